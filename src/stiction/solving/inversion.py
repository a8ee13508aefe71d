"""Find the mean separation at which a contact carries a given load, and the largest tension that the contact carries.

Separations are in units of sigma, the standard deviation of the heights. Loads are per asperity and normalised.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stiction.engine.blocks import blocks
from stiction.engine.heights import gaussian_density
from stiction.engine.starting_separations import NO_TENSION, NOTHING
from stiction.engine.summation import FARTHEST
from stiction.solving.closed_form import ClosedFormProblem
from stiction.solving.problem import LOAD, AsperitySum, Problem

# Separations that are searched first; the last is far beyond the range of any model. If heights or adhesion reach farther, the
# search goes on by these factors, which double a separation in twelve steps.
_FIRST = np.linspace(10.0, -10.0, 161)
_BEYOND = 2.0 ** (np.arange(1, 13) / 12.0)
_WAY_POINTS = 16  # memory that the search needs for each contact, as a number of points; half a block is then 12,500 contacts
# A root needs no further step if its load error is below _LEFT times the load, or below _ROUNDING times the sum of the absolute
# values of the terms of the load. After _STEPS steps at most, it is accepted if its load error is at most _GOOD times this
# bound.
_LEFT, _ROUNDING, _GOOD, _STEPS = 1e-14, 5e-16, 10.0, 3
# For theories in closed form: ratio of the two loads from which the slope is estimated, and largest number of evaluations.
_RATIO, _MOST = 1.01, 7


class Unreachable(Exception):
    """Report a load that a contact does not carry at any separation.

    law: index of the contact. at: index of the load. low, high: smallest and largest load that the contact carries,
    normalised; tension is negative. If the contact carries no tension, low is 0, but the load 0 itself is not carried.
    """

    def __init__(self, law: int, at: int, low: float, high: float):
        super().__init__(law, at, low, high)
        self.law, self.at, self.low, self.high = law, at, low, high


@dataclass(frozen=True)
class Inversion:
    """Store the separations at which n contacts carry m loads each.

    h (n, m): separations in units of sigma, NaN for loads that are not carried. residual (n, m): load error divided by the
    load, or by the largest tension if the load is negligible. tension (n,): largest tension on the branch of the problem
    (loading or unloading), normalised; 0 if the contact carries no tension. where (n,): separation of the largest tension,
    NaN if there is no tension. evaluations: largest number of evaluations for one root.
    """

    h: np.ndarray
    residual: np.ndarray
    tension: np.ndarray
    where: np.ndarray
    evaluations: int = 0

    def with_rows(self, rows: np.ndarray, found: "Inversion") -> "Inversion":
        """Copy the separations of some contacts into these arrays, in place, and return the whole inversion.

        rows: indices of these contacts. found: their separations.
        """
        for name in _ARRAYS:
            getattr(self, name)[rows] = getattr(found, name)
        return replace(self, evaluations=max(self.evaluations, found.evaluations))


_ARRAYS = ("h", "residual", "tension", "where")


def pull_off(problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest tension per asperity (n,), normalised, and its separation (n,), in units of sigma.

    The tension is 0, and the separation NaN, for contacts that carry no tension. Only the branch of the problem (loading or
    unloading) is searched. Source: the largest tension is minus the minimum of the load as a function of separation (Fuller
    & Tabor 1975).
    """
    if isinstance(problem, AsperitySum) and problem.heights.density is gaussian_density and len(problem.groups) == 1:
        tension, where, holds = problem.largest_tension
        if holds.all():
            return tension, where
    inversion = separations_at(problem, np.empty((len(problem.groups), 0)))
    return inversion.tension, inversion.where


def separations_at(problem: Problem, targets: np.ndarray, refuse: bool = True) -> Inversion:
    """Find the separations at which n contacts carry the normalised loads `targets` (n, m).

    A load may be carried at several separations. On approach, the first separation after the largest tension is stable under a
    given load and is returned. For sums over Gaussian heights, estimates are refined with the sums over asperities. Theories in
    closed form that provide an estimate use the secant method. In other cases, and if these methods fail, the root is bracketed
    on a grid and found by Chandrupatla's method. Raises Unreachable for a load that cannot be carried; with refuse=False its
    separation is NaN.
    """
    return _whole([inversion for inversion, _, _ in _by_blocks(problem, targets, refuse)])


