r"""Asperities of n neighbouring sampled points, where n grows as the surfaces approach: Hariri, Zu & Ben Mrad 2006.

*Assumes* (abstract of [hariri_zu_ben_mrad_2006]): an asperity consists of $n$ neighbouring sampled points of a profile, with
its $n-2$ middle points above a level. Larger $n$ appear as the separation falls. The example has exponential autocorrelation.
*Source*: [hariri_zu_ben_mrad_2006], its abstract; the reconstruction is in `stiction.surfaces.theory.n_point`. *Unknown*: all
formulas of the source. *Reconstruction*: the sampled points are $\ell$ apart, the two outer points of an asperity
$L=(n-1)\ell$. Its highest point is the height $t$ above the level $d$. The asperity is a Hertz contact at the displacement
$t$, with the radius $R_n$ of a parabola of the height $t$ and the width $L$ and the contact modulus $E^*$,

$$
R_n=\frac{L^2}{8t},\qquad\text{area}=\frac\pi8L^2,\qquad\text{load}=\frac{\sqrt2}3E^*L\,t
$$

A line meets an asperity of width $L$ if it passes within $L/2$ of its centre. The number of asperities per area is therefore
their number per length divided by $L$. (If it were the square of the number per length, the area at a large separation would
be proportional to the square of the fraction of points above $d$.) The sum over all $n$, for a Gaussian profile whose
neighbouring points have the correlation $r$, gives the ratio of contact area to nominal area, and the nominal pressure $p$:

$$
\frac A{A_n}=\frac\pi8\left[Q(D)+\nu_r\right],\qquad\frac p{E^*}=\frac{\sqrt2}3\,\frac{\nu_r\,\bar t}\ell,\qquad
\nu_r=2\,T_O\!\left(D,\sqrt{\tfrac{1-r}{1+r}}\right)
$$

$D$ is the level over the profile's standard deviation, $Q$ the fraction of points above it, $\nu_r$ the number of asperities
(runs of neighbouring points above the level) per sampled point, $T_O$ Owen's function and $\bar t(D,r)$ the mean of $t$,
tabulated from an integral equation. The number of points $n$ cancels in the load, and its square in the area. $\ell$ and $r$
are chosen so that peaks of three sampled points have the same number and curvature as the peaks of a profile of the surface
with the given $\sigma$, $N$ and $1/R$. This is possible for $\rho=NR\sigma$ from 0.0396 to 1.01. *Check*: $\nu_r$, and $\bar t$
over the profile's standard deviation, from simulated profiles of $2\cdot10^7$ points:

| $r$ | $D=-1$ | 0 | 1 | 2 |
|---|---|---|---|---|
| 0 | 0.1335, 2.152 | 0.2500, 1.042 | 0.1336, 0.567 | 0.0222, 0.378 |
| 0.3 | 0.1131, 2.027 | 0.2014, 1.031 | 0.1131, 0.585 | 0.0207, 0.386 |
| 0.7 | 0.0747, 1.721 | 0.1266, 0.940 | 0.0747, 0.578 | 0.0154, 0.394 |
| 0.95 | 0.0305, 1.087 | 0.0504, 0.656 | 0.0306, 0.451 | 0.0068, 0.337 |

The load has a maximum at a level about half a standard deviation below the mean plane, because runs of points merge; the model
ends at this level. At the same load it predicts a larger area than any other elastic model here. $\kappa$ in
$A/A_n=\kappa\,p/(E^*h')$, with the root mean square gradient $h'$, is 4.3, 5.6 and 7.2 at the separations $h$ = 0, 1 and 2 for
$\rho=0.0405$, and 3.7, 4.1 and 4.8 for $\rho=0.06$; simulated profiles give the same values. It is unknown whether the large
area is due to the paper's model or to the reconstruction.
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
    """Return the correlation (n,) between neighbouring points of the sampled profiles that represent n surfaces.

    density: N R sigma of the surfaces, (n,). Raises InputError if no such profile exists, or if its correlation is not
    tabulated.
    """
    bad = ~((density >= LEAST_DENSITY) & (density <= LARGEST_DENSITY))
    if bad.any():
        raise InputError(
            "roughness_parameter",
            float(density[bad][0]),
            f"{LEAST_DENSITY:.4g} to {LARGEST_DENSITY:.4g}: N R sigma for which this model is defined and tabulated",
        )
    alpha = np.clip(bandwidth(density), n_point.LEAST_BANDWIDTH, n_point.LARGEST_BANDWIDTH)
    return n_point.correlation_of_bandwidth(alpha)


def curve(h: np.ndarray, groups: Groups) -> tuple[np.ndarray, np.ndarray]:
    """Return load and contact area (n, H) per asperity at H separations of n contacts.

    h: separation in units of sigma from the mean summit height, (H,) or (n, H). Units: loads in K R^(1/2) sigma^(3/2), areas in
    pi R sigma. Raises InputError for contacts whose N R sigma is outside the range of the model.
    """
    return _sums(h, groups.roughness_parameter)


def _sums(h: np.ndarray, density: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    correlation = correlation_of(density)[:, None]
    surface = Moments.from_groups(density, np.ones_like(density))  # in units of sigma; R = sigma, which has no effect
    deviation = np.sqrt(surface.m0)[:, None]
    level = (h + summit_height(density)[:, None]) / deviation
    rate = n_point.rate_of_rows(level, correlation)
    spacing = 2.0 * math.pi * n_point.peaks_per_point(correlation) * np.sqrt(surface.m2 / surface.m4)[:, None]
    # per asperity: over N K R^(1/2) sigma^(3/2), K = (4/3) E*, and over N pi R sigma
    load = math.sqrt(2.0) / 4.0 * rate * n_point.mean_height(level, correlation) * deviation / spacing / density[:, None]
    return load, (n_point.points_above(level) + rate) / (8.0 * density[:, None])


def separation_near(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return approximate separations (n, H), in units of sigma, at the loads (n, H), as starting values for a search.

    load: per asperity, in units of K R^(1/2) sigma^(3/2). The load of this model has a maximum. All returned separations
    are larger than the separation at this maximum. They are NaN for loads of 0 or less.
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
            "Height and radius of such an asperity, and the step from profile to surface, are this project's own",
        ),
        Source("nayak_1971", "", "peaks of a profile of the isotropic Gaussian surface with the same sigma, R and N"),
    ),
    curve=curve,
    separation_near=separation_near,
    takes_surface_moments=True,
    verified="simulated profiles; numbers of asperities in closed form; no numbers of the paper are known",
    needs=("roughness_parameter",),
    load_is_monotonic=False,
    accuracy=1e-5,
    validity=(
        Validity(
            "roughness_parameter",
            LEAST_DENSITY,
            LARGEST_DENSITY,
            "profiles with exponential autocorrelation have no value below the lower limit; "
            "the model's table ends at the upper limit",
        ),
        ELASTIC,
    ),
    notes=(
        "The sampled profile has the variance of the isotropic Gaussian surface with the given sigma, N and mean curvature "
        "1/R. Its peaks of three points have the same number and curvature as the peaks of that surface's profile. This "
        "determines spacing and correlation of the points; the correlation is 0 at the smallest N R sigma, 0.5 at 0.0455 and "
        "0.9 at 0.09. The separation is from the mean summit height. The load is largest at about half a standard deviation "
        "below the mean plane, because two rows of points that merge lose one peak; the model ends there."
    ),
)
