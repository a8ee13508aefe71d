"""One asperity without adhesion: Hertz up to the critical interference, then a truncated sphere of conserved volume.

Chang, Etsion & Bogy 1987. Loads over K R^(1/2) sigma^(3/2), areas over pi R sigma, displacements over sigma.
"""

from ..compiled import formula


def hardness_coefficient(nu):
    """K_H = 0.454 + 0.41 nu: mean pressure at first yield over (2/3 of) the hardness. Arrays. The 1987 paper takes the
    constant 0.6; this form is the authors' of 1988."""
    return 0.454 + 0.41 * nu


def critical_interference(eta, K_H):
    """omega_c / sigma = ((2/3) K_H eta)^2, from omega_c = (pi K_H H / (2 E*))^2 R with eta = pi H sqrt(R/sigma)/K. Arrays."""
    return (2.0 / 3.0 * K_H * eta) ** 2


@formula
def plastic_along(w, w_c, eta, K_H):
    """A = pi R w (2 - w_c/w), P = A K_H H; the load jumps by 1.5 at w_c. A plastic asperity bears no tangential force."""
    area = 2.0 * w - w_c
    return w, 1.0, K_H * eta * area, area, 0.0, 0.0


@formula
def plastic_coordinate(w, w_c, eta, K_H):
    return w
