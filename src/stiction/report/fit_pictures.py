"""Draw a fit: measured and fitted values, residuals, predictions with intervals, and likelihood profiles."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.quantities.sampling import spread_rows
from stiction.quantities.shown import show
from stiction.report.pictures import BLUE, COLOURS, GREY, SKY, along, along_points, canvas, draw_band, finish, look_of
from stiction.report.swept_tables import coordinates_along, of_value, points_dimension

if TYPE_CHECKING:
    import xarray

_LINES = 5
_TOP = 12.0  # largest rise of chi square that is shown


def fit_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """Draw a fit, with one row of panels for each measured quantity.

    The panels show measured and fitted values, residuals and, if there are any, predictions. data: result of `fit`.
    """
    quantities = list(dict.fromkeys(data["quantity"].values.tolist()))
    predicted = [name for name in quantities if f"predicted_{name}" in data]
    columns = 3 if predicted else 2
    figure, panels = canvas(5.2 * columns, 4.2 * len(quantities) + 0.5, len(quantities), columns)
    for row, name in enumerate(quantities):
        measured, residual, *rest = panels[row * columns : (row + 1) * columns]
        _measured_panel(measured, data, name)
        _residual_panel(residual, data, name)
        for axes in rest:
            if name in predicted:
                _predicted_panel(axes, data, name)
            else:
                axes.set_axis_off()
    used = data.attrs
    figure.suptitle("\n".join(filter(None, [title, f"{used['model']} fitted to {used['values']} values"])), fontsize=11)
    return figure


def _series(data: "xarray.Dataset", name: str) -> "Iterator[tuple[str, dict[str, Any], np.ndarray, xarray.Dataset]]":
    """Yield (name, style, x values, rows of the dataset) for each sample in which a quantity was measured, in the order of x.

    name: the measured quantity. x: the loads, or the row numbers (from 0) of the measured values if any load is unknown.
    """
    x = data["measured_load"].values
    x = x if np.isfinite(x).all() else np.arange(float(x.size))
    for number, sample in enumerate(dict.fromkeys(data["sample"].values.tolist())):
        rows = np.flatnonzero((data["quantity"].values == name) & (data["sample"].values == sample))
        rows = rows[np.argsort(x[rows], kind="stable")]
        if rows.size:
            yield sample, look_of("", number), x[rows], data.isel(row=rows)


def _along_load(axes: Axes, data: "xarray.Dataset") -> None:
    load = data["measured_load"].values
    if np.isfinite(load).all():
        along(axes, "x", "load", load)
    else:
        axes.set_xlabel("number of the value")


def _measured_panel(axes: Axes, data: "xarray.Dataset", name: str) -> None:
    for sample, look, x, rows in _series(data, name):
        bars: dict[str, Any] = {"linestyle": "", "linewidth": 1, "capsize": 2, "label": sample or "measured"}
        axes.errorbar(x, rows["measured"], rows["error"], **look, **bars)
        axes.plot(x, rows["fitted"], color=look["color"], linewidth=1.6)
    _along_load(axes, data)
    measured = data["measured"].values[data["quantity"].values == name]
    along(axes, "y", name, measured, log=False, title="points: measured, standard error; lines: fitted")


def _residual_panel(axes: Axes, data: "xarray.Dataset", name: str) -> None:
    axes.axhspan(-1.96, 1.96, color=GREY, alpha=0.15, linewidth=0)
    axes.axhline(0.0, color="black", linewidth=1)
    for _, look, x, rows in _series(data, name):
        axes.plot(x, rows["residual"], linestyle="", **look)
    _along_load(axes, data)
    most = 1.1 * max(float(np.nanmax(np.abs(data["residual"].values))), 2.5)
    title = "grey: 95 % of residuals, if the model holds"
    finish(axes, ylim=(-most, most), ylabel="(measured - fitted) / standard error", title=title)


def _predicted_panel(axes: Axes, data: "xarray.Dataset", name: str) -> None:
    best, low, high = (data[f"predicted_{name}{end}"] for end in ("", "_low", "_high"))
    point = str(points_dimension(data))
    others = [dim for dim in best.dims if dim != point]
    places = list(np.ndindex(*(data.sizes[dim] for dim in others)))
    x = data[point].values
    for line, chosen in enumerate(spread_rows(len(places), _LINES)):
        place = dict(zip(others, places[chosen], strict=True))
        texts = [
            f"{coordinate} = {of_value(data, coordinate, index)}"
            for dim, index in place.items()
            for coordinate in coordinates_along(data, str(dim))
        ]
        colour, text = COLOURS[line % len(COLOURS)], ", ".join(texts)
        draw_band(axes, x, low.isel(place).values, high.isel(place).values, color=colour, alpha=0.25)
        axes.plot(x, best.isel(place), color=colour, linewidth=1.6, marker="o" if x.size == 1 else "", label=text or None)
    along_points(axes, data[point])
    along(axes, "y", name, best.values, log=False, title="predicted; band: 95 %, from errors of the fitted parameters only")


def profile_figure(data: "xarray.Dataset") -> Figure:
    """Draw the likelihood profile of each fitted parameter, one panel each.

    A panel shows by how much chi-square rises if the parameter is fixed at other values and all other parameters are refitted.
    data: result of `fit`.
    """
    count = data.sizes["parameter"]
    columns = min(count, 3)
    rows = -(-count // columns)
    figure, panels = canvas(4.8 * columns, 3.9 * rows + 0.4, rows, columns)
    for number, axes in enumerate(panels):
        if number >= count:
            axes.set_axis_off()
        else:
            _profile_panel(axes, data.isel(parameter=number))
    figure.suptitle("Likelihood profiles; all other fitted parameters are refitted", fontsize=11)
    return figure


def _profile_panel(axes: Axes, parameter: "xarray.Dataset") -> None:
    name = str(parameter["parameter"].values)
    quantity = name.partition(" (")[0].rpartition(".")[2]
    value, rise = parameter["profile_value"].values, parameter["profile_rise"].values
    there = np.isfinite(value)
    axes.plot(value[there], rise[there], color=BLUE, marker=".", markersize=4)
    axes.axvspan(float(parameter["low"]), float(parameter["high"]), color=SKY, alpha=0.3, linewidth=0)
    axes.axvline(float(parameter["value"]), color="black", linewidth=1)
    axes.set_ylim(-0.3, max(4.5, min(_TOP, 1.05 * np.nanmax(rise))))
    ends = [show(float(parameter[end]), quantity, 3) for end in ("low", "high")]
    opened = "open at an end: " if bool(parameter["open_low"]) or bool(parameter["open_high"]) else ""
    along(axes, "x", quantity, value[there], title=f"{opened}95 %: {ends[0]} to {ends[1]}", ylabel="rise of $\\chi^2$")
    axes.set_xlabel(f"{name.replace('_', ' ')} {axes.get_xlabel().rpartition('$')[2].strip()}".strip())
