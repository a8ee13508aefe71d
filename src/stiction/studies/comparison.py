"""Every model that applies, on one contact: what they say of its friction, how far they differ, and which to trust."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact, Indices
from stiction.contact.groups import Groups
from stiction.laws.registry import GRADES, Criterion, FilmLaw, RoughSurface, of_kind
from stiction.laws.validity import breaches
from stiction.quantities.errors import InputError
from stiction.quantities.units import show, to_si
from stiction.solving.choice import Choice
from stiction.solving.inversion import Unreachable, separations_at
from stiction.solving.problem import ClosedForm, Problem, as_asked, make_problem, problem_of
from stiction.solving.solve import labelled, scale_of, solve, units_of

if TYPE_CHECKING:
    import xarray

    from stiction.studies.case import Case

# Mean separations over sigma at which the curves are computed: out of touch to pressed together.
SEPARATIONS = np.linspace(5.0, -2.0, 80)
_RESULTS = ("mean_separation", "load", "contact_area", "friction_force", "friction_coefficient")


@dataclass(frozen=True)
class Candidate:
    """A model as it may be applied to a contact: its name in the comparison, and what is chosen."""

    name: str
    choice: Choice


@dataclass
class Answer:
    """What one candidate says, in the units of the contact. curve: results (points,); at_load: results at the working load,
    None if it cannot carry that. outside: ranges of validity that are left at the working load, or anywhere if there is none.
    effects: what it takes account of; of_interface: its friction is the shear strength that the contact states. why_not: why
    it says nothing, or nothing of friction."""

    candidate: Candidate
    grade: str = ""
    title: str = ""
    curve: dict[str, np.ndarray] = field(default_factory=dict)
    at_load: dict[str, float] | None = None
    outside: list[str] = field(default_factory=list)
    effects: list[str] = field(default_factory=list)
    of_interface: bool = False
    sources: list[str] = field(default_factory=list)
    why_not: str = ""

    @property
    def mu(self) -> float:
        """The friction coefficient at the working load, not a number where there is none."""
        return self.at_load.get("friction_coefficient", np.nan) if self.at_load else np.nan


def candidates(contact: Contact | Indices) -> list[Candidate]:
    """Every rough-surface model, and every asperity law that none of them takes, under Greenwood & Williamson's sum. On
    a coated contact those with their own film law, or the one that suits all; and every other film law by itself."""
    coated = contact.coating is not None if isinstance(contact, Contact) else contact.has_film
    models: dict[str, Any] = of_kind("rough surface")
    taken = {model.asperity for model in models.values()}
    found = [Candidate(key, Choice(key)) for key in models]
    found += [Candidate(key, Choice(_SUM, asperity=key)) for key in of_kind("asperity") if key not in taken]
    if not coated:
        return found
    found = [_with_film(candidate, models[candidate.choice.model]) for candidate in found]
    films: dict[str, Any] = of_kind("film")
    return found + [_alone(film) for film in films.values() if film.interchangeable and film.key != _SUITS_ALL]


_SUM, _SUITS_ALL = "greenwood_williamson_1966", "sequential"


def _with_film(candidate: Candidate, model: RoughSurface) -> Candidate:
    if not model.asperity:
        return candidate  # it will say itself that it knows no films
    film = model.default_film or _SUITS_ALL
    return Candidate(f"{candidate.name} + {film}", replace(candidate.choice, coating_law=film))


def _alone(film: FilmLaw) -> Candidate:
    """A film law with the asperity law of its source, under the model whose friction it has, if it has one."""
    models: dict[str, Any] = of_kind("rough surface")
    model = next((key for key, one in models.items() if one.asperity and one.tangential == film.tangential), _SUM)
    return Candidate(film.key, Choice(model, asperity=film.asperity or None, coating_law=film.key))


def compare(
    contact: Contact | Indices,
    *,
    load: Any = None,
    separations: Iterable[float] | None = None,
    progress: Callable[[Iterable], Iterable] = iter,
) -> "xarray.Dataset":
    """Every applicable model at once on one contact.

    contact: a Contact or Indices, of numbers (no arrays). load: the working load, above 0, N for a Contact (text with a unit is
    fine), normalised for Indices; None: only curves. separations: mean separations of the curves, over the sigma that a model
    takes, by default 80 from 5 to -2. progress: wraps the list of models while they are computed.

    Where a model has no tangential law of its own and the contact states an interfacial shear strength, that law of the
    interface is taken. Returns an xarray.Dataset over `model` and `point`, units as in `solve`: mean_separation, load,
    contact_area, friction_force, friction_coefficient; and over `model`, under names that end in `_at_load`, the same at the
    working load, with grade and `outside_validity`, lines joined by "; ". A theory that knows no separation has none (not a
    number) and is computed at the loads of Greenwood & Williamson. Attributes: `spread`, lowest and highest mu at the working
    load, `spread_within_validity`, the same of the models within their validity, `recommended` and `reason`; `criteria` (is it
    sticky?), and `left_out`: model: why.
    Raises InputError for bad input.
    """
    if not isinstance(contact, Contact | Indices):
        raise InputError("contact", type(contact).__name__, "a stiction.Contact or stiction.Indices")
    if any(True for _ in contact.arrays()):
        raise InputError("contact", "arrays", "single numbers, for a comparison of models")
    h = SEPARATIONS if separations is None else np.asarray(list(separations), dtype=float)
    units = units_of(contact)
    target = None if load is None else _pressing(contact, load, "load")
    groups = make_problem(contact, Choice()).groups
    plain = problem_of(groups.substrate(), Choice("greenwood_williamson_1966"))
    interface = _law_of_the_interface(groups)
    situation = _Situation(contact, h, plain.loads_on_grid(h) * units["N"], target, interface)
    answers = [_ask(situation, one) for one in progress(candidates(contact))]
    return _dataset(contact, answers, target)


def _law_of_the_interface(groups: Groups) -> str:
    """The law of the interface that uses most of what is known of it; "none" where nothing is."""
    laws = [one for one in of_kind("tangential").values() if one.interfacial]  # type: ignore[attr-defined]
    known = [one for one in laws if all(getattr(groups, name) is not None for name in one.needs)]
    return max(known, key=lambda one: len(one.needs)).key if known else "none"


@dataclass(frozen=True)
class _Situation:
    """What all candidates are asked: at the separations h, over their sigma, the loads (1, h) for those that know none, and
    the working load or None, in the units of the contact; interface: the tangential law of those that have none."""

    contact: Contact | Indices
    h: np.ndarray
    loads: np.ndarray
    target: float | None
    interface: str


def _ask(situation: _Situation, candidate: Candidate) -> Answer:
    """What one candidate says, or why it does not."""
    answer = Answer(candidate)
    choice = candidate.choice
    if of_kind("rough surface")[choice.model].tangential == "none" and choice.tangential is None:  # type: ignore[attr-defined]
        choice = replace(choice, tangential=situation.interface)
    try:
        problem = make_problem(situation.contact, choice)
        curve = _curve(problem, situation)
    except InputError as error:
        answer.why_not = _reason(error)
        return answer
    records = problem.records()
    answer.grade = max(record.grade for record in records)
    answer.title = problem.record.title
    answer.sources = list(dict.fromkeys(source.key for record in records for source in record.sources))
    if not problem.friction:
        answer.why_not = "of contact only: it needs an interfacial_shear_strength to say anything of friction"
    at_load = None
    if situation.target is not None:
        at_load = _at_working_load(problem, situation.target, answer)
    left = breaches(problem.subject, records, at_load or curve)
    answer.outside = [breach.short for breach in left]
    answer.effects = _effects(problem)
    answer.of_interface = problem.law.interfacial
    answer.curve = _in_units(problem, curve)
    if at_load:
        answer.at_load = {name: float(table[0, 0]) for name, table in _in_units(problem, at_load).items()}
    return answer


def _in_units(problem: Problem, results: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Normalised results in the units of the contact: each model normalises with the sigma, R and N that it takes."""
    scales = units_of(problem.subject)
    return {name: table * scales.get(scale_of(name), 1.0) for name, table in results.items()}


