"""Compute the elastic compliance of two bodies under a sinusoidal shear traction, along and across the wavevector.

Two half-spaces with shear moduli G_i and Poisson's ratios nu_i, wavevector k, k = |k| (Johnson 1985, Contact Mechanics, section
3.6, Fourier transformed; an infinite G_i means a rigid body):

    C_L(k) = sum (1 - nu_i)/G_i / k    along k,        C_T(k) = sum 1/G_i / k    across k                                (1)

The traction (q_x, q_y) displaces one face relative to the other by

    u = [C_T I + (C_L - C_T) k k^T/k^2] q,    u_x = [S - N k_x^2/k^2] q_x/k - N k_x k_y q_y/k^3                           (2)
    S = sum 1/G_i,  N = sum nu_i/G_i;    for u_y exchange x and y.

Sign: u is the motion of the upper body relative to the lower one. The traction q acts on the upper body, against u. For a film,
C_L and C_T come from the layered half-space (see `layered.waves`). The model assumes that traction does not change the
pressure. This is exact for two bodies of one material and for an incompressible body on a rigid one (Johnson 1985, section
5.4).
"""

import math
from dataclasses import dataclass

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.layered.waves import CoatedBody, waves


@dataclass(frozen=True)
class HalfSpace:
    """Describe an elastic half-space.

    modulus: Young's modulus [Pa], > 0; infinite for a rigid body. poisson: Poisson's ratio, > -1, at most 1/2. Raises
    InputError for other values.
    """

    modulus: float
    poisson: float

    def __post_init__(self) -> None:
        if not self.modulus > 0.0:
            raise InputError("modulus", self.modulus, "> 0 Pa, or infinite for a rigid body")
        if not -1.0 < self.poisson <= 0.5:
            raise InputError("poisson", self.poisson, "above -1 and at most 0.5")

    @property
    def shear_modulus(self) -> float:
        """Return the shear modulus G = E/(2 (1 + nu)) [Pa]."""
        return self.modulus / (2.0 * (1.0 + self.poisson))


Body = HalfSpace | Film


@dataclass(frozen=True)
class ShearCompliance:
    """Describe the tangential compliance of two elastic bodies in contact.

    bodies: two, each a half-space or a film on a half-space. Raises InputError if both are rigid half-spaces.
    """

    bodies: tuple[Body, Body]

    def __post_init__(self) -> None:
        if all(isinstance(body, HalfSpace) and math.isinf(body.modulus) for body in self.bodies):
            raise InputError("bodies", InWords("both rigid"), "at least one elastic body")

    @property
    def layered(self) -> bool:
        """Return whether at least one body has a film."""
        return any(isinstance(body, Film) for body in self.bodies)

    @property
    def near(self) -> float:
        """Return the sum of 1/G over the two surface materials [1/Pa], with the shear modulus G.

        The surface material of a body with a film is the film.
        """
        of_films = (2.0 * (1.0 + body.poisson) / body.modulus for body in self.bodies if isinstance(body, Film))
        return self.sums[0] + sum(of_films)

    @property
    def sums(self) -> tuple[float, float]:
        """Return the sums of 1/G and of nu/G over those bodies that have no film [1/Pa].

        G: shear modulus. nu: Poisson's ratio.
        """
        bare = [body for body in self.bodies if isinstance(body, HalfSpace)]
        return sum(1.0 / body.shear_modulus for body in bare), sum(body.poisson / body.shear_modulus for body in bare)

    @property
    def at_zero(self) -> float:
        """Return the displacement per uniform traction [m/Pa].

        It is the sum of thickness divided by shear modulus for films on rigid substrates. It is 0 if any body or substrate is
        an elastic half-space, whose displacement under uniform traction is not defined.
        """
        films = [body for body in self.bodies if isinstance(body, Film)]
        if self.sums[0] > 0.0 or any(film.far > 0.0 for film in films):
            return 0.0
        return sum(film.thickness * 2.0 * (1.0 + film.poisson) / film.modulus for film in films)

    def times_k(self, k: np.ndarray) -> np.ndarray:
        """Return the compliances along and across a wave, times the wavenumber k: k C_L and k C_T [1/Pa], (2, ...).

        k: wavenumbers > 0 [1/m], (...).
        """
        S, N = self.sums
        total = np.empty((2, *np.shape(k)))
        total[0], total[1] = S - N, S
        for body in self.bodies:
            if isinstance(body, Film):
                total += _of_film(body, np.asarray(k, dtype=float))[:2]
        return total

    def coupling(self, k: np.ndarray) -> np.ndarray:
        """Return the coefficient M(k) [1/Pa] that couples pressure and shear, at wavenumbers k > 0 [1/m], any shape.

        A wave of pressure p shifts the faces relative to each other by M p/k. A wave of shear q moves them apart by M q/k. M is
        0 for two equal bodies.
        """
        total = np.zeros(np.shape(k))
        for sign, body in zip((1.0, -1.0), self.bodies, strict=True):
            if isinstance(body, Film):
                total += sign * _of_film(body, np.asarray(k, dtype=float))[2]
            else:
                total += sign * (1.0 - 2.0 * body.poisson) / (2.0 * body.shear_modulus)
        return total


def _of_film(film: Film, k: np.ndarray) -> np.ndarray:
    """Return k C_L, k C_T and M [1/Pa] of a film on its substrate at the wavenumbers k [1/m], shape (...): (3, ...).

    C_L and C_T are the tangential compliances along and across a wave. M/k is the tangential displacement per pressure of a
    wave.
    """
    coated = CoatedBody(film.plane_strain * film.far, film.poisson, film.substrate_poisson)
    values, place = np.unique(k * film.thickness, return_inverse=True)
    found = waves(values, coated)
    relative = np.stack([*found.surface_compliances(film.poisson), found.surface_coupling(film.poisson)])
    return relative[:, place.ravel()].reshape(3, *k.shape) * (2.0 * (1.0 + film.poisson) / film.modulus)
