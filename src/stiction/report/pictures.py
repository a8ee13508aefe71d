"""Draw datasets as matplotlib figures, without computing results or changing global state."""

import math
import re
import textwrap
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import Formatter, LogLocator, NullFormatter, NullLocator

from stiction.laws.validity import warnings_of
from stiction.quantities.table import QUANTITIES
from stiction.report.files import unit_of
from stiction.report.html_words import letters
from stiction.report.scales import FEW_DECADES, is_log, scale_friction
from stiction.report.table import prefix
from stiction.solving.choice import RECOMMENDED
from stiction.surfaces.finding import methods

if TYPE_CHECKING:
    import xarray


# Okabe and Ito's colours, which colour-blind readers can distinguish.
BLUE, ORANGE, GREEN, RED, SKY, GREY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#777777"
COLOURS = (BLUE, RED, GREEN, ORANGE, SKY, "black")
COLOUR_MAP = "viridis"
_MARKERS = ("o", "s", "^", "D", "v", "P")
# The lines of the panels of a curve: label and look. A part that a model does not have is left out. Parts that lie on one
# another or on the total stay visible: the total is a broad band beneath, and the bodies have markers.
_PARTS: dict[str, tuple[str, dict[str, Any]]] = {
    "": ("total", {"color": "black", "linewidth": 5.0, "alpha": 0.3}),
    "_elastic": ("elastic asperities", {"color": BLUE, "linestyle": "--"}),
    "_elastic_plastic": ("elastic-plastic asperities", {"color": GREEN, "linestyle": "-."}),
    "_plastic": ("plastic asperities", {"color": RED, "linestyle": "-"}),
    "_slip_limited": ("slip before they yield", {"color": BLUE, "linestyle": "--"}),
    "_yield_limited": ("yield before they slip", {"color": RED, "linestyle": "-"}),
    "_film": ("film", {"color": ORANGE, "marker": "o", "markersize": 4.5, "markevery": 0.06, "linewidth": 0.8}),
    "_substrate": ("substrate", {"color": GREEN, "marker": "s", "markersize": 4.5, "markevery": 0.06, "linewidth": 0.8}),
}
# The panels of a curve: quantity along y, quantity along x.
_PANELS = (
    ("friction_coefficient", "load"), ("contact_area", "load"), ("load", "mean_separation"), ("friction_force", "load"),
)  # fmt: skip
_LEAST = 1e-6  # fraction of a panel's largest value below which parts are not drawn, so that the axis shows the others
_ONE = "1\\cdot "  # mantissa that is left out before a power of ten
_MANY_DECADES = 3e5  # ratio of the ends of a logarithmic axis above which its ticks are powers of ten
_LEAST_SPAN = 1e-2  # smallest range of a linear axis, over its largest value
_FEW_POINTS = 20  # largest number of points of a curve that are all marked
_MOST_WARNINGS = 5  # largest number of warnings below a picture
_MU = "friction_coefficient"
NOT_PRESSED = "no compressive load:\nmu is not defined"
METHOD_BAND = "range over methods of\nfinding asperities"
MU_LABEL = f"static friction coefficient ${QUANTITIES['friction_coefficient'].latex}$"


def label(variable: "xarray.DataArray", longest: int = 200) -> str:
    """Return the axis label of a variable: meaning, symbol and unit.

    longest: largest number of characters of a label whose unit stays on the same line.
    """
    name = str(variable.name).rpartition(".")[2]  # "hardness" of "first.hardness"
    meaning = variable.attrs.get("comment", variable.attrs.get("long_name", name)).partition(",")[0].partition(" (from")[0]
    symbol = f" ${QUANTITIES[name].latex}$" if name in QUANTITIES else ""
    unit = _unit(variable)
    space = "\n" if len(f"{meaning} {unit_of(variable)}") > longest else " "
    return f"{meaning}{symbol}" + (f"{space}[{unit}]" if unit else "")


