"""Build the terminal table of a parameter sweep: a row for each combination of parameters, mu at some of the loads."""

import math
from itertools import product
from typing import TYPE_CHECKING

from stiction.quantities.sampling import spread_rows
from stiction.quantities.table import QUANTITIES
from stiction.report.answer import span
from stiction.report.table import Table, numbers, shown, with_unit

if TYPE_CHECKING:
    import xarray

_ROWS, _POINTS = 9, 4
# Names of the dimension of loads or separations.
_POINT_NAMES = ("load", "mean_separation", "separation")
_HEADS = {"friction_coefficient": "mu", "contact_area": "area"}


def shown_quantity(data: "xarray.Dataset") -> str:
    """Return the name of the result to show: friction coefficient, or contact area for a model without friction."""
    return "friction_coefficient" if "friction_coefficient" in data else "contact_area"


def points_dimension(data: "xarray.Dataset") -> str | None:
    """Return the dimension of the loads or separations; None if there is a single point."""
    return next((name for name in _POINT_NAMES if name in data.dims), None)


def varied(data: "xarray.Dataset") -> list[str]:
    """Return the dimensions of a result that belong to array parameters, in order."""
    return [str(dim) for dim in data[shown_quantity(data)].dims if dim not in _POINT_NAMES]


def coordinates_along(data: "xarray.Dataset", dim: str) -> list[str]:
    """Return the names of the quantities that vary along a dimension of a result."""
    return [str(name) for name, coordinate in data.coords.items() if coordinate.dims == (dim,)]


def of_value(data: "xarray.Dataset", name: str, index: int) -> str:
    """Format the value at an index of a varied quantity with its unit: "200 nm"."""
    quantity = name.rpartition(".")[2]
    value = data[name].values[index]
    return shown(float(value), quantity) if quantity in QUANTITIES else f"{value:g}"


def of_point(data: "xarray.Dataset", index: int) -> str:
    """Format the load or separation at an index with its symbol: "P = 1 N", "d/sigma = 2"."""
    dim = points_dimension(data)
    if dim is None:
        return "at the point"
    variable, value = data[dim], float(data[dim].values[index])
    symbol = variable.attrs.get("symbol", dim)
    return f"{symbol} = {with_unit(variable, value)}"


def _head(name: str) -> str:
    """Return a two-line column head for a varied quantity: "second" above "H" for "second.hardness"."""
    part, _, quantity = name.rpartition(".")
    symbol = QUANTITIES[quantity].symbol if quantity in QUANTITIES else quantity
    return f"{part.replace('.', ' ')}\n{symbol}".strip()


def combinations_shown(data: "xarray.Dataset", option: str) -> str:
    """State how many combinations `swept_table` shows, and at how many loads or separations; "" if it shows all.

    option: option of the command that shows all combinations.
    """
    dims, points = varied(data), points_dimension(data)
    sizes = [data.sizes[dim] for dim in dims]
    parts = [
        (math.prod(min(size, _most(dims)) for size in sizes), math.prod(sizes), "combinations"),
        (len(_columns(data)), data.sizes[points] if points else 1, "loads" if points == "load" else "separations"),
    ]
    few = " and ".join(f"{count} of {size} {name}" for count, size, name in parts if count < size)
    return f"{few} are shown; {option} shows all combinations, and --out writes all to curve.csv" if few else ""


def _most(dims: list[str]) -> int:
    """Return the largest number of values that `swept_table` shows by default along each of the dimensions `dims`."""
    return max(2, int(_ROWS ** (1.0 / len(dims)) + 1e-9))


def _columns(data: "xarray.Dataset") -> list[int]:
    """Return the indices of the loads or separations for which `swept_table` has columns; [0] for a single point."""
    points = points_dimension(data)
    most = 2 if f"{shown_quantity(data)}_low" in data else _POINTS
    return spread_rows(data.sizes[points], most).tolist() if points else [0]


def swept_table(data: "xarray.Dataset", all_rows: bool = False) -> Table:
    """Return a table with a row for each of some combinations of array parameters, and mu at a few loads or separations.

    At most four loads or separations have a column, or two if mu has an interval. all_rows: whether to show every combination
    instead of about nine.
    """
    name, dims, points = shown_quantity(data), varied(data), points_dimension(data)
    intervals = f"{name}_low" in data
    columns, most = _columns(data), data[name].size if all_rows else _most(dims)
    heads = [_head(coordinate) for dim in dims for coordinate in coordinates_along(data, dim)]
    heads += [f"{_HEADS[name]} at\n{of_point(data, column)}" for column in columns]
    results = data[[name, f"{name}_low", f"{name}_high"] if intervals else [name]]
    rows = []
    for indices in product(*(spread_rows(data.sizes[dim], most).tolist() for dim in dims)):
        place = dict(zip(dims, indices, strict=True))
        cells = [of_value(data, name, index) for dim, index in place.items() for name in coordinates_along(data, dim)]
        for column in columns:
            cell = results.isel(place | ({points: column} if points else {}))
            text = shown(float(cell[name]), name, 2 if intervals else 4)
            has_interval = intervals and math.isfinite(cell[name])
            cells.append(f"{text} ({span(cell, name)})" if has_interval else text)
        rows.append(cells)
    return Table(numbers(*heads), rows)
