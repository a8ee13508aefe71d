"""Compute quantiles of a lognormally distributed number from its median and its 5 % and 95 % quantiles."""

from typing import Any

import numpy as np

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import floats


def lognormal_quantile(level: Any, median: float, low: float, high: float) -> np.ndarray:
    """Return quantiles of a positive, lognormally distributed number.

    Parameters
    ----------
    level : array_like, any shape
        Quantile levels, above 0 and below 1.
    median, low, high : float
        Quantiles at the levels 0.5, 0.05 and 0.95, all above 0. If `median` is not the geometric mean of `low` and `high`, the
        logarithm has one standard deviation below the median and another above it.

    Returns
    -------
    numpy.ndarray, the shape of `level`
        Quantile at each level, in the unit of `median`.

    Raises
    ------
    InputError
        A level is not above 0 and below 1.
    """
    from scipy.special import ndtri

    allowed = "quantile levels above 0 and below 1"
    levels = floats(level, "level", allowed)
    outside = ~((levels > 0.0) & (levels < 1.0))
    if outside.any():
        raise InputError("level", float(levels[outside].flat[0]), allowed)
    deviation = ndtri(levels) / ndtri(0.95)
    return median * np.where(deviation < 0.0, median / low, high / median) ** deviation
