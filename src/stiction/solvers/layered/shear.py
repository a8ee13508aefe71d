"""Compute the tangential stiffness of a round contact between coated bodies, with full stick.

Every point of the contact, of radius 1, moves by delta in the direction x. The traction has a component along x with the Hankel
transform Q0(k) (k: wavenumber). A second harmonic Q2(k) is added, because the compliances C_L(k)/k along a wave and C_T(k)/k
across it have a different ratio than on a half-space. For a wave in the direction phi, (Q0 - Q2) cos(phi) is along the wave and
-(Q0 + Q2) sin(phi) across it. By Galerkin's method, the following holds for the transforms q0(k), q2(k) of all test tractions

    (2/pi) Integral C_L (q0 - q2)(Q0 - Q2) + C_T (q0 + q2)(Q0 + Q2) dk = (4/pi) delta q0(0),   T = 2 pi Q0(0).

T is the tangential force. Q0 is a sum of the spherical Bessel functions of orders 0, 2, 4 ..., and Q2 of orders 2, 4, 6 ....
These are transforms of tractions inside the unit circle. On a half-space Q0 has order 0 only, and T = 8 delta/(C_L + C_T),
which is Mindlin's 8 a/beta (a: contact radius, beta: tangential compliance). As in Mindlin's theory, the traction is assumed
not to change the pressure. The equation is derived here; the half-space is the case of Mindlin (1949).
"""

from functools import lru_cache

import numpy as np

from stiction.engine.one_thread import on_one_thread
from stiction.solvers.layered.bodies import Bodies
from stiction.solvers.layered.curves import RADII, fit_one
from stiction.solvers.layered.sphere import spherical_waves
from stiction.solvers.layered.waves import waves

_STEP = 1e-4  # difference of ln x for numerical derivatives of compliances


def shear_ends(bodies: Bodies) -> tuple[float, float]:
    """Return the normal-tangential stiffness product K beta of very small and of very large contacts.

    Very small contacts depend on the film only, very large ones on the bodies below only. K is 4/3 of the contact modulus of
    the bodies without a film. beta is the tangential compliance in T = 8 a delta/beta, with force T, contact radius a and
    displacement delta.
    """
    film = _of_surfaces(bodies, *np.array([[1.0 - body.nu, 1.0] for body in bodies.coated]))
    below = [np.array([1.0 - body.nu_below, 1.0]) * body.shear_ratio for body in bodies.coated]
    return 4.0 / 3.0 * float(film.sum()), 4.0 / 3.0 * float(_of_surfaces(bodies, *below).sum())


def shear_compliance(bodies: Bodies, radius: float) -> tuple[float, float]:
    """Return the product K beta and the slope d ln beta/d ln a of a sticking contact of radius a.

    beta is the tangential compliance in T = 8 a delta/beta, with force T and displacement delta. K is 4/3 of the contact
    modulus of the bodies without a film. radius: a divided by the film thickness (the same for all films).
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
    """Return the coefficients c_k (TERMS,) of the curve of ln(K beta) against contact size.

    K beta: 4/3 of the contact modulus without a film, times the tangential compliance beta of T = 8 a delta/beta (force T,
    contact radius a, displacement delta). ln(K beta) = (1 - z)/2 ln(film only) + (1 + z)/2 ln(no film) + (1 - z^2) Sum c_k z^k,
    with the limits from `shear_ends` and z = (q - 1)/(q + 1), where q = sqrt(a/t) with contact radius a and film thickness t.
    """
    solved = np.array([shear_compliance(bodies, radius) for radius in RADII])
    film, below = np.log(shear_ends(bodies))
    return fit_one(np.log(solved[:, 0]) - film, solved[:, 1], below - film)


def _of_surfaces(bodies: Bodies, *of_films: np.ndarray) -> np.ndarray:
    """Return the tangential compliances C_L (along a wave) and C_T (across it) of both bodies together: (2, ...).

    The result is multiplied by the contact modulus of the bodies without films and so has no unit. of_films: C_L and C_T of
    each coated body, multiplied by the shear modulus of its film.
    """
    per_film = 2.0 / bodies.film_modulus
    bare = 2.0 * bodies.bare_share * np.array([1.0, 1.0 / (1.0 - bodies.bare_nu)])
    total = sum(per_film / (1.0 - body.nu) * compliance for body, compliance in zip(bodies.coated, of_films, strict=True))
    return total + bare.reshape(2, *(1,) * (np.ndim(total) - 1))


def _compliances(bodies: Bodies, x: np.ndarray) -> np.ndarray:
    """Return the tangential compliances C_L (along a wave) and C_T (across it) of both bodies together, as an array (2, m).

    They are multiplied by the contact modulus of the bodies without films. x (m,): wavenumbers times the film thickness.
    """
    return _of_surfaces(bodies, *(waves(x, body).surface_compliances(body.nu) for body in bodies.coated))


def _matrix(weights: np.ndarray, even: np.ndarray, compliances: np.ndarray) -> np.ndarray:
    """Return Galerkin's matrix (2 n - 2, 2 n - 2) of the sticking contact.

    weights (m,): integration weights of the m wavenumbers. even (n, m): transforms of the traction functions; the first n - 1
    represent the first harmonic, the last n - 1 the second. compliances (2, m): tangential compliances C_L along a wave and C_T
    across it.
    """
    along, across = compliances
    first, second = even[:-1], even[1:]
    total, difference = weights * (along + across), weights * (along - across)
    mixed = -(first * difference) @ second.T
    return np.block([[(first * total) @ first.T, mixed], [mixed.T, (second * total) @ second.T]])


def _matrix_of_half_space(count: int, compliances: np.ndarray) -> np.ndarray:
    """Return Galerkin's matrix of the sticking contact on a half-space, in closed form.

    count: number of orthonormal traction functions; each harmonic uses count - 1 of them, so the matrix has 2 (count - 1) rows.
    The first harmonic leaves out the last function, the second harmonic the first. compliances: along and across a wave, the
    same at all wavenumbers.
    """
    along, across = compliances
    mixed = (across - along) * np.eye(count - 1, k=-1)
    return np.block([[(along + across) * np.eye(count - 1), mixed], [mixed.T, (along + across) * np.eye(count - 1)]])
