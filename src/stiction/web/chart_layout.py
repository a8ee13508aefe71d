"""Fit the margins, ticks and legends of charts to a wide page or a phone."""

import math
from collections.abc import Mapping
from typing import Any

NARROW = 420  # largest width in pixels of a narrow chart
_LEAST = 340  # pixels, width for which the legend of a narrow chart is laid out
_LINE, _LETTER, _MARK = 24, 7.0, 44  # pixels: height of a legend line, width of a letter, of a mark with margins
_MOST = 42  # largest number of letters of an axis name in one line
_SCALE = 52  # pixels for the colour scale below a narrow chart


def fitted(options: Mapping[str, Any], room: int = NARROW) -> dict[str, Any]:
    """Return chart options that fit wide pages and phones.

    options: as returned by `charts.chart`; options without plane axes are returned unchanged. room: pixels for a legend line of
    a wide chart.
    """
    if "grid" not in options:
        return dict(options)
    wide = _at_width(options, room, False)
    legend = {**options["legend"], "type": "plain"}
    narrow = {"query": {"maxWidth": NARROW}, "option": _at_width(options, _LEAST, True)}
    return {**options, **wide, "legend": legend, "media": [narrow, {"option": wide}]}


def _at_width(options: Mapping[str, Any], room: int, narrow: bool) -> dict[str, Any]:
    """Return those chart options that differ between a narrow and a wide chart, for one of the two widths.

    All of them are set for both widths, so that no option of the other width remains when the page changes. room: pixels for a
    legend line. narrow: whether the chart is narrow.
    """
    x, y, size = options["xAxis"], options["yAxis"], 11 if narrow else 12
    width, lines = _columns(options, room)
    beside = not (narrow and y["type"] == "category")  # otherwise the names stand inside their rows, above the bars
    label: dict[str, Any] = {"inside": False, "verticalAlign": "middle", "padding": 0}
    if not beside:
        label = {"inside": True, "verticalAlign": "bottom", "padding": [0, 0, 9, 0], "width": _LEAST}
    letters = {"fontSize": size, "lineHeight": 15, "width": width, "overflow": "break"}
    found: dict[str, Any] = {
        "grid": {**options["grid"], "top": 12 + _LINE * lines if options["legend"].get("show", True) else 16},
        "legend": {"textStyle": {**options["legend"]["textStyle"], **letters}},
        "xAxis": {**x, "splitNumber": 3 if narrow else 5, "axisLabel": {**x["axisLabel"], "fontSize": size}},
        "yAxis": {**y, "splitNumber": 4 if narrow else 5, "z": 0 if beside else 9,
                  "axisLabel": {**y["axisLabel"], **label, "fontSize": size}},
    }  # fmt: skip
    if narrow:
        long = len(x["name"]) > _MOST
        found["grid"] = {"left": 50 if beside else 10, "right": 12, "top": found["grid"]["top"], "bottom": 62 if long else 44}
        found["xAxis"] |= {"name": x["name"].replace(" [", "\n[") if long else x["name"], "nameGap": 34 if long else 26}
        found["yAxis"]["nameGap"] = 36
    if "visualMap" in options:
        place: dict[str, Any] = {"orient": "vertical", "left": "auto", "bottom": "auto"}
        if narrow:
            found["grid"]["bottom"] += _SCALE
            place = {"orient": "horizontal", "left": "center", "right": "auto", "top": "auto", "bottom": 0}
        found["visualMap"] = {**options["visualMap"], **place}
    return found


def _columns(options: Mapping[str, Any], room: int) -> tuple[int, int]:
    """Return the width of a legend entry in pixels, and the number of legend lines.

    The longest name sets the width. A name that is longer than `room` pixels is broken into lines.
    """
    names = dict.fromkeys(options["legend"].get("data") or [one["name"] for one in options["series"]])
    wanted = [_LETTER * len(name) for name in names] or [0.0]
    width = min(room - _MARK, math.ceil(max(wanted)))
    beside = max(1, room // (width + _MARK))
    broken = [max(1, math.ceil(one / width)) if width else 1 for one in wanted]
    return width, sum(max(broken[at : at + beside]) for at in range(0, len(broken), beside))
