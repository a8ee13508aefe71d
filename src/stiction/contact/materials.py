"""Define the class Material, and read the preset materials from the files in material_data/, one file per source."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Self, get_args

import numpy as np
from pydantic import Field, model_validator

from stiction.quantities.data_files import read_tables
from stiction.quantities.errors import InputError, field_as, nearest
from stiction.quantities.inputs import Input, Number, OptionalNumber, by_default
from stiction.quantities.ranges import Ranges, check_ranges, range_in_words
from stiction.quantities.units import to_si

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import NumberOrArray, QuantityLike

# Classes of materials, which determine the possible interface states. The earlier class of a pair comes first in its name.
MaterialClass = Literal["ice", "elastomer", "polymer", "layered solid", "carbon film", "soft metal", "metal", "ceramic"]
MATERIAL_CLASSES: tuple[str, ...] = get_args(MaterialClass)
# What to write for a material or an interface called "anodised aluminium", "anodic oxide" and so on.
_ANODISED = re.compile("anodi[csz]", re.IGNORECASE)
_AS_FILM = 'aluminium, with coating = { material = "alumina", thickness = "10 um", bodies = "first" } and interface = "ceramic"'


class Material(Input):
    """Describe a homogeneous isotropic material.

    Parameters
    ----------
    youngs_modulus, hardness : float [Pa], str with a unit, or array
        Hardness is the mean pressure of a fully plastic contact.
    poissons_ratio : float or array
        At least 0 and below 0.5.
    yield_stress, tangent_modulus : float [Pa], str with a unit, or array, optional
        Yield stress in tension, and slope of the stress-strain curve beyond yield; some laws use them.
    surface_energy : float [J/m^2], str with a unit, or array, optional
        Energy of a clean surface.
    characteristic_depth : float [m], str with a unit, or array, optional
        Depth h* of a pyramid's imprint at which the hardness is sqrt(2) times the value of large imprints (Nix and Gao 1998).
        `hardness` is then the value of large imprints; small asperities have a larger hardness, except in models that solve a
        height map point by point.
    name : str, optional
        Name in results.
    source : str or dict, optional
        Source of the numbers, one text or one for each field.
    range : dict, optional
        Low and high end of a number, {"hardness": ("0.3 GPa", "0.5 GPa")}, in SI units or text.
    material_class : str, optional
        One of MATERIAL_CLASSES; by default `class_of` guesses it from the numbers.

    Raises
    ------
    InputError
        A number is out of its bounds; the error names the field, its value and the allowed range.

    Examples
    --------
    >>> import stiction as st
    >>> st.Material(youngs_modulus="210 GPa", poissons_ratio=0.3, hardness="7 GPa").hardness
    7000000000.0
    """

    name: str = "unnamed"
    youngs_modulus: Number
    poissons_ratio: Number
    hardness: Number
    yield_stress: OptionalNumber = by_default(None)
    tangent_modulus: OptionalNumber = by_default(None)
    characteristic_depth: OptionalNumber = by_default(None)
    surface_energy: OptionalNumber = by_default(None)
    source: str | dict[str, str] | None = Field(default=None, union_mode="left_to_right")
    range: Ranges = Field(default_factory=dict, description="low and high end of each number")
    material_class: MaterialClass | None = Field(default=None, description=", ".join(MATERIAL_CLASSES))

    @model_validator(mode="after")
    def _ranges_hold_the_numbers(self):
        check_ranges(self)
        return self

    def replace(self, **changes: object) -> Self:
        """Return a copy of the material with the fields in `changes` replaced.

        A replaced number loses its range, and also its source if sources are given by number. Raises InputError for a bad
        field.
        """
        return super().replace(**changes | remaining_notes(self.source, self.range, changes))

    @property
    def shear_modulus(self) -> "NumberOrArray":
        """Return the shear modulus [Pa] of an isotropic material, E / (2 (1 + nu))."""
        return self.youngs_modulus / (2 * (1 + self.poissons_ratio))

    def notes(self) -> list[str]:
        """Return the sources and the ranges of the numbers, one text each."""
        ends = [f"range of {field}: {range_in_words(*pair, field)}" for field, pair in self.range.items()]
        if not self.source:
            return ends
        if isinstance(self.source, str):
            return [f"source: {self.source}", *ends]
        return [*(f"{field}: {text}" for field, text in self.source.items() if text), *ends]

    def is_own(self, field: str) -> bool:
        """Return whether a field has a value, and the preset of the same name does not have this value.

        field: name of a number, such as "yield_stress". A value is also the user's own if no such preset exists or if the
        preset lacks this number.
        """
        value = getattr(self, field)
        of_this_name = _presets().get(self.name)
        preset = None if of_this_name is None else of_this_name.numbers.get(field)
        return value is not None and not (preset is not None and np.all(to_si(preset, field) == value))

    @classmethod
    def __get_pydantic_json_schema__(cls, core_schema, handler):
        """Return the JSON schema of a material: all its required numbers, or a preset with some numbers replaced.

        Example of the second form: {preset = "silver", hardness = "0.5 GPa"}.
        """
        schema = super().__get_pydantic_json_schema__(core_schema, handler)
        schema["properties"]["preset"] = {
            "description": "preset, or material of the case, whose numbers are used where none is stated here",
            "anyOf": [{"enum": material_names()}, {"type": "string"}],
        }
        schema["anyOf"] = [{"required": ["preset"]}, {"required": schema.pop("required")}]
        return schema


def material_names() -> list[str]:
    """Return the names of the preset materials, in alphabetical order."""
    return sorted(_presets())


def material(name: str, /, **changes: "QuantityLike | None") -> Material:
    """Return the preset material of this name or chemical symbol, with some numbers replaced.

    Parameters
    ----------
    name : str
        Name, chemical symbol or formula of a preset.
    **changes : float [SI], str with a unit, or array
        Fields of `Material`; a number that is replaced loses its source and its range.

    Returns
    -------
    Material
        The preset with the changes.

    Raises
    ------
    InputError
        The name is unknown or belongs to more than one preset, or a number is out of its bounds.

    Examples
    --------
    >>> import stiction as st
    >>> st.material("Ag", hardness="1 GPa").hardness
    1000000000.0
    """
    name = preset_name(name)
    preset = _presets()[name]
    own = {"name": name, "material_class": preset.material_class, **preset.numbers}
    return Material(**own | changes | remaining_notes(preset.source, preset.range, changes))


def work_of_adhesion(
    first: Material | str, second: Material | str, *, interfacial: "QuantityLike"
) -> "float | xarray.DataArray":
    """Return the work of adhesion of two surfaces, gamma_1 + gamma_2 - gamma_12 (Dupre).

    Parameters
    ----------
    first, second : Material or str
        Material or name of a preset, with a surface energy gamma_1 or gamma_2.
    interfacial : float [J/m^2] or str with a unit
        Energy of the closed interface, gamma_12 >= 0.

    Returns
    -------
    float or xarray.DataArray
        Work of adhesion [J/m^2].

    Raises
    ------
    InputError
        A surface energy is missing, or the result is negative.

    Notes
    -----
    The interfacial energy is zero for two bodies of one material in perfect registry. For other pairs, zero gives an upper
    bound. The surface energies apply to clean surfaces; adsorbed layers lower the work of adhesion by one or two orders of
    magnitude.

    Examples
    --------
    >>> import stiction as st
    >>> round(float(st.work_of_adhesion("silver", "silver", interfacial=0.0)), 2)
    2.5
    """
    energies = []
    for field, body in (("first", first), ("second", second)):
        body = as_material(body)
        if getattr(body, "surface_energy", None) is None:
            raise InputError(f"{field}.surface_energy", None, "a material with a surface_energy, e.g. 1.25 J/m^2")
        energies.append(body.surface_energy)
    return to_si(energies[0] + energies[1] - to_si(interfacial, "interfacial_energy"), "work_of_adhesion")


def preset_name(word: Any, field: str = "material", others: Sequence[str] = ()) -> str:
    """Return the name of the preset material that a name, chemical symbol or formula denotes: "silver" for "Ag".

    Case matters only where it distinguishes presets: "tin" is the metal, "TiN" the nitride. field: name of the input, for the
    error. others: names of materials that the case defines, for the error. Raises InputError for an unknown or ambiguous word.
    """
    if not isinstance(word, str):
        raise InputError(field, word, "the name of a preset; `stiction materials` lists them")
    if word in _presets():
        return word
    words = {(name, text) for name, preset in _presets().items() for text in (name, *preset.symbols)}
    exact = {name for name, text in words if text == word}
    meant = sorted(exact or {name for name, text in words if text.casefold() == str(word).casefold()})
    if len(meant) == 1:
        return meant[0]
    if meant:
        choices = ", ".join(f"{name} ({symbols_of(name)[0]})" for name in meant)
        raise InputError(field, word, f"one of {choices}, because several presets have this name")
    refuse_anodised(word, field)
    wanted = "a material of the case, or a preset: " if others else "a preset: "
    own = "(all: run `stiction materials`); for another material, state youngs_modulus, poissons_ratio and hardness"
    raise InputError(field, word, f"{wanted}{nearest(word, [*others, *material_names()])} {own}")


def refuse_anodised(word: str, field: str) -> None:
    """Raise InputError, which states what to write instead, if a word names an anodised surface.

    field: name of the input, for the error.
    """
    if _ANODISED.search(word):
        raise InputError(field, word, _AS_FILM)


def symbols_of(name: str) -> tuple[str, ...]:
    """Return the chemical symbols, formulas and designations of a preset, in the order of its file."""
    return tuple(_presets()[name].symbols)


def remaining_notes(source: Any, ranges: Mapping[str, Any], changes: Mapping[str, object]) -> dict[str, Any]:
    """Return the fields `source` and `range` of a record after some of its numbers are replaced.

    - source: text, or texts by name of the number; ranges: by name of the number; both before the change
    - changes: new values by field; they may include `source` and `range`

    Replaced numbers lose their range, and also their source if sources are given by number; a single text is kept. New sources
    and ranges in `changes` are used.
    """
    if isinstance(source, Mapping):
        source = {field: text for field, text in source.items() if field not in changes}
    given = changes.get("range", {})
    kept = {field: pair for field, pair in ranges.items() if field not in changes}
    return {"source": changes.get("source", source), "range": {**kept, **given} if isinstance(given, Mapping) else given}


def as_material(value):
    """Return a Material from the name of a preset or from a table that changes a preset; return other values unchanged.

    Raises InputError for an unknown preset or a bad change.
    """
    if isinstance(value, str):
        value = {"preset": value}
    if isinstance(value, dict) and "preset" in value:
        changes: dict[str, Any] = {key: entry for key, entry in value.items() if key != "preset"}
        with field_as(lambda field: "" if field == "material" else field):
            return material(value["preset"], **changes)
    return value


def class_of(body: Material) -> str:
    """Return the specified material class of a body, or guess it from Young's modulus E and hardness H.

    Below E = 0.1 GPa the class is "elastomer", below 10 GPa "polymer". Otherwise it is "ceramic" if H/E is 0.038 or more, else
    "metal". For arrays, the mean values are used.
    """
    if body.material_class is not None:
        return body.material_class
    modulus, hardness = (float(np.mean(value)) for value in (body.youngs_modulus, body.hardness))
    if modulus < 1e10:
        return "elastomer" if modulus < 1e8 else "polymer"
    return "ceramic" if hardness / modulus >= 0.038 else "metal"


class _Preset(NamedTuple):
    """Store a preset material as defined in its file: numbers, sources, ranges, symbols and class."""

    numbers: dict[str, Any]
    source: dict[str, str]
    range: dict[str, list]
    symbols: tuple[str, ...]
    material_class: str


@cache
def _presets() -> dict[str, _Preset]:
    """Return all preset materials by name, read from the files of material_data/."""
    presets: dict[str, _Preset] = {}
    for name, data in read_tables("contact", "material_data", "materials").items():
        notes, ends = data.pop("source", {}), data.pop("range", {})
        symbols, group = tuple(data.pop("symbols", ())), data.pop("material_class")
        presets[name] = _Preset(data, {field: notes.get(field, "") for field in data}, ends, symbols, group)
    return presets
