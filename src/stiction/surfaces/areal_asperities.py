"""Asperities of a map: points higher than their eight neighbours, and summits that stand out by a threshold.

The curvature of a summit is that of the paraboloid z = a + b x + c y + d x^2 + e x y + f y^2 that fits the points around it
best (least squares), half the sum of its two principal curvatures: -(d + f). On a grid this is a weighted sum of the heights.
What a grid sees depends on its pitch (Greenwood 1984): where waves are short of points, summits are missed and those found are
too low and too blunt. Fitting more points, or a threshold, trades one bias for another; docs/surfaces.md has their sizes.
"""

from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
from scipy.ndimage import minimum_filter

from stiction.quantities.errors import InputError
from stiction.surfaces.asperity_set import Asperities, of_samples, over_mean_plane, rounding
from stiction.surfaces.heightmap import HeightMap, in_metres
from stiction.surfaces.persistence import persistent_maxima

# ISO 25178-3's default for pruning the tree of hills and dales, which it gives as a share of the maximum height Sz.
PRUNING = 0.05


def eight_neighbour(surface: HeightMap, fit_points: int = 9) -> Asperities:
    """Points higher than all eight neighbours.

    fit_points: 5, 9, 25 or 49, of the fitted paraboloid (5: along the two axes only). Neighbours must be lower, not equal:
    plateaus are not counted. Summits whose fitted points are not all on the map and known are left out, also of the area.
    InputError for a profile or if fewer than two summits are found.
    """
    heights = _areal(surface)
    middle = heights[1:-1, 1:-1]
    top = np.ones(middle.shape, dtype=bool)
    rows, columns = heights.shape
    middle = middle - rounding(heights)
    for i, j in product(range(3), range(3)):
        if (i, j) != (1, 1):
            top &= middle > heights[i : rows - 2 + i, j : columns - 2 + j]  # never beside NaN
    row, column = np.nonzero(top)
    return _fitted(
        "eight_neighbour",
        surface,
        heights,
        row + 1,
        column + 1,
        fit_points,
        f"summits higher than all eight neighbours; paraboloid through {fit_points} points",
    )


def persistence(surface: HeightMap, threshold: Any = None, fit_points: int = 25) -> Asperities:
    """Summits that stand out: from each one has to go down by more than the threshold before a higher one can be reached.

    threshold: [m] >= 0 or text with a unit, by default PRUNING times the largest difference in height. A hill that stands out
    by less is part of the higher one behind its saddle, as in ISO 25178-2's segmentation with Wolf pruning. A plateau is one
    summit. fit_points, and what is left out: as of `eight_neighbour`. InputError for a profile, a bad threshold, or fewer than
    two summits.
    """
    heights = _areal(surface)
    if threshold is None:
        threshold = PRUNING * float(np.nanmax(heights) - np.nanmin(heights))
    threshold = in_metres(threshold, "threshold")
    if not 0.0 <= threshold < np.inf:
        raise InputError("threshold", threshold, ">= 0 m")
    row, column = np.unravel_index(persistent_maxima(heights, threshold), heights.shape)
    return _fitted(
        "persistence",
        surface,
        heights,
        row,
        column,
        fit_points,
        f"summits that stand out by more than {threshold:.4g} m; paraboloid through {fit_points} points",
        remedy=f"a threshold below {threshold:.4g} m, finer points or a larger map",
    )


def _areal(surface: HeightMap) -> np.ndarray:
    if min(surface.heights.shape) < 3:
        shape = f"shape {surface.heights.shape}"
        raise InputError("heights", shape, "a map of 3 or more rows and columns: a profile has no summits")
    return over_mean_plane(surface)


def _fitted(method, surface, heights, row, column, fit_points, note, **more) -> Asperities:
    """The summits at (row, column) whose fitted points are there, with their curvatures, per area where they could be."""
    if fit_points not in FITS:
        raise InputError("fit_points", fit_points, ", ".join(map(str, FITS)))
    dy, dx = surface.pitch
    stencil = FITS[fit_points](dy, dx)
    reach = len(stencil) // 2
    whole = _whole_windows(heights, reach, surface.complete)
    kept = whole[row, column]
    row, column = row[kept], column[kept]
    curvatures = np.zeros(len(row))
    for i, j in zip(*np.nonzero(stencil), strict=True):
        curvatures += stencil[i, j] * heights[row + i - reach, column + j - reach]
    area = max(np.count_nonzero(whole), 1) * dy * dx
    return of_samples(method, heights[row, column], curvatures, len(row) / area, note, **more)


def _whole_windows(heights: np.ndarray, reach: int, complete: bool) -> np.ndarray:
    """Where the square of points up to `reach` away is on the map and known; booleans like the heights."""
    known = np.ones(heights.shape, dtype=bool) if complete else np.isfinite(heights)
    if complete:
        for border in (known, known.T):
            border[:reach] = border[-reach:] = False
        return known
    return minimum_filter(known, size=2 * reach + 1, mode="constant", cval=0)


def _square(reach: int) -> Callable[[float, float], np.ndarray]:
    """Weights of the least-squares paraboloid over the (2 reach + 1)^2 points around.

    x^2 less its mean is orthogonal to every other term but a, to which it adds nothing: so d = sum(w z) / sum(w^2) with it.
    """

    def weights(dy: float, dx: float) -> np.ndarray:
        offset = np.arange(-reach, reach + 1.0)
        apart = np.broadcast_to(offset**2 - np.mean(offset**2), (len(offset), len(offset)))
        return -(apart / (dx * dx) + apart.T / (dy * dy)) / np.sum(apart**2)

    return weights


def _cross(dy: float, dx: float) -> np.ndarray:
    """Weights of the paraboloid through a point and its four nearest neighbours."""
    along = np.array([[0.0, 0.0, 0.0], [1.0, -2.0, 1.0], [0.0, 0.0, 0.0]]) / 2.0
    return -(along / (dx * dx) + along.T / (dy * dy))


# Mean curvature [1/m] as a sum over heights [m], by the number of points: a function of the pitch (dy, dx) [m].
FITS: dict[int, Callable[[float, float], np.ndarray]] = {5: _cross, 9: _square(1), 25: _square(2), 49: _square(3)}
