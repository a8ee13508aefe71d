"""Relate the spectral moments of an isotropic Gaussian surface to its summits.

The moments m0, m2, m4 are the mean squares of height, slope and second derivative along a line. The summits have a standard
deviation sigma of their heights, a mean tip radius R and a number N per area. m0, m2 and m4 determine sigma, R and N, and vice
versa. Nayak (1971) derived the statistics of the summits. McCool (1986) uses the summits as asperities. Papers on other
asperity models give the same conversion with N R sigma:

    sigma^2 = m0 - 3.717e-4 / (N R)^2,   mean height of the summits = 0.045944 / (N R).

Common errors: m2 and m4 are those of a profile along a line. The mean square gradient is 2 m2 and the mean square Laplacian
is 8 m4 / 3. The mean curvature of the summits depends on m4 alone, (8/3) sqrt(m4 / pi); a formula with m4 / m2 is wrong. The
separations measured from the mean plane and from the mean of the summits differ by `summit_height`. This package measures from
the mean of the summits.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from stiction.quantities.errors import InputError

# The variance of the summit heights is m0 (1 - SUMMIT_DEFICIT / alpha); 0.8968 in print. The closed form follows from Nayak's
# density: the mean curvature kappa of a summit has E[kappa^2] = m4 (4/sqrt(3) + 2/9) and E[kappa] = (8/3) sqrt(m4/pi).
SUMMIT_DEFICIT = 1.0 + 16.0 / math.pi - 3.0 * math.sqrt(3.0)

# m0 m4 / m2^2 of an isotropic Gaussian surface is at least 3/2, where height and curvature are in proportion (Nayak 1971).
LEAST_BANDWIDTH = 1.5

# alpha = 768 pi (N R sigma)^2 + SUMMIT_DEFICIT, by putting `from_asperities` into m0 m4 / m2^2; 768 pi = 2412.74.
_BANDWIDTH_FACTOR = 768.0 * math.pi

# Below this N R sigma, the summit heights would scatter less than those of any isotropic Gaussian surface.
LEAST_DENSITY = math.sqrt((LEAST_BANDWIDTH - SUMMIT_DEFICIT) / _BANDWIDTH_FACTOR)


@dataclass(frozen=True)
class Moments:
    """Store the spectral moments m0, m2, m4 of an isotropic surface along a profile, as numbers or arrays.

    m0: mean square height [m^2]. m2: mean square slope [1]. m4: mean square second derivative [1/m^2]. Any other unit of
    length may replace the metre.
    """

    m0: Any
    m2: Any
    m4: Any

    @classmethod
    def from_asperities(cls, deviation, radius, density) -> "Moments":
        """Return the spectral moments of the Gaussian surface whose summits have these statistics.

        deviation: standard deviation sigma of the summit heights [m]. radius: R, one over the mean curvature of the summits
        [m]. density: summits per area N [1/m^2]. All may be arrays. Source: McCool 1986, solved for the moments; the relations
        for R and N are from Nayak (1971).
        """
        m4 = 9.0 * math.pi / (64.0 * radius * radius)
        m2 = m4 / (6.0 * math.pi * math.sqrt(3.0) * density)
        return cls(deviation * deviation + SUMMIT_DEFICIT * m2 * m2 / m4, m2, m4)

    @classmethod
    def from_groups(cls, density, sharpness) -> "Moments":
        """Return the spectral moments of a surface, with sigma as the unit of length, from dimensionless groups.

        density: N R sigma. sharpness: sqrt(sigma/R). For the summits of the surface, sigma is the standard deviation of
        their heights, R their radius and N their number per area.
        """
        radius = 1.0 / (sharpness * sharpness)
        return cls.from_asperities(1.0, radius, density / radius)

    @property
    def alpha(self):
        """Return Nayak's bandwidth parameter alpha = m0 m4 / m2^2 of the surface.

        It is 3/2 if all waves have one wavelength, and large for a broad spectrum.
        """
        return self.m0 * self.m4 / (self.m2 * self.m2)

    @property
    def rms_slope(self):
        """Return the rms gradient of the surface, sqrt(2 m2)."""
        return np.sqrt(2.0 * self.m2)

    @property
    def rms_curvature(self):
        """Return the rms of half the Laplacian of the surface, sqrt(2 m4 / 3)."""
        return np.sqrt(2.0 / 3.0 * self.m4)

    @property
    def summit_height(self):
        """Return the mean height of the summits above the mean plane, 4 sqrt(m0 / (pi alpha)), with Nayak's alpha.

        Source: Nayak 1971.
        """
        return 4.0 * self.m2 / np.sqrt(math.pi * self.m4)

    def asperities(self):
        """Return the standard deviation sigma of the summit heights, their mean tip radius R and their number N per area.

        sigma is NaN for alpha below 0.8968. Source: Nayak 1971, McCool 1986.
        """
        deviation = np.sqrt(self.m0 - SUMMIT_DEFICIT * self.m2 * self.m2 / self.m4)
        radius = 3.0 / 8.0 * np.sqrt(math.pi / self.m4)
        return deviation, radius, self.m4 / self.m2 / (6.0 * math.pi * math.sqrt(3.0))


def combine(first: Moments, second: Moments) -> Moments:
    """Return the spectral moments of the sum of two independent surfaces: the sums of their moments.

    The gap between two rough bodies has these moments. The moments of both surfaces must include the same wavelengths.
    """
    return Moments(first.m0 + second.m0, first.m2 + second.m2, first.m4 + second.m4)


def bandwidth(density):
    """Return Nayak's bandwidth parameter alpha of a Gaussian surface from its summits; density: N R sigma."""
    return _BANDWIDTH_FACTOR * density * density + SUMMIT_DEFICIT


def density_of_bandwidth(alpha):
    """Return N R sigma of the summits of a Gaussian surface from Nayak's bandwidth parameter alpha >= 3/2.

    This function inverts `bandwidth`.
    """
    return np.sqrt((alpha - SUMMIT_DEFICIT) / _BANDWIDTH_FACTOR)


def summit_height(density):
    """Return the mean height of the summits above the mean plane, divided by the standard deviation sigma of their heights.

    It is 1 / (sqrt(48) pi N R sigma). density: N R sigma, with the tip radius R and the number N of summits per area.
    """
    return 1.0 / (math.sqrt(48.0) * math.pi * density)


def slope_over_sharpness(density):
    """Return the rms gradient of a Gaussian surface divided by sqrt(sigma/R): (sqrt(3) / (64 N R sigma))^(1/2).

    density: N R sigma of its summits.
    """
    return np.sqrt(math.sqrt(3.0) / (64.0 * density))


def reduced_pressure(load, density):
    """Return the reduced pressure p / (E* h') of a contact: load per nominal area divided by contact modulus and rms gradient.

    load: load per asperity divided by K R^(1/2) sigma^(3/2), with K = (4/3) E*. density: N R sigma, same shape. The result is
    (4/3) N R sigma sqrt(sigma/R) load / h'. sigma/R cancels, because h' is proportional to sqrt(sigma/R).
    """
    return 4.0 / 3.0 * density * load / slope_over_sharpness(density)


def require_gaussian(density: np.ndarray) -> None:
    """Raise InputError if N R sigma of some asperities is below LEAST_DENSITY, too small for any isotropic Gaussian surface.

    density: N R sigma, an array.
    """
    small = density < LEAST_DENSITY
    if small.any():
        raise InputError(
            "roughness_parameter",
            float(density[small][0]),
            f">= {LEAST_DENSITY:.4g}, the least N R sigma of an isotropic Gaussian surface (bandwidth 3/2 or more)",
        )
