r"""One asperity without adhesion in full stick with its counterface: Brizmer, Kligerman & Etsion 2006.

*Assumes*: an elastic, perfectly plastic sphere on a rigid flat in full stick, without slip anywhere in the contact. The
formulas are fitted to finite elements. *Source*: [brizmer_kligerman_etsion_2006]; critical values and load are taken from an
independent code. The critical displacement $w_c$ and load $P_c$, at first yield in stick, are those of a frictionless Hertz
contact (slip) times ratios that depend on Poisson's ratio. In slip $w_s=(\tfrac23C_\nu\eta/k)^2$ with
$C_\nu=1.234+1.256\nu$, the largest pressure over the yield stress; in stick

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
critical area is assumed to be
$\pi R\omega_c$. The only check of both is the agreement with the [other elastic-plastic
laws](#the-elastic-plastic-laws-side-by-side). *Trap*: a public implementation has $6.82-7.83(\ldots)$, without the $\nu$.
*Coordinate*: $u=\sqrt w$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ over $KR^{1/2}\sigma^{3/2}$ and contact area $A$ over $\pi R\sigma$ of one
asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$ ($E^*$ contact modulus);
$\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $k=H/Y$ hardness over yield stress; $\nu$ Poisson's ratio. [All
symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, edges_at, root_of
from stiction.records.registry import AsperityLaw, Limit, Validity
from stiction.records.sources import Source

# The ratios below were fitted for nu from here to 1/2; they have no meaning below (and no positive value below 0.117).
LEAST_NU = 0.2
# Where the sum is split, over the critical interference: the law leaves Hertz's as exp(-1/x) leaves zero.
_SPLITS = (4.0,)


def yield_coefficient(nu):
    """Return C_nu = 1.234 + 1.256 nu for Poisson's ratio nu (any shape).

    C_nu is the largest pressure over the yield stress at first yield of a frictionless contact.
    """
    return 1.234 + 1.256 * nu


def load_of_stick(nu):
    """Return the ratio of two critical loads (at first yield), full stick over frictionless slip; nu: Poisson's ratio.

    The ratio is 8.88 nu - 10.13 (nu^2 + 0.089), constant below nu = 0.2. Any shape.
    """
    nu = np.maximum(nu, LEAST_NU)
    return 8.88 * nu - 10.13 * (nu * nu + 0.089)


def interference_of_stick(nu):
    """Return the ratio of two critical interferences (at first yield), full stick over slip; nu: Poisson's ratio.

    The ratio is 6.82 nu - 7.83 (nu^2 + 0.0586), constant below nu = 0.2. Any shape.
    """
    nu = np.maximum(nu, LEAST_NU)
    return 6.82 * nu - 7.83 * (nu * nu + 0.0586)


def critical_values(eta, nu, k):
    """Return the interference delta_c and the load L_c at first yield in full stick (any shape).

    In slip, delta_c = (pi C_nu (1 - nu^2) Y/(2 E))^2 R, which follows from Hertz's largest pressure C_nu Y. Here E/(1 - nu^2)
    is the contact modulus E* of the pair and Y = H/k; over sigma this is ((2/3) C_nu eta/k)^2. Both slip values are multiplied
    by the ratios for stick.
    """
    slip_limited = (2.0 / 3.0 * yield_coefficient(nu) * eta / k) ** 2
    return interference_of_stick(nu) * slip_limited, load_of_stick(nu) * slip_limited**1.5


@formula
def elastic(u, stiffness):
    """Return displacement w = u^2, dw/du, load and area of the elastic asperity.

    The load is L_c (delta/delta_c)^(3/2), the area pi R delta. stiffness: L_c/delta_c^(3/2) in units of Hertz's value.
    """
    w = u * u
    return w, 2.0 * u, stiffness * w * u, w


_LEAST = 1e-300  # of ln(delta/delta_c): its inverse is still a number


@formula
def yielding(u, w_c, stiffness, load_power, area_power):
    """Return displacement w = u^2, dw/du, load and area of an asperity in full stick beyond first yield.

    With r = delta/delta_c: P/L_c = r^1.5 (1 - exp(1/(1 - r^beta))) and A/A_c = r (1 + exp(1/(1 - r^alpha))).
    """
    w = u * u
    growth = max(math.log(w / w_c), _LEAST)  # rounding may put the first point a little before delta_c
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
        Validity("nu", LEAST_NU, 0.5, f"the law is fitted for nu >= {LEAST_NU}; below, its stick/slip ratios are constant"),
    ),
    limits=(
        Limit("hertz", {"theta": 1.0, "lam": 1e24}, ("contact_area",), 1e-9),
        Limit("hertz", {"theta": 1.0, "lam": 1e24}, ("load",), 0.045),
    ),
    notes="Before yield, stick raises the load above Hertz's at the same displacement: by 2.6 % for nu = 0.3, by 4.3 % at "
    "most. The yield stress is hardness over hardness_to_yield.",
)
