"""The dimensionless groups that decide a contact, as flat arrays: what laws are written in."""

import math
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np


def hardness_group(theta, lam):
    """eta = pi H sqrt(R/sigma) / K = sqrt(pi) 18^(1/4) lambda^(1/4) theta^(-1/2) (half the 7.3 of eq 1). Arrays."""
    return math.sqrt(math.pi) * 18.0**0.25 * lam**0.25 / np.sqrt(theta)


def stiffness_group(nu):
    """K beta = (8/3)(2 - nu)/(1 - nu), when the bodies are alike or one of them is rigid. Arrays."""
    return 8.0 / 3.0 * (2.0 - nu) / (1.0 - nu)


@dataclass(frozen=True)
class Groups:
    """Groups of n contacts; arrays (n,). The meaning and bounds of each are in `quantities`. Film groups are arrays too, or all
    None if bare; the last eight are arrays, or None where they are not known: only some laws need them.

    film_aspect, t/sqrt(R sigma), is infinite where R is not known: the film is then a half-space to every asperity.
    """

    theta: np.ndarray
    lam: np.ndarray
    nu: np.ndarray
    hardness_to_yield: np.ndarray
    K_beta: np.ndarray
    n_E: Any = None
    n_H: Any = None
    tau: Any = None
    n_g: Any = None
    film_aspect: Any = None
    film_nu: Any = None
    film_K_beta: Any = None
    tabor_parameter: Any = None
    sharpness: Any = None
    density: Any = None
    nominal_width: Any = None
    shear_strength: Any = None
    pressure_coefficient: Any = None
    peeling: Any = None
    hardening: Any = None

    @property
    def eta(self) -> np.ndarray:
        """The hardness group: a mean pressure H on the area x is the load eta x."""
        return hardness_group(self.theta, self.lam)

    @property
    def coated(self) -> bool:
        return self.tau is not None

    def substrate(self) -> "Groups":
        """The groups without the film."""
        return replace(self, **{name: None for name in _FILM})  # type: ignore[arg-type]

    def film(self) -> "Groups":
        """The groups of the film as a half-space: theta n_E/n_g, lambda n_H^4/(n_E n_g)^2 (section 2 of the 2015 paper; n_g is
        this project's). Forces are then in the film's unit, n_E times less."""
        own: dict[str, Any] = {
            "theta": self.theta * self.n_E / self.n_g,
            "lam": self.lam * (self.n_H * self.n_H / (self.n_E * self.n_g)) ** 2,
            "nu": self.film_nu,
            "K_beta": self.film_K_beta,
        }
        if self.shear_strength is not None:
            own["shear_strength"] = self.shear_strength / self.n_H
        if self.tabor_parameter is not None:
            own["tabor_parameter"] = self.tabor_parameter * (self.n_g / self.n_E) ** (2.0 / 3.0)
        return replace(self.substrate(), **own)

    def __len__(self) -> int:
        return len(self.theta)

    def __getitem__(self, rows: slice | np.ndarray) -> "Groups":
        """The groups of some of the contacts."""
        columns: dict[str, Any] = {field.name: getattr(self, field.name) for field in fields(self)}
        for name, column in columns.items():
            columns[name] = None if column is None else column[rows]
        return Groups(**columns)


_FILM = ("n_E", "n_H", "tau", "n_g", "film_aspect", "film_nu", "film_K_beta")
