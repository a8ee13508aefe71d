"""Define the dimensionless groups of a contact: Indices for users, and Groups, with arrays, for laws."""

import math
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from pydantic import model_validator

from stiction.contact.subject import Scales, Subject
from stiction.quantities.dimensions import flattened
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.inputs import Number, OptionalNumber, by_default, floats, plain_number
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import as_sequence, check_names, has_unit

if TYPE_CHECKING:
    from stiction.quantities.arguments import NumberOrArray, QuantityLike, Values

# Default H/Y of a body without a yield stress: 2.8 as in Chang, Etsion & Bogy 1987; Tabor's value is 3.
HARDNESS_TO_YIELD = 2.8

_FILM = (
    "n_E", "n_H", "tau", "film_aspect", "film_nu", "film_K_beta", "films", "layer_n_H", "layer_nu", "coated_share", "coated_nu",
    "counter_nu", "film_friction_constant",
)  # fmt: skip

# Groups that follow from other groups if the user does not state them.
_FOLLOWS = ("hardness_group", "films", "layer_n_H", "layer_nu", "coated_share", "coated_nu", "counter_nu")


def hardness_group(theta, lam):
    """Return the hardness group eta = pi H sqrt(R/sigma)/K from the adhesion indices theta (elastic) and lambda (plastic).

    eta = sqrt(pi) 18^(1/4) lambda^(1/4) theta^(-1/2). The coefficient, 3.65, is half the 7.3 in eq. (1) of the 2015 paper.
    """
    return math.sqrt(math.pi) * 18.0**0.25 * lam**0.25 / np.sqrt(theta)


def stiffness_group(nu):
    """Return the product K beta = (8/3)(2 - nu)/(1 - nu) of normal stiffness K and tangential compliance beta.

    nu: Poisson's ratio. The formula holds for two bodies of one material, or if one body is rigid (S1.3 of the theory page).
    """
    return 8.0 / 3.0 * (2.0 - nu) / (1.0 - nu)


def check_film(theta, lam, n_E, n_H, n_g=1.0) -> None:
    """Raise InputError unless the adhesion indices of the contact with an infinitely thick film are within their bounds.

    theta, lam: adhesion indices without a film. n_E, n_H, n_g: modulus, hardness and work of adhesion of the film relative to
    the bodies. All may be arrays.
    """
    with np.errstate(over="ignore"):
        alone = {"theta": (theta * n_E / n_g, n_E), "lam": (lam * (n_H * n_H / (n_E * n_g)) ** 2, n_H)}
    for (name, (value, ratio)), field in zip(alone.items(), ("n_E", "n_H"), strict=True):
        bounds = QUANTITIES[name]
        if not np.asarray((value >= bounds.lower) & (value <= bounds.upper)).all():
            raise InputError(field, ratio, f"a ratio with which {bounds.symbol} of the film material is {bounds.allowed}")


