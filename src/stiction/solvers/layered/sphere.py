"""Solve the contact of a rigid sphere or flat punch with coated elastic bodies, without friction.

The sphere is a paraboloid of radius R. The pressure p(r) on the contact of radius a has the Hankel transform P(k) =
Integral_0^a g(s) cos(k s) ds. Abel's transform of the displacement u(r) = delta - r^2/(2R) (delta: approach) gives a Fredholm
equation of the second kind for g (Lebedev & Ufliand 1958; numerical method of Perriot & Barthel 2004). With a = 1, and moduli
divided by the contact modulus E1 of the two surface materials, it is

    g(s) + (2/pi) Integral_0^1 K(s, s') g(s') ds' = delta - s^2/R,
    K(s, s') = Integral_0^infinity [c(k t) - 1] cos(k s) cos(k s') dk,    load = 2 E1 Integral_0^1 g ds,    g(1) = 0.

c is the compliance at the wavenumber k relative to half-spaces, t the film thickness. The equation is solved by Galerkin's
method in even Legendre polynomials, whose transforms are spherical Bessel functions. The solution has the least elastic energy
among all pressures of this form, and errors fall geometrically with the number of polynomials. This holds for a = 1000 t too:
the polynomials are dense at the contact edge and resolve a boundary layer as wide as the film. Let g_0 be the solution of the
flat punch (right side 1) and g_2 the solution for the right side s^2. Then

    stiffness S = 2 a E_S, E_S = Integral g_0;   approach delta = D a^2/R, D = g_2(1)/g_0(1);
    load P = 4 E_P a^3/(3R), E_P = (3/2)(D Integral g_0 - Integral g_2);   dS/da = 2 B, B = g_0(1)^2 (Krein's identity).

Derivatives with respect to ln a follow from differentiating the equation with respect to s and to a. dP/d delta = S follows
from these equations and is not imposed.
"""

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from stiction.solvers.layered.compliance import Pair, compliance

# Wavenumbers k t at which integrals are split. Beyond the last one the compliance equals that of the film alone to within 1e-9.
_ENDS = (0.0, 0.03, 0.1, 0.3, 0.8, 2.0, 4.5, 12.0)
# Largest phase, in radians, that one integration rule covers.
_LONGEST = 60.0


class Response(NamedTuple):
    """Store the response of coated bodies to a sphere of radius R at one contact radius a.

    P is the load and delta the approach. E_P, E_S and B are divided by E1, the contact modulus of the two surface materials
    (the film's where a body is coated). load: E_P in P = 4 E_P a^3/(3R). approach: D in delta = D a^2/R. stiffness: E_S in dP/d
    delta = 2 a E_S. edge: B in dS/da = 2 B, where S = dP/d delta; adhesion at the contact edge follows from B. load_slope,
    approach_slope, edge_slope: derivatives of ln E_P, ln D and ln B with respect to ln a.
    """

    load: float
    approach: float
    stiffness: float
    edge: float
    load_slope: float
    approach_slope: float
    edge_slope: float


def respond(pair: Pair, radius: float) -> Response:
    """Return the dimensionless response of coated bodies to a sphere at one contact radius: a `Response`.

    It holds the moduli that determine load, stiffness and adhesion at the contact edge, the approach, and derivatives with
    respect to the contact radius. pair: the coatings. radius: contact radius divided by the film thickness (the same for all
    films), > 0; tested up to 1000. The numbers are accurate to 1e-6.
    """
    _, _, even, at_edge, edge_slope = waves(float(radius))
    softer, g_0, g_2, radius_slope, to_edge = _solve(pair, float(radius))
    return response_of(g_0, g_2, radius_slope, to_edge, even @ (softer * edge_slope), softer @ (at_edge * at_edge))


