"""Compute the asperities of a Gaussian surface from its spectral moments, and of the sum of two surfaces.

McCool (1986) puts the spectral moments m0, m2, m4 (mean squares of height, slope and second derivative along a profile) into
Nayak's statistics of summits (1971). The relations are in stiction.surfaces.theory.moments.
"""

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.theory.moments import LEAST_BANDWIDTH, SUMMIT_DEFICIT, Moments
from stiction.surfaces.theory.moments import combine as added

LEAST = f"isotropic Gaussian surfaces have a bandwidth parameter alpha of {LEAST_BANDWIDTH} or more"


def of_moments(method: str, moments: Moments, note: str) -> Asperities:
    """Return the asperities of the isotropic Gaussian surface with these spectral moments: its summits.

    method: key of the asperity method, for the result. moments: m0 [m^2], m2 [1] and m4 [1/m^2]. note: origin of the moments,
    in words. Isotropic Gaussian surfaces have alpha = m0 m4/m2^2 of 1.5 or more; smaller values are accepted without a warning.
    Raises InputError if m2 or m4 is not above 0, or alpha is 0.897 or less.
    """
    if not (moments.m2 > 0.0 and moments.m4 > 0.0):
        given = f"m2 = {moments.m2:g}, m4 = {moments.m4:g} 1/m^2"
        raise InputError(f"asperities by {method}", given, "> 0; a flat surface has no asperities")
    alpha = float(moments.alpha)
    if alpha <= SUMMIT_DEFICIT:
        allowed = f"> {SUMMIT_DEFICIT:.4g}; isotropic Gaussian surfaces have 1.5 or more"
        raise InputError(f"asperities by {method}", InWords(f"alpha = {alpha:.4g}"), allowed)
    deviation, radius, density = (float(one) for one in moments.asperities())
    return Asperities(method, density, deviation, radius, float(moments.summit_height), 0.0, f"{note}; alpha = {alpha:.4g}")


def combine(first: Asperities, second: Asperities) -> Asperities:
    """Return the asperities of the sum of two independent rough surfaces.

    The contact of two rough surfaces is equivalent to the contact of their sum with a smooth plane. The spectral moments m0, m2
    and m4 of independent surfaces add. Each set of sigma, R and N is converted to the moments of a Gaussian surface (McCool
    1986), and the sums are converted back. The variance of the surface heights adds exactly. The variance sigma^2 of the summit
    heights adds only approximately; the error falls as Nayak's alpha grows. No isotropic Gaussian surface has alpha below 1.5;
    if the sums do, the note of the result contains a warning. Raises InputError for alpha of 0.897 or less.
    """
    one, other = (Moments.from_asperities(each.deviation, each.radius, each.density) for each in (first, second))
    both = added(one, other)
    warning = f"; {LEAST}" if float(both.alpha) < LEAST_BANDWIDTH else ""
    return of_moments(f"{first.method} and {second.method}", both, f"two surfaces, their moments added{warning}")