def _reason(error: InputError) -> str:
    """Why a model cannot be asked: what is missing, or what it wants in place of what there is."""
    return f"{error.field} is not given: {error.allowed}" if error.value is None else error.allowed


def _curve(problem: Problem, situation: _Situation) -> dict[str, np.ndarray]:
    """Normalised results (points,) along the separations, or the loads in their place."""
    if isinstance(problem, ClosedForm) and problem.needs_load:
        loads = situation.loads / units_of(problem.subject)["N"]
        return {name: table[0] for name, table in problem.at_load(loads).items()}
    return {"mean_separation": situation.h} | {name: table[0] for name, table in problem.on_grid(situation.h).items()}


def _at_working_load(problem: Problem, target: float, answer: Answer) -> dict[str, np.ndarray] | None:
    """Normalised results (1, 1) at the working load; where it is not carried, nothing, and the answer says why."""
    unit = units_of(problem.subject)["N"]
    wanted = np.array([[target / unit]])
    try:
        if isinstance(problem, ClosedForm) and problem.needs_load:
            return problem.at_load(wanted)
        h = separations_at(problem, wanted).h
        return {"mean_separation": h} | as_asked(problem.at(h), wanted)
    except Unreachable as error:
        high, low = (_in_words(problem.subject, load * unit) for load in (error.high, error.low))
        answer.why_not = f"carries loads up to {high}" if wanted.item() > error.high else f"carries loads above {low}"
    except InputError as error:
        answer.why_not = _reason(error)
    return None


