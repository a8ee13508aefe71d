"""Compare all applicable models on one contact: their friction, and whether the contact is in their validity range."""

from collections.abc import Iterable, Mapping
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
from stiction.quantities.shown import reason_of
from stiction.quantities.table import QUANTITIES
from stiction.records.record import plug_in_error
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
from stiction.solving.unused import ignored_strength
from stiction.studies.comparison.criteria import criteria_of
from stiction.studies.pressing_loads import pressing_loads

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case
    from stiction.quantities.arguments import QuantityLike

# Mean separations over sigma at which the curves are computed, from hardly touching to strongly compressed surfaces.
SEPARATIONS = np.linspace(5.0, -2.0, 80)
_ONE = "a single number, because models are compared for one contact"
# Contact area over nominal area above which a model has failed; its results are not shown.
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
        One contact, without arrays.
    load : float [N] or str with a unit, optional
        Working load, above 0; dimensionless for Indices. Without it only curves are computed.
    separations : iterable of float, optional
        Mean separations of the curves, over the sigma that a model uses; by default 80 values from 5 to -2.
    progress : callable
        Receives the list of models and returns an iterable over the same models, e.g. a progress bar. For a measured surface it
        is called again with a list of contacts, one for each asperity method.

    Returns
    -------
    xarray.Dataset
        Curves over (model, point), dimensionless for Indices: mean_separation [m], load [N], contact_area [m^2], friction_force
        [N], friction_coefficient; and `range_status`: 0 inside the validity ranges of the model, 1 outside, 2 where a result is
        impossible. Over `model`: the same five results at the working load, with names that end in `_at_load`; `status`, a text
        that states whether the contact fits the model; `why_not`, the reason for missing results or missing friction; `grade`,
        the worst grade of its laws; `outside_validity` (text) and `validity_warnings` (JSON); `family_of_curve`, whether the
        strength of the interface or of the bodies determines friction; `plastic_junctions_resist`, how plastic contact spots
        resist shear; `measured_area_error`, `measured_area_error_rms` and `measured_friction_error`, relative errors on
        benchmark surfaces near this contact (truth.md), NaN if none is near; `measured_error` and `measured_film_error` (JSON),
        and `measured_error_in_words`.
        Attributes: `working_load`, `criteria`, `not_applicable` (model: reason), and `sources`, keys of publications. Without a
        working load there are no results with `_at_load`. With one, a surface measured by several asperity methods also has
        friction_coefficient_at_load_by_method (asperity_method, model), and `_low` and `_high` over the methods.

    Raises
    ------
    InputError
        A number of the contact is an array, or load or separations are out of bounds.

    Notes
    -----
    A theory without a mean separation is evaluated at the loads of the Greenwood-Williamson model; its mean_separation is NaN.
    If a model has no tangential law and an interfacial shear strength is specified, a law of the interface computes friction.
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
    measured = contact.measured
    if measured is None:
        return data
    return as_measured(_with_methods(data, measured.contacts(contact), load, progress), measured)


def _compared(contact: Subject, load: Any, separations: Any, progress: Steps) -> "xarray.Dataset":
    """Return the comparison of all models for one contact, without the range over asperity methods.

    The arguments are those of `compare`.
    """
    h = SEPARATIONS if separations is None else _separations(separations)
    target = None if load is None else _compressive_load(contact, load, "load")
    groups, _ = Groups.of(contact.indices())
    plain = problem_of(groups.substrate(), Choice("greenwood_williamson_1966", beside={"meniscus": "none"}))  # no tensile load
    loads = plain.loads_on_grid(h) * contact.scales().factors()["N"]
    answers = [_solve_candidate(contact, candidate, h, loads, target) for candidate in progress(candidates(contact))]
    return _dataset(contact, answers, target)


def _with_methods(data: "xarray.Dataset", contacts: Mapping[str, Subject], load: Any, progress: Steps) -> "xarray.Dataset":
    """Return the comparison `data` with friction at the working load added for each asperity method.

    contacts: by asperity method, the contact with the roughness that the method finds; the first is that of `data`. load:
    working load, as in `compare`. The dataset is returned unchanged without a working load or with a single method. Friction is
    NaN where a model does not apply with a method.
    """
    name = "friction_coefficient_at_load"
    if name not in data or len(contacts) < 2:
        return data
    frictions = [
        data[name] if index == 0 else _compared(other, load, [0.0], iter)[name].reindex(model=data["model"])
        for index, other in enumerate(progress(list(contacts.values())))
    ]
    table = np.array([friction.values for friction in frictions])
    return with_range_over_methods(data, list(contacts), table, ("model",), name)


