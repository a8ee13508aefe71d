"""The contact area that carries the load: area laws, each corrected by its measured error, combined by stacking.

A law's area on the drawn contacts is divided by its error on solved surfaces near the nominal contact, drawn from the
distribution of that error over those surfaces (docs/truth.md). What is left of a law is how it follows load, hardness and
roughness; its bias is gone. Laws are combined by weights that score best on solved surfaces left out (`make truth`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from stiction.quantities.dimensions import aligned
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.solving.accuracy.errors_near import NORMAL_SCORES
from stiction.solving.accuracy.film_errors import shares_on_film
from stiction.solving.accuracy.measured_error import MeasuredErrors, measured_errors
from stiction.solving.accuracy.solved_near import Place
from stiction.solving.choice import Choice
from stiction.solving.points import Points, points_of, solve_points
from stiction.solving.problem import Problem, make_problem
from stiction.solving.state import state_of
from stiction.studies.prediction.area_weights import area_weights
from stiction.studies.prediction.asked import Asked

__all__ = ["AreaLaw", "area_laws", "grown_to"]

_SUM, _FEWEST = "greenwood_williamson_1966", "roughness_parameter"
_ON_FILM = ((Choice("rough_on_film", tangential="none"), 1.0),)
# A film that the area law refuses: no solved surface is near, and the width says so.
_OTHER_FILMS = (
    (Choice(_SUM, asperity="zhao_maietta_chang_2000", film="layered", tangential="none"), 0.5),
    (Choice(_SUM, asperity="zhao_maietta_chang_2000", film="sequential", tangential="none"), 0.5),
)
# Heights that are not Gaussian are known to sums alone.
_OTHER_HEIGHTS = ((Choice(_SUM, asperity="zhao_maietta_chang_2000", tangential="none"), 1.0),)
# Standard deviation of ln of the area where no solved surface is near, a judgement (grade C): a factor of 2 at 90 %.
_FAR, _FAR_ON_MAP = 0.42, 0.03  # the latter of the solution of a map, which only the light load sets apart
# Share of the nominal area from which on a law that says nothing of a draw means that it is pressed flat; below, that spots
# would bear more than they can: then the area is the least that carries the load.
_HALF, _MOST = 0.5, 1.0 - 1e-9
_SHARPEST = 1.0  # sigma over R: asperities of a draw that are higher than their tips are wide cannot be
_POWER = 3.5  # of the mean of elastic and plastic area
_SOLVED = 0.005  # standard deviation of ln of what the solved areas are known to of surfaces that are known by numbers
# Quantiles of few surfaces are too narrow: by this, over their number, they are widened. Leaving designs of the benchmark set
# out one by one, the 90 % interval by numbers and kind then holds 89 % in place of 86 %.
_OF_FEW = 2.0


def grown_to(area: np.ndarray, factor: np.ndarray, nominal: np.ndarray) -> np.ndarray:
    """Return an area that grows by a factor while it is small, and to the nominal one at most."""
    open_share = np.maximum(1.0 - area / nominal, 1e-300)
    return nominal * -np.expm1(np.log(open_share) * factor)


@dataclass(frozen=True)
class AreaLaw:
    """Hold the area by one law.

    name: of the law. weight: by stacking, (m,), 0 where the law has no result. log_area: ln of the area [m2], array (n, m)
    over draws and loads. share: area of the nominal contact over its nominal area (m,), by which the errors are looked up.
    levels: quantiles of ln(A/solved A), array (m, 5), see errors_near.LEVELS. far: distance (m,) of the nearest solved
    surface, 0 to 1. sample: standard error of ln of the area of one window, (m,). touching: number of touching asperities
    (m,), infinite where it is unknown. yields_at: mean pressure of spots (n or 1, m) that flow [Pa]. far_error: standard
    deviation of ln of the area where no solved surface is near. elastic: of the nominal contact on a film, area over the
    nominal one without flow (m,); 0 where it is unknown.
    """

    name: str
    weight: np.ndarray
    log_area: np.ndarray
    share: np.ndarray
    levels: np.ndarray
    far: np.ndarray
    sample: np.ndarray
    touching: np.ndarray
    yields_at: np.ndarray
    far_error: float
    elastic: np.ndarray

    def at_load(self, at: int) -> "AreaLaw":
        """Return the law at one of the loads of one contact."""
        each = {one.name: getattr(self, one.name) for one in fields(self) if one.name != "levels"}
        arrays: dict[str, Any] = {
            name: one[..., [at]] for name, one in each.items() if isinstance(one, np.ndarray) and one.shape[-1] > 1
        }
        return replace(self, levels=self.levels[[at]], **arrays)

    def corrected(self, rows: np.ndarray, loads: np.ndarray, level: np.ndarray, nominal: np.ndarray) -> np.ndarray:
        """Return the area [m2] (n, m) of these rows of the inputs, without the error at these quantile levels (n,).

        Spots that flow bound it from below: no area is less than the load over their pressure. Where no solved surface is near,
        the nearest tell, and the part that is elastic is uncertain: area is a power mean of both, as in the law
        (persson_widened). nominal: area [m2] (n, 1).
        """
        from scipy.special import ndtri

        score = ndtri(level)
        near = np.array([_between(score, levels) for levels in self.levels]).T
        area = np.exp(self.log_area[rows])
        plastic = loads / self.yields_at[rows % len(self.yields_at)]
        area = np.maximum(grown_to(np.minimum(area, nominal), self._factor(near), nominal), plastic)
        elastic = np.maximum(area**_POWER - plastic**_POWER, 0.0) ** (1.0 / _POWER)
        apart, of_far = np.abs(near - self.levels[:, 2]), self.far_error * score[:, None] * self.far
        more = np.sign(of_far) * (np.hypot(apart, of_far) - apart)  # both errors together are as wide as their root sum square
        wide = ((elastic * np.exp(-more)) ** _POWER + plastic**_POWER) ** (1.0 / _POWER)
        return grown_to(np.minimum(area, nominal), wide / area, nominal)

    def _factor(self, error: np.ndarray) -> np.ndarray:
        """Return the factor of `grown_to` that takes this error (n, m) off the area of the nominal contact."""
        share = np.clip(self.share, 1e-12, _MOST)
        return np.log1p(-np.minimum(share * np.exp(-error), _MOST)) / np.log1p(-share)


def _between(score: np.ndarray, levels: np.ndarray) -> np.ndarray:
    """Return the quantile at normal scores (n,), by linear interpolation.

    Beyond the last level it is that of a normal distribution with the width of all levels.
    """
    ends = NORMAL_SCORES[0], NORMAL_SCORES[-1]
    slope = (levels[-1] - levels[0]) / (ends[1] - ends[0])
    return np.interp(score, NORMAL_SCORES, levels) + slope * (score - np.clip(score, *ends))


def area_laws(asked: Asked) -> list[AreaLaw]:
    """Return the laws that apply to a contact, with weights that sum to 1 at each point.

    Laws of later rank apply where no earlier one does. Raises InputError where none does.
    """
    found, refusal, left = [], None, np.ones(len(asked.loads), dtype=bool)
    for choices in _in_turn(asked):
        laws = []
        for choice, weight in choices:
            try:
                laws.append(_law(asked, choice, weight))
            except (InputError, ArithmeticError) as error:
                if asked.contacts > 1 and any(_answers(one, choice) for one in asked.ends()):
                    raise  # who asks for many divides them: the law answers for some
                refusal = error
        total = np.sum([law.weight for law in laws], axis=0)
        here = left & (total > 0.0)
        found += [replace(law, weight=np.where(here, law.weight / np.where(here, total, 1.0), 0.0)) for law in laws]
        left = left & ~here
        if not left.any():
            return found
    assert refusal is not None
    raise refusal


def _in_turn(asked: Asked) -> tuple[tuple[tuple[Choice, float], ...], ...]:
    """Return the sets of laws in their order, each if the one before refuses."""
    contact = asked.contact
    if contact.has_film:
        return _ON_FILM, _OTHER_FILMS
    if asked.on_map:
        return area_weights("map"), area_weights("numbers")
    if contact.heights[0] != "gaussian":
        return (_OTHER_HEIGHTS,)
    return (area_weights("numbers" if contact.surface_kind is None else "kind"),)


def _answers(asked: Asked, choice: Choice) -> bool:
    try:
        _law(asked, choice, 1.0)
    except (InputError, ArithmeticError):
        return False
    return True


def _law(asked: Asked, choice: Choice, weight: float) -> AreaLaw:
    """Return the area by one law.

    Its weight is 0 for contacts that it refuses for having fewer asperities than a Gaussian surface. Raises InputError,
    ArithmeticError.
    """
    try:
        points, tables = _solved(asked, choice)
    except InputError as error:
        is_gaussian = asked.is_gaussian
        if error.field != _FEWEST or is_gaussian.all() or not is_gaussian.any():
            raise
        law = _law(asked.as_gaussian(), choice, weight)
        return replace(law, weight=np.where(is_gaussian, law.weight, 0.0))
    nominal = asked.nominal(choice.model_key)
    errors = measured_errors(points.problem, tables)
    places = asked.places(points.dims)
    unit = np.broadcast_to(aligned(points.factors[QUANTITIES["contact_area"].scale], points.dims), points.wanted.shape)
    area = (tables["contact_area"].reshape(unit.shape) * unit).reshape(1, -1)[:, places]
    if "mean_separation" in tables:  # results where a load is nowhere carried are those at another one
        area = np.where(np.isnan(tables["mean_separation"]).reshape(1, -1)[:, places], np.nan, area)
    drawn, flat = area, ~(area < _HALF * asked.column(nominal.nominal_area))
    if asked.levels.size:
        drawn = asked.areas(choice) if nominal.map is None else area * asked.by_numbers().variation(choice)
    drawn = np.where(np.isnan(drawn), np.where(flat, np.inf, 0.0), drawn)
    drawn = np.where(_too_sharp(asked), np.nan, drawn)
    state = state_of(points.problem, tables)
    touching = np.ravel(state.get("touching_asperities", np.full(points.wanted.shape, np.inf)))[places]
    with np.errstate(divide="ignore"):
        far_error = _FAR if nominal.map is None else _FAR_ON_MAP
        yields_at = _yields_at(asked, state.get("pressure_over_body_below"), places, area)
        levels, far, sample = (one[places] for one in _known(errors, nominal.map is not None))
        share = np.nan_to_num(area / asked.column(nominal.nominal_area), nan=1.0)[0]
        name = replace(choice, tangential=None).name
        elastic = _elastic(points.problem, tables)[places]
        weights = np.full(len(asked.loads), weight)
        return AreaLaw(name, weights, np.log(drawn), share, levels, far, sample, touching, yields_at, far_error, elastic)


def _solved(asked: Asked, choice: Choice) -> tuple[Points, Mapping[str, np.ndarray]]:
    """Return the points of a law on the nominal contacts, and its results there. Raises InputError, ArithmeticError."""
    points = points_of(make_problem(asked.nominal(choice.model_key), choice), asked.load)
    return points, solve_points(points, refuse=False).tables


def _elastic(problem: Problem, tables: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return area over nominal area (k,) without flow at results of a film law; else 0."""
    load, area = (np.asarray(tables[name]).reshape(len(problem.groups), -1) for name in ("load", "contact_area"))
    if not problem.record.on_film:
        return np.zeros(load.size)
    return np.nan_to_num(shares_on_film(problem, Place.of(problem, load), area)[0])


