"""How far a model is from solved surfaces near a contact: its measured error.

The set (docs/truth.md) has the contact area of every model on surfaces whose contact was solved, by every way of finding
asperities, at some mean pressures, hardnesses and films. Near a contact that means: at its pressure and hardness over E* h',
read off between those of the set, for each surface of it; and the mean over surfaces, each weighing exp(-d^2/2) with its
distance d in Nayak's alpha, and where the map is known in skewness, lay and the slope of its top. A contact that is given by
numbers is compared with Gaussian isotropic surfaces. Friction of an interface is its strength times the area, so that its
error is that of the area, less where the strength rises with pressure. Adhesion is not in the set.
"""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from stiction.solving.film_errors import on_solved_maps
from stiction.solving.problem_base import Problem
from stiction.solving.solved_near import (
    Difference,
    Place,
    differences,
    film_differences,
    nearest_in_words,
    pressure_difference,
    squared_distance,
)
from stiction.solving.solved_set import SolvedSet, solved_set
from stiction.solving.state import state_of

__all__ = ["MeasuredErrors", "measured_errors"]

FAR = 2.0  # distance beyond which nothing near was measured
_ELASTIC = 3.0  # hardness over E* h' from which on nothing flows
_MOST_ADHESION = 0.1  # pull-off forces over the load, in the set there are none
_LEAST_SHARE = 0.8  # of the compliance that is the coated body's: in the set the other is rigid
_MOST_POINTS = 200
_PIXELS = 0.015  # ln of the area of a map that is solved, by the width of its points
_ITSELF, _MAP = "the solution itself", "map"
_SUM = "greenwood_williamson_1966"


@dataclass(frozen=True)
class MeasuredErrors:
    """At k points. area: ln(A/solved A) on average near each, not a number where nothing near was measured; expected: its root
    mean square over the surfaces near, and relative: that of A/solved A - 1; friction: of mu as area, where it is of the
    interface; distance: of the nearest surface, pressure, hardness; surfaces: how many count. column: the model and the way of
    finding asperities; why_not: why there is nothing at some of them, "" if there is; nearest: in what the nearest surface
    differs, "" where it hardly does."""

    column: str
    area: np.ndarray
    expected: np.ndarray
    relative: np.ndarray
    friction: np.ndarray
    distance: np.ndarray
    surfaces: np.ndarray
    why_not: str = ""
    nearest: np.ndarray = field(default_factory=lambda: np.empty(0, dtype=str))

    @property
    def known(self) -> bool:
        """Whether anything was measured at any point."""
        return bool(np.isfinite(self.area).any())

    def as_data(self) -> dict[str, Any]:
        """Relative errors: of the area and mu on average, root mean square of the area's, and how near; lists over the points,
        null where nothing was measured."""
        return {
            "measured_as": self.column,
            "area": _plain(np.expm1(self.area)),
            "area_rms": _plain(self.relative),
            "friction": _plain(np.expm1(self.friction)),
            "distance": _plain(self.distance),
            "surfaces": self.surfaces.astype(int).tolist(),
            "why_not": self.why_not,
        }

    @property
    def words(self) -> str:
        """In a line."""
        if self.column == _ITSELF:
            return "it is what the others are measured by; where points resolve the map, their width leaves 1 to 2 %"
        if not self.known:
            return f"not measured here: {self.why_not}"
        some = np.isfinite(self.area)
        low, high = np.expm1(self.area[some].min()), np.expm1(self.area[some].max())
        most = self.relative[some].max()
        ends = f"{low:+.0%}" if f"{low:+.0%}" == f"{high:+.0%}" else f"{low:+.0%} to {high:+.0%}"
        nearest = self.nearest[np.argmin(np.where(some, self.distance, np.inf))] if self.nearest.size else ""
        where = "" if some.all() else f" at {int(some.sum())} of {some.size} points"
        of_mu = ", and so of mu" if np.isfinite(self.friction).any() else ""
        like = "; ".join(filter(None, [f"rms {most:.0%} over {int(self.surfaces[some].max())} like this one", nearest]))
        return f"contact area {ends} against solved surfaces{where} ({like}){of_mu}"


def _plain(values: np.ndarray) -> list[float | None]:
    return [float(f"{value:.3g}") if math.isfinite(value) else None for value in np.ravel(values)]


def column_of(problem: Problem) -> str:
    """The column of the set for a model as it is applied here: "model|way of finding asperities"; "" where it has none."""
    chosen, record = problem.chosen, problem.record
    if any(problem.options[name] != values[0] for one in problem.records() for name, values in one.options.items()):
        return ""
    if record.takes_surface_moments:
        method = "map" if getattr(problem, "map", None) is not None and record.area_on_map is not None else "moments"
        return f"{record.key}|{method}"
    measured = None if problem.subject is None else problem.subject.measured
    method = "mccool" if measured is None else measured.method
    return f"{_name(chosen, record)}|{method}"


