"""Elastic contact area of a map without its solution: from its slopes, or from the solution of some of its points.

This project's own formulas, grade B: their evidence is solved maps. All begin with Persson's theory (2001),
A/A0 = erf(2^(1/2) p), p: mean pressure over E* h', h' the rms gradient of the map, and widen it:

    G(p, c) = erf(2^(1/2) p [1 + c (1 - erf(2^(1/2) p)^(1/2))])                                                           (1)

    by moments      A = G(p, c), c = .601 - .066 ln alpha                                                                 (2)
    by top slopes   A = G(p/F(A), c), c = .562 - .043 ln alpha                                                            (3)
    by ranks        A = G(p/S(r), c) with A = r/(.966 + .604 S(r)), the first such r                                      (4)
                    c = .497 - .031 ln alpha + .163 ln R

alpha: Nayak's m0 m4/m2^2; R: root of the ratio of the eigenvalues of the gradient tensor; points are ranked from the highest,
r is the share of points above. F(A): rms gradient of the highest 2A of the map over that of all of it. S(r): of the local
gradient s(r) at rank r over h', [mean over ranks below r of s^m]^(1/m), m = 1.207; past r = 1 it stays 1.

Against 54 solved maps of 256^2 points, 8 in the shortest wave, p = .002 to .3, error in %, rms (largest): Gaussian (2) 4 (18),
(3) 5 (15), (4) 7 (19); skewed by exp(z) upwards (4) 7, downwards (4) 2 to 5, (3) 13 to 23; tanh (4) 3; worn flat to .02 of
the roughness (4) 8 (15), cut and rough again (4) 53 (89); lay of 3 (4) 6 (14). Constants are those of a fit to areas about 2 %
lower at light loads (another correction for pixels), which is part of these errors.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.fft import rfft2
from scipy.special import erf

from stiction.surfaces.boundary_elements.operators import components

__all__ = ["MapSlopes", "by_moments", "by_ranks", "by_top_slopes", "map_slopes", "widened", "width_by_moments"]

_BINS = 1024
_POWER = 1.207
_FULL = 0.995


@dataclass(frozen=True)
class MapSlopes:
    """What the formulas need of a map. gradient: rms, of all waves [1]; alpha: Nayak's; lay: R, >= 1; ranks: upper ends of
    bins of points from the highest, as shares; squares: mean square gradient of the points of each bin, over that of all."""

    gradient: float
    alpha: float
    lay: float
    ranks: np.ndarray
    squares: np.ndarray


def map_slopes(heights: np.ndarray, size: tuple[float, float]) -> MapSlopes:
    """Of a periodic map; heights: (rows, columns) [m], finite; size: (y, x) [m]."""
    along_y, along_x = components(heights.shape, size)
    power = np.square(np.abs(rfft2(heights - heights.mean())))
    power[:, 1 : (heights.shape[1] + 1) // 2] *= 2.0
    power /= float(heights.size) ** 2
    xx, yy = float(np.sum(power * along_x**2)), float(np.sum(power * along_y**2))
    half = rfft2(heights)
    xy = _mixed(half, along_y, along_x, heights.shape[1], heights.size)
    root = math.hypot(0.5 * (xx - yy), xy)
    mean = 0.5 * (xx + yy)
    laplacian = float(np.sum(power * (along_x**2 + along_y**2) ** 2))
    alpha = 1.5 * float(power.sum()) * laplacian / (xx + yy) ** 2
    lay = math.sqrt((mean + root) / max(mean - root, 1e-12 * mean))
    ranks, squares = _by_rank(heights, size)
    return MapSlopes(math.sqrt(xx + yy), alpha, lay, ranks, squares)


def _mixed(waves, along_y, along_x, columns, points):
    """<h_x h_y>: waves on both sides of k_x = 0 are in the half transform, so that the product is summed with its sign."""
    weight = np.full(waves.shape[1], 2.0)
    weight[0] = 1.0
    if columns % 2 == 0:
        weight[-1] = 1.0
    return float(np.sum(np.square(np.abs(waves)) * along_y * along_x * weight)) / float(points) ** 2


def _by_rank(heights, size):
    """Upper ends of the bins, and their mean square gradients over that of all points."""
    square = np.zeros(heights.shape)
    for axis, length in enumerate(size):
        step = np.square((np.roll(heights, -1, axis) - heights) * (heights.shape[axis] / length))
        square += 0.5 * (step + np.roll(step, 1, axis))
    order = np.argsort(heights, axis=None)[::-1]
    ends = np.unique(np.linspace(0, heights.size, min(_BINS, heights.size // 16) + 1).astype(int))[1:]
    sums = np.diff(np.concatenate([[0.0], np.cumsum(square.ravel()[order])[ends - 1]]))
    counts = np.diff(np.concatenate([[0], ends]))
    return ends / heights.size, sums / counts / float(square.mean())


def widened(pressure, c):
    """(1); pressure: over E* h', of the local slope."""
    plain = erf(math.sqrt(2.0) * pressure)
    return erf(math.sqrt(2.0) * pressure * (1.0 + c * (1.0 - np.sqrt(plain))))


def by_moments(pressure: float, slopes: MapSlopes) -> float:
    """(2): share of the area in contact; pressure: mean, over E* h', > 0. Gaussian isotropic surfaces."""
    return float(widened(pressure, width_by_moments(slopes.alpha)))


def width_by_moments(alpha):
    """c of (2)."""
    return 0.601 - 0.066 * np.log(alpha)


def by_top_slopes(pressure: float, slopes: MapSlopes) -> float:
    """(3): as `by_moments`, with the slopes where contact is; Gaussian isotropic maps."""
    c = 0.562 - 0.043 * math.log(slopes.alpha)
    ratio = np.sqrt(np.cumsum(slopes.squares) / np.arange(1, len(slopes.squares) + 1))
    reach = np.minimum(0.5 * slopes.ranks, 1.0)
    return _first_crossing(reach, widened(pressure / ratio, c), beyond=float(widened(pressure, c)))


def by_ranks(pressure: float, slopes: MapSlopes) -> float:
    """(4): share of the area in contact; pressure: mean, over E* h', > 0. Also skewed, worn and anisotropic maps."""
    c = 0.497 - 0.031 * math.log(slopes.alpha) + 0.163 * math.log(slopes.lay)
    count = np.arange(1, len(slopes.squares) + 1)
    mean = (np.cumsum(slopes.squares ** (0.5 * _POWER)) / count) ** (1.0 / _POWER)
    area = slopes.ranks / (0.966 + 0.604 * mean)
    beyond = min(float(widened(pressure, c)), _FULL)
    return _first_crossing(area, widened(pressure / mean, c), beyond)


def _first_crossing(area, wanted, beyond):
    """Where the area first reaches what is wanted of it, between two bins by a straight line; `beyond` if it nowhere does."""
    reached = np.flatnonzero(area >= wanted)
    if not len(reached):
        return beyond
    last = int(reached[0])
    if last == 0:
        return float(wanted[0])
    before, after = wanted[last - 1] - area[last - 1], area[last] - wanted[last]
    return float(area[last - 1] + (area[last] - area[last - 1]) * before / (before + after))
