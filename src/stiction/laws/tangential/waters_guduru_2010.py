r"""Peeling under shear with a work of adhesion that grows with mode mixity: Waters & Guduru 2010, Hutchinson & Suo 1992.

*Assumes*: the edge of a JKR contact is a mixed-mode crack, as in [`savkoor_briggs_1977`](#savkoor_briggs_1977), with a work of
adhesion that grows with the mode mixity, the phase angle $\psi$ of shear against opening. The contact slides when no radius
satisfies the energy balance any more, or when it has shrunk to Hertz's contact, where the opening mode vanishes. *Source*:
[waters_guduru_2010], abstract: a work of adhesion that rises with the degree of mode mixity, measured and modelled;
[papangelo_ciavarella_2018], abstract: some of the compared models end in a jump to the Hertzian area, others approach a limit.
The function of $\psi$ is due to [hutchinson_suo_1992]. *Reconstructed*: the equations of both papers were not available. The
function that both papers use is written from memory, and its consequences are derived here.

$$
G_N+G_T=\gamma\left[1+\tan^2\left((1-\zeta)\psi\right)\right],\qquad\tan^2\psi=\frac{G_T}{G_N}
$$

with the energy release rates $G_N$ (normal load) and $G_T$ (tangential force) of `savkoor_briggs_1977`. With $p=P/P_c$, the
pull-off force $P_c=3\pi/(2\theta)$ in the units here, and $\kappa=1-\zeta$

$$
T=\frac{4\sqrt3\,\pi}{\theta\sqrt{K\beta}}\max_\psi\left(\sqrt g+\sqrt{g+p}\right)\sqrt q,\qquad
g=\frac{\cos^2\psi}{\cos^2\kappa\psi},\quad q=\frac{\sin^2\psi}{\cos^2\kappa\psi}
$$

where the maximum is taken over $0\le\psi\le\pi/2$ with $g+p\ge0$. The contact radius under shear equals a JKR contact's with
the work of adhesion $g\gamma$. For all loads above $P_c/(\kappa\sin\frac{\kappa\pi}2)^2$ the maximum is at $\psi=\pi/2$,
Hertz's contact, with $T=\frac{4\sqrt3\,\pi}{\theta\sqrt{K\beta}}\sqrt p/\cos\frac{\kappa\pi}2$.

$\zeta$ is `peeling` of the contact, by default 1; $\zeta=0$ (no peeling) raises an error. `savkoor_briggs_1977` uses
$G_N+\zeta G_T=\gamma$, which corresponds to another function of [hutchinson_suo_1992], $[1+(\zeta-1)\sin^2\psi]^{-1}$.
*Limit*: `savkoor_briggs_1977` for $\zeta=1$. *Unknown*: a third function, $1+(1-\zeta)\tan^2\psi$, has no largest force and is
not included. *Check*: $T$ divided by its value for $\zeta=1$,

| $P/P_c$ | −0.5 | 0 | 2 | 10 |
|---|---|---|---|---|
| $\zeta=0.5$ | 1.18126 | 1.20113 | 1.25364 | 1.34840 |
| $\zeta=0.1$ | 2.99699 | 3.58189 | 5.21942 | 6.09497 |

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of
adhesion; $\beta$ tangential compliance of the pair of bodies, $K\beta=\tfrac83(2-\nu)/(1-\nu)$ for equal bodies;
$P_c=\tfrac32\pi\gamma R$ pull-off force. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.joining import coordinates
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.savkoor_briggs_1977 import mode_mixity_share, pull_off_coordinate
from stiction.records.registry import Limit, TangentialLaw
from stiction.records.sources import Source

# Error of the angle at which the search ends; the largest force has an error of its square.
_NEAR = 1e-9


@formula
def _grows(psi, p, kappa):
    """Return a finite, continuous number with the sign of the peeling force's derivative with respect to the phase angle.

    psi: phase angle of shear against opening. p: load divided by pull-off force. kappa: 1 - zeta, where zeta is the input
    `peeling` of the contact.
    """
    sine, cosine = math.sin(psi), math.cos(psi)
    narrow, shared = math.cos(kappa * psi), kappa * sine * math.tan(kappa * psi)
    opening = cosine / narrow
    left = math.sqrt(max(opening * opening + p, 0.0))
    return shared * opening - sine * sine / narrow + (cosine + shared) * left


@formula
def _phase(p, kappa):
    """Return the phase angle, at most pi/2, at which the peeling force is largest, by regula falsi (Illinois variant).

    p: load divided by pull-off force. kappa: 1 - zeta, where zeta is the input `peeling` of the contact.
    """
    low, high = 0.0, 0.5 * math.pi
    at_low, at_high = _grows(low, p, kappa), _grows(high, p, kappa)
    if at_high >= 0.0:
        return high
    psi, side = low, 0
    for _ in range(100):
        if high - low <= _NEAR or at_low <= 0.0:
            break
        before = psi
        psi = (low * at_high - high * at_low) / (at_high - at_low)
        there = _grows(psi, p, kappa)
        if there > 0.0:
            low, at_low = psi, there
            at_high = 0.5 * at_high if side > 0 else at_high
            side = 1
        else:
            high, at_high = psi, there
            at_low = 0.5 * at_low if side < 0 else at_low
            side = -1
        if abs(psi - before) <= _NEAR or there == 0.0:
            break
    return psi


@formula
def peeling_force(p, kappa):
    """Return the dimensionless peeling force, the maximum of (sqrt(g) + sqrt(g + p)) sqrt(q) over the phase angle psi.

    p: load divided by pull-off force. kappa: 1 - zeta, where zeta is the input `peeling` of the contact. g =
    cos^2(psi)/cos^2(kappa psi), q = sin^2(psi)/cos^2(kappa psi). The result is sqrt(1 + p) for kappa = 0.
    """
    p = max(p, -1.0)
    psi = _phase(p, kappa)
    narrow = math.cos(kappa * psi)
    opening = math.cos(psi) / narrow
    return (opening + math.sqrt(max(opening * opening + p, 0.0))) * math.sin(psi) / narrow


@formula
def resistance(u, w, load, area, theta, K_beta, kappa):
    unit = 4.0 * math.sqrt(3.0) * math.pi / (theta * math.sqrt(K_beta))
    return unit * peeling_force(load * theta / (1.5 * math.pi), kappa), 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance | None:
    """Return the tangential force at which a JKR asperity peels along an elastic segment, or None for other segments.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts. Plastic asperities have no
    resistance. Raises InputError if `peeling` is 0.
    """
    if segment.state != "elastic":
        return None
    share = mode_mixity_share(groups)
    kinks = [_coordinate_of_hertz(segment, groups, 1.0 - share)[:, None], pull_off_coordinate(segment, groups)]
    parameters = (groups.theta, groups.K_beta, 1.0 - share)
    return TangentialResistance(resistance, parameters, np.concatenate([array for array in kinks if array is not None], axis=1))


def _coordinate_of_hertz(segment: NormalSegment, groups: Groups, kappa: np.ndarray) -> np.ndarray:
    """Return the coordinate u (n,) of a JKR contact above which shear shrinks the contact to Hertz's area before it slides.

    kappa (n,): 1 - zeta, where zeta is the input `peeling` of the contact. The result is clipped to the segment; for kappa = 0
    it is the upper end.
    """
    with np.errstate(divide="ignore"):
        p = 1.0 / (kappa * np.sin(0.5 * math.pi * kappa)) ** 2
    S = np.sqrt(6.0 * math.pi / groups.theta)
    y = 0.5 * S * (1.0 + np.sqrt(1.0 + p))  # u^3 of the JKR contact, from P = y (y - S) and p = 4 P/S^2
    return coordinates(segment, np.where(np.isfinite(y), np.cbrt(y) * (y - 2.0 / 3.0 * S), np.inf))


RECORD = TangentialLaw(
    key="waters_guduru_2010",
    title="Peeling of an adhesive contact whose work of adhesion grows with mode mixity",
    grade="C",
    sources=(
        Source("waters_guduru_2010", "abstract", "the work of adhesion grows with mode mixity; equations not available"),
        Source("hutchinson_suo_1992", "", "reconstructed: the function of the phase angle is from memory"),
        Source("papangelo_ciavarella_2018", "abstract", "comparison of models of the coupling; some jump to Hertz's area"),
        Source("savkoor_briggs_1977", "", "energy release rates of a sheared JKR contact"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="none",
    of_half_space="its energy balance uses the stiffness of a half-space",
    like="layered_peeling",
    required_traits={"JKR": "it computes the peeling of a JKR contact"},
    verified="energy balance over all contact radii, solved independently at 30 digits; savkoor_briggs_1977 for zeta = 1",
    needs=("theta", "K_beta"),
    takes=("peeling",),
    limits=(Limit("savkoor_briggs_1977", {"peeling": 1.0}, ("friction_force",), 1e-9),),
    notes="The force of peeling only; yield does not limit it. `peeling` is zeta, the lambda of Hutchinson and Suo; 1 is "
    "Savkoor and Briggs. Asperities that have yielded have no resistance.",
)
