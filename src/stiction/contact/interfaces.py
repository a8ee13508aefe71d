"""Define interface states, with distributions of the shear strength, and read them from the files in interface_data/."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self, TypedDict

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from stiction.contact.materials import (
    MATERIAL_CLASSES,
    Material,
    class_of,
    material_names,
    refuse_anodised,
    remaining_notes,
)
from stiction.contact.pair import choose, first_is_softer
from stiction.quantities.data_files import read_tables
from stiction.quantities.errors import InputError, InWords, field_named, nearest
from stiction.quantities.inputs import Input, OptionalNumber, as_text, by_default
from stiction.quantities.lognormal import lognormal_quantile
from stiction.quantities.ranges import Ranges, check_ranges, range_in_words
from stiction.quantities.table import QUANTITIES

# Common names of interface states -> name of the state, for the hint of an error.
_SYNONYMS = {
    **dict.fromkeys(("sam", "self-assembled monolayer", "fdts", "ots", "silane"), "monolayer"),
    **dict.fromkeys(("oil", "grease", "greasy", "lubricated", "lubricant"), "boundary lubricant"),
    **dict.fromkeys(("oxide", "oxidized metal", "native oxide", "metal"), "oxidised metal"),
    **dict.fromkeys(("rubber", "silicone", "pdms"), "elastomer"),
    **dict.fromkeys(("graphite", "mos2"), "layered solid"),
}

# Fields that state the strength: as a stress, divided by the hardness, or divided by the shear modulus of the softer body.
STRENGTHS = ("interfacial_shear_strength", "shear_strength", "strength_over_shear_modulus")


class Interface(Input):
    """Describe the state of an interface, such as "oxidised metal", by distributions of its shear strength.

    The shear strength is tau_0 + alpha p at the pressure p; tau_0 and alpha are lognormally distributed.
    interfacial_shear_strength, shear_strength, strength_over_shear_modulus: median of tau_0 in Pa, relative to the hardness, or
    relative to the shear modulus of the softer touching body or film; exactly one is specified. pressure_coefficient: median of
    alpha; None if the strength does not depend on pressure. pressure_limit: mean pressure of contact spots [Pa] above which the
    interface fails; None if unknown. range: 5 and 95 % quantiles of a number, by name; a number without a range is exact.
    source, grade: source and grade (a key of data_files.GRADES) of each number, by name. pairs: prior weight of the state for a
    pair of material classes, such as "metal, ceramic" or "polymer, any"; with weight 0 only the user can choose it. only_with:
    names of materials, at least one of which must be a body; empty if any bodies are allowed. A user may also select the state
    for a body that is not a preset, because it may consist of one of these materials. of_film: whether pairs of weight
    0 require a film. not_for: text on the contacts for which this state must not be used.

    These values are not capped at the strength of the bodies. Raises InputError for contradictory numbers.
    """

    name: str = Field(default="unnamed", description="its name")
    interfacial_shear_strength: OptionalNumber = by_default(None)
    shear_strength: OptionalNumber = by_default(None)
    strength_over_shear_modulus: OptionalNumber = by_default(None)
    pressure_coefficient: OptionalNumber = by_default(None)
    pressure_limit: OptionalNumber = by_default(None)
    range: Ranges = Field(default_factory=dict, description="5 and 95 % quantiles of its numbers")
    source: dict[str, str] = Field(default_factory=dict, description="where each number comes from")
    grade: dict[str, Literal["A", "B", "C"]] = Field(default_factory=dict, description="A, B or C for each number")
    pairs: dict[str, float] = Field(default_factory=dict, description="prior weight for each pair of material classes")
    only_with: tuple[str, ...] = ()
    of_film: bool = False
    not_for: str = ""

    @model_validator(mode="after")
    def _one_strength_within_its_range(self):
        given = [name for name in STRENGTHS if getattr(self, name) is not None]
        if len(given) != 1:
            raise InputError("interface", ", ".join(given) or None, f"one of {', '.join(STRENGTHS)}")
        check_ranges(self)
        for name, (low, _) in self.range.items():
            if low <= 0.0:
                raise InputError(f"range.{name}", low, "two numbers above 0, because the distribution is lognormal")
        return self

    @property
    def strength(self) -> str:
        """Return the name of the specified strength, such as "interfacial_shear_strength", one of STRENGTHS."""
        return next(name for name in STRENGTHS if getattr(self, name) is not None)

    def strength_at(self, level: Any, hardness: Any = None, shear_modulus: Any = None, median: Any = None) -> Any:
        """Return the shear strength tau_0 [Pa] of this interface state at quantile levels; arrays broadcast.

        hardness, shear_modulus: properties of the softer body [Pa]; needed only if the strength is relative to one of them.
        median: numbers that replace the specified strength; its 5 and 95 % quantiles are unchanged. Raises InputError for a
        level that is not above 0 and below 1, and if a needed hardness or shear modulus is missing.
        """
        scale: Any = 1.0
        if self.strength != "interfacial_shear_strength":
            name = "hardness" if self.strength == "shear_strength" else "shear_modulus"
            scale = hardness if name == "hardness" else shear_modulus
            if scale is None:
                raise InputError(
                    name, None, f"the {name} of the softer body, because the strength of {self.name} is relative to it"
                )
        return scale * self._quantile(self.strength, level, median)

    def pressure_coefficient_at(self, level: Any, median: Any = None) -> np.ndarray:
        """Return the pressure coefficient alpha of this interface state at quantile levels; 0 if it has none.

        median: numbers that replace the specified coefficient. Raises InputError, if there is a coefficient, for a level that
        is not above 0 and below 1.
        """
        return self._quantile("pressure_coefficient", level, median)

    def at(self, level: Any, first: Material, second: Material) -> tuple[Any, Any]:
        """Return shear strength [Pa] and pressure coefficient of this state between two bodies at quantile levels.

        first, second: the two touching materials. The pressure coefficient is None if the state has none. Raises InputError for
        a level that is not above 0 and below 1.
        """
        softer = first_is_softer(first, second)
        hardness = choose(softer, first.hardness, second.hardness)
        modulus = choose(softer, first.shear_modulus, second.shear_modulus)
        slope = None if self.pressure_coefficient is None else self.pressure_coefficient_at(level)
        return self.strength_at(level, hardness, modulus), slope

    def allows(self, first: Material, second: Material, *, coated: bool = True) -> bool:
        """Return whether a user may select this interface state for two bodies.

        A state with `pairs` is allowed if it has a prior weight for these two materials. If this weight is 0 and the state has
        `of_film`, a film is required too. A state without `pairs`, such as one defined by a user, is allowed for any bodies.
        coated: whether one of the two materials is a film.
        """
        own = any(body.name not in material_names() for body in (first, second))
        weight = self.weight_of(first, second, self.only_with if not own else ())
        return not self.pairs or (weight is not None and (weight > 0.0 or coated or not self.of_film))

    def notes(self) -> list[str]:
        """Return texts with the source and grade of each number, and on contacts for which this state must not be used.

        The grade is C where none is stated.
        """
        texts = [f"{name}: {text} (grade {self.grade.get(name, 'C')})" for name, text in self.source.items()]
        return [*texts, *([f"not for: {self.not_for}"] if self.not_for else [])]

    def replace(self, **changes: object) -> Self:
        """Return a copy of the state with the fields in `changes` replaced.

        A replaced number loses its source, grade and range. Raises InputError for a bad field.
        """
        kept = {field: grade for field, grade in self.grade.items() if field not in changes}
        return super().replace(**{"grade": kept} | changes | remaining_notes(self.source, self.range, changes))

    def listed(self) -> list[tuple[str, str]]:
        """Return pairs (field, text) for the name and each number of this state, with its central 90 % range if it has one."""
        rows = [("name", self.name)]
        for name in (self.strength, "pressure_coefficient"):
            if getattr(self, name) is not None:
                ends = f", 90 % within {range_in_words(*self.range[name], name)}" if name in self.range else ""
                rows.append((name, as_text(getattr(self, name), name) + ends))
        if self.pressure_limit is not None:
            rows.append(("pressure_limit", as_text(self.pressure_limit, "pressure_limit")))
        return rows

    def _quantile(self, name: str, level: Any, median: Any = None) -> Any:
        median = getattr(self, name) if median is None else median
        if median is None:
            return np.zeros(np.shape(level))
        if name not in self.range:
            return median * lognormal_quantile(level, 1.0, 1.0, 1.0)
        return lognormal_quantile(level, median, *self.range[name])

    def weight_of(self, first: Material, second: Material, only_with: Sequence[str]) -> float | None:
        """Return the prior weight of this state for two bodies, from their material classes; None if it does not suit them.

        only_with: names of materials, at least one of which must be a body; empty if any bodies are allowed.
        """
        if only_with and not {first.name, second.name} & set(only_with):
            return None
        ruling, other = sorted((class_of(first), class_of(second)), key=MATERIAL_CLASSES.index)
        return self.pairs.get(f"{ruling}, {other}", self.pairs.get(f"{ruling}, any"))


def interface_names() -> list[str]:
    """Return the names of the interface states of the package, in alphabetical order."""
    return sorted(_states())


def interface(name: str, /) -> Interface:
    """Return the interface state of this name, such as "oxidised metal".

    Raises InputError, which suggests similar names, for an unknown name.
    """
    if not isinstance(name, str) or name not in _states():
        refuse_anodised(str(name), "interface")
        known = _SYNONYMS.get(name.lower(), "") if isinstance(name, str) else ""
        hint = f"{known!r}" if known else nearest(name, interface_names())
        raise InputError("interface", name, f"a name that `stiction interfaces` lists, e.g. {hint}")
    return _states()[name]


def allowed_interfaces(first: Material, second: Material, *, coated: bool) -> list[str]:
    """Return the names of the interface states that a user may select for two bodies, in alphabetical order.

    coated: whether one of the bodies is a film.
    """
    return [name for name in interface_names() if interface(name).allows(first, second, coated=coated)]


def check_interface(contact: Input, state: Interface, first: Material, second: Material) -> None:
    """Raise InputError if the interface state of a contact contradicts its other inputs or does not suit its bodies.

    A state must not be combined with an interfacial shear strength or pressure coefficient. first, second: materials of the two
    touching surfaces.
    """
    stated = ("interfacial_shear_strength", "pressure_coefficient")
    for name in (name for name in stated if getattr(contact, name) is not None):
        raise InputError("interface", InWords(f"{state.name!r} and {name} are both given"), "one of the two")
    coated = contact.part("coating") is not None
    if not state.allows(first, second, coated=coated):
        bodies = f"{first.name} on {second.name}" + ("" if coated else " without a film")
        allowed = f"{', '.join(allowed_interfaces(first, second, coated=coated))} (the interfaces of {bodies})"
        unclassed = [body for body in (first, second) if body.material_class is None]
        guessed = dict.fromkeys(f"{body.name} is taken as {class_of(body)}" for body in unclassed)
        hint = f"{', '.join(guessed)}: if that is wrong, state material_class" if guessed else ""
        raise InputError("interface", state.name, allowed, hint)


def interface_weights(first: Material, second: Material) -> dict[str, float]:
    """Return the prior weight of each interface state that is possible between two bodies, by name; the weights sum to 1.

    States of weight 0 are left out. The weights apply if the user specifies no interface. They depend on the classes of the two
    materials. first, second: materials of the touching surfaces; for a coated body, the material of its film.
    """
    prior = {name: state.weight_of(first, second, state.only_with) for name, state in _states().items()}
    weights = {name: weight for name, weight in prior.items() if weight}
    total = sum(weights.values())
    return {name: weight / total for name, weight in weights.items()}


class InterfaceNumber(TypedDict):
    """Describe one number of an interface state: quantity, median, unit, 5 and 95 % quantiles, source and grade."""

    quantity: str
    value: float
    unit: str
    range: list[float]
    range_in_words: str
    source: str
    grade: str


class InterfaceLimit(TypedDict):
    """Describe the largest pressure of contact spots that an interface state can bear: value, unit, source and grade."""

    value: float
    unit: str
    source: str
    grade: str


class InterfaceRow(TypedDict):
    """Describe one interface state, as `interfaces` returns it; pressure_coefficient and pressure_limit may be None."""

    name: str
    strength: InterfaceNumber
    pressure_coefficient: InterfaceNumber | None
    pressure_limit: InterfaceLimit | None
    pairs: dict[str, float]
    only_with: list[str]
    of_film: bool
    not_for: str


def interfaces(names: Iterable[str] | None = None) -> list[InterfaceRow]:
    """Return the interface states of the package with their numbers, one dict for each.

    Parameters
    ----------
    names : sequence of str, optional
        Names of states; by default all.

    Returns
    -------
    list of dict
        Fields name, strength, pressure_coefficient, pressure_limit, pairs, only_with, of_film and not_for. The strength and the
        pressure coefficient are dicts of quantity, value (median), unit, range (5 and 95 % quantiles), range_in_words, source
        and grade. The pressure limit is a dict of value, unit, source and grade. Coefficient and limit may be None.

    Raises
    ------
    InputError
        A name is unknown.

    Examples
    --------
    >>> import stiction as st
    >>> state, = st.interfaces(["oxidised metal"])
    >>> state["name"]
    'oxidised metal'
    """
    try:
        wanted = interface_names() if names is None else list(names)
    except TypeError:
        raise InputError("names", names, "a list of names of states, or None for all") from None
    return [_row(interface(name)) for name in wanted]


def _row(state: Interface) -> InterfaceRow:
    return {
        "name": state.name,
        "strength": _number(state, state.strength),
        "pressure_coefficient": (None if state.pressure_coefficient is None else _number(state, "pressure_coefficient")),
        "pressure_limit": None if state.pressure_limit is None else _limit(state, "pressure_limit"),
        "pairs": dict(state.pairs),
        "only_with": list(state.only_with),
        "of_film": state.of_film,
        "not_for": state.not_for,
    }


def _number(state: Interface, name: str) -> InterfaceNumber:
    ends = state.range[name]
    return {
        "quantity": name,
        "value": getattr(state, name),
        "unit": QUANTITIES[name].unit or "1",
        "range": list(ends),
        "range_in_words": range_in_words(*ends, name),
        "source": state.source[name],
        "grade": state.grade[name],
    }


def _limit(state: Interface, name: str) -> InterfaceLimit:
    return {
        "value": float(getattr(state, name)),
        "unit": QUANTITIES[name].unit or "1",
        "source": state.source[name],
        "grade": state.grade[name],
    }


@cache
def _states() -> dict[str, Interface]:
    return {
        name: Interface(name=name, **table) for name, table in read_tables("contact", "interface_data", "interfaces").items()
    }


def _as_interface(value: Any) -> Any:
    """Return the interface state of this name; return an Interface, dict or None unchanged. Raises InputError otherwise."""
    if isinstance(value, Interface | dict | None):
        return value
    with field_named(""):
        return interface(value)


# Type of a field with an interface state: its name, a table of its numbers, or an Interface.
if TYPE_CHECKING:
    from stiction.quantities.keywords import Converted

    OptionalState = Converted[Interface | None, Interface | str | Mapping[str, object] | None]
else:
    OptionalState = Annotated[Interface, BeforeValidator(_as_interface, json_schema_input_type=str | Interface)] | None