def solved_at(problem: Problem, targets: np.ndarray, refuse: bool = True) -> tuple[Inversion, dict[str, np.ndarray]]:
    """Find the separations at which contacts carry normalised loads `targets` (n, m), and the results (n, m) there.

    A load that cannot be carried raises Unreachable. With refuse=False its separation is NaN and its results are those at
    separation 0. The results use the sums that the search computed last at these separations, if it did.
    """
    parts, tables = [], []
    for inversion, sums, some in _by_blocks(problem, targets, refuse):
        h = np.where(np.isnan(inversion.h), 0.0, inversion.h)
        tables.append(some.at(h) if sums is None else some.with_sums(h, sums))
        parts.append(inversion)
    return _whole(parts), {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}


def _by_blocks(problem: Problem, targets: np.ndarray, refuse: bool) -> Iterator[tuple[Inversion, np.ndarray | None, Any]]:
    """Find separations as `separations_at` does, and yield (inversion, sums, problem) for each block of contacts.

    sums (regimes, n, m, 5): sums over asperities at the separations, NaN where the search did not compute them, or None if
    it computed none. problem: the problem of this block alone.
    """
    for rows in blocks(len(problem.groups), max(targets.shape[1], _WAY_POINTS)):
        some = problem.with_groups(rows)
        try:
            yield *_of_block(some, targets[rows], refuse), some
        except Unreachable as error:
            error.law += rows.start
            raise


def _whole(parts: list[Inversion]) -> Inversion:
    h, residual, tension, where = (np.concatenate([getattr(part, name) for part in parts]) for name in _ARRAYS)
    return Inversion(h, residual, tension, where, max(part.evaluations for part in parts))


def _of_block(problem: Problem, targets: np.ndarray, refuse: bool) -> tuple[Inversion, np.ndarray | None]:
    """Find separations as `separations_at` does, for one block of contacts; return the inversion and the sums over asperities.

    The separations of a contact are found by bracketing if the fast method fails. The returned sums (regimes, n, m, 5) are NaN
    at separations where they were not computed, and None in place of the array if none were computed.
    """
    sums = None
    if isinstance(problem, ClosedFormProblem) and problem.record.separation_near is not None:
        quick, good = _from_tables(problem, targets)
    elif isinstance(problem, AsperitySum) and problem.heights.density is gaussian_density:
        quick, good, sums = _quickly(problem, targets)
    else:
        return _robustly(problem, targets, refuse), None
    rest = np.flatnonzero(~good)
    if not rest.size:
        return quick, sums
    try:
        slow = _robustly(problem.with_groups(rest), targets[rest], refuse)
    except Unreachable as error:
        error.law = rest[error.law]
        raise
    if sums is not None:
        sums[:, rest] = np.nan
    return quick.with_rows(rest, slow), sums


def _quickly(problem: AsperitySum, targets: np.ndarray) -> tuple[Inversion, np.ndarray, np.ndarray]:
    """Find the separations at the loads `targets` (n, m) with the fast method for Gaussian heights.

    Returns three values: the separations with their residuals, as an `Inversion`; a mask (n,) of the contacts for which the
    method succeeded; and the sums over asperities (regimes, n, m, 5) at these separations, NaN where they were not computed.
    The five sums are fraction touching, load, area, slip-limited and yield-limited resistance.
    """
    start, (tension, where, holds) = problem.approach.starts(targets), problem.largest_tension
    carried = np.where((tension > 0.0)[:, None], targets >= -tension[:, None], targets > 0.0)
    known = carried & np.isfinite(start.h) & holds[:, None]
    h, excess, law = start.h, np.full(targets.shape, np.nan), np.nonzero(known)[0]
    sums, every = problem.sums_at(np.where(known, h, 0.0)), known.all()
    target, slope = targets[known], start.slope[known]
    enough = np.maximum(_LEFT * np.abs(target), _ROUNDING * start.size[known])
    flat = (
        sums.reshape(len(sums), target.size, sums.shape[-1]) if every else sums[:, known]
    )  # a view, because a copy takes as long as sums
    h[known], excess[known], evaluations = _polished(problem, law, h[known], flat, target, slope, enough)
    if not every:
        sums[:, known], sums[:, ~known] = flat, np.nan
    good = holds & ~np.isnan(excess).any(axis=1)
    return Inversion(h, _relative(excess, targets, tension), tension.copy(), where.copy(), evaluations), good, sums


