"""Define a validity range for maps: the shortest wave must have enough points to resolve the contact area."""

import math

from stiction.records.claims import Validity
from stiction.solvers.boundary_elements.limits import LEAST_IN_WAVE

RESOLVED = Validity(
    "points_in_shortest_wave", LEAST_IN_WAVE, math.inf, "the map has too few points, so its contact area is inaccurate", "fit"
)