def _separations(given: Iterable[float]) -> np.ndarray:
    """Return mean separations over sigma as an array (n,); raise InputError if there is none, or one beyond +/-FARTHEST."""
    allowed = f"a sequence of numbers, over sigma, from {-FARTHEST:g} to {FARTHEST:g}"
    try:
        row = list(given)
    except TypeError:
        raise InputError("separations", given, allowed) from None
    h = floats(row, "separations", allowed)
    if h.ndim != 1 or not h.size or not (np.abs(h) <= FARTHEST).all():
        raise InputError("separations", given, allowed)
    return h


# What determines the friction of a model, by whether its tangential law uses the shear strength of the interface.
FAMILIES = {True: "strength of the interface", False: "strength of the bodies"}

# Attributes of each model that are texts, with the text for a model that has none; then those that are numbers.
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
    """Store the results of one model in a comparison, in SI units for a Contact and dimensionless for Indices.

    curve: results (points,) by name. range_status: at each point, WITHIN or OUTSIDE the validity ranges, or IMPOSSIBLE.
    at_load: results at the working load, or None. outside: validity warnings at the working load (none if the model cannot
    carry it), or along the curve if no working load is given. attributes: values for the names in _TEXTS and _NUMBERS. ignored:
    text from `_ignored`. sources: keys of publications. why_not: reason for missing results or missing friction; "" if none is
    missing.
    """

    candidate: Candidate
    curve: dict[str, np.ndarray] = field(default_factory=dict)
    range_status: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    at_load: dict[str, float] | None = None
    outside: list[ValidityWarning] = field(default_factory=list)
    attributes: dict[str, Any] = field(default_factory=dict)
    ignored: str = ""
    sources: list[str] = field(default_factory=list)
    why_not: str = ""

    @property
    def status(self) -> str:
        """Return a text that states whether the contact fits the model, with the reason if it does not."""
        if self.why_not:
            return f"no answer: {self.why_not}"
        left_out = f", without {self.ignored}" if self.ignored else ""
        of_chance = [warning.in_brief for warning in self.outside if warning.kind == "statistics"]
        if len(of_chance) == len(self.outside):  # warnings about statistics concern every model alike
            return "; ".join((f"fits{left_out}", *of_chance))
        worst = [warning for warning in self.outside if warning.kind == "impossible"]
        texts = list(dict.fromkeys(warning.in_brief for warning in worst or self.outside))
        more = f" and {len(texts) - 2} more" if len(texts) > 2 else ""
        return f"{'cannot be right' if worst else 'does not fit'}: {', '.join(texts[:2])}{more}{left_out}"


def _solve_candidate(contact: Subject, candidate: Candidate, h: np.ndarray, loads: np.ndarray, target: float | None) -> _Answer:
    """Return the results of one model, or the reason why it has none.

    h: mean separations over the height deviation sigma that the model uses, (points,). loads: loads for theories without
    separations, (1, points), in N for a Contact. target: working load in the same unit, or None.
    """
    answer = _Answer(candidate)
    try:
        problem = make_problem(contact, candidate.choice)
        curve = _curve(problem, h, loads)
    except Exception as error:
        refused = error if isinstance(error, InputError) else plug_in_error(error)
        if refused is None:
            raise
        answer.why_not = reason_of(refused)
        return answer
    answer.sources = [source.key for record in problem.records() for source in record.sources]
    if not problem.friction:
        answer.why_not = "it computes contact only; state an interfacial_shear_strength for friction"
    rows = {name: table[None, :] for name, table in curve.items()}
    at_load = None if target is None else _at_working_load(problem, target, answer)
    answer.attributes = _of_laws(problem)
    if at_load or target is None:  # a model that cannot carry the working load has no results to check
        answer.outside = answer.outside + warnings_of_results(problem, at_load or rows)
        answer.attributes |= film_errors.as_attributes(problem, at_load or rows)
    answer.ignored = _ignored(problem)
    answer.curve = _in_units(problem, curve)
    answer.range_status = points_outside(problem, rows)
    if at_load:
        answer.attributes |= _measured(measured_error.measured_errors(problem, at_load))
        answer.at_load = {name: float(table[0, 0]) for name, table in _in_units(problem, at_load).items()}
    return answer


