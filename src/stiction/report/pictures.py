"""Pictures: a dataset in, a matplotlib Figure out. Nothing is computed here, and no global state is touched."""

import re
import textwrap
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogFormatter, LogLocator, NullFormatter, NullLocator, StrMethodFormatter

from stiction.laws.validity import doubts_of
from stiction.quantities.table import QUANTITIES
from stiction.report.files import unit_of
from stiction.report.table import prefix

if TYPE_CHECKING:
    import xarray

    from stiction.studies.paper.claims import ClaimMap
    from stiction.studies.paper.figures import PanelCurves

# Okabe and Ito's colours, told apart by colour-blind readers too.
BLUE, ORANGE, GREEN, RED, SKY, GREY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#777777"
# Broad below, narrow and broken above: lines that lie on one another stay visible.
_VARYING: tuple[dict[str, Any], ...] = (
    {"color": SKY, "linewidth": 4.0},
    {"color": RED, "linewidth": 2.2},
    {"color": BLUE, "linewidth": 1.6, "linestyle": "--"},
)

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
# The panels of a curve: a quantity, and that against which it is drawn.
_PANELS = (
    ("friction_coefficient", "load"), ("contact_area", "load"), ("load", "mean_separation"), ("friction_force", "load"),
)  # fmt: skip
_LEAST = 1e-6  # of a panel's largest value: smaller parts are not drawn, so that the axis shows the others
_MANY_DECADES = 1e3
_FEW_POINTS = 20  # of a curve, up to which each is marked
_MOST_DOUBTS = 5  # that are told below a picture
NOT_PRESSED = "no compressive load here:\nthe surfaces hold themselves together,\nand mu is not defined"
METHOD_BAND = "spread over methods of\nfinding asperities"
MU_LABEL = f"static friction coefficient ${QUANTITIES['friction_coefficient'].latex}$"
WIDE = 100.0  # friction that varies more is shown on a logarithmic axis


def label(variable: "xarray.DataArray", longest: int = 200) -> str:
    """Meaning, symbol and unit for an axis: "net normal load $P$ [N]". What follows a comma in the meaning is left out.

    longest: number of characters above which the unit goes to a second line.
    """
    name = str(variable.name).rpartition(".")[2]  # of one of two bodies: "first.hardness"
    meaning = variable.attrs.get("comment", variable.attrs.get("long_name", name)).partition(",")[0]
    symbol = f" ${QUANTITIES[name].latex}$" if name in QUANTITIES else ""
    unit = _unit(variable)
    space = "\n" if len(f"{meaning} {unit_of(variable)}") > longest else " "
    return f"{meaning}{symbol}" + (f"{space}[{unit}]" if unit else "")


def _unit(variable: "xarray.DataArray") -> str:
    """Its unit with the exponents and letters set: "K R^(1/2) sigma^(3/2) per asperity" has a formula before " per "."""
    unit = unit_of(variable).replace("m^2", "m²")
    formula, per, rest = unit.partition(" per ")
    if "sigma" not in formula:
        return unit
    formula = re.sub(r"\^\((.*?)\)", r"^{\1}", formula)
    formula = re.sub(r"\b(sigma|pi)\b", r"\\\1", formula)
    return f"${formula}${per}{rest}"


def curve_figure(data: "xarray.Dataset", title: str = "") -> Figure:
    """One curve: friction coefficient, contact area and friction against load, and load against separation.

    data: result of `solve` with one dimension. Friction, or the separation, is left out where the model has none.
    """
    drawn = panels(data)
    rows, columns = (2, 2) if len(drawn) == 4 else (1, len(drawn))
    width, height = max(5.5 * columns, 8.0), 8.2 if rows == 2 else 4.6
    # Fixed margins: matplotlib's automatic layouts draw everything twice, and this picture is made on every run.
    notes = doubts_below(data, int(14.5 * width))
    below = 0.16 * len(notes)  # inches, which the figure has more
    figure = Figure(figsize=(width, height + below))
    figure.suptitle(heading(data, title), fontsize=11)
    if notes:
        figure.text(0.01, 0.06 / (height + below), "\n".join(notes), fontsize=8, color=RED, va="bottom")
    edge, beside = (1.0 if rows == 2 else 0.6), width / 11.0  # the same text takes more of one row, or column
    room = height / (height + below)
    bottom = (below + 0.07 / edge * height) / (height + below)
    figure.subplots_adjust(0.085 / beside, bottom, 1.0 - 0.015 / beside, 1.0 - 0.085 / edge * room, wspace=0.24, hspace=0.22)
    for axes, (what, against) in zip(figure.subplots(rows, columns, squeeze=False).flat, drawn, strict=True):
        _draw_panel(axes, data, what, against)
    return figure


