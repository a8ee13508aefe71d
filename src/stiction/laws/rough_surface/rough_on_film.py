r"""Contact area of a rough surface on a film, with the effective modulus of film and body at the size of contact spots.

*Assumes*: a Gaussian isotropic surface without friction and adhesion, and a film bonded to its body. Pressures are limited to
the film's hardness, or to the pressure that the body below a harder film can carry. Materials do not harden. *Source*: this
project's own. It is grade B, because it was compared with solved maps. The pressure limit set by the body below a harder film
was not compared and is grade C. $F$ is the area law of bare surfaces, the formula from spectral moments in
`solvers/boundary_elements/area_estimates.py` (see [`persson_widened`](#persson_widened)). With the nominal pressure $p$ and
the root mean square gradient $h'$, the elastic contact area is

$$
\frac{A_\mathrm{el}}{A_n}=F\!\left(\frac p{E_\mathrm{eff}h'}\right),\qquad
E_\mathrm{eff}^2=\frac{\sum k^2S(k)\,E_P^2(a/t)}{\sum k^2S(k)},\qquad
a=\frac{2.06}k\left(\frac{A_\mathrm{el}}{A_n}\right)^{0.086}\left(\frac{E_f}{E_s}\right)^{-0.047}
$$

solved for $A_\mathrm{el}$. $E_P(a/t)$ is the exact effective modulus of the film on its body for a sphere with the contact
radius $a$, as in [`layered`](#layered); $t$ is the film thickness. Waves of the wavenumber $k$ in the power spectrum $S$ are
assumed to touch the film in spots of the radius $a(k)$, which is fitted to solved maps; $E_f/E_s$ is the modulus of the film
divided by the body's. Weighting the film's compliance at the wavelength itself is not sufficient, because pressures vary over
shorter lengths than heights. With the film's hardness $H_f$, or the pressure that the body below can carry if this is less,

$$
\left(\frac A{A_n}\right)^{3.5}=\left(\frac{A_\mathrm{el}}{A_n}\right)^{3.5}+\left(\frac p{H_f}\right)^{3.5},\qquad A\le A_n
$$

*Spectrum*: $\sigma$, $R$ and $N$ give only the spectral moments. The surface is assumed self-affine, $S\propto k^{-2-2H}$ with
the Hurst exponent $H=0.8$, between two wavelengths that give these moments. If the contact names a scan, the elastic contact
of the map with its film is solved at up to five loads. Between and beyond them the area follows the law above with the
spectrum of the map, and with $F$ from the slopes of the map as in [`persson_widened`](#persson_widened). A map too large to be
solved uses the law alone. The result `area_by` names the method.

*Limit*: the area law of bare surfaces, with the modulus of the bodies for zero film thickness and the modulus of the film for
infinite thickness. *Check*: if film and bodies have the same modulus, the area equals the bare surface's, for example at
$p=0.05\,E^*h'$ and $NR\sigma=0.05$ (Nayak's $\alpha=6.93$); the areas are also equal for a film of ten times the modulus if
$a/t\to\infty$.
"""

import math
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.polynomial.chebyshev import chebval

from stiction.contact.indices import Groups
from stiction.engine.blocks import blocks
from stiction.laws.film.shared.layered_rows import coefficients
from stiction.laws.rough_surface.persson_2001_elastoplastic import hardness_over_slope
from stiction.laws.rough_surface.shared.maps import RESOLVED
from stiction.records.registry import RoughSurface, Validity
from stiction.records.sources import Source
from stiction.solvers.layered.below import pressure_carried_below
from stiction.solvers.layered.curves import TERMS
from stiction.surfaces.theory.moments import bandwidth, reduced_pressure, require_gaussian, slope_over_sharpness
from stiction.surfaces.theory.touching import expected_share

if TYPE_CHECKING:
    from stiction.solvers.boundary_elements.compliance import Compliance
    from stiction.surfaces.heightmap import HeightMap

