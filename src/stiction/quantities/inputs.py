"""Define the base class of all input records, such as Contact: immutable, with checked numbers."""

import math
import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from numbers import Real
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, ValidationInfo

from stiction.quantities import html
from stiction.quantities.dimensions import coordinates, from_series
from stiction.quantities.errors import InputError, InWords, field_named, nearest
from stiction.quantities.quantity import Quantity
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import is_series, to_si

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import NumberOrArray, QuantityLike
    from stiction.quantities.keywords import Converted


def floats(value: Any, field: str, allowed: str) -> np.ndarray:
    """Return numbers without unit, in any array-like form, as an array of floats of the same shape; bounds are not checked.

    field, allowed: name of the input and its allowed values, for the error message. Text such as "0.5" is read as a number.
    Raises InputError for values that are not numbers, including dates, bytes, complex numbers and booleans, although NumPy
    would convert some of them.
    """
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iufUO":
            raise TypeError
        return array.astype(float, copy=False)
    except (TypeError, ValueError, OverflowError):
        raise InputError(field, value, allowed) from None


def require_positive(**values: float) -> None:
    """Raise InputError for the first keyword argument whose value is not a finite number > 0; the error names the keyword."""
    for name, value in values.items():
        if not (isinstance(value, Real) and 0.0 < float(value) < math.inf):
            raise InputError(name, value, "a finite number > 0")


def _number(value, info: ValidationInfo):
    name = str(info.field_name)
    with field_named(""):
        number = to_si(from_series(value, name) if is_series(value) else value, name)
    if isinstance(number, np.ndarray):
        raise InputError(
            "",
            InWords(f"array of shape {number.shape}"),
            "one number, or an array with a named dimension, see stiction.axis",
        )
    return number


def _optional_number(value, info: ValidationInfo):
    return None if value is None else _number(value, info)


# A numeric field has the name of its quantity, which decides its unit and bounds.
if TYPE_CHECKING:
    Number = Converted[NumberOrArray, QuantityLike]
    OptionalNumber = Converted[NumberOrArray | None, QuantityLike | None]
else:
    Number = Annotated[Any, BeforeValidator(_number)]
    OptionalNumber = Annotated[Any, BeforeValidator(_optional_number)]
Seed = Annotated[int, Field(ge=0, le=2**63 - 1, strict=True, description="a whole number, 0 or more")]


_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]")


# Fields that describe the numbers and change no result.
_IN_NOTES = ("source", "range")


def by_default(value: object) -> Any:
    """Return `value` unchanged, typed as Any, for use as the default of a numeric field of an input record.

    Type checkers would otherwise reject the default, because they compare its type with the annotation `Converted`.
    """
    return value


def plain_number(entry: Any, where: str) -> float:
    """Return a value of a case file as a finite float.

    where: dotted name of the value in the file, for the error message. Raises InputError for infinite and NaN values.
    """
    try:
        number = float(entry)
    except OverflowError:  # whole numbers of TOML have no upper limit
        number = math.inf
    if not math.isfinite(number):
        raise InputError(where, entry, "a finite number")
    return number


def require_callable(callback: Any, field: str) -> None:
    """Raise an InputError unless a progress callback is callable; field: name of the argument, for the error message."""
    if not callable(callback):
        raise InputError(field, callback, "a function, or None")


def require_names(table: Mapping, where: str = "") -> None:
    """Raise an InputError if a table has a key that is not text, or a text value with control characters.

    Nested tables are checked too. where: dotted name of the table, for the error message. A key that is not text would fail
    later with a TypeError. Control characters break libraries that write result files, and terminals would execute them.
    """
    for key, value in table.items():
        if not isinstance(key, str):
            raise InputError(where or "case", key, "names that are text")
        place = f"{where}.{key}" if where else key
        if isinstance(value, Mapping):
            require_names(value, place)
        elif isinstance(value, str) and _CONTROL.search(value):
            raise InputError(place, value, "text without control characters")


