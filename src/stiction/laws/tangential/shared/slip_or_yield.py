"""Where the resistance min(slip, yield) of an adhesive elastic asperity has kinks: the edges of its regimes.

With S = sqrt(6 pi/theta) and u = S^(1/3) v, everything below depends on e = eta S^(-2/3), nu, k and K beta alone. At
y = v^3 slip and yield are equal (docs/theory.md, section 3) where
    G(y) = [d s^2 + 3n(p-q) s y (y-1) + 3n^2 y^2 (y-1)^2] / y^(8/3)   equals   (e/(pi k))^2,
d = p^2 + q^2 - pq, s = g |y - 1/2| (corrected) or g sqrt(y^2 - 1/4) (as printed), g = 4/sqrt(3 K beta). G is known, so
its crossings are bracketed between its own turning points: none can be missed.
"""

import math

from stiction.engine.compiled import formula, kernel
from stiction.laws.asperity.roy_chowdhury_ghosh_1994 import largest_root
from stiction.laws.tangential.shared.edge_yield import coefficients

# An elastic asperity without end ends here, in v: y^(8/3) still has all its digits.
_FARTHEST = 1e12
# y where loading starts (w = 0), where the slip resistance vanishes, and where unloading ends (dw/du = 0).
_TOUCH, _NO_SLIP, _LOST = 2.0 / 3.0, 1.0 / 2.0, 1.0 / 6.0
LOADING_KINKS, UNLOADING_KINKS = 5, 11


@formula
def _numerator(y, nu, K_beta, printed):
    """G(y) y^(8/3), and its derivative by y."""
    n, p, q = coefficients(nu)
    g = 4.0 / math.sqrt(3.0 * K_beta)
    if printed:
        root = math.sqrt(y * y - 0.25)
        s, ds = g * root, g * y / root
    else:
        s, ds = g * abs(y - 0.5), math.copysign(g, y - 0.5)
    d, b, c = p * p + q * q - p * q, 3.0 * n * (p - q), 3.0 * n * n
    z = y * (y - 1.0)
    dz = 2.0 * y - 1.0
    return d * s * s + b * s * z + c * z * z, 2.0 * d * s * ds + b * (ds * z + s * dz) + 2.0 * c * z * dz


@formula
def _steepness(y, nu, K_beta, printed):
    """d ln G / d ln y."""
    value, slope = _numerator(y, nu, K_beta, printed)
    return y * slope / value - 8.0 / 3.0


@formula
def _turning_point(low, high, nu, K_beta, printed):
    """A zero of the steepness between two places (the second of them, if its sign is the same at both): regula falsi, Illinois
    variant. To 1e-8, which is enough: G is flat there, so a crossing between this and the true turning point is within
    1e-16 of touching."""
    at_low, at_high = _steepness(low, nu, K_beta, printed), _steepness(high, nu, K_beta, printed)
    if (at_low < 0.0) == (at_high < 0.0):
        return high
    last = low
    for _ in range(60):
        middle = high - at_high * (high - low) / (at_high - at_low)
        here = _steepness(middle, nu, K_beta, printed)
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
def _dip(nu, K_beta, printed):
    """Where G turns down and up again above the touching point, or that point twice where it only rises.

    The steepness falls from the touching point to one lowest value and rises to 4/3 from there.
    """
    lowest, least, ratio = _TOUCH, 0.1, 1.4
    y = _TOUCH
    while y < 8.0 / (1.0 - 2.0 * nu):
        y *= ratio
        value, slope = _numerator(y, nu, K_beta, printed)
        excess = y * slope - 8.0 / 3.0 * value  # the steepness times G y^(8/3): mostly this is enough to know
        if excess < least * value:
            lowest, least = y, excess / value
    if 0.0 <= least < 0.1:  # near enough to zero for the true lowest value, between the samples, to be below
        low, high = lowest / ratio, lowest * ratio
        for _ in range(20):
            third = (high - low) / 3.0
            if _steepness(low + third, nu, K_beta, printed) < _steepness(high - third, nu, K_beta, printed):
                high -= third
            else:
                low += third
        lowest = 0.5 * (low + high)
        least = _steepness(lowest, nu, K_beta, printed)
    if least >= 0.0:
        return _TOUCH, _TOUCH
    down = _turning_point(_TOUCH, lowest, nu, K_beta, printed)
    return down, _turning_point(lowest, 16.0 / (1.0 - 2.0 * nu), nu, K_beta, printed)


