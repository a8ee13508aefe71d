r"""Tangential force at which a Hertz contact first yields anywhere, on its surface or below: Hamilton's stresses, von Mises.

*Assumes*: a Hertz contact fails when it first yields (von Mises) under normal load and tangential force, anywhere on its
surface or below. *Source*: [hamilton_1983], the stresses under Hertz's pressure $p_0\sqrt{1-r^2}$ and a shear traction
$q_0\sqrt{1-r^2}$ proportional to it, in the direction $x$. The depth $z$ and the distance $r$ from the axis are in units of
the contact radius $a$; the yield stress is $Y=H/k$. The formulas are rearranged in oblate spheroidal coordinates $M$ and $N$,

$$
z=MN,\qquad r^2=(1+M^2)(1-N^2)
$$

which avoid the cancellation of powers of $1/r$ near the axis. Short closed forms are:

- axis: $\sigma_x=\sigma_y=p_0(1+\nu)(z\arctan\tfrac1z-1)$ $+\,\frac{p_0}{2(1+z^2)}$, $\sigma_z=-\frac{p_0}{1+z^2}$,
  $\tau_{xz}=q_0\left[-1+\tfrac32z\arctan\tfrac1z-\frac{z^2}{2(1+z^2)}\right]$;
- surface inside the contact, from the traction: $\sigma_x=-\tfrac\pi8(4+\nu)x\,q_0$, $\sigma_y=-\tfrac{3\pi}8\nu x\,q_0$,
  $\tau_{xy}=-\tfrac\pi8(2-\nu)y\,q_0$, $\tau_{xz}=-\sqrt{1-r^2}\,q_0$;
- trailing edge $x=-1$: (S3.5) of [theory](theory.md#32-yield), and for the force (S3.7).

With $s=p_0/Y$ and $q=q_0/Y$, the position of first yield moves as $s$ grows. It is first on the surface inside the contact,
from the centre ($s=0$, $q=1/\sqrt3$) towards the trailing edge, where the stresses depend on $s$ only through $(1-2\nu)s$. It
is then the trailing edge itself (never for $\nu$ above about 0.39). Finally it is below the surface ahead of the axis, until
the load alone causes yield at $s=s_0$, where $q$ vanishes in proportion to $\sqrt{s_0-s}$. $q(s,\nu)$ at the first and at the
last of these positions has no closed form; it is a Chebyshev series in $s$ and $\nu$, computed from the stresses and accurate
to $10^{-9}$.

*Check*: first yield of the sheared contact, $\nu=0.3$; the last column is $p_0/Y$ for yield at the trailing edge:

| $\mu=q_0/p_0$ | $p_0/Y$ | position $(x,z)/a$ | the trailing edge alone |
|---|---|---|---|
| 0 | 1.6128 | (0, 0.481) | 4.3301 |
| 0.05 | 1.6099 | (0.055, 0.481) | 3.4103 |
| 0.1 | 1.6014 | (0.111, 0.475) | 2.7678 |
| 0.2 | 1.5682 | (0.218, 0.457) | 1.9790 |
| 0.25 | 1.5442 | (0.269, 0.445) | 1.7263 |
| 0.3 | 1.5157 | (0.318, 0.430) | 1.5291 |
| 0.35 | 1.3713 | (−1, 0) | 1.3713 |
| 0.4 | 1.2426 | (−1, 0) | 1.2426 |
| 0.5 | 1.0453 | (−1, 0) | 1.0453 |
| 0.6 | 0.9015 | (−1, 0) | 0.9015 |
| 0.8 | 0.7034 | (−0.376, 0) | 0.7065 |
| 1.0 | 0.5677 | (−0.310, 0) | 0.5806 |
| 2.0 | 0.2874 | (−0.162, 0) | 0.3066 |

and at other Poisson's ratios, $p_0/Y$:

| | $\mu=0$ | 0.2 | 0.3 | 0.5 | 1.0 |
|---|---|---|---|---|---|
| $\nu=0.25$ | 1.5543 | 1.5141 | 1.4089 | 0.9891 | 0.5633 |
| $\nu=0.4$ | 1.7385 | 1.6819 | 1.6155 | 1.1334 | 0.5745 |

First yield moves to the surface between $\mu=0.30$ and 0.31 at $\nu=0.3$ (0.27 to 0.28 at $\nu=0.25$, 0.35 to 0.36 at
$\nu=0.4$). The two positions checked by [`chang_etsion_bogy_1988`](#chang_etsion_bogy_1988-tangential-law) therefore give too
large a load at first yield: by 2 % at $\mu=1$ and 7 % at $\mu=2$ ($\nu=0.3$), and by 1, 4, 7 and 9 % at $\mu$ = 0.4, 0.6, 1
and 2 ($\nu=0.4$). The load at which the axis alone yields is too large by 1.6 % at $\mu=0.2$ and 3.5 % at $\mu=0.3$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $k=H/Y$ hardness divided by yield stress; $\nu$ Poisson's ratio. Full list:
[symbols](#1-units).
"""

