"""Convert normalised arrays to a labelled dataset in the units of the contact, with models, sources and warnings."""

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.subject import Subject
from stiction.laws.validity import as_attributes
from stiction.quantities.dimensions import aligned, dimensions, variable
from stiction.quantities.shown import span
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import JUNCTIONS, Addition
from stiction.solving import unused
from stiction.solving.accuracy import film_errors, measured_error
from stiction.solving.conditions import warnings_of_results
from stiction.solving.inversion import Inversion, pull_off
from stiction.solving.points import Points, Solved
from stiction.solving.problem import Problem
from stiction.solving.state import area_fraction

if TYPE_CHECKING:
    import xarray


def labelled(
    subject: Subject,
    tables: Mapping[str, np.ndarray],
    factors: Mapping[str, Any],
    dims: Mapping[str, int],
    coords: Mapping[str, Any],
) -> "xarray.Dataset":
    """Convert normalised arrays to a dataset in the units of the contact.

    tables: arrays by name, of the shape `dims` or broadcastable to it. factors: numbers by which arrays are multiplied, by unit
    ("N", "m^2", "count"). dims, coords: dimensions with their sizes, and coordinates.
    """
    return as_dataset(as_variables(subject, tables, factors, dims), coords)


def as_variables(
    subject: Subject, tables: Mapping[str, np.ndarray], factors: Mapping[str, Any], dims: Mapping[str, int]
) -> dict[str, tuple]:
    """Convert normalised arrays to (dimensions, values in the units of the contact, attributes), by name.

    tables: arrays by name. factors: as in `labelled`. dims: dimensions with their sizes.
    """
    shape, variables = tuple(dims.values()), {}
    for name, table in tables.items():
        scale = aligned(factors.get(QUANTITIES[name].scale, 1.0), dims)
        variables[name] = (tuple(dims), np.broadcast_to(table * scale, shape).copy(), subject.attributes(name))
    return variables


def variables_of(
    points: Points,
    solved: Solved,
    tables: Mapping[str, np.ndarray],
    keep: Collection[str] | None = None,
    refused: np.ndarray | None = None,
) -> dict[str, tuple]:
    """Return the results at points as variables, with the load residual and the pull-off results if there are any.

    tables: normalised results by name. keep: names of the requested results, by default all. refused: mask (n,) of contacts
    without results. A variable is (dimensions, values in the units of the contact, attributes).
    """
    kept = {name: table for name, table in tables.items() if keep is None or name in keep}
    variables = as_variables(points.problem.subject, kept, points.factors, points.dims)
    if solved.found is not None and (keep is None or "load_residual" in keep):
        variables["load_residual"] = (tuple(points.dims), solved.found.residual.reshape(points.wanted.shape), _RESIDUAL)
    pulls = keep is None or not {"pull_off_force", "pull_off_separation"}.isdisjoint(keep)
    if pulls and "mean_separation" in tables and not points.problem.needs_load:
        variables |= _pull_off(points, solved.found, refused)
    return variables


_RESIDUAL = {
    "long_name": "load residual",
    "comment": "(computed load - requested load) / requested load; relative to the pull-off force if the load is negligible",
}


def _pull_off(points: Points, inversion: Inversion | None, refused: np.ndarray | None) -> dict[str, tuple]:
    """Return the pull-off force and its separation for each contact: (dimensions, values, attributes) by name.

    inversion: separations found for the problem, or None. If the problem is on the unloading branch, it already contains both
    results; otherwise they are computed here. refused: mask (n,) of contacts without results, or None.
    """
    problem, apart = points.problem, points.problem.on_branch("unloading")
    if inversion is not None and apart is problem:
        tension, where = inversion.tension, inversion.where
    else:
        tension, where = np.full((2, len(problem.groups)), np.nan)
        taken = slice(None) if refused is None else np.flatnonzero(~refused)
        tension[taken], where[taken] = pull_off(apart.with_groups(taken))
    dims = dimensions(points.factors.values(), problem.dims)
    each = problem.shape + (1,) * (len(dims) - len(problem.shape))
    tables = {"pull_off_force": tension.reshape(each), "pull_off_separation": where.reshape(each)}
    return as_variables(apart.subject, tables, points.factors, dims)


