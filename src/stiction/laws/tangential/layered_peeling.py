r"""Tangential force at which an adhesive contact on a film peels: Savkoor & Briggs's energy balance with the film's stiffness.

*Assumes*: the edge of an adhesive contact is a mixed-mode crack, which peels where $G_N+\zeta\,G_T=\gamma$, as in
[`savkoor_briggs_1977`](#savkoor_briggs_1977). $G_N$ and $G_T$ are the energy release rates of normal load and tangential force,
$\zeta$ is `peeling` of the contact, $\gamma$ the work of adhesion. The contact stays circular. *Source*: [savkoor_briggs_1977]
for the balance; [mindlin_1949] for the tangential stiffness of a half-space, $S_T=8a/\beta$, which is replaced by the computed
stiffness of the layered contact (`solvers/layered/shear`). With the normal stiffness $S$, the tangential stiffness $S_T$, their
derivatives $S'$ and $S_T'$ with respect to the contact radius $a$, and the load $P_H$ that a contact without adhesion needs for
the same radius,

$$
G_N=\frac{(P_H-P)^2}{4\pi a}\frac{S'}{S^2},\qquad G_T=\frac{T^2}{4\pi a}\frac{S_T'}{S_T^2}=\frac{\beta T^2}{32\pi a^3}(1-e),
\qquad e=\frac{d\ln\beta}{d\ln a}
$$

and $T$ is the largest force for which a radius satisfies the balance at constant load. $\beta$ changes from the film's value
for small contacts to the bodies' value for large ones; these limits are `film_K_beta` and `K_beta`. The force as a function of
the displacement of an asperity is stored as a spline, which was accurate to 0.1 % where compared.

*Limit*: [`savkoor_briggs_1977`](#savkoor_briggs_1977) without a film, for a film of the same material as its body, and with
the film's groups for a film thickness $t\to\infty$; the groups of the bodies for $t\to0$. *Check*: $K\beta$ for a rigid
sphere, $\nu=0.3$ and the ratio $E_f/E_s$ of Young's moduli of film and substrate (6.4762 without a film)

| $E_f/E_s$ | $a/t=0.1$ | 0.5 | 1 | 2 | 5 | 20 |
|---|---|---|---|---|---|---|
| 0.1 | 62.26 | 53.11 | 44.64 | 34.23 | 21.60 | 11.27 |
| 10 | 0.717 | 0.980 | 1.253 | 1.666 | 2.470 | 4.024 |

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of
adhesion; $\beta$ tangential compliance of the pair of bodies, $K\beta=\tfrac83(2-\nu)/(1-\nu)$ for equal bodies. [All
symbols](#1-units).
"""

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.savkoor_briggs_1977 import mode_mixity_share
from stiction.laws.tangential.savkoor_briggs_1977 import tangential_resistance as of_a_half_space
from stiction.laws.tangential.shared.coated_peeling import peeling_columns, peeling_force
from stiction.records.registry import Limit, TangentialLaw
from stiction.records.sources import Source


@formula
def resistance(u, w, load, area, *row):
    return peeling_force(u, load, area, row), 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance | None:
    """Return the tangential force at which a JKR asperity peels along an elastic segment, or None for other segments.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts; without a film the law
    `savkoor_briggs_1977` applies. Plastic asperities have no resistance, because the energy balance does not apply to them.
    Raises InputError if `peeling` is 0.
    """
    if groups.n_E is None:
        return of_a_half_space(segment, groups)
    if segment.state != "elastic":
        return None
    resolved = groups.resolved()
    mode_mixity_share(resolved)  # raises InputError for zeta = 0
    own, vanishes = peeling_columns(segment, resolved)
    return TangentialResistance(resistance, own, vanishes)


RECORD = TangentialLaw(
    key="layered_peeling",
    title="Peeling of an adhesive contact on a film by shear",
    grade="B",
    sources=(
        Source("savkoor_briggs_1977", "", "energy balance, with the stiffness of the layered contact"),
        Source("mindlin_1949", "", "the tangential stiffness of a half-space, the limit of thick and thin films"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="none",
    layered=True,
    required_traits={"JKR": "it computes the peeling of a JKR contact"},
    verified="tangential stiffness by another method; largest force by a search over radii; limits in closed form",
    needs=("theta", "K_beta"),
    takes=("peeling",),
    accuracy=1e-4,
    limits=(Limit("savkoor_briggs_1977", {}, ("friction_force",), 1e-9),),
    notes="The force of peeling only; yield does not limit it. `peeling` is zeta in G_N + zeta G_T = gamma. Asperities that "
    "have yielded have no resistance. With a film law that treats film and body as two half-spaces, each has the force of "
    "savkoor_briggs_1977.",
)
