"""Load, contact area and static friction of a contact, as a labelled dataset."""

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .asperity.regime import Regime
from .contact import Contact, Indices
from .errors import InputError
from .heights import Heights
from .inversion import Inversion, Unreachable, pull_off, separations_at
from .problem import Problem, make_problem, spread
from .quantities import QUANTITIES
from .registry import Record
from .summation import FARTHEST
from .units import axis, show, to_si

if TYPE_CHECKING:
    import xarray

_COUNT, _LOAD, _AREA, _SLIP, _TEAR = range(5)  # as summation.QUANTITIES
_SUMS_AT_ONCE = 200_000  # pairs of a law and a separation at once: bounds the memory


def solve(
    contact: Contact | Indices,
    *,
    separation: Any = None,
    load: Any = None,
    model: str = "soft_coating_2015",
    reading: str | None = None,
    coating_law: str | None = None,
    branch: str | None = None,
    transition: str | None = None,
    heights: Heights | str | None = None,
) -> "xarray.Dataset":
    """Solve a contact at given mean separations, or at given loads.

    contact: a Contact (then everything is in SI) or Indices (then normalised as in docs/theory.md, per asperity).
    separation: mean separation, m for a Contact (text with a unit is fine), over sigma for Indices; or load: net normal
    load, N or normalised. A number, a 1-D sequence, or an xarray.DataArray with named dimensions. Any number of the
    contact may be an array with a named dimension (stiction.axis): the result carries all dimensions.
    model: key of a rough-surface model (stiction.models()). reading, coating_law, branch, transition: options of that model,
    None for its default. heights: a height distribution, or its name; by default the contact's own, or Gaussian.

    Returns an xarray.Dataset with units and long names: load, contact_area, friction_force, friction_coefficient (not a
    number where the net load is not compressive: there the surfaces hold themselves), mean_separation,
    touching_asperities, their parts by state, body and limit, and pull_off_force. Its attributes name model, options,
    sources, and, under `outside_validity`, what is used beyond the claims of its authors.
    Raises InputError for bad input and for a load that is nowhere carried.
    """
    if (separation is None) == (load is None):
        raise InputError("separation or load", "both" if load is not None else None, "exactly one of the two")
    options = {"reading": reading, "coating_law": coating_law, "branch": branch, "transition": transition}
    problem = make_problem(contact, model, options, heights)
    units = _units(contact)
    given = "load" if separation is None else "mean_separation"
    point = _points(contact, given, load if separation is None else separation)
    dims = _all_dims(problem, [point, *units.values()])
    shape = tuple(dims.values())
    wanted = spread(point, dims) / spread(units[_unit_of(given)], dims)
    extra, convergence = {}, {}
    if given == "load":
        found = _invert(contact, problem, np.broadcast_to(wanted, shape), spread(units["N"], dims))
        wanted = found.h.reshape(shape)
        extra = {"load_residual": (found.residual.reshape(shape), "load found less load asked for, over the latter")}
        convergence = {"convergence": f"all separations converged in at most {found.evaluations} evaluations"}
    elif not np.abs(wanted).max(initial=0.0) <= FARTHEST:
        raise InputError("separation", float(np.abs(wanted).max()), f"{FARTHEST:g} times sigma at most")
    coords = problem.coords | _coords([point, *units.values()])
    data = _labelled(contact, {"mean_separation": wanted} | _sum(problem, wanted, shape), units, dims, coords)
    tension, where = pull_off(problem.on_branch("unloading"))
    dims_of_contact = _all_dims(problem, units.values())
    each = problem.shape + (1,) * (len(dims_of_contact) - len(problem.shape))
    tables = {"pull_off_force": tension.reshape(each), "pull_off_separation": where.reshape(each)}
    data = data.merge(_labelled(contact, tables, units, dims_of_contact, {}))
    if given in getattr(point, "dims", ()):
        data = data.drop_vars(given).assign_coords({given: (given, point.values, data[given].attrs)})
    for name, (values, meaning) in extra.items():
        data[name] = (tuple(dims), values, {"long_name": meaning})
    return data.assign_attrs(_summary(contact, problem, data) | convergence)


