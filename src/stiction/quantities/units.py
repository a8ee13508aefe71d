"""Read text with units ("48 nm") and other inputs as numbers in SI units; no other module reads units.

The file units.csv lists common units. All others are read by pint, which is imported only when needed, because its import is
slow.
"""

import math
import re
import shutil
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction
from functools import cache
from numbers import Real
from typing import Any

import numpy as np

from stiction.quantities.cache import cache_folder
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.extras import bring_back
from stiction.quantities.quantity import Quantity
from stiction.quantities.table import QUANTITIES, rows_of_table

_NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.DOTALL)
# pint evaluates each unit, and "m^9^9^9" would take forever: only products of single-digit powers are passed to pint.
_POWER = r"(?:1|%|[^\W\d]+(?:(?:\^|\*\*)[+-]?\d|⁻?[⁰¹²³⁴-⁹])?)"
_UNIT = re.compile(rf"/?\s*{_POWER}(?:(?:\s*[/*·]\s*|\s+){_POWER})*")
_LONGEST_TEXT = 100  # characters; no quantity needs more, and the patterns above are slow on megabytes of text
_COMMAS = re.compile(r"\s*[+-]?\d*,\d[\d,]*")
_ERROR = re.compile(r"\d.*(\+/?-|±)\s*\d")
_CELSIUS = ("degC", "°C", "celsius", "deg C")  # allowed for temperatures only, because no factor converts them to kelvins
_ZERO_CELSIUS = 273.15
_PREFIXES = ("", "p", "n", "u", "m", "k", "M", "G")

# A Vickers number is the force in kgf divided by the area of the imprint's facets in mm^2 (ISO 6507-1). The mean pressure is
# the force divided by the projected area, which is sin(136 deg / 2) times the area of the facets. So 1 HV is 9.80665 MPa / sin
# 68 deg = 10.577 MPa (ISO 14577-1: HV = 0.0945 H_IT).
_VICKERS = 9.80665e6 / math.sin(math.radians(68.0))  # Pa

# A Brinell number is the force in kgf divided by the area in mm^2 of the spherical imprint of a ball of diameter D (ISO
# 6506-1). For imprint diameters d = 0.24 to 0.60 D the mean pressure is 1.5 to 11 % above this number. We take d = 0.375 D,
# where the slope of the ball at the edge of the imprint equals that of a Vickers pyramid: 1 HB is 10.178 MPa.
_IMPRINT = 0.375  # d/D
_BRINELL = 9.80665e6 * 2.0 * (1.0 - math.sqrt(1.0 - _IMPRINT**2)) / _IMPRINT**2  # Pa

# Rockwell C numbers are not defined as a force divided by an area. We use HV = (223 HRC + 14500) / (100 - HRC), a common
# formula of unknown origin. It agrees with the table for non-austenitic steels (ASTM E140, table 1) to 1.4 % from 35 to 68 HRC.
# Grade B.
_SOFTEST, _HARDEST = 20.0, 68.0  # HRC, range of the table
_SCALE = re.compile(r"HV(?:\s*/?\s*\d+(?:\.\d+)?)?|HRC|HRB|HRA|HB[WS]?|HK", re.IGNORECASE)


def to_si(value, name: str):
    """Return the value of a quantity in SI units, checked against the bounds of the quantity.

    value: a float, array, pandas.Series or xarray.DataArray in SI units; text with a unit ("48 nm"); a pint quantity; or a list
    of these. A DataArray with a different unit in its attribute `units` is converted. name: key of the quantity in QUANTITIES.

    Returns a float, an array of floats, or a DataArray without attributes (those of its coordinates are kept). Raises
    InputError if the value is not a number, is empty, is not finite, is out of bounds, or has a missing, unknown or wrong unit.
    """
    quantity = QUANTITIES[name]
    value = as_sequence(value)
    if isinstance(value, str):
        number = _from_text(value, quantity)
    elif has_unit(value):
        number = _from_pint(value, quantity)
    elif hasattr(value, "dims") and hasattr(value, "dtype"):  # a DataArray, not a Dataset
        number = _from_labelled(value, quantity)
    else:
        number = _from_numbers(value, quantity)
    _check(number, quantity, value)
    return number


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


def without_indexes(array: Any) -> Any:
    """Return an xarray array without indexes; its coordinates stay as plain variables.

    xarray aligns arrays that have indexes, which may drop or sort values. An array without indexes is returned unchanged.
    """
    indexes = getattr(array, "xindexes", ())  # an xarray.Variable has no indexes
    return array.drop_indexes(list(indexes)) if indexes else array


def check_names(array: Any, field: str) -> None:
    """Raise an InputError unless all dimension names of an xarray array are text; field: name of the input, for the message."""
    for dim in array.dims:
        if not isinstance(dim, str):
            raise InputError(field, InWords(f"dimension {dim!r}"), "dimension names that are text")


