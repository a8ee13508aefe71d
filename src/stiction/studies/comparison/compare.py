"""Every model that applies, on one contact: what each says of its friction, and whether the contact fits it."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.contact.subject import Subject, as_subject
from stiction.engine.summation import FARTHEST
from stiction.laws.validity import as_attributes
from stiction.quantities.errors import InputError
from stiction.quantities.inputs import floats
from stiction.quantities.progress import Steps
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import reason_of
from stiction.records.registry import Criterion, of_kind
from stiction.records.validity_warning import ValidityWarning
from stiction.solving.accuracy import film_errors, measured_error
from stiction.solving.candidates import Candidate, candidates
from stiction.solving.choice import Choice
from stiction.solving.conditions import OUTSIDE, leaves_out_liquid, points_outside, warnings_of_results, warnings_of_rounding
from stiction.solving.inversion import Unreachable
from stiction.solving.method_spread import as_measured, with_range_over_methods
from stiction.solving.points import points_of, solve_points
from stiction.solving.problem import Problem, make_problem, problem_of
from stiction.solving.results import labelled
from stiction.solving.state import state_of
from stiction.studies.pressing_loads import pressing_loads

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case
    from stiction.quantities.arguments import QuantityLike

# Mean separations over sigma at which the curves are computed: out of touch to pressed together.
SEPARATIONS = np.linspace(5.0, -2.0, 80)
_ONE = "one number, where models are compared"
# Contact area over the nominal one beyond which a model has failed, and has no numbers.
_MOST_AREA = 100.0
RESULTS = ("mean_separation", "load", "contact_area", "friction_force", "friction_coefficient")


def compare(
    contact: Subject,
    *,
    load: "QuantityLike | None" = None,
    separations: Iterable[float] | None = None,
    progress: Steps = iter,
) -> "xarray.Dataset":
    """Solve one contact with every model that applies to it.

    Parameters
    ----------
    contact : Contact or Indices
        One contact: numbers, no arrays.
    load : float [N] or str with a unit, optional
        Working load, above 0; normalised for Indices. Without it there are only curves.
    separations : iterable of float, optional
        Mean separations of the curves, over the sigma that a model takes; by default 80 from 5 to -2.
    progress : callable
        Receives the list of models and returns an iterator over it, e.g. a progress bar.

    Returns
    -------
    xarray.Dataset
        Curves over (model, point), units as in `solve`: mean_separation [m], load [N], contact_area [m^2], friction_force [N],
        friction_coefficient, and `range_status`: within the claims of the model, outside of them, or impossible (0, 1, 2).
        Over `model`: the same five at the working load, with names that end in `_at_load`; `status`, whether the contact fits
        the model and why not; grade, `outside_validity`, `validity_warnings` (JSON), `family_of_curve`,
        `plastic_junctions_resist`; `measured_area_error`, `measured_area_error_rms` and `measured_friction_error`, relative
        errors on solved surfaces near this contact (docs/truth.md), NaN where there are none; `measured_error` (JSON) and
        `measured_error_in_words`. Attributes: `working_load`, `criteria`, `not_applicable` (model: reason). With a measured
        surface also friction_coefficient_at_load_by_method (asperity_method, model), with `_low` and `_high`.

    Raises
    ------
    InputError
        A number of the contact is an array, or load or separations are out of bounds.

    Notes
    -----
    A theory without a separation is computed at the loads of Greenwood and Williamson, with NaN for mean_separation. Where a
    model has no tangential law and the contact states an interfacial shear strength, a law of the interface computes friction.
    `predict` combines the models into one answer.

    Examples
    --------
    >>> import stiction as st
    >>> table = st.compare(st.Indices(hardness_group=0.1), load=1.0)
    >>> float(table["load_at_load"].sel(model="greenwood_williamson_1966"))
    1.0
    """
    as_subject(contact).require_single(_ONE)
    data = _compared(contact, load, separations, progress)
    if contact.measured is None:
        return data
    return as_measured(_over_methods(data, contact, load, progress), contact.measured)


def _compared(contact: Subject, load: Any, separations: Any, progress: Steps) -> "xarray.Dataset":
    """Return the result of `compare` without the range over asperity methods."""
    h = SEPARATIONS if separations is None else _separations(separations)
    target = None if load is None else _pressing(contact, load, "load")
    groups, _ = Groups.of(contact.indices())
    plain = problem_of(groups.substrate(), Choice("greenwood_williamson_1966", beside={"meniscus": "none"}))  # which never pull
    situation = _Situation(contact, h, plain.loads_on_grid(h) * contact.scales().factors()["N"], target)
    answers = [_ask(situation, one) for one in progress(candidates(contact))]
    return _dataset(contact, answers, target)


def _over_methods(data: "xarray.Dataset", contact: Subject, load: Any, progress: Steps) -> "xarray.Dataset":
    """Return the comparison with the friction of every asperity method at the working load."""
    contacts = contact.measured.contacts(contact)
    name = "friction_coefficient_at_load"
    if name not in data or len(contacts) < 2:
        return data
    each = [
        data[name] if at == 0 else _compared(other, load, [0.0], iter)[name].reindex(model=data["model"])
        for at, other in enumerate(progress(list(contacts.values())))
    ]
    return with_range_over_methods(data, list(contacts), np.array([one.values for one in each]), ("model",), name)


def _separations(given: Iterable[float]) -> np.ndarray:
    """Return the separations of the curves, over sigma."""
    allowed = f"a row of numbers, over sigma, from {-FARTHEST:g} to {FARTHEST:g}"
    try:
        row = list(given)
    except TypeError:
        raise InputError("separations", given, allowed) from None
    h = floats(row, "separations", allowed)
    if h.ndim != 1 or not h.size or not (np.abs(h) <= FARTHEST).all():
        raise InputError("separations", given, allowed)
    return h


@dataclass(frozen=True)
class _Situation:
    """Hold the points at which all candidates are evaluated.

    h: separations over the sigma of each candidate; loads (1, h): for theories without separations; target: the working load or
    None. Loads are in the units of the contact.
    """

    contact: Subject
    h: np.ndarray
    loads: np.ndarray
    target: float | None


# What the friction of a model rests on, by whether it is the strength of the interface.
FAMILIES = {
    True: "strength of the interface",
    False: "strength of the bodies",
}


# Texts of each model -> what stands for one that it does not say; and numbers.
_TEXTS = {
    "grade": "",
    "family_of_curve": "",
    "plastic_junctions_resist": "",
    "measured_film_error": "[]",
    "measured_error": "null",
    "measured_error_in_words": "",
}
_NUMBERS = ("measured_area_error", "measured_area_error_rms", "measured_friction_error")


@dataclass
class _Answer:
    """Hold the results of one candidate, in the units of the contact.

    curve: results (points,); range_status: of each point, WITHIN, OUTSIDE or IMPOSSIBLE. at_load: results at the working load,
    None if it is not carried. outside: validity warnings at the working load, or of the curve without one. told: values of
    _TEXTS and _NUMBERS. dry: whether the liquid of the contact is left out. why_not: the reason for no results, or none of
    friction.
    """

    candidate: Candidate
    curve: dict[str, np.ndarray] = field(default_factory=dict)
    range_status: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    at_load: dict[str, float] | None = None
    outside: list[ValidityWarning] = field(default_factory=list)
    told: dict[str, Any] = field(default_factory=dict)
    dry: bool = False
    sources: list[str] = field(default_factory=list)
    why_not: str = ""

    @property
    def status(self) -> str:
        """Whether the contact fits the model, and why it does not."""
        if self.why_not:
            return f"no answer: {self.why_not}"
        dry = ", without the liquid" if self.dry else ""
        of_chance = [one.in_brief for one in self.outside if one.kind == "statistics"]
        if len(of_chance) == len(self.outside):  # whatever the model
            return "; ".join((f"fits{dry}", *of_chance))
        worst = [one for one in self.outside if one.kind == "impossible"]
        told = list(dict.fromkeys(one.in_brief for one in worst or self.outside))
        more = f" and {len(told) - 2} more" if len(told) > 2 else ""
        return f"{'cannot be right' if worst else 'does not fit'}: {', '.join(told[:2])}{more}{dry}"


def _ask(situation: _Situation, candidate: Candidate) -> _Answer:
    """Return the results of one candidate, or why it has none."""
    answer = _Answer(candidate)
    try:
        problem = make_problem(situation.contact, candidate.choice)
        curve = _curve(problem, situation)
    except InputError as error:
        answer.why_not = reason_of(error)
        return answer
    answer.sources = [source.key for record in problem.records() for source in record.sources]
    if not problem.friction:
        answer.why_not = "of contact only: it needs an interfacial_shear_strength to say anything of friction"
    rows = {name: table[None, :] for name, table in curve.items()}
    at_load = None if situation.target is None else _at_working_load(problem, situation.target, answer)
    answer.told = _of_laws(problem)
    if at_load or situation.target is None:  # of a load that is not carried there is no validity warning
        answer.outside = answer.outside + warnings_of_results(problem, at_load or rows)
        answer.told |= film_errors.as_attributes(problem, at_load or rows)
    answer.dry = leaves_out_liquid(problem)
    answer.curve = _in_units(problem, curve)
    answer.range_status = points_outside(problem, rows)
    if at_load:
        answer.told |= _measured(measured_error.measured_errors(problem, at_load))
        answer.at_load = {name: float(table[0, 0]) for name, table in _in_units(problem, at_load).items()}
    return answer


def _of_laws(problem: Problem) -> dict[str, str]:
    """Return grade, family of friction and resistance of plastic junctions of a model."""
    grade = max(record.grade for record in problem.records())
    tangential = problem.chosen.tangential
    if tangential is None:
        return {"grade": grade}
    family = FAMILIES["shear_strength" in tangential.needs]
    return {"grade": grade, "family_of_curve": family, "plastic_junctions_resist": problem.chosen.yielded}


def _measured(errors: measured_error.MeasuredErrors) -> dict[str, Any]:
    """Return the measured error at the working load: mean of area and mu, rms of the area.

    Relative; NaN where nothing was measured near.
    """
    numbers = np.expm1(errors.area[0]), errors.relative[0], np.expm1(errors.friction[0])
    return measured_error.as_attributes(errors) | dict(zip(_NUMBERS, numbers, strict=True))


def _in_units(problem: Problem, results: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Normalised results in the units of the contact: each model normalises with the sigma, R and N that it takes."""
    factors = problem.subject.scales().factors()
    return {name: table * factors.get(QUANTITIES[name].scale, 1.0) for name, table in results.items()}