# Contact radius a times wavenumber k, and the powers of area and modulus in it.
_SIZE, _BY_AREA, _BY_MODULUS = 2.06, 0.086, -0.047
_HURST = 0.8
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)  # Gauss points of a spectrum
# Ratios of largest to smallest wavenumber at which the bandwidth is tabulated.
_RATIOS = np.concatenate([[1.0], 1.0 + np.geomspace(1e-4, 1.0, 60), np.geomspace(2.0, 1e12, 600)[1:]])
_SOLVED_LOADS, _NEARLY_FLAT = 5, 0.98  # loads at which a map with its film is solved, up to this area over the nominal area
_PER_DECADE = 40  # the lightest solved pressure is 10^(k/40), with an integer k
_TO_A_FACTOR_OF_E = 2  # tabulated pressures of the bare area of a map, per factor e
_LEAST_AREA = 1e-300  # replaces an area of 0 in logarithms
_SLOPES = -2.0, -0.5  # limits of the slope of a secant, which near convergence is a quotient of two rounding errors
_STEPS = 40  # largest number of fixed-point steps
_PER_POINT, _IN_CACHE = 10, 25  # memory of a load, and of a wave so that a block fits in the cache, as numbers of points
# Points at which the modulus is interpolated, less half the range of ln(area); largest last term; widening of its range.
_POINTS, _ROUND_OFF, _BEYOND = 11, 2e-14, 0.5
STIFF = 5.0  # film modulus over the bodies' from which on this law is inaccurate for thin films


class Waves(NamedTuple):
    """Hold a spectrum: the wavenumber of each wave and its fraction of the mean square gradient.

    wavevector: (n, m) for n surfaces, or (m,), in the inverse unit of the film thickness. share: same shape, sum 1.
    """

    wavevector: np.ndarray
    share: np.ndarray


def waves_of_moments(density: np.ndarray) -> Waves:
    """Return the spectra of self-affine surfaces whose summits have the given N R sigma; density: N R sigma (n,).

    Spectra k^(-2 - 2 H) extend over wavenumbers k_l to k_s = z k_l in 1/sqrt(R sigma); H: Hurst exponent; M_n: integral of
    k^(n - 1 - 2 H) over k. Nayak's alpha = (3/2) M_0 M_4/M_2^2 gives z; m4/m2 = (3/4) M_4/M_2 = 6 pi sqrt(3) N gives k_s.
    """
    log_ratio = np.interp(np.log(bandwidth(density)), _log_bandwidths(), np.log(_RATIOS))[:, None]
    log_k = 0.5 * (_NODES - 1.0) * log_ratio  # ln k/k_s
    share = _WEIGHTS * np.exp((2.0 - 2.0 * _HURST) * log_k)
    share /= share.sum(axis=1, keepdims=True)
    mean_square = np.sum(share * np.exp(2.0 * log_k), axis=1, keepdims=True)  # M_4/M_2 over k_s^2
    shortest = np.sqrt(8.0 * math.pi * math.sqrt(3.0) * density[:, None] / mean_square)
    return Waves(shortest * np.exp(log_k), share)


@cache
def _log_bandwidths() -> np.ndarray:
    """Return the logarithm of Nayak's bandwidth parameter for each ratio of largest to smallest wavenumber in _RATIOS."""
    log = np.log(_RATIOS)

    def moment(order: float) -> np.ndarray:
        power = order - 2.0 * _HURST
        return np.where(log > 0.0, np.expm1(power * log) / power, log)

    with np.errstate(invalid="ignore", divide="ignore"):
        log_bandwidths = np.log(1.5 * moment(0.0) * moment(4.0) / moment(2.0) ** 2)
    log_bandwidths[0] = math.log(1.5)
    return log_bandwidths


def thickness_over_wave(groups: Groups) -> np.ndarray:
    """Return the ratio (n,) of the thickness of one film to the shortest wavelength of the surface."""
    shortest = waves_of_moments(groups.roughness_parameter).wavevector[:, -1]
    return groups.film_aspect / groups.films * shortest / (2.0 * math.pi)


