"""Align and broadcast arrays with named dimensions, and attach their coordinates to results.

An array input is an xarray.DataArray with named dimensions and without indexes (`without_indexes`). xarray then matches arrays
by the names of their dimensions alone, and never drops or sorts values. `coordinates` checks once, for all inputs together,
that the arrays agree.
"""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.quantities.errors import InputError, InWords

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike


def without_indexes(array: Any) -> Any:
    """Return the DataArray with its coordinates kept as plain variables, because xarray aligns arrays that have an index."""
    indexes = getattr(array, "xindexes", ())  # a Variable has none
    return array.drop_indexes(list(indexes)) if indexes else array


def check_names(array: Any, field: str) -> None:
    """Raise an InputError unless all dimension names of a DataArray are text."""
    for dim in array.dims:
        if not isinstance(dim, str):
            raise InputError(field, InWords(f"dimension {dim!r}"), "dimension names that are text")


def dimensions(values: Iterable[Any], first: Mapping[str, int] = MappingProxyType({})) -> dict[str, int]:
    """Return the length of every dimension of the values, by name, in the order of first appearance.

    first: dimensions that come first, with their lengths. Raises InputError if two values disagree about a length.
    """
    dims = dict(first)
    for value in values:
        for dim, size in getattr(value, "sizes", {}).items():
            if dims.setdefault(str(dim), size) != size:
                raise InputError(
                    str(dim),
                    InWords(f"lengths {dims[str(dim)]} and {size}"),
                    "the same length in all arrays with this dimension",
                )
    return dims


def aligned(value: Any, dims: Mapping[str, int]) -> np.ndarray:
    """Return the value as an array with its dimensions in the order of `dims`; missing dimensions get length 1."""
    if not hasattr(value, "dims"):
        return np.asarray(value, dtype=float)
    return arranged(value.values, value.dims, dims)


def arranged(values: np.ndarray, have: Sequence[Hashable], wanted: Iterable[str]) -> np.ndarray:
    """Transpose an array from the dimensions `have` to the dimensions `wanted`; missing dimensions get length 1."""
    wanted, sizes = [*wanted], dict(zip(have, values.shape, strict=True))
    return values.transpose([have.index(dim) for dim in wanted if dim in sizes]).reshape([sizes.get(dim, 1) for dim in wanted])


def in_columns(data: "xarray.Dataset", dim: str, part: str, text_of: Callable[[Any], str] = str) -> "xarray.Dataset":
    """Return a dataset in which every point along the dimension `dim` has become a variable of its own.

    With dim = part = "quantile", the variable mu_quantile becomes the variables mu_q05 and mu_q95: `part` in its name is
    replaced. text_of: function that returns the text for one point, such as "q05".
    """
    for name in [str(name) for name in data.data_vars if dim in data[name].dims]:
        each = {name.replace(part, text_of(point.item())): data[name].sel({dim: point}).drop_vars(dim) for point in data[dim]}
        data = data.drop_vars(name).assign(each)
    return data.drop_vars(dim, errors="ignore")


def flattened(values: Mapping[str, Any]) -> tuple[dict[str, np.ndarray | None], dict[str, int]]:
    """Return values with named dimensions as flat arrays (n,) over all n combinations, and the length of each dimension.

    A value of None stays None.
    """
    dims = dimensions(values.values())
    shape = tuple(dims.values())
    flat = {
        name: None if value is None else np.broadcast_to(aligned(value, dims), shape).reshape(-1).astype(float)
        for name, value in values.items()
    }
    return flat, dims


def coordinates(arrays: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    """Return the coordinates along all dimensions of the arrays, as name -> xarray.Variable.

    arrays: pairs of the dotted name of an input and its DataArray. An array from `stiction.axis` is its own coordinate: its
    values label the points of its dimension. If several such arrays share a dimension with another name, they vary together,
    and each becomes a coordinate under its own name. Raises InputError if two arrays disagree about a dimension.
    """
    by_name: dict[str, Any] = {}
    own: dict[str, list[tuple[str, Any]]] = {}
    first: dict[str, str] = {}
    arrays = list(arrays)
    for name, array in arrays:
        for coordinate, values in getattr(array, "coords", {}).items():  # a Variable has none
            dim = str(coordinate)
            if _is_its_own(array, dim) and dim != name.rpartition(".")[2]:
                own.setdefault(dim, []).append((name, values.variable))
            elif dim in array.dims and dim in by_name and not np.array_equal(by_name[dim].values, values.values):
                raise _disagreement(name, dim, values.size, first[dim])
            else:
                by_name.setdefault(dim, values.variable)
                first.setdefault(dim, name)
        for dim, size in array.sizes.items():
            known = next((other for other in arrays if other[1].sizes.get(dim, size) != size), None)
            if known:
                raise _disagreement(known[0], str(dim), known[1].sizes[dim], name)
    for dim, several in own.items():
        other = first.get(dim, "")
        if other.rpartition(".")[2] == dim and not np.array_equal(several[0][1].values, by_name[dim].values):
            raise _disagreement(several[0][0], dim, several[0][1].size, other)  # the dimension is that quantity's own
        by_name |= _own_coordinates(dim, several, dim in by_name)
    return by_name


# xarray imports dask, pint and others to see whether an array belongs to them, which takes half of the time of a first result.
# It does not ask with `fastpath`, nor of an index of pandas.
def variable(dims: Sequence[str], values: "ArrayLike", attributes: Mapping[str, Any] | None = None) -> "xarray.Variable":
    """Return an array with named dimensions and attributes as an xarray.Variable."""
    import xarray

    return xarray.Variable(dims, np.asarray(values), attributes, fastpath=True)


def coordinate(dim: str, values: np.ndarray, attributes: Mapping[str, Any] | None = None) -> "xarray.Variable":
    """Return the coordinate values along one dimension as an xarray.Variable."""
    import pandas
    import xarray

    return xarray.Variable((dim,), pandas.Index(values), attributes)


def labelled(value: Any, names: Mapping[str, Any]) -> Any:
    """Return an xarray.Variable as a DataArray with those coordinates (name -> Variable) that lie along its dimensions.

    A number is returned unchanged.
    """
    if not hasattr(value, "dims"):
        return value
    import xarray

    along = {name: coordinate for name, coordinate in names.items() if set(coordinate.dims) <= set(value.dims)}
    return xarray.DataArray(value, coords=xarray.Coordinates(along, indexes={}))


def _is_its_own(array: Any, dim: str) -> bool:
    return array.dims == (dim,) and np.array_equal(array.values, array.coords[dim].values)


def _own_coordinates(dim: str, several: list[tuple[str, Any]], named: bool) -> dict[str, Any]:
    """Return the coordinates of several arrays that vary together along the dimension `dim`.

    If all arrays are equal and the dimension has no coordinate yet (`named` is False), there is one coordinate, named after
    the dimension. Otherwise each array becomes a coordinate under its own name.
    """
    values = [variable.values for _, variable in several]
    if not named and all(np.array_equal(array, values[0]) for array in values):
        return {dim: several[0][1]}
    short = [name.rpartition(".")[2] for name, _ in several]
    return {(last if short.count(last) == 1 else name): variable for last, (name, variable) in zip(short, several, strict=True)}


def _disagreement(name: str, dim: str, size: int, other: str) -> InputError:
    return InputError(
        name,
        InWords(f"dimension {dim!r} of length {size}"),
        f"the length and the coordinate that {other} has along {dim!r}, or another name for this dimension",
    )
