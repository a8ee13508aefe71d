"""Pictures of a case whose numbers are several: curves over one quantity, heat maps over two, small multiples over more."""

from itertools import product
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure

from stiction.report.pictures import NOT_PRESSED, WIDE, canvas, entitle, finish, label, say, scale_friction
from stiction.report.several_tables import (
    coordinates_along,
    of_point,
    of_value,
    points_dimension,
    shown_quantity,
    varied,
)
from stiction.report.table import prefix, some

if TYPE_CHECKING:
    import xarray

_LINES, _MAPS, _MULTIPLES = 6, 6, 3
_DECADE = 9.0  # an axis whose values span more than this is logarithmic if they are spaced so


def several_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """The friction coefficient (of a model without friction the contact area) against what varies, at some of the points."""
    dims = varied(data)
    figure = _curves(data, dims[0]) if len(dims) == 1 else _maps(data, dims)
    entitle(figure, data, title)
    return figure


def _points(data: "xarray.Dataset") -> int:
    dim = points_dimension(data)
    return data.sizes[dim] if dim else 1


def _at_point(data: "xarray.Dataset", at: int) -> "xarray.DataArray":
    dim = points_dimension(data)
    one = data[shown_quantity(data)]
    return one.isel({dim: at}) if dim else one


def _curves(data: "xarray.Dataset", dim: str) -> Figure:
    """Against the quantity, a line for each of some points; and against the points, a line for each of some values."""
    points = points_dimension(data)
    over_points = points is not None and data.sizes[points] > 1
    figure, panels = canvas(11.0 if over_points else 6.5, 4.8, 1, 2 if over_points else 1)
    along = coordinates_along(data, dim)
    numbers = some(_points(data), _LINES)
    lines = [(of_point(data, at), _at_point(data, at).values) for at in numbers]
    _lines(panels[0], _x_values(data, dim), lines, len(numbers))
    panels[0].set_xlabel(_axis_label(data, dim))
    if over_points:
        chosen = some(data.sizes[dim], _LINES)
        lines = [
            (", ".join(of_value(data, name, at) for name in along), data[shown_quantity(data)].isel({dim: at}).values)
            for at in chosen
        ]
        _lines(panels[1], data[points].values, lines, len(chosen))
        panels[1].set_xlabel(label(data[points]))
        if panels[1].lines:
            panels[1].legend(title=", ".join(along), fontsize=8, framealpha=0.9)
    for axes in panels:
        axes.set_ylabel(label(data[shown_quantity(data)], longest=42))
    return figure


def _lines(axes: Axes, x: np.ndarray, lines: list[tuple[str, np.ndarray]], count: int) -> None:
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.9, max(count, 2)))
    seen = []
    for (text, y), colour in zip(lines, colours, strict=False):
        drawn = np.isfinite(y) & (y > 0.0)
        if not drawn.any():
            continue
        axes.plot(x[drawn], y[drawn], color=colour, marker="o" if x.size <= 30 else "", markersize=3.5, label=text)
        seen.append(y[drawn])
    if not seen:
        say(axes, NOT_PRESSED)
        return
    scale_friction(axes, np.concatenate(seen))
    if _is_log(x):
        axes.set_xscale("log")
    finish(axes)


