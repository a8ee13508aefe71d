r"""One asperity without adhesion, elastic up to first yield, then plastic with constant volume: Chang, Etsion & Bogy 1987.

*Assumes*: the asperity is elastic (Hertz) up to first yield at the displacement $w_c$, where its largest pressure is $K_HH$.
Beyond $w_c$ it is a truncated sphere of constant volume under the uniform pressure $K_HH$. *Source*: [chang_etsion_bogy_1987].

$$
w_c=\left(\tfrac23K_H\eta\right)^2,\quad K_H=0.454+0.41\nu;\qquad P=w^{3/2},\ A=w\ (w<w_c);\qquad
A=2w-w_c,\ P=\eta K_HA\ (w\ge w_c)
$$

In SI $\omega_c=(\pi K_HH/(2E^*))^2R$, $A=\pi R\omega(2-\omega_c/\omega)$. The 1987 paper uses the constant $K_H=0.6$; the
authors gave the form with $\nu$ in 1988. *Jump*: at $\omega_c$ the mean pressure rises from $\tfrac23K_HH$ to $K_HH$. The
load is multiplied by 1.5; the area is continuous. *Limit*: `hertz` for $\lambda\to\infty$ (no yield).

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $\nu$ Poisson's ratio; $\lambda$ plastic
adhesion index. [All symbols](#1-units).
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.asperity import hertz
from stiction.laws.segment import NormalSegment, displaced, edges_at
from stiction.laws.shared_claims import NEAR_YIELD, elastic_limit
from stiction.records.registry import AsperityLaw, Jump
from stiction.records.sources import Source


def hardness_coefficient(nu):
    """Return K_H = 0.454 + 0.41 nu, the largest pressure at first yield divided by the hardness.

    nu: Poisson's ratio, a number or an array of any shape. The authors gave this form in 1988; their 1987 paper has the
    constant 0.6.
    """
    return 0.454 + 0.41 * nu


def critical_interference(eta, K_H):
    """Return the displacement at first yield in units of sigma, ((2/3) K_H eta)^2.

    It follows from omega_c = (pi K_H H / (2 E*))^2 R, with the hardness group eta = pi H sqrt(R/sigma)/K and K = (4/3) E*.
    K_H: largest pressure at first yield divided by the hardness. The arguments may be arrays.
    """
    return (2.0 / 3.0 * K_H * eta) ** 2


@formula
def plastic(w, w_c, eta, K_H):
    """Return displacement w, dw/du = 1, load and contact area of an asperity beyond first yield; the coordinate u is w.

    The area is 2 w - w_c. The mean pressure is K_H H, so the load is eta K_H times the area. w_c: displacement at first yield.
    eta: hardness group. K_H: largest pressure at first yield divided by the hardness. Units: w in sigma, load in K R^(1/2)
    sigma^(3/2), area in pi R sigma.
    """
    area = 2.0 * w - w_c
    return w, 1.0, K_H * eta * area, area


def segments(groups: Groups) -> list[NormalSegment]:
    eta, K_H = groups.eta, hardness_coefficient(groups.nu)
    w_c = critical_interference(eta, K_H)
    flow = edges_at(w_c, np.inf)
    return [hertz.elastic(w_c), NormalSegment(plastic, displaced, (w_c, eta, K_H), flow, "plastic")]


RECORD = AsperityLaw(
    key="chang_etsion_bogy_1987",
    title="Elastic sphere up to first yield, then constant volume under uniform pressure",
    grade="B",
    sources=(Source("chang_etsion_bogy_1987", "critical interference, plastic load and area"),),
    segments=segments,
    traits=frozenset({"no adhesion", "Hertz", "Hertz's shape"}),
    jumps=(Jump(1, 1.5, 1.0, "at the critical interference"),),
    verified="loads, areas and their sums over heights, computed independently at 30 digits",
    needs=("hardness_group", "nu"),
    validity=(NEAR_YIELD,),
    limits=(elastic_limit("hertz"),),
    load_is_monotonic=False,
    notes="At first yield the mean pressure jumps from (2/3) K_H H to K_H H, with K_H = 0.454 + 0.41 nu.",
)