def _unit(variable: "xarray.DataArray") -> str:
    """Return the unit of a variable as text for matplotlib; a divisor that contains sigma becomes a LaTeX formula."""
    unit = unit_of(variable).replace("m^2", "m²")
    formula, per, rest = unit.partition(" per ")
    if "sigma" not in formula:
        return unit
    formula = re.sub(r"\^\((.*?)\)", r"^{\1}", formula)
    formula = re.sub(r"\b(sigma|pi)\b", r"\\\1", formula)
    return f"${formula}${per}{rest}"


def curve_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """Draw one curve: friction coefficient, contact area and friction force against load, and load against separation.

    data: result of `solve` with one dimension. Panels without data are omitted.
    """
    drawn = panels(data)
    rows, columns = (2, 2) if len(drawn) == 4 else (1, len(drawn))
    width, height = max(5.5 * columns, 8.0), 8.2 if rows == 2 else 4.6
    # Fixed margins: matplotlib's automatic layouts draw everything twice, and this picture is made on every run.
    notes = warnings_below(data, int(14.5 * width))
    below = 0.16 * len(notes)  # inches added to the figure for the warnings
    figure = Figure(figsize=(width, height + below))
    figure.suptitle(heading(data, title), fontsize=11)
    if notes:
        figure.text(0.01, 0.06 / (height + below), "\n".join(notes), fontsize=8, color=RED, va="bottom")
    edge, beside = (1.0 if rows == 2 else 0.6), width / 11.0  # texts take a larger fraction of a figure with one row or column
    room = height / (height + below)
    bottom = (below + 0.07 / edge * height) / (height + below)
    figure.subplots_adjust(0.085 / beside, bottom, 1.0 - 0.015 / beside, 1.0 - 0.085 / edge * room, wspace=0.24, hspace=0.22)
    for axes, (what, against) in zip(figure.subplots(rows, columns, squeeze=False).flat, drawn, strict=True):
        _draw_panel(axes, data, what, against)
    return figure


def panels(data: "xarray.Dataset") -> list[tuple[str, str]]:
    """Return the panels for which a curve has data, as pairs (y quantity, x quantity)."""
    return [names for names in _PANELS if all(name in data for name in names)]


def panel_of_curve(data: "xarray.Dataset", what: str, against: str) -> Figure:
    """Draw one panel of a curve as a separate figure.

    what, against: names of the variables along y and along x.
    """
    figure, (axes,) = canvas(5.2, 3.9)
    _draw_panel(axes, data, what, against)
    return figure


def uncertainty_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """Draw the friction coefficient of one model against load, with its quantiles over the uncertain inputs as a band."""
    figure, (axes,) = canvas(7.0, 5.2)
    friction_panel(axes, data)
    figure.suptitle(heading(data, title), fontsize=11)
    return figure


def _draw_panel(axes: Axes, data: "xarray.Dataset", what: str, against: str) -> None:
    if what == _MU:
        friction_panel(axes, data)
    else:
        _parts_panel(axes, data, what, against)


def heading(data: "xarray.Dataset", title: str) -> str:
    used = data.attrs
    words = [
        "prediction" if used["model"] == RECOMMENDED else used["model"],
        *(f"{used[name]} {name}" for name in ("variant", "branch") if name in used),
    ]
    if used.get("film", "none") != "none":
        words.append(f"film: {used['film']}")
    grade = f" (grade {used['grade']})" if "grade" in used else ""  # a prediction has none
    return "\n".join(filter(None, [title, f"{', '.join(words)}{grade}"]))


def add_titles(figure: Figure, data: "xarray.Dataset", title: str, *more: str) -> None:
    """Write title lines above a figure and the validity warnings of a result below it, and enlarge the figure for them.

    title: first line. more: further lines below the line on model and grade.
    """
    figure.suptitle("\n".join([heading(data, title), *more]), fontsize=11)
    if notes := warnings_below(data, int(14.0 * figure.get_figwidth())):
        figure.set_figheight(figure.get_figheight() + 0.16 * len(notes))
        figure.supxlabel("\n".join(notes), fontsize=8, color=RED, x=0.01, ha="left")


