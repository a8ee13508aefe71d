r"""The pressure that a yielding body carries through a harder film: a spot of radius a on a film of thickness t.

*Assumes*: the body flows under a spot where the von Mises stress, at the depth of its surface, is what it is somewhere under a
spot on the bare body that bears its hardness. Stresses are Hertz's on the axis of a half-space (Johnson, Contact Mechanics,
1985, eq. 3.45), the film replaced by one of the body's modulus and the thickness t_e = t (E_f/E_s)^(1/3), which bends as
stiffly (Odemark's equivalent thickness, from memory). Over the hardness of the body, with z the depth over a,

    p/H_s = max_z s(z)/max_{z >= t_e/a} s(z),   s(z) = 3/(2 (1 + z^2)) - (1 + nu)(1 - z arctan(1/z))

which is 1 where t_e is below about a/2. This project's own, grade C: plasticity is not solved.
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.solvers.layered.bodies import per_root

_NEAR = np.linspace(0.3, 0.7, 81)  # depths over a: of the largest stress
_DEEPEST = 1e3  # from there on no body below yields before its film does


def carried_at_depth(depth: np.ndarray, nu: np.ndarray) -> np.ndarray:
    """Return the pressure at which the body below flows, divided by its hardness.

    depth: of the body's surface divided by the contact radius; nu: Poisson's ratio. Arrays.
    """
    largest = _stress(_NEAR, np.asarray(nu)[..., None])
    deepest = _NEAR[largest.argmax(axis=-1)]
    return largest.max(axis=-1) / _stress(np.clip(depth, deepest, _DEEPEST), nu)


def pressure_carried_below(spot: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the pressure at which the body below the film flows, divided by the hardness H, shape (n, m).

    spot: contact area divided by pi R sigma, shape (n, m).
    """
    whole = groups.resolved()
    radius = np.sqrt(spot) * per_root(whole)[:, None] ** 2
    depth = np.cbrt(np.reshape(whole.film_modulus, (-1, 1))) / np.maximum(radius, 1e-12)
    return carried_at_depth(depth, np.reshape(whole.coated_nu, (-1, 1)))


def _stress(z: np.ndarray, nu: np.ndarray) -> np.ndarray:
    """Return the von Mises stress on the axis at the depth z a, divided by the largest pressure."""
    return 1.5 / (1.0 + z * z) - (1.0 + nu) * (1.0 - z * np.arctan2(1.0, z))
