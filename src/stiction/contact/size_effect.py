r"""Compute the hardness of a material that is harder under smaller asperities (the indentation size effect).

*Assumes*: a crystal that hardens by dislocations: those present before the contact, and those that the shape of an imprint
requires. The dislocations of the imprint fill a hemisphere as wide as the contact. Strength is proportional to the square root
of the total density of dislocations (Taylor).
*Source*: [nix_gao_1998], the form in which other texts restate it;
[swadener_george_pharr_2002], abstract: under spheres hardness does not depend on the depth
but grows as the radius falls. The densities rho below are derived here by counting dislocation loops, as both sources do. For a
cone or pyramid whose faces lie at the angle beta to the surface, and for a sphere of radius R, with the Burgers vector b,

    rho = 3 tan^2(beta)/(2 b h),   H = H_0 sqrt(1 + h*/h);      rho = 1/(b R),   H = H_0 sqrt(1 + R*/R)

so that R* = (2/3) h*/tan^2(beta), 5.20 h* for Berkovich's and Vickers's pyramids, each as a cone of 70.3 degrees. An asperity
is a sphere, so it has one hardness at every depth h. H_0 is the hardness of large imprints. h* is the characteristic depth,
from a fit of hardness against the depth under a pyramid. The yield stress is assumed to grow in proportion to the hardness.

*Limit*: h* -> 0 or R -> infinity: H_0. *Unknown*: what limits the growth. Measured hardness is reported to be lower than this
formula predicts at depths below about 100 nm, where the dislocations spread beyond the hemisphere; a result with R* above 10 R
gets a validity warning.
"""

from collections.abc import Iterable
from math import radians, tan

import numpy as np

from stiction.contact.materials import Material

# Angle between the surface and the faces of a cone that displaces as much as Berkovich's or Vickers's pyramid.
_FACE = radians(90.0 - 70.3)


def radius_of(depth):
    """Return the length R* [m] that describes the size effect of hardness under a sphere: H = H_0 sqrt(1 + R*/R).

    depth: h* [m], the characteristic depth of the size effect under a pyramid.
    """
    return 2.0 / 3.0 * depth / tan(_FACE) ** 2


def size_ratio(body: Material, radius):
    """Return R*/R, which measures how much harder a body is under asperities of radius R: H = H_0 sqrt(1 + R*/R).

    radius: R [m]. The ratio is 0 for a body without a characteristic depth.
    """
    return 0.0 if body.characteristic_depth is None else radius_of(body.characteristic_depth) / radius


def at_radius(body: Material, radius) -> Material:
    """Return a material with the hardness that it has under asperities of this radius [m].

    Hardness and yield stress are raised by the factor sqrt(1 + R*/R), where R* is `radius_of(characteristic_depth)`; elastic
    moduli are unchanged. The result has no characteristic depth and no ranges. A material without a characteristic depth is
    returned unchanged.
    """
    if body.characteristic_depth is None:
        return body
    factor = (1.0 + size_ratio(body, radius)) ** 0.5
    strength = {} if body.yield_stress is None else {"yield_stress": body.yield_stress * factor}
    return body.replace(hardness=body.hardness * factor, characteristic_depth=None, range={}, **strength)


def size_notes(bodies: Iterable[Material], radius) -> list[str]:
    """Return a sentence for each body with a size effect: how much harder it is under asperities than in large imprints.

    radius: radius of the asperities [m]. The factor is omitted if it is an array. Equal sentences are listed once.
    """
    notes = []
    for body in bodies:
        if body.characteristic_depth is not None:
            factor = (1.0 + size_ratio(body, radius)) ** 0.5
            words = f"{float(factor):.3g} times the" if np.ndim(factor) == 0 else "above the"
            notes.append(f"hardness of {body.name} in small contacts: {words} hardness of large imprints (Nix and Gao 1998)")
    return list(dict.fromkeys(notes))
