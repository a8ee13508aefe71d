"""From a load to the mean separation that carries it, and the largest tension that a contact carries."""

from dataclasses import dataclass

import numpy as np

from .problem import Problem

# Separations searched, from out of touch to where the surfaces are pressed far beyond any model's claim.
_FAR, _NEAR, _STEPS = 10.0, -10.0, 161


class Unreachable(Exception):
    """A load that a contact nowhere carries. law and at: which; low and high: what it does carry, normalised."""

    def __init__(self, law: int, at: int, low: float, high: float):
        super().__init__(law, at, low, high)
        self.law, self.at, self.low, self.high = law, at, low, high


@dataclass(frozen=True)
class Inversion:
    """h (n, m): separations of n laws at m loads; residual (n, m): what is left, over the load; evaluations: at most."""

    h: np.ndarray
    residual: np.ndarray
    evaluations: int


def pull_off(problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """Largest tension per asperity (n,), zero where there is none, and the separation (n,) at which it is carried.

    On the branch of the problem. Source: the minimum of the load over separation (Fuller & Tabor 1975).
    """
    return _approach(problem)[2:]


def _approach(problem: Problem) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Separations from far to near, the loads there (n, H), the largest tension (n,) and its separation (n,)."""
    h = np.linspace(_FAR, _NEAR, _STEPS)
    loads = problem.loads_on_grid(h)
    lowest = np.argmin(loads, axis=1)
    laws = np.arange(len(loads))
    tension, where = np.zeros(len(loads)), h[lowest]
    inside = (loads[laws, lowest] < 0.0) & (lowest > 0) & (lowest < _STEPS - 1)
    tension[~inside] = np.maximum(-loads[laws, lowest], 0.0)[~inside]
    if inside.any():
        from scipy.optimize.elementwise import find_minimum

        law, at = laws[inside], lowest[inside]

        def load(x, law):
            return problem.loads(x.ravel(), law.ravel().astype(int)).reshape(x.shape)

        found = find_minimum(load, (h[at + 1], h[at], h[at - 1]), args=(law.astype(float),))
        tension[inside], where[inside] = -found.f_x, found.x
    return h, loads, tension, where


def separations_at(problem: Problem, targets: np.ndarray) -> Inversion:
    """The separations at which each law carries each load (n, m), per asperity and normalised.

    Of several, the first that is met when the surfaces approach from their largest tension (from afar, if there is none):
    that is the stable branch under a given load. The root is bracketed on a grid and found by Chandrupatla's method.
    Raises Unreachable for a load that is nowhere carried.
    """
    from scipy.optimize.elementwise import find_root

    h, loads, tension, where = _approach(problem)
    start = np.where(tension > 0.0, np.searchsorted(-h, -where, side="right"), 0)  # the first grid point nearer
    nearer = np.arange(_STEPS) >= start[:, None]
    reached = nearer[:, None, :] & (loads[:, None, :] >= targets[:, :, None])
    first = np.argmax(reached, axis=2)
    lowest = np.where(tension > 0.0, -tension, loads[:, 0])
    highest = np.where(nearer, loads, -np.inf).max(axis=1)
    carried = reached.any(axis=2) & (targets >= lowest[:, None])
    if not carried.all():
        law, at = np.argwhere(~carried)[0]
        raise Unreachable(law, at, lowest[law], highest[law])
    left = np.where(first == start[:, None], np.where(tension > 0.0, where, _FAR)[:, None], h[np.maximum(first - 1, 0)])
    law = np.broadcast_to(np.arange(len(loads))[:, None], targets.shape)

    def excess(x, law, target):
        return problem.loads(x.ravel(), law.ravel().astype(int)).reshape(x.shape) - target

    found = find_root(excess, (h[first], left), args=(law.astype(float), targets))
    if not found.success.all():
        raise ArithmeticError(f"{np.sum(~found.success)} of {targets.size} separations did not converge")
    scale = np.where(targets == 0.0, 1.0, np.abs(targets))
    return Inversion(found.x, found.f_x / scale, int(np.max(found.nfev)))
