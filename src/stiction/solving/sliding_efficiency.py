"""Estimate what fraction of its strength a contact bears at once, if strength falls with slip.

Spots do not reach their strength together, because elastic bodies move their points by different amounts. With s the standard
deviation, over the contact, of the displacement that the strengths tau_p cause, and D_c the slip over which strength falls to
r tau_p, the largest force over the sum of strengths is

    V = (1 - r) s/D_c,    e_0 = [1 + (b V)^m]^(-1/(2 m)),                                                                  (1)
    e = r + 1/2 {e_0 - r + [(e_0 - r)^2 + w^2 r (1 - r)(1 - e_0) e_0]^(1/2)}                                               (2)

1 for small or weak spots, Griffith's V^(-1/2) for large ones without residual strength, r at least. b, m, w are fitted to
maps that were moved aside (truth/slides.py): 1.6 % rms there, 1.5 % on 306 rows of maps held out. Without a map, spots of
radius a and a square nominal area of side L, which ends, with the share c in contact, have, with S = sum (2 - nu_i)/(2 G_i),

    s^2 = (tau_p S)^2 {[k_a a (eta R sigma)^d (1 - c)^q]^2 + [k_L c L]^2},                                                 (3)
    a^2 = sigma R F_1(t)/F_0(t),    c = pi eta R sigma F_1(t),

F_0, F_1 the share of Gaussian heights above t and their mean excess (Greenwood & Williamson 1966). k_a, d and q are fitted to
the same maps, whose s the numbers of their asperities give with a standard error of 11 %; k_L is that of a uniform
square. Single discs of 0.3 to 12 l_c, which were not fitted, come out within 1.1 %. Own formulas (grade C): no
published law of this was found.
"""

import math

import numpy as np
from scipy.special import ndtr

FITTED = (4.213, 1.062, 0.680)
"""b, m and w of the law."""
_OF_SPOTS, _BY_SHARE, _BY_DENSITY, _OF_EDGES = 4.546, 0.815, 0.783, 0.0590
SPOTS_ERROR = 0.25
"""Standard deviation of ln of the displacement of spots that are known by numbers: twice that on the maps of the fit and more,
as one of 10 um that was moved aside later was 0.37 off."""
LAW_ERROR = 0.02
"""Standard deviation of ln of the efficiency of a map whose displacement is known: more than on the maps of the fit, which do
not yield."""
UNLIKE = (0.85, 0.3, 0.08)
"""Loss of unlike bodies, -ln of their efficiency over that of like bodies, divided by Dundurs' beta: mean, standard deviation,
and the part y of the strength that can be lost at which 1 - 1/e of this loss is reached. Pressing unlike bodies shears the
contact, which uses up a part of the slip. On four maps at three loads with beta of .04 and .12 the quotient is .4 to 1.2;
larger beta were not fitted (grade C)."""
_DEEPEST, _HIGHEST, _NODES = -8.0, 8.0, 4001


def efficiency(spread, residual, constants=FITTED):
    """Return the largest tangential force of a contact over the sum of the strengths of its spots, by (1) and (2).

    spread: standard deviation s of the spots' displacement over the slip D_c, >= 0. residual: fraction r of the strength that
    remains after slip, 0 to 1. Shapes broadcast. constants: b, m and w.
    """
    b, m, w = constants
    alone = (1.0 + (b * (1.0 - residual) * spread) ** m) ** (-0.5 / m)
    over = alone - residual
    return residual + 0.5 * (over + np.sqrt(over**2 + w**2 * residual * (1.0 - residual) * (1.0 - alone) * alone))


def spot_radius(share, deviation, radius, density):
    """Return the mean radius of contact spots [m], by (3).

    share: real over nominal area, 0 to 1. deviation [m], radius [m], density [1/m2]: of asperities. Shapes broadcast.
    """
    t = np.linspace(_HIGHEST, _DEEPEST, _NODES)
    tail = ndtr(-t)
    excess = np.exp(-0.5 * t * t) / math.sqrt(2.0 * math.pi) - t * tail
    wanted = share / (math.pi * radius * deviation * density)
    return np.sqrt(radius * deviation * np.interp(wanted, excess, excess / tail))


def spread_of_spots(radius, share, roughness_parameter):
    """Return s/(tau_p S) [m] by (3) for contact spots of one radius, without edges of the nominal area.

    s: standard deviation of the displacement due to shear. tau_p: strength. S: shear compliance. radius: of the spots [m].
    share: real over nominal area. roughness_parameter: eta R sigma of the asperities.
    """
    return _OF_SPOTS * radius * roughness_parameter**_BY_DENSITY * (1.0 - share) ** _BY_SHARE


def spread_of_edges(side, share):
    """Return s/(tau_p S) [m] by (3) due to the edges of a square nominal area.

    s: standard deviation of the displacement due to shear. tau_p: strength. S: shear compliance. side: of the square [m].
    share: real over nominal area.
    """
    return _OF_EDGES * side * share
