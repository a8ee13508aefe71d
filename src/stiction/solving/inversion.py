"""From a load to the mean separation that carries it, and the largest tension that a contact carries."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from stiction.engine.summation import FARTHEST
from stiction.solving.problem import Problem

# Separations searched first, the last far beyond any model's claim; and on, where heights or adhesion reach farther, by
# factors: twelve steps double.
_FIRST = np.linspace(10.0, -10.0, 161)
_BEYOND = 2.0 ** (np.arange(1, 13) / 12.0)
_AT_ONCE = 10_000  # laws at once: bounds the memory
# Out of touch: less than this share of the largest load. No tension: less than this share, as of heights beyond nine sigma.
_NOTHING, _NO_TENSION = 1e-12, 1e-20


class Unreachable(Exception):
    """A load that a contact nowhere carries. law and at: which; low and high: what it does carry, normalised; without
    adhesion low is 0, and not carried."""

    def __init__(self, law: int, at: int, low: float, high: float):
        super().__init__(law, at, low, high)
        self.law, self.at, self.low, self.high = law, at, low, high


@dataclass(frozen=True)
class Inversion:
    """What n contacts carry, at m loads, per asperity and normalised.

    h (n, m): separations; residual (n, m): what is left of the load, over the load, or over the largest tension where the load
    is nothing beside it; evaluations: at most. tension (n,): the largest that is carried, on the branch of the problem, 0 where
    there is none; where (n,): the separation at which, else not a number.
    """

    h: np.ndarray
    residual: np.ndarray
    evaluations: int
    tension: np.ndarray
    where: np.ndarray


def pull_off(problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """Largest tension per asperity (n,), 0 where there is none, and the separation (n,) at which, else not a number.

    On the branch of the problem. Source: the minimum of the load over separation (Fuller & Tabor 1975).
    """
    ways = [_approach(problem.with_groups(rows), None) for rows in _blocks(problem)]
    return np.concatenate([way.tension for way in ways]), np.concatenate([way.where for way in ways])


def separations_at(problem: Problem, targets: np.ndarray) -> Inversion:
    """The separations at which each law carries each load (n, m), per asperity and normalised.

    Of several, the first that is met when the surfaces approach from their largest tension (from afar, if there is none):
    that is the stable branch under a given load. The root is bracketed on a grid and found by Chandrupatla's method.
    Raises Unreachable for a load that is nowhere carried.
    """
    parts = []
    for rows in _blocks(problem):
        way = _approach(problem.with_groups(rows), targets[rows])
        try:
            parts.append(_inverted(way, targets[rows]))
        except Unreachable as error:
            raise Unreachable(rows.start + error.law, error.at, error.low, error.high) from None
    h, residual, tension, where = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("h", "residual", "tension", "where")
    )
    return Inversion(h, residual, max(part.evaluations for part in parts), tension, where)


def _blocks(problem: Problem) -> list[slice]:
    return [slice(start, start + _AT_ONCE) for start in range(0, len(problem.groups), _AT_ONCE)]


@dataclass(frozen=True)
class _Approach:
    """Loads (n, H) of n laws at separations h (H,), from where nothing touches inwards; tension, where: as in Inversion."""

    problem: Problem
    h: np.ndarray
    loads: np.ndarray
    tension: np.ndarray
    where: np.ndarray


def _approach(problem: Problem, targets: np.ndarray | None) -> _Approach:
    """The way together, from farther than where the smallest of the loads `targets` (n, m) is carried."""
    h, loads, size = _loads_past(problem, targets)
    load = _load_of(problem)
    tension, where = largest_tension(load, np.broadcast_to(h, loads.shape), loads)
    if problem.heights.tops.size:
        near = _below_tops(problem)
        more, at = largest_tension(load, near, load(near, np.arange(len(near))[:, None]))
        larger = more > tension
        tension[larger], where[larger] = more[larger], at[larger]
    nothing = tension <= _NO_TENSION * size
    tension[nothing], where[nothing] = 0.0, np.nan
    return _Approach(problem, h, loads, tension, where)


def _load_of(problem: Problem) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """load(h, law): at any separations, of the laws of these numbers, which broadcast to them."""

    def load(h: np.ndarray, law: np.ndarray) -> np.ndarray:
        return problem.loads(h.ravel(), np.broadcast_to(law.astype(int), h.shape).ravel()).reshape(h.shape)

    return load


def _below_tops(problem: Problem) -> np.ndarray:
    """Separations (n, m), descending, about the tops of the heights, where a few asperities adhere before many press: they do
    so over a distance of theta^(-2/3)."""
    scale = problem.groups.theta ** (-2.0 / 3.0)
    steps = 2.0 ** np.arange(-3.0, 6.0, 0.25)
    about = np.concatenate([steps[::-1], [0.0], -steps])
    places = problem.heights.tops[None, :, None] + scale[:, None, None] * about
    return -np.sort(-places.reshape(len(scale), -1), axis=1)


def largest_tension(load: Callable, h: np.ndarray, loads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Largest tension (n,), 0 where there is none, and where it is (n,), else not a number.

    load(h, law): of the laws of these numbers, elementwise; loads (n, H): at the places h (n, H), in order. Between the two
    beside the lowest of them the minimum is found.
    """
    laws = np.arange(len(loads))
    lowest = np.argmin(loads, axis=1)
    tension = np.maximum(-loads[laws, lowest], 0.0)
    where = np.where(tension > 0.0, h[laws, lowest], np.nan)
    inside = (tension > 0.0) & (lowest > 0) & (lowest < h.shape[1] - 1)
    if inside.any():
        from scipy.optimize.elementwise import find_minimum

        law, at = laws[inside], lowest[inside]
        bracket = np.sort([h[law, at + beside] for beside in (-1, 0, 1)], axis=0)
        found = find_minimum(load, tuple(bracket), args=(law.astype(float),))
        tension[inside], where[inside] = -found.f_x, found.x
    return tension, where


