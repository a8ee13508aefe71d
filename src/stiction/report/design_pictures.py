"""A picture of a design: how the search went, the best for each choice from the lists, and the front of two wishes."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.quantities.table import QUANTITIES
from stiction.report.design_tables import columns_of
from stiction.report.pictures import BLUE, GREY, ORANGE, finish, say

if TYPE_CHECKING:
    import xarray

__all__ = ["design_figure"]

_BARS = 12


def design_figure(data: "xarray.Dataset") -> Figure:
    """The best for each choice from the lists; the front of two wishes, or how the search went."""
    figure = Figure(figsize=(11.0, 4.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    wishes = [
        one.split(" next to ")[0].removeprefix("least ").removeprefix("most ") for one in data.attrs["wishes"].split("\n")
    ]
    _bars(left, data, wishes[0])
    if len(wishes) == 2:
        _front(right, data, wishes)
    else:
        _search(right, data, wishes[0])
    figure.suptitle(
        "\n".join(filter(None, [data.attrs.get("case", ""), "; ".join(data.attrs["wishes"].split("\n"))])), fontsize=11
    )
    return figure


def _axis(name: str) -> str:
    row = QUANTITIES[name]
    unit = f" [{row.unit.replace('m^2', 'm²')}]" if row.unit else ""
    return f"{(row.short or row.meaning)} ${row.latex}${unit}"


def _bars(axes: Axes, data: "xarray.Dataset", wish: str) -> None:
    count = min(data.sizes["design"], _BARS)
    columns = columns_of(data, "design")
    chosen = [name for name in data.attrs["chosen"].split(", ") if name in columns and data[columns[name]].dtype.kind in "UO"]
    names = [", ".join(str(data[columns[name]].values[at]) for name in chosen) or "best" for at in range(count)]
    values, kept = data[columns[wish]].values[:count], data["kept"].values[:count]
    places = np.arange(count)[::-1]
    axes.barh(places, values, color=[BLUE if one else GREY for one in kept])
    axes.set_yticks(places, names)
    axes.set_xlabel(_axis(wish))
    axes.set_title("best for each choice; grey: breaks a limit", fontsize=9)
    axes.grid(axis="x", alpha=0.3)


def _front(axes: Axes, data: "xarray.Dataset", wishes: list[str]) -> None:
    if not data.sizes.get("front"):
        say(axes, "no design keeps the limits")
        return
    columns = columns_of(data, "front")
    x, y = (data[columns[one]].values for one in wishes)
    axes.plot(x, y, color=BLUE, marker="o", markersize=4, linewidth=1)
    for values, scale in ((x, axes.set_xscale), (y, axes.set_yscale)):
        if values.min() > 0.0 and values.max() > 9.0 * values.min():
            scale("log")
    axes.set(xlabel=_axis(wishes[0]), ylabel=_axis(wishes[1]))
    axes.set_title("none is better in both than any of these", fontsize=9)
    finish(axes)


def _search(axes: Axes, data: "xarray.Dataset", wish: str) -> None:
    value = data["best_so_far"].values
    there = np.isfinite(value)
    if not there.any():
        say(axes, "no design keeps the limits")
        return
    axes.plot(1 + np.flatnonzero(there), value[there], color=ORANGE, linewidth=1.8, drawstyle="steps-post")
    axes.set_xscale("log")
    axes.set_xlabel("designs asked")
    off = (
        "distance from the target: "
        if " next to " in data.attrs["wishes"]
        else "less of "
        if "most " in data.attrs["wishes"]
        else ""
    )
    axes.set_ylabel(("-" if off == "less of " else "") + ("" if off == "less of " else off) + _axis(wish))
    axes.set_title("best design so far that keeps all limits", fontsize=9)
    finish(axes)
