"""Draw the result of a design study: best designs, all evaluated designs, and the Pareto front of two objectives."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.report.pictures import BLUE, GREY, ORANGE, RED, along, canvas, finish, look_of, say
from stiction.report.scales import scale_friction
from stiction.report.table import shown
from stiction.report.views.design import columns_of
from stiction.studies.design.plan import quantity_of

if TYPE_CHECKING:
    import xarray

_BARS = 12


def design_figure(data: "xarray.Dataset") -> Figure:
    """Draw the result of a design study.

    data: result of `design`. If design variables were chosen from lists, the first panel shows the best design for each
    combination of list entries, at most twelve. The next panel shows the Pareto front of two objectives or, for one objective,
    all evaluated designs. For two objectives without lists, a last panel shows the design variables along the Pareto front.
    """
    texts = data.attrs["objectives"].split("\n")
    objectives = [text.split(" next to ")[0].removeprefix("least ").removeprefix("most ") for text in texts]
    several, two = data.sizes["design"] > 1, len(objectives) == 2
    drawn: list[Callable[[Axes], None]] = [lambda axes: _bars(axes, data, objectives[0])] if several else []
    drawn.append(lambda axes: _front(axes, data, objectives) if two else _draw_evaluated(axes, data, objectives[0]))
    if two and not several and data.sizes["pareto"]:
        drawn.append(lambda axes: _chosen(axes, data, objectives[0]))
    figure, panels = canvas(max(5.6 * len(drawn), 7.0), 4.8, 1, len(drawn))
    for axes, draw in zip(panels, drawn, strict=True):
        draw(axes)
    missed = [f"missed: {words.replace('_', ' ')}" for words in data.attrs["missed"].split("\n") if words]
    objective = f"objective: {'; '.join(texts).replace('_', ' ')}"
    figure.suptitle("\n".join(filter(None, [data.attrs.get("case", ""), objective, *missed])), fontsize=11)
    return figure


def _bars(axes: Axes, data: "xarray.Dataset", objective: str) -> None:
    count = min(data.sizes["design"], _BARS)
    columns = columns_of(data, "design")
    chosen = [name for name in data.attrs["chosen"].split(", ") if data[columns[name]].dtype.kind in "UO"]
    names = [", ".join(str(data[columns[name]].values[row]) for name in chosen) or str(row + 1) for row in range(count)]
    values, feasible = data[columns[objective]].values[:count], data["feasible"].values[:count]
    places = np.arange(count)[::-1]
    axes.barh(places, values, color=[BLUE if holds else GREY for holds in feasible])
    title = "best for each choice" + ("" if feasible.all() else "; grey: violates a limit")
    _along_result(axes, "x", objective, values, log=False, title=title)
    axes.set_yticks(places, names)
    axes.grid(False, axis="y")


def _along_result(axes: Axes, which: str, name: str, values: np.ndarray, log: bool = True, **named: Any) -> None:
    """Label an axis with a result, or with an end of its interval such as friction_coefficient_high, by `along`."""
    quantity = quantity_of(name)
    end = name.removeprefix(quantity).removeprefix("_")
    along(axes, which, quantity, values, log, f"{end} end of the interval of the\n" if end else "", **named)


def _legend_above(axes: Axes, columns: int = 1) -> None:
    """Move title and legend above the panel, where the legend covers no points and no limits.

    columns: number of columns of the legend.
    """
    place: dict[str, Any] = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0), "ncols": columns, "frameon": False}
    axes.legend(title=axes.get_title(), title_fontsize=9, fontsize=8, **place)
    axes.set_title("")


def _front(axes: Axes, data: "xarray.Dataset", objectives: list[str]) -> None:
    if not data.sizes.get("pareto"):
        say(axes, "no design meets the limits")
        return
    columns = columns_of(data, "pareto")
    x, y = (data[columns[objective]].values for objective in objectives)
    axes.plot(x, y, color=BLUE, marker="o", markersize=4, linewidth=1)
    _along_result(axes, "x", objectives[0], x)
    _along_result(axes, "y", objectives[1], y, title="Pareto front: no other design is better in both")


def _chosen(axes: Axes, data: "xarray.Dataset", objective: str) -> None:
    """Draw the design variables along the Pareto front, each scaled from 0 at its lower to 1 at its upper search limit.

    Variables searched on a log scale are scaled in their logarithm. Choices from lists are not drawn. objective: name of the
    result on the horizontal axis.
    """
    columns = columns_of(data, "pareto")
    x = data[columns[objective]].values
    names = [name for name in data.attrs["chosen"].split(", ") if "searched_from" in data[columns[name]].attrs]
    for number, name in enumerate(names):
        variable, last = data[columns[name]], name.rpartition(".")[2]
        low, high, values = variable.attrs["searched_from"], variable.attrs["searched_to"], variable.values
        text = f"{last.replace('_', ' ')}: {shown(low, last, 3)} to {shown(high, last, 3)}"
        if variable.attrs["spacing"] == "log":
            low, high, values = np.log(low), np.log(high), np.log(values)
        axes.plot(x, (values - low) / (high - low), linewidth=0.8, label=text, **look_of("", number))
    title = "design variables along the front"
    _along_result(axes, "x", objective, x, ylabel="0: lower search limit; 1: upper search limit", title=title)
    _legend_above(axes)


def _draw_evaluated(axes: Axes, data: "xarray.Dataset", objective: str) -> None:
    """Draw the objective of every evaluated design against the first design variable that has search limits, as points."""
    columns = columns_of(data, "evaluated")
    name = next(
        (candidate for candidate in data.attrs["chosen"].split(", ") if "searched_from" in data[columns[candidate]].attrs), ""
    )
    if not name:
        say(axes, "no design variable has search limits")
        return
    number, value, feasible = data[columns[name]], data[columns[objective]].values, data["evaluated_feasible"].values
    for mask, colour, text in ((~feasible, GREY, "violates a limit"), (feasible, BLUE, "meets all limits")):
        axes.plot(
            number.values[mask], value[mask], ".", color=colour, markersize=4, alpha=0.5, label=text if mask.any() else None
        )
    best = data.isel(design=0)
    chosen = columns_of(data, "design")
    axes.plot(float(best[chosen[name]]), float(best[chosen[objective]]), "*", color=RED, markersize=14, label="best", zorder=3)
    for end_number, end in enumerate(("searched_from", "searched_to")):
        axes.axvline(number.attrs[end], color=ORANGE, linestyle="--", label=None if end_number else "search limits")
    seen = value[feasible & np.isfinite(value)] if feasible.any() else value[np.isfinite(value)]
    quantity = name.rpartition(".")[2]
    along(axes, "x", quantity, number.values, title=f"{len(value)} designs evaluated")
    _along_result(axes, "y", objective, seen)
    if seen.size and seen.min() > 0.0:
        scale_friction(axes, seen)
        finish(axes)
    _legend_above(axes, 2)
