"""Add number fields to the form, each with name, text and slider, and the field of the working load."""

import math
from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from nicegui import ui

from stiction.case.swept import with_error
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si
from stiction.report.html_words import letters
from stiction.studies.prediction.around import AROUND
from stiction.web.elements import attributes
from stiction.web.explorer import Explorer
from stiction.web.fields import NOT_STATED, Number, as_written, value_at, with_points

# Short labels. Other fields have their meaning as label; a tooltip shows the meaning of every field.
_LABELS = {
    "kind": "kind", "nominal_area": "area Aₙ", "thickness": "thickness t", "asperity_height_deviation": "heights σ",
    "asperity_radius": "tip radius R", "asperity_density": "density N", "work_of_adhesion": "work γ", "bodies": "body",
    "rms_height": "height Sq", "mean_height": "height Ra", "load": "force P", "skewness": "skewness Ssk",
    "kurtosis": "kurtosis Sku", "texture_aspect_ratio": "texture Str",
}  # fmt: skip
_LOAD = Number(("solve", "load"), QUANTITIES["load"], True)


def draw_line(
    number: Number,
    written: str,
    value: float | None,
    typed: Callable[[str], Awaitable[None]],
    moved: Callable[[float], Awaitable[None]],
    otherwise: str = "",
) -> tuple[ui.input, Callable[[float | None], None]]:
    """Add a label, a text field and, if there is a value, a slider; return the text field and a mover of the slider.

    written: content of the text field. value: number in SI units, or None. typed: receives the text of the field. moved:
    receives the number in SI units to which the visitor moves the slider. otherwise: placeholder of the empty text field. The
    mover receives a number in SI units; for None, or without a slider, it does nothing.
    """
    with ui.element("div").classes("number"):
        attributes(ui.label(label_of(number.path)).classes("text-xs one-line").props("aria-hidden=true"), title=number.help)
        empty = otherwise or ("" if number.required else NOT_STATED)
        text = ui.input(value=written, placeholder=empty, validation={})  # old versions of nicegui show no error without a rule
        attributes(text.props("dense outlined debounce=300 hide-bottom-space"), aria_label=number.label, title=number.help)
        text.on_value_change(lambda event: typed(str(event.value or "").strip()))
        if value is None:
            return text, lambda value: None
        knob = number.knob(value)
        slider = ui.slider(min=knob.low, max=knob.high, step=knob.step, value=knob.place(value)).props("dense")
        attributes(slider, aria_label=f"{number.label}, slider", aria_valuetext=number.text(value))
    by_visitor = True

    def changed(event: Any) -> Awaitable[None] | None:
        value = knob.value(float(event.value))
        attributes(slider, aria_valuetext=number.text(value))
        return moved(value) if by_visitor else None

    def move(value: float | None) -> None:
        nonlocal by_visitor
        if value is not None:
            by_visitor = False
            slider.set_value(knob.place(value))
            by_visitor = True
            attributes(slider, aria_valuetext=number.text(value))  # a logarithmic slider cannot stand at 0

    slider.on_value_change(changed)
    return text, move


def draw_number(explorer: Explorer, number: Number, otherwise: str = "") -> ui.input:
    """Add the text field of a number and, if it has a value, a slider, and return the text field.

    otherwise: text of the value that applies if the field is empty. An uncertain number keeps its relative uncertainty when the
    slider moves.
    """

    def given() -> Any:
        return value_at(explorer.query.tables, number.path)

    async def typed(wanted: str) -> None:
        if as_written(wanted) != as_written(given()):  # an equal text was set by the slider
            move(number.si(number.written(wanted or otherwise)))
            await explorer.put(number.path, number.written(wanted) if wanted else None)

    async def moved(value: float) -> None:
        new = number.moved(given(), value)
        text.set_value(as_written(new))
        await explorer.put(number.path, new)

    value = number.si(given() if given() is not None else otherwise or None)
    text, move = draw_line(number, as_written(given()), value, typed, moved, otherwise)
    return text.classes("uncertain") if with_error(given()) else text


