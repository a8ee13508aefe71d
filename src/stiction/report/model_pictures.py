"""Every model's friction at the working load, a row each: to be read where there is little room."""

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from stiction.quantities.table import QUANTITIES
from stiction.report.families import families_of
from stiction.report.pictures import BLUE, GREEN, GREY, ORANGE, RED, SKY, finish, say

if TYPE_CHECKING:
    import xarray

_LOOKS = ((BLUE, "o"), (ORANGE, "s"), (GREEN, "^"), (SKY, "D"))
_MU = "friction_coefficient_at_load"
_WIDE = 1e4  # friction more than this factor below the largest stands at the edge: the axis would be of it alone


def rows_of_models(data: "xarray.Dataset") -> list[int]:
    """Places of the models that have a friction coefficient at the working load, families together, from the least up."""
    mu, rests, families = data[_MU].values, data["family_of_curve"].values, families_of(data)
    shown = np.flatnonzero(np.isfinite(mu)).tolist()
    return sorted(shown, key=lambda at: (rests[at] != data.attrs.get("family"), families[at], mu[at]))


def models_figure(data: "xarray.Dataset") -> Figure:
    """Dots, hollow where a model is outside its range, and an arrow at the edge with its number where it says far less than the
    others; a bar over what is uncertain of the inputs, where that is known; the
    recommended one named in bold. data: a comparison at a working load."""
    rows = rows_of_models(data)
    figure = Figure(figsize=(6.4, 1.5 + 0.21 * max(len(rows), 3)), layout="constrained")
    axes = figure.subplots()
    if not rows:
        say(axes, "no model says anything of friction here")
        return figure
    every = families_of(data)
    families = list(dict.fromkeys(every[at] for at in rows))
    least = max(float(data[_MU].values[rows].max()) / _WIDE, 1e-300)
    for row, at in enumerate(rows):
        colour, mark = _LOOKS[families.index(every[at]) % len(_LOOKS)]
        outside = bool(str(data["outside_validity"].values[at]))
        look: dict[str, Any] = {"color": colour, "markerfacecolor": "none" if outside else colour, "markersize": 6}
        mu = float(data[_MU].values[at])
        if mu < least:
            axes.plot(0.02, row, "<", transform=axes.get_yaxis_transform(), **look)
            axes.text(0.04, row, f"{mu:.2g}", transform=axes.get_yaxis_transform(), fontsize=8, va="center")
            continue
        _bar(axes, data, at, row, colour, least)
        axes.plot(mu, row, mark, **look)
    names = [str(data["model"].values[at]) for at in rows]
    axes.set_yticks(range(len(rows)), names, fontsize=8)
    for text, name in zip(axes.get_yticklabels(), names, strict=True):
        if name == data.attrs.get("recommended"):
            text.set_fontweight("bold")
            axes.axhspan(names.index(name) - 0.45, names.index(name) + 0.45, color=RED, alpha=0.15, linewidth=0.0)
    axes.set(xscale="log", ylim=(len(rows) - 0.4, -0.6), xlabel=f"static friction coefficient ${QUANTITIES[_RESULT].latex}$")
    finish(axes)
    _legend(figure, families)
    return figure


_RESULT = "friction_coefficient"


def _bar(axes: Axes, data: "xarray.Dataset", at: int, row: int, colour: str, least: float) -> None:
    """From the low to the high end of the band of one model, no lower than the axis reaches."""
    if f"{_MU}_quantile" not in data:
        return
    low, high = (float(data[f"{_MU}_quantile"].isel(model=at, quantile=end)) for end in (0, -1))
    if np.isfinite([low, high]).all() and low > 0.0:
        axes.plot([max(low, least), high], [row, row], color=colour, linewidth=2.0, alpha=0.6)


def _legend(figure: Figure, families: list[str]) -> None:
    handles = [Line2D([], [], color=_LOOKS[at % len(_LOOKS)][0], marker=_LOOKS[at % len(_LOOKS)][1], linestyle="")
               for at in range(len(families))]  # fmt: skip
    handles.append(Line2D([], [], color=GREY, marker="o", linestyle="", markerfacecolor="none"))
    figure.legend(handles, [*families, "hollow: outside its range"], loc="outside upper left", fontsize=8, frameon=False)
