"""The loads of a case that press, and the one at which models are judged."""

import numpy as np

from stiction.case.read import Case
from stiction.solving.choice import DEFAULT_MODEL, RECOMMENDED
from stiction.solving.solve import solve


def few_places(size: int, few: int) -> np.ndarray:
    """Return so many places of a list at most: first, last and some between."""
    return np.unique(np.linspace(0, size - 1, min(size, few)).round().astype(int))


def pressing_loads(case: Case) -> tuple[np.ndarray, int]:
    """Return the loads of a case above 0, and the place among them of its working load.

    The working load is the middle one of the case, or the one nearest to it in the list that presses. Where the case names
    separations, the loads are those that its own model carries there. The array is empty where nothing presses.
    """
    loads = case.load
    if loads is None:
        key = DEFAULT_MODEL if case.choice.model == RECOMMENDED else case.choice.model_key
        own = case.choice.arguments() | {"model": key}  # named: loads do not depend on what friction ignores
        loads = solve(case.subject.as_numbers(), separation=case.separation, **own)["load"].values
    pressing = np.flatnonzero(loads > 0.0)
    middle = (len(loads) - 1) // 2
    return loads[pressing], int(np.argmin(np.abs(pressing - middle))) if pressing.size else 0
