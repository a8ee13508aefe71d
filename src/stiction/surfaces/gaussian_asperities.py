"""Asperities of a Gaussian surface from its spectral moments, and of two surfaces.

McCool (1986) puts the moments m0, m2, m4 into Nayak's statistics of summits (1971); stiction.surfaces.theory.moments has the
relations.
"""

from stiction.quantities.errors import InputError
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.theory.moments import LEAST_BANDWIDTH, SUMMIT_DEFICIT, Moments
from stiction.surfaces.theory.moments import combine as added

LEAST = f"no isotropic Gaussian surface has alpha < {LEAST_BANDWIDTH}"


def of_moments(method: str, moments: Moments, note: str) -> Asperities:
    """Return the summits of the isotropic Gaussian surface with these moments [SI].

    Raises InputError if there is no such surface.
    """
    if not (moments.m2 > 0.0 and moments.m4 > 0.0):
        given = f"m2 = {moments.m2:g}, m4 = {moments.m4:g} 1/m^2"
        raise InputError(f"asperities by {method}", given, "> 0; a flat surface has no asperities")
    alpha = float(moments.alpha)
    if alpha <= SUMMIT_DEFICIT:
        allowed = f"> {SUMMIT_DEFICIT:.4g}; isotropic Gaussian surfaces have 1.5 or more"
        raise InputError(f"asperities by {method}", f"alpha = {alpha:.4g}", allowed)
    deviation, radius, density = (float(one) for one in moments.asperities())
    return Asperities(method, density, deviation, radius, float(moments.summit_height), 0.0, f"{note}; alpha = {alpha:.4g}")


def combine(first: Asperities, second: Asperities) -> Asperities:
    """Return the asperities of the sum of two independent rough surfaces.

    The contact of two rough surfaces is equivalent to the contact of their sum with a smooth surface.

    Heights of independent surfaces add, and so do the moments m0, m2 and m4. Each set of sigma, R and N is converted to the
    moments of a Gaussian surface (McCool 1986). The sum of the moments is converted back. sigma^2 of the heights adds
    exactly. sigma^2 of the summits adds only approximately, the better the larger Nayak's alpha is. Raises InputError as
    `of_moments` does.
    """
    one, other = (Moments.from_asperities(each.deviation, each.radius, each.density) for each in (first, second))
    both = added(one, other)
    warning = f"; {LEAST}" if float(both.alpha) < LEAST_BANDWIDTH else ""
    return of_moments(f"{first.method} and {second.method}", both, f"two surfaces, their moments added{warning}")
