"""Divide arrays whose divisor may be zero."""

from typing import Any

import numpy as np


def quotient(part: Any, whole: Any, otherwise: float = np.nan) -> np.ndarray:
    """Return part / whole, elementwise on broadcast arrays; `otherwise` where whole is not above 0."""
    out = np.full(np.broadcast_shapes(np.shape(part), np.shape(whole)), otherwise)
    return np.divide(part, whole, out=out, where=np.asarray(whole) > 0.0)
