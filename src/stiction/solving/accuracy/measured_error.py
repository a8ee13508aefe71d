"""Estimate the error of a model at a contact from its errors on similar benchmark surfaces.

The benchmark set (docs/explanation/truth.md) holds the contact areas of many surfaces by a reference solution and by every
model and asperity method, for ranges of mean pressure, hardness and films. The errors on each surface are interpolated to the
pressure and hardness of the contact, both divided by E* h' (E*: contact modulus, h': rms slope). They are then averaged over
the surfaces with the weight exp(-d^2/2). The distance d includes differences in Nayak's alpha and, for a map, in skewness, lay
and the slope of its highest parts. For a contact given by numbers the kind of surface is unknown. The mean error is then
computed over Gaussian surfaces, for which models are ranked; the interval is computed over all kinds (skewed, worn, with a lay,
with two wave bands). If the kind is specified, mean and interval are computed over surfaces of that kind.

Friction of an interface is its shear strength times the area, so the relative errors of friction and area are equal. The error
of friction is smaller if the strength rises with pressure, and unknown if the strength exceeds the strength of the bodies.
Adhesion is not included.

A solution on the map itself has a discretisation error, and a sampling error if the map is a window of a larger surface.
"""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.quantities.quotient import quotient
from stiction.quantities.shown import span
from stiction.solving.accuracy.benchmark_set import BenchmarkSet, benchmark_set
from stiction.solving.accuracy.errors_near import LEVELS, NORMAL_SCORES, ErrorsNear, bare_errors, film_errors_near
from stiction.solving.accuracy.film_errors import on_other_kinds, on_solved_maps
from stiction.solving.accuracy.solved_near import ContactFeatures
from stiction.solving.closed_form import ClosedFormProblem
from stiction.solving.on_map import MapProblem
from stiction.solving.problem_base import Problem
from stiction.solving.state import state_of

if TYPE_CHECKING:
    from stiction.solvers.boundary_elements.map_area import MapArea
    from stiction.surfaces.heightmap import HeightMap

FAR = 2.0  # distance beyond which a benchmark surface is too different from a contact
_MOST_ADHESION = 0.1  # largest ratio of adhesion to load for which errors are used, because the set has no adhesion
_FULL = 1.0  # ratio of pull to load that is assumed where the load is 0
_LEAST_SHARE = 0.8  # least fraction of the compliance that is due to the coated body; in the set the other body is rigid
_MOST_POINTS = 25  # largest number of points whose errors are reported with a result; a prediction uses all points
# Standard deviation of ln of the solved area due to the point spacing, for maps with 8 points in the shortest wave. The first
# number is its value with one point in contact. The second is the exponent of the number of points in contact
# (truth/points.csv). The third is its value with many points, from a comparison with other solvers on maps with a lay and with
# plateaus (calibration.md); truth/points.csv alone gives .4 %, an outside audit .6 to 1.4 %.
_OF_POINTS, _POWER, _OWN_ERROR = 0.6, -0.6, 0.008
_BY_FORMULA = {"top slopes": 0.031, "ranks": 0.06}  # for maps too large to be solved (docs/explanation/truth.md)
_LEAST_TOLD = 0.5  # surfaces for which the model has a result must have at least this fraction of the total weight
_ITSELF, _MAP = "the solution itself", "map"
_SUM = "greenwood_williamson_1966"