class Indices(Subject):
    """Describe a contact by its dimensionless groups (docs/explanation/theory.md).

    Parameters
    ----------
    theta, lam : float or array, optional
        Elastic and plastic adhesion index; without adhesion, specify hardness_group instead of both.
    hardness_group, nu, K_beta, hardness_to_yield, tabor_parameter, sharpness, roughness_parameter : float or array, optional
        Groups of the bodies without a film. Defaults: nu 0.3, hardness_to_yield 2.8, K_beta as for two equal bodies.
    n_E, n_H, tau : float or array, optional
        Modulus and hardness of a film relative to the bodies, and thickness divided by sigma: all three, or none without a
        film.
    n_g, film_aspect, film_nu, film_K_beta, film_friction_constant : float or array, optional
        Further groups of a film. By default n_g is 1, film_aspect infinite (the film acts as a half-space for every asperity),
        film_nu is nu, film_K_beta follows from film_nu or is K_beta, film_friction_constant follows from strength and hardness.
    films, layer_n_H, layer_nu, coated_share, coated_nu, counter_nu : float or array, optional
        Groups of the coated bodies. By default films is 1 (one coated body), coated_share is 1/films (the bare body is rigid,
        or both coated bodies are equal), layer_n_H is n_H, layer_nu is film_nu, coated_nu and counter_nu are nu.
    nominal_width, size_over_burgers, shear_strength, pressure_coefficient, peeling, hardening, strength_variation : optional
        Groups that some laws use.
    waiting, ageing_rate, meniscus_index, meniscus_height : float or array, optional
        Time at rest divided by the reference time, and ageing rate: both or neither. Two groups of menisci: both or neither.

    Raises
    ------
    InputError
        A number is out of its bounds, a group is missing, or groups contradict each other.

    Notes
    -----
    Every number may be an array with a named dimension (`stiction.axis`). The list below has the meaning and bounds of each.

    Examples
    --------
    >>> import stiction as st
    >>> round(float(st.Indices(theta=40.0, lam=3.0).eta), 3)
    0.76
    """

    theta: OptionalNumber = by_default(None)
    lam: OptionalNumber = by_default(None)
    hardness_group: OptionalNumber = by_default(None)
    nu: Number = by_default(0.3)
    hardness_to_yield: Number = by_default(HARDNESS_TO_YIELD)
    n_E: OptionalNumber = by_default(None)
    n_H: OptionalNumber = by_default(None)
    tau: OptionalNumber = by_default(None)
    n_g: Number = by_default(1.0)
    film_aspect: OptionalNumber = by_default(None)
    K_beta: OptionalNumber = by_default(None)
    film_nu: OptionalNumber = by_default(None)
    film_K_beta: OptionalNumber = by_default(None)
    films: OptionalNumber = by_default(None)
    layer_n_H: OptionalNumber = by_default(None)
    layer_nu: OptionalNumber = by_default(None)
    coated_share: OptionalNumber = by_default(None)
    coated_nu: OptionalNumber = by_default(None)
    counter_nu: OptionalNumber = by_default(None)
    film_friction_constant: OptionalNumber = by_default(None)
    tabor_parameter: OptionalNumber = by_default(None)
    sharpness: OptionalNumber = by_default(None)
    roughness_parameter: OptionalNumber = by_default(None)
    nominal_width: OptionalNumber = by_default(None)
    size_over_burgers: OptionalNumber = by_default(None)
    shear_strength: OptionalNumber = by_default(None)
    pressure_coefficient: OptionalNumber = by_default(None)
    peeling: OptionalNumber = by_default(None)
    hardening: OptionalNumber = by_default(None)
    strength_variation: OptionalNumber = by_default(None)
    waiting: OptionalNumber = by_default(None)
    ageing_rate: OptionalNumber = by_default(None)
    meniscus_index: OptionalNumber = by_default(None)
    meniscus_height: OptionalNumber = by_default(None)

    @model_validator(mode="after")
    def _adheres_or_not(self):
        given = [name for name in ("theta", "lam") if getattr(self, name) is not None]
        for pair in (("meniscus_index", "meniscus_height"), ("waiting", "ageing_rate")):
            left_out = [name for name in pair if getattr(self, name) is None]
            if len(left_out) == 1:
                raise InputError(left_out[0], None, f"{pair[0]} and {pair[1]} together, or none of them")
        if (self.hardness_group is None) == (len(given) == 2) and len(given) != 1:
            return self
        missing = "lam" if self.lam is None and self.theta is not None else "theta"
        if self.hardness_group is not None:
            allowed = "no value together with theta and lam, because it follows from them"
            raise InputError("hardness_group", self.hardness_group, allowed)
        raise InputError(
            missing, None, f"{QUANTITIES[missing].described}; without adhesion, state hardness_group instead of theta and lam"
        )

    @model_validator(mode="after")
    def _film_is_whole(self):
        needed = ("n_E", "n_H", "tau")
        missing = [name for name in needed if getattr(self, name) is None]
        beside = [name for name in _FILM if name not in needed and getattr(self, name) is not None]
        if (np.asarray(self.n_g) != 1).any():
            beside.append("n_g")
        if missing and (len(missing) < len(needed) or beside):
            given = next((name for name in needed if name not in missing), None) or beside[0]
            raise InputError(missing[0], None, f"a film needs n_E, n_H and tau together ({given} is given)")
        self.check_dimensions()
        if not missing and self.theta is not None:
            check_film(self.theta, self.lam, self.n_E, self.n_H, self.n_g)
        self._check_bodies()
        return self

    def _check_bodies(self) -> None:
        """Raise InputError if film and bodies cannot exist together, such as an n_E above the value of a rigid film."""
        # `np.any` and `np.all` call xarray's own reductions, which take ten times as long as those of plain arrays.
        if self.films is not None and not np.asarray((self.films == 1.0) | (self.films == 2.0)).all():
            raise InputError("films", self.films, "1 or 2, the number of coated bodies")
        if not self.has_film or self.coated_share is None:
            return
        films: Any = 1.0 if self.films is None else self.films
        n_E: Any = self.n_E
        if np.asarray((films == 2.0) & (self.coated_share == 1.0)).any():
            raise InputError("coated_share", self.coated_share, "below 1, because both bodies are coated (films = 2)")
        if np.asarray((films == 1.0) & (n_E * (1.0 - self.coated_share) > 1.0 + 1e-9)).any():
            raise InputError("n_E", self.n_E, "at most 1/(1 - coated_share), the ratio with a rigid film")

    @classmethod
    def __get_pydantic_json_schema__(cls, core_schema, handler):
        schema = super().__get_pydantic_json_schema__(core_schema, handler)
        return schema | {"oneOf": [{"required": ["theta", "lam"]}, {"required": ["hardness_group"]}]}

    @property
    def has_film(self) -> bool:
        """Return whether at least one body has a film."""
        return self.tau is not None

    @property
    def eta(self) -> "NumberOrArray":
        """Return the hardness group eta = pi H sqrt(R/sigma)/K: ratio of dimensionless load to area at the pressure H."""
        return hardness_group(self.theta, self.lam) if self.hardness_group is None else self.hardness_group

    @property
    def yield_strain(self) -> "NumberOrArray | None":
        """Return the yield stress divided by the contact modulus E*; None if `sharpness`, sqrt(sigma/R), is unknown."""
        if self.sharpness is None:
            return None
        return 4.0 / 3.0 * self.eta * self.sharpness / (math.pi * self.hardness_to_yield)

    @property
    def film_plasticity_index(self) -> "NumberOrArray | None":
        """Return (E*/H) sqrt(sigma/R) = (3/4) pi/eta of the contact with an infinitely thick film; None without a film."""
        film: Any = self  # with a film, n_E and n_H are known
        return 0.75 * math.pi / (self.eta * film.n_H / film.n_E) if self.has_film else None

    @property
    def film_stiffness(self) -> "NumberOrArray | None":
        """Return n_E sqrt(R sigma)/t for film thickness t, infinite at t = 0; None without a film or if R is unknown."""
        if not self.has_film or self.film_aspect is None:
            return None
        film: Any = self  # with a film, n_E is known
        with np.errstate(divide="ignore"):
            return np.divide(film.n_E, film.film_aspect)

    @property
    def meniscus_tabor_parameter(self) -> "NumberOrArray | None":
        """Return Tabor's parameter (R W^2/(E*^2 H^3))^(1/3) of a meniscus at an asperity of radius R; None without menisci.

        W = 2 gamma_L c is the work of adhesion of the liquid, with surface tension gamma_L and wetting factor c. H = 2 r c is
        the height of the meniscus, the range of its attraction, with the Kelvin radius r.
        """
        if self.meniscus_index is None or self.meniscus_height is None:
            return None
        return (4.0 / 3.0 / self.meniscus_index) ** (2.0 / 3.0) / self.meniscus_height

    @property
    def meniscus_over_radius(self) -> "NumberOrArray | None":
        """Return the ratio of meniscus height to asperity radius R; None without menisci or if sqrt(sigma/R) is unknown."""
        if self.meniscus_height is None or self.sharpness is None:
            return None
        return self.meniscus_height * self.sharpness**2

    @property
    def film_modulus(self) -> "NumberOrArray":
        """Return E_f/(1 - nu_f^2) of the film divided by the contact modulus E* of the bodies without a film.

        The groups must have a film. The result is computed from n_E by subtracting the compliance of the opposite surface. n_E
        is the contact modulus of the film paired with this surface, divided by E*.
        """
        whole: Any = self.resolved()
        rest = np.where(np.asarray(whole.films) == 2.0, 0.5, (1.0 - whole.coated_share) * whole.n_E)
        return whole.n_E / np.maximum(1.0 - rest, 1e-15)

    @property
    def body_shear_strength(self) -> "NumberOrArray":
        """Return the shear strength Y/sqrt(3) of the weaker touching surface divided by the hardness of the bodies."""
        return (1.0 if self.n_H is None else self.n_H) / (math.sqrt(3.0) * self.hardness_to_yield)

    @property
    def strength_over_bodies(self) -> "NumberOrArray | None":
        """Return the shear strength of the interface divided by the shear strength of the weaker surface; None if unknown."""
        return None if self.shear_strength is None else self.shear_strength / self.body_shear_strength

    @property
    def interface_strength(self) -> "NumberOrArray | None":
        """Return the interfacial shear strength over hardness, at most the strength of the weaker surface; None if unknown."""
        strengths: Any = self.shear_strength, self.body_shear_strength
        return None if self.shear_strength is None else np.minimum(*strengths)

    def has(self, group: str) -> bool:
        """Return whether the group of this name has a value or is one of _FOLLOWS, which follow from other groups."""
        return group in _FOLLOWS or getattr(self, group) is not None

    def indices(self) -> "Indices":
        return self

    def scales(self) -> Scales:
        return Scales()

    def resolved(self) -> Self:
        """Return the indices with defaults for K_beta and, with a film, for film_nu, film_K_beta, and films to counter_nu."""
        K_beta = stiffness_group(self.nu) if self.K_beta is None else self.K_beta
        if not self.has_film:
            return self._unchecked(K_beta=K_beta)
        film_nu = self.nu if self.film_nu is None else self.film_nu
        film_K_beta = self.film_K_beta
        if film_K_beta is None:
            film_K_beta = K_beta if self.film_nu is None else stiffness_group(film_nu)
        films = 1.0 if self.films is None else self.films
        alone = {
            "films": films, "layer_n_H": self.n_H, "layer_nu": film_nu, "coated_share": 1.0 / films, "coated_nu": self.nu,
            "counter_nu": self.nu,
        }  # fmt: skip
        given = {name: getattr(self, name) for name in alone if getattr(self, name) is not None}
        return self._unchecked(K_beta=K_beta, film_nu=film_nu, film_K_beta=film_K_beta, **alone | given)

    def film(self) -> Self:
        """Return the groups of the contact with an infinitely thick film, which acts as a half-space for every asperity.

        Its adhesion indices are theta n_E/n_g and lambda n_H^4/(n_E n_g)^2; its nu and K beta are those of the film.

        Source: section 2 of the 2015 paper (S5.1); n_g is an addition of this project. Forces are then normalised with the
        film's unit of force, which is n_E times the bodies' unit. Raises InputError without a film.
        """
        if not self.has_film:
            raise InputError("tau", None, "the film thickness over sigma; a film needs tau, n_E and n_H together")
        whole: Any = self.resolved()
        strength, tabor, eta = whole.shear_strength, whole.tabor_parameter, whole.hardness_group
        return whole.substrate().with_changes(
            theta=None if whole.theta is None else whole.theta * whole.n_E / whole.n_g,
            lam=None if whole.lam is None else whole.lam * (whole.n_H * whole.n_H / (whole.n_E * whole.n_g)) ** 2,
            hardness_group=None if eta is None else eta * whole.n_H / whole.n_E,
            nu=whole.film_nu,
            K_beta=whole.film_K_beta,
            shear_strength=None if strength is None else strength / whole.n_H,
            tabor_parameter=None if tabor is None else tabor * (whole.n_g / whole.n_E) ** (2.0 / 3.0),
        )

    def substrate(self) -> Self:
        """Return the groups of the same contact without its film."""
        return self.with_changes(n_g=1.0, **dict.fromkeys(_FILM))

    def with_changes(self, **changes: object) -> Self:
        """Return a copy with the groups in `changes` replaced and all groups checked again."""
        return type(self)(**self._fields() | changes)

    def _unchecked(self, **defaults: Any) -> Self:
        """Return a copy with default groups added; nothing is checked, because the defaults follow from checked groups."""
        return type(self).model_construct(**self._fields() | defaults)

    def _fields(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in type(self).model_fields}

    def read(self, value: "QuantityLike", name: str) -> "Values":
        given: Any = as_sequence(value)
        if has_unit(given):
            raise InputError(name, str(given), "numbers without a unit, normalised like the indices")
        normalised = "numbers, normalised like the indices"
        array = floats(given.values if hasattr(given, "dims") else given, name, normalised)
        if not np.all(np.isfinite(array)):
            raise InputError(name, given, "finite numbers")
        if hasattr(given, "dims"):
            check_names(given, name)
            if (unit := given.attrs.get("units", "1")) not in ("", "1"):
                raise InputError(name, InWords(f"numbers in {unit}"), f"{normalised}, without a unit")
            return given.copy(deep=False, data=array) if array.ndim else float(array)
        if array.ndim > 1:
            allowed = "one number, one row of them, or an array with named dimensions"
            raise InputError(name, InWords(f"array of shape {array.shape}"), allowed)
        return array if array.ndim else float(array)

    def read_point(self, entry: object, name: str, where: str) -> float:
        if isinstance(entry, str):
            raise InputError(where, entry, "a plain number")
        return plain_number(entry, where)

    def show(self, value: float, name: str, digits: int = 6) -> str:
        return f"{value:.{digits}g}"

    def attributes(self, name: str) -> dict[str, str]:
        quantity = QUANTITIES[name]
        return quantity.attributes | ({"units": "1", "normalised_by": quantity.normalised_by} if quantity.normalised_by else {})


