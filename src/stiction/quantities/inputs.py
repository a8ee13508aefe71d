"""What all typed input has in common: frozen records whose numbers obey the table of quantities."""

import difflib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, ValidationError, ValidationInfo

from stiction.quantities.dimensions import coordinates
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES, Quantity
from stiction.quantities.units import to_si

__all__ = ["Input", "Number", "OptionalNumber", "floats", "nearest", "unnamed"]


def nearest(word: str, known) -> str:
    """The known words, the likely ones first if there are any: the text of a suggestion."""
    close = difflib.get_close_matches(str(word), list(known), n=3, cutoff=0.5)
    every = ", ".join(known)
    return f"{' or '.join(close)} (all: {every})" if close else every


def floats(value: Any, field: str, allowed: str) -> np.ndarray:
    """Numbers without a unit, of any shape, as an array of floats, checked no further; InputError for what are none: dates,
    bytes, complex numbers and truths, too, which numpy would turn into some."""
    try:
        given = np.asarray(value)
        if given.dtype.kind not in "iufUO":
            raise TypeError
        return given.astype(float, copy=False)
    except (TypeError, ValueError, OverflowError):
        raise InputError(field, value, allowed) from None


@contextmanager
def unnamed():
    """Take the name off an InputError raised inside: the record around it knows the full path."""
    try:
        yield
    except InputError as error:
        raise InputError("", error.value, error.allowed) from None


def _number(value, info: ValidationInfo):
    with unnamed():
        number = to_si(value, str(info.field_name))
    if isinstance(number, np.ndarray):
        raise InputError(
            "",
            f"array of shape {number.shape}",
            "one number, or an array with a named dimension, see stiction.axis",
        )
    return number


def _optional_number(value, info: ValidationInfo):
    return None if value is None else _number(value, info)


# The name of the field is the name of the quantity: it decides unit and bounds.
Number = Annotated[Any, BeforeValidator(_number)]
OptionalNumber = Annotated[Any, BeforeValidator(_optional_number)]


class Input(BaseModel):
    """A frozen record that refuses unknown keys and raises InputError, one line, for any bad field."""

    model_config = ConfigDict(frozen=True, extra="forbid", arbitrary_types_allowed=True)

    def __init__(self, /, **data):
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise _input_error(error, type(self)) from None

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs):
        """Add unit, meaning and bounds of every number to the docstring, from the table."""
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

    def arrays(self) -> Iterator[tuple[str, Any]]:
        """Dotted name and xarray.DataArray of every array in this record and the records in it."""
        for name in type(self).model_fields:
            value = getattr(self, name)
            if isinstance(value, Input):
                yield from ((f"{name}.{inner}", array) for inner, array in value.arrays())
            elif hasattr(value, "dims"):
                yield name, value

    def check_dimensions(self) -> None:
        """Raise InputError where two arrays disagree about a dimension of the same name."""
        coordinates(self.arrays())


def number_schema(quantity: Quantity) -> dict:
    """The JSON schema of an input: text with a unit if it has one, else a bounded number."""
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
    """TOML cannot say null: what may be None is left out of the file instead."""
    if entry.get("default", 0) is None:
        del entry["default"]
    choices = [choice for choice in entry.pop("anyOf", []) if choice.get("type") != "null"]
    entry.update(choices[0] if len(choices) == 1 else {"anyOf": choices} if choices else {})


def _input_error(error: ValidationError, cls: type[Input]) -> InputError:
    """The first of pydantic's errors as one line, a mistyped key before the field that it leaves missing."""
    details = min(error.errors(), key=lambda entry: entry["type"] != "extra_forbidden")
    path = [str(part) for part in details["loc"]]
    cause = details.get("ctx", {}).get("error")
    if isinstance(cause, InputError):
        return InputError(".".join([*path, cause.field] if cause.field else path), cause.value, cause.allowed)
    if details["type"] == "extra_forbidden":
        known = nearest(path[-1], cls.model_fields)
        return InputError(".".join(path), details["input"], f"{known}; {path[-1]} is no key here")
    if details["type"] == "missing":
        return InputError(".".join(path), None, _wanted(path[-1], cls))
    allowed = details.get("ctx", {}).get("expected") or cls.model_fields[path[0]].description or details["msg"]
    return InputError(".".join(path), details["input"], allowed)


def _wanted(name: str, cls: type[Input]) -> str:
    if name in QUANTITIES:
        return f"{QUANTITIES[name].meaning}, {QUANTITIES[name].wanted}"
    return cls.model_fields[name].description or "required"
