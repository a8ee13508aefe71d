"""Build the hint at the end of an error message that suggests the intended unit or spelling of a number."""

import re

from stiction.quantities.quantity import Quantity

_COMMA = re.compile(r"\s*[+-]?\d*,\d[\d,]*")
_PREFIXES = ("", "p", "n", "u", "m", "k", "M", "G")


def suggest_decimal_point(text: str) -> str:
    """Return a hint that suggests a decimal point for a number with a decimal comma; "" if `text` has no decimal comma.

    For a number with more than one comma, the hint suggests writing it without commas.
    """
    number = _COMMA.match(text[:100])
    if number is None:
        return ""
    if number[0].count(",") > 1:
        return "; write the number without commas"
    return f'; write a decimal point: "{text[:100].strip().replace(",", ".", 1)}"'


def suggest_unit(number: str, unit: str, quantity: Quantity) -> str:
    """Return a hint for an error that suggests the unit the user probably meant; "" if there is no suggestion.

    - number, unit: the two parts of the text that the user wrote; unit is "" if missing
    - quantity: the quantity that was expected

    The suggestion is a unit of this quantity that differs from `unit` only in capitalisation. For a pressure without unit, it
    is the unit of the example in the table of quantities.
    """
    usual = quantity.example.rpartition(" ")[2]
    if not unit:
        return _did_you_mean(number, usual) if quantity.unit == "Pa" else ""
    known = [usual, *(f"{prefix}{quantity.unit}" for prefix in _PREFIXES[::-1])]
    alike = [symbol for symbol in known if symbol.casefold() == unit.casefold()]
    return _did_you_mean(number, alike[0]) if alike else ""


def suggest_larger_unit(value: object, pascals: float, quantity: Quantity) -> str:
    """Return a hint that suggests a larger unit for a pressure below its lower bound; "" for any other value.

    value: the value as the user wrote it, such as "210 mPa". pascals: the same value in Pa. quantity: the expected quantity.
    """
    if quantity.unit != "Pa" or not 0.0 < pascals < quantity.lower:
        return ""
    words = str(value).split()
    if len(words) == 2 and words[1] == "mPa":
        return _did_you_mean(words[0], "MPa")
    return _did_you_mean(f"{pascals:g}", quantity.example.rpartition(" ")[2])


def _did_you_mean(number: str, unit: str) -> str:
    return f'; did you mean "{number} {unit}"?'