def response_of(
    g_0: np.ndarray, g_2: np.ndarray, radius_slope: np.ndarray, to_edge: np.ndarray, to_edge_slope: np.ndarray, edge: float
) -> Response:
    """Return the `Response` of coated bodies to a sphere at one contact radius, from solutions of the contact equation.

    g_0, g_2, radius_slope (n,): coefficients of the solution for the flat punch, of the solution for the displacement s^2, and
    of the derivative of g_0 with respect to the contact radius, divided by g_0(1). to_edge (n,): factors that give the value at
    the contact edge. All four are from `_solve`. to_edge_slope (n,): derivative of `to_edge` with respect to the coordinate s,
    at the edge. edge: (2/pi) K(1, 1), with the kernel K of the contact equation of this module.
    """
    edge_0, edge_2 = 1.0 - to_edge @ g_0, 1.0 - to_edge @ g_2
    slope_0, slope_2 = -to_edge_slope @ g_0, 2.0 - to_edge_slope @ g_2
    stiffness, approach = g_0[0], edge_2 / edge_0
    load = 1.5 * (approach * stiffness - g_2[0])
    rise = (slope_2 - approach * slope_0) / edge_0  # d delta/da, from dg/ds + dg/da = 0 at the edge
    growth = slope_0 - edge_0 * (edge + to_edge @ radius_slope)
    return Response(
        float(load),
        float(approach),
        float(stiffness),
        float(edge_0 * edge_0),
        float(1.5 * stiffness * rise / load - 3.0),
        float(rise / approach - 2.0),
        float(2.0 * growth / edge_0),
    )


def pressure(pair: Pair, radius: float) -> np.ndarray:
    """Return the coefficients (n,) of the pressure under a sphere on coated bodies, in orthonormal even polynomials.

    The sum g(s) of coefficients times polynomials gives the Hankel transform of the pressure, P(k) = Integral_0^1 g(s) cos(k s)
    ds. Mean pressure and contact radius are 1. pair: the coatings. radius: contact radius divided by the film thickness.
    """
    _, g_0, g_2, _, to_edge = _solve(pair, float(radius))
    g = (1.0 - to_edge @ g_2) / (1.0 - to_edge @ g_0) * g_0 - g_2
    g[0] -= value_of(g, np.array(1.0))  # any remainder of g at the edge would be an infinite pressure there
    return g / (2.0 * g[0])


