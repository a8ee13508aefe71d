"""Define the class Contact, which computes the dimensionless groups of two rough bodies (docs/explanation/theory.md)."""

from functools import cached_property, reduce
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field, model_validator

from stiction.contact.coating import Body, Coating, softer_in_words
from stiction.contact.indices import Indices
from stiction.contact.interfaces import OptionalState, check_interface
from stiction.contact.liquid import Liquid
from stiction.contact.materials import Material
from stiction.contact.optional_inputs import optional_inputs
from stiction.contact.pair import Pair, choose, compliance_of, more_compliant
from stiction.contact.size_effect import at_radius, size_notes, size_ratio
from stiction.contact.subject import Scales, Subject
from stiction.quantities.dimensions import coordinates, labelled
from stiction.quantities.errors import InputError, InWords, explained, field_named
from stiction.quantities.inputs import Number, OptionalNumber, by_default, plain_number
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si
from stiction.surfaces.rough_input import Rough

if TYPE_CHECKING:
    from stiction.quantities.arguments import ArrayLike, NumberOrArray, QuantityLike, Values
    from stiction.surfaces.heightmap import HeightMap
    from stiction.surfaces.measured import Measured

# Equilibrium distance [m] of two surfaces for the Tabor parameter: a customary round value for an atomic spacing; no source.
EQUILIBRIUM_DISTANCE = 0.3e-9
_STATE: Any = Field(None, description="the name of a state, see `stiction interfaces`, or a table of its numbers")


