r"""Tangential force at which a Hertz contact first yields, on its axis or at its trailing edge: Chang, Etsion & Bogy 1988.

*Assumes*: a Hertz contact fails when it first yields (von Mises) under normal load and tangential force, at one of two points:
on the axis at the depth $z=0.48$ contact radii, or at the trailing edge. At and beyond the displacement $\omega_c$, at which
it yields under the normal load alone, the contact has no resistance. *Source*: [chang_etsion_bogy_1988], with the stresses of
[hamilton_1983], as restated by [eriten_2010]. The friction coefficient $\mu$ of one asperity ($T=\mu P$) depends on $r=w/w_c$
with $w_c$ and $K_H$ of [`chang_etsion_bogy_1987`](#chang_etsion_bogy_1987):

$$
\mu=\min\left\{\frac{0.2045}{K_H|c_1|}\sqrt{\frac1r-1},\ \frac{-c_4+\sqrt{c_4^2-4c_3c_5}}{2c_3}\right\}\ (r<1),\qquad0\ (r\ge1)
$$

$$
c_1=-1+\tfrac32z\arctan\tfrac1z-\frac{z^2}{2(1+z^2)}\ (z=0.48),\qquad
c_3=\tfrac{9\pi^2}{16}\left(2-\tfrac\nu2+\tfrac78\nu^2\right)
$$

$$
c_4=\tfrac{9\pi}4(1-2\nu)\left(1-\tfrac\nu2\right),\qquad c_5=\tfrac32(1-2\nu)^2-\frac{0.56}{K_H^2\,r}
$$

0.2045 and 0.56 are $0.354/\sqrt3$ and $\tfrac92\cdot0.354^2$, rounded in print. The law therefore contains $Y=0.354H$, for any
$k$ of the contact. *Check*, at $\nu=0.3$: $K_H=0.577$, $c_1=-0.284869$, $c_3=10.707750$, $c_4=2.403318$.

| $\omega/\omega_c$ | 0.01 | 0.05 | 0.1 | 0.2 | 0.3 | 0.4 | 0.5 | 0.6 | 0.7 | 0.8 | 0.9 | 0.95 | 0.99 |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
| $\mu$ | 3.8499 | 1.6575 | 1.1372 | .7685 | .6046 | .5066 | .4395 | .3898 | .3510 | .3197 | .2936 | .2822 | .1250 |
| $T/P_c$ | .00385 | .01853 | .03596 | .06873 | .09934 | .12815 | .15537 | .18115 | .20558 | .22874 | .25071 | .26126 | .12317 |

$P_c=w_c^{3/2}$ is the load at $\omega_c$. The axis yields first above $r=0.9512$. The adhesion of the 1988 papers is not
included. With the option `plastic_junctions`, asperities beyond $\omega_c$ resist according to another law, and results show by
how much $\mu$ then differs from the paper's value; the default `none` is the paper's assumption.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $\nu$ Poisson's ratio; $k=H/Y$ hardness divided by yield stress. Full list:
[symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.bisection import halving
from stiction.engine.compiled import formula, lazy_kernel
from stiction.laws.asperity.chang_etsion_bogy_1987 import critical_interference, hardness_coefficient
from stiction.laws.joining import coordinates
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.shared.plastic_junctions import LAWS, beyond, of_whole_segment
from stiction.records.registry import NO_JUNCTIONS, TangentialLaw, Validity
from stiction.records.sources import Source

# Both come from Y/H = 0.354, as rounded in print: 0.354/sqrt(3) and 4.5 (0.354)^2 would be 0.20438 and 0.56392.
_ON_AXIS, _AT_EDGE = 0.2045, 0.56


@formula
def axis_coefficient(nu):
    """Return c1, the ratio of the shear stress on the axis of a sheared Hertz contact to the largest surface traction q0.

    c1 = -1 + (3/2) z atan(1/z) - z^2 / (2 (1 + z^2)), where z = 0.48 is the depth of first yield, in units of the contact
    radius, for nu = 0.3. The authors use this depth for every Poisson's ratio; nu is not used.
    """
    z = 0.48
    return -1.0 + 1.5 * z * math.atan(1.0 / z) - z * z / (2.0 * (1.0 + z * z))


@formula
def on_axis(w_ratio, nu, K_H):
    """Return the ratio of tangential to normal force at which a Hertz contact yields on its axis; it is 0 for w_ratio >= 1.

    w_ratio: displacement divided by the displacement at first yield without shear. K_H: largest pressure at that yield
    divided by the hardness. nu: Poisson's ratio. At yield (f p0)^2 + 3 (c1 q0)^2 = Y^2, with the yield stress Y. Without
    shear, the von Mises stress on the axis is f times the largest pressure p0. The largest traction q0 adds the shear
    stress c1 q0 on the axis, see `axis_coefficient`.
    """
    return _ON_AXIS / (K_H * abs(axis_coefficient(nu))) * math.sqrt(max(1.0 / w_ratio - 1.0, 0.0))


@formula
def at_edge(w_ratio, nu, K_H):
    """Return the ratio of tangential to normal force at which a Hertz contact yields at its trailing edge.

    It is the positive root mu of c3 mu^2 + c4 mu + c5 = 0. w_ratio: displacement divided by the displacement at first yield
    without shear. K_H: largest pressure at that yield divided by the hardness. nu: Poisson's ratio.
    """
    c3 = 9.0 * math.pi * math.pi / 16.0 * (2.0 - nu / 2.0 + 7.0 / 8.0 * nu * nu)
    c4 = 9.0 * math.pi / 4.0 * (1.0 - 2.0 * nu) * (1.0 - nu / 2.0)
    c5 = 1.5 * (1.0 - 2.0 * nu) * (1.0 - 2.0 * nu) - _AT_EDGE / (K_H * K_H * w_ratio)
    return (math.sqrt(max(c4 * c4 - 4.0 * c3 * c5, 0.0)) - c4) / (2.0 * c3)


@formula
def friction_coefficient(w_ratio, nu, K_H):
    """Return the friction coefficient of one asperity, the ratio of tangential to normal force at which it first yields.

    It is the smaller of `on_axis` and `at_edge`, and 0 if the load alone causes yield (w_ratio >= 1). w_ratio: displacement
    divided by the displacement at first yield without shear. K_H: largest pressure at that yield divided by the hardness.
    nu: Poisson's ratio.
    """
    return min(on_axis(w_ratio, nu, K_H), at_edge(w_ratio, nu, K_H)) if w_ratio < 1.0 else 0.0


@formula
def _at_edge_first(w_ratio, arguments):
    return on_axis(w_ratio, *arguments) > at_edge(w_ratio, *arguments)


_halve = halving(_at_edge_first)


@lazy_kernel(worth=300)
def _fill_first_on_axis(nu, K_H, out):
    for i in range(nu.size):
        out[i] = _halve(0.5, 1.0, (nu[i], K_H[i]))


def first_on_axis(nu: np.ndarray, K_H: np.ndarray) -> np.ndarray:
    """Return the ratio (n,) w/w_c above which a Hertz contact under shear yields on its axis first.

    w: displacement. w_c: displacement at first yield without shear. Below this ratio the contact yields at its trailing
    edge first. nu (n,): Poisson's ratio. K_H (n,): largest pressure at first yield without shear divided by the hardness.
    The ratio is found by bisection; it is 0.9512 for nu = 0.3.
    """
    out = np.empty_like(nu)
    _fill_first_on_axis(nu, K_H, out)
    return out


@formula
def resistance(u, w, load, area, w_c, nu, K_H):
    """Return the slip-limited and the yield-limited force of one asperity, (0, mu P).

    Both are 0 before first touch and for w >= w_c. w: displacement in units of sigma. load: P in units of K R^(1/2)
    sigma^(3/2), like the forces. w_c: displacement at first yield without shear. nu: Poisson's ratio. K_H: largest pressure
    at that yield divided by the hardness. u, area: not used.
    """
    return 0.0, load * friction_coefficient(w / w_c, nu, K_H) if 0.0 < w < w_c else 0.0


def tangential_resistance(
    segment: NormalSegment, groups: Groups, plastic_junctions: str = NO_JUNCTIONS
) -> TangentialResistance | None:
    """Return the tangential resistance on a segment, or None for a plastic segment without resistance.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts. Up to the displacement at first
    yield the resistance is the force at which a Hertz contact yields under shear. Beyond it there is none, unless
    `plastic_junctions` is the key of another law, whose resistance is then used.
    """
    if segment.state == "plastic":
        return of_whole_segment(plastic_junctions, segment, groups)
    K_H = hardness_coefficient(groups.nu)
    w_c = critical_interference(groups.eta, K_H)
    # Yield moves from the edge to the axis at the first kink; at the second the resistance ends like sqrt(w_c - w).
    kinks = [coordinates(segment, w) for w in (first_on_axis(groups.nu, K_H) * w_c, w_c)]
    published = TangentialResistance(resistance, (w_c, groups.nu, K_H), np.stack(kinks, axis=1), kinks[1][:, None])
    return beyond(plastic_junctions, w_c, published, segment, groups)


RECORD = TangentialLaw(
    key="chang_etsion_bogy_1988",
    title="First yield of a Hertz contact under load and shear, on its axis or at its trailing edge",
    grade="B",
    sources=(
        Source("chang_etsion_bogy_1988", "", "stress criteria as restated by Eriten, Polycarpou & Bergman 2010"),
        Source("hamilton_1983", "stresses on the axis and at the edge"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="none",
    of_half_space="it checks only two places, at which a half-space first yields",
    like="layered_first_yield",
    required_traits={
        "Hertz": "it uses the stresses of a Hertz contact",
        "no adhesion": "it neglects adhesion",
    },
    verified="friction of single asperities tabulated independently; independent evaluation at 30 digits",
    needs=("hardness_group", "nu"),
    junctions=LAWS,
    validity=(
        Validity(
            "plasticity_index",
            0.0,
            0.6,
            "plastic asperities have no friction in this law, so mu is too low",
            "effect",
            as_published=True,
        ),
    ),
    notes="The critical interference is that of chang_etsion_bogy_1987 with any asperity law. Beyond it an asperity has no "
    "resistance, or that of the law named by plastic_junctions. Yield is checked at two places only: on the axis at one depth, "
    "and at the trailing edge.",
)