def draw_load(explorer: Explorer, inputs: dict[tuple[str, ...], Any]) -> Callable[[], None]:
    """Add the field of the working load, and return a function that updates the field after a new answer.

    inputs: text fields by path in the tables of the case. The new field is added to this dict, so that an error of the load
    appears below the field. If the case states separations, the load follows from them.
    """
    if not explorer.load > 0.0:
        ui.label("The load is not compressive: see the points of the curve.").classes("text-sm")
        return lambda: explorer.rebuild() if explorer.load > 0.0 else None

    return _LoadField(explorer, inputs).follow


class _LoadField:
    """Show the working load as text and slider, and solve the case at another load."""

    def __init__(self, explorer: Explorer, inputs: dict[tuple[str, ...], Any]):
        self._explorer = explorer
        self._asked = load = explorer.load  # working load of the newest query, whose answer may still be missing
        self._text, self._move = draw_line(_LOAD, _LOAD.text(load), load, self._typed, self._moved)
        inputs[_LOAD.path] = self._text

    async def _put(self, load: float) -> None:
        if load > 0.0 and _LOAD.text(load) != _LOAD.text(self._asked):
            before, self._asked = self._asked, load
            tables = self._explorer.query.tables
            if not isinstance(tables.get("solve", {}).get("load"), Mapping):
                self._explorer.view.point = None  # the new load is in the middle of the new range
            await self._explorer.ask(_at_load(tables, before, load))

    async def _typed(self, wanted: str) -> None:
        load, self._text.error = _typed_load(wanted)
        await self._put(load)

    async def _moved(self, load: float) -> None:
        await self._put(float(f"{load:.3g}"))

    def follow(self) -> None:
        """Show the working load of the newest answer."""
        if self._explorer.waits:
            return
        self._asked = load = self._explorer.load
        if not load > 0.0:
            return
        typed = _LOAD.si(self._text.value)
        if typed is None or _LOAD.text(load) != _LOAD.text(typed):
            self._text.set_value(_LOAD.text(load))
        self._move(load)


def _typed_load(text: str) -> tuple[float, str | None]:
    """Return the load [N] of a text, and the error of the text: None for a load above 0. Without a number the load is NaN."""
    try:
        load = float(to_si(text, "load"))
    except InputError as error:
        return math.nan, str(error)
    return load, None if load > 0.0 else "load: must be > 0 N"


def _at_load(tables: Mapping[str, Any], before: float, load: float) -> dict[str, Any]:
    """Return the tables of a case at another working load [N].

    before: present working load [N]. A single load is replaced, and a range is scaled. A list of loads, or a case without
    loads, becomes the range of a prediction's curve, from a tenth to ten times the new load.
    """
    given = tables.get("solve", {}).get("load")
    if given is not None and not isinstance(given, Mapping) and (not isinstance(given, list) or len(given) == 1):
        return with_points(tables, {"load": [_LOAD.written(_LOAD.text(load))]})
    if isinstance(given, Mapping):
        ends = {end: (_LOAD.si(given[end]) or load) * load / before for end in ("start", "stop")}
    else:
        given = {"count": len(AROUND), "spacing": "log"}
        ends = {"start": load * AROUND[0], "stop": load * AROUND[-1]}
    return with_points(tables, {"load": {**given, **{end: _LOAD.written(_LOAD.text(value)) for end, value in ends.items()}}})


def label_of(path: tuple[str, ...]) -> str:
    """Return the label of the form's field for a number or word of a case.

    path: sequence of keys in the tables of the case; the last one decides.
    """
    name = path[-1]
    if name in _LABELS or name not in QUANTITIES:
        return _LABELS.get(name, name)
    row = QUANTITIES[name]
    return f"{(row.short or row.meaning).partition(',')[0]} {letters(row.symbol)}"
