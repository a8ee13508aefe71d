r"""Static friction of an elastic-plastic sphere in full stick: Brizmer, Kligerman & Etsion 2007, fitted to finite elements.

*Assumes*: full stick, without slip anywhere in the contact; sliding begins when the junction has lost its tangential stiffness
(finite elements). The law is an upper bound for clean metals. *Source*: [brizmer_kligerman_etsion_2007], the fit as commonly
quoted. The friction coefficient of one asperity under the load $P$ is

$$
\mu=0.27\coth\left[0.27\left(P/P_c\right)^{0.35}\right]
$$

with the load $P_c$ at first yield of [`brizmer_kligerman_etsion_2006`](#brizmer_kligerman_etsion_2006). *Check*:

| $P/P_c$ | 0.1 | 1 | 5 | 10 | 50 | 100 | 500 |
|---|---|---|---|---|---|---|---|
| $\mu$ | 2.2496 | 1.0242 | 0.6114 | 0.4998 | 0.3434 | 0.3086 | 0.2747 |

Plastic asperities resist too. Rough surfaces therefore have $\mu\ge0.27$ at any plasticity index, while the laws of Kogut and
Etsion and of Chang, Etsion and Bogy give almost no friction at a high plasticity index. *Unknown*: the growth of the
junction's area, which the available texts do not print.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus). Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.asperity.brizmer_kligerman_etsion_2006 import LEAST_NU, critical_values
from stiction.laws.joining import coordinates, normal_states
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.shared.zero_load import zero_load
from stiction.records.registry import TangentialLaw, Validity
from stiction.records.sources import Source

# A segment that begins under load is split for the sum over heights at these multiples of its first displacement.
_SPLITS = (8.0, 64.0, 512.0, 4096.0)


@formula
def friction_coefficient(load_ratio):
    """Return the friction coefficient of one asperity in full stick, 0.27 coth(0.27 (P/L_c)^0.35).

    load_ratio: P/L_c, the asperity's load divided by its load at first yield in full stick. The coefficient is 1.0242 at
    L_c and tends to 0.27 for heavy loads.
    """
    return 0.27 / math.tanh(0.27 * load_ratio**0.35)


@formula
def resistance(u, w, load, area, L_c):
    """Return the slip-limited and the yield-limited force of one asperity, (0, mu P); both are 0 under tension.

    At the force mu P the asperity has lost its tangential stiffness. load: P in units of K R^(1/2) sigma^(3/2), like the
    forces. L_c: load at first yield in full stick, in the same unit. u, w, area: not used.
    """
    return 0.0, load * friction_coefficient(load / L_c) if load > 0.0 else 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance:
    L_c = critical_values(groups.eta, groups.nu, groups.hardness_to_yield)[1]
    first = np.ascontiguousarray(segment.edges[:, 0])
    # T grows as P^0.65 with the load, a fractional power in any smooth coordinate. The load is zero at first touch or, for
    # an adhesive plastic junction, where its tension ends.
    begins = zero_load(segment)
    begins = first if begins is None else begins
    at_first = normal_states(segment, first)
    touches = at_first[:, 2] <= 0.0
    # If a segment begins under load, the power law begins before the segment, near first touch.
    near = [coordinates(segment, np.where(touches, -np.inf, at_first[:, 0] * factor)) for factor in _SPLITS]
    kinks = np.stack([begins, *(np.where(touches, begins, place) for place in near)], axis=1)
    return TangentialResistance(resistance, (L_c,), kinks, np.where(touches, begins, -np.inf))


RECORD = TangentialLaw(
    key="brizmer_kligerman_etsion_2007",
    title="Static friction of an elastic-plastic sphere in full stick",
    grade="C",
    sources=(
        Source("brizmer_kligerman_etsion_2007", "", "the fit as commonly quoted; the text was not available"),
        Source("brizmer_kligerman_etsion_2006", "critical load in full stick"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="full stick",
    of_half_space="it is fitted to finite elements of a homogeneous sphere, and a film changes stick and yield",
    required_traits={"no adhesion": "it neglects adhesion"},
    verified="seven loads tabulated independently; independent evaluation at 30 digits; sums over Gaussian heights",
    needs=("hardness_group", "nu", "hardness_to_yield"),
    validity=(
        Validity(
            "nu",
            LEAST_NU,
            0.5,
            f"the fit starts at {LEAST_NU}; below it, the effect of stick on load and displacement at first "
            f"yield is taken as at {LEAST_NU}",
        ),
    ),
    notes="The junction is assumed as strong as the bulk, an upper bound for clean metals. Plastic asperities resist too, so "
    "that mu stays above 0.27 at any plasticity index. The yield stress is hardness over hardness_to_yield.",
)