def _curve(problem: Problem, situation: _Situation) -> dict[str, np.ndarray]:
    """Normalised results (points,) along the separations, or the loads in their place."""
    if problem.needs_load:
        loads = problem.few_of(situation.loads / problem.subject.scales().factors()["N"])
        return {name: table[0] for name, table in problem.at_load(loads).items()}
    return {"mean_separation": situation.h} | {name: table[0] for name, table in problem.on_grid(situation.h).items()}


def _at_working_load(problem: Problem, target: float, answer: _Answer) -> dict[str, np.ndarray] | None:
    """Normalised results (1, 1) at the working load; where it is not carried, nothing, and the answer says why."""
    points = points_of(problem, target)
    try:
        solved = solve_points(points)
        if solved.carried is not None:
            answer.outside = warnings_of_rounding(solved.carried, points.wanted)
        return _sensible(problem, {name: table.reshape(1, 1) for name, table in solved.tables.items()}, answer)
    except Unreachable as error:
        unit = points.factors["N"]
        high, low = (problem.subject.show(load * unit, "load", 4) for load in (error.high, error.low))
        answer.why_not = f"carries loads up to {high}" if points.wanted.item() > error.high else f"carries loads above {low}"
    except InputError as error:
        answer.why_not = reason_of(error)
    return None