import math
from dataclasses import replace
from functools import cache, lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.joining import coordinates
from stiction.laws.segment import NormalSegment, TangentialResistance, edges_at
from stiction.laws.tangential.shared.edge_yield import yield_resistance
from stiction.laws.tangential.shared.hamilton_field import Stress, dragged, least_over, pressed, von_mises
from stiction.records.registry import TangentialLaw
from stiction.records.sources import Source

# Numbers of terms of both series in s = p0/Y, and of their coefficients in Poisson's ratio from 0 to 0.5.
INSIDE, BELOW, IN_NU = 14, 15, 20


def inside_reach(nu):
    """Return the largest (1 - 2 nu) p0/Y for which the series for yield on the surface inside the contact is fitted.

    nu: Poisson's ratio. p0/Y: largest pressure divided by yield stress. For nu up to 0.4 the series is used up to a value
    that is 0.4 to 7 % smaller. For larger nu it is used up to a much smaller value, because the asperity yields below the
    surface first.
    """
    return 0.205 + 0.33 * nu


def below_reach(nu):
    """Return the relative width of the range of p0/Y in which the series for yield below the surface is fitted.

    p0/Y: largest pressure divided by yield stress. The range is (1 - width) s_0 to s_0, where s_0 is the p0/Y at which the load
    alone causes yield. nu: Poisson's ratio. The series is used where yield below the surface comes first; this begins at most
    0.02 s_0 above the start of the range.
    """
    return 0.012 + 0.22 * nu


def shear_at_yield(s, nu, x, z) -> np.ndarray:
    """Return the ratio q0/Y of largest traction to yield stress at which a given point of a sheared Hertz contact yields.

    s: largest pressure divided by the yield stress, p0/Y. nu: Poisson's ratio. x, z: position along the direction of shear and
    depth of the point, in units of the contact radius. The arguments are broadcast. The result is infinite if the point never
    yields; s alone must not make it yield. The squared von Mises stress is a quadratic form in s and q0/Y.
    """
    return _root(s, *_forms(nu, x, z))


