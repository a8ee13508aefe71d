"""Read the table of quantities: unit, bounds, symbol and meaning of every input and result.

Validators, docstrings, command-line help, result attributes and axis labels all use this table; units and bounds are defined
nowhere else. The rows are in quantities.csv; the symbols are those of docs/explanation/theory.md.
"""

import csv
from collections.abc import Iterator
from pathlib import Path

from stiction.quantities.quantity import Quantity


def _quantity(bounds: str, **texts: str) -> Quantity:
    """Return the Quantity of one row of the table.

    bounds: interval as text, such as "[0 0.5)"; a bracket includes the end, a parenthesis excludes it. texts: all other
    columns.
    """
    lower, upper = map(float, bounds[1:-1].split())
    return Quantity(**texts, lower=lower, upper=upper, lower_included=bounds[0] == "[", upper_included=bounds[-1] == "]")


def rows_of_table(name: str) -> Iterator[dict[str, str]]:
    """Yield each row of a CSV file in the folder of this module as a dict, column name -> text.

    name: file name. Lines that begin with # are skipped.
    """
    lines = Path(__file__).with_name(name).read_text(encoding="utf-8").splitlines()
    return csv.DictReader(line for line in lines if not line.startswith("#"))


QUANTITIES: dict[str, Quantity] = {row["name"]: _quantity(**row) for row in rows_of_table("quantities.csv")}
