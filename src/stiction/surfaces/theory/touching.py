"""Estimate the fraction of asperities that touch from the elastic contact area (Gaussian heights)."""

import math
from functools import cache

import numpy as np

# Separations over sigma at which the fraction is tabulated, from a contact in which all asperities touch to none.
_SEPARATIONS = np.linspace(-8.0, 37.0, 2000)


def expected_share(area: np.ndarray) -> np.ndarray:
    """Estimate the fraction of asperities that touch, for theories that do not describe individual asperities.

    area: array of contact areas per asperity, divided by pi R sigma. The estimate holds for elastic spheres with Gaussian
    heights (Greenwood & Williamson 1966, eqs 5 and 6): F_0(h) at the separation h at which F_1(h) = area. F_n(h) is the
    integral of (z - h)^n phi(z) over z > h, with the standard Gaussian density phi.
    """
    log_area, log_share = _tables()
    small = np.log(np.maximum(area, 1e-300))
    return np.where(area > 0.0, np.exp(np.interp(small, log_area, log_share)), 0.0)


@cache
def _tables() -> tuple[np.ndarray, np.ndarray]:
    """Return the logarithms of F_1(h), ascending, and of F_0(h) at the same separations h; see `expected_share`."""
    from scipy.special import ndtr  # slow to import, and used by theories without asperities only

    h = _SEPARATIONS[::-1]
    share = ndtr(-h)
    density = np.exp(-0.5 * h * h) / math.sqrt(2.0 * math.pi)
    # F_1 = phi - h F_0 loses its digits at large h, where F_0/h (1 - 2/h^2 + 10/h^4 ...) replaces it.
    far = h > 12.0
    tail = share / np.where(far, h, 1.0) * (1.0 - 2.0 / np.where(far, h, 1.0) ** 2 + 10.0 / np.where(far, h, 1.0) ** 4)
    return np.log(np.where(far, tail, density - h * share)), np.log(share)
