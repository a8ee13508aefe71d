"""Compute the real contact area under a load by area models, each corrected by its error on benchmark surfaces.

An area model computes the area of every sample. The error of a model is the ratio of its area to the solved area. It is
sampled from the errors on benchmark surfaces near the nominal contact (truth.md), and divides the area. This removes the bias
of the model, but keeps how its area depends on load, hardness and roughness. Models of bare Gaussian surfaces are combined with
stacking weights, which best predict benchmark surfaces that were left out of the fit (`make truth`).
"""

import math
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
from stiction.solving.accuracy.solved_near import ContactFeatures
from stiction.solving.choice import Choice
from stiction.solving.points import Points, points_of, solve_points
from stiction.solving.problem import Problem, make_problem
from stiction.solving.state import state_of
from stiction.studies.prediction.area_weights import area_weights
from stiction.studies.prediction.finish import SHARPEST
from stiction.studies.prediction.sampled_case import SampledCase, rows_of

_SUM, _FEWEST = "greenwood_williamson_1966", "roughness_parameter"
_ON_FILM = ((Choice("rough_on_film", tangential="none"), 1.0),)
# A film that the area law refuses: no benchmark surface is near, and the interval widens.
_OTHER_FILMS = (
    (Choice(_SUM, asperity="zhao_maietta_chang_2000", film="layered", tangential="none"), 0.5),
    (Choice(_SUM, asperity="zhao_maietta_chang_2000", film="sequential", tangential="none"), 0.5),
)
# Only asperity sums accept heights that are not Gaussian.
_OTHER_HEIGHTS = ((Choice(_SUM, asperity="zhao_maietta_chang_2000", tangential="none"), 1.0),)
# Standard deviation of ln of the area where no solved surface is near, a judgement (grade C): a factor of 2 at 90 %.
_FAR, _FAR_ON_MAP = 0.42, 0.03  # second value: the map itself was solved, but at larger loads only
# Area fraction of the nominal contact above which a sample without a result counts as pressed flat. Below it, the spots
# would exceed the hardness, and the area of the sample is the smallest that carries the load.
_HALF, _MOST = 0.5, 1.0 - 1e-9
_LARGEST_BELOW_1, _LOG_CLOSED = 1.0 - 2.0**-53, math.log(1e-300)
_POWER = 3.5  # exponent m of (elastic^m + plastic^m)^(1/m), which combines elastic and plastic area
_SOLVED = 0.005  # standard deviation of ln of the solved areas themselves, for surfaces described by roughness parameters
# Quantiles of few surfaces are too narrow: they are widened by 1 + this over the number of surfaces. If designs of the
# benchmark set are left out one by one, the 90 % interval by numbers and kind then contains 89 % instead of 86 %. The second
# value is used if Ssk, Sku or Str is stated without the kind: if all surfaces generated in one way are left out, the interval
# then contains 91 % (with 2: 88 %).
_OF_FEW, _OF_FEW_SHAPED = 2.0, 6.0


def grown_to(area: np.ndarray, factor: np.ndarray, nominal: np.ndarray) -> np.ndarray:
    """Return an area [m2] enlarged or reduced by a factor, with saturation: the result never exceeds the nominal area [m2].

    The result is A_n (1 - (1 - A/A_n)^factor) for the area A and the nominal area A_n. It is close to factor A where A and this
    product are much smaller than A_n. If A is A_n or more, 1 - A/A_n is taken as 1e-300. NaN gives NaN.
    """
    share = area / nominal
    # log1p, because 1 - share loses a share of 1e-16 in round-off. A closed contact stays closed, and NaN stays NaN.
    log_open = np.where(share >= 1.0, _LOG_CLOSED, np.log1p(-np.minimum(share, _LARGEST_BELOW_1)))
    return nominal * -np.expm1(log_open * factor)


