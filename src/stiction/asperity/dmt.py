"""One elastic asperity with adhesion around the contact: Derjaguin, Muller & Toporov 1975, as Maugis 1992 states it:
Hertz's contact, with the load less the constant 2 pi gamma R."""

import math

from ..compiled import formula


@formula
def along(u, theta):
    """Displacement w = u^2, its slope, load w^(3/2) - 2 pi/theta, area w (over pi R sigma); no tangential law."""
    w = u * u
    return w, 2.0 * u, w * u - 2.0 * math.pi / theta, w, 0.0, 0.0


@formula
def coordinate(w, theta):
    return math.sqrt(max(w, 0.0))
