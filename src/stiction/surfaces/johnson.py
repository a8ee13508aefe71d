"""Transform Gaussian variables to variables with a given skewness and kurtosis: Johnson's system (1949).

A height is an increasing function of a standard Gaussian variable z. With u = (z - gamma) / delta, the height, apart from its
mean and scale, is one of three functions:

    sinh u            unbounded     kurtosis above the lognormal line
    exp u             lognormal     on the line: with w = exp(1 / delta^2), skewness^2 = (w - 1) (w + 2)^2,
                                    kurtosis = w^4 + 2 w^3 + 3 w^2 - 3
    1 / (1 + e^-u)    bounded       below the line, down to the limit skewness^2 + 1

Every possible pair of skewness >= 0 and kurtosis has exactly one such function, except the Gaussian pair 0 and 3, for which the
height is z itself. For a negative skewness, the function f(z) for the opposite skewness is mirrored: -f(-z). Kurtosis is the
standardised fourth moment, 3 for a Gaussian distribution.

scipy.stats has these functions as johnsonsu, lognorm and johnsonsb, but fits them to data and not to given moments. It has no
closed form for the moments of the bounded function. This module therefore computes the moments of all three by one quadrature
rule.
"""

import math
from collections.abc import Callable
from numbers import Real

import numpy as np
from scipy.optimize import brentq, least_squares
from scipy.special import expit

from stiction.quantities.errors import InputError

# The trapezoidal rule is exact to round-off for integrands that fall off like a Gaussian.
_Z = np.linspace(-16.0, 16.0, 3201)
_WEIGHT = np.exp(-0.5 * _Z * _Z) * (_Z[1] - _Z[0]) / math.sqrt(2.0 * math.pi)

_NEAR = 2e-3  # a kurtosis this close to the lognormal line counts as on it, because the other two functions end there
_AGREED = 1e-6  # largest remaining difference in skewness and kurtosis
_LARGEST = 50.0  # largest kurtosis; above it, no map has enough points for the mean fourth power to converge


def johnson(skewness: float, kurtosis: float) -> Callable[[np.ndarray], np.ndarray]:
    """Return an increasing function that gives Gaussian variables this skewness and kurtosis.

    The function maps an array of standard Gaussian variables to variables with mean 0 and variance 1. kurtosis: above
    skewness^2 + 1 and at most 50; a Gaussian has 3. Raises InputError otherwise, or if no function is found for a kurtosis
    close to its lower limit, where the heights would take only two values.
    """
    for name, value in (("skewness", skewness), ("kurtosis", kurtosis)):
        if isinstance(value, bool) or not isinstance(value, Real) or abs(value) > 1e100:
            raise InputError(name, value, "a finite number")
    limit = skewness * skewness + 1.0
    if not (math.isfinite(skewness) and limit < kurtosis <= _LARGEST):
        raise InputError(
            "kurtosis", kurtosis, f"above {limit:g}, which is skewness^2 + 1, and at most {_LARGEST:g}; 3 for Gaussian heights"
        )
    if skewness < 0.0:
        mirrored = johnson(-skewness, kurtosis)
        return lambda z: -mirrored(-z)
    over = kurtosis - _lognormal_kurtosis(skewness)
    if abs(over) > _NEAR:
        return _standardised(*_fitted(_unbounded if over > 0.0 else _bounded, skewness, kurtosis))
    if skewness < _NEAR:
        return lambda z: np.array(z, dtype=float)
    return _standardised(_lognormal, math.log(_lognormal_base(skewness)) ** -0.5, 0.0)


def _unbounded(z, delta, gamma):
    return np.sinh((z - gamma) / delta)


def _bounded(z, delta, gamma):
    return expit((z - gamma) / delta)


def _lognormal(z, delta, gamma):
    return np.exp((z - gamma) / delta)


def _lognormal_base(skewness: float) -> float:
    """Return w = exp(1 / delta^2) of the lognormal distribution with this skewness (delta as in the module docstring)."""
    return brentq(lambda w: (w - 1.0) * (w + 2.0) ** 2 - skewness**2, 1.0, 2.0 + abs(skewness))


def _lognormal_kurtosis(skewness: float) -> float:
    w = _lognormal_base(skewness)
    return w**4 + 2.0 * w**3 + 3.0 * w**2 - 3.0


def _mean_and_deviation(curve, delta, gamma) -> tuple[float, float]:
    values = curve(_Z, delta, gamma)
    mean = float(_WEIGHT @ values)
    return mean, math.sqrt(float(_WEIGHT @ (values - mean) ** 2))


def _skewness_and_kurtosis(curve, delta, gamma) -> tuple[float, float]:
    mean, deviation = _mean_and_deviation(curve, delta, gamma)
    over = (curve(_Z, delta, gamma) - mean) / deviation
    return float(_WEIGHT @ over**3), float(_WEIGHT @ over**4)


def _fitted(curve, skewness: float, kurtosis: float):
    """Return (curve, delta, gamma) of the function of Johnson's system that has this skewness (>= 0) and kurtosis.

    curve: `_bounded` or `_unbounded`, a function of (z, delta, gamma). The search starts from the best points of a coarse grid
    of both parameters. It varies gamma / delta instead of gamma, because that ratio stays of order one. Raises InputError if it
    fails.
    """
    sign = -1.0 if curve is _unbounded else 1.0

    def difference(x):
        delta = math.exp(x[0])
        found = _skewness_and_kurtosis(curve, delta, sign * x[1] * delta)
        return np.array([found[0] - skewness, found[1] - kurtosis])

    deltas = (0.3, 0.6, 1.0, 1.5, 2.5, 5.0, 20.0)[2 if curve is _unbounded else 0 :]  # for smaller ones sinh^4 is too large
    starts = [(math.log(delta), shift) for delta in deltas for shift in (0.0, 0.2, 0.5, 1.0, 2.0, 4.0)]
    starts.sort(key=lambda x: float(np.abs(difference(x)).max()))
    for start in starts[:3]:
        found = least_squares(difference, start, bounds=([-2.0, -0.1], [6.0, 12.0]), xtol=1e-15, ftol=1e-15, gtol=1e-15)
        if np.abs(found.fun).max() < _AGREED:
            delta = math.exp(found.x[0])
            return curve, delta, sign * found.x[1] * delta
    raise InputError(
        "kurtosis",
        kurtosis,
        f"a larger kurtosis, because no Johnson distribution was found near the limit for skewness {skewness:g}",
    )


def _standardised(curve, delta, gamma):
    mean, deviation = _mean_and_deviation(curve, delta, gamma)
    return lambda z: (curve(np.asarray(z, dtype=float), delta, gamma) - mean) / deviation
