"""Compute the contact area of a surface from its spectral moments by Persson's theory, fitted to solved maps.

The formulas are this project's own, grade B. Their evidence is solved maps (docs/explanation/truth.md); they are fitted to the
Gaussian isotropic maps of seeds 1 and 2. They extend A/A0 = erf(2^(1/2) p) (Persson 2001), where A/A0 is the area fraction and
p the mean pressure divided by E* h', with the contact modulus E* and the rms gradient h':

    G(p, c) = erf(2^(1/2) p [1 + c (1 - erf(2^(1/2) p)^(1/2))])                                                           (1)
    A = G(p, c), c = .617 - .041 ln alpha, alpha: Nayak's m0 m4/m2^2                                                      (2)
    A = [A^3.5 + (p/H)^3.5]^(1/3.5), A on the right: elastic                                                              (5)

In (5) p/H is the mean pressure divided by the hardness. (3) and (4), which need a map, are in
solvers.boundary_elements.area_estimates.
"""

import math

import numpy as np
from scipy.special import erf

WIDEST_BAND = 160.0  # largest alpha of the solved maps
MEETING = 3.5  # exponent of (5)


def widened(pressure, c):
    """Return the elastic contact area fraction by equation (1): Persson's theory with a correction of strength c.

    pressure: mean pressure divided by E* and the rms gradient h'. c: coefficient in equation (1).
    """
    plain = erf(math.sqrt(2.0) * pressure)
    return erf(math.sqrt(2.0) * pressure * (1.0 + c * (1.0 - np.sqrt(plain))))


def with_hardness(elastic, pressure, hardness):
    """Return the contact area fraction of plastically deforming bodies by equation (5), from the elastic one.

    elastic: area fraction of elastic bodies. pressure, hardness: mean pressure and hardness in one unit; hardness may be
    infinite. The fraction is 1 if the pressure reaches the hardness.
    """
    flowing = np.minimum(pressure / hardness, 1.0)
    return np.minimum((elastic**MEETING + flowing**MEETING) ** (1.0 / MEETING), 1.0)


def of_moments(pressure, alpha):
    """Return the elastic contact area fraction by equation (2) for Gaussian isotropic surfaces.

    pressure: mean pressure divided by E* and the rms gradient h', >= 0. alpha: Nayak's bandwidth parameter m0 m4/m2^2.
    """
    return widened(pressure, width_by_moments(alpha))


def width_by_moments(alpha):
    """Return the coefficient c = 0.617 - 0.041 ln(alpha) of equation (2); alpha: Nayak's bandwidth parameter m0 m4/m2^2."""
    return 0.617 - 0.041 * np.log(alpha)
