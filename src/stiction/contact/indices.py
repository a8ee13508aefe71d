"""The dimensionless groups that decide a contact: as a user gives them, and as laws take them."""

import math
import warnings
from typing import Any, Self

import numpy as np
from pydantic import model_validator

from stiction.contact.subject import Scales, Subject
from stiction.quantities.dimensions import check_names, flattened
from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Number, OptionalNumber, floats
from stiction.quantities.table import QUANTITIES

__all__ = ["Groups", "Indices", "hardness_group", "stiffness_group"]

# H/Y where no material says otherwise: 2.8 as in Chang, Etsion & Bogy 1987; Tabor's would be 3.
HARDNESS_TO_YIELD = 2.8

# How the film is spread over the bodies, and their elastic constants one by one: what an exact elastic solution asks for.
_LAYER = ("film_bodies", "coated_share", "layer_nu", "coated_nu", "other_nu")
_FILM = ("n_E", "n_H", "tau", "film_aspect", "film_nu", "film_K_beta", "film_friction_constant", *_LAYER)


def hardness_group(theta, lam):
    """eta = pi H sqrt(R/sigma) / K = sqrt(pi) 18^(1/4) lambda^(1/4) theta^(-1/2) (half the 7.3 of eq 1). Arrays."""
    return math.sqrt(math.pi) * 18.0**0.25 * lam**0.25 / np.sqrt(theta)


def stiffness_group(nu):
    """K beta = (8/3)(2 - nu)/(1 - nu), when the bodies are alike or one of them is rigid: 6.4762 at nu = 0.3 (theory 1)."""
    return 8.0 / 3.0 * (2.0 - nu) / (1.0 - nu)


def check_film(theta, lam, n_E, n_H, n_g=1.0) -> None:
    """Raise InputError unless the film alone, as a half-space, has groups within the bounds of theta and lambda. Arrays."""
    with np.errstate(over="ignore"):
        alone = {"theta": (theta * n_E / n_g, n_E), "lam": (lam * (n_H * n_H / (n_E * n_g)) ** 2, n_H)}
    for (name, (value, ratio)), field in zip(alone.items(), ("n_E", "n_H"), strict=True):
        bounds = QUANTITIES[name]
        if not np.all((value >= bounds.lower) & (value <= bounds.upper)):
            raise InputError(field, ratio, f"what leaves {bounds.symbol} of the film alone {bounds.allowed}")


