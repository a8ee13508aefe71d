"""Refuse numbers without a unit in case files: a reader cannot tell their unit."""

from collections.abc import Mapping
from typing import Any

from stiction.case.distribution import Distribution, is_law
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES


def refuse_bare_numbers(table: Mapping, path: str) -> None:
    """Raise InputError for numbers of a table that need a unit and have none; path: dotted name of the table."""
    for key, value in table.items():
        where = f"{path}.{key}" if path else key
        if isinstance(value, Mapping):
            refuse_bare_numbers(value, where)
        elif where != "solve.load" and not _is_text(value, path) and key in QUANTITIES and QUANTITIES[key].unit:
            raise InputError(where, value, QUANTITIES[key].as_text)


def _is_text(value: Any, path: str) -> bool:
    """Return whether a number is text, or a range with text ends.

    Swept numbers are checked where they are read; distributions in Python are in SI units.
    """
    if isinstance(value, list):
        return path.rpartition(".")[2] != "range" or all(isinstance(end, str) for end in value)
    return isinstance(value, str | Distribution) or is_law(value)
