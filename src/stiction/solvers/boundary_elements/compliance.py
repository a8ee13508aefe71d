"""Compute the compliance of elastic bodies to a pressure wave: normal displacement per pressure at the wavenumber k.

Half-space (Johnson 1985, Contact Mechanics, section 13.2; plane-strain modulus E* = E/(1 - nu^2), for a pair of bodies 1/E* is
the sum):

    C(k) = 2 / (E* k)                                                                                                     (1)

For a film of thickness t (index 1) bonded to a half-space (index 2), without shear on its face, let x = k t, and G = mu1/mu2
the ratio of the shear moduli. This is one wave of the layered half-space of O'Sullivan & King (1988, J. Tribology 110, 235), in
the notation of Nogi & Kato (1997, J. Tribology 119, 493):

    C(k) = 2/(E1* k) [1 + 4 x K e^(-2x) - L K e^(-4x)] / [1 - (L + K + 4 K x^2) e^(-2x) + L K e^(-4x)]                    (2)
    L = 1 - 4 (1 - nu1) / (1 + G (3 - 4 nu2)),          K = (G - 1) / (G + 3 - 4 nu1)

Grade B: (2) was not compared with the printed equations. Tests compare it with a direct solution of the six boundary conditions
of one wave. (2) becomes (1) of the substrate for t -> 0, or for G = 1 and nu1 = nu2, and (1) of the film for t -> infinity. G =
0 is a film on a rigid base, and nu1 = 1/2 an incompressible film.

With y = 2x, numerator and denominator of (2) are multiplied by e^y. This avoids differences of nearly equal numbers as x -> 0.
In that limit the compliance of a film on a rigid base is proportional to t, or to k^2 t^3 if the film is incompressible:

    numerator   = (1 - LK) cosh y + (1 + LK) (sinh y - y) + (1 + LK + 2K) y                                               (3)
    denominator = (1 + LK) (cosh y - 1) + (1 - LK) sinh y + (1 - L)(1 - K) - K y^2
"""

import math
from dataclasses import dataclass

import numpy as np

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import require_positive

_LARGE = 1.0  # value of y above which (2) loses no digits, because e^-y is well below 1
_SERIES = 1.0 / np.cumprod([6.0, *((2 * n) * (2 * n + 1) for n in range(2, 10))])  # series of sinh y - y: y^3/3! + y^5/5! + ...


@dataclass(frozen=True)
class Film:
    """Describe an elastic film bonded to an elastic half-space.

    thickness: [m], > 0. modulus, poisson: Young's modulus [Pa], > 0, and Poisson's ratio (-1 to 1/2; 1/2 is incompressible) of
    the film. substrate_modulus, substrate_poisson: the same constants of the half-space; an infinite modulus means rigid.
    Raises InputError for other values.
    """

    thickness: float
    modulus: float
    poisson: float
    substrate_modulus: float
    substrate_poisson: float

    def __post_init__(self) -> None:
        require_positive(**{"film.thickness": self.thickness, "film.modulus": self.modulus})
        if not self.substrate_modulus > 0.0:
            raise InputError("film.substrate_modulus", self.substrate_modulus, "> 0 Pa, or infinite for a rigid body")
        for name in ("poisson", "substrate_poisson"):
            if not (-1.0 < getattr(self, name) <= 0.5):
                raise InputError(f"film.{name}", getattr(self, name), "above -1 and at most 0.5")

    @property
    def plane_strain(self) -> float:
        """Return the plane-strain modulus E1* = E/(1 - nu^2) of the film [Pa]."""
        return self.modulus / (1.0 - self.poisson**2)

    @property
    def far(self) -> float:
        """Return k/2 times the compliance in the limit of long wavelengths [1/Pa], where k is the wavenumber.

        It equals 1/E2*, where E2* is the plane-strain modulus of the substrate; it is 0 for a rigid substrate.
        """
        return (1.0 - self.substrate_poisson**2) / self.substrate_modulus

    @property
    def at_zero(self) -> float:
        """Return the displacement per uniform pressure [m/Pa] of a film on a rigid base.

        It is the thickness divided by the oedometric modulus (1 - nu) E/((1 + nu)(1 - 2 nu)), with Young's modulus E and
        Poisson's ratio nu of the film.
        """
        nu = self.poisson
        return self.thickness / self.modulus * (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu)

    def over_half_space(self, k: np.ndarray) -> np.ndarray:
        """Return the compliance of the film on its substrate, divided by the compliance of a half-space of film material.

        k: wavenumbers > 0 [1/m], any shape. The result, of the same shape, is equation (2) of this module divided by
        2/(E1* k), with the plane-strain modulus E1* of the film.
        """
        parts = self._parts()
        y = 2.0 * self.thickness * np.asarray(k, dtype=float)
        ratio = np.empty_like(y)
        small = y < _LARGE
        ratio[small] = _near(y[small], *parts)
        ratio[~small] = _away(y[~small], *parts)
        return ratio

    def _parts(self) -> tuple[float, float, float, float, float]:
        """Return L, K, 1 - LK, 1 + LK + 2K and (1 - L)(1 - K), numbers that compare the elasticity of film and substrate.

        L and K are defined by equation (2) of this module. The last three are computed without differences of nearly equal
        numbers.
        """
        nu1, nu2 = self.poisson, self.substrate_poisson
        shear = self.modulus / self.substrate_modulus * (1.0 + nu2) / (1.0 + nu1)
        below, film = 1.0 + shear * (3.0 - 4.0 * nu2), shear + 3.0 - 4.0 * nu1
        one_less_l, one_less_k = 4.0 * (1.0 - nu1) / below, 4.0 * (1.0 - nu1) / film
        one_less_lk = one_less_k * shear * 4.0 * (1.0 - nu2) / below
        linear = 4.0 * (shear + 1.0 - 2.0 * nu1) / film - one_less_lk
        return 1.0 - one_less_l, (shear - 1.0) / film, one_less_lk, linear, one_less_l * one_less_k


