"""Asperities that a surface would have if it were Gaussian, isotropic but for a stretch: McCool's, from spectral moments.

No asperity is looked for. The mean squares of height, slope and second derivative along profiles (m0, m2, m4), put into Nayak's
statistics (1971) as McCool (1986) does, give sigma, R and N; stiction.surfaces.theory.moments has the relations.
"""

from stiction.quantities.errors import InputError
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.statistics import combine as added
from stiction.surfaces.statistics import moments_by_differences
from stiction.surfaces.theory.moments import LEAST_BANDWIDTH, SUMMIT_DEFICIT, Moments


def mccool(surface: HeightMap, cutoff: float | None = None) -> Asperities:
    """Summits of the Gaussian surface with the moments of this one, by finite differences; isotropic, or stretched (a lay).

    cutoff: [m], as of `moments_by_differences`, by default two pitches. Differences see less of the waves near the cutoff than
    there is; for moments by the spectrum see `of_moments`. InputError as of both, and for grooves all along one line.
    """
    moments = moments_by_differences(surface, cutoff).equivalent
    if moments is None:
        raise InputError("asperities by mccool", "slopes along one line only", "a surface with summits, not grooves")
    return of_moments("mccool", moments, "from moments by finite differences")


def of_moments(method: str, moments: Moments, note: str) -> Asperities:
    """The summits of the isotropic Gaussian surface with these moments [SI]. InputError if there is none."""
    if not (moments.m2 > 0.0 and moments.m4 > 0.0):
        given = f"m2 = {moments.m2:g}, m4 = {moments.m4:g} 1/m^2"
        raise InputError(f"asperities by {method}", given, "> 0: a surface that is not flat")
    alpha = float(moments.alpha)
    if alpha <= SUMMIT_DEFICIT:
        allowed = f"> {SUMMIT_DEFICIT:.4g}; isotropic Gaussian surfaces have 1.5 or more"
        raise InputError(f"asperities by {method}", f"alpha = {alpha:.4g}", allowed)
    notes = [f"{note}; alpha = {alpha:.4g}"]
    if alpha < LEAST_BANDWIDTH:
        notes.append(f"no isotropic Gaussian surface has alpha < {LEAST_BANDWIDTH}")
    deviation, radius, density = (float(one) for one in moments.asperities())
    return Asperities(method, density, deviation, radius, float(moments.summit_height), 0.0, "; ".join(notes))


def combine(first: Asperities, second: Asperities) -> Asperities:
    """Asperities of the sum of two independent rough surfaces: one smooth surface against it is like the two together.

    Heights of independent surfaces add, and so do m0, m2 and m4. Each set of sigma, R and N is turned into the moments of the
    Gaussian surface that has it (McCool 1986), and their sum back. sigma^2 of the heights adds exactly; that of the summits
    does so as far as Nayak's alpha is large. InputError as of `of_moments`.
    """
    one, other = (Moments.from_asperities(each.deviation, each.radius, each.density) for each in (first, second))
    return of_moments(f"{first.method} and {second.method}", added(one, other), "two surfaces, their moments added")
