"""Compute the tangential force at which a coated contact yields at its trailing edge (von Mises).

The stresses there come from `solvers.layered.edge`.
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.tangential.shared.edge_yield import coefficients
from stiction.solvers.layered.bodies import bodies_of, per_root
from stiction.solvers.layered.edge import EDGE_TERMS, FORMS, edge_curves

_WIDTH = 2 + EDGE_TERMS
# Positions in a row at which the curves of ln D, A and B begin, and at which the last one ends.
_D, _A, _B, _END = (2 + at * _WIDTH for at in range(FORMS + 1))


@formula
def _curve(z, row):
    value = 0.0
    for k in range(EDGE_TERMS - 1, -1, -1):
        value = value * z + row[2 + k]
    return 0.5 * (1.0 - z) * row[0] + 0.5 * (1.0 + z) * row[1] + (1.0 - z * z) * value


@formula
def edge_root(u, load, area, row):
    """Return the discriminant and the larger root T of the yield condition at the trailing edge of a coated contact.

    The condition is D (A P^2 + 2 B P T + T^2) = S^2. P: load. T: tangential force, valid if both returned numbers are
    positive. S: yield stress times contact area. A, B, D: functions of contact radius divided by film thickness. u:
    coordinate, u^4 = a^2/(R sigma) with the contact radius a. row: parameters from `edge_columns`. Units: load and T in K
    R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    z = 1.0 - 2.0 / (row[1] * u + 1.0)
    A, B = _curve(z, row[_A:_B]), _curve(z, row[_B:_END])
    strength = row[0] * area
    part = strength * strength * math.exp(-_curve(z, row[_D:_A]))
    discriminant = part + (B * B - A) * load * load
    return discriminant, math.sqrt(max(discriminant, 0.0)) - B * load


def edge_columns(groups: Groups) -> tuple[np.ndarray, ...]:
    """Return the parameters of `edge_root`, each an array (n,), for yield at the trailing edge of a contact with a film.

    groups: dimensionless groups of n contacts with all defaults filled in, from `Groups.resolved`. If the film thickness is 0,
    the parameters describe the bare body.
    """
    laws = len(groups)
    different, which = bodies_of(groups)
    curves = np.array([edge_curves(materials) for materials in different])[which]
    there = np.broadcast_to((groups.film_aspect > 0.0) & (groups.tau > 0.0), laws)
    curves[~there] = _of_half_space(np.broadcast_to(groups.nu, laws)[~there])
    strength = np.where(there, groups.n_H, 1.0) * groups.eta / groups.hardness_to_yield
    return np.broadcast_to(strength, laws), per_root(groups), *curves.reshape(laws, -1).T


def _of_half_space(nu: np.ndarray) -> np.ndarray:
    """Return the curves of ln D, A and B (n, FORMS, 2 + EDGE_TERMS) for uniform half-spaces with Poisson's ratios nu (n,).

    A, B, D: coefficients of the squared von Mises stress at the trailing edge, as in `edge_root`. These curves do not depend on
    the contact radius.
    """
    n, p, q = coefficients(nu)
    d = p * p + q * q - p * q
    curves = np.zeros((len(nu), FORMS, _WIDTH))
    values = np.log(math.pi**2 * d), 3.0 * n * n / d, 1.5 * n * (p - q) / d
    curves[:, :, :2] = np.stack(values, axis=1)[:, :, None]
    return curves