def _near(y, _, k, one_less_lk, linear, constant):
    """Return the compliance of a film on its substrate relative to a half-space of film material, for long waves.

    y: 2 t times the wavenumber, below 1, with the film thickness t. The other arguments are L (not used), K (named k), 1 - LK,
    1 + LK + 2K and (1 - L)(1 - K). This is equation (3) of this module, which loses no digits for small y.
    """
    sine = y**3 * np.polynomial.polynomial.polyval(y * y, _SERIES)
    rest = 2.0 - one_less_lk
    above = one_less_lk * np.cosh(y) + rest * sine + linear * y
    below = rest * 2.0 * np.sinh(0.5 * y) ** 2 + one_less_lk * np.sinh(y) + constant - k * y * y
    return above / below


def _away(y, el, k, *_):
    """Return the compliance of a film on its substrate relative to a half-space of film material, for short waves.

    y: 2 t times the wavenumber, 1 or more, with the film thickness t. el, k: the numbers L and K of equation (2) of this
    module, which is evaluated here.
    """
    once = np.exp(-y)
    return (1.0 + 2.0 * y * k * once - el * k * once**2) / (1.0 - (el + k + k * y * y) * once + el * k * once**2)


@dataclass(frozen=True)
class Compliance:
    """Describe the normal compliance of two bodies in contact, each with or without a film.

    modulus: contact modulus E* [Pa] of the uncoated bodies: of both bodies, or of the only body without a film. It is infinite
    if both bodies have films, or if the uncoated bodies are rigid. film, counter_film: film on the first and on the second
    body, each with its own half-space below, or None. Raises InputError unless the modulus is > 0, and finite if there is no
    film.
    """

    modulus: float
    film: Film | None = None
    counter_film: Film | None = None

    def __post_init__(self) -> None:
        if not self.modulus > 0.0 or (not self.films and math.isinf(self.modulus)):
            raise InputError("modulus", self.modulus, "> 0 Pa; infinite only with a film")

    @property
    def films(self) -> tuple[Film, ...]:
        """Return the films, at most two."""
        return tuple(film for film in (self.film, self.counter_film) if film is not None)

    @property
    def near(self) -> float:
        """Return the compliance at short wavelengths, times half the wavenumber [1/Pa].

        It is 1/E* of the two surface materials; the surface material of a coated body is its film.
        """
        return 1.0 / self.modulus + sum(1.0 / film.plane_strain for film in self.films)

    @property
    def far(self) -> float:
        """Return the compliance at long wavelengths, times half the wavenumber [1/Pa].

        It is 1/E* of both bodies with their films removed, and 0 if both are then rigid.
        """
        return 1.0 / self.modulus + sum(film.far for film in self.films)

    @property
    def depth(self) -> float:
        """Return the thickness of the thickest film [m], 0 without a film."""
        return max((film.thickness for film in self.films), default=0.0)

    def times_half_k(self, k: np.ndarray) -> np.ndarray:
        """Return the compliance C(k) of both bodies (displacement per pressure) times k/2 [1/Pa].

        k: wavenumbers > 0 [1/m], any shape. The result has the same shape.
        """
        total = np.full(np.shape(k), 1.0 / self.modulus)
        for film in self.films:
            total += film.over_half_space(k) / film.plane_strain
        return total

    def at(self, k: np.ndarray) -> np.ndarray:
        """Return the compliance C(k) of both bodies together: displacement per pressure [m/Pa].

        k: wavenumbers >= 0 [1/m], any shape. At k = 0 the result is the limit if this is finite, and 0 otherwise: the mean
        displacement of half-spaces is not finite.
        """
        k = np.asarray(k, dtype=float)
        positive = k > 0.0
        safe = np.where(positive, k, 1.0)
        at_zero = 0.0 if self.far > 0.0 else sum(film.at_zero for film in self.films)
        return np.where(positive, 2.0 * self.times_half_k(safe) / safe, at_zero)