def _ignored(problem: Problem) -> str:
    """Return, in words, which stated inputs a model ignores: of the liquid and, if it has friction, the interface; or ""."""
    names = ignored_strength(problem) if problem.friction else []
    texts = []
    if any(not name.endswith("pressure_coefficient") for name in names):
        texts.append("the interface")
    elif names:
        texts.append("alpha")
    return " and ".join([*texts, *(["the liquid"] if leaves_out_liquid(problem) else [])])


def _of_laws(problem: Problem) -> dict[str, str]:
    """Return texts about a model by name: `grade` is the worst grade of its laws.

    If the model computes friction, `family_of_curve` and `plastic_junctions_resist` are also returned.
    """
    grade = max(record.grade for record in problem.records())
    tangential = problem.chosen.tangential
    if tangential is None:
        return {"grade": grade}
    family = FAMILIES["shear_strength" in tangential.needs]
    return {"grade": grade, "family_of_curve": family, "plastic_junctions_resist": problem.chosen.yielded}


def _measured(errors: measured_error.MeasuredErrors) -> dict[str, Any]:
    """Return the benchmark errors of a model at the working load by name: as text, as JSON, and as three relative numbers.

    The numbers are the geometric mean error of the area, its root mean square error, and the geometric mean error of mu (0.1 is
    10 % too large). They are NaN if no benchmark surface is near. The error of mu is also NaN if mu does not depend on the
    interface strength, or if the interface is not weaker than the bodies.
    """
    numbers = np.expm1(errors.area[0]), errors.relative[0], np.expm1(errors.friction[0])
    return measured_error.as_attributes(errors) | dict(zip(_NUMBERS, numbers, strict=True))


