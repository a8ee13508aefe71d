"""From a scan to the roughness of a contact: asked for here, answered two rooms above, where scans are understood.

Imports run downwards, so this room cannot name who measures: `stiction` says it, when the first of its names is used.
"""

from collections.abc import Callable
from typing import Any

from stiction.quantities.errors import InputError

__all__ = ["measure", "measured_by"]

_ways: list[Callable[[Any], Any]] = []


def measured_by(way: Callable[[Any], Any]) -> None:
    """From now on a Roughness is found in a scan by this function."""
    _ways[:] = [way]


def measure(scan: Any) -> Any:
    """The Roughness of what is no table of numbers. Raises InputError where it is no scan either; the name of the field, from
    `roughness` on, is left to who asks."""
    if not _ways:
        raise InputError("", type(scan).__name__, "a stiction.Roughness; scans are read by stiction.Contact")
    try:
        return _ways[0](scan)
    except InputError as error:
        raise InputError(error.field.removeprefix("roughness").lstrip("."), error.value, error.allowed) from None
