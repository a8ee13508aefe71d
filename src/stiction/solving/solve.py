"""Load, contact area and static friction of a contact, as a labelled dataset."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact, Indices
from stiction.engine.heights import Heights
from stiction.engine.summation import FARTHEST
from stiction.laws.validity import breaches
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import axis, show, to_si
from stiction.solving.choice import Choice
from stiction.solving.inversion import Inversion, Unreachable, pull_off, separations_at
from stiction.solving.problem import ClosedForm, Problem, as_asked, make_problem, spread

if TYPE_CHECKING:
    import xarray

_SUMS_AT_ONCE = 200_000  # pairs of a law and a separation at once: bounds the memory


def solve(
    contact: Contact | Indices,
    *,
    separation: Any = None,
    load: Any = None,
    model: str = "soft_coating_2015",
    asperity: str | None = None,
    tangential: str | None = None,
    coating_law: str | None = None,
    presliding: str | None = None,
    heights: Heights | str | None = None,
    **options: str | None,
) -> "xarray.Dataset":
    """Solve a contact at given mean separations, or at given loads.

    contact: a Contact (then everything is in SI) or Indices (then normalised as in docs/theory.md, per asperity).
    separation: mean separation, m for a Contact (text with a unit is fine), over sigma for Indices; or load: net normal
    load, N or normalised. A number, a 1-D sequence, or an xarray.DataArray with named dimensions. Any number of the
    contact may be an array with a named dimension (stiction.axis): the result carries all dimensions.
    model: key of a rough-surface model (stiction.models()). asperity, tangential, coating_law: keys of other laws in place of
    those that the model takes by itself; tangential="none" for contact only. presliding: "mindlin_1949" adds
    tangential_stiffness, that of the contact before anything slides. heights: a height distribution, or its name; by
    default the contact's own, or Gaussian. options: those of the model or of these laws, by name, such as
    reading="published", branch="unloading", transition="gradual"; None for a default.

    Returns an xarray.Dataset with units and long names: load, contact_area, friction_force, friction_coefficient (not a
    number where the net load is not compressive: there the surfaces hold themselves), mean_separation,
    touching_asperities, their parts by state, body and limit, and pull_off_force; what a model does not know is left out. Its
    attributes name model, options, sources, and, under `outside_validity`, what is used beyond the claims of its authors.
    Raises InputError for bad input, for laws that do not go together, and for a load that is nowhere carried.
    """
    if (separation is None) == (load is None):
        raise InputError("separation or load", "both" if load is not None else None, "exactly one of the two")
    problem = make_problem(contact, Choice(model, asperity, tangential, coating_law, options, presliding), heights)
    contact = problem.subject
    units = units_of(contact)
    given = "load" if separation is None else "mean_separation"
    point = points_asked(contact, given, load if separation is None else separation)
    dims = all_dims(problem, [point, *units.values()])
    shape = tuple(dims.values())
    wanted = spread(point, dims) / spread(units[scale_of(given)], dims)
    coords = problem.coords | coords_of([point, *units.values()])
    extra, convergence, found = {}, {}, None
    if isinstance(problem, ClosedForm) and problem.needs_load:
        if given != "load":
            raise InputError("separation", separation, f"a load in its place: {model} knows no separation")
        if (wanted < 0.0).any():
            least = float((wanted * spread(units["N"], dims)).min())
            shown = show(least, "load") if isinstance(contact, Contact) else f"{least:.6g}"
            raise InputError("load", shown, f"0 or more: {model} knows no adhesion")
        tables = _at_load(problem, np.broadcast_to(wanted, shape))
    else:
        asked = np.broadcast_to(wanted, shape)
        if given == "load":
            found = inverted(contact, problem, asked, spread(units["N"], dims))
            wanted = found.h.reshape(shape)
            meaning = "load found less load asked for, over the latter, or over the pull-off force if it is nothing beside that"
            extra = {"load_residual": (found.residual.reshape(shape), meaning)}
            convergence = {"convergence": f"all separations converged in at most {found.evaluations} evaluations"}
        elif not np.abs(wanted).max(initial=0.0) <= FARTHEST:
            raise InputError("separation", float(np.abs(wanted).max()), f"{FARTHEST:g} times sigma at most")
        results = _sum(problem, wanted, shape)
        tables = {"mean_separation": wanted} | (as_asked(results, asked) if given == "load" else results)
    data = labelled(contact, tables, units, dims, coords)
    if "mean_separation" in tables:
        data = data.merge(_pull_off(contact, problem, units, found))
    if given in getattr(point, "dims", ()):
        data = data.drop_vars(given).assign_coords({given: (given, point.values, data[given].attrs)})
    for name, (values, meaning) in extra.items():
        data[name] = (tuple(dims), values, {"long_name": meaning})
    return data.assign_attrs(summary_of(contact, problem, tables) | convergence)


def _pull_off(contact, problem: Problem, units: dict[str, Any], found: Inversion | None) -> "xarray.Dataset":
    """The largest tension of each contact, and where it is; found: of the problem itself, if it is known already."""
    apart = problem.on_branch("unloading")
    tension, where = (found.tension, found.where) if found and apart is problem else pull_off(apart)
    dims = all_dims(problem, units.values())
    each = problem.shape + (1,) * (len(dims) - len(problem.shape))
    return labelled(
        contact, {"pull_off_force": tension.reshape(each), "pull_off_separation": where.reshape(each)}, units, dims, {}
    )


def _at_load(problem: ClosedForm, load: np.ndarray) -> dict[str, np.ndarray]:
    """Results of the full shape at normalised loads, of a theory that knows no separation."""
    tables = problem.at_load(load.reshape(len(problem.groups), -1))
    return {name: table.reshape(load.shape) for name, table in tables.items()}


def scale_of(name: str) -> str:
    """Which scale a quantity is measured in: its SI unit, or "count"."""
    return "count" if name == "touching_asperities" else QUANTITIES[name].unit


def units_of(contact: Contact | Indices) -> dict[str, Any]:
    """What normalised results are multiplied by, for each SI unit: numbers or arrays with named dimensions."""
    if isinstance(contact, Indices):
        return dict.fromkeys(("N", "m^2", "m", "count", "N/m"), 1.0)
    scales = contact.scales()
    return {
        "N": scales.load * scales.asperities,
        "m^2": scales.contact_area * scales.asperities,
        "m": scales.separation,
        "count": scales.asperities,
        "N/m": scales.load * scales.asperities / scales.separation,
    }


def points_asked(contact: Contact | Indices, name: str, value: Any) -> Any:
    """The separations or loads asked for: a number, or an array with named dimensions (a plain sequence is named after
    its quantity)."""
    import xarray

    if isinstance(contact, Contact):
        single = isinstance(value, str) or hasattr(value, "dims") or np.ndim(value) == 0
        return to_si(value, name) if single else axis(name, value)
    try:
        array = value if hasattr(value, "dims") else np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise InputError(name, value, "numbers, normalised like the indices") from None
    if not np.all(np.isfinite(array)):
        raise InputError(name, value, "finite numbers")
    if hasattr(value, "dims") or array.ndim == 0:
        return array if array.ndim else float(array)
    return xarray.DataArray(array, dims=(name,), coords={name: array})


def coords_of(values: Iterable[Any]) -> dict[str, Any]:
    return {str(name): item.variable for value in values for name, item in getattr(value, "coords", {}).items()}


def all_dims(problem: Problem, others: Iterable[Any]) -> dict[str, int]:
    """Dimensions of the contacts first, then those that only points and scales have."""
    dims = dict(problem.dims)
    for value in others:
        for dim, size in getattr(value, "sizes", {}).items():
            if dims.setdefault(str(dim), size) != size:
                raise InputError(str(dim), f"lengths {dims[str(dim)]} and {size}", "one length for one dimension")
    return dims


def inverted(contact, problem: Problem, wanted: np.ndarray, unit: np.ndarray) -> Inversion:
    """Separations (laws, points) over sigma where the normalised loads `wanted` (full shape) are carried."""
    targets = wanted.reshape(len(problem.groups), -1)
    try:
        return separations_at(problem, targets)
    except Unreachable as error:
        where = (error.law, error.at)
        scale = np.broadcast_to(unit, wanted.shape).reshape(targets.shape)[where]
        text = (lambda number: show(number * scale, "load")) if isinstance(contact, Contact) else "{:.6g}".format
        if targets[where] <= error.high:
            bound = f"at least {text(error.low)}" if error.low else "more than 0"
        elif error.high >= 0.0:
            bound = f"at most {text(error.high)}"
        else:
            bound = f"none that is above {text(error.high)}, found within {FARTHEST:g} sigma,"
        raise InputError("load", text(targets[where]), f"{bound} under this model, for this contact") from None


def _sum(problem: Problem, h: np.ndarray, shape: tuple[int, ...]) -> dict[str, np.ndarray]:
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


def labelled(contact, tables, units, dims, coords) -> "xarray.Dataset":
    """Tables (shape of dims or broadcasting to it), normalised, as a dataset in the units of the contact."""
    import xarray

    data = xarray.Dataset(coords=coords)
    shape = tuple(dims.values())
    for name, table in tables.items():
        scale = spread(units[scale_of(name)], dims) if scale_of(name) in units else 1.0
        data[name] = (tuple(dims), np.broadcast_to(table * scale, shape).copy(), attributes_of(contact, name))
    return data


def attributes_of(contact: Contact | Indices, name: str) -> dict[str, str]:
    quantity = QUANTITIES[name]
    attributes = {"long_name": quantity.meaning, "symbol": quantity.symbol, "units": quantity.unit or "1"}
    if isinstance(contact, Indices) and quantity.normalised_by:
        attributes |= {"units": "1", "normalised_by": quantity.normalised_by}
    return attributes


def summary_of(contact: Contact | Indices, problem: Problem, tables: dict[str, np.ndarray]) -> dict[str, str]:
    """What was used, where it comes from, and where it goes beyond the claims of its authors."""
    records = problem.records()
    used = dict.fromkeys(source.key for record in records for source in record.sources)
    laws = {kind: next((one.key for one in records if one.kind == kind), "none") for kind in ("asperity", "tangential", "film")}
    return {
        "title": f"Static friction after {problem.record.key}",
        "model": problem.record.key,
        **laws,
        **problem.options,
        "options": " ".join(problem.options),
        "heights": problem.heights.key,
        "grade": max(record.grade for record in records),
        "sources": " ".join(used),
        "outside_validity": "; ".join(map(str, breaches(contact, records, tables))),
        "friction_law": "included" if problem.friction else "none: this model is of contact only",
    }
