"""Read measured series from CSV files and convert them to SI units."""

import csv
import io
import re
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from stiction.case.addresses import address_of, subject_table
from stiction.case.swept import Address
from stiction.quantities.errors import InputError, InWords, field_named, nearest
from stiction.quantities.paths import read_text
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si

# Results that a file may hold as measured against load; the electrical contact resistance follows from the contact area.
MEASURABLE = (
    "friction_coefficient", "friction_force", "pull_off_force", "contact_area", "area_fraction", "contact_resistance",
    "tangential_stiffness", "mean_separation",
)  # fmt: skip
_NEED_NO_LOAD = ("pull_off_force",)
_HEAD = re.compile(r"\s*([\w.]+)\s*(?:\[\s*(.*?)\s*\])?\s*")
_ERROR = "_error"
_SAMPLE, _NOTES = "sample", ("note", "source")
_LARGEST_FILE, _MOST_ROWS = 10**7, 20_000
_LEAST_ERROR = 1e-10  # smallest standard error, relative to the largest value of the quantity
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d*,\d+([eE][+-]?\d+)?\s*")
_FORM = 'a CSV table whose first line names the columns, e.g. "load [mN],friction_coefficient,friction_coefficient_error"'


@dataclass(frozen=True)
class Measurements:
    """Store n measured values in SI units, with their loads, standard errors and samples.

    Each field has n entries. quantity: name of the measured result, e.g. "friction_force". value: measured value. sample: name
    of the series, "" if missing. load: in N; NaN if missing. error: standard error of the value, NaN if missing. known: numbers
    of the contact in the same row, by address (tuple of keys). line: line number in the file. For [indices], value, load and
    error are dimensionless.
    """

    quantity: tuple[str, ...]
    sample: tuple[str, ...]
    load: np.ndarray
    value: np.ndarray
    error: np.ndarray
    known: tuple[Mapping[Address, float], ...]
    line: tuple[int, ...]

    def __len__(self) -> int:
        return len(self.value)

    @property
    def samples(self) -> list[str]:
        return list(dict.fromkeys(self.sample))

    @property
    def quantities(self) -> list[str]:
        return list(dict.fromkeys(self.quantity))

    def some(self, rows: np.ndarray) -> "Measurements":
        """Return the measurements that `rows` selects: an array of indices, or a boolean mask (n,)."""
        indices = np.flatnonzero(rows) if np.asarray(rows).dtype == bool else np.asarray(rows)
        lists = (tuple(column[i] for i in indices) for column in (self.quantity, self.sample, self.known, self.line))
        quantity, sample, known, line = lists
        return Measurements(quantity, sample, self.load[indices], self.value[indices], self.error[indices], known, line)  # type: ignore[arg-type]


@dataclass(frozen=True)
class _Column:
    """Describe a column of a CSV file of measurements.

    kind: "known" (a number of the contact), "value" (a measured result), "error" (its standard error), "load", "sample" or
    "note". quantity: name of the quantity, "" for "sample" and "note". unit: unit in the column name, "" if none. path: address
    in the case of a number of the contact, () for other kinds.
    """

    kind: str
    quantity: str
    unit: str
    path: Address = ()


