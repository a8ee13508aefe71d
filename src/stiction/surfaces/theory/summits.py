"""Sum load and contact area over the summits of an isotropic Gaussian surface, by Nayak's joint density of their properties.

A summit is a point of zero slope that curves down in all directions. Nayak (1971) gives the number of summits by height z, mean
curvature kappa and half the difference r of the principal curvatures kappa + r and kappa - r. At a point of an isotropic
Gaussian surface with moments m0, m2, m4 the gradient is independent of heights and second derivatives and has the density 1/(2
pi m2) at zero. z and kappa are Gaussian with variances m0 and 2 s^2 and covariance m2. r is independent of z and kappa and has
Rayleigh's distribution with s^2 = m4/3. The determinant of the second derivatives is kappa^2 - r^2. The number of summits per
area and per dz dkappa dr is therefore

    1/(2 pi m2) phi(z, kappa) (r / s^2) exp(-r^2 / (2 s^2)) (kappa^2 - r^2),   0 < r < kappa,                            (1)

which integrates to m4 / (6 pi sqrt(3) m2). With q = kappa/s and t = r/kappa (0 for a round summit, 1 for a ridge), an elastic
summit with the overlap w carries the load (4/3) E* w^(3/2) kappa^(-1/2) C_P(t) on the area pi w / kappa C_A(t). For load and
area each, the integral over t is a function g(q), and the integral over z is a Gaussian mean. One integral over q remains.

F_n(h) is the integral of (z - h)^n phi(z) over z > h, with the standard Gaussian density phi.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial.chebyshev import chebinterpolate, chebval
from numpy.polynomial.legendre import leggauss

from stiction.engine.compiled import formula, kernel
from stiction.engine.vectorised import exponential
from stiction.surfaces.theory.moments import SUMMIT_DEFICIT, require_gaussian, summit_height

_ROOT_2PI = math.sqrt(2.0 * math.pi)
_DEEP = -12.0  # for smaller h, F_n(h) equals its asymptotic series to the last digit
_FAR = 39.0  # for larger h, exp(-h^2/2) is zero in double precision
_DEGREE = 64
_REACH = 9.0  # standard deviations from its peak beyond which a Gaussian is neglected
_STEP, _NODES = 1.25, 12  # panels of 1.25 deviations, with 12 Gauss points each
_MOST_PANELS = 200


# ---- F_n(h), the integral of (z - h)^n phi(z) over z > h


@cache
def _truncated_tables(n: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the Chebyshev coefficients of F_n(h) (see `truncated_mean`) in two ranges of h, above and below 0.

    On 0 to 39 the series represents F_n exp(h^2/2) (1 + h)^(n+1), on -12 to 0 it represents F_n / (1 - h)^n.
    """
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


def _fold(h, last):
    """Map h in 0..last to -1..1 by 2 (last + 3)/last h/(h + 3) - 1, so that interpolation points are dense near h = 0."""
    return 2.0 * (last + 3.0) / last * h / (h + 3.0) - 1.0


_fold_one = formula(_fold)  # for a single number, inside kernels


def _unfold(x: np.ndarray, last: float = _FAR) -> np.ndarray:
    share = (x + 1.0) / 2.0 * last / (last + 3.0)
    return 3.0 * share / (1.0 - share)


def truncated_mean(n: float, h: np.ndarray) -> np.ndarray:
    """Return F_n(h), the integral of (z - h)^n phi(z) over z from h to infinity.

    phi is the standard Gaussian density. n >= 0; h: array of any shape. The relative error is below 1e-11.
    """
    above, below = _truncated_tables(n)
    h = np.asarray(h, dtype=float)
    value = np.zeros_like(h)
    high = (h >= 0.0) & (h < _FAR)
    x = h[high]
    value[high] = chebval(_fold(x, _FAR), above) * np.exp(-0.5 * x * x) * (1.0 + x) ** (-n - 1.0)
    low = (h < 0.0) & (h >= _DEEP)
    x = h[low]
    value[low] = chebval(1.0 - 2.0 * x / _DEEP, below) * (1.0 - x) ** n
    deep = h < _DEEP
    value[deep] = _asymptotic(n, -h[deep])
    return value


def _asymptotic(n, depth):
    """Return F_n(-depth) (see the module) to the last digit, for a depth above 12, from its asymptotic series."""
    total = term = 1.0
    for k in range(1, 12):  # binomial(n, 2k) (2k - 1)!! / depth^(2k)
        term = term * (n - 2 * k + 2) * (n - 2 * k + 1) / (2 * k) / (depth * depth)
        total = total + term
    return depth**n * total


_asymptotic_one = formula(_asymptotic)

# ---- sums over the summits


@dataclass(frozen=True, eq=False)
class Shapes:
    """Store load and area factors of an elliptic summit at the Gauss points of its shape t; all arrays are (m,).

    - t: half the difference of the principal curvatures divided by their mean: 0 for a round summit, 1 for a ridge
    - weight: weight of each Gauss point
    - load, area: factors C_P(t) and C_A(t): load and contact area relative to a round summit at the same overlap
    """

    t: np.ndarray
    weight: np.ndarray
    load: np.ndarray
    area: np.ndarray


