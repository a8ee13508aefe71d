"""Division by what may be nothing."""

from typing import Any

import numpy as np


def quotient(part: Any, whole: Any, otherwise: float = np.nan) -> np.ndarray:
    """Return part/whole, and another number where the whole is not above 0; arrays that broadcast."""
    out = np.full(np.broadcast_shapes(np.shape(part), np.shape(whole)), otherwise)
    return np.divide(part, whole, out=out, where=np.asarray(whole) > 0.0)
