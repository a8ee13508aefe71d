"""Solve the contact of one height map without materials: all pressures are divided by E* h'.

E* is the contact modulus and h' the root mean square gradient of the map.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.inputs import floats
from stiction.records.validity_warning import ValidityWarning
from stiction.solvers.boundary_elements.bodies import Bodies
from stiction.solvers.boundary_elements.curve import MapCurve, curve_of_map
from stiction.solvers.boundary_elements.map_warnings import warnings_of_map
from stiction.solvers.boundary_elements.measures import waves
from stiction.surfaces.heightmap import HeightMap

PRESSURES = (0.005, 0.02, 0.05, 0.1, 0.2)


@dataclass(frozen=True)
class ContactOfMap:
    """Store the solved contact of a rough map with a flat.

    Pressures are divided by E* h', with the contact modulus E*. pressures: nominal pressures. gradient: h', the root mean
    square gradient. hardness: largest local pressure, None for elastic contact. height: Sq, root mean square height [m]. curve:
    solutions for E* = 1 Pa, one for each pressure, None if interrupted. validity_warnings: warnings about the map, such as too
    few points.
    """

    pressures: np.ndarray
    gradient: float
    hardness: float | None
    height: float
    curve: MapCurve
    validity_warnings: tuple[ValidityWarning, ...]

    @property
    def columns(self) -> dict[str, np.ndarray]:
        """Return dimensionless results by column name, one value for each pressure; NaN where the solution was interrupted."""
        curve = self.curve
        side = np.sqrt(curve.array("nominal_area"))
        return {
            "p/(E* h')": self.pressures,
            "A/A0": curve.fraction,
            "A/A0 in points": curve.array("area_pixels") / curve.array("nominal_area"),
            "plastic load": curve.array("plastic_share"),
            "separation/Sq": curve.array("separation") / self.height,
            "mean gap/Sq": curve.array("mean_gap") / self.height,
            "stiffness/(E* L)": curve.array("stiffness") / side,
        }

    def all_warnings(self) -> list[str]:
        """Return the warnings about the map and about the solution at each pressure as texts, without repetitions."""
        texts = {str(one): None for one in self.validity_warnings}
        for pressure, contact in zip(self.pressures, self.curve.contacts, strict=True):
            if contact is None:
                texts[f"p/(E* h') = {pressure:g}: interrupted before it was solved"] = None
            else:
                texts |= {f"p/(E* h') = {pressure:g}: {one}": None for one in contact.validity_warnings}
        return list(texts)


def contact_of_map(surface: HeightMap, pressures: Sequence[float] = PRESSURES, hardness: float | None = None) -> ContactOfMap:
    """Solve the contact of a prepared map with a flat at given nominal pressures.

    Pressures and hardness are above 0 and divided by E* h'; E* is the contact modulus, h' the root mean square gradient of the
    map. Raises InputError for a profile, a flat map, missing points, or a pressure that is not below the hardness.
    """
    allowed = "a list of numbers > 0, nominal pressures over E* h'"
    wanted = floats(list(pressures), "pressures", allowed)
    if wanted.ndim != 1 or not wanted.size or not (np.isfinite(wanted) & (wanted > 0.0)).all():
        raise InputError("pressures", pressures, allowed)
    if hardness is not None and not 0.0 < hardness < math.inf:
        raise InputError("hardness", hardness, "> 0, over E* h'")
    if surface.is_profile:
        raise InputError("scan", InWords("a profile"), "a map; the contact of a profile is not solved")
    if not surface.complete:
        raise InputError("fill", None, f"harmonic or nearest: {surface.missing} points have no height")
    if float(np.ptp(surface.heights)) == 0.0:
        raise InputError("scan", InWords("heights all alike"), "a rough map; a flat face touches everywhere")
    gradient = waves(surface.heights, surface.size, surface.periodic).gradient
    if hardness is not None and wanted.max() >= hardness:
        raise InputError("pressures", float(wanted.max()), f"< {hardness:g}, the hardness over E* h'")
    bodies = Bodies(1.0, hardness=None if hardness is None else hardness * gradient)
    curve = curve_of_map(surface, bodies, (wanted * gradient).tolist())
    of_map = warnings_of_map(surface.heights, surface.size, None, surface.periodic)
    return ContactOfMap(wanted, gradient, hardness, float(np.std(surface.heights)), curve, of_map)


def summary_of_contact(contact: ContactOfMap) -> dict[str, Any]:
    """Return the solved contact as a dict of plain numbers and texts, for JSON."""
    return {
        "rms_gradient": contact.gradient,
        "hardness": contact.hardness,
        "every": contact.curve.every,
        "points_in_shortest_wave": contact.curve.of_map["points_in_shortest_wave"],
        "longest_waves_on_a_side": contact.curve.of_map["longest_waves_on_a_side"],
        "columns": {head: values.tolist() for head, values in contact.columns.items()},
        "residual": contact.curve.array("residual").tolist(),
        "validity_warnings": [one.as_data() for one in contact.validity_warnings],
        "validity_warnings_in_words": contact.all_warnings(),
    }
