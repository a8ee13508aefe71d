"""Where the load of an asperity turns from tension to compression: a kink of laws that count compression only."""

from functools import cache

import numpy as np
from numba.np.unsafe.ndarray import to_fixed_tuple

from stiction.engine.compiled import bind, kernel
from stiction.laws.piece import NormalPiece

# The function named _*_template is compiled anew for each kind of piece, with these names bound.
normal = None
PARAMETERS = 0
_STEPS = 400  # doublings: from a billionth of the first coordinate to beyond any number


def _zeros_template(parameters, edges, out):
    """out[i]: the coordinate at which the load of law i becomes positive; the first where it is not in tension there, the last
    where it stays in tension. Steps that double, then bisection: right if the load changes its sign once."""
    for i in range(out.size):
        row = to_fixed_tuple(parameters[i], PARAMETERS)
        low, last = edges[i, 0], edges[i, edges.shape[1] - 1]
        out[i] = low
        if not (last > low and normal(low, *row)[2] < 0.0):
            continue
        step = 1e-9 * max(abs(low), 1e-3)
        high = min(low + step, last)
        for _ in range(_STEPS):
            if high >= last or not normal(high, *row)[2] < 0.0:
                break
            low = high
            step *= 2.0
            high = min(low + step, last)
        if not normal(high, *row)[2] > 0.0:
            out[i] = high
            continue
        for _ in range(100):
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
            if normal(middle, *row)[2] < 0.0:
                low = middle
            else:
                high = middle
        out[i] = high


@cache
def _kernel(normal, parameters: int):
    return kernel(bind(_zeros_template, normal=normal, PARAMETERS=parameters))


def zero_load(piece: NormalPiece) -> np.ndarray | None:
    """Coordinates (n,) at which the load of a piece turns from tension to compression; the nearer end where it does not; None
    for a piece without length."""
    laws, count = piece.edges.shape
    if count < 2:
        return None
    columns = [np.broadcast_to(column, laws) for column in piece.parameters]
    rows = np.ascontiguousarray(np.reshape(columns, (len(columns), laws)).T, dtype=float)
    out = np.empty(laws)
    _kernel(piece.normal, len(columns))(rows, np.ascontiguousarray(piece.edges), out)
    return out
