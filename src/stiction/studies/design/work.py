"""How many designs each part of a search evaluates, and which it begins with."""

import numpy as np

from stiction.quantities.sampling import sobol_points
from stiction.studies.design.space import DesignSpace

FRONT = 12  # designs between the two ends of a front that are searched, of a model
_DRAWN, _FEW_DRAWN = 256, 32  # designs that a search begins with, of a model and of a prediction with one objective
TOGETHER, _PER_ROUND = 64, 12  # designs of a round of a front of predictions; effort of a round
_POPULATION, FEW = 24, 8
WAYS = 12  # ways to choose from lists that are searched
REFINED = 3  # ways to choose from lists whose numbers are refined


def most_designs(space: DesignSpace) -> int:
    """Return the largest number of designs that a search evaluates; most searches stop earlier."""
    drawn, plan = first_designs(space), space.plan
    if not plan.free:
        return len(drawn)
    if len(plan.objectives) == 2 and space.is_predicted:
        return len(drawn) + TOGETHER * front_rounds(space)
    generations = len(plan.objectives) * (plan.effort + 1)
    if len(plan.objectives) == 2:
        generations += FRONT * (front_generations(space) + 1)
    ways = len(np.unique(space.combination(drawn), axis=0))
    refined = 0 if space.is_predicted else len(plan.objectives) * min(ways, REFINED) * (refinements(space) + 1)
    return len(drawn) + min(ways, WAYS) * population(space) * generations + refined


def population(space: DesignSpace) -> int:
    few = space.is_predicted
    return max(FEW if few else _POPULATION, (3 if few else 6) * space.dimension)


def front_generations(space: DesignSpace) -> int:
    return max(1, space.plan.effort // 3)


def front_rounds(space: DesignSpace) -> int:
    return max(1, space.plan.effort // _PER_ROUND)


def refinements(space: DesignSpace) -> int:
    return 60 * (1 + len(space.plan.free))


def first_designs(space: DesignSpace) -> np.ndarray:
    """Return the first designs to evaluate (n, d): Sobol points for every combination of list entries.

    Each of the d choices is a position between its ends or along its list, 0 to 1. Without free numbers,
    each combination occurs once.
    """
    plan, most = space.plan, _FEW_DRAWN * len(space.plan.objectives) ** 2 if space.is_predicted else _DRAWN
    counts = [len(one.entries) for one in plan.options]
    if not counts:
        return sobol_points(len(plan.free), most, plan.seed)
    centres = np.stack(np.meshgrid(*((np.arange(n) + 0.5) / n for n in counts), indexing="ij"), axis=-1).reshape(
        -1, len(counts)
    )
    ways = len(centres)
    if not plan.free:
        return centres
    each = 2 ** max(2, int(np.ceil(np.log2(max(4.0, most / ways)))))
    points = sobol_points(len(plan.free), each, plan.seed)
    some = centres[:: max(1, ways // 512)]
    return np.column_stack([np.repeat(some, each, axis=0), np.tile(points, (len(some), 1))])
