"""Estimate the elastic contact area of a map without solving it, from the slopes at its points ranked by height.

These formulas are this project's own (grade B: fitted to solved maps). All start from Persson's theory (2001), A/A0 =
erf(2^(1/2) p), where A/A0 is the area fraction, p the mean pressure divided by E* h', and h' the rms gradient of the map.
Formulas (1) and (2) are implemented in surfaces.theory.widened_area, (3) and (4) here:

    G(p, c) = erf(2^(1/2) p [1 + c (1 - erf(2^(1/2) p)^(1/2))])                                                           (1)

    by moments      A = G(p, c), c = .617 - .041 ln alpha                                                                 (2)
    by top slopes   A = G(p/F(A), c), c = .672 - .071 ln alpha                                                            (3)
    by ranks        A = G(p/S(r), c) with the smallest r for which A = r/(1.195 + .312 S(r))                              (4)
                    c = .655 - .071 ln alpha + .183 ln R

alpha is Nayak's m0 m4/m2^2. R is the root of the ratio of the eigenvalues of the gradient tensor. Points are ranked from the
highest down; the rank r of a point is the fraction of points above it. F(A) is the rms gradient of the highest fraction 2A of
the points, divided by h'. S(r) is [mean of s^m over ranks below r]^(1/m) with m = .783, where s(r) is the local gradient at
rank r divided by h'. If no r up to 1 satisfies (4), S is 1.

The constants were fitted to the surfaces of the benchmark set with seeds 1 and 2 (truth.md); (2) and (3) were fitted only to
its Gaussian isotropic surfaces. Errors on the surfaces with seeds 3 and 4, in % rms (largest), for p = .002 to .3: on Gaussian
isotropic surfaces (2) 6.6 (37), (3) 3.1 (12), (4) 3.2 (13). There, 80 % of the areas by (2) and 91 % of the areas by (3) are
within 5 %. Errors of (4) on other surfaces: skewed 5.1 (18), peaked 7.4, flat 5.1, with a lay 5.1 (23), bimodal 3.8, periodic
10, worn 30 (96). At light loads (4) fails on worn plateaus with fine roughness on them.
"""

import math
from dataclasses import dataclass

import numpy as np

from stiction.solvers.boundary_elements.operators import components
from stiction.surfaces.spectrum import wave_power
from stiction.surfaces.theory.widened_area import widened

_BINS = 1024
_POWER = 0.783
_FULL = 0.995
_FIRST, _SECOND = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / 12.0, np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12.0


@dataclass(frozen=True)
class MapSlopes:
    """Store the slopes of a map that the area formulas need.

    gradient: rms gradient of the map [1]. alpha: Nayak's parameter. lay: ratio R of the largest to the smallest rms slope of
    all directions, >= 1. For the two arrays, all points are sorted from highest to lowest and divided into bins. ranks (bins,):
    fraction of all points that lie in this bin or in a higher bin. squares (bins,): mean square gradient in each bin, divided
    by the mean square gradient of the map.
    """

    gradient: float
    alpha: float
    lay: float
    ranks: np.ndarray
    squares: np.ndarray

    def top(self, share: float) -> float:
        """Return the rms gradient of the highest points, divided by the rms gradient of the map.

        share: fraction (0 to 1) of all points that are averaged, from the highest down.
        """
        counts = np.diff(self.ranks, prepend=0.0)
        return math.sqrt(float(np.interp(share, self.ranks, np.cumsum(self.squares * counts) / self.ranks)))


def map_slopes(heights: np.ndarray, size: tuple[float, float], periodic: bool = True) -> MapSlopes:
    """Measure the gradient of a map, its Nayak parameter and lay, and how the gradient varies with height.

    heights: (rows, columns) [m], finite. size: (y, x) [m]. periodic: whether gradient, Nayak parameter and lay are computed
    from the spectrum; otherwise from finite differences.
    """
    gradient, alpha, lay = _of_waves(heights, size) if periodic else _of_differences(heights, size)
    ranks, squares = _by_rank(heights, size, periodic)
    return MapSlopes(gradient, alpha, lay, ranks, squares)


def _of_waves(heights, size):
    """Return rms gradient [1], Nayak's alpha and lay ratio of a periodic map, from its spectrum.

    heights: (rows, columns) [m]. size: (y, x) [m]. Lay ratio: ratio of the largest to the smallest rms slope of all directions.
    """
    along_y, along_x = components(heights.shape, size)
    power = wave_power(heights - heights.mean()) / float(heights.size) ** 2
    xx, yy = float(np.sum(power * along_x**2)), float(np.sum(power * along_y**2))
    xy = float(np.sum(power * along_y * along_x))
    laplacian = float(np.sum(power * (along_x**2 + along_y**2) ** 2))
    return math.sqrt(xx + yy), 1.5 * float(power.sum()) * laplacian / (xx + yy) ** 2, _lay(xx, yy, xy)


