"""Read tables of numbers from text: a matrix of heights, columns x y z, or columns x z.

Column separators and decimal marks are detected. A table with two or three columns holds positions and heights, because a map
with so few columns would be too narrow. One line of words above the columns is skipped and noted in the history; it is not
read for units. Lines that begin with # are skipped.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.raw_scan import RawScan, ends_in_a_line, no_channel
from stiction.surfaces.readers.shared.positions import equally_spaced, gridded


def read_text(path: Path, channel, otherwise: Callable[[np.ndarray, tuple[str, ...], str], RawScan]) -> RawScan | None:
    """Read a table of numbers from a text file; with two or three columns it holds positions and heights, x z or x y z.

    channel: must be None. otherwise: function (table, notes, file name) -> RawScan for any other number of columns. Returns
    None for a file that begins with more than one line of words. Raises InputError for a channel, and for a table that cannot
    be read.
    """
    layout = _layout(path)
    if layout is None:
        return None
    no_channel(channel)
    table, notes = _numbers(path, layout)
    columns = _COLUMNS.get(table.shape[1])
    return columns(table, notes) if columns else otherwise(table, notes, path.name)


# ---- columns


def _profile(table: np.ndarray, notes: tuple[str, ...]) -> RawScan:
    heights, size, done = equally_spaced(*table.T)
    return RawScan(heights, "columns x z", size, notes=notes + done)


def _map(table: np.ndarray, notes: tuple[str, ...]) -> RawScan:
    heights, size, done = gridded(*table.T)
    return RawScan(heights, "columns x y z", size, notes=notes + done)


_COLUMNS = {2: _profile, 3: _map}


def matrix(table: np.ndarray, notes: tuple[str, ...], name: str) -> RawScan:
    """Return the RawScan of a matrix of heights, whose rows run along x; a single column is a profile.

    table: heights (rows, columns). notes: for the history. name: name of the file, for the error. Raises InputError if the
    table includes row and column numbers.
    """
    _no_numbering(table, name)
    return RawScan(table.T if table.shape[1] == 1 else table, "matrix of heights", notes=notes)


def _no_numbering(table: np.ndarray, name: str) -> None:
    """Raise InputError if the first row and the first column of a table hold row and column numbers.

    Spreadsheets and data frames write such tables: the numbers start at 0, and the first cell is empty. name: name of the file,
    for the error.
    """
    rows, columns = table.shape
    if (
        np.isnan(table[0, 0])
        and np.array_equal(table[0, 1:], np.arange(columns - 1))
        and np.array_equal(table[1:, 0], np.arange(rows - 1))
    ):
        raise InputError(
            "scan", InWords(f"{name} with row and column numbers"), "heights only; delete the first row and column"
        )


# ---- layout


@dataclass(frozen=True)
class _Layout:
    """Store how the numbers of a text file are written.

    delimiter: column separator; None for blanks. commas: whether commas are decimal marks. ends_rows: whether the delimiter
    also ends each row. heading: the line of words above the columns, or None.
    """

    delimiter: str | None
    commas: bool
    ends_rows: bool
    heading: str | None


def _layout(path: Path) -> _Layout | None:
    """Return the layout of the numbers in a text file: delimiter, decimal mark and heading.

    The result is None if the file does not begin with numbers after at most one line of words. Raises InputError for an empty
    file, for a column of row numbers, and for numbers with decimal commas and decimal points.
    """
    first, second = [*islice(_lines(path), 2), "", ""][:2]
    if not first:
        raise InputError("scan", str(path), "a file with numbers")
    delimiter = _delimiter(second or first)
    names, cells = ([cell.strip() for cell in line.split(delimiter)] for line in (first, second))
    numbers = any(map(_is_number, names)) or not any(names)  # a row of empty cells is a row of missing heights
    if numbers:
        return _surveyed(path, delimiter, None) if not names[0] or _is_number(names[0]) else None
    if len(names) != len(cells) or not any(map(_is_number, cells)):
        return None
    if not names[0]:
        raise InputError("scan", InWords(f"{path.name} with row numbers"), "columns x z, x y z, or heights only")
    return _surveyed(path, delimiter, first)


def _surveyed(path: Path, delimiter: str | None, heading: str | None) -> _Layout:
    """Return the layout of a text file, with the decimal marks and row ends found in all its lines.

    delimiter, heading: already known parts of the layout. Raises InputError if the numbers have decimal commas and decimal
    points.
    """
    commas, points, ends_rows = False, False, delimiter is not None
    for line in islice(_lines(path), bool(heading), None):
        commas = commas or (delimiter != "," and "," in line)
        points = points or "." in line
        ends_rows = ends_rows and line.endswith(delimiter or "")
    if commas and points:
        raise InputError(
            "scan", InWords(f"{path.name} with commas and points in its numbers"), "decimal commas or decimal points"
        )
    return _Layout(delimiter, commas, ends_rows, heading)


def _delimiter(line: str) -> str | None:
    for mark in "\t;":
        if mark in line:
            return mark
    if "," in line and not re.search(r"\d[ ]+[-+\d]", line):
        return ","
    return None  # columns are separated by blanks, and a comma is a decimal mark


def _is_number(text: str) -> bool:
    try:
        float(text.replace(",", "."))
    except ValueError:
        return False
    return True


def _lines(path: Path) -> Iterator[str]:
    """Yield the lines of a text file that are neither empty nor begin with #.

    Bytes that are not valid UTF-8 are replaced; numbers do not contain such bytes.
    """
    with path.open(encoding="utf-8-sig", errors="replace") as file:
        for line in file:
            line = line.strip(" \r\n")
            if line and not line.startswith("#"):
                yield line


# ---- numbers


def _numbers(path: Path, layout: _Layout) -> tuple[np.ndarray, tuple[str, ...]]:
    """Return the numbers of a text file as a table (rows, columns), NaN for empty cells, and notes for the history.

    Raises InputError if the rows differ in length or contain words.
    """
    try:
        table = np.loadtxt(_rows(path, layout), delimiter=layout.delimiter, ndmin=2, comments=None)
    except ValueError as error:
        problem = str(error).partition(";")[0].rstrip(".")
        raise InputError("scan", path.name, f"the same number of values in every row ({problem})") from None
    notes: tuple[str, ...] = ("decimal commas",) if layout.commas else ()
    if layout.heading:
        notes += (f"heading {layout.heading[:60]!r} passed over, not read for units",)
    return table, notes + ends_in_a_line(path)


def _rows(path: Path, layout: _Layout) -> Iterator[str]:
    """Yield the lines of numbers of a text file, with "nan" in empty cells and points as decimal marks."""
    mark = layout.delimiter
    empty = re.compile(f"(?:^|{mark}) *(?:{mark}|$)")
    for line in islice(_lines(path), bool(layout.heading), None):
        if layout.commas:
            line = line.replace(",", ".")
        if mark is not None:
            line = line[:-1] if layout.ends_rows else line
            if empty.search(line):
                line = mark.join(cell.strip(" ") or "nan" for cell in line.split(mark))
        yield line
