"""Words, units and looks that pictures have in common."""

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter

from stiction.quantities.table import QUANTITIES
from stiction.report.pictures import BLUE, GREEN, ORANGE, RED, SKY, InUnit, finish, label
from stiction.report.table import prefix
from stiction.surfaces.finding import methods

if TYPE_CHECKING:
    import xarray

COLOURS = (BLUE, RED, GREEN, ORANGE, SKY, "black")
_MARKERS = ("o", "s", "^", "D", "v", "P")


def along(axes: Axes, which: str, quantity: str, values: np.ndarray, log: bool = True, before: str = "") -> None:
    """Label and ticks of the "x" or "y" axis for values (n,) of a quantity, in SI, in a unit with a fitting prefix; logarithmic
    where they span a decade, unless that is not wanted."""
    row, axis = QUANTITIES[quantity], getattr(axes, f"{which}axis")
    seen = np.abs(values[np.isfinite(values)])
    if log and seen.size and values.min() > 0.0 and seen.max() > 9.0 * seen.min():
        getattr(axes, f"set_{which}scale")("log")
    factor, unit = prefix(quantity, float(seen.max(initial=0.0)))
    finish(axes)
    if row.unit and factor != 1.0:
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value * factor:.6g}"))
        if axis.get_scale() == "log":
            axis.set_minor_formatter(InUnit(factor))
    axis.set_label_text(f"{before}{row.short or row.meaning} ${row.latex}$" + (f" [{unit}]" if unit else ""))


def along_points(axes: Axes, points: "xarray.DataArray") -> None:
    """Label and scale the x axis for the points of a result: loads or separations, in SI or normalised."""
    values = points.values
    if points.attrs.get("units", "1") != "1":
        along(axes, "x", str(points.name), values)
        return
    if values.min() > 0.0 and values.max() > 9.0 * values.min():
        axes.set_xscale("log")
    axes.set_xlabel(label(points))
    finish(axes)


def look_of(method: str, at: int) -> dict[str, Any]:
    """Colour and mark of a method, the same in all pictures; of anything else, of its place among the lines."""
    known = list(methods())
    at = known.index(method) if method in known else at
    return {"color": COLOURS[at % len(COLOURS)], "marker": _MARKERS[at % len(_MARKERS)], "markersize": 5}


def plain(method: str) -> str:
    """What a method finds, in a few words; anything else as it is."""
    record = methods().get(method)
    return method.replace("_", " ") if record is None else record.label


def unit_for(quantity: str, largest: float) -> tuple[float, str]:
    """What values up to this one, in SI, are to be multiplied by, and the unit they then have."""
    if quantity == "asperity_density":
        return next(((per, unit) for per, unit in ((1e-12, "1/µm²"), (1e-6, "1/mm²")) if largest * per >= 0.1), (1.0, "1/m²"))
    return prefix(quantity, largest) if QUANTITIES[quantity].unit == "m" else (1.0, "")
