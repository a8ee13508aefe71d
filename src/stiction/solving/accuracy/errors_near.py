"""Average the errors of a model over benchmark surfaces, weighted by their distance from a contact.

A surface at distance d has the weight exp(-d^2/2). On some surfaces the solution, or the result of the model, exists only above
or only below the pressure or hardness of the contact. The weight of these surfaces decreases gradually, so that the average
does not jump.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from typing import NamedTuple

import numpy as np

from stiction.engine.blocks import blocks
from stiction.solving.accuracy.benchmark_set import BenchmarkSet
from stiction.solving.accuracy.solved_near import (
    ContactFeatures,
    Difference,
    differences,
    film_differences,
    nearest_in_words,
    pressure_difference,
    squared_distance,
)

ELASTIC = 3.0  # hardness over E* h' above which no point flows plastically (h': rms slope)
LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)  # probabilities of the stored quantiles
NORMAL_SCORES = (-1.6449, -0.6745, 0.0, 0.6745, 1.6449)  # quantiles of the standard normal distribution at LEVELS
# Errors below the lightest solved pressure p are extrapolated with their slope between p and _SLOPE p, down to p/_FARTHEST.
# Some surfaces were solved down to p/_FARTHEST as a check (truth/light.csv). On smooth plateaus and skewed surfaces the error
# changes as extrapolated, and on rough plateaus by a third of the extrapolated change.
_SLOPE, _FARTHEST = 5.0, 16.0
_STEEP = 0.3  # slope of ln(area/load) by ln(pressure) above which a surface counts as having smooth plateaus
_FLOWS = 0.1  # hardness over E* h' at which a surface counts as half elastic and half plastic
_TABLES = 40  # numbers stored for each point and surface; they determine the size of blocks
_WINDOW = 0.03  # half-width of the range of probabilities over which a quantile is averaged
_COUNTED = 0.1  # a surface counts as near if its weight is at least this fraction of the weight of the nearest surface


class ErrorsNear(NamedTuple):
    """Store the errors of a model's contact area at k points, averaged over similar benchmark surfaces.

    A point is one contact at one load. The error is ln(A/A_ref), where A is the area by the model and A_ref the area by the
    reference solution. levels (k, 5): quantiles of the error at the probabilities LEVELS; levels, relative and middle are NaN
    where the model has no result. relative: root mean square of A/A_ref - 1. middle: mean of the error over surfaces of the
    specified kind, or over Gaussian surfaces if neither map nor kind is specified. distance: distance of the nearest surface.
    coverage: fraction of the total weight on surfaces for which the model has a result. surfaces: number of surfaces with a
    noticeable weight. nearest: for each point a function that returns a text on how the nearest surface differs, or "" if it
    hardly differs. All arrays but levels are (k,).
    """

    levels: np.ndarray
    relative: np.ndarray
    middle: np.ndarray
    distance: np.ndarray
    coverage: np.ndarray
    surfaces: np.ndarray
    nearest: np.ndarray


class _Table(NamedTuple):
    """Store values of s benchmark surfaces, for interpolation in ln(pressure) between p pressures.

    The arrays start, rise, weight and fall have the shape (h, p - 1, s) for h hardnesses. start, rise: value of each
    surface at the lower end of each pressure interval, and its change within the interval; a value known only at one end is
    used for the whole interval. weight, fall: weight at the lower end, and its change within the interval; the weight is 1
    at an end whose value is known, else 0. hard (h,): the hardnesses, ascending.
    """

    hard: np.ndarray
    start: np.ndarray
    rise: np.ndarray
    weight: np.ndarray
    fall: np.ndarray

    @classmethod
    def of(cls, known: BenchmarkSet, values: np.ndarray) -> "_Table":
        """Build the table from values (s, h, p) of s benchmark surfaces at h hardnesses and p pressures, NaN where unknown.

        known: the benchmark set, which holds the hardnesses.
        """
        hard = np.minimum(known["hardnesses"], ELASTIC)
        order = np.argsort(hard)
        values = np.ascontiguousarray(np.moveaxis(values[:, order], 0, -1))
        left, right = values[:, :-1], values[:, 1:]
        at_left, at_right = np.isfinite(left), np.isfinite(right)
        start = np.where(at_left, left, right)
        rise = np.where(at_right, right, left) - start
        return cls(hard[order], start, rise, 1.0 * at_left, 1.0 * at_right - at_left)

    def at(self, known: BenchmarkSet, pressure: np.ndarray, hardness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Interpolate to k pressures and hardnesses; return values (k, s) of all surfaces, and their weights, 0 to 1.

        pressure, hardness (k,): divided by E* h', with the contact modulus E* and the rms slope h'. weights: (k, s). An unknown
        value is NaN and has the weight 0.
        """
        upper, part = _interval(self.hard, np.minimum(hardness, ELASTIC))
        (low, of_low), (high, of_high) = (self._at_hardness(known, pressure, place) for place in (upper - 1, upper))
        values = np.where(of_low == 0.0, high, np.where(of_high == 0.0, low, low + part * (high - low)))
        alone = np.maximum(of_low * np.maximum(1.0 - 2.0 * part, 0.0), of_high * np.maximum(2.0 * part - 1.0, 0.0))
        return values, np.maximum(np.minimum(of_low, of_high), alone)

    def _at_hardness(self, known: BenchmarkSet, pressure: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        upper, part = _interval(known["loads"], pressure)
        at = place, upper - 1
        values, weights = part * self.rise[at], part * self.fall[at]
        values += self.start[at]
        weights += self.weight[at]
        return values, weights


def _interval(grid: np.ndarray, numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the intervals of an ascending grid that contain k numbers; return index of the upper end (k,), position (k, 1).

    The position runs from 0 at the lower end to 1 at the upper end, linearly in the logarithm of the
    number. Numbers outside the grid are moved to its ends.
    """
    upper = np.clip(np.searchsorted(grid, numbers), 1, len(grid) - 1)
    part = np.log(numbers / grid[upper - 1]) / np.log(grid[upper] / grid[upper - 1])
    return upper, np.clip(part, 0.0, 1.0)[:, None]


@cache
def _tables(known: BenchmarkSet, column: str) -> tuple[_Table, _Table]:
    """Return two tables for a model: its errors, and the reference areas of the surfaces for which it has any result.

    known: the benchmark set. column: "model|asperity method", a column of the set.
    """
    errors = known.errors(column)
    assert errors is not None
    any_result = np.isfinite(errors).any(axis=(1, 2))
    return _Table.of(known, errors), _Table.of(known, np.where(any_result[:, None, None], known.areas, np.nan))


def bare_errors(known: BenchmarkSet, column: str, features: ContactFeatures, anywhere: bool) -> ErrorsNear | None:
    """Return the errors of a model at k points, averaged over similar benchmark surfaces without a film.

    The result is None if the set does not contain the model. known: the benchmark set. column: "model|asperity method", a
    column of the set. features: features of the contact at k points. anywhere: True for a model that solves the map and is
    therefore equally accurate on any surface; only the pressure then determines the distance of a benchmark surface.
    """
    errors = known.errors(column)
    if errors is None:
        return None
    tables = _tables(known, column)
    return _in_blocks(features, errors.shape[0], lambda rows: _bare_errors(known, *tables, features.some(rows), anywhere))


def _in_blocks(features: ContactFeatures, surfaces: int, errors_of: Callable[[slice], ErrorsNear]) -> ErrorsNear:
    """Compute the errors for blocks of points one after the other and join them, to limit the memory.

    features: features of the contact at all points. surfaces: number of benchmark surfaces. errors_of: function that returns
    the errors for a slice of the points.
    """
    parts = [errors_of(rows) for rows in blocks(features.pressure.size, _TABLES * surfaces)]
    return ErrorsNear(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


def _bare_errors(known: BenchmarkSet, errors: _Table, areas: _Table, features: ContactFeatures, anywhere: bool) -> ErrorsNear:
    """Return the errors of a model at k points, averaged over similar benchmark surfaces without a film.

    errors: table of the errors ln(A/A_ref) of the model's area A. areas: table of the reference areas A_ref of the surfaces
    for which the model has any result. features: features of the contact at k points. anywhere: whether only the pressure
    determines the distance of a benchmark surface.
    """
    positive = (features.pressure > 0.0) & (features.hardness > 0.0)
    pressure, hardness = np.where(positive, features.pressure, 1.0), np.where(positive, features.hardness, 1.0)
    of_pressure, inside, solved_hardness = pressure_difference(known, pressure, hardness)
    found, there = errors.at(known, inside, solved_hardness)
    times = np.maximum(of_pressure.theirs[:, 0] / of_pressure.ours, 1.0)
    found, real = _at_lighter_load(known, errors, found, times, inside, solved_hardness)
    softer = np.divide(hardness, solved_hardness, out=np.ones(hardness.shape), where=hardness < solved_hardness)
    found = found * softer[:, None]  # softer than all benchmark surfaces: every area tends to load over hardness
    _, asked = areas.at(known, inside, solved_hardness)
    of_kind = known.of_kind(None if anywhere else features.kind)
    apart = [*([] if anywhere else differences(known, features)), of_pressure]
    presumed = of_kind > 0.0 if features.kind_known or anywhere else known.gaussian
    return _averaged(found, there * real * of_kind, asked * real * of_kind * positive[:, None], apart, presumed)


def film_errors_near(known: BenchmarkSet, errors: np.ndarray, features: ContactFeatures, like: np.ndarray) -> ErrorsNear:
    """Return the errors of a model at k points, averaged over similar benchmark surfaces with a film.

    known: the benchmark set. errors: array (coated surfaces, films, loads) of ln(A/A_ref), where A is the area by the model and
    A_ref the area by the reference solution. features: features of the contact at k points. like: mask (k,) of the points whose
    film is of the kind that the benchmark set contains. The others, and points without a compressive load, get NaN.
    """
    surfaces = math.prod(errors.shape[:2])
    return _in_blocks(features, surfaces, lambda rows: _film_errors(known, errors, features.some(rows), like[rows]))


def _film_errors(known: BenchmarkSet, errors: np.ndarray, features: ContactFeatures, like: np.ndarray) -> ErrorsNear:
    """Return the errors of `film_errors_near` for one block of points; the arguments are the same."""
    positive = features.pressure > 0.0
    features = replace(features, pressure=np.where(positive, features.pressure, 1.0))
    pressure, loads = np.log(features.pressure), np.log(known["film_loads"])
    found = np.empty((len(positive), *loads.shape[:2]))
    for one in np.ndindex(*loads.shape[:2]):
        found[:, *one] = np.interp(pressure, loads[one], errors[one])
    of_kind, gaussian = (
        np.broadcast_to(mask[known["film_surfaces"], None], loads.shape[:2]).ravel()
        for mask in (known.of_kind(features.kind), known.gaussian)
    )
    found = found.reshape(len(found), -1)
    asked = (of_kind * (positive & like)[:, None]).astype(float)
    presumed = of_kind > 0.0 if features.kind_known else gaussian
    return _averaged(found, np.isfinite(found) * of_kind.astype(float), asked, film_differences(known, features), presumed)


def quantiles(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Return the weighted quantiles (k, 5) of each row of values (k, s), at the probabilities LEVELS.

    weights (k, s): at least one in each row must be positive. Each quantile is averaged over probabilities within 0.03 of
    its own. Without this average, a quantile of few values would jump when a weight changes slightly.
    """
    order = np.argsort(values, axis=1)
    values, weights = (np.take_along_axis(table, order, axis=1) for table in (values, weights))
    shares, integrals, rows = np.cumsum(weights, axis=1), np.cumsum(weights * values, axis=1), np.arange(len(values))

    def integral(level: float) -> np.ndarray:
        """Integrate the sorted values with respect to their weights, up to the fraction `level` of the total weight; (k,)."""
        end = level * shares[:, -1]
        at = np.count_nonzero(shares < end[:, None], axis=1)
        return integrals[rows, at] - (shares[rows, at] - end) * values[rows, at]

    over = [integral(level + _WINDOW) - integral(level - _WINDOW) for level in LEVELS]
    return np.stack(over, axis=1) / (2.0 * _WINDOW * shares[:, -1:])


def _at_lighter_load(
    known: BenchmarkSet,
    errors: _Table,
    at_lightest: np.ndarray,
    pressure_ratio: np.ndarray,
    lightest: np.ndarray,
    hardness: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Extrapolate errors (k, s) to loads below the lightest solved load; return them with weights (k, s) of the surfaces.

    errors: table of the errors. at_lightest (k, s): errors at the pressures `lightest`. pressure_ratio (k,): lightest solved
    pressure divided by the pressure of the contact, or 1 if the contact has a larger pressure. lightest (k,): the larger of the
    pressure of the contact and the lightest solved pressure, divided by E* h'. hardness (k,): hardness of the contact, divided
    by E* h'. Errors at the ratio 1 are not changed. On elastic surfaces the error continues linearly in ln of the pressure down
    to 1/_FARTHEST of the lightest solved pressure, and is constant below. On surfaces that flow plastically it decreases with
    the square root of the pressure, because the finest roughness of a plateau flows too. Surfaces whose error changes fast have
    smooth plateaus, whereas real plateaus are rough; the weight of such surfaces therefore decreases with the load. Both rules
    are judgements of the authors (grade C).
    """
    if not (pressure_ratio > 1.0).any():
        return at_lightest, np.ones(at_lightest.shape)
    elastic = (1.0 / (1.0 + (_FLOWS / np.minimum(hardness, ELASTIC)) ** 2))[:, None]
    heavier, _ = errors.at(known, _SLOPE * lightest, hardness)
    slope = np.nan_to_num(at_lightest - heavier) / math.log(_SLOPE)
    farther = (np.log(pressure_ratio) / math.log(_FARTHEST))[:, None]
    real = np.minimum(_STEEP / np.maximum(np.abs(slope), 1e-9), 1.0) ** (2.0 * elastic * farther)
    going_on = at_lightest + elastic * slope * math.log(_FARTHEST) * np.minimum(farther, 1.0)
    return going_on * pressure_ratio[:, None] ** (-0.5 * (1.0 - elastic)), real


def _averaged(
    errors: np.ndarray, with_result: np.ndarray, all_surfaces: np.ndarray, apart: list[Difference], presumed: np.ndarray
) -> ErrorsNear:
    """Return statistics of the errors (k, s) on s surfaces for each of k points (one contact at one load).

    with_result, all_surfaces: weights (k, s), 0 to 1, of the surfaces for which the model has a result, and of all benchmark
    surfaces; all_surfaces is 0 for points that get no error. apart: differences that add up to the squared distances. presumed:
    mask (s,) of the surfaces of the specified or assumed kind, over which `ErrorsNear.middle` is averaged.
    """
    distances = squared_distance(apart)
    squared = np.where(all_surfaces > 0.0, distances.reshape(len(distances), -1), np.inf)
    known = np.atleast_1d(np.isfinite(squared).any(axis=1))
    mine = (with_result > 0.0) & known[:, None]
    ranked = mine & presumed
    answered = np.atleast_1d(ranked.any(axis=1))
    weights, ranks = _weights(squared, np.ones_like(mine)), _weights(squared, ranked)
    coverage = np.divide(
        (weights * with_result).sum(axis=1), (weights * all_surfaces).sum(axis=1), out=np.zeros(len(known)), where=answered
    )
    count = np.where(answered, np.count_nonzero(mine & (weights > _COUNTED), axis=1), 0)
    weights, ranks = np.where(mine, weights * with_result, 0.0), ranks * with_result
    values = np.where(mine, errors, 0.0)
    levels, relative, middle = np.full((len(known), len(LEVELS)), math.nan), *np.full((2, len(known)), math.nan)
    relative[answered] = np.sqrt(np.average(np.expm1(values[answered]) ** 2, axis=1, weights=weights[answered]))
    middle[answered] = np.average(values[answered], axis=1, weights=ranks[answered])
    nearest = np.where(answered[:, None] & ~mine, np.inf, squared).argmin(axis=1)
    least = np.take_along_axis(squared, nearest[:, None], axis=1)[:, 0]
    levels[answered] = quantiles(values[answered], weights[answered])
    words = np.full(len(known), no_words, dtype=object)
    for point in np.flatnonzero((least > 1.0) & np.isfinite(least)).tolist():
        words[point] = partial(nearest_in_words, apart, point, int(nearest[point]))
    return ErrorsNear(levels, relative, middle, np.sqrt(least), coverage, count, words)


def no_words() -> str:
    """Return an empty text, used for a point whose nearest benchmark surface hardly differs."""
    return ""


def _weights(squared: np.ndarray, some: np.ndarray) -> np.ndarray:
    """Return the weights exp(-d^2/2) (k, s) of benchmark surfaces, divided by the weight of the nearest one.

    squared: squared distances d^2 (k, s). some: mask (k, s) of the surfaces to include; the others have weight 0.
    """
    squared = np.where(some, squared, np.inf)
    least = squared.min(axis=1, keepdims=True)
    return np.exp(-0.5 * np.where(np.isfinite(squared), squared - np.where(np.isfinite(least), least, 0.0), np.inf))
