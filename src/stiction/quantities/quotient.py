"""Divide arrays where the divisor may be zero."""

from typing import Any

import numpy as np


def quotient(numerator: Any, denominator: Any, otherwise: float = np.nan) -> np.ndarray:
    """Return numerator / denominator elementwise, and `otherwise` where the denominator is not above 0; shapes broadcast."""
    out = np.full(np.broadcast_shapes(np.shape(numerator), np.shape(denominator)), otherwise)
    return np.divide(numerator, denominator, out=out, where=np.asarray(denominator) > 0.0)
