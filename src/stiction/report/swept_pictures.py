"""Draw a parameter sweep: lines, or heat maps for two array parameters with many values each, and for more than two."""

from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure

from stiction.quantities.sampling import spread_rows
from stiction.quantities.table import QUANTITIES
from stiction.report.pictures import (
    COLOUR_MAP,
    NOT_PRESSED,
    SKY,
    InUnit,
    add_titles,
    along,
    along_points,
    canvas,
    draw_band,
    finish,
    label,
    look_of,
    say,
)
from stiction.report.scales import is_log, scale_friction
from stiction.report.swept_tables import (
    coordinates_along,
    of_point,
    of_value,
    points_dimension,
    shown_quantity,
    varied,
)
from stiction.report.table import prefix

if TYPE_CHECKING:
    import xarray

_LINES, _PANELS, _MAPS, _MULTIPLES = 6, 3, 6, 3
_MARKED = 30  # largest number of points of a line that has marks
_DECADE = 9.0  # smallest ratio of the ends of a logarithmic axis


def swept_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """Draw friction against the array parameters of a case, at some of its loads or separations.

    data: result of `predict` or `solve` with array parameters. For a model without friction the contact area is drawn.
    """
    dims, points = varied(data), points_dimension(data)
    if len(dims) > 2 or (len(dims) == 2 and min(data.sizes[dim] for dim in dims) > _LINES):
        figure = _maps(data, dims)
    elif len(dims) == 2:
        by, against = sorted(dims, key=lambda dim: data.sizes[dim])
        places = [{points: int(point)} for point in spread_rows(data.sizes[points], _PANELS)] if points else [{}]
        figure, panels = canvas(5.2 * len(places) + 0.5, 4.8, 1, len(places), sharey=True)
        seen = []
        for axes, place in zip(panels, places, strict=True):
            seen += _lines(axes, data.isel(place), against, by)
            axes.set_title(_place_in_words(data, place), fontsize=9)
        if seen:
            scale_friction(panels[0], np.concatenate(seen))  # for all panels: they share the axis
        for axes in panels:
            axes.label_outer()
        _legend_below(figure, panels)
    else:
        along_load = points is not None and data.sizes[points] > 1
        figure, panels = canvas(11.0 if along_load else 6.5, 4.8, 1, 1 + along_load)
        _lines(panels[0], data, dims[0], points)
        if along_load:
            _lines(panels[1], data, str(points), dims[0])
    add_titles(figure, data, title)
    return figure


def _legend_below(figure: Figure, panels: list[Axes]) -> None:
    """Replace the legends of panels that have the same lines by one legend below the panels."""
    legends = [legend for axes in panels if (legend := axes.get_legend())]
    if not legends:
        return
    lines, title = legends[0].legend_handles, legends[0].get_title().get_text()
    for legend in legends:
        legend.remove()
    look: dict[str, Any] = {"loc": "outside lower center", "ncols": min(len(lines), _LINES), "frameon": False}
    figure.legend(handles=lines, title=title, title_fontsize=9, fontsize=9, **look)


def _lines(axes: Axes, data: "xarray.Dataset", against: str, by: str | None) -> list[np.ndarray]:
    """Draw a result against the dimension `against`, one line for each of a few positions along the dimension `by`.

    by: None draws a single line, with its interval if that is known. Returns the drawn values.
    """
    name = shown_quantity(data)
    x, seen = _x_values(data, against), []
    places = [{by: int(index)} for index in spread_rows(data.sizes[by], _LINES)] if by else [{}]
    for number, place in enumerate(places):
        y = data[name].isel(place).values
        drawn = np.isfinite(y) & (y > 0.0)
        if not drawn.any():
            continue
        look = look_of("", number) | ({} if x.size <= _MARKED else {"marker": ""})
        axes.plot(x[drawn], y[drawn], label=_place_in_words(data, place), **look)
        seen.append(y[drawn])
        if len(places) == 1 and f"{name}_low" in data:
            low, high = (data[f"{name}_{end}"].isel(place).values[drawn] for end in ("low", "high"))
            draw_band(axes, x[drawn], low, high, color=SKY, alpha=0.25, label=f"{data.attrs['level']:.0%} interval")
            seen += [low[low > 0.0], high]
    axes.set_ylabel(label(data[name], longest=42))
    if not seen:
        say(axes, NOT_PRESSED)
        return seen
    scale_friction(axes, np.concatenate(seen))
    if data[name].attrs.get("units", "1") != "1":
        along(axes, "y", name, np.concatenate(seen), log=False)
    _name_axis(axes, "x", data, against)
    if by in varied(data) and (legend := axes.get_legend()):
        legend.set_title(", ".join(coordinates_along(data, str(by))).replace("_", " "))
    return seen


def _place_in_words(data: "xarray.Dataset", place: "dict[str, int]") -> str:
    """Describe a position in the sweep by its load and the values of its parameters.

    place: index along each dimension.
    """
    points, texts = points_dimension(data), []
    for dim, index in place.items():
        names = coordinates_along(data, dim)
        values = [of_value(data, name, index) for name in names] if dim != points else [of_point(data, index)]
        texts += (
            values
            if dim == points or len(place) == 1
            else [f"{coordinate} = {value}" for coordinate, value in zip(names, values, strict=True)]
        )
    return "\n".join(texts) if len(place) > 1 else ", ".join(texts)