class Indices(Subject):
    """The dimensionless groups of theory 1 and 4: all that a model needs to know of a contact.

    Any of them may be an array with a named dimension (`stiction.axis`). K_beta left out is that of bodies
    alike, (8/3)(2 - nu)/(1 - nu). There is a film if n_E, n_H and tau are given, all or none; film_nu left
    out is nu, film_K_beta left out follows from film_nu, or is K_beta; film_aspect left out is infinite: the film is then a
    half-space to every asperity; film_friction_constant left out follows from strength and hardness. film_bodies left out is 1;
    coated_share left out is 1, a rigid counterbody, or 1/2, bodies alike, if both carry the film; layer_nu left out is film_nu,
    coated_nu and other_nu are nu. These and the last eight are needed by some laws only. Raises InputError.
    """

    theta: Number
    lam: Number
    nu: Number = 0.3
    hardness_to_yield: Number = HARDNESS_TO_YIELD
    n_E: OptionalNumber = None
    n_H: OptionalNumber = None
    tau: OptionalNumber = None
    n_g: Number = 1.0
    film_aspect: OptionalNumber = None
    K_beta: OptionalNumber = None
    film_nu: OptionalNumber = None
    film_K_beta: OptionalNumber = None
    film_friction_constant: OptionalNumber = None
    film_bodies: OptionalNumber = None
    coated_share: OptionalNumber = None
    layer_nu: OptionalNumber = None
    coated_nu: OptionalNumber = None
    other_nu: OptionalNumber = None
    tabor_parameter: OptionalNumber = None
    sharpness: OptionalNumber = None
    roughness_parameter: OptionalNumber = None
    nominal_width: OptionalNumber = None
    shear_strength: OptionalNumber = None
    pressure_coefficient: OptionalNumber = None
    peeling: OptionalNumber = None
    hardening: OptionalNumber = None

    @model_validator(mode="before")
    @classmethod
    def _old_name(cls, given):
        if isinstance(given, dict) and "density" in given:
            warnings.warn("density is now called roughness_parameter", FutureWarning, stacklevel=4)
            given = {"roughness_parameter" if name == "density" else name: value for name, value in given.items()}
        return given

    @model_validator(mode="after")
    def _film_is_whole(self):
        needed = ("n_E", "n_H", "tau")
        missing = [name for name in needed if getattr(self, name) is None]
        beside = [name for name in _FILM if name not in needed and getattr(self, name) is not None]
        if np.any(self.n_g != 1):
            beside.append("n_g")
        if missing and (len(missing) < len(needed) or beside):
            given = next((name for name in needed if name not in missing), None) or beside[0]
            raise InputError(missing[0], None, f"a film needs n_E, n_H and tau together ({given} is given)")
        if self.film_bodies is not None and not np.isin(self.film_bodies, (1, 2)).all():
            raise InputError("film_bodies", self.film_bodies, "1 or 2")
        self.check_dimensions()
        if not missing and self.theta is not None:
            check_film(self.theta, self.lam, self.n_E, self.n_H, self.n_g)
        return self

    @property
    def has_film(self) -> bool:
        """Whether there is a film."""
        return self.tau is not None

    @property
    def eta(self) -> Any:
        """The hardness group: a mean pressure H on the area x is the load eta x."""
        return hardness_group(self.theta, self.lam)

    def indices(self) -> "Indices":
        return self

    def scales(self) -> Scales:
        return Scales()

    def resolved(self) -> Self:
        """The same groups with K_beta, and with a film film_nu and film_K_beta, filled in."""
        K_beta = stiffness_group(self.nu) if self.K_beta is None else self.K_beta
        if not self.has_film:
            return self.with_changes(K_beta=K_beta)
        film_nu = self.nu if self.film_nu is None else self.film_nu
        film_K_beta = self.film_K_beta
        if film_K_beta is None:
            film_K_beta = K_beta if self.film_nu is None else stiffness_group(film_nu)
        bodies = 1.0 if self.film_bodies is None else self.film_bodies
        layer = {
            "film_bodies": bodies,
            "coated_share": 1.0 / bodies,
            "layer_nu": film_nu,
            "coated_nu": self.nu,
            "other_nu": self.nu,
        }
        given = {name: getattr(self, name) for name in layer if getattr(self, name) is not None}
        return self.with_changes(K_beta=K_beta, film_nu=film_nu, film_K_beta=film_K_beta, **layer | given)

    def film(self) -> Self:
        """The groups of the film as a half-space: theta n_E/n_g, lambda n_H^4/(n_E n_g)^2, with nu and K beta of the film.

        Source: section 2 of the 2015 paper (theory 4); n_g is this project's. Forces are then in the film's unit, n_E times
        less. Raises InputError without a film.
        """
        if not self.has_film:
            raise InputError("tau", None, "n_E, n_H and tau: there is no film")
        whole = self.resolved()
        strength, tabor = whole.shear_strength, whole.tabor_parameter
        return whole.substrate().with_changes(
            theta=whole.theta * whole.n_E / whole.n_g,
            lam=whole.lam * (whole.n_H * whole.n_H / (whole.n_E * whole.n_g)) ** 2,
            nu=whole.film_nu,
            K_beta=whole.film_K_beta,
            shear_strength=None if strength is None else strength / whole.n_H,
            tabor_parameter=None if tabor is None else tabor * (whole.n_g / whole.n_E) ** (2.0 / 3.0),
        )

    def substrate(self) -> Self:
        """The groups of the same contact without its film."""
        return self.with_changes(n_g=1.0, **dict.fromkeys(_FILM))

    def with_changes(self, **changes: Any) -> Self:
        """The same groups but for these."""
        return type(self)(**{name: getattr(self, name) for name in type(self).model_fields} | changes)

    def read(self, value: Any, name: str) -> Any:
        normalised, labelled = "numbers, normalised like the indices", hasattr(value, "dims")
        array = floats(value.values if labelled else value, name, normalised)
        if not np.all(np.isfinite(array)):
            raise InputError(name, value, "finite numbers")
        if labelled:
            check_names(value, name)
            if (unit := value.attrs.get("units", "1")) not in ("", "1"):
                raise InputError(name, f"numbers in {unit}", f"{normalised}: they have no unit")
            return value.copy(data=array) if array.ndim else float(array)
        if array.ndim > 1:
            raise InputError(
                name, f"array of shape {array.shape}", "one number, one row of them, or an array with named dimensions"
            )
        return array if array.ndim else float(array)

    def read_point(self, entry: Any, name: str, where: str) -> float:
        if isinstance(entry, str):
            raise InputError(where, entry, "a plain number")
        return plain_number(entry, where)

    def show(self, value: float, name: str, digits: int = 6) -> str:
        return f"{value:.{digits}g}"

    def attributes(self, name: str) -> dict[str, str]:
        quantity = QUANTITIES[name]
        attributes = {"long_name": quantity.meaning, "symbol": quantity.symbol, "units": quantity.unit or "1"}
        return attributes | ({"units": "1", "normalised_by": quantity.normalised_by} if quantity.normalised_by else {})


class Groups(Indices):
    """The groups of n contacts as laws take them: arrays (n,), or None where they are not known. Nothing is checked again.

    Of a bare contact all that tell of a film are None. film_aspect is infinite where R is not known.
    """

    def __init__(self, /, **arrays: Any):
        unknown = arrays.keys() - type(self).model_fields.keys()
        if unknown:
            raise TypeError(f"there is no group {', '.join(sorted(unknown))}")
        made = type(self).model_construct(**arrays)
        for name in ("__dict__", "__pydantic_fields_set__", "__pydantic_extra__", "__pydantic_private__"):
            object.__setattr__(self, name, getattr(made, name))

    @classmethod
    def of(cls, indices: Indices) -> tuple["Groups", dict[str, int]]:
        """Flat groups of all combinations of the named dimensions of some indices, and those dimensions."""
        whole = indices.resolved()
        values = {name: getattr(whole, name) for name in cls.model_fields}
        if not whole.has_film:
            values["n_g"] = None
        elif whole.film_aspect is None:
            values["film_aspect"] = math.inf
        flat, dims = flattened(values)
        return cls(**flat), dims

    def __len__(self) -> int:
        return len(self.theta)

    def __getitem__(self, rows: slice | np.ndarray) -> "Groups":
        """The groups of some of the contacts."""
        columns = {name: getattr(self, name) for name in type(self).model_fields}
        return Groups(**{name: column[rows] if np.ndim(column) else column for name, column in columns.items()})


def plain_number(entry: Any, where: str) -> float:
    """A finite number without a unit; `where` in a case file it stands. Raises InputError."""
    try:
        number = float(entry)
    except OverflowError:  # TOML has whole numbers without end
        number = math.inf
    if not math.isfinite(number):
        raise InputError(where, entry, "a finite number")
    return number