def sphere_modulus(curve: np.ndarray, n_E: np.ndarray, a_over_t: np.ndarray) -> np.ndarray:
    """Return the effective modulus E_P (n, H, m) for a sphere on a film, divided by the modulus of the bodies without film.

    curve: coefficients (n, TERMS) of the curve of E_P. n_E (n,): film modulus divided by the modulus of the bodies without
    film. a_over_t (n, H, m): contact radius divided by film thickness.
    """
    z = 1.0 - 2.0 / (np.sqrt(a_over_t) + 1.0)
    sums = np.zeros_like(z)
    for term in range(TERMS - 1, -1, -1):
        sums *= z  # in place: new arrays of this size would take half of the time
        sums += curve[:, term, None, None]
    return np.exp(0.5 * (1.0 - z) * np.log(n_E)[:, None, None] + (1.0 - z * z) * sums)


def area_of_waves(
    pressure: np.ndarray, bare: Callable[[np.ndarray], np.ndarray], waves: Waves, thickness: np.ndarray, groups: Groups
) -> np.ndarray:
    """Return the ratio (n, H) of elastic contact area to nominal area for a rough surface on a film, at H pressures.

    pressure (n, H): nominal pressure divided by E* h', >= 0, with the contact modulus E* of the bodies without film and the
    root mean square gradient h'. bare: function that returns the area without film at this pressure. waves: spectrum of the
    surface. thickness (n,): thickness of one film, in the unit of the waves. groups: groups with all defaults filled in.
    """
    curve, n_E = coefficients(groups)[:, 0], np.broadcast_to(groups.n_E, len(pressure))
    k = np.broadcast_to(waves.wavevector, (len(pressure), np.shape(waves.wavevector)[-1]))[:, None, :]
    share = np.broadcast_to(waves.share, k[:, 0].shape)[:, None, :]
    with np.errstate(divide="ignore"):
        width = (_SIZE * n_E**_BY_MODULUS / thickness)[:, None, None] / k  # a/t of the whole area

    def modulus_at(log_area: np.ndarray) -> np.ndarray:
        size, each = np.exp(_BY_AREA * log_area)[..., None], blocks(len(width), _IN_CACHE * log_area[0].size * k.shape[-1])
        moduli = ((share[some], sphere_modulus(curve[some], n_E[some], width[some] * size[some])) for some in each)
        return np.sqrt(np.concatenate([np.sum(part * modulus**2, axis=-1) for part, modulus in moduli]))

    def log_bare(pressure: np.ndarray) -> np.ndarray:
        return np.log(np.maximum(bare(pressure), _LEAST_AREA))

    if pressure.shape[1] > 2:  # for fewer pressures it is faster to compute the modulus in every step
        least, most = _BEYOND * np.minimum(n_E, 1.0)[:, None], np.maximum(n_E, 1.0)[:, None] / _BEYOND
        smallest = np.where(pressure > 0.0, pressure, np.inf).min(axis=1, keepdims=True)
        largest = pressure.max(axis=1, keepdims=True)
        modulus_at = _interpolated(modulus_at, log_bare(np.minimum(smallest, largest) / most), log_bare(largest / least))
    guess, last_guess, last_change = log_bare(pressure), *np.full((2, *pressure.shape), np.nan)
    for _ in range(_STEPS):
        area = bare(pressure / modulus_at(guess))
        change = np.log(np.maximum(area, _LEAST_AREA)) - guess
        if np.all(np.abs(change) <= 1e-14 * np.maximum(np.abs(guess), 1.0)):
            break
        # The radius depends on the area to the power 0.086, so a plain step leaves a tenth of the error, a secant step less.
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = (change - last_change) / (guess - last_guess)
        last_guess, last_change = guess, change
        guess = guess - change / np.clip(np.where(np.isnan(slope), -1.0, slope), *_SLOPES)
    return area


