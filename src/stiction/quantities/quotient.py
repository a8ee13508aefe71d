"""Divide arrays whose divisor may be zero."""

from typing import Any

import numpy as np


def quotient(part: Any, whole: Any, otherwise: float = np.nan) -> np.ndarray:
    """Return part / whole where whole > 0, and `otherwise` elsewhere; the arrays are broadcast."""
    out = np.full(np.broadcast_shapes(np.shape(part), np.shape(whole)), otherwise)
    return np.divide(part, whole, out=out, where=np.asarray(whole) > 0.0)
