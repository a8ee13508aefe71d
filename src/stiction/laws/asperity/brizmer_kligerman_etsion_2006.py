r"""One asperity without adhesion in full stick with its counterface: Brizmer, Kligerman & Etsion 2006.

*Assumes*: an elastic, perfectly plastic sphere on a rigid flat in full stick, without slip anywhere in the contact. The
formulas are fitted to finite elements. *Source*: [brizmer_kligerman_etsion_2006]; critical values and load are taken from an
independent code. The displacement $w_c$ and load $P_c$ at first yield in stick equal the values for a frictionless Hertz
contact (slip), multiplied by ratios that depend on Poisson's ratio. In slip $w_s=(\tfrac23C_\nu\eta/k)^2$ with
$C_\nu=1.234+1.256\nu$, the largest pressure divided by the yield stress; in stick

$$
w_c=\left[6.82\nu-7.83\,(\nu^2+0.0586)\right]w_s,\qquad P_c=\left[8.88\nu-10.13\,(\nu^2+0.089)\right]w_s^{3/2}
$$

$$
\frac P{P_c}=r^{3/2}\left\{1-\exp\left[\frac1{1-r^\beta}\right]\right\},\qquad
A=w\left\{1+\exp\left[\frac1{1-r^\alpha}\right]\right\},\qquad r=\frac w{w_c}>1
$$

with $\beta=0.174+0.08\nu$ and $\alpha=0.25+0.125\nu$. Up to first yield ($r\le1$), $P=P_cr^{3/2}$ and $A=w$. The ratios in
square brackets are 0.8825 (displacement) and 0.8507 (load) at $\nu=0.3$, 0.994 and 1.006 at $\nu=\tfrac12$. They are fitted
for $\nu\ge0.2$ and kept constant below. In SI $\omega_s=(\pi C_\nu(1-\nu^2)Y/(2E))^2R$; here $E/(1-\nu^2)$ is $E^*$ of any
pair and $Y=H/k$.

Load and area are continuous at first yield. *Limit* without yield: Hertz's area, and Hertz's load times 1.026 at $\nu=0.3$
(1.043 at most), because stick makes the contact stiffer. *Unknown*: the exponent $\alpha$ of the area is from memory, and the
critical area is assumed to be $\pi R\omega_c$. The only check of both is the agreement with the [other elastic-plastic
laws](#the-elastic-plastic-laws-side-by-side). *Trap*: a public implementation has $6.82-7.83(\ldots)$, without the $\nu$.
*Coordinate* of integration: $u=\sqrt w$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $k=H/Y$ hardness divided by yield stress;
$\nu$ Poisson's ratio. [All symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, edges_at, root_of
from stiction.records.registry import AsperityLaw, Limit, Validity
from stiction.records.sources import Source

# Smallest Poisson's ratio of both fits below. Under it they have no meaning; the load ratio is negative below 0.117.
LEAST_NU = 0.2
# The sum over heights is split at this multiple of the displacement at first yield, because the law departs from Hertz's like
# exp(-1/x) there.
_SPLITS = (4.0,)


def yield_coefficient(nu):
    """Return C_nu = 1.234 + 1.256 nu, the ratio of the largest pressure to the yield stress at first frictionless yield.

    nu: Poisson's ratio, a number or an array of any shape.
    """
    return 1.234 + 1.256 * nu


def stick_load_ratio(nu):
    """Return the ratio of the loads at first yield in full stick and in frictionless slip.

    The ratio is 8.88 nu - 10.13 (nu^2 + 0.089); below nu = 0.2 it keeps its value at 0.2. nu: Poisson's ratio, a number or an
    array of any shape.
    """
    nu = np.maximum(nu, LEAST_NU)
    return 8.88 * nu - 10.13 * (nu * nu + 0.089)


def stick_displacement_ratio(nu):
    """Return the ratio of the displacements at first yield in full stick and in frictionless slip.

    The ratio is 6.82 nu - 7.83 (nu^2 + 0.0586); below nu = 0.2 it keeps its value at 0.2. nu: Poisson's ratio, a number or an
    array of any shape.
    """
    nu = np.maximum(nu, LEAST_NU)
    return 6.82 * nu - 7.83 * (nu * nu + 0.0586)


def critical_values(eta, nu, k):
    """Return displacement and load at first yield in full stick, in units of sigma and of K R^(1/2) sigma^(3/2).

    eta: hardness group pi H sqrt(R/sigma)/K with K = (4/3) E*. nu: Poisson's ratio. k: hardness divided by yield stress,
    H/Y. The arguments may be arrays. Both results are the values in frictionless slip, times the ratios for stick. In slip,
    the displacement is (pi C_nu (1 - nu^2) Y/(2 E))^2 R, from Hertz's largest pressure C_nu Y; with E/(1 - nu^2) = E* and Y
    = H/k this is ((2/3) C_nu eta/k)^2 in units of sigma.
    """
    in_slip = (2.0 / 3.0 * yield_coefficient(nu) * eta / k) ** 2
    return stick_displacement_ratio(nu) * in_slip, stick_load_ratio(nu) * in_slip**1.5


@formula
def elastic(u, stiffness):
    """Return displacement w, dw/du, load and contact area of the elastic asperity in full stick, at the coordinate u = sqrt(w).

    The load is stiffness w^(3/2), the area w. stiffness: ratio of the load to Hertz's load at the same displacement. Units: w
    in sigma, load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    w = u * u
    return w, 2.0 * u, stiffness * w * u, w