def panels(data: "xarray.Dataset") -> list[tuple[str, str]]:
    """The panels that a curve has: a quantity, and that against which it is drawn."""
    return [names for names in _PANELS if all(name in data for name in names)]


def panel_of_curve(data: "xarray.Dataset", what: str, against: str) -> Figure:
    """One of the panels of a curve as a picture of its own."""
    figure = Figure(figsize=(5.2, 3.9), layout="constrained")
    _draw_panel(figure.subplots(), data, what, against)
    return figure


def _draw_panel(axes: Axes, data: "xarray.Dataset", what: str, against: str) -> None:
    if what == "friction_coefficient":
        _friction_panel(axes, data)
    else:
        _parts_panel(axes, data, what, against)


def heading(data: "xarray.Dataset", title: str) -> str:
    used = data.attrs
    words = [used["model"], *(f"{used[name]} {name}" for name in ("reading", "branch") if name in used)]
    if used.get("film", "none") != "none":
        words.append(f"film: {used['film']}")
    grade = f" (grade {used['grade']})" if "grade" in used else ""  # a prediction has none
    return "\n".join(filter(None, [title, f"{', '.join(words)}{grade}"]))


def entitle(figure: Figure, data: "xarray.Dataset", title: str, *more: str) -> None:
    """Write above a figure what it shows, line by line, and below it what is doubtful, for which it grows."""
    figure.suptitle("\n".join([heading(data, title), *more]), fontsize=11)
    if notes := doubts_below(data, int(14.0 * figure.get_figwidth())):
        figure.set_figheight(figure.get_figheight() + 0.16 * len(notes))
        figure.supxlabel("\n".join(notes), fontsize=8, color=RED, x=0.01, ha="left")


def doubts_below(data: "xarray.Dataset", width: int) -> list[str]:
    """Lines, of so many characters, that say below a picture what is doubtful in it; none where nothing is."""
    doubts = [str(doubt) for doubt in doubts_of(data)]
    if not doubts:
        return []
    more = len(doubts) - _MOST_DOUBTS
    told = [
        *doubts[:_MOST_DOUBTS],
        *([f"and {more} more doubts: outside_validity of the result has them all"] if more > 0 else []),
    ]
    return [
        "outside the range of validity:",
        *(line for one in told for line in textwrap.wrap(one, width, subsequent_indent="  ")),
    ]


def _marked(count: int) -> dict[str, Any]:
    """Marks on a line of few points: a line alone would claim what is between them, and of one point show nothing."""
    return {"marker": "o", "markersize": 4.0} if count <= _FEW_POINTS else {}


def _friction_panel(axes: Axes, data: "xarray.Dataset") -> None:
    load, mu = data["load"].values, data["friction_coefficient"].values
    drawn = (load > 0.0) & (mu > 0.0)
    axes.plot(load[drawn], mu[drawn], color="black", **_marked(int(drawn.sum())))
    seen = [mu[drawn]]
    for low, high, look in _friction_bands(data):
        there = (load > 0.0) & (high > 0.0) & np.isfinite(low)
        if there.any():
            # Where friction may be 0 the band reaches down to the edge of a logarithmic axis.
            low = np.maximum(low[there], np.concatenate([low[there & (low > 0.0)], high[there]]).min() / 2.0)
            draw_band(axes, load[there], low, high[there], **look)
            axes.legend(fontsize=8, framealpha=0.9)
            seen += [low, high[there]]
    axes.set(xlabel=label(data["load"]), ylabel=MU_LABEL)
    if drawn.any():
        axes.set_xscale("log")
        scale_friction(axes, np.concatenate(seen))
    else:
        say(axes, NOT_PRESSED)
    finish(axes)


