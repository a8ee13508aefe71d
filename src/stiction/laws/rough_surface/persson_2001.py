r"""Elastic contact by diffusion of the pressure distribution towards finer roughness: Persson 2001.

*Assumes*: there are no asperities. As finer roughness is included, the distribution of the contact pressure broadens by
diffusion. Contact is lost where the pressure reaches zero. *Source*: [persson_2001]. The variable that plays the role of time
in the diffusion is $G=(E^*h')^2/8$ for the whole surface, with the contact modulus $E^*$ and the root mean square gradient
$h'$. The ratio of contact area to nominal area at the nominal pressure $p$, and $\kappa$ in $A/A_n=\kappa\,p/(E^*h')$ at light
load, are

$$
\frac A{A_n}=\operatorname{erf}\frac p{2\sqrt G}=\operatorname{erf}\left(\sqrt2\,\frac p{E^*h'}\right),\qquad
\kappa\to\sqrt{8/\pi}=1.5958
$$

*Check*:

| $p/(E^*h')$ | 0.01 | 0.05 | 0.1 | 0.2 | 0.5 | 1 |
|---|---|---|---|---|---|---|
| $A/A_n$ | 0.01596 | 0.07966 | 0.15852 | 0.31084 | 0.68269 | 0.95450 |

$h'$ belongs to the isotropic Gaussian surface with $N$ summits per area of the mean curvature $1/R$: $h'^2=\sqrt3/(64NR^2)$.
The theory does not compute the separation.
"""

import math

import numpy as np
from scipy.special import erf

from stiction.contact.indices import Groups
from stiction.laws.rough_surface.shared.corrected_diffusion import GRADIENT, area_per_asperity
from stiction.laws.shared_claims import ELASTIC_CONTACT
from stiction.records.registry import RoughSurface
from stiction.records.sources import Source


def area_share(pressure: np.ndarray) -> np.ndarray:
    """Return the ratio of contact area to nominal area at the reduced pressures p / (E* h') >= 0.

    pressure: array of any shape; p: nominal pressure, E*: contact modulus, h': root mean square gradient. Source: Persson
    2001.
    """
    return erf(math.sqrt(2.0) * pressure)


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the contact area per asperity (n, H), in units of pi R sigma, at H loads of n contacts; it is 0 under tension.

    load: per asperity, in units of K R^(1/2) sigma^(3/2).
    """
    return area_per_asperity(load, groups, area_share)


RECORD = RoughSurface(
    key="persson_2001",
    title="Contact of randomly rough surfaces by diffusion of the pressure, elastic",
    grade="B",
    sources=(
        Source("persson_2001", "", "A/A0 = erf(p / (2 sqrt(G))), with G = (E* h')^2 / 8 for the gradient of the whole surface"),
        Source("nayak_1971", "", "gradient of the surface from sigma, R and N"),
    ),
    area_at_load=area_at_load,
    takes_surface_moments=True,
    up_to_full_contact=True,
    verified="diffusion with an absorbing boundary by finite differences; A/A0 = sqrt(8/pi) p/(E* h') at light load",
    needs=("roughness_parameter",),
    validity=(ELASTIC_CONTACT,),
    notes=GRADIENT,
)
