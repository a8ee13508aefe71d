"""Determine how many designs each part of a search evaluates, and with which designs it begins."""

import numpy as np

from stiction.quantities.sampling import sobol_points
from stiction.studies.design.space import DesignSpace

FRONT = 12  # ceilings of the second objective at which the Pareto front of a model is searched
_DRAWN, _FEW_DRAWN = 256, 32  # first designs of a search, for a model and for a prediction with one objective
TOGETHER, _PER_ROUND = 64, 12  # designs per round on the Pareto front of a prediction; generations that count as one round
_POPULATION, FEW = 24, 8  # smallest population of differential evolution, for a model and for a prediction
WAYS = 12  # combinations of list entries that are searched, the best first
REFINED = 3  # combinations of list entries whose numbers are refined


def most_designs(space: DesignSpace) -> int:
    """Return the largest number of designs that a search may evaluate; most searches stop earlier."""
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
    """Return the n designs that a search evaluates first, (n, d): Sobol points for every combination of list entries.

    Each of the d choices is a position, 0 to 1, between its ends or along its list. If there are 1024 or more combinations,
    only every second, third, ... combination is used, so that 512 to 768 remain. Without free parameters, the designs are all
    combinations, once each.
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
