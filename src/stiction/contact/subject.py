"""Common interface of Contact (two bodies) and Indices (their dimensionless groups)."""

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Input
from stiction.quantities.units import values_in_words

if TYPE_CHECKING:
    from stiction.contact.indices import Indices
    from stiction.quantities.arguments import NumberOrArray, QuantityLike, Values
    from stiction.surfaces.heightmap import HeightMap
    from stiction.surfaces.measured import Measured


@dataclass(frozen=True)
class Scales:
    """Hold the factors that convert dimensionless results of a contact to SI units.

    load [N], contact_area [m^2]: per asperity. separation [m]. asperities: number of asperities on the nominal area.
    nominal_area [m^2]: None if unknown. The load of the whole contact is the dimensionless load times `load` times
    `asperities`.
    """

    load: Any = 1.0
    contact_area: Any = 1.0
    separation: Any = 1.0
    asperities: Any = 1.0
    nominal_area: Any = None

    def factors(self) -> dict[str, Any]:
        """Return the factor that converts dimensionless results to each SI unit, or to "count", by unit."""
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
    """Represent two rough surfaces in contact, with the inputs of a model.

    Numbers may be arrays with named dimensions.
    """

    @abstractmethod
    def indices(self) -> "Indices":
        """Return the dimensionless groups."""

    @abstractmethod
    def scales(self) -> Scales:
        """Return the scales of dimensionless results."""

    @property
    @abstractmethod
    def has_film(self) -> bool:
        """Return whether the contact has a film."""

    @cached_property
    def prepared(self) -> list[object]:
        """Return the problems that `solving.problem.make_problem` keeps for this contact, each with its request."""
        return []

    def require_single(self, allowed: str) -> None:
        """Raise InputError if a number of the contact is an array.

        allowed: the text of what is allowed, for the error.
        """
        for name, array in self.arrays():
            raise InputError(name, values_in_words(array, name), allowed)

    def inputs(self) -> list[tuple[str, str]]:
        """Return the dotted name and the value with its unit of every stated input."""
        return self.listed()

    def optional_inputs(self) -> dict[str, str]:
        """Return the stated optional inputs: for each dotted name, the group that the input determines.

        The group is "" if no law needs the input.
        """
        names = (
            "shear_strength", "pressure_coefficient", "peeling", "hardening", "hardness_to_yield", "waiting", "ageing_rate",
            "strength_variation", "size_over_burgers",
            "meniscus_index", "meniscus_height",
        )  # fmt: skip
        return {name: name for name in names if name in self.model_fields_set and getattr(self, name) is not None}

    def remarks(self) -> list[str]:
        """Return remarks on the dimensionless groups of this contact, which need no solution."""
        return []

    @property
    def heights(self) -> tuple[str, dict[str, float | list[float]]]:
        """Return name and parameters of the distribution of asperity heights."""
        return "gaussian", {}

    @property
    def surface_kind(self) -> str | None:
        """Return the stated kind of surface, one of finishes.SURFACE_KINDS; else None."""
        return None

    @property
    def surface_shape(self) -> dict[str, float]:
        """Return the stated statistics of the surface, by their names in surfaces.roughness.SHAPE."""
        rough: Any = self.known("roughness")
        return {} if rough is None else rough.shape

    @property
    def measured(self) -> "Measured | None":
        """Return the measured roughness if it comes from scans; else None."""
        return None

    @property
    def map(self) -> "HeightMap | None":
        """Return the height map that represents both surfaces, if the scans give one; else None."""
        return None

    def as_numbers(self) -> "Subject":
        """Return the same contact with the roughness numbers of the selected method, without its scans."""
        return self

    def with_surface_moments(self) -> "Subject":
        """Return the contact with asperity numbers that reproduce the spectral moments of the surface.

        Theories of the whole surface take these numbers.
        """
        return self

    def groups(self) -> dict[str, float]:
        """Return every known dimensionless group with a single value, by name."""
        return {name: float(value) for name, value in self.all_groups().items() if not hasattr(value, "dims")}

    def all_groups(self) -> dict[str, "NumberOrArray"]:
        """Return every known dimensionless group, a number or labelled array, by name."""
        indices = self.indices().resolved()
        names = [name for name in type(indices).model_fields if indices.has_film or name != "n_g"]
        return {name: value for name in names if (value := getattr(indices, name)) is not None}

    def known(self, name: str) -> object:
        """Return the property or dimensionless group `name` of the contact; None if unknown."""
        value = getattr(self, name, None)
        return value() if callable(value) else value

    def given_as(self, group: str) -> str:
        """Return the name of the input by which a user states a group."""
        return group

    @abstractmethod
    def read(self, value: "QuantityLike", name: str) -> "Values":
        """Convert a separation or load stated by a user, a number or an array, to SI units or normalised values.

        Raises InputError.
        """

    @abstractmethod
    def read_point(self, entry: object, name: str, where: str) -> float:
        """Return one point of a case file, in which every number has its unit.

        where: its place in the file, for errors.
        """

    @abstractmethod
    def show(self, value: float, name: str, digits: int = 6) -> str:
        """Format a separation or load as text."""

    @abstractmethod
    def attributes(self, name: str) -> dict[str, str]:
        """Return meaning, symbol and unit of a result of this contact."""


def as_subject(given: Any) -> Subject:
    """Return a Contact or Indices unchanged; raise InputError for anything else."""
    if not isinstance(given, Subject):
        raise InputError("contact", type(given).__name__, "a stiction.Contact or stiction.Indices")
    return given
