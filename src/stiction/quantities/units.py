"""Convert between text with units ("48 nm") and numbers in SI units; no other module reads units.

The file units.csv lists common units. All others are read by pint, which is imported only when needed, because its import is
slow.
"""

import re
import shutil
from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction
from functools import cache
from numbers import Real
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities import foreign
from stiction.quantities.cache import cache_folder
from stiction.quantities.dimensions import check_names, coordinate, variable, without_indexes
from stiction.quantities.errors import InputError, InWords, nearest
from stiction.quantities.extras import bring_back
from stiction.quantities.hardness import from_hardness_test
from stiction.quantities.hints import suggest_decimal_point, suggest_larger_unit, suggest_unit
from stiction.quantities.quantity import Quantity, in_degrees
from stiction.quantities.table import QUANTITIES, rows_of_table

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import QuantityLike

_NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.DOTALL)
# pint evaluates each unit, and "m^9^9^9" would take forever: only products of single-digit powers are passed to pint.
_POWER = r"(?:1|%|[^\W\d]+(?:(?:\^|\*\*)[+-]?\d|⁻?[⁰¹²³⁴-⁹])?)"
_UNIT = re.compile(rf"/?\s*{_POWER}(?:(?:\s*[/*·]\s*|\s+){_POWER})*")
_LONGEST_TEXT = 100  # characters; no quantity needs more, and the patterns above are slow on megabytes of text
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d*,\d")
_ERROR = re.compile(r"\d.*(\+/?-|±)\s*\d")
_CELSIUS = ("degC", "°C", "celsius", "deg C")  # allowed for temperatures only, because no factor converts them to kelvins
_ZERO_CELSIUS = 273.15
# Prefixes are chosen here, because `to_compact` of pint takes 27 times as long, and prints 999.9999999 nm as 1000 nm and
# 1.7e10 1/m^2 as 17000 1/mm^2.
_AREA_SHIFT = 2  # decades by which an area changes its prefix early, because prefixes of areas are six decades apart
_PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def to_si(value, name: str):
    """Return the value of a quantity in SI units, checked against the bounds of the quantity.

    value: a float, array, pandas.Series or xarray.DataArray in SI units; text with a unit ("48 nm"); a pint quantity; or a list
    of these. A DataArray with a different unit in its attribute `units` is converted. name: key of the quantity in QUANTITIES.

    Returns a float, an array of floats, or a DataArray without attributes (those of its coordinates are kept). Raises
    InputError if the value is not a number, is not finite, is out of bounds, or has a missing, unknown or wrong unit.
    """
    quantity = QUANTITIES[name]
    value = foreign.as_sequence(value)
    if isinstance(value, str):
        number = _from_text(value, quantity)
    elif foreign.has_unit(value):
        number = _from_pint(value, quantity)
    elif hasattr(value, "dims") and hasattr(value, "dtype"):  # a DataArray, not a Dataset
        number = _from_labelled(value, quantity)
    else:
        number = _from_numbers(value, quantity)
    _check(number, quantity, value)
    return number


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


def axis(name: str, values: "QuantityLike | None" = None, dimension: str | None = None) -> "xarray.DataArray":
    """Return values of a quantity along a named dimension.

    Parameters
    ----------
    name : str
        Name of a quantity, e.g. "load" or "thickness".
    values : array_like (n,) [SI], or sequence of str with units
        Values along the dimension.
    dimension : str, optional
        Name of the dimension; by default the name of the quantity. Needed if the same quantity varies for both bodies.

    Returns
    -------
    xarray.DataArray
        Values (n,) in SI units, which are also their own coordinate. Use it in place of any number of a Contact or Indices.

    Raises
    ------
    InputError
        The name is unknown, or a value has a wrong unit or is out of bounds.

    Examples
    --------
    >>> import stiction as st
    >>> st.axis("load", ["1 mN", "2 mN"]).values
    array([0.001, 0.002])
    """
    import xarray

    if not isinstance(name, str) or name not in QUANTITIES:
        first = 'first the name of a quantity, then its values, e.g. axis("load", ["1 N", "2 N"])'
        raise InputError("axis", name, f"{first}: {nearest(name, QUANTITIES)}")
    quantity, numbers = QUANTITIES[name], values_along(name, values)
    if dimension is not None and not isinstance(dimension, str):
        raise InputError("dimension", dimension, "a name, as text")
    dimension = dimension or name
    attributes = {name: text for name, text in quantity.attributes.items() if name != "symbol"}
    along = {dimension: coordinate(dimension, numbers, attributes)}
    return xarray.DataArray(variable((dimension,), numbers, attributes), coords=along, name=name)


def values_along(name: str, values: "QuantityLike | None") -> np.ndarray:
    """Return values of a quantity as an array (n,) in SI units.

    name: key of the quantity in QUANTITIES. values: one number or a one-dimensional sequence, in SI units or with units. Raises
    InputError for None, for more than one dimension, and as `to_si` does.
    """
    if values is None:
        raise InputError(name, None, f"its values along the axis, {QUANTITIES[name].wanted}")
    numbers = np.atleast_1d(np.asarray(to_si(values, name)))
    if numbers.ndim != 1:
        raise InputError(name, InWords(f"array of shape {numbers.shape}"), "a list of values, or an array with one dimension")
    return numbers


def from_series(series, name: str):
    """Return a pandas.Series with values of a quantity as an xarray.DataArray in SI units with one named dimension.

    name: key of the quantity in QUANTITIES. The index of the series becomes the coordinate, and the name of the index the name
    of the dimension. If the index has no name, the values are their own coordinate, as in `axis`. Raises InputError as `to_si`
    does.
    """
    import xarray

    along = series.index.name
    if along is None:
        return axis(name, series)
    return xarray.DataArray(to_si(series, name), dims=(str(along),), coords={str(along): series.index.to_numpy()}, name=name)


def _from_text(text: str, quantity: Quantity) -> float:
    if _ERROR.search(text[:_LONGEST_TEXT]):
        allowed = "one value without an error (+/-); a case file, or a dict like one, accepts errors of numbers of the contact"
        raise InputError(quantity.name, text, allowed)
    match = _NUMBER_AND_UNIT.fullmatch(text) if len(text) <= _LONGEST_TEXT else None
    if match is None or _DECIMAL_COMMA.match(text[:_LONGEST_TEXT]):
        raise InputError(quantity.name, text, quantity.wanted + suggest_decimal_point(text))
    number, unit = match.groups()
    rounded = float(number)
    if not unit:
        if quantity.unit:
            hint = suggest_unit(number, "", quantity)
            raise InputError(quantity.name, text, f"a number with its unit: {quantity.wanted}{hint}")
        return rounded
    if quantity.unit == "K" and unit in _CELSIUS:
        return round(rounded + _ZERO_CELSIUS, 9)
    if quantity.name == "hardness" and (pressure := from_hardness_test(rounded, unit, text)) is not None:
        return pressure
    factor = _factor(unit, quantity, text)
    if rounded == 0 or not np.isfinite(rounded):
        return rounded  # also keeps a number like 1e999999999 away from exact arithmetic
    # The product is exact and rounded only once, so that "5 um" is 5e-06 to the last digit.
    return _float(Fraction(number) * factor, quantity, text)


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
        allowed = f"{quantity.wanted} (the given unit {problem}){suggest_unit(number, unit, quantity)}"
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
    if foreign.has_unit(array.data):
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
    number = _from_pint(entry, quantity) if foreign.has_unit(entry) else _from_numbers(entry, quantity)
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
        raise InputError(quantity.name, shown, allowed + suggest_larger_unit(shown, worst, quantity))


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
