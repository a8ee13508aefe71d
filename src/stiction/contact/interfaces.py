"""States of an interface with distributions of shear strength, read from interface_data/ (one file per family)."""

from collections.abc import Iterable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self, TypedDict

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from stiction.contact.materials import MATERIAL_CLASSES, Material, class_of, notes_left
from stiction.contact.pair import choose, first_is_softer
from stiction.quantities.data_files import read_tables
from stiction.quantities.errors import InputError, field_named, nearest
from stiction.quantities.inputs import Input, OptionalNumber, as_text, by_default
from stiction.quantities.lognormal import lognormal_quantile
from stiction.quantities.ranges import Ranges, check_ranges, range_in_words
from stiction.quantities.table import QUANTITIES

# How the strength of a state may be given: as a stress, over the hardness, or over the shear modulus of the softer body.
STRENGTHS = ("interfacial_shear_strength", "shear_strength", "strength_over_shear_modulus")


class Interface(Input):
    """Hold the state of an interface: distributions of tau_0 and alpha in the shear strength tau_0 + alpha p.

    p is the pressure. Exactly one of the three strengths is stated, as its median. A strength over hardness or shear
    modulus is relative to the softer body, or to the film if it touches the other body. pressure_coefficient: median of
    alpha; if absent, the strength does not depend on pressure. range: 5 and 95 % quantiles; a number without a range is
    exact. source, grade: of each number, see data_files.GRADES. pairs: prior weight for each pair of material classes,
    "metal, ceramic" or "polymer, any"; 0: used only if the user states it. only_with: materials; at least one is
    required. of_film: whether pairs of weight 0 need a film. not_for: where the state must not be used.

    The strength of the bodies does not cap these values. Raises InputError.
    """

    name: str = Field(default="unnamed", description="what to call it")
    interfacial_shear_strength: OptionalNumber = by_default(None)
    shear_strength: OptionalNumber = by_default(None)
    strength_over_shear_modulus: OptionalNumber = by_default(None)
    pressure_coefficient: OptionalNumber = by_default(None)
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
        """Return the name of the stated strength, one of STRENGTHS."""
        return next(name for name in STRENGTHS if getattr(self, name) is not None)

    def strength_at(self, level: Any, hardness: Any = None, shear_modulus: Any = None, median: Any = None) -> Any:
        """Return tau_0 [Pa] at quantile levels between 0 and 1; arrays broadcast.

        hardness, shear_modulus: of the softer body [Pa]; only the reference of a relative strength is used. median: values
        that replace the stated number, which must then have no range. Raises InputError for a level that is not between 0
        and 1, and if the reference is missing.
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
        """Return alpha at quantile levels between 0 and 1; 0 if the state has no pressure coefficient.

        median: as of `strength_at`. Raises InputError.
        """
        return self._quantile("pressure_coefficient", level, median)

    def at(self, level: Any, first: Material, second: Material) -> tuple[Any, Any]:
        """Return shear strength [Pa] and pressure coefficient between two bodies at quantile levels.

        The pressure coefficient is None if the state has none. Raises InputError for a level that is not between 0 and 1.
        """
        softer = first_is_softer(first, second)
        hardness = choose(softer, first.hardness, second.hardness)
        modulus = choose(softer, first.shear_modulus, second.shear_modulus)
        slope = None if self.pressure_coefficient is None else self.pressure_coefficient_at(level)
        return self.strength_at(level, hardness, modulus), slope

    def allows(self, first: Material, second: Material, *, coated: bool = True) -> bool:
        """Return whether a user may select the state for two bodies; coated: whether one of them is a film.

        A state without pairs, such as one defined by a user, is allowed for any bodies.
        """
        weight = self.weight_of(first, second)
        return not self.pairs or (weight is not None and (weight > 0.0 or coated or not self.of_film))

    def notes(self) -> list[str]:
        """Return texts on the sources of the numbers, and on uses that must be avoided."""
        texts = [f"{name}: {text} (grade {self.grade.get(name, 'C')})" for name, text in self.source.items()]
        return [*texts, *([f"not for: {self.not_for}"] if self.not_for else [])]

    def replace(self, **changes: object) -> Self:
        """Return a copy of the state with these fields changed.

        A changed number loses its source, grade and range. Raises InputError.
        """
        kept = {field: grade for field, grade in self.grade.items() if field not in changes}
        return super().replace(**{"grade": kept} | changes | notes_left(self.source, self.range, changes))

    def listed(self) -> list[tuple[str, str]]:
        """Return name and numbers, each with its 90 % range, as text."""
        rows = [("name", self.name)]
        for name in (self.strength, "pressure_coefficient"):
            if getattr(self, name) is not None:
                ends = f", 90 % within {range_in_words(*self.range[name], name)}" if name in self.range else ""
                rows.append((name, as_text(getattr(self, name), name) + ends))
        return rows

    def _quantile(self, name: str, level: Any, median: Any = None) -> Any:
        median = getattr(self, name) if median is None else median
        if median is None:
            return np.zeros(np.shape(level))
        if name not in self.range:
            return median * lognormal_quantile(level, 1.0, 1.0, 1.0)
        return lognormal_quantile(level, median, *self.range[name])

    def weight_of(self, first: Material, second: Material) -> float | None:
        """Return the prior weight of this state for two bodies; None if the bodies do not allow the state."""
        if self.only_with and not {first.name, second.name} & set(self.only_with):
            return None
        ruling, other = sorted((class_of(first), class_of(second)), key=MATERIAL_CLASSES.index)
        return self.pairs.get(f"{ruling}, {other}", self.pairs.get(f"{ruling}, any"))


def interface_names() -> list[str]:
    """Return the names of the states, in alphabetical order."""
    return sorted(_states())


def interface(name: str, /) -> Interface:
    """Return the state of this name. Raises InputError for an unknown name, with similar names."""
    if not isinstance(name, str) or name not in _states():
        raise InputError("interface", name, "a state of an interface: " + nearest(name, interface_names()))
    return _states()[name]


def allowed_interfaces(first: Material, second: Material, *, coated: bool) -> list[str]:
    """Return the names of the states that are allowed for two bodies, in alphabetical order.

    coated: whether one of the bodies is a film.
    """
    return [name for name in interface_names() if interface(name).allows(first, second, coated=coated)]


def check_interface(contact: Input, state: Interface, first: Material, second: Material) -> None:
    """Raise InputError if both a state and strength numbers are stated, or if the bodies do not allow the state."""
    stated = ("interfacial_shear_strength", "pressure_coefficient")
    for name in (name for name in stated if getattr(contact, name) is not None):
        allowed = f"either interface or {name}; leave out one of them"
        raise InputError("interface", state.name, allowed)
    coated = contact.part("coating") is not None
    if not state.allows(first, second, coated=coated):
        bodies = f"{first.name} and {second.name}" + ("" if coated else " without a film")
        allowed = f"{', '.join(allowed_interfaces(first, second, coated=coated))} (the states that suit {bodies})"
        raise InputError("interface", state.name, allowed)


def interface_weights(first: Material, second: Material) -> dict[str, float]:
    """Return the prior weight of each state that two bodies allow if the user states none; the weights sum to 1.

    A coated body counts with the material of its film. The class of the weaker body, in the order of MATERIAL_CLASSES,
    decides.
    """
    prior = {name: state.weight_of(first, second) for name, state in _states().items()}
    weights = {name: weight for name, weight in prior.items() if weight}
    total = sum(weights.values())
    return {name: weight / total for name, weight in weights.items()}


class InterfaceNumber(TypedDict):
    """Describe one number of an interface state: median, unit, 5 and 95 % quantiles, source and grade."""

    quantity: str
    value: float
    unit: str
    range: list[float]
    range_in_words: str
    source: str
    grade: str


class InterfaceRow(TypedDict):
    """Describe one interface state, as `interfaces` returns it; the fields are those of `Interface`."""

    name: str
    strength: InterfaceNumber
    pressure_coefficient: InterfaceNumber | None
    pairs: dict[str, float]
    only_with: list[str]
    of_film: bool
    not_for: str


def interfaces(names: Iterable[str] | None = None) -> list[InterfaceRow]:
    """Return the states of interfaces with their numbers, one dict for each.

    Parameters
    ----------
    names : sequence of str, optional
        Names of states; by default all.

    Returns
    -------
    list of dict
        Name, strength and pressure_coefficient (value, unit, 5 and 95 % quantiles, source and grade of each), pairs, only_with,
        of_film and not_for.

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


@cache
def _states() -> dict[str, Interface]:
    return {
        name: Interface(name=name, **table) for name, table in read_tables("contact", "interface_data", "interfaces").items()
    }


def _as_interface(value: Any) -> Any:
    """Return the state of this name; other values are returned unchanged, to be validated."""
    if isinstance(value, Interface | dict | None):
        return value
    with field_named(""):
        return interface(value)


# A field that holds a state: its name, a table of its numbers, or an Interface.
if TYPE_CHECKING:
    from stiction.quantities.keywords import Converted

    OptionalState = Converted[Interface | None, Interface | str | Mapping[str, object] | None]
else:
    OptionalState = Annotated[Interface, BeforeValidator(_as_interface, json_schema_input_type=str | Interface)] | None
