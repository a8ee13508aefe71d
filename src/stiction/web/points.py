"""Fields for the points of the curve: mean separations or loads, from where to where, and how many."""

from collections.abc import Callable, Mapping
from typing import Any

from nicegui import ui

from stiction.web.explorer import Explorer
from stiction.web.fields import as_written

_SEPARATIONS = {"start": 4, "stop": -1, "count": 51}
_LOADS = {"start": "1 mN", "stop": "100 N", "count": 51, "spacing": "log"}
_PLAIN_LOADS = {"start": 1e-6, "stop": 0.1, "count": 51, "spacing": "log"}  # per asperity, of dimensionless groups


def points_fields(explorer: Explorer, inputs: dict[tuple[str, ...], Any], rebuild: Callable[[], None]) -> None:
    """Choose between separations and loads, with their ends and their number. inputs: gets the fields, by their places."""
    tables = explorer.question.tables
    solve = tables.get("solve", {})
    by = "load" if "load" in solve else "separation"
    given = solve.get(by)

    async def other(event: Any) -> None:
        kept = {name: value for name, value in solve.items() if name not in ("load", "separation")}
        loads = _PLAIN_LOADS if "indices" in tables else _LOADS
        points = loads if event.value == "load" else _SEPARATIONS
        await explorer.ask({**tables, "solve": {**kept, event.value: dict(points)}})
        rebuild()

    with ui.expansion("Points of the curve").classes("w-full").props("dense"):
        ui.toggle({"load": "loads", "separation": "separations"}, value=by, on_change=other).props("dense no-caps")
        if not isinstance(given, Mapping):
            ui.label(f"{by}: {as_written(given)}").classes("text-sm")
            return
        for key, kind in (("start", float), ("stop", float), ("count", int)):
            text = ui.input(key, value=str(given.get(key, ""))).props("dense outlined debounce=300").classes("w-full")
            text.on_value_change(lambda event, key=key, kind=kind: explorer.put(("solve", by, key), _read(event.value, kind)))
            inputs["solve", by, key] = text
        spacing = ui.toggle(["linear", "log"], value=str(given.get("spacing", "linear"))).props("dense no-caps")
        spacing.on_value_change(lambda event: explorer.put(("solve", by, "spacing"), event.value))


def _read(text: str, kind: Callable[[str], float]) -> float | str:
    """A number where the text is one; else the text, which the case will judge."""
    try:
        return kind(text)
    except ValueError:
        return text
