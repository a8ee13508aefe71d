"""Fields for the points of the curve: mean separations or loads, from where to where, and how many."""

from collections.abc import Callable, Mapping
from typing import Any

from nicegui import ui

from stiction.web.explorer import Explorer
from stiction.web.fields import as_written, placed

__all__ = ["points_fields"]

_SEPARATIONS = {"start": 4, "stop": -1, "count": 51}
_LOADS = {"start": "1 mN", "stop": "100 N", "count": 51, "spacing": "log"}
_PLAIN_LOADS = {"start": 1e-6, "stop": 0.1, "count": 51, "spacing": "log"}  # per asperity, of dimensionless groups


def points_fields(explorer: Explorer, inputs: dict[tuple[str, ...], Any], rebuild: Callable[[], None]) -> None:
    """Choose between separations and loads, with their ends and their number. inputs: gets the fields, by their places."""
    tables = explorer.question.tables
    solve = tables.get("solve", {})
    by = "load" if "load" in solve else "separation"

    async def other(event: Any) -> None:
        kept = {name: value for name, value in solve.items() if name not in ("load", "separation")}
        loads = _PLAIN_LOADS if "indices" in tables else _LOADS
        points = loads if event.value == "load" else _SEPARATIONS
        await explorer.ask({**tables, "solve": {**kept, event.value: dict(points)}})
        rebuild()

    with ui.expansion("Points of the curve").classes("w-full").props("dense"):
        ui.toggle({"load": "loads", "separation": "separations"}, value=by, on_change=other).props("dense no-caps")
        given = solve.get(by)
        if not isinstance(given, Mapping):
            ui.label(f"{by}: {as_written(given)}").classes("text-sm")
            return
        for key in ("start", "stop", "count"):
            _end(explorer, inputs, ("solve", by, key), given.get(key))
        _spacing(explorer, ("solve", by, "spacing"), str(given.get("spacing", "linear")))


def _end(explorer: Explorer, inputs: dict[tuple[str, ...], Any], path: tuple[str, ...], value: Any) -> None:
    async def typed(event: Any) -> None:
        await explorer.ask(placed(explorer.question.tables, path, _read(str(event.value), path[-1] == "count")))

    one = ui.input(path[-1], value="" if value is None else str(value), on_change=typed)
    inputs[path] = one.props("dense outlined debounce=300").classes("w-full")


def _read(text: str, whole: bool) -> Any:
    """A number where the text is one; else the text, which the case will judge."""
    try:
        return int(text) if whole else float(text)
    except ValueError:
        return text


def _spacing(explorer: Explorer, path: tuple[str, ...], value: str) -> None:
    async def chosen(event: Any) -> None:
        await explorer.put(path, event.value)

    ui.toggle(["linear", "log"], value=value, on_change=chosen).props("dense no-caps")
