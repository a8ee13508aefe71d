"""Formulate the law of an asperity on a graded film: modulus and hardness depend on depth (theory.md, section 5.3).

This project's own composition (grade C) of published parts: the modulus of film and substrate at a given contact radius
(Gao, Chiu & Lee 1992), their hardness at a given depth (Bhattacharya & Nix 1988), the JKR contact, and the transition to full
plasticity of Zhao, Maietta & Chang 2000. Without a film the same law is the bare asperity without a jump at yield.

For elastic and plastic asperities alike, the coordinate is u = x^(1/4); x = a^2/(R sigma), with the contact radius a that the
elastic contact would have at this displacement. Units: displacements in sigma, loads in K R^(1/2) sigma^(3/2), areas in pi R
sigma, with K = (4/3) E* of the substrate.
"""

import math

from stiction.engine.compiled import formula
from stiction.engine.vectorised import exponential
from stiction.laws.asperity.shared.transition import plastic_share
from stiction.laws.composite.gao_chiu_lee_1992 import modulus_share
from stiction.laws.tangential.savkoor_briggs_1977 import slip_resistance
from stiction.laws.tangential.shared.edge_yield import yield_resistance

_PI = math.pi
ALONE, WHOLE = 11, 20  # number of parameters for adhesion and strength; together with those of the stiffness


@formula
def stiffness(u, bodies):
    """Return three numbers: K_eff/K_s, its derivative with respect to ln u, and the film's weight in the modulus.

    K_eff/K_s is the ratio (S5.11) of the contact modulus with the film to that without it, at the contact radius a = sqrt(R
    sigma) u^2. The weight is averaged over the coated bodies. bodies: two bounds on the result (unused here), sqrt(R sigma)
    divided by the film thickness on one body, then the first four fields of `TwoBodies`, and for each body the mean of its own
    Poisson's ratio and the film's.
    """
    _, _, per_aspect, first, second, s, films, nu_first, nu_second = bodies
    share, slope = modulus_share(u * u * per_aspect, nu_first)
    g, rise = 1.0 + (first - 1.0) * share, 2.0 * (first - 1.0) * slope
    other, other_rise = 1.0, 0.0
    if films == 2.0:
        other_share, slope = modulus_share(u * u * per_aspect, nu_second)
        other, other_rise = 1.0 + (second - 1.0) * other_share, 2.0 * (second - 1.0) * slope
        share = 0.5 * (share + other_share)
    compliance = s * other + (1.0 - s) * g  # compliance of both bodies in series, times g and `other`
    rise = (s * rise * other * other + (1.0 - s) * other_rise * g * g) / (compliance * compliance)
    return g * other / compliance, rise, share


@formula
def contact(u, S, bodies):
    """Return w, dw/du, Q, d ln Q/d ln u and the film's weight in the modulus, for an elastic JKR contact on a graded film.

    w: displacement in units of sigma. Q = sqrt(K_eff/K_s) u^3, with the modulus K_eff of film and substrate together
    (S5.11) and the modulus K_s of the substrate. u: coordinate, with the contact radius sqrt(R sigma) u^2. S: sqrt(6 pi
    n_g/theta), strength of adhesion, with the work of adhesion n_g of the film divided by the substrate's and the elastic
    adhesion index theta. bodies: as in `stiffness`.
    """
    ratio, rise, share = stiffness(u, bodies)
    root = math.sqrt(ratio)
    s = 2.0 / 3.0 * S / root
    steepness = 0.5 * rise / ratio
    u3 = u * u * u
    return u * (u3 - s), 4.0 * u3 - s * (1.0 - steepness), root * u3, 3.0 + steepness, share


@formula
def fading(w, linear, square):
    """Return the film's weight in the hardness at the displacement w in units of sigma, exp(-c (w/tau)^m) (S5.13).

    For m = 1, linear = c/tau and square = 0; for m = 2, linear = 0 and square = c/tau^2. tau: film thickness in units of sigma.
    The formula is continued to slightly negative w, because a branch point there affects the first contact.
    """
    return exponential(min(-w * (linear + square * w), 4.0))


