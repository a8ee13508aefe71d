"""Draw how friction and the height deviation, radius and density of asperities depend on the asperity method."""

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.quantities.errors import InputError
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.report.pictures import (
    GREY,
    METHOD_BAND,
    add_titles,
    canvas,
    finish,
    friction_panel,
    look_of,
    plain,
    say,
)
from stiction.report.table import prefix, unit_for
from stiction.solving.method_spread import METHOD

if TYPE_CHECKING:
    import xarray

# The panels of a resolution study: variable, quantity that names it, name for the axis.
_RESOLUTION_PANELS = (
    ("sigma", "asperity_height_deviation", "deviation of asperity heights"),
    ("R", "asperity_radius", "asperity radius"),
    ("N", "asperity_density", "asperities per area"),
    ("mu", "friction_coefficient", "static friction coefficient"),
)

# Style of the marks by the height distribution assumed for the asperities.
_DISTRIBUTIONS: dict[str, dict[str, Any]] = {
    "gaussian": {},
    "weibull": {"fillstyle": "left", "markerfacecoloralt": "white"},
    "empirical": {"markerfacecolor": "white"},
}
_HEIGHTS = {"gaussian": "Gaussian heights", "weibull": "Weibull heights", "empirical": "heights as found"}


_MOST_NOTES = 5  # largest number of notes on missing values below a picture


# ---- the resolution study


def resolution_figure(resolution_study: "xarray.Dataset", title: str = "") -> Figure:
    """Draw sigma, R, N and, if present, mu against the cutoff wavelength, with one line for each asperity method.

    resolution_study: dataset over (asperity_method, cutoff). Cutoff 0, the unfiltered map, is labelled "none" and drawn at the
    left. A line has a gap if its method has no value or friction is 0, and a note below the figure states the reason. Markers
    show which height distribution was used, because mu jumps where that distribution changes.
    """
    panels = [panel for panel in _RESOLUTION_PANELS if panel[0] in resolution_study]
    figure, grid = canvas(12, 8.6, 2, 2) if len(panels) > 3 else canvas(14, 4.8, 1, len(panels))
    for axes, panel in zip(grid, panels, strict=True):
        _resolution_panel(axes, resolution_study, *panel)
    if "mu" in resolution_study and "height_distribution" in resolution_study:
        _mark_distributions(grid[-1], resolution_study.sortby("cutoff"))
    # The legend has the title, because matplotlib would draw a figure title on top of the legend.
    title = title or ": ".join(
        filter(None, [resolution_study.attrs.get("title", ""), resolution_study.attrs.get("surface", "")])
    )
    look: dict[str, Any] = {
        "title": title,
        "title_fontsize": 11,
        "fontsize": 9,
        "frameon": False,
        "ncols": len(resolution_study[METHOD]),
    }
    figure.legend(*grid[0].get_legend_handles_labels(), loc="outside upper center", **look)
    if notes := _without_value(resolution_study, [variable for variable, _, _ in panels]):
        if len(notes) > _MOST_NOTES:
            more = f"and {len(notes) - _MOST_NOTES} more reasons, all listed in the variable `failure`"
            notes = [*notes[:_MOST_NOTES], more]
        text = "\n".join(line for note in notes for line in textwrap.wrap(note, int(16 * figure.get_figwidth())))
        figure.supxlabel(text, fontsize=8, color=GREY, x=0.01, ha="left")
    return figure


def _resolution_panel(axes: Axes, resolution_study: "xarray.Dataset", variable: str, quantity: str, name: str) -> None:
    table = resolution_study[variable].transpose(METHOD, "cutoff").values
    drawn = np.where(table > 0.0, table, np.nan)  # NaN stays NaN
    factor, unit = unit_for(quantity, float(np.max(drawn, initial=0.0, where=drawn > 0.0)))
    across, length = prefix("scan_size", float(resolution_study["cutoff"].max()))
    cutoffs = resolution_study["cutoff"].values * across
    places = _places(cutoffs)
    order = np.argsort(places)
    for number, (method, values) in enumerate(zip(resolution_study[METHOD].values, drawn * factor, strict=True)):
        axes.plot(places[order], values[order], label=plain(str(method)), **look_of(str(method), number))
    axes.set(xscale="log", xlabel=f"cutoff: shortest wavelength kept [{length}]")
    axes.set_ylabel(f"{name} ${QUANTITIES[quantity].latex}$" + (f" [{unit}]" if unit else ""))
    if np.isfinite(drawn).any():
        axes.set_yscale("log")
    else:
        say(axes, "no method gives a value")
    finish(axes, legend=False)
    labelled = _apart(places[order])
    names = {place: f"{cutoff:.3g}" if cutoff > 0.0 else "none" for place, cutoff in zip(places, cutoffs, strict=True)}
    axes.set_xticks(labelled, [names[place] for place in labelled])
    axes.set_xticks([], minor=True)


