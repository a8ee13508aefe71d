"""Maxima of a map that stand out by more than a threshold: persistence, by joining hills from the highest saddle down.

Only few points matter. Around most of them the higher neighbours hang together: whatever they belong to, the point belongs to
as well. A maximum has no higher neighbour; a saddle has several groups of them, and may be where two hills meet. Of two points
of the same height that with the larger flat index counts as higher, so that there is one order of all.
"""

import numpy as np
from scipy.ndimage import label

from stiction.engine.compiled import formula, kernel

__all__ = ["persistent_maxima"]

# The eight neighbours around a point, from that before it in its row; the last four have a larger flat index.
_AROUND = ((0, -1), (-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1))
_MISSING = -1


def _groups(mask: int) -> int:
    """How many groups of neighbours, touching each other at sides or corners, the neighbours in the mask are."""
    square = np.zeros((3, 3), dtype=int)
    for k, (i, j) in enumerate(_AROUND):
        square[1 + i, 1 + j] = mask >> k & 1
    return int(label(square, structure=np.ones((3, 3)))[1])


_GROUPS = np.array([_groups(mask) for mask in range(256)], dtype=np.int8)


def persistent_maxima(heights: np.ndarray, threshold: float) -> np.ndarray:
    """Flat indices, ascending, of the maxima of heights (rows, columns) that stand out by more than the threshold >= 0.

    Where two hills meet, among eight neighbours, the lower one ends: it stands out by its height over this saddle. The highest
    of every connected piece stays. Missing points, NaN, connect nothing. Of a plateau it is one of its points.
    """
    heights = np.ascontiguousarray(heights)
    parent, saddle = _uphill(heights, _GROUPS)
    flat = heights.ravel()
    saddles = np.flatnonzero(saddle)
    ascending = saddles[np.argsort(flat[saddles], kind="stable")]
    return np.flatnonzero(_joined(flat, heights.shape[1], parent, ascending, threshold))


@kernel
def _uphill(heights, groups):
    """For every point (n,) a higher neighbour, itself if there is none, _MISSING if it has no height; and which are saddles."""
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
    """Whether one point is higher than another in the order of all."""
    return heights[one] > heights[other] or (heights[one] == heights[other] and one > other)


@formula
def _top(parent, point):
    """The highest point of what the point belongs to, by the way up, which is halved for the next time."""
    while parent[point] != point:
        parent[point] = parent[parent[point]]
        point = parent[point]
    return point


@kernel
def _joined(heights, columns, parent, ascending, threshold):
    """Which points (n,) of the flat map are maxima that stand out; joins what `parent` says of every hill on the way."""
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
