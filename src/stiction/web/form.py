"""Build the form of a case: load, bodies, film, roughness, adhesion and interface, with fields, sliders and errors.

The tables of a case are nested dicts, as they are read from a case file. A path is the sequence of keys to an entry.
"""

from collections.abc import Awaitable, Callable, Mapping
from contextlib import contextmanager
from typing import Any

from nicegui import ui

from stiction.contact.materials import material, material_names
from stiction.quantities.errors import InputError
from stiction.records.registry import kinds_of_additions
from stiction.solving.choice import DEFAULT_MODEL
from stiction.surfaces.finished import is_finished
from stiction.surfaces.roughness import SHAPE
from stiction.web.elements import attributes, folded
from stiction.web.explorer import Explorer
from stiction.web.fields import (
    ENDINGS,
    INTERFACE,
    NOT_STATED,
    OPTIONAL_PARTS,
    ROUGHNESS,
    SURFACE_KNOWN_BY,
    Choices,
    Number,
    Part,
    as_written,
    example_cases,
    numbers_of,
    parts_of,
    value_at,
    with_points,
    with_value_at,
)  # fmt: skip
from stiction.web.number_fields import draw_load, draw_number, label_of
from stiction.web.query import law_names, option_values, states_of

_OWN = "properties of its own"
_STRENGTH = "a stated strength"
_PREDICTION = "recommended"
_NONE = "the model's own"
_SCAN = "a scan"
# Laws that have a default and can be turned off by "none".
_MAY_BE_NONE = ("tangential", *(name for name, kind in kinds_of_additions().items() if kind.default))
_SEPARATIONS = {"start": 4, "stop": -1, "count": 51}
_LOADS = {"start": "1 mN", "stop": "100 N", "count": 51, "spacing": "log"}
_PLAIN_LOADS = {"start": 1e-6, "stop": 0.1, "count": 51, "spacing": "log"}  # normalised loads of dimensionless groups