def scale_friction(axes: Axes, values: np.ndarray) -> None:
    """Make the axis of friction, or of what goes with it, logarithmic where it varies much; else it begins at 0."""
    if values.max() > WIDE * values.min():
        axes.set_yscale("log")
    else:
        axes.set_ylim(0.0, 1.08 * values.max())  # room above a friction that does not vary


def draw_band(axes: Axes, x: np.ndarray, low: np.ndarray, high: np.ndarray, **look: Any) -> None:
    """Fill what lies between two curves; of one point, which has no width, draw a bar."""
    if len(x) == 1:
        axes.vlines(x, low, high, linewidth=14.0, **look)
    else:
        axes.fill_between(x, low, high, linewidth=0.0, **look)


def _friction_bands(data: "xarray.Dataset") -> Iterator[tuple[np.ndarray, np.ndarray, dict[str, Any]]]:
    """Yield low and high end, and look, of the bands of friction that are known: over the methods of finding asperities in a
    measured surface, and over what is uncertain of the inputs."""
    mu = "friction_coefficient"
    if f"{mu}_low" in data:
        look = {
            "color": SKY,
            "alpha": 0.25,
            "label": f"{METHOD_BAND}; taken:\n{data.attrs.get('roughness_method', 'first method')}",
        }
        yield data[f"{mu}_low"].values, data[f"{mu}_high"].values, look
    if f"{mu}_quantile" in data:
        shares = data["quantile"].values
        low, high = (np.broadcast_to(data[f"{mu}_quantile"].values[at], data["load"].shape) for at in (0, -1))
        text = f"{shares[0]:.0%} to {shares[-1]:.0%} of what is\nuncertain of the inputs"
        yield low, high, {"color": BLUE, "alpha": 0.2, "label": text}


def _parts_panel(axes: Axes, data: "xarray.Dataset", what: str, against: str) -> None:
    """A quantity and its parts against another one, on a logarithmic axis; dotted where it is negative."""
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
        alike = max(sizes) < (1.0 + 1e-9) * min(sizes)  # but for rounding: matplotlib finds no limits, and says so
        axes.set_autoscaley_on(not alike)
        axes.set_yscale("log")
        if alike:
            axes.set_ylim(min(sizes) / 1.5, max(sizes) * 1.5)
    if tension:
        axes.plot([], [], ":", color=GREY, label="dotted: tension, its size")
    if against == "load":
        if np.any(x > 0.0):
            axes.set_xscale("log")
    else:
        _prefixed(axes, data[against])
        axes.invert_xaxis()  # pressing harder goes to the right, as in the other panels
    finish(axes)
    if axes.lines:
        axes.legend(fontsize=8, framealpha=0.9)


def finish(axes: Axes) -> None:
    """Grid, and small ticks only where a logarithmic axis has few large ones."""
    axes.grid(True, alpha=0.3)
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        if axis.get_scale() == "log" and high > _MANY_DECADES * low:
            axis.set_minor_locator(NullLocator())
        elif axis.get_scale() == "log":
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            axis.set_minor_formatter(InUnit(1.0))


def sparse(axes: Axes) -> None:
    """Put plain numbers on a logarithmic x axis, few enough to be read."""
    low, high = axes.get_xlim()
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 200.0 * low else (1.0,)))
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


class InUnit(LogFormatter):
    """Labels of small ticks in a unit with a prefix, as 0.6 rather than 6e-01; none where matplotlib finds enough."""

    def __init__(self, factor: float):
        super().__init__(minor_thresholds=(1.2, 0.5))
        self.factor = factor

    def __call__(self, x: float, pos: int | None = None) -> str:
        return f"{x * self.factor:.6g}" if super().__call__(x, pos) else ""


def _prefixed(axes: Axes, variable: "xarray.DataArray") -> None:
    """Ticks of the x axis in a unit with a fitting prefix; the data stay in SI."""
    largest = float(np.max(np.abs(variable.values), initial=0.0))
    if variable.attrs.get("units", "1") == "1" or largest == 0.0:
        return
    factor, unit = prefix(str(variable.name), largest)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value * factor:g}"))
    axes.set_xlabel(label(variable).replace(f"[{variable.attrs['units']}]", f"[{unit}]"))


