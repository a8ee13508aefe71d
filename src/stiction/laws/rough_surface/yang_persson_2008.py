r"""Persson's diffusion for elastic contact, slowed in partial contact: Yang & Persson 2008.

*Assumes*: as [`persson_2001`](#persson_2001); but in partial contact, finer roughness adds less to the variance $V$ of the
pressure than in full contact, by a factor fitted to numerical solutions. *Source*: [yang_persson_2008], as the program
published with [xu_zhu_xiao_zhou_2024] restates it (the text was not available). With the variance $V_c$ in full contact, which
is $(E^*h')^2/4$ for the whole surface, the contact modulus $E^*$, the root mean square gradient $h'$ and the nominal pressure
$p$:

$$
\frac{dV}{dV_c}=\gamma+(1-\gamma)\left(\frac A{A_n}\right)^2,\qquad
\frac A{A_n}=\operatorname{erf}\frac p{\sqrt{2V}},\qquad\gamma=0.45
$$

In print the factor is inside an integral over the scales of the spectrum. Because it depends only on $A$, $V_c$ can replace the
scale, so only $h'$ of the spectrum is needed. *Limit*: $A/A_n=\kappa\,p/(E^*h')$ with $\kappa\to\sqrt{8/(\pi\gamma)}=2.3788$ at
light load, full contact at high load. *Unknown*: the constant $\gamma$ is quoted between 0.4 and 0.5. The value 0.45 is used,
as in the figures of the program, whose own default is 0.42. *Check*:

| $p/(E^*h')$ | 0.01 | 0.05 | 0.1 | 0.2 | 0.5 | 1 |
|---|---|---|---|---|---|---|
| $A/A_n$ | 0.02373 | 0.11488 | 0.21687 | 0.38493 | 0.71787 | 0.95582 |

The simulations published with that program (17 pressures, $p/(E^*h')$ from 0.0004 to 1.8, Hurst exponent 0.8) agree with this
formula within -4 to +8 %. The theory does not compute the separation.
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.rough_surface.shared.corrected_diffusion import GRADIENT, area_per_asperity, area_share
from stiction.laws.shared_claims import ELASTIC_CONTACT
from stiction.records.registry import RoughSurface
from stiction.records.sources import Source

GAMMA = 0.45


def rate(share: np.ndarray) -> np.ndarray:
    """Return dV/dV_c, the growth of the pressure variance V with finer roughness relative to its growth in full contact (V_c).

    share: ratio of contact area to nominal area, an array of any shape. Source: Yang & Persson 2008, as restated by Xu et
    al. 2024.
    """
    return GAMMA + (1.0 - GAMMA) * share**2


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the contact area per asperity (n, H), in units of pi R sigma, at H loads of n contacts; it is 0 under tension.

    load: per asperity, in units of K R^(1/2) sigma^(3/2).
    """
    return area_per_asperity(load, groups, lambda pressure: area_share(pressure, rate))


RECORD = RoughSurface(
    key="yang_persson_2008",
    title="Contact of randomly rough surfaces by diffusion of the pressure, slower in partial contact, elastic",
    grade="B",
    sources=(
        Source("yang_persson_2008", "", "the factor, as restated in the program of Xu et al. 2024; the text was not available"),
        Source("xu_zhu_xiao_zhou_2024", "", "the program that contains the factor, with gamma = 0.45 in its figures"),
        Source("persson_2001", "", "the diffusion"),
        Source("nayak_1971", "", "gradient of the surface from sigma, R and N"),
    ),
    area_at_load=area_at_load,
    takes_surface_moments=True,
    up_to_full_contact=True,
    verified="the differential equation integrated independently; its limits at light load and full contact",
    needs=("roughness_parameter",),
    validity=(ELASTIC_CONTACT,),
    notes=f"gamma = {GAMMA}. {GRADIENT}",
)
