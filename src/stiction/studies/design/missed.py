"""Compute how far designs miss the target values of their objectives."""

from collections.abc import Iterator, Mapping

import numpy as np

from stiction.quantities.units import show
from stiction.studies.design.plan import DesignPlan, quantity_of

_NEAR = 0.01  # of a target: nearer than this counts as met


def off_targets(plan: DesignPlan, known: Mapping[str, np.ndarray]) -> Iterator[tuple[str, np.ndarray]]:
    """Yield each objective with a target: the name of its result, and the relative distances (n,) of n designs from the target.

    A distance is (result - target)/|target|. known: results (n,) by name.
    """
    for objective, target in zip(plan.objectives, plan.targets, strict=True):
        if objective.target:
            yield objective.quantity, (known[objective.quantity] - target) / (abs(target) or 1.0)


def missed_objectives(plan: DesignPlan, known: Mapping[str, np.ndarray], row: int) -> list[str]:
    """Return one sentence for each target that a design misses by more than 1 %, with the difference in percent.

    known: results (n,) by name. row: index of the design.
    """
    targets = {objective.quantity: target for objective, target in zip(plan.objectives, plan.targets, strict=True)}
    found = []
    for name, off in off_targets(plan, known):
        if abs(off[row]) > _NEAR:
            value, target = (show(one, quantity_of(name), 4) for one in (float(known[name][row]), targets[name]))
            found.append(f"{name} = {value}, {abs(100.0 * off[row]):.3g} % {'above' if off[row] > 0.0 else 'below'} {target}")
    return found
