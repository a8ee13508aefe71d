r"""Find the summits of a map that stand out by more than a threshold, by joining hills from the highest saddle down.

Only a few points matter: maxima and saddles. A maximum has no higher neighbour. A saddle has two or more separate groups of
higher neighbours, and may be where two hills meet. At any other point all higher neighbours are connected; they and the point
belong to one hill. Of two points of the same height the one with the larger flat index counts as higher, so that the order of
the points is unique.

*Assumes*: an asperity is the top of a hill from which every path to a higher top descends by more than a threshold; its
curvature is computed from the least-squares paraboloid around it. *Source*: [iso_25178_2_2012], hills and Wolf pruning.
*Reconstruction*: the standards were not available; the pruning, and its default of 5 % of $S_z$, are from memory, and dales are
left out. A hill with its top at $z$, which joins a higher hill at a saddle of height $s$, counts if

$$
z-s>c,\qquad\kappa=-\tfrac12(z_{xx}+z_{yy}),\qquad N=\frac nA,\qquad\frac1R=\bar\kappa
$$

with the threshold $c$, the curvature $\kappa$ of its top, and $n$ hills on the area $A$.
"""

from functools import cache

import numpy as np

from stiction.engine.compiled import formula, kernel
from stiction.quantities.shown import show
from stiction.records.registry import AsperityMethod, Limit, Parameter
from stiction.records.sources import Source
from stiction.surfaces.asperity_method.shared.summits import FITS, areal, fitted
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.heightmap import HeightMap

# ISO 25178-3's default threshold for pruning the tree of hills and dales, as a fraction of the maximum height Sz.
PRUNING = 0.05


def persistence(surface: HeightMap, threshold: float | None, fit_points: int) -> Asperities:
    """Find the summits of a map that stand out from their surroundings by more than a threshold, as asperities.

    From such a summit, every path to a higher summit descends by more than the threshold. A hill that stands out by less
    belongs to the higher hill beyond its saddle, as in ISO 25178-2's segmentation with Wolf pruning. A plateau is one summit.

    - threshold: height difference [m] >= 0; None for 5 % of the range of heights
    - fit_points: number of points of the paraboloid fitted around each summit, a key of FITS

    A summit is excluded if a fitted point is missing or off the map. The density is the number of summits divided by the area
    of the positions where they could be counted. Raises InputError for a map with fewer than three rows or columns, for fewer
    than two summits, and for a mean curvature that is not positive.
    """
    heights = areal(surface)
    if threshold is None:
        threshold = PRUNING * float(np.nanmax(heights) - np.nanmin(heights))
    row, column = np.unravel_index(persistent_maxima(heights, threshold), heights.shape)
    return fitted(
        "persistence",
        surface,
        heights,
        (row, column),
        fit_points,
        f"summits that stand out by more than {show(threshold, 'mean_separation', 4)}; paraboloid through {fit_points} points",
        remedy=f"a threshold below {show(threshold, 'mean_separation', 4)}, finer points or a larger map",
    )


# Steps (row, column) to the eight neighbours of a point, in circular order; the last four have a larger flat index.
_AROUND = ((0, -1), (-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1))
_MISSING = -1


@cache
def _groups() -> np.ndarray:
    """Return a table (256,): the number of connected groups of higher neighbours, for each pattern of higher neighbours.

    Bit k of a pattern is set if neighbour k, in the order of _AROUND, is higher. Neighbours that touch at sides or corners are
    connected.
    """
    from scipy.ndimage import label  # slow to import

    counts = np.empty(256, dtype=np.int8)
    for mask in range(256):
        square = np.zeros((3, 3), dtype=int)
        for k, (i, j) in enumerate(_AROUND):
            square[1 + i, 1 + j] = mask >> k & 1
        counts[mask] = label(square, structure=np.ones((3, 3)))[1]
    return counts


def persistent_maxima(heights: np.ndarray, threshold: float) -> np.ndarray:
    """Return the flat indices (n,), ascending, of the maxima of a map that stand out by more than a threshold.

    heights: (rows, columns) [m], NaN where missing. threshold: height difference [m] >= 0. Neighbours of a point are the eight
    points around it. Where two hills meet, the lower one ends: its top stands out by its height above this saddle. The highest
    maximum of each connected region always counts. Missing points separate regions. A plateau yields one of its points.
    """
    heights = np.ascontiguousarray(heights)
    parent, saddle = _uphill(heights, _groups())
    flat = heights.ravel()
    saddles = np.flatnonzero(saddle)
    ascending = saddles[np.argsort(flat[saddles], kind="stable")]
    return np.flatnonzero(_joined(flat, heights.shape[1], parent, ascending, threshold))