class Contact(Subject):
    """Describe two rough bodies in contact, with or without a film between them.

    Parameters
    ----------
    first, second : Material, str or dict
        Material, name of a preset, or a dict. Their order matters for inputs that refer to one body, and in `st.slide`.
    roughness : Roughness, dict, HeightMap, topography or (array, size)
        sigma, R and N of the asperities; or a scan of the first body (the second is then smooth); or a dict like the table of
        a case file, with scans or numbers as `first` and `second`, and the method that finds asperities.
    nominal_area : float [m^2], str with a unit, or array
        Nominal contact area.
    work_of_adhesion : float [J/m^2], str with a unit, or array, optional
        Work of adhesion of the two surfaces, see `st.work_of_adhesion`; by default, or at zero, there is no adhesion.
    coating : Coating or dict, optional
        Film on one body or on both.
    hardness_to_yield : float or array, optional
        H/Y; by default hardness / yield_stress of the softer body, or 2.8 if that body has no yield_stress.
    interfacial_shear_strength, pressure_coefficient : float [Pa] and float, str with a unit, or array, optional
        tau_0 and alpha in the shear strength tau_0 + alpha p of the interface at the pressure p, on the real contact area.
    interface : str, dict or Interface, optional
        State of the interface in place of these two numbers; `stiction interfaces` lists the states. Results use its medians.
    peeling, strength_variation, burgers_vector : float, the last [m] or str with a unit, optional
        Fraction of the energy released by shear that peels an adhesive asperity off, by default 1; coefficient of variation of
        the junction strength; Burgers vector, which only the law `hurtado_kim_1999` uses.
    weakening_slip, residual_strength : float [m] and float, str with a unit, or array, optional
        Slip over which the strength of the interface falls, and fraction of it that remains. A slip requires the fraction.
    liquid, hold_time, reference_time, ageing_rate : optional
        Liquid that condenses between asperities. The other three describe ageing of the interface at rest: all or none.

    Raises
    ------
    InputError
        A number is out of its bounds, or two inputs contradict each other.

    Notes
    -----
    Every number may be an array with a named dimension (`stiction.axis`). The softer body determines the strength of the
    contact. If both are equally hard, the body with the lower yield stress determines it, then the lower Poisson's ratio, then
    the lower E_t/E (tangent modulus over Young's modulus).

    Examples
    --------
    >>> import stiction as st
    >>> rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1e9 /m^2")
    >>> contact = st.Contact(first="silver", second="gold", roughness=rough, nominal_area="1 mm^2")
    >>> round(float(contact.plasticity_index), 1)
    7.5
    """

    first: Body = Field(description="a material: the name of a preset, or its numbers")
    second: Body = Field(description="a material: the name of a preset, or its numbers")
    roughness: Rough = Field(description="a table with sigma, R and N of the asperities")
    work_of_adhesion: OptionalNumber = by_default(None)
    nominal_area: Number
    coating: Coating | None = None
    hardness_to_yield: OptionalNumber = by_default(None)
    interfacial_shear_strength: OptionalNumber = by_default(None)
    pressure_coefficient: OptionalNumber = by_default(None)
    interface: OptionalState = _STATE
    burgers_vector: OptionalNumber = by_default(None)
    peeling: OptionalNumber = by_default(None)
    liquid: Liquid | None = None
    strength_variation: OptionalNumber = by_default(None)
    weakening_slip: OptionalNumber = by_default(None)
    residual_strength: OptionalNumber = by_default(None)
    hold_time: OptionalNumber = by_default(None)
    reference_time: OptionalNumber = by_default(None)
    ageing_rate: OptionalNumber = by_default(None)

    @model_validator(mode="after")
    def _dimensions_agree(self):
        self.check_dimensions()
        self._check_adhesion()
        if self.interface is not None:
            check_interface(self, self.interface, *self.touching)
        ageing = ("hold_time", "reference_time", "ageing_rate")
        left_out = [name for name in ageing if getattr(self, name) is None]
        if 0 < len(left_out) < len(ageing):
            raise InputError(left_out[0], None, f"{', '.join(ageing)} together, or none of them")
        if self.weakening_slip is not None and self.residual_strength is None:
            raise InputError("residual_strength", None, "0 to 1, the fraction of strength that remains after weakening_slip")
        return self

    def _check_adhesion(self) -> None:
        """Raise InputError if a sweep mixes zero and positive works of adhesion, or if only one of contact and film adheres."""
        some = np.asarray(0.0 if self.work_of_adhesion is None else self.work_of_adhesion)
        if (some == 0.0).any() and some.any():
            allowed = "a sweep with all values above 0, or 0 as a single number for no adhesion"
            raise InputError("work_of_adhesion", InWords("a sweep from 0"), allowed)
        film = None if self.coating is None else self.coating.work_of_adhesion
        if film is None or np.all((np.asarray(film) > 0.0) == some.any()):
            return
        if some.any():
            raise InputError("coating.work_of_adhesion", "0", "above 0, because work_of_adhesion of the contact is above 0")
        raise InputError("coating.work_of_adhesion", "above 0", "nothing: work_of_adhesion of the contact is 0 or not stated")

    @property
    def adheres(self) -> bool:
        """Return whether the work of adhesion of the contact is specified and above 0."""
        return bool(np.any(np.asarray(0.0 if self.work_of_adhesion is None else self.work_of_adhesion) > 0.0))

    def indices(self) -> Indices:
        """Return the dimensionless groups of this contact: groups of the bare bodies and, if there is a film, of the film.

        Array inputs are broadcast by the names of their dimensions. Raises InputError if a group is out of its bounds.
        """
        return self._indices

    @cached_property
    def _indices(self) -> Indices:
        try:
            with np.errstate(all="ignore"):  # Indices refuses numbers that have overflowed in an array
                groups = self.unlabelled._groups()
        except ArithmeticError:
            raise InputError("contact", InWords("numbers that overflow"), "numbers as real materials have them") from None
        names = {} if self.unlabelled is self else coordinates(self.arrays())
        with explained(lambda name: f"follows from the numbers of the contact: {QUANTITIES[name].meaning}"):
            return Indices(**{name: labelled(value, names) for name, value in groups.items()} if names else groups)

    @property
    def impossible(self) -> "NumberOrArray":
        with np.errstate(all="ignore"):
            groups = self.unlabelled._groups().items()
        outside = (np.logical_not(QUANTITIES[name].holds(value)) for name, value in groups if value is not None)
        return reduce(np.logical_or, outside, False)

    def known(self, name: str) -> object:
        """Return the property or dimensionless group called `name`; None if the contact does not determine it."""
        is_group = name in Indices.model_fields or hasattr(Indices, name)  # other names need no groups
        return self.indices().known(name) if is_group and not hasattr(self, name) else super().known(name)

    def _groups(self) -> dict[str, Any]:
        bare = self._bare
        sigma, radius, (strength, coefficient) = self._sigma, self._radius, self.interface_at()
        groups = self._adhesion(bare) | {
            "nu": bare.nu,
            "hardness_to_yield": bare.k if self.hardness_to_yield is None else self.hardness_to_yield,
            "K_beta": bare.K * bare.beta,
            "sharpness": (sigma / radius) ** 0.5,
            "roughness_parameter": self.roughness.asperity_density * radius * sigma,
            "nominal_width": self.nominal_area**0.5 / sigma,
            "size_over_burgers": None if self.burgers_vector is None else (radius * sigma) ** 0.5 / self.burgers_vector,
            "shear_strength": None if strength is None else strength / bare.hardness,
            "pressure_coefficient": coefficient,
            "peeling": self.peeling,
            "hardening": bare.hardening,
            "waiting": None if self.hold_time is None or self.reference_time is None else self.hold_time / self.reference_time,
            "ageing_rate": self.ageing_rate,
            "strength_variation": self.strength_variation,
        }
        if self.liquid is not None:
            groups["meniscus_index"] = bare.K * sigma**1.5 / (self.liquid.work * radius**0.5)
            groups["meniscus_height"] = self.liquid.height / sigma
        return groups if self.coating is None else groups | self._film_groups(self.coating, bare)

    def _adhesion(self, bare: "Pair") -> dict[str, Any]:
        """Return theta, lam and Tabor's parameter of the bare bodies, by name; only the hardness group if nothing adheres."""
        sigma, radius, gamma = self._sigma, self._radius, self.work_of_adhesion
        if gamma is None or not self.adheres:
            return {"hardness_group": pi * bare.hardness * (radius / sigma) ** 0.5 / bare.K}
        return {
            "theta": bare.K * sigma**1.5 / (gamma * radius**0.5),
            "lam": pi**2 * radius * bare.hardness**4 * sigma / (18 * bare.K**2 * gamma**2),
            "tabor_parameter": self.tabor_parameter(),
        }

    def _film_groups(self, coating: Coating, bare: "Pair") -> dict[str, Any]:
        film = Pair(at_radius(coating.material, self._radius), at_radius(self._against_film(coating), self._radius))
        gamma, film_gamma, constant = self.work_of_adhesion, coating.work_of_adhesion, coating.friction_constant
        # If both bodies are coated, the more compliant one counts as the coated body, so that their order does not matter.
        coated, counter = (self.second, self.first) if coating.bodies == "second" else (self.first, self.second)
        first = True if coating.bodies != "both" else more_compliant(coated, counter)
        share = choose(first, compliance_of(coated), compliance_of(counter)) * (0.75 * bare.K)  # round-off may exceed 1
        return {
            # The ratio of K equals the n_E = E_c/E_s of the 2015 paper if film and bodies have the same nu.
            "n_E": film.K / bare.K,
            "n_H": film.hardness / bare.hardness,
            "tau": coating.thickness / self._sigma,
            "n_g": 1.0 if film_gamma is None or gamma is None or not self.adheres else film_gamma / gamma,
            "film_aspect": coating.thickness / (self._radius * self._sigma) ** 0.5,
            "film_nu": film.nu,
            "film_K_beta": film.K * film.beta,
            "film_friction_constant": None if constant is None else constant / (bare.K * (self._radius * self._sigma) ** 0.5),
            "films": 2.0 if coating.bodies == "both" else 1.0,
            "layer_n_H": at_radius(coating.material, self._radius).hardness / bare.hardness,
            "layer_nu": coating.material.poissons_ratio,
            "coated_share": np.minimum(share, 1.0),
            "coated_nu": choose(first, coated.poissons_ratio, counter.poissons_ratio),
            "counter_nu": choose(first, counter.poissons_ratio, coated.poissons_ratio),
        }

    @property
    def has_film(self) -> bool:
        return self.coating is not None

    @property
    def heights(self) -> tuple[str, dict[str, float | list[float]]]:
        return self.roughness.height_distribution, self.roughness.height_parameters

    def optional_inputs(self) -> dict[str, str]:
        return optional_inputs(self)

    def remarks(self) -> list[str]:
        of_film = [] if (softer := self.softer_counterbody) is None else [softer_in_words(*softer, self._bare.hardness)]
        return [*size_notes(self._bodies, self._radius), *of_film, *self.roughness.notes()]

    @property
    def _bodies(self) -> list[Material]:
        return [self.first, self.second, *([] if self.coating is None else [self.coating.material])]

    @property
    def softer_counterbody(self) -> tuple[Material, Material] | None:
        """Return (film, counterbody) if only one body is coated and the other is softer than the film anywhere; else None."""
        if self.coating is None or self.coating.bodies == "both":
            return None
        film, other = (at_radius(body, self._radius) for body in (self.coating.material, self._against_film(self.coating)))
        return (film, other) if (np.asarray(other.hardness) < np.asarray(film.hardness)).any() else None

    def notes(self) -> list[str]:
        return [*([] if self.measured is None else [f"roughness measured, by {self.measured.method}"]), *self.remarks()]

    @property
    def surface_kind(self) -> str | None:
        return self.roughness.surface_kind

    @property
    def measured(self) -> "Measured | None":
        return self.roughness.measured

    @property
    def map(self) -> "HeightMap | None":
        return self.roughness.map

    def as_numbers(self) -> "Contact":
        return self if self.measured is None else self.replace(roughness=self.roughness.as_numbers())

    def with_surface_moments(self) -> "Contact":
        surface = self.roughness.of_surface()
        return self if surface is None else self.model_copy(update={"roughness": surface})

    def all_groups(self) -> dict[str, "NumberOrArray"]:
        """Return every known dimensionless group by name, and the plasticity index, which needs the materials."""
        return super().all_groups() | {"plasticity_index": self.plasticity_index}

    def given_as(self, group: str) -> str:
        names = {"shear_strength": "interfacial_shear_strength", "hardening": "tangent_modulus", "waiting": "hold_time"}
        names |= {"size_over_burgers": "burgers_vector", "meniscus_index": "liquid", "meniscus_height": "liquid"}
        return names.get(group, "work_of_adhesion" if group in ("theta", "lam", "tabor_parameter") else group)

    def read(self, value: "QuantityLike", name: str) -> "Values":
        return to_si(value, name)

    def read_point(self, entry: object, name: str, where: str) -> float:
        """Convert an entry of a case file to a load [N] or mean separation [m].

        entry: text with a unit, or for a mean separation also a number, in units of sigma. name: "load" or "mean_separation".
        where: place in the file, for errors. Raises InputError for any other entry.
        """
        if not isinstance(entry, str):
            if name == "mean_separation":
                return plain_number(entry, where) * self._sigma
            raise InputError(where, entry, QUANTITIES[name].as_text)
        with field_named(where):
            return to_si(entry, name)

    def show(self, value: float, name: str, digits: int = 6) -> str:
        return show(value, name, digits)

    def attributes(self, name: str) -> dict[str, str]:
        return QUANTITIES[name].attributes

    def scales(self) -> Scales:
        """Return the factors that convert dimensionless load, area, separation and asperity number to SI units."""
        return self.unlabelled._scales

    @cached_property
    def _scales(self) -> Scales:
        K = self._bare.K
        return Scales(
            load=K * self._radius**0.5 * self._sigma**1.5,
            contact_area=pi * self._radius * self._sigma,
            separation=self._sigma,
            asperities=self.roughness.asperity_density * self.nominal_area,
            nominal_area=self.nominal_area,
        )

    @property
    def contact_modulus(self) -> "NumberOrArray":
        """Return the contact modulus E* [Pa] of the two bodies without a film: 1/E* is the sum of (1 - nu^2)/E."""
        return 0.75 * self._bare.K

    @property
    def touching(self) -> tuple[Material, Material]:
        """Return the materials of the two surfaces that meet: those of both bodies, or the film and the opposite material."""
        return (self.first, self.second) if self.coating is None else (self.coating.material, self._against_film(self.coating))

    def interface_at(self, level: "ArrayLike" = 0.5) -> tuple["Values | None", "Values | None"]:
        """Return the shear strength tau_0 [Pa] and the pressure coefficient of the interface; each is None if unknown.

        level: quantile levels at which the distributions of the interface state are evaluated; without a state the level has no
        effect. The strength is not capped at the strength of the bodies. A strength relative to hardness or shear modulus
        refers to the softer touching body. Raises InputError for a level that is not above 0 and below 1.
        """
        if self.interface is None:
            return self.interfacial_shear_strength, self.pressure_coefficient
        return self.interface.at(level, *(at_radius(body, self._radius) for body in self.touching))

    @property
    def interface_strength(self) -> "NumberOrArray | None":
        """Return tau_0 of the interface [Pa], capped at the shear strength of the weaker surface; None if not specified."""
        return None if self.interface_at()[0] is None else self.indices().interface_strength * self._bare.hardness

    @property
    def kelvin_radius(self) -> "NumberOrArray | None":
        """Return the Kelvin radius of the menisci [m], see `Liquid.kelvin_radius`; None without a liquid."""
        return None if self.liquid is None else self.liquid.kelvin_radius

    @property
    def kelvin_radius_over_confirmed(self) -> "NumberOrArray | None":
        """Return Kelvin radius over smallest radius at which Kelvin's equation is confirmed; None without a liquid."""
        return None if self.liquid is None else self.liquid.kelvin_radius_over_confirmed

    @property
    def plasticity_index(self) -> "NumberOrArray":
        """Return the plasticity index (E*/H) (sigma/R)^(1/2) of the bodies without a film (Greenwood & Williamson 1966).

        H is the hardness of the softer body.
        """
        return self.contact_modulus / self._bare.hardness * (self._sigma / self._radius) ** 0.5

    def tabor_parameter(self, equilibrium_distance: "QuantityLike" = EQUILIBRIUM_DISTANCE) -> "NumberOrArray":
        """Return Tabor's parameter (R gamma^2/(E*^2 epsilon^3))^(1/3) of the bodies without a film (Tabor 1977).

        equilibrium_distance: epsilon, in m or text with a unit; by default 0.3 nm. The parameter is 0 without adhesion. JKR
        adhesion holds well above about 5, DMT well below about 0.1.
        """
        distance = to_si(equilibrium_distance, "equilibrium_distance")
        if (gamma := self.work_of_adhesion) is None or not self.adheres:
            return 0.0
        return (self._radius * gamma**2 / (self.contact_modulus**2 * distance**3)) ** (1 / 3)

    @cached_property
    def _bare(self) -> Pair:
        """Return both bodies without a film, each with the hardness that it has under asperities of radius R."""
        return Pair(at_radius(self.first, self._radius), at_radius(self.second, self._radius))

    @property
    def size_effect(self) -> "NumberOrArray | None":
        """Return (H under asperities/H of large imprints)^2 - 1, maximum of bodies and film; None without a size effect."""
        ratios = [size_ratio(body, self._radius) for body in self._bodies if body.characteristic_depth is not None]
        return max(ratios, key=lambda ratio: float(np.max(ratio))) if ratios else None

    @property
    def _sigma(self):
        return self.roughness.asperity_height_deviation

    @property
    def _radius(self):
        return self.roughness.asperity_radius

    def _against_film(self, coating: Coating) -> Material:
        """Return the material that the film touches: the film of the other body, or the other body if it has no film."""
        return {"both": coating.material, "first": self.second, "second": self.first}[coating.bodies]
