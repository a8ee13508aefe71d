"""Compute the friction force of each point of a solved map from its pressure.

    lesser            tau = min(alpha p, tau_0)                                                                           (1)
    junction_growth   tau_0 on the area that carries the load under combined stresses, p^2 + 9 tau_0^2 = H^2              (2)

p is the pressure, H the hardness, tau_0 the shear strength of the interface and alpha its pressure coefficient. (1): friction
cannot exceed the strength of the sheared material (Orowan 1943, Proc. Inst. Mech. Eng. 150, 140). (2): Tabor (1959, Proc. R.
Soc. A 251, 378), with his value of 9 for the factor of tau_0^2. Spots with a pressure above (H^2 - 9 tau_0^2)^(1/2) flow under
the shear and grow until their pressure has this value. For spots that flow, mu = tau_0/(H^2 - 9 tau_0^2)^(1/2), which equals
Tabor's 1/[9 (c^-2 - 1)]^(1/2) with c = 3 tau_0/H. Both are reconstructed and were not compared with the papers (grade C).
"""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError

if TYPE_CHECKING:
    from stiction.solvers.boundary_elements.solve import MapContact

# Pairs of a state ("elastic" or "plastic") and the forces of all points in this state [N].
OfPoints = Iterator[tuple[str, np.ndarray]]

_TABOR = 9.0  # factor of tau_0^2 in (2), from Tabor's measurements


def points_of(map_contact: "MapContact") -> Iterator[tuple[str, np.ndarray, float, float]]:
    """Yield each group of points of a solved map: state, pressures [Pa], area of a pixel [m2], contact area of each point [m2].

    The group "elastic" holds the points with a pressure below the hardness, the group "plastic" those at the hardness; a group
    without points is not yielded. Pixels at contact edges touch only in part, so the sum of all pixels exceeds the contact
    area. To remove the excess, the areas of the elastic points are reduced by a common factor. If they are too small for this,
    all points are reduced by a common factor.
    """
    assert map_contact.pressure is not None
    pixel = map_contact.nominal_area / map_contact.pressure.size
    pressure = map_contact.pressure[map_contact.pressure > 0.0]
    hardness = float(pressure.max(initial=0.0)) if map_contact.plastic_area > 0.0 else math.inf
    elastic, wanted = map_contact.area_pixels - map_contact.plastic_area, map_contact.area - map_contact.plastic_area
    shares = dict.fromkeys(("elastic", "plastic"), map_contact.area / map_contact.area_pixels)
    if elastic > 0.0 and wanted > 0.0:
        shares = {"elastic": wanted / elastic, "plastic": 1.0}
    for state, some in (("elastic", pressure[pressure < hardness]), ("plastic", pressure[pressure >= hardness])):
        if some.size:
            yield state, some, pixel, pixel * shares[state]


def _lesser(contact: Contact, law: str, map_contact: "MapContact") -> OfPoints:
    """Yield the state, "elastic" or "plastic", and the tangential forces [N] of each group of points.

    The force on a point is pressure coefficient times load, or strength times contact area if this is smaller. law: not
    used. Raises InputError without a pressure coefficient or a strength.
    """
    strength, (_, coefficient) = _strength(contact), contact.interface_at()
    if coefficient is None:
        raise InputError(
            "pressure_coefficient",
            None,
            "a number, because shear = lesser is the smaller of shear strength and pressure_coefficient times pressure",
        )
    for state, pressure, pixel, area in points_of(map_contact):
        yield state, np.minimum(coefficient * pressure * pixel, strength * area)


def _junction_growth(contact: Contact, law: str, map_contact: "MapContact") -> OfPoints:
    """Yield the state, "elastic" or "plastic", and the tangential forces [N] of each group of points.

    The force on a point is the shear strength times the contact area. This area grows until the point carries its load under
    combined stresses, according to equation (2) of this module. law: key of the tangential law; only the law of constant
    strength is allowed. Raises InputError for another law, for a film, and for a strength that is not stated or at which
    junctions grow without limit.
    """
    from stiction.contact.pair import Pair

    strength = _strength(contact)
    if law != "bowden_tabor_1943":
        raise InputError("tangential", law, "bowden_tabor_1943, because junction growth needs a constant interface strength")
    if contact.coating is not None:
        raise InputError("shear", "junction_growth", "law or lesser, because junction growth is not available for films")
    hardness = float(Pair(contact.first, contact.second).hardness)
    if strength**2 * _TABOR >= hardness**2:
        raise InputError(
            "interfacial_shear_strength", contact.show(strength, "interfacial_shear_strength"),
            f"< {contact.show(hardness / math.sqrt(_TABOR), 'interfacial_shear_strength')}, or junctions grow without limit",
        )  # fmt: skip
    bearing = math.sqrt(hardness**2 - _TABOR * strength**2)
    for state, pressure, pixel, area in points_of(map_contact):
        yield state, strength * np.maximum(area, pressure * pixel / bearing)


def _strength(contact: Contact) -> float:
    """Return the shear strength of the interface [Pa], limited by the weaker body; raise InputError if it is not stated."""
    if contact.interface_strength is None:
        raise InputError("interfacial_shear_strength", None, "the interfacial shear strength, as text with a unit of pressure")
    return float(contact.interface_strength)


# Functions that yield the forces of the points of a map, by the value of the option `shear` that selects them.
POINT_SHEARS: Mapping[str, Callable[[Contact, str, "MapContact"], OfPoints]] = {
    "lesser": _lesser,
    "junction_growth": _junction_growth,
}
