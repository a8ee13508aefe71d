r"""The tangential law of the 2015 paper: an adhesive elastic asperity resists until it peels or yields at its edge.

*Assumes*: an asperity slides when it peels ([`savkoor_briggs_1977`](#savkoor_briggs_1977)) or when its trailing edge yields
(Hamilton's stresses, von Mises), whichever comes first; plastic asperities have no resistance. *Source*: [soft_coating_2015],
eqs. (10) to (15); [theory, section 3](theory.md#3-one-asperity-under-tangential-load), equations (S3.1) to (S3.11).

$$
T=\min(T_\text{slip},\,T_\text{yield}),\qquad
T_\text{slip}=\frac4{\sqrt{\zeta K\beta}}\sqrt{\frac{2\pi}\theta P+\frac{3\pi^2}{\theta^2}}
$$

$T_\text{yield}$ is (S3.7). $\zeta$ is `peeling` of the contact, which weights the energy release of the tangential force; with
$\zeta=0$ only yield limits the force. If a film is solved together with its body (film law [`layered`](#layered)), the energy
balance uses the stiffness of the layered contact ([`layered_peeling`](#layered_peeling)). Yield at the trailing edge then uses
the elastic stresses there under the frictionless pressure of a sphere, with the mean pressure and area of the adhesive
contact:

$$
D\left(AP^2+2BPT+T^2\right)=(Y_f\,\pi a^2)^2
$$

In this equation $P$ and $T$ are in SI, $a$ is the contact radius, $Y_f$ the yield stress of the film; the coefficients $A$,
$B$ and $D$ are functions of $a/t$ ($t$ film thickness) and the elastic constants (`solvers/layered/edge`). It is accurate to
0.5 % in $T$ up to $a/t=300$, and to a few per cent near the point where $T$ vanishes. Earlier yield inside the film or at its
interface is not checked; [`layered_first_yield`](#layered_first_yield) does this, without adhesion. *Limit*: the law without a
film, if film and body have the same moduli, and with the film's groups for $t\to\infty$.

With the option `plastic_junctions`, yielded asperities resist according to another law, and results show by how much $\mu$ then
differs from the paper's value; the default `none` is the paper's assumption. *Reconstructed*: the seven coefficients of the
paper's yield condition, eq. (11), which it does not print (departure D12).

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of
adhesion; $\beta$ tangential compliance of the pair of bodies, $K\beta=\tfrac83(2-\nu)/(1-\nu)$ for equal bodies. [All
symbols](#1-units).
"""

import math

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.savkoor_briggs_1977 import slip_resistance, slip_resistance_printed
from stiction.laws.tangential.shared.edge_yield import keep_smaller, yield_resistance
from stiction.laws.tangential.shared.plastic_junctions import LAWS, of_whole_segment
from stiction.laws.tangential.shared.slip_or_yield import kinks_of
from stiction.laws.tangential.shared.smaller_force import Force, smaller_force
from stiction.records.registry import NO_JUNCTIONS, TangentialLaw
from stiction.records.sources import Source


@formula
def resistance(u, w, load, area, *row):
    """Return the slip-limited (peeling) and the yield-limited force of an adhesive asperity, with the larger replaced by 0.

    u, w: not used. row: elastic adhesion index theta, hardness group eta, K beta times the fraction of the tangential energy
    that peels, Poisson's ratio nu, k = H/Y. Units: load and forces in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    theta, eta, K_beta, nu, k = row
    slip_limited = slip_resistance(load, theta, K_beta)
    return keep_smaller(slip_limited, yield_resistance(load, eta * area / (math.pi * k), nu))


@formula
def resistance_printed(u, w, load, area, *row):
    """Return the two forces of `resistance` with the peeling force of eq (10) as published; replace the larger by 0.

    area: contact area in units of pi R sigma, which eq (10) uses as x. load, row: as in `resistance`. u, w: not used.
    """
    theta, eta, K_beta, nu, k = row
    slip_limited = slip_resistance_printed(area, theta, K_beta)
    return keep_smaller(slip_limited, yield_resistance(load, eta * area / (math.pi * k), nu))


def tangential_resistance(
    segment: NormalSegment, groups: Groups, plastic_junctions: str = NO_JUNCTIONS
) -> TangentialResistance | None:
    """Return the tangential resistance on a segment of a JKR asperity, or None if the segment has none.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts. On an elastic segment the
    resistance is the smaller of peeling force and force at yield of the trailing edge. On a plastic segment it follows the law
    whose key is `plastic_junctions`, if any. If the film law solves film and body as one solid, both forces use the stiffness
    and stresses of this solid.
    """
    if segment.state != "elastic":
        return of_whole_segment(plastic_junctions, segment, groups)
    if groups.n_E is not None:
        return _on_a_film(segment, groups)
    return _elastic_resistance(segment, groups, resistance, printed=False)


def _on_a_film(segment: NormalSegment, groups: Groups) -> TangentialResistance:
    # Imported here because the modules load slowly, and contacts without a layered film do not need them.
    from stiction.laws.tangential.shared.coated_edge import edge_columns, edge_root
    from stiction.laws.tangential.shared.coated_peeling import peeling_columns, peeling_force

    resolved = groups.resolved()
    own, vanishes = peeling_columns(segment, resolved)
    return smaller_force(segment, Force(peeling_force, own), Force(edge_root, edge_columns(resolved)), vanishes)


def tangential_resistance_printed(segment: NormalSegment, groups: Groups) -> TangentialResistance | None:
    return _elastic_resistance(segment, groups, resistance_printed, printed=True)


def _elastic_resistance(segment, groups, formula_of, printed: bool) -> TangentialResistance | None:
    if segment.state != "elastic":
        return None
    # In G_N + zeta G_T = gamma, zeta multiplies the tangential compliance.
    K_beta = groups.K_beta if groups.peeling is None else groups.K_beta * groups.peeling
    kinks, branch = kinks_of(groups, K_beta, segment.edges[:, -1], printed, unloading=segment.lowest < 0.0)
    return TangentialResistance(
        formula_of, (groups.theta, groups.eta, K_beta, groups.nu, groups.hardness_to_yield), kinks, branch
    )


RECORD = TangentialLaw(
    key="soft_coating_2015",
    title="Peeling or yield at the trailing edge, whichever comes first",
    grade="C",
    sources=(
        Source("soft_coating_2015", "eqs. (10)-(15)", "departure D6; C1..C7 of eq. (11) are reconstructed"),
        Source("savkoor_briggs_1977", "force of peeling"),
        Source("hamilton_1983", "stresses at the trailing edge"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="none",
    layered=True,
    required_traits={"JKR": "it computes the peeling of a JKR contact"},
    verified="friction of asperities and sums over heights, computed independently at 30 digits",
    needs=("theta", "lam", "nu", "hardness_to_yield"),
    takes=("peeling",),
    junctions=LAWS,
    notes="Plastic asperities have no resistance, so that mu tends to zero if most of them are plastic; plastic_junctions "
    "names another law for them.",
)