def read_measurements(path: Any, content: Mapping) -> Measurements:
    """Read measured values, with their loads and standard errors, from a CSV file, in SI units.

    path: path of the file. content: tables of the case to which the values belong. The first line that is not a comment (#)
    holds the column names, each with its unit in brackets if it has one:

    - one or more of MEASURABLE, e.g. `friction_coefficient`
    - `load [mN]`, needed for every measured value except `pull_off_force`
    - standard errors, e.g. `friction_coefficient_error`: for all values of a quantity or for none
    - `sample`: name of the series
    - numbers of the contact that change from row to row, e.g. `coating.thickness [nm]`
    - `note` and `source`, which are ignored

    Other cells may be empty. Commas separate cells. If the line of column names has a semicolon, semicolons separate all cells,
    and numbers may have decimal commas. For [indices], results and loads are dimensionless. Raises InputError, which states the
    line or column, for an invalid file.
    """
    if not isinstance(path, str | PathLike):
        raise InputError("--data", path, "the path of a CSV file")
    text = read_text(Path(path), "--data", "a CSV file", _LARGEST_FILE)
    lines = [(line_number, line) for line_number, line in enumerate(text.splitlines(), start=1) if _is_data_line(line)]
    if not lines:
        raise InputError("--data", str(path), f"{_FORM}; this file is empty")
    between = ";" if ";" in lines[0][1] else ","
    heads = _cells(*lines[0], between)
    columns = [_column(head, content) for head in heads]
    _check_heads(columns, heads)
    entries: list[tuple] = []
    for line_number, line in lines[1:]:
        cells = _cells(line_number, line, between)
        if len(cells) != len(heads):
            raise InputError(
                f"line {line_number}", InWords(f"{len(cells)} cells"), f"{len(heads)} cells, one for each column name"
            )
        entries += _entries(line_number, dict(zip(heads, cells, strict=True)), dict(zip(heads, columns, strict=True)))
    if not entries:
        raise InputError("--data", str(path), "at least one measured value")
    if len(entries) > _MOST_ROWS:
        raise InputError("--data", InWords(f"{len(entries)} values"), f"{_MOST_ROWS} at most")
    quantity, sample, load, value, error, known, number = zip(*entries, strict=True)
    measured = Measurements(quantity, sample, np.array(load), np.array(value), np.array(error), known, number)
    _check_errors(measured)
    return measured


def _cells(line_number: int, line: str, between: str) -> list[str]:
    try:
        cells = next(csv.reader(io.StringIO(line), delimiter=between))
    except csv.Error:  # the csv module refuses cells of more than 131072 characters
        raise InputError(
            f"line {line_number}", line, "cells of at most 131072 characters, separated by commas or semicolons"
        ) from None
    if between == ",":
        return cells
    # Spreadsheets in many countries write decimal commas. A cell with both a comma and a point is refused later as no number.
    return [cell.replace(",", ".") if _DECIMAL_COMMA.fullmatch(cell) else cell for cell in cells]


def _is_data_line(line: str) -> bool:
    return bool(line.strip().strip(",;")) and not line.lstrip().startswith("#")


def _column(head: str, content: Mapping) -> _Column:
    match = _HEAD.fullmatch(head)
    if match is None or not match[1][0].isalpha():
        raise InputError("--data", head, _FORM)
    name, unit = match[1], match[2] or ""
    if name == _SAMPLE or name in _NOTES:
        return _Column(_SAMPLE if name == _SAMPLE else "note", "", "")
    plain = subject_table(content) == "indices"
    if name == "load":
        return _Column("load", "load", _unit("load", unit, head, plain))
    measured = name.removesuffix(_ERROR)
    if measured in MEASURABLE:
        kind = "value" if name == measured else "error"
        return _Column(kind, measured, _unit(measured, unit, head, plain))
    try:
        path = address_of(name, content, "--data")
    except InputError:
        known = [_SAMPLE, "load", *MEASURABLE, *(f"{quantity}{_ERROR}" for quantity in MEASURABLE), "note"]
        raise InputError("--data", head, f"a number of the contact, or one of these columns: {nearest(name, known)}") from None
    return _Column("known", path[-1], _unit(path[-1], unit, head, False), path)


def _unit(quantity: str, unit: str, head: str, normalised: bool) -> str:
    """Return the unit in the name of a column, "" for a dimensionless quantity.

    quantity: name of the quantity. unit: text between the brackets of the column name. head: full column name, for errors.
    normalised: whether values are dimensionless, so that no unit is allowed. Raises InputError if a unit is missing or not
    allowed.
    """
    wanted = "" if normalised else QUANTITIES[quantity].unit
    if bool(unit) != bool(wanted) and not (wanted == "" and unit == "1"):
        raise InputError(
            "--data",
            head,
            f'a column name with its unit, e.g. "{quantity} [{wanted}]"' if wanted else "no unit: the column is dimensionless",
        )
    return unit if wanted else ""