@formula
def along(u, *row):
    """Return the state of an asperity on a graded film at the coordinate u.

    It consists of displacement w, dw/du, load, contact area, slip-limited and yield-limited tangential force, in the units of
    this module. u: coordinate, with the contact radius sqrt(R sigma) u^2 of the elastic contact. row, in this order:

    - pull: half of DMT's adhesive force
    - eta, n_H: hardness group of the substrate; hardness of the film divided by the hardness of the substrate
    - linear, square: as in `fading`
    - nu_s, nu_c: Poisson's ratios of substrate (s) and film (c)
    - K_beta_s, K_beta_c: K beta of substrate and film
    - yield_s, yield_c: yield stresses of substrate and film, divided by pi times the hardness of the substrate
    - parameters of `stiffness`
    - start and level of three plateaus: for u >= start the load is at least level
    """
    pull, eta, n_H, linear, square, nu_s, nu_c, K_beta_s, K_beta_c, yield_s, yield_c = row[:ALONE]
    (
        start_1, level_1, start_2, level_2, start_3, level_3,
    ) = row[WHOLE:]  # fmt: skip
    S = math.sqrt(6.0 * pull)
    w, slope, Q, _, share = contact(u, S, row[ALONE:WHOLE])
    film = fading(w, linear, square)
    x = u * u * u * u
    elastic_load = Q * (Q - S)
    hardness = eta * (1.0 + (n_H - 1.0) * film)
    flowing = hardness * x  # load of the contact area x if its mean pressure is the hardness
    f, _ = plastic_share(elastic_load / flowing)
    capped = min(elastic_load, flowing)
    load = capped + f * (2.0 * (hardness * w - pull) - capped)
    load = max(load, level_1) if u >= start_1 else load
    load = max(load, level_2) if u >= start_2 else load
    load = max(load, level_3) if u >= start_3 else load
    slip_limited = slip_resistance(capped, _PI / pull, K_beta_s + (K_beta_c - K_beta_s) * share)
    strength = eta * x * (yield_s + (yield_c - yield_s) * film)
    yield_limited = yield_resistance(capped, strength, nu_s + (nu_c - nu_s) * share)
    slips = slip_limited <= yield_limited
    hold = 1.0 - f
    return (
        w, slope, load, x + f * (2.0 * w - x), hold * slip_limited if slips else 0.0, 0.0 if slips else hold * yield_limited,
    )  # fmt: skip


@formula
def depth_coordinate(w, S, bodies):
    """Return the coordinate u of an elastic JKR contact on a graded film at the displacement w >= 0 in units of sigma.

    S, bodies: as in `contact`. Newton's method is bracketed; the displacement grows with u.
    """
    s = 2.0 / 3.0 * S
    least, greatest = bodies[0], bodies[1]
    low = max(w**0.25, (s / math.sqrt(greatest)) ** (1.0 / 3.0))
    high = max((2.0 * w) ** 0.25, (2.0 * s / math.sqrt(least)) ** (1.0 / 3.0))
    u = low if least == greatest and w == 0.0 else high
    for _ in range(100):
        depth, slope, _, _, _ = contact(u, S, bodies)
        if depth > w:
            high = u
        else:
            low = u
        last = u
        u -= (depth - w) / slope
        if not low <= u <= high:
            u = 0.5 * (low + high)
        if abs(u - last) <= 1e-15 * u:
            break
    return u


@formula
def coordinate(w, *row):
    """Return the coordinate u of an asperity on a graded film at the displacement w in units of sigma, or 0 for w <= 0.

    It is the inverse of the displacement in `along`. row: parameters, as in `along`.
    """
    if not w > 0.0:
        return 0.0
    return depth_coordinate(w, math.sqrt(6.0 * row[0]), row[ALONE:WHOLE]) if w < math.inf else math.inf