def _of_differences(heights, size):
    """Return rms gradient [1], Nayak's alpha and lay ratio of a map that is not periodic, from finite differences.

    heights: (rows, columns) [m]. size: (y, x) [m]. The lay ratio is the ratio of the largest to the smallest rms slope of all
    directions. The differences are of fourth order. Mean square slopes are evaluated between points; heights, curvatures and
    the product of the two slopes at points.
    """
    pitch = size[0] / heights.shape[0], size[1] / heights.shape[1]
    yy, xx = (float(np.mean(np.square(_between(np.moveaxis(heights, axis, 0), pitch[axis])))) for axis in (0, 1))
    inner = (slice(2, -2), slice(2, -2))
    slope_y, slope_x = (np.moveaxis(_at_points(np.moveaxis(heights, axis, 0), pitch[axis], _FIRST), 0, axis) for axis in (0, 1))
    xy = float(np.mean(slope_y[:, 2:-2] * slope_x[2:-2, :]))
    bend_y, bend_x = (
        np.moveaxis(_at_points(np.moveaxis(heights, axis, 0), pitch[axis] ** 2, _SECOND), 0, axis) for axis in (0, 1)
    )
    laplacian = float(np.mean(np.square(bend_y[:, 2:-2] + bend_x[2:-2, :])))
    return math.sqrt(xx + yy), 1.5 * float(np.var(heights[inner])) * laplacian / (xx + yy) ** 2, _lay(xx, yy, xy)


def _between(rows, pitch):
    """Return the derivative of an array (n, ...) along its first axis, midway between neighbouring points.

    pitch: point spacing. The formula is of fourth order; the result has n - 3 rows.
    """
    return (27.0 * (rows[2:-1] - rows[1:-2]) - (rows[3:] - rows[:-3])) / (24.0 * pitch)


def _at_points(rows, unit, weights):
    """Return a derivative of an array (n, ...) along its first axis, at all points but the two outermost at each end.

    unit: point spacing to the power of the derivative's order. weights: finite-difference weights of five neighbouring points.
    """
    count = len(rows) - 4
    return sum(weight * rows[first : first + count] for first, weight in enumerate(weights)) / unit


def _lay(xx, yy, xy):
    mean, root = 0.5 * (xx + yy), math.hypot(0.5 * (xx - yy), xy)
    return math.sqrt((mean + root) / max(mean - root, 1e-12 * mean))


def _by_rank(heights, size, periodic):
    """Return the mean square gradient of points of about equal height, from the highest to the lowest: two arrays (bins,).

    heights: (rows, columns) [m]. size: (y, x) [m]. periodic: whether opposite edges are neighbours. All points are sorted from
    highest to lowest and divided into bins. The first array is the fraction of all points that lie in this bin or in a higher
    bin. The second is the mean square gradient in each bin, divided by its mean over the map.
    """
    square = np.zeros(heights.shape)
    for axis, length in enumerate(size):
        step = np.square((np.roll(heights, -1, axis) - heights) * (heights.shape[axis] / length))
        if not periodic:  # the last point has no neighbour, so the step before it is used
            ends = np.moveaxis(step, axis, 0)
            ends[-1] = ends[-2]
        square += 0.5 * (step + np.roll(step, 1, axis))
    order = np.argsort(heights, axis=None)[::-1]
    ends = np.unique(np.linspace(0, heights.size, min(_BINS, heights.size // 16) + 1).astype(int))[1:]
    sums = np.diff(np.concatenate([[0.0], np.cumsum(square.ravel()[order])[ends - 1]]))
    counts = np.diff(np.concatenate([[0], ends]))
    return ends / heights.size, sums / counts / float(square.mean())


def by_top_slopes(pressure: float, slopes: MapSlopes) -> float:
    """Estimate the area fraction A/A0 of a Gaussian isotropic map from the gradient of its highest points.

    This is formula (3) of this module. A/A0: ratio of real to nominal contact area. pressure: mean pressure, > 0, divided by
    E* h', with the contact modulus E* and the rms gradient h'. slopes: measured by `map_slopes`.
    """
    c = 0.672 - 0.071 * math.log(slopes.alpha)
    ratio = np.sqrt(np.cumsum(slopes.squares) / np.arange(1, len(slopes.squares) + 1))
    reach = np.minimum(0.5 * slopes.ranks, 1.0)
    return first_crossing(reach, widened(pressure / ratio, c), beyond=float(widened(pressure, c)))


def by_ranks(pressure: float, slopes: MapSlopes) -> float:
    """Estimate the area fraction A/A0 of any map from the gradients of its points ranked by height.

    This is formula (4) of this module. A/A0: ratio of real to nominal contact area. pressure: mean pressure, > 0, divided by
    E* h', with the contact modulus E* and the rms gradient h'. slopes: measured by `map_slopes`.
    """
    c = 0.655 - 0.071 * math.log(slopes.alpha) + 0.183 * math.log(slopes.lay)
    count = np.arange(1, len(slopes.squares) + 1)
    mean = (np.cumsum(slopes.squares ** (0.5 * _POWER)) / count) ** (1.0 / _POWER)
    area = slopes.ranks / (1.195 + 0.312 * mean)
    beyond = min(float(widened(pressure, c)), _FULL)
    return first_crossing(area, widened(pressure / mean, c), beyond)


def first_crossing(area, wanted, beyond):
    """Return the value of `area` where it first reaches `wanted`, interpolated linearly between elements.

    area, wanted: (n,), compared element by element. beyond: the value returned if `area` never reaches `wanted`. If the first
    element of `area` reaches it, `wanted[0]` is returned.
    """
    reached = np.flatnonzero(area >= wanted)
    if not len(reached):
        return beyond
    last = int(reached[0])
    if last == 0:
        return float(wanted[0])
    before, after = wanted[last - 1] - area[last - 1], area[last] - wanted[last]
    return float(area[last - 1] + (area[last] - area[last - 1]) * before / (before + after))
