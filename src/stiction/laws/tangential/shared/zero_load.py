"""Find where the load of an asperity changes from tension to compression; laws that ignore tension have a kink there."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.engine.bisection import halving
from stiction.engine.compiled import formula, lazy_kernel, unpack
from stiction.engine.regime import columns
from stiction.laws.segment import NormalSegment

_STEPS = 400  # steps that double, from 1e-9 of the first coordinate to beyond any number


@cache
def _zeros(normal: Callable, parameters: int) -> Any:
    @formula
    def pulled(u, row):
        return normal(u, *row)[2] < 0.0

    halve = halving(pulled)

    @lazy_kernel(worth=300)
    def fill_zeros(table, edges, out):
        """Fill out[i] with the coordinate at which the load of contact i becomes positive.

        table, edges: parameters and edges of the segment. The result is the first coordinate if the load is not negative
        there, and the last if the load stays negative. The search doubles its step until the sign changes, then bisects.
        The load must change sign at most once.
        """
        for i in range(out.size):
            row = unpack(table[i], parameters)
            low, last = edges[i, 0], edges[i, edges.shape[1] - 1]
            out[i] = low
            if not (last > low and pulled(low, row)):
                continue
            step = 1e-9 * max(abs(low), 1e-3)
            high = min(low + step, last)
            for _ in range(_STEPS):
                if high >= last or not pulled(high, row):
                    break
                low = high
                step *= 2.0
                high = min(low + step, last)
            out[i] = halve(low, high, row) if normal(high, *row)[2] > 0.0 else high

    return fill_zeros


def zero_load(segment: NormalSegment) -> np.ndarray | None:
    """Return the coordinates (n,) at which the load changes from tension to compression, clipped to the segment.

    Returns None for a segment that has only one edge.
    """
    laws, count = segment.edges.shape
    if count < 2:
        return None
    out = np.empty(laws)
    compiled = _zeros(segment.normal, len(segment.parameters))
    compiled(columns(segment.parameters, laws), np.ascontiguousarray(segment.edges), out)
    return out
