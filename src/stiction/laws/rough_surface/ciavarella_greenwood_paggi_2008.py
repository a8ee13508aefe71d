r"""Asperities that interact, all lowered by the same displacement: Ciavarella, Greenwood & Paggi 2008.

*Assumes*: the loads on Greenwood and Williamson's asperities lower all other asperities. To first order, all asperities are
lowered by the same displacement, the displacement of the nominal area under the mean pressure $p$. *Source*:
[ciavarella_greenwood_paggi_2008]; *unknown*: its text. *Reconstruction*: the nominal area is a square of side $L$ on a
half-space and is displaced by its mean displacement under uniform pressure (Love's solution, [johnson_1985]),
$0.9464\,pL/E^*$:

$$
\bar P=F_{3/2}(h^*),\quad\bar A=F_1(h^*),\quad h^*=h+c\,F_{3/2}(h^*),\quad
c=\frac4\pi\left[\ln(1+\sqrt2)-\frac{\sqrt2-1}3\right]\tfrac43\,\rho\,\varsigma\,\frac L\sigma
$$

$\bar P$ and $\bar A$ are load and area per asperity and $F_n$ the integrals of
[`greenwood_williamson_1966`](#greenwood_williamson_1966), $h$ is the separation (in units of $\sigma$), $h^*$ the separation
enlarged by the displacement, $\rho=NR\sigma$ and $\varsigma=\sqrt{\sigma/R}$. The relation of area and load is Greenwood and
Williamson's. Only the separation differs; the difference grows with the size of the surface. *Check*, $\rho=0.04$,
$\varsigma=0.03$, $L/\sigma=20\,000$: $\bar P=0.0420103$, $\bar A=0.0482781$ at $h=0$ and 0.00449705, 0.00584984 at $h=2$.
*Limit*: Greenwood and Williamson for $L\to0$.
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.shared_claims import ELASTIC
from stiction.records.registry import Limit, RoughSurface
from stiction.records.sources import Source
from stiction.surfaces.theory.start_table import lone_separation
from stiction.surfaces.theory.summits import truncated_mean

# Mean displacement of a square of side L under the uniform pressure p, over p L / E*: Love's solution, averaged.
SINKING = 4.0 / math.pi * (math.log(1.0 + math.sqrt(2.0)) - (math.sqrt(2.0) - 1.0) / 3.0)

_MOST_STEPS = 200


def shifted_separation(h: np.ndarray, compliance: np.ndarray) -> np.ndarray:
    """Return the separation x at which independent asperities carry the load that interacting asperities carry at h.

    It solves x = h + compliance F_3/2(x), with the mean load F_3/2 of independent asperities. h, x: in units of sigma.
    compliance: displacement of the nominal area, in units of sigma, per unit of load. h and compliance are arrays of the
    same shape. Newton's method starts at h and rises to the root without passing it, because the slope of x - compliance
    F_3/2(x) is positive and decreases with x.
    """
    x = h.astype(float)
    for _ in range(_MOST_STEPS):
        missing = h + compliance * truncated_mean(1.5, x) - x
        step = missing / (1.0 + 1.5 * compliance * truncated_mean(0.5, x))
        x = x + step
        if np.all(np.abs(step) <= 1e-14 * (1.0 + np.abs(x))):
            break
    return x


def curve(h: np.ndarray, groups: Groups) -> tuple[np.ndarray, np.ndarray]:
    """Return load and contact area (n, H) per asperity at H separations of n contacts.

    h: separation in units of sigma from the flat to the mean height of the undeformed asperities, (H,) or (n, H). Units: loads
    in K R^(1/2) sigma^(3/2), areas in pi R sigma.
    """
    x = shifted_separation(*np.broadcast_arrays(h, _compliance(groups)))
    return truncated_mean(1.5, x), truncated_mean(1.0, x)


def separation_near(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return separations (n, H), in units of sigma, at the loads (n, H), as starting values for a search.

    load: per asperity, in units of K R^(1/2) sigma^(3/2). The separations are those of independent asperities minus the
    displacement of the nominal area; they are NaN for loads of 0 or less.
    """
    return lone_separation(load) - _compliance(groups) * load


def _compliance(groups: Groups) -> np.ndarray:
    """Return the displacement of the nominal area, in units of sigma, per unit of load per asperity, (n, 1).

    The unit of load is K R^(1/2) sigma^(3/2). F units of load per asperity are the mean pressure p = (4/3) N R sigma
    sqrt(sigma/R) E* F, under which the nominal area A_n is displaced by SINKING (p / E*) sqrt(A_n).
    """
    return (SINKING * 4.0 / 3.0 * groups.roughness_parameter * groups.sharpness * groups.nominal_width)[:, None]


RECORD = RoughSurface(
    key="ciavarella_greenwood_paggi_2008",
    title="Greenwood & Williamson's model with interaction of the asperities through the mean pressure",
    grade="C",
    sources=(
        Source(
            "ciavarella_greenwood_paggi_2008",
            "",
            "reconstructed, the paper was not available: uniform displacement by the mean pressure, here the mean displacement "
            "0.9464 p sqrt(A_n)/E* of a uniformly loaded square",
        ),
        Source("greenwood_williamson_1966", "", "the asperities"),
        Source("johnson_1985", "chapter 3, uniform pressure on a rectangle (Love)"),
    ),
    curve=curve,
    separation_near=separation_near,
    verified="loads and areas against independent integrals; greenwood_williamson_1966 for small areas; mean displacement of a "
    "square by numerical integration",
    needs=("roughness_parameter", "sharpness", "nominal_width"),
    validity=(ELASTIC,),
    limits=(Limit("greenwood_williamson_1966", {"nominal_width": 1e-12}, ("load", "contact_area"), 1e-9),),
    notes=(
        "Heights are Gaussian. The nominal area is a square on a half-space, whose displacement grows with its side. Area "
        "against load is that of Greenwood & Williamson; only the separation differs."
    ),
)
