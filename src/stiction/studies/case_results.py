"""A case, solved or compared: also one whose surface was measured, with the range over the methods of finding asperities."""

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction import __version__
from stiction.case.read import Case
from stiction.contact.subject import Subject
from stiction.quantities.dimensions import dimensions
from stiction.quantities.errors import InputError
from stiction.quantities.progress import Progress, silent
from stiction.records.registry import RoughSurface, find
from stiction.solving.candidates import choice_of
from stiction.solving.choice import RECOMMENDED, Choice
from stiction.solving.sliding import slide
from stiction.solving.solve import solve
from stiction.studies.comparison.compare import compare
from stiction.studies.prediction.predict import is_predicted, predict
from stiction.studies.pressing_loads import few_places
from stiction.studies.uncertainty.bands import with_bands
from stiction.studies.uncertainty.drawing import solves_maps

if TYPE_CHECKING:
    import xarray

_MOST = 1_000_000  # points at once in memory
_FEW = 5  # curves of force against displacement of one case


def solve_case(case: Case, choice: Choice | None = None, progress: Progress = silent) -> "xarray.Dataset":
    """The points of a case, as `solve` gives them; choice: other laws and options than those of the case. The model may be any
    that `compare` shows; for "recommended" it is what `predict` gives.

    Where the case names scans, friction_coefficient is that of the method which stands for the surface, and the result has
    also friction_coefficient_by_method (asperity_method, points), friction_coefficient_low and friction_coefficient_high; its
    attributes say the method and what was done to the scans. Where numbers of the case are uncertain, it is that of the nominal
    ones, and has also NAME_quantile (quantile, ...) of friction, area, load and pull-off, with NAME_quantile_error.
    progress: from a text, what wraps a list of steps. Raises InputError.
    """
    choice = choice or case.choice
    if choice.model == RECOMMENDED and is_predicted(chosen := replace(case, choice=choice)):
        return predict(chosen)
    _check_size(case)
    choice = choice_of_case(case, choice)
    data = solve(case.subject, separation=case.separation, load=case.load, **choice.arguments())
    data = with_bands(data, case, choice, progress("Drawing what is uncertain"))
    return with_groups(_said(data, case), case.with_surface_moments(choice.model_key).subject)


def film_of_case(case: Case, choice: Choice) -> "xarray.Dataset":
    """The stresses in the film of a case at its points, as `film_stresses` gives them. Raises InputError, also for a contact of
    which numbers are several."""
    from stiction.studies.stresses.film_stress import film_stresses, require_film  # slow to import, and no other study needs it

    require_film(case.subject)
    case.subject.require_single("a single value; film stresses are computed for one contact per case")
    subject = case.with_surface_moments(choice.model_key).subject
    return _said(film_stresses(subject, separation=case.separation, load=case.load, **choice.arguments()), case)


def slide_case(case: Case, choice: Choice | None = None, kept: float = 1.0, weakening_slip: Any = None) -> "xarray.Dataset":
    """From rest to sliding at points of a case, five of them at the most, as `slide` gives it: of the nominal numbers, where
    some are uncertain, and of the map, or of the method that stands for the surface, where it was measured.

    choice: model and laws, in place of those of the case; kept, weakening_slip: as in `slide`. Raises InputError, also for a
    contact of which numbers are several."""
    if case.is_several:
        raise InputError("contact", "numbers of the contact are several", "one contact; st.slide takes any number")
    choice = choice_of_case(case, choice or case.choice)
    given = {name: value for name, value in choice.arguments().items() if name != "presliding"}
    given_at = {name: getattr(case, name) for name in ("separation", "load") if getattr(case, name) is not None}
    points = {name: each[few_places(np.size(each), _FEW)] if np.ndim(each) else each for name, each in given_at.items()}
    subject = case.subject if solves_maps(choice) else case.subject.as_numbers()
    data = slide(subject, **points, kept=kept, weakening_slip=weakening_slip, **given)
    return _said(data, case).assign_attrs(case.subject.groups())


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
    """The choice with the model that its name stands for. Raises InputError."""
    laws = {law: key for law, key in choice.laws().items() if law != "model"}
    if choice.model != case.choice.model:
        model = find(choice_of(choice.model, {}, case.subject).model_key, RoughSurface)
        if not model.asperity:  # it takes none of the laws that the case names beside its own
            laws = {law: key for law, key in laws.items() if key != case.choice.laws()[law]}
    return choice_of(choice.model, laws | dict(choice.options), case.subject)


def compare_case(case: Case, load: Any = None, progress: Progress = silent) -> "xarray.Dataset":
    """Every model on the contact of a case, as `compare` gives them, at a working load [N].

    Where the case names scans, the result has also friction_coefficient_at_load_by_method (asperity_method, model),
    friction_coefficient_at_load_low and friction_coefficient_at_load_high. progress: from a text, what wraps a list of steps.
    Raises InputError.
    """
    return _said(compare(case.subject, load=load, progress=progress("Asking the models")), case)


def _said(data: "xarray.Dataset", case: Case) -> "xarray.Dataset":
    """With the title of the case, and the program."""
    title = {"case": case.title} if case.title else {}
    return data.assign_attrs(title, program=f"stiction {__version__}")