def _polished(problem: AsperitySum, law, h, sums, target, slope, enough) -> tuple[np.ndarray, np.ndarray, int]:
    """Refine the separations h (k,), in units of sigma, by Newton's method with a known derivative of the load.

    law, target, slope, enough (k,): index of the contact, requested load, derivative of the load with respect to the
    separation, and load error at which no further step is needed. sums (regimes, k, 5): sums over asperities at the separations
    h; they are overwritten with those at the refined separations. Returns the refined separations, their load errors (NaN if
    too large), and the number of evaluations.
    """
    times, excess = 1, sums[..., LOAD].sum(axis=0) - target
    while times <= _STEPS and (some := np.flatnonzero(np.abs(excess) > enough)).size:
        ahead = np.divide(excess[some], slope[some], where=slope[some] != 0.0, out=np.zeros(some.size))
        further = h[some] - ahead
        there = problem.sums(further, law[some])
        left = there[..., LOAD].sum(axis=0) - target[some]
        better = np.abs(left) < np.abs(excess[some])
        h[some[better]], excess[some[better]] = further[better], left[better]
        sums[:, some[better]] = there[:, better]
        times += 1
    return h, np.where(np.abs(excess) <= _GOOD * enough, excess, np.nan), times


def _from_tables(problem: ClosedFormProblem, targets: np.ndarray) -> tuple[Inversion, np.ndarray]:
    """Find the separations at the loads `targets` (n, m) for a closed-form theory that provides an estimate of them.

    The theory has no adhesion. The secant method on the logarithm of the load starts from the estimate. Returns the inversion,
    and a mask (n,) of the contacts for which the method succeeded.
    """
    laws = len(targets)
    near, nearer = problem.near(targets), problem.near(targets * _RATIO)
    law, at = np.nonzero(np.isfinite(near) & np.isfinite(nearer) & (targets > 0.0))
    target, x = targets[law, at], near[law, at]
    rate = (nearer[law, at] - x) / math.log(_RATIO)
    left = _log_of(problem.loads(x, law) / target)
    best, least, evaluations = x.copy(), left.copy(), 1
    while evaluations < _MOST and (some := np.flatnonzero(np.isfinite(left) & (np.abs(least) > 2.0 * _LEFT))).size:
        before, was = x[some], left[some]
        x[some] = before - np.clip(rate[some] * was, -1.0, 1.0)
        left[some] = _log_of(problem.loads(x[some], law[some]) / target[some])
        rise = left[some] - was
        rate[some] = np.divide(x[some] - before, rise, where=np.abs(rise) > _GOOD * _LEFT, out=rate[some])
        better = np.abs(left) < np.abs(least)
        best[better], least[better] = x[better], left[better]
        evaluations += 1
    h, residual = np.full((2, *targets.shape), np.nan)
    found = (np.abs(least) <= _GOOD * _LEFT) & (best >= _FIRST[-1])
    h[law[found], at[found]], residual[law[found], at[found]] = best[found], np.expm1(least[found])
    return Inversion(h, residual, np.zeros(laws), np.full(laws, np.nan), evaluations), ~np.isnan(h).any(axis=1)


def _log_of(values: np.ndarray) -> np.ndarray:
    """Return the natural logarithm of an array; minus infinity where a value is 0."""
    with np.errstate(divide="ignore"):
        return np.log(values)


def _relative(excess: np.ndarray, targets: np.ndarray, tension: np.ndarray) -> np.ndarray:
    """Return load errors (n, m), each divided by the size of the load, or by the largest tension if the load is negligible.

    If both are 0, the error is not divided. excess, targets (n, m): load errors and loads. tension (n,): largest tensions.
    """
    tension = tension[:, None]
    scale = np.where(np.abs(targets) > NOTHING * tension, np.abs(targets), np.where(tension > 0.0, tension, 1.0))
    return excess / scale


