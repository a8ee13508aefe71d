"""Read the one table of quantities: units, bounds, symbols and meanings of everything that goes in or comes out.

Validators, docstrings, command-line help, result attributes and axis labels read it; nothing else states a unit or a bound. Its
rows are in quantities.csv; the symbols are those of docs/theory.md.
"""

import csv
from pathlib import Path

from stiction.quantities.quantity import Quantity


def _quantity(bounds: str, **texts: str) -> Quantity:
    """Return the quantity of a row; bounds: an interval such as "[0 0.5)"."""
    lower, upper = map(float, bounds[1:-1].split())
    return Quantity(**texts, lower=lower, upper=upper, lower_included=bounds[0] == "[", upper_included=bounds[-1] == "]")


def _read() -> dict[str, Quantity]:
    lines = Path(__file__).with_name("quantities.csv").read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return {row["name"]: _quantity(**row) for row in rows}


QUANTITIES: dict[str, Quantity] = _read()
