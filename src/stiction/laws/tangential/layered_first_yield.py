r"""Tangential force at which a coated asperity first yields anywhere: film, interface or body; von Mises.

*Assumes*: a sphere on a bonded film fails when film or body first yields anywhere (von Mises). The pressure is the pressure of
a frictionless contact, and the shear traction is proportional to it, as in [`hamilton_1983`](#hamilton_1983). *Source*:
[osullivan_king_1988] computed such stresses, below a sphere dragged over a layer, by least squares. Here they are solved for
each wave of a Fourier transform (`solvers/layered`). The mean pressure $s$ and the mean traction $q$ cause the largest von
Mises stress $N_f$ in the film and $N_s$ in the body. The asperity with the contact radius $a$ yields at

$$
N_f(s,q)=Y_f\quad\text{or}\quad N_s(s,q)=Y_s,\qquad T=q\,\pi a^2,\qquad Y_f=n_HY_s,\quad Y_s=H/k
$$

whichever comes first. The yield stresses are $Y_f$ of the film and $Y_s$ of the body, with the hardness $H$ of the body. $N$
is a norm in $(s,q)$ that depends on $a/t$ ($t$ film thickness) and the elastic constants. It is tabulated once for each pair
of materials, for 61 ratios $q/s$ and 27 radii. It is accurate to 0.2 % on average and to 3 % at worst, where the position of
first yield changes. The maximum over all directions around the axis is exact; the most stressed point may lie outside the
plane of symmetry.

*Results for films*: a soft film yields in the middle of the sheared surface. A stiff film is bent by the load. It yields at
its interface below the axis ($a\approx t$) or, for wider contacts, where it is stretched over the body like a membrane. There
it yields under a small load.

*Limit*: [`hamilton_1983`](#hamilton_1983) without a film, for a film of the same material as its body, and with the film's
groups for $t\to\infty$. A very thin film is stretched with its body and yields accordingly. *Check*, for $\nu=0.3$, $Y_f=Y_s$
and a rigid sphere: mean pressure divided by the yield stress at first yield (on a half-space 1.075 for $q=0$ and 0.697 for
$q=s/2$), and the position of first yield (f film, i interface, b body),

| $E_f/E_s$ | | $a/t=0.5$ | 1 | 2 | 5 |
|---|---|---|---|---|---|
| 0.1 | $q=0$ | 1.005 f | 0.921 f | 0.911 f | 0.931 b |
| 2 | | 1.126 f | 1.132 i | 0.879 i | 1.136 b |
| 10 | | 1.313 f | 0.607 i | 0.416 i | 0.588 f |
| 0.1 | $q=s/2$ | 0.689 f | 0.656 f | 0.573 f | 0.538 f |
| 2 | | 0.704 f | 0.684 f | 0.619 f | 0.536 f |
| 10 | | 0.732 f | 0.601 i | 0.416 i | 0.321 f |

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $n_H$ hardness of the film divided by the substrate's; $k=H/Y$ hardness divided by
yield stress. Full list: [symbols](#1-units).
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.hamilton_1983 import tangential_resistance as of_a_half_space
from stiction.laws.tangential.shared.coated_strength import strength_at, strengths
from stiction.records.registry import Limit, TangentialLaw
from stiction.records.sources import Source


@formula
def resistance(u, w, load, area, *row):
    """Return the slip-limited and the yield-limited force of a coated asperity, (0, q A).

    The first force is 0 because this law has no slip limit. Both are 0 if the load alone causes yield. q: mean traction at
    first yield of film or body. u: coordinate. area: contact area A in units of pi R sigma. w, load: not used. row: eta/k, the
    yield stress of the body in units of load divided by area; the coordinate at which the load alone causes yield; the
    parameters of `strength_at`.
    """
    if u >= row[1]:
        return 0.0, 0.0
    return 0.0, row[0] * area * strength_at(u, row[2], row[3], row[4:]) ** 0.5


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance | None:
    """Return the tangential force at first yield along an elastic segment; None (no resistance) for yielded asperities.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts. Without a film the law
    `hamilton_1983` applies.
    """
    if groups.n_E is None:
        return of_a_half_space(segment, groups)
    if segment.state != "elastic":
        return None
    curve, bends = strengths(segment, groups.resolved())
    end = np.ascontiguousarray(curve[0])[:, None]
    scale = np.broadcast_to(groups.eta / groups.hardness_to_yield, len(groups))
    return TangentialResistance(resistance, (scale, *curve), np.concatenate([bends, end], axis=1), branch=end)


RECORD = TangentialLaw(
    key="layered_first_yield",
    title="First yield anywhere in a pressed and sheared sphere on a film",
    grade="B",
    sources=(
        Source("osullivan_king_1988", "", "stresses in a sheared layer; derived and solved again here"),
        Source("hamilton_1983", "stresses under the normal and the tangential load", "the limit without a film"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="none",
    layered=True,
    verified="stresses: Hamilton's for equal materials, plane waves, equilibrium; first yield by a finer spatial search",
    needs=("hardness_group", "nu", "hardness_to_yield"),
    accuracy=1e-3,
    limits=(Limit("hamilton_1983", {}, ("friction_force",), 1e-9),),
    required_traits={
        "Hertz": "it uses the pressure of a Hertz contact",
        "no adhesion": "it neglects adhesion",
    },
    notes="The force is the largest one without yield anywhere in film or body. With a film law that treats film and body as "
    "two half-spaces, each has the force of hamilton_1983. The counterbody is assumed not to yield.",
)
