r"""Compute hardness that grows as asperities get smaller.

*Assumes*: a crystal that hardens by dislocations: those present before, and those that an imprint makes necessary. The latter
fill a hemisphere as wide as the contact. Strength grows with the square root of the total density (Taylor).
*Source*: [nix_gao_1998], the form as several texts restate it;
[swadener_george_pharr_2002], abstract: under spheres hardness does not depend on the depth
but grows as the radius falls. The densities below are derived here, by the count of loops that both build on. For a cone or
pyramid, whose faces lie at the angle beta to the surface, and a sphere of radius R, b being the length of a Burgers vector,

    rho = 3 tan^2(beta)/(2 b h),   H = H_0 sqrt(1 + h*/h);      rho = 1/(b R),   H = H_0 sqrt(1 + R*/R)

so that R* = (2/3) h*/tan^2(beta), 5.20 h* for Berkovich's and Vickers's pyramids, each as a cone of 70.3 degrees. An asperity
is a sphere: it has one hardness at every depth. H_0 is the hardness of large imprints, and h* is fitted to hardness against
the depth under a pyramid. The yield stress is taken to grow as the hardness does.

*Limit*: h* -> 0 or R -> infinity: H_0. *Unknown*: what limits the growth; measured hardness is said to be less than this at
depths below some 100 nm, where the dislocations spread over more than the hemisphere; results are flagged where R* is above
10 R.
"""

from collections.abc import Iterable
from math import radians, tan

import numpy as np

from stiction.contact.materials import Material

# Angle between the surface and the faces of a cone that displaces as much as Berkovich's or Vickers's pyramid.
_FACE = radians(90.0 - 70.3)


def radius_of(depth):
    """Return the length R* [m] of the size effect under a sphere, from h* [m] under a pyramid."""
    return 2.0 / 3.0 * depth / tan(_FACE) ** 2


def size_ratio(body: Material, radius):
    """Return R*/R of a body, the strength of its size effect under asperities of radius R.

    It is 0 without a characteristic depth.
    """
    return 0.0 if body.characteristic_depth is None else radius_of(body.characteristic_depth) / radius


def at_radius(body: Material, radius) -> Material:
    """Return the material with the hardness that it has under asperities of this radius [m].

    Hardness and yield stress are higher; elastic moduli are unchanged.
    """
    if body.characteristic_depth is None:
        return body
    factor = (1.0 + size_ratio(body, radius)) ** 0.5
    strength = {} if body.yield_stress is None else {"yield_stress": body.yield_stress * factor}
    return body.replace(hardness=body.hardness * factor, characteristic_depth=None, range={}, **strength)


def size_notes(bodies: Iterable[Material], radius) -> list[str]:
    """Return a sentence for each body whose asperities are harder than large imprints."""
    notes = []
    for body in bodies:
        if body.characteristic_depth is not None:
            factor = (1.0 + size_ratio(body, radius)) ** 0.5
            words = f"{float(factor):.3g} times the" if np.ndim(factor) == 0 else "above the"
            notes.append(f"hardness of {body.name} in small contacts: {words} hardness of large imprints (Nix and Gao 1998)")
    return list(dict.fromkeys(notes))