@kernel
def _uphill(heights, groups):
    """Return the flat index of a higher neighbour of every point (n,), and a mask (n,) of the saddle points.

    heights: (rows, columns) [m], NaN where missing. groups: number of groups for each pattern of higher neighbours, from
    `_groups`. A maximum gets its own index; a point without a height gets _MISSING. A saddle point has two or more separate
    groups of higher neighbours.
    """
    rows, columns = heights.shape
    parent = np.empty(heights.size, dtype=np.int32)
    saddle = np.zeros(heights.size, dtype=np.bool_)
    for row in range(rows):
        for column in range(columns):
            point = row * columns + column
            z = heights[row, column]
            mask, higher = 0, point
            for k, (i, j) in enumerate(_AROUND):
                if 0 <= row + i < rows and 0 <= column + j < columns:
                    other = heights[row + i, column + j]
                    if other > z or (k >= 4 and other == z):
                        mask |= 1 << k
                        higher = point + i * columns + j
            parent[point] = higher if z == z else _MISSING
            saddle[point] = groups[mask] > 1
    return parent, saddle


@formula
def _above(heights, one, other):
    """Return whether point `one` ranks higher than point `other`; of equal heights the larger index ranks higher.

    heights: flat map (n,). one, other: indices of points.
    """
    return heights[one] > heights[other] or (heights[one] == heights[other] and one > other)


@formula
def _top(parent, point):
    """Return the index of the highest point of the hill to which a point belongs.

    parent: for each point the index of a higher point of the same hill, or its own index at the top. The search shortens the
    paths in `parent`, in place, so that later calls are faster.
    """
    while parent[point] != point:
        parent[point] = parent[parent[point]]
        point = parent[point]
    return point


@kernel
def _joined(heights, columns, parent, ascending, threshold):
    """Join hills at their saddles, and return a mask (n,) of the maxima that stand out by more than the threshold.

    heights: flat map (n,) [m]. columns: number of columns of the map. parent: index of a higher point of the same hill, for
    each point; changed in place where hills are joined. ascending: indices of the saddle points, sorted by height; they are
    processed from the highest down. The highest maximum of each connected region is always in the mask.
    """
    kept = np.zeros(heights.size, dtype=np.bool_)
    for k in range(ascending.size - 1, -1, -1):
        point = ascending[k]
        column = point % columns
        hill = _top(parent, point)
        for i, j in _AROUND:
            other = point + i * columns + j
            outside = other < 0 or other >= heights.size or column + j < 0 or column + j >= columns
            if outside or not _above(heights, other, point):
                continue
            other = _top(parent, other)
            if other != hill:
                low, high = (hill, other) if _above(heights, other, hill) else (other, hill)
                if heights[low] - heights[point] > threshold:
                    kept[low] = True
                parent[low] = high
                hill = high
    for point in range(heights.size):
        if parent[point] == point:
            kept[point] = True
    return kept


RECORD = AsperityMethod(
    key="persistence",
    title="Hills of a map that stand out by more than a threshold; curvature of the least-squares paraboloid around their tops",
    label="persistent summits",
    grade="C",
    sources=(
        Source("iso_25178_2_2012", "", "reconstructed from memory: hills and Wolf pruning; dales are not pruned"),
        Source("iso_16610_85_2013", "", "reconstructed from memory: hills and Wolf pruning"),
        Source("iso_25178_3_2012", "", "reconstructed from memory: the default threshold of 5 % of Sz"),
    ),
    verified="its definition, tested level by level with another library on random maps with and without a lay; arrays of "
    "paraboloids in closed form; eight-neighbour summits for a threshold of 0",
    find=persistence,
    order=3,
    of_profiles=False,
    parameters={
        "threshold": Parameter(
            f"height of a hill above the saddle to a higher hill; default: {100.0 * PRUNING:g} % of the range of heights, Sz",
            None,
            lower=0.0,
            lower_included=True,
        ),
        "fit_points": Parameter("points of the fitted paraboloid; 5: along the two axes only", 25, tuple(FITS)),
    },
    limits=(
        Limit(
            "eight_neighbour",
            {},
            ("asperity_height_deviation", "asperity_radius", "asperity_density"),
            1e-12,
            {"threshold": 0.0, "fit_points": 9},
        ),
    ),
    notes="Only summits that stand out are counted. These are fewer, higher and, with a fine pitch, sharper than summits by "
    "other methods. The default threshold is larger on larger maps, which have higher extremes, and on maps with spikes. A "
    "plateau counts as one summit.",
)