def _forms(nu, x, z) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the coefficients of s^2, 2 s q and q^2 in the squared von Mises stress at a point of a Hertz contact.

    The squared stress is in units of Y^2. s, q: largest pressure and largest traction, each divided by the yield stress Y.
    nu: Poisson's ratio. x, z: position along the direction of shear and depth of the point, in units of the contact radius.
    """
    normal, tangential = pressed(x, 0.0, z, nu), dragged(x, 0.0, z, nu)
    return _product(normal, normal), _product(normal, tangential), _product(tangential, tangential)


def _root(s, of_s, of_both, C) -> np.ndarray:
    """Return the larger root q of the yield condition C q^2 + 2 B q + A = 0, with A = s^2 of_s - 1 and B = s of_both.

    s: largest pressure divided by the yield stress. of_s, of_both, C: coefficients from `_forms`. The root is computed
    without cancellation; it is infinite for C = 0.
    """
    A, B = s * s * of_s - 1.0, s * of_both
    root = np.sqrt(np.maximum(B * B - A * C, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(C > 0.0, np.where(B > 0.0, -A / (B + root), (root - B) / C), np.inf)


def _product(first: Stress, other: Stress) -> np.ndarray:
    """Return 3/2 of the double contraction of the deviators of two stresses, each with the components (x, y, z, xy, yz, xz).

    For two equal stresses this is the squared von Mises stress.
    """
    shear = first[3] * other[3] + first[4] * other[4] + first[5] * other[5]
    mean = (first[0] + first[1] + first[2]) * (other[0] + other[1] + other[2]) / 3.0
    return 1.5 * (first[0] * other[0] + first[1] * other[1] + first[2] * other[2] - mean) + 3.0 * shear


@cache
def first_yield_of_load() -> np.ndarray:
    """Return the coefficients (IN_NU,) of a Chebyshev series in 4 nu - 1 for s_0.

    s_0: p0/Y at which the load alone causes yield. p0/Y: largest pressure divided by yield stress. nu: Poisson's ratio.
    """
    nu = (1.0 + chebyshev.chebpts1(IN_NU)) / 4.0
    largest = least_over(lambda x, z: -von_mises(pressed(x, 0.0, z, nu[:, None])), np.zeros(IN_NU), 0.48, 0.0, 0.1)[2]
    return _fit(-1.0 / largest[None, :])[0]


@cache
def series_inside() -> np.ndarray:
    """Return the coefficients (INSIDE, IN_NU) of a Chebyshev series of q0/Y at yield on the surface inside the contact.

    The variables are 2 y - 1 and 4 nu - 1, with Poisson's ratio nu, y = (1 - 2 nu) s / inside_reach(nu) and s = p0/Y. q0 and
    p0: largest traction and pressure; Y: yield stress.
    """
    y, nu = _nodes(INSIDE)
    # At nu = 0.5 every y but 0 means an infinite s, but stresses on the surface depend on s only through (1 - 2 nu) s.
    s = y * inside_reach(nu) / (1.0 - 2.0 * nu)
    return _fit(_least(s, nu, np.linspace(-0.8, 0.1, 19), 0.0, 0.05, 0.0))


@cache
def series_below() -> np.ndarray:
    """Return the coefficients (BELOW, IN_NU) of a Chebyshev series of (q0/Y)^2/y at yield below the surface.

    The variables are 2 y - 1 and 4 nu - 1, with Poisson's ratio nu, y = (1 - s/s_0) / below_reach(nu), s = p0/Y, and s_0 the
    value of s at which the load alone causes yield. q0 and p0: largest traction and pressure; Y: yield stress.
    """
    y, nu = _nodes(BELOW)
    s = chebyshev.chebval(4.0 * nu - 1.0, first_yield_of_load()) * (1.0 - y * below_reach(nu))

    return _fit(_least(s, nu, np.linspace(0.0, 1.0, 11), np.linspace(0.3, 0.6, 4)[:, None], 0.1, 0.1) ** 2 / y)


def _least(s, nu, x, z, reach_x: float, reach_z: float) -> np.ndarray:
    """Return the ratio q0/Y at which a Hertz contact first yields, the smallest value of `shear_at_yield` over all its points.

    q0: largest traction. Y: yield stress. s: largest pressure divided by Y. nu: Poisson's ratio. s, nu and the result are
    arrays of one shape. The points (x, z), in units of the contact radius, are tried first. Then a neighbourhood of the point
    that yields first, reach_x by reach_z in size, is searched.
    """

    def shear(x, z):
        return shear_at_yield(s[..., None], nu[..., None], x, z)

    x, z = (array.ravel() for array in np.broadcast_arrays(x, z))
    best = shear(x, z).argmin(axis=-1)
    return least_over(shear, x[best], z[best], reach_x, reach_z)[2]


def _nodes(terms: int) -> tuple[np.ndarray, np.ndarray]:
    """Return two arrays (terms, IN_NU), a grid of Chebyshev points of y (0 to 1, along axis 0) and nu (0 to 0.5, along axis 1).

    y: variable of a series. nu: Poisson's ratio.
    """
    y, nu = (1.0 + chebyshev.chebpts1(terms)) / 2.0, (1.0 + chebyshev.chebpts1(IN_NU)) / 4.0
    return np.meshgrid(y, nu, indexing="ij")


def _fit(values: np.ndarray) -> np.ndarray:
    """Return the Chebyshev coefficients of a function of y and Poisson's ratio from its values on the grid of `_nodes`.

    Values and coefficients have the same shape, (terms, IN_NU).
    """
    for axis in (0, 1):
        count = values.shape[axis]
        basis = chebyshev.chebvander(chebyshev.chebpts1(count), count - 1)
        values = np.moveaxis(np.tensordot(np.linalg.inv(basis), values, axes=(1, axis)), 0, axis)
    return values


@formula
def _sum(y, series, first, terms):
    """Return the sum of a Chebyshev series in 2 y - 1 at y in [0, 1], by Clenshaw's method.

    The coefficients are series[first:first + terms].
    """
    t = 4.0 * y - 2.0
    last = before = 0.0
    for k in range(first + terms - 1, first, -1):
        last, before = series[k] + t * last - before, last
    return series[first] + 0.5 * t * last - before


@formula
def resistance(u, w, load, area, *row):
    """Return the slip-limited and the yield-limited force of an elastic asperity, (0, Q) with Q = (q0/p0) P.

    Q is 0 if the load alone causes yield. load, area: P and contact area. u, w: not used. row: hardness group eta; k = H/Y;
    Poisson's ratio; three values of s = p0/Y (see `series_for`); two factors that convert s to the variables y of the two
    series; coefficients of both series. s = 1.5 k P/(eta A), because the mean pressure is H where P = eta A (theory.md) and H =
    k Y. Units: load and forces in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    eta, k, nu, inside_until, below_from, end, to_inside, to_below = row[:8]
    series = row[8:]
    strength = eta * area / k  # the load at which the mean pressure is Y
    s = 1.5 * load / strength if area > 0.0 else 0.0
    if s >= end:
        return 0.0, 0.0
    if s >= below_from:
        y = (1.0 - s / end) * to_below
        return 0.0, strength / 1.5 * (y * _sum(y, series, INSIDE, BELOW)) ** 0.5
    if s >= inside_until:
        return 0.0, yield_resistance(load, strength / math.pi, nu)
    return 0.0, strength / 1.5 * _sum(s * to_inside, series, 0, INSIDE)


