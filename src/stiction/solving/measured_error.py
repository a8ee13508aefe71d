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
from dataclasses import dataclass
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.solving.film_errors import on_solved_maps
from stiction.solving.problem_base import Problem
from stiction.solving.solved_set import SolvedSet, solved_set
from stiction.solving.state import state_of
from stiction.surfaces.theory.moments import bandwidth, reduced_pressure, slope_over_sharpness

__all__ = ["MeasuredErrors", "measured_errors"]

FAR = 2.0  # distance beyond which nothing near was measured
_SCALES = {"alpha": 0.5, "skewness": 0.6, "lay": 0.35, "top": 0.25}  # that count as a distance of 1; logarithms but skewness
_LEAST_TOP = 0.03
_PRESSURE = 1.4  # ln of the pressure beyond those of the set, a distance of 1; where all flows it hardly counts
_FLOWING, _FLOWING_PRESSURE = 0.1, 7.0  # hardness over E* h' below that is so
_ELASTIC = 3.0  # hardness over E* h' from which on nothing flows
_FILM_SCALES = (0.7, 0.8)  # ln of the modulus over the substrate's, of the thickness over sqrt(m2/m4)
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
    finding asperities; why_not: why there is nothing at some of them, "" if there is."""

    column: str
    area: np.ndarray
    expected: np.ndarray
    relative: np.ndarray
    friction: np.ndarray
    distance: np.ndarray
    surfaces: np.ndarray
    why_not: str = ""

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
        count, near = int(self.surfaces[some].max()), float(np.min(self.distance[some]))
        where = "" if some.all() else f" at {int(some.sum())} of {some.size} points"
        of_mu = ", and so of mu" if np.isfinite(self.friction).any() else ""
        nearest = f"{count} near, the nearest at {near:.1f}"
        return f"contact area {ends} against solved surfaces{where} (rms {most:.0%}; {nearest}){of_mu}"


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
    place = _Place.of(problem, load)
    known = solved_set()
    coated = problem.groups.has_film
    found = _on_film(known, column, place, problem) if coated else _bare(known, column, place)
    if found is None and coated:
        found = on_solved_maps(problem, load.size // len(problem.groups))
    if found is None:
        return _unknown(column, load.size, "this model was not measured")
    distance, surfaces = found[3], found[4]
    far = ~(distance <= FAR) | ~np.isfinite(found[0])
    error, expected, relative = (np.where(far, np.nan, one) for one in found[:3])
    why = _far(distance[far]) if far.any() else ""
    if far.any() and coated and np.isfinite(distance[far]).any():
        why = "; ".join(filter(None, [_film_far(known, place), why]))
    return MeasuredErrors(column, error, expected, relative, _of_friction(problem, results, error), distance, surfaces, why)


def _unknown(column: str, points: int, why: str) -> MeasuredErrors:
    nothing = np.full(points, np.nan)
    return MeasuredErrors(column, nothing, nothing, nothing, nothing, nothing, np.zeros(points), why)


def _far(distance: np.ndarray) -> str:
    least = float(np.min(distance, initial=np.inf, where=np.isfinite(distance)))
    if math.isinf(least):
        return "the film is not as in the set, elastic and on one body under a rigid one"
    return (
        f"the nearest of the solved surfaces is at {least:.1f}, above {FAR:g}"
        if least > FAR
        else "it carries no such load there"
    )


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


@dataclass(frozen=True)
class _Place:
    """Where k points are. pressure, hardness: over E* h'; alpha: Nayak's; shape: skewness, lay and top of the map, None where
    there is none; thickness, modulus: of the film, over sqrt(m2/m4) and the substrate's."""

    pressure: np.ndarray
    hardness: np.ndarray
    alpha: np.ndarray
    shape: tuple[float, float, float] | None
    modulus: np.ndarray | None = None
    thickness: np.ndarray | None = None

    @classmethod
    def of(cls, problem: Problem, load: np.ndarray) -> "_Place":
        groups, points = problem.groups, load.shape[1]
        density = groups.roughness_parameter[:, None]
        pressure = reduced_pressure(load, density)
        hardness = groups.eta[:, None] * (4.0 / 3.0) / math.pi / slope_over_sharpness(density)
        alpha, shape = np.broadcast_to(bandwidth(density), load.shape).ravel(), None
        surface = None if problem.subject is None else problem.subject.with_surface_moments().map
        if surface is not None:
            pressure, hardness, alpha, shape = _of_map(surface, problem, load)
        film = _film_of(groups, points) if groups.has_film else (None, None)
        return cls(pressure.ravel(), np.broadcast_to(hardness, load.shape).ravel(), alpha, shape, *film)


