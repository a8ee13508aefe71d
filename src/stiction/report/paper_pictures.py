"""Draw the figures of the 2015 paper on soft coatings, and the map of its claims."""

import re
import textwrap
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from stiction.quantities.table import QUANTITIES
from stiction.report.pictures import BLUE, MU_LABEL, RED, SKY, canvas, finish, label
from stiction.studies.paper.claims import CLAIMS, VARIANTS
from stiction.studies.paper.figures import in_words

if TYPE_CHECKING:
    import xarray

    from stiction.studies.paper.claims import ClaimMap
    from stiction.studies.paper.figures import PanelCurves

# Later lines are narrower or dashed, so that lines on top of each other stay visible.
_VARYING: tuple[dict[str, Any], ...] = (
    {"color": SKY, "linewidth": 4.0},
    {"color": RED, "linewidth": 2.2},
    {"color": BLUE, "linewidth": 1.6, "linestyle": "--"},
)


def panel_figure(curves: "PanelCurves") -> Figure:
    """Draw one figure of the 2015 paper: mu against normalised load for three films and for the uncoated surface.

    curves: normalised curves of the figure.
    """
    figure, (axes,) = canvas(7, 5.4)
    along = curves.panel.along
    _friction_line(axes, curves.bare, label="uncoated", color="black", linewidth=2.0)
    for value, look in zip(curves.panel.values, _VARYING, strict=False):
        curve = curves.coated.sel({along: value})
        _friction_line(axes, curve, label=f"${QUANTITIES[along].latex}$ = {value:g}", **look)
    axes.set_title(_with_letters(curves.caption))
    finish(axes, xscale="log", yscale="log", xlabel=label(curves.bare["load"]), ylabel=MU_LABEL)
    return figure


def _with_letters(text: str) -> str:
    """Replace the symbols of dimensionless groups in a text, such as lambda, by LaTeX formulas."""
    letters = {QUANTITIES[name].symbol: QUANTITIES[name].latex for name in ("theta", "lam", "n_E", "n_H", "tau")}
    return re.sub(rf"\b({'|'.join(letters)})\b", lambda match: f"${letters[match[0]]}$", text)


def _friction_line(axes: Axes, data: "xarray.Dataset", **look: Any) -> None:
    load, mu = data["load"].values, data["friction_coefficient"].values
    drawn = (load > 0.0) & (mu > 0.0)
    axes.plot(np.where(drawn, load, np.nan), np.where(drawn, mu, np.nan), **look)


def claims_figure(claims: "ClaimMap", point: Mapping[str, float]) -> Figure:
    """Draw where in the plane of the adhesion indices theta and lambda each claim of the 2015 paper holds.

    claims: for each claim, the fraction of its cases in which it holds, on a grid of theta and lambda. Columns of the figure
    are claims. Rows are variants of the model; the last row solves the film as an elastic layer. point: theta and lam of a
    contact, which a star marks.
    """
    figure = Figure(figsize=(3.1 * len(CLAIMS) + 0.8, 3.3 * len(VARIANTS)), layout="constrained")
    grid = figure.subplots(len(VARIANTS), len(CLAIMS), sharex=True, sharey=True, squeeze=False)
    colours = matplotlib.colormaps["viridis"]
    norm = BoundaryNorm(np.linspace(0.0, 1.0, 11), colours.N)
    for row, variant in enumerate(VARIANTS):
        for column, claim in enumerate(CLAIMS):
            axes = grid[row, column]
            share = np.ma.masked_invalid(claims.share[column, row].T)
            axes.pcolormesh(claims.theta, claims.lam, share, cmap=colours, norm=norm, shading="nearest")
            axes.set(xscale="log", yscale="log")
            for colour, style in (("white", "-"), ("black", "--")):  # two lines, to be seen on dark and on light colours
                axes.axvline(10.0, color=colour, linewidth=0.9, linestyle=style)
                axes.axhline(0.125, color=colour, linewidth=0.9, linestyle=style)
            axes.plot(point["theta"], point["lam"], marker="*", color=RED, markeredgecolor="white", markersize=12)
            if row == 0:
                axes.set_title(f"({claim.key}) {textwrap.fill(claim.says, 36)}", fontsize=9)
            if column == 0:
                axes.set_ylabel(f"{in_words(variant)}\nplastic adhesion index $\\lambda$")
            if row == len(VARIANTS) - 1:
                axes.set_xlabel(r"elastic adhesion index $\theta$")
    bar = figure.colorbar(ScalarMappable(norm, colours), ax=grid, shrink=0.8, pad=0.01)
    bar.set_label("fraction of the films for which the claim holds (white: not comparable)")
    figure.suptitle(
        "Where the claims of the 2015 paper hold; dashed: below $\\theta$ = 10 or $\\lambda$ = 0.125 adhesion matters; "
        f"star: $\\theta$ = {point['theta']:g}, $\\lambda$ = {point['lam']:g}",
        fontsize=10,
    )
    return figure
