"""Ranges within which a map stands for its surface, shared by the models that solve the contact of a map."""

import math

from stiction.records.claims import Validity
from stiction.solvers.boundary_elements.limits import LEAST_IN_WAVE, LEAST_WAVES

RESOLVED = Validity("points_in_shortest_wave", LEAST_IN_WAVE, math.inf, "the area of the map is not converged in points", "fit")
A_SAMPLE = Validity("longest_waves_on_a_side", LEAST_WAVES, math.inf, "the map is no sample of its surface", "statistics")
