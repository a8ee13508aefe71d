"""The picture of a comparison: friction coefficient against load of every model, families apart."""

import textwrap
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from stiction.quantities.table import QUANTITIES
from stiction.report.families import with_plastic_junctions
from stiction.report.pictures import GREY, finish, label, say

if TYPE_CHECKING:
    import xarray

__all__ = ["comparison_figure"]

# Of `doubtful`: as the model claims, and outside of its range; beyond that a curve is not drawn.
_WITHIN, _DOUBTFUL = 0, 1
_DASHES = ("-", "--", ":", "-.")  # beyond this many lines colours repeat, with another dash
_NEAR = 1e3  # as many times beyond the loads of the case a working load is still shown
_APART = 0.034  # of the height of a panel, between the names at the ends of its curves


def comparison_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """Friction coefficient against load of every model of a comparison: a panel for each family, faint where a model is outside
    its validity, ended where what it says cannot be so, named at the right end. The recommended one is black and thick; the
    legend says why. The loads are those of the case where these are known."""
    families = [name for name in dict.fromkeys(data["family_of_curve"].values.tolist()) if name and _any_drawn(data, name)]
    families.sort(key=lambda name: name != data.attrs.get("family"))  # the family of the recommended one first
    figure = Figure(figsize=(8.4 + 6.0 * (len(families) > 1), 7.4), layout="constrained")
    panels = np.atleast_1d(figure.subplots(1, max(len(families), 1), sharey=True)).tolist()
    for axes, family in zip(panels, families, strict=False):
        _panel(axes, data, family)
    if not families:
        say(panels[0], "no model says anything of friction here:\ngive the contact an interfacial_shear_strength")
        panels[0].set(xscale="log", yscale="log", xlabel=label(data["load"]))
    panels[0].set_ylabel(f"static friction coefficient ${QUANTITIES['friction_coefficient'].latex}$")
    figure.suptitle(title or "Static friction after every applicable model", fontsize=11)
    _in_sight(panels, data)
    for axes in panels:
        finish(axes)
    for axes, family in zip(panels, families, strict=False):
        _mark_working_load(axes, data, family)
    for axes in panels:
        _name_ends(axes)  # last: an error bar may have changed what is in sight
    _legend(figure, panels[0], data)
    return figure


def _any_drawn(data: "xarray.Dataset", family: str) -> bool:
    some = data.isel(model=np.flatnonzero(data["family_of_curve"].values == family))
    return bool((np.nan_to_num(some["friction_coefficient"].values) > 0.0).any())


