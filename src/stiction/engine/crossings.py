"""Where a formula changes its sign along pieces, looked for between samples: for kernels, made for each formula."""

from collections.abc import Callable
from functools import cache
from typing import Any

from stiction.engine.compiled import kernel, unpack

SAMPLES, HALVINGS, MOST = 24, 60, 6  # on a piece, of a bracket, crossings that are looked for


@cache
def crossing(excess: Callable, parameters: int) -> Any:
    """The kernel that looks for the changes of sign of excess(u, row), row having so many parameters."""

    @kernel
    def fill_crossings(table, edges, out):
        """Where it changes between two edges (n, m): at most so many places as there is room for in out (n, k), the first edge
        for none. Edges are finite."""
        for i in range(edges.shape[0]):
            row, found = unpack(table[i], parameters), 0
            out[i] = edges[i, 0]
            for at in range(edges.shape[1] - 1):
                low, step = edges[i, at], (edges[i, at + 1] - edges[i, at]) / SAMPLES
                if not step > 0.0:
                    continue
                u = low + 1e-9 * step
                before = excess(u, row)
                for k in range(1, SAMPLES + 1):
                    v = low + (k if k < SAMPLES else SAMPLES - 1e-9) * step
                    value = excess(v, row)
                    if (value > 0.0) != (before > 0.0) and found < out.shape[1]:
                        left, right = u, v
                        for _ in range(HALVINGS):
                            middle = 0.5 * (left + right)
                            if (excess(middle, row) > 0.0) == (before > 0.0):
                                left = middle
                            else:
                                right = middle
                        out[i, found] = right
                        found += 1
                    u, before = v, value

    return fill_crossings
