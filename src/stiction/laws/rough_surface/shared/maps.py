"""The range within which the points of a map resolve its area, shared by the models that solve the contact of a map."""

import math

from stiction.records.claims import Validity
from stiction.solvers.boundary_elements.limits import LEAST_IN_WAVE

RESOLVED = Validity("points_in_shortest_wave", LEAST_IN_WAVE, math.inf, "the area of the map is not converged in points", "fit")
