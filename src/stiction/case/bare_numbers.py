"""Check that a case file states the unit of every number that needs one."""

from collections.abc import Mapping
from typing import Any

from stiction.case.distribution import Distribution, is_scipy_law
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES


def refuse_bare_numbers(table: Mapping, path: str) -> None:
    """Raise InputError if a number of the table needs a unit and has none.

    path: dotted name of the table, e.g. "contact.coating"; "" for the whole case.
    """
    for key, value in table.items():
        where = f"{path}.{key}" if path else key
        if isinstance(value, Mapping):
            refuse_bare_numbers(value, where)
        elif where != "solve.load" and not _is_text(value, path) and key in QUANTITIES and QUANTITIES[key].unit:
            raise InputError(where, value, QUANTITIES[key].as_text)


def _is_text(value: Any, path: str) -> bool:
    """Return whether a value is text, or a range of two texts, and so may state a unit.

    Lists and distributions count as text: swept numbers are checked when they are read, and distributions made in Python
    are in SI units.
    """
    if isinstance(value, list):
        return path.rpartition(".")[2] != "range" or all(isinstance(end, str) for end in value)
    return isinstance(value, str | Distribution) or is_scipy_law(value)
