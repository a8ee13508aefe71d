"""Take the smaller of peeling force and yield force on an adhesive asperity, and find the kinks of the result."""

from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.shared.edge_yield import keep_smaller
from stiction.laws.tangential.shared.sign_changes import sign_changes

# Largest number of sign changes that each number of the formula is searched for.
_MOST = 5


class Force(NamedTuple):
    """Hold a formula with the arguments (u, load, area, row) and its parameters for n laws.

    columns: one array (n,) for each parameter. row: the parameters of one law. The formula of a peeling force returns the
    force. The formula of a yield force returns two numbers: one that is negative where the force is not real, and the force
    itself. A yield force that is negative or not real is replaced by 0.
    """

    formula: Callable
    columns: tuple[np.ndarray, ...]


@cache
def _resistance(peels: Callable, width: int, yields: Callable) -> Any:
    @formula
    def resistance(u, w, load, area, *row):
        real, force = yields(u, load, area, row[width:])
        return keep_smaller(peels(u, load, area, row), max(force, 0.0) if real >= 0.0 else 0.0)

    return resistance


@cache
def _signed(peels: Callable, width: int, yields: Callable, normal: Callable, parameters: int) -> Any:
    """Return a formula of (u, row) for two numbers that change sign at the kinks of the smaller of two forces.

    The two forces are the peeling force and the yield force at the coordinate u. The first number changes sign where the
    two forces are equal or the yield force vanishes, the second where the yield force stops being real. peels, yields:
    formulas of the forces; `peels` has `width` parameters. normal: formula of the segment, with `parameters` parameters.
    row: parameters of segment, peeling and yield, in this order.
    """
    of_yield = parameters + width

    @formula
    def signed(u, row):
        _, _, load, area = normal(u, *row[:parameters])
        real, force = yields(u, load, area, row[of_yield:])
        yield_force = force if real >= 0.0 and force > 0.0 else 0.0
        crosses = (yield_force - peels(u, load, area, row[parameters:])) * (1.0 if force > 0.0 else -1.0)
        return crosses, real

    return signed


def smaller_force(
    segment: NormalSegment, peeling: Force, yielding: Force, kinks: np.ndarray | None = None
) -> TangentialResistance:
    """Return the tangential resistance of an adhesive asperity on an elastic segment, the smaller of peeling and yield force.

    peeling, yielding: formulas with their parameters. kinks (n, k): coordinates u of further kinks, at which one of the two
    forces itself has a kink, or None.
    """
    width, own = len(peeling.columns), (*peeling.columns, *yielding.columns)
    signed = _signed(peeling.formula, width, yielding.formula, segment.normal, len(segment.parameters))
    crossings = sign_changes(signed, segment, own, 2, _MOST)
    branch = np.where(crossings[:, 1] > segment.edges[:, :1], crossings[:, 1], -np.inf)
    all_kinks = np.concatenate([crossings.reshape(len(crossings), -1), *([] if kinks is None else [kinks])], axis=1)
    return TangentialResistance(_resistance(peeling.formula, width, yielding.formula), own, all_kinks, branch)