if TYPE_CHECKING:
    _Arrays: Any  # for type checkers: the fields of Groups are arrays, whereas those of Indices are numbers
else:
    _Arrays = Indices


class Groups(_Arrays):
    """Store the dimensionless groups of n contacts for laws: each an array (n,), or None if unknown.

    Values are not validated again. Groups of a film are None without one; film_aspect is infinite if R is unknown.
    """

    def __init__(self, /, **arrays: Any):
        unknown = arrays.keys() - type(self).model_fields.keys()
        if unknown:
            raise TypeError(f"there is no dimensionless group {', '.join(sorted(unknown))}; Groups takes the fields of Indices")
        made = type(self).model_construct(**arrays)
        for name in ("__dict__", "__pydantic_fields_set__", "__pydantic_extra__", "__pydantic_private__"):
            object.__setattr__(self, name, getattr(made, name))

    @classmethod
    def of(cls, indices: Indices) -> tuple["Groups", dict[str, int]]:
        """Return the groups of all n combinations of array inputs, and the lengths of their dimensions by name.

        The shear strength of the interface is limited to the strength of the weaker touching surface.
        """
        whole = indices.resolved()
        values = {name: getattr(whole, name) for name in cls.model_fields} | {"shear_strength": whole.interface_strength}
        if not whole.has_film:
            values["n_g"] = None
        elif whole.film_aspect is None:
            values["film_aspect"] = math.inf
        flat, dims = flattened(values)
        return cls(**flat), dims

    def __len__(self) -> int:
        return len(self.hardness_group if self.theta is None else self.theta)

    def __getitem__(self, rows: slice | np.ndarray) -> "Groups":
        """Return the groups of selected contacts; rows: slice, mask or indices."""
        columns = self._fields().items()
        return Groups(**{name: column[rows] if np.ndim(column) else column for name, column in columns})
