r"""A shear strength of the interface that grows with pressure: Briscoe & Tabor 1978.

*Assumes*: the shear strength of the interface grows with pressure, $\tau=\tau_0+\alpha p$, here with the mean pressure $p$ of
each asperity; $\alpha$ is the pressure coefficient. *Source*: [briscoe_tabor_1978].

$$
T=\frac{\tau_0}H\,\eta\,A+\alpha\max(P,0)
$$

Tension does not lower the strength; this is the project's own choice. For heavy loads the friction coefficient tends to
$\alpha$ plus the ratio of $\tau_0$ to the mean pressure. *Limit*: `bowden_tabor_1943` for $\alpha=0$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness. Full list:
[symbols](#1-units).
"""

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.bowden_tabor_1943 import shear_force
from stiction.laws.tangential.shared.zero_load import zero_load
from stiction.records.registry import Limit, TangentialLaw
from stiction.records.sources import Source


@formula
def resistance(u, w, load, area, eta, shear_strength, pressure_coefficient):
    """Return the slip-limited and the yield-limited force of one asperity, (tau_0 A + alpha max(P, 0), 0).

    load, area: P and A. eta: hardness group. shear_strength: tau_0/H, strength of the interface divided by the hardness.
    pressure_coefficient: alpha. u, w: not used. Units: load and forces in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    return shear_force(area, eta, shear_strength) + pressure_coefficient * max(load, 0.0), 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance:
    """Return the tangential resistance on a segment, with a kink at zero load; under tension, the load adds no strength.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts.
    """
    turns = zero_load(segment)
    parameters = groups.eta, groups.shear_strength, groups.pressure_coefficient
    return TangentialResistance(resistance, parameters, None if turns is None else turns[:, None])


RECORD = TangentialLaw(
    key="briscoe_tabor_1978",
    title="Shear strength of the interface that grows with pressure",
    grade="B",
    sources=(
        Source(
            "briscoe_tabor_1978",
            "",
            "shear strength linear in pressure, here the mean pressure of each asperity; tension does not lower it, which is "
            "this project's choice",
        ),
    ),
    tangential_resistance=tangential_resistance,
    yielded="interface",
    interfacial=True,
    of_area=True,
    verified="evaluation in SI units at 30 digits; bowden_tabor_1943 for alpha = 0",
    needs=("hardness_group", "shear_strength", "pressure_coefficient"),
    limits=(Limit("bowden_tabor_1943", {"pressure_coefficient": 0.0}, ("friction_force",), 1e-12),),
    notes="For heavy loads mu tends to alpha plus tau_0 divided by the mean pressure.",
)