def _of_map(surface: Any, problem: Problem, load: np.ndarray):
    """The same by the map itself, whose slopes decide, whatever the asperities."""
    from stiction.surfaces.boundary_elements.map_area import map_area

    area, whole = map_area(surface), problem.subject.with_surface_moments()
    h = area.slopes.gradient
    factors = problem.subject.scales().factors()
    strength = whole.contact_modulus * h
    pressure = load * float(factors["N"]) / whole.nominal_area / strength
    groups = problem.groups
    of_load = groups.eta[:, None] * (4.0 / 3.0) / math.pi * groups.sharpness[:, None] / h
    z = surface.heights - surface.heights.mean()
    skewness = float(np.mean(z**3)) / float(np.mean(z**2)) ** 1.5
    return pressure, of_load, np.full(load.size, area.slopes.alpha), (skewness, area.slopes.lay, area.slopes.top(0.05))


def _film_of(groups: Groups, points: int) -> tuple[np.ndarray, np.ndarray]:
    """sqrt(m2/m4) = 1/sqrt(6 pi sqrt(3) N) (Nayak 1971); film_aspect is t/sqrt(R sigma)."""
    thickness = groups.film_aspect * np.sqrt(6.0 * math.pi * math.sqrt(3.0) * groups.roughness_parameter)
    return np.repeat(groups.film_modulus, points), np.repeat(thickness, points)


def _film_far(known: SolvedSet, place: _Place) -> str:
    """How the film leaves the solved ones, in modulus and thickness; "" where it does not."""
    assert place.modulus is not None and place.thickness is not None
    moduli, thicknesses = known["films"].T
    waves = known["gradient_over_shortest"][known["film_surfaces"]] / known.feature("wave")[known["film_surfaces"]]
    rows = (
        ("modulus", "that of the body", place.modulus, moduli.min(), moduli.max()),
        ("thickness", "sqrt(m2/m4)", place.thickness, thicknesses.min() * waves.min(), thicknesses.max() * waves.max()),
    )
    beyond = [
        f"the film's {what} is {given.min():.3g}{'' if given.min() == given.max() else f' to {given.max():.3g}'} of {unit}, "
        f"the solved films have {low:.3g} to {high:.3g}"
        for what, unit, given, low, high in rows
        if given.min() < 0.999 * low or given.max() > 1.001 * high
    ]
    return "; ".join(beyond)


def _surface_distance(known: SolvedSet, place: _Place, at: int) -> np.ndarray:
    """Squared distance (s,) of every surface from a point; infinite of those that are not Gaussian where no map is known."""
    total = ((np.log(known.feature("alpha")) - math.log(place.alpha[at])) / _SCALES["alpha"]) ** 2
    if place.shape is None:
        return np.where(known.gaussian, total, np.inf)
    skewness, lay, top = place.shape
    total += ((known.feature("skewness") - skewness) / _SCALES["skewness"]) ** 2
    total += (np.log(known.feature("lay") / lay) / _SCALES["lay"]) ** 2
    tops = np.maximum(known.feature("top"), _LEAST_TOP)
    return total + (np.log(tops / max(top, _LEAST_TOP)) / _SCALES["top"]) ** 2


