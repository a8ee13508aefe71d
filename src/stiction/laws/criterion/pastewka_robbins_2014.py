r"""Criterion for a rough surface to stick without a load, as a single ratio: Pastewka & Robbins 2014.

*Assumes*: attraction acts on a rim around each contact spot, where the gap is below the range $\varrho$ of the attraction. A
surface sticks if the attraction on the rims is larger than the repulsion in the spots. *Source*: [pastewka_robbins_2014], eq.
(10), as restated by the authors' group with contact spots $4h'/h''$ wide and the relation of area and load
$A/A_n=\kappa\,p/(E^*h')$, $\kappa=2$ ($A/A_n$: contact area divided by nominal area, $p$: nominal pressure). `stiction
compare` prints the ratio.

$$
\frac{h'E^*\varrho}{2\gamma}\left(\frac{h'^2}{h''\varrho}\right)^{2/3}<1
$$

$h'$ is the root mean square gradient of the surface, $h''$ the root mean square of half the Laplacian of the heights,
$\gamma$ the work of adhesion and $E^*$ the contact modulus. $\varrho$ is taken as the equilibrium distance $\varepsilon$ and
must be short compared with $\tfrac{16}3h'^2/h''$. For asperities with the density $\rho=NR\sigma$,
$\varsigma=\sqrt{\sigma/R}$, the adhesion index $\theta$ and the Tabor parameter $\mu_T$:
$h'=\varsigma(\sqrt3/(64\rho))^{1/2}$, $h''\sigma=\sqrt{3\pi/32}\,\varsigma^2$,
$\varrho/\sigma=(16/9)^{1/3}\theta^{-2/3}/\mu_T$ and $\gamma/(E^*\sigma)=\tfrac43\varsigma/\theta$; $\varsigma$ cancels.
*Check*: the ratio is 14.666 at $\theta=228.041$, $\rho=0.0408$, $\mu_T=5.19282$. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.records.registry import Criterion
from stiction.records.sources import Source
from stiction.surfaces.theory.moments import slope_over_sharpness

KAPPA = 2.0  # area over load, A E* h' / (A0 p), from simulations
_CURVATURE = math.sqrt(3.0 * math.pi / 32.0)  # h'' sigma over sigma/R


def stickiness_ratio(rms_slope, rms_curvature, interaction_range, adhesion_length):
    """Return the ratio of repulsion to attraction of a rough surface; the surface sticks if it is below 1.

    Source: Pastewka & Robbins 2014, eq. (10). rms_slope: root mean square gradient h' [1]. rms_curvature: h'', root mean
    square of half the Laplacian of the heights [1/m]. interaction_range: range rho of the attraction [m]. adhesion_length:
    work of adhesion divided by the contact modulus E* [m].
    """
    spot = rms_slope * rms_slope / (rms_curvature * interaction_range)
    return rms_slope * interaction_range / (KAPPA * adhesion_length) * spot ** (2.0 / 3.0)


def interaction_range(groups: Groups) -> np.ndarray:
    """Return the range of the attraction in units of sigma (n,), taken as the equilibrium distance of the surfaces.

    It equals (16/9)^(1/3) theta^(-2/3) / mu_T, with the elastic adhesion index theta and the Tabor parameter mu_T.
    """
    return np.cbrt(16.0 / 9.0) * groups.theta ** (-2.0 / 3.0) / groups.tabor_parameter


def range_over_gap(groups: Groups) -> np.ndarray:
    """Return the ratio (n,) of the attraction's range to the gap next to a contact spot, (16/3) h'^2/h''.

    h' is the root mean square gradient, h'' the root mean square of half the Laplacian. The theory requires a short range, so
    this ratio must be small. It does not depend on sqrt(sigma/R). Source: Monti, Sanner & Pastewka 2021, as restated by the
    authors' group.
    """
    slope = slope_over_sharpness(groups.roughness_parameter)
    return interaction_range(groups) / (16.0 / 3.0 * slope * slope / _CURVATURE)


def stickiness(groups: Groups) -> np.ndarray:
    """Return the ratio (n,) of repulsion to attraction of n rough surfaces; a surface sticks if its ratio is below 1.

    The surfaces are isotropic and Gaussian and have the summits (sigma, R, N) of `groups`. The range of the attraction is the
    equilibrium distance. In units of sigma and with s = sqrt(sigma/R), w/E* = (4/3) s / theta and h'' = sqrt(3 pi/32) s^2,
    where w is the work of adhesion, E* the contact modulus, theta the elastic adhesion index and h'' the root mean square of
    half the Laplacian. The ratio does not depend on s.
    """
    slope = slope_over_sharpness(groups.roughness_parameter)  # h'/s; below also h''/s^2 and (w/E*)/s, so that s cancels
    return stickiness_ratio(slope, _CURVATURE, interaction_range(groups), 4.0 / (3.0 * groups.theta))


RECORD = Criterion(
    key="pastewka_robbins_2014",
    title="Stickiness of a rough surface: attraction around the contact spots against repulsion in them",
    grade="B",
    sources=(
        Source("pastewka_robbins_2014", "eq. (10)", "as the authors' group restates it: kappa = 2, spots 4 h'/h'' wide"),
        Source("nayak_1971", "gradient and curvature of the surface from sigma, R and N"),
    ),
    ratio=stickiness,
    below="the contact sticks: separating the bodies needs a tensile force",
    above="the contact does not stick: it needs a load",
    verified="the same ratio computed in SI units, to rounding",
    needs=("theta", "roughness_parameter", "tabor_parameter"),
    notes="The range of the attraction is taken as the equilibrium distance. It must be short compared with (16/3) h'^2/h'', "
    "the gap next to a contact spot.",
)
