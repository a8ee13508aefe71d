"""CSV with units in the heads and no comment lines, for any program that reads a table (RFC 4180)."""

import csv
import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def heads_and_rows(table: "xarray.Dataset") -> list[list]:
    """Return a list of heads, as "name [unit]", and the rows of the table."""
    units = {name: variable.attrs["units"] for name, variable in table.items()}
    heads = [f"{name} [{unit}]" if unit != "1" else str(name) for name, unit in units.items()]
    rows = zip(*(table[name].values for name in units), strict=True)
    return [heads, *([float(f"{value:.9g}") for value in row] for row in rows)]


def content(table: "xarray.Dataset") -> str:
    """Return the table as CSV."""
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(heads_and_rows(table))
    return text.getvalue()
