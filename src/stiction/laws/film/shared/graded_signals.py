"""Define functions of the coordinate u ("signals") whose zeros are the kinks of a graded film's law, and find their zeros.

Each signal is smooth, except for a kink where the asperity begins to flow plastically. `law` is the tuple of parameters that
`graded_law.along` takes, without the plateaus.
"""

import math

import numpy as np

from stiction.engine.compiled import formula, lazy_kernel
from stiction.laws.asperity.shared.transition import FULLY_PLASTIC, plastic_share
from stiction.laws.film.shared.graded_law import ALONE, contact, fading
from stiction.laws.tangential.shared.edge_yield import coefficients

NEARER = 0.3  # a near miss is examined if the parabola through it comes closer to zero by this fraction


@formula
def signals(u, law):
    """Return five numbers at the coordinate u whose sign changes are kinks of the law of a graded film.

    They are zero, in this order, where the asperity first yields; where it becomes fully plastic; where the yield resistance
    stops being real in tension (a branch point, S3.9); where the yield resistance vanishes in compression (S3.10); and where
    slip and yield resistance are equal (S3.11, divided by the strength). law: parameters of an asperity on a graded film.
    """
    pull, eta, n_H, linear, square, nu_s, nu_c, Kb_s, Kb_c, yield_s, yield_c = law[:ALONE]
    S = math.sqrt(6.0 * pull)
    w, _, Q, _, share = contact(u, S, law[ALONE:])
    film = fading(w, linear, square)
    x = u * u * u * u
    load, flowing = Q * (Q - S), eta * (1.0 + (n_H - 1.0) * film) * x
    strength = eta * x * (yield_s + (yield_c - yield_s) * film)
    ratio = load / flowing
    n, p, q = coefficients(nu_s + (nu_c - nu_s) * share)
    d = p * p + q * q - p * q
    P = min(load, flowing) / strength
    K_beta = Kb_s + (Kb_c - Kb_s) * share
    T = 4.0 * math.sqrt(max(2.0 * pull * P + 3.0 * pull * pull / strength, 0.0) / (K_beta * strength))
    squeeze = math.sqrt(3.0) * n * P
    balance = squeeze * squeeze + 3.0 * n * (p - q) * P * T + d * T * T - 1.0
    real = 2.0 * math.sqrt(d) + (p + q) * squeeze
    return ratio - 1.0, ratio - FULLY_PLASTIC, real, 1.0 - squeeze, balance


@formula
def load_before_plateaus(u, law):
    """Return the load P without plateaus, dP/d(ln u) in scaled form, and the ratio of elastic mean pressure to hardness.

    The derivative dP/d(ln u) is divided by hardness times contact area, so it is of order one. u: coordinate. law: parameters
    of an asperity on a graded film.
    """
    pull, eta, n_H, linear, square = law[:5]
    S = math.sqrt(6.0 * pull)
    w, slope, Q, growth, _ = contact(u, S, law[ALONE:])
    film = fading(w, linear, square)
    x, dx = u * u * u * u, 4.0 * u * u * u
    elastic, d_elastic = Q * (Q - S), (2.0 * Q - S) * Q * growth / u
    hardness = eta * (1.0 + (n_H - 1.0) * film)
    d_hardness = -eta * (n_H - 1.0) * film * (linear + 2.0 * square * max(w, 0.0)) * slope
    flowing, d_flowing = hardness * x, d_hardness * x + hardness * dx
    ratio = elastic / flowing
    d_ratio = (d_elastic - ratio * d_flowing) / flowing
    f, df = plastic_share(ratio)
    full, d_full = 2.0 * (hardness * w - pull), 2.0 * (d_hardness * w + hardness * slope)
    capped = min(elastic, flowing)
    d_capped = d_elastic if ratio <= 1.0 else d_flowing
    load = capped + f * (full - capped)
    slope = d_capped + df * d_ratio * (full - capped) + f * (d_full - d_capped)
    return load, slope * u / flowing, ratio


# Numbers of the functions of u whose zeros are searched for: five signals (0 to 4), slope of the load, load minus a level.
REAL, SQUEEZED, BALANCE, SLOPE, ABOVE = 2, 3, 4, 5, 6
# Numbers are passed as entries of this array, because each literal constant would compile another kernel.
NUMBERS = np.arange(7)


