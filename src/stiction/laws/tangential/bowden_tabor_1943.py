r"""A constant shear strength of the interface: Bowden & Tabor 1943.

*Assumes*: the interface has a shear strength $\tau_0$ that does not depend on the pressure or on yield of the asperities.
*Sources*: [bowden_tabor_1943], [bowden_tabor_1950].

$$
T=\frac{\tau_0}H\,\eta\,A\qquad(\text{SI:}\ T=\tau_0\,\pi a^2)
$$

for elastic and plastic asperities ($a$: contact radius). If all contacts are plastic, the friction coefficient is
$\mu=\tau_0/H$, which is Bowden and Tabor's $s/p$. The law needs `interfacial_shear_strength`.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness. Full list:
[symbols](#1-units).
"""

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.records.registry import TangentialLaw
from stiction.records.sources import Source


@formula
def shear_force(area, eta, shear_strength):
    """Return the tangential force T = tau_0 A of a contact, in units of K R^(1/2) sigma^(3/2).

    area: contact area A in units of pi R sigma. eta: hardness group; eta times the area is the load at which the mean
    pressure is the hardness H. shear_strength: strength of the interface divided by the hardness, tau_0/H.
    """
    return shear_strength * eta * area


@formula
def resistance(u, w, load, area, eta, shear_strength):
    return shear_force(area, eta, shear_strength), 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance:
    """Return the tangential resistance on a segment: shear strength of the interface times contact area, elastic or plastic.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts.
    """
    return TangentialResistance(resistance, (groups.eta, groups.shear_strength))


RECORD = TangentialLaw(
    key="bowden_tabor_1943",
    title="Constant shear strength of the interface",
    grade="B",
    sources=(
        Source("bowden_tabor_1943", "", "friction as the shear strength of the film times the real contact area"),
        Source("bowden_tabor_1950", "", "the adhesion theory of friction"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="interface",
    interfacial=True,
    of_area=True,
    verified="evaluation in SI units at 30 digits; mu = tau_0/H where the mean pressure is the hardness",
    needs=("hardness_group", "shear_strength"),
    notes="With a soft film, the area is the outer contact area of the asperity and tau_0 the film's shear strength. If all "
    "contacts are plastic, mu is tau_0 divided by their mean pressure, Bowden and Tabor's s/p.",
)
