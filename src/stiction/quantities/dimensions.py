"""Make, align and broadcast arrays with named dimensions, and attach coordinates to results.

An array input is an xarray.DataArray with named dimensions. `units.to_si` removes its indexes, so that xarray matches arrays by
the names of their dimensions alone, and never drops or sorts values. `coordinates` checks for all inputs together that arrays
with the same dimension agree on its length and its coordinate values.
"""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.quantities.errors import InputError, InWords, nearest
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike

    from stiction.quantities.arguments import QuantityLike


def dimensions(values: Iterable[Any], first: Mapping[str, int] = MappingProxyType({})) -> dict[str, int]:
    """Return dimension name -> length for all dimensions of some arrays, in the order of first appearance.

    values: xarray arrays; values without dimensions (numbers, None) are ignored. first: dimensions, with lengths, that come
    first in the result. Raises InputError if two arrays have different lengths along one dimension.
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
    """Return a number or xarray array as a NumPy array whose axes are the dimensions `dims`, in this order.

    dims: name -> length. A dimension that the value does not have becomes an axis of length 1; a number has no axes.
    """
    if not hasattr(value, "dims"):
        return np.asarray(value, dtype=float)
    return arranged(value.values, value.dims, dims)


def arranged(values: np.ndarray, have: Sequence[Hashable], wanted: Iterable[str]) -> np.ndarray:
    """Return a NumPy array with its axes in another order.

    values: array. have: names of its axes. wanted: names of the axes of the result, in order; an axis that `values` does not
    have gets length 1.
    """
    wanted, sizes = [*wanted], dict(zip(have, values.shape, strict=True))
    return values.transpose([have.index(dim) for dim in wanted if dim in sizes]).reshape([sizes.get(dim, 1) for dim in wanted])


def in_columns(data: "xarray.Dataset", dim: str, part: str, text_of: Callable[[Any], str] = str) -> "xarray.Dataset":
    """Return a dataset in which each point along the dimension `dim` is a separate variable without this dimension.

    - part: part of the variable name that is replaced by the text for the point
    - text_of: function that returns the text for a coordinate value along `dim`

    Example with dim = part = "quantile": the variable mu_quantile becomes the variables mu_q05 and mu_q95, if text_of returns
    "q05" and "q95".
    """
    for name in [str(name) for name in data.data_vars if dim in data[name].dims]:
        each = {name.replace(part, text_of(point.item())): data[name].sel({dim: point}).drop_vars(dim) for point in data[dim]}
        data = data.drop_vars(name).assign(each)
    return data.drop_vars(dim, errors="ignore")


def flattened(values: Mapping[str, Any]) -> tuple[dict[str, np.ndarray | None], dict[str, int]]:
    """Return numbers and arrays as flat arrays for all combinations of their dimensions, and dimension name -> length.

    values: name -> number, xarray array or None. The first result maps each name to an array (n,) of floats, or to None for
    None; n is the product of all lengths.
    """
    dims = dimensions(values.values())
    shape = tuple(dims.values())
    flat = {
        name: None if value is None else np.broadcast_to(aligned(value, dims), shape).reshape(-1).astype(float)
        for name, value in values.items()
    }
    return flat, dims


def coordinates(arrays: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    """Return the coordinates along all dimensions of some input arrays, as name -> xarray.Variable.

    arrays: pairs (dotted name of the input, xarray.DataArray). An array made by `stiction.axis` is itself the coordinate of its
    dimension. If two or more of these arrays, with different values, share a dimension, each becomes a coordinate named after
    its own input. Raises InputError if two arrays differ in the length of a dimension or in its coordinate.
    """
    by_name: dict[str, Any] = {}
    own: dict[str, list[tuple[str, Any]]] = {}
    first: dict[str, str] = {}
    arrays = list(arrays)
    for name, array in arrays:
        for coordinate, values in getattr(array, "coords", {}).items():  # an xarray.Variable has no coordinates
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
            raise _disagreement(several[0][0], dim, several[0][1].size, other)  # the dimension is named after `other`
        by_name |= _own_coordinates(dim, several, dim in by_name)
    return by_name


# xarray imports dask, pint and others to see whether an array belongs to them, which takes half of the time of a first result.
# It skips this test with `fastpath`, and for a pandas index.
def variable(dims: Sequence[str], values: "ArrayLike", attributes: Mapping[str, Any] | None = None) -> "xarray.Variable":
    """Return an array with named dimensions and attributes as an xarray.Variable.

    dims: name of each axis. values: array or number. attributes: name -> value, such as units and long_name.
    """
    import xarray

    return xarray.Variable(dims, np.asarray(values), attributes, fastpath=True)


def coordinate(dim: str, values: np.ndarray, attributes: Mapping[str, Any] | None = None) -> "xarray.Variable":
    """Return the values along one dimension, with attributes, as an xarray.Variable that can be used as a coordinate.

    dim: name of the dimension. values: array (n,). attributes: name -> value, such as units and long_name.
    """
    import pandas
    import xarray

    return xarray.Variable((dim,), pandas.Index(values), attributes)


def axis(name: str, values: "QuantityLike | None" = None, dimension: str | None = None) -> "xarray.DataArray":
    """Return values of a quantity along a named dimension.

    Parameters
    ----------
    name : str
        Name of a quantity, e.g. "load" or "thickness".
    values : array_like (n,) [SI], or sequence of str with units
        Values along the dimension.
    dimension : str, optional
        Name of the dimension; by default the name of the quantity. Needed if the same quantity varies for both bodies.

    Returns
    -------
    xarray.DataArray
        Values (n,) in SI units, which are also their own coordinate. Use it in place of any number of a Contact or Indices.

    Raises
    ------
    InputError
        The name is unknown, or a value has a wrong unit or is out of bounds.

    Examples
    --------
    >>> import stiction as st
    >>> st.axis("load", ["1 mN", "2 mN"]).values
    array([0.001, 0.002])
    """
    import xarray

    if not isinstance(name, str) or name not in QUANTITIES:
        first = 'first the name of a quantity, then its values, e.g. axis("load", ["1 N", "2 N"])'
        raise InputError("axis", name, f"{first}: {nearest(name, QUANTITIES)}")
    quantity, numbers = QUANTITIES[name], values_along(name, values)
    if dimension is not None and not isinstance(dimension, str):
        raise InputError("dimension", dimension, "a name, as text")
    dimension = dimension or name
    attributes = {name: text for name, text in quantity.attributes.items() if name != "symbol"}
    along = {dimension: coordinate(dimension, numbers, attributes)}
    return xarray.DataArray(variable((dimension,), numbers, attributes), coords=along, name=name)


def values_along(name: str, values: "QuantityLike | None") -> np.ndarray:
    """Return values of a quantity as an array (n,) in SI units.

    name: key of the quantity in QUANTITIES. values: one number or a one-dimensional sequence, in SI units or with units. Raises
    InputError for None, for more than one dimension, and as `to_si` does.
    """
    if values is None:
        raise InputError(name, None, f"its values along the axis, {QUANTITIES[name].wanted}")
    numbers = np.atleast_1d(np.asarray(to_si(values, name)))
    if numbers.ndim != 1:
        raise InputError(name, InWords(f"array of shape {numbers.shape}"), "a list of values, or an array with one dimension")
    return numbers


def from_series(series, name: str):
    """Return a pandas.Series with values of a quantity as an xarray.DataArray in SI units with one named dimension.

    name: key of the quantity in QUANTITIES. The index of the series becomes the coordinate, and the name of the index the name
    of the dimension. If the index has no name, the values are their own coordinate, as in `axis`. Raises InputError as `to_si`
    does.
    """
    import xarray

    along = series.index.name
    if along is None:
        return axis(name, series)
    numbers = values_along(name, series)
    return xarray.DataArray(numbers, dims=(str(along),), coords={str(along): series.index.to_numpy()}, name=name)


def labelled(value: Any, names: Mapping[str, Any]) -> Any:
    """Return an xarray.Variable as a DataArray with coordinates; return a number unchanged.

    names: coordinate name -> xarray.Variable. Only coordinates whose dimensions are all among those of `value` are added.
    """
    if not hasattr(value, "dims"):
        return value
    import xarray

    along = {name: coordinate for name, coordinate in names.items() if set(coordinate.dims) <= set(value.dims)}
    return xarray.DataArray(value, coords=xarray.Coordinates(along, indexes={}))


def _is_its_own(array: Any, dim: str) -> bool:
    return array.dims == (dim,) and np.array_equal(array.values, array.coords[dim].values)


def _own_coordinates(dim: str, several: list[tuple[str, Any]], named: bool) -> dict[str, Any]:
    """Return name -> coordinate for input arrays that vary together along one dimension.

    - dim: name of the dimension
    - several: pairs (dotted name of the input, xarray.Variable with its values)
    - named: whether the dimension already has a coordinate with its name

    If `named` is False and all arrays are equal, the only coordinate is named after the dimension. Otherwise each array becomes
    a coordinate with the last part of its dotted name, or the full name where two inputs have the same last part.
    """
    values = [variable.values for _, variable in several]
    if not named and all(np.array_equal(array, values[0]) for array in values):
        return {dim: several[0][1]}
    short = [name.rpartition(".")[2] for name, _ in several]
    return {(last if short.count(last) == 1 else name): variable for last, (name, variable) in zip(short, several, strict=True)}


def _disagreement(name: str, dim: str, size: int, other: str) -> InputError:
    return InputError(
        name,
        InWords(f"length {size} along dimension {dim!r}"),
        f"the length and coordinate of {other}, which has the same dimension; to combine every {name} with every {other}, "
        f"rename this dimension of {name}",
    )
