"""Compute the tangential force at which a coated contact yields at its trailing edge, from `solvers.layered.edge`."""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.tangential.shared.edge_yield import coefficients
from stiction.solvers.layered.bodies import bodies_of, per_root
from stiction.solvers.layered.edge import EDGE_TERMS, FORMS, edge_curves

_WIDTH = 2 + EDGE_TERMS
# Where ln D, A and B begin and end in a row.
_D, _A, _B, _END = (2 + at * _WIDTH for at in range(FORMS + 1))


@formula
def _curve(z, row):
    value = 0.0
    for k in range(EDGE_TERMS - 1, -1, -1):
        value = value * z + row[2 + k]
    return 0.5 * (1.0 - z) * row[0] + 0.5 * (1.0 + z) * row[1] + (1.0 - z * z) * value


@formula
def edge_root(u, load, area, row):
    """Return the discriminant and the larger root T of D (A P^2 + 2 B P T + T^2) = S^2.

    S: yield stress times contact area. The force T is valid if both numbers are positive, as `Force` requires. row: parameters
    from `edge_columns`.
    """
    z = 1.0 - 2.0 / (row[1] * u + 1.0)
    A, B = _curve(z, row[_A:_B]), _curve(z, row[_B:_END])
    strength = row[0] * area
    part = strength * strength * math.exp(-_curve(z, row[_D:_A]))
    discriminant = part + (B * B - A) * load * load
    return discriminant, math.sqrt(max(discriminant, 0.0)) - B * load


def edge_columns(groups: Groups) -> tuple[np.ndarray, ...]:
    """Return the parameters (n,) of `edge_root`, for yield at the edge of a contact with a film.

    groups: complete groups, from `Groups.resolved`. For contacts without a film the parameters describe the body.
    """
    laws = len(groups)
    different, which = bodies_of(groups)
    curves = np.array([edge_curves(materials) for materials in different])[which]
    there = np.broadcast_to((groups.film_aspect > 0.0) & (groups.tau > 0.0), laws)
    curves[~there] = _of_half_space(np.broadcast_to(groups.nu, laws)[~there])
    strength = np.where(there, groups.n_H, 1.0) * groups.eta / groups.hardness_to_yield
    return np.broadcast_to(strength, laws), per_root(groups), *curves.reshape(laws, -1).T


def _of_half_space(nu: np.ndarray) -> np.ndarray:
    """Return the curves of ln D, A and B (n, FORMS, ...) for half-spaces with Poisson's ratios nu (n,)."""
    n, p, q = coefficients(nu)
    d = p * p + q * q - p * q
    curves = np.zeros((len(nu), FORMS, _WIDTH))
    values = np.log(math.pi**2 * d), 3.0 * n * n / d, 1.5 * n * (p - q) / d
    curves[:, :, :2] = np.stack(values, axis=1)[:, :, None]
    return curves