def _loads_past(problem: Problem, targets: np.ndarray | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Separations (H,), descending, and loads (n, H): from where next to nothing touches, and less than the smallest of the
    targets is carried, to far beyond any model's claim, and where compression outweighs all tension; and the size (n,) of
    loads, which does not depend on how far that is."""
    h, loads = _FIRST, problem.loads_on_grid(_FIRST)
    size = np.abs(loads).max(axis=1)
    load, laws = _load_of(problem), np.arange(len(loads))[:, None]
    smallest = np.full(len(loads), np.inf)
    if targets is not None:
        smallest = np.where(targets > 0.0, targets, np.inf).min(axis=1, initial=np.inf)

    def more(ends: np.ndarray) -> np.ndarray:
        return load(np.broadcast_to(ends, (len(laws), ends.size)), laws)

    while h[0] < FARTHEST and _touches(loads, size, smallest).any():
        farther = np.minimum(h[0] * _BEYOND[::-1], FARTHEST)
        h, loads = np.concatenate([farther, h]), np.concatenate([more(farther), loads], axis=1)
    while -h[-1] < FARTHEST and (loads[:, -1] < -loads.min(axis=1)).any():
        nearer = np.maximum(h[-1] * _BEYOND, -FARTHEST)
        h, loads = np.concatenate([h, nearer]), np.concatenate([loads, more(nearer)], axis=1)
    return h, loads, size


def _touches(loads: np.ndarray, size: np.ndarray, smallest: np.ndarray) -> np.ndarray:
    """Where (n,) something worth mention touches at the farthest separation, or the largest tension may lie beyond."""
    farthest = loads[:, 0]
    tension = (farthest < -_NO_TENSION * size) & (np.argmin(loads, axis=1) == 0)
    return (np.abs(farthest) > _NOTHING * size) | tension | (farthest >= smallest)


def _inverted(way: _Approach, targets: np.ndarray) -> Inversion:
    """Separations of the loads (n, m) on a way past them; as `separations_at`."""
    from scipy.optimize.elementwise import find_root

    h, loads, adheres = way.h, way.loads, way.tension > 0.0
    start = np.where(adheres, np.searchsorted(-h, -way.where, side="right"), 1)  # the first grid point nearer
    nearer = np.arange(h.size) >= start[:, None]
    reached = nearer[:, None, :] & (loads[:, None, :] >= targets[:, :, None])
    first = np.argmax(reached, axis=2)
    carried = reached.any(axis=2) & np.where(adheres[:, None], targets >= -way.tension[:, None], targets > 0.0)
    if not carried.all():
        law, at = np.argwhere(~carried)[0]
        raise Unreachable(law, at, -way.tension[law], np.where(nearer, loads, -np.inf).max(axis=1)[law])
    left = np.where(adheres[:, None] & (first == start[:, None]), way.where[:, None], h[first - 1])
    law = np.broadcast_to(np.arange(len(loads))[:, None], targets.shape)
    load = _load_of(way.problem)

    def excess(x, law, target):
        return load(x, law) - target

    found = find_root(excess, (h[first], left), args=(law.astype(float), targets))
    if not found.success.all():
        raise ArithmeticError(f"{np.sum(~found.success)} of {targets.size} separations did not converge")
    # A load that is nothing beside the largest tension is as good as that.
    least = _NOTHING * way.tension[:, None]
    scale = np.where(np.abs(targets) > least, np.abs(targets), np.where(adheres, way.tension, 1.0)[:, None])
    return Inversion(found.x, found.f_x / scale, int(np.max(found.nfev)), way.tension, way.where)
