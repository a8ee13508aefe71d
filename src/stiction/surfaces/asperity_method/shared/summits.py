"""Compute the curvature of the summits of a map from fitted paraboloids, and their number per area.

The curvature of a summit is computed from the paraboloid z = a + b x + c y + d x^2 + e x y + f y^2 that fits the points around
it best (least squares): half the sum of its two principal curvatures, -(d + f). On a grid this is a weighted sum of the
heights. The result depends on the pitch, the point spacing (Greenwood 1984): where waves are sampled by too few points, some
summits are missed, and the others appear too low and too blunt. Fitting more points, or a threshold, trades one bias for
another (docs/how-to/which-asperity-method.md).
"""

from collections.abc import Callable

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.asperity_set import Asperities, of_samples, over_mean_plane
from stiction.surfaces.heightmap import HeightMap


def areal(surface: HeightMap) -> np.ndarray:
    """Return the heights (rows, columns) [m] of a map above its mean plane.

    Raises InputError if the map has fewer than three rows or columns.
    """
    if min(surface.heights.shape) < 3:
        shape = InWords(f"shape {surface.heights.shape}")
        raise InputError("heights", shape, "a map of 3 or more rows and columns: a profile has no summits")
    return over_mean_plane(surface)


def fitted(
    method: str, surface: HeightMap, heights: np.ndarray, tops: tuple[np.ndarray, ...], fit_points: int, note: str, **more
) -> Asperities:
    """Return the Asperities object for summits at given points of a map, with the curvatures of fitted paraboloids.

    - method: key of the asperity method; note, more: arguments of `asperity_set.of_samples`
    - heights: (rows, columns) [m] above the mean plane
    - tops: (row numbers, column numbers) of the summits, (n,) each
    - fit_points: number of points of the fitted paraboloid, a key of FITS

    A summit counts only if all its fitted points have heights. The density is the number of summits divided by the area of the
    positions where this holds. Raises InputError as `asperity_set.of_samples` does.
    """
    row, column = tops
    dy, dx = surface.pitch
    stencil = FITS[fit_points](dy, dx)
    reach = len(stencil) // 2
    whole = _whole_windows(heights, reach, surface.complete)
    kept = whole[row, column]
    row, column = row[kept], column[kept]
    curvatures = np.zeros(len(row))
    for i, j in zip(*np.nonzero(stencil), strict=True):
        curvatures += stencil[i, j] * heights[row + i - reach, column + j - reach]
    area = max(int(np.count_nonzero(whole)), 1) * dy * dx
    places = np.column_stack((row, column))
    return of_samples(method, heights[row, column], curvatures, len(row) / area, note, places=places, **more)


def _whole_windows(heights: np.ndarray, reach: int, complete: bool) -> np.ndarray:
    """Return a mask (rows, columns) of the points whose surrounding square lies on the map and has no missing point.

    heights: (rows, columns). reach: number of points from the middle of the square to each side. complete: whether no point of
    the map is missing.
    """
    known = np.ones(heights.shape, dtype=bool) if complete else np.isfinite(heights)
    if complete:
        for border in (known, known.T):
            border[:reach] = border[-reach:] = False
        return known
    from scipy.ndimage import minimum_filter  # slow to import

    return minimum_filter(known, size=2 * reach + 1, mode="constant", cval=0)


def _square(reach: int) -> Callable[[float, float], np.ndarray]:
    """Return a function of the pitch (dy, dx) [m] that computes the weights of the heights in the curvature of a summit.

    The least-squares paraboloid is fitted to a square of (2 reach + 1)^2 points. The function w, x^2 minus its mean, is
    orthogonal to all terms of the paraboloid except d x^2. The coefficient is therefore d = sum(w z) / sum(w^2) with the
    heights z.
    """

    def weights(dy: float, dx: float) -> np.ndarray:
        offset = np.arange(-reach, reach + 1.0)
        apart = np.broadcast_to(offset**2 - np.mean(offset**2), (len(offset), len(offset)))
        return -(apart / (dx * dx) + apart.T / (dy * dy)) / np.sum(apart**2)

    return weights


def _cross(dy: float, dx: float) -> np.ndarray:
    """Return the weights (3, 3) [1/m^2] of heights in the curvature of the paraboloid through a point and four neighbours.

    dy, dx: pitch [m] along y and x.
    """
    along = np.array([[0.0, 0.0, 0.0], [1.0, -2.0, 1.0], [0.0, 0.0, 0.0]]) / 2.0
    return -(along / (dx * dx) + along.T / (dy * dy))


# Number of fitted points -> function of the pitch (dy, dx) [m] that returns the weights of the heights in the mean curvature.
FITS: dict[int, Callable[[float, float], np.ndarray]] = {5: _cross, 9: _square(1), 25: _square(2), 49: _square(3)}