def as_dataset(variables: Mapping[str, tuple], coords: Mapping[str, Any]) -> "xarray.Dataset":
    """Build a dataset from variables and coordinates in one step.

    variables: (dimensions, values, attributes) by name. Assigning variables one by one would align all variables each time.
    """
    import xarray

    made = {name: variable(*given) for name, given in variables.items()}
    data = xarray.Dataset({name: variable for name, variable in made.items() if name not in coords}, coords=coords)
    again = {name: variable for name, variable in made.items() if name in coords}
    return data.assign(again) if again else data


def with_shares(problem: Problem, tables: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return the results with area_fraction and nominal_pressure added, where they can be computed.

    area_fraction requires the roughness parameter, nominal_pressure the nominal area. tables: normalised arrays by name, with
    the dimensions of the contacts first.
    """
    shared = dict(tables)
    if problem.groups.roughness_parameter is not None:
        area = tables["contact_area"]
        shared["area_fraction"] = area_fraction(problem.groups, area.reshape(len(problem.groups), -1)).reshape(area.shape)
    if "Pa" in problem.subject.scales().factors():
        shared["nominal_pressure"] = tables["load"]
    return shared


def _change_by_junctions(problem: Problem, tables: Mapping[str, np.ndarray]) -> dict[str, str]:
    """Return an attribute that compares mu with the mu of the published law; {} if the published law is in use.

    The two differ if an option gives yielded junctions the resistance of another law.
    """
    if "friction_coefficient_published" not in tables:
        return {}
    mu, published = (np.ravel(tables[name]) for name in ("friction_coefficient", "friction_coefficient_published"))
    known = np.isfinite(mu) & np.isfinite(published)
    words = [f"yielded junctions follow {problem.options[JUNCTIONS]}, not the published law"]
    if known.any():
        mu, published = mu[known], published[known]
        ends = [span((coefficients.min(), coefficients.max())) for coefficients in (mu, published)]
        words.append(f"mu is {ends[0]}, by the published law {ends[1]}")
        if (published > 0.0).all():
            ratio = mu / published
            words.append(f"a ratio of {span((ratio.min(), ratio.max()))}")
    return {"change_by_junctions": ": ".join([words[0], ", ".join(words[1:])]) if words[1:] else words[0]}


def summary_of(subject: Subject, problem: Problem, tables: Mapping[str, np.ndarray]) -> dict[str, str]:
    """Return the attributes of a result: laws, sources, measured errors and validity warnings, as texts by name.

    tables: normalised results by name.
    """
    if "description" not in problem.shared:
        problem.shared["description"] = _description(subject, problem)
    return {
        **problem.shared["description"],
        **_change_by_junctions(problem, tables),
        **as_attributes(warnings_of_results(problem, tables)),
        **measured_error.as_attributes(measured_error.measured_errors(problem, tables)),
        **film_errors.as_attributes(problem, tables),
    }


def _description(subject: Subject, problem: Problem) -> dict[str, str]:
    """Return those attributes of a result that depend only on the problem: title, laws, sources, inputs."""
    records = problem.records()
    used = dict.fromkeys(source.key for record in records for source in record.sources)
    laws = {
        kind: next((record.key for record in records if record.kind == kind), "none")
        for kind in ("asperity", "tangential", "film")
    }
    return {
        "title": f"Static friction after {problem.record.key}",
        "model": problem.record.key,
        **laws,
        **{record.kind: record.key for record in records if isinstance(record, Addition)},
        **problem.options,
        "options": " ".join(problem.options),
        "heights": problem.heights_taken,
        **({"area_by": problem.way} if problem.way else {}),
        "grade": max(record.grade for record in records),
        "sources": " ".join(used),
        **unused.as_attributes(unused.unused_inputs(problem)),
        "remarks": "; ".join(subject.remarks()),
        "inputs": "\n".join(f"{name} = {text}" for name, text in subject.inputs()),
        "friction_law": "included" if problem.friction else "none: this model computes no friction",
    }
