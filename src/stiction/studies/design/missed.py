"""How far a design is off the objectives."""

from collections.abc import Iterator, Mapping

import numpy as np

from stiction.quantities.units import show
from stiction.studies.design.plan import DesignPlan, quantity_of

_NEAR = 0.01  # of a target: nearer than this counts as met


def off_targets(plan: DesignPlan, known: Mapping[str, np.ndarray]) -> Iterator[tuple[str, np.ndarray]]:
    """Yield each result with a target, and how far designs are off it, over its size: above 0 where they are too high."""
    for objective, target in zip(plan.objectives, plan.targets, strict=True):
        if objective.target:
            yield objective.quantity, (known[objective.quantity] - target) / (abs(target) or 1.0)


def missed_objectives(plan: DesignPlan, known: Mapping[str, np.ndarray], row: int) -> list[str]:
    """Return a sentence for each target that a design misses by more than 1 %: its value, the target, and by how much."""
    targets = {objective.quantity: target for objective, target in zip(plan.objectives, plan.targets, strict=True)}
    found = []
    for name, off in off_targets(plan, known):
        if abs(off[row]) > _NEAR:
            value, target = (show(one, quantity_of(name), 4) for one in (float(known[name][row]), targets[name]))
            found.append(f"{name} = {value}, {abs(100.0 * off[row]):.3g} % {'above' if off[row] > 0.0 else 'below'} {target}")
    return found