_LARGEST_Q = 60.0


@cache
def _over_shapes(shapes: Shapes) -> tuple[np.ndarray, np.ndarray]:
    """Return the Chebyshev coefficients of (1 + q^2) g(q), for the load and for the area.

    q is the mean curvature of a summit divided by s, as in the module docstring. g(q) = Int_0^1 t (1 - t^2) exp(-q^2 t^2 / 2)
    C(t) dt is the integral over the shapes t of the summits (not normalised), with C the load factor or the area factor in
    `shapes`.
    """
    measure = shapes.weight * shapes.t * (1.0 - shapes.t**2)

    def tabulate(carried):
        def value(x):
            q = _unfold(x, _LARGEST_Q)[:, None]
            return np.sum(measure * carried * np.exp(-0.5 * (q * shapes.t) ** 2), axis=1) * (1.0 + q[:, 0] ** 2)

        return chebinterpolate(value, _DEGREE)

    return tabulate(shapes.load), tabulate(shapes.area)


def curve(h: np.ndarray, density: np.ndarray, shapes: Callable[[], Shapes]) -> tuple[np.ndarray, np.ndarray]:
    """Return load and contact area per asperity, (n, H) each, of elastic Gaussian surfaces in contact with a plane.

    The load is divided by K R^(1/2) sigma^(3/2), the area by pi R sigma. h: separation from the mean of the summits divided
    by sigma, (H,) for all surfaces or (n, H). density: N R sigma (n,) of the surfaces. shapes: function that returns the load
    and area factors of a summit. Raises InputError if no isotropic Gaussian surface has this density.
    """
    require_gaussian(density)
    # Lengths in sigma, heights from the mean plane. A summit of curvature q has the mean height `rise` q and deviation `rest`.
    rise = 1.0 / (32.0 * math.sqrt(math.pi) * density)  # (sqrt(3)/2) m2 / sqrt(m4)
    variance = 1.0 - (1.5 - SUMMIT_DEFICIT) / (768.0 * math.pi * density * density)  # m0 - (3/2) m2^2/m4
    rest = np.sqrt(np.maximum(variance, 1e-12))
    d = np.ascontiguousarray(h + summit_height(density)[:, None])
    shared = h.ndim == 1 and h.size > 1  # the panels then reach equally far for all separations
    farthest = np.repeat(d.max(axis=1, keepdims=True), h.size, axis=1) if shared else d
    load, area = np.empty((2, *d.shape))
    series = np.stack(_over_shapes(shapes())), *_tables_of_means()
    _fill_curves((d, farthest), (rise, rest), series, _gauss(), (load, area))
    size = math.sqrt(3.0 * math.pi) / 8.0  # s R
    common = math.sqrt(3.0) / (2.0 * math.sqrt(math.pi))  # s^2 / (2 pi m2 N) times the factor of the Gaussian
    rest = rest[:, None]
    return common / math.sqrt(size) * rest**1.5 * load, common / size * rest * area


@cache
def _tables_of_means() -> tuple[np.ndarray, np.ndarray]:
    """Return the Chebyshev coefficients of F_3/2(h) and F_1(h), (2, terms) each for h >= 0 and for h < 0."""
    above, below = zip(_truncated_tables(1.5), _truncated_tables(1.0), strict=True)
    return np.stack(above), np.stack(below)


@cache
def _gauss() -> tuple[np.ndarray, np.ndarray]:
    node, weight = leggauss(_NODES)
    return node, weight


