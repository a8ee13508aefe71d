"""Turn results into options for charts of the browser library ECharts; nothing is computed here."""

from html import escape
from typing import Any

import numpy as np
import xarray

from stiction.quantities.table import QUANTITIES
from stiction.report.files import unit_of
from stiction.report.html_words import letters
from stiction.report.pictures import BLUE, GREEN, ORANGE, RED, SKY
from stiction.report.scales import LOG, is_log, log_ticks
from stiction.report.share_pictures import part_in_words, shares_of, stacks
from stiction.report.table import prefix, with_signs

COLOURS = (BLUE, ORANGE, GREEN, RED, SKY, "#CC79A7")  # Okabe and Ito's colours
SHADES = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"]  # viridis: its lightness also rises for colour-blind readers
_DASHES = ("solid", "dashed", "dotted", [8, 3, 2, 3], [2, 2], [12, 4])
INK = {False: "#333333", True: "#dddddd"}  # colour of texts, on a light and on a dark page
_GRID = {False: "#dddddd", True: "#444444"}
_MAIN = {False: BLUE, True: SKY}  # colour of a result and its band, on a light and on a dark page
_HATCHES = ("none", "rect", "triangle", "circle", "diamond", "pin")
_BANDED = ("friction_coefficient", "friction_force", "contact_area")  # results that may have a band
_OPACITY = 0.3  # opacity of a band
_PLAIN = 1e-4, 1e5  # range of values written in plain digits
# JavaScript that formats the numbers of an axis.
_SHORT = (
    f"value => value !== 0 && (Math.abs(value) < {_PLAIN[0]} || Math.abs(value) >= {_PLAIN[1]}) "
    "? value.toExponential(0) : String(+value.toPrecision(4))"
)
# JavaScript that writes the numbers of an axis as powers of ten, all of them if one is too long in plain digits.
_POWERS = (
    "value => { const [first, power] = value.toExponential(0).split('e');"
    " const above = [...String(+power)].map(each => '⁰¹²³⁴⁵⁶⁷⁸⁹'[each] ?? '⁻');"
    " return (first === '1' ? '' : first + '·') + '10' + above.join(''); }"
)


def numbers(values: Any) -> list[float | None]:
    """Return values as a list of numbers for JSON; values that are not finite become None."""
    return [float(one) if np.isfinite(one) else None for one in np.atleast_1d(np.asarray(values, dtype=float))]


def axis_name(variable: xarray.DataArray) -> str:
    """Return the axis name of a result: meaning, symbol and unit, short enough for a phone."""
    row, unit = QUANTITIES[str(variable.name)], with_signs(unit_of(variable))
    return f"{(row.short or row.meaning).partition(',')[0]} {letters(row.symbol)}".strip() + (f" [{unit}]" if unit else "")


def chart(title: str, x: dict[str, Any], y: dict[str, Any], series: list[dict[str, Any]], dark: bool) -> dict[str, Any]:
    """Return the ECharts options of a chart with named axes.

    title: description for screen readers. x, y: further options of the axes. series: lines and points of the chart, as options.
    dark: whether the page is dark.
    """
    ink, grid = INK[dark], _GRID[dark]
    look: dict[str, Any] = {
        "axisLine": {"onZero": False, "lineStyle": {"color": ink}},
        "axisLabel": {"color": ink, "hideOverlap": True, ":formatter": _SHORT},
        "nameTextStyle": {"color": ink},
        "splitLine": {"lineStyle": {"color": grid}},
        "nameLocation": "middle",
    }
    return {
        "animation": False,
        "aria": {"enabled": True, "label": {"description": title}, "decal": {"show": False}},
        "textStyle": {"color": ink},
        "color": list(COLOURS),
        "grid": {"left": 74, "right": 18, "top": 36, "bottom": 46},
        "legend": {"textStyle": {"color": ink}, "top": 0, "show": len(series) > 1},
        "tooltip": {"trigger": "axis", "renderMode": "richText", "confine": True},
        "xAxis": {"type": "value", "nameGap": 28, **look, **x, "axisLabel": {**look["axisLabel"], **x.get("axisLabel", {})}},
        "yAxis": {"type": "value", "nameGap": 56, **look, **y, "axisLabel": {**look["axisLabel"], **y.get("axisLabel", {})}},
        "series": series,
    }