@lazy_kernel(worth=100_000)
def signal(which, u, law, level):
    """Return the value of function number `which` of an asperity on a graded film at the coordinate u.

    Callers search for zeros of this function. which: 0 to 4 select an entry of `signals`, SLOPE selects the slope of the load
    (see `load_before_plateaus`), ABOVE the load minus `level`. level: used with ABOVE only. law: parameters of an asperity on a
    graded film.
    """
    if which < SLOPE:
        return signals(u, law)[which]
    load, slope, _ = load_before_plateaus(u, law)
    return slope if which == SLOPE else load - level


@lazy_kernel(worth=100_000)
def zero(which, low, at_low, high, at_high, law, level):
    """Return the coordinate between low and high at which the function `which` is zero, by the method of false position.

    which, law, level: as in `signal`. at_low, at_high: values at low and high, of opposite sign. The method is from Anderson &
    Bjorck 1973; some steps bisect the bracket. The relative accuracy is 4e-15 for ABOVE, SLOPE and REAL, and 1e-9
    for the other functions. The yield resistance jumps at the zero of REAL.
    """
    fine, small = (4e-15, 0.0) if which == REAL or which >= SLOPE else (1e-9, 1e-11)
    u = last = low
    for turn in range(90):
        u = high - at_high * (high - low) / (at_high - at_low)
        if turn % 8 == 7 or turn > 30 or not low < u < high:
            u = 0.5 * (low + high)
        value = signal(which, u, law, level)
        step = abs(u - last) / u
        if value == 0.0 or step <= 4e-15 or (step <= fine and abs(value) <= small):
            break
        if (value > 0.0) == (at_high > 0.0):
            shrink = 1.0 - value / at_high
            at_low *= shrink if shrink > 0.0 else 0.5
            high, at_high = u, value
        else:
            shrink = 1.0 - value / at_low
            at_high *= shrink if shrink > 0.0 else 0.5
            low, at_low = u, value
        last = u
    return u


@lazy_kernel(worth=100_000)
def beyond_zero(which, left, at_left, u, at_u, right, at_right, law):
    """Search for a sign change of a function between two coordinates at which it has the same sign.

    which, law: as in `signal`. left, u, right: coordinates in ascending order; at_left, at_u, at_right: values at these
    coordinates, almost zero at u. The search fits parabolas through three points. Returns a coordinate and the value there.
    The value has the opposite sign or, if no such coordinate is found, is the closest to zero.
    """
    for turn in range(25):
        p, q = (u - left) * (at_u - at_right), (u - right) * (at_u - at_left)
        if p == q:
            break
        vertex = u - 0.5 * ((u - left) * p - (u - right) * q) / (p - q)
        if not left < vertex < right or abs(vertex - u) < 1e-3 * (right - left):
            vertex = u + 0.1 * ((right - u) if right - u > u - left else (left - u))
        value = signal(which, vertex, law, 0.0)
        if (value > 0.0) != (at_u > 0.0):
            return vertex, value
        if abs(value) < abs(at_u):
            saved = 1.0 - value / at_u
            if vertex > u:
                left, at_left = u, at_u
            else:
                right, at_right = u, at_u
            u, at_u = vertex, value
            if turn > 3 and saved < 0.01:  # this is the extremum
                break
        elif vertex > u:
            right, at_right = vertex, value
        else:
            left, at_left = vertex, value
        if right - left < 1e-7 * u:
            break
    return u, at_u


@formula
def comes_near(before, current, following, small):
    """Return whether a function, given by three samples of the same sign, has an extremum close to zero between them.

    before, current, following: the three samples. The middle one must be smaller than `small` in absolute value, or the
    parabola through all three must come much closer to zero than the samples.
    """
    rise, bend = following - before, following - 2.0 * current + before
    turns = (current - before) * (following - current) < 0.0 and bend * current > 0.0 and before * current > 0.0
    near = rise * rise > 8.0 * NEARER * bend * current or abs(current) < small
    return turns and near
