"""Load, contact area and static friction of a contact, as a labelled dataset."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.contact.subject import Subject, as_subject
from stiction.engine.heights import Heights
from stiction.engine.summation import FARTHEST
from stiction.laws.registry import RoughSurface, find
from stiction.laws.validity import Doubt, with_doubts
from stiction.quantities.dimensions import aligned, coordinates, dimensions
from stiction.quantities.errors import InputError
from stiction.quantities.foreign import as_sequence, is_series
from stiction.quantities.units import axis, from_series
from stiction.solving.candidates import choice_of
from stiction.solving.choice import DEFAULT_MODEL, Choice
from stiction.solving.conditions import doubts_of_rounding
from stiction.solving.inversion import Inversion, Unreachable, pull_off, solved_at
from stiction.solving.method_spread import with_measured
from stiction.solving.problem import Problem, as_asked, make_problem, with_surface_moments
from stiction.solving.results import as_dataset, as_variables, summary_of, with_shares

if TYPE_CHECKING:
    import xarray

_SUMS_AT_ONCE = 200_000  # pairs of a law and a separation at once: bounds the memory


def solve(
    contact: Subject,
    *,
    separation: Any = None,
    load: Any = None,
    model: str = DEFAULT_MODEL,
    heights: Heights | str | None = None,
    threads: int = 1,
    **laws: str | None,
) -> "xarray.Dataset":
    """Solve a contact at given mean separations, or at given loads.

    contact: a Contact (then everything is in SI) or Indices (then normalised as in docs/theory.md, per asperity).
    separation: mean separation, m for a Contact (text with a unit is fine), over sigma for Indices; or load: net normal
    load, N or normalised. A number, a 1-D sequence, or an xarray.DataArray with named dimensions. Any number of the
    contact may be an array with a named dimension (stiction.axis): the result carries all dimensions.
    model: key of a rough-surface model (stiction.models()), or any name that `compare` shows for this contact; where it has
    no tangential law and the contact states the strength of its interface, that is sheared. laws: keys of other laws in place
    of those that the model takes by itself, as asperity, tangential ("none" for contact only) or film;
    presliding="mindlin_1949" adds tangential_stiffness, that of the contact before anything slides; meniscus and ageing are
    taken where the contact states a liquid and a waiting time, "none" leaves them out; and options of the model or of these
    laws, by name, such as reading="published", branch="unloading", transition="gradual"; None for a default. heights: a
    height distribution, or its name; by default the contact's own, or Gaussian. threads: how many share the work, which
    changes no digit.

    Returns an xarray.Dataset with units and long names: load, contact_area, friction_force, friction_coefficient (not a
    number where the net load is not compressive: there the surfaces hold themselves), mean_separation,
    touching_asperities, their parts by state, body and limit, and pull_off_force; what a model does not know is left out. Its
    attributes name model, options, sources, and what is used beyond the claims of its authors: `outside_validity` in words,
    `doubts` as JSON. Where the roughness was measured, friction_coefficient is that of the method which stands for the surface,
    and there are also friction_coefficient_by_method (asperity_method, points), friction_coefficient_low and
    friction_coefficient_high; the attributes say the method and what was done to the scans.
    Raises InputError for bad input, for laws that do not go together, and for a load that is nowhere carried.
    """
    choice = choice_of(model, laws, as_subject(contact))
    measured = with_surface_moments(as_subject(contact), choice.model).measured
    try:
        data = _at_points(contact, separation, load, choice, heights, threads)
    except InputError as error:
        doubts = "".join(f"; {doubt}" for doubt in (measured.doubts if measured else ()))
        raise InputError(error.field, error.value, error.allowed + doubts, error.hint) from None
    if measured is None:
        return data
    if find(choice.model, RoughSurface).of_map is not None:
        return with_doubts(data, map(Doubt, measured.doubts)).assign_attrs(measured.solvable.attributes())

    def solved(other: Contact, loads: Any) -> "xarray.Dataset":
        return _at_points(other, None, loads, choice, heights, threads)

    whole = with_surface_moments(contact, choice.model)
    assert isinstance(whole, Contact)  # groups were not measured
    return with_measured(data, whole, solved)


def _at_points(
    contact: Subject, separation: Any, load: Any, choice: Choice, heights: Heights | str | None, threads: int
) -> "xarray.Dataset":
    """What `solve` gives, without the spread over the methods of finding asperities."""
    if (separation is None) == (load is None):
        raise InputError("separation or load", "both" if load is not None else None, "exactly one of the two")
    problem = make_problem(contact, choice, heights, threads)
    if problem.needs_load and load is None:
        raise InputError("separation", separation, f"a load in its place: {problem.record.key} knows no separation")
    name, given = ("load", load) if separation is None else ("mean_separation", separation)
    return _solved(problem, name, points_asked(problem.subject, name, given))


def _solved(problem: Problem, given: str, point: Any) -> "xarray.Dataset":
    """The dataset at the points given: the mean separations or loads, a number or an array with named dimensions."""
    subject = problem.subject
    factors = subject.scales().factors()
    dims = all_dims(problem, [point, *factors.values()])
    unit = "N" if given == "load" else "m"
    wanted = np.broadcast_to(aligned(point, dims) / aligned(factors[unit], dims), tuple(dims.values()))
    found = carried = None
    if problem.needs_load:
        tables = _at_load(problem, wanted, aligned(factors["N"], dims))
    elif given == "load":
        found, tables, carried = inverted(problem, wanted, aligned(factors["N"], dims))
    else:
        check_reach(wanted)
        h = aligned(point, dims) / aligned(factors["m"], dims)  # not broadcast: separations that all share are a grid
        tables = {"mean_separation": h} | summed(problem, h, wanted.shape)
    tables = with_shares(problem, tables)
    variables = as_variables(subject, tables, factors, dims)
    variables |= {} if found is None else convergence(found, dims)
    if "mean_separation" in tables and not problem.needs_load:
        variables |= pull_off_variables(problem, factors, found)
    coords = problem.coords | point_coordinates(point)
    if given in getattr(point, "dims", ()):
        coords[given] = (given, point.values, variables.pop(given)[2])
    data = as_dataset(variables, coords).assign_attrs(summary_of(subject, problem, tables))
    if found is None or carried is None:
        return data if problem.record.of_map is None else _with_interruption(data)
    kept = as_variables(subject, {"load": carried}, factors, dims)["load"] if given in data.coords else None
    data = _with_carried(data, carried, wanted, kept)
    return data.assign_attrs(convergence=f"all separations converged in at most {found.evaluations} evaluations")


def _with_interruption(data: "xarray.Dataset") -> "xarray.Dataset":
    """The dataset with the doubt that not all loads were solved, where a solution was interrupted."""
    missing = int(np.isnan(data["contact_area"].values).sum())
    if not missing:
        return data
    return with_doubts(data, [Doubt(f"interrupted: {missing} of {data['contact_area'].size} loads were not solved")])


def _with_carried(data: "xarray.Dataset", carried: np.ndarray, asked: np.ndarray, beside: tuple | None) -> "xarray.Dataset":
    """The dataset with the doubt that loads asked for are lost in rounding, where any are, and with the loads that are carried
    beside those asked for, where these are a coordinate."""
    doubts = doubts_of_rounding(carried, asked)
    if doubts and beside is not None:
        dims, values, attributes = beside
        data["load_carried"] = (dims, values, attributes | {"long_name": "net normal load that is carried"})
    return with_doubts(data, doubts)


def convergence(found: Inversion, dims: Mapping[str, int]) -> dict[str, tuple]:
    meaning = "load found less load asked for, over the latter, or over the pull-off force if it is nothing beside that"
    return {
        "load_residual": (
            tuple(dims),
            found.residual.reshape(tuple(dims.values())),
            {"long_name": "load residual", "comment": meaning},
        )
    }


def pull_off_variables(problem: Problem, factors: Mapping[str, Any], found: Inversion | None) -> dict[str, tuple]:
    """The largest tension of each contact, and where it is; found: of the problem itself, if it is known already."""
    apart = problem.on_branch("unloading")
    tension, where = (found.tension, found.where) if found and apart is problem else pull_off(apart)
    dims = all_dims(problem, factors.values())
    each = problem.shape + (1,) * (len(dims) - len(problem.shape))
    tables = {"pull_off_force": tension.reshape(each), "pull_off_separation": where.reshape(each)}
    return as_variables(problem.subject, tables, factors, dims)


def _at_load(problem: Problem, load: np.ndarray, unit: np.ndarray) -> dict[str, np.ndarray]:
    """Results of the full shape at normalised loads, of a theory that knows no separation."""
    model = problem.record.key
    if (load < 0.0).any() and not problem.adheres:
        raise InputError(
            "load", problem.subject.show(float((load * unit).min()), "load"), f"0 or more: {model} knows no adhesion"
        )
    tables = problem.at_load(load.reshape(len(problem.groups), -1))
    return {name: table.reshape(load.shape) for name, table in tables.items()}


def points_asked(subject: Subject, name: str, value: Any) -> Any:
    """The separations or loads asked for: a number, or an array with named dimensions (a plain sequence is named after
    its quantity)."""
    import xarray

    if isinstance(subject, Contact):
        if is_series(value):
            return from_series(value, name)
        value = as_sequence(value)
        row = isinstance(value, list | tuple) or getattr(value, "ndim", 0) > 0
        if row and not hasattr(value, "dims"):
            return axis(name, value)
    read = subject.read(value, name)
    return xarray.DataArray(read, dims=(name,), coords={name: read}) if isinstance(read, np.ndarray) else read


def point_coordinates(*points: Any) -> dict[str, Any]:
    """Coordinates of the points asked for, those that are results left out: there they stand already."""
    named = coordinates((str(point.name or ""), point) for point in points if hasattr(point, "dims"))
    results = ("load", "mean_separation")
    return {name: one for name, one in named.items() if name not in results or one.dims == (name,)}


def all_dims(problem: Problem, others: Any) -> dict[str, int]:
    """Dimensions of the contacts first, then those that only points and scales have."""
    return dimensions(others, problem.dims)


def check_reach(separation: np.ndarray) -> None:
    """InputError for separations over sigma beyond what is summed."""
    farthest = float(np.abs(separation).max(initial=0.0))
    if not farthest <= FARTHEST:
        raise InputError("separation", farthest, f"{FARTHEST:g} times sigma at most")


def inverted(problem: Problem, wanted: np.ndarray, unit: np.ndarray) -> tuple[Inversion, dict[str, np.ndarray], np.ndarray]:
    """Where the normalised loads `wanted` (full shape) are carried: how that was found, the results there with their
    mean_separation, and the loads that are carried."""
    with in_words(problem, wanted, unit):
        found, at_loads = solved_at(problem, wanted.reshape(len(problem.groups), -1))
    results = {name: table.reshape(wanted.shape) for name, table in at_loads.items()}
    return found, {"mean_separation": found.h.reshape(wanted.shape)} | as_asked(results, wanted), results["load"]


@contextmanager
def in_words(problem: Problem, wanted: np.ndarray, unit: np.ndarray) -> Iterator[None]:
    """Where one of the normalised loads `wanted` (full shape) is nowhere carried, say which loads are."""
    try:
        yield
    except Unreachable as error:
        where = (error.law, error.at)
        targets = wanted.reshape(len(problem.groups), -1)
        scale = np.broadcast_to(unit, wanted.shape).reshape(targets.shape)[where]

        def text(load: float) -> str:
            return problem.subject.show(load * scale, "load")

        if targets[where] <= error.high:
            bound = f"at least {text(error.low)}" if error.low else "more than 0"
        elif error.high >= 0.0:
            bound = f"at most {text(error.high)}"
        else:
            bound = f"none that is above {text(error.high)}, found within {FARTHEST:g} sigma,"
        raise InputError("load", text(targets[where]), f"{bound} under this model, for this contact") from None


def summed(problem: Problem, h: np.ndarray, shape: tuple[int, ...]) -> dict[str, np.ndarray]:
    """Results of the full shape, normalised, at separations h over sigma that broadcast to it."""
    laws = len(problem.groups)
    shared = all(length == 1 for length in h.shape[: len(problem.shape)])
    points = int(np.prod(shape)) // laws
    if shared:
        common = np.broadcast_to(h, (1,) * len(problem.shape) + shape[len(problem.shape) :]).reshape(-1)
    else:
        table = np.broadcast_to(h, shape).reshape(laws, points)
    step = max(1, _SUMS_AT_ONCE // max(points, 1))
    parts = []
    for start in range(0, laws, step):
        rows = slice(start, start + step)
        some = problem.with_groups(rows)
        parts.append(some.on_grid(common) if shared else some.at(table[rows]))
    return {name: np.concatenate([part[name] for part in parts]).reshape(shape) for name in parts[0]}
