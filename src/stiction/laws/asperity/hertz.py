r"""One elastic asperity without adhesion: Hertz 1882.

*Assumes*: elastic, smooth bodies without adhesion and friction; a contact radius $a\ll R$. *Source*: [hertz_1882].

$$
P=w^{3/2},\qquad A=w
$$

In SI $P=\tfrac43E^*R^{1/2}\omega^{3/2}$, $a^2=R\omega$, largest pressure
$p_0=\tfrac32P/(\pi a^2)=(2E^*/\pi)\sqrt{\omega/R}$. *Coordinate* of integration: $u=\sqrt w$, in which load and area are
polynomials.

**First yield.** Without shear, a Hertz contact first yields (von Mises, yield stress $Y$) on its axis, at a depth $z$ below
the surface ([johnson_1985], eq. 3.45 for the stresses). The table compares the exact $p_0/Y$, from `first_yield`, with the
fits in the elastic-plastic laws: $1.295\,e^{0.736\nu}$ of Jackson and Green, $1.234+1.256\nu$ of Brizmer et al.,
$2.8\,(0.454+0.41\nu)$ of Chang et al.:

| $\nu$ | depth $z/a$ | exact $p_0/Y$ | Jackson and Green | Brizmer et al. | Chang et al. |
|---|---|---|---|---|---|
| 0.10 | 0.4149 | 1.3945 | 1.3939 | 1.3596 | 1.3860 |
| 0.20 | 0.4478 | 1.4986 | 1.5004 | 1.4852 | 1.5008 |
| 0.25 | 0.4643 | 1.5543 | 1.5566 | 1.5480 | 1.5582 |
| 0.30 | 0.4809 | 1.6128 | 1.6150 | 1.6108 | 1.6156 |
| 0.35 | 0.4975 | 1.6741 | 1.6755 | 1.6736 | 1.6730 |
| 0.40 | 0.5142 | 1.7385 | 1.7383 | 1.7364 | 1.7304 |
| 0.45 | 0.5310 | 1.8061 | 1.8035 | 1.7992 | 1.7878 |
| 0.499 | 0.5475 | 1.8758 | 1.8697 | 1.8607 | 1.8441 |

The fit of Jackson and Green is within 0.4 % throughout. The other two are linear in $\nu$, with errors up to 2.5 % outside
$\nu$ = 0.2 to 0.4.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\nu$ Poisson's ratio. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, edges_at, root_of
from stiction.laws.shared_claims import ELASTIC
from stiction.records.registry import AsperityLaw
from stiction.records.sources import Source


@formula
def load(w):
    """Return Hertz's load w^(3/2) at the displacement w.

    Units: w in sigma, load in K R^(1/2) sigma^(3/2) with K = (4/3) E*.
    """
    return w * math.sqrt(w)


@formula
def normal(u):
    """Return displacement w, dw/du, load and contact area of a Hertz contact at the coordinate u = sqrt(w).

    The load is w^(3/2), the area w. Units: w in sigma, load in K R^(1/2) sigma^(3/2) with K = (4/3) E*, area in pi R sigma.
    """
    w = u * u
    return w, 2.0 * u, w * u, w


def elastic(last: np.ndarray) -> NormalSegment:
    """Return Hertz's law as a NormalSegment, from first touch to the displacements `last` (n,) in units of sigma.

    Asperity laws with yield use it for their elastic part.
    """
    return NormalSegment(normal, root_of, (), edges_at(0.0, np.sqrt(last)), "elastic")


def segments(groups: Groups) -> list[NormalSegment]:
    return [elastic(np.full(len(groups), np.inf))]


def first_yield(nu: float) -> tuple[float, float]:
    """Return p0/Y and z/a at which a frictionless Hertz contact first yields (von Mises).

    p0/Y: largest contact pressure divided by the yield stress. z/a: depth of first yield below the centre of the contact,
    divided by the contact radius. nu: Poisson's ratio, 0 <= nu < 0.5. Source: stresses on the axis as in Johnson, Contact
    Mechanics (1985), eq. 3.45; with stresses in units of p0 and z in units of a, sigma_r = -(1 + nu)(1 - z arctan(1/z)) +
    1/(2 (1 + z^2)), sigma_z = -1/(1 + z^2).
    """
    from scipy.optimize import brentq

    def slope(z):
        """Return d(sigma_r - sigma_z)/dz, the derivative of radial minus axial stress along the axis, at the depth z.

        Stresses are in units of the largest pressure, z in units of the contact radius. The derivative falls from (1 + nu) pi/2
        at the surface to below zero at z = 1. nu: Poisson's ratio.
        """
        return (1.0 + nu) * (math.atan2(1.0, z) - z / (1.0 + z * z)) - 3.0 * z / (1.0 + z * z) ** 2

    z = brentq(slope, 0.0, 1.0, xtol=1e-14)
    largest = 1.5 / (1.0 + z * z) - (1.0 + nu) * (1.0 - z * math.atan2(1.0, z))
    return 1.0 / largest, z


RECORD = AsperityLaw(
    key="hertz",
    title="Elastic sphere without adhesion",
    grade="B",
    sources=(Source("hertz_1882", "load and contact area of two elastic spheres"),),
    segments=segments,
    traits=frozenset({"no adhesion", "Hertz", "Hertz's shape"}),
    verified="closed forms of load and area; sums over Gaussian heights at 30 digits",
    validity=(ELASTIC,),
)