@kernel
def _fill_curves(separations, spread, series, gauss, sums):
    """Write the integrals over the summit curvature q for load and area into the two arrays `sums`, (n, H) each.

    - separations: two arrays (n, H) in units of sigma: d, the separation from the mean plane, and the separation that sets the
      range of integration (the largest d of each surface if all surfaces share their separations, else d)
    - spread: mean height of a summit of curvature q, divided by q, and standard deviation of the summit height at fixed q, (n,)
      each
    - series: Chebyshev coefficients of the integrals over the shape, and of the truncated means for h >= 0 and h < 0
    - gauss: nodes and weights of a Gauss rule
    """
    (d, farthest), (rise, rest), (node, weight), (load, area) = separations, spread, gauss, sums
    shapes, above, below = series
    most = _MOST_PANELS * node.size
    q, measure, x, overlap, work = np.empty(most), np.empty(most), np.empty(most), np.empty(most), np.empty((2, 2, most))
    shape, mean = np.empty((2, most)), np.empty((2, most))
    ends = np.empty(_MOST_PANELS + 1)
    for i in range(d.shape[0]):
        for at in range(d.shape[1]):
            count = node.size * _put_panels(d[i, at], farthest[i, at], rise[i], rest[i], ends)
            for k in range(count):
                first, last = ends[k // node.size], ends[k // node.size + 1]
                root = first + (last - first) / 2.0 * (1.0 + node[k % node.size])
                q[k] = root * root
                measure[k] = (last - first) * weight[k % node.size] * root * q[k] ** 3  # from (1), q^4 / q in the area
                x[k] = _fold_one(q[k], _LARGEST_Q)
                overlap[k] = (d[i, at] - rise[i] * q[k]) / rest[i]
            _add_series(x, 0, count, shapes, work, shape)
            _put_means(overlap, count, above, below, x, work, mean)
            total = cover = 0.0
            for k in range(count):  # q: Gaussian of variance 2
                part = measure[k] * exponential(-0.25 * q[k] * q[k]) / (1.0 + q[k] * q[k])
                total += part * math.sqrt(q[k]) * shape[0, k] * mean[0, k]
                cover += part * shape[1, k] * mean[1, k]
            load[i, at], area[i, at] = total, cover


@kernel
def _add_series(x, first, last, coefficients, work, out):
    """Write two Chebyshev series at the points x[k], first <= k < last, into the array `out` (2, points).

    coefficients: (2, terms). work: scratch array. Clenshaw's recurrence sums the series.
    """
    for f in range(coefficients.shape[0]):
        one, two, series = work[f, 0], work[f, 1], coefficients[f]
        one[first:last] = 0.0
        two[first:last] = 0.0
        for term in range(series.size - 1, 1, -2):
            a, b = series[term], series[term - 1]
            for k in range(first, last):
                two[k] = a + 2.0 * x[k] * one[k] - two[k]
                one[k] = b + 2.0 * x[k] * two[k] - one[k]
        for k in range(first, last):
            out[f, k] = series[0] + x[k] * one[k] - two[k]


@kernel
def _put_means(h, count, above, below, x, work, mean):
    """Write F_3/2(h[k]) into mean[0, k] and F_1(h[k]) into mean[1, k] for k < count; h descends.

    F_n: see `truncated_mean`. above, below: Chebyshev coefficients for h >= 0 and h < 0. x, work: scratch arrays.
    """
    high = 0
    while high < count and h[high] >= _FAR:
        high += 1
    low = high
    while low < count and h[low] >= 0.0:
        low += 1
    deep = low
    while deep < count and h[deep] >= _DEEP:
        deep += 1
    mean[:, :high] = 0.0
    for k in range(high, low):
        x[k] = _fold_one(h[k], _FAR)
    _add_series(x, high, low, above, work, mean)
    for k in range(high, low):
        square = 1.0 / ((1.0 + h[k]) * (1.0 + h[k]))
        falls = exponential(-0.5 * h[k] * h[k]) * square
        mean[0, k] *= falls * math.sqrt(math.sqrt(square))
        mean[1, k] *= falls
    for k in range(low, deep):
        x[k] = 1.0 - 2.0 * h[k] / _DEEP
    _add_series(x, low, deep, below, work, mean)
    for k in range(low, deep):
        mean[0, k] *= (1.0 - h[k]) * math.sqrt(1.0 - h[k])
        mean[1, k] *= 1.0 - h[k]
    for k in range(deep, count):
        mean[0, k], mean[1, k] = _asymptotic_one(1.5, -h[k]), _asymptotic_one(1.0, -h[k])


@kernel
def _put_panels(d, farthest, rise, rest, ends):
    """Write the boundaries of the integration panels in sqrt(q) into `ends`, and return the number of panels.

    q: dimensionless summit curvature. d: separation from the mean plane. farthest: largest separation, which sets the end of
    the range. rise: mean height of a summit of curvature q, divided by q. rest: standard deviation of summit heights at fixed
    q. Panels have equal widths in q up to q = d / rise, where the mean summit height equals the separation; beyond it they
    usually widen.
    """
    whole = math.sqrt(rest * rest + 2.0 * rise * rise)  # sqrt(m0)
    width = math.sqrt(2.0) * rest / whole  # deviation of q at a given height
    highest = max(farthest, 0.0) / whole
    if d > _FAR * whole:
        return 0
    last = math.sqrt(2.0) * (highest + _REACH)
    # Distance, in widths, from q = d/rise back to well beyond the largest integrand.
    behind = min(highest * rest / (math.sqrt(2.0) * rise) + _REACH, last / width)
    start = min(max(d / rise, 0.0), last)
    back, ahead, step, count = math.ceil(behind / _STEP), 0.0, _STEP * width, 0
    ends[0] = math.sqrt(max(start - back * step, 0.0))
    while count < ends.size - 1 and ends[count] < math.sqrt(last):
        if back > 0:
            back -= 1
            end = start - back * _STEP * width
        else:
            ahead += step
            end = start + ahead
            step = min(2.0 * step, _STEP)
        if end > 0.0:
            count += 1
            ends[count] = math.sqrt(min(end, last))
    return count
