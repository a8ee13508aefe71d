"""The interface of a subject: a contact of bodies (Contact), or its dimensionless groups (Indices)."""

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Input
from stiction.quantities.units import several_in_words


@dataclass(frozen=True)
class Scales:
    """Factors that turn dimensionless results of a contact into SI units.

    load [N] and contact_area [m^2] per asperity, separation [m], asperities: their number on the nominal area, nominal_area
    [m^2], None where it is not known. The load of the whole contact is its dimensionless value times load times asperities.
    """

    load: Any = 1.0
    contact_area: Any = 1.0
    separation: Any = 1.0
    asperities: Any = 1.0
    nominal_area: Any = None

    def factors(self) -> dict[str, Any]:
        """Return the factor of results for each scale of the table of quantities.

        A scale is an SI unit, or "count".
        """
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
    """Two rough surfaces in contact, with all that a model needs.

    Numbers may be arrays with named dimensions.
    """

    @abstractmethod
    def indices(self) -> Any:
        """Return the dimensionless groups, as Indices."""

    @abstractmethod
    def scales(self) -> Scales:
        """Return the scales of dimensionless results."""

    @property
    @abstractmethod
    def has_film(self) -> bool:
        """Return whether there is a film."""

    def require_single(self, allowed: str) -> None:
        """Raise InputError where a number of the contact is an array."""
        for name, array in self.arrays():
            raise InputError(name, several_in_words(array, name), allowed)

    def inputs(self) -> list[tuple[str, str]]:
        """Return dotted name and value, with its unit, of all given inputs."""
        return self.listed()

    def optional_inputs(self) -> dict[str, str]:
        """Return the given optional inputs: dotted name -> group that it decides.

        The group is "" where no law needs the input.
        """
        names = (
            "shear_strength", "pressure_coefficient", "peeling", "hardening", "hardness_to_yield", "waiting", "ageing_rate",
            "strength_variation",
            "meniscus_index", "meniscus_height",
        )  # fmt: skip
        return {name: name for name in names if name in self.model_fields_set and getattr(self, name) is not None}

    def remarks(self) -> list[str]:
        """Return remarks on the groups of this contact, known before a solution."""
        return []

    @property
    def heights(self) -> tuple[str, dict[str, Any]]:
        """Return name and parameters of the distribution of asperity heights."""
        return "gaussian", {}

    @property
    def surface_kind(self) -> str | None:
        """Return the stated kind of surface, one of finishes.SURFACE_KINDS; else None."""
        return None

    @property
    def measured(self) -> Any:
        """Return the measured roughness where it comes from scans; else None."""
        return None

    @property
    def map(self) -> Any:
        """Return the map that stands for both faces, where scans give one; else None."""
        return None

    def as_numbers(self) -> "Subject":
        """Return the same contact with the roughness numbers of the chosen method.

        The scans are dropped.
        """
        return self

    def with_surface_moments(self) -> "Subject":
        """Return the contact with asperities that have the surface's spectral moments.

        Theories of the whole surface take these.
        """
        return self

    def groups(self) -> dict[str, float]:
        """Return name -> value of every known dimensionless group that is one number."""
        return {name: float(value) for name, value in self.all_groups().items() if not hasattr(value, "dims")}

    def all_groups(self) -> dict[str, Any]:
        """Return name -> number or labelled array of every known dimensionless group."""
        indices = self.indices().resolved()
        names = [name for name in type(indices).model_fields if indices.has_film or name != "n_g"]
        return {name: value for name in names if (value := getattr(indices, name)) is not None}

    def known(self, name: str) -> Any:
        """Return a property or group of this name, None where it is not known."""
        value = getattr(self, name, None)
        return value() if callable(value) else value

    def given_as(self, group: str) -> str:
        """Return the name under which a user gives the input of a group."""
        return group

    @abstractmethod
    def read(self, value: Any, name: str) -> Any:
        """Read a separation or load as a user writes it, in SI units or normalised.

        A number or an array. Raises InputError.
        """

    @abstractmethod
    def read_point(self, entry: Any, name: str, where: str) -> float:
        """Read one point of a case file, in which every number has its unit.

        where: its place in the file.
        """

    @abstractmethod
    def show(self, value: float, name: str, digits: int = 6) -> str:
        """Format a separation or load as text."""

    @abstractmethod
    def attributes(self, name: str) -> dict[str, str]:
        """Return meaning, symbol and unit of a result of this contact."""


def as_subject(given: Any) -> Subject:
    """Return the subject unchanged; raise InputError for anything else."""
    if not isinstance(given, Subject):
        raise InputError("contact", type(given).__name__, "a stiction.Contact or stiction.Indices")
    return given
