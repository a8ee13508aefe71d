"""Combine the moduli of film and substrate for contacts in which one or both bodies are coated.

A composite law gives the modulus E' = E/(1 - nu^2) of one half-space with its film. In contact the two half-spaces act in
series. If both bodies are coated, each has half of the film thickness. The ratio of the contact modulus to the
bare bodies' contact modulus is then

    1 / (s/g_1 + (1 - s)/g_2),    g_i = E'_i,coated/E'_i,    s = E*_bare/E'_1.

For a film of infinite thickness this ratio is the group n_E, whichever bodies are coated. It is g_1 if the other body is rigid
(s = 1).
"""

from dataclasses import dataclass

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula


@dataclass(frozen=True)
class TwoBodies:
    """Hold the elastic constants of n contacts in which one body or both are coated, as arrays (n,).

    first, second: modulus of the film divided by the modulus of the first and of the second body, with E' = E/(1 - nu^2);
    `second` has no meaning if the second body is bare. share: fraction of the compliance of both bare bodies that is due to
    the first body, which is coated. films: number of coated bodies, 1 or 2. nu: Poisson's ratio of the film. nu_first,
    nu_second: Poisson's ratios of the first and of the second body.
    """

    first: np.ndarray
    second: np.ndarray
    share: np.ndarray
    films: np.ndarray
    nu: np.ndarray
    nu_first: np.ndarray
    nu_second: np.ndarray

    @classmethod
    def of(cls, groups: Groups) -> "TwoBodies":
        resolved, laws = groups.resolved(), len(groups)
        film = groups.film_modulus
        share = resolved.coated_share
        columns = (
            film * share,
            film * (1.0 - share),
            share,
            resolved.films,
            resolved.layer_nu,
            resolved.coated_nu,
            resolved.counter_nu,
        )
        return cls(*(np.broadcast_to(np.asarray(column, dtype=float), laws) for column in columns))

    @classmethod
    def against_rigid(cls, film_over_substrate: np.ndarray, nu_film: np.ndarray, nu_substrate: np.ndarray) -> "TwoBodies":
        """Return the constants of a coated first body against a rigid second body.

        film_over_substrate (n,): reduced modulus of the film divided by the substrate's. nu_film, nu_substrate (n,):
        Poisson's ratios of film and substrate.
        """
        ones = np.ones_like(film_over_substrate)
        return cls(film_over_substrate, 0.0 * ones, ones, ones, nu_film, nu_substrate, nu_substrate)

    def without_film(self, there: np.ndarray) -> "TwoBodies":
        """Return a copy without film where the mask `there` (n,) is False: the film then has the modulus of its body."""
        first, second = np.where(there, self.first, 1.0), np.where(there, self.second, 1.0)
        return TwoBodies(first, second, self.share, self.films, self.nu, self.nu_first, self.nu_second)

    def columns(self) -> tuple[np.ndarray, ...]:
        """Return the seven fields, arrays (n,), in the order in which the formulas take them."""
        return self.first, self.second, self.share, self.films, self.nu, self.nu_first, self.nu_second

    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the bounds (n,) of the ratio of the contact modulus with films to the contact modulus of the bare bodies.

        The modulus of each coated body is between its own and the film's.
        """
        second = self._second()
        ends = np.minimum, np.maximum
        least, greatest = (in_series(end(self.first, 1.0), end(second, 1.0), self.share) for end in ends)
        return least, greatest

    @property
    def film_over_bodies(self) -> np.ndarray:
        """Return the film modulus divided by the modulus of the coated body (n,), or of two coated bodies in series."""
        both = in_series(self.first, self._second(), self.share)
        return np.where(self.films == 2.0, both, self.first)

    def _second(self) -> np.ndarray:
        """Return the ratio (n,) of the film modulus to the second body's modulus, or 1 if the second body is bare."""
        return np.where(self.films == 2.0, self.second, 1.0)


@formula
def in_series(first, second, share):
    """Return the ratio of the contact modulus with films to the contact modulus of the bare bodies.

    first, second: factors by which films multiply the moduli of the two bodies. share: fraction of the compliance of both
    bare bodies that is due to the first body.
    """
    return first * second / (share * second + (1.0 - share) * first)
