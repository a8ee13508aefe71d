"""List the models and laws, materials and interface states of the package."""

from collections.abc import Iterable, Mapping
from typing import Any

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.text import Text

from stiction.contact.interfaces import interfaces
from stiction.contact.materials import Material, material, material_names, symbols_of
from stiction.quantities.data_files import GRADES
from stiction.quantities.ranges import DIGITS, range_in_words
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.report.table import Column, Table

LISTED = ("youngs_modulus", "poissons_ratio", "hardness", "surface_energy")


def material_rows(names: Iterable[str] | None = None) -> list[dict[str, Any]]:
    """Return material presets as dicts with name, symbols and numbers; each number has a value, unit, range and source.

    names: presets to list; None for all. Raises InputError for an unknown name.
    """
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
    """Format a property of a material preset with its range, "82 GPa (82 to 83 GPa)"; "" if the preset does not have it."""
    value = getattr(preset, name)
    if value is None:
        return ""
    ends = f" ({range_in_words(*preset.range[name], name)})" if name in preset.range else ""
    return show(value, name, DIGITS) + ends


def materials_table(names: Iterable[str]) -> Table:
    """Return a table of the named material presets, one row each, with the range of a property below its value."""
    columns = [Column("material\n"), *(Column(f"{QUANTITIES[name].symbol}\nrange", wrap=True) for name in LISTED)]
    rows = [
        [_lines(name, ", ".join(symbols_of(name))), *(_two_lines(material(name), quantity) for quantity in LISTED)]
        for name in names
    ]
    return Table(columns, rows, ruled=True, gap=1)


def _two_lines(preset: Material, name: str) -> Text:
    """Return a table cell with a material property and, on a second line, its range."""
    number, _, ends = with_range(preset, name).partition(" (")
    return _lines(number, ends.removesuffix(")"))


def _lines(first: str, second: str) -> Text:
    """Return a table cell of two lines; the second line is dim."""
    return Text(first) + Text(f"\n{second}", style="dim")


def material_in_full(name: str) -> Group:
    """Describe one material preset: every property with its value, range and source."""
    preset = material(name)
    symbols = "".join(f", {other_symbol}" for other_symbol in symbols_of(preset.name))
    lines: list[RenderableType] = [Text(preset.name, style="bold") + Text(symbols)]
    for quantity, source in (preset.source if isinstance(preset.source, dict) else {}).items():
        row = QUANTITIES[quantity]
        lines.append(Text(f"{row.symbol}, {row.meaning.partition(',')[0]}: {with_range(preset, quantity)}"))
        lines.append(Padding(Text(source), (0, 0, 0, 4)))
    return Group(*lines)


# Quantity -> factor of a strength without a unit: H hardness, G shear modulus.
_TIMES = {"interfacial_shear_strength": "", "shear_strength": " H", "strength_over_shear_modulus": " G"}


def median_in_words(number: Mapping[str, Any] | None) -> str:
    """Format the median of an interface property: "25 MPa", "0.15 H" or "0.4 G" (H: hardness, G: shear modulus).

    number: the property as a dict; None, if the interface state does not have it, gives "none".
    """
    if number is None:
        return "none"
    return show(number["value"], number["quantity"]) + _TIMES.get(number["quantity"], "")


def range_of(number: Mapping[str, Any] | None) -> str:
    """Format the 5 % and 95 % quantiles of an interface property as "low to high"; "" for None."""
    return "" if number is None else number["range_in_words"] + _TIMES.get(number["quantity"], "")


def grade_of(number: Mapping[str, Any] | None) -> str:
    """Return the grade of evidence for an interface property, a key of GRADES such as "B"; "" for None."""
    return "" if number is None else number["grade"]


def _with_grade(number: Mapping[str, Any] | None) -> str:
    return "" if number is None else f"{range_of(number)} ({grade_of(number)})"


def interfaces_table() -> Group:
    """Return a table of all interface states, one line each, with a legend and an example of how a case specifies a state.

    The table is at most 80 columns wide.
    """
    rows = []
    for row in interfaces():
        numbers = row["strength"], row["pressure_coefficient"]
        cells = [text for number in numbers for text in (median_in_words(number), _with_grade(number))]
        rows.append([row["name"], *cells])
    table = Table([*map(Column, ("state", "tau_0", "90 % (grade)", "alpha", "90 % (grade)"))], rows, ruled=True, gap=1)
    letters = [Text(f"{letter}: {meaning}") for letter, meaning in GRADES.items()]
    meaning = Text("Strength: tau_0 + alpha p. H: hardness of the softer body")
    return Group(table, meaning, *letters, _how_to_state("oxidised metal"))


def _how_to_state(name: str) -> Text:
    return Text(f'In a case, under [contact]: interface = "{name}"\nIn Python: st.Contact(..., interface="{name}")')


def interface_in_full(name: str) -> Group:
    """Describe one interface state: strength, sources, allowed pairs of materials, and uses to avoid."""
    (row,) = interfaces([name])
    lines: list[RenderableType] = [Text(name, style="bold")]
    for number in filter(None, (row["strength"], row["pressure_coefficient"])):
        text = f"{median_in_words(number)}, 90 % range {range_of(number)}, grade {number['grade']}"
        lines += [
            Text(f"{QUANTITIES[number['quantity']].symbol}: {text}"),
            Padding(Text(number["source"]), (0, 0, 0, 4)),
        ]
    if (limit := row["pressure_limit"]) is not None:
        lines.append(Text(f"valid up to {show(limit['value'], 'pressure_limit')} on the contact spots, grade {limit['grade']}"))
        lines.append(Padding(Text(limit["source"]), (0, 0, 0, 4)))
    with_one = f"; one body of {', '.join(row['only_with'])} or a material of your own" if row["only_with"] else ""
    pairs = (f"{pair} (a film)" if row["of_film"] and not weight else pair for pair, weight in row["pairs"].items())
    lines.append(Text(f"allowed between: {'; '.join(pairs)}{with_one}"))
    lines += [Text(f"not for: {row['not_for']}"), _how_to_state(name)]
    return Group(*lines)
