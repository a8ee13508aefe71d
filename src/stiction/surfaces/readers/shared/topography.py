"""Convert a topography of the library SurfaceTopography to arrays."""

import logging
import warnings
from contextlib import contextmanager
from typing import Any

import numpy as np

from stiction.surfaces.readers.shared.positions import equally_spaced


@contextmanager
def quiet_library():
    """Suppress Python warnings, log lines and floating-point warnings of SurfaceTopography, inside a with-block.

    Errors of the library are not suppressed; callers report them as InputError.
    """
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.disable(before)


def on_grid(topography) -> tuple[np.ndarray, tuple[float, float], tuple[str, ...]]:
    """Return heights (rows, columns), size (y, x), and notes for the history from a topography of SurfaceTopography.

    Heights and size have the unit of the topography. The library stores x as the first index, so maps are transposed. Profiles
    with unequal spacing are resampled. Missing points become NaN.
    """
    heights: Any = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    if topography.dim == 2:
        width, depth = (float(length) for length in topography.physical_sizes)
        return np.ascontiguousarray(heights.T), (depth, width), ()
    if topography.is_uniform:
        length = float(topography.physical_sizes[0])
        return heights[None, :], (length / heights.size, length), ()
    return equally_spaced(np.asarray(topography.positions(), dtype=float), heights.ravel())
