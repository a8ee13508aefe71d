r"""A film that affects friction but not the normal contact: Ogilvy 1993.

*Assumes* (according to the 2015 paper, [soft_coating_2015]): the normal contact does not include the film. *Source*:
[ogilvy_1993]. Load and area are therefore those of the substrate, $P_s$ and $A_s$, by any asperity law. The film shears over
the whole area with its own strength:

$$
P=P_s(w),\qquad A=A_s(w),\qquad T=\tau_0A
$$

(the last equation is in SI). If the contact is plastic, this is Bowden and Tabor's soft film: the friction coefficient is
$\mu=\tau_0/H_s$, with the substrate's hardness $H_s$. *Unknown*: the text of the source, which solved the contact of given
surfaces numerically.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $\tau_0$ shear strength of the interface. Full list: [symbols](#1-units).
"""

import math

from stiction.contact.indices import Groups
from stiction.engine.regime import Regime
from stiction.records.registry import Departure, FilmLaw, Validity
from stiction.records.sources import Source


def regimes(groups: Groups, law) -> list[Regime]:
    """Return the regimes of the bare substrate, because this film changes only the shear strength.

    A regime is a segment of an asperity law together with the tangential force on it. law: asperity law of the substrate,
    and a tangential law of the interface, which uses the shear strength of the film. groups: dimensionless groups of n
    coated contacts; modulus, hardness and thickness of the film are not used.
    """
    return law.regimes(groups, body="substrate")


RECORD = FilmLaw(
    key="ogilvy_1993",
    title="Film too thin to affect the normal contact: load and area of the substrate, shear strength of the film",
    grade="C",
    sources=(
        Source("ogilvy_1993", "", "not available; according to the 2015 paper, the normal contact does not include the film"),
        Source("bowden_tabor_1943", "", "shear strength of the film, hardness of the substrate"),
    ),
    regimes=regimes,
    tangential="interface",
    departures=(
        Departure("thick", "load", -0.97, math.inf),
        Departure("thick", "contact_area", -0.67, 1.7),
        Departure("thick", "friction_force", -0.67, 1.7),
    ),
    verified="friction coefficient of plastic asperities equals shear strength divided by hardness",
    needs=("shear_strength",),
    validity=(Validity("tau", 0.0, 1.0, "the law assumes a film that is thinner than the roughness"),),
    notes="Modulus, hardness and thickness of the film have no effect. shear_strength is that of the film divided by the "
    "hardness of the substrate. The source solved the contact of given rough surfaces numerically; here asperity laws take "
    "its place.",
)
