"""Charts for the page: a result in, the options of an ECharts chart out. Nothing is computed."""

from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.quantities.table import QUANTITIES
from stiction.report.answer import at_working_load
from stiction.report.families import families_of
from stiction.report.files import unit_of
from stiction.report.picture_style import scale
from stiction.report.pictures import BLUE, GREEN, ORANGE, RED, SKY
from stiction.report.share_pictures import part_in_words, shares_of, stacks

if TYPE_CHECKING:
    import xarray

__all__ = [
    "COLOURS",
    "axis_name",
    "cells",
    "chart",
    "comparison_chart",
    "curve_chart",
    "ink_of",
    "line",
    "numbers",
    "prediction_chart",
    "share_chart",
    "stacks",
]

COLOURS = (BLUE, ORANGE, GREEN, RED, SKY, "#CC79A7")  # Okabe and Ito's
_DASHES = ("solid", "dashed", "dotted", [8, 3, 2, 3], [2, 2], [12, 4])
_INK = {False: "#333333", True: "#dddddd"}
_GRID = {False: "#dddddd", True: "#444444"}
_HATCHES = ("none", "rect", "triangle", "circle", "diamond", "pin")
# Beyond this ratio an axis is logarithmic.
_WIDE = 20.0
# How the browser writes the numbers of an axis.
_SHORT = (
    "value => value !== 0 && (Math.abs(value) < 0.01 || Math.abs(value) >= 1e5) "
    "? value.toExponential(0) : String(+value.toPrecision(4))"
)


def ink_of(dark: bool) -> str:
    """The colour of what is written."""
    return _INK[dark]


def numbers(values: Any) -> list[float | None]:
    """Numbers as JSON has them: what is not finite is nothing."""
    return [float(one) if np.isfinite(one) else None for one in np.atleast_1d(np.asarray(values, dtype=float))]


def axis_name(variable: "xarray.DataArray") -> str:
    """Meaning, symbol and unit of a variable."""
    name = str(variable.name)
    symbol = variable.attrs.get("symbol") or (QUANTITIES[name].symbol if name in QUANTITIES else "")
    unit = unit_of(variable)
    meaning = str(variable.attrs.get("long_name", name)).partition(",")[0]
    return f"{meaning} {symbol}".strip() + (f" [{unit}]" if unit else "")


def chart(title: str, x: dict[str, Any], y: dict[str, Any], series: list[dict[str, Any]], dark: bool) -> dict[str, Any]:
    """Options of a chart with named axes; its description for those who do not see it is ECharts' own, of the title."""
    ink, grid = _INK[dark], _GRID[dark]
    look = {
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
        "xAxis": {"type": "value", "nameGap": 28, **look, **x},
        "yAxis": {"type": "value", "nameGap": 56, **look, **y},
        "series": series,
    }


def line(name: str, x: Any, y: Any, at: int, **more: Any) -> dict[str, Any]:
    """A line of its own colour and dashes; points that have no number are left out."""
    points = [[a, b] for a, b in zip(numbers(x), numbers(y), strict=True) if a is not None]
    look = {"color": COLOURS[at % len(COLOURS)], "type": _DASHES[at % len(_DASHES)], "width": 2.5}
    return {
        "name": name, "type": "line", "data": points, "showSymbol": len(points) < 12, "lineStyle": look,
        "itemStyle": {"color": look["color"]}, **more,
    }  # fmt: skip


def cells(name: str, points: list[list[float]], x: tuple[str, str], y: tuple[str, str]) -> dict[str, Any]:
    """Coloured cells at the points (x, y, value). x, y: the two ends of a cell, as what a browser makes of the number `it`."""
    ends = [f"(it => {one})(api.value({at}))" for at, pair in enumerate((x, y)) for one in pair]
    draw = (
        f"(params, api) => {{ const [left, top] = api.coord([{ends[0]}, {ends[2]}]);"
        f" const [right, bottom] = api.coord([{ends[1]}, {ends[3]}]);"
        " return {type: 'rect', style: {fill: api.visual('color')},"
        " shape: {x: Math.min(left, right) - 0.5, y: Math.min(top, bottom) - 0.5,"
        " width: Math.abs(right - left) + 1, height: Math.abs(bottom - top) + 1}}; }"
    )
    return {
        "name": name,
        "type": "custom",
        ":renderItem": draw,
        "progressive": 0,  # all at once: a picture in parts says something else
        "data": points,
        "clip": True,
        "z": 1,
        "encode": {"x": 0, "y": 1},
    }


