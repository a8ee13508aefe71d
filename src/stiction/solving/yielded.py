"""Compute the fraction of the load on asperities that have yielded."""

import numpy as np

from stiction.engine.regime import MENISCUS
from stiction.quantities.errors import InputError
from stiction.quantities.quotient import quotient
from stiction.solving.parts import sum_selected
from stiction.solving.problem import LOAD, AsperitySum, Problem

YIELDED = ("load_share_yielded", "load_share_substrate_yielded")


def require_states(problem: Problem, name: str) -> AsperitySum:
    """Return the problem if its model can compute the fraction of the load on yielded asperities, else raise InputError.

    name: one of YIELDED, the fraction on all yielded asperities or on those where the substrate yields. The model must sum
    asperities. For the second name, its film law, if any, must treat film and substrate separately.
    """
    if not isinstance(problem, AsperitySum):
        allowed = "a model of asperities, e.g. greenwood_williamson_1966, which distinguishes yielded asperities"
        raise InputError(name, problem.record.key, allowed)
    film = problem.chosen.film
    if name != YIELDED[0] and film is not None and not any(regime.body == "substrate" for regime in problem.regimes):
        raise InputError(name, film.key, "sequential or printed, the film laws that treat film and substrate separately")
    return problem


def yielded_shares(problem: Problem, h: np.ndarray, name: str) -> np.ndarray:
    """Return the fraction (n, m) of the load on asperities that are not elastic, at separations h (n, m), in units of sigma.

    Absolute values of loads are summed, without menisci. name: one of YIELDED, which selects all yielded asperities or
    those where the substrate yields. Without a film, the bodies count as the substrate. Raises InputError for a model that
    does not distinguish the states of its asperities, or does not separate film and substrate.
    """
    sums, film = require_states(problem, name), problem.chosen.film
    regimes, of_all = sums.regimes, name == YIELDED[0]
    loads = np.abs(sums.sums_at(h)[..., LOAD])
    counted = [
        regime.state not in ("elastic", MENISCUS) and (of_all or film is None or regime.body == "substrate")
        for regime in regimes
    ]
    return quotient(sum_selected(loads, counted), sum_selected(loads, [regime.state != MENISCUS for regime in regimes]), 0.0)
