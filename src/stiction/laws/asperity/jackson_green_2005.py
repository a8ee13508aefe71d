r"""One asperity without adhesion whose hardness falls as it is flattened: Jackson & Green 2005.

*Assumes*: an elastic, perfectly plastic hemisphere on a rigid flat; the formulas are fitted to finite elements. The mean
pressure tends to the limit $H_G$, which falls as the contact radius $a$ grows relative to $R$. There is no fully plastic
segment with the hardness $H$. *Source*: [jackson_green_2005]; constants are taken from two independent codes. With the
displacement $w_c$ and load $P_c$ at first yield:

$$
w_c=\left(\tfrac23C\eta/k\right)^2,\quad C=1.295\,e^{0.736\nu},\quad P_c=w_c^{3/2},\quad r=w/w_c;\qquad\text{Hertz to}\ r=1.9
$$

$$
A=w\left(\frac r{1.9}\right)^B,\qquad
\frac P{P_c}=e^{-\frac14r^{5/12}}r^{3/2}+\frac{4H_G}{CY}\left(1-e^{-\frac1{25}r^{5/9}}\right)r
$$

$$
B=0.14\,e^{23Y/E^*},\qquad\frac{H_G}Y=2.84\left[1-\exp\left(-0.82\,(a/R)^{-0.7}\right)\right],\quad\frac aR=\sqrt A\,\varsigma
$$

The yield stress is $Y=H/k$. In SI $\omega_c=(\pi CY/(2E^*))^2R$ and $P_c=\tfrac43(R/E^*)^2(\tfrac12C\pi Y)^3$; the source's
argument of $H_G$, $\tfrac\pi2C(Y/E^*)\sqrt{r(r/1.9)^B}$, is this $a/R$. *Jump*: at $r=1.9$ the load of blunt asperities is
multiplied by 1.0047 at $\nu=0.3$, 1.075 at $\nu=0$, 0.966 at $\nu=\tfrac12$; the area is continuous. The exponent $B$ is
fitted to metals and becomes very large if $Y/E^*$ is not small; here it is constant beyond $Y/E^*=0.1$. *Coordinate*
of integration: $u=\sqrt w$.

*Check*: $H_G/Y=2.6137$ at $a/R=0.2$ and 2.0905 at 0.5. The table is from an independent code of the later law for hardening
materials ([ghaednia_2019]), run without hardening on two equal spheres ($E=192$ GPa, $\nu=0.3$, $Y=330$ MPa, effective radius
1.4 mm). The code presses one sphere on a rigid plane, with twice the effective radius, twice the contact modulus and half the
displacement of the pair, so its $Y/E^*$ is half of the pair's:

| displacement [m] | contact radius [m] | load [N] | this law |
|---|---|---|---|
| 4.407882127871e-8 | 7.855593535195e-6 | 4.870544928015e-2 | equal (elastic) |
| 8.815764255743e-8 | 1.110948691796e-5 | 1.377598138669e-1 | equal (elastic) |
| 2.644729276723e-7 | 1.989065002445e-5 | 6.885474816181e-1 | radius equal; load within $3\cdot10^{-5}$ |

The last load agrees to $10^{-11}$ with the limiting pressure of this code, $H_G/Y=2.84-0.92(1-\cos(\pi a/R))$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $k=H/Y$ hardness divided by yield stress;
$\nu$ Poisson's ratio; $\varsigma=\sqrt{\sigma/R}$. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.asperity import hertz
from stiction.laws.segment import NormalSegment, edges_at, root_of
from stiction.laws.shared_claims import elastic_limit
from stiction.records.registry import AsperityLaw, Jump, Validity
from stiction.records.sources import Source

_MOST_STRAIN = 0.1  # largest S_y/E* in the exponent B, which is 1.4 there and would be 240 at 0.33
FITTED_TO_METALS = Validity("yield_strain", 0.0, _MOST_STRAIN, "the area of yielding asperities is fitted to metals", "effect")
ELASTIC_TO = 1.9  # omega over omega_c
# The sum over heights is split at these ratios omega/omega_c, beyond which the elastic part of the load vanishes.
_SPLITS = (1e3, 1e5)


def yield_coefficient(nu):
    """Return C = 1.295 exp(0.736 nu), the largest pressure divided by the yield stress at first yield.

    nu: Poisson's ratio, a number or an array of any shape.
    """
    return 1.295 * np.exp(0.736 * nu)


def critical_interference(eta, C, k):
    """Return the displacement at first yield in units of sigma, ((2/3) C eta/k)^2.

    It follows from omega_c = (pi C S_y/(2 E*))^2 R with the yield stress S_y = H/k and the hardness group eta = pi H
    sqrt(R/sigma)/K, K = (4/3) E*. C: largest pressure divided by the yield stress, from `yield_coefficient`. k: hardness
    divided by yield stress. The arguments may be arrays.
    """
    return (2.0 / 3.0 * C * eta / k) ** 2


def area_power(yield_strain):
    """Return the exponent of the contact area, B = 0.14 exp(23 S_y/E*).

    yield_strain: S_y/E*, yield stress divided by contact modulus, a number or an array; it is limited to 0.1, because the
    exponential is fitted to metals.
    """
    return 0.14 * np.exp(23.0 * np.minimum(yield_strain, _MOST_STRAIN))


@formula
def area_ratio(ratio, B):
    """Return the ratio of the contact area to Hertz's area pi R omega: (omega/(1.9 omega_c))^B, or 1 below 1.9 omega_c.

    ratio: displacement divided by displacement at first yield, omega/omega_c. B: exponent, from `area_power`.
    """
    return math.exp(min(B * max(math.log(ratio / ELASTIC_TO), 0.0), 600.0))


@formula
def hardness(radius):
    """Return the limiting pressure divided by the yield stress, H_G/S_y = 2.84 (1 - exp(-0.82 (a/R)^(-0.7))).

    radius: contact radius divided by asperity radius, a/R.
    """
    return -2.84 * math.expm1(-0.82 * radius**-0.7)


@formula
def load_ratio(ratio, C, H):
    """Return the ratio of the load to the load at first yield, P/P_c.

    P/P_c = exp(-ratio^(5/12)/4) ratio^(3/2) + (4 H/C) (1 - exp(-ratio^(5/9)/25)) ratio. ratio: displacement divided by
    displacement at first yield. C: largest pressure divided by the yield stress at first yield. H: limiting pressure
    divided by the yield stress, H_G/S_y.
    """
    elastic = math.exp(-0.25 * ratio ** (5.0 / 12.0)) * math.sqrt(ratio)
    return ratio * (elastic - 4.0 * H / C * math.expm1(-(ratio ** (5.0 / 9.0)) / 25.0))


@formula
def yielding(u, w_c, C, B, sharpness):
    """Return displacement w, dw/du, load and contact area of an asperity beyond 1.9 w_c, at the coordinate u = sqrt(w).

    w_c: displacement at first yield. C: largest pressure divided by the yield stress at w_c. B: exponent of the area.
    sharpness: sqrt(sigma/R); sharpness times sqrt(area) is the contact radius divided by R. The load at first yield, P_c =
    (4/3) (R/E*)^2 (C pi S_y/2)^3, is Hertz's load at w_c. Units: w in sigma, load in K R^(1/2) sigma^(3/2), area in pi R
    sigma.
    """
    w = u * u
    ratio = w / w_c
    area = w * area_ratio(ratio, B)
    H = hardness(math.sqrt(area) * sharpness)
    return w, 2.0 * u, w_c * math.sqrt(w_c) * load_ratio(ratio, C, H), area


def segments(groups: Groups) -> list[NormalSegment]:
    C, k = yield_coefficient(groups.nu), groups.hardness_to_yield
    w_c = critical_interference(groups.eta, C, k)
    B = area_power(groups.yield_strain)
    edges = edges_at(*(ratio * w_c for ratio in (ELASTIC_TO, *_SPLITS)), np.inf)
    return [
        hertz.elastic(ELASTIC_TO * w_c),
        NormalSegment(yielding, root_of, (w_c, C, B, groups.sharpness), np.sqrt(edges), "elastic-plastic"),
    ]


RECORD = AsperityLaw(
    key="jackson_green_2005",
    title="Elastic-plastic sphere whose limiting pressure falls as it is flattened",
    grade="B",
    sources=(
        Source("jackson_green_2005", "contact area, load and limiting hardness", "constants from independent codes"),
        Source("hertz_1882", "the elastic asperity"),
    ),
    segments=segments,
    traits=frozenset({"no adhesion", "Hertz", "Hertz's shape"}),
    jumps=(
        Jump(
            1,
            1.00474,
            1.0,
            "at 1.9 omega_c, for blunt asperities and nu = 0.3; 1.075 for nu = 0, 0.966 for nu = 1/2; smaller for sharp ones",
            {"theta": 1e3, "lam": 1e2, "nu": 0.3, "hardness_to_yield": 2.8, "sharpness": 0.02},
        ),
    ),
    verified="an independent code of the extension to hardening, run without hardening: contact radius, and load with the "
    "limiting pressure of that code, to 1e-11; load within 6 % and area within 10 % of kogut_etsion_2002 and "
    "brizmer_kligerman_etsion_2006 from 1.5 to 110 omega_c",
    needs=("hardness_group", "nu", "hardness_to_yield", "sharpness"),
    limits=(elastic_limit("hertz"),),
    validity=(FITTED_TO_METALS,),
    load_is_monotonic=False,
    notes="The yield stress Y is hardness over hardness_to_yield. The mean pressure does not tend to the hardness H but to "
    "H_G, which is 2.84 Y at most and falls as contact radius divided by R grows. The fit is for metals: the exponent of the "
    "area, 0.14 exp(23 Y/E*), would become very large for soft elastic materials; it is kept constant beyond Y/E* = 0.1.",
)
