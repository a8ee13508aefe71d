"""Compute load, contact area and static friction of a contact, as a labelled dataset."""

from typing import TYPE_CHECKING, Any, Unpack

import numpy as np

from stiction.contact.contact import Contact
from stiction.contact.subject import Subject, as_subject
from stiction.engine.heights import Heights
from stiction.laws.validity import with_warnings
from stiction.quantities.dimensions import coordinate
from stiction.quantities.errors import InputError
from stiction.quantities.keywords import with_keywords
from stiction.records.registry import RoughSurface, find
from stiction.records.validity_warning import ValidityWarning
from stiction.solving.candidates import choice_of
from stiction.solving.choice import Choice, LawKeywords
from stiction.solving.conditions import warnings_of_rounding
from stiction.solving.method_spread import as_measured, with_method_spread
from stiction.solving.points import Points, in_words, points_of, solve_points
from stiction.solving.problem import make_problem, with_surface_moments
from stiction.solving.results import as_dataset, as_variables, summary_of, variables_of, with_shares

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import QuantityLike


@with_keywords(LawKeywords)
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

    Parameters
    ----------
    contact : Contact or Indices
        All values are in SI units for a Contact, and normalised per asperity (theory.md) for Indices. Any number in it may be
        an array with a named dimension (`st.axis`); the result then has that dimension.
    separation : float [m], str with a unit, or array, optional
        Mean separation, for Indices in units of sigma. Scalar, one-dimensional, or an xarray.DataArray with named
        dimensions.
    load : float [N], str with a unit, or array, optional
        Net normal load, in place of a separation; normalised for Indices. Shape as for `separation`.
    model : str, optional
        Key of a rough-surface model (`st.models()`), or a name that `st.compare` shows for this contact. By default
        "soft_coating_2015", which raises an error if the contact specifies an interfacial shear strength.
    heights : Heights or str, optional
        Height distribution, or its name; by default the distribution of the contact, or Gaussian.
    threads : int
        Number of threads; it does not affect the results.
    **laws : str, optional
        Keys of laws that replace those of the model (`asperity`, `tangential`, `film`) or add to them (e.g. `meniscus`,
        `ageing`), or options of the model and its laws, e.g. `variant="published"`. `stiction.models` lists all laws. "none"
        omits a law: with `tangential="none"` only the contact is solved.

    Returns
    -------
    xarray.Dataset
        Results with units and long names, along the dimensions of contact and points: load, contact_area, friction_force,
        friction_coefficient (NaN where the net load is not compressive), mean_separation, touching_asperities, pull_off_force
        and their parts by state, body and limit. Results that a model does not compute are missing. Attributes: model, options,
        sources, and the validity warnings as text (`outside_validity`) and as JSON (`validity_warnings`). With a measured
        surface also friction_coefficient_by_method (asperity_method, points), friction_coefficient_low and
        friction_coefficient_high.

    Raises
    ------
    InputError
        A value is out of bounds, laws cannot be combined, or a load cannot be carried at any separation.

    Notes
    -----
    Equations and sources are those of the model and its laws: `st.cite(result)` returns them. If the model has no tangential
    law and the contact specifies an interfacial shear strength, a law of the interface computes the friction.

    Examples
    --------
    >>> import stiction as st
    >>> rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    >>> contact = st.Contact(
    ...     first="gold", second="gold", roughness=rough, nominal_area="1 mm^2", interfacial_shear_strength="50 MPa"
    ... )
    >>> result = st.solve(contact, load=["1 N", "2 N"], model="greenwood_williamson_1966")
    >>> result.friction_coefficient.values.round(4)
    array([0.0798, 0.0767])
    """
    choice = choice_of(model, laws, as_subject(contact))
    bodies = with_surface_moments(contact, choice.model_key)
    measured = bodies.measured
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
    assert isinstance(bodies, Contact)  # no other subject has scans
    return as_measured(with_method_spread(data, measured.contacts(bodies), measured.counts, choice, heights), measured)


def _at_points(
    contact: Subject, separation: Any, load: Any, choice: Choice, heights: Heights | str | None, threads: int
) -> "xarray.Dataset":
    """Return the result of `solve` for one set of roughness numbers, without the range between asperity methods."""
    points = points_of(make_problem(contact, choice, heights, threads), load, separation)
    problem, given = points.problem, points.name
    with in_words(points):
        solved = solve_points(points)
    tables = with_shares(problem, solved.tables)
    variables = variables_of(points, solved, tables)
    coords = points.coords
    if given in getattr(points.value, "dims", ()):
        coords[given] = coordinate(given, points.value.values, variables.pop(given)[2])
    data = as_dataset(variables, coords)
    data.attrs |= summary_of(problem.subject, problem, tables)  # in place, because assign_attrs copies the dataset
    if solved.found is None or solved.carried is None:
        return data if problem.record.of_map is None else _with_interruption(data)
    data.attrs["convergence"] = f"all separations converged in at most {solved.found.evaluations} evaluations"
    return _with_carried(data, points, solved.carried)


def _with_interruption(data: "xarray.Dataset") -> "xarray.Dataset":
    """Return the dataset with a validity warning if some loads were not solved because the solution was interrupted."""
    missing = int(np.isnan(data["contact_area"].values).sum())
    if not missing:
        return data
    why = f"interrupted: {missing} of {data['contact_area'].size} loads were not solved"
    return with_warnings(data, [ValidityWarning(why)])


def _with_carried(data: "xarray.Dataset", points: Points, carried: np.ndarray) -> "xarray.Dataset":
    """Return the dataset with a validity warning if requested loads were lost in round-off.

    carried: normalised loads that were computed. If a warning is added and the load is a coordinate, the computed loads are
    added as `load_carried`.
    """
    validity_warnings = warnings_of_rounding(carried, points.wanted)
    if not validity_warnings:
        return data
    if "load" in data.coords:
        beside = as_variables(points.problem.subject, {"load": carried}, points.factors, points.dims)["load"]
        data["load_carried"] = (*beside[:2], beside[2] | {"long_name": "normal load that is carried"})
    return with_warnings(data, validity_warnings)