def _from_text(text: str, quantity: Quantity) -> float:
    if _ERROR.search(text[:_LONGEST_TEXT]):
        allowed = "one value without an error (+/-); a case file, or a dict like one, accepts errors of numbers of the contact"
        raise InputError(quantity.name, text, allowed)
    match = _NUMBER_AND_UNIT.fullmatch(text) if len(text) <= _LONGEST_TEXT else None
    if match is None or _COMMAS.match(text[:_LONGEST_TEXT]):
        raise InputError(quantity.name, text, quantity.wanted + _suggest_decimal_point(text))
    number, unit = match.groups()
    rounded = float(number)
    if not unit:
        if quantity.unit:
            hint = _suggest_unit(number, "", quantity)
            raise InputError(quantity.name, text, f"a number with its unit: {quantity.wanted}{hint}")
        return rounded
    if quantity.unit == "K" and unit in _CELSIUS:
        return round(rounded + _ZERO_CELSIUS, 9)
    if quantity.name == "hardness" and (pressure := _from_hardness_test(rounded, unit, text)) is not None:
        return pressure
    factor = _factor(unit, quantity, text)
    if rounded == 0 or not np.isfinite(rounded):
        return rounded  # also keeps a number like 1e999999999 away from exact arithmetic
    # The product is exact and rounded only once, so that "5 um" is 5e-06 to the last digit.
    return _float(Fraction(number) * factor, quantity, text)


def _from_hardness_test(number: float, unit: str, text: str) -> float | None:
    """Return the result of a hardness test as a pressure [Pa], or None if the unit is not a hardness scale.

    - number: the measured number, such as 700
    - unit: the scale, such as "HV", "HB" or "HRC"; the test force in "HV0.5" is ignored
    - text: the whole input as the user wrote it, for the error message

    Raises InputError for an unsupported scale and for Rockwell C numbers outside 20 to 68.
    """
    if not _SCALE.fullmatch(unit):
        return None
    scale = unit.upper()
    if scale.startswith("HV"):
        return number * _VICKERS
    if scale.startswith("HB"):
        return number * _BRINELL
    if scale == "HRC":
        if not _SOFTEST <= number <= _HARDEST:
            raise InputError("hardness", text, f'{_SOFTEST:g} to {_HARDEST:g} HRC, or another scale: "7 GPa", "700 HV"')
        return (223.0 * number + 14500.0) / (100.0 - number) * _VICKERS
    raise InputError("hardness", text, 'pressure, Vickers, Brinell or Rockwell C: "7 GPa", "700 HV", "200 HB", "60 HRC"')


def _factor(unit: str, quantity: Quantity, text) -> Fraction:
    """Return the exact factor by which a number in `unit` is multiplied to be in the SI unit of the quantity.

    text: the input as the user wrote it, for the error message. Raises InputError if the unit is unknown or has another
    dimension.
    """
    try:
        if not _UNIT.fullmatch(unit):
            raise ValueError("not a unit")
        return _exact_factor(unit, quantity.unit)
    except _unit_errors() as error:
        problem = "has another dimension" if isinstance(error, _pint().DimensionalityError) else "is unknown"
        number = text.removesuffix(unit).strip()
        allowed = f"{quantity.wanted} (the given unit {problem}){_suggest_unit(number, unit, quantity)}"
        raise InputError(quantity.name, text, allowed) from None


@cache
def _exact_factor(unit: str, si_unit: str) -> Fraction:
    if (factor := _common_factors().get((unit, si_unit))) is not None:
        return factor
    registry = _registry()
    parsed = registry.parse_units("1" + unit if unit.startswith("/") else unit)
    if registry.Quantity(Fraction(0), parsed).to(si_unit or "dimensionless").magnitude != 0:
        raise ValueError("a unit with an offset, such as degC, has no factor to an SI unit")
    return Fraction(registry.Quantity(Fraction(1), parsed).to(si_unit or "dimensionless").magnitude)


@cache
def _common_factors() -> dict[tuple[str, str], Fraction]:
    """Return (unit, SI unit) -> exact conversion factor for every unit in the table units.csv."""
    return {(row["unit"], row["si_unit"]): Fraction(row["factor"]) for row in rows_of_table("units.csv")}


@cache
def _pint():
    """Import and return the package pint, even if a command has hidden it with `leave_out`."""
    bring_back("pint")
    import pint

    return pint


@cache
def _registry():
    """Return pint's registry, which can read all units.

    pint's unit definitions take longer to read than a contact takes to solve, so they are cached on disk. A damaged cache is
    deleted and rebuilt.
    """
    pint = _pint()
    folder = cache_folder(f"units-{pint.__version__}")
    for _ in range(2):
        try:
            return pint.UnitRegistry(non_int_type=Fraction, cache_folder=folder)
        except Exception:  # unpickling a damaged file may raise anything; the cache is then made again
            shutil.rmtree(folder, ignore_errors=True)
    return pint.UnitRegistry(non_int_type=Fraction)