def line(name: str, x: Any, y: Any, at: int, **more: Any) -> dict[str, Any]:
    """Return the ECharts series of a line through the points (x, y); points without a finite x are omitted.

    at: index of the line in the legend, which decides its colour and dashes. more: further options of the series. A y that is
    not finite leaves a gap.
    """
    points = [[a, b] for a, b in zip(numbers(x), numbers(y), strict=True) if a is not None]
    look = {"color": COLOURS[at % len(COLOURS)], "type": _DASHES[at % len(_DASHES)], "width": 2.5}
    return {
        "name": name, "type": "line", "data": points, "showSymbol": len(points) < 12, "lineStyle": look,
        "itemStyle": {"color": look["color"]}, **more,
    }  # fmt: skip


def mark(name: str, point: Any, symbol: str = "diamond", size: int = 12, colour: str = RED) -> dict[str, Any]:
    """Return the ECharts series of a single point (x, y), drawn above all other series."""
    return {"name": name, "type": "scatter", "data": [list(map(float, point))], "symbol": symbol, "symbolSize": size, "z": 6,
            "itemStyle": {"color": colour, "borderColor": "white", "borderWidth": 1.5}}  # fmt: skip


def add_cells(
    options: dict[str, Any], name: str, x: np.ndarray, y: np.ndarray, values: np.ndarray, scale: tuple[float, str, str]
) -> None:
    """Add a heat map to the options of a chart, below all other series, with a colour scale.

    x (n,), y (m,): centres of the cells, evenly spaced; on logarithmic axes at a constant ratio. values: (n, m). scale:
    (largest value, label of that end, label of the end at 0).
    """
    log = options["xAxis"]["type"] == "log"
    halves = [float((at[1] / at[0]) ** 0.5 if log else (at[1] - at[0]) / 2.0) for at in (x, y)]
    # JavaScript for both ends of a cell along x and y.
    corners = [f"api.value({at}) {sign} {half!r}" for at, half in enumerate(halves) for sign in ("/*" if log else "-+")]
    draw = (
        f"(params, api) => {{ const [left, top] = api.coord([{corners[0]}, {corners[2]}]);"
        f" const [right, bottom] = api.coord([{corners[1]}, {corners[3]}]);"
        " return {type: 'rect', style: {fill: api.visual('color')},"
        " shape: {x: Math.min(left, right) - 0.5, y: Math.min(top, bottom) - 0.5,"
        " width: Math.abs(right - left) + 1, height: Math.abs(bottom - top) + 1}}; }"
    )
    # Drawn in one step, because a partly drawn picture would mislead.
    points = [[float(x[i]), float(y[j]), float(values[i, j])] for i, j in np.argwhere(np.isfinite(values))]
    cells = {"name": name, "type": "custom", ":renderItem": draw, "progressive": 0, "data": points, "clip": True, "z": 1,
             "encode": {"x": 0, "y": 1}}  # fmt: skip
    most, *words = scale
    options["legend"]["data"] = [one["name"] for one in options["series"]]
    options["series"] = [cells, *options["series"]]
    options["grid"]["right"] = 110
    options["visualMap"] = {"min": 0.0, "max": most, "dimension": 2, "seriesIndex": 0, "right": 0, "top": "middle",
                            "calculable": True, "align": "left", "precision": 3, "inRange": {"color": SHADES},
                            "text": words, "textStyle": options["textStyle"]}  # fmt: skip


def _positive(values: Any) -> np.ndarray:
    return np.where(np.greater(values, 0.0), values, np.nan)


