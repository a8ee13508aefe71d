"""How much of a friction coefficient is the reading of the surface: the spread over methods that find asperities in a scan."""

from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.laws.validity import Doubt, with_doubts
from stiction.quantities.errors import InputError
from stiction.quantities.units import show
from stiction.solving.choice import Choice
from stiction.solving.solve import solve

if TYPE_CHECKING:
    import xarray

# The dimension of results over methods; `method` itself would be taken for an argument of xarray's `sel`.
METHOD = "asperity_method"
_MU = "friction_coefficient"
# Fewer than this many of the asperities found in a scan: how high they are is then chance.
FEW_TOUCH = 10
_MEANINGS = {
    "by_method": "static friction coefficient by how asperities were found",
    "low": "lowest static friction coefficient over the methods of finding asperities",
    "high": "highest static friction coefficient over the methods of finding asperities",
}


def _at_loads(contact: Contact, loads: np.ndarray, choice: Choice) -> np.ndarray:
    """(2, n): friction coefficient, and share of the asperities that touch, at the loads (n,) [N]; not a number where the
    contact does not carry a load or the model does not say. All loads at once; where one is not carried, one by one."""
    result = np.full((2, *loads.shape), np.nan)
    pressed = np.flatnonzero(loads > 0.0)
    try:
        result[:, pressed] = _solved(contact, loads[pressed], choice)
    except InputError:
        for at in pressed:
            with suppress(InputError):
                result[:, at : at + 1] = _solved(contact, loads[at : at + 1], choice)
    return result


def _solved(contact: Contact, loads: np.ndarray, choice: Choice) -> np.ndarray:
    if not loads.size:
        return np.zeros((2, 0))
    return _read_off(solve(contact, load=loads, **choice.arguments()), contact)


def _read_off(found: "xarray.Dataset", contact: Contact) -> np.ndarray:
    """(2, n): what `_at_loads` gives, of a result of `solve`; not a number where the load is not compressive."""
    mu = np.atleast_1d(found[_MU].values)
    known = "touching_asperities" in found
    touching = np.atleast_1d(found["touching_asperities"].values) if known else np.full(mu.shape, np.nan)
    share = touching / (contact.roughness.asperity_density * contact.nominal_area)
    return np.where(np.atleast_1d(found["load"].values) > 0.0, [mu, share], np.nan)


def with_method_spread(
    data: "xarray.Dataset", contacts: Mapping[str, Contact], counts: Mapping[str, int], choice: Choice
) -> "xarray.Dataset":
    """The result of `solve` on the first of the contacts, with the friction coefficients of all at the same loads.

    contacts: the same bodies with the roughness that each method finds; counts: how many separate asperities it found, 0 where
    it has averages only. Added: friction_coefficient_by_method (asperity_method, points), over the methods
    friction_coefficient_low and friction_coefficient_high, and found_touching_by_method, how many of the asperities found would
    touch: where they are fewer than FEW_TOUCH, friction follows from the tail of the heights that is assumed, which
    `outside_validity` then says, and nothing else than assumed where there are averages only (not a number). As it is where
    there is no friction.
    """
    if _MU not in data:
        return data
    points, shape = data["load"].dims, (len(contacts), *data["load"].shape)
    loads = np.atleast_1d(data["load"].values)
    first, *others = contacts.values()
    tables = np.stack([_read_off(data, first), *(_at_loads(contact, loads, choice) for contact in others)], axis=1)
    of_found = np.array([[counts[name] or np.nan] for name in contacts])
    touching = (tables[1] * of_found).reshape(shape)
    meaning = {"units": "1", "long_name": "how many of the asperities found would touch"}
    result = with_range_over_methods(data, list(contacts), tables[0].reshape(shape), points, _MU)
    result = result.assign(found_touching_by_method=((METHOD, *points), touching, meaning))
    return with_doubts(result, map(Doubt, filter(None, [_on_the_tail(result)])))


def _on_the_tail(data: "xarray.Dataset") -> str:
    """By which methods, and up to which load, fewer than FEW_TOUCH of the asperities found touch, or none were found; "" if
    nowhere, or if the model knows of no asperities."""
    if "touching_asperities" not in data:
        return ""
    loads = np.atleast_1d(data["load"].values)
    said = []
    for method in data[METHOD].values:
        touching = np.atleast_1d(data["found_touching_by_method"].sel({METHOD: method}).values)
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
    added = {f"{name}_{end}": (*table, attributes | {"long_name": _MEANINGS[end]}) for end, table in tables.items()}
    return data.assign_coords({METHOD: methods}).assign(added)


def as_columns(data: "xarray.Dataset") -> "xarray.Dataset":
    """The dataset for a table: a variable NAME_METHOD for each method, in place of NAME_by_method with a dimension more."""
    for name in [str(name) for name in data.data_vars if METHOD in data[name].dims]:
        stem = name.removesuffix("_by_method")
        each = {f"{stem}_{one.item()}": data[name].sel({METHOD: one}).drop_vars(METHOD) for one in data[METHOD]}
        data = data.drop_vars(name).assign(each)
    return data.drop_vars(METHOD, errors="ignore")
