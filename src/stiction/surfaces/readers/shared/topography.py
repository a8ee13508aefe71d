"""A topography of the library SurfaceTopography as an array."""

from typing import Any

import numpy as np

from stiction.surfaces.readers.shared.positions import equally_spaced


def on_grid(topography) -> tuple[np.ndarray, tuple[float, float], tuple[str, ...]]:
    """Return heights (rows, columns), size (y, x), and remarks.

    The library has x first.
    """
    heights: Any = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    if topography.dim == 2:
        width, depth = (float(length) for length in topography.physical_sizes)
        return np.ascontiguousarray(heights.T), (depth, width), ()
    if topography.is_uniform:
        length = float(topography.physical_sizes[0])
        return heights[None, :], (length / heights.size, length), ()
    return equally_spaced(np.asarray(topography.positions(), dtype=float), heights.ravel())