@dataclass(frozen=True)
class MeasuredErrors:
    """Store the measured errors of a model's contact area at k points (one contact at one load); arrays are (k,) unless noted.

    The error is ln(A/A_ref), where A is the area by the model and A_ref the area by the reference solution. column: model and
    asperity method. area: mean error over benchmark surfaces of the specified kind, or over Gaussian surfaces if neither map
    nor kind is known. levels (k, 5): quantiles of the error on the nearest surfaces at the probabilities errors_near.LEVELS,
    even if these surfaces are far away. relative: root mean square of A/A_ref - 1 over these surfaces. friction: error of
    ln(mu) due to the area, for laws of the interface. area, relative and friction are NaN if unknown. distance: distance of the
    nearest surface. surfaces: number of surfaces with a noticeable weight. trust: weight, 1 for a near surface, 0 where none is
    similar; adhesion lowers it. sample: standard error of ln(A) because the map is only a window of a larger surface; 0 without
    a map. why_not: reason why no error is known at some points, or "". nearest: for each point a function that returns a text
    on how the nearest surface differs, or "". kind_known: whether the kind of surface is known. kind: the specified kind.
    """

    column: str
    area: np.ndarray
    levels: np.ndarray
    relative: np.ndarray
    friction: np.ndarray
    distance: np.ndarray
    surfaces: np.ndarray
    trust: np.ndarray
    sample: np.ndarray
    why_not: str = ""
    nearest: np.ndarray = field(default_factory=lambda: np.empty(0, dtype=object))
    kind_known: bool = True
    kind: str | None = None

    @property
    def low(self) -> np.ndarray:
        """Return the 5 % quantile of the error ln(A/A_ref) at each point; NaN where no benchmark surface is similar."""
        return np.where(np.isfinite(self.area), self.levels[:, 0], np.nan)

    @property
    def high(self) -> np.ndarray:
        """Return the 95 % quantile of the error ln(A/A_ref) at each point; NaN where no benchmark surface is similar."""
        return np.where(np.isfinite(self.area), self.levels[:, -1], np.nan)

    @property
    def known(self) -> bool:
        """Return whether an error was measured at any point."""
        return bool(np.isfinite(self.area).any())

    def as_data(self) -> dict[str, Any]:
        """Return the errors as data for JSON, by name.

        Each list has one value per point, None where unknown; it is empty if no benchmark surface has a finite distance.
        Relative errors: mean of area and mu, 5 and 95 % quantiles and rms of area, sampling error. Other lists: distance of the
        nearest surface, number of surfaces. Texts: model, kind of surface (or None), why no error is known. Flag: kind_known.
        """
        some = slice(None) if np.isfinite(self.distance).any() else slice(0)
        return {
            "measured_as": self.column,
            "area": _plain(np.expm1(self.area[some])),
            "area_low": _plain(np.expm1(self.low[some])),
            "area_high": _plain(np.expm1(self.high[some])),
            "area_rms": _plain(self.relative[some]),
            "friction": _plain(np.expm1(self.friction[some])),
            "sample": _plain(self.sample[some]),
            "distance": _plain(self.distance[some]),
            "surfaces": self.surfaces[some].astype(int).tolist(),
            "kind_known": self.kind_known,
            "kind": self.kind,
            "why_not": self.why_not,
        }

    @property
    def words(self) -> str:
        """Return a description of the errors, or the reason why none is known, in one line."""
        if not self.known:
            return f"not known here: {self.why_not}"
        some = np.isfinite(self.area)
        most = self.relative[some].max()
        if self.column == _ITSELF:
            return f"the reference solution; its point spacing leaves an error of {most:.1%}{self._of_sample}"
        where = "" if some.all() else f" at {int(some.sum())} of {some.size} points"
        of_mu = ", and so of mu" if np.isfinite(self.friction).any() else ""
        nearest = self.nearest[np.argmin(np.where(some, self.distance, np.inf))]()
        nearest = f"; {nearest}" if nearest else ""
        middle, levels = np.expm1(self.area[some]), np.expm1(self.levels[some])
        mean, ends = (span((one.min(), one.max()), "+.0%") for one in (middle, levels))
        alike = "like this one" if self.kind is None else f"of this kind, {self.kind}"
        kinds = alike if self.kind_known else "of all kinds, because the kind is not stated"
        surfaces = f"solved {'' if self.kind_known else 'Gaussian '}surfaces{where}"
        counted = f"{ends} for 90% of {int(self.surfaces[some].max())} {kinds}{nearest}"
        return f"contact area {mean} against {surfaces} ({counted}){of_mu}{self._of_sample}"

    @property
    def _of_sample(self) -> str:
        largest = float(np.max(self.sample, where=np.isfinite(self.sample), initial=0.0))
        return f"; +/-{largest:.0%} more because the map is one part of a larger surface" if largest > 0.0 else ""


def _plain(values: np.ndarray) -> list[float | None]:
    return [float(f"{value:.3g}") if math.isfinite(value) else None for value in np.ravel(values)]


