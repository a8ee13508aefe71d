"""Values as other packages hold them, told by what they can do: no such package has to be there."""

from collections.abc import Iterator
from typing import Any


def has_unit(value: Any) -> bool:
    """Whether this is a number or an array with a unit of its own, as pint has them."""
    return hasattr(value, "magnitude") and hasattr(value, "units")


def is_series(value: Any) -> bool:
    """Whether this is a column of a table, as pandas has them."""
    return hasattr(value, "to_numpy") and hasattr(value, "index") and getattr(value, "ndim", 0) == 1


def as_sequence(value: Any) -> Any:
    """Return a column of a table, a range or a generator as a sequence; everything else unchanged."""
    if isinstance(value, range | Iterator):
        return list(value)
    if is_series(value):
        numbers = value.to_numpy()
        return numbers if numbers.dtype.kind in "iuf" else numbers.tolist()
    return value