def _log(values: Any) -> bool:
    given = np.asarray(values, dtype=float)
    given = given[np.isfinite(given) & (given > 0.0)]
    return bool(given.size) and bool(given.max() > _WIDE * given.min())


def _positive(values: Any) -> np.ndarray:
    given = np.asarray(values, dtype=float)
    return np.where(given > 0.0, given, np.nan)


def _against(curve: "xarray.Dataset", against: str) -> tuple[np.ndarray, dict[str, Any]]:
    """Values and axis of what the curve is drawn against."""
    values = np.asarray(curve[against].values, dtype=float)
    axis: dict[str, Any] = {"name": axis_name(curve[against]), "scale": True}
    if against == "load":
        return _positive(values), axis | ({"type": "log"} if _log(values) else {})
    if unit_of(curve[against]) == "m":
        per, unit = scale(float(np.nanmax(np.abs(values), initial=0.0)))
        values, axis = values * per, axis | {"name": axis["name"].replace("[m]", f"[{unit}]")}
    return values, axis | {"inverse": True}  # pressing harder goes to the right


def curve_chart(curve: "xarray.Dataset", name: str, against: str, here: int, dark: bool) -> dict[str, Any]:
    """A result against load or separation, with the point that is told in words marked; of friction also its band."""
    x, x_axis = _against(curve, against)
    y = _positive(curve[name].values)
    bands = [one for one in (f"{name}_low", f"{name}_high") if one in curve]
    series = [line(axis_name(curve[name]), x, y, 0)]
    series += [line(f"{one.rpartition('_')[2]}, over ways to find asperities", x, _positive(curve[one].values), 4)
               for one in bands]  # fmt: skip
    if f"{name}_quantile" in curve:
        for share in curve["quantile"].values[[0, -1]]:
            drawn = _positive(curve[f"{name}_quantile"].sel(quantile=share).values)
            series.append(line(f"{share:g} of what is drawn is below", x, drawn, 4))
    if here < x.size and np.isfinite(x[here]) and np.isfinite(y[here]):
        mark = {"name": "the point in words", "type": "scatter", "data": [[float(x[here]), float(y[here])]], "symbolSize": 12}
        series.append(mark | {"itemStyle": {"color": RED}, "symbol": "diamond"})
    y_axis = {"name": axis_name(curve[name])} | ({"type": "log"} if _log(y) else {"min": 0})
    return chart(f"{axis_name(curve[name])} against {x_axis['name']}", x_axis, y_axis, series, dark)


def prediction_chart(data: "xarray.Dataset", name: str, dark: bool) -> dict[str, Any]:
    """Return the median of a result along the load, with its interval as a band; the working load is marked."""
    ordered, here = data.sortby("load"), at_working_load(data)
    x, x_axis = _against(ordered, "load")
    low, middle, high = (_positive(ordered[f"{name}{end}"].values) for end in ("_low", "", "_high"))
    interval = f"{data.attrs['level']:.0%} interval"
    series = [line("median", x, middle, 0)]
    for end, values in (("low", low), ("high", high)):
        edge = line(f"{end} end", x, values, 0)
        series.append(edge | {"lineStyle": {"color": BLUE, "width": 0.5}})
    outline = [*zip(x, low, strict=True), *zip(x[::-1], high[::-1], strict=True)]
    corners = [list(map(float, one)) for one in outline if np.isfinite(one).all()]
    draw = (
        "(params, api) => ({type: 'polygon', style: {fill: api.visual('color'), opacity: 0.25},"
        f" shape: {{points: {corners}.map(one => api.coord(one))}}}})"
    )
    series.append({"name": interval, "type": "custom", ":renderItem": draw, "data": corners[:1], "clip": True, "z": 1,
                   "silent": True, "itemStyle": {"color": BLUE}, "tooltip": {"show": False}})  # fmt: skip
    mark = [[float(here["load"]), float(here[name])]]
    series.append({"name": "working load", "type": "scatter", "data": mark, "symbolSize": 12, "symbol": "diamond",
                   "itemStyle": {"color": RED}})  # fmt: skip
    wide = {"type": "log"} if _log([low, high]) else {"min": 0}
    unit = f" [{QUANTITIES[name].unit}]" if QUANTITIES[name].unit else ""
    y_axis = {"name": f"{name.replace('_', ' ')} {QUANTITIES[name].symbol}{unit}"} | wide  # short enough for a telephone
    options = chart(f"{y_axis['name']} against {x_axis['name']}, with its {interval}", x_axis, y_axis, series, dark)
    options["legend"]["data"] = ["median", interval, "working load"]
    return options