def _axis(variable: xarray.DataArray, values: list[np.ndarray], tight: bool = False) -> tuple[float, dict[str, Any]]:
    """Return (factor, options) of an axis: the factor from SI to its unit, and its ECharts options.

    The axis is logarithmic if `is_log` holds for the values. values: arrays to be shown, in SI; the first is the line, which
    decides the unit. tight: whether a logarithmic axis ends at the values, and not at round numbers.
    """
    known = np.concatenate([each[np.isfinite(each)] for each in map(np.ravel, values)])
    name, factor = axis_name(variable), 1.0
    if (unit := variable.attrs.get("units", "1")) != "1":
        line = values[0][np.isfinite(values[0])]
        factor, prefixed = prefix(str(variable.name), float(np.max(np.abs(line), initial=0.0)))
        name = name.replace(f"[{with_signs(unit)}]", f"[{prefixed}]")
    if not is_log(known):
        return factor, {"name": name}
    low, high = (float(end) * factor for end in (known.min(), known.max()))
    ticks = log_ticks(low, high)
    ends = (low, high) if tight else (ticks[0], ticks[-1])
    places = {"customValues": ticks}
    look = places | ({} if _PLAIN[0] <= ticks[0] and ticks[-1] < _PLAIN[1] else {":formatter": _POWERS})
    if str(variable.name) == "friction_coefficient":
        name += LOG
    return factor, {"name": name, "type": "log", "min": ends[0], "max": ends[1], "axisLabel": look, "axisTick": places}


def _against(curve: xarray.Dataset, against: str) -> tuple[np.ndarray, dict[str, Any]]:
    """Return the values and the axis options of the variable on the horizontal axis.

    against: "load" or "mean_separation".
    """
    values = np.asarray(curve[against].values, dtype=float)
    if against == "load":
        values = _positive(values)
        factor, axis = _axis(curve[against], [values], tight=True)
        return values * factor, {"scale": True} | axis
    factor, axis = _axis(curve[against], [np.abs(values)])
    # The separation decreases to the right, so that the load rises to the right, as in other charts.
    return values * factor, {"name": axis["name"], "scale": True, "inverse": True}


def _bands(curve: xarray.Dataset, name: str) -> dict[str, list[np.ndarray]]:
    """Return the bands of a result by their names, each as the arrays [low, high].

    A band is the prediction interval, the range over asperity methods, or a range of quantiles. name: the result.
    """
    bands = {}
    if f"{name}_low" in curve:
        text = f"{curve.attrs['level']:.0%} interval" if "level" in curve.attrs else "range over asperity methods"
        bands[text] = [_positive(curve[f"{name}_{end}"].values) for end in ("low", "high")]
    if f"{name}_quantile" in curve:
        shares = curve["quantile"].values[[0, -1]]
        ends = curve[f"{name}_quantile"].sel(quantile=shares).transpose("quantile", ...).values
        bands["{:.0%} to {:.0%} over uncertain inputs".format(*shares)] = [_positive(end) for end in ends]
    return bands


def _line_name(curve: xarray.Dataset) -> str:
    if "level" in curve.attrs:
        return "median"
    return "at nominal inputs" if "quantile" in curve.dims else str(curve.attrs["model"]).replace("_", " ")