def _sensible(problem: Problem, results: dict[str, np.ndarray], answer: _Answer) -> dict[str, np.ndarray] | None:
    """Return the results, or None where their area is outside all sense; the answer then says why."""
    fraction = state_of(problem, results).get("area_fraction")
    if fraction is None or not fraction.item() > _MOST_AREA:
        return results
    answer.why_not = f"outside all sense: its contact area is {fraction.item():.2g} times the nominal one"
    return None


def _dataset(contact, answers: list[_Answer], target: float | None) -> "xarray.Dataset":
    """Answers as a dataset over model and point; those that say nothing at all are left out, with the reason."""
    shown = [one for one in answers if one.curve]
    dims = {"model": len(shown), "point": max((one.curve["load"].size for one in shown), default=0)}
    as_it_is: dict[str, Any] = {}  # results are in the units of the contact already

    def padded(values: np.ndarray, nothing: float) -> np.ndarray:
        return np.pad(values, (0, dims["point"] - values.size), constant_values=nothing)

    tables = {name: np.array([padded(one.curve.get(name, np.zeros(0)), np.nan) for one in shown]) for name in RESULTS}
    data = labelled(contact, tables, as_it_is, dims, {"model": [one.candidate.name for one in shown]})
    if target is not None:
        single = {name: np.array([(one.at_load or {}).get(name, np.nan) for one in shown]) for name in RESULTS}
        found = labelled(contact, single, as_it_is, {"model": len(shown)}, {"model": data["model"]})
        data = data.merge(found.rename({name: f"{name}_at_load" for name in RESULTS}))
    numbers = {name: np.array([one.told.get(name, np.nan) for one in shown]) for name in _NUMBERS}
    texts = {name: [one.told.get(name, nothing) for one in shown] for name, nothing in _TEXTS.items()} | {
        "outside_validity": ["; ".join(warning.short for warning in one.outside) for one in shown],
        "validity_warnings": [as_attributes(one.outside)["validity_warnings"] for one in shown],
        "status": [one.status for one in shown],
        "why_not": [one.why_not for one in shown],
    }
    told = numbers | {name: np.array(values, dtype=object) for name, values in texts.items()}
    data = data.assign({name: ("model", values) for name, values in told.items()})
    range_status = np.array([padded(one.range_status, OUTSIDE) for one in shown]).reshape(tuple(dims.values()))
    data = data.assign(range_status=(("model", "point"), range_status))
    return data.assign_attrs(_attributes(contact, answers, target))


