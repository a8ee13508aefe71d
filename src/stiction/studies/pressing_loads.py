"""The loads of a case that are above 0, and the working load at which models are compared."""

import numpy as np

from stiction.case.read import Case
from stiction.solving.choice import DEFAULT_MODEL, RECOMMENDED
from stiction.solving.solve import solve


def pressing_loads(case: Case) -> tuple[np.ndarray, int]:
    """Return the loads of a case above 0 (n,), and the index of its working load among them.

    The working load is the middle one of all loads of the case, or the load above 0 that is nearest to the middle. If the case
    has separations, the loads are those that its own model carries at these. The array is empty if no load is above 0.
    """
    loads = case.load
    if loads is None:
        key = DEFAULT_MODEL if case.choice.model == RECOMMENDED else case.choice.model_key
        own = case.choice.arguments() | {"model": key}  # named: loads do not depend on what friction ignores
        loads = solve(case.subject.as_numbers(), separation=case.separation, **own)["load"].values
    pressing = np.flatnonzero(loads > 0.0)
    middle = (len(loads) - 1) // 2
    return loads[pressing], int(np.argmin(np.abs(pressing - middle))) if pressing.size else 0