def _unit_of(name: str) -> str:
    """Which scale a quantity is measured in: its SI unit, or "count"."""
    return "count" if name == "touching_asperities" else QUANTITIES[name].unit


def _units(contact: Contact | Indices) -> dict[str, Any]:
    """What normalised results are multiplied by, for each SI unit: numbers or arrays with named dimensions."""
    if isinstance(contact, Indices):
        return {"N": 1.0, "m^2": 1.0, "m": 1.0, "count": 1.0}
    scales = contact.scales()
    return {
        "N": scales.load * scales.asperities,
        "m^2": scales.contact_area * scales.asperities,
        "m": scales.separation,
        "count": scales.asperities,
    }


def _points(contact: Contact | Indices, name: str, value: Any) -> Any:
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


def _coords(values: Iterable[Any]) -> dict[str, Any]:
    return {str(name): item.variable for value in values for name, item in getattr(value, "coords", {}).items()}


def _all_dims(problem: Problem, others: Iterable[Any]) -> dict[str, int]:
    """Dimensions of the contacts first, then those that only points and scales have."""
    dims = dict(problem.dims)
    for value in others:
        for dim, size in getattr(value, "sizes", {}).items():
            if dims.setdefault(str(dim), size) != size:
                raise InputError(str(dim), f"lengths {dims[str(dim)]} and {size}", "one length for one dimension")
    return dims


def _invert(contact, problem: Problem, wanted: np.ndarray, unit: np.ndarray) -> Inversion:
    """Separations (laws, points) over sigma where the normalised loads `wanted` (full shape) are carried."""
    targets = wanted.reshape(len(problem.groups), -1)
    try:
        return separations_at(problem, targets)
    except Unreachable as error:
        where = (error.law, error.at)
        scale = np.broadcast_to(unit, wanted.shape).reshape(targets.shape)[where]
        text = (lambda number: show(number * scale, "load")) if isinstance(contact, Contact) else "{:.6g}".format
        beyond = targets[where] > error.high
        bound = f"at most {text(error.high)}" if beyond else f"at least {text(error.low)}"
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
        some = replace(problem, groups=problem.groups[rows])
        if shared:
            sums = some.by_regime_on_grid(common)
        else:
            law = np.repeat(np.arange(len(some.groups)), points)
            sums = some.by_regime(table[rows].reshape(-1), law)
            sums = sums.reshape(len(sums), -1, points, sums.shape[-1])
        parts.append(_by_name(some, sums))
    return {name: np.concatenate([part[name] for part in parts]).reshape(shape) for name in parts[0]}


def _by_name(problem: Problem, sums: np.ndarray) -> dict[str, np.ndarray]:
    """Results (n, m) from the sums (regimes, n, m, 5) by what the regimes are labelled."""
    regimes = problem.regimes
    total = sums.sum(axis=0)
    grip = sums[..., _SLIP] + sums[..., _TEAR]
    results = {
        "load": total[..., _LOAD],
        "contact_area": total[..., _AREA],
        "touching_asperities": sums[[regime.touching for regime in regimes], ..., _COUNT].sum(axis=0),
    }
    for state in ("elastic", "plastic"):
        chosen = [regime.state == state for regime in regimes]
        results[f"load_{state}"] = sums[chosen, ..., _LOAD].sum(axis=0)
        results[f"contact_area_{state}"] = sums[chosen, ..., _AREA].sum(axis=0)
    bodies = ("film", "substrate") if problem.groups.coated else ()
    for body in bodies:
        results[f"load_{body}"] = sums[[regime.body == body for regime in regimes], ..., _LOAD].sum(axis=0)
    if not all(regime.in_half_space for regime in regimes):
        results["load_share_beyond_film"] = _share_beyond(regimes, sums[..., _LOAD])
    if not problem.record.friction:
        return results
    results["friction_force"] = grip.sum(axis=0)
    compressed = results["load"] > 0.0
    ratio = np.divide(results["friction_force"], results["load"], where=compressed, out=np.full(compressed.shape, np.nan))
    results["friction_coefficient"] = ratio
    results["friction_slip_limited"] = total[..., _SLIP]
    results["friction_yield_limited"] = total[..., _TEAR]
    for body in bodies:
        results[f"friction_{body}"] = grip[[regime.body == body for regime in regimes]].sum(axis=0)
    if "load_share_beyond_film" in results:
        results["friction_share_beyond_film"] = _share_beyond(regimes, grip)
    return results


