"""Select the loads of a case that are above 0, and the working load at which models are compared."""

import numpy as np

from stiction.case.read import Case
from stiction.solving.choice import DEFAULT_MODEL, RECOMMENDED
from stiction.solving.solve import solve


def pressing_loads(case: Case) -> tuple[np.ndarray, int]:
    """Return the loads of a case above 0 (n,), and the index of its working load among them.

    Loads are in N, or dimensionless for [indices]. The working load is the middle entry in the list of all loads. If this entry
    is not above 0, the working load is the load above 0 whose position in the list is nearest to the middle. If the case states
    separations, the loads are those that its model (for a prediction, the default model) computes at these separations. If no
    load is above 0, the array is empty and the index 0.
    """
    loads = case.load
    if loads is None:
        key = DEFAULT_MODEL if case.choice.model == RECOMMENDED else case.choice.model_key
        # The default model is named, because without a name it refuses inputs that its friction ignores.
        own = case.choice.arguments() | {"model": key}
        if key == DEFAULT_MODEL and all(value is None for name, value in own.items() if name != "model"):
            own["tangential"] = "none"  # loads do not depend on friction, and computing friction would take most of the time
        loads = solve(case.subject.as_numbers(), separation=case.separation, **own)["load"].values
    pressing = np.flatnonzero(loads > 0.0)
    middle = (len(loads) - 1) // 2
    return loads[pressing], int(np.argmin(np.abs(pressing - middle))) if pressing.size else 0
