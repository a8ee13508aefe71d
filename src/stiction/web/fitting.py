"""Charts at the width of their place: what is smaller, fewer or elsewhere where a chart is as narrow as a telephone."""

import math
from collections.abc import Mapping
from typing import Any

__all__ = ["NARROW", "fitted"]

NARROW = 420  # pixels of a chart, up to which it is narrow
_LEAST = 340  # pixels: what a legend of a narrow chart may count on
_LINE, _LETTER, _MARK = 24, 7.0, 44  # pixels of a line of a legend, of one of its letters, and of its mark with its margins
_MOST = 42  # letters of the name of an axis in one line
_SCALE = 52  # pixels for the scale of colours below a narrow chart


def fitted(options: Mapping[str, Any], room: int = NARROW) -> dict[str, Any]:
    """Options of a chart that fit it at every width, from those that `charts.chart` makes; room: pixels that its legend has
    where it is not narrow. Others, of charts without axes in a plane, are as they were."""
    if "grid" not in options:
        return dict(options)
    wide = _wide(options, room)
    found = {**options, **wide, "legend": {**options["legend"], "type": "plain"}}
    return {**found, "media": [{"query": {"maxWidth": NARROW}, "option": _narrow(options)}, {"option": _wide(options, room)}]}


def _wide(options: Mapping[str, Any], room: int) -> dict[str, Any]:
    found: dict[str, Any] = {"grid": {**options["grid"], "top": _top(options, room)}}
    letters = {"fontSize": 12, "lineHeight": 15, "width": _columns(options, room)[0], "overflow": "break"}
    found["legend"] = {"textStyle": {**options["legend"]["textStyle"], **letters}}
    for axis in ("xAxis", "yAxis"):
        given = options[axis]
        label = {"fontSize": 12, "inside": False, "verticalAlign": "middle" if axis == "yAxis" else "top", "padding": 0}
        found[axis] = {**given, "splitNumber": 5, "z": 0, "axisLabel": {**given["axisLabel"], **label}}
    if "visualMap" in options:
        found["visualMap"] = {**options["visualMap"], "orient": "vertical", "left": "auto", "bottom": "auto"}
    return found


def _narrow(options: Mapping[str, Any]) -> dict[str, Any]:
    x, y = options["xAxis"], options["yAxis"]
    named = y["type"] == "category"  # a name in each row: above what is drawn there, as beside it there is no room
    names = {"inside": True, "verticalAlign": "bottom", "padding": [0, 0, 9, 0], "width": _LEAST}
    name = x["name"] if len(x["name"]) <= _MOST else x["name"].replace(" [", "\n[")
    bottom = 62 if "\n" in name else 44
    letters = {"fontSize": 11, "lineHeight": 15, "width": _columns(options, _LEAST)[0], "overflow": "break"}
    found: dict[str, Any] = {
        "grid": {"left": 10 if named else 50, "right": 12, "top": _top(options, _LEAST), "bottom": bottom},
        "legend": {"textStyle": {**options["legend"]["textStyle"], **letters}},
        "xAxis": {**x, "name": name, "splitNumber": 3, "nameGap": 34 if "\n" in name else 26,
                  "nameTextStyle": {**x["nameTextStyle"], "lineHeight": 14}, "axisLabel": {**x["axisLabel"], "fontSize": 11}},
        "yAxis": {**y, "splitNumber": 4, "nameGap": 36, "z": 9 if named else 0,
                  "axisLabel": {**y["axisLabel"], "fontSize": 11, **(names if named else {})}},
    }  # fmt: skip
    if "visualMap" in options:
        found["grid"]["bottom"] += _SCALE
        below = {"orient": "horizontal", "left": "center", "right": "auto", "top": "auto", "bottom": 0}
        found["visualMap"] = {**options["visualMap"], **below}
    return found


def _top(options: Mapping[str, Any], room: int) -> int:
    """Pixels above the axes: the legend takes as many lines as its names need in so much room."""
    return 12 + _LINE * _columns(options, room)[1] if options["legend"].get("show", True) else 16


def _columns(options: Mapping[str, Any], room: int) -> tuple[int, int]:
    """Pixels of each name of the legend, which all take as many as the longest, and how many lines they take in so much room.
    A name that is longer than the room is broken."""
    names = dict.fromkeys(options["legend"].get("data") or [one["name"] for one in options["series"]])
    wanted = [_LETTER * len(name) for name in names] or [0.0]
    width = min(room - _MARK, math.ceil(max(wanted)))
    beside = max(1, room // (width + _MARK))
    broken = [max(1, math.ceil(one / width)) if width else 1 for one in wanted]
    return width, sum(max(broken[at : at + beside]) for at in range(0, len(broken), beside))