class Input(BaseModel):
    """Provide the base class of input records, which are immutable and raise InputError for unknown fields and bad values."""

    model_config = ConfigDict(frozen=True, extra="forbid", arbitrary_types_allowed=True)
    instead: ClassVar[str] = ""  # inputs that may replace a missing number, for the error

    def __init__(self, /, *unnamed_values, **data):
        if unnamed_values:
            names = ", ".join(f"{name}=..." for name, field in type(self).model_fields.items() if field.is_required())
            count = len(unnamed_values)
            shown = InWords(f"{count} value{'s' * (count > 1)} without a name")
            raise InputError(type(self).__name__, shown, f"values given by name: {names or 'see its fields'}")
        require_names(data)
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise _input_error(error, type(self)) from None

    def replace(self, **changes: object) -> Self:
        """Return a copy of the record with the fields in `changes` replaced; all fields are checked again.

        Raises InputError for a bad value or an unknown field.
        """
        fields = {name: getattr(self, name) for name in self.model_fields_set}
        return type(self)(**fields | changes)

    def __getstate__(self) -> dict[Any, Any]:
        """Return the state to pickle and copy: only the fields, because some cached values cannot be pickled."""
        state = super().__getstate__()
        fields = type(self).model_fields
        return state | {"__dict__": {name: value for name, value in state["__dict__"].items() if name in fields}}

    def part(self, name: str) -> object:
        """Return the value of the field `name`, or None if the record has no such field."""
        return getattr(self, name) if name in type(self).model_fields else None

    def model_copy(self, *, update: Mapping[str, object] | None = None, deep: bool = False) -> Self:
        """Return a copy of the record, with the fields in `update` replaced and checked as `replace` does.

        deep: whether a copy without changes also copies the values of its fields.
        """
        return self.replace(**update) if update else super().model_copy(deep=deep)

    def __setattr__(self, name: str, value: Any) -> None:
        """Set a private attribute; raise an InputError for a public attribute, because records are immutable.

        If the field exists and the new value is not allowed, the error reports this value instead.
        """
        if name in type(self).model_fields:
            self.replace(**{name: value})
            raise InputError(
                f"{type(self).__name__}.{name}", value, f"not supported: a record cannot be changed; use replace({name}=...)"
            )
        if not name.startswith("_"):
            raise InputError(
                f"{type(self).__name__}.{name}", value, f"{nearest(name, type(self).model_fields)}; {name} is not a field"
            )
        super().__setattr__(name, value)

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs):
        """Append the unit, meaning and bounds of every numeric field to the docstring of a new subclass.

        The texts come from the table of quantities.
        """
        rows = [
            f"    {name}: {QUANTITIES[name].label}, {QUANTITIES[name].allowed}"
            + ("" if field.is_required() else ", may be left out")
            for name, field in cls.model_fields.items()
            if name in QUANTITIES
        ]
        if rows:
            cls.__doc__ = "\n".join([(cls.__doc__ or "").rstrip(), "", "    Numbers, each with its SI unit:", *rows])

    @classmethod
    def __get_pydantic_json_schema__(cls, core_schema, handler):
        schema = handler.resolve_ref_schema(handler(core_schema))
        for name, entry in schema.get("properties", {}).items():
            if name in QUANTITIES:
                entry.update(number_schema(QUANTITIES[name]))
            _drop_null(entry)
        return schema

    def arrays(self) -> Iterator[tuple[str, "xarray.DataArray"]]:
        """Yield (dotted name, xarray.DataArray) for every array in this record and in the records nested in it."""
        for name in type(self).model_fields:
            value = getattr(self, name)
            if isinstance(value, Input):
                yield from ((f"{name}.{inner}", array) for inner, array in value.arrays())
            elif hasattr(value, "dims"):
                yield name, value

    @property
    def unlabelled(self) -> Self:
        """Return the record with each xarray.DataArray as an xarray.Variable, which has named dimensions but no coordinates.

        Arithmetic is five times as fast with a Variable as with a DataArray.
        """
        return self._without_labels or self

    @cached_property
    def _without_labels(self) -> Self | None:  # None if nothing changes: with the record itself, == would never end
        fields = {name: _unlabelled(getattr(self, name)) for name in type(self).model_fields}
        changed = any(value is not getattr(self, name) for name, value in fields.items())
        return type(self).model_construct(self.model_fields_set, **fields) if changed else None

    def listed(self) -> list[tuple[str, str]]:
        """Return the dotted name and the value, as text with its unit, of every number, text and table in this record.

        Nested records are included; the fields `source` and `range` are omitted.
        """
        rows: list[tuple[str, str]] = []
        for name in type(self).model_fields:
            value = getattr(self, name)
            if isinstance(value, Input):
                rows += [(f"{name}.{inner}", text) for inner, text in value.listed()]
            elif name in QUANTITIES and value is not None:
                rows.append((name, as_text(value, name)))
            elif isinstance(value, str) and name not in _IN_NOTES:
                rows.append((name, value))
            elif isinstance(value, dict) and name not in _IN_NOTES:
                rows += [
                    (f"{name}.{key}", str(entry) if np.ndim(entry) == 0 else f"{np.size(entry)} values")
                    for key, entry in value.items()
                ]
        return rows

    def _repr_html_(self) -> str:
        """Return the record as an HTML table, which a notebook shows."""
        meanings = {name: QUANTITIES[name].meaning for name in QUANTITIES}
        rows = [
            (name, f"{text}  ({meanings[last]})" if (last := name.rpartition(".")[2]) in meanings else text)
            for name, text in self.listed()
        ]
        return html.table(type(self).__name__, rows, self.notes())

    def notes(self) -> list[str]:
        """Return the lines of text that a notebook shows below the table of this record; by default there are none."""
        return []

    def check_dimensions(self) -> None:
        """Raise an InputError if two arrays of the record differ in the length or coordinate of a dimension that they share."""
        coordinates(self.arrays())


