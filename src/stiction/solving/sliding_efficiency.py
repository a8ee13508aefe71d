"""Estimate the largest friction force of a contact, as a fraction of its summed strength, if strength falls with slip.

Contact spots do not reach their strength at the same displacement, because elastic bodies move their points by different
amounts. Let s be the standard deviation of the displacement that the strengths tau_p cause, and D_c the slip over which
strength falls to r tau_p. The largest force divided by the sum of strengths, e, is

    V = (1 - r) s/D_c,    e_0 = [1 + (b V)^m]^(-1/(2 m)),                                                                  (1)
    e = r + 1/2 {e_0 - r + [(e_0 - r)^2 + w^2 r (1 - r)(1 - e_0) e_0]^(1/2)}                                               (2)

e is 1 for small or weak spots, follows Griffith's V^(-1/2) for large spots without residual strength, and is at least r. b, m,
w are fitted to maps that were displaced tangentially (truth/slides.py): the rms error is 1.6 % for these maps, and 1.5 % for
306 other results of such maps. Without a map, s follows from the radius a of the spots and the fraction c of the nominal area
that is in contact. The nominal area is a square of side L with free edges. With S = sum (2 - nu_i)/(2 G_i) (nu: Poisson's
ratio, G: shear modulus),

    s^2 = (tau_p S)^2 {[k_a a (eta R sigma)^d (1 - c)^q]^2 + [k_L c L]^2},                                                 (3)
    a^2 = sigma R F_1(t)/F_0(t),    c = pi eta R sigma F_1(t),

F_n(t) is the integral of (z - t)^n times the Gaussian density over heights z > t; eta, R and sigma are density, radius and rms
height of the asperities (Greenwood & Williamson 1966). k_a, d and q are fitted to the same maps, for which equation (3)
predicts s with a standard error of 11 %; k_L is the value of a uniform square. For single discs with radii of 0.3 to 12
weakening lengths, which were not fitted, e is accurate to 1.1 %. These formulas are this project's own (grade C); no published
law was found.
"""

import math

import numpy as np
from scipy.special import ndtr

FITTED = (4.213, 1.062, 0.680)
"""The constants b, m and w of (1) and (2)."""
_OF_SPOTS, _BY_SHARE, _BY_DENSITY, _OF_EDGES = 4.546, 0.815, 0.783, 0.0590
SPOTS_ERROR = 0.25
"""Standard deviation of ln s for a contact without a map. It is more than twice the value on the fitted maps, because the error
was 0.37 on a map of 10 um that was displaced after the fit."""
LAW_ERROR = 0.02
"""Standard deviation of ln e for a map whose s was computed. It is larger than on the fitted maps, which do not yield."""
UNLIKE = (0.85, 0.3, 0.08)
"""Loss of efficiency of bodies with unlike elastic constants: -ln(e_u/e_l)/beta, with the efficiencies e_u of unlike and e_l
of like bodies, and Dundurs' beta. The first two numbers are the mean and the standard deviation of the loss. The third is a
fraction of the strength that slip can remove: where like bodies have lost this fraction, 63 % of the loss is reached. Pressing
unlike bodies together shears the contact, which uses up part of the slip. On four maps at three loads with beta of .04 and .12
the loss is .4 to 1.2; larger beta were not fitted (grade C)."""
_DEEPEST, _HIGHEST, _NODES = -8.0, 8.0, 4001


def efficiency(spread, residual, constants=FITTED):
    """Return the largest tangential force of a contact, divided by the sum of the strengths of its spots.

    spread: standard deviation of the spots' shear displacement, divided by the slip over which strength is lost, >= 0.
    residual: fraction of the strength that remains after slip, 0 to 1. The shapes broadcast. constants: b, m and w of equations
    (1) and (2) of this module.
    """
    b, m, w = constants
    alone = (1.0 + (b * (1.0 - residual) * spread) ** m) ** (-0.5 / m)
    over = alone - residual
    return residual + 0.5 * (over + np.sqrt(over**2 + w**2 * residual * (1.0 - residual) * (1.0 - alone) * alone))


def spot_radius(share, deviation, radius, density):
    """Return the mean radius of contact spots [m] in Greenwood & Williamson's model with Gaussian heights.

    share: ratio of real to nominal contact area, 0 to 1. deviation [m], radius [m], density [1/m2]: standard deviation of the
    heights, radius and number per area of the asperities. The shapes broadcast.
    """
    t = np.linspace(_HIGHEST, _DEEPEST, _NODES)
    tail = ndtr(-t)
    excess = np.exp(-0.5 * t * t) / math.sqrt(2.0 * math.pi) - t * tail
    wanted = share / (math.pi * radius * deviation * density)
    return np.sqrt(radius * deviation * np.interp(wanted, excess, excess / tail))


def spread_of_spots(radius, share, roughness_parameter):
    """Return the standard deviation of the shear displacement of contact spots, without the effect of the edges.

    The result [m] is the standard deviation divided by tau_p S (tau_p: strength, S: shear compliance). It is the term
    k_a a (eta R sigma)^d (1 - c)^q of equation (3) of this module. radius: radius of the spots [m]. share: ratio of real to
    nominal contact area. roughness_parameter: density times radius times rms height of the asperities.
    """
    return _OF_SPOTS * radius * roughness_parameter**_BY_DENSITY * (1.0 - share) ** _BY_SHARE


def spread_of_edges(side, share):
    """Return the standard deviation of the shear displacement due to the edges of a square nominal area.

    The result [m] is the standard deviation divided by tau_p S (tau_p: strength, S: shear compliance), k_L c L of equation (3)
    of this module. side: side of the square [m]. share: ratio of real to nominal contact area.
    """
    return _OF_EDGES * side * share
