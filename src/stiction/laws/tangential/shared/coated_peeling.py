"""Compute the tangential force at which an adhesive asperity on a film peels, as a curve along its elastic segment.

Under the load P and a shear force T, the edge of a contact of radius a releases the energy

    G = (P_H - P)^2 S'/(4 pi a S^2) + zeta T^2 S_T'/(4 pi a S_T^2),    S_T = 8 a/beta,    S_T'/S_T^2 = (1 - e) beta/(8 a^2),

where P_H is the load of a contact of this radius without adhesion, S the normal and S_T the tangential stiffness, S' and S_T'
their derivatives with respect to a, zeta the weight of the tangential energy release, beta the tangential compliance and e = d
ln beta/d ln a. In equilibrium G equals the work of adhesion. As T grows at constant P, the contact shrinks, up to the largest T
for which such a radius exists. With c = (P_H - P)/L, where L is the adhesive force of JKR's contact at this radius, and in the
units of the laws, T^2 is the largest value of 32 pi n_g u^6/(theta zeta K beta (1 - e)) (1 - c^2) over c from 0 to 1. n_g: work
of adhesion of the film divided by the substrate's; theta: adhesion index; u^4 = a^2/(R sigma).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula, lazy_kernel, unpack
from stiction.engine.regime import columns
from stiction.laws.segment import NormalSegment
from stiction.laws.tangential.shared.even_spline import SEGMENTS, spline, to_coefficients
from stiction.solvers.layered.asperity import EDGED, parted
from stiction.solvers.layered.bodies import bodies_of, per_root
from stiction.solvers.layered.curves import TERMS
from stiction.solvers.layered.shear import shear_curve

# Natural logarithm of u over its first value at the middle of the knots.
_HALFWAY = 2.0
_GOLDEN, _NARROWING = 0.5 * (math.sqrt(5.0) - 1.0), 16
_MOST_STEPS = 60
# Replaces a mode-mixity share of 0, which would make the force infinite.
_LEAST_SHARE = 1e-200


@formula
def _compliance(u, root, curve):
    """Return the dimensionless tangential compliance K beta of a coated contact, and 1 - e with e = d ln(K beta)/d ln a.

    K = (4/3) E*; beta: tangential compliance; a: contact radius. u: coordinate, u^4 = a^2/(R sigma). root: factor that
    converts u to sqrt(a/t), with the thickness t of one film. curve: logarithms of K beta for the film and for the bodies,
    then coefficients of the curve between them.
    """
    rest = 1.0 / (root * u + 1.0)
    z, by_radius = 1.0 - 2.0 * rest, rest * (1.0 - rest)  # dz/d ln a
    value = slope = 0.0
    for k in range(TERMS - 1, -1, -1):
        slope = slope * z + value
        value = value * z + curve[2 + k]
    rise = curve[1] - curve[0]
    e = by_radius * (0.5 * rise + 4.0 * rest * (1.0 - rest) * slope - 2.0 * z * value)
    return math.exp(curve[0] + 0.5 * (1.0 + z) * rise + 4.0 * rest * (1.0 - rest) * value), 1.0 - e


@formula
def _coordinate_at_load(start, c, load, row):
    """Return the largest coordinate u at which P_H - c L equals the load, or a negative number if no u satisfies this.

    P_H: load of a contact of this radius without adhesion. L: adhesive force of JKR's contact of this radius. c: number
    from 0 to 1. row: parameters of the coated JKR asperity. start: coordinate of a wider contact, at which the secant
    method starts.
    """
    u = start
    before = before_u = slope = 0.0
    for step in range(_MOST_STEPS):
        hertz, pull = parted(u, row)
        excess = hertz - c * pull - load
        slope = (6.0 * hertz - 3.0 * c * pull) / u if step == 0 else (excess - before) / (u - before_u)
        if not slope > 0.0:
            return -1.0
        before, before_u = excess, u
        u -= excess / slope
        if not u > 0.0:
            return -1.0
        if abs(u - before_u) <= 1e-7 * u:
            break
    return u


@formula
def _largest_force_squared(start, load, row, root, curve):
    """Return the largest value of T^2 theta zeta/(32 pi n_g) at which the contact is in equilibrium; T: tangential force.

    theta: adhesion index. zeta: weight of the tangential energy release. n_g: work of adhesion of the film divided by the
    substrate's. The value depends on c, from 0 to 1, the fraction of JKR's adhesive force that acts; golden section search
    finds its single maximum over c. start: coordinate at which the secant method starts, of a contact wider than the result.
    load: normal load. row: parameters of the coated JKR asperity. root, curve: as in `_compliance`.
    """
    low, high = 0.0, 1.0
    at_first, at_second, best = -1.0, -1.0, 0.0
    for _ in range(_NARROWING):
        of_first = at_first < 0.0
        c = high - _GOLDEN * (high - low) if of_first else low + _GOLDEN * (high - low)
        u = _coordinate_at_load(start, c, load, row)
        value = 0.0
        if u > 0.0:
            K_beta, left = _compliance(u, root, curve)
            value = u**6 * (1.0 - c * c) / (K_beta * left)
        best = max(best, value)
        if of_first:
            at_first = value
        else:
            at_second = value
        if at_first >= 0.0 and at_second >= 0.0:
            if at_first > at_second:
                high, at_second, at_first = low + _GOLDEN * (high - low), at_first, -1.0
            else:
                low, at_first, at_second = high - _GOLDEN * (high - low), at_second, -1.0
    return best


@lazy_kernel(worth=300)
def _fill(rows, root, curves, first, out):
    """Fill `out` (n, SEGMENTS + 1) with the scaled peeling force at the knots of a spline over u, one row per contact.

    The scaled force is sqrt(T^2 theta zeta/(32 pi n_g))/u^3, with the peeling force T, the adhesion index theta, the weight
    zeta of the tangential energy release, and the work of adhesion n_g of the film divided by the substrate's. The last
    knot is the limit at infinite u. It is negative where the load falls as the contact grows, because such a contact pulls
    off under a constant load. rows: parameters of the coated JKR asperities. root, curves: as in `_compliance`. first (n,):
    u at the first knot.
    """
    for i in range(root.size):
        row = unpack(rows[i], EDGED)
        for knot in range(SEGMENTS):
            y = knot / SEGMENTS
            u = first[i] * math.exp(_HALFWAY * y / (1.0 - y))
            hertz, pull = parted(u, row)
            load = hertz - pull
            start, sign = 1.0001 * u, 1.0
            hertz, pull = parted(start, row)
            while hertz - pull < load:
                sign = -1.0
                start *= 1.05
                hertz, pull = parted(start, row)
            out[i, knot] = sign * math.sqrt(_largest_force_squared(start, load, row, root[i], curves[i])) / u**3
        out[i, SEGMENTS] = math.exp(-0.5 * curves[i, 1])


def peeling_columns(segment: NormalSegment, groups: Groups) -> tuple[tuple[np.ndarray, ...], np.ndarray | None]:
    """Return the parameters of `peeling_force`, arrays (n,), and the coordinate (n, 1) at which that force is 0, or None.

    The coordinate is None for a loading segment. For an unloading segment whose force vanishes nowhere, it is the start of the
    segment. segment: JKR asperity of a film law that solves film and body as one solid. groups: dimensionless groups of n
    contacts with a film, with all defaults filled in. If `peeling` is 0, the force is practically infinite.
    """
    share = np.maximum(1.0 if groups.peeling is None else groups.peeling, _LEAST_SHARE)
    scale = np.broadcast_to(np.sqrt(32.0 * math.pi * groups.n_g / (groups.theta * share)), len(groups))
    curve, vanishes = _curves(segment, groups)
    return (scale, *curve), vanishes[:, None] if segment.lowest < 0.0 else None


def _curves(segment: NormalSegment, groups: Groups) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
    """Return the spline of the peeling force along a segment, and the coordinate (n,) at which the force vanishes.

    The spline is a tuple of arrays (n,): the coordinate at the start of the segment, then the coefficients. If the force
    vanishes nowhere, the second result is the start of the segment. segment, groups: as in `peeling_columns`.
    """
    laws, first = len(groups), np.ascontiguousarray(segment.edges[:, 0])
    different, which = bodies_of(groups)
    shapes = np.array([shear_curve(value) for value in different])[which]
    # K beta of film and of bodies are groups of the contact; only the curve between both is solved.
    film = np.where(groups.film_aspect > 0.0, groups.film_K_beta / groups.n_E, groups.K_beta)
    ends = [np.broadcast_to(np.log(value), laws) for value in (film, groups.K_beta)]
    given = np.column_stack([first, per_root(groups), *ends, shapes, columns(segment.parameters, laws)])
    # Contacts that differ only in hardness share a spline, whose computation takes longer than their sums.
    each, which = np.unique(given, axis=0, return_inverse=True)
    first_of, roots, curves, rows = np.split(each, [1, 2, 4 + TERMS], axis=1)
    found = np.empty((len(each), SEGMENTS + 1))
    _fill(*map(np.ascontiguousarray, (rows, roots[:, 0], curves, first_of[:, 0])), found)
    values = found[np.ravel(which)]
    return (first, *(values @ to_coefficients().T).T), _sign_change(first, values)


def _sign_change(first: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the coordinate (n,) at which values given at knots change sign, if they are linear in the knot number.

    values (n, SEGMENTS + 1): at the knots, negative before the sign change. first (n,): coordinate u at the first knot, which
    is returned if the first value is not negative.
    """
    crossing = np.maximum((values < 0.0).sum(axis=1), 1)
    below, above = (np.take_along_axis(values, index[:, None], axis=1)[:, 0] for index in (crossing - 1, crossing))
    y = (crossing - np.clip(above / (above - below), 0.0, 1.0)) / SEGMENTS
    return np.where(below < 0.0, first * np.exp(_HALFWAY * y / (1.0 - y)), first)


@formula
def peeling_force(u, load, area, row):
    """Return the tangential force at which a coated JKR asperity peels, in units of K R^(1/2) sigma^(3/2).

    u: coordinate, u^4 = a^2/(R sigma) with the contact radius a. load, area: not used. row: sqrt(32 pi n_g/(theta zeta)), with
    the symbols of the module docstring; u at the first knot; spline coefficients.
    """
    y = 1.0
    if u < 1e100:
        part = math.log(max(u / row[1], 1.0))
        y = part / (part + _HALFWAY)
    return row[0] * u**3 * abs(spline(y, row[2:]))
