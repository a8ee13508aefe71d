"""What the form asks: the fields of the records of a case, with unit, bounds and help of the table of quantities."""

import math
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel

from stiction.case.text import inline
from stiction.contact.contact import Contact, Indices
from stiction.contact.materials import Material, material, material_names
from stiction.quantities.errors import InputError
from stiction.quantities.quantity import Quantity
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import show, to_si
from stiction.surfaces.finished import Finished, is_finished
from stiction.surfaces.finishes import SURFACE_KINDS, finish_names

__all__ = [
    "NOT_STATED", "Choices", "InterfacePart", "Knob", "MaterialPart", "Number", "Part", "as_written", "dropped", "got",
    "numbers_of", "parts_of", "placed",
]  # fmt: skip

NOT_STATED = "not stated"
_STRENGTH = ("interfacial_shear_strength", "pressure_coefficient")  # in place of a state of the interface
_DECADES = 3.0  # of a slider, to either side of the example of a quantity
Path = tuple[str, ...]
ROUGHNESS: Path = ("contact", "roughness")
# Fields that are words: what they may be, and what holds where they are left out.
_WORDS: dict[str, tuple[tuple[str, ...], str]] = {
    "kind": ((NOT_STATED, *dict.fromkeys([*SURFACE_KINDS, *finish_names()])), NOT_STATED),
    "finish": (tuple(finish_names()), finish_names()[0]),
}


@dataclass(frozen=True)
class Knob:
    """A slider: its ends and its step, of the number or, if log, of its decimal logarithm."""

    low: float
    high: float
    step: float
    log: bool

    def place(self, value: float) -> float:
        """Where the slider stands for a value in SI."""
        return math.log10(value) if self.log and value > 0.0 else self.low if self.log else value

    def value(self, place: float) -> float:
        """The value, SI, at a place of the slider."""
        return 10.0**place if self.log else place


@dataclass(frozen=True)
class Number:
    """A number of the case: where it stands in the tables, its row of the table, and whether it may be left out."""

    path: Path
    quantity: Quantity
    required: bool

    @property
    def label(self) -> str:
        return f"{self.quantity.meaning} {self.quantity.symbol}"

    @property
    def help(self) -> str:
        return self.quantity.wanted + ("" if self.required else "; may be left out")

    def text(self, value: float) -> str:
        """A value in SI as a case file has it, to four digits."""
        return show(value, self.quantity.name, 4)

    def written(self, text: str) -> Any:
        """What the table of a case has for this text: a number where there is no unit, the text where there is one; a list or
        a distribution as a case file has it."""
        if text.startswith(("[", "{")):
            try:
                return tomllib.loads(f"given = {text}")["given"]
            except tomllib.TOMLDecodeError:
                return text  # the case will say what is wrong with it
        if self.quantity.unit:
            return text
        try:
            return float(text)
        except ValueError:
            return text  # the case will say what is wrong with it

    def si(self, given: Any) -> float | None:
        """The value in SI of what stands in a table; None where that is not one number."""
        try:
            value = to_si(given, self.quantity.name)
        except InputError:
            return None
        return value if isinstance(value, float) else None

    def knob(self, value: float) -> Knob:
        """A slider for it, on which this value has a place."""
        lower, upper = self.quantity.lower, self.quantity.upper
        if math.isfinite(lower) and upper <= 2.0:
            step = 0.005
            ends = (
                lower if self.quantity.lower_included else lower + step,
                upper if self.quantity.upper_included else upper - step,
            )
            return Knob(*ends, step, False)
        example = self.si(self.quantity.example) or 1.0
        places = [math.log10(one) for one in (example, value) if one > 0.0]
        low, high = min(places) - _DECADES, max(places) + _DECADES
        low = max(low, math.log10(lower)) if lower > 0.0 else low
        if math.isfinite(upper):
            high = min(high, math.log10(upper) - (0.0 if self.quantity.upper_included else 0.01))
        return Knob(low, high, 0.01, True)


@dataclass(frozen=True)
class Choices:
    """A word of the case, one of a few. default: what holds where it is left out; NOT_STATED leaves it out."""

    path: Path
    values: tuple[str, ...]
    default: str


@dataclass(frozen=True)
class MaterialPart:
    """A body: where it stands in the tables, and its numbers."""

    path: Path
    numbers: tuple[Number, ...]

    def preset(self, tables: Mapping[str, Any]) -> str:
        """The name of the material that it starts from, "" if it is all numbers of its own."""
        given = got(tables, self.path)
        return given if isinstance(given, str) else str((given or {}).get("preset", ""))

    def names(self, tables: Mapping[str, Any]) -> list[str]:
        """Materials that it may start from: presets, and those of the case."""
        own = tables.get("materials")
        return [*(own if isinstance(own, Mapping) else {}), *material_names()]

    def of_preset(self, tables: Mapping[str, Any], number: Number) -> str:
        """What the preset says of a number, as text; "" where it says nothing."""
        try:
            value = getattr(material(self.preset(tables)), number.quantity.name)
        except InputError:
            return ""
        return "" if value is None else number.text(value)


