"""The picture of a prediction: mu along the load with its interval, or its distribution at one load."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.report.answer import at_working_load, headline
from stiction.report.pictures import BLUE, RED, WIDE, finish, sparse

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient"


def prediction_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """Return a figure of mu: a band along the load, or a histogram of the draws at one load."""
    figure = Figure(figsize=(6.4, 4.2), layout="constrained")
    axes = figure.subplots()
    (_band if data["load"].size > 1 else _histogram)(axes, data)
    if title:
        figure.suptitle(title, fontsize=11)
    return figure


def _band(axes: Axes, data: "xarray.Dataset") -> None:
    ordered = data.sortby("load")
    load, here = ordered["load"].values, at_working_load(data)
    low, middle, high = (ordered[f"{_MU}{end}"].values for end in ("_low", "", "_high"))
    axes.fill_between(load, low, high, color=BLUE, alpha=0.2, linewidth=0, label=f"{data.attrs['level']:.0%} interval")
    axes.plot(load, middle, color=BLUE, label="median")
    ends = [[float(here[_MU] - here[f"{_MU}_low"])], [float(here[f"{_MU}_high"] - here[_MU])]]
    axes.errorbar([float(here["load"])], [float(here[_MU])], ends, color=RED, marker="o", capsize=4, label=headline(data))
    if load[-1] > 10.0 * load[0]:
        axes.set_xscale("log")
    if np.nanmax(high) > 0.1 * WIDE * np.nanmin(low):
        axes.set_yscale("log")
    else:
        axes.set_ylim(bottom=0.0)
    finish(axes)
    axes.set_xlabel("load [N]")
    axes.set_ylabel("static friction coefficient")
    axes.legend(frameon=False, fontsize=9)


def _histogram(axes: Axes, data: "xarray.Dataset") -> None:
    here = at_working_load(data.isel(load=0) if data["load"].ndim else data)
    values = here[f"{_MU}_samples"].values
    values = values[np.isfinite(values) & (values > 0.0)]
    low, high = np.quantile(values, [0.005, 0.995])
    axes.hist(np.clip(values, low, high), bins=np.geomspace(low * 0.999, high * 1.001, 30).tolist(), color=BLUE, alpha=0.4)
    axes.set_xscale("log")
    sparse(axes)
    for name in (f"{_MU}_low", _MU, f"{_MU}_high"):
        axes.axvline(float(here[name]), color=RED, linestyle="-" if name == _MU else "--")
    axes.set_xlabel("static friction coefficient")
    axes.set_ylabel(f"draws of {len(values)}")
    axes.set_title(headline(data), fontsize=10)
