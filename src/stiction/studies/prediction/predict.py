"""Predict the friction coefficient of a contact, with a calibrated interval."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from numbers import Real
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from stiction.case.read import Case, as_case, case_in
from stiction.case.uncertain import Uncertain, named, with_ranges
from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.solving.choice import RECOMMENDED
from stiction.studies.prediction.beside import bare_metal, checked_against, in_handbooks
from stiction.studies.prediction.finish import with_finish
from stiction.studies.prediction.levels import Levels, draw_levels
from stiction.studies.prediction.measured import Measured, chosen_draws, interval_after_measuring, read_measured
from stiction.studies.prediction.mixture import Mixture, Samples
from stiction.studies.prediction.regime import enlarged_by, mu_by_state, next_step, regime_of, warnings_of
from stiction.studies.prediction.sampled_case import SampledCase
from stiction.studies.prediction.shares import shares_of_variance
from stiction.studies.prediction.sources import beside_area, sources_of
from stiction.studies.prediction.unused import not_used, refusal_of
from stiction.studies.pressing_loads import pressing_loads

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike

    from stiction.case.arguments import CaseLike
    from stiction.quantities.arguments import FilePath, QuantityLike

COUNT, _MANY = 512, 16384  # number of samples by default, and with measured values
_FAR_LOAD = 3.0  # factor beyond the range of measured loads above which the prediction has a warning
_UNTOLD = 0.8  # ratio of interval widths, after over before measuring, above which a number counts as not determined
_NEAR_END = 0.1  # quantile level beyond which an updated interval ends where the stated distribution does
_STRENGTH = "interfacial_shear_strength"


def predict(
    contact: "Contact | CaseLike",
    *,
    load: "QuantityLike | None" = None,
    level: float | None = None,
    measured: "FilePath | None" = None,
) -> "xarray.Dataset":
    """Predict the static friction of a contact, with an interval.

    Parameters
    ----------
    contact : Contact, Case, dict or path
        A contact, or a case as for `read_case`; its numbers may be arrays. The uncertain numbers of a case are sampled. Numbers
        of material presets are sampled within their ranges, unless the case switches that off.
    load : number, text with a unit, or a sequence of these, optional
        Normal load [N], above 0; by default the loads above 0 of the case.
    level : float, optional
        Coverage probability of the interval, between 0 and 1; by default the coverage that the case states, or 0.9.
    measured : path, optional
        CSV file of measured friction of this contact, with the columns `load [N],friction_coefficient`. Samples are then
        weighted by their agreement with the measured values.

    Returns
    -------
    xarray.Dataset
        Over `load` and the dimensions of array parameters: medians of `friction_coefficient`, `friction_force` [N] and
        `contact_area` [m^2]; `_low` and `_high` of each, the ends of the interval; and `friction_coefficient_samples` (sample,
        load). If a weakening slip lowers friction, also `friction_efficiency`, the force over the sum of strengths. Without
        array parameters, a `load` given as one number or text is not a dimension.

        Attributes, at the middle load: `level`, `regime` (sentences), `lowered_by` (what would lower mu), `enlarged_by` (cause
        -> factor of the contact area, for junction growth and adhesion), `shares` (part -> fraction of the variance of ln mu),
        `warnings` (a list, the most serious first), `inputs_not_used` (a list), `next_step` (what to measure or state next),
        `after_measuring` (interval of mu that one measurement with 15 % error would leave), `models` (area model -> weight),
        `beside_area` (laws of menisci and contamination that apply), `sources` (bibliography keys, for `st.cite`); over all
        loads: `excluded` (fraction of impossible samples), `strength` (tau_0 [Pa]: median and ends of the interval).

        With measured friction, `shares` and `next_step` are empty. If the case states uncertain numbers, `value`, `low` and
        `high` over `parameter` are their updated values, and `verdict` names those that the measurement does not determine, or
        bounds from one side only.

        With array parameters there are no samples and no regime, shares or next step. The attributes are `level`, `draws`
        (samples per contact), `model`, `sources` and `refused` (number of points, each a contact at a load, without an answer).
        If there are such points, `why_refused` is the reason for the first of them.

    Raises
    ------
    InputError
        A number is out of bounds, no load is above 0, a load exceeds hardness times nominal area, no area model applies, the
        case has [indices], or a stated input would decide friction but predictions cannot use it. With array parameters, a
        refused point is NaN, and an error is raised only if all points are refused.

    Notes
    -----
    mu = e (tau_0 A + alpha W)/P. P is the load, W = P + pull the load with the adhesive pull, and A the contact area under
    W. tau_0 is the shear strength of the interface at zero pressure, and alpha its increase with pressure. These are
    sampled together: the inputs; tau_0 and alpha by the state of the interface; the area, by models whose errors on
    benchmark surfaces near the contact are known; the pull of adhesion and menisci; the growth of plastic junctions under
    shear; and random scatter if few asperities touch. The efficiency e is 1 unless a weakening slip is stated; then contact
    spots slip one after another (docs/explanation/onset.md). The bodies set limits: tau_0 is at most the shear strength of
    the weaker body, A at most the nominal area, and the pressure at most the hardness.

    Examples
    --------
    >>> import stiction as st
    >>> pair = st.Contact(
    ...     first="copper", second="copper", interface="oxidised metal", nominal_area="1 cm^2",
    ...     roughness=dict(asperity_height_deviation="0.2 um", asperity_radius="20 um", asperity_density="1e10 1/m^2"),
    ... )
    >>> answer = st.predict(pair, load="10 N")
    >>> bool(answer.friction_coefficient_low < answer.friction_coefficient < answer.friction_coefficient_high)
    True
    """
    if level is not None and not (isinstance(level, Real) and 0.0 < level < 1.0):
        raise InputError("level", level, "a probability above 0 and below 1, e.g. 0.9")
    case = case_given(contact, load)
    level = case.uncertainty.coverage if level is None else level
    if (refusal := refusal_of(case)) is not None:
        raise refusal
    if case.is_swept:
        from stiction.studies.prediction.many import predict_swept  # imported here, because it imports this module

        if measured is not None:
            raise InputError("--data", str(measured), "a single contact: the case has array parameters")
        return predict_swept(case, level)
    stated = case.uncertain
    case, (loads, working_index) = with_uncertain(case), pressing_loads(case)
    if not loads.size:
        largest_load = None if case.load is None else case.subject.show(float(case.load.max()), "load")
        raise InputError("load", largest_load, "> 0 N; the case has no compressive load")
    if measured is None:
        levels = draws_of(case)
        mixture = Mixture.of(SampledCase(case, loads, levels.inputs))
        samples = mixture.samples(levels, np.arange(len(levels)))
        shares = shares_of_variance(mixture, levels, working_index)
        by_state = mu_by_state(mixture, levels, working_index, level)
        attributes = _attributes(mixture, samples, working_index, level, shares, by_state)
    else:
        samples, attributes, updated = _given(read_measured(measured, case), case, loads, working_index, level, stated)
    data = _dataset(samples, loads, level).assign_attrs(attributes)
    data = data if measured is None else data.assign(updated)
    data = data.assign_attrs({"case": case.title} if case.title else {}, working_load=float(loads[working_index]))
    return data.isel(load=0) if load is not None and np.ndim(cast("ArrayLike", load)) == 0 else data


def is_predicted(case: Case) -> bool:
    """Return whether a case is evaluated by `predict`, which combines many models, instead of by one model.

    This is so if the case has a [contact] and names no model, law or option, or only the model "recommended". Raises InputError
    if it names "recommended" together with a law or an option, or with [indices].
    """
    named = {name: value for name, value in case.choice.arguments().items() if value is not None}
    is_recommended = named.pop("model", None) == RECOMMENDED
    if named or not isinstance(case.subject, Contact):
        if is_recommended:
            allowed = f"the key of a model, or no {', '.join(named)}" if named else "a case with [contact] instead of [indices]"
            raise InputError("model", RECOMMENDED, allowed)
        return False
    return is_recommended or case.choice.model is None


def prediction_of(case: Case, load: float | None) -> "xarray.Dataset | None":
    """Return the prediction of a case at a load [N]; None if no prediction is possible.

    No prediction is possible if `load` is None, for a case with [indices], and for an input that decides friction but that
    predictions cannot use. Raises InputError if `predict` refuses the case for another reason.
    """
    if load is None or not isinstance(case.subject, Contact) or refusal_of(case) is not None:
        return None
    return predict(case, load=load)


def case_given(given: Any, load: Any) -> Case:
    """Return a case from a contact, a case, a dict of tables or the path of a case file.

    load: loads above 0, in N or as texts with units, that replace the loads or separations of the case; None keeps them. Raises
    InputError for another load, for a contact without loads and for a case with [indices].
    """
    if isinstance(given, Contact):
        if load is None:
            raise InputError("load", None, 'a load above 0, e.g. load="1 N"')
        swept = {("contact", *name.split(".")): array for name, array in given.arrays()}
        case = case_in({"contact": given, "solve": {"load": ["1 N"]}})
        case = replace(case, swept=swept)
    else:
        case = as_case(given)
    if not isinstance(case.subject, Contact):
        raise InputError("indices", InWords("given"), "[contact] instead, because a prediction needs materials and lengths")
    if load is None:
        return case
    read = case.subject.read
    loads = np.atleast_1d(
        np.asarray([read(value, "load") for value in load] if np.ndim(load) else read(load, "load"), dtype=float)
    )
    if not loads.size or not (np.isfinite(loads) & (loads > 0.0)).all():
        raise InputError(
            "load",
            InWords(show(loads.min(), "load")) if loads.size else None,
            "> 0 N, because mu is the friction force divided by the load",
        )
    return replace(case, load=loads, separation=None)


def with_uncertain(case: Case) -> Case:
    """Return the case with every number that a prediction samples declared as uncertain.

    These are the uncertain numbers of the case, roughness parameters left open by a surface finish, and numbers of materials
    that have a range. If the case states the key `ranges`, true or false, it decides whether materials are sampled.
    """
    if "ranges" not in case.uncertainty.model_fields_set:
        taken = [*case.swept, *(number.path for number in case.uncertain)]
        case = replace(case, uncertain=tuple(named([*case.uncertain, *with_ranges(case.tables, taken)])))
    return with_finish(case)


def stated_count(case: Case, count: int) -> int:
    """Return the number of samples that a case states; `count` if it states none."""
    return case.uncertainty.count if "count" in case.uncertainty.model_fields_set else count


def draws_of(case: Case, count: int = COUNT) -> Levels:
    """Return the quantile levels of all samples of a case; `count`: number of samples if the case states none."""
    return draw_levels(len(case.unknowns), stated_count(case, count), case.uncertainty.seed)


def intervals(samples: Samples, loads: np.ndarray, level: float) -> dict[str, tuple[np.ndarray, dict[str, str]]]:
    """Return the median and both interval ends of each result, as (values (m,), attributes) by name.

    samples: results of n samples at m loads. loads: these loads (m,) [N]. level: coverage probability of the interval.
    Impossible samples are left out; a value is NaN if all samples at its load are impossible. friction_efficiency is included
    only if a sample has one other than 1.
    """
    tables = {"friction_coefficient": samples.force / loads, "friction_force": samples.force, "contact_area": samples.area}
    if (samples.efficiency != 1.0).any():
        tables["friction_efficiency"] = samples.efficiency
    ends = {"": 0.5, "_low": 0.5 - 0.5 * level, "_high": 0.5 + 0.5 * level}
    known = np.isfinite(samples.force)
    results, answered = {}, known.any(axis=0)
    quantile = np.quantile if known.all() else np.nanquantile  # the second takes ten times as long
    for name, table in tables.items():
        quantity, quantiles = QUANTITIES[name], np.full((len(ends), len(answered)), np.nan)
        quantiles[:, answered] = quantile(np.where(known, table, np.nan)[:, answered], list(ends.values()), axis=0)
        for (end, share), values in zip(ends.items(), quantiles, strict=True):
            meaning = f"{quantity.meaning}, " + ("median" if not end else f"quantile {share:.3g}")
            results[name + end] = values, {"units": quantity.unit or "1", "long_name": meaning}
    return results


def _dataset(samples: Samples, loads: np.ndarray, level: float) -> "xarray.Dataset":
    import xarray

    variables: dict[str, tuple] = {name: ("load", *result) for name, result in intervals(samples, loads, level).items()}
    mu = np.where(np.isfinite(samples.force), samples.force / loads, np.nan)
    variables["friction_coefficient_samples"] = (("sample", "load"), mu)
    return xarray.Dataset(variables, coords={"load": ("load", loads, QUANTITIES["load"].attributes)})


def _given(
    known: Measured, case: Case, loads: np.ndarray, working_index: int, level: float, stated: Sequence[Uncertain]
) -> tuple[Samples, dict[str, Any], dict[str, Any]]:
    """Return samples that agree with measured friction, attributes of the prediction, and updated uncertain numbers.

    known: the measured friction. loads: loads of the prediction [N]. working_index: index of the working load among them.
    level: coverage probability. stated: uncertain numbers in the case itself. The last result has their updated medians and
    interval ends as dataset variables with the dimension `parameter`; it is {} without such numbers.
    """
    levels = draw_levels(len(case.unknowns), _MANY, case.uncertainty.seed)
    mixture = Mixture.of(SampledCase(case, np.concatenate([loads, known.load]), levels.inputs))
    samples = mixture.samples(levels, np.arange(_MANY))
    mu = samples.force[:, len(loads) :] / known.load
    rows, warnings = chosen_draws(known, mu, COUNT)
    chosen = samples.some(rows, len(loads))
    attributes = _attributes(mixture, chosen, working_index, level, {})
    weights = mixture.weights_of_laws(levels, rows)
    attributes |= {
        "warnings": [*warnings, *_extrapolates(known, case, loads[working_index]), *attributes["warnings"]],
        "models": weights,
        "measured": len(known.load),
        "measured_error": known.assumed,
        "fixed_strength": int(mixture.strength.stated is not None and len(mixture.strength.stated) == 1),
        "bare_metal": [],
        "next_step": "",
    }
    drawn = case.numbers_at(levels.inputs[rows])
    stated = [number for number in stated if number.path in drawn]  # a height beside a finish is part of the sampled surface
    if not stated:
        return chosen, attributes, {}
    ends = [0.5, 0.5 - 0.5 * level, 0.5 + 0.5 * level]
    values = np.array([np.quantile(drawn[number.path], ends) for number in stated])
    names = [".".join(number.path[1:]) for number in stated]
    left_open: dict[str, list[str]] = {}
    for name, number, updated in zip(names, stated, values, strict=True):
        left_open.setdefault(_left_open(number, updated, np.array(ends[1:])), []).append(name)
    attributes["verdict"] = "; ".join(text.format(", ".join(some)) for text, some in left_open.items() if text)
    if _STRENGTH in names:  # the strength that the weaker body lets act
        values[names.index(_STRENGTH)] = np.quantile(chosen.strength[:, min(working_index, chosen.strength.shape[1] - 1)], ends)
    table = {name: ("parameter", column) for name, column in zip(("value", "low", "high"), values.T, strict=True)}
    return chosen, attributes, {"parameter": names} | table


def _left_open(number: Uncertain, updated: np.ndarray, ends: np.ndarray) -> str:
    """Return a text, with {} for the name, on an uncertain number that measured friction does not determine, else "".

    The text also states if the data bound the number from one side only. updated: median, low and high end of the number after
    the measurement. ends: quantile levels of these two ends.
    """
    if _width(*updated[1:]) > _UNTOLD * _width(*number.at(ends)):
        return "the measured friction does not determine {}"
    low, high = number.at(np.array([_NEAR_END, 1.0 - _NEAR_END]))
    if updated[2] >= high:
        return "the data bound {} only from below"
    return "the data bound {} only from above" if updated[1] <= low else ""


def _extrapolates(known: Measured, case: Case, load: float) -> list[str]:
    """Return a list with a warning if a load [N] is far outside the loads of the measured friction; otherwise [].

    Far outside means above three times the largest or below a third of the smallest of these loads.
    """
    least, most = known.load.min(), known.load.max()
    if least / _FAR_LOAD <= load <= most * _FAR_LOAD:
        return []
    here, low, high = (case.subject.show(float(value), "load", 3) for value in (load, least, most))
    measured = f"measured load, {low}" if least == most else f"measured loads, {low} to {high}"
    return [f"{here} is far from the {measured}: mu there follows from the models."]


def _width(low: float, high: float) -> float:
    """Return the width of an interval, or of its logarithm if the lower end is positive."""
    return math.log(high / low) if low > 0.0 else high - low


def _attributes(
    mixture: Mixture,
    samples: Samples,
    working_index: int,
    level: float,
    shares: Mapping[str, float],
    by_state: Sequence[str] = (),
) -> dict[str, Any]:
    quantiles = [0.5, 0.5 - 0.5 * level, 0.5 + 0.5 * level]
    mu = samples.force[:, working_index] / mixture.sampled.loads[working_index]
    regime, lowered_by = regime_of(mixture, samples, working_index)
    return {
        "level": level,
        "regime": regime,
        "lowered_by": lowered_by,
        "enlarged_by": enlarged_by(mixture, samples, working_index),
        "shares": dict(shares),
        "strength": np.quantile(samples.strength, quantiles).tolist(),
        "pressure_coefficient": np.quantile(samples.coefficient, quantiles).tolist(),
        "warnings": warnings_of(mixture, samples, working_index, shares, by_state),
        "inputs_not_used": not_used(mixture.sampled, mixture.strength, mixture.touching),
        "next_step": next_step(shares, mixture),
        "models": {law.name: float(law.weight[working_index]) for law in mixture.laws if law.weight[working_index] > 0.0},
        "after_measuring": interval_after_measuring(mu, level),
        "beside_area": beside_area(mixture.sampled.contact),
        "sources": sources_of(mixture),
        "excluded": float(np.mean(~np.isfinite(samples.force))),
        "bare_metal": bare_metal(mixture, level),
        "checked_against": checked_against(mixture, working_index),
        "in_handbooks": list(in_handbooks(mixture)),
    }