def series_for(nu: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the parameters of `resistance` that depend on Poisson's ratio alone: (5, n) and (INSIDE + BELOW, n).

    The first array holds three values of s = p0/Y and two factors that convert s to the variables of the two series. First
    yield is on the surface inside the contact for s below the first value, at the trailing edge between the first two
    values, below the surface above the second, and due to the load alone above the third. The second array holds the
    coefficients of both series. nu: Poisson's ratio (n,).
    """
    known, which = np.unique(nu, return_inverse=True)
    steps, series = _series_for(known.tobytes())
    return steps[:, which], series[:, which]


@lru_cache(maxsize=16)
def _series_for(nu_bytes: bytes) -> tuple[np.ndarray, np.ndarray]:
    nu = np.frombuffer(nu_bytes)
    t = 4.0 * nu - 1.0
    inside, below = chebyshev.chebval(t, series_inside().T), chebyshev.chebval(t, series_below().T)
    end = chebyshev.chebval(t, first_yield_of_load())

    def q_inside(s):
        return chebyshev.chebval(2.0 * s * (1.0 - 2.0 * nu) / inside_reach(nu) - 1.0, inside, tensor=False)

    def q_below(s):
        y = (1.0 - s / end) / below_reach(nu)
        return np.sqrt(y * chebyshev.chebval(2.0 * y - 1.0, below, tensor=False))

    at_edge = _forms(nu, -1.0, 0.0)

    # q of all three positions falls with s: below the surface from above the others to zero, at the edge least steeply.
    first = end * (1.0 - below_reach(nu))
    reach = np.minimum(inside_reach(nu) / np.maximum(1.0 - 2.0 * nu, 1e-300), end)
    inside_until = _crossing(lambda s: q_inside(s) >= _root(s, *at_edge), np.zeros_like(nu), reach)

    def is_below(s):
        return q_below(s) <= np.minimum(np.where(s < reach, q_inside(s), np.inf), _root(s, *at_edge))

    below_from = _crossing(is_below, first, end)
    scale = (1.0 - 2.0 * nu) / inside_reach(nu), 1.0 / below_reach(nu)
    return np.stack([np.minimum(inside_until, below_from), below_from, end, *scale]), np.concatenate([inside, below])


def _crossing(passed, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Return the value (n,) between low and high (n,) at which the condition `passed` becomes True, or high if it never does.

    passed(values): a mask (n,). Bisection to 1e-10 of the range is sufficient, because the resistance is continuous: an
    error in the position of a kink has only a second-order effect.
    """
    for _ in range(34):
        middle = 0.5 * (low + high)
        beyond = passed(middle)
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return high


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance | None:
    """Return the tangential force at first yield along an elastic segment, or None for other segments.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts. The stresses are those of a Hertz
    contact. Yielded asperities have no resistance.
    """
    if segment.state != "elastic":
        return None
    eta, k = groups.eta, groups.hardness_to_yield
    steps, series = series_for(groups.nu)
    endless = replace(segment, edges=edges_at(segment.edges[:, 0], np.inf))
    # Hertz: p0/Y = 1.5 k sqrt(w)/eta. A kink slightly beyond the segment is not moved, because it still affects the integrand.
    kinks = np.stack([coordinates(endless, (s * eta / (1.5 * k)) ** 2) for s in steps[:3]], axis=1)
    return TangentialResistance(resistance, (eta, k, groups.nu, *steps, *series), kinks, branch=kinks[:, 2:])


RECORD = TangentialLaw(
    key="hamilton_1983",
    title="First yield anywhere in a pressed and sheared Hertz contact",
    grade="B",
    sources=(Source("hamilton_1983", "stresses under the normal and the tangential load", "with the von Mises criterion"),),
    tangential_resistance=tangential_resistance,
    yielded="none",
    of_half_space="its stresses are those of a half-space",
    like="layered_first_yield",
    verified="stresses: equilibrium, surface tractions and independent integration of point loads; first yield by search",
    needs=("hardness_group", "nu", "hardness_to_yield"),
    accuracy=1e-9,
    required_traits={
        "Hertz": "it uses the stresses of a Hertz contact",
        "no adhesion": "it neglects adhesion",
    },
    notes="The force is the largest one without yield anywhere in the asperity; it is zero if the load alone causes yield.",
)