@dataclass(frozen=True)
class InterfacePart:
    """The interface of two bodies: the place of its state, and the numbers that stand in place of a state."""

    path: Path
    numbers: tuple[Number, ...]


@dataclass(frozen=True)
class Part:
    """A table of the case with its fields; optional: it may be left out as a whole."""

    path: Path
    optional: bool
    fields: tuple[Number | Choices | MaterialPart | InterfacePart, ...]


def numbers_of(part: Part) -> Iterator[Number]:
    """Yield the numbers of a part, with those of its bodies and its interface."""
    for one in part.fields:
        if isinstance(one, Number):
            yield one
        elif isinstance(one, MaterialPart | InterfacePart):
            yield from one.numbers


def parts_of(tables: Mapping[str, Any]) -> list[Part]:
    """The parts of a form for these tables."""
    if "indices" in tables:
        return list(_parts(Indices, ("indices",), False))
    found = list(_parts(Contact, ("contact",), False))
    if is_finished(got(tables, ROUGHNESS)):
        of_finish = next(_parts(Finished, ROUGHNESS, False))
        return [of_finish if part.path == ROUGHNESS else part for part in found]
    return found


def _parts(record: type[BaseModel], path: Path, optional: bool) -> Iterator[Part]:
    fields: list[Number | Choices | MaterialPart | InterfacePart] = []
    inner: list[Part] = []
    for name, field in record.model_fields.items():
        place = (*path, name)
        below = _record_in(field.annotation)
        if record is Contact and name in _STRENGTH:
            continue
        if name in QUANTITIES:
            fields.append(Number(place, QUANTITIES[name], field.is_required()))
        elif get_origin(field.annotation) is Literal:
            fields.append(Choices(place, get_args(field.annotation), field.default))
        elif name in _WORDS:
            fields.append(Choices(place, *_WORDS[name]))
        elif name == "interface":
            strengths = [(one, record.model_fields[one].is_required()) for one in _STRENGTH]
            fields.append(InterfacePart(place, tuple(Number((*path, one), QUANTITIES[one], must) for one, must in strengths)))
        elif below is Material:
            fields.append(MaterialPart(place, _numbers(Material, place)))
        elif below is not None and below is not record:
            inner += _parts(below, place, not field.is_required())
    yield Part(path, optional, tuple(fields))
    yield from inner


def _numbers(record: type[BaseModel], path: Path) -> tuple[Number, ...]:
    known = [(name, field) for name, field in record.model_fields.items() if name in QUANTITIES]
    return tuple(Number((*path, name), QUANTITIES[name], field.is_required()) for name, field in known)


def _record_in(annotation: Any) -> type[BaseModel] | None:
    """The record that a field holds, if it holds one."""
    for one in (annotation, *get_args(annotation)):
        if isinstance(one, type) and issubclass(one, BaseModel):
            return one
    return None


def as_written(given: Any) -> str:
    """Return what stands at a place of the tables as a case file has it, on a line, a text without quotes; "" for nothing."""
    return "" if given is None else given if isinstance(given, str) else inline(given)


def got(tables: Any, path: Path) -> Any:
    """What stands at a place of the tables; None for nothing."""
    for key in path:
        if isinstance(tables, str) and key == "preset":
            return tables
        if not isinstance(tables, Mapping) or key not in tables:
            return None
        tables = tables[key]
    return tables


def placed(tables: Mapping[str, Any], path: Path, value: Any) -> dict[str, Any]:
    """The tables with a value at a place. A material that was only a name becomes a table that starts from it."""
    key, rest = path[0], path[1:]
    if not rest:
        return {**tables, key: value}
    inner = tables.get(key, {})
    if isinstance(inner, str):
        inner = {"preset": inner}
    return {**tables, key: placed(inner if isinstance(inner, Mapping) else {}, rest, value)}


def dropped(tables: Mapping[str, Any], path: Path) -> dict[str, Any]:
    """The tables without what stands at a place."""
    key, rest = path[0], path[1:]
    if not rest:
        return {name: one for name, one in tables.items() if name != key}
    inner = tables.get(key)
    return {**tables, key: dropped(inner, rest)} if isinstance(inner, Mapping) else dict(tables)