@dataclass(frozen=True)
class AreaLaw:
    """Store the real contact area by one area model, with its errors on benchmark surfaces, for n samples and m loads.

    name: name of the model. weight: weight (m,), 0 where the model is not used. log_area: ln of the area [m2], (n or 1, m).
    Where the model gives no area for a sample, log_area is inf if the nominal contact is at least half closed, else -inf. It is
    NaN for an impossible surface. share: real over nominal area of the nominal contact (m,), 1 where the model gives no area.
    levels: quantiles (m, 5) of ln(area/benchmark area), at errors_near.LEVELS. far: distance (m,) to the nearest benchmark
    surface, from 0 (near) to 1 (none is similar). sample: standard error (m,) of ln(area) because a scan is one finite window
    of the surface; 0 without a scan. touching: number of asperities in contact (m,), infinite if unknown. yields_at: mean
    pressure (n or 1, m) of plastic contact spots [Pa]. far_error: standard deviation of ln of the elastic area if no benchmark
    surface is near. elastic: real over nominal area (m,) of the nominal contact on a film without plastic flow; 0 if unknown
    or without a film. sources: bibliography keys of the model and its laws.
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
    sources: tuple[str, ...]

    def at_load(self, index: int) -> "AreaLaw":
        """Return the results of the model at one load of a single contact; index: position of this load among the m loads."""
        each = {field.name: getattr(self, field.name) for field in fields(self) if field.name != "levels"}
        arrays: dict[str, Any] = {
            name: field[..., [index]] for name, field in each.items() if isinstance(field, np.ndarray) and field.shape[-1] > 1
        }
        return replace(self, levels=self.levels[[index]], **arrays)

    def corrected(self, rows: np.ndarray, loads: np.ndarray, level: np.ndarray, nominal: np.ndarray) -> np.ndarray:
        """Return the area [m2] (n, m) after correction for sampled errors of the model.

        rows: index of the sampled numbers of each sample (n,). loads: loads (m,) [N]. level: quantile levels (n,) of the error;
        a higher level gives a smaller area. nominal: nominal area [m2] (n, m or 1), a limit of the area. The area is at least
        the load over the pressure of plastic spots. Far from all benchmark surfaces, the errors on the nearest ones are
        used, and the elastic part of the area becomes more uncertain. Elastic and plastic area are combined as (elastic^m +
        plastic^m)^(1/m), as in the model persson_widened.
        """
        from scipy.special import ndtri

        score = ndtri(level)
        near = np.array([_between(score, levels) for levels in self.levels]).T
        area = np.exp(rows_of(self.log_area, rows))
        plastic = loads / rows_of(self.yields_at, rows)
        area = np.maximum(grown_to(np.minimum(area, nominal), self._factor(near), nominal), plastic)
        of_plastic = plastic**_POWER
        of_elastic = np.maximum(area**_POWER - of_plastic, 0.0)
        apart, of_far = np.abs(near - self.levels[:, 2]), self.far_error * score[:, None] * self.far
        more = np.sign(of_far) * (np.sqrt(apart**2 + of_far**2) - apart)  # the two independent errors add up in squares
        wide = (of_elastic * np.exp(-_POWER * more) + of_plastic) ** (1.0 / _POWER)
        return grown_to(np.minimum(area, nominal), wide / area, nominal)

    def _factor(self, error: np.ndarray) -> np.ndarray:
        """Return the factor (n, m) with which `grown_to` removes an error of the area.

        error: error of ln(area), (n, m). With this factor, `grown_to` divides the area of the nominal contact by exp(error),
        but not to more than the nominal area.
        """
        share = np.clip(self.share, 1e-12, _MOST)
        return np.log1p(-np.minimum(share * np.exp(-error), _MOST)) / np.log1p(-share)


def _between(score: np.ndarray, levels: np.ndarray) -> np.ndarray:
    """Return quantiles (n,) at standard normal scores (n,), interpolated linearly between five known quantiles.

    levels (5,): quantiles at the scores NORMAL_SCORES. Beyond the outer scores, the quantile is linear in the score, with the
    mean slope between the outer scores.
    """
    ends = NORMAL_SCORES[0], NORMAL_SCORES[-1]
    slope = (levels[-1] - levels[0]) / (ends[1] - ends[0])
    return np.interp(score, NORMAL_SCORES, levels) + slope * (score - np.clip(score, *ends))


def area_laws(sampled: SampledCase) -> list[AreaLaw]:
    """Return the area models that apply to a contact, with weights that sum to 1 at each point.

    A point is a contact at a load. Sets of models are tried in turn. A later set is used at the points where no model of an
    earlier set applies; where the weight of a model is reduced (see `_law`), the later set gets the remaining weight.

    Raises InputError or ArithmeticError if no model applies at some point. The error is also raised if a model refuses several
    contacts together but accepts the first or the last of them, because the model then applies to some of them; the caller
    divides such a batch.
    """
    answers, refusal, left = [], None, np.ones(len(sampled.loads))
    for choices in _in_turn(sampled):
        laws, applies = [], np.zeros(len(left))
        for choice, weight in choices:
            try:
                laws.append(_law(sampled, choice, weight))
                applies = np.maximum(applies, laws[-1].weight / weight)
            except (InputError, ArithmeticError) as error:
                if sampled.contacts > 1 and any(_answers(end, choice) for end in sampled.ends()):
                    raise  # the model applies to some of these contacts
                refusal = error
        total = np.sum([law.weight for law in laws], axis=0)
        answers += [replace(law, weight=left * applies * law.weight / np.where(total > 0.0, total, 1.0)) for law in laws]
        left = left * (1.0 - applies)
        if not left.any():
            return answers
    if answers and (left < 1.0).all():
        return [replace(law, weight=law.weight / (1.0 - left)) for law in answers]
    assert refusal is not None
    raise refusal


def _in_turn(sampled: SampledCase) -> tuple[tuple[tuple[Choice, float], ...], ...]:
    """Return the sets of area models in the order in which `area_laws` tries them; a set is a tuple of (model, weight)."""
    contact = sampled.contact
    if contact.has_film:
        return _ON_FILM, _OTHER_FILMS
    if sampled.on_map:
        return area_weights("map"), area_weights("numbers")
    if contact.heights[0] != "gaussian":
        return (_OTHER_HEIGHTS,)
    known = "shape" if contact.surface_shape else "numbers"
    return (area_weights(known if contact.surface_kind is None else "kind"),)


def _answers(sampled: SampledCase, choice: Choice) -> bool:
    try:
        _law(sampled, choice, 1.0)
    except (InputError, ArithmeticError):
        return False
    return True


def _law(sampled: SampledCase, choice: Choice, weight: float) -> AreaLaw:
    """Return the area of all samples by one model, with its errors on benchmark surfaces.

    choice: the model. weight: its weight. If the model refuses a contact because the product of asperity density, radius and
    height deviation is smaller than a Gaussian surface can have, the area is computed with the smallest product of a Gaussian
    surface. The weight then decreases with the actual product, to 0 at half of this smallest product. Raises InputError or
    ArithmeticError if the model refuses any contact for another reason, or has no weight for all contacts.
    """
    try:
        points, tables = _solved(sampled, choice)
    except InputError as error:
        share = sampled.gaussian_share
        if error.field != _FEWEST or (share == 1.0).all() or not share.any():
            raise
        law = _law(sampled.as_gaussian(), choice, weight)
        return replace(law, weight=share * law.weight)
    nominal = sampled.nominal(choice.model_key)
    errors = measured_errors(points.problem, tables, most_points=math.inf)
    places = sampled.places(points.dims)
    unit = np.broadcast_to(aligned(points.factors[QUANTITIES["contact_area"].scale], points.dims), points.wanted.shape)
    area = (tables["contact_area"].reshape(unit.shape) * unit).reshape(1, -1)[:, places]
    if "mean_separation" in tables:  # if no separation carries the load, the other results belong to another load
        area = np.where(np.isnan(tables["mean_separation"]).reshape(1, -1)[:, places], np.nan, area)
    drawn, flat = area, ~(area < _HALF * sampled.column(nominal.nominal_area))
    if sampled.levels.size:
        drawn = sampled.areas(choice) if nominal.map is None else area * sampled.by_numbers().variation(choice)
    drawn = np.where(np.isnan(drawn), np.where(flat, np.inf, 0.0), drawn)
    drawn = np.where(_too_sharp(sampled), np.nan, drawn)
    state = state_of(points.problem, tables)
    touching = np.ravel(state.get("touching_asperities", np.full(points.wanted.shape, np.inf)))[places]
    with np.errstate(divide="ignore"):
        far_error = _FAR if nominal.map is None else _FAR_ON_MAP
        yields_at = _yields_at(sampled, state.get("pressure_over_body_below"), places, area)
        few = _OF_FEW_SHAPED if nominal.surface_shape and nominal.surface_kind is None else _OF_FEW
        levels, far, sample = (table[places] for table in _known(errors, few if nominal.map is None else None))
        share = np.nan_to_num(area / sampled.column(nominal.nominal_area), nan=1.0)[0]
        name = replace(choice, tangential=None).name
        elastic = _elastic(points.problem, tables)[places]
        weights = np.full(len(sampled.loads), weight)
        sources = tuple(source.key for record in points.problem.records() for source in record.sources)
        return AreaLaw(
            name, weights, np.log(drawn), share, levels, far, sample, touching, yields_at, far_error, elastic, sources
        )


def _solved(sampled: SampledCase, choice: Choice) -> tuple[Points, Mapping[str, np.ndarray]]:
    """Solve one model for the nominal contacts at their loads; return the points and the results.

    The results are normalised arrays by name. Where no separation carries the load, the mean separation is NaN, and the other
    results are those at separation 0. Raises InputError or ArithmeticError if the model refuses a contact.
    """
    points = points_of(make_problem(sampled.nominal(choice.model_key), choice), sampled.load)
    return points, solve_points(points, refuse=False).tables


def _elastic(problem: Problem, tables: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return the real over nominal area (k,) that a model for films gives without plastic flow; 0 if unknown.

    It is also 0 for models that are not for films. tables: normalised results of the model at k points, by name.
    """
    load, area = (np.asarray(tables[name]).reshape(len(problem.groups), -1) for name in ("load", "contact_area"))
    if not problem.record.on_film:
        return np.zeros(load.size)
    return np.nan_to_num(shares_on_film(problem, ContactFeatures.of(problem, load), area)[0])


