"""Measured series: a table of text, its units in the heads of its columns, as numbers in SI units."""

import csv
import io
import re
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from stiction.case.places import placed, subject_table
from stiction.case.several import Address
from stiction.quantities.errors import InputError, field_named, nearest
from stiction.quantities.paths import read_text
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import show, to_si

# What may be measured against load: results, and the resistance that follows from the area.
MEASURABLE = (
    "friction_coefficient", "friction_force", "pull_off_force", "contact_area", "area_fraction", "contact_resistance",
    "tangential_stiffness", "mean_separation",
)  # fmt: skip
_NEED_NO_LOAD = ("pull_off_force",)
_HEAD = re.compile(r"\s*([\w.]+)\s*(?:\[\s*(.*?)\s*\])?\s*")
_ERROR = "_error"
_SAMPLE, _NOTES = "sample", ("note", "source")
_LARGEST_FILE, _MOST_ROWS = 10**7, 20_000
_LEAST_ERROR = 1e-10  # of the largest value
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d*,\d+([eE][+-]?\d+)?\s*")
_FORM = (
    "a table with commas or semicolons between its cells and heads like "
    '"load [mN],friction_coefficient,friction_coefficient_error"'
)


@dataclass(frozen=True)
class Measurements:
    """Hold n measured values.

    Each (n,): quantity, sample, load [N] (NaN where none is needed), standard error (NaN where none is stated) and line of the
    file. known: numbers of the contact in the file, path -> value, in SI units.
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
        """Those of these numbers, or where a mask (n,) is true."""
        at = np.flatnonzero(rows) if np.asarray(rows).dtype == bool else np.asarray(rows)
        lists = (tuple(one[i] for i in at) for one in (self.quantity, self.sample, self.known, self.line))
        quantity, sample, known, line = lists
        return Measurements(quantity, sample, self.load[at], self.value[at], self.error[at], known, line)  # type: ignore[arg-type]


@dataclass(frozen=True)
class _Column:
    """Describe a column: role ("known", "value", "error", "load", "sample"), quantity, unit, and address of a known number."""

    kind: str
    quantity: str
    unit: str
    path: Address = ()


def read_measurements(path: Any, content: Mapping) -> Measurements:
    """Read the measured series in a CSV file.

    content: tables of the case that it is compared with. The first line that is no comment (#) has the heads: `load [mN]`;
    one or more of MEASURABLE; its standard error, `friction_coefficient_error`; `sample`, the name of a series; numbers of
    the contact that differ from row to row, by their names in the case, `coating.thickness [nm]`; `note` and `source`, which
    are ignored. A cell may be empty. Cells are separated by commas, or by semicolons if the heads have them; numbers may then
    have decimal commas. Raises InputError, one line with the line of the file and the column.
    """
    if not isinstance(path, str | PathLike):
        raise InputError("--data", path, "the path of a CSV file")
    text = read_text(Path(path), "--data", "a CSV file", _LARGEST_FILE)
    lines = [(at, line) for at, line in enumerate(text.splitlines(), start=1) if _says(line)]
    if not lines:
        raise InputError("--data", str(path), f"{_FORM}; this file is empty")
    between = ";" if ";" in lines[0][1] else ","
    heads = _cells(*lines[0], between)
    columns = [_column(head, content) for head in heads]
    _check_heads(columns, heads)
    entries: list[tuple] = []
    for at, line in lines[1:]:
        cells = _cells(at, line, between)
        if len(cells) != len(heads):
            raise InputError(f"line {at}", f"{len(cells)} cells", f"{len(heads)}, as many as there are heads")
        entries += _entries(at, dict(zip(heads, cells, strict=True)), dict(zip(heads, columns, strict=True)))
    if not entries:
        raise InputError("--data", str(path), "at least one measured value")
    if len(entries) > _MOST_ROWS:
        raise InputError("--data", f"{len(entries)} values", f"{_MOST_ROWS} at most")
    quantity, sample, load, value, error, known, number = zip(*entries, strict=True)
    measured = Measurements(quantity, sample, np.array(load), np.array(value), np.array(error), known, number)
    _check_errors(measured)
    return measured


def _cells(at: int, line: str, between: str) -> list[str]:
    try:
        cells = next(csv.reader(io.StringIO(line), delimiter=between))
    except csv.Error:  # a cell of more than 131072 characters
        raise InputError(f"line {at}", line, "cells with commas between them; one of these is out of all proportion") from None
    if between == ",":
        return cells
    # Spreadsheets of countries with a decimal comma; a cell with a comma and a point is no number, and refused as one.
    return [cell.replace(",", ".") if _DECIMAL_COMMA.fullmatch(cell) else cell for cell in cells]


def _says(line: str) -> bool:
    return bool(line.strip().strip(",;")) and not line.lstrip().startswith("#")


def _column(head: str, content: Mapping) -> _Column:
    match = _HEAD.fullmatch(head)
    if match is None:
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
        path = placed(name, content, "--data")
    except InputError:
        known = [_SAMPLE, "load", *MEASURABLE, *(f"{one}{_ERROR}" for one in MEASURABLE), "note"]
        raise InputError("--data", head, f"a column of {nearest(name, known)}, or a number of the contact") from None
    return _Column("known", path[-1], _unit(path[-1], unit, head, False), path)


def _unit(quantity: str, unit: str, head: str, normalised: bool) -> str:
    """Return the unit of a column. Raises InputError if it is missing, or not allowed."""
    wanted = "" if normalised else QUANTITIES[quantity].unit
    if bool(unit) != bool(wanted) and not (wanted == "" and unit == "1"):
        raise InputError("--data", head, f'a head with its unit, like "{quantity} [{wanted}]"' if wanted else "no unit here")
    return unit if wanted else ""


def _check_heads(columns: list[_Column], heads: list[str]) -> None:
    keys = [(one.kind, one.quantity, one.path) for one in columns if one.kind != "note"]
    for key, head in zip(keys, [h for h, one in zip(heads, columns, strict=True) if one.kind != "note"], strict=True):
        if keys.count(key) > 1:
            raise InputError("--data", head, "each column once")
    measured = [one.quantity for one in columns if one.kind == "value"]
    if not measured:
        raise InputError("--data", ", ".join(heads), "a column of what was measured: " + ", ".join(MEASURABLE))
    for one in columns:
        if one.kind == "error" and one.quantity not in measured:
            raise InputError("--data", f"{one.quantity}{_ERROR}", f"together with a column {one.quantity}")
    if not any(one.kind == "load" for one in columns) and set(measured) - set(_NEED_NO_LOAD):
        raise InputError("--data", ", ".join(heads), 'a column of the loads, like "load [mN]"')


def _entries(at: int, cells: Mapping[str, str], columns: Mapping[str, _Column]) -> list[tuple]:
    """Return the measured values of a line."""
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
            number = _number(cell, column, f"line {at}, {head}")
            if column.kind == "known":
                known[column.path] = number
            elif column.kind == "load":
                load = number
            else:
                (values if column.kind == "value" else errors)[column.quantity] = number
    for quantity in values:
        if not np.isfinite(load) and quantity not in _NEED_NO_LOAD:
            raise InputError(f"line {at}", None, f"a load where {quantity} was measured")
        if quantity == "friction_coefficient" and not load > 0.0:
            raise InputError(f"line {at}, load", load, "above 0 where friction_coefficient was measured")
        if quantity in errors and not errors[quantity] > 0.0:
            raise InputError(f"line {at}, {quantity}{_ERROR}", errors[quantity], "above 0")
    return [(q, sample, load, value, errors.get(q, float("nan")), known, at) for q, value in values.items()]


def _number(cell: str, column: _Column, where: str) -> float:
    try:
        plain = float(cell)
    except ValueError:
        raise InputError(where, cell, "a number, with a decimal point (or comma, with semicolons between the cells)") from None
    if not np.isfinite(plain):
        raise InputError(where, cell, "a finite number")
    with field_named(where):
        return float(to_si(f"{cell} {column.unit}" if column.unit else plain, column.quantity))


def _check_errors(measured: Measurements) -> None:
    """Errors of a quantity are given for all its values, or for none, and no value has more digits than a number."""
    for quantity in measured.quantities:
        of = np.array([one == quantity for one in measured.quantity])
        there = np.isfinite(measured.error[of])
        if there.any() and not there.all():
            line = np.array(measured.line)[of][~there][0]
            raise InputError(f"line {line}, {quantity}{_ERROR}", None, "a standard error for every value, or for none")
        least = _LEAST_ERROR * np.abs(measured.value[of]).max()
        small = of & (measured.error < least)
        if small.any():
            at = int(np.flatnonzero(small)[0])
            allowed = f"{show(float(least), quantity)} or more, {_LEAST_ERROR:g} of the largest value"
            raise InputError(f"line {measured.line[at]}, {quantity}{_ERROR}", float(measured.error[at]), allowed)
