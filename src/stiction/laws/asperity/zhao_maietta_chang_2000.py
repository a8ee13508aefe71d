r"""One asperity without adhesion with a smooth transition from Hertz to full plasticity: Zhao, Maietta & Chang 2000.

*Assumes*: the contact is elastic (Hertz) up to first yield, at the displacement $\omega_1$ and a mean pressure of $0.4H$. It
is fully plastic (area $2\pi R\omega$, mean pressure $H$) above $\omega_2=54\,\omega_1$. In between the area follows a cubic
step and the mean pressure a logarithm. *Source*: [zhao_maietta_chang_2000], from an independent code; 0.4 is the commonly
quoted value.

$$
w_1=(0.4\,\eta)^2,\quad w_2=54\,w_1,\quad\xi=\frac{w-w_1}{w_2-w_1}:\qquad
A=w\left(1+3\xi^2-2\xi^3\right),\quad\frac P{\eta A}=0.4+0.6\,\frac{\ln(w/w_1)}{\ln54}
$$

for $w_1<w<w_2$, and $A=2w$, $P=2\eta w$ above. In SI $\omega_1=(3\pi\cdot0.4H/(4E^*))^2R$. Load, area and the slope of the
area are continuous. The authors give 54 as a lower bound of $\omega_2/\omega_1$; as usual, it is used as the ratio itself.
*Coordinate* of integration: $u=\sqrt w$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.asperity import hertz
from stiction.laws.asperity.shared.transition import FIRST_YIELD, SPAN
from stiction.laws.segment import NormalSegment, edges_at, root_of
from stiction.laws.shared_claims import elastic_limit
from stiction.records.registry import AsperityLaw
from stiction.records.sources import Source

_LOG_SPAN = math.log(SPAN)


def first_yield(eta):
    """Return the displacement at first yield in units of sigma, (0.4 eta)^2.

    It follows from omega_1 = (3 pi k H/(4 E*))^2 R with k = 0.4 and the hardness group eta = pi H sqrt(R/sigma)/K, K = (4/3)
    E*; eta may be an array.
    """
    return (FIRST_YIELD * eta) ** 2


@formula
def elastic_plastic(u, w_1, eta):
    """Return displacement w, dw/du, load and contact area between first yield and full plasticity, at u = sqrt(w).

    With xi = (omega - omega_1)/(omega_2 - omega_1) the area is pi R omega (1 + 3 xi^2 - 2 xi^3). The mean pressure is H (1 - (1
    - k) ln(omega_2/omega)/ln(omega_2/omega_1)) with k = 0.4 and omega_2 = 54 omega_1. w = omega/sigma; w_1: w at first yield.
    eta: hardness group. Units: load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    w = u * u
    ratio = w / w_1
    done = (ratio - 1.0) / (SPAN - 1.0)
    area = w * (1.0 + done * done * (3.0 - 2.0 * done))
    pressure = FIRST_YIELD + (1.0 - FIRST_YIELD) * math.log(ratio) / _LOG_SPAN
    return w, 2.0 * u, eta * pressure * area, area


@formula
def flow(u, w_1, eta):
    """Return displacement w, dw/du, load and contact area of a fully plastic asperity, at the coordinate u = sqrt(w).

    The area is 2 w. The mean pressure is the hardness, so the load is 2 eta w. eta: hardness group. w_1 is not used. Units: w
    in sigma, load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    w = u * u
    return w, 2.0 * u, 2.0 * eta * w, 2.0 * w


def segments(groups: Groups) -> list[NormalSegment]:
    w_1 = first_yield(groups.eta)
    last = SPAN * w_1
    parameters = w_1, groups.eta
    return [
        hertz.elastic(w_1),
        NormalSegment(elastic_plastic, root_of, parameters, np.sqrt(edges_at(w_1, last)), "elastic-plastic"),
        NormalSegment(flow, root_of, parameters, np.sqrt(edges_at(last, np.inf)), "plastic"),
    ]


RECORD = AsperityLaw(
    key="zhao_maietta_chang_2000",
    title="Elastic sphere that becomes fully plastic gradually, without a jump",
    grade="B",
    sources=(
        Source(
            "zhao_maietta_chang_2000",
            "area and mean pressure between first yield and full plasticity",
            "from an independent code; the mean pressure at first yield, 0.4 H, as commonly quoted",
        ),
        Source("hertz_1882", "the elastic asperity"),
    ),
    segments=segments,
    traits=frozenset({"no adhesion", "Hertz", "Hertz's shape"}),
    verified="independent evaluation; load, area and slope of the area continuous at both ends of the transition",
    needs=("hardness_group",),
    limits=(elastic_limit("hertz"),),
    notes="The authors give 54 as a lower bound of omega_2/omega_1; as usual, it is used as the ratio itself.",
)
