"""Read swept numbers of a case file: lists, ranges, and parameters that vary together."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field

from stiction.case.distribution import Distribution, is_scipy_law
from stiction.contact.subject import Subject
from stiction.quantities.errors import InputError, InWords, field_as
from stiction.quantities.inputs import Input, plain_number
from stiction.quantities.shown import values_in_words
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si

if TYPE_CHECKING:
    import xarray

# The keys that lead to an entry in the tables of a case, e.g. ("contact", "first", "hardness").
Address = tuple[str, ...]

_MOST_POINTS = 100_000
_ROUNDING = 1e-14  # a point below this fraction of the larger end of its range is 0 with a round-off error
# Names that a dimension must not have, because results use them for dimensions, coordinates or variables.
_TAKEN = (
    "asperity_method", "separation", "contact", "sample", "block", "rule", "statistic", "quantile", "input", "spread",
    "set", "row", "parameter", "other_parameter", "profile", "model", "number", "design", "pareto", "evaluated",
    "validity_warnings", "validity_warnings_by_block", "statistics_by_block", "counts_by_block",
)  # fmt: skip


def as_point(value):
    """Return a number, or text with a number and its unit, unchanged; raise InputError for anything else."""
    if isinstance(value, bool) or not isinstance(value, float | int | str):
        raise InputError("", value, "a number, or text with a number and its unit")
    return value


Point = Annotated[Any, BeforeValidator(as_point, json_schema_input_type=float | str)]


class Range(Input):
    """Define `count` evenly spaced points from `start` to `stop`; spacing = "log" spaces their logarithms evenly."""

    start: Point = Field(description="the first point")
    stop: Point = Field(description="the last point")
    count: int = Field(ge=2, le=_MOST_POINTS, strict=True, description=f"a whole number, 2 to {_MOST_POINTS}")
    spacing: Literal["linear", "log"] = Field("linear", description="linear: even steps of the number; log: of its logarithm")


def _along(value):
    if not isinstance(value, str) or not re.fullmatch(r"[A-Za-z]\w{0,63}", value) or value in QUANTITIES or value in _TAKEN:
        raise InputError("", value, "a name of letters, digits and _ that is neither a quantity nor reserved")
    return value


Along = Annotated[
    Any,
    BeforeValidator(_along, json_schema_input_type=str),
    Field(
        validate_default=False,
        description="name of a dimension; numbers with the same dimension vary together, point by point",
    ),
]


class _Ends(Range):
    """Define a swept number as a range of values from `start` to `stop`.

    count: number of values; None only if a study samples the range. along: name of its dimension.
    """

    count: int | None = Field(  # type: ignore[assignment]  # None if a study samples the range
        None, ge=2, le=_MOST_POINTS, strict=True, description=f"a whole number, 2 to {_MOST_POINTS}"
    )
    along: Along = None


class _Values(Input):
    """Define a swept number as a list of values; `along` names its dimension."""

    values: list[Point] = Field(min_length=1, max_length=_MOST_POINTS, description="a list with at least one value")
    along: Along = None


def _points(value):
    if isinstance(value, Mapping):
        return Range(**value)
    if value == []:
        raise InputError("", value, "a list with at least one value")
    return [as_point(entry) for entry in (value if isinstance(value, list) else [value])]


# The mean separations or loads of [solve]: a Range, or a list of numbers and texts with units.
Points = Annotated[Any, BeforeValidator(_points, json_schema_input_type=list[float | str] | Range)]


@dataclass(frozen=True)
class SweptNumber:
    """Describe a swept number of a contact: its address and the values that it takes.

    path: address in the case, e.g. ("contact", "coating", "thickness"). dimension: name of the dimension along which it varies;
    numbers of one dimension vary together. name: name of the coordinate with its values in results. values: values (n,) in SI
    units, or the two ends of a range if `is_range`. count: number of points of a range; None if a study samples the range.
    spacing: "linear" or "log".
    """

    path: Address
    dimension: str
    name: str
    values: np.ndarray
    is_range: bool = False
    count: int | None = None
    spacing: str = "linear"

    @property
    def quantity(self) -> str:
        return self.path[-1]

    @property
    def where(self) -> str:
        return ".".join(self.path)

    @property
    def words(self) -> InWords:
        """Return the number of values, and the first and last of them, as text for errors."""
        return values_in_words(self.values, self.where, self.count)

    def numbers(self) -> np.ndarray:
        """Return all values (n,) of the swept number in SI units; raise InputError for a range without count."""
        if not self.is_range:
            return self.values
        if self.count is None:
            raise InputError(f"{self.where}.count", None, f"a whole number, 2 to {_MOST_POINTS}")
        return _spaced(self.values, self.count, self.spacing)

    def as_table(self) -> dict[str, Any]:
        """Return the list or range of the swept number as a table for JSON, with numbers in SI units."""
        if not self.is_range:
            return {"values": self.values.tolist(), "along": self.dimension}
        start, stop = self.values.tolist()
        return {"start": start, "stop": stop, "count": self.count, "spacing": self.spacing, "along": self.dimension}

    def at(self, share: np.ndarray) -> np.ndarray:
        """Return the values (n,), in SI units, at positions `share` (n,) along the list or range.

        Position 0 is the first value or the start of a range. Positions are below 1, the end of a list or range. A list of m
        values has value i, counted from 0, at positions from i/m to (i + 1)/m.
        """
        start, stop = self.values[0], self.values[-1]
        if not self.is_range:
            return self.values[(share * len(self.values)).astype(int)]
        return start + share * (stop - start) if self.spacing == "linear" else start * (stop / start) ** share

    def array(self, values: np.ndarray, dimension: str | None = None) -> "xarray.DataArray":
        """Return values (n,) of this number, in SI units, as an xarray.DataArray whose coordinate has the same values.

        dimension: name of the dimension of the array; None uses the dimension of the swept number.
        """
        import xarray

        quantity, dimension = QUANTITIES[self.quantity], dimension or self.dimension
        attributes = dict(quantity.attributes)
        if self.name != self.quantity:
            attributes |= {
                key: f"{self.name.rpartition('.')[0]}: {attributes[key]}"
                for key in ("long_name", "comment")
                if key in attributes
            }
        return xarray.DataArray(values, dims=(dimension,), coords={self.name: ((dimension,), values, attributes)})


def swept_numbers(content: Mapping) -> dict[Address, SweptNumber]:
    """Return the swept numbers in the tables [contact] and [indices] of a case, by address (tuple of keys).

    Raises InputError for an invalid entry.
    """
    entries = {path: entry for path, entry in numbers_in(content, ("contact", "indices")) if not with_error(entry)}
    short = [path[-1] for path in entries]
    return {path: _read(path, entry, short.count(path[-1]) > 1) for path, entry in entries.items()}


def numbers_in(content: Mapping, tables: Sequence[str]) -> Iterator[tuple[Address, Any]]:
    """Yield the address and the entry of every number that is swept or uncertain in some tables of a case.

    tables: names of these tables, e.g. ("contact", "indices").
    """
    for table in tables:
        if isinstance(content.get(table), Mapping):
            yield from _in_table(content[table], (table,))


def with_error(entry: Any) -> bool:
    """Return whether an entry of a case describes an uncertain number.

    Such entries are text such as "0.5 +/- 0.1 GPa", tables such as { low, high }, and distributions, also of scipy.stats.
    """
    if isinstance(entry, str):
        return any(sign in entry for sign in _ERROR_SIGNS)
    return (
        is_scipy_law(entry)
        or isinstance(entry, Distribution)
        or (isinstance(entry, Mapping) and bool(entry.keys() & _ERROR_KEYS))
    )


_ERROR_SIGNS = ("+/-", "+-", "±")
_ERROR_KEYS = {"low", "high", "median", "factor", "samples"}


def _in_table(table: Mapping, path: Address) -> Iterator[tuple[Address, Any]]:
    for key, value in table.items():
        if key in QUANTITIES and (isinstance(value, list | Mapping) or with_error(value)):
            yield (*path, key), value
        elif isinstance(value, Mapping) and key not in ("range", "source", "grade"):  # these tables only describe numbers
            yield from _in_table(value, (*path, key))


def _read(path: Address, entry: Any, ambiguous: bool) -> SweptNumber:
    where = ".".join(path)
    if isinstance(entry, list):
        entry = {"values": entry}
    with field_as(lambda field: f"{where}.{field}".removesuffix(".values")):
        table = _Ends(**entry) if entry.keys() & {"start", "stop", "count", "spacing"} else _Values(**entry)
    name = ".".join(path[1:]) if ambiguous else path[-1]
    if isinstance(table, _Values):
        return SweptNumber(path, table.along or name, name, _numbers(table.values, path, ("",)))
    ends = _numbers([table.start, table.stop], path, (".start", ".stop"))
    _check_spacing(where, table, start=ends[0], stop=ends[1])
    return SweptNumber(path, table.along or name, name, ends, True, table.count, table.spacing)


def _numbers(entries: list[Any], path: Address, ends: tuple[str, ...]) -> np.ndarray:
    """Convert entries of a case file to numbers (n,) in SI units, after checking each.

    entries: as written in the file. path: address of the swept number, whose last key is the name of the quantity. ends:
    suffixes that errors add to the address, one for each entry, e.g. (".start", ".stop"); for further entries the last suffix
    is used again. Raises InputError for an invalid entry.
    """
    where = [".".join(path) + ends[min(address, len(ends) - 1)] for address in range(len(entries))]
    return np.array([number_of(entry, path[-1], address) for entry, address in zip(entries, where, strict=True)])


def number_of(entry: Any, name: str, where: str, given: Any = None) -> float:
    """Return an entry of a case file, such as "50 nm", as a number in SI units.

    name: name of the quantity; a quantity with a unit needs text. where: address for errors. given: text or table that contains
    the entry; errors show it instead of the entry. Raises InputError for a missing unit or a value that is not allowed.
    """
    quantity = QUANTITIES[name]
    if quantity.unit and not isinstance(entry, str):
        raise InputError(where, entry, quantity.as_text)
    if isinstance(entry, bool) or not isinstance(entry, str | int | float):
        raise InputError(where, entry, quantity.wanted)
    try:
        return float(to_si(entry, name))
    except InputError as error:
        raise InputError(where, given or error.value, error.allowed) from None


def read_ends(given: Any, quantity: str, where: str) -> tuple[float, float]:
    """Return the limits `low` and `high` of a table, in SI units.

    given: checked record with the fields low, high and spacing. quantity: name of the quantity. where: address for errors.
    Raises InputError if `low` is not below `high`, or if `low` is not positive with logarithmic spacing.
    """
    low, high = (number_of(getattr(given, end), quantity, f"{where}.{end}") for end in ("low", "high"))
    if not low < high:
        raise InputError(f"{where}.high", given.high, f"above the low end, {given.low}")
    _check_spacing(where, given, low=low)
    return low, high


def points_of(points: Any, name: str, subject: Subject, where: str) -> Any:
    """Return the loads or separations of [solve] as numbers (n,); None if `points` is None.

    points: a Range or a list. name: "load" or "mean_separation". subject: the contact. where: address for errors. Numbers are
    in SI units for a Contact and dimensionless for Indices. Separations without unit are multiples of sigma. If sigma is swept,
    they are lengths [m] in an array with the dimension `separation` and the sweep dimension of sigma. Raises InputError for an
    invalid entry.
    """
    if points is None:
        return None
    is_range = isinstance(points, Range)
    entries = [points.start, points.stop] if is_range else points
    ends = (".start", ".stop") if is_range else ("",) * len(entries)
    numbers = [subject.read_point(entry, name, where + end) for entry, end in zip(entries, ends, strict=True)]
    by_sigma = any(hasattr(number, "dims") for number in numbers)
    if by_sigma:
        text = next((entry for entry in entries if isinstance(entry, str)), None)
        if text is not None:
            raise InputError(where, text, "plain numbers, in multiples of sigma, because sigma is an array")
        numbers = [plain_number(entry, where) for entry in entries]
    h = np.array(numbers)
    if is_range:
        _check_spacing(where, points, start=h[0], stop=h[1])
        h = _spaced(h, points.count, points.spacing)
    return _over_sigma(h, subject) if by_sigma else h


def _spaced(ends: np.ndarray, count: int, spacing: str) -> np.ndarray:
    start, stop = ends.tolist()
    if spacing != "linear":
        return np.geomspace(start, stop, count)
    places = np.linspace(start, stop, count)
    return np.where(np.abs(places) < _ROUNDING * max(abs(start), abs(stop)), 0.0, places)


def _check_spacing(where: str, given: Any, **ends: float) -> None:
    """Raise InputError if the spacing of a range is logarithmic and one of its ends is not positive.

    where: address of the range for errors. given: range as written in the file. ends: numbers to check by name of the end, e.g.
    start.
    """
    for end, number in ends.items():
        if given.spacing == "log" and number <= 0.0:
            raise InputError(f"{where}.{end}", getattr(given, end), 'above 0 with spacing = "log"')


def _over_sigma(h: np.ndarray, subject: Any) -> Any:
    import xarray

    attributes = {"units": "1", "long_name": "mean separation over sigma", "symbol": "d/sigma"}
    row = xarray.DataArray(h, dims=("separation",), coords={"separation": (("separation",), h, attributes)})
    return row * subject.roughness.asperity_height_deviation


def numbers_schema(schema: dict, more: Sequence[tuple[str, type[Input]]] = ()) -> None:
    """Extend the JSON schema of a case file so that each number of a contact may also be a list, a range or a distribution.

    schema: JSON schema, which is changed in place. more: further tables that may replace a number: (name in the schema,
    class).
    """
    forms: tuple[tuple[str, type[Input]], ...] = (("RangeOfNumbers", _Ends), ("ListAlong", _Values), *more)
    several = {name: cls.model_json_schema() for name, cls in forms}
    schema["$defs"] |= several
    for table in ("Contact", "Indices", "Coating", "Liquid", "Roughness", "Material", "Interface", "Finished"):
        for name, entry in schema["$defs"].get(table, {}).get("properties", {}).items():
            if name in QUANTITIES and "type" in entry:
                of_one = {key: value for key, value in entry.items() if key not in ("description", "examples", "default")}
                rest = {key: value for key, value in entry.items() if key not in of_one}
                several_of = [
                    {"type": "array", "items": of_one, "minItems": 1},
                    *([] if of_one["type"] == "string" else [{"type": "string", "pattern": "\\+/-|±"}]),
                    *({"$ref": f"#/$defs/{form}"} for form in several),
                ]
                schema["$defs"][table]["properties"][name] = rest | {"anyOf": [of_one, *several_of]}
