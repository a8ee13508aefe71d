"""Compute how much the friction coefficient depends on the method of finding asperities in a scan."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.engine.heights import Heights
from stiction.laws.validity import with_warnings
from stiction.quantities.dimensions import aligned
from stiction.quantities.errors import InputError
from stiction.quantities.quotient import quotient
from stiction.quantities.shown import show
from stiction.records.validity_warning import ValidityWarning
from stiction.solving.choice import Choice
from stiction.solving.pointwise import solve_batch

if TYPE_CHECKING:
    import xarray

# The dimension of results over methods. It cannot be called `method`, which is an argument of xarray's `sel`.
METHOD = "asperity_method"
_MU = "friction_coefficient"
# Least number of asperities of a scan that must touch; the heights of fewer asperities are a matter of chance.
FEW_TOUCH = 10
_MEANINGS = {
    "by_method": ("friction, each method", "static friction coefficient, for each method of finding asperities"),
    "low": ("friction, lowest", "lowest static friction coefficient over the methods of finding asperities"),
    "high": ("friction, highest", "highest static friction coefficient over the methods of finding asperities"),
}


def as_measured(data: "xarray.Dataset", measured: Any) -> "xarray.Dataset":
    """Return a result of `solve` with attributes that describe the scans: asperity method, history, sources and warnings.

    measured: roughness that was measured on scans.
    """
    sources = " ".join(dict.fromkeys([*data.attrs["sources"].split(), *measured.sources()]))
    data = with_warnings(data, map(ValidityWarning, measured.validity_warnings)) if measured.validity_warnings else data
    return data.assign_attrs(measured.attributes(), sources=sources)


def _at_loads(contact: Contact, like: "xarray.Dataset", choice: Choice, heights: Heights | str | None) -> np.ndarray:
    """Solve the contact at the loads of a result; return friction coefficient and touching fraction as one array.

    like: the result of `solve`; the array is (2, *shape of its friction coefficient). The values are NaN where a load cannot be
    carried or the model does not accept the contact.
    """
    import xarray

    loads, keep = like["load"].drop_vars(list(like["load"].coords)), (_MU, "load", "touching_asperities")
    try:
        batch = solve_batch(contact, choice, load=loads, keep=keep, heights=heights)
    except InputError:
        return np.full((2, *like[_MU].shape), np.nan)
    tables = {name: xarray.DataArray(values, dims=dims) for name, (dims, values, _) in batch.variables.items()}
    return _read_off(tables, contact, like[_MU])


def _over(array: Any, like: "xarray.DataArray") -> np.ndarray:
    """Return the values of a labelled array, broadcast to the shape of `like`."""
    return np.broadcast_to(aligned(array, {str(dim): size for dim, size in like.sizes.items()}), like.shape)


def _read_off(results: Mapping, contact: Contact, like: "xarray.DataArray") -> np.ndarray:
    """Return friction coefficient and fraction of touching asperities as one array (2, *shape of `like`).

    results: arrays by name. The values are NaN where the load is not compressive, and for results that the model does not
    compute.
    """
    asperities = contact.roughness.asperity_density * contact.nominal_area
    touching = _over(results["touching_asperities"], like) if "touching_asperities" in results else np.nan
    share = np.broadcast_to(quotient(touching, _over(asperities, like)), like.shape)
    return np.where(_over(results["load"], like) > 0.0, [_over(results[_MU], like), share], np.nan)


def with_method_spread(
    data: "xarray.Dataset",
    contacts: Mapping[str, Contact],
    counts: Mapping[str, int],
    choice: Choice,
    heights: Heights | str | None = None,
) -> "xarray.Dataset":
    """Add the friction coefficients of all asperity methods to a result of `solve`, and return it.

    contacts: contacts with the roughness from each method, by the name of the method. counts: number of asperities that each
    method found, 0 for methods that compute averages without finding single asperities. Adds friction_coefficient_by_method
    (asperity_method, points), its range over the methods as friction_coefficient_low and friction_coefficient_high, and
    found_touching_by_method, the number of found asperities that touch (NaN for averages). If a method finds fewer than ten
    that touch, or no single asperities, friction depends on the assumed tail of the height distribution, and the result has a
    validity warning. A result without friction is returned unchanged.
    """
    if _MU not in data:
        return data
    like = data[_MU]
    points = like.dims
    first, *others = contacts.values()
    rows = [_read_off(data, first, like), *(_at_loads(contact, data, choice, heights) for contact in others)]
    tables = np.stack(rows, axis=1)
    of_found = np.array([counts[name] or np.nan for name in contacts])
    touching = tables[1] * of_found.reshape(-1, *(1 for _ in like.shape))
    meaning = {"units": "1", "long_name": "detected asperities that touch"}
    result = with_range_over_methods(data, list(contacts), tables[0], points, _MU)
    result = result.assign(found_touching_by_method=((METHOD, *points), touching, meaning))
    return with_warnings(result, map(ValidityWarning, filter(None, [_on_the_tail(result)])))


def _on_the_tail(data: "xarray.Dataset") -> str:
    """Return a warning text that lists the methods and loads at which fewer than ten of the found asperities touch.

    Methods that find no single asperities, or whose contact could not be solved, are listed at every load. The text is "" if no
    method is listed, or if the model has no asperities.
    """
    if "touching_asperities" not in data:
        return ""
    loads = _over(data["load"], data[_MU])
    texts = []
    for method in data[METHOD].values:
        touching = data["found_touching_by_method"].sel({METHOD: method}).values
        few = (touching < FEW_TOUCH) & (loads > 0.0)
        if few.any():
            texts.append(f"{method} up to {show(loads[few].max(), 'load', 3)}")
        elif np.isnan(touching).all():
            texts.append(f"{method} at every load")
    if not texts:
        return ""
    return (
        f"fewer than {FEW_TOUCH} of the detected asperities touch ({', '.join(texts)}): mu then follows from the assumed tail "
        "of the height distribution, not from measured heights"
    )


def with_range_over_methods(
    data: "xarray.Dataset", methods: list[str], each: np.ndarray, points, name: str
) -> "xarray.Dataset":
    """Add a quantity by asperity method, and its lowest and highest value, to a dataset; return the dataset.

    methods: names of the methods. each: values (methods, points). points: names of the other dimensions. name: name of the
    quantity; the three new variables are name_by_method, name_low and name_high.
    """
    tables = ((METHOD, *points), each), (points, np.fmin.reduce(each)), (points, np.fmax.reduce(each))
    added = {
        f"{name}_{end}": (*table, {"units": "1", "symbol": "mu", "long_name": short, "comment": meaning})
        for (end, (short, meaning)), table in zip(_MEANINGS.items(), tables, strict=True)
    }
    return data.assign_coords({METHOD: methods}).assign(added)
