"""Draw a sensitivity study: Sobol indices, Morris effects, indices against load, and logarithmic sensitivities."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from stiction.quantities.table import QUANTITIES
from stiction.report.html_words import letters
from stiction.report.pictures import BLUE, COLOURS, ORANGE, along_points, canvas, finish, heading, look_of, say
from stiction.report.swept_tables import of_point, points_dimension
from stiction.report.views.sensitivity import at_working_load, head_of, ranked, results_of, working_place
from stiction.studies.prediction.uncertainty_sources import part_name

if TYPE_CHECKING:
    import xarray

_SHOWN = 12  # largest number of bars in a panel
_TICKS = 6  # largest number of ticks of an axis of effects, whose numbers may be long
_NAMED = 0.05  # fraction of the largest effect above which an input is named


def sensitivity_figure(data: "xarray.Dataset") -> Figure:
    """Draw a sensitivity study: Sobol indices, total indices against load, Morris effects and logarithmic sensitivities.

    data: result of `sensitivity`. For a prediction, shares of the variance of ln mu are drawn instead of indices and effects.
    Without uncertain inputs, only the logarithmic sensitivities are drawn.
    """
    if "friction_coefficient_share" in data:
        figure, (shares, slopes) = canvas(11.0, 4.8, 1, 2)
        _shares(shares, data)
        _log_sensitivities(slopes, data)
    elif "input" not in data.dims:
        figure, (slopes,) = canvas(7.5, 5.6)
        _log_sensitivities(slopes, data)
    else:
        figure, dim = Figure(figsize=(13.5, 9.4), layout="constrained"), points_dimension(data)
        several = dim is not None and data.sizes[dim] > 1
        panels = figure.subplot_mosaic([["indices", "over load" if several else "indices"], ["screening", "slopes"]])
        name = results_of(data, "total_order")[0]
        _indices(panels["indices"], data, name)
        if several:
            _over_load(panels["over load"], data, name, str(dim))
        _screening(panels["screening"], data, name)
        _log_sensitivities(panels["slopes"], data)
    figure.suptitle(heading(data, data.attrs.get("case", "")), fontsize=11)
    return figure


def _shares(axes: Axes, data: "xarray.Dataset") -> None:
    """Draw the fraction of the variance of ln mu that each source of uncertainty causes."""
    names = [part_name(name) for name in data["input"].values.tolist()]
    axes.barh(names, data["friction_coefficient_share"].values, color=BLUE)
    _limit_height(axes, len(names))
    axes.invert_yaxis()
    finish(axes, xlim=(0.0, 1.0), xlabel=r"share of the variance of $\ln\,\mu$", title="sources of the interval")


def _limit_height(axes: Axes, bars: int) -> None:
    """Leave room above and below so that none of `bars` bars at 0, 1, ... takes more than a quarter of the height."""
    room = 0.5 + max(4 - bars, 0) / 2.0
    axes.set_ylim(-room, bars - 1 + room)


def _symbol(name: str) -> str:
    return f"${QUANTITIES[name].latex}$"


def _indices(axes: Axes, data: "xarray.Dataset", name: str) -> None:
    """Draw total and first-order Sobol indices of one result at the working load, with their 95 % intervals.

    name: the result. Only the twelve most important inputs are shown. The total indices of other results are drawn as marks.
    """
    results = at_working_load(data)
    order = ranked(results, name, "total_order", "input")[:_SHOWN]
    y = np.arange(len(order))[::-1]
    for kind, shift, colour in (("total", 0.2, BLUE), ("first", -0.2, ORANGE)):
        value, low, high = (results[f"{name}_{kind}_order{end}"].values[order] for end in ("", "_low", "_high"))
        error = np.nan_to_num(np.abs([value - low, high - value]))
        look = {"elinewidth": 1.0, "capsize": 2.0}
        axes.barh(y + shift, np.nan_to_num(value), height=0.38, xerr=error, color=colour, error_kw=look,
                  label=f"{kind} index of ln {_symbol(name)}")  # fmt: skip
    for other, mark in zip(results_of(data, "total_order")[1:], "so^", strict=False):
        axes.plot(results[f"{other}_total_order"].values[order], y + 0.2, mark, color="black", mfc="none", markersize=5,
                  label=f"total, {head_of(other)}")  # fmt: skip
    axes.set_yticks(y, [part_name(str(results["input"].values[place])) for place in order], fontsize=9)
    axes.set(xlabel=f"share of the variance, 95 % intervals; {of_point(data, working_place(data))}")
    axes.set_xlim(left=0.0)
    finish(axes, title="which input should be measured better?")
    axes.grid(False, axis="y")


def _over_load(axes: Axes, data: "xarray.Dataset", name: str, dim: str) -> None:
    order = ranked(at_working_load(data), name, "total_order", "input")[: len(COLOURS)]
    for place, number in enumerate(order):
        chosen = data.isel(input=int(number))
        y = chosen[f"{name}_total_order"].values
        axes.plot(data[dim].values, y, label=part_name(str(chosen["input"].item())), **look_of("", place))
    along_points(axes, data[dim])
    axes.set(ylabel=f"total Sobol index of ln {_symbol(name)}", ylim=(0.0, None))


def _screening(axes: Axes, data: "xarray.Dataset", name: str) -> None:
    results = at_working_load(data)
    size, deviation, error = (results[f"{name}_effect{end}"].values for end in ("", "_deviation", "_error"))
    if not np.isfinite(size).any():
        say(axes, "not known")
        return
    axes.errorbar(size, deviation, xerr=error, linestyle="", marker="o", color=BLUE, elinewidth=0.8, clip_on=False)
    for place in ranked(results, name, "effect", "input")[:_SHOWN]:
        if size[place] > _NAMED * np.nanmax(size):  # names of small effects would overlap
            left = size[place] > 0.6 * np.nanmax(size)
            side = {"xytext": (-4, 4), "ha": "right"} if left else {"xytext": (4, 4), "ha": "left"}
            text = part_name(str(results["input"].values[place]))
            axes.annotate(text, (size[place], deviation[place]), fontsize=8, textcoords="offset points", **side)
    axes.set_xlim(0.0, 1.1 * max(float(np.nanmax(size)), 1e-9))
    axes.xaxis.set_major_locator(MaxNLocator(_TICKS))
    axes.set(xlabel=f"mean size of the effect on ln {_symbol(name)}", ylabel="deviation of the effect over other inputs")
    axes.set_ylim(0.0, 1.15 * max(float(np.nanmax(deviation)), 1e-9))
    finish(axes, title="effects of Morris")


def _log_sensitivities(axes: Axes, data: "xarray.Dataset") -> None:
    results, names = at_working_load(data), results_of(data, "log_sensitivity")
    if not names:
        say(axes, "not known")
        return
    order = ranked(results, names[0], "log_sensitivity", "number")
    order = np.array(
        [number for number in order if any(abs(_known(results, name, number)) > 1e-4 for name in names)][:_SHOWN], dtype=int
    )
    y, height = np.arange(len(order))[::-1], 0.8 / len(names)
    for number, (name, colour) in enumerate(zip(names, COLOURS, strict=False)):
        values = [_known(results, name, place) for place in order]
        axes.barh(y + 0.4 - (number + 0.5) * height, values, height=height, color=colour, label=letters(head_of(name)))
    axes.set_yticks(y, [part_name(str(results["number"].values[number])) for number in order], fontsize=9)
    _limit_height(axes, len(order))
    axes.axvline(0.0, color="black", linewidth=0.8)
    axes.xaxis.set_major_locator(MaxNLocator(_TICKS))
    heads = "the result" if len(names) > 1 else letters(head_of(names[0]))
    finish(axes, len(names) > 1, xlabel=f"change of {heads} [%] per 1 % of the input", title="at nominal inputs")
    axes.grid(False, axis="y")


def _known(results: "xarray.Dataset", name: str, place: int) -> float:
    return float(np.nan_to_num(results[f"{name}_log_sensitivity"].values[place]))