def share_chart(curve: "xarray.Dataset", what: str, against: str, dark: bool) -> dict[str, Any]:
    """Parts as stacked shares of the sum of their sizes."""
    total, parts = stacks(curve)[what]
    x, x_axis = _against(curve, against)
    series = []
    for at, (name, share) in enumerate(zip(parts, shares_of(curve, parts), strict=True)):
        said = part_in_words(name, total)
        area = {"opacity": 0.75, "decal": {"symbol": _HATCHES[at % len(_HATCHES)], "color": "rgba(255,255,255,0.5)"}}
        series.append(line(said, x, share, at, stack="all", areaStyle=area))
    tension = any(np.nanmin(curve[name].values, initial=0.0) < 0.0 for name in parts)
    named = f"share of {what}" + (", of their sizes: some pull" if tension else "")
    return chart(named, x_axis, {"name": f"share of {what.partition(',')[0]}", "min": 0, "max": 1}, series, dark)


def comparison_chart(data: "xarray.Dataset", dark: bool) -> dict[str, Any]:
    """Friction at the working load by each model, a row each, families apart; what is outside its range is hollow, faint."""
    mu = data["friction_coefficient_at_load"].values
    families = families_of(data)
    shown = [at for at in np.argsort(mu) if np.isfinite(mu[at]) and mu[at] > 0.0]
    shown.sort(key=lambda at: (families[at], mu[at]))
    names = [str(data["model"].values[at]) for at in shown]
    series = []
    for at, family in enumerate(dict.fromkeys(families[one] for one in shown)):
        for outside in (False, True):
            rows = [row for row, one in enumerate(shown) if families[one] == family and _outside(data, one) == outside]
            colour = COLOURS[at % len(COLOURS)]
            look = (
                {"color": "transparent", "borderColor": colour, "borderWidth": 2, "opacity": 0.8}
                if outside
                else {"color": colour}
            )
            series.append({"name": family + (", outside its range" if outside else ""), "type": "scatter", "symbolSize": 12,
                           "symbol": ("circle", "rect", "triangle", "diamond")[at % 4], "itemStyle": look,
                           "data": [[float(mu[shown[row]]), row] for row in rows]})  # fmt: skip
    best = data.attrs.get("recommended")
    if best in names:
        row = names.index(best)
        ring = {"color": "transparent", "borderColor": RED, "borderWidth": 3}
        series.append({"name": "recommended", "type": "scatter", "symbol": "circle", "symbolSize": 22, "itemStyle": ring,
                       "data": [[float(mu[shown[row]]), row]]})  # fmt: skip
    series = [one for one in series if one["data"]]
    options = chart("static friction coefficient by each model", {"type": "log", "name": "static friction coefficient mu"},
                    {"type": "category", "data": names,
                     "axisLabel": {"color": _INK[dark], "width": 300, "overflow": "truncate", "interval": 0}},
                    series, dark)  # fmt: skip
    options["grid"] |= {"left": 316}
    options["tooltip"]["trigger"] = "item"
    return options


def _outside(data: "xarray.Dataset", at: int) -> bool:
    return bool(str(data["outside_validity"].values[at]))
