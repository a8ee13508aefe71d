"""The dimensionless groups that decide a contact, as flat arrays: what laws are written in."""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Groups:
    """Groups of n contacts; arrays (n,). The meaning and bounds of each are in `quantities`; film groups are
    arrays too, or all None if bare.

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

    @property
    def coated(self) -> bool:
        return self.tau is not None

    @property
    def film_theta(self) -> np.ndarray:
        """theta n_E / n_g: the film's own elastic adhesion index (section 2 of the 2015 paper; n_g is this project's)."""
        return self.theta * self.n_E / self.n_g

    @property
    def film_lam(self) -> np.ndarray:
        """lambda n_H^4 / (n_E^2 n_g^2): the film's own plastic adhesion index."""
        return self.lam * (self.n_H * self.n_H / (self.n_E * self.n_g)) ** 2

    def __len__(self) -> int:
        return len(self.theta)

    def __getitem__(self, rows: slice | np.ndarray) -> "Groups":
        """The groups of some of the contacts."""
        columns: dict[str, Any] = {field.name: getattr(self, field.name) for field in fields(self)}
        for name, column in columns.items():
            columns[name] = None if column is None else column[rows]
        return Groups(**columns)
