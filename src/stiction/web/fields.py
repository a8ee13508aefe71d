"""Derive the fields of the form from the records of a case, and read the cases that the page offers.

The tables of a case are nested dicts, as they are read from a case file. A path is the sequence of keys to an entry.
"""

import math
import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib import resources
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel

from stiction.case.swept import with_error
from stiction.case.text import inline
from stiction.case.uncertain import read_distribution
from stiction.contact.contact import Contact, Indices
from stiction.contact.materials import Material
from stiction.quantities.errors import InputError
from stiction.quantities.quantity import Quantity
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si
from stiction.report.table import with_signs
from stiction.surfaces.finished import Finished, is_finished
from stiction.surfaces.finishes import SURFACE_KINDS, finish_names

NOT_STATED = "not stated"
_STRENGTH = ("interfacial_shear_strength", "pressure_coefficient")  # numbers that replace a named interface state
_DECADES = 3.0  # decades of a slider on either side of the example value
Path = tuple[str, ...]
ROUGHNESS: Path = ("contact", "roughness")
INTERFACE: Path = ("contact", "interface")
# Fields that take a word: the allowed words, and the word that applies if the case lacks the field.
_WORDS: dict[str, tuple[tuple[str, ...], str]] = {
    "kind": ((NOT_STATED, *dict.fromkeys([*SURFACE_KINDS, *finish_names()])), NOT_STATED),
    "finish": (tuple(finish_names()), finish_names()[0]),
}


@dataclass(frozen=True)
class Knob:
    """Hold range and step of a slider, for a number in SI units or, if `log` is True, for its decimal logarithm."""

    low: float
    high: float
    step: float
    log: bool

    def place(self, value: float) -> float:
        """Return the slider position of a value in SI units; the lower end for a value of 0 or less on a logarithmic slider."""
        return math.log10(value) if self.log and value > 0.0 else self.low if self.log else value

    def value(self, place: float) -> float:
        """Return the value in SI units at a slider position."""
        return 10.0**place if self.log else place


@dataclass(frozen=True)
class Number:
    """Describe a number field of the form: its path in the tables of the case, its quantity, and whether it is required."""

    path: Path
    quantity: Quantity
    required: bool

    @property
    def label(self) -> str:
        """Return the meaning and symbol of the number, as the label of its field."""
        return f"{self.quantity.meaning} {self.quantity.symbol}"

    @property
    def help(self) -> str:
        """Return the help text of the number field: label, allowed range, example, and whether it is optional."""
        return with_signs(f"{self.label}: {self.quantity.wanted}") + ("" if self.required else "; may be left out")

    def text(self, value: float) -> str:
        """Format a value in SI units as a field shows it, with four digits."""
        return with_signs(show(value, self.quantity.name, 4))

    def written(self, text: str) -> Any:
        """Convert the text of a field to an entry of a case table: a number, a text with a unit, a list or a distribution.

        Other text is returned unchanged; reading the case then raises an error that names the field.
        """
        try:
            if text.startswith(("[", "{")):
                return tomllib.loads(f"given = {text}")["given"]
            for form, keys in _UNCERTAIN.items():
                if found := form.fullmatch(text):
                    given = dict(zip(keys, found.groups(), strict=True))
                    return {key: float(one) if key == "factor" else self.written(one) for key, one in given.items()}
            return text.translate(_ON_KEYBOARD) if self.quantity.unit else float(text)
        except ValueError:
            return text  # reading the case raises the error

    def si(self, given: Any) -> float | None:
        """Return an entry of a case table as a number in SI units; None if it is not a single number.

        An uncertain number gives its nominal value.
        """
        try:
            if with_error(given):
                return float(read_distribution(given, self.quantity.name, "").nominal)
            value = to_si(given, self.quantity.name)
        except InputError:
            return None
        return value if isinstance(value, float) else None

    def moved(self, given: Any, value: float) -> Any:
        """Return an entry of a case table with its number replaced by a new value in SI units.

        given: the present entry. An uncertain entry keeps its relative uncertainty.
        """
        before = self.si(given)
        if not with_error(given) or not before or not isinstance(given, str | Mapping):
            return self.written(self.text(value))
        if isinstance(given, str):
            deviation = read_distribution(given, self.quantity.name, "").parameters[-1] / abs(before)
            return f"{self.written(self.text(value))} +/- {100.0 * deviation:.3g} %"
        ends = {key: self.si(one) for key, one in given.items() if key in ("low", "high", "median")}
        return {**given, **{key: self.written(self.text(end * value / before)) for key, end in ends.items() if end is not None}}

    def knob(self, value: float) -> Knob:
        """Return a slider for this number whose range includes a value in SI units."""
        row = self.quantity
        linear = math.isfinite(row.lower) and (row.upper <= 2.0 or row.lower < 0.0)
        step = 0.005 if linear else 0.01
        below, above = (0.0 if included else step for included in (row.lower_included, row.upper_included))
        if linear:
            return Knob(row.lower + below, row.upper - above, step, False)
        places = [math.log10(one) for one in (self.si(row.example) or 1.0, value) if one > 0.0]
        low = math.log10(row.lower) if row.lower > 0.0 else -math.inf
        high = math.log10(row.upper) - above
        return Knob(max(min(places) - _DECADES, low), min(max(places) + _DECADES, high), step, True)


@dataclass(frozen=True)
class Choices:
    """Describe a field of the form that takes one of a few words.

    path: sequence of keys in the tables of the case. default: the word that applies if the case lacks the field. The word
    NOT_STATED removes the field from the case.
    """

    path: Path
    values: tuple[str, ...]
    default: str


@dataclass(frozen=True)
class Part:
    """Describe a part of the form: one table of the case, such as "coating", with its fields.

    path: sequence of keys to the table. Some fields are parts themselves: a body, or the numbers that replace a named interface
    state.
    """

    path: Path
    fields: tuple["Number | Choices | Part", ...]