def _panel(axes: Axes, data: "xarray.Dataset", family: str) -> None:
    """The curves of one family; where its models do not agree what plastic junctions resist, their names say it."""
    from matplotlib.colors import TABLEAU_COLORS

    colours, drawn = list(TABLEAU_COLORS.values()), 0
    some = data.isel(model=np.flatnonzero(data["family_of_curve"].values == family))
    for at, name in enumerate(with_plastic_junctions(some)):
        one = some.isel(model=at)
        best = one["model"].item() == data.attrs.get("recommended")
        dashes = "-" if best else _DASHES[drawn // 10 % 4]  # a gap of the recommended curve may lie at the working load
        look = {"color": "black" if best else colours[drawn % 10], "linestyle": dashes}
        drawn += _curve(axes, one, label=name, linewidth=3.0 if best else 1.5, zorder=3 if best else 2, **look)
    axes.set(xscale="log", yscale="log", xlabel=label(data["load"]))
    axes.set_title(family, fontsize=9.5)


def _curve(axes: Axes, one: "xarray.Dataset", **look: Any) -> bool:
    """One model: faint all along what may be, and over it as it is where it is within its validity."""
    load, mu, doubtful = (one[name].values for name in ("load", "friction_coefficient", "doubtful"))
    shown = (load > 0.0) & (np.nan_to_num(mu) > 0.0) & (doubtful <= _DOUBTFUL)
    if not shown.any():
        return False
    within = shown & (doubtful == _WITHIN)
    axes.plot(np.where(shown, load, np.nan), np.where(shown, mu, np.nan), **look, alpha=0.35)
    axes.plot(np.where(within, load, np.nan), np.where(within, mu, np.nan), **(look | {"label": f"_{look['label']}"}))
    return True


def _in_sight(panels: list[Axes], data: "xarray.Dataset") -> None:
    """The loads of the case and what is near to them; of a comparison without, not more than eight decades. Not more than five
    decades of friction."""
    lines = [np.asarray(line.get_data(), dtype=float) for axes in panels for line in axes.lines]
    if not lines:
        return
    x, y = np.concatenate(lines, axis=1)
    x, y = x[np.isfinite(y)], y[np.isfinite(y)]
    asked = [load for load in np.atleast_1d(data.attrs.get("case_loads", [])) if load > 0.0]
    low, high = (min(asked) / 3.0, max(asked) * 3.0) if asked else (max(x.min() / 1.5, x.max() / 1e8), x.max() * 1.5)
    working = data.attrs.get("working_load", low)
    if low / _NEAR < working < high * _NEAR:
        low, high = min(low, working / 3.0), max(high, working * 3.0)
    seen = (x >= low) & (x <= high)
    for axes in panels:
        axes.set_xlim(low, high)
    if seen.any():
        top = y[seen].max()
        panels[0].set_ylim(max(y[seen].min() / 1.5, top / 1e5), top * 1.5)


def _name_ends(axes: Axes) -> None:
    """The name of every curve at the right of the panel, at its last point in sight, so far apart that they can be read."""
    left, right = axes.get_xlim()
    bottom, top = np.log(axes.get_ylim())
    ends = []
    for line in axes.lines:
        if str(line.get_label()).startswith("_"):
            continue
        x, y = (np.asarray(values, dtype=float) for values in line.get_data())
        seen = np.flatnonzero(np.isfinite(y) & (x >= left) & (x <= right) & (y >= np.exp(bottom)))
        if seen.size:
            at = seen[np.argmax(x[seen])]
            ends.append(((np.log(y[at]) - bottom) / (top - bottom), x[at], y[at], line))
    ends.sort(key=lambda end: end[0])
    for place, (_, x, y, line) in zip(_spread([end[0] for end in ends]), ends, strict=True):
        axes.annotate(
            str(line.get_label()), (x, y), xytext=(1.02, place), textcoords="axes fraction", va="center", fontsize=7.5,
            color=line.get_color(), weight="bold" if line.get_linewidth() > 2.0 else "normal",
            arrowprops={"arrowstyle": "-", "relpos": (0.0, 0.5), "color": line.get_color(), "linewidth": 0.5, "alpha": 0.6},
            annotation_clip=False,
        )  # fmt: skip


def _spread(places: list[float]) -> list[float]:
    """The ascending places, moved apart to _APART, and down again where they would leave the panel."""
    found = [min(max(place, 0.0), 1.0) for place in places]
    for at in range(1, len(found)):
        found[at] = max(found[at], found[at - 1] + _APART)
    over = found[-1] - 1.0 if found else 0.0
    if over > 0.0:
        found[-1] -= over
        for at in range(len(found) - 2, -1, -1):
            found[at] = min(found[at], found[at + 1] - _APART)
    assert all(high - low > 0.9 * _APART for low, high in pairwise(found))
    return found


def _mark_working_load(axes: Axes, data: "xarray.Dataset", family: str) -> None:
    """Mark the working load by a line, and on it mu of the recommended model, with its error bar, whether or not its curve
    reaches there."""
    load = data.attrs.get("working_load")
    low, high = axes.get_xlim()
    if load is None or not low < load < high:
        return
    axes.axvline(load, color=GREY, linestyle="--", linewidth=1.0)
    axes.annotate("working load", (load, 0.01), xycoords=("data", "axes fraction"), rotation=90,
                  color=GREY, fontsize=8, ha="right", va="bottom")  # fmt: skip
    if family == data.attrs.get("family"):
        _point(axes, data)
        _error_bar(axes, data)


def _point(axes: Axes, data: "xarray.Dataset") -> None:
    if data.attrs["recommended"] not in data["model"]:
        return
    mu = float(data["friction_coefficient_at_load"].sel(model=data.attrs["recommended"]))
    if mu > 0.0:
        axes.plot([data.attrs["working_load"]], [mu], "ko", markersize=7, zorder=4, label="_recommended")
        bottom, top = axes.get_ylim()
        axes.set_ylim(min(bottom, mu / 1.5), max(top, 1.5 * mu))


def _error_bar(axes: Axes, data: "xarray.Dataset") -> None:
    """Spread of the recommended model over the methods of finding asperities, at the working load, if there is one."""
    best = data.attrs["recommended"]
    if "friction_coefficient_at_load_low" not in data or best not in data["model"]:
        return
    mu, low, high = (float(data[f"friction_coefficient_at_load{end}"].sel(model=best)) for end in ("", "_low", "_high"))
    if np.isfinite([mu, low, high]).all():
        reach = [[mu - low], [high - mu]]
        label = f"over methods of finding asperities:\n{low:.3g} to {high:.3g}"
        axes.errorbar([data.attrs["working_load"]], [mu], yerr=reach, fmt="ko", capsize=6, linewidth=2.0, label=label)
        bottom, top = axes.get_ylim()
        axes.set_ylim(min(bottom, max(low / 1.5, bottom * 1e-3)), max(top, 1.5 * high))


def _legend(figure: Figure, axes: Axes, data: "xarray.Dataset") -> None:
    """What black and faint mean, and why the recommended one is; below the picture."""
    handles: list[Any] = [Line2D([], [], color=GREY, alpha=0.35), Line2D([], [], color=GREY)]
    said = ["outside of its validity; ended where it cannot be so", "within its validity"]
    if "working_load" in data.attrs:
        best = data.attrs["recommended"]
        handles.append(Line2D([], [], color="black", linewidth=3.0 if best in data["model"] else 0.0))
        said.append(
            "\n".join(
                textwrap.wrap(f"recommended: {best}{_mu_of(data)}; {data.attrs['reason']}", int(14 * figure.get_figwidth()))
            )
        )
    bars, names = axes.get_legend_handles_labels()
    extra = [(bar, name) for bar, name in zip(bars, names, strict=True) if name.startswith("over methods")]
    handles, said = handles + [bar for bar, _ in extra], said + [name for _, name in extra]
    figure.legend(handles, said, loc="outside lower left", fontsize=8, frameon=False)


def _mu_of(data: "xarray.Dataset") -> str:
    if data.attrs["recommended"] not in data["model"]:
        return f" ({data.attrs['advice']})" if data.attrs["advice"] else ""
    mu = float(data["friction_coefficient_at_load"].sel(model=data.attrs["recommended"]))
    low, high = data.attrs["recommended_range"]
    return f", $\\mu$ = {mu:.3g}, two thirds of the weight from {low:.3g} to {high:.3g}"
