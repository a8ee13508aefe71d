"""Find where the tangential resistance of an adhesive elastic asperity changes between slip and yield (its kinks).

The tangential resistance is the smaller of slip and yield resistance. Slip resistance is the force of peeling; yield resistance
is the force at which the trailing edge yields. With the strength of adhesion S = sqrt(6 pi/theta) and the coordinate
u = S^(1/3) v of JKR's contact, the equations below depend only on e = eta S^(-2/3), Poisson's ratio nu, k = H/Y and K beta.
With y = v^3, both resistances are equal (docs/explanation/theory.md, section 3) where

    G(y) = [D s^2 + 3n(p-q) s y (y-1) + 3n^2 y^2 (y-1)^2] / y^(8/3)   equals   (e/(pi k))^2.

n, p and q are the stress coefficients of `edge_yield.coefficients`, D = p^2 + q^2 - pq, g = 4/sqrt(3 K beta), and s = g |y -
1/2| (corrected) or g sqrt(y^2 - 1/4) (as published). The crossings are bracketed between the turning points of G, so none can
be missed.
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula, lazy_kernel
from stiction.laws.asperity.roy_chowdhury_ghosh_1994 import unit_roots
from stiction.laws.tangential.shared.edge_yield import coefficients

# Largest v of an endless elastic asperity, for which y^(8/3) does not overflow.
_FARTHEST = 1e12
# y where loading starts (w = 0), where the slip resistance vanishes, and where unloading ends (dw/du = 0).
_TOUCH, _NO_SLIP, _LOST = 2.0 / 3.0, 1.0 / 2.0, 1.0 / 6.0


@formula
def _shape(nu, K_beta):
    """Return the coefficients of r^2, r y (y-1) and y^2 (y-1)^2 in the numerator of G(y), the function G of this module.

    Slip and yield resistance of an asperity are equal where G(y) equals a certain value. y = (u/S^(1/3))^3, with the
    coordinate u and the strength of adhesion S. r: slip resistance divided by a constant. nu: Poisson's ratio. K_beta: K
    times the tangential compliance.
    """
    n, p, q = coefficients(nu)
    g = 4.0 / math.sqrt(3.0 * K_beta)
    return (p * p + q * q - p * q) * g * g, 3.0 * n * (p - q) * g, 3.0 * n * n


@formula
def _numerator(y, shape, printed):
    """Return G(y) y^(8/3) and its derivative with respect to y, with the function G of this module.

    Slip and yield resistance of an asperity are equal where G(y) equals a certain value. y = (u/S^(1/3))^3, with the coordinate
    u and the strength of adhesion S. shape: coefficients from `_shape`. printed: whether the slip resistance follows eq (10) of
    soft_coating_2015 as published.
    """
    a, b, c = shape
    if printed:
        r = math.sqrt(y * y - 0.25)
        dr = y / r
    else:
        r, dr = abs(y - 0.5), math.copysign(1.0, y - 0.5)
    z = y * (y - 1.0)
    dz = 2.0 * y - 1.0
    return a * r * r + b * r * z + c * z * z, 2.0 * a * r * dr + b * (dr * z + r * dz) + 2.0 * c * z * dz


@formula
def _steepness(y, shape, printed):
    """Return the logarithmic slope d ln G / d ln y of the function G of this module.

    G, y, shape, printed: as in `_numerator`.
    """
    value, slope = _numerator(y, shape, printed)
    return y * slope / value - 8.0 / 3.0


@formula
def _turning_point(low, high, shape, printed):
    """Return the y between low and high at which the function G of this module has an extremum, or `high` if there is none.

    G, y, shape, printed: as in `_numerator`. The search is regula falsi (Illinois variant). An accuracy of 1e-8 is enough: G is
    flat at an extremum, so its value there is accurate to 1e-16.
    """
    at_low, at_high = _steepness(low, shape, printed), _steepness(high, shape, printed)
    if (at_low < 0.0) == (at_high < 0.0):
        return high
    last = low
    for _ in range(60):
        middle = high - at_high * (high - low) / (at_high - at_low)
        value = _steepness(middle, shape, printed)
        if (value < 0.0) == (at_high < 0.0):
            at_low *= 0.5
        else:
            low, at_low = high, at_high
        high, at_high = middle, value
        if abs(middle - last) <= 1e-8 * middle or value == 0.0:
            break
        last = middle
    return high


@formula
def _dip(nu, shape, printed):
    """Return the two y between which the function G of this module falls; if G only rises, both are the y of first touch.

    nu: Poisson's ratio. G, y, shape, printed: as in `_numerator`. As y grows from first touch, d ln G/d ln y falls to a
    single minimum, then rises to 4/3.
    """
    lowest, least, ratio = _TOUCH, 0.1, 1.4
    y = _TOUCH
    while y < 8.0 / (1.0 - 2.0 * nu):
        y *= ratio
        value, slope = _numerator(y, shape, printed)
        excess = y * slope - 8.0 / 3.0 * value  # steepness times G y^(8/3); its sign is mostly sufficient
        if excess < least * value:
            lowest, least = y, excess / value
    if 0.0 <= least < 0.1:  # the true minimum, between the samples, may be negative
        low, high = lowest / ratio, lowest * ratio
        for _ in range(20):
            third = (high - low) / 3.0
            if _steepness(low + third, shape, printed) < _steepness(high - third, shape, printed):
                high -= third
            else:
                low += third
        lowest = 0.5 * (low + high)
        least = _steepness(lowest, shape, printed)
    if least >= 0.0:
        return _TOUCH, _TOUCH
    down = _turning_point(_TOUCH, lowest, shape, printed)
    return down, _turning_point(lowest, 16.0 / (1.0 - 2.0 * nu), shape, printed)


@formula
def _crossing(low, high, level, shape, printed):
    """Return v between low and high at which slip and yield resistance are equal, G(v^3) = level, or `high` if there is none.

    v: coordinate u divided by S^(1/3), with the strength of adhesion S. G: function of this module, which must be monotonic
    between low and high. shape, printed: as in `_numerator`. Bracketed Newton's method is applied to the fourth root of G,
    which is almost linear for large v.
    """
    if not high > low:
        return high
    above = _numerator(low**3, shape, printed)[0] > level * low**8
    if above == (_numerator(high**3, shape, printed)[0] > level * high**8):
        return high
    v = 0.5 * (low + high)
    for _ in range(100):
        v3 = v * v * v
        value, slope = _numerator(v3, shape, printed)
        power = level * v3 * v3 * v * v
        if (value > power) == above:
            low = v
        else:
            high = v
        step = 4.0 * v * value * (1.0 - math.sqrt(math.sqrt(power / value))) / (3.0 * slope * v3 - 8.0 * value)
        if abs(step) <= 4e-15 * v:
            return v - step
        v = v - step if low < v - step < high else 0.5 * (low + high)
    return v


@formula
def _unloading_kinks(out, level, shape):
    """Fill out[0:6] with the kinks v at and below first touch, which an asperity reaches only during unloading.

    v: coordinate u divided by S^(1/3), with the strength of adhesion S. level: value of the function G of this module at
    which slip and yield resistance are equal. shape: coefficients from `_shape`. The slip resistance vanishes at v^3 = 1/2,
    and G has one extremum on either side.
    """
    lost, none, touch = _LOST ** (1.0 / 3.0), _NO_SLIP ** (1.0 / 3.0), _TOUCH ** (1.0 / 3.0)
    left = _turning_point(_LOST, _NO_SLIP - 1e-9, shape, False) ** (1.0 / 3.0)
    right = _turning_point(_NO_SLIP + 1e-9, _TOUCH, shape, False) ** (1.0 / 3.0)
    out[0] = none
    out[1] = touch
    out[2] = _crossing(lost, left, level, shape, False)
    out[3] = _crossing(left, none, level, shape, False)
    out[4] = _crossing(none, right, level, shape, False)
    out[5] = _crossing(right, touch, level, shape, False)


@lazy_kernel(worth=3_000)
def _fill_kinks(level, end, nu, K_beta, printed, unloading, kinks):
    """Fill `kinks` (n, 3 or 9) with the coordinates v, up to `end` (n,), at which the resistance of n contacts has a kink.

    v: coordinate u divided by S^(1/3), with the strength of adhesion S. The first three columns are the v above first touch
    (v^3 = 2/3) at which slip and yield resistance are equal. With `unloading` the segment starts at a smaller v, and six
    columns follow: the v at which the slip resistance vanishes, v at first touch, and four values below first touch at
    which both resistances are equal. A crossing that does not exist is replaced by the upper end of its interval. level
    (n,): value of the function G of this module at which both resistances are equal. nu (n,): Poisson's ratio. K_beta (n,):
    (4/3) E* times the tangential compliance and the mode-mixity share. printed: as in `_numerator`.
    """
    touch = _TOUCH ** (1.0 / 3.0)
    down, up, shape = touch, touch, (0.0, 0.0, 0.0)
    for i in range(level.size):
        if i == 0 or nu[i] != nu[i - 1] or K_beta[i] != K_beta[i - 1]:
            shape = _shape(nu[i], K_beta[i])
            down, up = _dip(nu[i], shape, printed)
            down, up = down ** (1.0 / 3.0), up ** (1.0 / 3.0)
        out = kinks[i]
        out[0] = _crossing(touch, min(down, end[i]), level[i], shape, printed)
        out[1] = _crossing(down, min(up, end[i]), level[i], shape, printed)
        out[2] = _crossing(up, end[i], level[i], shape, printed)
        if unloading:
            _unloading_kinks(out[3:], level[i], shape)


def kinks_of(
    groups: Groups, K_beta: np.ndarray, last: np.ndarray, printed: bool, unloading: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Return the kinks (n, 5 or 11) of min(slip, yield resistance) and the branch point (n,) of the yield resistance.

    Both are values of the coordinate u of an adhesive elastic asperity. Below the branch point the yield condition has no real
    root. K_beta (n,): K beta times the mode-mixity share. last (n,): u at the end of the elastic asperity. printed: use eq (10)
    of soft_coating_2015 as published. unloading: start at the smallest stable contact instead of first touch; this adds six
    kinks. A kink that does not exist is placed at an end of the segment or outside it.
    """
    scale = np.sqrt(6.0 * math.pi / groups.theta) ** (1.0 / 3.0)
    e = groups.eta / (scale * scale)
    n, p, q = coefficients(groups.nu)
    # Coefficients of e for the first two kinks: the yield condition has a real root from the first kink on, and a positive
    # root up to the second.
    positive = 1.0 / (math.sqrt(3.0) * n * math.pi * groups.hardness_to_yield)
    real = 2.0 * np.sqrt(p * p + q * q - p * q) / (p + q) * positive
    kinks = np.empty((len(e), 5 + 6 * unloading))
    kinks[:, 0], kinks[:, 1] = unit_roots(real * e), unit_roots(-positive * e)
    level, crossings = (e / (math.pi * groups.hardness_to_yield)) ** 2, np.empty((len(e), kinks.shape[1] - 2))
    _fill_kinks(level, np.minimum(last / scale, _FARTHEST), groups.nu, K_beta, printed, unloading, crossings)
    kinks[:, 2:] = crossings
    kinks *= scale[:, None]
    return kinks, kinks[:, 0].copy()
