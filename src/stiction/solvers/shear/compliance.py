"""How far elastic bodies give way under a wave of shear traction: along the wave, and across it.

Two half-spaces with shear moduli G_i and Poisson's ratios nu_i, wavevector k, k = |k| (Johnson 1985, Contact Mechanics, section
3.6, transformed; G_i infinite: rigid):

    C_L(k) = sum (1 - nu_i)/G_i / k    along k,        C_T(k) = sum 1/G_i / k    across k                                (1)

so that the traction (q_x, q_y) displaces one face past the other by

    u = [C_T I + (C_L - C_T) k k^T/k^2] q,    u_x = [S - N k_x^2/k^2] q_x/k - N k_x k_y q_y/k^3,  u_y alike               (2)
    S = sum 1/G_i,  N = sum nu_i/G_i.

Sign: q acts on the upper body against the direction of u, the motion of the upper body past the lower one. A film takes C_L and
C_T from the waves of a layered half-space (see `layered.waves`). Traction is taken to leave the pressure alone, which is exact
for like bodies and for an incompressible body on a rigid one (Johnson 1985, section 5.4).
"""

import math
from dataclasses import dataclass

import numpy as np

from stiction.quantities.errors import InputError
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.layered.waves import CoatedBody, waves


@dataclass(frozen=True)
class HalfSpace:
    """An elastic half-space.

    modulus: Young's modulus [Pa], > 0, infinite: rigid; poisson: Poisson's ratio, > -1, at most 1/2. Raises InputError
    otherwise.
    """

    modulus: float
    poisson: float

    def __post_init__(self) -> None:
        if not self.modulus > 0.0:
            raise InputError("modulus", self.modulus, "> 0 Pa, or infinite: rigid")
        if not -1.0 < self.poisson <= 0.5:
            raise InputError("poisson", self.poisson, "> -1, <= 0.5")

    @property
    def shear_modulus(self) -> float:
        """Return G = E/(2 (1 + nu)) [Pa]."""
        return self.modulus / (2.0 * (1.0 + self.poisson))


Body = HalfSpace | Film


@dataclass(frozen=True)
class ShearCompliance:
    """Compliance of two bodies under shear.

    bodies: two, each a half-space or a film on one. Raises InputError if both are rigid.
    """

    bodies: tuple[Body, Body]

    def __post_init__(self) -> None:
        if all(isinstance(body, HalfSpace) and math.isinf(body.modulus) for body in self.bodies):
            raise InputError("bodies", "both rigid", "at least one that is elastic")

    @property
    def layered(self) -> bool:
        """Return whether a body has a film."""
        return any(isinstance(body, Film) for body in self.bodies)

    @property
    def near(self) -> float:
        """Return S of (2) [1/Pa] of the faces: of films where there are any."""
        of_films = (2.0 * (1.0 + body.poisson) / body.modulus for body in self.bodies if isinstance(body, Film))
        return self.sums[0] + sum(of_films)

    @property
    def sums(self) -> tuple[float, float]:
        """Return S and N of (2) [1/Pa], of bodies without films."""
        bare = [body for body in self.bodies if isinstance(body, HalfSpace)]
        return sum(1.0 / body.shear_modulus for body in bare), sum(body.poisson / body.shear_modulus for body in bare)

    @property
    def mismatch(self) -> float:
        """Return M [1/Pa], by which pressure and shear feel each other; of two bodies without films."""
        first, second = (
            (1.0 - 2.0 * body.poisson) / (2.0 * body.shear_modulus) for body in self.bodies if isinstance(body, HalfSpace)
        )
        return first - second

    @property
    def at_zero(self) -> float:
        """Return the displacement under uniform traction [m/Pa]: t/G of films on rigid bases, 0 where that is not defined."""
        films = [body for body in self.bodies if isinstance(body, Film)]
        if self.sums[0] > 0.0 or any(film.far > 0.0 for film in films):
            return 0.0
        return sum(film.thickness * 2.0 * (1.0 + film.poisson) / film.modulus for film in films)

    def times_k(self, k: np.ndarray) -> np.ndarray:
        """Return k C_L and k C_T [1/Pa], shape (2, ...), at wavevectors k > 0 [1/m] of any shape."""
        S, N = self.sums
        total = np.empty((2, *np.shape(k)))
        total[0], total[1] = S - N, S
        for body in self.bodies:
            if isinstance(body, Film):
                total += _of_film(body, np.asarray(k, dtype=float))
        return total


def _of_film(film: Film, k: np.ndarray) -> np.ndarray:
    """Return k C_L and k C_T [1/Pa] of a film on its substrate."""
    coated = CoatedBody(film.plane_strain * film.far, film.poisson, film.substrate_poisson)
    values, place = np.unique(k * film.thickness, return_inverse=True)
    relative = waves(values, coated).surface_compliances(film.poisson)
    return relative[:, place.ravel()].reshape(2, *k.shape) * (2.0 * (1.0 + film.poisson) / film.modulus)