def _bare(known: SolvedSet, column: str, place: _Place):
    """Mean, root mean square of logarithm and ratio, distance, number of surfaces at k points; None of a model that was not
    measured. A solution of the map is as good on any surface: then only pressure and hardness tell how near."""
    errors = known.errors(column)
    if errors is None:
        return None
    anywhere = column.endswith(f"|{_MAP}")
    rows = [_at_point(known, errors, place, at, anywhere) for at in range(place.pressure.size)]
    return tuple(np.array(values) for values in zip(*rows, strict=True))


def _at_point(known: SolvedSet, errors: np.ndarray, place: _Place, at: int, anywhere: bool):
    pressure, hardness = float(place.pressure[at]), float(place.hardness[at])
    if not (pressure > 0.0 and hardness > 0.0):
        return _NONE
    loads = known["loads"]
    softest = float(known["hardnesses"][1:].min())
    if hardness < softest:  # all flows: what counts is the pressure over the hardness
        pressure, hardness = pressure * softest / hardness, softest
    low, high = float(loads[0]), float(loads[-1])
    scale = _FLOWING_PRESSURE if hardness <= _FLOWING else _PRESSURE
    beyond = max(math.log(low / pressure), math.log(pressure / high), 0.0) / scale
    inside = min(max(pressure, low), high)
    found, solved = (_between(known, one, inside, hardness) for one in (errors, known.areas))
    squared = np.zeros(len(found)) if anywhere else _surface_distance(known, place, at)
    asked = np.isfinite(solved) & np.isfinite(errors).any(axis=(1, 2))  # there, and of this model at all
    return _averaged(found, np.where(asked, squared + beyond**2, np.inf))


_NONE = (math.nan, math.nan, math.nan, math.inf, 0)


def _averaged(found: np.ndarray, squared: np.ndarray):
    """Weighted by exp(-d^2/2), of those that are numbers; none where most of what is near says nothing."""
    if not np.isfinite(squared).any():
        return _NONE
    least = float(squared.min())
    weights = np.exp(-0.5 * (squared - least))
    told = np.isfinite(found)
    if not told.any() or weights[told].sum() < 0.5 * weights[np.isfinite(squared)].sum():
        return math.nan, math.nan, math.nan, math.sqrt(least), 0
    weights, values = weights[told] / weights[told].sum(), found[told]
    mean = float(np.sum(weights * values))
    expected = math.sqrt(float(np.sum(weights * values**2)))
    relative = math.sqrt(float(np.sum(weights * np.expm1(values) ** 2)))
    return mean, expected, relative, math.sqrt(float(squared[told].min())), int(np.count_nonzero(weights > 0.1 * weights.max()))


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


def _on_film(known: SolvedSet, column: str, place: _Place, problem: Problem):
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


def _film_point(known: SolvedSet, errors: np.ndarray, place: _Place, at: int):
    assert place.modulus is not None and place.thickness is not None
    some = known["film_surfaces"]
    squared = _surface_distance(known, place, at)[some][:, None]
    moduli, thicknesses = known["films"].T
    waves = (known["gradient_over_shortest"][some] / known.feature("wave")[some])[:, None]
    by_film = (np.log(moduli / place.modulus[at]) / _FILM_SCALES[0])[None, :]
    by_thickness = np.log(thicknesses[None, :] * waves / place.thickness[at]) / _FILM_SCALES[1]
    loads = known["film_loads"]
    pressure = float(place.pressure[at])
    ends = np.log(loads[..., 0] / pressure), np.log(pressure / loads[..., -1])
    beyond = np.maximum(np.maximum(*ends), 0.0) / _PRESSURE
    found = np.empty(loads.shape[:2])
    for one in np.ndindex(*found.shape):
        found[one] = np.interp(math.log(pressure), np.log(loads[one]), errors[one])
    return _averaged(found.ravel(), (squared + by_film**2 + by_thickness**2 + beyond**2).ravel())


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
