"""Materials, given by numbers or taken from the presets in material_data/ (one file per source of data)."""

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any, Literal, NamedTuple, Self, get_args

import numpy as np
from pydantic import Field, model_validator

from stiction.quantities.data_files import read_tables
from stiction.quantities.errors import InputError, field_as, nearest
from stiction.quantities.inputs import Input, Number, OptionalNumber
from stiction.quantities.ranges import Ranges, check_ranges, range_in_words
from stiction.quantities.units import to_si

# What decides which states an interface may be in, the class that rules a pair first.
MaterialClass = Literal["ice", "elastomer", "polymer", "layered solid", "carbon film", "soft metal", "metal", "ceramic"]
MATERIAL_CLASSES: tuple[str, ...] = get_args(MaterialClass)


class Material(Input):
    """A homogeneous isotropic material.

    name: what to call it; source: where the numbers come from, one text or one for each field; range: between which ends a
    number lies, {"hardness": ("0.3 GPa", "0.5 GPa")}, kept in SI units: of a preset, what tables, grades and makes give; no
    result uses it. characteristic_depth: h* of a hardness that grows as imprints get smaller (Nix and Gao 1998), under a
    pyramid; hardness is then that of large imprints, and asperities find more (stiction.contact.size_effect). Left out, the
    hardness is that of every asperity; the contact of a map, solved point by point, always takes it so. material_class: see
    MATERIAL_CLASSES; left out, `class_of` guesses it from the numbers.

    Numbers are SI floats, text with a unit ("210 GPa"), or arrays with a named dimension (`stiction.axis`).
    Raises InputError naming the field, its value and the allowed range.
    """

    name: str = "unnamed"
    youngs_modulus: Number
    poissons_ratio: Number
    hardness: Number
    yield_stress: OptionalNumber = None
    tangent_modulus: OptionalNumber = None
    characteristic_depth: OptionalNumber = None
    surface_energy: OptionalNumber = None
    source: str | dict[str, str] | None = Field(None, union_mode="left_to_right")
    range: Ranges = Field(default_factory=dict, description="low and high end of its numbers")
    material_class: MaterialClass | None = Field(None, description=", ".join(MATERIAL_CLASSES))

    @model_validator(mode="after")
    def _ranges_hold_the_numbers(self):
        check_ranges(self)
        return self

    def replace(self, **changes: Any) -> Self:
        """Another material, with these fields in place of its own; what is replaced loses its source and its range. Raises
        InputError."""
        return super().replace(**changes | notes_left(self.source, self.range, changes))

    @property
    def shear_modulus(self):
        """Shear modulus of an isotropic material [Pa], E / (2 (1 + nu))."""
        return self.youngs_modulus / (2 * (1 + self.poissons_ratio))

    def notes(self) -> list[str]:
        """Where the numbers come from, and between which ends they lie."""
        ends = [f"range of {field}: {range_in_words(*pair, field)}" for field, pair in self.range.items()]
        if not self.source:
            return ends
        if isinstance(self.source, str):
            return [f"source: {self.source}", *ends]
        return [*(f"{field}: {text}" for field, text in self.source.items() if text), *ends]

    def is_own(self, field: str) -> bool:
        """Whether this field was given, and is not just that of the preset of this name."""
        value = getattr(self, field)
        of_this_name = _presets().get(self.name)
        preset = None if of_this_name is None else of_this_name.numbers.get(field)
        return value is not None and not (preset is not None and np.all(to_si(preset, field) == value))

    @classmethod
    def __get_pydantic_json_schema__(cls, core_schema, handler):
        """In a file a material may also start from a preset: {preset = "silver", hardness = "0.5 GPa"}."""
        schema = super().__get_pydantic_json_schema__(core_schema, handler)
        schema["properties"]["preset"] = {
            "description": "preset, or material of the case, whose numbers hold wherever none is given here",
            "anyOf": [{"enum": material_names()}, {"type": "string"}],
        }
        schema["anyOf"] = [{"required": ["preset"]}, {"required": schema.pop("required")}]
        return schema


def material_names() -> list[str]:
    """Names of the presets, in alphabetical order."""
    return sorted(_presets())


