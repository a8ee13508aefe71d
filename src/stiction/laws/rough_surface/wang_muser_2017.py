r"""Persson's diffusion with a rate fitted to elastic solutions up to full contact: Wang & Müser 2017.

*Assumes*: as [`yang_persson_2008`](#yang_persson_2008), with a different factor for the growth of the variance $V$ of the
pressure. *Source*: [wang_muser_2017], as the program published with [xu_zhu_xiao_zhou_2024] restates it (the text was not
available). With the variance $V_c$ in full contact, the nominal pressure $p$, the contact modulus $E^*$ and the root mean
square gradient $h'$:

$$
\frac{dV}{dV_c}=\frac59-\frac29\left(\frac A{A_n}\right)^2+\frac69\left(\frac A{A_n}\right)^4,\qquad
\frac A{A_n}=\operatorname{erf}\frac p{\sqrt{2V}},\qquad V_c=\frac{(E^*h')^2}4
$$

*Limit*: $A/A_n=\kappa\,p/(E^*h')$ with $\kappa\to\sqrt{72/(5\pi)}=2.1410$ at light load, full contact at high load. *Check*:

| $p/(E^*h')$ | 0.01 | 0.05 | 0.1 | 0.2 | 0.5 | 1 |
|---|---|---|---|---|---|---|
| $A/A_n$ | 0.02142 | 0.10706 | 0.21174 | 0.39748 | 0.73837 | 0.95703 |

The simulations published with that program (17 pressures, $p/(E^*h')$ from 0.0004 to 1.8, Hurst exponent 0.8) agree with this
formula within -10 to +5 %. The source treats surfaces that attract each other; its correction for surfaces without attraction
is used here. The theory does not compute the separation.
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.rough_surface.shared.corrected_diffusion import GRADIENT, area_per_asperity, area_share
from stiction.laws.shared_claims import ELASTIC_CONTACT
from stiction.records.registry import RoughSurface
from stiction.records.sources import Source


def rate(share: np.ndarray) -> np.ndarray:
    """Return dV/dV_c, the growth of the pressure variance V with finer roughness relative to its growth in full contact (V_c).

    share: ratio of contact area to nominal area, an array of any shape. Source: Wang & Müser 2017, as restated by Xu et al.
    2024.
    """
    squared = share**2
    return (5.0 - 2.0 * squared + 6.0 * squared**2) / 9.0


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the contact area per asperity (n, H), in units of pi R sigma, at H loads of n contacts; it is 0 under tension.

    load: per asperity, in units of K R^(1/2) sigma^(3/2).
    """
    return area_per_asperity(load, groups, lambda pressure: area_share(pressure, rate))


RECORD = RoughSurface(
    key="wang_muser_2017",
    title="Contact of randomly rough surfaces by diffusion of the pressure, at a rate fitted up to full contact, elastic",
    grade="B",
    sources=(
        Source("wang_muser_2017", "", "the factor, as restated in the program of Xu et al. 2024; the text was not available"),
        Source("xu_zhu_xiao_zhou_2024", "", "the program that contains the factor"),
        Source("persson_2001", "", "the diffusion"),
        Source("nayak_1971", "", "gradient of the surface from sigma, R and N"),
    ),
    area_at_load=area_at_load,
    takes_surface_moments=True,
    up_to_full_contact=True,
    verified="the differential equation integrated independently; its limits at light load and full contact",
    needs=("roughness_parameter",),
    validity=(ELASTIC_CONTACT,),
    notes=GRADIENT,
)
