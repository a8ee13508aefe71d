"""Hariri, Zu & Ben Mrad 2006: asperities of n neighbouring sampled points, n growing as the surfaces come closer.

The abstract's definition is known, the paper's formulas are not; surfaces.theory.n_point has what was made of it. Here each
n-point asperity of a Gaussian profile with exponential autocorrelation is a sphere in Hertz's contact with a flat at the level
d:

    area  pi R t = (pi/8) L^2,        load  (4/3) E* R^(1/2) t^(3/2) = (sqrt(2)/3) E* L t,        R = L^2 / (8 t).

From the profile to the surface (an assumption of this reconstruction): a line meets the asperities of width L whose middles
are within L/2 of it, so that there are, per area, as many as per length, over L. With asperities per area = (per length)^2
the area at a large separation would be as the square of the share of points above d. Summed over all n, with the
rate of rows nu and their mean height t per sampled point, and the spacing l,

    A/A0 = (pi/8) (P(y > d) + nu),    p/E* = (sqrt(2)/3) nu t / l,

since sum m P_m = P(y > d). The number of points n drops out of the load, and its square out of the area.
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.registry import RoughSurface, Validity
from stiction.laws.sources import Source
from stiction.quantities.errors import InputError
from stiction.surfaces.theory import n_point
from stiction.surfaces.theory.moments import Moments, bandwidth, density_of_bandwidth, summit_height

LEAST_DENSITY = float(density_of_bandwidth(n_point.LEAST_BANDWIDTH))
LARGEST_DENSITY = float(density_of_bandwidth(n_point.LARGEST_BANDWIDTH))


def correlation_of(density: np.ndarray) -> np.ndarray:
    """Correlation of neighbouring points of the sampled profile of a surface with this N R sigma (n,)."""
    bad = ~((density >= LEAST_DENSITY) & (density <= LARGEST_DENSITY))
    if bad.any():
        raise InputError(
            "roughness_parameter",
            float(density[bad][0]),
            f"{LEAST_DENSITY:.4g} to {LARGEST_DENSITY:.4g}: N R sigma of surfaces that have a sampled profile with exponential "
            "autocorrelation, up to where its asperities are tabulated",
        )
    alpha = np.clip(bandwidth(density), n_point.LEAST_BANDWIDTH, n_point.LARGEST_BANDWIDTH)
    return n_point.correlation_of_bandwidth(alpha)


def curve(h: np.ndarray, groups: Groups) -> tuple[np.ndarray, np.ndarray]:
    """Load and area (n, H) at separations h (H,) from the mean of the summits."""
    density = groups.roughness_parameter
    correlation = correlation_of(density)[:, None]
    surface = Moments.from_groups(density, np.ones_like(density))  # in sigma; R = sigma, of which nothing depends here
    deviation = np.sqrt(surface.m0)[:, None]
    level = (h + summit_height(density)[:, None]) / deviation
    rate = n_point.rate_of_rows(level, correlation)
    spacing = 2.0 * math.pi * n_point.peaks_per_point(correlation) * np.sqrt(surface.m2 / surface.m4)[:, None]
    # per asperity: over N K R^(1/2) sigma^(3/2), K = (4/3) E*, and over N pi R sigma
    load = math.sqrt(2.0) / 4.0 * rate * n_point.mean_height(level, correlation) * deviation / spacing / density[:, None]
    return load, (n_point.points_above(level) + rate) / (8.0 * density[:, None])


RECORD = RoughSurface(
    key="hariri_zu_ben_mrad_2006",
    title="n-point asperities of a sampled Gaussian profile with exponential autocorrelation, elastic",
    grade="C",
    sources=(
        Source(
            "hariri_zu_ben_mrad_2006",
            "abstract",
            "reconstructed: n neighbouring points, the n - 2 in the middle above a level; larger n as the separation falls. "
            "Height and radius of such an asperity, and the step from profile to surface, are this project's",
        ),
        Source("nayak_1971", "", "peaks of a profile of the isotropic Gaussian surface with the same sigma, R and N"),
    ),
    curve=curve,
    takes_surface_moments=True,
    verified="simulated profiles of 1e8 points, and rates of rows in closed form; none of the paper's own numbers is known",
    needs=("roughness_parameter",),
    load_falls=False,
    accuracy=1e-5,
    validity=(
        Validity(
            "roughness_parameter",
            LEAST_DENSITY,
            LARGEST_DENSITY,
            "a surface with fewer asperities N R sigma has no sampled profile with exponential autocorrelation; with more "
            "the model is not tabulated",
        ),
        Validity("plasticity_index", 0.0, 0.6, "asperities are taken as elastic"),
        Validity("theta", 10.0, math.inf, "adhesion is left out"),
    ),
    notes=(
        "The sampled profile has the variance of the isotropic Gaussian surface with the same sigma, N and mean curvature 1/R, "
        "and its peaks of three points are as many and as curved as those of that surface's profile; this decides spacing and "
        "correlation of the points: 0 at the least N R sigma, 0.5 at 0.0455, 0.9 at 0.09. Separation is from the mean of the "
        "summits. The load is largest at about half a deviation below the mean plane: two rows of points that merge lose one "
        "peak, so that nearer surfaces carry less. There the model ends."
    ),
)