def _check_heads(columns: list[_Column], heads: list[str]) -> None:
    keys = [(column.kind, column.quantity, column.path) for column in columns if column.kind != "note"]
    for key, head in zip(keys, [h for h, column in zip(heads, columns, strict=True) if column.kind != "note"], strict=True):
        if keys.count(key) > 1:
            raise InputError("--data", head, "each column only once; delete the repetition")
    measured = [column.quantity for column in columns if column.kind == "value"]
    if not measured:
        raise InputError("--data", ", ".join(heads), "a column with a measured quantity: " + ", ".join(MEASURABLE))
    for column in columns:
        if column.kind == "error" and column.quantity not in measured:
            raise InputError("--data", f"{column.quantity}{_ERROR}", f"only together with a column {column.quantity}")
    if not any(column.kind == "load" for column in columns) and set(measured) - set(_NEED_NO_LOAD):
        raise InputError("--data", ", ".join(heads), 'a column with the loads, e.g. "load [mN]"')


def _entries(line_number: int, cells: Mapping[str, str], columns: Mapping[str, _Column]) -> list[tuple]:
    """Return one tuple for each measured value in a line of the file.

    cells: text of each cell by column name. columns: description of each column by column name. A tuple is (quantity, sample,
    load, value, standard error, numbers of the contact by address (tuple of keys), line number), in SI units; a missing load or
    error is NaN, a missing sample "". Raises InputError for a cell that is not allowed, and for a value without the load that
    it needs.
    """
    sample, load, known = "", float("nan"), {}
    values: dict[str, float] = {}
    errors: dict[str, float] = {}
    for head, column in columns.items():
        cell = cells[head].strip()
        if column.kind == "sample":
            sample = cell
        elif column.kind == "note" or not cell:
            continue
        else:
            number = _number(cell, column, f"line {line_number}, {head}")
            if column.kind == "known":
                known[column.path] = number
            elif column.kind == "load":
                load = number
            else:
                (values if column.kind == "value" else errors)[column.quantity] = number
    for quantity in values:
        if not np.isfinite(load) and quantity not in _NEED_NO_LOAD:
            raise InputError(f"line {line_number}", None, f"a load for each measured {quantity}")
        if quantity == "friction_coefficient" and not load > 0.0:
            raise InputError(f"line {line_number}, load", load, "above 0 for a measured friction_coefficient")
        if quantity in errors and not errors[quantity] > 0.0:
            raise InputError(f"line {line_number}, {quantity}{_ERROR}", errors[quantity], "above 0")
    return [(q, sample, load, value, errors.get(q, float("nan")), known, line_number) for q, value in values.items()]


def _number(cell: str, column: _Column, where: str) -> float:
    try:
        plain = float(cell)
    except ValueError:
        raise InputError(where, cell, "a number with a decimal point; a decimal comma needs semicolons between cells") from None
    if not np.isfinite(plain):
        raise InputError(where, cell, "a finite number")
    with field_named(where):
        return float(to_si(f"{cell} {column.unit}" if column.unit else plain, column.quantity))


def _check_errors(measured: Measurements) -> None:
    """Raise InputError if a fit cannot use the standard errors.

    Each quantity must have a standard error for every measured value or for none. No error may be below 1e-10 of the largest
    value of its quantity.
    """
    for quantity in measured.quantities:
        rows = np.array([name == quantity for name in measured.quantity])
        there = np.isfinite(measured.error[rows])
        if there.any() and not there.all():
            line = np.array(measured.line)[rows][~there][0]
            raise InputError(
                f"line {line}, {quantity}{_ERROR}", None, f"a standard error for each value of {quantity}, or for none"
            )
        least = _LEAST_ERROR * np.abs(measured.value[rows]).max()
        small = rows & (measured.error < least)
        if small.any():
            index = int(np.flatnonzero(small)[0])
            allowed = f"at least {show(float(least), quantity)}, which is {_LEAST_ERROR:g} of the largest value"
            raise InputError(f"line {measured.line[index]}, {quantity}{_ERROR}", float(measured.error[index]), allowed)
