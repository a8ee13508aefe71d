"""The states of an interface as what the command line prints and the documentation shows."""

from collections.abc import Mapping
from typing import Any

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.text import Text

from stiction.contact.interfaces import interfaces
from stiction.quantities.data_files import GRADES
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import show
from stiction.report.number_table import ruled_table

# What a strength without a unit is multiplied by.
_TIMES = {"interfacial_shear_strength": "", "shear_strength": " H", "strength_over_shear_modulus": " G"}


def median_in_words(number: Mapping[str, Any] | None) -> str:
    """Return a median as text: "25 MPa", "0.15 H" or "0.4 G"; "none" for a number that the state does not have."""
    if number is None:
        return "none"
    return show(number["value"], number["quantity"]) + _TIMES.get(number["quantity"], "")


def range_of(number: Mapping[str, Any] | None) -> str:
    """Return the 5 and 95 % quantiles as text."""
    return "" if number is None else number["range_in_words"] + _TIMES.get(number["quantity"], "")


def grade_of(number: Mapping[str, Any] | None) -> str:
    """Return the grade of a number, "" where there is none."""
    return "" if number is None else number["grade"]


def interfaces_table() -> Group:
    """Return a line for each state, 80 columns wide at most, and what the letters mean."""
    table = ruled_table("state", "tau_0", "90 % range", "", "alpha", "90 % range", "")
    for column in table.columns:
        column.no_wrap = True
    for row in interfaces():
        numbers = row["strength"], row["pressure_coefficient"]
        cells = [text for number in numbers for text in (median_in_words(number), range_of(number), grade_of(number))]
        table.add_row(row["name"], *cells)
    letters = [Text(f"{letter}: {meaning}") for letter, meaning in GRADES.items()]
    meaning = Text("Strength tau_0 + alpha p; H, G: hardness, shear modulus of the softer body")
    return Group(table, meaning, *letters, _how_to_state("oxidised metal"))


def _how_to_state(name: str) -> Text:
    return Text(f'In a case, under [contact]: interface = "{name}"\nIn Python: st.Contact(..., interface="{name}")')


def interface_in_full(name: str) -> Group:
    """Return all of a state: its numbers, their sources, the pairs that allow it and where it must not be used."""
    (row,) = interfaces([name])
    lines: list[RenderableType] = [Text(name, style="bold")]
    for number in filter(None, (row["strength"], row["pressure_coefficient"])):
        told = f"{median_in_words(number)}, 90 % range {range_of(number)}, grade {number['grade']}"
        lines += [
            Text(f"{QUANTITIES[number['quantity']].symbol}: {told}"),
            Padding(Text(number["source"]), (0, 0, 0, 4)),
        ]
    with_one = f"; one body of {' or '.join(row['only_with'])}" if row["only_with"] else ""
    lines.append(Text(f"allowed between: {'; '.join(row['pairs'])}{with_one}"))
    lines += [Text(f"not for: {row['not_for']}"), _how_to_state(name)]
    return Group(*lines)
