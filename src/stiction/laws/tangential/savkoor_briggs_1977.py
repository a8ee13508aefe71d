r"""Tangential force at which an adhesive contact peels: Savkoor & Briggs 1977, with optional weaker mode coupling.

*Assumes*: the edge of a JKR contact is a mixed-mode crack. The contact peels where $G_N+\zeta\,G_T=\gamma$, with the energy
release rates $G_N$ of the normal load and $G_T$ of the tangential force and the work of adhesion $\gamma$; $\zeta$ is
`peeling` of the contact, by default 1. *Source*: [savkoor_briggs_1977] for $\zeta=1$, re-derived from the load before
shearing. [johnson_1996] states that measured contacts couple the modes more weakly; the simple form with $\zeta$ is not from
this source.

$$
G_N=\frac{(P_1-P)^2}{6\pi Ka^3},\quad G_T=\frac{\beta T^2}{32\pi a^3},\quad P_1=\frac{Ka^3}R\ \text{(SI)};\qquad
T=\frac4{\sqrt{\zeta K\beta}}\sqrt{\frac{2\pi}\theta P+\frac{3\pi^2}{\theta^2}}
$$

$a$ is the contact radius and $P_1$ the load at which a contact without adhesion has this radius. $\zeta=0$ (no peeling) raises
an error, because the force would be infinite. Asperities that have yielded do not resist. *Check*, at $\nu=0.3$, for equal
bodies or one rigid body:

| $P/P_c$ | −0.5 | 0 | 2 | 10 |
|---|---|---|---|---|
| $T/P_c$ | 1.28338 | 1.81497 | 3.14362 | 6.01958 |
| area at peeling over initial area | 0.6423 | 0.6300 | 0.6598 | 0.7458 |

*Caution*: real contacts shrink much less under shear than the last line of the table states, and a uniform interfacial shear
stress would not change JKR's contact ([menga_carbone_dini_2018], [papangelo_ciavarella_2018]).

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
from stiction.quantities.errors import InputError
from stiction.records.registry import TangentialLaw
from stiction.records.sources import Source


@formula
def slip_resistance(load, theta, K_beta):
    """Return the tangential force at which a JKR contact peels, T = 4 (K beta)^(-1/2) sqrt((2 pi/theta) P + 3 pi^2/theta^2).

    load: P before shearing, in units of K R^(1/2) sigma^(3/2), like T. theta: elastic adhesion index. K_beta: K beta, with K =
    (4/3) E* and the tangential compliance beta of the pair of bodies. The force follows from the energy balance G_N + G_T =
    gamma at constant load; it is eq (10) of soft_coating_2015, restated for the state before shearing (departure D6). The
    radicand is a perfect square for a JKR contact; only rounding can make it negative; it then counts as 0.
    """
    pull = math.pi / theta
    return 4.0 * math.sqrt(max(2.0 * pull * load + 3.0 * pull * pull, 0.0) / K_beta)


@formula
def slip_resistance_printed(x, theta, K_beta):
    """Return the tangential force at which a JKR contact peels by eq (10) of soft_coating_2015, as published.

    It is T = 4 (K beta)^(-1/2) sqrt((2 pi/theta) x^(3/2) - 3 pi^2/theta^2), in units of K R^(1/2) sigma^(3/2). x: a^2/(R
    sigma), with the contact radius a. theta: elastic adhesion index. K_beta: K beta, with K = (4/3) E* and the tangential
    compliance beta of the pair of bodies. A negative radicand counts as 0.
    """
    hertz = x * math.sqrt(x)
    return 4.0 * math.sqrt(max(2.0 * math.pi / theta * hertz - 3.0 * (math.pi / theta) ** 2, 0.0) / K_beta)


@formula
def resistance(u, w, load, area, theta, K_beta):
    return slip_resistance(load, theta, K_beta), 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance | None:
    """Return the tangential force at which a JKR asperity peels along an elastic segment, or None for other segments.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts. Plastic asperities have no
    resistance, because the energy balance does not apply to them. Raises InputError if `peeling` is 0.
    """
    if segment.state != "elastic":
        return None
    share = mode_mixity_share(groups)
    # In G_N + zeta G_T = gamma, G_T is proportional to T^2 beta, so that zeta multiplies the tangential compliance.
    return TangentialResistance(resistance, (groups.theta, groups.K_beta * share), pull_off_coordinate(segment, groups))


def mode_mixity_share(groups: Groups) -> np.ndarray:
    """Return zeta (n,), the fraction of the tangential energy release rate that contributes to peeling; the default is 1.

    It is the group `peeling`. Raises InputError if it is 0, because the peeling force would then be infinite.
    """
    share = np.ones_like(groups.theta) if groups.peeling is None else groups.peeling
    if np.any(share == 0.0):
        raise InputError("peeling", 0.0, "above 0; with 0 there is no peeling: choose another tangential law")
    return share


def pull_off_coordinate(segment: NormalSegment, groups: Groups) -> np.ndarray | None:
    """Return the coordinate (n, 1) at which the load alone pulls a JKR contact off, or None for a loading segment.

    At this coordinate the peeling force is 0 and has a kink, because it is proportional to |u^3 - S/2|. u: coordinate of
    the JKR contact. S = sqrt(6 pi/theta), with the elastic adhesion index theta. groups: dimensionless groups of n
    contacts.
    """
    if segment.lowest >= 0.0:
        return None
    S = np.sqrt(6.0 * math.pi / groups.theta)
    return coordinates(segment, -S / 6.0 * np.cbrt(S / 2.0))[:, None]  # w = u (u^3 - (2/3) S) at u^3 = S/2


RECORD = TangentialLaw(
    key="savkoor_briggs_1977",
    title="Peeling of an adhesive contact by shear",
    grade="B",
    sources=(
        Source("savkoor_briggs_1977", "", "energy balance, re-derived from the state before shearing"),
        Source(
            "johnson_1996",
            "",
            "modes are coupled more weakly than in Savkoor and Briggs, by an empirical parameter; G_N + zeta G_T = gamma is "
            "the simplest such law and not from this source",
        ),
    ),
    tangential_resistance=tangential_resistance,
    yielded="none",
    of_half_space="its energy balance uses the stiffness of a half-space",
    like="layered_peeling",
    required_traits={"JKR": "it computes the peeling of a JKR contact"},
    verified="energy balance; forces and areas at peeling of four contacts, tabulated independently; evaluation at 30 digits",
    needs=("theta", "K_beta"),
    takes=("peeling",),
    notes="The force of peeling only; yield does not limit it. `peeling` is zeta in G_N + zeta G_T = gamma: the force is "
    "proportional to zeta^(-1/2), 1 is Savkoor and Briggs, and 0 (no peeling) raises an error. Measured contacts shrink less "
    "under shear than with zeta = 1. Asperities that have yielded have no resistance.",
)
