"""Average the errors of a model over solved surfaces, weighted by their distance from a contact.

A surface at distance d has the weight exp(-d^2/2). The weight also fades where the surface was solved only on one
side of the pressure or hardness, or where the model has no result on one side, so that the average has no jumps.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from stiction.solving.accuracy.solved_near import (
    Difference,
    Place,
    differences,
    film_differences,
    nearest_in_words,
    pressure_difference,
    squared_distance,
)
from stiction.solving.accuracy.solved_set import SolvedSet

ELASTIC = 3.0  # hardness over E* h' from which on nothing flows
LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)  # of the quantiles that are kept
NORMAL_SCORES = (-1.6449, -0.6745, 0.0, 0.6745, 1.6449)  # of a normal number at LEVELS, in standard deviations
# Times the lightest pressure: how errors change up to there is how they go on below, down to one over the second, to which it
# was solved (truth/light.csv: as far on smooth plateaus and skewed surfaces, a third as far on plateaus that are rough again).
_SLOPE, _FARTHEST = 5.0, 16.0
_STEEP = 0.3  # change of ln of area over load with ln of the pressure, on plateaus without roughness of their own
_FLOWS = 0.1  # hardness over E* h' at which spots flow as much as not
_COUNTED = 0.1  # of the weight of the nearest, from which on a surface counts as near


class ErrorsNear(NamedTuple):
    """Hold the errors of ln(A/solved A) at k points.

    levels: quantiles (k, 5) at LEVELS over the nearby solved surfaces; relative: root mean square of A/solved A - 1;
    middle: mean of the logarithm over nearby surfaces of the stated kind, or over Gaussian surfaces if neither map nor
    kind is stated; distance: distance of the nearest surface; told: share of the total weight on surfaces where the
    model has a result; surfaces: number of surfaces with a noticeable weight; nearest: the feature in which the nearest
    surface differs most.
    """

    levels: np.ndarray
    relative: np.ndarray
    middle: np.ndarray
    distance: np.ndarray
    told: np.ndarray
    surfaces: np.ndarray
    nearest: np.ndarray


def bare_errors(known: SolvedSet, column: str, place: Place, anywhere: bool) -> ErrorsNear | None:
    """Return the errors of a model on surfaces without a film; None if the model was not measured.

    anywhere: True for a solution of the map, which is equally good on any surface. Then only the pressure decides how
    near a solved surface is.
    """
    errors = known.errors(column)
    if errors is None:
        return None
    return _together([_at_point(known, errors, place, at, anywhere) for at in range(place.pressure.size)])


def film_errors_near(known: SolvedSet, errors: np.ndarray, place: Place, like: np.ndarray) -> ErrorsNear:
    """Return the errors near each point from an array of errors (coated surfaces, films, loads).

    like: mask (k,) of the points whose film is of the kind that the benchmark set contains.
    """
    return _together([_film_point(known, errors, place, at) if like[at] else _NONE for at in range(place.pressure.size)])


def quantiles(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Return the quantiles at LEVELS of weighted values, by linear interpolation."""
    order = np.argsort(values)
    middles = np.cumsum(weights[order]) - 0.5 * weights[order]
    return np.interp(LEVELS, middles / weights.sum(), values[order])


def _together(rows: list[tuple]) -> ErrorsNear:
    return ErrorsNear(*(np.array(values) for values in zip(*rows, strict=True)))


_NONE = (np.full(len(LEVELS), math.nan), math.nan, math.nan, math.inf, 0.0, 0, "")


def _at_point(known: SolvedSet, errors: np.ndarray, place: Place, at: int, anywhere: bool):
    pressure, hardness = float(place.pressure[at]), float(place.hardness[at])
    if not (pressure > 0.0 and hardness > 0.0):
        return _NONE
    of_pressure, inside, solved_hardness = pressure_difference(known, pressure, hardness)
    found, there = _between(known, errors, inside, solved_hardness)
    if of_pressure.ours < of_pressure.theirs[0]:
        times = float(of_pressure.theirs[0] / of_pressure.ours)
        found, real = _at_lighter_load(known, errors, found, times, inside, solved_hardness)
        there = there * real
    found = found * min(hardness / solved_hardness, 1.0)  # softer than what was solved: areas tend to load over hardness
    hardness = solved_hardness
    _, solved = _between(known, known.areas, inside, hardness)
    asked = np.where(np.isfinite(errors).any(axis=(1, 2)), solved, 0.0)  # of which the model says anything at all
    of_kind = known.of_kind(None if anywhere else place.kind)
    there, asked = there * of_kind, asked * of_kind
    apart = [*([] if anywhere else differences(known, place, at)), of_pressure]
    presumed = of_kind if place.kind_known or anywhere else known.gaussian
    return _averaged(found, there, asked, apart, presumed)


