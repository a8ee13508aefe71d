"""Draw a cross-section of the mean touching asperity of a coated contact, and the stresses at the film interface."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, MultipleLocator

from stiction.quantities.shown import show
from stiction.report.pictures import BLUE, COLOUR_MAP, GREY, ORANGE, RED, add_titles, canvas, finish
from stiction.report.table import prefix, with_unit

if TYPE_CHECKING:
    import xarray

_LEVELS = 12


def film_figure(data: "xarray.Dataset", section: "xarray.Dataset", title: str = "") -> Figure:
    """Draw the stresses in a film under the mean touching asperity.

    Left panel: von Mises stress over the local yield stress in a cross-section. Right panel: normal and shear stress along the
    interface of film and body. data: result of `film_stresses` at one load or separation. section: result of `film_section` at
    the same load or separation.
    """
    figure, (left, right) = canvas(11.0, 4.6, 1, 2, width_ratios=(1.45, 1.0))
    _section_panel(figure, left, section)
    _interface_panel(right, section)
    yields = "; inside the red line it yields" if float(section["stress_over_yield"].max()) > 1.0 else ""
    # The titles stand above both panels, because matplotlib moves a panel of equal axes after placing its title.
    add_titles(figure, data, title, _sizes(data, section), f"left: elastic stresses{yields}")
    return figure


def _sizes(data: "xarray.Dataset", section: "xarray.Dataset") -> str:
    """Return a title line with the load, and contact radius, film thickness and mean pressure of the mean asperity."""
    used = section.attrs
    words = [f"load {with_unit(data['load'])}", f"a/t = {1.0 / used['thickness_over_radius']:.3g}"]
    if "mean_pressure" in used:
        lengths = (show(used[name], "mean_separation", 3) for name in ("contact_radius", "film_thickness"))
        words += [f"a = {next(lengths)}", f"t = {next(lengths)}", f"mean pressure {show(used['mean_pressure'], 'hardness', 3)}"]
    return "mean touching asperity: " + ", ".join(words)


def _section_panel(figure: Figure, axes: Axes, section: "xarray.Dataset") -> None:
    used, x, z = section.attrs, section["x"].values, section["z"].values
    field = section["stress_over_yield"].values
    levels = MaxNLocator(_LEVELS).tick_values(0.0, max(float(field.max()), 1e-12))
    drawn = axes.contourf(x, z, field, levels=levels, cmap=f"{COLOUR_MAP}_r")
    label = r"von Mises stress / yield stress $\sigma_\mathrm{M}/Y$"
    figure.colorbar(drawn, ax=axes, label=label, format="%.3g", location="bottom")
    if field.max() > 1.0:
        axes.contour(x, z, field, levels=[1.0], colors=RED, linewidths=1.5)
    axes.plot([-1.0, 1.0], [0.0, 0.0], color="black", linewidth=4.0, solid_capstyle="butt", label="contact", clip_on=False)
    if used["thickness_over_radius"] <= z[-1]:
        axes.axhline(used["thickness_over_radius"], color=ORANGE, linewidth=1.8, label="interface")
    text = f"largest: {used['largest']:.3g}, {'at' if used['where'] == 'interface' else 'in'} the {used['where']}"
    axes.plot(used["largest_x"], used["largest_z"], marker="X", color=RED, markeredgecolor="white", markersize=11,
              linestyle="none", label=text, clip_on=False)  # fmt: skip
    axes.set(xlim=(x[0], x[-1]), ylim=(z[-1], 0.0), aspect="equal", xlabel="$x/a$, along the tangential force",
             ylabel="depth $z/a$")  # fmt: skip
    axes.yaxis.set_major_locator(MultipleLocator(0.5))  # fixed ticks: labels of the same width at every size of the panel
    axes.legend(fontsize=8, loc="lower right", framealpha=0.9)


def _interface_panel(axes: Axes, section: "xarray.Dataset") -> None:
    x, normal, shear = (section[name].values for name in ("x", "interface_normal_stress", "interface_shear_stress"))
    in_si = section["interface_normal_stress"].attrs["units"] == "Pa"
    factor, unit = prefix("hardness", float(np.abs([normal, shear]).max())) if in_si else (1.0, "of the mean pressure")
    axes.plot(x, factor * normal, color=BLUE, label="normal stress, tension > 0")
    axes.plot(x, factor * shear, color=ORANGE, linestyle="--", label="shear stress along x")
    axes.axhline(0.0, color=GREY, linewidth=0.8)
    axes.set_xlabel("$x/a$, along the tangential force")
    finish(axes, xlim=(x[0], x[-1]), ylabel=f"stress at the interface [{unit}]")
