"""The presets of materials, as rows, one JSON object each, and as what the command line prints."""

from collections.abc import Iterable
from typing import Any

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from stiction.contact.materials import Material, material, material_names, symbols_of
from stiction.quantities.ranges import range_in_words
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import show
from stiction.report.number_table import ruled_table

LISTED = ("youngs_modulus", "poissons_ratio", "hardness", "surface_energy")


def material_rows(names: Iterable[str] | None = None) -> list[dict[str, Any]]:
    """Name and numbers of these presets, or of all: value, unit, low and high end, and source of each. Raises InputError for
    an unknown name."""
    return [_row(material(name)) for name in (material_names() if names is None else names)]


def _row(preset: Material) -> dict[str, Any]:
    sources = preset.source if isinstance(preset.source, dict) else {}
    numbers = {
        name: {
            "value": getattr(preset, name),
            "unit": QUANTITIES[name].unit or "1",
            "range": list(preset.range[name]),
            "source": sources[name],
        }
        for name in sources
    }
    return {"name": preset.name, "symbols": list(symbols_of(preset.name)), "numbers": numbers}


def with_range(preset: Material, name: str) -> str:
    """A number with its range, as text: "82 GPa (82 to 83 GPa)"; "" if there is none."""
    value = getattr(preset, name)
    if value is None:
        return ""
    ends = f" ({range_in_words(*preset.range[name], name)})" if name in preset.range else ""
    return show(value, name) + ends


def materials_table(names: Iterable[str]) -> Table:
    """A line for each of these presets: its numbers, each with its range."""
    table = ruled_table("material\n", *(f"{QUANTITIES[name].symbol}\nrange" for name in LISTED))
    for name in names:
        preset = material(name)
        table.add_row(_lines(name, ", ".join(symbols_of(name))), *(_two_lines(preset, quantity) for quantity in LISTED))
    return table


def _two_lines(preset: Material, name: str) -> Text:
    """A number, and its range below."""
    number, _, ends = with_range(preset, name).partition(" (")
    return _lines(number, ends.removesuffix(")"))


def _lines(first: str, second: str) -> Text:
    """Return two lines of a cell, the second one dim."""
    return Text(first) + Text(f"\n{second}", style="dim")


def material_in_full(name: str) -> Group:
    """Every number of a preset, with its range and its source."""
    preset = material(name)
    symbols = "".join(f", {one}" for one in symbols_of(preset.name))
    lines: list[RenderableType] = [Text(preset.name, style="bold") + Text(symbols)]
    for quantity, source in (preset.source if isinstance(preset.source, dict) else {}).items():
        row = QUANTITIES[quantity]
        lines.append(Text(f"{row.symbol}, {row.meaning.partition(',')[0]}: {with_range(preset, quantity)}"))
        lines.append(Padding(Text(source), (0, 0, 0, 4)))
    return Group(*lines)
