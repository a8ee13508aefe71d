"""Compute displacement, load and area of one elastic asperity on a film, without adhesion or with DMT's or JKR's adhesion.

The coordinate is u = x^(1/4), with x = a^2/(R sigma), a the contact radius, R the asperity radius and sigma the standard
deviation of the asperity heights. A row of parameters holds ln n_E, per_root = (R sigma)^(1/4)/sqrt(t_1) with t_1 the thickness
of one film, the strength of adhesion, and the coefficients of two or three curves (see `solvers.layered.curves`). n_E is the
contact modulus of the surfaces that meet, divided by the contact modulus of the bodies without films. The curves are functions
of z = (q - 1)/(q + 1), with q = per_root u. They give D in the approach D a^2/R, and the effective moduli E_P, E_S and B of the
layered contact, divided by the contact modulus of the bodies without films. Displacement, load, stiffness and area without
adhesion are

    w_H = D u^4,  P_H = E_P u^6,  dP_H/dw_H = (3/2) E_S u^2,  A = u^4

DMT's adhesion is a pull of 2 pi n_g/theta. JKR's adhesion follows from energy alone, for any layered bodies. At a given radius
the load is P_H minus the load of a flat punch, and the energy released at the contact edge equals the work of adhesion:

    w = w_H - s u/sqrt(B),  P = P_H - (3/2) s E_S u^3/sqrt(B),  s = (2/3) sqrt(6 pi n_g/theta)

theta is the adhesion index and n_g the work of adhesion with the film divided by the value without the film. In SI units delta
= delta_H - sqrt(4 pi a gamma/S'), P = P_H - S sqrt(4 pi a gamma/S'), S = 2 a E_S, S' = dS/da = 2 B (compare Barthel & Perriot
2007; the limit of short-ranged forces).
"""

import math

from stiction.engine.bisection import halving
from stiction.engine.compiled import formula
from stiction.engine.vectorised import exponential
from stiction.solvers.layered.curves import TERMS

# Numbers of parameters before the coefficients, of a row for Hertz and DMT, and of a row for JKR.
HEAD = 3
_APPROACH, PLAIN, EDGED = HEAD + TERMS, HEAD + 2 * TERMS, HEAD + 3 * TERMS
_MOST_STEPS = 100


@formula
def _place(u, per_root):
    """Return z, the argument of the film's curves, and dz/d ln u = (1 - z^2)/2.

    z = (q - 1)/(q + 1) with q = per_root u. u: coordinate of the asperity; where it is infinite, the two values are 1 and 0.
    """
    rest = 1.0 / (per_root * u + 1.0)
    return 1.0 - 2.0 * rest, 2.0 * rest * (1.0 - rest)


@formula
def _next(z, sums, coefficient):
    """Advance Horner's scheme at z by one coefficient; sums: (value, derivative) of the polynomial so far."""
    value, slope = sums
    return value * z + coefficient, slope * z + value


@formula
def _polynomial(z, c):
    """Return the polynomial Sum c_k z^k with 19 coefficients c, and its derivative with respect to z.

    The terms are written out because the compiler does not vectorise a loop over a tuple.
    """
    sums = _next(z, _next(z, _next(z, (c[18], 0.0), c[17]), c[16]), c[15])
    sums = _next(z, _next(z, _next(z, sums, c[14]), c[13]), c[12])
    sums = _next(z, _next(z, _next(z, sums, c[11]), c[10]), c[9])
    sums = _next(z, _next(z, _next(z, sums, c[8]), c[7]), c[6])
    sums = _next(z, _next(z, _next(z, sums, c[5]), c[4]), c[3])
    return _next(z, _next(z, _next(z, sums, c[2]), c[1]), c[0])


@formula
def _curve(z, by_u, c):
    """Return (1 - z^2) Sum c_k z^k at z, and its derivative with respect to ln u.

    c: the 19 coefficients. by_u: dz/d ln u = (1 - z^2)/2, with u the coordinate of the asperity.
    """
    value, slope = _polynomial(z, c)
    return 2.0 * by_u * value, by_u * (2.0 * by_u * slope - 2.0 * z * value)


@formula
def _hertzian(u, row):
    """Return z, dz/d ln u, E_P, D, d ln E_P/d ln u and d ln D/d ln u of a sphere without adhesion at the coordinate u.

    The normalised load is E_P u^6, the displacement D u^4. z: argument of the film's curves (see `_place`). row: parameters of
    the asperity.
    """
    z, by_u = _place(u, row[1])
    load, load_slope = _curve(z, by_u, row[HEAD:_APPROACH])
    approach, approach_slope = _curve(z, by_u, row[_APPROACH:PLAIN])
    E_P = exponential(0.5 * (1.0 - z) * row[0] + load)
    return z, by_u, E_P, exponential(approach), load_slope - 0.5 * by_u * row[0], approach_slope


@formula
def plain(u, *row):
    """Return displacement w, dw/du, load and area of an asperity without adhesion or with DMT's adhesion.

    u: coordinate, (a^2/(R sigma))^(1/4). row: parameters; the third is the pull that is subtracted from the load. Displacements
    are divided by sigma, loads by K R^(1/2) sigma^(3/2) and areas by pi R sigma, with K = (4/3) E* of the bodies without a
    film.
    """
    _, _, E_P, D, _, approach_slope = _hertzian(u, row)
    u3 = u * u * u
    return D * u3 * u, D * u3 * (4.0 + approach_slope), E_P * u3 * u3 - row[2], u3 * u