def _share_beyond(regimes: list[Regime], parts: np.ndarray) -> np.ndarray:
    """Share (n, m) of the sizes of `parts` (regimes, n, m) that is beyond the film's half-space; 0 where all is nothing."""
    sizes = np.abs(parts)
    whole = sizes.sum(axis=0)
    beyond = sizes[[not regime.in_half_space for regime in regimes]].sum(axis=0)
    return np.divide(beyond, whole, where=whole > 0.0, out=np.zeros_like(whole))


def _labelled(contact, tables, units, dims, coords) -> "xarray.Dataset":
    """Tables (shape of dims or broadcasting to it), normalised, as a dataset in the units of the contact."""
    import xarray

    data = xarray.Dataset(coords=coords)
    shape = tuple(dims.values())
    for name, table in tables.items():
        scale = spread(units[_unit_of(name)], dims) if _unit_of(name) in units else 1.0
        data[name] = (tuple(dims), np.broadcast_to(table * scale, shape).copy(), _attributes(contact, name))
    return data


def _attributes(contact: Contact | Indices, name: str) -> dict[str, str]:
    quantity = QUANTITIES[name]
    attributes = {"long_name": quantity.meaning, "symbol": quantity.symbol, "units": quantity.unit or "1"}
    if isinstance(contact, Indices) and quantity.normalised_by:
        attributes |= {"units": "1", "normalised_by": quantity.normalised_by}
    return attributes


def _summary(contact: Contact | Indices, problem: Problem, data: "xarray.Dataset") -> dict[str, str]:
    """What was used, where it comes from, and where it goes beyond the claims of its authors."""
    records = problem.records()
    used = dict.fromkeys(source.key for record in records for source in record.sources)
    return {
        "title": f"Static friction after {problem.record.key}",
        "model": problem.record.key,
        **problem.options,
        "film": records[1].key if len(records) > 1 else "none",
        "heights": problem.heights.key,
        "grade": max(record.grade for record in records),
        "sources": " ".join(used),
        "outside_validity": "; ".join(outside_validity(contact, records, data)),
        "friction_law": "included" if problem.record.friction else "none: this model is of contact only",
    }


def outside_validity(contact: Contact | Indices, records: list[Record], data: "xarray.Dataset") -> list[str]:
    """One line for each range of validity that the results leave."""
    lines = []
    for rule in (rule for record in records for rule in record.validity):
        values = _known(contact, data, rule.quantity)
        if values is None or not np.any(outside := (values < rule.low) | (values > rule.high)):
            continue
        ends = dict.fromkeys((f"{values[outside].min():.3g}", f"{values[outside].max():.3g}"))
        where = f"in {outside.sum()} of {outside.size} points" if outside.size > 1 else "here"
        lines.append(
            f"{QUANTITIES[rule.quantity].meaning} is {' to '.join(ends)} {where}, claimed is {rule.range}: {rule.why}"
        )
    return lines


def _known(contact: Contact | Indices, data: "xarray.Dataset", name: str) -> np.ndarray | None:
    """Values of a quantity that a range of validity speaks of, as far as this contact decides it."""
    if name == "mean_separation":
        sigma = contact.scales().separation if isinstance(contact, Contact) else 1.0
        return np.atleast_1d(np.asarray(data["mean_separation"] / sigma))
    if name in data:
        return np.atleast_1d(data[name].values)
    known = contact if hasattr(contact, name) or isinstance(contact, Indices) else contact.indices()
    value = getattr(known, name, None)
    return None if value is None else np.atleast_1d(np.asarray(value() if callable(value) else value, dtype=float))
