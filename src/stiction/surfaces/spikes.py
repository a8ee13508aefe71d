"""Spikes: single points drawn far from the surface by the instrument.

Dust, an edge or a lost signal causes them.

A point is a spike if it is further from the median than so many robust deviations: 1.4826 times the median distance from the
median, which is the standard deviation of a Gaussian surface and is not moved by the spikes themselves.
A few of them decide Sq, Sz and with that the threshold of persistent summits.
"""

import math

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.heightmap import HeightMap

SUSPICIOUS = 10.0  # robust deviations: of a Gaussian surface no point is as far
_GAUSSIAN = 1.4826  # standard deviation over median distance from the median


def spikes(surface: HeightMap, times: float = SUSPICIOUS) -> np.ndarray:
    """Return a mask (rows, columns) of points beyond `times` robust deviations.

    Empty where half of all points have the same height. Raises InputError unless times > 0 and finite.
    """
    if not (isinstance(times, int | float) and 0.0 < times < math.inf):
        raise InputError("spikes", times, "> 0 robust deviations, e.g. 10")
    heights = surface.heights
    if surface.missing == heights.size:
        return np.zeros(heights.shape, dtype=bool)
    distance = np.abs(heights - np.nanmedian(heights))
    deviation = _GAUSSIAN * float(np.nanmedian(distance))
    return distance > times * deviation if deviation > 0.0 else np.zeros(heights.shape, dtype=bool)


def mask_spikes(surface: HeightMap, times: float) -> HeightMap:
    """Return the levelled map with its spikes missing. Raises InputError as `spikes`."""
    found = spikes(surface, times)
    step = f"{np.count_nonzero(found)} points further than {times:g} robust deviations from the median masked"
    return surface.with_heights(np.where(found, np.nan, surface.heights), step)
