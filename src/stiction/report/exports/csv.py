"""Write CSV with units in the column heads and without comment lines (RFC 4180), for any program that reads tables."""

import csv
import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def heads_and_rows(table: "xarray.Dataset") -> list[list]:
    """Return a friction table as a list of lists: the heads "name [unit]", then one list of numbers for each row.

    table: dataset of `export`. The head of a dimensionless column has no unit. Numbers have nine significant digits.
    """
    units = {name: variable.attrs["units"] for name, variable in table.items()}
    heads = [f"{name} [{unit}]" if unit != "1" else str(name) for name, unit in units.items()]
    rows = zip(*(table[name].values for name in units), strict=True)
    return [heads, *([float(f"{value:.9g}") for value in row] for row in rows)]


def content(table: "xarray.Dataset") -> str:
    """Return a friction table as CSV text, with nine significant digits.

    table: dataset of `export`, in its consistent units.
    """
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(heads_and_rows(table))
    return text.getvalue()