def column_of(problem: Problem) -> str:
    """Return a model's column, e.g. "greenwood_williamson_1966|mccool" or "persson_2001|map"; "" if an option is changed."""
    chosen, record = problem.chosen, problem.record
    if any(problem.options[name] != values[0] for one in problem.records() for name, values in one.options.items()):
        return ""
    if record.takes_surface_moments:
        method = "map" if getattr(problem, "map", None) is not None and record.area_on_map is not None else "moments"
        return f"{record.key}|{method}"
    measured = None if problem.subject is None else problem.subject.measured
    method = "mccool" if measured is None else measured.method
    name = record.key
    if chosen.asperity is not None and chosen.asperity.key != record.asperity:  # the name in a comparison
        name = chosen.asperity.key if record.key == _SUM else f"{name} with {chosen.asperity.key}"
    return f"{name}|{method}"


def measured_errors(problem: Problem, results: Mapping[str, np.ndarray], most_points: float = _MOST_POINTS) -> MeasuredErrors:
    """Return the measured errors of a model for each point of normalised results.

    results: arrays by name, with the dimensions of the contacts first. The errors are flat arrays for all contacts and points.
    most_points: with more points, no errors are looked up; only the sampling error is then unknown if the map itself is solved.
    """
    load, area = (np.asarray(results[name]).reshape(len(problem.groups), -1) for name in ("load", "contact_area"))
    column = column_of(problem)
    if isinstance(problem, MapProblem):
        return _of_solution(problem, load, area, most_points)
    if why := _why_not(problem, column, load.size, most_points):
        return _unknown(column, load.size, why)
    near_none, why = _adhesion(problem, results)
    if why:
        return _unknown(column, load.size, why)
    features = ContactFeatures.of(problem, load)
    found = _near(problem, column, features, load.size // len(problem.groups), area)
    if found is None:
        kind = "" if features.kind is None else f" on {features.kind} surfaces"
        return _unknown(column, load.size, f"this model was not compared with solved surfaces{kind}")
    far = ~(found.distance <= FAR) | ~(found.coverage > _LEAST_TOLD)
    relative, error = (np.where(far, np.nan, one) for one in (found.relative, found.middle))
    why = _far(found.distance[far], found.nearest[far]) if far.any() else ""
    coverage = np.clip((found.coverage - _LEAST_TOLD) / (0.5 * _LEAST_TOLD), 0.0, 1.0)
    trust, levels = np.clip(FAR - found.distance, 0.0, 1.0) * coverage, found.levels * coverage[:, None]
    own = sample = np.zeros(load.size)
    if isinstance(problem, ClosedFormProblem) and problem.map is not None:
        own, sample = _own_error(problem.map, _share(problem, area)), _sample_error(problem.map, features, most_points)
    return MeasuredErrors(
        column, error, _widened(found.middle * coverage, levels, own), np.hypot(relative, own),
        _of_friction(problem, results, error), found.distance, found.surfaces, trust * near_none,
        sample, why, found.nearest, features.kind_known, features.kind,
    )  # fmt: skip


def _of_solution(problem: MapProblem, load: np.ndarray, area: np.ndarray, most_points: float) -> MeasuredErrors:
    """Return the errors of a solution on the map itself: the discretisation error and the sampling error.

    load, area: normalised load and contact area (1, m).
    """
    surface = problem.surface()
    features = ContactFeatures.of(problem, load, surface)
    there = np.where(np.isfinite(area.ravel()), 0.0, np.nan)
    own, nothing = there + _own_error(surface, _share(problem, area), every_point=True), np.zeros(load.size)
    levels = _widened(there, np.repeat(there[:, None], len(LEVELS), axis=1), own)
    return MeasuredErrors(
        _ITSELF, there, levels, own, there, nothing, nothing + 1.0, nothing + 1.0, _sample_error(surface, features, most_points)
    )


def _share(problem: Problem, area: np.ndarray) -> np.ndarray:
    """Return the ratio of real to nominal contact area (k,) from normalised areas (n, m), k = n m; 0 where nothing touches."""
    return np.nan_to_num(np.minimum(math.pi * np.reshape(problem.groups.roughness_parameter, (-1, 1)) * area, 1.0)).ravel()


def _own_error(surface: "HeightMap", share: np.ndarray, every_point: bool = False) -> np.ndarray:
    """Return the standard deviation (k,) of ln(A) due to the point spacing, where the contact area A was solved on a map.

    It depends on the number of points in contact. For a map too large to be solved, it is the error of the formula used
    instead. share: area fraction (k,). every_point: whether all points of the map are solved.
    """
    area = _map_area(surface)
    if not area.solvable and not every_point:
        return np.full(share.shape, _BY_FORMULA[area.way])
    every = np.ones(share.size) if every_point else np.array([area.every(one) for one in share.tolist()])
    points = np.maximum(share * area.heights.size / every**2, 1.0)
    return np.hypot(_OWN_ERROR, _OF_POINTS * points**_POWER)


def _widened(middle: np.ndarray, levels: np.ndarray, more: np.ndarray) -> np.ndarray:
    """Widen the quantiles `levels` (k, 5) about `middle` (k,) by a normal error with standard deviation `more` (k,)."""
    if not more.any():
        return levels
    apart = levels - middle[:, None]
    scores = np.array(NORMAL_SCORES)
    return middle[:, None] + np.where(apart == 0.0, np.sign(scores), np.sign(apart)) * np.hypot(apart, scores * more[:, None])


def _sample_error(surface: "HeightMap", features: ContactFeatures, most_points: float) -> np.ndarray:
    """Return the standard error (k,) of ln(A) because the map is only a window of a larger surface; 0 for a periodic map.

    A: contact area. features: features of the contact at k points. The error is NaN if there are more than most_points points.
    """
    if features.pressure.size > most_points:
        return np.full(features.pressure.size, np.nan)
    area, found = _map_area(surface), np.empty(features.pressure.size)
    h = area.slopes.gradient
    for hardness in np.unique(features.hardness):
        at = features.hardness == hardness
        found[at] = area.sample_error(np.maximum(features.pressure[at], 0.0) * h, float(hardness) * h)
    return found


def _near(problem: Problem, column: str, features: ContactFeatures, points: int, area: np.ndarray) -> ErrorsNear | None:
    """Return the errors of the model at each point of the contacts; None for a model that was not measured.

    column: "model|asperity method". features: features at all points. points: loads per contact. area: normalised contact area.
    """
    known = benchmark_set()
    if not problem.groups.has_film:
        return bare_errors(known, column, features, anywhere=column.endswith(f"|{_MAP}"))
    found = None if problem.record.on_film else _on_film(known, column, features, problem)
    return _on_other_maps(problem, features, points, area) if found is None else found


def _on_other_maps(problem: Problem, features: ContactFeatures, points: int, area: np.ndarray) -> ErrorsNear | None:
    """Return the errors of an area law for films, measured on rough surfaces with films (truth/films.csv); None without data.

    If the law solves the contact's own map, the errors are 0; the discretisation error is added later. Without a map of the
    contact, the intervals are wider, because its surface may be non-Gaussian. A stated kind or statistic of the surface also
    shifts the errors. features: features of the contact at k points. points: loads per contact. area: normalised contact area.
    """
    found = on_solved_maps(problem, points)
    surface = problem.map if isinstance(problem, ClosedFormProblem) else None
    if found is not None and surface is not None and _map_area(surface).solvable:
        return _none_but_own(found)
    return found if found is None or features.shape is not None else on_other_kinds(problem, features, found, area)


def _map_area(surface: "HeightMap") -> "MapArea":
    from stiction.solvers.boundary_elements.map_area import map_area  # only contacts with a map need this

    return map_area(surface)


def _none_but_own(found: ErrorsNear) -> ErrorsNear:
    """Return errors of zero at distance zero, for a model that solves the map; its discretisation error is added later.

    found: errors, from which the shapes and the other fields are copied.
    """
    nothing = np.zeros_like(found.distance)
    each = {name: nothing for name in ("relative", "middle", "distance")}
    return found._replace(**each, levels=np.zeros_like(found.levels), coverage=nothing + 1.0)


def _unknown(column: str, points: int, why: str) -> MeasuredErrors:
    nothing, zero = np.full(points, np.nan), np.zeros(points)
    levels = np.full((points, len(LEVELS)), np.nan)
    return MeasuredErrors(column, nothing, levels, nothing, nothing, nothing, zero, zero, zero, why)


def _far(distance: np.ndarray, nearest: np.ndarray) -> str:
    """Return a text on why no error is known at some points: the film, the nearest surface, or the load.

    distance (k,): distance of the nearest benchmark surface at k points. nearest (k,): functions that describe it.
    """
    at = int(np.argmin(distance))
    if math.isinf(distance[at]):
        return "solved surfaces with a film have one elastic film on one body, and a rigid counterbody"
    return f"no solved surface is like this one: {nearest[at]()}" if distance[at] > FAR else "no result at this load"


def _why_not(problem: Problem, column: str, points: int, most_points: float) -> str:
    if not column:
        return "this variant of the model was not compared with solved surfaces"
    if problem.groups.roughness_parameter is None:
        return "at least one of sigma, R and N of the roughness is unknown"
    if points > most_points:
        return f"computed for at most {most_points:g} points"
    return ""


def _adhesion(problem: Problem, results: Mapping[str, np.ndarray]) -> tuple[float, str]:
    """Return a weight, 1 to 0, for using errors measured without adhesion, and the reason if it is 0.

    The weight falls to 0 as adhesion or the pull of menisci rises from 5 to 10 % of the load; the reason is "" up to 10 %.
    """
    state, why = state_of(problem, results), "menisci would pull, but the solved surfaces are dry"
    pull = _largest(state.get("meniscus_share"))
    if "load_meniscus" in results:
        pulled, load = (np.abs(np.asarray(results[name], dtype=float)) for name in ("load_meniscus", "load"))
        share = np.where(pulled > 0.0, quotient(pulled, load, _FULL), 0.0)
        pull, why = _largest(share), "menisci pull, but the solved surfaces are dry"
    sticks = _largest(state.get("adhesion_share"))
    if sticks > max(pull, _MOST_ADHESION):
        pull, why = sticks, "the contact adheres, but the solved surfaces do not"
    near = float(np.clip(2.0 - 2.0 * max(pull, sticks) / _MOST_ADHESION, 0.0, 1.0))
    return near, "" if pull <= _MOST_ADHESION else why


def _largest(values: np.ndarray | None) -> float:
    """Return the largest finite value of an array; -inf if there is none or the array is None."""
    known = np.empty(0) if values is None else values[np.isfinite(values)]
    return float(np.max(known, initial=-np.inf))


def _on_film(known: BenchmarkSet, column: str, features: ContactFeatures, problem: Problem) -> ErrorsNear | None:
    """Return the errors of a model on benchmark surfaces with a film, at each point; None if it was not measured on them.

    It is also None if no coated surface is of the contact's kind. The error is NaN unless one body has an elastic film.
    """
    groups, film = problem.groups, problem.chosen.film
    name = column.split("|")[0]
    own = film is not None and f"{film.key}|mccool"
    candidates = [f"{name} + {film.key}|{one}" if film else column for one in ("mccool", "moments")] + [own or column]
    errors = next((one for one in map(known.film_errors, candidates) if one is not None), None)
    if errors is None or not known.of_kind(features.kind)[known["film_surfaces"]].any():
        return None
    elastic = (groups.n_H * features.hardness.reshape(len(groups), -1)[:, 0] / np.maximum(groups.film_modulus, 1.0)) > 1.0
    like = elastic & (groups.coated_share >= _LEAST_SHARE) & (groups.films == 1.0)
    return film_errors_near(known, errors, features, np.repeat(like, features.pressure.size // len(groups)))


def _of_friction(problem: Problem, results: Mapping[str, np.ndarray], error: np.ndarray) -> np.ndarray:
    """Return the error (k,) of ln mu that follows from the error of the area, for laws mu = tau_0 A/P + beta.

    error: ln(A/A_ref) (k,) of the contact area A. tau_0: shear strength, P: load, beta: pressure coefficient. The result is NaN
    for other friction laws, and for contacts whose interface is not weaker than the bodies.
    """
    tangential = problem.chosen.tangential
    if tangential is None or not tangential.interfacial or "friction_force" not in results:
        return np.full(error.shape, np.nan)
    ratio = problem.groups.strength_over_bodies
    if ratio is not None:  # where the interface is not weaker than the bodies, junctions grow, and mu has another error
        weaker = np.broadcast_to(ratio < 1.0 - 1e-12, len(problem.groups))
        error = np.where(np.repeat(weaker, error.size // len(weaker)), error, np.nan)
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
    """Return the measured errors of a model as attributes of a result: as plain text, and as JSON."""
    return {"measured_error": json.dumps(found.as_data()), "measured_error_in_words": found.words}
