"""Give what models that use a map share: the validity range of its points, and the unit of length of its contact."""

import math
from typing import TYPE_CHECKING

import numpy as np

from stiction.contact.indices import Groups
from stiction.records.claims import Validity
from stiction.solvers.boundary_elements.limits import LEAST_IN_WAVE

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap

RESOLVED = Validity(
    "points_in_shortest_wave", LEAST_IN_WAVE, math.inf, "the map has too few points: its contact area is inaccurate", "fit"
)


def unit_of_map(surface: "HeightMap", groups: Groups) -> np.ndarray:
    """Return sqrt(R sigma) in metres (n,), from N R sigma of the contacts and the asperity density N of their map."""
    from stiction.surfaces.asperity_method.mccool import mccool  # slow to import

    return np.sqrt(groups.roughness_parameter / mccool(surface, None).density)
