"""Convert a topography of the library SurfaceTopography to an array."""

from typing import Any

import numpy as np

from stiction.surfaces.readers.shared.positions import equally_spaced


def on_grid(topography) -> tuple[np.ndarray, tuple[float, float], tuple[str, ...]]:
    """Return heights (rows, columns), size (y, x), and notes, from a topography.

    The library stores x as the first index, so maps are transposed. Profiles with unequal spacing are resampled.
    """
    heights: Any = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    if topography.dim == 2:
        width, depth = (float(length) for length in topography.physical_sizes)
        return np.ascontiguousarray(heights.T), (depth, width), ()
    if topography.is_uniform:
        length = float(topography.physical_sizes[0])
        return heights[None, :], (length / heights.size, length), ()
    return equally_spaced(np.asarray(topography.positions(), dtype=float), heights.ravel())
