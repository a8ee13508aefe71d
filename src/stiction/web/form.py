"""The form: fields and sliders made from the records of a case. What is wrong is said beside the field."""

from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from nicegui import ui

from stiction.contact.materials import material, material_names
from stiction.quantities.errors import InputError
from stiction.records.registry import kinds_of_additions
from stiction.solving.choice import DEFAULT_MODEL
from stiction.surfaces.finished import is_finished
from stiction.web.asked import keys_by_choice, option_values, states_of
from stiction.web.drawn import attributes
from stiction.web.explorer import Explorer
from stiction.web.fields import (
    NOT_STATED,
    OPTIONAL_PARTS,
    ROUGHNESS,
    SURFACE_KNOWN_BY,
    Choices,
    Number,
    Part,
    as_written,
    got,
    numbers_of,
    parts_of,
    placed,
)  # fmt: skip

_OWN = "numbers of its own"
_STRENGTH = "a stated strength"
_PREDICTION = "recommended"
_NONE = "the model's own"
_LABELS = {"kind": "kind of surface"}
# Laws that may be left out of a contact that would have them.
_MAY_BE_NONE = ("tangential", *(name for name, kind in kinds_of_additions().items() if kind.default))
_SEPARATIONS = {"start": 4, "stop": -1, "count": 51}
_LOADS = {"start": "1 mN", "stop": "100 N", "count": 51, "spacing": "log"}
_PLAIN_LOADS = {"start": 1e-6, "stop": 0.1, "count": 51, "spacing": "log"}  # per asperity, of dimensionless groups
_ENDINGS = {"first": "first body", "second": "second body"}


