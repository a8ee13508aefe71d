"""Load, contact area and static friction of a contact, as a labelled dataset."""

from typing import TYPE_CHECKING, Any, Unpack

import numpy as np

from stiction.contact.subject import Subject, as_subject
from stiction.engine.heights import Heights
from stiction.laws.validity import with_warnings
from stiction.quantities.errors import InputError
from stiction.records.registry import RoughSurface, find
from stiction.records.validity_warning import ValidityWarning
from stiction.solving.candidates import choice_of
from stiction.solving.choice import Choice, LawKeywords, with_law_keywords
from stiction.solving.conditions import warnings_of_rounding
from stiction.solving.method_spread import as_measured, with_method_spread
from stiction.solving.points import Points, in_words, points_of, solve_points
from stiction.solving.problem import make_problem, with_surface_moments
from stiction.solving.results import as_dataset, as_variables, summary_of, variables_of, with_shares

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import QuantityLike


@with_law_keywords
def solve(
    contact: Subject,
    *,
    separation: "QuantityLike | None" = None,
    load: "QuantityLike | None" = None,
    model: str | None = None,
    heights: Heights | str | None = None,
    threads: int = 1,
    **laws: Unpack[LawKeywords],
) -> "xarray.Dataset":
    """Solve a contact at given mean separations, or at given loads.

    contact: a Contact (then everything is in SI) or Indices (then normalised as in docs/theory.md, per asperity).
    separation: mean separation, m for a Contact (text with a unit is fine), over sigma for Indices; or load: net normal
    load, N or normalised. A number, a 1-D sequence, or an xarray.DataArray with named dimensions. Any number of the
    contact may be an array with a named dimension (stiction.axis): the result carries all dimensions.
    model: key of a rough-surface model (stiction.models()), or any name that `compare` shows for this contact, by default
    soft_coating_2015, unless the contact states a strength of its interface, which that ignores; where it has
    no tangential law and the contact states the strength of its interface, that is sheared. laws: keys of other laws in place
    of those that the model takes by itself, as asperity, tangential ("none" for contact only) or film;
    presliding="mindlin_1949" adds tangential_stiffness, that of the contact before anything slides; meniscus and ageing are
    taken where the contact states a liquid and a waiting time, "none" leaves them out; and options of the model or of these
    laws, by name, such as variant="published", branch="unloading", transition="gradual"; None for a default. heights: a
    height distribution, or its name; by default the contact's own, or Gaussian. threads: how many share the work, which
    changes no digit.

    Returns an xarray.Dataset with units and long names: load, contact_area, friction_force, friction_coefficient (not a
    number where the net load is not compressive: there the surfaces hold themselves), mean_separation,
    touching_asperities, their parts by state, body and limit, and pull_off_force; what a model does not know is left out. Its
    attributes name model, options, sources, and what is used beyond the claims of its authors: `outside_validity` in words,
    `validity_warnings` as JSON. Where the roughness was measured, friction_coefficient is that of the method which stands for
    the surface, and there are also friction_coefficient_by_method (asperity_method, points), friction_coefficient_low and
    friction_coefficient_high; the attributes say the method and what was done to the scans.
    Raises InputError for bad input, for laws that do not go together, and for a load that is nowhere carried.
    """
    choice = choice_of(model, laws, as_subject(contact))
    measured = with_surface_moments(as_subject(contact), choice.model_key).measured
    try:
        data = _at_points(contact, separation, load, choice, heights, threads)
    except InputError as error:
        validity_warnings = "".join(f"; {warning}" for warning in (measured.validity_warnings if measured else ()))
        raise InputError(error.field, error.value, error.allowed + validity_warnings, error.hint) from None
    if measured is None:
        return data
    if find(choice.model_key, RoughSurface).of_map is not None:
        return with_warnings(data, map(ValidityWarning, measured.validity_warnings)).assign_attrs(
            measured.solvable.attributes()
        )
    contacts = measured.contacts(with_surface_moments(contact, choice.model_key))
    return as_measured(with_method_spread(data, contacts, measured.counts, choice, heights), measured)


def _at_points(
    contact: Subject, separation: Any, load: Any, choice: Choice, heights: Heights | str | None, threads: int
) -> "xarray.Dataset":
    """What `solve` gives, without the spread over the methods of finding asperities."""
    points = points_of(make_problem(contact, choice, heights, threads), load, separation)
    problem, given = points.problem, points.name
    with in_words(points):
        solved = solve_points(points)
    tables = with_shares(problem, solved.tables)
    variables = variables_of(points, solved, tables)
    coords = points.coords
    if given in getattr(points.value, "dims", ()):
        coords[given] = (given, points.value.values, variables.pop(given)[2])
    data = as_dataset(variables, coords).assign_attrs(summary_of(problem.subject, problem, tables))
    if solved.found is None or solved.carried is None:
        return data if problem.record.of_map is None else _with_interruption(data)
    data = _with_carried(data, points, solved.carried)
    return data.assign_attrs(convergence=f"all separations converged in at most {solved.found.evaluations} evaluations")


def _with_interruption(data: "xarray.Dataset") -> "xarray.Dataset":
    """The dataset with the validity warning that not all loads were solved, where a solution was interrupted."""
    missing = int(np.isnan(data["contact_area"].values).sum())
    if not missing:
        return data
    why = f"interrupted: {missing} of {data['contact_area'].size} loads were not solved"
    return with_warnings(data, [ValidityWarning(why)])


def _with_carried(data: "xarray.Dataset", points: Points, carried: np.ndarray) -> "xarray.Dataset":
    """The dataset with the validity warning that loads asked for are lost in rounding, where any are, and with the loads that
    are carried beside those asked for, where these are a coordinate."""
    validity_warnings = warnings_of_rounding(carried, points.wanted)
    if validity_warnings and "load" in data.coords:
        beside = as_variables(points.problem.subject, {"load": carried}, points.factors, points.dims)["load"]
        data["load_carried"] = (*beside[:2], beside[2] | {"long_name": "net normal load that is carried"})
    return with_warnings(data, validity_warnings)
