"""Solve a case, compute its friction during sliding, or compare all models for it.

For a surface measured by scans, the functions add the range of friction over the asperity methods.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction import __version__
from stiction.case.read import Case, as_case
from stiction.contact.subject import Subject
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.progress import Progress, silent
from stiction.quantities.sampling import spread_rows
from stiction.records.registry import RoughSurface, find
from stiction.solving.candidates import choice_of
from stiction.solving.choice import RECOMMENDED, Choice
from stiction.solving.sliding import slide
from stiction.solving.solve import solve
from stiction.studies.comparison.compare import compare
from stiction.studies.prediction.predict import is_predicted, predict
from stiction.studies.uncertainty.bands import with_bands
from stiction.studies.uncertainty.drawing import solves_maps

if TYPE_CHECKING:
    import xarray

    from stiction.case.arguments import CaseLike
    from stiction.quantities.arguments import QuantityLike

_MOST = 1_000_000  # points of one case; more need too much memory and time
_FEW = 5  # points of one case for which curves of force against displacement are computed


def solve_case(case: "CaseLike", choice: Choice | None = None, progress: Progress = silent) -> "xarray.Dataset":
    """Solve a case at the loads or mean separations that it states.

    Parameters
    ----------
    case : Case, path, or dict like a case file
        The contact and its points: loads or mean separations.
    choice : Choice, optional
        Model, laws and options that replace those of the case. The model may be any model that `compare` shows, or
        "recommended" for the prediction of `predict`.
    progress : callable
        Receives a label and returns a function that wraps the list of steps.

    Returns
    -------
    xarray.Dataset
        The dataset that `solve` returns; for a prediction, the dataset that `predict` returns. With uncertain numbers, the
        results belong to the nominal contact. For friction_coefficient, contact_area, load and pull_off_force, the variables
        NAME_quantile (quantile, ...) and NAME_quantile_error, its standard error, are added. With scans,
        friction_coefficient_by_method (asperity_method, points) is added. Its smallest and largest values over the asperity
        methods are friction_coefficient_low and friction_coefficient_high.

    Raises
    ------
    InputError
        The errors of `solve` or, for a prediction, of `predict`; or the case has more than 1,000,000 points.

    Examples
    --------
    >>> import stiction as st
    >>> case = {"indices": {"theta": 40, "lam": 10}, "solve": {"separation": [0.5, 1.0]}}
    >>> st.solve_case(case).mean_separation.values
    array([0.5, 1. ])
    """
    case = as_case(case)
    choice = case.choice if choice is None else choice
    require_choice(choice)
    if choice.model == RECOMMENDED and is_predicted(chosen := replace(case, choice=choice)):
        return predict(chosen)
    if case.size > _MOST:
        raise InputError("contact", InWords(f"{case.size} points"), f"at most {_MOST}; `stiction sweep` computes more, on disk")
    choice = choice_of_case(case, choice)
    data = solve(case.subject, **case.requested_points, **choice.arguments())
    data = with_bands(data, case, choice, progress("Sampling uncertain inputs"))
    return with_groups(_with_notes(data, case), case.with_surface_moments(choice.model_key).subject)


def sources_of_case(case: "CaseLike") -> list[str]:
    """Return the bibliography keys of the prediction of a case, or of the model and laws that solve it if it names any.

    The default model solves a case that names no model, but a law or an option, and a case with [indices] that names no model.
    Raises the errors of `solve_case` and `predict`.
    """
    case = as_case(case)
    data = predict(case) if is_predicted(case) else solve_case(case)
    return data.attrs["sources"].split()


def film_of_case(case: Case, choice: Choice) -> "xarray.Dataset":
    """Compute the stresses in the film of a case at its points, with the models and laws of `choice`.

    Returns the dataset of `film_stresses`, with the title of the case. Raises InputError if the contact has no film or if a
    number of the case is an array.
    """
    from stiction.studies.stresses.film_stress import film_stresses, require_film  # slow to import, and no other study needs it

    require_film(case.subject)
    case.subject.require_single("a single value; film stresses are computed for one contact per case")
    subject = case.with_surface_moments(choice.model_key).subject
    return _with_notes(film_stresses(subject, **case.requested_points, **choice.arguments()), case)


def slide_case(
    case: "CaseLike",
    choice: Choice | None = None,
    residual_strength: float | None = None,
    weakening_slip: "QuantityLike | None" = None,
    spring_stiffness: "QuantityLike | None" = None,
    tangential_force: "QuantityLike | None" = None,
) -> "xarray.Dataset":
    """Compute the tangential force of a case against displacement, at no more than five of its points.

    Parameters
    ----------
    case : Case, path, or dict like a case file
        One contact; uncertain numbers have their nominal values.
    choice : Choice, optional
        Model and laws that replace those of the case.
    residual_strength : float, optional
        Fraction of the shear strength, 0 to 1, that remains: at an asperity once it slides, at a point of a height map after
        the slip `weakening_slip`.
    weakening_slip : float [m] or str with a unit, optional
        For a height map: slip over which the strength of a point falls to `residual_strength`.
    spring_stiffness : float [N/m] or str with a unit, optional
        For a height map: stiffness of the machine that moves the body; by default the machine is rigid.
    tangential_force : float [N], str with a unit, or array, optional
        For a height map at one load: tangential forces to apply instead of displacements.

    Returns
    -------
    xarray.Dataset
        The dataset that `slide` returns, with the dimensionless groups of the contact as attributes.

    Raises
    ------
    InputError
        The errors of `slide`; or a number of the contact is an array.

    Examples
    --------
    >>> import stiction as st
    >>> case = {"indices": {"theta": 40, "lam": 10}, "solve": {"separation": [0.5, 1.0]}}
    >>> st.slide_case(case).sizes["mean_separation"]
    2
    """
    case = as_case(case)
    if case.is_swept:
        raise InputError("contact", InWords("array parameters"), "a single contact; st.slide accepts arrays")
    choice = choice_of_case(case, case.choice if choice is None else choice)
    arguments = {name: value for name, value in choice.arguments().items() if name != "presliding"}
    points = {
        name: row[spread_rows(np.size(row), _FEW)] if np.ndim(row) else row for name, row in case.requested_points.items()
    }
    subject = case.subject if solves_maps(choice) else case.subject.as_numbers()
    data = slide(
        subject, **points, residual_strength=residual_strength, weakening_slip=weakening_slip,
        spring_stiffness=spring_stiffness, tangential_force=tangential_force, **arguments,
    )  # fmt: skip
    return _with_notes(data, case).assign_attrs(case.subject.groups())


def with_groups(data: "xarray.Dataset", subject: Subject) -> "xarray.Dataset":
    """Return a dataset of results with the dimensionless groups of the contact added.

    A group that is a single number becomes an attribute. A group that is an array becomes a variable, unless the dataset
    already has one of this name.
    """
    groups: dict[str, Any] = subject.all_groups()
    swept = {
        name: (value.dims, value.values, subject.attributes(name))
        for name, value in groups.items()
        if hasattr(value, "dims") and name not in data.variables
    }
    return data.assign(swept).assign_attrs(subject.groups())


def require_choice(choice: Any) -> None:
    if not isinstance(choice, Choice):
        raise InputError("choice", choice, "a stiction.solving.choice.Choice, e.g. Choice(model=...)")


def choice_of_case(case: Case, choice: Choice) -> Choice:
    """Return the model, laws and options that evaluate a case, resolved from the names in `choice`.

    A name that `compare` shows may denote a model together with laws; the model and these laws then replace the name. If
    `choice` names another model than the case, and that model has fixed laws, the laws of the case are dropped. Raises
    InputError.
    """
    require_choice(choice)
    laws = choice.laws()
    del laws["model"]
    if choice.model != case.choice.model:
        model = find(choice_of(choice.model, {}, case.subject).model_key, RoughSurface)
        if not model.asperity:  # a theory in closed form has its own laws
            laws = {law: key for law, key in laws.items() if key != case.choice.laws()[law]}
    return choice_of(choice.model, laws | dict(choice.options), case.subject)


def compare_case(case: "CaseLike", load: "QuantityLike | None" = None, progress: Progress = silent) -> "xarray.Dataset":
    """Solve a case with every model that applies to it.

    Parameters
    ----------
    case : Case, path, or dict like a case file
        The contact.
    load : float [N] or str with a unit, optional
        Working load, above 0; without it only curves are computed.
    progress : callable
        Receives a label and returns a function that wraps the list of models.

    Returns
    -------
    xarray.Dataset
        The dataset that `compare` returns.

    Raises
    ------
    InputError
        The errors of `compare`.

    Examples
    --------
    >>> import stiction as st
    >>> case = {"indices": {"theta": 40, "lam": 10}, "solve": {"separation": [0.5, 1.0]}}
    >>> "persson_2001" in st.compare_case(case, load=1.0).model
    False
    """
    case = as_case(case)
    return _with_notes(compare(case.subject, load=load, progress=progress("Comparing the models")), case)


def _with_notes(data: "xarray.Dataset", case: Case) -> "xarray.Dataset":
    """Return the dataset with the version of stiction and the title of the case, if it has one, added as attributes."""
    title = {"case": case.title} if case.title else {}
    return data.assign_attrs(title, program=f"stiction {__version__}")
