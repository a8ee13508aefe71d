"""Find where functions change sign along a segment.

If a function is the difference of two forces, a law that takes the smaller one has a kink there.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.engine.bisection import halving
from stiction.engine.compiled import formula, lazy_kernel, unpack
from stiction.engine.regime import columns
from stiction.laws.segment import NormalSegment

# Number of steps in ln u, and the largest ratio of the last coordinate of the search to the first.
_STEPS, _FARTHEST = 200, 1e5


@cache
def _finding(signed: Callable, parameters: int) -> Any:
    @formula
    def holds(u, arguments):
        row, number, above = arguments
        return (signed(u, row)[number] > 0.0) == above

    halve = halving(holds)

    @lazy_kernel(worth=300)
    def fill(table, edges, out):
        for i in range(out.shape[0]):
            row, first, last = unpack(table[i], parameters), edges[i, 0], edges[i, edges.shape[1] - 1]
            low = max(first, 1e-6 * min(last, 1.0))
            out[i] = first
            if not last > low:
                continue
            ratio = (min(last / low, _FARTHEST) * (1.0 - 1e-9)) ** (1.0 / _STEPS)
            counts = np.zeros(out.shape[1], np.int64)
            high, before = low, signed(low, row)
            for step in range(_STEPS + 1):
                after = signed(high, row) if step > 0 else before
                for number in range(out.shape[1]):
                    if (after[number] > 0.0) == (before[number] > 0.0) or counts[number] == out.shape[2]:
                        continue
                    out[i, number, counts[number]] = halve(low, high, (row, number, before[number] > 0.0))
                    counts[number] += 1
                low, before = high, after
                high = low * ratio

    return fill


def sign_changes(
    signed: Callable, segment: NormalSegment, parameters: tuple[np.ndarray, ...], numbers: int, most: int
) -> np.ndarray:
    """Return the coordinates (n, numbers, most) at which functions of u change sign along a segment.

    signed(u, row) returns the values of `numbers` functions at the coordinate u. row: parameters of the segment, followed by
    `parameters`, arrays (n,). most: largest number of sign changes of each function. The search takes 200 equal steps in ln u,
    up to 1e5 times its first coordinate; two sign changes within one step are missed. Unused entries are the first coordinate
    of the segment.
    """
    laws = len(segment.edges)
    all_parameters, out = (*segment.parameters, *parameters), np.empty((laws, numbers, most))
    _finding(signed, len(all_parameters))(columns(all_parameters, laws), np.ascontiguousarray(segment.edges), out)
    return out
