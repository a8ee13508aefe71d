"""One elastic asperity without adhesion: Hertz 1882. Coordinate: u = sqrt(w), in which load and area are polynomials."""

import math

from ..compiled import formula


@formula
def load(w):
    """P = w^(3/2), over K R^(1/2) sigma^(3/2), K = (4/3) E*."""
    return w * math.sqrt(w)


@formula
def along(u):
    """Displacement w = u^2, its slope, load w^(3/2), area w (over pi R sigma); no tangential law."""
    w = u * u
    return w, 2.0 * u, w * u, w, 0.0, 0.0


@formula
def coordinate(w):
    return math.sqrt(max(w, 0.0))
