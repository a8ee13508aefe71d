"""Draw a prediction (mu against load, or its distribution at one load), its sources of uncertainty and its validation."""

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.report.answer import at_working_load, ends_of_mu, headline
from stiction.report.pictures import BLUE, GREEN, MU_LABEL, RED, canvas, finish, friction_panel, label
from stiction.report.scales import LOG, is_log, scale_friction
from stiction.studies.prediction.uncertainty_sources import main_sources, part_name

if TYPE_CHECKING:
    import xarray

    from stiction.studies.prediction.measured import Measured

_MU = "friction_coefficient"


def prediction_figure(
    data: "xarray.Dataset", title: str = "", curve: "xarray.Dataset | None" = None, measured: "Measured | None" = None
) -> Figure:
    """Draw mu of a prediction with its interval against load; for a single load, draw a histogram of the samples of mu.

    data: result of `predict`. curve: prediction at loads around the single load of `data`; it is drawn in place of the
    histogram, and the single load is marked on it. measured: friction that the prediction uses, drawn with its standard errors.
    """
    figure, (axes,) = canvas(8.53, 4.8)
    _draw_mu(axes, data if curve is None else curve, data, measured)
    if title:
        figure.suptitle(title, fontsize=11)
    return figure


def answer_figure(data: "xarray.Dataset", prediction: "xarray.Dataset") -> Figure:
    """Draw mu against load with the prediction at its working load, or a histogram of the samples of mu.

    data: result of the model that the user named, or the curve of the prediction. prediction: result of `predict`. The
    histogram is drawn if `data` is a prediction at a single load, or has no friction.
    """
    figure, (axes,) = canvas(5.0, 3.4)
    _draw_mu(axes, data, prediction)
    for legend in figure.legends:
        legend.set_loc("outside upper center")  # the x axis is then as high as that of `sources_figure` beside it
    return figure


def _draw_mu(axes: Axes, data: "xarray.Dataset", prediction: "xarray.Dataset", measured: "Measured | None" = None) -> None:
    if _MU in data and (data is not prediction or data["load"].size > 1):
        _band(axes, data, prediction, measured)
    else:
        _histogram(axes, prediction)


def sources_figure(prediction: "xarray.Dataset") -> Figure:
    """Draw the interval of mu, and for each main source of uncertainty the interval that it would cause alone.

    prediction: result of `predict`.
    """
    figure, (axes,) = canvas(5.0, 3.4)
    sources_panel(axes, prediction)
    return figure


def validation_figure(data: "xarray.Dataset") -> Figure:
    """Draw measured friction next to the prediction at each load. data: result of `validate`."""
    figure, (axes,) = canvas(7.0, 4.4)
    validation_panel(axes, data)
    return figure


def validation_panel(axes: Axes, data: "xarray.Dataset") -> None:
    """Draw measured friction next to the predicted median with its 50 % (thick) and 90 % intervals.

    data: result of `validate`.
    """
    data = data.isel(row=np.flatnonzero(np.isfinite(data["prediction"].sel(quantile=0.5))))
    load, quantiles = data["load"].values, data["prediction"].transpose("quantile", "row").values
    axes.vlines(load, quantiles[0], quantiles[4], color=BLUE, linewidth=2, label="90 % interval")
    axes.vlines(load, quantiles[1], quantiles[3], color=BLUE, linewidth=8, alpha=0.5, label="50 % interval")
    axes.plot(load, quantiles[2], "o", color=BLUE, label="predicted")
    beside = load * 1.12  # a small shift keeps both visible
    axes.vlines(beside, data["measured_low"], data["measured_high"], color=RED, linewidth=5, label="measured")
    axes.plot(beside, data["measured"], "_", color=RED, markersize=9)
    axes.set(xscale="log", yscale="log", ylim=(None, 6.0 * quantiles.max()))  # room for the legend
    finish(axes, xlabel=label(data["load"]), ylabel=MU_LABEL + LOG, title=data.attrs["title"])
    axes.legend(fontsize=8, ncols=2, loc="upper center")


def sources_panel(axes: Axes, data: "xarray.Dataset") -> None:
    """Draw the interval of mu, and for each main source of uncertainty the interval that it would cause alone.

    The width of the interval of a source, in ln mu, is the width of the interval of mu, times the square root of the share of
    the variance that the source causes.
    """
    mu, low, high = ends_of_mu(data)
    shares = main_sources(data.attrs["shares"])
    sources = ((part_name(name) if name != "other" else "other sources", share) for name, share in shares)
    names = ["all together", *(f"{source} alone\n({share:.0%} of the variance)" for source, share in sources)]
    for row, share in enumerate([1.0, *(share for _, share in shares)]):
        ends = [[mu - mu * (low / mu) ** share**0.5], [mu * (high / mu) ** share**0.5 - mu]]
        axes.errorbar([mu], [row], xerr=ends, color=BLUE if row else RED, marker="o", capsize=5, linewidth=2.5)
    axes.set(ylim=(len(names) - 0.5, -0.5))
    axes.set_xlabel(MU_LABEL)
    scale_friction(axes, np.array([low, high]), "x")
    axes.set_yticks(range(len(names)), names, fontsize=9)
    finish(axes)


def _band(axes: Axes, data: "xarray.Dataset", prediction: "xarray.Dataset", measured: "Measured | None") -> None:
    """Draw friction against load, the prediction at its working load, measured friction, and a legend below the figure.

    data: result over loads, of `predict` or of one model. prediction: result of `predict`.
    """
    friction_panel(axes, data.sortby("load") if data["load"].ndim else data)
    mu, low, high = ends_of_mu(prediction)
    text, load = "prediction at the working load", float(at_working_load(prediction)["load"])
    axes.errorbar([load], [mu], [[mu - low], [high - mu]], color=RED, marker="o", capsize=4, label=text)
    if measured is not None:
        ends = np.abs(np.exp(measured.log_mu) - np.exp(measured.log_mu + np.multiply.outer([-1.0, 1.0], measured.error)))
        look: dict[str, Any] = {
            "color": GREEN,
            "linestyle": "",
            "marker": "s",
            "capsize": 3,
            "label": "measured, standard error",
        }
        axes.errorbar(measured.load, np.exp(measured.log_mu), ends, **look)
    axes.autoscale(axis="y")
    drawn = np.concatenate([line.get_ydata() for line in axes.lines])
    scale_friction(axes, np.concatenate([drawn[drawn > 0.0], [low, high]]))
    finish(axes, legend=False)
    if legend := axes.get_legend():
        legend.remove()
    handles, names = axes.get_legend_handles_labels()
    columns = 3 if len(names) <= 3 else 2
    axes.figure.legend(handles, names, loc="outside lower center", ncols=columns, frameon=False, fontsize=9)


def _histogram(axes: Axes, data: "xarray.Dataset") -> None:
    point = at_working_load(data.isel(load=0) if data["load"].ndim else data)
    values = point[f"{_MU}_samples"].values
    values = values[np.isfinite(values) & (values > 0.0)]
    low, high = np.quantile(values, [0.005, 0.995])
    spaced = np.geomspace if is_log(np.array([low, high])) else np.linspace
    axes.hist(np.clip(values, low, high), bins=spaced(low * 0.999, high * 1.001, 30).tolist(), color=BLUE, alpha=0.4)
    axes.set_xlabel(MU_LABEL)
    scale_friction(axes, np.array([low, high]), "x")
    for name in (f"{_MU}_low", _MU, f"{_MU}_high"):
        axes.axvline(float(point[name]), color=RED, linestyle="-" if name == _MU else "--")
    finish(axes, ylabel=f"number of {len(values)} samples", title=headline(data))
