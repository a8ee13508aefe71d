r"""One elastic-plastic asperity without adhesion, fitted to finite elements: Kogut & Etsion 2002.

*Assumes*: an elastic, perfectly plastic sphere on a rigid flat without friction. Power laws are fitted to finite elements.
*Source*: [kogut_etsion_2002]; constants are taken from two independent codes. Load and area are given relative to their values
at first yield, $P_c=w_c^{3/2}$ and $A_c=w_c$, with the critical interference of
[`chang_etsion_bogy_1987`](#chang_etsion_bogy_1987),

$$
w_c=\left(\tfrac23K_H\eta\right)^2,\quad K_H=0.454+0.41\nu,\quad r=w/w_c:
$$

| $r$ | $P/P_c$ | $A/A_c$ |
|---|---|---|
| 0 to 1 | $r^{3/2}$ | $r$ |
| 1 to 6 | $1.03\,r^{1.425}$ | $0.93\,r^{1.136}$ |
| 6 to 110 | $1.40\,r^{1.263}$ | $0.94\,r^{1.146}$ |
| above 110 | $(3/K_H)\,r$: mean pressure $H$ | $2r$ |

*Jumps*: load +3 % and area −7 % at $r=1$; load +1.7 % and area +2.9 % at $r=6$. At $r=110$ the load is multiplied by
$0.647/K_H$ (+8 % at $\nu=0.3$, from 530.2 to 571.9 $P_c$; +37 % at $\nu=0$, −5 % near $\nu=\tfrac12$) and the area by 1.071.
*Trap*: a public implementation divides by $R$ in $\omega_c$ where it should multiply. *Coordinate* of integration: $u=\sqrt w$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $\nu$ Poisson's ratio. Full list:
[symbols](#1-units).
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.asperity import hertz
from stiction.laws.asperity.chang_etsion_bogy_1987 import critical_interference, hardness_coefficient
from stiction.laws.segment import NormalSegment, edges_at, root_of
from stiction.laws.shared_claims import elastic_limit
from stiction.records.registry import AsperityLaw, Jump, Validity
from stiction.records.sources import Source

# Elastic-plastic segments: start and end (omega over omega_c), factor and power of the load over P_c, the same of the area
# over A_c.
POWER_LAWS = (
    (1.0, 6.0, 1.03, 1.425, 0.93, 1.136),
    (6.0, 110.0, 1.40, 1.263, 0.94, 1.146),
)
FULLY_PLASTIC = 110.0  # omega over omega_c


@formula
def power_law(u, load_factor, load_power, area_factor, area_power):
    """Return displacement w, dw/du, load and contact area of an asperity in one fitted range of displacement, at u = sqrt(w).

    The load is load_factor w^load_power, the area area_factor w^area_power. Units: w in sigma, load in K R^(1/2) sigma^(3/2),
    area in pi R sigma.
    """
    w = u * u
    return w, 2.0 * u, load_factor * w**load_power, area_factor * w**area_power


@formula
def flow(u, eta):
    """Return displacement w, dw/du, load and contact area of a fully plastic asperity, at the coordinate u = sqrt(w).

    The area is 2 w. The mean pressure is the hardness, so the load is 2 eta w. eta: hardness group. Units: w in sigma, load in
    K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    w = u * u
    return w, 2.0 * u, 2.0 * eta * w, 2.0 * w


def segments(groups: Groups) -> list[NormalSegment]:
    # P_c = (2/3) K_H H pi R omega_c is Hertz's load at omega_c: w_c^(3/2) in these units; A_c = pi R omega_c.
    w_c = critical_interference(groups.eta, hardness_coefficient(groups.nu))
    parts = [hertz.elastic(w_c)]
    for low, high, load_factor, load_power, area_factor, area_power in POWER_LAWS:
        parameters = (
            load_factor * w_c ** (1.5 - load_power),
            np.full_like(w_c, load_power),
            area_factor * w_c ** (1.0 - area_power),
            np.full_like(w_c, area_power),
        )
        edges = np.sqrt(edges_at(low * w_c, high * w_c))
        parts.append(NormalSegment(power_law, root_of, parameters, edges, "elastic-plastic"))
    edges = np.sqrt(edges_at(FULLY_PLASTIC * w_c, np.inf))
    return [*parts, NormalSegment(flow, root_of, (groups.eta,), edges, "plastic")]


RECORD = AsperityLaw(
    key="kogut_etsion_2002",
    title="Elastic-plastic sphere, power laws fitted to finite elements",
    grade="B",
    sources=(
        Source("kogut_etsion_2002", "load and contact area in four ranges of interference", "constants from independent codes"),
        Source("hertz_1882", "the elastic asperity"),
    ),
    segments=segments,
    traits=frozenset({"no adhesion", "Hertz", "Hertz's shape"}),
    jumps=(
        Jump(1, 1.03, 0.93, "at the critical interference omega_c"),
        Jump(2, 1.01679, 1.02903, "at 6 omega_c"),
        Jump(3, 1.07878, 1.07117, "at 110 omega_c; the load's factor is 0.647/K_H", {"nu": 0.3}),
    ),
    verified="constants equal those of two independent codes; load within 6 % and area within 10 % of "
    "brizmer_kligerman_etsion_2006 and jackson_green_2005 from 1.5 to 110 omega_c",
    needs=("hardness_group", "nu"),
    validity=(
        # 0.94 r^1.146 at the last interference ratio that was computed, r = 110
        Validity(
            "asperity_area_over_yield",
            0.0,
            205.0,
            "the published fit ends at 110 times the displacement at first yield, where this ratio is 205",
            "fit",
        ),
    ),
    limits=(elastic_limit("hertz"),),
    load_is_monotonic=False,
    notes="The published segments do not meet: load and area jump at 1, 6 and 110 omega_c. At 110 omega_c the load rises by "
    "37 % for nu = 0 and falls by 5 % for nu near 1/2, because the power laws depend on nu only through omega_c.",
)