class Form:
    """Show the form of one visitor.

    The form is rebuilt when fields are added to or removed from the case, but not while a slider moves.
    """

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._inputs: dict[tuple[str, ...], Any] = {}
        self._switched_off: dict[tuple[str, ...], Any] = {}  # removed parts and their numbers, to restore them
        self._strength_chosen = False  # whether the strength is to be stated by number, also before a number is typed
        self._other = ui.label().classes("text-negative").props('role="alert"')  # an error that no field has
        self._column = ui.column().classes("w-full gap-1")
        self.build()
        explorer.rebuild = self.build
        explorer.listen(self.show)

    def build(self) -> None:
        """Build all fields from the tables of the case."""
        self._inputs.clear()
        self._follow: Callable[[], None] = lambda: None  # shows the load of the newest answer
        self._rare: list[Number] = []  # numbers that the case may omit, at the end of the form
        self._column.clear()
        tables = self._explorer.query.tables
        parts = {part.path[-1]: part for part in parts_of(tables)}
        with self._column:
            self._tools()
            if "contact" in parts:
                self._contact(parts)
            else:
                self._fields(parts.pop("indices"))
            self._folded("More", self._more, any(value_at(tables, one.path) is not None for one in self._rare))
            self._folded("Model", self._model)
        self.show()

    def _tools(self) -> None:
        """Add the menu of examples and the buttons for undo and reset."""
        explorer = self._explorer

        async def chosen(event: Any) -> None:
            await explorer.open(example_cases()[event.value])

        with ui.row().classes("w-full items-center gap-1 no-wrap"):
            menu = ui.select(list(example_cases()), label="examples", on_change=chosen).classes("grow").style("min-width: 0")
            attributes(menu.props("dense outlined options-dense"), aria_label="examples")
            for icon, label, work in (("undo", "undo", explorer.undo), ("restart_alt", "reset", self._reset)):
                attributes(ui.button(icon=icon, on_click=work).props("flat dense"), aria_label=label, title=label)

    async def _reset(self) -> None:
        await self._explorer.open(self._explorer.first)

    def _contact(self, parts: dict[str, Part]) -> None:
        """Add the fields of a case with a table [contact].

        parts: parts of the form by the last key of their path.
        """
        part = parts["contact"]
        fields = {one.path[-1]: one for one in part.fields}
        with _group("Load"):
            self._follow = draw_load(self._explorer, self._inputs)
        with _group("Bodies"):
            for body in ("first", "second"):
                self._material(fields.pop(body))  # type: ignore[arg-type]
            self._number(fields.pop("nominal_area"))  # type: ignore[arg-type]
        with _group("Film") as head:
            self._optional(parts["coating"], head)
        with _group("Roughness"):
            self._roughness(parts["roughness"])
        with _group("Adhesion"):
            self._number(fields.pop("work_of_adhesion"))  # type: ignore[arg-type]
            self._optional(parts["liquid"])
        with _group("Interface"):
            self._interface(fields.pop("interface"))  # type: ignore[arg-type]
        self._rare += fields.values()  # type: ignore[arg-type]

    def show(self) -> None:
        """Show the error of the newest query below its field, or above the form if no field has it."""
        error = self._explorer.error
        if error is None:
            self._follow()
        beside = False
        for path, field in self._inputs.items():
            wrong = error is not None and _is_of(error, path)
            field.error = str(error) if wrong else None
            beside |= wrong
        self._other.set_text("" if error is None or beside else str(error))
        self._other.set_visibility(error is not None and not beside)

    def _folded(self, title: str, fill: Callable[[], None], is_open: bool = False, name: str = "") -> None:
        """Add a folded section, as `folded` does, whose opening moves an error that is above the form to its field."""
        folded(title, fill, is_open, name).on_value_change(self.show)

    def _more(self) -> None:
        for one in self._rare:
            self._number(one)

    def _model(self) -> None:
        tables, answer = self._explorer.query.tables, self._explorer.answer
        solve, names = tables.get("solve", {}), law_names(answer.case)
        given = str(solve.get("model", _PREDICTION if answer.is_prediction else DEFAULT_MODEL))
        self._menu("model", [_PREDICTION, *names.pop("model")], given, ("solve", "model"), self._choose_model)
        if answer.is_prediction:
            ui.label("recommended combines all models that apply; a chosen model is shown next to it").classes("text-xs")

        def laws() -> None:
            for choice, known in names.items():
                listed = [_NONE, *known, *(["none"] if choice in _MAY_BE_NONE else [])]
                self._menu(choice, listed, str(solve.get(choice, _NONE)), ("solve", choice))

        self._folded("Replace its laws", laws)
        for name, values in option_values(answer.data).items():
            here = ("solve", "options", name) if name in solve.get("options", {}) else ("solve", name)
            self._menu(name.replace("_", " "), list(values), str(value_at(tables, here) or values[0]), here)
        self._folded("Points of the curve", self._points)

    async def _choose_model(self, name: str) -> None:
        """Solve the case with another model; if the prediction is chosen, remove model, laws and options from the case."""
        tables = self._explorer.query.tables
        kept = {key: one for key, one in tables.get("solve", {}).items() if key in ("load", "separation")}
        await self._explorer.ask(
            {**tables, "solve": kept} if name == _PREDICTION else with_value_at(tables, ("solve", "model"), name)
        )

    def _menu(
        self,
        label: str,
        values: list[str],
        value: str,
        path: tuple[str, ...],
        choose: Callable[[str], Awaitable[None]] | None = None,
        searched: bool = False,
        named: bool = True,
    ) -> None:
        """Add a menu of values to the form; a choice rebuilds the form.

        value: present value, which is listed even if it is not among the values. path: path of the value in the tables of the
        case. choose: receives the choice; by default the choice is stored at the path. searched: whether a name can be typed.
        named: whether the label is shown.
        """

        async def chosen(event: Any) -> None:
            if choose is None:
                await self._explorer.put(path, None if event.value in (_NONE, NOT_STATED) else event.value)
            else:
                await choose(event.value)
            self.build()

        known = {name: name.replace("_", " ") for name in (*values, value)}
        with ui.element("div").classes("number" if named else "w-full"):
            if named:
                ui.label(label).classes("text-xs one-line").props("aria-hidden=true")
            menu = ui.select(known, value=value, on_change=chosen, with_input=searched, validation={}).props(
                "dense outlined options-dense"
            )
            self._inputs[path] = attributes(menu.props("hide-bottom-space"), aria_label=label)

    def _points(self) -> None:
        """Add a switch between loads and separations, and fields for their range: both ends, number and spacing.

        A list of loads or separations is only shown.
        """
        tables = self._explorer.query.tables
        solve = tables.get("solve", {})
        by = "load" if "load" in solve else "separation"
        given = solve.get(by)

        async def other(event: Any) -> None:
            loads = _PLAIN_LOADS if "indices" in tables else _LOADS
            points = loads if event.value == "load" else _SEPARATIONS
            await self._explorer.ask(with_points(tables, {event.value: dict(points)}))
            self.build()

        ui.toggle({"load": "loads", "separation": "separations"}, value=by, on_change=other).props("dense no-caps")
        if not isinstance(given, Mapping):
            ui.label(f"{by}: {as_written(given)}").classes("text-sm")
            return
        for key, kind in (("start", float), ("stop", float), ("count", int)):
            path = ("solve", by, key)
            text = (
                ui.input(key, value=str(given.get(key, "")), validation={})
                .props("dense outlined debounce=300")
                .classes("w-full")
            )
            text.on_value_change(lambda event, path=path, kind=kind: self._explorer.put(path, _read(event.value, kind)))
            self._inputs[path] = text
        spacing = ui.toggle(["linear", "log"], value=str(given.get("spacing", "linear"))).props("dense no-caps")
        spacing.on_value_change(lambda event: self._explorer.put(("solve", by, "spacing"), event.value))

    def _optional(self, part: Part, head: Any = None) -> None:
        """Add a switch for an optional part of the case and, if the switch is on, the fields of the part.

        head: heading beside which the switch is placed; None for a line of its own.
        """
        given = value_at(self._explorer.query.tables, part.path)
        title = ENDINGS.get(part.path[-1], part.path[-1])
        with head or ui.element("div"):
            switch = ui.switch("" if head else title, value=given is not None)
        switch.on_value_change(lambda event: self._switch(part, event.value))
        attributes(switch.props("dense").classes("text-sm"), aria_label=f"there is a {title}")
        if given is not None:
            self._fields(part)

    def _fields(self, part: Part) -> None:
        """Add the fields of a part; optional numbers that the case omits follow at the end of the form."""
        tables = self._explorer.query.tables
        for one in part.fields:
            if isinstance(one, Part):
                self._material(one)
            elif isinstance(one, Choices):
                self._menu(label_of(one.path), list(one.values), str(value_at(tables, one.path) or one.default), one.path)
            elif (
                one.required or value_at(tables, one.path) is not None or (part.path == ROUGHNESS and one.path[-1] not in SHAPE)
            ):
                self._number(one)
            else:
                self._rare.append(one)

    def _roughness(self, part: Part) -> None:
        """Add the fields of the roughness: sigma, R and N, or a finish with Sq or Ra, or a note on a scan."""
        given = value_at(self._explorer.query.tables, ROUGHNESS)
        bodies = isinstance(given, Mapping) and bool(given.keys() & {"first", "second"})
        scanned = bodies and not is_finished(given)
        known = _SCAN if scanned else list(SURFACE_KNOWN_BY)[is_finished(given)]

        async def chosen(value: str) -> None:
            if value == _SCAN and not scanned:
                self._explorer.open_tab("Surface")
                return
            self._switched_off[(*ROUGHNESS, known)] = given
            new = self._switched_off.get((*ROUGHNESS, value)) or SURFACE_KNOWN_BY[value]
            await self._explorer.put(ROUGHNESS, dict(new))

        self._menu("the surface is stated by", [*SURFACE_KNOWN_BY, _SCAN], known, ROUGHNESS, chosen, named=False)
        if bodies:
            text = "measured: see the tab Surface" if scanned else "from finishes: see the case file"
            ui.label(text).classes("text-sm")
            return
        self._fields(part)

    async def _switch(self, part: Part, there: bool) -> None:
        """Put a part into the case, with the numbers that it had before, or remove it.

        there: whether the part is to be in the case.
        """
        if not there:
            self._switched_off[part.path] = value_at(self._explorer.query.tables, part.path)
        numbers = self._switched_off.get(part.path) or OPTIONAL_PARTS.get(part.path[-1])
        tables = with_value_at(self._explorer.query.tables, part.path, numbers if there else None)
        await self._explorer.ask(self._with_allowed_interface(tables))
        self.build()

    def _with_allowed_interface(self, tables: Mapping[str, Any]) -> Mapping[str, Any]:
        """Return case tables without the interface state, if their bodies do not allow it.

        A removed state is put back as soon as the bodies allow it again.
        """
        state = value_at(tables, INTERFACE) or self._switched_off.get(INTERFACE)
        if not isinstance(state, str):
            return tables
        allowed = state in states_of(self._explorer.query.with_tables(tables))
        self._switched_off[INTERFACE] = None if allowed else state
        return with_value_at(tables, INTERFACE, state if allowed else None)

    def _interface(self, part: Part) -> None:
        """Add a menu of interface states and, if the strength is specified by numbers instead, the fields of these numbers."""
        tables, numbers = self._explorer.query.tables, list(numbers_of(part))
        stated = any(value_at(tables, one.path) is not None for one in numbers)
        state = value_at(tables, part.path)

        async def chosen(value: str) -> None:
            self._strength_chosen = value == _STRENGTH
            rest = self._explorer.query.tables
            for path in (part.path, *(one.path for one in numbers)):
                rest = with_value_at(rest, path, None)
            await self._explorer.ask(with_value_at(rest, part.path, None if value in (NOT_STATED, _STRENGTH) else value))

        by_number = not state and (stated or self._strength_chosen)
        value = as_written(state) or (_STRENGTH if by_number else NOT_STATED)
        self._menu(
            "interface", [NOT_STATED, *states_of(self._explorer.query), _STRENGTH], value, part.path, chosen, named=False
        )
        if by_number or stated:
            for number in numbers:
                self._number(number)

    def _number(self, number: Number, otherwise: str = "") -> None:
        """Add the field of a number.

        otherwise: text of the number that applies if the field is empty.
        """
        self._inputs[number.path] = draw_number(self._explorer, number, otherwise)

    def _material(self, part: Part) -> None:
        """Add a menu of materials for one body or film, and the fields of the chosen material."""
        tables = self._explorer.query.tables
        preset = str(value_at(tables, (*part.path, "preset")) or "")
        own = tables.get("materials")
        names = [_OWN, *(own if isinstance(own, Mapping) else {}), *material_names()]
        label = ENDINGS.get(part.path[-1], "film")

        async def chosen(value: str) -> None:
            await self._explorer.put(part.path, {} if value == _OWN else value)

        self._menu(f"material of the {label}", names, preset or _OWN, part.path, chosen, searched=True, named=False)
        known = material(preset) if preset in material_names() else None
        changed = any(value_at(tables, number.path) is not None for number in numbers_of(part))

        def properties() -> None:
            for number in numbers_of(part):
                value = getattr(known, number.quantity.name, None)
                self._number(number, "" if value is None else number.text(value))

        title = "properties" + (", changed" if preset and changed else "")
        self._folded(title, properties, not preset, f"properties of the {label}")


@contextmanager
def _group(title: str) -> Any:
    """Return a context manager that adds a titled group to the form; fields added within it belong to the group."""
    with ui.element("div").classes("group"):
        with ui.element("div").classes("group-head") as head:
            ui.label(title).classes("font-bold text-sm")
        with ui.element("div"):
            yield head


def _read(text: str, kind: Callable[[str], float]) -> float | str:
    """Convert text to a number by `kind`; text that is not a number is returned unchanged.

    Reading the case then raises an error that names the field.
    """
    try:
        return kind(text)
    except ValueError:
        return text


def _is_of(error: InputError, path: tuple[str, ...]) -> bool:
    """Return whether an error concerns the field at a path in the tables of the case."""
    where = error.field.removeprefix("contact.").removeprefix("indices.").removeprefix("solve.")
    here = ".".join(path[1:])
    return where == here or error.field == here