def spherical_waves(radius: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return nodes for integrals over wavenumbers, and at them the transforms of the polynomials that represent the pressure.

    The arrays are the wavenumbers k a (m,), the integration weights times 2/pi (m,), and the transforms (n, m) of n orthonormal
    even polynomials on 0 to 1. radius: contact radius a divided by the film thickness (the same for all films).
    """
    k, weights, even, _, _ = waves(float(radius))
    return k, weights, even


def value_of(g: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Return the value at s of a polynomial with the coefficients g (n,) in even polynomials orthonormal on 0 to 1.

    s: number or array, real or complex.
    """
    series = np.zeros(2 * g.size - 1)
    series[::2] = g * np.sqrt(4.0 * np.arange(g.size) + 1.0)
    return np.polynomial.legendre.legval(s, series)


def transform(g: np.ndarray, k: np.ndarray) -> np.ndarray:
    """Return the Hankel transform P(k) (m,) of the pressure under a sphere.

    g: coefficients of the pressure in orthonormal even polynomials, as `pressure` returns them. k: wavenumbers times the
    contact radius (m,), > 0.
    """
    order = np.arange(g.size)
    return (g * np.sqrt(4.0 * order + 1.0) * (-1.0) ** order) @ _even_bessel(k, g.size)


def _solve(pair: Pair, radius: float) -> tuple[np.ndarray, ...]:
    """Solve the contact equation for the flat punch, for the displacement s^2, and for the derivative by radius.

    radius: contact radius divided by the film thickness. Returns the weights times the relative excess compliance of each wave
    (m,); the coefficients (n,) of the flat punch's solution g_0, of the solution g_2 for s^2, and of the derivative of g_0 with
    respect to the contact radius, divided by g_0(1); and the factors (n,) that give the edge value g(1) from coefficients.
    """
    k, weights, even, at_edge, _ = waves(radius)
    softer = weights * (compliance(k / radius, pair) - 1.0)
    matrix = (even * softer) @ even.T
    matrix[np.diag_indices_from(matrix)] += 1.0
    to_edge = even @ (softer * at_edge)
    g_0, g_2, radius_slope = np.linalg.solve(matrix, np.column_stack([right_sides(len(matrix)), -to_edge])).T
    return softer, g_0, g_2, radius_slope, to_edge


def right_sides(size: int) -> np.ndarray:
    """Return the coefficients (size, 2) of the displacements 1 and s^2 in orthonormal even polynomials."""
    sides = np.zeros((size, 2))
    sides[0, 0], sides[:2, 1] = 1.0, (1.0 / 3.0, 2.0 / (3.0 * 5.0**0.5))
    return sides


@lru_cache(maxsize=256)
def waves(radius: float) -> tuple[np.ndarray, ...]:
    """Return wavenumbers k a (m,), integration weights, transforms (n, m), cos(k a) and -k a sin(k a).

    radius: contact radius a divided by the film thickness (the same for all films). Weights include the factor 2/pi. Transforms
    are those of even polynomials orthonormal on 0 to 1. The results depend on no material and are cached.
    """
    x, weights = gauss(_ENDS, radius)
    k = radius * x
    order = np.arange(int(9.0 + 4.0 * radius**0.5))
    even = _even_bessel(k, order.size) * (np.sqrt(4.0 * order + 1.0) * (-1.0) ** order)[:, None]
    return k, 2.0 / np.pi * radius * weights, even, np.cos(k), -k * np.sin(k)


def gauss(ends: Sequence[float], radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Return Gauss-Legendre nodes and weights for integrals over x, split at the values `ends`.

    x: wavenumber times film thickness. The nodes are dense enough to integrate cos^2(x radius).
    """
    nodes, weights = [], []
    for low, high in pairwise(ends):
        places = np.linspace(low, high, 2 + int((high - low) * radius / _LONGEST))
        t, w = np.polynomial.legendre.leggauss(int(12.0 + (places[1] - low) * radius))
        half = (places[1] - low) / 2.0
        nodes.append((places[:-1, None] + half * (t + 1.0)).ravel())
        weights.append(np.tile(half * w, places.size - 1))
    return np.concatenate(nodes), np.concatenate(weights)


def _even_bessel(k: np.ndarray, count: int) -> np.ndarray:
    """Return the spherical Bessel functions of the orders 0, 2, 4 ... at k (m,) > 0: (count, m).

    The upward recurrence is stable only for k above the order, so smaller k use Miller's downward recurrence.
    """
    out = np.empty((count, k.size))
    far = k > 2.0 * count
    for chosen, part in ((far, _upwards(k[far], count)), (~far, _downwards(k[~far], count))):
        out[:, chosen] = part
    return out


def _upwards(k: np.ndarray, count: int) -> np.ndarray:
    out = np.empty((count, k.size))
    before = np.sin(k) / k
    out[0], now = before, before / k - np.cos(k) / k
    for order in range(2, 2 * count - 1):
        before, now = now, (2 * order - 1) / k * now - before
        if order % 2 == 0:
            out[order // 2] = now
    return out


def _downwards(k: np.ndarray, count: int) -> np.ndarray:
    out = np.zeros((count, k.size))
    above, now = np.zeros(k.size), np.full(k.size, 1e-250)
    for order in range(2 * count + 40, 0, -1):
        above, now = now, (2 * order + 1) / k * now - above
        if order % 2 and order // 2 < count:
            out[order // 2] = now
        large = np.abs(now) > 1e200
        for row in (above, now):
            row[large] *= 1e-250
        out[:, large] *= 1e-250
    zeroth = np.sin(k) / k
    first = zeroth / k - np.cos(k) / k
    by_zeroth = np.abs(zeroth) > np.abs(first)
    return out * np.where(by_zeroth, zeroth, first) / np.where(by_zeroth, now, above)
