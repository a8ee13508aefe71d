r"""Asperities of n neighbouring sampled points, n growing as the surfaces come closer: Hariri, Zu & Ben Mrad 2006.

*Assumes* (abstract of [hariri_zu_ben_mrad_2006]): an asperity is $n$ neighbouring sampled points of a profile whose $n-2$
middle ones are above a level; as the separation falls larger $n$ appear; exponential autocorrelation is the example.
*Source*: [hariri_zu_ben_mrad_2006], its abstract; what was made of it is in `stiction.surfaces.theory.n_point`.
*Unknown*: every formula. *Reconstruction*: with the level $d$, the height $t$ of the highest point above it and the chord
$L=(n-1)\ell$ between the outer neighbours, an asperity is a Hertz contact pressed by $t$ with the radius of the parabola,

$$
R_n=\frac{L^2}{8t},\qquad\text{area}=\frac\pi8L^2,\qquad\text{load}=\frac{\sqrt2}3E^*L\,t
$$

and a line meets the asperities of width $L$ within $L/2$ of their middles, so that there are per area as many as per length,
over $L$ (with asperities per area as the square of those per length the area at a large separation would be as the square of
the share of points above $d$). Summed over all $n$, for a Gaussian profile whose neighbouring points have the correlation
$r$:

$$
\frac A{A_n}=\frac\pi8\left[Q(D)+\nu_r\right],\qquad\frac p{E^*}=\frac{\sqrt2}3\,\frac{\nu_r\,\bar t}\ell,\qquad
\nu_r=2\,T_O\!\left(D,\sqrt{\tfrac{1-r}{1+r}}\right)
$$

$D$ is the level over the profile's standard deviation, $Q$ the share of points above it, $\nu_r$ the rows of points per point
($T_O$ is Owen's function) and $\bar t(D,r)$ their mean height, from an integral equation, tabulated; the number of points $n$
drops out of the load, and its square out of the area. $\ell$ and $r$ are such that the peaks of three sampled points are as
many and as curved as those of a profile of the surface with the same $\sigma$, $N$ and $1/R$; that exists for $\rho$ from
0.0396 to 1.01. *Check*: from simulated profiles of $2\cdot10^7$ points, $\nu_r$ and $\bar t$ over the profile's deviation:

| $r$ | $D=-1$ | 0 | 1 | 2 |
|---|---|---|---|---|
| 0 | 0.1335, 2.152 | 0.2500, 1.042 | 0.1336, 0.567 | 0.0222, 0.378 |
| 0.3 | 0.1131, 2.027 | 0.2014, 1.031 | 0.1131, 0.585 | 0.0207, 0.386 |
| 0.7 | 0.0747, 1.721 | 0.1266, 0.940 | 0.0747, 0.578 | 0.0154, 0.394 |
| 0.95 | 0.0305, 1.087 | 0.0504, 0.656 | 0.0306, 0.451 | 0.0068, 0.337 |

The load has a maximum at about half a deviation below the mean plane, where rows merge: there the model ends. It has more
area at the same load than any other elastic model here: $\kappa$ in $A/A_n=\kappa\,p/(E^*h')$, of simulated profiles too, is
4.3, 5.6 and 7.2 at $h$ = 0, 1 and 2 for $\rho=0.0405$, and 3.7, 4.1 and 4.8 for $\rho=0.06$. Whether that is the paper's or
the reconstruction's cannot be said.
"""

import math
from functools import cache

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.shared_claims import ELASTIC
from stiction.quantities.errors import InputError
from stiction.records.registry import RoughSurface, Validity
from stiction.records.sources import Source
from stiction.surfaces.theory import n_point
from stiction.surfaces.theory.moments import Moments, bandwidth, density_of_bandwidth, summit_height
from stiction.surfaces.theory.start_table import tabulated

LEAST_DENSITY = float(density_of_bandwidth(n_point.LEAST_BANDWIDTH))
LARGEST_DENSITY = float(density_of_bandwidth(n_point.LARGEST_BANDWIDTH))


def correlation_of(density: np.ndarray) -> np.ndarray:
    """Return the correlation (n,) of neighbouring points of the sampled profile of surfaces with density = N R sigma (n,).

    Raises InputError if no such profile exists or is tabulated.
    """
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
    """Return load and area (n, H) per asperity at separations h (H,) or (n, H) from the mean of the summits."""
    return _sums(h, groups.roughness_parameter)


def _sums(h: np.ndarray, density: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    correlation = correlation_of(density)[:, None]
    surface = Moments.from_groups(density, np.ones_like(density))  # in sigma; R = sigma, of which nothing depends here
    deviation = np.sqrt(surface.m0)[:, None]
    level = (h + summit_height(density)[:, None]) / deviation
    rate = n_point.rate_of_rows(level, correlation)
    spacing = 2.0 * math.pi * n_point.peaks_per_point(correlation) * np.sqrt(surface.m2 / surface.m4)[:, None]
    # per asperity: over N K R^(1/2) sigma^(3/2), K = (4/3) E*, and over N pi R sigma
    load = math.sqrt(2.0) / 4.0 * rate * n_point.mean_height(level, correlation) * deviation / spacing / density[:, None]
    return load, (n_point.points_above(level) + rate) / (8.0 * density[:, None])


def separation_near(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return approximate separations (n, H) at the loads (n, H), as starting values.

    They are on the far side of the largest load, where the load rises on approach.
    """
    return _near()(load, np.log(groups.roughness_parameter))


@cache
def _near():
    along = np.linspace(math.log(LEAST_DENSITY), math.log(LARGEST_DENSITY), 40)
    density = np.clip(np.exp(along), LEAST_DENSITY, LARGEST_DENSITY)
    return tabulated(lambda h, groups: _sums(h, groups)[0], density, along)


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
    separation_near=separation_near,
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
        ELASTIC,
    ),
    notes=(
        "The sampled profile has the variance of the isotropic Gaussian surface with the same sigma, N and mean curvature 1/R, "
        "and its peaks of three points are as many and as curved as those of that surface's profile; this decides spacing and "
        "correlation of the points: 0 at the least N R sigma, 0.5 at 0.0455, 0.9 at 0.09. Separation is from the mean of the "
        "summits. The load is largest at about half a deviation below the mean plane: two rows of points that merge lose one "
        "peak, so that nearer surfaces carry less. There the model ends."
    ),
)
