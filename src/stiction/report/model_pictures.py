"""Draw friction against load by every possible model, with the interval of the prediction; three models are named."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.report.answer import ends_of_mu
from stiction.report.pictures import BLUE, GREEN, GREY, MU_LABEL, ORANGE, RED, canvas, finish, label, say
from stiction.report.scales import is_log, scale_friction
from stiction.report.views.comparison import Group, groups_of

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient"
_COLOURS = (BLUE, GREEN, ORANGE)  # colours of the named models
_WIDE = 1e4  # groups with a mu smaller than the largest by more than this factor are not drawn
_AROUND = 10.0  # the axis runs from the working load over this factor to the working load times this factor


def models_figure(
    data: "xarray.Dataset",
    groups: Sequence[Group] | None = None,
    prediction: "xarray.Dataset | None" = None,
    title: str = "",
    curve: "xarray.Dataset | None" = None,
) -> Figure:
    """Draw mu against load for each possible model, with the interval of the prediction at the working load.

    data: result of `compare`. groups: groups of its models that agree on mu; the legend names the first three. prediction:
    result of `predict` at its working load. curve: prediction over several loads, drawn as a band. Dots mark the working load.
    Groups whose results are physically impossible, or whose mu is 0 or more than 10^4 times smaller than the largest, are left
    out.
    """
    figure, (axes,) = canvas(8.53, 4.8)
    known = groups_of(data) if groups is None and "working_load" in data.attrs else groups or ()
    groups = [candidate for candidate in known if candidate.possible and candidate.low > 0.0]
    groups = [candidate for candidate in groups if candidate.high > max(other.high for other in groups) / _WIDE]
    if not groups and prediction is None:
        say(axes, "no model gives friction for this contact")
        return figure
    load = float(data.attrs["working_load"])
    named = {group.names[0]: colour for group, colour in zip(groups, _COLOURS, strict=False)}
    ends = [end for group in groups for end in (group.low, group.high)]
    if prediction is not None:
        mu, low, high = ends_of_mu(prediction)
        text = f"prediction, {prediction.attrs['level']:.0%} interval"
        ends += [low, high]
        if curve is not None and curve["load"].size > 1:
            x, line, *band = (curve.sortby("load")[name].values for name in ("load", _MU, f"{_MU}_low", f"{_MU}_high"))
            near = (np.abs(np.log(x / load)) < np.log(1.01 * _AROUND)) & np.isfinite(line)
            axes.fill_between(x[near], band[0][near], band[1][near], color=RED, alpha=0.1, linewidth=0.0)
            axes.plot(x[near], line[near], color=RED, linewidth=2.0)
            ends += [band[0][near].min(), band[1][near].max()]
        else:
            axes.axhspan(low, high, color=RED, alpha=0.1, linewidth=0.0)
        axes.errorbar(
            [load], [mu], [[mu - low], [high - mu]], color=RED, marker="o", capsize=5, linewidth=2.5, label=text, zorder=5
        )
    for name in (name for group in groups for name in group.names):
        candidate = data.sel(model=name)
        order = np.argsort(candidate["load"].values)
        x, y = candidate["load"].values[order], candidate[_MU].values[order]
        x, y = _within(x, y, load / _AROUND, load * _AROUND)
        colour, width = named.get(name, GREY), 2.0 if name in named else 0.8
        axes.plot(x, y, color=colour, linewidth=width, alpha=1.0 if name in named else 0.5)
        axes.plot(load, float(candidate[f"{_MU}_at_load"]), "o", color=colour, markersize=6 if name in named else 3)
    for group in groups[: len(named)]:
        fits = "" if group.fits else ", out of range"
        axes.plot([], [], color=named[group.names[0]], marker="o", label=f"{group.title}{fits}")
    if sum(len(group.names) for group in groups) > len(named):
        axes.plot([], [], color=GREY, label="other models")
    plain = data["load"].attrs.get("units", "1") == "1"
    text = f"{load:.4g}" if plain else show(load, "load", 3)
    axes.set_title(" ".join(filter(None, [title, f"at ${QUANTITIES['load'].latex}$ = {text}"])))
    axes.set_ylabel(MU_LABEL)
    scale_friction(axes, np.array(ends))
    bottom, top = (min(ends) / 2.0, max(ends) * 2.0) if is_log(np.array(ends)) else (0.0, max(ends) * 1.5)
    axes.set(xscale="log", xlim=(load / _AROUND, load * _AROUND), ylim=(bottom, top))
    finish(axes, legend=False, xlabel=label(data["load"]))
    handles = axes.get_legend_handles_labels()[0]
    handles = handles[-1:] + handles[:-1] if prediction is not None else handles
    figure.legend(handles=handles, loc="outside lower center", fontsize=8, frameon=False, ncols=2)
    return figure


def _within(x: np.ndarray, y: np.ndarray, low: float, high: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the part of a line between the loads `low` and `high`, with interpolated values at these loads.

    x, y: loads, in ascending order, and mu at each load. Points at which the load or mu is not positive are left out.
    """
    known = (x > 0.0) & (y > 0.0)
    x, y = x[known], y[known]
    if not x.size:
        return x, y
    ends = [end for end in (low, high) if x[0] < end < x[-1]]
    places = np.sort(np.concatenate([x[(x >= low) & (x <= high)], ends]))
    return places, np.exp(np.interp(np.log(places), np.log(x), np.log(y)))