def _too_sharp(sampled: SampledCase) -> np.ndarray:
    """Return a mask (n or 1, m or 1) of samples with an impossible surface: height deviation above the asperity radius.

    Where every sample is impossible, the mask is False, so that the contact still has a result.
    """
    rough = sampled.drawn.roughness
    sharp = sampled.column(rough.asperity_height_deviation / rough.asperity_radius) > SHARPEST
    return sharp & ~sharp.all(axis=0)


def _known(errors: MeasuredErrors, few: float | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return error quantiles (k, 5) of a model at k points, the distance to the benchmarks (k,), and the sampling error (k,).

    The quantiles are those of ln(area/benchmark area), 0 where unknown. Quantiles from few surfaces are too narrow: with n
    benchmark surfaces near a point, the distance of each quantile from the median is multiplied by 1 + few/n. The error of the
    benchmark areas themselves, _SOLVED, is then added in quadrature. If few is None, because the area is computed from a map,
    neither is done: the quantiles already contain the error of the solution. The distance to the nearest benchmark surface is 0
    to 1, and 1 where no similar surface was solved. The sampling error is the standard error of ln(area) because a map is one
    window of a larger surface; it is 0 if unknown.
    """
    known = np.isfinite(errors.levels).all(axis=1)
    trust = np.where(known, np.clip(errors.trust, 0.0, 1.0), 0.0)
    levels = np.where(known[:, None], errors.levels, 0.0)
    scores, middle = np.array(NORMAL_SCORES), levels[:, 2:3]
    if few is not None:  # otherwise the quantiles already contain the error of the solution
        wider = 1.0 + few / np.maximum(errors.surfaces[:, None], 1.0)
        levels = middle + np.sign(scores) * np.hypot(wider * (levels - middle), _SOLVED * scores)
    return levels, 1.0 - trust, np.nan_to_num(errors.sample)


def _yields_at(sampled: SampledCase, over_below: np.ndarray | None, places: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Return the mean pressure of plastic contact spots [Pa], (n or 1, m), for n samples at m points (contacts at a load).

    It is the hardness of each sample, or the pressure at which the body below a hard film yields if that is smaller.
    over_below: mean pressure over that yield pressure at the solved points; None without a film. places: index of the solved
    point for each point (m,). area: area of the nominal contact [m2] (1, m).
    """
    hardness = sampled.bodies.hardness
    if over_below is None:
        return np.broadcast_to(hardness, (len(hardness), area.shape[1]))
    return np.fmin(hardness, sampled.loads / area[0] / np.ravel(over_below)[places])