def _attributes(contact, answers: list[_Answer], target: float | None) -> dict[str, Any]:
    """Return the attributes of the dataset."""
    used = dict.fromkeys(key for one in answers for key in one.sources)
    left_out = [f"{one.candidate.name}: {one.why_not}" for one in answers if not one.curve]
    attributes: dict[str, Any] = {
        "sources": " ".join(used), "not_applicable": "\n".join(left_out), "criteria": "\n".join(criteria_of(contact)),
    }  # fmt: skip
    return attributes if target is None else attributes | {"working_load": target}


def criteria_of(contact: Subject) -> list[str]:
    """Return what the criteria state of the surface of a contact, one line each.

    Criteria whose groups are unknown are left out.
    """
    groups = Groups.of(contact.with_surface_moments().indices())[0].substrate()
    lines = []
    for one in of_kind(Criterion).values():
        if all(groups.knows(name) for name in one.needs):
            ratio = float(one.ratio(groups)[0])
            lines.append(f"{one.key}: {one.below if ratio < 1.0 else one.above} (ratio {ratio:.3g}, the border is 1)")
    return lines


def working_load(case: "Case", given: str | None) -> float | None:
    """Return the load at which the models of a case are judged, or None.

    It is the given one, else the middle one of the case or the pressing one nearest to it in the list. For separations it is
    among the loads that the model of the case carries there. None where no load presses.
    """
    case.subject.require_single(_ONE)
    if given is not None:
        return _pressing(case.subject, given, "--load")
    loads, at = pressing_loads(case)
    return float(loads[at]) if loads.size else None


def _pressing(subject: Subject, given: Any, field: str) -> float:
    """Return the given load, in N for a Contact, normalised for Indices.

    Raises InputError where it does not press.
    """
    unit = subject.attributes("load")["units"]
    if not isinstance(given, str) and np.ndim(given) > 0:
        one = f"one load > 0 {unit}".removesuffix(" 1")
        raise InputError(field, given, f"{one}: compare takes a single load; solve accepts an array")
    try:
        load = float(subject.read(given, "load"))
    except InputError as error:
        raise InputError(field, error.value, error.allowed) from None
    except (TypeError, ValueError):
        raise InputError(field, given, f"one load > 0 {unit}".removesuffix(" 1")) from None
    if not 0.0 < load < np.inf:
        raise InputError(field, given, f"> 0 {unit}".removesuffix(" 1"))
    return load
