"""Define the common interface of Contact (two bodies) and Indices (their dimensionless groups)."""

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Input
from stiction.quantities.shown import values_in_words

if TYPE_CHECKING:
    from stiction.contact.indices import Indices
    from stiction.quantities.arguments import NumberOrArray, QuantityLike, Values
    from stiction.surfaces.heightmap import HeightMap
    from stiction.surfaces.measured import Measured


@dataclass(frozen=True)
class Scales:
    """Store the factors that convert dimensionless results of a contact to SI units; all are 1 for Indices.

    - load [N], contact_area [m^2]: unit of load and of area, for one asperity
    - separation [m]: unit of length
    - asperities: number of asperities on the nominal area
    - nominal_area [m^2]: None if unknown

    The load of the contact is the dimensionless load per asperity times `load` times `asperities`.
    """

    load: Any = 1.0
    contact_area: Any = 1.0
    separation: Any = 1.0
    asperities: Any = 1.0
    nominal_area: Any = None

    def factors(self) -> dict[str, Any]:
        """Return the factors that convert dimensionless results to SI units, by unit; "count" is for numbers of asperities."""
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
    """Represent two rough surfaces in contact, with the inputs of a model: the base class of Contact and Indices.

    Numbers may be xarray arrays with named dimensions.
    """

    @abstractmethod
    def indices(self) -> "Indices":
        """Return the dimensionless groups of this contact."""

    @abstractmethod
    def scales(self) -> Scales:
        """Return the factors that convert dimensionless results of this contact to SI units."""

    @property
    @abstractmethod
    def has_film(self) -> bool:
        """Return whether at least one body has a film."""

    @property
    def impossible(self) -> "NumberOrArray":
        """Return where a dimensionless group is out of its bounds: a mask with the dimensions of the array inputs."""
        return False

    @cached_property
    def prepared(self) -> list[object]:
        """Return the list in which `solving.problem.make_problem` caches the problems made for this contact."""
        return []

    def require_single(self, allowed: str) -> None:
        """Raise InputError if a number of the contact is an array; allowed: allowed values, as text for the error."""
        for name, array in self.arrays():
            raise InputError(name, values_in_words(array, name), allowed)

    def inputs(self) -> list[tuple[str, str]]:
        """Return the dotted name and the value with its unit of every specified input."""
        return self.listed()

    def optional_inputs(self) -> dict[str, str]:
        """Return the dimensionless group that each specified optional input determines, by name of the input.

        The group is "" if no law uses the input.
        """
        names = (
            "shear_strength", "pressure_coefficient", "peeling", "hardening", "hardness_to_yield", "waiting", "ageing_rate",
            "strength_variation", "size_over_burgers",
            "meniscus_index", "meniscus_height",
        )  # fmt: skip
        return {name: name for name in names if name in self.model_fields_set and getattr(self, name) is not None}

    def remarks(self) -> list[str]:
        """Return remarks, as text, on the inputs of this contact; no solution is needed for them."""
        return []

    @property
    def heights(self) -> tuple[str, dict[str, float | list[float]]]:
        """Return name and parameters of the distribution of asperity heights."""
        return "gaussian", {}

    @property
    def surface_kind(self) -> str | None:
        """Return the kind of surface that the user specified, one of finishes.SURFACE_KINDS; None if there is none."""
        return None

    @property
    def surface_shape(self) -> dict[str, float]:
        """Return the values of skewness, kurtosis and texture_aspect_ratio that are specified, by name."""
        rough: Any = self.known("roughness")
        return {} if rough is None else rough.shape

    @property
    def measured(self) -> "Measured | None":
        """Return the roughness measured from scans (surfaces.measured.Measured); None without scans."""
        return None

    @property
    def map(self) -> "HeightMap | None":
        """Return the single height map that represents the roughness of both surfaces; None if there is no such map."""
        return None

    def as_numbers(self) -> "Subject":
        """Return the same contact with sigma, R and N of the selected asperity method in place of its scans."""
        return self

    def with_surface_moments(self) -> "Subject":
        """Return the contact with the sigma, R and N that reproduce the spectral moments of the surface.

        Theories of the whole surface use these values. If the spectral moments are unknown, the contact is returned unchanged.
        """
        return self

    def groups(self) -> dict[str, float]:
        """Return every known dimensionless group that is a single number, by name; arrays are left out."""
        return {name: float(value) for name, value in self.all_groups().items() if not hasattr(value, "dims")}

    def all_groups(self) -> dict[str, "NumberOrArray"]:
        """Return every known dimensionless group by name; a value is a number or an xarray array."""
        indices = self.indices().resolved()
        names = [name for name in type(indices).model_fields if indices.has_film or name != "n_g"]
        return {name: value for name in names if (value := getattr(indices, name)) is not None}

    def known(self, name: str) -> object:
        """Return the property or dimensionless group called `name`; None if it is unknown."""
        value = getattr(self, name, None)
        return value() if callable(value) else value

    def given_as(self, group: str) -> str:
        """Return the name of the user's input that sets a dimensionless group, e.g. hold_time; for Indices the group's name."""
        return group

    @abstractmethod
    def read(self, value: "QuantityLike", name: str) -> "Values":
        """Check loads or separations specified by the user, and return them in the unit of this contact's inputs.

        name: "load" or "mean_separation". A Contact has SI units; Indices have dimensionless values. Raises InputError.
        """

    @abstractmethod
    def read_point(self, entry: object, name: str, where: str) -> float:
        """Return one load or separation from a case file as a number, in the unit of this contact's inputs.

        entry: content of the file. name: "load" or "mean_separation". where: place in the file, for errors.
        """

    @abstractmethod
    def show(self, value: float, name: str, digits: int = 6) -> str:
        """Return a load or separation as text, with its unit if it has one.

        name: "load" or "mean_separation". digits: number of significant digits.
        """

    @abstractmethod
    def attributes(self, name: str) -> dict[str, str]:
        """Return meaning, symbol and unit of the result called `name`, as attributes of an xarray variable."""


def as_subject(given: Any) -> Subject:
    """Return `given` unchanged if it is a Contact or Indices; raise InputError otherwise."""
    if not isinstance(given, Subject):
        raise InputError("contact", type(given).__name__, "a stiction.Contact or stiction.Indices")
    return given
