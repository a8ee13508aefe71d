"""Compute the tangential force at which the trailing edge of a Hertz contact yields (Hamilton 1983, von Mises).

Reconstruction: soft_coating_2015 takes the coefficients C1..C7 of its eq (11) from Roy Chowdhury & Ghosh 1994 and does not
print them. The condition used here has exactly the powers of eq (11); it is not known whether its coefficients are the same
(departure D12 of docs/explanation/theory-limits.md).
"""

import math

from stiction.engine.compiled import formula


@formula
def coefficients(nu):
    """Return the coefficients n, p and q of the stresses at the trailing edge of a Hertz contact.

    n = (1-2nu)/(2 pi), p = 3(4+nu)/16 and q = 9nu/16, with Poisson's ratio nu. The stresses are derived in
    docs/explanation/theory.md, section 3.2.
    """
    return (1.0 - 2.0 * nu) / (2.0 * math.pi), 3.0 * (4.0 + nu) / 16.0, 9.0 * nu / 16.0


@formula
def yield_resistance(load, strength, nu):
    """Return the tangential force T at which the trailing edge of a Hertz contact yields, or 0 if T is not real and positive.

    T is the larger root of 3n^2 P^2 + 3n(p-q) P T + (p^2+q^2-pq) T^2 = strength^2, with n, p and q from `coefficients`.
    load: P. strength: eta x/(pi k), which is yield stress times contact area, divided by pi. nu: Poisson's ratio. load,
    strength and T have the same unit.
    """
    n, p, q = coefficients(nu)
    d = p * p + q * q - p * q
    ceiling = 2.0 * math.sqrt(d) * strength
    pull = math.sqrt(3.0) * n * (p + q) * load
    discriminant = (ceiling - pull) * (ceiling + pull)
    root = (math.sqrt(max(discriminant, 0.0)) - 3.0 * n * (p - q) * load) / (2.0 * d)
    return max(root, 0.0) if discriminant >= 0.0 else 0.0


@formula
def keep_smaller(slip_limited, yield_limited):
    """Return both forces with the larger one replaced by 0; if they are equal, the slip-limited force is kept."""
    slips = slip_limited <= yield_limited
    return slip_limited if slips else 0.0, 0.0 if slips else yield_limited