def _too_sharp(asked: Asked) -> np.ndarray:
    """Return which draws (n or 1, m or 1) have a surface that cannot be; none where the nominal one is such."""
    rough = asked.drawn.roughness
    found = asked.column(rough.asperity_height_deviation / rough.asperity_radius) > _SHARPEST
    return found & ~found.all(axis=0)


def _known(errors: MeasuredErrors, on_map: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return levels, how far nothing is known, and the error of the sample, at each load."""
    known = np.isfinite(errors.levels).all(axis=1)
    trust = np.where(known, np.clip(errors.trust, 0.0, 1.0), 0.0)
    levels = np.where(known[:, None], errors.levels, 0.0)
    scores, middle = np.array(NORMAL_SCORES), levels[:, 2:3]
    if not on_map:  # else the error of the solution is in them
        few = 1.0 + _OF_FEW / np.maximum(errors.surfaces[:, None], 1.0)
        levels = middle + np.sign(scores) * np.hypot(few * (levels - middle), _SOLVED * scores)
    return levels, 1.0 - trust, np.nan_to_num(errors.sample)


def _yields_at(asked: Asked, over_below: np.ndarray | None, places: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Return the mean pressure of spots that flow.

    It is the hardness of each draw, or the pressure that the body below a hard film carries. over_below: pressure over that of
    the body below, at the solved points; places: index of the solved point of each point.
    """
    hardness = asked.bodies.hardness
    if over_below is None:
        return np.broadcast_to(hardness, (len(hardness), area.shape[1]))
    return np.fmin(hardness, asked.loads / area[0] / np.ravel(over_below)[places])
