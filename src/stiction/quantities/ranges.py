"""Read and check the ranges (low and high value) of material properties, from which uncertainty studies draw samples."""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator

from stiction.quantities.errors import InputError, field_named
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si

DIGITS = 3  # significant digits with which the ends of a range are shown
_FORM = 'a table of low and high values, e.g. hardness = ["0.3 GPa", "0.5 GPa"]'


def _read(value: Any) -> dict[str, tuple[float, float]]:
    if not isinstance(value, Mapping):
        raise InputError("", value, _FORM)
    return {str(name): _read_range(name, ends) for name, ends in value.items()}


def _read_range(name: Any, ends: Any) -> tuple[float, float]:
    """Return (low, high) of a range in SI units, from two numbers or texts with units.

    name: key of a quantity in QUANTITIES. ends: list with the low and the high value. Raises InputError for anything else.
    """
    if name not in QUANTITIES:
        raise InputError(str(name), ends, f"a range of a material property; {name} is not one")
    if not isinstance(ends, list | tuple) or len(ends) != 2:
        raise InputError(name, ends, f"two values, low and high: {QUANTITIES[name].wanted}")
    try:
        with field_named(name):
            low, high = (float(to_si(end, name)) for end in ends)
    except InputError:
        raise
    except (TypeError, ValueError):
        raise InputError(name, ends, "two single values, low and high") from None
    if low > high:
        raise InputError(name, list(ends), "the low value before the high value")
    return low, high


# Name of a quantity -> (low, high) in SI units; the user states both as numbers or texts with units.
Ranges = Annotated[
    dict[str, tuple[float, float]],
    BeforeValidator(_read, json_schema_input_type=dict[str, tuple[str | float, str | float]]),
]


def range_in_words(low: float, high: float, name: str) -> str:
    """Return a range as text: "82 to 83 GPa", or "500 kPa to 2 GPa" if the ends have different unit prefixes.

    low, high: in SI units. name: key of the quantity in QUANTITIES.
    """
    first, last = show(low, name, DIGITS), show(high, name, DIGITS)
    number, _, unit = first.partition(" ")
    return f"{number if unit == last.partition(' ')[2] else first} to {last}"


def check_ranges(record: Any) -> None:
    """Raise an InputError if a range in the field `range` of a record, such as a Material, is invalid.

    A range is valid if the record has a value for the same property and this value lies within the range.
    """
    for name, (low, high) in record.range.items():
        value = getattr(record, name, None)
        if value is None:
            raise InputError(f"range.{name}", [show(low, name), show(high, name)], f"not supported: the material has no {name}")
        if not np.all((np.asarray(value) >= low) & (np.asarray(value) <= high)):
            shown = show(float(np.asarray(value).flat[0]), name)
            raise InputError(f"range.{name}", range_in_words(low, high, name), f"a range that includes {name} = {shown}")
