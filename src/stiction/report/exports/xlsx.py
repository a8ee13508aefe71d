"""Write an Excel workbook (Office Open XML) with openpyxl: one sheet, units in the first row, no comment lines."""

import io
from typing import TYPE_CHECKING

from stiction.quantities.extras import require
from stiction.report.exports.csv import heads_and_rows

if TYPE_CHECKING:
    import xarray


def content(table: "xarray.Dataset") -> bytes:
    """Return a friction table as the bytes of an Excel workbook.

    table: dataset of `export`, in its consistent units. Raises InputError if openpyxl is not installed.
    """
    require("--to xlsx", "openpyxl")
    import openpyxl

    book, made = openpyxl.Workbook(), io.BytesIO()
    book.active.title = "friction"
    for row in heads_and_rows(table):
        book.active.append(row)
    book.active.freeze_panes = "A2"
    book.save(made)
    return made.getvalue()
