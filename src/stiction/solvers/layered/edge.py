"""Compute the von Mises stress of a film at the trailing edge of a pressed and sheared sphere.

At this edge the square M of the von Mises stress is a quadratic form in the mean pressure s and the mean traction q,

    M = D (A s^2 + 2 B s q + q^2).

A, B and D depend on the contact radius divided by the film thickness. For small contacts they are the values of a half-space of
film material. For wide contacts the film is stretched like the surface below it. `Stresses` supplies the values between these
limits.
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from stiction.engine.one_thread import on_one_thread
from stiction.solvers.layered.bodies import Bodies
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.first_yield import forms_of, stretched
from stiction.solvers.layered.stresses import Radial, Stresses
from stiction.solvers.layered.waves import CoatedBody

FORMS, EDGE_TERMS = 3, 17
# Contact radii of the solutions, divided by the film thickness. The film's contribution to stresses has a relative error of
# exp(-_REACH).
_RADII = np.concatenate([[1e-5, 1e-4, 1e-3, 0.005, 0.02, 0.06], np.geomspace(0.14, 200.0, 21)])
_REACH = 12.0
# Weight that keeps the coefficients c_k small, because nothing else determines the curves beyond the solved radii.
_HOLD = 1e-3
_PLACE = np.array([1.0]), np.array([0.0])


@lru_cache(maxsize=256)
@on_one_thread
def edge_curves(bodies: Bodies) -> np.ndarray:
    """Return coefficients (FORMS, 2 + EDGE_TERMS) of the curves of ln D, A and B (edge stress) against contact size.

    Each curve has one row. A row holds the limits f (a half-space of film material) and g (a film of zero thickness), then the
    c_k of the curve (1 - z)/2 f + (1 + z)/2 g + (1 - z^2) Sum c_k z^k. z = (q - 1)/(q + 1), q = sqrt(contact radius / film
    thickness). If two coated bodies differ, the values at each contact radius are those of the body whose film has the higher
    stress under traction.
    """
    each = [_of_body(bodies, body) for body in dict.fromkeys(bodies.coated)]
    rows = np.stack(each)
    worse = np.take_along_axis(rows, rows[:, :, :1].argmax(axis=0)[None], axis=0)[0]
    root = np.sqrt(_RADII)
    z = (root - 1.0) / (root + 1.0)
    ends, inner = worse[[0, -1]], worse[1:-1]
    left = inner - np.outer((1.0 - z) / 2.0, ends[0]) - np.outer((1.0 + z) / 2.0, ends[1])
    held = np.concatenate([chebyshev.chebvander(z, EDGE_TERMS - 1), _HOLD * np.eye(EDGE_TERMS)])
    wanted = np.concatenate([left / (1.0 - z * z)[:, None], np.zeros((EDGE_TERMS, FORMS))])
    series = np.linalg.lstsq(held, wanted, rcond=None)[0]
    powers = np.stack([np.pad(p, (0, EDGE_TERMS - p.size)) for p in map(chebyshev.cheb2poly, series.T)])
    return np.column_stack([*ends, powers])


def _of_body(bodies: Bodies, body: CoatedBody) -> np.ndarray:
    """Return the coefficients ln D, A and B of the stress at the trailing edge of one coated body.

    The result (len(_RADII) + 2, FORMS) has a row for each contact radius, and ln D, A and B as columns. The first row is for an
    infinitely thick film, the last for a film of zero thickness, the others for the solved contact radii between.
    """
    solved = [_forms(Stresses(bodies.pair, body, float(radius), _REACH).in_film(*_PLACE)) for radius in _RADII]
    return np.array([_forms(half_space(body.nu)), *solved, _forms(stretched(half_space(body.nu_below), body))])


@lru_cache(maxsize=64)
def half_space(nu: float) -> Radial:
    """Return the stresses at the contact edge, on the surface of a half-space with Poisson's ratio nu.

    A pressed and dragged sphere causes the stresses, which are divided by the mean pressure.
    """
    return Stresses((Layer.of(1.0, 1.0, nu, nu),), CoatedBody(1.0, nu, nu), 0.5).in_film(*_PLACE)


def _forms(radial: Radial) -> tuple[float, float, float]:
    """Return ln D, A and B, which determine the squared von Mises stress at the trailing edge.

    The equation is that of the module docstring. radial: stresses at the contact edge. At the trailing edge the stress under
    traction is largest.
    """
    A, B, D, _ = (float(form[0, 0]) for form in forms_of(radial))
    return np.log(D), A / D, -B / D