def _robustly(problem: Problem, targets: np.ndarray, refuse: bool) -> Inversion:
    """Find separations as `separations_at` does, for any law, by brackets on a grid of separations."""
    h, loads, size = _loads_past(problem, targets)
    tension, where = _tension_past(problem, h, loads, size)
    if not targets.size:
        return Inversion(targets.copy(), targets.copy(), tension, where)
    adheres = tension > 0.0
    start = np.where(adheres, np.searchsorted(-h, -where, side="right"), 1)  # first grid point below the largest tension
    nearer = np.arange(h.size) >= start[:, None]
    reached = nearer[:, None, :] & (loads[:, None, :] >= targets[:, :, None])
    first = np.argmax(reached, axis=2)
    carried = reached.any(axis=2) & np.where(adheres[:, None], targets >= -tension[:, None], targets > 0.0)
    if refuse and not carried.all():
        law, at = np.argwhere(~carried)[0]
        raise Unreachable(law, at, -tension[law], np.where(nearer, loads, -np.inf).max(axis=1)[law])
    left = np.where(adheres[:, None] & (first == start[:, None]), where[:, None], h[first - 1])
    separation, excess = np.full((2, *targets.shape), np.nan)
    bracket = h[first][carried], left[carried]
    separation[carried], excess[carried], evaluations = _roots(problem, np.nonzero(carried)[0], targets[carried], bracket)
    return Inversion(separation, _relative(excess, targets, tension), tension, where, evaluations)