def _mark_distributions(axes: Axes, resolution_study: "xarray.Dataset") -> None:
    """Mark each point of the mu panel by the height distribution that was assumed for its asperities.

    axes: the panel, with one line for each asperity method. resolution_study: dataset with ascending cutoffs.
    """
    taken = resolution_study["height_distribution"].transpose(METHOD, "cutoff").values
    for line, names in zip(tuple(axes.lines), taken, strict=True):
        x, y = (np.asarray(values, dtype=float) for values in line.get_data())
        look: dict[str, Any] = {"color": line.get_color(), "marker": line.get_marker(), "markersize": line.get_markersize()}
        for name, marks in _DISTRIBUTIONS.items():
            axes.plot(np.where(names == name, x, np.nan), y, linestyle="", label=f"_{name}", **look, **marks)
    handles = [
        axes.plot([], [], "o", color=GREY, markersize=5, label=_HEIGHTS[name], **marks)[0]
        for name, marks in _DISTRIBUTIONS.items()
        if (taken == name).any()
    ]
    axes.legend(handles=handles, fontsize=8)


def _places(cutoffs: np.ndarray) -> np.ndarray:
    """Return the cutoff wavelengths to draw on a logarithmic axis; cutoff 0 becomes half the smallest other cutoff."""
    others = cutoffs[cutoffs > 0.0]
    return np.where(cutoffs > 0.0, cutoffs, 0.5 * others.min() if others.size else 1.0)


def _apart(places: np.ndarray) -> list[float]:
    """Return the values that are far enough apart on a logarithmic axis for their labels, including the first one.

    places: ascending values, > 0. The least distance is 0.13 of the length of the logarithmic axis.
    """
    logs = np.log(places / places[0])
    chosen = [0]
    for i in range(1, len(logs)):
        if logs[i] - logs[chosen[-1]] > 0.13 * logs[-1]:
            chosen.append(i)
    return [float(places[i]) for i in chosen]


def _without_value(resolution_study: "xarray.Dataset", variables: list[str]) -> list[str]:
    """Return one line for each reason why points are missing, with the affected asperity methods and cutoffs.

    variables: names of the results; a point is missing if any of them is NaN or not positive.
    """
    where: dict[str, list[str]] = {}
    for method in resolution_study[METHOD].values:
        results = resolution_study.sel({METHOD: method})
        reasons: dict[str, list[str]] = {}
        for cutoff in results["cutoff"].values:
            point = results.sel({"cutoff": cutoff})
            reason = str(point["failure"].item()) if "failure" in results else ""
            missing = [variable for variable in variables if not float(point[variable]) > 0.0]
            if missing:
                reason = reason or f"{', '.join(missing)}: 0 or none"
                reasons.setdefault(reason, []).append(show(cutoff, "mean_separation", 3) if cutoff > 0.0 else "none")
        for reason, cutoffs in reasons.items():
            cutoffs_text = "every cutoff" if len(cutoffs) == resolution_study.sizes["cutoff"] else ", ".join(cutoffs)
            where.setdefault(reason, []).append(f"{plain(str(method))} at {cutoffs_text}")
    return [f"Not drawn: {'; '.join(points)} ({reason})" for reason, points in where.items()]


# ---- friction


def method_spread_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """Draw friction against load for every method of finding asperities, with the range over the methods shaded.

    data: result of `solve` for a contact with scanned roughness, at one load or along one dimension. Its first method is the
    one that the result uses, and has a bold line. Raises InputError if the result has no friction by method.
    """
    if "friction_coefficient_by_method" not in data:
        raise InputError("friction_coefficient_by_method", None, "a result of a contact whose roughness was measured in scans")
    table = data["friction_coefficient_by_method"].transpose(METHOD, ...)
    (taken, *others), load = table[METHOD].values.tolist(), np.atleast_1d(data["load"].values)
    figure, (axes,) = canvas(9.6, 5.2)
    add_titles(figure, data, title)
    friction_panel(axes, data.drop_vars("friction_coefficient_quantile", errors="ignore"))
    for line, band in zip(axes.lines, axes.collections, strict=False):
        line.set(linewidth=2.4, marker="o" if load.size == 1 else "", label=f"used: {plain(taken)}", zorder=3)
        band.set_label(METHOD_BAND)
    floor = 0.0 if axes.get_yscale() == "log" else -np.inf
    for number, method in enumerate(others if axes.collections else (), 1):
        mu, text = np.atleast_1d(table.sel({METHOD: method}).values), plain(method)
        pressed = mu[load > 0.0]
        if np.isnan(pressed).any():
            text += "\n(carries no load)" if np.isnan(pressed).all() else "\n(does not carry every load)"
        elif (pressed <= floor).any():
            text += "\n(not drawn where mu = 0)"
        drawn = np.where((load > 0.0) & (mu > floor), mu, np.nan)
        axes.plot(load, drawn, linewidth=1.1, label=text, **(look_of(method, number) | {"markersize": 3.5}))
    if axes.collections:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, fontsize=9, frameon=False)
    return figure
