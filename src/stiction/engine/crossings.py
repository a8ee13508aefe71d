"""Build compiled loops that find where a formula changes sign, by sampling and refining."""

from collections.abc import Callable
from functools import cache
from typing import Any

from stiction.engine.compiled import formula, lazy_kernel, unpack

SAMPLES, MOST = 24, 6  # samples on a segment; largest number of sign changes that callers look for
_STEPS, _SECANTS = 80, 24  # largest number of steps; secants are tried in the first 24 steps, every third of which bisects
_CLOSE = 1e-15  # the search ends when two successive values of u differ by less than this, relative to u


@cache
def narrowing(excess: Callable) -> Any:
    @formula
    def narrow(left, right, at_left, at_right, row):
        """Return the number u between `left` and `right` at which the formula excess(u, row) changes sign.

        at_left, at_right: values of the formula at both ends, of opposite sign. row: parameters of the formula. Secant steps
        (Illinois variant) alternate with bisection steps. Bisection is needed because secant steps do not converge if the
        formula jumps across zero.
        """
        rises, last = at_right > 0.0, left
        for step in range(_STEPS):
            middle = 0.5 * (left + right)
            if step < _SECANTS and step % 3 < 2 and at_right != at_left:
                secant = right - at_right * (right - left) / (at_right - at_left)
                middle = secant if left < secant < right else middle
            if not left < middle < right or abs(middle - last) <= _CLOSE * abs(middle):
                break
            value, last = excess(middle, row), middle
            if (value > 0.0) == rises:
                right, at_right, at_left = middle, value, 0.5 * at_left
            else:
                left, at_left, at_right = middle, value, 0.5 * at_right
        return right if not left < last < right else last

    return narrow


@cache
def crossing(excess: Callable, parameters: int, samples: int = SAMPLES) -> Any:
    """Return a compiled loop that finds the sign changes of the formula excess(u, row) between given values of u.

    row: tuple of `parameters` numbers. samples: number of intervals into which each range between two neighbouring edges is
    divided. Edges are the ends and kinks of the formula. Two sign changes within one interval are missed.
    """
    narrow = narrowing(excess)

    @lazy_kernel(worth=300)
    def fill_crossings(table, edges, out):
        """Store in out[i] the first k values of u at which excess(u, table[i]) changes sign, in ascending order.

        table (n, p): parameters. edges (n, m): ends and kinks of the formula, finite and ascending; sign changes are sought
        between them. out: (n, k); unused entries hold the first edge.
        """
        for i in range(edges.shape[0]):
            row, count = unpack(table[i], parameters), 0
            out[i] = edges[i, 0]
            for segment in range(edges.shape[1] - 1):
                low, step = edges[i, segment], (edges[i, segment + 1] - edges[i, segment]) / samples
                if not step > 0.0:
                    continue
                u = low + 1e-9 * step
                before = excess(u, row)
                for k in range(1, samples + 1):
                    v = low + (k if k < samples else samples - 1e-9) * step
                    value = excess(v, row)
                    if (value > 0.0) != (before > 0.0) and count < out.shape[1]:
                        out[i, count] = narrow(u, v, before, value, row)
                        count += 1
                    u, before = v, value

    return fill_crossings
