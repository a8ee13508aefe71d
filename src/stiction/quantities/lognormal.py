"""Quantiles of a positive number that is known by its median and its 5 and 95 % quantiles."""

from typing import Any

import numpy as np

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import floats


def lognormal_quantile(level: Any, median: float, low: float, high: float) -> np.ndarray:
    """Return the quantile of a lognormal number at levels between 0 and 1.

    Parameters
    ----------
    level : array_like, any shape
        Quantile levels, each above 0 and below 1.
    median, low, high : float
        Quantiles at the levels 0.5, 0.05 and 0.95, above 0. Where `median` is not the geometric mean of the ends, the
        logarithm is normal with one width below the median and another above it.

    Returns
    -------
    numpy.ndarray, the shape of `level`

    Raises
    ------
    InputError
        A level is not between 0 and 1.
    """
    from scipy.special import ndtri

    allowed = "quantile levels above 0 and below 1"
    levels = floats(level, "level", allowed)
    outside = ~((levels > 0.0) & (levels < 1.0))
    if outside.any():
        raise InputError("level", float(levels[outside].flat[0]), allowed)
    deviation = ndtri(levels) / ndtri(0.95)
    return median * np.where(deviation < 0.0, median / low, high / median) ** deviation