def say(axes: Axes, text: str) -> None:
    """A word in place of curves, without numbers along the axes."""
    axes.set(xticks=[], yticks=[])
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=GREY)


def panel_figure(curves: "PanelCurves") -> Figure:
    """One of the paper's figures: friction coefficient against load for films, beside the uncoated surface."""
    figure = Figure(figsize=(7, 5.4), layout="constrained")
    axes = figure.subplots()
    along = curves.panel.along
    _friction_line(axes, curves.bare, label="uncoated", color="black", linewidth=2.0)
    for value, look in zip(curves.panel.values, _VARYING, strict=False):
        one = curves.coated.sel({along: value})
        _friction_line(axes, one, label=f"${QUANTITIES[along].latex}$ = {value:g}", **look)
    axes.set_title(_with_letters(curves.caption), fontsize=9.5)
    axes.set(xscale="log", yscale="log", xlabel=label(curves.bare["load"]), ylabel=MU_LABEL)
    finish(axes)
    axes.legend()
    return figure


def _with_letters(text: str) -> str:
    """The text with the symbols of the groups set as formulas."""
    letters = {QUANTITIES[name].symbol: QUANTITIES[name].latex for name in ("theta", "lam", "n_E", "n_H", "tau")}
    return re.sub(rf"\b({'|'.join(letters)})\b", lambda found: f"${letters[found[0]]}$", text)


def _friction_line(axes: Axes, data: "xarray.Dataset", **look: Any) -> None:
    load, mu = data["load"].values, data["friction_coefficient"].values
    drawn = (load > 0.0) & (mu > 0.0)
    axes.plot(np.where(drawn, load, np.nan), np.where(drawn, mu, np.nan), **look)


def claims_figure(claims: "ClaimMap", here: Mapping[str, float]) -> Figure:
    """The map of the claims: a column for each, a row for each reading and for the film that is solved; here: theta and lam
    that are marked."""
    import matplotlib

    from stiction.studies.paper.claims import CLAIMS, READINGS
    from stiction.studies.paper.figures import in_words

    figure = Figure(figsize=(3.1 * len(CLAIMS) + 0.8, 3.3 * len(READINGS)), layout="constrained")
    grid = figure.subplots(len(READINGS), len(CLAIMS), sharex=True, sharey=True, squeeze=False)
    colours = matplotlib.colormaps["viridis"]
    norm = BoundaryNorm(np.linspace(0.0, 1.0, 11), colours.N)
    for row, reading in enumerate(READINGS):
        for column, claim in enumerate(CLAIMS):
            axes = grid[row, column]
            share = np.ma.masked_invalid(claims.share[column, row].T)
            axes.pcolormesh(claims.theta, claims.lam, share, cmap=colours, norm=norm, shading="nearest")
            axes.set(xscale="log", yscale="log")
            for colour, style in (("white", "-"), ("black", "--")):  # seen on dark and on light colours
                axes.axvline(10.0, color=colour, linewidth=0.9, linestyle=style)
                axes.axhline(0.125, color=colour, linewidth=0.9, linestyle=style)
            axes.plot(here["theta"], here["lam"], marker="*", color=RED, markeredgecolor="white", markersize=12)
            if row == 0:
                axes.set_title(f"({claim.key}) {textwrap.fill(claim.says, 36)}", fontsize=9)
            if column == 0:
                axes.set_ylabel(f"{in_words(reading)}\nplastic adhesion index $\\lambda$")
            if row == len(READINGS) - 1:
                axes.set_xlabel(r"elastic adhesion index $\theta$")
    bar = figure.colorbar(ScalarMappable(norm, colours), ax=grid, shrink=0.8, pad=0.01)
    bar.set_label("share of its cases for which it holds (white: not comparable)")
    figure.suptitle(
        "Where the claims of the 2015 paper hold; dashed: below $\\theta$ = 10 or $\\lambda$ = 0.125 adhesion matters; "
        f"star: $\\theta$ = {here['theta']:g}, $\\lambda$ = {here['lam']:g}",
        fontsize=10,
    )
    return figure