def _in_words(subject: Contact | Indices, load: float) -> str:
    """A load, in a force unit where the contact is real."""
    return show(load, "load", 4) if isinstance(subject, Contact) else f"{load:.4g}"


def _effects(problem: Problem) -> list[str]:
    """What a problem takes account of beyond elastic asperities."""
    closed = isinstance(problem, ClosedForm)
    plasticity = "lam" in problem.record.needs if closed else any(one.state != "elastic" for one in problem.regimes)
    film = problem.film is not None
    return [name for name, there in (("adhesion", problem.adheres), ("plasticity", plasticity), ("the film", film)) if there]


def _recommend(answers: list[Answer]) -> tuple[Answer | None, str]:
    """The answer to trust, and why: of those that say something of friction, the least outside their validity; then those
    that use the shear strength of the interface, if it is stated; then the best grade; then what takes account of most; and of
    all that are left the middle one."""
    able = [one for one in answers if np.isfinite(one.mu)]
    if not able:
        return None, "no model says anything of friction at this load"
    stated = any(one.of_interface for one in able)

    def rank(one: Answer) -> tuple[int, bool, str, int]:
        return len(one.outside), stated and not one.of_interface, one.grade, -len(one.effects)

    alike = sorted((one for one in able if rank(one) == min(map(rank, able))), key=lambda one: one.mu)
    best = alike[(len(alike) - 1) // 2]
    within = sum(not one.outside for one in able)
    reasons = [
        f"no model is within its validity here, and this leaves the fewest ranges ({len(best.outside)})"
        if best.outside
        else f"within its validity here, as {within} of the {len(able)} models that predict friction are",
        "uses the stated shear strength of the interface" if best.of_interface else "",
        f"grade {best.grade} ({GRADES[best.grade]})",
        f"takes account of {' and '.join(best.effects)}" if best.effects else "",
        f"the middle one of {len(alike)} alike" if len(alike) > 1 else "",
    ]
    return best, "; ".join(filter(None, reasons))


def _dataset(contact, answers: list[Answer], target: float | None) -> "xarray.Dataset":
    """Answers as a dataset over model and point; those that say nothing at all are left out, with the reason."""
    shown = [one for one in answers if one.curve]
    dims = {"model": len(shown), "point": shown[0].curve["load"].size if shown else 0}
    as_it_is: dict[str, Any] = {}  # results are in the units of the contact already
    tables = {name: np.array([_or_nothing(one.curve.get(name), dims["point"]) for one in shown]) for name in _RESULTS}
    data = labelled(contact, tables, as_it_is, dims, {"model": [one.candidate.name for one in shown]})
    if target is not None:
        single = {name: np.array([(one.at_load or {}).get(name, np.nan) for one in shown]) for name in _RESULTS}
        found = labelled(contact, single, as_it_is, {"model": len(shown)}, {"model": data["model"]})
        data = data.merge(found.rename({name: f"{name}_at_load" for name in _RESULTS}))
    texts = {
        "grade": [one.grade for one in shown],
        "outside_validity": ["; ".join(one.outside) for one in shown],
        "why_not": [one.why_not for one in shown],
    }
    data = data.assign({name: ("model", np.array(values, dtype=object)) for name, values in texts.items()})
    return data.assign_attrs(_attributes(contact, answers, target))


def _or_nothing(values: np.ndarray | None, points: int) -> np.ndarray:
    return np.full(points, np.nan) if values is None else values


def _attributes(contact, answers: list[Answer], target: float | None) -> dict[str, Any]:
    """What goes with the dataset as a whole."""
    used = dict.fromkeys(key for one in answers for key in one.sources)
    left_out = [f"{one.candidate.name}: {one.why_not}" for one in answers if not one.curve]
    attributes: dict[str, Any] = {
        "sources": " ".join(used), "left_out": "\n".join(left_out), "criteria": "\n".join(_criteria(contact)),
    }  # fmt: skip
    if target is None:
        return attributes
    best, reason = _recommend(answers)
    inside = [one.mu for one in answers if not one.outside]
    attributes |= {
        "working_load": target,
        "spread": _spread([one.mu for one in answers]),
        "spread_within_validity": _spread(inside),
        "recommended": best.candidate.name if best else "none",
        "reason": reason,
    }
    return attributes


def _criteria(contact: Contact | Indices) -> list[str]:
    """What the criteria of the registry say of the surface of a contact, one line each; those that want what is not known
    are left out."""
    surface = contact.with_surface_moments() if isinstance(contact, Contact) else contact
    groups = make_problem(surface, Choice()).groups.substrate()
    lines = []
    for one in of_kind("criterion").values():
        assert isinstance(one, Criterion)
        if all(getattr(groups, name) is not None for name in one.needs):
            ratio = float(one.ratio(groups)[0])
            lines.append(f"{one.key}: {one.below if ratio < 1.0 else one.above} (ratio {ratio:.3g}, the border is 1)")
    return lines


def _spread(values: list[float]) -> list[float]:
    """Lowest and highest of those that are numbers; empty if none is."""
    numbers = [one for one in values if np.isfinite(one)]
    return [min(numbers), max(numbers)] if numbers else []


def working_load(case: "Case", given: str | None) -> float | None:
    """The load at which the models of a case are judged: that given, else the middle one of the case, or the compressive one
    that is nearest to it in the list; where the case names separations, of the loads that its own model carries there. None
    where none is compressive."""
    if given is not None:
        return _pressing(case.subject, given, "--load")
    loads = case.load
    if loads is None:
        loads = solve(case.subject, separation=case.separation, **case.choice.arguments())["load"].values
    pressing = np.flatnonzero(loads > 0.0)
    if not pressing.size:
        return None
    middle = (len(loads) - 1) // 2
    return float(loads[pressing[np.argmin(np.abs(pressing - middle))]])


def _pressing(contact: Contact | Indices, given: Any, field: str) -> float:
    """The load given, in N for a Contact and normalised for Indices; InputError where it does not press."""
    real = isinstance(contact, Contact)
    try:
        load = float(to_si(given, "load") if real else given)
    except InputError as error:
        raise InputError(field, error.value, error.allowed) from None
    except (TypeError, ValueError):
        raise InputError(field, given, "a plain number, normalised like the indices") from None
    if not 0.0 < load < np.inf:
        raise InputError(field, given, "> 0 N" if real else "> 0")
    return load


def comparison(data: "xarray.Dataset") -> dict[str, Any]:
    """A comparison as one JSON object: attributes, and a list of models with what each says."""
    units = {name: data[name].attrs.get("units", "1") for name in _RESULTS}
    rows = []
    for at, name in enumerate(data["model"].values):
        one = data.isel(model=at)
        row = {
            "model": str(name),
            "grade": str(one["grade"].item()),
            "outside_validity": [line for line in one["outside_validity"].item().split("; ") if line],
            "why_not": one["why_not"].item() or None,
        }
        row |= {key: one[f"{key}_at_load"].item() for key in _RESULTS if f"{key}_at_load" in data}
        row |= _over_methods(one)
        rows.append(row | {"curve": {key: one[key].values for key in _RESULTS}})
    left_out = dict(line.split(": ", 1) for line in data.attrs["left_out"].splitlines())
    attributes = {name: value for name, value in data.attrs.items() if name not in ("left_out", "sources", "criteria")}
    attributes["criteria"] = data.attrs["criteria"].splitlines()
    return attributes | {"units": units, "models": rows, "left_out": left_out, "sources": data.attrs["sources"].split()}


def _over_methods(one: "xarray.Dataset") -> dict[str, Any]:
    """What one model says of every way to find asperities in a measured surface, at the working load."""
    name = "friction_coefficient_at_load"
    if f"{name}_by_method" not in one:
        return {}
    each = one[f"{name}_by_method"]
    return {
        "friction_coefficient_by_method": dict(zip(each["asperity_method"].values.tolist(), each.values.tolist(), strict=True)),
        "friction_coefficient_low": one[f"{name}_low"].item(),
        "friction_coefficient_high": one[f"{name}_high"].item(),
    }


def comparison_rows(data: "xarray.Dataset") -> tuple[list[str], Iterator[list[Any]]]:
    """Heads and rows of a table: every point of every model."""
    heads = [_head(data, name) for name in _RESULTS]
    columns = [data[name].values for name in _RESULTS]
    points = range(data.sizes["point"])
    names = data["model"].values
    rows = ([str(name), *(float(column[at, point]) for column in columns)] for at, name in enumerate(names) for point in points)
    return ["model", *heads], rows


def _head(data: "xarray.Dataset", name: str) -> str:
    unit = data[name].attrs.get("units", "1")
    return name if unit == "1" else f"{name} [{unit}]"


def at_load_rows(data: "xarray.Dataset") -> tuple[list[str], Iterator[list[Any]]]:
    """Heads and rows of a table: what every model says at the working load; of a measured surface also the lowest and the
    highest friction coefficient over the methods of finding asperities."""
    names = [f"{name}_at_load" for name in ("friction_coefficient", *_RESULTS[:-1])]
    names[1:1] = [f"{names[0]}_{end}" for end in ("low", "high") if f"{names[0]}_{end}" in data]
    heads = [_head(data, name).replace("_at_load", "") for name in names]
    texts = ("outside_validity", "why_not")
    rows = (
        [str(one[name].item()) for name in ("model", "grade")]
        + [one[name].item() for name in names]
        + [str(one[name].item()) for name in texts]
        for one in (data.isel(model=at) for at in range(data.sizes["model"]))
    )
    return ["model", "grade", *heads, *texts], rows