def _interpolated(function: Callable[[np.ndarray], np.ndarray], low: np.ndarray, high: np.ndarray) -> Callable:
    """Return a function that approximates the positive function `function` between the limits low and high (n, 1).

    It interpolates ln(function) by Chebyshev polynomials, one for each row, and clips its argument (n, H) to the limits; limits
    less than 2 apart are first widened to 2 about their middle. `function` itself is returned if round-off is not reached.
    """
    middle, half = 0.5 * (high + low), np.maximum(0.5 * (high - low), 1.0)
    points = _POINTS + math.ceil(half.max())
    angles = (np.arange(points) + 0.5) * math.pi / points
    terms = np.cos(np.outer(np.arange(points), angles)) @ np.log(function(middle + half * np.cos(angles))).T * (2.0 / points)
    terms[0] *= 0.5
    if not np.abs(terms[-2:]).max() <= _ROUND_OFF:
        return function
    return lambda x: np.exp(chebval(np.clip((x - middle) / half, -1.0, 1.0), terms[..., None], tensor=False))


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the area per asperity (n, H), in pi R sigma, at loads (n, H) in K R^(1/2) sigma^(3/2); it is 0 under tension.

    Raises InputError if no isotropic Gaussian surface has the N R sigma of a contact.
    """
    resolved = groups.resolved()
    require_gaussian(resolved.roughness_parameter)
    return np.concatenate([_area(load[rows], resolved[rows]) for rows in blocks(len(load), _PER_POINT * load.shape[1])])


def _area(load: np.ndarray, groups: Groups) -> np.ndarray:
    density = groups.roughness_parameter[:, None]
    pressure = reduced_pressure(np.maximum(load, 0.0), density)
    return _flowing(elastic_share(pressure, groups), pressure, groups) / (math.pi * density)


def elastic_share(pressure: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the ratio (n, H) of contact area to nominal area for elastic contacts on a film, at H pressures of n contacts.

    pressure (n, H): nominal pressure divided by E* h', >= 0; E*: contact modulus without film, h': root mean square gradient.
    """
    from stiction.surfaces.theory.widened_area import of_moments  # slow to import

    alpha, waves = bandwidth(groups.roughness_parameter[:, None]), waves_of_moments(groups.roughness_parameter)
    return area_of_waves(pressure, lambda p: of_moments(p, alpha), waves, _thickness(groups), groups)