_LEAST = 1e-300  # lower bound of ln(w/w_c), so that its inverse stays finite


@formula
def yielding(u, w_c, stiffness, load_power, area_power):
    """Return displacement w, dw/du, load and contact area of an asperity in full stick beyond first yield, at u = sqrt(w).

    With r = w/w_c the load is stiffness w^1.5 (1 - exp(1/(1 - r^beta))), the area w (1 + exp(1/(1 - r^alpha))). w_c:
    displacement at first yield. stiffness: ratio of the elastic load to Hertz's load. load_power, area_power: beta and alpha.
    Units: w in sigma, load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    w = u * u
    growth = max(math.log(w / w_c), _LEAST)  # rounding may put the first point a little below w_c
    load = -math.expm1(-1.0 / math.expm1(load_power * growth))
    area = 1.0 + math.exp(-1.0 / math.expm1(area_power * growth))
    return w, 2.0 * u, stiffness * w * u * load, w * area


def segments(groups: Groups) -> list[NormalSegment]:
    nu = groups.nu
    w_c, L_c = critical_values(groups.eta, nu, groups.hardness_to_yield)
    stiffness = L_c / w_c**1.5
    beta, alpha = 0.174 + 0.08 * nu, 0.25 + 0.125 * nu
    start = np.sqrt(edges_at(0.0, w_c))
    edges = edges_at(w_c, *(ratio * w_c for ratio in _SPLITS), np.inf)
    return [
        NormalSegment(elastic, root_of, (stiffness,), start, "elastic"),
        NormalSegment(yielding, root_of, (w_c, stiffness, beta, alpha), np.sqrt(edges), "elastic-plastic"),
    ]


RECORD = AsperityLaw(
    key="brizmer_kligerman_etsion_2006",
    title="Elastic-plastic sphere in full stick",
    grade="C",
    sources=(
        Source("brizmer_kligerman_etsion_2006", "critical values in slip and in full stick, load", "from an independent code"),
        Source(
            "brizmer_kligerman_etsion_2006",
            "contact area",
            "reconstructed: the exponent 0.25 + 0.125 nu is from memory and could not be checked; the critical area is "
            "assumed to be pi R delta_c",
        ),
    ),
    segments=segments,
    traits=frozenset({"no adhesion"}),
    verified="load within 6 % and area within 10 % of kogut_etsion_2002 and jackson_green_2005 from 1.5 to 110 critical "
    "interferences, the only check of the area's exponent; load and area continuous at first yield",
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
    limits=(
        Limit("hertz", {"theta": 1.0, "lam": 1e24}, ("contact_area",), 1e-9),
        Limit("hertz", {"theta": 1.0, "lam": 1e24}, ("load",), 0.045),
    ),
    notes="Before yield, stick raises the load above Hertz's at the same displacement: by 2.6 % for nu = 0.3, by 4.3 % at "
    "most. The yield stress is hardness over hardness_to_yield.",
)
