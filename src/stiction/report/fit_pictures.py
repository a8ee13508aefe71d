"""Pictures of a fit: what was measured with what the model says, residuals, predictions with bands, and profiles."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import show
from stiction.report.picture_style import along
from stiction.report.pictures import BLUE, GREEN, GREY, ORANGE, RED, SKY, draw_band, finish, label

if TYPE_CHECKING:
    import xarray

__all__ = ["fit_figure", "profile_figure"]

_COLOURS = (BLUE, RED, GREEN, ORANGE, SKY, "black")
_MARKERS = ("o", "s", "^", "D", "v", "P")
_LINES = 5
_TOP = 12.0  # of the rise of chi square that is shown


def fit_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """A row for each measured quantity: measured and fitted, residuals, and predictions with their bands."""
    quantities = list(dict.fromkeys(data["quantity"].values.tolist()))
    predicted = [name for name in quantities if f"predicted_{name}" in data]
    columns = 3 if predicted else 2
    figure = Figure(figsize=(5.2 * columns, 4.2 * len(quantities) + 0.5), layout="constrained")
    panels = figure.subplots(len(quantities), columns, squeeze=False)
    for row, name in zip(panels, quantities, strict=True):
        _measured_panel(row[0], data, name)
        _residual_panel(row[1], data, name)
        if name in predicted:
            _predicted_panel(row[2], data, name)
        elif columns == 3:
            row[2].set_axis_off()
    used = data.attrs
    figure.suptitle("\n".join(filter(None, [title, f"{used['model']} fitted to {used['values']} values"])), fontsize=11)
    return figure


def _rows(data: "xarray.Dataset", name: str, sample: str) -> np.ndarray:
    return np.flatnonzero((data["quantity"].values == name) & (data["sample"].values == sample))


def _samples(data: "xarray.Dataset") -> list[str]:
    return list(dict.fromkeys(data["sample"].values.tolist()))


def _x(data: "xarray.Dataset", rows: np.ndarray) -> np.ndarray:
    """Loads; of what was measured without any the numbers of the rows."""
    load = data["measured_load"].values[rows]
    return load if np.isfinite(load).all() else rows.astype(float)


def _axis(name: str) -> str:
    row = QUANTITIES[name]
    unit = f" [{row.unit.replace('m^2', 'm²')}]" if row.unit else ""
    return f"{row.meaning.partition(',')[0]} ${row.latex}${unit}"


def _with_load_axis(axes: Axes, data: "xarray.Dataset") -> None:
    load = data["measured_load"].values
    if not np.isfinite(load).all():
        axes.set_xlabel("number of the value")
        return
    axes.set_xlabel(_axis("load"))
    if load.min() > 0.0 and load.max() > 9.0 * load.min():
        axes.set_xscale("log")


def _measured_panel(axes: Axes, data: "xarray.Dataset", name: str) -> None:
    for at, sample in enumerate(_samples(data)):
        rows = _rows(data, name, sample)
        if not rows.size:
            continue
        colour, marker = _COLOURS[at % len(_COLOURS)], _MARKERS[at % len(_MARKERS)]
        x = _x(data, rows)
        order = np.argsort(x, kind="stable")
        axes.errorbar(
            x, data["measured"].values[rows], data["error"].values[rows], fmt=marker, color=colour, markersize=4, linewidth=1,
            capsize=2, label=sample or "measured",
        )  # fmt: skip
        axes.plot(x[order], data["fitted"].values[rows][order], color=colour, linewidth=1.6)
    _with_load_axis(axes, data)
    axes.set_ylabel(_axis(name))
    axes.set_title("points: measured, standard error; lines: fitted", fontsize=9)
    axes.legend(fontsize=8, framealpha=0.9)
    finish(axes)


def _residual_panel(axes: Axes, data: "xarray.Dataset", name: str) -> None:
    axes.axhspan(-1.96, 1.96, color=GREY, alpha=0.15, linewidth=0)
    axes.axhline(0.0, color="black", linewidth=1)
    for at, sample in enumerate(_samples(data)):
        rows = _rows(data, name, sample)
        axes.plot(
            _x(data, rows), data["residual"].values[rows], linestyle="", color=_COLOURS[at % len(_COLOURS)],
            marker=_MARKERS[at % len(_MARKERS)], markersize=4,
        )  # fmt: skip
    _with_load_axis(axes, data)
    most = np.nanmax(np.abs(data["residual"].values))
    axes.set_ylim(-1.1 * max(most, 2.5), 1.1 * max(most, 2.5))
    axes.set_ylabel("(measured - fitted) / standard error")
    axes.set_title("grey: 95 % of residuals, if the model holds", fontsize=9)
    finish(axes)


def _predicted_panel(axes: Axes, data: "xarray.Dataset", name: str) -> None:
    best, low, high = (data[f"predicted_{name}{end}"] for end in ("", "_low", "_high"))
    point = next(dim for dim in ("load", "mean_separation", "separation") if dim in best.dims)
    others = [dim for dim in best.dims if dim != point]
    rows = [dict(zip(others, at, strict=True)) for at in np.ndindex(*(data.sizes[dim] for dim in others))]
    chosen = [rows[at] for at in np.unique(np.linspace(0, len(rows) - 1, min(len(rows), _LINES)).round().astype(int))]
    x = data[point].values if point in data.coords else np.arange(data.sizes[point])
    for at, place in enumerate(chosen):
        colour = _COLOURS[at % len(_COLOURS)]
        draw_band(axes, x, low.isel(place).values, high.isel(place).values, color=colour, alpha=0.25)
        axes.plot(
            x, best.isel(place), color=colour, linewidth=1.6, marker="o" if x.size == 1 else "",
            label=_place(data, place) or "as in the case",
        )  # fmt: skip
    if x.size > 1 and x.min() > 0.0 and x.max() > 9.0 * x.min():
        axes.set_xscale("log")
    axes.set_xlabel(label(data[point]) if point in data.coords else point)
    axes.set_ylabel(_axis(name))
    axes.set_title("predicted; band: 95 %, of the fitted numbers alone", fontsize=9)
    axes.legend(fontsize=8, framealpha=0.9)
    finish(axes)


def _place(data: "xarray.Dataset", place: dict) -> str:
    said = []
    for dim, at in place.items():
        for name, one in data.coords.items():
            if one.dims == (dim,):
                quantity = str(name).rpartition(".")[2]
                value = float(one.values[at])
                said.append(f"{quantity.replace('_', ' ')} {show(value, quantity, 3) if quantity in QUANTITIES else value}")
    return ", ".join(said)


def profile_figure(data: "xarray.Dataset") -> Figure:
    """A panel for each free number: how much worse the best fit is for every value of it."""
    count = data.sizes["parameter"]
    columns = min(count, 3)
    rows = -(-count // columns)
    figure = Figure(figsize=(4.8 * columns, 3.9 * rows + 0.4), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False).flat
    for at, axes in enumerate(panels):
        if at >= count:
            axes.set_axis_off()
        else:
            _profile_panel(axes, data.isel(parameter=at))
    figure.suptitle("Profile of the likelihood: all other free numbers at their best", fontsize=11)
    return figure


def _profile_panel(axes: Axes, one: "xarray.Dataset") -> None:
    name = str(one["parameter"].values)
    quantity = name.partition(" (")[0].rpartition(".")[2]
    value, rise = one["profile_value"].values, one["profile_rise"].values
    there = np.isfinite(value)
    axes.plot(value[there], rise[there], color=BLUE, marker=".", markersize=4)
    axes.axvspan(float(one["low"]), float(one["high"]), color=SKY, alpha=0.3, linewidth=0)
    axes.axvline(float(one["value"]), color="black", linewidth=1)
    axes.set_ylim(-0.3, max(4.5, min(_TOP, 1.05 * np.nanmax(rise))))
    along(axes, "x", quantity, value[there])
    ends = [show(float(one[end]), quantity, 3) for end in ("low", "high")]
    opened = "open at an end: " if bool(one["open_low"]) or bool(one["open_high"]) else ""
    axes.set_title(f"{opened}95 %: {ends[0]} to {ends[1]}", fontsize=9)
    axes.set_xlabel(f"{name} {axes.get_xlabel().rpartition('$')[2]}".strip())
    axes.set_ylabel("rise of $\\chi^2$")
    axes.grid(alpha=0.3)
