"""Where the resistance min(slip, yield) of an adhesive elastic asperity has kinks: the edges of its regimes.

With S = sqrt(6 pi/theta) and u = S^(1/3) v, everything below depends on e = eta S^(-2/3), nu, k and K beta alone. At
y = v^3 slip and yield are equal (docs/theory.md, section 3) where
    G(y) = [d s^2 + 3n(p-q) s y (y-1) + 3n^2 y^2 (y-1)^2] / y^(8/3)   equals   (e/(pi k))^2,
d = p^2 + q^2 - pq, s = g r = g |y - 1/2| (corrected) or g sqrt(y^2 - 1/4) (as printed), g = 4/sqrt(3 K beta). G is known, so
its crossings are bracketed between its own turning points: none can be missed.
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula, lazy_kernel
from stiction.laws.asperity.roy_chowdhury_ghosh_1994 import unit_roots
from stiction.laws.tangential.shared.edge_yield import coefficients

# An elastic asperity without end ends here, in v: y^(8/3) still has all its digits.
_FARTHEST = 1e12
# y where loading starts (w = 0), where the slip resistance vanishes, and where unloading ends (dw/du = 0).
_TOUCH, _NO_SLIP, _LOST = 2.0 / 3.0, 1.0 / 2.0, 1.0 / 6.0


@formula
def _shape(nu, K_beta):
    """Return the coefficients of G that depend on the material.

    They multiply r^2, r y (y-1) and y^2 (y-1)^2, s = g r.
    """
    n, p, q = coefficients(nu)
    g = 4.0 / math.sqrt(3.0 * K_beta)
    return (p * p + q * q - p * q) * g * g, 3.0 * n * (p - q) * g, 3.0 * n * n


@formula
def _numerator(y, shape, printed):
    """Return G(y) y^(8/3), and its derivative by y."""
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
    """Return d ln G / d ln y."""
    value, slope = _numerator(y, shape, printed)
    return y * slope / value - 8.0 / 3.0


@formula
def _turning_point(low, high, shape, printed):
    """Find a zero of the steepness between two places by regula falsi (Illinois).

    Returns the second of them if its sign is the same at both. To 1e-8, which is enough: G is flat there, so a crossing between
    this and the true turning point is within 1e-16 of touching.
    """
    at_low, at_high = _steepness(low, shape, printed), _steepness(high, shape, printed)
    if (at_low < 0.0) == (at_high < 0.0):
        return high
    last = low
    for _ in range(60):
        middle = high - at_high * (high - low) / (at_high - at_low)
        here = _steepness(middle, shape, printed)
        if (here < 0.0) == (at_high < 0.0):
            at_low *= 0.5
        else:
            low, at_low = high, at_high
        high, at_high = middle, here
        if abs(middle - last) <= 1e-8 * middle or here == 0.0:
            break
        last = middle
    return high


@formula
def _dip(nu, shape, printed):
    """Where G turns down and up again above the touching point, or that point twice where it only rises.

    The steepness falls from the touching point to one lowest value and rises to 4/3 from there.
    """
    lowest, least, ratio = _TOUCH, 0.1, 1.4
    y = _TOUCH
    while y < 8.0 / (1.0 - 2.0 * nu):
        y *= ratio
        value, slope = _numerator(y, shape, printed)
        excess = y * slope - 8.0 / 3.0 * value  # the steepness times G y^(8/3): mostly this is enough to know
        if excess < least * value:
            lowest, least = y, excess / value
    if 0.0 <= least < 0.1:  # near enough to zero for the true lowest value, between the samples, to be below
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
    """Find the v in (low, high), where G is monotonic, with G(v^3) = level.

    Returns `high` if there is none. Bracketed Newton on the fourth root of G, which is nearly straight where v is large.
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
    """Fill out[0:6] with the kinks below the touching point.

    The slip resistance vanishes at y = 1/2, and G turns once on either side.
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
    """Kinks (n, 3 or 9) in v where slip and yield are equal, on asperities that end at `end`."""
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
    """Kinks (n, 5 or 11) in u of the resistance of n laws, and the branch point (n,) of their yield resistance.

    K_beta: with what weighs the tangential compliance. last: where the elastic asperity ends, (n,). printed: the slip
    resistance of eq (10) of the 2015 paper to the letter. unloading: from the smallest stable contact on, not from the touching
    point. A kink that is not there lies at an end, or outside.
    """
    scale = np.sqrt(6.0 * math.pi / groups.theta) ** (1.0 / 3.0)
    e = groups.eta / (scale * scale)
    n, p, q = coefficients(groups.nu)
    # The yield condition has a real root from here on, and a positive one up to there.
    positive = 1.0 / (math.sqrt(3.0) * n * math.pi * groups.hardness_to_yield)
    real = 2.0 * np.sqrt(p * p + q * q - p * q) / (p + q) * positive
    kinks = np.empty((len(e), 5 + 6 * unloading))
    kinks[:, 0], kinks[:, 1] = unit_roots(real * e), unit_roots(-positive * e)
    level, crossings = (e / (math.pi * groups.hardness_to_yield)) ** 2, np.empty((len(e), kinks.shape[1] - 2))
    _fill_kinks(level, np.minimum(last / scale, _FARTHEST), groups.nu, K_beta, printed, unloading, crossings)
    kinks[:, 2:] = crossings
    kinks *= scale[:, None]
    return kinks, kinks[:, 0].copy()
