r"""Tangential force at which an adhesive contact peels, in terms of the pull-off force: Thornton 1991.

*Assumes*: as [`savkoor_briggs_1977`](#savkoor_briggs_1977) at $\zeta=1$. Both give the same force; here it is written with
the pull-off force $P_c$ and the shear moduli $G_1$, $G_2$ of both bodies (equation in SI). *Source*: [thornton_1991], as
commonly quoted.

$$
T=4\sqrt{\left(PP_c+P_c^2\right)G^*/E^*},\qquad\frac1{G^*}=\beta=\frac{2-\nu_1}{G_1}+\frac{2-\nu_2}{G_2},\qquad
\frac{G^*}{E^*}=\frac4{3K\beta}
$$

*Unknown*: the sliding force of a contact after peeling by the 1991 criterion; it is not included.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $\beta$ tangential compliance of the pair of bodies, $K\beta=\tfrac83(2-\nu)/(1-\nu)$
for equal bodies; $P_c=\tfrac32\pi\gamma R$ pull-off force. Full list: [symbols](#1-units).
"""

import math

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.savkoor_briggs_1977 import pull_off_coordinate
from stiction.records.registry import Limit, TangentialLaw
from stiction.records.sources import Source


@formula
def peeling_force(load, pull_off, stiffness_ratio):
    """Return the tangential force at which a JKR contact peels, T = 4 sqrt((P P_c + P_c^2) G*/E*), in the unit of the load.

    load: P. pull_off: P_c = (3/2) pi gamma R, in the same unit. stiffness_ratio: G*/E*, with the contact modulus E*, 1/G* =
    (2 - nu_1)/G_1 + (2 - nu_2)/G_2, and shear modulus G_i and Poisson's ratio nu_i of each body. The radicand is not negative,
    because a contact is lost at P = -P_c; a value below 0 due to rounding is replaced by 0.
    """
    return 4.0 * math.sqrt(max((load + pull_off) * pull_off * stiffness_ratio, 0.0))


@formula
def resistance(u, w, load, area, theta, K_beta):
    """Return the slip-limited and the yield-limited force, (T, 0), where T is the force at which a JKR contact peels.

    load: in units of K R^(1/2) sigma^(3/2), like T. theta: elastic adhesion index. K_beta: K times the tangential
    compliance beta of the pair of bodies. G* = 1/beta and K = (4/3) E* give G*/E* = (4/3)/(K beta). u, w, area: not used.
    """
    return peeling_force(load, 1.5 * math.pi / theta, 4.0 / (3.0 * K_beta)), 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance | None:
    if segment.state != "elastic":
        return None
    return TangentialResistance(resistance, (groups.theta, groups.K_beta), pull_off_coordinate(segment, groups))


RECORD = TangentialLaw(
    key="thornton_1991",
    title="Peeling of an adhesive contact by shear, from its pull-off force",
    grade="B",
    sources=(Source("thornton_1991", "", "the critical force as commonly quoted; it equals that of Savkoor and Briggs"),),
    tangential_resistance=tangential_resistance,
    yielded="none",
    of_half_space="its force uses the stiffness of a half-space",
    like="layered_peeling",
    required_traits={"JKR": "it computes the peeling of a JKR contact"},
    verified="equality with Savkoor and Briggs; evaluation in SI units at 30 digits",
    needs=("theta", "K_beta"),
    limits=(Limit("savkoor_briggs_1977", {"peeling": 1.0}, ("friction_force",), 1e-9),),
    notes="The first part of the 1991 criterion. The sliding friction after peeling, under load plus adhesion, is not "
    "included, because its form could not be checked. Asperities that have yielded have no resistance.",
)
