"""The picture of what is uncertain: the band of friction over load."""

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.quantities.table import QUANTITIES
from stiction.report.pictures import BLUE, WIDE, draw_band, finish, heading, label, say
from stiction.report.several_tables import points_dimension

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient"


def uncertainty_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """The friction coefficient over load with its band over what is uncertain."""
    figure = Figure(figsize=(7.0, 5.2), layout="constrained")
    _band(figure.subplots(), data)
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