def _maps(data: "xarray.Dataset", dims: list[str]) -> Figure:
    """Draw heat maps over two of the array parameters.

    A sweep of two parameters has one map for each of some loads or separations. A sweep of more parameters has a grid of maps
    at the middle load: the two with most values span each map, some values of the next two span the grid, and all others are at
    their middle value.
    """
    points = points_dimension(data)
    count = data.sizes[points] if points else 1
    places = [{points: int(index)} if points else {} for index in spread_rows(count, _MAPS)]
    columns = min(len(places), 3)
    if len(dims) > 2:
        dims = sorted(dims, key=lambda dim: -data.sizes[dim])
        fixed = {dim: (data.sizes[dim] - 1) // 2 for dim in dims[4:]} | ({points: (count - 1) // 2} if points else {})
        outer = {dim: spread_rows(data.sizes[dim], _MULTIPLES) for dim in reversed(dims[2:4])}
        places = [fixed | dict(zip(outer, map(int, index), strict=True)) for index in product(*outer.values())]
        columns = len(outer[dims[2]])
    rows = -(-len(places) // columns)
    figure, panels = canvas(4.0 * columns + 1.6, 3.6 * rows + 0.9, rows, columns)
    for axes in panels[len(places) :]:
        axes.set_axis_off()
    up, across = dims[:2]
    name = shown_quantity(data)
    tables = [data[name].isel(place).transpose(up, across).values for place in places]
    seen = np.concatenate([table[np.isfinite(table) & (table > 0.0)] for table in tables])
    if not seen.size:
        for axes in panels:
            say(axes, "not defined here")
        return figure
    norm = LogNorm(seen.min(), seen.max()) if is_log(seen) else Normalize(0.0, seen.max())
    x, y = _x_values(data, across), _x_values(data, up)
    for axes, place, table in zip(panels, places, tables, strict=False):
        drawn = np.ma.masked_where(~(np.isfinite(table) & (table > 0.0)), table)
        mesh = axes.pcolormesh(_edges(x), _edges(y), drawn, norm=norm, cmap=COLOUR_MAP)
        _name_axis(axes, "x", data, across)
        _name_axis(axes, "y", data, up)
        axes.set_title(_place_in_words(data, place), fontsize=9)
        axes.grid(False)
        axes.set_facecolor("#dddddd")
    figure.colorbar(mesh, ax=panels, label=f"{label(data[name])}; grey: not defined")
    return figure


def _rises(values: np.ndarray) -> bool:
    steps = np.diff(values)
    return bool(np.all(steps > 0.0) or np.all(steps < 0.0))


def _x_values(data: "xarray.Dataset", dim: str) -> np.ndarray:
    """Return the positions on an axis of all points along a dimension.

    They are the values of the first quantity that varies along it, or 1, 2, 3, ... if these values are not sorted.
    """
    values = data[dim if dim == points_dimension(data) else coordinates_along(data, dim)[0]].values
    return values if _rises(values) else np.arange(1.0, values.size + 1.0)


def _name_axis(axes: Axes, which: str, data: "xarray.Dataset", dim: str) -> None:
    """Label and scale the axis ("x" or "y") that shows a dimension."""
    if dim == points_dimension(data):
        along_points(axes, data[dim])
        return
    first, *others = coordinates_along(data, dim)
    values, quantity = data[first].values, first.rpartition(".")[2]
    axis = getattr(axes, f"{which}axis")
    if not _rises(values):
        axis.set_label_text(f"position in the list of {', '.join([first, *others])}")
        finish(axes)
        return
    if _in_ratios(values):
        getattr(axes, f"set_{which}scale")("log")
    if quantity in QUANTITIES:
        along(axes, which, quantity, values, log=False)
    elif data[first].attrs.get("units") == "m":
        factor, unit = prefix("scan_size", float(np.abs(values).max()))
        axis.set_major_formatter(InUnit(factor))
        axis.set_label_text(label(data[first]).replace("[m]", f"[{unit}]"))
        finish(axes)
    else:
        axis.set_label_text(label(data[first]))
        finish(axes)
    if others:
        axis.set_label_text(f"{axis.get_label_text()}\nwith {', '.join(others)}")


def _in_ratios(values: np.ndarray) -> bool:
    """Return whether values suit a logarithmic axis.

    Such values span about a decade, and the ratios of neighbouring values vary less than their differences.
    """
    if values.size < 3 or values.min() <= 0.0 or values.max() < _DECADE * values.min():
        return False
    even, ratios = np.abs(np.diff(values)), np.abs(np.diff(np.log(values)))
    return even.max() / even.min() > ratios.max() / ratios.min()


def _edges(values: np.ndarray) -> np.ndarray:
    """Return the edges (n + 1,) of heat map cells around values (n,).

    Edges are halfway between values, or at their geometric mean on a logarithmic axis.
    """
    log = _in_ratios(values)
    centres = np.log(values) if log else values
    if centres.size == 1:
        half = abs(centres[0]) * 0.1 or 0.5
        return np.array([centres[0] - half, centres[0] + half])
    middle = (centres[1:] + centres[:-1]) / 2.0
    edges = np.concatenate([[2.0 * centres[0] - middle[0]], middle, [2.0 * centres[-1] - middle[-1]]])
    return np.exp(edges) if log else edges
