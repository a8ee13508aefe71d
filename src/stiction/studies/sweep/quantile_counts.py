"""Quantiles of any number of values in bounded memory: how many values there are of each size.

A size is a value's sign, exponent and first seven binary digits: bins that are 1/128 of their lower end wide or less, and the
same for everybody, so that counts of parts add up to those of the whole, in whatever order and to the last one. A quantile is
the middle of its bin, within 1/256 of the true one. Source: counts in bins of constant relative width, which bound the relative
error of quantiles and can be added, Masson, Rim & Lee 2019 (DDSketch), section 2. The authors' package takes one value after
another in Python, thirty times slower.
"""

from collections.abc import Iterable, Mapping
from itertools import pairwise

import numpy as np

# Share of the values that are not above it, by the name of a statistic.
PERCENTILES: Mapping[str, float] = {
    "percentile_1": 0.01,
    "percentile_5": 0.05,
    "percentile_25": 0.25,
    "median": 0.5,
    "percentile_75": 0.75,
    "percentile_95": 0.95,
    "percentile_99": 0.99,
}
_CUT = 52 - 7  # binary digits that are left out of the 52 that a number has
_FLIPPED = np.int64(2**63 - 1)  # of a negative number all but the sign: then they are in order, too
_MIDDLE = 1 << (63 - _CUT)  # sizes below belong to negative numbers
_AT_ONCE = 250_000  # counts that are added together: as many as stay in a cache


def sizes_of(values: np.ndarray) -> np.ndarray:
    """Return the bins (uint32, above 0) of finite float64 values, in the order of the values."""
    bits = np.ascontiguousarray(values, dtype=np.float64).view(np.int64)
    return (((bits ^ ((bits >> 63) & _FLIPPED)) >> _CUT) + _MIDDLE).astype(np.uint32)


def values_at(sizes: np.ndarray) -> np.ndarray:
    """Return the centres of bins; 0 for the bins next to 0."""
    first = (sizes.astype(np.int64) - _MIDDLE) << _CUT
    ends = (first, first + ((1 << _CUT) - 1))
    low, high = ((end ^ ((end >> 63) & _FLIPPED)).view(np.float64) for end in ends)
    middle = 0.5 * low + 0.5 * high
    return np.where(np.abs(middle) < np.finfo(float).tiny, 0.0, middle)


def counted(values: np.ndarray) -> np.ndarray:
    """Count the finite values (n, points) by bin, (2, points, m) uint32: bins and counts.

    The bins of each point ascend; bin 0 does not occur and fills the rest; m: the largest number of bins of a point.
    """
    there = np.isfinite(values)
    sizes = np.where(there, sizes_of(np.where(there, values, 0.0)), np.uint32(0)).T.copy()
    sizes.sort(axis=1)
    if not sizes.size:
        return np.zeros((2, *sizes.shape), dtype=np.uint32)
    flat, (points, n) = sizes.ravel(), sizes.shape
    is_first = np.append(True, flat[1:] != flat[:-1])
    is_first[::n] = True
    start = np.flatnonzero(is_first)
    many = np.diff(start, append=flat.size)
    kept = flat[start] > 0
    start, many = start[kept], many[kept]
    point = start // n
    place = np.arange(point.size) - np.searchsorted(point, np.arange(points))[point]
    found = np.zeros((2, points, place.max(initial=0) + 1), dtype=np.uint32)
    found[0, point, place], found[1, point, place] = flat[start], many
    return found


def quantiles_of(parts: Iterable[np.ndarray], points: int, shares: Iterable[float]) -> np.ndarray:
    """Return the quantiles (shares, points) of all parts, each (2, points, n) as `counted` returns.

    A quantile is the lowest bin up to which the values make the requested share; NaN without values.
    """
    keys, counts = _together(parts)
    shares = list(shares)
    found = np.full((len(shares), points), np.nan)
    ends = np.searchsorted(keys >> np.uint64(32), np.arange(points + 1, dtype=np.uint64))
    for point, (start, stop) in enumerate(pairwise(ends)):
        if stop > start:
            up_to = np.cumsum(counts[start:stop])
            rank = np.maximum(np.ceil(np.array(shares) * up_to[-1]), 1.0)
            found[:, point] = values_at((keys[start:stop] & np.uint64(0xFFFFFFFF))[np.searchsorted(up_to, rank)])
    return found


def _together(parts: Iterable[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Merge the counts of all parts: return each key once, ascending, and its total count.

    A key is one integer for a point and a bin of values.
    """
    keys, counts = [np.empty(0, dtype=np.uint64)], [np.empty(0, dtype=np.int64)]
    waiting = 0
    for sizes, many in parts:
        there = sizes > 0
        point = np.repeat(np.arange(len(sizes), dtype=np.uint64), there.sum(axis=1))
        keys.append((point << np.uint64(32)) | sizes[there])
        counts.append(many[there])
        waiting += point.size
        if waiting > max(_AT_ONCE, keys[0].size):
            keys, counts, waiting = *_added(keys, counts), 0
    (keys_of_all,), (counts_of_all,) = _added(keys, counts)
    return keys_of_all, counts_of_all


def _added(keys: list[np.ndarray], counts: list[np.ndarray]) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Merge parts into one: every key once, ascending, with its total count.

    The keys of each part ascend, which makes a stable sort fast.
    """
    every = np.concatenate(keys)
    order = np.argsort(every, kind="stable")
    every = every[order]
    is_first = np.ones(every.size, dtype=bool)
    is_first[1:] = every[1:] != every[:-1]
    first = np.flatnonzero(is_first)
    return [every[first]], [np.add.reduceat(np.concatenate(counts)[order], first)]
