r"""Compute the summits that a surface would have if it were Gaussian, from its spectral moments (McCool).

No single asperity is searched for. The mean squares of height, slope and second derivative along profiles (m0, m2, m4), put
into Nayak's statistics (1971) as McCool (1986) does, give sigma, R and N; stiction.surfaces.theory.moments has the relations.

*Assumes*: the surface is Gaussian, and isotropic or an isotropic one that was stretched along one direction. *Source*:
[mccool_1986], [nayak_1971]. From the mean squares
$m_0,m_2,m_4$ of height, slope and second derivative along profiles,

$$
N=\frac{m_4/m_2}{6\pi\sqrt3},\qquad R=\frac38\sqrt{\frac\pi{m_4}},\qquad\sigma^2=\left(1-\frac{0.8968}\alpha\right)m_0,\qquad
\alpha=\frac{m_0m_4}{m_2^2}
$$
"""

from math import inf

from stiction.quantities.errors import InputError, InWords
from stiction.records.registry import AsperityMethod, Parameter, Validity
from stiction.records.sources import Source
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.gaussian_asperities import of_moments
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.statistics import moments_by_differences
from stiction.surfaces.theory.moments import LEAST_DENSITY


def mccool(surface: HeightMap, cutoff: float | None) -> Asperities:
    """Return the summits of the Gaussian surface that has the spectral moments of this surface, as asperities.

    The moments are computed by finite differences. The surface may be isotropic, or stretched along one direction (a lay).
    cutoff: shortest wavelength [m], as in `moments_by_differences`; None for twice the larger pitch. Differences underestimate
    waves near the cutoff; for moments from the spectrum see `of_moments`. Raises InputError as these two functions do, and for
    a surface with slopes along one direction only.
    """
    moments = moments_by_differences(surface, cutoff).equivalent
    if moments is None:
        raise InputError(
            "asperities by mccool",
            InWords("slopes along one direction only"),
            "a surface that is rough in both directions; grooves have no summits",
        )
    return of_moments("mccool", moments, "from moments by finite differences")


RECORD = AsperityMethod(
    key="mccool",
    title="Summits of the Gaussian surface with the measured spectral moments, isotropic or stretched; the map is not searched",
    label="moments (McCool)",
    grade="B",
    sources=(
        Source("mccool_1986", "", "asperities from spectral moments"),
        Source("nayak_1971", "", "summits of a Gaussian surface"),
    ),
    verified="an egg-crate surface in closed form; generated Gaussian surfaces with known moments, isotropic (to 3 %) and with "
    "a lay",
    find=mccool,
    order=5,
    validity=(
        Validity(
            "roughness_parameter",
            LEAST_DENSITY,
            inf,
            "no isotropic Gaussian surface has such a low value (bandwidth parameter alpha >= 1.5)",
        ),
    ),
    of_summits=True,
    of_moments=True,
    parameters={
        "cutoff": Parameter(
            "shortest wavelength: differences span half of it; default: twice the larger pitch", None, lower=0.0
        ),
    },
    notes="The heights are assumed Gaussian, because only averages are known. Finite differences underestimate short "
    "waves: with 4 points in the shortest wavelength the radius is 6 to 10 % too large.",
)