def _name(chosen, record) -> str:
    """As a comparison shows it."""
    if chosen.asperity is None or chosen.asperity.key == record.asperity:
        name = record.key
    else:
        name = chosen.asperity.key if record.key == _SUM else f"{record.key} with {chosen.asperity.key}"
    return name


def measured_errors(problem: Problem, results: Mapping[str, np.ndarray]) -> MeasuredErrors:
    """At the points of these normalised results, contacts first: flat over both."""
    load, area = (np.asarray(results[name]).reshape(len(problem.groups), -1) for name in ("load", "contact_area"))
    column = column_of(problem)
    if problem.record.of_map is not None:
        there = np.where(np.isfinite(area.ravel()), 0.0, np.nan)
        return MeasuredErrors(_ITSELF, there, there + _PIXELS, there + _PIXELS, there, there, np.ones(load.size))
    why = _why_not(problem, results, column, load.size)
    if why:
        return _unknown(column, load.size, why)
    place = Place.of(problem, load)
    known = solved_set()
    coated = problem.groups.has_film
    found = _on_film(known, column, place, problem) if coated else _bare(known, column, place)
    if found is None and coated:
        found = on_solved_maps(problem, load.size // len(problem.groups))
    if found is None:
        return _unknown(column, load.size, "this model was not measured")
    *numbers, distance, surfaces, nearest = found
    far = ~(distance <= FAR) | ~np.isfinite(numbers[0])
    error, expected, relative = (np.where(far, np.nan, one) for one in numbers)
    why = _far(distance[far], nearest[far]) if far.any() else ""
    friction = _of_friction(problem, results, error)
    return MeasuredErrors(column, error, expected, relative, friction, distance, surfaces, why, nearest)


def _unknown(column: str, points: int, why: str) -> MeasuredErrors:
    nothing = np.full(points, np.nan)
    return MeasuredErrors(column, nothing, nothing, nothing, nothing, nothing, np.zeros(points), why)


def _far(distance: np.ndarray, nearest: np.ndarray) -> str:
    """distance, and what is said of the nearest solved surface, at the points where nothing near was measured."""
    at = int(np.argmin(distance))
    if math.isinf(distance[at]):
        return "the film is not as in the set, elastic and on one body under a rigid one"
    return f"no solved surface is like this one: {nearest[at]}" if distance[at] > FAR else "it carries no such load there"


def _why_not(problem: Problem, results: Mapping[str, np.ndarray], column: str, points: int) -> str:
    if not column:
        return "not with these options"
    if problem.groups.roughness_parameter is None:
        return "the roughness is not known as a surface"
    if points > _MOST_POINTS:
        return f"asked for {_MOST_POINTS} points at most"
    state = state_of(problem, results)
    if "load_meniscus" in results:
        pull, load = (np.abs(np.asarray(results[name], dtype=float)) for name in ("load_meniscus", "load"))
        if (pull > _MOST_ADHESION * load).any():
            return "menisci pull, the solved surfaces are dry"
    elif _largest(state.get("meniscus_share")) > _MOST_ADHESION:
        return "menisci would pull, the solved surfaces are dry"
    if _largest(state.get("adhesion_share")) > _MOST_ADHESION:
        return "the contact adheres, the solved surfaces do not"
    return ""


def _largest(share: np.ndarray | None) -> float:
    """The largest of what is known of a share; -inf of nothing."""
    known = np.empty(0) if share is None else share[np.isfinite(share)]
    return float(np.max(known, initial=-np.inf))


def _bare(known: SolvedSet, column: str, place: Place):
    """Mean, root mean square of logarithm and ratio, distance, number of surfaces, words of the nearest, at k points; None of
    a model that was not measured. A solution of the map is as good on any surface: there only pressure tells how near."""
    errors = known.errors(column)
    if errors is None:
        return None
    anywhere = column.endswith(f"|{_MAP}")
    rows = [_at_point(known, errors, place, at, anywhere) for at in range(place.pressure.size)]
    return tuple(np.array(values) for values in zip(*rows, strict=True))


def _at_point(known: SolvedSet, errors: np.ndarray, place: Place, at: int, anywhere: bool):
    pressure, hardness = float(place.pressure[at]), float(place.hardness[at])
    if not (pressure > 0.0 and hardness > 0.0):
        return _NONE
    of_pressure, inside, hardness = pressure_difference(known, pressure, hardness)
    found, solved = (_between(known, one, inside, hardness) for one in (errors, known.areas))
    apart = [*([] if anywhere else differences(known, place, at)), of_pressure]
    asked = np.isfinite(solved) & np.isfinite(errors).any(axis=(1, 2))  # there, and of this model at all
    return _averaged(found, np.where(asked, squared_distance(apart), np.inf), apart)


_NONE = (math.nan, math.nan, math.nan, math.inf, 0, "")


def _averaged(found: np.ndarray, squared: np.ndarray, apart: list[Difference]):
    """Weighted by exp(-d^2/2), of those that are numbers; none where most of what is near says nothing. apart: what the squared
    distances are made of."""
    if not np.isfinite(squared).any():
        return _NONE
    least = float(squared.min())
    weights = np.exp(-0.5 * (squared - least))
    told = np.isfinite(found)
    if not told.any() or weights[told].sum() < 0.5 * weights[np.isfinite(squared)].sum():
        return math.nan, math.nan, math.nan, math.sqrt(least), 0, nearest_in_words(apart, int(np.argmin(squared)))
    nearest = nearest_in_words(apart, int(np.argmin(np.where(told, squared, np.inf))))
    weights, values = weights[told] / weights[told].sum(), found[told]
    mean = float(np.sum(weights * values))
    expected = math.sqrt(float(np.sum(weights * values**2)))
    relative = math.sqrt(float(np.sum(weights * np.expm1(values) ** 2)))
    count = int(np.count_nonzero(weights > 0.1 * weights.max()))
    return mean, expected, relative, math.sqrt(float(squared[told].min())), count, nearest


def _between(known: SolvedSet, errors: np.ndarray, pressure: float, hardness: float) -> np.ndarray:
    """Errors (s,) at a pressure and a hardness, read off between those of the set by straight lines over their logarithms."""
    hard = np.minimum(known["hardnesses"], _ELASTIC)
    order = np.argsort(hard)
    right = int(np.clip(np.searchsorted(hard[order], min(hardness, _ELASTIC)), 1, len(order) - 1))
    ends = order[right - 1], order[right]
    part = math.log(min(hardness, _ELASTIC) / hard[ends[0]]) / math.log(hard[ends[1]] / hard[ends[0]])
    lower, upper = (_at_pressure(known["loads"], errors[:, end, :], pressure) for end in ends)
    both = lower + part * (upper - lower)
    # A surface that was not solved with this hardness, or not at this pressure, is taken where the other end is near.
    near = np.where(part > 0.7, upper, np.nan) if part > 0.5 else np.where(part < 0.3, lower, np.nan)
    return np.where(np.isfinite(both), both, near)


def _at_pressure(loads: np.ndarray, errors: np.ndarray, pressure: float) -> np.ndarray:
    right = int(np.clip(np.searchsorted(loads, pressure), 1, len(loads) - 1))
    part = math.log(pressure / loads[right - 1]) / math.log(loads[right] / loads[right - 1])
    left, next_one = errors[:, right - 1], errors[:, right]
    if part < 1e-9:
        return left
    if part > 1.0 - 1e-9:
        return next_one
    return np.where(np.isfinite(next_one), left + part * (next_one - left), left)  # the last that was solved stands for more


def _on_film(known: SolvedSet, column: str, place: Place, problem: Problem):
    """As `_bare`, on a film that is elastic, on one body, the other rigid."""
    groups, film = problem.groups, problem.chosen.film
    name = column.split("|")[0]
    own = film is not None and f"{film.key}|mccool"
    candidates = [f"{name} + {film.key}|{one}" if film else column for one in ("mccool", "moments")] + [own or column]
    errors = next((one for one in map(known.film_errors, candidates) if one is not None), None)
    if errors is None:
        return None
    elastic = (groups.n_H * place.hardness.reshape(len(groups), -1)[:, 0] / np.maximum(groups.film_modulus, 1.0)) > 1.0
    like = elastic & (groups.coated_share >= _LEAST_SHARE) & (groups.films == 1.0)
    points = place.pressure.size // len(groups)
    holds = np.repeat(like, points)
    rows = [_film_point(known, errors, place, at) if holds[at] else _NONE for at in range(place.pressure.size)]
    return tuple(np.array(values) for values in zip(*rows, strict=True))


def _film_point(known: SolvedSet, errors: np.ndarray, place: Place, at: int):
    apart, loads = film_differences(known, place, at), known["film_loads"]
    found = np.empty(loads.shape[:2])
    for one in np.ndindex(*found.shape):
        found[one] = np.interp(math.log(place.pressure[at]), np.log(loads[one]), errors[one])
    return _averaged(found.ravel(), squared_distance(apart).ravel(), apart)


def _of_friction(problem: Problem, results: Mapping[str, np.ndarray], error: np.ndarray) -> np.ndarray:
    """ln of mu over what it would be with the solved area: of a law of the interface, mu = tau_0 A/P + beta."""
    tangential = problem.chosen.tangential
    if tangential is None or not tangential.interfacial or "friction_force" not in results:
        return np.full(error.shape, np.nan)
    beta = problem.groups.pressure_coefficient
    if beta is None or "pressure_coefficient" not in (*tangential.needs, *tangential.takes):
        return error
    friction, load = (
        np.asarray(results[name], dtype=float).reshape(len(problem.groups), -1) for name in ("friction_force", "load")
    )
    of_load = np.reshape(beta, (-1, 1)) * load
    solved = (friction - of_load) * np.exp(-error.reshape(load.shape)) + of_load
    return np.log(friction / solved).ravel()


def as_attributes(found: MeasuredErrors) -> dict[str, str]:
    """Attributes of a result: in words, and as JSON."""
    return {"measured_error": json.dumps(found.as_data()), "measured_error_in_words": found.words}