def _in_units(problem: Problem, results: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return dimensionless results of a model in the units of the contact: SI for a Contact, dimensionless for Indices.

    Each result is multiplied by the scale formed from the sigma, R and N that the model uses.
    """
    factors = problem.subject.scales().factors()
    return {name: table * factors.get(QUANTITIES[name].scale, 1.0) for name, table in results.items()}


def _curve(problem: Problem, h: np.ndarray, loads: np.ndarray) -> dict[str, np.ndarray]:
    """Return dimensionless results (points,) of a model by name, along separations or along loads.

    h: mean separations over sigma. loads: loads (1, points) in the unit of the contact, at which theories without separations
    are evaluated.
    """
    if problem.needs_load:
        few = problem.few_of(loads / problem.subject.scales().factors()["N"])
        return {name: table[0] for name, table in problem.at_load(few).items()}
    return {"mean_separation": h} | {name: table[0] for name, table in problem.on_grid(h).items()}


def _at_working_load(problem: Problem, target: float, answer: _Answer) -> dict[str, np.ndarray] | None:
    """Return dimensionless results (1, 1) of a model at the working load `target`; None if the model cannot carry it.

    For None, the reason is stored in `answer`.
    """
    points = points_of(problem, target)
    try:
        solved = solve_points(points)
        if solved.carried is not None:
            answer.outside = warnings_of_rounding(solved.carried, points.wanted)
        return _sensible(problem, {name: table.reshape(1, 1) for name, table in solved.tables.items()}, answer)
    except Unreachable as error:
        unit = points.factors["N"]
        high, low = (problem.subject.show(load * unit, "load", 4) for load in (error.high, error.low))
        reached = f"up to {high}" if points.wanted.item() > error.high else f"above {low}"
        answer.why_not = f"carries only loads {reached}"
    except InputError as error:
        answer.why_not = reason_of(error)
    return None


def _sensible(problem: Problem, results: dict[str, np.ndarray], answer: _Answer) -> dict[str, np.ndarray] | None:
    """Return the results of a model unchanged, or None if its contact area exceeds 100 times the nominal area.

    For None, the reason is stored in `answer`. results: dimensionless results (1, 1) by name.
    """
    fraction = state_of(problem, results).get("area_fraction")
    if fraction is None or not fraction.item() > _MOST_AREA:
        return results
    answer.why_not = f"impossible: its contact area is {fraction.item():.2g} times the nominal area"
    return None


def _dataset(contact, answers: list[_Answer], target: float | None) -> "xarray.Dataset":
    """Return the results of all models as a dataset over the dimensions `model` and `point`.

    target: working load, or None. A model without any result is listed only in the attribute `not_applicable`, with the reason.
    """
    shown = [answer for answer in answers if answer.curve]
    dims = {"model": len(shown), "point": max((answer.curve["load"].size for answer in shown), default=0)}
    as_it_is: dict[str, Any] = {}  # results are in the units of the contact already

    def padded(values: np.ndarray, nothing: float) -> np.ndarray:
        return np.pad(values, (0, dims["point"] - values.size), constant_values=nothing)

    tables = {name: np.array([padded(answer.curve.get(name, np.zeros(0)), np.nan) for answer in shown]) for name in RESULTS}
    data = labelled(contact, tables, as_it_is, dims, {"model": [answer.candidate.name for answer in shown]})
    if target is not None:
        single = {name: np.array([(answer.at_load or {}).get(name, np.nan) for answer in shown]) for name in RESULTS}
        at_load = labelled(contact, single, as_it_is, {"model": len(shown)}, {"model": data["model"]})
        data = data.merge(at_load.rename({name: f"{name}_at_load" for name in RESULTS}))
    numbers = {name: np.array([answer.attributes.get(name, np.nan) for answer in shown]) for name in _NUMBERS}
    texts = {name: [answer.attributes.get(name, nothing) for answer in shown] for name, nothing in _TEXTS.items()} | {
        "outside_validity": ["; ".join(warning.short for warning in answer.outside) for answer in shown],
        "validity_warnings": [as_attributes(answer.outside)["validity_warnings"] for answer in shown],
        "status": [answer.status for answer in shown],
        "why_not": [answer.why_not for answer in shown],
    }
    columns = numbers | {name: np.array(values, dtype=object) for name, values in texts.items()}
    data = data.assign({name: ("model", values) for name, values in columns.items()})
    range_status = np.array([padded(answer.range_status, OUTSIDE) for answer in shown]).reshape(tuple(dims.values()))
    data = data.assign(range_status=(("model", "point"), range_status))
    return data.assign_attrs(_attributes(contact, answers, target))


def _attributes(contact, answers: list[_Answer], target: float | None) -> dict[str, Any]:
    """Return the attributes of a comparison: sources, models that are not applicable, criteria and working load."""
    used = dict.fromkeys(key for answer in answers for key in answer.sources)
    left_out = [f"{answer.candidate.name}: {answer.why_not}" for answer in answers if not answer.curve]
    attributes: dict[str, Any] = {
        "sources": " ".join(used), "not_applicable": "\n".join(left_out), "criteria": "\n".join(criteria_of(contact)),
    }  # fmt: skip
    return attributes if target is None else attributes | {"working_load": target}


def working_load(case: "Case", given: str | None) -> float | None:
    """Return the load at which the models of a case are compared, in N or dimensionless; None if no load is above 0.

    given: load as text; if None, the working load of `pressing_loads` is used. Raises InputError.
    """
    case.subject.require_single(_ONE)
    if given is not None:
        return _compressive_load(case.subject, given, "--load")
    loads, index = pressing_loads(case)
    return float(loads[index]) if loads.size else None


def _compressive_load(subject: Subject, given: Any, field: str) -> float:
    """Return a given load as a number, in N for a Contact, dimensionless for Indices.

    field: name of the option in the error message. Raises InputError unless the load is single, finite and above 0.
    """
    allowed = f"one load > 0 {subject.attributes('load')['units']}".removesuffix(" 1")
    if not isinstance(given, str) and np.ndim(given) > 0:
        raise InputError(field, given, f"{allowed}: compare takes a single load; solve accepts an array")
    try:
        load = float(subject.read(given, "load"))
    except InputError as error:
        raise InputError(field, error.value, error.allowed) from None
    except (TypeError, ValueError):
        raise InputError(field, given, allowed) from None
    if not 0.0 < load < np.inf:
        raise InputError(field, given, allowed)
    return load
