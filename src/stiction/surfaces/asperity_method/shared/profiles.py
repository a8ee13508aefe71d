"""Select the profiles of a map, its rows and columns, and convert the density of asperities along them to a density per area.

The number of asperities per area N follows from the number per length D as for an isotropic Gaussian surface (Nayak 1971),
which has (1/2 pi) sqrt(m4/m2) peaks per length and m4 / (6 pi sqrt(3) m2) summits per area:

    N = 2 pi / (3 sqrt(3)) D_x D_y = 1.2092 D_x D_y.                                                                       (1)
"""

import math
from collections.abc import Sequence

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.records.registry import Parameter
from stiction.surfaces.asperity_set import over_mean_plane
from stiction.surfaces.heightmap import HeightMap

_SUMMITS_PER_PEAKS_SQUARED = 2.0 * math.pi / (3.0 * math.sqrt(3.0))  # factor of equation (1)
RELATION = f"N = {_SUMMITS_PER_PEAKS_SQUARED:.4f} D_x D_y (one direction: D^2) of an isotropic Gaussian surface"

DIRECTIONS = Parameter("directions of the profiles; a single profile has only x", "xy", ("xy", "x", "y"))


def profiles(surface: HeightMap, directions: str) -> list[tuple[np.ndarray, float]]:
    """Return the profiles of a map along each chosen direction, as a list of (heights, pitch).

    directions: "x", "y" or "xy". heights: (lines, points) [m] above the mean plane. pitch: point spacing along the lines [m].
    Raises InputError if a profile has fewer than three points.
    """
    heights = over_mean_plane(surface)
    dy, dx = surface.pitch
    along = {"x": (heights, dx), "y": (heights.T, dy)}
    chosen = [along[one] for one in directions_of(surface, directions)]
    if any(lines.shape[1] < 3 for lines, _ in chosen):
        raise InputError("heights", InWords(f"shape {surface.heights.shape}"), "3 or more points along a profile")
    return chosen


def directions_of(surface: HeightMap, directions: str) -> str:
    """Return the directions of the profiles to use, as letters: "x" for a single profile, otherwise `directions`."""
    return "x" if surface.is_profile else directions


def places_of(points: Sequence[tuple[np.ndarray, np.ndarray]], surface: HeightMap, directions: str) -> np.ndarray:
    """Convert points on profiles to rows and columns (n, 2) of the map.

    points: for each direction, two arrays: line numbers, and indices along the line. directions: "x", "y" or "xy". The result
    lists one direction after the other.
    """
    chosen = directions_of(surface, directions)
    along = [one if way == "x" else one[::-1] for way, one in zip(chosen, points, strict=True)]
    return np.concatenate([np.column_stack(one) for one in along])


def per_area(per_length: Sequence[float]) -> float:
    """Return the asperities per area [1/m^2] from the asperities per length D [1/m]: N = 1.2092 D_x D_y (equation (1)).

    per_length: D_x and D_y; a single value is used for both directions.
    """
    return _SUMMITS_PER_PEAKS_SQUARED * per_length[0] * per_length[-1]