class Form:
    """The form of one visitor; made anew where the case gets other fields, and else left as it is while a knob moves."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._inputs: dict[tuple[str, ...], Any] = {}
        self._switched_off: dict[tuple[str, ...], Any] = {}  # numbers of parts, which come back with them
        self._strength_chosen = False  # in place of a state of the interface, also before there is a number
        self._next: ui.label | None = None  # what to state of the interface
        self._other = ui.label().classes("text-negative").props('role="alert"')  # an error of no field
        self._column = ui.column().classes("w-full gap-1")
        self.build()
        explorer.rebuild = self.build
        explorer.listen(self.show)

    def build(self) -> None:
        """All fields, from the tables of the case."""
        self._inputs.clear()
        self._next = None
        self._column.clear()
        with self._column:
            self._model()
            self._points()
            for part in parts_of(self._explorer.question.tables):
                self._part(part)
        self.show()

    def show(self) -> None:
        """Errors of the newest answer, beside their fields, and what to state of the interface."""
        error = self._explorer.answer.error
        if self._next is not None:
            data = self._explorer.good.data
            self._next.set_text(data.attrs.get("next_step", "").capitalize() if data is not None else "")
        beside = False
        for path, one in self._inputs.items():
            wrong = error is not None and _is_of(error, path)
            one.error = str(error) if wrong else None
            beside |= wrong
        self._other.set_text("" if error is None or beside else str(error))
        self._other.set_visibility(error is not None and not beside)

    def _model(self) -> None:
        tables, good = self._explorer.question.tables, self._explorer.good
        solve, keys = tables.get("solve", {}), keys_by_choice(good.case)
        with ui.expansion("Model and laws", value=True).classes("w-full").props("dense"):
            given = str(solve.get("model", _PREDICTION if good.prediction is not None else DEFAULT_MODEL))
            self._menu("model", [_PREDICTION, *keys.pop("model")], given, ("solve", "model"), self._choose_model)
            if good.prediction is not None:
                ui.label("recommended: the prediction by all that is known; a model by name answers alone").classes("text-xs")
            with ui.expansion("Other laws than its own").classes("w-full").props("dense"):
                for choice, laws in keys.items():
                    known = [_NONE, *laws, *(["none"] if choice in _MAY_BE_NONE else [])]
                    self._menu(choice, known, str(solve.get(choice, _NONE)), ("solve", choice))
            for name, values in option_values(good.data).items():
                here = ("solve", "options", name) if name in solve.get("options", {}) else ("solve", name)
                self._menu(name.replace("_", " "), list(values), str(got(tables, here) or values[0]), here)

    async def _choose_model(self, name: str) -> None:
        """Answer with a model; with the prediction, laws and options that are named go too."""
        tables = self._explorer.question.tables
        kept = {key: one for key, one in tables.get("solve", {}).items() if key in ("load", "separation")}
        await self._explorer.ask({**tables, "solve": kept} if name == _PREDICTION else placed(tables, ("solve", "model"), name))

    def _menu(
        self,
        label: str,
        values: list[str],
        value: str,
        path: tuple[str, ...],
        choose: Callable[[str], Awaitable[None]] | None = None,
        searched: bool = False,
    ) -> ui.select:
        """A menu; a value that is none of its own is added. choose: asks with what was chosen, by default puts it at its place;
        then the form is made anew; searched: a name may be typed."""

        async def chosen(event: Any) -> None:
            if choose is None:
                await self._explorer.put(path, None if event.value in (_NONE, NOT_STATED) else event.value)
            else:
                await choose(event.value)
            self.build()

        known = list(dict.fromkeys([*values, value]))
        menu = ui.select(known, value=value, label=label, on_change=chosen, with_input=searched).classes("w-full")
        self._inputs[path] = attributes(menu.props("dense outlined options-dense"), aria_label=label)
        return menu

    def _points(self) -> None:
        """Choose between separations and loads, with their ends and their number."""
        tables = self._explorer.question.tables
        solve = tables.get("solve", {})
        by = "load" if "load" in solve else "separation"
        given = solve.get(by)

        async def other(event: Any) -> None:
            kept = {name: value for name, value in solve.items() if name not in ("load", "separation")}
            loads = _PLAIN_LOADS if "indices" in tables else _LOADS
            points = loads if event.value == "load" else _SEPARATIONS
            await self._explorer.ask({**tables, "solve": {**kept, event.value: dict(points)}})
            self.build()

        with ui.expansion("Points of the curve").classes("w-full").props("dense"):
            ui.toggle({"load": "loads", "separation": "separations"}, value=by, on_change=other).props("dense no-caps")
            if not isinstance(given, Mapping):
                ui.label(f"{by}: {as_written(given)}").classes("text-sm")
                return
            for key, kind in (("start", float), ("stop", float), ("count", int)):
                path = ("solve", by, key)
                text = ui.input(key, value=str(given.get(key, ""))).props("dense outlined debounce=300").classes("w-full")
                text.on_value_change(lambda event, path=path, kind=kind: self._explorer.put(path, _read(event.value, kind)))
                self._inputs[path] = text
            spacing = ui.toggle(["linear", "log"], value=str(given.get("spacing", "linear"))).props("dense no-caps")
            spacing.on_value_change(lambda event: self._explorer.put(("solve", by, "spacing"), event.value))

    def _part(self, part: Part) -> None:
        tables = self._explorer.question.tables
        given = got(tables, part.path)
        title = " ".join(_ENDINGS.get(one, one.replace("_", " ")) for one in part.path[1:]) or part.path[0]
        with ui.expansion(title.capitalize(), value=len(part.path) < 3).classes("w-full").props("dense"):
            if part.optional:
                there = f"there is a {title}"
                switch = ui.switch(there, value=given is not None, on_change=lambda event: self._switch(part, event.value))
                attributes(switch, aria_label=there)
                if given is None:
                    return
            if isinstance(given, Mapping) and part.path == ROUGHNESS:
                if given.keys() & {"first", "second"}:
                    words = "as of finishes: see the case file" if is_finished(given) else "measured: see the tab Surface"
                    ui.label(words).classes("text-sm")
                    return
                self._known_by(given)
            for one in part.fields:
                if isinstance(one, Number):
                    self._number(one)
                elif isinstance(one, Choices):
                    label = _LABELS.get(one.path[-1], one.path[-1])
                    self._menu(label, list(one.values), str(got(tables, one.path) or one.default), one.path)
                elif one.path[-1] == "interface":
                    self._interface(one)
                else:
                    self._material(one)

    async def _switch(self, part: Part, there: bool) -> None:
        """Put a part into the case, with its numbers of before, or take it out."""
        if not there:
            self._switched_off[part.path] = got(self._explorer.question.tables, part.path)
        numbers = self._switched_off.get(part.path) or OPTIONAL_PARTS.get(part.path[-1])
        await self._explorer.put(part.path, numbers if there else None)
        self.build()

    def _known_by(self, given: Mapping[str, Any]) -> None:
        """A menu of what is known of the surface: numbers of asperities, or a finish with Sq or Ra."""

        async def chosen(value: str) -> None:
            self._switched_off[(*ROUGHNESS, known)] = given
            new = self._switched_off.get((*ROUGHNESS, value)) or SURFACE_KNOWN_BY[value]
            await self._explorer.put(ROUGHNESS, dict(new))

        known = list(SURFACE_KNOWN_BY)[is_finished(given)]
        self._menu("the surface is known by", list(SURFACE_KNOWN_BY), known, ROUGHNESS, chosen)

    def _interface(self, part: Part) -> None:
        """A menu of states, and in place of a state the numbers of a stated strength."""
        tables, numbers = self._explorer.question.tables, list(numbers_of(part))
        stated = any(got(tables, one.path) is not None for one in numbers)
        state = got(tables, part.path)

        async def chosen(value: str) -> None:
            self._strength_chosen = value == _STRENGTH
            rest = self._explorer.question.tables
            for path in (part.path, *(one.path for one in numbers)):
                rest = placed(rest, path, None)
            await self._explorer.ask(placed(rest, part.path, None if value in (NOT_STATED, _STRENGTH) else value))

        by_number = not state and (stated or self._strength_chosen)
        value = as_written(state) or (_STRENGTH if by_number else NOT_STATED)
        self._menu("interface", [NOT_STATED, *states_of(self._explorer.question), _STRENGTH], value, part.path, chosen)
        ui.label("Either a state of the interface or a stated strength, not both.").classes("text-xs")
        if value == NOT_STATED:
            self._next = ui.label().classes("text-xs text-negative")
        if by_number or stated:
            for number in numbers:
                self._number(number)

    def _material(self, part: Part) -> None:
        """A menu of materials, and the numbers of the one that is chosen."""
        tables = self._explorer.question.tables
        preset = str(got(tables, (*part.path, "preset")) or "")
        own = tables.get("materials")
        names = [_OWN, *(own if isinstance(own, Mapping) else {}), *material_names()]
        label = _ENDINGS.get(part.path[-1], part.path[-1])

        async def chosen(value: str) -> None:
            await self._explorer.put(part.path, {} if value == _OWN else value)

        menu = self._menu(label, names, preset or _OWN, part.path, chosen, searched=True)
        attributes(menu, aria_label=f"material of the {label}")
        known = material(preset) if preset in material_names() else None
        with ui.expansion(f"numbers of the {label}", value=not preset).classes("w-full").props("dense"):
            for number in numbers_of(part):
                value = getattr(known, number.quantity.name, None)
                self._number(number, "" if value is None else number.text(value))

    def _number(self, one: Number, otherwise: str = "") -> None:
        """A text and, where it holds one number, a slider. otherwise: what holds where the text is empty."""
        given = got(self._explorer.question.tables, one.path)
        value = one.si(given if given is not None else otherwise or None)
        ui.label(one.label).classes("text-xs w-full").style("line-height: 1.25; margin: 4px 0 -12px").props("aria-hidden=true")
        text = ui.input(value=as_written(given), placeholder=otherwise)
        attributes(text.props("dense outlined debounce=300").classes("w-full"), hint=one.help, aria_label=one.label)
        self._inputs[one.path] = text

        async def typed(_: Any) -> None:
            wanted = str(text.value or "").strip()
            if wanted != as_written(got(self._explorer.question.tables, one.path)):  # else it was the slider that wrote it
                await self._explorer.put(one.path, one.written(wanted) if wanted else None)

        text.on_value_change(typed)
        if value is None:
            return
        knob = one.knob(value)
        slider = ui.slider(min=knob.low, max=knob.high, step=knob.step, value=knob.place(value))
        attributes(
            slider.props("dense").classes("w-full px-2"), aria_label=f"{one.label}, slider", aria_valuetext=one.text(value)
        )

        async def moved(event: Any) -> None:
            at = one.text(knob.value(float(event.args)))
            attributes(slider, aria_valuetext=at)
            put = self._explorer.put(one.path, one.written(at))
            text.set_value(at)
            await put

        slider.on("update:model-value", moved, throttle=0.05, leading_events=True)


def _read(text: str, kind: Callable[[str], float]) -> float | str:
    """A number where the text is one; else the text, which the case will judge."""
    try:
        return kind(text)
    except ValueError:
        return text


def _is_of(error: InputError, path: tuple[str, ...]) -> bool:
    """Whether an error is of the field at a place of the tables."""
    where = error.field.removeprefix("contact.").removeprefix("indices.").removeprefix("solve.")
    here = ".".join(path[1:])
    return where == here or error.field == here
