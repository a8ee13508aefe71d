"""The asperity of a graded film, as formulas: modulus and hardness depend on depth (docs/theory.md, section 5.3).

This project's own composition (grade C) of published pieces: the modulus felt by a contact of given radius (Gao, Chiu & Lee
1992), the hardness at a given depth (Bhattacharya & Nix 1988), the JKR contact, and the passage to full plasticity of
Zhao, Maietta & Chang 2000. The same law without a film is the bare asperity without the jump at yield.

The coordinate is u = x^(1/4) at every depth, plastic or not: x is then the apparent displacement that the elastic contact
would have at this depth. Displacements are over sigma, loads over K R^(1/2) sigma^(3/2), areas over pi R sigma, with K of
the substrate.
"""

import math

from stiction.engine.compiled import formula
from stiction.engine.vectorised import exponential
from stiction.laws.asperity.shared.transition import plastic_share
from stiction.laws.composite.gao_chiu_lee_1992 import modulus_share
from stiction.laws.tangential.savkoor_briggs_1977 import slip_resistance
from stiction.laws.tangential.shared.edge_yield import yield_resistance

_PI = math.pi
ALONE, WHOLE = 11, 20  # parameters of adhesion and strength; with them those of the stiffness of both bodies


@formula
def stiffness(u, bodies):
    """K_eff/K_s (S5.11) of the contact of radius a = sqrt(R sigma) u^2, its derivative by ln u, and the film's share.

    bodies: least and greatest K_eff/K_s; one over the thickness on a body over sqrt(R sigma); then as of TwoBodies, nu being
    the mean of film and body.
    """
    _, _, per_aspect, first, second, s, films, nu_first, nu_second = bodies
    share, slope = modulus_share(u * u * per_aspect, nu_first)
    g, rise = 1.0 + (first - 1.0) * share, 2.0 * (first - 1.0) * slope
    other, other_rise = 1.0, 0.0
    if films == 2.0:
        other_share, slope = modulus_share(u * u * per_aspect, nu_second)
        other, other_rise = 1.0 + (second - 1.0) * other_share, 2.0 * (second - 1.0) * slope
        share = 0.5 * (share + other_share)
    compliance = s * other + (1.0 - s) * g  # of both in series, times g and other
    rise = (s * rise * other * other + (1.0 - s) * other_rise * g * g) / (compliance * compliance)
    return g * other / compliance, rise, share


@formula
def contact(u, S, bodies):
    """Return JKR's contact with the modulus of (S5.11).

    Displacement w, dw/du, Q = sqrt(K_eff/K_s) u^3, d ln Q/d ln u, share of the film.
    """
    ratio, rise, share = stiffness(u, bodies)
    root = math.sqrt(ratio)
    s = 2.0 / 3.0 * S / root
    steepness = 0.5 * rise / ratio
    u3 = u * u * u
    return u * (u3 - s), 4.0 * u3 - s * (1.0 - steepness), root * u3, 3.0 + steepness, share


@formula
def fading(w, linear, square):
    """Return exp(-c (w/tau)^m), the film's share in the hardness (S5.13).

    linear = c/tau, square = 0 for m = 1; 0, c/tau^2 for 2. Continued slightly to w < 0, where a branch point may lie that
    affects first contact.
    """
    return exponential(min(-w * (linear + square * w), 4.0))


@formula
def along(u, *row):
    """Return the response of the asperity at u, as a Regime requires it.

    row: pull = pi n_g/theta; eta, of the substrate; n_H; linear, square, as in `fading`; nu_s, nu_c, K_beta_s, K_beta_c, of
    substrate and film; yield_s, yield_c, their yield stress over pi H_s; the parameters of `stiffness`; and three plateaus:
    from u = start_i on the load is at least level_i.
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
    """Return the u at which the displacement is w >= 0.

    By Newton's method within bounds; displacement grows with u there.
    """
    s = 2.0 / 3.0 * S
    least, greatest = bodies[0], bodies[1]
    low = max(w**0.25, (s / math.sqrt(greatest)) ** (1.0 / 3.0))
    high = max((2.0 * w) ** 0.25, (2.0 * s / math.sqrt(least)) ** (1.0 / 3.0))
    u = low if least == greatest and w == 0.0 else high
    for _ in range(100):
        at, slope, _, _, _ = contact(u, S, bodies)
        if at > w:
            high = u
        else:
            low = u
        last = u
        u -= (at - w) / slope
        if not low <= u <= high:
            u = 0.5 * (low + high)
        if abs(u - last) <= 1e-15 * u:
            break
    return u


@formula
def coordinate(w, *row):
    """Invert `along`, for the same row; return 0 where nothing touches."""
    if not w > 0.0:
        return 0.0
    return depth_coordinate(w, math.sqrt(6.0 * row[0]), row[ALONE:WHOLE]) if w < math.inf else math.inf