def _flowing(elastic: np.ndarray, pressure: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the ratio (n, H) of contact area to nominal area after plastic flow has limited the contact pressure.

    elastic (n, H): the same ratio without this limit. pressure (n, H): nominal pressure divided by E* h'. The limit is the film
    hardness, or the pressure that the body below carries through the film if that pressure is lower. This pressure depends
    on the mean size of a contact spot, which is computed from the number of asperities in contact.
    """
    from stiction.surfaces.theory.widened_area import with_hardness  # slow to import

    density, unit = math.pi * groups.roughness_parameter[:, None], hardness_over_slope(groups)[:, None]
    share, hardest = elastic, np.reshape(groups.n_H, (-1, 1))
    if not np.any(hardest > 1.0):  # the body below carries at least its own hardness
        return with_hardness(elastic, pressure, unit * hardest)
    for _ in range(_STEPS):
        area = share / density
        touching = expected_share(area)
        spot = np.divide(area, touching, where=touching > 0.0, out=np.zeros(area.shape))
        hardness = np.minimum(hardest, pressure_carried_below(spot, groups))
        share, before = with_hardness(elastic, pressure, unit * hardness), share
        if np.all(np.abs(share - before) <= 1e-14 * share):
            break
    return share


def _thickness(groups: Groups) -> np.ndarray:
    """Return the thickness of one film in units of sqrt(R sigma) (n,), half of the total if both bodies are coated."""
    return np.broadcast_to(groups.film_aspect / groups.films, len(groups))


def area_on_map(load: np.ndarray, groups: Groups, surface: "HeightMap") -> np.ndarray:
    """Return the contact area per asperity (n, H) at H loads of n coated contacts, from a map of both faces.

    Units: load per asperity in K R^(1/2) sigma^(3/2), area in pi R sigma. The elastic contact of the map with its film is
    solved at up to five loads, unless the map is too large. Between and beyond them, the area law is used with the spectrum and
    the bare contact area of the map. All contacts have the same map. The area is 0 under tension.
    """
    resolved, density = groups.resolved(), groups.roughness_parameter[:, None]
    pressure = reduced_pressure(np.maximum(load, 0.0), density)
    slopes = groups.sharpness * slope_over_sharpness(groups.roughness_parameter)
    elastic = np.array([_elastic_on_map(p, resolved[i : i + 1], surface, float(slopes[i])) for i, p in enumerate(pressure)])
    return _flowing(elastic, pressure, resolved) / (math.pi * density)


def waves_of_map(surface: "HeightMap", groups: Groups) -> Waves:
    """Return the spectrum of a map for one contact, with wavenumbers in units of 1/sqrt(R sigma) of the map."""
    from stiction.surfaces.spectrum import power_spectrum, radial_average  # slow to import

    spectrum = radial_average(power_spectrum(surface, "none" if surface.periodic else "hann"))
    power = spectrum.wavevector**2 * spectrum.density * spectrum.waves
    return Waves(spectrum.wavevector * _unit(surface, groups), power / power.sum())


def _unit(surface: "HeightMap", groups: Groups) -> float:
    """Return sqrt(R sigma) [m] of a map, from its moments and the dimensionless groups of one contact."""
    from stiction.surfaces.finding import length_unit  # slow to import

    return float(length_unit(surface, _single(groups.roughness_parameter)))


def compliance_of(groups: Groups, surface: "HeightMap") -> "Compliance":
    """Return the compliance of film and bodies of one contact, for the boundary-element solver.

    It is scaled so that the contact modulus of both bodies without film is 1. Lengths are in m.
    """
    from stiction.solvers.boundary_elements.compliance import Compliance, Film  # slow to import

    share, thickness = _single(groups.coated_share), _single(_thickness(groups)) * _unit(surface, groups)
    film, nu = _single(groups.film_modulus), _single(groups.layer_nu)

    def on(body: float, body_nu: float) -> Film:
        modulus = math.inf if body <= 0.0 else (1.0 - body_nu**2) / body
        return Film(thickness, film * (1.0 - nu**2), nu, modulus, body_nu)

    first, second = on(share, _single(groups.coated_nu)), on(1.0 - share, _single(groups.counter_nu))
    if _single(groups.films) == 2.0:
        return Compliance(math.inf, first, second)
    return Compliance(math.inf if share >= 1.0 else 1.0 / (1.0 - share), first)


def _elastic_on_map(pressure: np.ndarray, groups: Groups, surface: "HeightMap", slope: float) -> np.ndarray:
    """Return the ratio (H,) of elastic contact area to nominal area for one coated contact with a map.

    pressure (H,): nominal pressure divided by E* h'. slope: root mean square gradient h'. Contacts with the film are solved at
    up to five loads, or at none if the map is too large. The ratio of their areas to the area law is interpolated over the
    logarithm of the pressure. Where too few points touch, the ratio at the lightest solvable pressure 10^(k/40) is used.
    """
    from scipy.interpolate import PchipInterpolator

    from stiction.solvers.boundary_elements.map_area import AT_LEAST, map_area  # slow to import

    waves, thickness, n_E = waves_of_map(surface, groups), _thickness(groups), _single(groups.n_E)

    def law(p: np.ndarray) -> np.ndarray:
        return area_of_waves(p[None], _bare_curve(surface, p, slope, n_E), waves, thickness, groups)[0]

    area, points = law(pressure), map_area(surface)
    some = np.unique(np.log(pressure[(pressure > 0.0) & (area < _NEARLY_FLAT)]))
    if not (some.size and points.solvable):
        return area
    nodes = np.exp(some if some.size <= _SOLVED_LOADS else np.linspace(some[0], some[-1], _SOLVED_LOADS))
    lightest = 10.0 ** (math.floor(_PER_DECADE * math.log10(nodes[0])) / _PER_DECADE)
    while float(law(np.array([lightest]))[0]) * points.finest_points < AT_LEAST:
        lightest *= 10.0 ** (1.0 / _PER_DECADE)
    of_law = law(nodes := np.unique(np.maximum(nodes, lightest)))
    solved = points.solved_with(compliance_of(groups, surface), nodes * slope, of_law)
    if not (there := np.isfinite(solved)).any():
        return area
    x, y = np.log(nodes[there]), np.log(solved[there] / of_law[there])
    log_pressure = np.clip(np.log(np.maximum(pressure, 1e-300)), x[0], x[-1])
    return np.minimum(area * np.exp(PchipInterpolator(x, y)(log_pressure) if x.size > 1 else y[0]), 1.0)


def _bare_curve(surface: "HeightMap", pressure: np.ndarray, slope: float, n_E: float) -> Callable[[np.ndarray], np.ndarray]:
    """Return a function that gives the ratio of contact area to nominal area for a map without film.

    Its argument is the nominal pressure divided by E* h'. It interpolates a formula based on the slopes of the map, for all
    pressures that films with the modulus ratio n_E may need. pressure: with the film, divided by E* h'. slope: rms gradient h'.
    """
    from scipy.interpolate import PchipInterpolator

    from stiction.solvers.boundary_elements.map_area import map_area  # slow to import

    if not (some := pressure[pressure > 0.0]).size:
        return np.zeros_like
    area = map_area(surface)
    low, high = 0.5 * float(some.min()) / max(n_E, 1.0), 2.0 * float(some.max()) / min(n_E, 1.0)
    ends = _TO_A_FACTOR_OF_E * np.log([low, high]) + [-3.0, 4.0]  # whole numbers of steps: the same points for all loads
    log_pressure = np.arange(*np.floor(ends)) / _TO_A_FACTOR_OF_E
    of_map = slope / area.slopes.gradient
    curve = PchipInterpolator(log_pressure, np.log([area.by_formula(p * of_map, math.inf) for p in np.exp(log_pressure)]))

    def bare(p: np.ndarray) -> np.ndarray:
        return np.where(p > 0.0, np.exp(curve(np.log(np.clip(p, low, high)))), 0.0)

    return bare


def _single(value: np.ndarray) -> float:
    """Convert a dimensionless group of a single contact, an array of one element, to a float."""
    return float(np.ravel(value)[0])


WAYS = (
    "formula from spectral moments, for a Gaussian, isotropic, self-affine surface",
    "solution of the contact of the map with its film or, if the map is too large, a formula from its slopes and spectrum",
)

RECORD = RoughSurface(
    key="rough_on_film",
    title="Elastic-plastic contact area of a rough surface on a film, with an effective modulus of film and body",
    grade="B",
    sources=(
        Source("persson_2001", "", "the form of the area law of bare surfaces, increased here by a fit to solved maps"),
        Source("perriot_barthel_2004", "", "the sphere on a film, whose effective modulus is averaged over the spectrum here"),
        Source("nayak_1971", "", "spectral moments of the surface from sigma, R and N"),
    ),
    area_at_load=area_at_load,
    area_on_map=area_on_map,
    way=lambda surface: WAYS[surface is not None],
    takes_surface_moments=True,
    on_film=True,
    up_to_full_contact=True,
    verified="maps on a film solved by boundary elements, elastic and with hardness; limits of zero and infinite thickness",
    needs=(
        "hardness_group", "roughness_parameter", "nu", "n_E", "n_H", "film_aspect", "films", "coated_share", "layer_nu",
        "coated_nu", "counter_nu",
    ),
    validity=(
        RESOLVED,
        Validity("n_E", 0.1, 10.0, "the law was compared with solved maps only for these films", "fit"),
        Validity("stiff_film_over_wave", 0.15, math.inf, "the contact area is inaccurate under such a thin, stiff film"),
    ),
    notes="The pressure is limited to the film's hardness or to the pressure that the body below a harder film can carry, "
    "whichever is smaller. The higher pressure of a soft film confined by a hard body is not included. For a surface given by "
    "sigma, R and N the spectrum is self-affine with the Hurst exponent 0.8; for a scan it is the spectrum of its map.",
)  # fmt: skip
