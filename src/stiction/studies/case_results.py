"""A case, solved or compared: also one whose surface was measured, with the spread over the methods of finding asperities."""

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from stiction import __version__
from stiction.case.read import Case
from stiction.contact.subject import Subject
from stiction.laws.validity import Doubt, with_doubts
from stiction.quantities.dimensions import dimensions
from stiction.quantities.errors import InputError
from stiction.quantities.progress import Progress, silent
from stiction.quantities.units import several_in_words
from stiction.records.registry import RoughSurface, find
from stiction.solving.candidates import choice_of
from stiction.solving.choice import LAWS, Choice
from stiction.solving.sliding import slide
from stiction.solving.solve import solve
from stiction.studies.comparison.compare import compare, working_load
from stiction.studies.uncertainty.bands import with_bands, with_bands_of_models
from stiction.studies.uncertainty.spreads import spreads_of_comparison

if TYPE_CHECKING:
    import xarray
    from _typeshed import DataclassInstance

RECOMMENDED = "recommended"
Plan = TypeVar("Plan", bound="DataclassInstance")
_LAYERED = "layered"  # the film law of `stiction film`
_MOST = 1_000_000  # points at once in memory
_FEW = 5  # curves of force against displacement of one case


def solve_case(case: Case, choice: Choice | None = None, progress: Progress = silent) -> "xarray.Dataset":
    """The points of a case, as `solve` gives them; choice: other laws and options than those of the case; the model may be any
    that `compare` shows, or "recommended": the one that it recommends at the working load.

    Where the case names scans, friction_coefficient is that of the method which stands for the surface, and the result has
    also friction_coefficient_by_method (asperity_method, points), friction_coefficient_low and friction_coefficient_high; its
    attributes say the method and what was done to the scans. Where numbers of the case are uncertain, it is that of the nominal
    ones, and has also NAME_quantile (quantile, ...) of friction, area, load and pull-off, with NAME_quantile_error.
    progress: from a text, what wraps a list of steps. Raises InputError.
    """
    _check_size(case)
    choice, leap = _chosen(case, choice or case.choice)
    data = solve(case.subject, separation=case.separation, load=case.load, **choice.arguments())
    data = with_doubts(data, [Doubt(leap)]) if leap else data
    data = with_bands(data, case, choice, progress("Drawing what is uncertain"))
    return with_groups(_said(data, case), case.with_surface_moments(choice.model_key).subject)


def film_of_case(case: Case, choice: Choice) -> "xarray.Dataset":
    """The stresses in the film of a case at its points, as `film_stresses` gives them; by the recommended model, where that is
    asked, if it goes with a layered film. Raises InputError, also for a contact of which numbers are several."""
    from stiction.studies.stresses.film_stress import film_stresses, require_film  # slow to import, and no other study needs it

    require_film(case.subject)
    if case.is_several:
        name, array = next(iter(case.subject.arrays()))
        raise InputError(
            name, several_in_words(array, name), "a single value; film stresses are computed for one contact per case"
        )
    recommended = choice.model_key == RECOMMENDED
    if recommended:
        choice = replace(choice_of_case(case, replace(choice, film=None)), film=_LAYERED)
    subject = case.with_surface_moments(choice.model_key).subject
    try:
        data = film_stresses(subject, separation=case.separation, load=case.load, **choice.arguments())
    except InputError:
        if not recommended:
            raise
        name = replace(choice, film=None).name
        allowed = f"a sum over asperities that goes with the film law {_LAYERED}, such as --model soft_coating_2015"
        raise InputError("model", f"{RECOMMENDED}, which is {name} here", allowed) from None
    return _said(data, case)


def slide_case(case: Case, choice: Choice | None = None, kept: float = 1.0) -> "xarray.Dataset":
    """From rest to sliding at points of a case, five of them at the most, as `slide` gives it: of the nominal numbers, where
    some are uncertain, and of the method that stands for the surface, where it was measured.

    choice: model and laws, in place of those of the case; kept: the share of its strength that an asperity keeps once it
    slides, 0 to 1. Raises InputError, also for a contact of which numbers are several."""
    if case.is_several:
        raise InputError("--sliding", "numbers of the contact are several", "one contact; st.slide takes any number")
    choice = choice_of_case(case, choice or case.choice)
    given = {name: value for name, value in choice.arguments().items() if name != "presliding"}
    points = {name: _few(getattr(case, name)) for name in ("separation", "load") if getattr(case, name) is not None}
    data = slide(case.subject.as_numbers(), **points, kept=kept, **given)
    return _said(data, case).assign_attrs(case.subject.groups())


