"""Build bisection formulas that compiled kernels can call, one for each condition."""

import math
from collections.abc import Callable
from functools import cache
from typing import Any

from stiction.engine.compiled import formula


@cache
def halving(holds: Callable) -> Any:
    """Return a formula (low, high, arguments) -> u that finds by bisection where the condition `holds` becomes false.

    holds(u, arguments): a formula that is true at low and false at high and changes once in between. arguments: a tuple of its
    further arguments. u is the smallest number found at which `holds` is false, exact to machine precision.
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
    """Return a formula (low, last, step, farthest, arguments) -> u: the condition `holds` is true from low up to u.

    u is low if `holds` is false at low, and last if `holds` is true at last. holds: as in `halving`. If last is infinite, an
    upper bound is searched first: the step starts at `step` and grows fourfold, up to `farthest`.
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
