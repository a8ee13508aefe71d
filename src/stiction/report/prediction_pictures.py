"""The picture of a prediction: mu along the load with its interval, or its distribution at one load."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.report.answer import at_working_load, headline
from stiction.report.pictures import BLUE, MU_LABEL, RED, canvas, finish, friction_panel, sparse

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient"


def prediction_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """Return a figure of mu: a band along the load, or a histogram of the draws at one load."""
    figure, (axes,) = canvas(6.4, 4.2)
    (_band if data["load"].size > 1 else _histogram)(axes, data)
    if title:
        figure.suptitle(title, fontsize=11)
    return figure


def _band(axes: Axes, data: "xarray.Dataset") -> None:
    friction_panel(axes, data.sortby("load"))
    here = at_working_load(data)
    ends = [[float(here[_MU] - here[f"{_MU}_low"])], [float(here[f"{_MU}_high"] - here[_MU])]]
    axes.errorbar([float(here["load"])], [float(here[_MU])], ends, color=RED, marker="o", capsize=4, label=headline(data))
    finish(axes)


def _histogram(axes: Axes, data: "xarray.Dataset") -> None:
    here = at_working_load(data.isel(load=0) if data["load"].ndim else data)
    values = here[f"{_MU}_samples"].values
    values = values[np.isfinite(values) & (values > 0.0)]
    low, high = np.quantile(values, [0.005, 0.995])
    axes.hist(np.clip(values, low, high), bins=np.geomspace(low * 0.999, high * 1.001, 30).tolist(), color=BLUE, alpha=0.4)
    axes.set_xscale("log")
    for name in (f"{_MU}_low", _MU, f"{_MU}_high"):
        axes.axvline(float(here[name]), color=RED, linestyle="-" if name == _MU else "--")
    finish(axes, xlabel=MU_LABEL, ylabel=f"draws of {len(values)}", title=headline(data))
    sparse(axes)
