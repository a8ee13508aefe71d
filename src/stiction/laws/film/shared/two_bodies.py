"""A coated contact of two bodies: the effect of film and substrate on each and both.

A composite gives the modulus of one half-space and its film. In contact the two half-spaces are in series: with one of them
coated the other stays as it is, with both each has half of the thickness. E*/E*_bare is then

    1 / (s/g_1 + (1 - s)/g_2),    g_i = E'_i,coated/E'_i,    s = E*_bare/E'_1,

which is n_E under a film without end, whichever bodies are coated, and g_1 where the other body is rigid (s = 1).
"""

from dataclasses import dataclass

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula


@dataclass(frozen=True)
class TwoBodies:
    """Arrays (n,) that describe n coated contacts of two bodies.

    first, second: E'_f/E'_i, second without meaning where the other body is bare; share: s of the coated body; films: 1 or 2;
    nu, nu_first, nu_second: of the film itself and of the bodies.
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
        whole, laws = groups.resolved(), len(groups)
        film = groups.film_modulus
        share = whole.coated_share
        columns = (
            film * share,
            film * (1.0 - share),
            share,
            whole.films,
            whole.layer_nu,
            whole.coated_nu,
            whole.counter_nu,
        )
        return cls(*(np.broadcast_to(np.asarray(column, dtype=float), laws) for column in columns))

    @classmethod
    def against_rigid(cls, film_over_substrate: np.ndarray, nu_film: np.ndarray, nu_substrate: np.ndarray) -> "TwoBodies":
        """Return a coated body against a rigid one."""
        one = np.ones_like(film_over_substrate)
        return cls(film_over_substrate, 0.0 * one, one, one, nu_film, nu_substrate, nu_substrate)

    def without_film(self, there: np.ndarray) -> "TwoBodies":
        """Return the same bodies with their own modulus in place of the film's.

        Only where there is no film.
        """
        first, second = np.where(there, self.first, 1.0), np.where(there, self.second, 1.0)
        return TwoBodies(first, second, self.share, self.films, self.nu, self.nu_first, self.nu_second)

    def columns(self) -> tuple[np.ndarray, ...]:
        """Return the fields in their order, as the formulas take them."""
        return self.first, self.second, self.share, self.films, self.nu, self.nu_first, self.nu_second

    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Return least and greatest E*/E*_bare at any depth (n,).

        Each body is between itself and the film.
        """
        second = self._second()
        ends = np.minimum, np.maximum
        least, greatest = (in_series(end(self.first, 1.0), end(second, 1.0), self.share) for end in ends)
        return least, greatest

    @property
    def film_over_bodies(self) -> np.ndarray:
        """Return the film's modulus over the bodies' in series (n,)."""
        both = in_series(self.first, self._second(), self.share)
        return np.where(self.films == 2.0, both, self.first)

    def _second(self) -> np.ndarray:
        """Return E'_f/E'_2, or 1 where the second body is bare."""
        return np.where(self.films == 2.0, self.second, 1.0)


@formula
def in_series(first, second, share):
    """Return E*/E*_bare of two bodies with these multiples of their own moduli."""
    return first * second / (share * second + (1.0 - share) * first)
