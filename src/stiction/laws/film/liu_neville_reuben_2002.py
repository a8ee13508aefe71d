r"""A plastic film on an elastic-plastic substrate, with adhesion: after Liu, Neville & Reuben 2002.

*Assumes* (abstract of [liu_neville_reuben_2002]): the adhesion of Derjaguin, Muller and Toporov acts on an elastic-plastic
soft coating. *Source*: [liu_neville_reuben_2002], its abstract. *Reconstruction*: the load $P_\text{Chang}$ of
[`chang_1997`](#chang_1997) minus DMT's adhesive force with the film's work of adhesion $\gamma_f=n_g\gamma$, for every
touching asperity,

$$
P=P_\text{Chang}-\frac{2\pi n_g}\theta
$$

(in SI the force is $2\pi R\gamma_f$). *Check* of the abstract's statements: with a shear strength of the interface, friction
rises with film thickness at plasticity indices above 0.5; at a plasticity index of 0.25 and light load, friction rises as a
very thin film gets thinner. With `chang_etsion_bogy_1988`, where only the substrate resists, only the second trend appears.
*Unknown*: all equations of the source. *Limit*: `chang_1997` without adhesion.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of adhesion; $n_g$ work
of adhesion of the film divided by the substrate's. Full list: [symbols](#1-units).
"""

import math

from stiction.contact.indices import Groups
from stiction.engine.regime import Regime
from stiction.laws.film.chang_1997 import DEPARTURES, FLOWING, NO_ADHESION, plastic_film
from stiction.laws.shared_claims import SOFT_FILM
from stiction.records.registry import FilmLaw
from stiction.records.sources import Source


def regimes(groups: Groups, law) -> list[Regime]:
    """Return the regimes of a surface with a plastic film and DMT adhesion.

    A regime is a segment of an asperity law together with the tangential force on it. Forces are in units of K R^(1/2)
    sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated contacts. law: asperity law
    and tangential law of the substrate (a joining.Law).
    """
    return plastic_film(groups, law, 2.0 * math.pi * groups.n_g / groups.theta)


RECORD = FilmLaw(
    key="liu_neville_reuben_2002",
    title="Plastic film on an elastic-plastic substrate, with DMT adhesion",
    grade="C",
    sources=(
        Source("liu_neville_reuben_2002", "abstract", "reconstructed: the equations were not available"),
        Source("derjaguin_muller_toporov_1975", "", "adhesion, as a constant force on each touching asperity"),
        Source("chang_1997", "", "the contact, itself reconstructed"),
        Source("chang_etsion_bogy_1988", "", "friction of the substrate, with the tangential law of this name"),
    ),
    regimes=regimes,
    asperity="chang_etsion_bogy_1987",
    required_traits=NO_ADHESION,
    departures=DEPARTURES,
    verified="independent sums over heights; chang_1997 without adhesion; trends of the abstract, see the note",
    needs=("theta", "hardness_group", "n_H", "n_g", "tau"),
    validity=(SOFT_FILM, *FLOWING),
    notes="With the asperity law chang_etsion_bogy_1987 and a shear strength of the interface, results agree with the "
    "abstract: at a plasticity index above 0.5 friction rises with the film thickness; at 0.25 and light load it rises as a "
    "very thin film gets thinner. With chang_etsion_bogy_1988, where only the substrate resists, friction falls with "
    "thickness at every plasticity index unless adhesion is strong. Asperities that do not touch are not attracted.",
)