def material(name: str, /, **changes) -> Material:
    """The preset of that name or symbol, changed where fields are given: material("Ag", hardness="1 GPa").

    changes: fields of `Material`, in SI or text with a unit; what is replaced loses its source and its range. Raises InputError
    for an unknown name, listing those near to it, for one of several presets, and for a bad number.
    """
    name = preset_name(name)
    preset = _presets()[name]
    own = {"name": name, "material_class": preset.material_class, **preset.numbers}
    return Material(**own | changes | notes_left(preset.source, preset.range, changes))


def preset_name(word: Any, field: str = "material", others: Sequence[str] = ()) -> str:
    """Return the name of the preset that a name, chemical symbol or formula stands for: "silver" for "Ag".

    Upper and lower case count only where they tell presets apart: "tin" is the metal, "TiN" the nitride. others: names that
    would be accepted in place of a preset. Raises InputError, with the name of the field, for an unknown or ambiguous word.
    """
    if isinstance(word, str) and word in _presets():
        return word
    words = {(name, text) for name, preset in _presets().items() for text in (name, *preset.symbols)}
    exact = {name for name, text in words if text == word}
    meant = sorted(exact or {name for name, text in words if text.casefold() == str(word).casefold()})
    if len(meant) == 1:
        return meant[0]
    if meant:
        choices = ", ".join(f"{name} ({symbols_of(name)[0]})" for name in meant)
        raise InputError(field, word, f"one of {choices}: several presets have this name")
    wanted = "a material of the case, or a preset: " if others else "a preset: "
    raise InputError(field, word, f"{wanted}{nearest(word, [*others, *material_names()])}; all: stiction materials")


def symbols_of(name: str) -> tuple[str, ...]:
    """Return the chemical symbols, formulas and designations that mean this preset and no other, the usual one first."""
    every = [symbol for preset in _presets().values() for symbol in preset.symbols]
    return tuple(symbol for symbol in _presets()[name].symbols if every.count(symbol) == 1)


def notes_left(source: Any, ends: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return source and range of a changed record: its own wherever nothing is changed, and what the changes say."""
    if isinstance(source, Mapping):
        source = {field: text for field, text in source.items() if field not in changes}
    given = changes.get("range", {})
    kept = {field: pair for field, pair in ends.items() if field not in changes}
    return {"source": changes.get("source", source), "range": {**kept, **given} if isinstance(given, Mapping) else given}


def as_material(value):
    """Validator of a field that holds a body: a Material, the name of a preset, or a table of numbers."""
    if isinstance(value, str):
        value = {"preset": value}
    if isinstance(value, dict) and "preset" in value:
        changes: dict[str, Any] = {key: entry for key, entry in value.items() if key != "preset"}
        with field_as(lambda field: "" if field == "material" else field):
            return material(value["preset"], **changes)
    return value


def class_of(body: Material) -> str:
    """Return the class of a material; where it has none, guess it: elastomers below 0.1 GPa, polymers below 10 GPa, ceramics
    from H/E = 0.038 on, metals else."""
    if body.material_class is not None:
        return body.material_class
    modulus, hardness = (float(np.mean(value)) for value in (body.youngs_modulus, body.hardness))
    if modulus < 1e10:
        return "elastomer" if modulus < 1e8 else "polymer"
    return "ceramic" if hardness / modulus >= 0.038 else "metal"


class _Preset(NamedTuple):
    """A preset as its file has it: numbers, the source and the low and high end of each, symbols and class."""

    numbers: dict[str, Any]
    source: dict[str, str]
    range: dict[str, list]
    symbols: tuple[str, ...]
    material_class: str


@cache
def _presets() -> dict[str, _Preset]:
    """Every preset, read from all files of material_data/."""
    presets: dict[str, _Preset] = {}
    for name, data in read_tables("contact", "material_data", "materials").items():
        notes, ends = data.pop("source", {}), data.pop("range", {})
        symbols, group = tuple(data.pop("symbols", ())), data.pop("material_class")
        presets[name] = _Preset(data, {field: notes.get(field, "") for field in data}, ends, symbols, group)
    return presets