def _tension_past(problem: Problem, h: np.ndarray, loads: np.ndarray, size: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the largest tension (n,) and its separation (n,) from loads on a grid; 0 and NaN for contacts without tension.

    h (H,): descending separations in units of sigma. loads (n, H): loads at these separations. size (n,): scale of the loads; a
    tension that is tiny in comparison is a round-off error. Separations near the upper ends of the heights may be searched too.
    """
    tension, where = largest_tension(problem.load_at, np.broadcast_to(h, loads.shape), loads)
    if problem.heights.tops.size and (problem.groups.theta is not None or problem.groups.meniscus_height is not None):
        near = _below_tops(problem)
        more, at = largest_tension(problem.load_at, near, problem.load_at(near, np.arange(len(near))[:, None]))
        larger = more > tension
        tension[larger], where[larger] = more[larger], at[larger]
    nothing = tension <= NO_TENSION * size
    tension[nothing], where[nothing] = 0.0, np.nan
    return tension, where


def _below_tops(problem: Problem) -> np.ndarray:
    """Return descending separations (n, m) in units of sigma, near the highest asperities, where the largest tension may lie.

    At these separations a few asperities adhere before many are compressed. The separations span multiples of theta^(-2/3)
    (theta: adhesion index). With menisci they also span multiples of the meniscus height and of the distance at which
    compression overcomes the pull.
    """
    groups = problem.groups
    steps = 2.0 ** np.arange(-3.0, 6.0, 0.25)
    about = np.concatenate([steps[::-1], [0.0], -steps])
    indices = [index for index in (groups.theta, groups.meniscus_index) if index is not None]
    heights = [] if groups.meniscus_height is None else [groups.meniscus_height]
    scales = [index ** (-2.0 / 3.0) for index in indices] + heights
    places = [problem.heights.tops[None, :, None] + scale[:, None, None] * about for scale in scales]
    every = np.concatenate([table.reshape(len(groups), -1) for table in places], axis=1)
    return -np.sort(-every, axis=1)


def largest_tension(load: Callable, h: np.ndarray, loads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the largest tension (n,) and its separation (n,) from loads on a grid; 0 and NaN if no load is negative.

    load(h, law): function that returns the loads of the contacts with the indices `law` at the separations h, element by
    element. h, loads (n, H): ordered separations and the loads at them. The minimum of the load is located between the two
    neighbours of the lowest load.
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
        minimum = find_minimum(load, tuple(bracket), args=(law.astype(float),))
        tension[inside], where[inside] = -minimum.f_x, minimum.x
    return tension, where


def _loads_past(problem: Problem, targets: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return descending separations (H,) in units of sigma, the loads (n, H) at them, and the scale (n,) of the loads.

    The separations start where the load is below the smallest of `targets` (n, m) and almost nothing touches. They end at
    -10, or where compression exceeds all tension. For sparse asperities of nearly equal heights they extend further, until
    the largest target is carried or the asperities would fill the nominal area. The scale does not depend on this range.
    """
    h, loads = _FIRST, problem.loads_on_grid(_FIRST)
    size = np.abs(loads).max(axis=1)
    laws = np.arange(len(loads))[:, None]
    smallest = np.where(targets > 0.0, targets, np.inf).min(axis=1, initial=np.inf)

    def more(ends: np.ndarray) -> np.ndarray:
        return problem.load_at(np.broadcast_to(ends, (len(laws), ends.size)), laws)

    while h[0] < FARTHEST and _touches(loads, size, smallest).any():
        farther = np.minimum(h[0] * _BEYOND[::-1], FARTHEST)
        h, loads = np.concatenate([farther, h]), np.concatenate([more(farther), loads], axis=1)
    largest, deepest = targets.max(axis=1, initial=0.0), _deepest(problem)

    def enough() -> np.ndarray:
        """Return the load (n,) to which the separations must reach: the tension found so far, or the largest target."""
        return np.maximum(-loads.min(axis=1), np.where(-h[-1] < deepest, largest, 0.0))

    while -h[-1] < FARTHEST and (loads[:, -1] < enough()).any():
        nearer = np.maximum(h[-1] * _BEYOND, -FARTHEST)
        h, loads = np.concatenate([h, nearer]), np.concatenate([loads, more(nearer)], axis=1)
    return h, loads, size


def _deepest(problem: Problem) -> np.ndarray | float:
    """Return the largest depth -h, in units of sigma, at which a load is searched for, as an array (n,) or a number.

    An asperity pressed by delta touches the area pi R delta/2 or more, so N asperities per area fill the plane when pressed by
    2/(pi N R) (R: asperity radius). For listed heights, which may be nearly equal, the result is FARTHEST. It is 0 if the
    asperity density is unknown or the model does not sum over asperities.
    """
    density = problem.groups.roughness_parameter  # N R sigma
    if problem.heights.listed.size:
        return FARTHEST
    return 0.0 if not isinstance(problem, AsperitySum) or density is None else 2.0 / (math.pi * density)


def _touches(loads: np.ndarray, size: np.ndarray, smallest: np.ndarray) -> np.ndarray:
    """Return a mask (n,) of contacts that still touch at the largest separation, which is the first column of `loads` (n, H).

    They touch if their load at this separation is not negligible, if it is at least the smallest target, or if their largest
    tension may lie at larger separations. size: scale (n,) of the loads. smallest: smallest target (n,).
    """
    farthest = loads[:, 0]
    tension = (farthest < -NO_TENSION * size) & (np.argmin(loads, axis=1) == 0)
    return (np.abs(farthest) > NOTHING * size) | tension | (farthest >= smallest)


def _roots(problem: Problem, law: np.ndarray, targets: np.ndarray, bracket: tuple) -> tuple[np.ndarray, np.ndarray, int]:
    """Find the separations (k,) within brackets at which contacts carry loads; return them with load errors and evaluations.

    law: indices (k,) of the contacts. targets: loads (k,). bracket: lower and upper separations, (k,) each. The last value is
    the largest number of evaluations for one root. Raises ArithmeticError if a root does not converge.
    """
    from scipy.optimize.elementwise import find_root

    if not targets.size:
        return targets.copy(), targets.copy(), 0

    def excess(x, law, target):
        return problem.load_at(x, law) - target

    root = find_root(excess, bracket, args=(law.astype(float), targets))
    if not root.success.all():
        raise ArithmeticError(f"{np.sum(~root.success)} of {targets.size} separations did not converge")
    return root.x, root.f_x, int(np.max(root.nfev))
