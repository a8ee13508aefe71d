"""What a contact is asked, whether it is given by bodies and roughness (Contact) or by its dimensionless groups (Indices)."""

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Input
from stiction.quantities.units import several_in_words


@dataclass(frozen=True)
class Scales:
    """What the dimensionless results of a contact are multiplied by to be in SI units.

    load [N] and contact_area [m^2] per asperity, separation [m], asperities: their number on the nominal
    area, nominal_area [m^2], None where it is not known. The load of the whole contact is its dimensionless value times load
    times asperities.
    """

    load: Any = 1.0
    contact_area: Any = 1.0
    separation: Any = 1.0
    asperities: Any = 1.0
    nominal_area: Any = None

    def factors(self) -> dict[str, Any]:
        """The factor of results of the whole contact for each scale of the table of quantities: an SI unit, or "count"."""
        pressure = {} if self.nominal_area is None else {"Pa": self.load * self.asperities / self.nominal_area}
        return pressure | {
            "N": self.load * self.asperities,
            "m^2": self.contact_area * self.asperities,
            "m": self.separation,
            "count": self.asperities,
            "N/m": self.load * self.asperities / self.separation,
            "J": self.load * self.asperities * self.separation,
        }


class Subject(Input):
    """Two rough surfaces in contact, as far as a model asks. Numbers may be arrays with named dimensions."""

    @abstractmethod
    def indices(self) -> Any:
        """The dimensionless groups, as Indices."""

    @abstractmethod
    def scales(self) -> Scales:
        """What dimensionless results are multiplied by."""

    @property
    @abstractmethod
    def has_film(self) -> bool:
        """Whether there is a film."""

    def require_single(self, allowed: str) -> None:
        """Raise InputError where a number of the contact is several."""
        for name, array in self.arrays():
            raise InputError(name, several_in_words(array, name), allowed)

    def inputs(self) -> list[tuple[str, str]]:
        """Dotted name and value, with its unit, of all that was given."""
        return self.listed()

    def optional_inputs(self) -> dict[str, str]:
        """What was given and may be left out: dotted name -> the group that it decides, "" where no law asks for it."""
        names = (
            "shear_strength", "pressure_coefficient", "peeling", "hardening", "hardness_to_yield", "waiting", "strengthening",
            "strength_variation",
            "meniscus_index", "meniscus_height",
        )  # fmt: skip
        return {name: name for name in names if name in self.model_fields_set and getattr(self, name) is not None}

    def remarks(self) -> list[str]:
        """What is worth knowing of the groups of this contact before anything is solved."""
        return []

    @property
    def heights(self) -> tuple[str, dict[str, Any]]:
        """Name and parameters of the distribution of asperity heights."""
        return "gaussian", {}

    @property
    def surface_kind(self) -> str | None:
        """The kind of surface that is stated, one of finishes.SURFACE_KINDS; else None."""
        return None

    @property
    def measured(self) -> Any:
        """What scans say of the roughness, where it was measured; else None."""
        return None

    @property
    def map(self) -> Any:
        """The map that stands for both faces, where the roughness was measured and makes one; else None."""
        return None

    def as_numbers(self) -> "Subject":
        """The same without the memory of what was measured: with the numbers of the method that stands for the surface."""
        return self

    def with_surface_moments(self) -> "Subject":
        """The same as theories of the whole surface take it: with the asperities that have its spectral moments."""
        return self

    def groups(self) -> dict[str, float]:
        """Name -> value of every dimensionless group that is known, and is one number."""
        return {name: float(value) for name, value in self.all_groups().items() if not hasattr(value, "dims")}

    def all_groups(self) -> dict[str, Any]:
        """Name -> number or labelled array of every dimensionless group that is known."""
        indices = self.indices().resolved()
        names = [name for name in type(indices).model_fields if indices.has_film or name != "n_g"]
        return {name: value for name in names if (value := getattr(indices, name)) is not None}

    def known(self, name: str) -> Any:
        """A property or group of this name, where the contact decides it; else None."""
        value = getattr(self, name, None)
        return value() if callable(value) else value

    def given_as(self, group: str) -> str:
        """The name under which a user gives what decides a group."""
        return group

    @abstractmethod
    def read(self, value: Any, name: str) -> Any:
        """A separation or load as a user writes it: a number or an array, in SI units or normalised.

        Raises InputError.
        """

    @abstractmethod
    def read_point(self, entry: Any, name: str, where: str) -> float:
        """One point of a case file, in which a unit is written wherever there is one; where: its place in the file."""

    @abstractmethod
    def show(self, value: float, name: str, digits: int = 6) -> str:
        """A separation or load as text."""

    @abstractmethod
    def attributes(self, name: str) -> dict[str, str]:
        """Meaning, symbol and unit of a result of this contact."""


def as_subject(given: Any) -> Subject:
    """What was given, if it is one; else InputError."""
    if not isinstance(given, Subject):
        raise InputError("contact", type(given).__name__, "a stiction.Contact or stiction.Indices")
    return given
