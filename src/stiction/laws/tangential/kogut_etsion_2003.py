r"""Sliding inception of an elastic-plastic sphere on a rigid flat: Kogut & Etsion 2003, fitted to finite elements.

*Assumes*: sliding begins when a sphere under load and shear loses its strength, because yield reaches its surface (finite
elements). *Sources*: [kogut_etsion_2003], and [kogut_etsion_2004], which prints the same fits, multiplied by the load. The
friction coefficient $\mu$ of one asperity, with $r=w/w_c$ of [`kogut_etsion_2002`](#kogut_etsion_2002), is

$$
\mu=\begin{cases}0.52\,r^{-0.518}&r\le1\\0.822-0.389\,r+0.085\,r^2-0.007\,r^3&1<r<6\\0&r\ge6\end{cases}
$$

*Reconstructed*: the texts were not available, but three quotations agree. $T/P_c=0.52\,r^{0.982}$, with the load
$P_c=w_c^{3/2}$ at first yield, equals $\mu=0.516\,(P/P_c)^{-0.345}$ within 1.2 %. The cubic times 1.03, rounded to two
decimals, is the version printed in 2004. *Trap*: that version is negative above $r=4.3$; three decimals are needed. *Jumps*:
$\mu$ falls from 0.520 to 0.511 at $r=1$ (with the authors' load, $T$ rises by 1.2 %) and from 0.036 to 0 at $r=6$. With another
asperity law, $\mu(r)$ is unchanged and $T$ is $\mu$ times the load of that law. With the option `plastic_junctions`, asperities
at and beyond $6\,\omega_c$ resist according to another law, and results show by how much $\mu$ then differs from the paper's
value; the default `none` is the paper's assumption.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $w_c$ displacement at first yield. Full list: [symbols](#1-units).
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.asperity.chang_etsion_bogy_1987 import critical_interference, hardness_coefficient
from stiction.laws.joining import coordinates, normal_states
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.shared.plastic_junctions import LAWS, beyond
from stiction.records.registry import NO_JUNCTIONS, TangentialLaw, Validity
from stiction.records.sources import Source

NONE_FROM = 6.0  # omega/omega_c from which on the plastic zone reaches the surface and there is no resistance to shear


@formula
def friction_coefficient(w_ratio):
    """Return the friction coefficient of one asperity, tangential force at failure divided by load, Q/P.

    w_ratio: displacement divided by displacement at first yield. Up to 1 the coefficient follows from Q/P_c = 0.52
    w_ratio^0.982 and P/P_c = w_ratio^1.5. From 1 to 6 it is a cubic, and beyond it is 0. The 2004 paper prints the cubic times
    1.03 with two decimals, which is negative above 4.3; three decimals are therefore used here.
    """
    if w_ratio <= 1.0:
        return 0.52 * w_ratio**-0.518
    cubic = 0.822 + w_ratio * (-0.389 + w_ratio * (0.085 - 0.007 * w_ratio))
    return cubic if w_ratio < NONE_FROM else 0.0


@formula
def resistance(u, w, load, area, w_c):
    """Return the slip-limited and the yield-limited force of one asperity, (0, mu P).

    Both are 0 before first touch and for w >= 6 w_c. w, w_c: displacement, and displacement at first yield, in units of
    sigma. load: P in units of K R^(1/2) sigma^(3/2), like the forces. u, area: not used.
    """
    return 0.0, load * friction_coefficient(w / w_c) if w > 0.0 else 0.0


def tangential_resistance(
    segment: NormalSegment, groups: Groups, plastic_junctions: str = NO_JUNCTIONS
) -> TangentialResistance:
    w_c = critical_interference(groups.eta, hardness_coefficient(groups.nu))
    kinks = np.stack([coordinates(segment, w_c), coordinates(segment, NONE_FROM * w_c)], axis=1)
    first = np.ascontiguousarray(segment.edges[:, 0])
    # Q grows as w^0.982 from first touch, which is a fractional power in any smooth coordinate.
    touches = normal_states(segment, first)[:, 0] <= 0.0
    published = TangentialResistance(resistance, (w_c,), kinks, np.where(touches, first, -np.inf))
    return beyond(plastic_junctions, NONE_FROM * w_c, published, segment, groups)


RECORD = TangentialLaw(
    key="kogut_etsion_2003",
    title="Sliding inception of an elastic-plastic sphere when yield reaches its surface",
    grade="C",
    sources=(
        Source("kogut_etsion_2003", "", "fits reconstructed: the text was not available; three quotations of them agree"),
        Source("kogut_etsion_2004", "", "the same fits times the load, to two decimals"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="none",
    of_half_space="it is fitted to finite elements of a homogeneous sphere, and a film moves the yielding zone",
    required_traits={"no adhesion": "it neglects adhesion"},
    verified="the quoted forms agree with each other and with the rounded print of 2004; independent evaluation at 30 digits",
    needs=("hardness_group", "nu"),
    junctions=LAWS,
    validity=(
        Validity(
            "plasticity_index",
            0.0,
            2.0,
            "asperities above six times the critical interference have no friction in this law, so mu is too low",
            "effect",
            as_published=True,
        ),
    ),
    notes="With any asperity law, the friction coefficient of one asperity is the authors' function of its interference; the "
    "force is this coefficient times the load of the law. plastic_junctions names another law for asperities beyond six "
    "critical interferences. The published segments do not meet: mu falls from 0.520 to 0.511 at one critical interference "
    "(with the authors' load the force rises by 1.2 %), and from 0.036 to 0 at six.",
)
