"""Read the table of quantities: unit, bounds, symbol and meaning of every input and result.

Validators, docstrings, command-line help, result attributes and axis labels all use this table; units and bounds are written
nowhere else. The rows are in quantities.csv; the symbols are those of docs/explanation/theory.md.
"""

import csv
from collections.abc import Iterator
from pathlib import Path

from stiction.quantities.quantity import Quantity


def _quantity(bounds: str, **texts: str) -> Quantity:
    """Return the quantity of one row; bounds: an interval such as "[0 0.5)"."""
    lower, upper = map(float, bounds[1:-1].split())
    return Quantity(**texts, lower=lower, upper=upper, lower_included=bounds[0] == "[", upper_included=bounds[-1] == "]")


def rows_of_table(name: str) -> Iterator[dict[str, str]]:
    """Yield the rows of a CSV file of this folder; lines that begin with # are comments."""
    lines = Path(__file__).with_name(name).read_text(encoding="utf-8").splitlines()
    return csv.DictReader(line for line in lines if not line.startswith("#"))


QUANTITIES: dict[str, Quantity] = {row["name"]: _quantity(**row) for row in rows_of_table("quantities.csv")}