@cache
def _unit_errors() -> tuple[type[Exception], ...]:
    """Return the exception classes, including Python's parser errors, that pint may raise for text that is not a unit."""
    import tokenize

    return (
        _pint().PintError,
        ValueError,
        TypeError,
        AttributeError,
        KeyError,
        ArithmeticError,
        SyntaxError,
        AssertionError,
        tokenize.TokenError,
    )


def _from_pint(value, quantity: Quantity):
    """Return a pint quantity, from any of pint's registries, as a number or array in SI units.

    quantity: the expected quantity. The unit is converted to text first and then read like a unit that the user typed.
    """
    unit, numbers = f"{value.units:C}", value.magnitude
    if unit in ("", "dimensionless") and not quantity.unit:
        return _from_numbers(numbers, quantity)
    factor = _factor(unit or "1", quantity, str(value))
    if np.ndim(numbers):
        return _from_numbers(np.asarray(numbers), quantity) * float(factor)
    number = _from_numbers(numbers, quantity)
    return _float(Fraction(number) * factor, quantity, value) if np.isfinite(number) else number


def _from_labelled(array, quantity: Quantity):
    check_names(array, quantity.name)
    if has_unit(array.data):
        values = _from_pint(array.data, quantity)
    else:
        values = _from_numbers(array.values, quantity)
        unit = str(array.attrs.get("units", quantity.unit))
        if unit not in (quantity.unit, quantity.unit or "1"):  # xarray users write "1" where there is no unit
            values = values * float(_factor(unit, quantity, unit))
    result = without_indexes(array).copy(deep=False, data=np.asarray(values))
    result.attrs = {}  # otherwise products with other quantities would inherit them; the field defines the quantity
    return result


def _from_numbers(value, quantity: Quantity):
    """Return a number as a float, and an array or list as an array of floats; entries of a list may have units.

    Raises InputError for other types.
    """
    if isinstance(value, list | tuple):
        return np.array([_single(entry, quantity) for entry in value], dtype=float)
    if isinstance(value, Real | Decimal) and not isinstance(value, bool):
        return _float(value, quantity, value)
    if isinstance(value, np.ndarray) and value.dtype.kind in "iuf":
        return float(value) if value.ndim == 0 else value.astype(float)
    raise InputError(quantity.name, value, quantity.wanted)


def _single(entry, quantity: Quantity) -> float:
    if isinstance(entry, str):
        return _from_text(entry, quantity)
    number = _from_pint(entry, quantity) if has_unit(entry) else _from_numbers(entry, quantity)
    if not isinstance(number, float):
        raise InputError(quantity.name, entry, quantity.wanted)
    return number


def _float(number, quantity: Quantity, original) -> float:
    try:
        return float(number)
    except (OverflowError, ValueError):
        raise InputError(quantity.name, original, quantity.allowed) from None


def _check(number, quantity: Quantity, original) -> None:
    values = np.asarray(number)
    if values.size == 0:
        raise InputError(quantity.name, InWords("no values"), "at least one value")
    good = quantity.holds(values)
    if not good.all():
        place = tuple(index[0] for index in np.nonzero(~good)) if values.ndim else ()
        worst = float(values[place])
        allowed = quantity.allowed if np.isfinite(worst) else f"finite, {quantity.allowed}"
        shown = _as_given(original, place, worst)
        raise InputError(quantity.name, shown, allowed + _suggest_larger_unit(shown, worst, quantity))


def _as_given(original, place: tuple[int, ...], worst: float):
    """Return the value that is out of bounds, for the error message: as the user wrote it, else as a number in SI units.

    original: the whole input. place: indices of the value in it, () for a single number. worst: the value in SI units.
    """
    if isinstance(original, str):
        return original
    if isinstance(original, list | tuple) and len(place) == 1:
        return original[place[0]]
    unit = getattr(original, "attrs", {}).get("units", "")
    return f"{original.values[place]:g} {unit}" if unit not in ("", "1") else worst


def _suggest_decimal_point(text: str) -> str:
    """Return a hint that suggests a decimal point for a number with a decimal comma; "" if `text` has no decimal comma.

    For a number with more than one comma, the hint suggests writing it without commas.
    """
    number = _COMMAS.match(text[:100])
    if number is None:
        return ""
    if number[0].count(",") > 1:
        return "; write the number without commas"
    return f'; write a decimal point: "{text[:100].strip().replace(",", ".", 1)}"'


def _suggest_unit(number: str, unit: str, quantity: Quantity) -> str:
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


def _suggest_larger_unit(value: object, pascals: float, quantity: Quantity) -> str:
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
