"""Recognise pint and pandas values by their attributes, so that these packages need not be installed."""

from collections.abc import Iterator
from typing import Any


def has_unit(value: Any) -> bool:
    """Return whether a value is a number or array with a unit, such as a pint quantity: it has `magnitude` and `units`."""
    return hasattr(value, "magnitude") and hasattr(value, "units")


def is_series(value: Any) -> bool:
    """Return whether a value is a table column, such as a pandas.Series: one-dimensional, with `to_numpy` and `index`."""
    return hasattr(value, "to_numpy") and hasattr(value, "index") and getattr(value, "ndim", 0) == 1


def as_sequence(value: Any) -> Any:
    """Return a table column, range or iterator as a list or array; return any other value unchanged."""
    if isinstance(value, range | Iterator):
        return list(value)
    if is_series(value):
        numbers = value.to_numpy()
        return numbers if numbers.dtype.kind in "iuf" else numbers.tolist()
    return value
