"""One adhesive elastic asperity: Johnson, Kendall & Roberts 1971, in the units of docs/theory.md.

The coordinate is u = x^(1/4), x = a^2/(R sigma) the apparent displacement: load and displacement are polynomials in it.
S = sqrt(6 pi / theta) measures adhesion.
"""

import math

from ..compiled import formula


@formula
def adhesion(theta):
    """S = sqrt(6 pi / theta), the 4.34 / theta^(1/2) of eqs (1) and (2) of the 2015 paper."""
    return math.sqrt(6.0 * math.pi / theta)


@formula
def displacement(u, S):
    """Real displacement w = x - (2/3) S x^(1/4) (eq 4 of the 2015 paper), over sigma."""
    return u * (u * u * u - 2.0 / 3.0 * S)


@formula
def stretch(u, S):
    """dw/du."""
    return 4.0 * u * u * u - 2.0 / 3.0 * S


@formula
def load(u, S):
    """P = x^(3/2) - S x^(3/4) (integrand of eq 1 of the 2015 paper), over K R^(1/2) sigma^(3/2)."""
    u3 = u * u * u
    return u3 * (u3 - S)


@formula
def area(u):
    """x = a^2 / (R sigma): contact area over pi R sigma."""
    return u * u * u * u


@formula
def coordinate(w, S):
    """u >= 0 with displacement w, on the stable side dw/du >= 0: Newton from above on a convex polynomial."""
    if w == math.inf:
        return math.inf
    s = 2.0 / 3.0 * S
    if w <= -0.75 * s * (0.25 * s) ** (1.0 / 3.0):  # the displacement at which dw/du vanishes, and less
        return (0.25 * s) ** (1.0 / 3.0)
    u = max((2.0 * max(w, 0.0)) ** 0.25, (2.0 * s) ** (1.0 / 3.0))
    for _ in range(60):
        u3 = u * u * u
        step = (u * (u3 - s) - w) / (4.0 * u3 - s)
        u -= step
        if step <= 1e-12 * u:
            break
    return u
