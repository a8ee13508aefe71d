"""Fields of numbers in the form: a name, a text and a slider; and the field of the working load."""

from collections.abc import Mapping
from typing import Any

from nicegui import ui

from stiction.case.several import with_error
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si
from stiction.report.html_words import letters
from stiction.web.drawn import attributes
from stiction.web.explorer import Explorer
from stiction.web.fields import NOT_STATED, Knob, Number, as_written, got

# What a field is called beside it; others by their meaning, which is also what a pointer shows of all of them.
_LABELS = {
    "kind": "kind", "nominal_area": "area Aₙ", "thickness": "thickness t", "asperity_height_deviation": "heights σ",
    "asperity_radius": "tip radius R", "asperity_density": "density N", "work_of_adhesion": "work γ", "bodies": "on body",
    "rms_height": "height Sq", "mean_height": "height Ra", "load": "force P",
}  # fmt: skip
_ROUND_LOAD = 10.0  # ratio of the ends of a range to the load that is set
_LOAD = Number(("solve", "load"), QUANTITIES["load"], True)


def draw_line(one: Number, written: str, value: float | None, otherwise: str = "") -> tuple[ui.input, Any, Any]:
    """Add a name, a text and, where there is a value, a slider; return text, slider and knob."""
    with ui.element("div").classes("number"):
        attributes(ui.label(label_of(one.path)).classes("text-xs one-line").props("aria-hidden=true"), title=one.help)
        text = ui.input(value=written, placeholder=otherwise or ("" if one.required else NOT_STATED))
        attributes(text.props("dense outlined debounce=300 hide-bottom-space"), aria_label=one.label, title=one.help)
        if value is None:
            return text, None, None
        knob = one.knob(value)
        slider = ui.slider(min=knob.low, max=knob.high, step=knob.step, value=knob.place(value)).props("dense")
        attributes(slider, aria_label=f"{one.label}, slider", aria_valuetext=one.text(value))
    return text, slider, knob


def draw_number(explorer: Explorer, one: Number, otherwise: str = "") -> ui.input:
    """Add the text of a number and, where it holds one, a slider; return the text. An uncertain number keeps its error.

    otherwise: the number that holds where the text is empty.
    """
    given = got(explorer.question.tables, one.path)
    value = one.si(given if given is not None else otherwise or None)
    text, slider, knob = draw_line(one, as_written(given), value, otherwise)
    if with_error(given):
        text.classes("uncertain")

    async def typed(_: Any) -> None:
        wanted = str(text.value or "").strip()
        if wanted != as_written(got(explorer.question.tables, one.path)):  # else it was the slider that wrote it
            await explorer.put(one.path, one.written(wanted) if wanted else None)

    text.on_value_change(typed)
    if slider is None:
        return text

    async def moved(event: Any) -> None:
        at = knob.value(float(event.args))
        attributes(slider, aria_valuetext=one.text(at))
        new = one.moved(got(explorer.question.tables, one.path), at)
        put = explorer.put(one.path, new)
        text.set_value(as_written(new))
        await put

    slider.on("update:model-value", moved, throttle=0.05, leading_events=True)
    return text


class LoadField:
    """The working load; where separations are given, it follows from them until it is stated."""

    def __init__(self, explorer: Explorer, inputs: dict[tuple[str, ...], Any]):
        """Draw the field; its text joins the inputs that show errors."""
        self._explorer = explorer
        self._drawn: tuple[Any, Any, Knob] | None = None
        load = self._explorer.load
        if not load > 0.0:
            ui.label("no load presses: see the points of the curve").classes("text-sm")
            return
        text, slider, knob = draw_line(_LOAD, _LOAD.text(load), load)
        inputs[_LOAD.path] = text

        async def put(value: float) -> None:
            if value > 0.0 and _LOAD.text(value) != _LOAD.text(self._explorer.load):
                await self._explorer.ask(_at_load(self._explorer.question.tables, self._explorer.load, value))

        async def typed(_: Any) -> None:
            try:
                value = float(to_si(str(text.value or ""), "load"))
                text.error = None if value > 0.0 else "above 0 N"
            except InputError as error:
                text.error = str(error)
                return
            await put(value)

        async def moved(event: Any) -> None:
            await put(float(f"{knob.value(float(event.args)):.3g}"))

        text.on_value_change(typed)
        slider.on("update:model-value", moved, throttle=0.05, leading_events=True)
        self._drawn = text, slider, knob

    def follow(self) -> None:
        """Show the load that follows from the case."""
        load = self._explorer.load
        if self._drawn is not None and load > 0.0:
            text, slider, knob = self._drawn
            if _LOAD.si(text.value) is None or _LOAD.text(load) != _LOAD.text(_LOAD.si(text.value) or 0.0):
                text.set_value(_LOAD.text(load))
                slider.set_value(knob.place(load))
            attributes(slider, aria_valuetext=_LOAD.text(load))


def _at_load(tables: Mapping[str, Any], before: float, load: float) -> dict[str, Any]:
    """Return the tables at another working load: a single load is replaced, a range is moved with it."""
    solve = {name: one for name, one in tables.get("solve", {}).items() if name != "separation"}
    given = solve.get("load")
    if isinstance(given, Mapping):
        ends = {end: _LOAD.text((_LOAD.si(given[end]) or load) * load / before) for end in ("start", "stop")}
        return {**tables, "solve": {**solve, "load": {**given, **ends}}}
    if given is not None and (not isinstance(given, list) or len(given) == 1):
        return {**tables, "solve": {**solve, "load": [_LOAD.text(load)]}}
    ends = {"start": _LOAD.text(load / _ROUND_LOAD), "stop": _LOAD.text(load * _ROUND_LOAD)}
    return {**tables, "solve": {**solve, "load": {**ends, "count": 21, "spacing": "log"}}}


def label_of(path: tuple[str, ...]) -> str:
    """Return what a field is called beside it."""
    name = path[-1]
    if name in _LABELS or name not in QUANTITIES:
        return _LABELS.get(name, name)
    row = QUANTITIES[name]
    return f"{(row.short or row.meaning).partition(',')[0]} {letters(row.symbol)}"