def _at_lighter_load(known: SolvedSet, errors: np.ndarray, found: np.ndarray, times: float, lightest: float, hardness: float):
    """Extrapolate errors (s,) below the lightest solved pressure; return them with the weight (s,) of each surface.

    times: lightest solved pressure over the pressure of the contact. On elastic surfaces the error continues linearly
    in ln of the pressure. On surfaces that flow it fades with the square root of the pressure, because the finest
    roughness of a plateau flows too. A surface whose error changes fast has smooth plateaus, while real plateaus are
    rough and carry light loads: such a surface loses weight as the load decreases. Both rules are judgements of the
    authors (grade C).
    """
    elastic = 1.0 / (1.0 + (_FLOWS / min(hardness, ELASTIC)) ** 2)
    heavier, _ = _between(known, errors, _SLOPE * lightest, hardness)
    slope = np.nan_to_num(found - heavier) / math.log(_SLOPE)
    farther = math.log(times) / math.log(_FARTHEST)
    real = np.minimum(_STEEP / np.maximum(np.abs(slope), 1e-9), 1.0) ** (2.0 * elastic * farther)
    going_on = found + elastic * slope * math.log(_FARTHEST) * min(farther, 1.0)
    return going_on * times ** (-0.5 * (1.0 - elastic)), real


def _film_point(known: SolvedSet, errors: np.ndarray, place: Place, at: int):
    if not place.pressure[at] > 0.0:
        return _NONE
    apart, loads = film_differences(known, place, at), known["film_loads"]
    found = np.empty(loads.shape[:2])
    for one in np.ndindex(*found.shape):
        found[one] = np.interp(math.log(place.pressure[at]), np.log(loads[one]), errors[one])
    gaussian, of_kind = (
        np.broadcast_to(one[known["film_surfaces"], None], found.shape) for one in (known.gaussian, known.of_kind(place.kind))
    )
    presumed = of_kind if place.kind_known else gaussian
    there = np.isfinite(found) * of_kind.astype(float)
    return _averaged(found.ravel(), there.ravel(), of_kind.astype(float).ravel(), apart, presumed.ravel())


def _averaged(found: np.ndarray, there: np.ndarray, asked: np.ndarray, apart: list[Difference], presumed: np.ndarray):
    """Return one row of ErrorsNear.

    there, asked: weights (0 to 1) of the surfaces where the model has a result, and of all solved surfaces; apart:
    differences that add up to the squared distances; presumed: mask of the surfaces over which `middle` is averaged.
    """
    squared = np.where(asked > 0.0, squared_distance(apart).ravel(), np.inf)
    if not np.isfinite(squared).any():
        return _NONE
    weights = np.exp(-0.5 * (squared - squared.min()))
    told = float(np.sum(weights * there) / np.sum(weights * asked))
    mine = there > 0.0
    if not (mine & presumed).any():
        return *_NONE[:3], math.sqrt(float(squared.min())), 0.0, 0, nearest_in_words(apart, int(np.argmin(squared)))
    at = int(np.argmin(np.where(mine, squared, np.inf)))
    count = int(np.count_nonzero(mine & (weights > _COUNTED)))
    weights = weights * there
    ends = quantiles(found[mine], weights[mine])
    relative = math.sqrt(float(np.average(np.expm1(found[mine]) ** 2, weights=weights[mine])))
    ranked = mine & presumed
    of_ranked = np.exp(-0.5 * (squared[ranked] - squared[ranked].min())) * there[ranked]
    middle = float(np.average(found[ranked], weights=of_ranked))
    return ends, relative, middle, math.sqrt(float(squared[at])), told, count, nearest_in_words(apart, at)


def _between(known: SolvedSet, table: np.ndarray, pressure: float, hardness: float) -> tuple[np.ndarray, np.ndarray]:
    """Interpolate a table (s, h, p) of the set at a pressure and a hardness; return values (s,) and weights (s,)."""
    hard = np.minimum(known["hardnesses"], ELASTIC)
    order = np.argsort(hard)

    def at_pressure(place: int) -> tuple[np.ndarray, np.ndarray]:
        column = table[:, order[place]]
        return _read_off(known["loads"], pressure, lambda at: (column[:, at], 1.0 * np.isfinite(column[:, at])), 1.0)

    return _read_off(hard[order], min(hardness, ELASTIC), at_pressure, 2.0)


def _read_off(grid: np.ndarray, place: float, column: Callable, fade: float) -> tuple[np.ndarray, np.ndarray]:
    """Interpolate linearly in the logarithm of an ascending grid; return values (s,) and weights (s,).

    column(index): values and weights at a grid point. A value known at one end of the interval only is used for the
    whole interval; its weight decreases with the distance from that end, by `fade` over the interval.
    """
    right = int(np.clip(np.searchsorted(grid, place), 1, len(grid) - 1))
    part = math.log(place / grid[right - 1]) / math.log(grid[right] / grid[right - 1])
    (lower, of_lower), (upper, of_upper) = column(right - 1), column(right)
    both = lower + part * (upper - lower)
    values = np.where(of_lower == 0.0, upper, np.where(of_upper == 0.0, lower, both))
    alone = np.maximum(of_lower * max(1.0 - fade * part, 0.0), of_upper * max(1.0 - fade * (1.0 - part), 0.0))
    return values, np.where(np.isfinite(values), np.maximum(np.minimum(of_lower, of_upper), alone), 0.0)