def _unlabelled(value: Any) -> Any:
    """Return the value of a field without coordinates: an array, or each array in a record, becomes an xarray.Variable.

    Any other value is returned unchanged.
    """
    return value.unlabelled if isinstance(value, Input) else getattr(value, "variable", value)


def as_text(value: Any, name: str) -> str:
    """Return a number of a quantity as text with its unit, such as "48 nm"; for an array its size, range and dimensions.

    value: number or xarray array in SI units. name: key of the quantity in QUANTITIES.
    """
    if not hasattr(value, "dims"):
        return show(value, name)
    ends = [show(float(end), name) for end in (value.min(), value.max())]
    return f"{value.size} values, {ends[0]} to {ends[1]}, along {', '.join(map(str, value.dims))}"


def number_schema(quantity: Quantity) -> dict:
    """Return the JSON schema of a numeric field of the case file.

    If the quantity has a unit, the schema demands text ("48 nm"), else a number with the bounds of the quantity.
    """
    schema: dict[str, Any] = {"description": f"{quantity.label}; {quantity.allowed}"}
    if quantity.unit:
        schema["type"] = "string"
    else:
        schema["type"] = "number"
        if np.isfinite(quantity.lower):
            schema["minimum" if quantity.lower_included else "exclusiveMinimum"] = quantity.lower
        if np.isfinite(quantity.upper):
            schema["maximum" if quantity.upper_included else "exclusiveMaximum"] = quantity.upper
    if quantity.example:
        schema["examples"] = [quantity.example if quantity.unit else float(quantity.example)]
    return schema


def _drop_null(entry: dict) -> None:
    """Delete the default null and the type null from the JSON schema of a field; the given dict is changed.

    entry: schema of the field. TOML has no null, so a case file omits a field whose value is None.
    """
    if entry.get("default", 0) is None:
        del entry["default"]
    choices = [choice for choice in entry.pop("anyOf", []) if choice.get("type") != "null"]
    entry.update(choices[0] if len(choices) == 1 else {"anyOf": choices} if choices else {})


_KINDS = {"model_type": "a table of named numbers"}  # replaces texts of pydantic that are meant for programmers


_PROFILES = {"Rq": "Sq", "Sa": "Ra"}  # the table of quantities has one symbol for profiles and areas


def _by_symbol(key: str, cls: type[Input]) -> str:
    """Return "FIELD for KEY" if a field of an input record has the quantity with the symbol `key`; otherwise "".

    Example: "asperity_radius for R" for key "R". cls: the class of the record.
    """
    symbol = _PROFILES.get(key, key)
    names = [name for name in cls.model_fields if name in QUANTITIES and QUANTITIES[name].symbol == symbol]
    return f"{names[0]} for {key}" if names else ""


def _input_error(error: ValidationError, cls: type[Input]) -> InputError:
    """Convert the most useful of pydantic's validation errors into an InputError.

    cls: the record class that was validated. An unknown key is reported before all other errors, because a misspelt key also
    makes a required field appear to be missing.
    """
    details = min(error.errors(), key=lambda entry: entry["type"] != "extra_forbidden")
    path = [str(part) or '""' for part in details["loc"]]
    cause = details.get("ctx", {}).get("error")
    if isinstance(cause, InputError):
        return InputError(".".join([*path, cause.field] if cause.field else path), cause.value, cause.allowed, cause.hint)
    if details["type"] == "extra_forbidden":
        known = _by_symbol(path[-1], cls) or nearest(path[-1], cls.model_fields) + cls.instead
        return InputError(".".join(path), InWords("unknown key"), known)
    if details["type"] == "missing":
        return InputError(".".join(path), None, _wanted(path[-1], cls))
    allowed = details.get("ctx", {}).get("expected") or cls.model_fields[path[0]].description
    allowed = allowed or _KINDS.get(details["type"], details["msg"])
    return InputError(".".join(path), details["input"], allowed)


def _wanted(name: str, cls: type[Input]) -> str:
    if name in QUANTITIES:
        return QUANTITIES[name].described + cls.instead
    return cls.model_fields[name].description or "required"