@formula
def _edge(z, by_u, row):
    """Return 1/sqrt(B) at the coordinate z of the curves, and the derivative of its logarithm with respect to ln u.

    2 B is the derivative of the contact stiffness with respect to the contact radius. by_u: dz/d ln u. row: parameters of the
    asperity.
    """
    edge, edge_slope = _curve(z, by_u, row[PLAIN:EDGED])
    return exponential(-0.25 * (1.0 - z) * row[0] - 0.5 * edge), -0.5 * edge_slope + 0.25 * by_u * row[0]


@formula
def _stiffness(E_P, D, load_slope, approach_slope):
    """Return the normalised contact stiffness (3/2) E_S, computed as (dP_H/du)/(dw_H/du)/u^2.

    P_H = E_P u^6 and w_H = D u^4 are the normalised load and displacement without adhesion at u = (a^2/(R sigma))^(1/4).
    load_slope, approach_slope: d ln E_P / d ln u and d ln D / d ln u.
    """
    return E_P * (6.0 + load_slope) / (D * (4.0 + approach_slope))


@formula
def parted(u, row):
    """Return the load without adhesion at the coordinate u, and the amount by which the load with JKR's adhesion is smaller.

    Loads are divided by K R^(1/2) sigma^(3/2), with K = (4/3) E* of the bodies without a film. row: parameters of the asperity.
    """
    z, by_u, E_P, D, load_slope, approach_slope = _hertzian(u, row)
    u3, softness = u * u * u, _edge(z, by_u, row)[0]
    return E_P * u3 * u3, _stiffness(E_P, D, load_slope, approach_slope) * row[2] * softness * u3


@formula
def edged(u, *row):
    """Return displacement w, dw/du, load and area of an asperity with JKR's adhesion.

    u: coordinate, (a^2/(R sigma))^(1/4). row: parameters; the third is the strength of adhesion s. Displacements are divided by
    sigma, loads by K R^(1/2) sigma^(3/2) and areas by pi R sigma, with K = (4/3) E* of the bodies without a film.
    """
    z, by_u, E_P, D, load_slope, approach_slope = _hertzian(u, row)
    softness, softness_slope = _edge(z, by_u, row)
    u3, back = u * u * u, row[2] * softness
    stiffness = _stiffness(E_P, D, load_slope, approach_slope)
    stretch = D * u3 * (4.0 + approach_slope) - back * (1.0 + softness_slope)
    return u * (D * u3 - back), stretch, u3 * (E_P * u3 - stiffness * back), u3 * u


@formula
def plain_coordinate(w, *row):
    """Return the coordinate u of an asperity, without adhesion or with DMT's adhesion, at the displacement w; 0 for w <= 0.

    w: divided by sigma; u is infinite if w is. row: parameters of the asperity. Newton's method is applied to logarithms,
    because ln w rises with ln u at a slope close to 4.
    """
    if not w > 0.0:
        return 0.0
    if w == math.inf:
        return math.inf
    u = math.sqrt(math.sqrt(w))
    for _ in range(_MOST_STEPS):
        _, _, _, D, _, approach_slope = _hertzian(u, row)
        step = math.log(D * u * u * u * u / w) / (4.0 + approach_slope)
        u *= math.exp(-step)
        if abs(step) <= 1e-14:
            break
    return u


@formula
def _approached(w, row):
    """Return the coordinate u of an asperity with JKR's adhesion at the displacement w >= 0.

    w: divided by sigma. row: parameters of the asperity. Adhesion lowers the displacement w_H(u) of the contact without
    adhesion by v(u), so that w = w_H - v. Newton's method solves ln(w_H/(w + v)) = 0, whose left side rises with ln u.
    """
    u = max(math.sqrt(math.sqrt(w)), max(row[2], 1e-200) ** (1.0 / 3.0))
    for _ in range(_MOST_STEPS):
        z, by_u, _, D, _, approach_slope = _hertzian(u, row)
        softness, softness_slope = _edge(z, by_u, row)
        back = row[2] * softness * u
        slope = 4.0 + approach_slope - back / (w + back) * (1.0 + softness_slope)
        step = min(max(math.log(D * u * u * u * u / (w + back)) / slope, -2.0), 2.0)
        u *= math.exp(-step)
        if abs(step) <= 1e-14:
            break
    return u


@formula
def touch(row):
    """Return the coordinate u at which approaching bodies first touch with JKR's adhesion, at the displacement 0.

    row: parameters of the asperity.
    """
    return _approached(0.0, row)


@formula
def _comes_off(u, row):
    """Return whether a contact with JKR's adhesion is unstable at the coordinate u: its displacement does not rise with u."""
    return edged(u, *row)[1] <= 0.0


@formula
def _is_short(u, given):
    """Return whether u is too small: the displacement at u is less than w, or does not rise with u.

    given: (w, row), the displacement divided by sigma and the parameters of the asperity.
    """
    w, row = given
    here = edged(u, *row)
    return here[0] < w or here[1] <= 0.0


_halve_off, _halve_short = halving(_comes_off), halving(_is_short)


@formula
def edged_coordinate(w, *row):
    """Return the coordinate u of an asperity with JKR's adhesion at the displacement w, on the stable branch.

    On this branch the displacement grows with u. w: divided by sigma; u is infinite if w is. Below the displacement of
    detachment, the result is the coordinate of detachment. row: parameters of the asperity.
    """
    if w == math.inf:
        return math.inf
    if w >= 0.0:
        return _approached(w, row)
    low = high = touch(row)
    while not _is_short(low, (w, row)):
        low, high = 0.9 * low, low
    return _halve_short(low, high, (w, row))


@formula
def pulled_off(row):
    """Return the coordinate u at which an asperity with JKR's adhesion detaches while the bodies are moved apart.

    At this coordinate the derivative of the displacement with respect to u is 0. row: parameters of the asperity.
    """
    low = high = touch(row)
    while not _comes_off(low, row):
        low, high = 0.97 * low, low
    return _halve_off(low, high, row)
