"""A case, solved or compared: also one whose surface was measured, with the spread over the methods of finding asperities."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction import __version__
from stiction.quantities.errors import InputError
from stiction.solving.candidates import choice_of
from stiction.solving.choice import LAWS, Choice
from stiction.solving.solve import solve
from stiction.studies.case import Case
from stiction.studies.comparison import compare, working_load

if TYPE_CHECKING:
    import xarray

__all__ = ["compare_case", "solve_case"]


RECOMMENDED = "recommended"


def solve_case(case: Case, choice: Choice | None = None) -> "xarray.Dataset":
    """The points of a case, as `solve` gives them; choice: other laws and options than those of the case; the model may be any
    that `compare` shows, or "recommended": the one that it recommends at the working load.

    Where the case names scans, friction_coefficient is that of the method which stands for the surface, and the result has
    also friction_coefficient_by_method (asperity_method, points), friction_coefficient_low and friction_coefficient_high; its
    attributes say the method and what was done to the scans. Raises InputError.
    """
    choice = choice_of_case(case, choice or case.choice)
    data = solve(case.subject, separation=case.separation, load=case.load, **choice.arguments())
    return _said(data, case).assign_attrs(case.with_surface_moments(choice.model).subject.groups())


def choice_of_case(case: Case, choice: Choice) -> Choice:
    """The choice with the model that its name stands for. Raises InputError where none is recommended."""
    name = choice.model
    if name == RECOMMENDED:
        said = compare(case.subject, load=working_load(replace(case, choice=Choice()), None)).attrs
        name = said.get("recommended", "none")
        if name == "none":
            why = said.get("reason", "without a working load, which is above 0, no model is judged")
            raise InputError("model", RECOMMENDED, "; ".join(filter(None, ["a model by its key", why, said.get("advice")])))
    given = {law: getattr(choice, law) for law in LAWS if law != "model"} | dict(choice.options)
    return choice_of(name, given, case.subject)


def compare_case(
    case: Case, load: Any = None, progress: Callable[[str], Callable[[Iterable], Iterable]] = lambda text: iter
) -> "xarray.Dataset":
    """Every model on the contact of a case, as `compare` gives them, at a working load [N].

    Where the case names scans, the result has also friction_coefficient_at_load_by_method (asperity_method, model),
    friction_coefficient_at_load_low and friction_coefficient_at_load_high. progress: from a text, what wraps a list of steps.
    Raises InputError.
    """
    data = compare(case.subject, load=load, progress=progress("Asking the models"))
    if case.load is not None:
        data = data.assign_attrs(case_loads=np.asarray(case.load, dtype=float))
    return _said(data, case)


def _said(data: "xarray.Dataset", case: Case) -> "xarray.Dataset":
    """With the title of the case, and the program."""
    title = {"case": case.title} if case.title else {}
    return data.assign_attrs(title, program=f"stiction {__version__}")
