"""Pictures of what is uncertain: the band of friction over load, and what friction differs by, a bar of three colours."""

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.quantities.table import QUANTITIES
from stiction.report.pictures import BLUE, GREEN, ORANGE, WIDE, draw_band, finish, heading, label, say
from stiction.report.several_tables import points_dimension
from stiction.report.uncertainty_tables import MEANINGS

if TYPE_CHECKING:
    import xarray

__all__ = ["spread_figure", "uncertainty_figure"]

# The three colours, of the inputs, the methods and the models.
COLOURS = dict(zip(MEANINGS, (BLUE, ORANGE, GREEN), strict=True))
_MU = "friction_coefficient"
_SEEN = 1.005  # a factor that is a bar, and no line


def uncertainty_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """The friction coefficient over load with its band over what is uncertain; and where they are known, beside it, what it
    differs by."""
    spreads = "spread_factor" in data
    figure = Figure(figsize=(12.5 if spreads else 7.0, 5.2), layout="constrained")
    places: Any = [["band", "spreads"], ["band", "factors"]] if spreads else [["band"]]
    panels = figure.subplot_mosaic(places, height_ratios=[3, 1] if spreads else None)
    _band(panels["band"], data)
    if spreads:
        _spreads(panels["spreads"], panels["factors"], data)
    figure.suptitle(heading(data, title), fontsize=11)
    return figure


def _band(axes: Axes, data: "xarray.Dataset") -> None:
    dim = points_dimension(data)
    x = data["load"].values
    band, error = data[f"{_MU}_quantile"].values, data[f"{_MU}_quantile_error"].values
    mu = data[_MU].values
    if dim is None:
        x, mu, band, error = np.atleast_1d(x), np.atleast_1d(mu), band[:, None], error[:, None]
    known = (x > 0.0) & (np.isfinite(band) & (band > 0.0)).all(axis=0) & (mu > 0.0)
    axes.set(xlabel=label(data["load"]), ylabel=f"static friction coefficient ${QUANTITIES[_MU].latex}$")
    if not known.any():
        say(axes, "not defined here:\nthere is no compressive load")
        return
    shares, x = data["quantile"].values, x[known]
    middle = len(shares) // 2
    for low, depth in zip(range(middle), np.linspace(0.2, 0.4, middle), strict=True):
        high = len(shares) - 1 - low
        text = f"{shares[low]:.0%} to {shares[high]:.0%}"
        draw_band(axes, x, band[low][known], band[high][known], color=BLUE, alpha=depth, label=text)
    axes.plot(
        x, band[middle][known], color=BLUE, linestyle="--", marker="_" if x.size == 1 else "", markersize=14, label="median"
    )
    marks: dict[str, Any] = {"marker": "o", "markersize": 4.0} if x.size <= 20 else {}
    axes.plot(x, mu[known], color="black", label="of the nominal numbers", **marks)
    for at in (0, -1):
        bars = axes.errorbar(x, band[at][known], 2.0 * error[at][known], linestyle="", color=BLUE, elinewidth=0.8)
        if at == 0:
            bars.set_label("two standard errors of the sampling")
    _scales(axes, x, np.concatenate([band[:, known].ravel(), mu[known]]))
    axes.legend(fontsize=8, framealpha=0.9)


def _scales(axes: Axes, x: np.ndarray, values: np.ndarray) -> None:
    axes.set_xscale("log")
    if values.max() > WIDE / 10.0 * values.min():
        axes.set_yscale("log")
    else:
        axes.set_ylim(0.0, 1.08 * values.max())
    if x.size == 1:
        axes.set_xlim(x[0] / 2.0, x[0] * 2.0)
    finish(axes)


def spread_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """What friction at the working load differs by, each apart: from where to where, and one bar of three colours."""
    figure = Figure(figsize=(7.5, 4.6), layout="constrained")
    above, below = figure.subplots(2, 1, height_ratios=[3, 1])
    _spreads(above, below, data)
    figure.suptitle(title or "How far may this friction be trusted?", fontsize=11)
    return figure


def _spreads(axes: Axes, below: Axes, data: "xarray.Dataset") -> None:
    """Bars from low to high, one below the other, on an axis of mu; and below them one bar of three colours, of the factors."""
    told = {str(name): data.sel(spread=name) for name in data["spread"].values}
    known = {name: one for name, one in told.items() if np.isfinite(float(one["spread_factor"]))}
    axes.set_xlabel(f"static friction coefficient ${QUANTITIES[_MU].latex}$ at the working load")
    if not known:
        say(axes, "nothing is uncertain")
        below.set_axis_off()
        return
    for at, (name, one) in enumerate(known.items()):
        low, high = float(one["spread_low"]), float(one["spread_high"])
        axes.barh(-at, high - low, left=low, height=0.4, color=COLOURS[name])
        text = f"{MEANINGS[name]}: {low:.3g} to {high:.3g}"
        if _none(high / low):  # a bar of no width is seen by nobody
            axes.plot(low, -at, marker="D", color=COLOURS[name], markersize=9, linestyle="none")
            text = f"{MEANINGS[name]}: {low:.3g}, {'one opinion' if name == 'models' else 'no difference'}"
        axes.annotate(text, (0.02, -at + 0.24), xycoords=("axes fraction", "data"), fontsize=8, va="bottom")
    nominal = float(data.attrs["spread_around"])
    axes.axvline(nominal, color="black", linewidth=1.0)
    ends = [nominal, *(float(one[f"spread_{end}"]) for one in known.values() for end in ("low", "high"))]
    axes.set(xscale="log", xlim=(min(ends) / 1.2, max(ends) * 1.2), ylim=(0.4 - len(known), 0.7), yticks=[])
    _factors(below, {name: float(one["spread_factor"]) for name, one in known.items()})
    for panel in (axes, below):
        finish(panel)
        panel.grid(False, axis="y")


def _none(factor: float) -> bool:
    """Whether a factor is none that could be seen."""
    return factor < _SEEN


def _factors(axes: Axes, factors: dict[str, float]) -> None:
    """One bar: the factors one after another, each as long as its logarithm."""
    left = 1.0
    for name, factor in factors.items():
        axes.barh(0.0, left * (factor - 1.0), left=left, height=0.6, color=COLOURS[name], label=f"{name}: {factor:.3g}")
        left *= factor
    if _none(left):
        axes.text(0.5, 0.25, "no difference: a factor of 1", transform=axes.transAxes, ha="center", va="center", fontsize=8)
    axes.set(xscale="log", xlim=(1.0, max(1.1 * left, 1.2)), ylim=(-0.5, 1.2), yticks=[])
    axes.set_xlabel("by what factor it differs, one after another")
    axes.legend(fontsize=8, ncols=3, loc="upper left", framealpha=0.9)
