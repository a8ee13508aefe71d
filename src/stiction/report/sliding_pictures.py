"""Draw tangential force and dissipated energy against displacement, from rest to sliding."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.animation import PillowWriter
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from stiction.quantities.table import QUANTITIES
from stiction.report.pictures import COLOURS, NOT_PRESSED, add_titles, along, canvas, say
from stiction.report.table import with_unit

if TYPE_CHECKING:
    import xarray


def sliding_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """Draw tangential force over load against displacement, one line for each load or separation.

    data: result of `slide` with at most one dimension of loads or separations. Dotted lines mark the static friction
    coefficient. Dots mark the largest force. If sliding asperities keep their full strength, the dots mark 99 % of the largest
    force, and a second panel shows the energy lost in a cycle.
    """
    lost = "energy_loss" in data
    figure, panels = canvas(12.0 if lost else 7.0, 5.4, 1, 1 + lost)
    points = [dim for dim in data["tangential_force"].dims if dim != "displacement"]
    rows = [data.isel({points[0]: number}) for number in range(data.sizes[points[0]])] if points else [data]
    _forces(panels[0], rows)
    if lost:
        _losses(panels[1], rows)
    add_titles(figure, data, title)
    return figure


def write_animation(data: "xarray.Dataset", path: Path) -> None:
    """Write a GIF that shows which points of a height map stick or slide as the displacement grows.

    data: result of `slide` for a map. If it has more than one load, the largest is shown.
    """
    points = [dim for dim in data["tangential_force"].dims if dim != "displacement"]
    row = data.isel({points[0]: int(np.argmax(data["load"].values))}) if points else data
    figure, (left, right) = canvas(9.0, 4.4, 1, 2)
    shown = left.imshow(row["point_state"][0], cmap=ListedColormap(["white", COLOURS[0], COLOURS[1]]), vmin=0, vmax=2)
    left.set(xticks=[], yticks=[], title="blue: sticks, red: slides")
    _forces(right, [row])
    (dot,) = right.plot([], [], "o", color=COLOURS[1])
    moved, force = row["displacement"].values, row["tangential_force"].values / float(row["load"])
    writer = PillowWriter(fps=6)
    with writer.saving(figure, str(path), dpi=80):
        for step in range(moved.size):
            shown.set_data(row["point_state"][step])
            dot.set_data(moved[step : step + 1], force[step : step + 1])
            writer.grab_frame()


def _named(row: "xarray.Dataset") -> str:
    """Format the load of one row of a result, for the legend."""
    return f"${QUANTITIES['load'].latex}$ = {with_unit(row['load'], digits=3)}"


def _forces(axes: Axes, rows: list["xarray.Dataset"]) -> None:
    pressed = [row for row in rows if float(row["load"]) > 0.0]
    axes.set_ylabel("tangential force over load $F/P$")
    if not pressed:
        say(axes, NOT_PRESSED)
        return
    for number, row in enumerate(pressed):
        colour, load = COLOURS[number % len(COLOURS)], float(row["load"])
        axes.plot(row["displacement"], row["tangential_force"] / load, color=colour, label=_named(row))
        axes.axhline(float(row["friction_coefficient"]), color=colour, linestyle=":", linewidth=1.0)
        share = 0.99 if "energy_loss" in row else 1.0  # without weakening, the force approaches its limit and never reaches it
        axes.plot(row["sliding_displacement"], share * row["largest_friction_coefficient"], "o", color=colour, markersize=5)
    axes.plot([], [], ":", color="black", label="static friction coefficient $\\mu$")
    axes.plot([], [], "o", color="black", label="99 % of $\\mu$" if "energy_loss" in rows[0] else "largest")
    axes.set_ylim(bottom=0.0)
    along(axes, "x", "displacement", rows[0]["displacement"].values, log=False)


def _losses(axes: Axes, rows: list["xarray.Dataset"]) -> None:
    moved = rows[0]["displacement"].values > 0.0
    largest = np.zeros(1)
    for number, row in enumerate(rows):
        lost = row["energy_loss"].values[moved]
        largest = np.concatenate([largest, lost])
        axes.plot(row["displacement"].values[moved], lost, color=COLOURS[number % len(COLOURS)], label=_named(row))
    along(axes, "y", "energy_loss", largest[largest > 0.0])
    along(axes, "x", "displacement", rows[0]["displacement"].values[moved])
    axes.set_xlabel(f"amplitude: {axes.get_xlabel()}")
