"""Where along a piece the sign of something changes: kinks of laws that take the lesser of two forces."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.engine.compiled import kernel, unpack
from stiction.engine.regime import columns
from stiction.laws.piece import NormalPiece

__all__ = ["turns"]

# Steps in ln u that are looked at, up to so many times the first coordinate; halvings of a step.
_STEPS, _FARTHEST, _HALVINGS = 200, 1e5, 50


@cache
def _finding(signed: Callable, parameters: int) -> Any:
    @kernel
    def fill(table, edges, out):
        for i in range(out.shape[0]):
            row, first, last = unpack(table[i], parameters), edges[i, 0], edges[i, edges.shape[1] - 1]
            low = max(first, 1e-6 * min(last, 1.0))
            out[i] = first
            if not last > low:
                continue
            ratio = (min(last / low, _FARTHEST) * (1.0 - 1e-9)) ** (1.0 / _STEPS)
            before, found = signed(low, row), 0
            for _ in range(_STEPS):
                high = low * ratio
                after = signed(high, row)
                if (after > 0.0) != (before > 0.0) and found < out.shape[1]:
                    left, right = low, high
                    for _ in range(_HALVINGS):
                        middle = 0.5 * (left + right)
                        if (signed(middle, row) > 0.0) == (before > 0.0):
                            left = middle
                        else:
                            right = middle
                    out[i, found] = right
                    found += 1
                low, before = high, after

    return fill


def turns(signed: Callable, piece: NormalPiece, parameters: tuple[np.ndarray, ...], most: int) -> np.ndarray:
    """Coordinates (n, most) of the piece at which signed(u, row) changes its sign, the first coordinate for none. signed: a
    formula; row: the parameters of the piece, and these (n,)."""
    laws = len(piece.edges)
    whole, out = (*piece.parameters, *parameters), np.empty((laws, most))
    _finding(signed, len(whole))(columns(whole, laws), np.ascontiguousarray(piece.edges), out)
    return out
