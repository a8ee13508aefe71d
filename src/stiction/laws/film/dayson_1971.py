r"""A plastic film that roughness penetrates, with two shear strengths: after Dayson 1971.

*Assumes* (abstract of [dayson_1971]): friction rises as a very thin solid film gets thinner, because asperities penetrate more
of it; the effect is stronger on rougher surfaces. According to the 2015 paper, [soft_coating_2015], the contact is plastic.
*Source*: [dayson_1971], its abstract. *Reconstruction*: the geometry of [`chang_1997`](#chang_1997) with film and substrate
both plastic. An asperity at the displacement $\omega$ touches on the area $2\pi R\omega$. Where it is deeper than the film
thickness $t$, it touches the substrate on the area $A_s$ at the substrate's hardness $H$. On the other part of the area,
$A_f$, it touches the film,

$$
A_f=2\min(w,\tau),\qquad A_s=2\max(w-\tau,0),\qquad P=\eta\,(pA_f+A_s),\qquad
T=\eta\left(\frac{\tau_0}HA_f+\frac{A_s}{\sqrt3\,k}\right)
$$

$\tau_0$ is the shear strength of the film, from a tangential law of the interface. The exposed substrate shears at its shear
yield stress $Y/\sqrt3$, like the junctions of [bowden_tabor_1950]. `rim_pressure` chooses the pressure on the film: its own
hardness, $p=n_H$, as in `chang_1997`; or the hardness of the substrate, $p=1$, for a film so thin that the substrate carries
the load through it ([bowden_tabor_1943]).

*Limit*: the friction coefficient is $\mu=\tau_0/(pH)$ for a thick film, $\mu=1/(\sqrt3\,k)$ for zero thickness, and lies
between these values otherwise. Friction therefore rises as the film gets thinner if $\tau_0/(pH)<1/(\sqrt3\,k)$. With $p=1$
this holds for every film that is weaker in shear than its substrate. With $p=n_H$ a soft metal film that shears at its own
shear yield stress $Y_f/\sqrt3$ does not change $\mu$; only weaker films (layered solids, polymers) show the trend of the
abstract. *Check*: for Gaussian heights (density $\varphi$, distribution function $\Phi$) and the mean separation $h$ in units
of $\sigma$, the mean displacement is $F(h)=\varphi(h)-h\,[1-\Phi(h)]$. The penetrated fraction of the area is
$F(h+\tau)/F(h)$, and with $p=1$

$$
\mu=\frac{\tau_0}H+\left(\frac1{\sqrt3\,k}-\frac{\tau_0}H\right)\frac{F(h+\tau)}{F(h)},\qquad P=2\eta F(h)
$$

*Unknown*: all equations of the source, including how it computes the penetrated fraction and which shear strengths it uses.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $n_H$ hardness of the film
divided by the substrate's; $\tau=t/\sigma$ film thickness; $k=H/Y$ hardness divided by yield stress. Full list:
[symbols](#1-units).
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.regime import Regime
from stiction.laws.film.shared.plastic import at_pressure
from stiction.laws.joining import Law, Weights
from stiction.laws.segment import NormalSegment, displaced, edges_at
from stiction.laws.shared_claims import PLASTIC_FILM, SOFT_FILM
from stiction.laws.tangential.bowden_tabor_1943 import RECORD as CONSTANT_STRENGTH
from stiction.records.registry import FilmLaw
from stiction.records.sources import Source

RIM_PRESSURE = ("film_hardness", "substrate_hardness")


@formula
def rim(w, pressure, tau):
    """Return w, dw/du = 1, load and area of the ring of film around the contact with the substrate; the coordinate u is w.

    For w > tau the film is penetrated, and load and area of the ring are constant. w: displacement, tau: film thickness,
    both in units of sigma. pressure: pressure on the film divided by the substrate's hardness, times the hardness group
    eta.
    """
    return w, 1.0, 2.0 * pressure * tau, 2.0 * tau


def regimes(groups: Groups, law: Law, rim_pressure: str) -> list[Regime]:
    """Return the regimes of a surface with a plastic film that asperities penetrate.

    A regime is a segment of an asperity law together with the tangential force on it. Forces are in units of K R^(1/2)
    sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated contacts. law: only its
    tangential law is used, which must describe the interface; it gives the shear strength of the film. rim_pressure:
    "film_hardness" or "substrate_hardness", the pressure on the film.
    """
    laws = len(groups)
    tau, none = np.broadcast_to(groups.tau, laws), np.zeros(laws)
    pressed = groups.eta * (groups.n_H if rim_pressure == "film_hardness" else np.ones(laws))
    edges = edges_at(tau, np.inf)
    around = NormalSegment(rim, displaced, (pressed, tau), edges, "plastic", float(np.min(tau, initial=np.inf)))
    bare = Law(law.asperity, None if law.tangential is None else CONSTANT_STRENGTH)
    metal = groups.with_changes(shear_strength=groups.substrate().body_shear_strength)
    return [
        law.join(at_pressure(pressed, none, tau), groups, body="film"),
        law.join(around, groups, body="film"),
        bare.join(at_pressure(groups.eta, none, np.inf), metal, Weights(shift=tau), body="substrate", touching=False),
    ]


RECORD = FilmLaw(
    key="dayson_1971",
    title="Plastic film that asperities penetrate, with the shear strengths of film and substrate",
    grade="C",
    sources=(
        Source("dayson_1971", "abstract", "reconstructed: the equations were not available"),
        Source("chang_1997", "abstract", "the geometry of a penetrated film, itself reconstructed"),
        Source("bowden_tabor_1950", "", "shear strength of the film where it is intact, of the metal where it is penetrated"),
    ),
    regimes=regimes,
    tangential="interface",
    own_asperity=True,
    bares_substrate=True,
    confined=True,
    own_options={"rim_pressure": RIM_PRESSURE},
    verified="closed forms for Gaussian heights; limits of the film alone and of the substrate alone; trends of the abstract",
    needs=("hardness_group", "hardness_to_yield", "n_H", "tau"),
    validity=(
        PLASTIC_FILM,
        SOFT_FILM,
    ),
    notes="The contact's interfacial shear strength is that of the film. The substrate shears at Y/sqrt(3), with the "
    "contact's k = H/Y. Friction rises as the film gets thinner if the film's shear strength divided by the pressure on it is "
    "below 1/(sqrt(3) k), which is 0.206 for k = 2.8. With rim_pressure = substrate_hardness this holds for every film weaker "
    "in shear than its substrate; with film_hardness it does not hold for a metal film that shears at its own shear yield "
    "stress.",
)
