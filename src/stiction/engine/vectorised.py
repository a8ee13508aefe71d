"""Evaluate elementary functions by polynomials, so that the compiler can vectorise loops that use them."""

import math

import numpy as np

from stiction.engine.compiled import formula

_LOG2E = 1.4426950408889634
_ROUNDS = 1.5 * 2.0**52  # adding this rounds to an integer, because the sum has no bits left for a fraction
_LN2_HIGH = 6.93147180369123816490e-01  # ln 2 in two parts, so that k * high is exact (W. J. Cody and W. Waite 1980)
_LN2_LOW = 1.90821492927058770002e-10
_PI = math.pi
_LN2 = math.log(2.0)
_NEAR, _FAR, _BORDER = math.tan(_PI / 16.0), math.tan(3.0 * _PI / 16.0), math.tan(_PI / 8.0)
_SQRT2 = math.sqrt(2.0)
_SQRT_HALF_BITS = int(np.float64(math.sqrt(0.5)).view(np.int64))


@formula
def exponential(x):
    """Return exp(x) for x <= 0, with a relative error of at most 2e-16; the result is 0 for x <= -708."""
    shifted = x * _LOG2E + _ROUNDS  # the last bits are the integer k nearest to x/ln 2
    k = shifted - _ROUNDS
    r = (x - k * _LN2_HIGH) - k * _LN2_LOW
    # The polynomial of degree 11 interpolates exp on |r| <= ln(2)/2 at Chebyshev nodes, to within 1.7e-17.
    p = 2.5110049204818658e-08
    p = p * r + 2.763265472252779e-07
    p = p * r + 2.755724088722987e-06
    p = p * r + 2.4801485441561313e-05
    p = p * r + 1.9841269890076403e-04
    p = p * r + 1.3888888952352863e-03
    p = p * r + 8.333333333319589e-03
    p = p * r + 4.166666666648795e-02
    p = p * r + 1.666666666666668e-01
    p = p * r + 5.000000000000019e-01
    p = p * r + 1.0
    p = p * r + 1.0
    power = np.int64(np.float64(shifted).view(np.int64) << np.int64(52))  # k moved to the exponent bits
    return np.int64(np.float64(p).view(np.int64) + power).view(np.float64) if x > -708.0 else 0.0


@formula
def arctan(v):
    """Return arctan v, in radians, for v >= 0, with a relative error of at most 2e-16."""
    r = 1.0 / v if v > 1.0 else v
    center = _FAR if r > _BORDER else _NEAR
    r = (r - center) / (1.0 + r * center)  # within tan(pi/16) of zero: the Taylor series needs 12 terms
    z = -r * r
    p = 1.0 / 23.0
    p = p * z + 1.0 / 21.0
    p = p * z + 1.0 / 19.0
    p = p * z + 1.0 / 17.0
    p = p * z + 1.0 / 15.0
    p = p * z + 1.0 / 13.0
    p = p * z + 1.0 / 11.0
    p = p * z + 1.0 / 9.0
    p = p * z + 1.0 / 7.0
    p = p * z + 1.0 / 5.0
    p = p * z + 1.0 / 3.0
    p = p * z + 1.0
    angle = (3.0 * _PI / 16.0 if center == _FAR else _PI / 16.0) + r * p
    return 0.5 * _PI - angle if v > 1.0 else angle


@formula
def log_quotient(z):
    """Return ln(1 + z)/z for z >= 0 (1 at z = 0), with a relative error of at most 4e-16."""
    small = z < _SQRT2 - 1.0
    bits = np.float64(1.0 + z).view(np.int64)
    k = (bits - np.int64(_SQRT_HALF_BITS)) >> np.int64(52)
    f = z if small else np.int64(bits - (k << np.int64(52))).view(np.float64) - 1.0  # 1 + z = 2^k (1 + f)
    s = f / (2.0 + f)
    t = s * s
    p = 1.0 / 23.0  # ln(1 + f) = 2 artanh s, |s| < 0.172
    p = p * t + 1.0 / 21.0
    p = p * t + 1.0 / 19.0
    p = p * t + 1.0 / 17.0
    p = p * t + 1.0 / 15.0
    p = p * t + 1.0 / 13.0
    p = p * t + 1.0 / 11.0
    p = p * t + 1.0 / 9.0
    p = p * t + 1.0 / 7.0
    p = p * t + 1.0 / 5.0
    p = p * t + 1.0 / 3.0
    p = p * t + 1.0
    return 2.0 / (2.0 + z) * p if small else (np.float64(k) * _LN2 + 2.0 * s * p) / z
