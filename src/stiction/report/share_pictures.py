"""Draw the parts of load, contact area and friction as stacked shares."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from stiction.quantities.table import QUANTITIES
from stiction.report.pictures import BLUE, GREEN, ORANGE, RED, SKY, canvas, finish, label, say

if TYPE_CHECKING:
    import xarray

_COLOURS = (BLUE, ORANGE, GREEN, RED, SKY)
_HATCHES = ("", "//", "..", "\\\\", "xx")


def stacks(curve: "xarray.Dataset") -> dict[str, tuple[str, list[str]]]:
    """Return the charts of stacked parts for which a curve has data, as description -> (total, parts).

    total: name of the summed variable, for example "contact_area". parts: names of the variables that add up to the total.
    """
    stacked: dict[str, tuple[str, list[str]]] = {}
    for total, stem, words in (("contact_area", "contact_area", "contact area"), ("friction_force", "friction", "friction"),
                               ("load", "load", "load")):  # fmt: skip
        if total not in curve:
            continue
        parts = [str(name) for name in curve.data_vars
                 if str(name).startswith(f"{stem}_") and name != total and name in QUANTITIES
                 and QUANTITIES[str(name)].unit == QUANTITIES[total].unit]  # fmt: skip
        bodies = [name for name in parts if name.endswith(("_film", "_substrate"))]
        states = [name for name in parts if name not in bodies]
        for kind, names in (("by state", states), ("film and substrate", bodies)):
            if len(names) > 1:
                stacked[f"{words}, {kind}"] = (total, names)
    return stacked


def shares_of(curve: "xarray.Dataset", parts: Sequence[str]) -> np.ndarray:
    """Return the absolute value of each part, divided by the sum of these values over all parts, shape (parts, points).

    parts: names of variables of the curve. The shares are NaN where all parts are 0.
    """
    sizes = np.abs([np.asarray(curve[name].values, dtype=float) for name in parts])
    total = sizes.sum(axis=0)
    return np.divide(sizes, total, out=np.full(sizes.shape, np.nan), where=total > 0.0)


def part_in_words(name: str, total: str) -> str:
    """Return the readable name of a part of a sum: "elastic-plastic" for contact_area_elastic_plastic.

    total: name of the summed variable.
    """
    stem = "friction_" if total == "friction_force" else f"{total}_"
    return name.removeprefix(stem).replace("_", "-")


def share_figure(curve: "xarray.Dataset", what: str) -> Figure:
    """Draw the absolute value of each part, over the sum of all, as a stack against compressive load, with hatches.

    what: key of `stacks(curve)`, for example "contact area, by state".
    """
    total, parts = stacks(curve)[what]
    figure, (axes,) = canvas(5.2, 3.9)
    load, shares = curve["load"].values, shares_of(curve, parts)
    order = np.argsort(load)
    drawn = order[(load[order] > 0.0) & np.isfinite(shares[:, order]).all(axis=0)]
    axes.set(xlabel=label(curve["load"]), ylabel=f"share of {what.partition(',')[0]}")
    if drawn.size < 2:
        say(axes, "fewer than two compressive loads")
        return figure
    names = [part_in_words(name, total) for name in parts]
    look: dict[str, Any] = {"colors": _COLOURS, "hatch": _HATCHES, "edgecolor": "white", "linewidth": 0.0}
    axes.stackplot(load[drawn], shares[:, drawn], labels=names, **look)
    finish(axes, legend=False, xscale="log", ylim=(0.0, 1.0), xlim=(load[drawn][0], load[drawn][-1]))
    figure.legend(loc="outside upper center", ncols=min(len(parts), 3), fontsize=9, frameon=False)
    return figure
