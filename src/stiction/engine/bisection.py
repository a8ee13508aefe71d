"""Bisection along a piece, for kernels: made for each condition that is sought."""

import math
from collections.abc import Callable
from functools import cache
from typing import Any

from stiction.engine.compiled import formula


@cache
def halving(holds: Callable) -> Any:
    """Return a formula (low, high, given) -> the place, to the last digit, beyond which `holds` is false.

    holds(u, given): a formula, true at low and false at high, that changes once between; given: its further arguments.
    """

    @formula
    def halve(low, high, given):
        for _ in range(100):
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
            if holds(middle, given):
                low = middle
            else:
                high = middle
        return high

    return halve


@cache
def up_to(holds: Callable) -> Any:
    """Return a formula (low, last, step, farthest, given) -> the place up to which `holds` on a piece from low to last.

    last may be infinite. The result is low if it holds nowhere, last if everywhere. holds: as in `halving`. On an endless
    piece the search takes growing steps, the first of this length, up to `farthest`.
    """
    halve = halving(holds)

    @formula
    def search(low, last, step, farthest, given):
        if not holds(low, given):
            return low
        high = last
        if high == math.inf:
            while step < farthest and holds(low + step, given):
                step *= 4.0
            high = low + step
        return last if holds(high, given) else halve(low, high, given)

    return search
