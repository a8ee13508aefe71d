"""Approximate quantiles of any number of values in bounded memory, by histograms that can be merged.

A bin has one sign, one exponent and the first seven binary digits of the fraction, so its width is at most 1/128 of its end
nearer to 0. All histograms have the same bins, so the counts of parts add up exactly, in any order. A quantile is the centre of
its bin, with a relative error of at most 1/256. Source: Masson, Rim & Lee 2019 (DDSketch), section 2. Bins of constant relative
width bound the relative error of quantiles and can be merged. The authors' package processes one value after another in Python
and is thirty times slower.
"""

from collections.abc import Iterable, Mapping
from itertools import pairwise

import numpy as np

# Quantile level of each percentile, by the name of the statistic.
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
_FLIPPED = np.int64(2**63 - 1)  # all bits but the sign; flipping them puts negative numbers in ascending order
_MIDDLE = 1 << (63 - _CUT)  # bin numbers below belong to negative values
_AT_ONCE = 250_000  # counts that are added in one step; this number fits into the cache of a processor


def bin_numbers(values: np.ndarray) -> np.ndarray:
    """Return the histogram bin number (uint32, above 0) of each finite float64 value; larger values have larger numbers."""
    bits = np.ascontiguousarray(values, dtype=np.float64).view(np.int64)
    return (((bits ^ ((bits >> 63) & _FLIPPED)) >> _CUT) + _MIDDLE).astype(np.uint32)


def bin_centres(bins: np.ndarray) -> np.ndarray:
    """Return the central value of each histogram bin, 0 if it is below the smallest normal float; bins: bin numbers."""
    first = (bins.astype(np.int64) - _MIDDLE) << _CUT
    ends = (first, first + ((1 << _CUT) - 1))
    low, high = ((end ^ ((end >> 63) & _FLIPPED)).view(np.float64) for end in ends)
    middle = 0.5 * low + 0.5 * high
    return np.where(np.abs(middle) < np.finfo(float).tiny, 0.0, middle)


def histogram(values: np.ndarray) -> np.ndarray:
    """Return the histogram of n values at each of several points, as bin numbers and their counts, (2, points, m).

    values: array (n, points). Non-finite values are excluded. The bin numbers of a point ascend. m is the largest number of
    occupied bins of a point, at least 1 if n > 0; shorter rows are filled up with bin 0, which no value has.
    """
    there = np.isfinite(values)
    sizes = np.where(there, bin_numbers(np.where(there, values, 0.0)), np.uint32(0)).T.copy()
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
    """Return quantiles (levels, points) of all values that are counted in several histograms.

    parts: histograms (2, points, m) as `histogram` returns them. points: number of points, each with values of its own. shares:
    quantile levels, 0 to 1. A quantile is the centre of the lowest bin up to which the fraction of the values reaches the
    level. It is NaN for a point without values.
    """
    keys, counts = _together(parts)
    shares = list(shares)
    found = np.full((len(shares), points), np.nan)
    ends = np.searchsorted(keys >> np.uint64(32), np.arange(points + 1, dtype=np.uint64))
    for point, (start, stop) in enumerate(pairwise(ends)):
        if stop > start:
            up_to = np.cumsum(counts[start:stop])
            rank = np.maximum(np.ceil(np.array(shares) * up_to[-1]), 1.0)
            found[:, point] = bin_centres((keys[start:stop] & np.uint64(0xFFFFFFFF))[np.searchsorted(up_to, rank)])
    return found


def _together(parts: Iterable[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Merge histograms: return each key once, ascending, and its total count.

    parts: histograms (2, points, m). A key is one integer that encodes a point (upper 32 bits) and a bin number (lower 32
    bits).
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
    """Merge arrays of keys and of counts: return one array of each, in a list; every key once, ascending, with its total count.

    A key is one integer that encodes a point and a bin number. The keys of each array ascend, which makes a stable sort fast.
    """
    every = np.concatenate(keys)
    order = np.argsort(every, kind="stable")
    every = every[order]
    is_first = np.ones(every.size, dtype=bool)
    is_first[1:] = every[1:] != every[:-1]
    first = np.flatnonzero(is_first)
    return [every[first]], [np.add.reduceat(np.concatenate(counts)[order], first)]
