r"""Persson's contact area with a correction fitted to solved maps; for scans, the contact is solved instead.

*Assumes*: half-spaces without adhesion and friction, with one hardness at all scales. *Source*: this project's own, a fit to
maps of rough surfaces whose contact was solved point by point ([the set](truth.md)); [persson_2001] for the form, [nayak_1971]
for the spectral moments $m_0$, $m_2$, $m_4$ of a profile. With the nominal pressure $p$ in units of $E^*h'$ ($E^*$ contact
modulus, $h'$ root mean square gradient) and the bandwidth parameter $\alpha=m_0m_4/m_2^2$, the elastic contact area is

$$
\frac{A_\text{el}}{A_n}=
\operatorname{erf}\left(\sqrt2\,p\left[1+c\left(1-\sqrt{\operatorname{erf}(\sqrt2\,p)}\right)\right]\right),\qquad
c=.617-.041\ln\alpha
$$

and with the hardness $H$ the area is $A=\left[A_\text{el}^{3.5}+(pA_n/H)^{3.5}\right]^{1/3.5}$ (here $p$ in Pa). This formula
is used if the surface is given by $\sigma$, $R$ and $N$. Most of its error comes from properties that these numbers do not
describe: skewness, wear, a lay, and the scatter of a small map. If the contact names scans, the contact of their map is solved,
elastic or with the hardness. More than twelve pressures are interpolated between solutions at four pressures per decade. At
pressures at which fewer than about 120 points touch, and above $p=1.2\,E^*h'$ or 0.97 of the hardness, a formula is scaled to
the nearest solution. Points are skipped if at least four per shortest wavelength (eight on a map with a lay, 2.5 on maps that
are otherwise too large) and 3000 in contact remain. A map with too many points uses one of the formulas of
`solvers/boundary_elements/area_estimates.py`. The result `area_by` names the method.

*Check*: at light load $A/A_n=\kappa\,p/(E^*h')$ with $\kappa\to(1+c)\sqrt{8/\pi}$; $c=0$ gives
[`persson_2001`](#persson_2001); $A=pA_n/H$ for a soft body.
"""

from typing import TYPE_CHECKING

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.rough_surface.persson_2001_elastoplastic import hardness_over_slope
from stiction.laws.rough_surface.shared.maps import RESOLVED
from stiction.records.registry import RoughSurface, Validity
from stiction.records.sources import Source
from stiction.surfaces.theory.moments import LEAST_BANDWIDTH, LEAST_DENSITY, bandwidth, density_of_bandwidth, reduced_pressure
from stiction.surfaces.theory.moments import slope_over_sharpness as slope_of
from stiction.surfaces.theory.widened_area import WIDEST_BAND, of_moments, with_hardness

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap

WAYS = {
    "moments": "formula from spectral moments, for a Gaussian isotropic surface",
    "solution": "solution of the contact of the map, with as few points as are sufficient",
    "top slopes": "formula from the slopes of the map's highest points, because the map has too many points to be solved",
    "ranks": "formula from the slopes of the map by height, because the map has too many points to be solved",
}


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the contact area per asperity (n, H) at H loads of n contacts, from the spectral moments of the surface.

    Units: load per asperity in K R^(1/2) sigma^(3/2), area in pi R sigma. The area is 0 under tension.
    """
    density = groups.roughness_parameter[:, None]
    pressure = reduced_pressure(np.maximum(load, 0.0), density)
    elastic = of_moments(pressure, np.maximum(bandwidth(density), LEAST_BANDWIDTH))
    return with_hardness(elastic, pressure, hardness_over_slope(groups)[:, None]) / (np.pi * density)


def area_on_map(load: np.ndarray, groups: Groups, surface: "HeightMap") -> np.ndarray:
    """Return the contact area per asperity (n, H) at H loads of n contacts, from a map.

    Units: load per asperity in K R^(1/2) sigma^(3/2), area in pi R sigma. surface: map that represents the roughness of both
    faces, the same for all contacts. The area is 0 under tension.
    """
    density = groups.roughness_parameter[:, None]
    slope = groups.sharpness[:, None] * slope_of(density)
    pressure = reduced_pressure(np.maximum(load, 0.0), density) * slope  # over E*
    hardness = hardness_over_slope(groups) * slope[:, 0]
    from stiction.solvers.boundary_elements.map_area import map_area  # slow to import

    area = map_area(surface)
    shares = [area.share(row, float(h)) for row, h in zip(pressure, hardness, strict=True)]
    return np.array(shares).reshape(load.shape) / (np.pi * density)


def way(surface: "HeightMap | None") -> str:
    """Return the key in WAYS of the method that computes the contact area.

    surface: map that represents the roughness of both faces, or None for a surface given by its moments.
    """
    if surface is None:
        return "moments"
    from stiction.solvers.boundary_elements.map_area import map_area  # slow to import

    return map_area(surface).way


RECORD = RoughSurface(
    key="persson_widened",
    title="Persson's contact area with a correction fitted to solved maps; for a scan, the solution of its contact",
    grade="B",
    sources=(
        Source("persson_2001", "", "the form of the area"),
        Source("nayak_1971", "", "gradient and bandwidth of the surface from sigma, R and N"),
        Source("polonsky_keer_1999", "", "how the contact of a map is solved"),
    ),
    area_at_load=area_at_load,
    area_on_map=area_on_map,
    way=lambda surface: WAYS[way(surface)],
    takes_surface_moments=True,
    up_to_full_contact=True,
    verified="solved maps that were not used in the fit: periodic, Gaussian and not, elastic and with a hardness",
    needs=("hardness_group", "roughness_parameter"),
    validity=(
        RESOLVED,
        Validity(
            "roughness_parameter",
            LEAST_DENSITY,
            float(density_of_bandwidth(WIDEST_BAND)),
            "the formula was not fitted to such surfaces",
            "fit",
        ),
    ),
    notes=(
        "For a surface given by sigma, R and N the formula for Gaussian isotropic surfaces is used; for scans the contact of "
        "their map is solved. The hardness is that of the softer body at all scales."
    ),
)
