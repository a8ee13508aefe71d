"""Find and mask spikes: single points that the instrument measured far from the surface.

Dust, an edge or a lost signal causes spikes. A point is a spike if it is further from the median height than a given number of
robust standard deviations. The robust standard deviation is 1.4826 times the median distance from the median. It equals the
standard deviation for Gaussian heights, and a few spikes do not change it. A few spikes strongly change the rms height Sq and
the range of heights Sz. The default threshold of the asperity method `persistence` is proportional to Sz.
"""

import math

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.heightmap import HeightMap

SUSPICIOUS = 10.0  # robust standard deviations; no point of a Gaussian surface is as far from the median
_GAUSSIAN = 1.4826  # standard deviation over median distance from the median


def spikes(surface: HeightMap, times: float = SUSPICIOUS) -> np.ndarray:
    """Return a mask (rows, columns) of points more than `times` robust standard deviations from the median height.

    The robust standard deviation is 1.4826 times the median distance from the median. Missing points are False. The mask is
    all False if no height is measured, or if more than half of the heights are equal. Raises InputError unless times is finite
    and > 0.
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
    """Return the map with its spikes, as `spikes` finds them, marked as missing. Level the map first.

    times: number of robust standard deviations. Raises InputError as `spikes` does.
    """
    found = spikes(surface, times)
    step = f"{np.count_nonzero(found)} points further than {times:g} robust deviations from the median masked"
    return surface.with_heights(np.where(found, np.nan, surface.heights), step)
