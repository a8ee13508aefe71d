"""Evaluate cubic splines with evenly spaced knots in [0, 1] inside compiled formulas; each contact has its own spline."""

from functools import lru_cache

import numpy as np

from stiction.engine.compiled import formula

SEGMENTS = 56


@lru_cache(maxsize=1)
def to_coefficients() -> np.ndarray:
    """Return the matrix (SEGMENTS + 3, SEGMENTS + 1) that converts values at the knots to coefficients of a cubic B-spline.

    The spline satisfies the not-a-knot condition at both ends.
    """
    from scipy.interpolate import BSpline  # slow to import

    knots = np.arange(-3.0, SEGMENTS + 4.0)
    basis = BSpline(knots, np.eye(SEGMENTS + 3), 3)
    third = basis.derivative(3)
    same = np.stack([third(end + 0.5) - third(end - 0.5) for end in (1.0, SEGMENTS - 1.0)])
    return np.linalg.inv(np.concatenate([basis(np.arange(SEGMENTS + 1.0)), same]))[:, : SEGMENTS + 1]


@formula
def spline(y, coefficients):
    """Return the value of a cubic B-spline with the coefficients (SEGMENTS + 3,) at y, which is between 0 and 1."""
    place = min(y * SEGMENTS, SEGMENTS - 1e-9)
    knot = int(place)
    t = place - knot
    r = 1.0 - t
    return (
        r * r * r * coefficients[knot]
        + (3.0 * t * t * t - 6.0 * t * t + 4.0) * coefficients[knot + 1]
        + (3.0 * r * r * r - 6.0 * r * r + 4.0) * coefficients[knot + 2]
        + t * t * t * coefficients[knot + 3]
    ) / 6.0
