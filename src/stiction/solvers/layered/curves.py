"""Fit the response of a pair of layered bodies at every contact radius a by three smooth curves.

The curves are ln E_P, ln D and ln B of `sphere.Response` (moduli of load and contact edge, and factor of the approach) against
z = (q - 1)/(q + 1), q = sqrt(a/t), with the film thickness t. At z = -1 only the film matters, at z = 1 only the body below.
For E = E_P or B

    ln E = (1 + z)/2 ln(E at z = 1) + (1 - z^2) Sum_k c_k z^k

(D is 1 at both ends). The c_k are fitted to exact solutions and to their slopes, so that load, approach and stiffness are
consistent. With e = d ln E_P/d ln a and d = d ln D/d ln a, dP/d delta = S becomes an identity of the curves (P: load, delta:
approach, S = 2 a E_S: stiffness),

    E_S = E_P (1 + e/3)/(D (1 + d/2)).

The curves and their slopes are continuous from a/t = 0 to infinity. The film alone and the substrate alone are exact. Between
them the error is at most 0.2 % in E_P, D and E_S, and 0.5 % in B, for a ratio of moduli of 0.01 to 100 and a/t up to 1000
(tests/contact/test_layered_sphere.py).
"""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from stiction.engine.one_thread import on_one_thread
from stiction.solvers.layered.compliance import Pair, modulus_without_film
from stiction.solvers.layered.many_spheres import STIFFEST, respond_many
from stiction.solvers.layered.sphere import Response, respond

CURVES, TERMS = 3, 19
# Contact radii of the exact solutions, divided by the film thickness (the same for all films).
RADII = np.concatenate([[1e-5, 1e-4, 5e-4], np.geomspace(0.002, 600.0, 24)])
# Smallest number of pairs that are solved together, because this is then faster than one by one.
_MANY = 64
# Weight of a slope relative to a value in the fit.
_SLOPE = 0.3
# Coefficients of Chebyshev's polynomials in powers of z, one row for each polynomial.
POWERS = np.array(
    [np.pad(chebyshev.cheb2poly(row), (0, TERMS - 1 - order)) for order, row in enumerate(np.tri(TERMS) - np.tri(TERMS, k=-1))]
)


@lru_cache(maxsize=1024)
@on_one_thread
def _solved(pair: Pair) -> tuple[float, ...]:
    return tuple(fit(np.array([respond(pair, radius) for radius in RADII]), modulus_without_film(pair)).ravel())


def curves(pair: Pair) -> np.ndarray:
    """Return the coefficients (CURVES, TERMS) of the curves ln E_P, ln D and ln B for a pair of coated bodies.

    E_P is the contact modulus of the load, D the factor of the approach D a^2/R (a: contact radius, R: sphere radius), and B
    half the derivative of the contact stiffness with respect to the contact radius. Exact solutions are cached for each pair.
    Two rigid bodies are not supported, because their modulus without films is infinite.
    """
    return np.array(_solved(pair)).reshape(CURVES, TERMS)


def curves_of_pairs(pairs: Sequence[Pair]) -> np.ndarray:
    """Return the coefficients (n, CURVES, TERMS) of n pairs of bodies, as `curves` does for one.

    Many pairs are solved together, which is ten times faster. Films that are too stiff for this are solved one by one.
    """
    together = [i for i, pair in enumerate(pairs) if all(film.ratio <= STIFFEST for film in pair)]
    solved = _solved_together(tuple(pairs[i] for i in together)) if len(together) >= _MANY else np.empty(0)
    at = {i: row for i, row in zip(together, solved, strict=False)}
    return np.array([at[i] if i in at else curves(pair) for i, pair in enumerate(pairs)]).reshape(-1, CURVES, TERMS)


@lru_cache(maxsize=4)
@on_one_thread
def _solved_together(pairs: tuple[Pair, ...]) -> np.ndarray:
    responses = respond_many(pairs, RADII)
    return np.array([fit(solved, modulus_without_film(pair)) for solved, pair in zip(responses, pairs, strict=True)])


def fit(solved: np.ndarray, below: float) -> np.ndarray:
    """Fit the coefficients (CURVES, TERMS) of the curves ln E_P, ln D and ln B to exact solutions at the contact radii RADII.

    solved: fields of `sphere.Response` (radii, 7). below: contact modulus of the bodies without films, divided by the contact
    modulus of half-spaces of the surface materials.
    """
    at = {name: column for name, column in zip(Response._fields, solved.T, strict=True)}
    ends = {"load": np.log(below), "approach": 0.0, "edge": np.log(below)}
    return np.stack([fit_one(np.log(at[name]), at[f"{name}_slope"], rise) for name, rise in ends.items()])


def fit_one(values: np.ndarray, slopes: np.ndarray, rise: float) -> np.ndarray:
    """Fit the coefficients (TERMS,) of one curve to its values and slopes at the contact radii RADII.

    slopes: derivatives with respect to the logarithm of the contact radius. rise: value of the curve at very large radii; at
    very small radii it is 0.
    """
    root = np.sqrt(RADII)
    z = (root - 1.0) / (root + 1.0)
    by_radius = (1.0 - z * z) / 4.0  # dz/d ln a
    value, slope = _basis(z)
    table = np.concatenate([value, _SLOPE * by_radius[:, None] * slope])
    wanted = np.concatenate([values - 0.5 * (1.0 + z) * rise, _SLOPE * (slopes - 0.5 * rise * by_radius)])
    return np.linalg.lstsq(table, wanted, rcond=1e-12)[0] @ POWERS


def _basis(z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the fit functions (1 - z^2) T_k(z) at z (n,), and their derivatives with respect to z: (n, TERMS) each.

    T_k: Chebyshev polynomials.
    """
    unit = np.eye(TERMS)
    value = chebyshev.chebval(z, unit).T
    slope = chebyshev.chebval(z, chebyshev.chebder(unit)).T
    window = (1.0 - z * z)[:, None]
    return window * value, window * slope - 2.0 * z[:, None] * value