def warnings_below(data: "xarray.Dataset", width: int) -> list[str]:
    """Return the validity warnings of a result as lines of at most `width` characters, for the foot of a figure."""
    warnings = [letters(str(warning)) for warning in warnings_of(data)]
    if not warnings:
        return []
    more = len(warnings) - _MOST_WARNINGS
    lines = [
        *warnings[:_MOST_WARNINGS],
        *([f"and {more} more validity warnings, all listed in the attribute outside_validity"] if more > 0 else []),
    ]
    return [
        "outside the range of validity:",
        *(line for text in lines for line in textwrap.wrap(text, width, subsequent_indent="  ")),
    ]


def _marked(count: int) -> dict[str, Any]:
    """Return line properties that mark the computed points of a line of `count` points; {} for more than twenty points."""
    return {"marker": "o", "markersize": 4.0} if count <= _FEW_POINTS else {}


def friction_panel(axes: Axes, data: "xarray.Dataset") -> None:
    """Draw friction against load in one panel, with all bands that the result has.

    A band is the prediction interval, the range over asperity methods, or a range of quantiles over the uncertain inputs.
    """
    load, mu = (np.atleast_1d(data[name].values) for name in ("load", _MU))
    axes.set_ylabel(MU_LABEL)
    drawn = (load > 0.0) & (mu > 0.0)
    text = "median" if "level" in data.attrs else "at nominal inputs" if f"{_MU}_quantile" in data else ""
    seen = [mu[drawn]]
    for low, high, look in _friction_bands(data):
        there = (load > 0.0) & (high > 0.0) & np.isfinite(low)
        if there.any():
            # Where friction may be 0 the band reaches down to the edge of a logarithmic axis.
            low = np.maximum(low[there], np.concatenate([low[there & (low > 0.0)], high[there]]).min() / 2.0)
            draw_band(axes, load[there], low, high[there], **look)
            seen += [low, high[there]]
    if f"{_MU}_quantile" in data:
        _quantiles(axes, data, load)
    axes.plot(load[drawn], mu[drawn], color="black", label=text, **_marked(int(drawn.sum())))
    if drawn.any():
        axes.set_xscale("log")
        scale_friction(axes, np.concatenate(seen))
        if axes.get_yscale() == "log":
            _slopes(axes, load[drawn], mu[drawn])
        if load.size == 1:
            axes.set_xlim(load[0] / 3.0, load[0] * 3.0)
    else:
        say(axes, NOT_PRESSED)
    finish(axes, xlabel=label(data["load"]))
    if (entries := len(axes.get_legend_handles_labels()[0])) > 2:  # a large legend would cover the band
        bottom, top = axes.get_ylim()
        share = 0.08 * entries
        axes.set_ylim(bottom, top * (top / bottom) ** share if axes.get_yscale() == "log" else top + share * (top - bottom))