def numbers_of(part: Part) -> Iterator[Number]:
    """Yield the number fields of a part of the form, including those of its bodies and its interface."""
    for one in part.fields:
        if isinstance(one, Part):
            yield from numbers_of(one)
        elif isinstance(one, Number):
            yield one


def parts_of(tables: Mapping[str, Any]) -> list[Part]:
    """Return the parts of the form for a case: those of a Contact or of Indices; `tables` are the tables of the case."""
    if "indices" in tables:
        return list(_parts(Indices, ("indices",)))
    found = list(_parts(Contact, ("contact",)))
    if is_finished(value_at(tables, ROUGHNESS)):
        of_finish = next(_parts(Finished, ROUGHNESS))
        return [of_finish if part.path == ROUGHNESS else part for part in found]
    return found


def _parts(record: type[BaseModel], path: Path) -> Iterator[Part]:
    fields: list[Number | Choices | Part] = []
    inner: list[Part] = []
    for name, field in record.model_fields.items():
        place = (*path, name)
        below = next((one for one in (field.annotation, *get_args(field.annotation)) if _is_record(one)), None)
        if name in QUANTITIES and not (record is Contact and name in _STRENGTH):
            fields.append(Number(place, QUANTITIES[name], field.is_required()))
        elif get_origin(field.annotation) is Literal:
            fields.append(Choices(place, get_args(field.annotation), field.default))
        elif name in _WORDS:
            fields.append(Choices(place, *_WORDS[name]))
        elif name == "interface":
            fields.append(Part(place, tuple(Number((*path, one), QUANTITIES[one], False) for one in _STRENGTH)))
        elif below is Material:
            fields += _parts(Material, place)
        elif below is not None and below is not record:
            inner += _parts(below, place)
    yield Part(path, tuple(fields))
    yield from inner


def _is_record(annotation: Any) -> bool:
    return isinstance(annotation, type) and issubclass(annotation, BaseModel)


_ON_KEYBOARD = str.maketrans({"µ": "u", "μ": "u", "²": "^2", "³": "^3"})  # symbol in a unit -> its text in a case file
# Text of an uncertain number on the page -> its keys in a case file.
_UNCERTAIN = {re.compile("(.+) within a factor (\\S+)"): ("median", "factor"), re.compile("(.+) to (.+)"): ("low", "high")}


def as_written(given: Any) -> str:
    """Return an entry of the case tables as one line of text; "" for None.

    Units are written with their symbols, "µm" for "um"; other text is unchanged. The tables {low, high} and {median, factor}
    become "30 nm to 70 nm" and "1 µm within a factor 2"; other tables and lists are written as in a case file.
    """
    if isinstance(given, Mapping) and given.keys() == {"median", "factor"}:
        given = f"{given['median']} within a factor {given['factor']}"
    if isinstance(given, Mapping) and given.keys() == {"low", "high"}:
        given = f"{given['low']} to {given['high']}"
    return "" if given is None else with_signs(given) if isinstance(given, str) else inline(given)


def value_at(tables: Any, path: Path) -> Any:
    """Return the entry at a path of keys in the tables of a case; None if there is no entry.

    A material specified only by its name is read as a table with the key "preset".
    """
    for key in path:
        if isinstance(tables, str) and key == "preset":
            return tables
        if not isinstance(tables, Mapping) or key not in tables:
            return None
        tables = tables[key]
    return tables


def with_value_at(tables: Mapping[str, Any], path: Path, value: Any) -> dict[str, Any]:
    """Return a copy of the tables of a case with a value at a path of keys; None removes the entry.

    A material specified only by its name becomes a table with the key "preset".
    """
    key, rest = path[0], path[1:]
    inner = tables.get(key)
    if rest:
        if value is None and not isinstance(inner, Mapping):
            return dict(tables)
        inner = {"preset": inner} if isinstance(inner, str) else inner
        value = with_value_at(inner if isinstance(inner, Mapping) else {}, rest, value)
    kept = {name: one for name, one in tables.items() if name != key or value is not None}
    return kept if value is None else {**kept, key: value}


def with_points(tables: Mapping[str, Any], points: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy of the tables of a case with other loads or separations in the table [solve].

    points: {"load": ...} or {"separation": ...}, as in a case file.
    """
    solve = {name: value for name, value in tables.get("solve", {}).items() if name not in ("load", "separation")}
    return {**tables, "solve": {**solve, **points}}


# Content that the switch of an optional part puts into the case.
OPTIONAL_PARTS: dict[str, dict[str, Any]] = {
    "coating": {"material": "silver", "thickness": "200 nm", "bodies": "first"},
    "liquid": {"relative_humidity": 0.5, "contact_angle_first": "10 deg", "contact_angle_second": "10 deg"},
}

ENDINGS = {"first": "first body", "second": "second body", "coating": "film"}
# Ways to specify a surface, each with the initial numbers in the form.
SURFACE_KNOWN_BY: dict[str, dict[str, Any]] = {
    "σ, R, N": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
    "finish and Sq or Ra": {"finish": "ground"},
}


def first_case() -> dict[str, Any]:
    """Return the tables of the case that the page shows first: a soft film on hardened steel."""
    return _packaged("first.toml")


def example_cases() -> dict[str, dict[str, Any]]:
    """Return the tables of the cases in the menu of examples, by their titles."""
    named = {title: {"title": title, **tables} for title, tables in _packaged("examples.toml").items()}
    return {first_case()["title"]: first_case(), **named}


def _packaged(name: str) -> dict[str, Any]:
    return tomllib.loads(resources.files("stiction.web").joinpath(name).read_text(encoding="utf-8"))
