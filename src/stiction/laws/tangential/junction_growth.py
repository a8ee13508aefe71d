r"""Junction growth from a weak interface (Tabor 1959) to full stick (Brizmer et al. 2007).

*Assumes*: as in [`tabor_1959`](#tabor_1959), the area $A$ of a junction grows with its shear force $T$ as $A^2=A_0^2+gT^2$,
from the area $A_0$ without shear. The growth ends where a junction in full stick slides, at the force $T_s$ of
[`brizmer_kligerman_etsion_2007`](#brizmer_kligerman_etsion_2007). There its mean shear stress is the shear strength $\tau_b$ of
the bulk, so its area is $A_s=T_s/\tau_b$, which determines $g$. *Sources*: [tabor_1959] for the growth,
[brizmer_kligerman_etsion_2007] for the force in full stick, and [brizmer_kligerman_etsion_2007_junction] for the growth of the
area until the junction has lost its tangential stiffness.

An interface with the shear strength $\tau_0=c\,\tau_b$ slides where $T=\tau_0A(T)$:

$$
\frac1{T^2}=\frac{1-c^2}{(\tau_0A_0)^2}+\frac1{T_s^2}\quad(c\le1);\qquad T=T_s\quad(c\ge1)\quad\text{(SI)}
$$

$$
\frac{A^2}{A_0^2}=1+\left(\frac{A_s^2}{A_0^2}-1\right)\frac{T^2}{T_s^2}
$$

*Limits*: [`bowden_tabor_1943`](#bowden_tabor_1943) for $c\to0$; full stick, $T_s$, for $c=1$ and above, where the bulk shears;
[`tabor_1959`](#tabor_1959) of a plastic junction for $T_s\to\infty$. The force rises continuously between these limits.
*Reconstructed*: Tabor's form of the area between these limits, and the area at full stick; the growth that Brizmer, Kligerman
and Etsion computed, and their fit, were not available. The option `alpha` sets $\tau_b=H/\sqrt\alpha$. If this makes the bulk
so strong that $A_s<A_0$, the equations give a smaller area, which has no physical meaning. *Check*: with $\alpha=3(H/Y)^2$,
that is $\tau_b=Y/\sqrt3$; Hertz's asperity at the load $P_c$ of first yield in full stick for $\nu=0.3$, $H/Y=2.8$ (mean
pressure 1.0175 $Y$, $A_s=1.805A_0$):

| $c$ | 0.01 | 0.1 | 0.3 | 0.5 | 0.8 | 0.95 | 1 |
|---|---|---|---|---|---|---|---|
| $\mu$ | 0.0057 | 0.0569 | 0.1758 | 0.3120 | 0.6085 | 0.8808 | 1.0242 |

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $k=H/Y$ hardness divided by yield stress. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential import brizmer_kligerman_etsion_2007 as full_stick
from stiction.laws.tangential.bowden_tabor_1943 import shear_force
from stiction.laws.tangential.shared.junctions import ALPHA, interface_over_bulk
from stiction.records.registry import Limit, TangentialLaw
from stiction.records.sources import Source

_force_of_full_stick = full_stick.resistance


@formula
def growing_force(of_interface, of_full_stick, share):
    """Return the tangential force T of a growing junction, from 1/T^2 = (1 - c^2)/(tau_0 A)^2 + 1/T_s^2.

    of_interface: tau_0 A, strength of the interface times area before growth. of_full_stick: T_s, force of a junction in
    full stick. share: c, strength of the interface divided by the bulk's, at most 1. T is T_s for c = 1; it is tau_0
    A/sqrt(1 - c^2) for T_s -> infinity, and 0 if tau_0 A or T_s is 0.
    """
    if of_interface == 0.0 or of_full_stick == 0.0:
        return 0.0
    weaker = (1.0 - share) * (1.0 + share) * (of_full_stick / of_interface) ** 2
    return of_full_stick / math.sqrt(1.0 + weaker)


@formula
def resistance(u, w, load, area, L_c, eta, shear_strength, share):
    """Return the slip-limited and the yield-limited force of a growing junction; one of the two is 0.

    The force is slip-limited if the interface is weaker than the bulk (share < 1), else yield-limited. L_c: load at first
    yield in full stick. eta: hardness group. shear_strength: strength of the interface divided by hardness. share: strength
    of the interface divided by the bulk's. Units: loads and forces in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    _, of_full_stick = _force_of_full_stick(u, w, load, area, L_c)
    force = growing_force(shear_force(area, eta, shear_strength), of_full_stick, share)
    return (force, 0.0) if share < 1.0 else (0.0, force)


def tangential_resistance(segment: NormalSegment, groups: Groups, alpha: str) -> TangentialResistance:
    stick = full_stick.tangential_resistance(segment, groups)
    share = np.minimum(interface_over_bulk(groups, alpha), 1.0)
    return TangentialResistance(
        resistance, (*stick.parameters, groups.eta, groups.shear_strength, share), stick.kinks, stick.branch
    )


RECORD = TangentialLaw(
    key="junction_growth",
    title="From a weak interface to full stick: junctions that grow until they slide",
    grade="C",
    sources=(
        Source("tabor_1959", "", "area growing with the shear force, as commonly quoted; here it ends at full stick"),
        Source("brizmer_kligerman_etsion_2007", "", "sliding inception in full stick, as commonly quoted"),
        Source(
            "brizmer_kligerman_etsion_2007_junction",
            "",
            "areas grow until the junction has lost its stiffness; the growth itself, not available, is reconstructed",
        ),
    ),
    tangential_resistance=tangential_resistance,
    yielded="junction growth",
    required_traits={"no adhesion": "it neglects adhesion"},
    of_half_space="its limit is full stick of a homogeneous sphere, and a film changes stick and yield",
    verified="shear stress and grown area solved together by bisection at 30 digits; the three limits",
    needs=("hardness_group", "nu", "hardness_to_yield", "shear_strength"),
    validity=full_stick.RECORD.validity,
    limits=(
        Limit("bowden_tabor_1943", {"shear_strength": 1e-7}, ("friction_force",), 1e-11),
        Limit("brizmer_kligerman_etsion_2007", {"shear_strength": 1.0}, ("friction_force",), 1e-12),
    ),
    own_options={"alpha": tuple(ALPHA)},
    notes="alpha: 3 (H/Y)^2 (von_mises) or 9, quoted from experiments. The shear strength of the bulk is H/sqrt(alpha); an "
    "interface of this strength or more is in full stick. The transition from weak interface to full stick is this project's "
    "own.",
)
