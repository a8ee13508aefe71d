r"""Contact area as a function of load for a rough surface that attracts but does not stick: Pastewka & Robbins 2014.

*Assumes*: as in the criterion [`pastewka_robbins_2014`](#pastewka_robbins_2014), attraction acts on rims around the contact
spots and repulsion in the spots. The attractive force is proportional to the area of the rims, the repulsive force to the area
of the spots. Both areas are proportional to the load. *Source*: [pastewka_robbins_2014]: the abstract (the area is
proportional to the load; the factor rises linearly with weak attraction and changes sign at a threshold), and eq. (10) as
restated by the authors' group. *Reconstructed*: eq. (10) states where the two forces cancel, $Q=1$. Here the attraction is
also subtracted where they do not cancel:

$$
p=\left(1-\frac1Q\right)\frac{E^*h'}{\kappa}\frac A{A_n},\qquad
Q=\frac{h'E^*\varrho}{2\gamma}\left(\frac{h'^2}{h''\varrho}\right)^{2/3},\qquad\kappa=2
$$

$p$ is the nominal pressure, $A/A_n$ contact area divided by nominal area, $E^*$ the contact modulus, $h'$ the root mean square
gradient, $h''$ the root mean square of half the Laplacian of the heights, $\gamma$ the work of adhesion and $\varrho$ the
range of the attraction. *Limit*: $A/A_n=2p/(E^*h')$ without attraction. *Check*: $A/A_n=0.021463$ at $p/(E^*h')=0.01$ and
$Q=14.666$. *Unknown*: the authors' form of the area law, and whether the threshold is $Q=1$, as restated, or
$Q=\pi(3/16)^{2/3}=1.03$.

A surface that sticks ($Q\le1$) is in contact without a load; the model then raises an error. The area is proportional to the
load up to a tenth of the nominal area. The range of the attraction must be short compared with $\tfrac{16}3h'^2/h''$
([monti_sanner_pastewka_2021]). The theory does not compute the separation.
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.criterion.pastewka_robbins_2014 import KAPPA, stickiness
from stiction.laws.shared_claims import ELASTIC_CONTACT
from stiction.quantities.errors import InputError
from stiction.records.registry import RoughSurface, Validity
from stiction.records.sources import Source
from stiction.surfaces.theory.moments import reduced_pressure


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the contact area per asperity (n, H), in units of pi R sigma, at H loads of n contacts.

    load: per asperity, in units of K R^(1/2) sigma^(3/2). The area is 0 under tension, and NaN for contacts that stick. Raises
    InputError if all contacts stick.
    """
    ratio = stickiness(groups)[:, None]
    if not (ratio > 1.0).any():
        now = float(ratio[0, 0])
        allowed = f"a value at which the surface does not stick: repulsion over attraction is {now:.3g}, must be above 1"
        raise InputError("tabor_parameter", float(groups.tabor_parameter[0]), allowed)
    density = groups.roughness_parameter[:, None]
    kappa = np.divide(KAPPA, 1.0 - 1.0 / ratio, where=ratio > 1.0, out=np.full(ratio.shape, np.nan))
    return kappa * reduced_pressure(np.maximum(load, 0.0), density) / (math.pi * density)


RECORD = RoughSurface(
    key="pastewka_robbins_2014_area",
    title="Contact of a randomly rough surface with weak attraction around its contact spots, elastic",
    grade="C",
    sources=(
        Source("pastewka_robbins_2014", "abstract and eq. (10)", "reconstructed: eq. (10) used away from the threshold"),
        Source("monti_sanner_pastewka_2021", "", "how short the range must be, as restated by the authors' group"),
        Source("nayak_1971", "", "gradient and curvature of the surface from sigma, R and N"),
    ),
    area_at_load=area_at_load,
    takes_surface_moments=True,
    adheres=True,
    verified="pressures in spots and on rims computed in SI units; limits of no attraction and of the threshold",
    needs=("theta", "roughness_parameter", "tabor_parameter"),
    validity=(
        ELASTIC_CONTACT,
        Validity(
            "stickiness_ratio",
            1.0,
            math.inf,
            "attraction exceeds repulsion, so the surface sticks without a load",
            "impossible",
        ),
        Validity("range_over_gap", 0.0, 0.1, "the attraction reaches beyond the rims of the contact spots"),
    ),
    notes="The range of the attraction is taken as the equilibrium distance. A surface that sticks raises an error.",
)
