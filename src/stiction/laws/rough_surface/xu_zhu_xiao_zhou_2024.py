r"""Persson's diffusion for elastic contact with a corrected variance: Xu, Zhu, Xiao & Zhou 2024.

*Assumes*: as [`yang_persson_2008`](#yang_persson_2008), but the correction factor, here $\gamma+(1-\gamma)A/A_n$, multiplies
the variance $V$ of the pressure itself instead of its growth with finer roughness. *Source*: [xu_zhu_xiao_zhou_2024], the
program published with it (only the abstract of the text was available). With the nominal pressure $p$, the contact modulus
$E^*$ and the root mean square gradient $h'$:

$$
\frac A{A_n}=\operatorname{erf}\frac p{\sqrt{2V}},\qquad
V=\left[\gamma+(1-\gamma)\frac A{A_n}\right]\frac{(E^*h')^2}4,\qquad\gamma=0.45
$$

This is an equation for $A$ with one root; $\gamma$ is a constant. *Limit*: $A/A_n=\kappa\,p/(E^*h')$ with
$\kappa\to\sqrt{8/(\pi\gamma)}=2.3788$ at light load, full contact at high load. *Unknown*: which $\gamma$ the text recommends.
The figures use 0.45; the default of the program is 0.42. *Check*:

| $p/(E^*h')$ | 0.01 | 0.05 | 0.1 | 0.2 | 0.5 | 1 |
|---|---|---|---|---|---|---|
| $A/A_n$ | 0.02345 | 0.11123 | 0.20975 | 0.37808 | 0.72264 | 0.95704 |

The simulations published with that program (17 pressures, $p/(E^*h')$ from 0.0004 to 1.8, Hurst exponent 0.8) agree with this
formula within -3 to +5 %. The theory does not compute the separation.
"""

import math

import numpy as np
from scipy.special import erf

from stiction.contact.indices import Groups
from stiction.laws.rough_surface.shared.corrected_diffusion import GRADIENT, area_per_asperity
from stiction.laws.shared_claims import ELASTIC_CONTACT
from stiction.records.registry import RoughSurface
from stiction.records.sources import Source

GAMMA = 0.45
_STEPS = 12


def area_share(pressure: np.ndarray) -> np.ndarray:
    """Return the ratio of contact area to nominal area at the reduced pressures p / (E* h') >= 0.

    pressure: array of any shape; p: nominal pressure, E*: contact modulus, h': root mean square gradient. With q = p / sqrt(2
    V) and the variance V of the pressure, the area is erf(q), where q^2 [gamma + (1 - gamma) erf(q)] = 2 p^2 and p is in units
    of E* h'. Newton's method solves this in ln q, in which the logarithm of the left side has a slope from 2 to 3. Source: Xu
    et al. 2024, the published program.
    """
    x = np.clip(pressure, 1e-150, 1e150)
    wanted = 2.0 * np.log(math.sqrt(2.0) * x)
    log_q = wanted / 2.0
    for _ in range(_STEPS):
        q = np.exp(log_q)
        share = erf(q)
        factor = GAMMA + (1.0 - GAMMA) * share
        steepness = (1.0 - GAMMA) * 2.0 / math.sqrt(math.pi) * q * np.exp(-q * q) / factor
        log_q = log_q - (2.0 * log_q + np.log(factor) - wanted) / (2.0 + steepness)
    return np.where(pressure > 0.0, erf(np.exp(log_q)), 0.0)


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the contact area per asperity (n, H), in units of pi R sigma, at H loads of n contacts; it is 0 under tension.

    load: per asperity, in units of K R^(1/2) sigma^(3/2).
    """
    return area_per_asperity(load, groups, area_share)


RECORD = RoughSurface(
    key="xu_zhu_xiao_zhou_2024",
    title="Contact of randomly rough surfaces by diffusion of the pressure with a corrected variance, elastic",
    grade="B",
    sources=(
        Source("xu_zhu_xiao_zhou_2024", "", "the published program, gamma = 0.45 as in its figures; abstract of the text"),
        Source("persson_2001", "", "the diffusion"),
        Source("nayak_1971", "", "gradient of the surface from sigma, R and N"),
    ),
    area_at_load=area_at_load,
    takes_surface_moments=True,
    up_to_full_contact=True,
    verified="the equation solved by bisection at 30 digits; its limits at light load and full contact",
    needs=("roughness_parameter",),
    validity=(ELASTIC_CONTACT,),
    notes=f"gamma = {GAMMA}. {GRADIENT}",
)