def curve_chart(curve: xarray.Dataset, name: str, against: str, here: int, dark: bool) -> dict[str, Any]:
    """Return a chart of a result against load or separation, with its bands and a mark at the working load.

    curve: results at loads or separations. name: the result. against: "load" or "mean_separation". here: index of the working
    load. The chart has no legend, because `curve_legend` serves all charts of a curve.
    """
    x, x_axis = _against(curve, against)
    bands = _bands(curve, name)
    shown = [_positive(curve[name].values), *(end for band in bands.values() for end in band)]
    factor, y_axis = _axis(curve[name], shown)
    y, *ends = (values * factor for values in shown)
    colour = _MAIN[dark]
    result = line(_line_name(curve), x, y, 0)
    series = [result | {"lineStyle": {**result["lineStyle"], "color": colour}, "itemStyle": {"color": colour}}]
    for text, low, high in zip(bands, ends[::2], ends[1::2], strict=True):
        series += _band(text, x, low, high, colour)
    if here < x.size and np.isfinite(x[here]) and np.isfinite(y[here]):
        series.append(mark("working load", (x[here], y[here])))
    title = f"{y_axis['name']} against {', with its '.join([x_axis['name'], *bands])}"
    options = chart(title, x_axis, {"min": 0} | y_axis, series, dark)
    options["legend"]["show"] = False
    return options


def curve_legend(curve: xarray.Dataset, dark: bool) -> str:
    """Return the legend of all charts of a curve as HTML: its line, its bands and the mark of the working load."""
    colour = _MAIN[dark]
    shapes = {_line_name(curve): f'<path d="M0 7H26" stroke="{colour}" stroke-width="2.5"/>'}
    names = dict.fromkeys(text for name in _BANDED for text in _bands(curve, name))
    shapes |= {
        text: f'<path d="M0 1H26V13H0Z" fill="{colour}" fill-opacity="{_OPACITY}" stroke="{colour}" stroke-width="0.5"/>'
        for text in names
    }
    shapes["working load"] = f'<path d="M13 1L19 7L13 13L7 7Z" fill="{RED}" stroke="white" stroke-width="1.5"/>'
    drawn = '<span><svg width="26" height="14" aria-hidden="true">{}</svg> {}</span>'
    return f'<div class="legend text-sm">{"".join(drawn.format(shape, escape(text)) for text, shape in shapes.items())}</div>'


def _band(name: str, x: np.ndarray, low: np.ndarray, high: np.ndarray, colour: str) -> list[dict[str, Any]]:
    """Return the series of a band between the curves low and high: their lines, thin, and the area between them."""
    thin = {"lineStyle": {"color": colour, "width": 0.5}}
    edges = [line(f"{end} end", x, values, 0) | thin for end, values in (("low", low), ("high", high))]
    outline = [*zip(x, low, strict=True), *zip(x[::-1], high[::-1], strict=True)]
    corners = [list(map(float, one)) for one in outline if np.isfinite(one).all()]
    draw = (
        f"(params, api) => ({{type: 'polygon', style: {{fill: api.visual('color'), opacity: {_OPACITY}}},"
        f" shape: {{points: {corners}.map(one => api.coord(one))}}}})"
    )
    between = {"name": name, "type": "custom", ":renderItem": draw, "data": corners[:1], "clip": True, "z": 1, "silent": True}
    return [*edges, between | {"itemStyle": {"color": colour}, "tooltip": {"show": False}}]


def share_chart(curve: xarray.Dataset, what: str, against: str, dark: bool) -> dict[str, Any]:
    """Return a chart of the parts of a result as stacked shares of the sum of their absolute values.

    what: key of `share_pictures.stacks`, for example "contact area, by state". against: "load" or "mean_separation". The legend
    names the parts.
    """
    total, parts = stacks(curve)[what]
    x, x_axis = _against(curve, against)
    series = []
    for at, (name, share) in enumerate(zip(parts, shares_of(curve, parts), strict=True)):
        label = part_in_words(name, total)
        area = {"opacity": 0.75, "decal": {"symbol": _HATCHES[at % len(_HATCHES)], "color": "rgba(255,255,255,0.5)"}}
        series.append(line(label, x, share, at, stack="all", areaStyle=area))
    tension = any(np.nanmin(curve[name].values, initial=0.0) < 0.0 for name in parts)
    named = f"share of {what}" + (", absolute values: some parts are in tension" if tension else "")
    return chart(named, x_axis, {"name": f"share of {what.partition(',')[0]}", "min": 0, "max": 1}, series, dark)
