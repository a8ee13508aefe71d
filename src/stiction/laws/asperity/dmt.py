r"""One elastic asperity with adhesion that acts around the contact: Derjaguin, Muller & Toporov 1975.

*Assumes*: adhesion acts around the contact and does not change its Hertzian shape. *Source*: [derjaguin_muller_toporov_1975],
in the form given by [maugis_1992]: the load is Hertz's minus the constant $2\pi\gamma R$.

$$
P=w^{3/2}-\frac{2\pi}\theta,\qquad A=w\qquad(w\ge0)
$$

The law is valid for Tabor parameters below about 0.1. Asperities that do not touch are not attracted. *Limit*: `hertz` without
adhesion ($\theta\to\infty$).

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of adhesion. Full list:
[symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, root_of
from stiction.laws.shared_claims import ELASTIC
from stiction.records.registry import AsperityLaw, Limit, Validity
from stiction.records.sources import Source


@formula
def normal(u, theta):
    """Return displacement w, dw/du, load and contact area of a DMT asperity at the coordinate u = sqrt(w).

    The load is w^(3/2) - 2 pi/theta, the area is w. theta: elastic adhesion index. Units: w in sigma, load in K R^(1/2)
    sigma^(3/2) with K = (4/3) E*, area in pi R sigma.
    """
    w = u * u
    return w, 2.0 * u, w * u - 2.0 * math.pi / theta, w


def segments(groups: Groups) -> list[NormalSegment]:
    edges = np.tile([0.0, np.inf], (len(groups), 1))
    return [NormalSegment(normal, root_of, (groups.theta,), edges, "elastic")]


RECORD = AsperityLaw(
    key="dmt",
    title="Elastic sphere, adhesion around the contact",
    grade="B",
    sources=(Source("derjaguin_muller_toporov_1975", "", "Hertz's load minus 2 pi gamma R, in the form of Maugis 1992"),),
    segments=segments,
    traits=frozenset({"Hertz's shape"}),
    verified="loads, areas and their sums over heights, computed independently at 30 digits; equal to Hertz without adhesion",
    needs=("theta",),
    validity=(
        Validity("tabor_parameter", 0.0, 0.1, "the law describes the adhesion of stiff, small asperities only"),
        ELASTIC,
    ),
    limits=(Limit("hertz", {"theta": 1e14}, ("load", "contact_area"), 1e-9),),
)
