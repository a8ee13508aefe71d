"""Build bisection formulas that compiled loops can call, one formula for each condition."""

import math
from collections.abc import Callable
from functools import cache
from typing import Any

from stiction.engine.compiled import formula


@cache
def halving(holds: Callable) -> Any:
    """Return a formula (low, high, arguments) -> u that finds by bisection where the condition `holds` becomes false.

    holds(u, arguments): a formula that is true at low and false at high and changes once in between. arguments: the tuple that
    is passed on to `holds`. u is the smallest number found at which `holds` is false, exact to machine precision.
    """

    @formula
    def halve(low, high, arguments):
        for _ in range(100):
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
            if holds(middle, arguments):
                low = middle
            else:
                high = middle
        return high

    return halve


@cache
def up_to(holds: Callable) -> Any:
    """Return a formula (low, last, step, farthest, arguments) -> u that finds how far above `low` a condition stays true.

    holds(u, arguments): a formula, the condition; it may change once, from true to false. u is the number at which it changes,
    found by bisection; low if the condition is false at low; last if it is still true at last. If last is infinite, the search
    tries low + step with a step that grows fourfold up to `farthest`, until the condition is false. If the
    condition is never false, u is infinite.
    """
    halve = halving(holds)

    @formula
    def search(low, last, step, farthest, arguments):
        if not holds(low, arguments):
            return low
        high = last
        if high == math.inf:
            while step < farthest and holds(low + step, arguments):
                step *= 4.0
            high = low + step
        return last if holds(high, arguments) else halve(low, high, arguments)

    return search
