"""Write numbers in SI units as text for users, with suitable unit prefixes."""

import re
from collections.abc import Iterable
from numbers import Real

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.quantity import in_degrees
from stiction.quantities.table import QUANTITIES

# Prefixes are chosen here, because `to_compact` of pint takes 27 times as long, and prints 999.9999999 nm as 1000 nm and
# 1.7e10 1/m^2 as 17000 1/mm^2.
_AREA_SHIFT = 2  # decades by which an area changes its prefix early, because prefixes of areas are six decades apart
_PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def show(value, name: str, digits: int = 6) -> str:
    """Return a value in SI units as short text with a suitable unit prefix, such as "48 nm", "1.25 mN" or "110 deg".

    name: key of the quantity in QUANTITIES. digits: number of significant digits, 6 at most. Areas have at most four digits
    before the point: 0.052 mm^2, not 52000 um^2.
    """
    value, unit = in_degrees(value, QUANTITIES[name].unit)
    value = float(f"{value:.{digits}g}")
    prefixed = re.fullmatch(r"(m|Pa|N|J)(\^[23])?(.*)", unit)
    if prefixed is None or value == 0 or not np.isfinite(value):
        return f"{value:.6g} {unit}".rstrip()
    symbol, raised, rest = prefixed.groups(default="")
    power = int(raised[1:] or 1)  # 1 mm^2 is (1 mm)^2: a prefix counts twice in an area
    # It is rounded to the printed digits first, so that 999.9999999 nm is shown as 1 um and not as 1000 nm.
    exponent = (int(f"{value:.5e}".partition("e")[2]) + (_AREA_SHIFT if power == 2 else 0)) // (3 * power) * 3
    exponent = min(max(exponent, min(_PREFIXES)), max(_PREFIXES))
    return f"{value / 10.0 ** (exponent * power):.6g} {_PREFIXES[exponent]}{symbol}{raised}{rest}"


def span(ends: Iterable[float], form: str = ".3g") -> str:
    """Return a range of numbers as text, "0.31 to 0.45", or a single number if both ends look the same, "0.31".

    ends: the low and the high end. form: format specification of the numbers.
    """
    return " to ".join(dict.fromkeys(format(end, form) for end in ends))


def values_in_words(values, where: str, count: int | None = None) -> InWords:
    """Describe numbers, where only one was expected, as text for an error message: "3 numbers, 100 nm to 2 um".

    values: numbers in SI units. where: dotted name of the input; its last part is the key of the quantity in QUANTITIES. count:
    number of values, needed if `values` holds only the smallest and the largest.
    """
    numbers, name = np.asarray(values, dtype=float).ravel(), where.rpartition(".")[2]
    count = numbers.size if count is None else count
    many = f"{count} number{'' if count == 1 else 's'}"
    if not numbers.size or name not in QUANTITIES:
        return InWords(many)
    ends = dict.fromkeys(show(end, name, 4) for end in (numbers.min(), numbers.max()))
    return InWords(f"{many}, {' to '.join(ends)}")


def reason_of(error: InputError) -> str:
    """Return the reason why an InputError makes a model unusable, as text: a missing input or a value out of range."""
    if error.value is None:
        return f"{error.field} is not given: {error.allowed}"
    name, value = error.field.rpartition(".")[2], error.value
    if name not in QUANTITIES:
        return error.allowed
    return f"{error.field} is {show(value, name, 4) if isinstance(value, Real) else value}; allowed: {error.allowed}"