@formula
def _crossing(low, high, level, nu, K_beta, printed):
    """The v in (low, high), where G is monotonic, with G(v^3) = level; `high` if there is none. Newton, bracketed."""
    if not high > low:
        return high
    above = _numerator(low**3, nu, K_beta, printed)[0] > level * low**8
    if above == (_numerator(high**3, nu, K_beta, printed)[0] > level * high**8):
        return high
    v = 0.5 * (low + high)
    for _ in range(100):
        v3 = v * v * v
        value, slope = _numerator(v3, nu, K_beta, printed)
        power = level * v3 * v3 * v
        excess = value - power * v
        if (excess > 0.0) == above:
            low = v
        else:
            high = v
        last = v
        v -= excess / (3.0 * slope * v * v - 8.0 * power)
        if not low < v < high:
            v = 0.5 * (low + high)
        if abs(v - last) <= 4e-15 * v:
            break
    return v


@formula
def _unloading_kinks(out, level, nu, K_beta):
    """Fill out[0:6] with the kinks below the touching point: the slip resistance vanishes at y = 1/2, and G turns once on
    either side of that."""
    lost, none, touch = _LOST ** (1.0 / 3.0), _NO_SLIP ** (1.0 / 3.0), _TOUCH ** (1.0 / 3.0)
    left = _turning_point(_LOST, _NO_SLIP - 1e-9, nu, K_beta, False) ** (1.0 / 3.0)
    right = _turning_point(_NO_SLIP + 1e-9, _TOUCH, nu, K_beta, False) ** (1.0 / 3.0)
    out[0] = none
    out[1] = touch
    out[2] = _crossing(lost, left, level, nu, K_beta, False)
    out[3] = _crossing(left, none, level, nu, K_beta, False)
    out[4] = _crossing(none, right, level, nu, K_beta, False)
    out[5] = _crossing(right, touch, level, nu, K_beta, False)


@kernel
def fill_kinks(S, eta, K_beta, nu, k, last, printed, unloading, kinks, branch):
    """Kinks (n, 5 or 11) in u of the resistance of n laws, and the branch point (n,) of their yield resistance.

    S, eta, K_beta, nu, k: arrays (n,). last: where the elastic asperity ends, (n,). printed: the slip resistance of eq (10) of
    the 2015 paper to the letter. unloading: from the smallest stable contact on, with UNLOADING_KINKS kinks, not from the
    touching point. A kink that is not there lies at an end, or outside.
    """
    touch = _TOUCH ** (1.0 / 3.0)
    down = up = touch
    for i in range(S.size):
        n, p, q = coefficients(nu[i])
        scale = S[i] ** (1.0 / 3.0)
        e = eta[i] / (scale * scale)
        level = (e / (math.pi * k[i])) ** 2
        end = min(last[i] / scale, _FARTHEST)
        # The yield condition has a real root from here on, and a positive one up to there.
        positive = 1.0 / (math.sqrt(3.0) * n * math.pi * k[i])
        real = 2.0 * math.sqrt(p * p + q * q - p * q) / (p + q) * positive
        if i == 0 or nu[i] != nu[i - 1] or K_beta[i] != K_beta[i - 1]:
            down, up = _dip(nu[i], K_beta[i], printed)
            down, up = down ** (1.0 / 3.0), up ** (1.0 / 3.0)
        out = kinks[i]
        out[0] = largest_root(real * e, 1.0)
        out[1] = largest_root(-positive * e, 1.0)
        out[2] = _crossing(touch, min(down, end), level, nu[i], K_beta[i], printed)
        out[3] = _crossing(down, min(up, end), level, nu[i], K_beta[i], printed)
        out[4] = _crossing(up, end, level, nu[i], K_beta[i], printed)
        if unloading:
            _unloading_kinks(out[5:], level, nu[i], K_beta[i])
        branch[i] = out[0] * scale
        for at in range(out.size):
            out[at] *= scale
