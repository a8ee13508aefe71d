"""Friction at the working load: the prediction, and models that agree, a row each."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import show
from stiction.report.pictures import BLUE, GREY, ORANGE, RED, canvas, finish, say, sparse
from stiction.report.views.comparison import Group

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient"
_COLOURS = (BLUE, ORANGE, GREY)  # of families
_ROWS = 9  # beside the prediction
_WIDE = 1e4  # friction more than this factor below the largest has no place on the axis


def models_figure(
    data: "xarray.Dataset", groups: list[Group], prediction: "xarray.Dataset | None" = None, title: str = ""
) -> Figure:
    """Return dots with intervals: the prediction with its interval, and at most nine groups of models, hollow where the contact
    does not fit them; a bar is mu less the error of the model on solved surfaces, at the ends of 90 %.

    data: a comparison; prediction: at its working load. groups: of the comparison.
    """
    groups = [one for one in groups if one.possible and one.low > 0.0]
    groups = [one for one in groups if one.high > max(other.high for other in groups) / _WIDE][:_ROWS]
    count = len(groups) + (prediction is not None)
    figure, (axes,) = canvas(8.0, 1.4 + 0.36 * max(count, 2))
    if not count:
        say(axes, "no model says anything of friction here")
        return figure
    names = []
    if prediction is not None:
        low, middle, high = (float(prediction[f"{_MU}{end}"]) for end in ("_low", "", "_high"))
        _row(axes, 0, (low, middle, middle, high), RED, True)
        axes.axvspan(low, high, color=RED, alpha=0.08, linewidth=0.0)
        names.append("prediction")
    families = list(dict.fromkeys(group.family for group in groups))
    for group in groups:
        colour = _COLOURS[min(families.index(group.family), 2)]
        _row(axes, len(names), (group.least, group.low, group.high, group.most), colour, group.fits)
        names.append(group.title)
    axes.set_yticks(range(len(names)), names, fontsize=9)
    if prediction is not None:
        axes.get_yticklabels()[0].set_fontweight("bold")
    plain = data["load"].attrs.get("units", "1") == "1"
    load = data.attrs["working_load"]
    text = f"P = {load:.4g}" if plain else show(load, "load", 3)
    axes.set(xscale="log", ylim=(len(names) - 0.4, -0.6))
    axes.set_xlabel(f"static friction coefficient ${QUANTITIES[_MU].latex}$ at {text}")
    figure.suptitle(title, fontsize=11)
    finish(axes)
    sparse(axes)
    handles = [Line2D([], [], color=_COLOURS[min(at, 2)], marker="o", label=name) for at, name in enumerate(families)]
    if any(not group.fits for group in groups):
        handles.append(Line2D([], [], color=GREY, marker="o", markerfacecolor="white", linestyle="", label="does not fit"))
    figure.legend(handles=handles, loc="outside lower left", fontsize=8, frameon=False, ncols=3)
    return figure


def _row(axes: Axes, row: int, ends: tuple[float, float, float, float], colour: str, fits: bool) -> None:
    """Draw a thin bar from end to end, a thick one over the values of the models, and a dot."""
    least, low, high, most = ends
    axes.plot([least, most], [row, row], color=colour, linewidth=1.2)
    axes.plot([low, high], [row, row], color=colour, linewidth=4.0, alpha=0.6, solid_capstyle="butt")
    axes.plot(np.sqrt(low * high), row, "o", color=colour, markerfacecolor=colour if fits else "white", markersize=7)
