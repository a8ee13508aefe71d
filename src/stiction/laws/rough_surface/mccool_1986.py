"""McCool 1986: Greenwood & Williamson's asperities with the radius, number and height deviation of a surface's summits.

The sum is Greenwood & Williamson's; what McCool adds is where sigma, R and N come from: the spectral moments of the surface
(surfaces.theory.moments), after Nayak. Given sigma, R and N, the moments follow, and with them where the mean plane is.
"""

import math

from stiction.laws.registry import Limit, RoughSurface, Validity
from stiction.laws.sources import Source

RECORD = RoughSurface(
    key="mccool_1986",
    title="Greenwood & Williamson's model with the summits of a Gaussian surface",
    grade="B",
    sources=(
        Source("mccool_1986", "", "asperities from spectral moments"),
        Source("nayak_1971", "", "number, mean curvature and heights of the summits"),
        Source("greenwood_williamson_1966", "", "the sum over heights"),
    ),
    asperity="hertz",
    takes_surface_moments=True,
    verified="ratio of area to load of surfaces with known spectral moments; moments against Nayak's density, integrated",
    validity=(
        Validity("plasticity_index", 0.0, 0.6, "asperities are taken as elastic"),
        Validity("theta", 10.0, math.inf, "adhesion is left out"),
    ),
    limits=(Limit("greenwood_williamson_1966", {}, ("load", "contact_area"), 1e-14),),
    notes=(
        "For given sigma, R and N it is Greenwood & Williamson's model; it differs in taking them from the moments of the "
        "surface, for which there is surfaces.theory.moments. Separation is from the mean of the summits; the mean plane is "
        "lower by sigma / (sqrt(48) pi N R sigma)."
    ),
)