def _maps(data: "xarray.Dataset", dims: list[str]) -> Figure:
    """Heat maps over the two dimensions with most values. Of two one at each of some points; of more at the middle point, a row
    and a column of them for some values of the next two; of what varies beside these, the middle."""
    places: list[tuple[dict[str, int], int]] = [({}, int(at)) for at in some(_points(data), _MAPS)]
    columns = min(len(places), 3)
    if len(dims) > 2:
        dims = sorted(dims, key=lambda dim: -data.sizes[dim])
        fixed = {dim: (data.sizes[dim] - 1) // 2 for dim in dims[4:]}
        outer = {dim: some(data.sizes[dim], _MULTIPLES) for dim in reversed(dims[2:4])}
        middle = (_points(data) - 1) // 2
        places = [(fixed | dict(zip(outer, map(int, at), strict=True)), middle) for at in product(*outer.values())]
        columns = len(outer[dims[2]])
    rows = -(-len(places) // columns)
    figure, panels = canvas(4.0 * columns + 1.6, 3.6 * rows + 0.9, rows, columns)
    for axes in panels[len(places) :]:
        axes.set_axis_off()
    panels = panels[: len(places)]
    up, across = dims[:2]
    tables = [_at_point(data, point).isel(at).transpose(up, across).values for at, point in places]
    seen = np.concatenate([table[np.isfinite(table) & (table > 0.0)] for table in tables])
    if not seen.size:
        for axes in panels:
            say(axes, "not defined here")
        return figure
    wide = seen.max() > WIDE * seen.min()
    norm = LogNorm(seen.min(), seen.max()) if wide else Normalize(0.0, seen.max())
    x, y = _x_values(data, across), _x_values(data, up)
    for axes, (at, point), table in zip(panels, places, tables, strict=True):
        said = [f"{name} = {of_value(data, name, place)}" for dim, place in at.items() for name in coordinates_along(data, dim)]
        drawn = np.ma.masked_where(~(np.isfinite(table) & (table > 0.0)), table)
        mesh = axes.pcolormesh(_edges(x), _edges(y), drawn, norm=norm, cmap="viridis")
        for values, scale in ((x, axes.set_xscale), (y, axes.set_yscale)):
            if _is_log(values):
                scale("log")
        axes.set(
            title="\n".join([of_point(data, point), *said]), xlabel=_axis_label(data, across), ylabel=_axis_label(data, up)
        )
        axes.title.set_fontsize(9)
        axes.set_facecolor("#dddddd")
    name = shown_quantity(data)
    figure.colorbar(mesh, ax=panels, label=f"{label(data[name])}; grey: not defined")
    return figure


def _rises(values: np.ndarray) -> bool:
    steps = np.diff(values)
    return bool(np.all(steps > 0.0) or np.all(steps < 0.0))


def _x_values(data: "xarray.Dataset", dim: str) -> np.ndarray:
    """Where the values along a dimension are drawn: at those of its first quantity, or one after another where that neither
    rises nor falls."""
    name = coordinates_along(data, dim)[0]
    values = data[name].values
    return values * _prefix(data, name)[0] if _rises(values) else np.arange(1.0, values.size + 1.0)


def _prefix(data: "xarray.Dataset", name: str) -> tuple[float, str]:
    """What values of a quantity are drawn times, and the unit with a fitting prefix that they then have."""
    unit, largest = data[name].attrs.get("units", "1"), float(np.abs(data[name].values).max())
    return (1.0, unit) if unit == "1" or largest == 0.0 else prefix(name.rpartition(".")[2], largest)


def _axis_label(data: "xarray.Dataset", dim: str) -> str:
    names = coordinates_along(data, dim)
    if not _rises(data[names[0]].values):
        return f"place in the list of {', '.join(names)}"
    beside = f"\nwith {', '.join(names[1:])}" if names[1:] else ""
    unit, prefixed = data[names[0]].attrs.get("units", "1"), _prefix(data, names[0])[1]
    return label(data[names[0]], longest=60).replace(f"[{unit}]", f"[{prefixed}]") + beside


def _is_log(values: np.ndarray) -> bool:
    """Whether values span a decade and are spaced by their logarithms rather than evenly."""
    if values.size < 3 or values.min() <= 0.0 or values.max() < _DECADE * values.min():
        return False
    even, ratios = np.abs(np.diff(values)), np.abs(np.diff(np.log(values)))
    return even.max() / even.min() > ratios.max() / ratios.min()


def _edges(values: np.ndarray) -> np.ndarray:
    """Borders (n + 1,) of cells around values (n,), between them halfway, on a logarithmic axis by ratio."""
    log = _is_log(values)
    at = np.log(values) if log else values
    if at.size == 1:
        half = abs(at[0]) * 0.1 or 0.5
        return np.array([at[0] - half, at[0] + half])
    middle = (at[1:] + at[:-1]) / 2.0
    edges = np.concatenate([[2.0 * at[0] - middle[0]], middle, [2.0 * at[-1] - middle[-1]]])
    return np.exp(edges) if log else edges