def _few(points: Any) -> Any:
    """First, last and some between of an array of points."""
    count = np.size(points)
    chosen = np.unique(np.linspace(0, count - 1, min(count, _FEW)).round().astype(int))
    return points[chosen] if np.ndim(points) else points


def _check_size(case: Case) -> None:
    """InputError for more points than fit in memory and patience."""
    points = case.load if case.load is not None else case.separation
    count = math.prod(dimensions([*(array for _, array in case.subject.arrays()), points]).values())
    count *= 1 if hasattr(points, "dims") else np.size(points)
    if count > _MOST:
        raise InputError("contact", f"{count} points", f"{_MOST} at most in memory; `stiction sweep` takes any number")


def with_groups(data: "xarray.Dataset", subject: Subject) -> "xarray.Dataset":
    """With the dimensionless groups of the contact: those that are one number as attributes, the others as variables, but for
    what is given and stands among the coordinates."""
    several = {
        name: (value.dims, value.values, subject.attributes(name))
        for name, value in subject.all_groups().items()
        if hasattr(value, "dims") and name not in data.variables
    }
    return data.assign(several).assign_attrs(subject.groups())


def choice_of_case(case: Case, choice: Choice) -> Choice:
    """The choice with the model that its name stands for. Raises InputError where none is recommended."""
    return _chosen(case, choice)[0]


def _chosen(case: Case, choice: Choice) -> tuple[Choice, str]:
    """The same, and what is said of the load at which the recommended model changes, "" if nothing."""
    name, leap = recommended_model(case) if choice.model == RECOMMENDED else (choice.model, "")
    laws = {law: getattr(choice, law) for law in LAWS if law != "model"}
    if choice.model != case.choice.model and _brings_its_laws(case, choice.model, name):
        laws = {law: key for law, key in laws.items() if key != getattr(case.choice, law)}
    return choice_of(name, laws | dict(choice.options), case.subject), leap


def _brings_its_laws(case: Case, model: str | None, name: str | None) -> bool:
    """Return whether a model that replaces that of the case takes none of the laws that the case names beside its own."""
    return model == RECOMMENDED or not find(choice_of(name, {}, case.subject).model_key, RoughSurface).asperity


def recommended_model(case: Case) -> tuple[str, str]:
    """Return the name of the model that `compare` recommends at the working load, and what it says of loads near it where
    another one is. Raises InputError where there is none."""
    said = compare(case.subject, load=working_load(replace(case, choice=Choice()), None)).attrs
    name = said.get("recommended", "none")
    if name == "none":
        why = said.get("reason", "without a working load, which is above 0, no model is judged")
        raise InputError("model", RECOMMENDED, "; ".join(filter(None, ["a model by its key", why, said.get("advice")])))
    return name, said["leap"]


def with_recommended(plan: Plan, case: Case) -> Plan:
    """Return the plan of a study with the recommended model by its name, where its case asks for the recommended one.

    case: the case of the plan at the numbers and loads where models are compared. The whole study then has that model. Raises
    InputError where none is recommended.
    """
    if case.choice.model != RECOMMENDED:
        return plan
    name, _ = recommended_model(case)
    tables = {key: getattr(plan, key) for key in ("content", "given")}
    return replace(plan, **{key: {**some, "solve": {**some["solve"], "model": name}} for key, some in tables.items()})


def compare_case(
    case: Case,
    load: Any = None,
    progress: Progress = silent,
    bands: bool = True,
) -> "xarray.Dataset":
    """Every model on the contact of a case, as `compare` gives them, at a working load [N].

    Where the case names scans, the result has also friction_coefficient_at_load_by_method (asperity_method, model),
    friction_coefficient_at_load_low and friction_coefficient_at_load_high. Where numbers are uncertain, it has also
    friction_coefficient_at_load_quantile (quantile, model) with its error; and wherever a model is recommended, what its
    friction differs by, spread_low, spread_high and spread_factor (spread). progress: from a text, what wraps a list of steps.
    bands: whether the quantiles are asked. Raises InputError.
    """
    data = compare(case.subject, load=load, progress=progress("Asking the models"))
    if load is not None:
        at = float(data.attrs["working_load"])
        data = with_bands_of_models(data, case, at, progress("Drawing what is uncertain")) if bands else data
        data = spreads_of_comparison(data, case.uncertainty.coverage)
    if case.load is not None:
        data = data.assign_attrs(case_loads=np.asarray(case.load, dtype=float))
    return _said(data, case)


def _said(data: "xarray.Dataset", case: Case) -> "xarray.Dataset":
    """With the title of the case, and the program."""
    title = {"case": case.title} if case.title else {}
    return data.assign_attrs(title, program=f"stiction {__version__}")
