"""Divide arrays whose divisor may be zero."""

from typing import Any

import numpy as np


def quotient(numerator: Any, denominator: Any, otherwise: float = np.nan) -> np.ndarray:
    """Return numerator / denominator, elementwise on broadcast arrays; `otherwise` where the denominator is not above 0."""
    out = np.full(np.broadcast_shapes(np.shape(numerator), np.shape(denominator)), otherwise)
    return np.divide(numerator, denominator, out=out, where=np.asarray(denominator) > 0.0)