def _slopes(axes: Axes, load: np.ndarray, mu: np.ndarray) -> None:
    """Draw reference lines with the slopes of an elastic sphere (-1/3) and of Amontons' law (0).

    They are drawn only if mu varies at least 2-fold and the load at least 1000-fold.
    """
    if load.size < 3 or mu.max() < 2.0 * mu.min() or load.max() < 1e3 * load.min():
        return
    middle = int(np.argsort(load)[load.size // 2])
    for slope, text, style in ((-1.0 / 3.0, "slope -1/3, an elastic sphere", "--"), (0.0, "slope 0, Amontons", ":")):
        ends = np.array([load.min(), load.max()])
        axes.plot(ends, mu[middle] * (ends / load[middle]) ** slope, color=GREY, linestyle=style, linewidth=1.0, label=text)


def _quantiles(axes: Axes, data: "xarray.Dataset", load: np.ndarray) -> None:
    """Draw the median of mu over the uncertain inputs, and error bars of two standard errors at the outer quantiles."""
    band, error = (data[f"{_MU}_quantile{end}"].values.reshape(-1, load.size) for end in ("", "_error"))
    known = (load > 0.0) & (band > 0.0).all(axis=0)
    look: dict[str, Any] = {"marker": "_", "markersize": 14} if load.size == 1 else {}
    axes.plot(load[known], band[len(band) // 2, known], color=BLUE, linestyle="--", label="median", **look)
    for place, text in ((0, "two standard errors of the sampling"), (-1, None)):
        ends = 2.0 * error[place, known]
        axes.errorbar(load[known], band[place, known], ends, linestyle="", color=BLUE, elinewidth=0.8, label=text)


def draw_band(axes: Axes, x: np.ndarray, low: np.ndarray, high: np.ndarray, **look: Any) -> None:
    """Fill the area between two curves; draw a bar if there is only one point."""
    if len(x) == 1:
        axes.vlines(x, low, high, linewidth=14.0, **look)
    else:
        axes.fill_between(x, low, high, linewidth=0.0, **look)


def _friction_bands(data: "xarray.Dataset") -> Iterator[tuple[np.ndarray, np.ndarray, dict[str, Any]]]:
    """Yield (low, high, style) of each friction band of a result, the widest kind first.

    First comes the prediction interval, or the range over asperity methods. Quantile ranges over uncertain inputs follow.
    """
    if f"{_MU}_low" in data:
        text = f"{METHOD_BAND}; used:\n{data.attrs.get('roughness_method', 'first method')}"
        text = f"{data.attrs['level']:.0%} interval" if "level" in data.attrs else text
        low, high = (np.atleast_1d(data[f"{_MU}_{end}"].values) for end in ("low", "high"))
        yield low, high, {"color": SKY, "alpha": 0.25, "label": text}
    if f"{_MU}_quantile" in data:
        shares, band = data["quantile"].values, data[f"{_MU}_quantile"].values.reshape(data.sizes["quantile"], -1)
        for number, depth in enumerate(np.linspace(0.2, 0.4, len(shares) // 2)):
            text = f"{shares[number]:.0%} to {shares[-1 - number]:.0%} over uncertain inputs"
            yield band[number], band[-1 - number], {"color": BLUE, "alpha": depth, "label": text}


def _parts_panel(axes: Axes, data: "xarray.Dataset", what: str, against: str) -> None:
    """Draw the absolute value of a quantity and of its parts on a logarithmic axis; negative values are dotted."""
    stem = "friction" if what == "friction_force" else what
    names = [what] + [stem + part for part in _PARTS if part and stem + part in data]
    x = data[against].values
    floor = _LEAST * max(np.nanmax(np.abs(data[name].values), initial=0.0) for name in names)
    tension, named, sizes = False, set(), []
    for name in names:
        text, look = _PARTS[name.removeprefix(what if name == what else stem)]
        y = data[name].values
        for sign, style in ((1.0, look), (-1.0, look | {"linestyle": ":", "linewidth": 1.8})):
            drawn = (sign * y > floor) & ((x > 0.0) | (against != "load"))
            if drawn.any():
                tension |= sign < 0.0
                marks = _marked(x.size) | style | ({"markevery": None} if x.size <= _FEW_POINTS else {})
                axes.plot(x, np.where(drawn, sign * y, np.nan), label=None if name in named else text, **marks)
                named.add(name)
                sizes += [np.min(sign * y[drawn]), np.max(sign * y[drawn])]
    axes.set(xlabel=label(data[against]), ylabel=label(data[what], longest=42))
    if axes.lines:
        alike = max(sizes) < (1.0 + 1e-9) * min(sizes)  # for equal values matplotlib finds no limits, and warns
        axes.set_autoscaley_on(not alike)
        axes.set_yscale("log")
        if alike:
            axes.set_ylim(min(sizes) / 1.5, max(sizes) * 1.5)
    if tension:
        axes.plot([], [], ":", color=GREY, label="dotted: tension (absolute value)")
    if against == "load":
        axes.set_xscale("log" if np.any(x > 0.0) else "linear")
    else:
        if data[against].attrs.get("units", "1") != "1":
            along(axes, "x", against, x, log=False)
        axes.invert_xaxis()  # the load rises to the right, as in the other panels
    if sizes and data[what].attrs.get("units", "1") != "1":
        along(axes, "y", what, np.array(sizes))
    finish(axes)


def finish(axes: Axes, legend: bool = True, **named: Any) -> None:
    """Format ticks and grid of the axes, set further properties such as `xlabel`, and add a legend if lines have names."""
    axes.set(**named)
    axes.title.set_fontsize(9)
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        if axis.get_scale() == "log":
            if not isinstance(axis.get_major_formatter(), InUnit):  # `along` may have set one
                axis.set_major_formatter(InUnit())
            axis.set_minor_formatter(NullFormatter())
            if high < FEW_DECADES * low:
                axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            elif high > _MANY_DECADES * low:
                axis.set_minor_locator(NullLocator())
        elif high - low < _LEAST_SPAN * abs(high):  # labels would differ in their last digits
            axis.set_view_interval(low - 0.05 * abs(high), high + 0.05 * abs(high), ignore=True)
    axes.grid(True, alpha=0.3)
    if legend and axes.get_legend_handles_labels()[0]:
        axes.legend(fontsize=8, framealpha=0.9)


class InUnit(Formatter):
    """Format tick labels in a prefixed unit, or as powers of ten on a log axis with many decades or extreme values.

    factor: number by which a tick value is multiplied.
    """

    def __init__(self, factor: float = 1.0):
        self.factor = factor

    def __call__(self, x: float, pos: int | None = None) -> str:
        axis: Any = self.axis
        low, high = (self.factor * end for end in sorted(axis.get_view_interval()))
        value = x * self.factor
        if axis.get_scale() == "log" and (high > _MANY_DECADES * low or low < 1e-5 or high > 1e6):
            power = math.floor(math.log10(value) + 1e-9)
            lead = f"{value / 10.0**power:.3g}\\cdot "
            return f"${lead.removeprefix(_ONE)}10^{{{power}}}$"
        return f"{value:.6g}"


def canvas(width: float, height: float, rows: int = 1, columns: int = 1, **more: Any) -> tuple[Figure, list[Axes]]:
    """Return a new figure of the given size [inches] and the list of its panels, row by row."""
    figure = Figure(figsize=(width, height), layout="constrained")
    return figure, list(figure.subplots(rows, columns, squeeze=False, **more).flat)


def say(axes: Axes, text: str) -> None:
    """Write text in the middle of empty axes and remove the ticks."""
    axes.set(xticks=[], yticks=[])
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=GREY)


def along(axes: Axes, which: str, quantity: str, values: np.ndarray, log: bool = True, before: str = "", **named: Any) -> None:
    """Label an axis with a quantity, and show its ticks in a prefixed unit.

    which: "x" or "y". quantity: key of QUANTITIES. values: SI values (n,) that the axis shows. log: whether `is_log` may make
    the axis logarithmic. before: start of the label. named: arguments of `finish`.
    """
    row, axis = QUANTITIES[quantity], getattr(axes, f"{which}axis")
    seen = np.abs(values[np.isfinite(values)])
    if log and is_log(values):
        getattr(axes, f"set_{which}scale")("log")
    factor, unit = prefix(quantity, float(seen.max(initial=0.0)))
    if row.unit and factor != 1.0:
        axis.set_major_formatter(InUnit(factor))
    finish(axes, **named)
    axis.set_label_text(f"{before}{row.short or row.meaning} ${row.latex}$" + (f" [{unit}]" if unit else ""))


def along_points(axes: Axes, points: "xarray.DataArray") -> None:
    """Label and scale the x axis of a panel whose points are loads or separations, in SI units or normalised."""
    values = points.values
    if points.attrs.get("units", "1") != "1":
        along(axes, "x", str(points.name), values)
        return
    if is_log(values):
        axes.set_xscale("log")
    axes.set_xlabel(label(points))
    finish(axes)


def look_of(method: str, number: int) -> dict[str, Any]:
    """Return colour and marker of an asperity method, which are the same in all figures.

    number: index of the line; it decides the look if `method` is not the name of an asperity method.
    """
    known = list(methods())
    number = known.index(method) if method in known else number
    return {"color": COLOURS[number % len(COLOURS)], "marker": _MARKERS[number % len(_MARKERS)], "markersize": 5}


def plain(method: str) -> str:
    """Return a short text on what an asperity method finds; for any other name, the name with blanks for underscores."""
    record = methods().get(method)
    return method.replace("_", " ") if record is None else record.label
