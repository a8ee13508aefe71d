"""Compute the pressure at which a body yields below a harder film.

*Assumes*: A contact spot of radius a lies on a film of thickness t. The body flows when the largest von Mises stress below the
film equals the largest von Mises stress in the bare body under a mean pressure equal to its hardness. Stresses are those of a
Hertz contact on the axis of a half-space (Johnson, Contact Mechanics, 1985, eq. 3.45). The film is replaced by body material of
the thickness t_e = t (E_f/E_s)^(1/3), which has the same bending stiffness (Odemark's equivalent thickness, from memory; E_f,
E_s: moduli of film and body). With H_s the hardness of the body, z the depth divided by a, and nu its Poisson's ratio,

    p/H_s = max_z s(z)/max_{z >= t_e/a} s(z),   s(z) = 3/(2 (1 + z^2)) - (1 + nu)(1 - z arctan(1/z))

The result is 1 if t_e is below about a/2. The formula is this project's own and is a judgement (grade C): plasticity is not
solved.
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.solvers.layered.bodies import per_root

_NEAR = np.linspace(0.3, 0.7, 81)  # depths divided by the contact radius, among which the largest stress is searched
_DEEPEST = 1e3  # depth, divided by the contact radius, from which a body never yields before its film


def carried_at_depth(depth: np.ndarray, nu: np.ndarray) -> np.ndarray:
    """Return the pressure on a film at which the body below yields, divided by the body's hardness.

    depth: depth of the body's surface, divided by the contact radius. nu: Poisson's ratio of the body. Both are arrays of one
    shape.
    """
    largest = _stress(_NEAR, np.asarray(nu)[..., None])
    deepest = _NEAR[largest.argmax(axis=-1)]
    return largest.max(axis=-1) / _stress(np.clip(depth, deepest, _DEEPEST), nu)


def pressure_carried_below(spot: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the mean pressure (n, m) on a contact spot at which the body below the film yields, divided by its hardness.

    spot: contact area (n, m), divided by pi R sigma (R: asperity radius, sigma: standard deviation of the asperity heights).
    groups: dimensionless groups of n contacts.
    """
    whole = groups.resolved()
    radius = np.sqrt(spot) * per_root(whole)[:, None] ** 2
    depth = np.cbrt(np.reshape(whole.film_modulus, (-1, 1))) / np.maximum(radius, 1e-12)
    return carried_at_depth(depth, np.reshape(whole.coated_nu, (-1, 1)))


def _stress(z: np.ndarray, nu: np.ndarray) -> np.ndarray:
    """Return the von Mises stress on the axis of a Hertz contact, divided by the largest pressure.

    z: depth divided by the contact radius. nu: Poisson's ratio.
    """
    return 1.5 / (1.0 + z * z) - (1.0 + nu) * (1.0 - z * np.arctan2(1.0, z))
