r"""How stiff a round contact of bodies with a film is against a tangential displacement, all of it in stick.

The surface moves by delta in the direction x everywhere on the contact. The traction that this takes is not only along x, of
the transform Q0(k): where a wave along itself and across itself meets compliances C_L(k)/k and C_T(k)/k in another ratio than
on a half-space, it has a second harmonic too, of transform Q2(k). Of a wave in the direction phi, (Q0 - Q2) cos(phi) is along
and -(Q0 + Q2) sin(phi) across it, so that for all tractions q0, q2 on the contact (Galerkin's equations)

    (2/pi) Integral C_L (q0 - q2)(Q0 - Q2) + C_T (q0 + q2)(Q0 + Q2) dk = (4/pi) delta q0(0),   T = 2 pi Q0(0).

Q0 is made of the spherical Bessel functions of orders 0, 2, 4 ..., Q2 of 2, 4, 6 ...: tractions on the unit circle. A
half-space has Q0 of order 0 alone and T = 8 delta/(C_L + C_T), which is Mindlin's 8 a/beta. As in Mindlin's, the tangential
traction is taken to leave the pressure alone. Derived here; the half-space is Mindlin (1949).
"""

from functools import lru_cache

import numpy as np

from stiction.engine.one_thread import on_one_thread
from stiction.solvers.layered.bodies import Bodies
from stiction.solvers.layered.curves import RADII, fit_one
from stiction.solvers.layered.sphere import spherical_waves
from stiction.solvers.layered.waves import waves

_STEP = 1e-4  # of ln x, for slopes of compliances


def shear_ends(bodies: Bodies) -> tuple[float, float]:
    """Return K beta where only the film is felt, and without it.

    K is 4/3 of the modulus of both bodies without a film.
    """
    film = _of_surfaces(bodies, *np.array([[1.0 - body.nu, 1.0] for body in bodies.coated]))
    below = [np.array([1.0 - body.nu_below, 1.0]) * body.shear_ratio for body in bodies.coated]
    return 4.0 / 3.0 * float(film.sum()), 4.0 / 3.0 * float(_of_surfaces(bodies, *below).sum())


def shear_compliance(bodies: Bodies, radius: float) -> tuple[float, float]:
    """Return K beta in T = 8 a delta/beta, and its slope d ln beta/d ln a.

    At the contact radius a over the thickness of one film.
    """
    k, weights, even = spherical_waves(radius)
    x = k / radius
    far = _of_surfaces(bodies, *np.array([[1.0 - body.nu, 1.0] for body in bodies.coated]))
    near, lower, higher = (_compliances(bodies, x * step) for step in (1.0, np.exp(-_STEP), np.exp(_STEP)))
    matrix = _matrix(weights, even, near - far[:, None])
    matrix += _matrix_of_half_space(len(even), far)
    solution = np.linalg.solve(matrix, np.eye(len(matrix))[0])
    slope = solution @ _matrix(weights, even, (lower - higher) / (2.0 * _STEP)) @ solution
    return 4.0 / 3.0 / float(solution[0]), float(slope / solution[0])


@lru_cache(maxsize=256)
@on_one_thread
def shear_curve(bodies: Bodies) -> np.ndarray:
    """Return coefficients (TERMS,) of ln beta, as those of `curves`.

    ln beta = (1 - z)/2 ln(film's) + (1 + z)/2 ln(without) + (1 - z^2) Sum c_k z^k.
    """
    solved = np.array([shear_compliance(bodies, radius) for radius in RADII])
    film, below = np.log(shear_ends(bodies))
    return fit_one(np.log(solved[:, 0]) - film, solved[:, 1], below - film)


def _of_surfaces(bodies: Bodies, *of_films: np.ndarray) -> np.ndarray:
    """Return C_L and C_T (2, ...) of both bodies.

    From those of each coated body times the shear modulus of its film.
    """
    per_film = 2.0 / bodies.film_modulus
    bare = 2.0 * bodies.bare_share * np.array([1.0, 1.0 / (1.0 - bodies.bare_nu)])
    total = sum(per_film / (1.0 - body.nu) * compliance for body, compliance in zip(bodies.coated, of_films, strict=True))
    return total + bare.reshape(2, *(1,) * (np.ndim(total) - 1))


def _compliances(bodies: Bodies, x: np.ndarray) -> np.ndarray:
    """Return C_L and C_T of the waves x = k t (2, m)."""
    return _of_surfaces(bodies, *(waves(x, body).surface_compliances(body.nu) for body in bodies.coated))


def _matrix(weights: np.ndarray, even: np.ndarray, compliances: np.ndarray) -> np.ndarray:
    """Return Galerkin's matrix of both harmonics for these compliances (2, m)."""
    along, across = compliances
    first, second = even[:-1], even[1:]
    total, difference = weights * (along + across), weights * (along - across)
    mixed = -(first * difference) @ second.T
    return np.block([[(first * total) @ first.T, mixed], [mixed.T, (second * total) @ second.T]])


def _matrix_of_half_space(count: int, compliances: np.ndarray) -> np.ndarray:
    """Return Galerkin's matrix of a half-space in closed form.

    The functions are orthonormal, and those of both harmonics are the same but for one.
    """
    along, across = compliances
    mixed = (across - along) * np.eye(count - 1, k=-1)
    return np.block([[(along + across) * np.eye(count - 1), mixed], [mixed.T, (along + across) * np.eye(count - 1)]])
