"""Sums over the summits of an isotropic Gaussian surface: Nayak's joint density of height and curvatures, and F_n(h).

Nayak (1971) counts the summits, points of zero slope that curve downwards in all directions, by height z, mean curvature
kappa and half the difference r of the principal curvatures kappa + r and kappa - r. At a point of an isotropic Gaussian
surface with moments m0, m2, m4 the gradient is independent of the rest, with the density 1/(2 pi m2) at zero; z and kappa are
Gaussian with variances m0 and 2 s^2 and covariance m2; r, independent of them, has Rayleigh's distribution with s^2 = m4/3.
The determinant of the second derivatives is kappa^2 - r^2. So there are, per area and per dz dkappa dr,

    1/(2 pi m2) phi(z, kappa) (r / s^2) exp(-r^2 / (2 s^2)) (kappa^2 - r^2),   0 < r < kappa,                            (1)

which integrates to m4 / (6 pi sqrt(3) m2). With q = kappa/s and t = r/kappa (0: round, 1: a ridge), an elastic summit with the
overlap w carries (4/3) E* w^(3/2) kappa^(-1/2) C_P(t) on the area pi w / kappa C_A(t). The integral over t is a function g(q)
of its own for each, and that over the height is a Gaussian mean: what remains is one integral over q.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial.chebyshev import chebinterpolate, chebval
from numpy.polynomial.legendre import leggauss

from stiction.surfaces.theory.moments import SUMMIT_DEFICIT, require_gaussian, summit_height

_ROOT_2PI = math.sqrt(2.0 * math.pi)
_DEEP = -12.0  # below, F_n is its asymptotic series to the last digit
_FAR = 39.0  # above, exp(-h^2/2) is zero to double precision
_DEGREE = 64
_REACH = 9.0  # a Gaussian is neglected this many deviations from its peak
_STEP, _NODES = 1.25, 12  # panels of 1.25 deviations, with 12 Gauss points each


# ---- F_n(h), the mean of (z - h)^n over a standard Gaussian's z > h


@cache
def _truncated_tables(n: float) -> tuple[np.ndarray, np.ndarray]:
    """Chebyshev coefficients of F_n: times exp(h^2/2) (1 + h)^(n+1) on 0..FAR, over (1 - h)^n on DEEP..0."""
    node, weight = leggauss(200)
    y = 7.0 * (1.0 + node) / 2.0  # v = y^2, up to 49
    v, measure = y * y, 7.0 * weight * y ** (2.0 * n + 1.0) / _ROOT_2PI

    def above(x):
        h = _unfold(x)[:, None]
        scale = 1.0 / (1.0 + h)  # v shrinks with growing h: integrate over v (1 + h)
        return np.sum(measure * np.exp(-0.5 * (v * scale) ** 2 - h * v * scale), axis=1)

    def below(x):
        # F = Int_0^13 (v - h)^n phi(v) dv + Int_0^-h u^n phi(u + h) du
        depth = -_DEEP / 2.0 * (1.0 - x)[:, None]
        line = (1.0 + node) / 2.0
        whole = 13.0 * line
        right = np.sum(6.5 * weight * (whole + depth) ** n * np.exp(-0.5 * whole**2), axis=1)
        u = depth * line**2
        left = np.sum(depth * weight * line * u**n * np.exp(-0.5 * (u - depth) ** 2), axis=1)
        return (right + left) / _ROOT_2PI / (1.0 + depth[:, 0]) ** n

    return chebinterpolate(above, _DEGREE), chebinterpolate(below, _DEGREE)


def _fold(h: np.ndarray, last: float = _FAR) -> np.ndarray:
    """0..last to -1..1, dense near zero: h/(h + 3), stretched."""
    return 2.0 * (last + 3.0) / last * h / (h + 3.0) - 1.0


def _unfold(x: np.ndarray, last: float = _FAR) -> np.ndarray:
    share = (x + 1.0) / 2.0 * last / (last + 3.0)
    return 3.0 * share / (1.0 - share)


def truncated_mean(n: float, h: np.ndarray) -> np.ndarray:
    """F_n(h) = Int_h^inf (z - h)^n phi(z) dz, phi the standard Gaussian; relative error below 1e-11. n >= 0, h of any shape."""
    above, below = _truncated_tables(n)
    h = np.asarray(h, dtype=float)
    value = np.zeros_like(h)
    high = (h >= 0.0) & (h < _FAR)
    x = h[high]
    value[high] = chebval(_fold(x), above) * np.exp(-0.5 * x * x) * (1.0 + x) ** (-n - 1.0)
    low = (h < 0.0) & (h >= _DEEP)
    x = h[low]
    value[low] = chebval(1.0 - 2.0 * x / _DEEP, below) * (1.0 - x) ** n
    deep = h < _DEEP
    value[deep] = _asymptotic(n, -h[deep])
    return value


def _asymptotic(n: float, depth: np.ndarray) -> np.ndarray:
    """The mean of (depth + z)^n over all z, by its moments."""
    total, term = np.ones_like(depth), np.ones_like(depth)
    for k in range(1, 12):  # binomial(n, 2k) (2k - 1)!! / depth^(2k)
        term = term * (n - 2 * k + 2) * (n - 2 * k + 1) / (2 * k) / (depth * depth)
        total = total + term
    return depth**n * total


# ---- sums over the summits


@dataclass(frozen=True, eq=False)
class Shapes:
    """What a summit of the flatness t = r / kappa carries, at Gauss points of t over 0..1; arrays (m,).

    t; weight: of the Gauss point; load: C_P(t); area: C_A(t), both 1 at t = 0.
    """

    t: np.ndarray
    weight: np.ndarray
    load: np.ndarray
    area: np.ndarray


_LARGEST_Q = 60.0


@cache
def _over_shapes(shapes: Shapes) -> tuple[np.ndarray, np.ndarray]:
    """Chebyshev coefficients, over q, of (1 + q^2) g(q): g = Int t (1 - t^2) exp(-q^2 t^2/2) C(t) dt, of load and area."""
    measure = shapes.weight * shapes.t * (1.0 - shapes.t**2)

    def tabulate(carried):
        def value(x):
            q = _unfold(x, _LARGEST_Q)[:, None]
            return np.sum(measure * carried * np.exp(-0.5 * (q * shapes.t) ** 2), axis=1) * (1.0 + q[:, 0] ** 2)

        return chebinterpolate(value, _DEGREE)

    return tabulate(shapes.load), tabulate(shapes.area)


def curve(h: np.ndarray, density: np.ndarray, shapes: Callable[[], Shapes]) -> tuple[np.ndarray, np.ndarray]:
    """Load over K R^(1/2) sigma^(3/2) and area over pi R sigma, per asperity, at separations h over sigma.

    h: (H,), from the mean of the summits; density: N R sigma (n,). Returns two arrays (n, H).
    InputError where no isotropic Gaussian surface has this density.
    """
    require_gaussian(density)
    load, area = np.empty((2, len(density), len(h)))
    for row, one in enumerate(density):
        load[row], area[row] = _one_curve(h, float(one), shapes())
    return load, area


def _one_curve(h: np.ndarray, density: float, shapes: Shapes) -> tuple[np.ndarray, np.ndarray]:
    # Lengths in sigma, heights from the mean plane. A summit of curvature q has the mean height `rise` q and deviation `rest`.
    rise = 1.0 / (32.0 * math.sqrt(math.pi) * density)  # (sqrt(3)/2) m2 / sqrt(m4)
    rest = math.sqrt(max(1.0 - (1.5 - SUMMIT_DEFICIT) / (768.0 * math.pi * density * density), 1e-12))  # m0 - (3/2) m2^2/m4
    d = h + summit_height(density)
    q, weight = _panels(d, rise, rest)
    overlap = (d[:, None] - rise * q) / rest
    g_load, g_area = (chebval(_fold(q, _LARGEST_Q), table) / (1.0 + q * q) for table in _over_shapes(shapes))
    weight = weight * np.exp(-0.25 * q * q) * q**3  # q: Gaussian of variance 2; from (1), q^4 / q in the area
    size = math.sqrt(3.0 * math.pi) / 8.0  # s R
    common = math.sqrt(3.0) / (2.0 * math.sqrt(math.pi))  # s^2 / (2 pi m2 N), and the Gaussian's own factor
    load = np.sum(weight * np.sqrt(q) * g_load * truncated_mean(1.5, overlap), axis=1)
    area = np.sum(weight * g_area * truncated_mean(1.0, overlap), axis=1)
    return common / math.sqrt(size) * rest**1.5 * load, common / size * rest * area


def _panels(d: np.ndarray, rise: float, rest: float) -> tuple[np.ndarray, np.ndarray]:
    """Gauss points and weights (H, m) over q: panels as fine as the summits' scatter, graded away from q = d / rise, where the
    mean height is the separation."""
    whole = math.hypot(rest, math.sqrt(2.0) * rise)  # sqrt(m0)
    width = math.sqrt(2.0) * rest / whole  # deviation of q at a given height
    highest = max(float(d.max()), 0.0) / whole
    last = math.sqrt(2.0) * (highest + _REACH)
    # from d/rise back to well past the largest integrand, in widths
    behind = min(highest * rest / (math.sqrt(2.0) * rise) + _REACH, last / width)
    left = -_STEP * width * np.arange(math.ceil(behind / _STEP), 0, -1)
    right, step = [0.0], _STEP * width
    while right[-1] < last:
        right.append(right[-1] + step)
        step = min(2.0 * step, _STEP)
    start = np.clip(d / rise, 0.0, last)[:, None]
    ends = np.sqrt(np.clip(start + np.concatenate([left, right]), 0.0, last))  # in sqrt(q), for the half powers at zero
    node, weight = leggauss(_NODES)
    span = np.diff(ends)[:, :, None] / 2.0
    x = ends[:, :-1, None] + span * (1.0 + node)
    return (x * x).reshape(len(d), -1), (span * weight * 2.0 * x).reshape(len(d), -1)
