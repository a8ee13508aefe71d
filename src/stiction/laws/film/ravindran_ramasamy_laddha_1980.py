r"""A soft metal film whose friction varies as the cube root of thickness/load: after Ravindran, Ramasamy & Laddha 1980.

*Assumes* (abstract of [ravindran_ramasamy_laddha_1980]): in spherical contact, the friction coefficient of a thin soft metal
film is proportional to the cube root of thickness divided by load where Amontons's law fails. It fails because the substrate
deforms plastically. *Source*: [ravindran_ramasamy_laddha_1980], its abstract, which calls the relation empirical. For one
asperity with the load $W$ in N and the film thickness $t$ in m

$$
\mu=c\left(\frac tW\right)^{1/3}=\left(\frac{Ct}W\right)^{1/3},\qquad C=c^3\ \text{in N/m}
$$

*Reconstruction*: friction is the film's shear strength divided by the mean pressure, $\mu=\tau_0/p$. The cube root then
requires a pressure proportional to $W^{1/3}$, which on the area $2\pi R\omega$ of a plastic contact is
$p\propto\sqrt{\omega/t}$. The pressure lies between the film's hardness $H_f$, where the film carries the load, and the
substrate's hardness $H$, where the substrate carries it ([bowden_tabor_1943]). At both limits Amontons's law holds, in
agreement with the abstract. Friction is higher where the film carries the load, as in the abstract of [rabinowicz_1967]. With
$p$ divided by $H$ and multiplied by $\eta$ in the units here,

$$
A=2w,\qquad P=pA,\qquad p=\eta\,\min\left[1,\ n_H\max\left(1,\ q\sqrt{w/\tau}\right)\right]
$$

$$
\mu=\min\left\{\frac{\tau_0}{H_f},\ \max\left[\frac{\tau_0}H,\ \left(\frac{Ct}W\right)^{1/3}\right]\right\},\qquad
C=\frac{2\pi R\,\tau_0^3}{q^2H_f^2}
$$

$C$ is `friction_constant` of the coating (`film_friction_constant` of indices is $C/(K\sqrt{R\sigma})$); together with
$\tau_0$ it determines $q$. If it is not given, $q=1$, and the substrate takes part once the displacement exceeds the film
thickness. $\tau_0$ comes from a tangential law of the interface. A film harder than its substrate ($n_H>1$) is treated as
equally hard, $p=\eta$.

*Check*: $\mu=\tau_0/(4^{1/3}H_f)=0.62996\,\tau_0/H_f$ for one sphere with $W=8\pi RH_ft$ and $q=1$. The powers of $t$ and $W$
are exact between the two limits, whose loads differ by the factor $n_H^{-3}$. *Limit*: $\mu=\tau_0/H_f$ for a thick film,
$\tau_0/H$ for zero thickness. *Unknown*: $c$, and how it depends on hardness, strength and radius. The sum over asperities is
this project's own: at a given load, $\mu$ of a rough surface is an average over its asperities.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $n_H$ hardness of the film divided by the
substrate's; $\tau=t/\sigma$ film thickness. Full list: [symbols](#1-units).
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.regime import Regime
from stiction.laws.film.shared.plastic import at_pressure
from stiction.laws.joining import Law
from stiction.laws.segment import NormalSegment, edges_at, root_of
from stiction.laws.shared_claims import PLASTIC_FILM, SOFT_FILM
from stiction.records.registry import Departure, FilmLaw
from stiction.records.sources import Source

_THINNEST = 1e-200  # replaces a film thickness of 0, over sigma


@formula
def shared(u, stiffness):
    """Return displacement w, dw/du, load and contact area while film and substrate share the load, at u = sqrt(w).

    The mean pressure is (stiffness/2) u, in units of load divided by area; the area is 2 w. Units: w in sigma, area in pi R
    sigma.
    """
    w = u * u
    return w, 2.0 * u, stiffness * w * u, 2.0 * w


def rise(groups: Groups) -> np.ndarray:
    """Return the factor q (n,) in the mean pressure q n_H sqrt(w/tau) eta while film and substrate carry the load together.

    The pressure is in units of load divided by area. w, tau: displacement and film thickness in units of sigma. n_H: hardness
    of the film divided by the hardness H of the substrate, at most 1. eta: hardness group. With the film's shear strength
    tau_0, q follows from the friction constant C: C/(K sqrt(R sigma)) = 2 eta (tau_0/H)^3/(q n_H)^2. Without C, q is 1.
    """
    constant = groups.film_friction_constant
    if constant is None:
        return np.ones(len(groups))
    return np.sqrt(2.0 * groups.eta * groups.shear_strength**3 / constant) / np.minimum(groups.n_H, 1.0)


def regimes(groups: Groups, law: Law) -> list[Regime]:
    """Return the regimes of a surface with a soft metal film.

    A regime is a segment of an asperity law together with the tangential force on it. Forces are in units of K R^(1/2)
    sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated contacts. law: only its tangential
    law is used, which must be a law of interface strength (interfacial=True).
    """
    laws = len(groups)
    n_H, q = np.broadcast_to(np.minimum(groups.n_H, 1.0), laws), rise(groups)
    tau = np.maximum(np.broadcast_to(groups.tau, laws), _THINNEST)
    with np.errstate(divide="ignore", over="ignore"):  # for a film without shear strength, where the substrate never takes part
        first = tau / (q * q)
        last = first / (n_H * n_H)
    first = np.where(n_H < 1.0, first, 0.0)
    last = np.where(n_H < 1.0, last, 0.0)
    stiffness = 2.0 * groups.eta * n_H * q / np.sqrt(tau)
    between = edges_at(np.sqrt(first), np.sqrt(last))
    return [
        law.join(at_pressure(groups.eta * n_H, 0.0, first), groups, body="film"),
        law.join(NormalSegment(shared, root_of, (stiffness,), between, "plastic"), groups, body="substrate"),
        law.join(at_pressure(groups.eta, last, np.inf), groups, body="substrate"),
    ]


RECORD = FilmLaw(
    key="ravindran_ramasamy_laddha_1980",
    title="Soft metal film whose friction is proportional to the cube root of thickness over load",
    grade="C",
    sources=(
        Source(
            "ravindran_ramasamy_laddha_1980",
            "abstract",
            "the power; the factor, and the pressure that leads to this power, are reconstructed",
        ),
        Source("bowden_tabor_1943", "", "friction as shear strength of the film over a pressure limited by the substrate"),
        Source("rabinowicz_1967", "abstract", "friction is higher where the film, not the substrate, carries the load"),
    ),
    regimes=regimes,
    tangential="interface",
    own_asperity=True,
    departures=(Departure("thick", "load", -0.98, 0.0),),  # for a film harder than its substrate
    verified="power laws of one asperity; independent sums over heights; limits of the film alone and of the substrate alone",
    needs=("hardness_group", "n_H", "tau", "shear_strength"),
    validity=(
        PLASTIC_FILM,
        SOFT_FILM,
    ),
    notes="For each asperity mu = (C t/W)^(1/3), limited to the range from shear strength divided by substrate hardness to "
    "shear strength divided by film hardness. C is friction_constant of the coating. If it is not given, the substrate takes "
    "part once the displacement exceeds the film thickness. The load of an asperity between the limits is counted as the "
    "substrate's.",
)
