"""How much of a friction coefficient is the reading of the surface: the spread over methods that find asperities in a scan."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.laws.validity import Doubt, with_doubts
from stiction.quantities.dimensions import aligned
from stiction.quantities.errors import InputError
from stiction.quantities.units import show

if TYPE_CHECKING:
    import xarray

# What solves a contact at loads [N], one or an array with named dimensions.
Solved = Callable[[Contact, Any], "xarray.Dataset"]
# The dimension of results over methods; `method` itself would be taken for an argument of xarray's `sel`.
METHOD = "asperity_method"
_MU = "friction_coefficient"
# Fewer than this many of the asperities found in a scan: how high they are is then chance.
FEW_TOUCH = 10
_SHORT = {"by_method": "friction, each method", "low": "friction, lowest", "high": "friction, highest"}
_MEANINGS = {
    "by_method": "static friction coefficient by how asperities were found",
    "low": "lowest static friction coefficient over the methods of finding asperities",
    "high": "highest static friction coefficient over the methods of finding asperities",
}


def with_measured(data: "xarray.Dataset", contact: Contact, solved: Solved) -> "xarray.Dataset":
    """A result for a contact whose roughness was measured, with the spread over the methods of finding asperities, and what was
    measured. solved: what solves such a contact at loads."""
    measured = contact.measured
    return as_measured(with_method_spread(data, measured.contacts(contact), measured.counts, solved), measured)


def as_measured(data: "xarray.Dataset", measured: Any) -> "xarray.Dataset":
    """A result with the method that stands for the surface, what was done to the scans, their sources and their doubts."""
    sources = " ".join(dict.fromkeys([*data.attrs["sources"].split(), *measured.sources()]))
    data = with_doubts(data, map(Doubt, measured.doubts)) if measured.doubts else data
    return data.assign_attrs(measured.attributes(), sources=sources)


def _at_loads(contact: Contact, loads: "xarray.DataArray", like: "xarray.DataArray", solved: Solved) -> np.ndarray:
    """(2, *shape): friction coefficient, and share of the asperities that touch, at the loads, of the shape of `like`; not a
    number where the contact does not carry a load or the model does not say. All loads at once; where one is not carried, one
    by one, along sweeps of the contact all of one load."""
    result = np.full((2, *like.shape), np.nan)
    pressed = np.broadcast_to(_over(loads, like) > 0.0, like.shape)
    if not pressed.any():
        return result
    whole = loads.where(loads > 0.0, float(loads.where(loads > 0.0).max()))  # where nothing presses, any load: not read off
    try:
        return np.where(pressed, _read_off(solved(contact, _asked(whole)), contact, like), np.nan)
    except InputError:
        for load in np.unique(whole.values):
            with suppress(InputError):
                found = _read_off(solved(contact, float(load)), contact, like)
                result = np.where(pressed & (_over(loads, like) == load), found, result)
    return result


_ASKED = " asked for"


def _asked(loads: "xarray.DataArray") -> Any:
    """The loads along the same dimensions, which must not be called like results: of these there are others now."""
    if not loads.ndim:
        return float(loads)
    bare = loads.drop_vars(list(loads.coords))
    return bare.rename({name: f"{name}{_ASKED}" for name in bare.dims if name in ("load", "mean_separation")})


def _over(array: "xarray.DataArray", like: "xarray.DataArray") -> np.ndarray:
    """The values of the array, ready to broadcast to the shape of another."""
    dims = {str(name): size for name, size in zip(like.dims, like.shape, strict=True)}
    return aligned(array.rename({name: str(name).removesuffix(_ASKED) for name in array.dims}), dims)


def _read_off(found: "xarray.Dataset", contact: Contact, like: "xarray.DataArray") -> np.ndarray:
    """(2, *shape): what `_at_loads` gives, of a result of `solve`; not a number where the load is not compressive."""
    names = [_MU, *(["touching_asperities"] if "touching_asperities" in found else [])]
    mu, *touching = (np.broadcast_to(_over(found[name], like), like.shape) for name in names)
    asperities = contact.roughness.asperity_density * contact.nominal_area
    every = _over(asperities, like) if hasattr(asperities, "dims") else asperities
    share = touching[0] / every if touching else np.full(like.shape, np.nan)
    return np.where(_over(found["load"], like) > 0.0, [mu, share], np.nan)


def with_method_spread(
    data: "xarray.Dataset", contacts: Mapping[str, Contact], counts: Mapping[str, int], solved: Solved
) -> "xarray.Dataset":
    """The result of `solve` on the first of the contacts, with the friction coefficients of all at the same loads,
    as `solved` finds them.

    contacts: the same bodies with the roughness that each method finds; counts: how many separate asperities it found, 0 where
    it has averages only. Added: friction_coefficient_by_method (asperity_method, points), over the methods
    friction_coefficient_low and friction_coefficient_high, and found_touching_by_method, how many of the asperities found would
    touch: where they are fewer than FEW_TOUCH, friction follows from the tail of the heights that is assumed, which
    `outside_validity` then says, and nothing else than assumed where there are averages only (not a number). As it is where
    there is no friction.
    """
    if _MU not in data:
        return data
    like, loads = data[_MU], data["load"]
    points = like.dims
    first, *others = contacts.values()
    rows = [_read_off(data, first, like), *(_at_loads(contact, loads, like, solved) for contact in others)]
    tables = np.stack(rows, axis=1)
    of_found = np.array([counts[name] or np.nan for name in contacts])
    touching = tables[1] * of_found.reshape(-1, *(1 for _ in like.shape))
    meaning = {"units": "1", "long_name": "found ones that touch", "comment": "how many of the asperities found would touch"}
    result = with_range_over_methods(data, list(contacts), tables[0], points, _MU)
    result = result.assign(found_touching_by_method=((METHOD, *points), touching, meaning))
    return with_doubts(result, map(Doubt, filter(None, [_on_the_tail(result)])))


def _on_the_tail(data: "xarray.Dataset") -> str:
    """By which methods, and up to which load, fewer than FEW_TOUCH of the asperities found touch, or none were found; "" if
    nowhere, or if the model knows of no asperities."""
    if "touching_asperities" not in data:
        return ""
    like = data[_MU]
    loads = np.broadcast_to(_over(data["load"], like), like.shape)
    said = []
    for method in data[METHOD].values:
        touching = data["found_touching_by_method"].sel({METHOD: method}).values
        few = (touching < FEW_TOUCH) & (loads > 0.0)
        if few.any():
            said.append(f"{method} up to {show(loads[few].max(), 'load', 3)}")
        elif np.isnan(touching).all():
            said.append(f"{method} at every load")
    if not said:
        return ""
    return (
        f"contact on fewer than {FEW_TOUCH} of the asperities found ({', '.join(said)}): there mu follows from the tail of the "
        "height distribution that is assumed, not from measured heights"
    )


def with_range_over_methods(
    data: "xarray.Dataset", methods: list[str], each: np.ndarray, points, name: str
) -> "xarray.Dataset":
    """The dataset with what each method says (methods, points), and the ends of it over the methods that say something."""
    ends = {"low": (points, np.fmin.reduce(each)), "high": (points, np.fmax.reduce(each))}
    tables: dict[str, Any] = {"by_method": ((METHOD, *points), each)} | ends
    attributes: dict[str, Any] = {"units": "1", "symbol": "mu"}
    added = {
        f"{name}_{end}": (*table, attributes | {"long_name": _SHORT[end], "comment": _MEANINGS[end]})
        for end, table in tables.items()
    }
    return data.assign_coords({METHOD: methods}).assign(added)


def as_columns(data: "xarray.Dataset") -> "xarray.Dataset":
    """The dataset for a table: a variable NAME_METHOD for each method, in place of NAME_by_method with a dimension more."""
    for name in [str(name) for name in data.data_vars if METHOD in data[name].dims]:
        stem = name.removesuffix("_by_method")
        each = {f"{stem}_{one.item()}": data[name].sel({METHOD: one}).drop_vars(METHOD) for one in data[METHOD]}
        data = data.drop_vars(name).assign(each)
    return data.drop_vars(METHOD, errors="ignore")
