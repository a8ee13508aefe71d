"""Solve an adhesive periodic map, and return results of the same type as without adhesion.

The faces attract each other over a range rho (see `adhesive`). The option "atomic_range" is the range of atomic forces, which
few maps resolve. "shortest_range" is the shortest range that the map resolves, but at least the atomic range. A map resolves a
range if two or more points lie across the cohesive zone at the contact edge; the width of this zone is E* rho^2/w (w: work of
adhesion). The shorter the range, the closer the result is to Johnson, Kendall & Roberts.
"""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.solvers.boundary_elements.adhesive import AdhesiveContact, solve_adhesive
from stiction.solvers.boundary_elements.bodies import Bodies
from stiction.solvers.boundary_elements.compliance import Compliance
from stiction.solvers.boundary_elements.curve import MapCurve, of_map
from stiction.solvers.boundary_elements.limits import LEAST_POINTS
from stiction.solvers.boundary_elements.solve import MapContact

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap


def shortest_range(surface: "HeightMap", bodies: Bodies, work: float) -> float:
    """Return the shortest range of attraction [m] that the points of a map resolve.

    bodies: elastic constants of both bodies. work: work of adhesion [J/m2].
    """
    near = Compliance(bodies.modulus, bodies.film, bodies.counter_film).near
    return math.sqrt(LEAST_POINTS * max(surface.pitch) * near * work)


def adhesive_curve(surface: "HeightMap", bodies: Bodies, pressures: Sequence[float], *, work: float, reach: float) -> MapCurve:
    """Solve an adhesive map at nominal pressures [Pa] in the given order, and return its contacts.

    Negative pressures pull. Each solution starts from the previous one. bodies: elastic constants of both bodies. work: work of
    adhesion [J/m2]. reach: range of attraction [m]. Raises InputError for a map that is not periodic, for plastic bodies, and
    for films on both bodies.
    """
    if not surface.periodic:
        raise InputError("adhesion", InWords("on a map that is not periodic"), "left_out, or a periodic map (periodic = true)")
    if bodies.hardness is not None:
        raise InputError("yielding", "at_hardness", "none, because the adhesive solver assumes elastic bodies")
    if bodies.counter_film is not None:
        raise InputError("coating.bodies", "both", "first or second, because the adhesive solver supports one film")
    nominal = surface.size[0] * surface.size[1]
    adhesive = solve_adhesive(
        surface.heights, surface.size, modulus=bodies.modulus, film=bodies.film, work=work, reach=reach,
        loads=[float(pressure) * nominal for pressure in pressures],
    )  # fmt: skip
    numbers = of_map(surface, bodies, 1) | {"adhesion_range": reach, "points_at_edge": adhesive[0].points_at_edge}
    contacts = tuple(_as_contact(contact, nominal) for contact in adhesive)
    return MapCurve(contacts, 1, numbers, {"attraction_residual": np.array([contact.residual for contact in adhesive])})


def _as_contact(contact: AdhesiveContact, nominal: float) -> MapContact:
    """Convert an adhesive contact to a MapContact without a pressure map.

    nominal: nominal area [m2]. The separation is the mean gap, infinite if the faces have separated. The pressure map is
    omitted, because tension also acts inside the contact, and other code counts every point with pressure as a contact point.
    The adhesive solver does not compute stiffness, residual and relative errors (NaN), or the approach (None).
    """
    return MapContact(
        load=contact.load, mean_pressure=contact.load / nominal, nominal_area=nominal, area=contact.area,
        area_pixels=contact.area_pixels, perimeter=contact.perimeter, separation=contact.mean_gap, mean_gap=contact.mean_gap,
        approach=None, stiffness=math.nan, plastic_area=0.0, plastic_share=0.0, residual=math.nan, pressure_error=math.nan,
        area_error=math.nan, overlap=0.0, load_error=math.nan, steps=0, points=contact.points, load_at_ends=0.0,
        validity_warnings=contact.validity_warnings,
    )  # fmt: skip
