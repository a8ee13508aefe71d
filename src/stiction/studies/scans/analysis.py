"""Everything that is said of one scan: prepared, with statistics, spectrum, moments and the asperities by every method."""

import math
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from stiction.laws.finding import Asperities, asperities, methods
from stiction.quantities.errors import InputError
from stiction.surfaces.height_model import HeightModel, height_model
from stiction.surfaces.heightmap import HeightMap, metres
from stiction.surfaces.prepare import fill_missing, filter_band, filter_period, level, remove_form
from stiction.surfaces.spectrum import BinnedSpectrum, power_spectrum, radial_average
from stiction.surfaces.spikes import mask_spikes
from stiction.surfaces.spikes import spikes as spikes_of
from stiction.surfaces.statistics import ProfileMoments, Statistics, moments_by_differences, moments_by_spectrum, statistics
from stiction.surfaces.theory.moments import Moments

__all__ = ["Analysis", "analyse", "prepared", "spectrum_rows", "summary"]

_APART = 5.0  # steps from end to end of one period over those of neighbours: no period has such


@dataclass(frozen=True)
class Analysis:
    """What is said of a scan.

    surface: as prepared. statistics; spectrum: radial average of it; of_spectrum: how its gaps were filled for that, if there
    are any. spikes: how many points are SUSPICIOUS robust deviations from the median. by_differences, by_spectrum: spectral
    moments, both with the same cutoff. asperities: method -> what was found; heights: method -> their distribution; failures:
    method -> why nothing was found.
    """

    surface: HeightMap
    statistics: Statistics
    spectrum: BinnedSpectrum
    of_spectrum: str
    spikes: int
    by_differences: ProfileMoments
    by_spectrum: ProfileMoments
    asperities: dict[str, Asperities]
    heights: dict[str, HeightModel]
    failures: dict[str, str]


def prepared(
    surface: HeightMap,
    form: int = 1,
    spikes: float | None = None,
    fill: str | None = None,
    shortest: Any = None,
    longest: Any = None,
) -> HeightMap:
    """The scan without its form and without the waves outside of a band.

    surface: heights in metres, as `read_scan` gives them. form: order of the polynomial taken off, 1 for the mean plane, 0
    for nothing. spikes: points further from the median of the levelled heights than so many robust deviations are masked
    before that; None for none. fill: "harmonic" or "nearest" fills missing points, None leaves them missing. shortest,
    longest: ends of the band, metres or text with a unit; None for no end. Raises InputError.
    """
    raw = surface
    if spikes is not None:
        surface = mask_spikes(level(surface), spikes)
    if form == 1:
        surface = level(surface)
    elif form > 1:
        surface = remove_form(surface, order=form)
    _check_left(raw, surface)
    if fill is not None:
        surface = fill_missing(surface, fill)
    return surface if shortest is None and longest is None else filter_band(surface, shortest, longest)


def prepared_period(
    surface: HeightMap, spikes: float | None = None, fill: str | None = None, shortest: Any = None, longest: Any = None
) -> HeightMap:
    """One period of a surface without end, without its mean and the waves outside of a band: it stays a period.

    It has no form. The rest as in `prepared`; missing points are left, unless filled, and then no band is taken.
    """
    if spikes is not None:
        surface = mask_spikes(surface, spikes)
    if fill is not None:
        surface = fill_missing(surface, fill)
    if surface.complete and (shortest is not None or longest is not None):
        surface = filter_period(surface, shortest, longest)
    return surface.with_heights(surface.heights - np.nanmean(surface.heights), f"mean removed{_seam(surface)}")


def _seam(surface: HeightMap) -> str:
    """A word where the ends of what is said to be one period do not meet: where its mean square step from one end to the other,
    along rows or columns, is much larger than that of neighbours within."""
    heights = surface.heights
    far = 0.0
    for axis in (axis for axis in (0, 1) if heights.shape[axis] > 1):
        within = float(np.nanmean(np.square(np.diff(heights, axis=axis))))
        across = np.square(np.take(heights, 0, axis=axis) - np.take(heights, -1, axis=axis))
        if np.isfinite(across).any() and within > 0.0:
            far = max(far, math.sqrt(float(np.nanmean(across)) / within))
    if far < _APART:
        return ""
    return f", as of one period; but its ends do not meet: steps between them are {far:.0f} times those between neighbours"


def _check_left(raw: HeightMap, surface: HeightMap) -> None:
    """InputError if what is left without form and spikes is no more than the rounding of the heights."""
    if surface is raw or not np.isfinite(surface.heights).any():
        return
    before, after = (float(np.nanmax(one.heights) - np.nanmin(one.heights)) for one in (raw, surface))
    offset = max(abs(float(np.nanmax(raw.heights))), abs(float(np.nanmin(raw.heights))))
    if after <= 1e-12 * before + 8.0 * np.finfo(float).eps * offset:
        raise InputError("scan", f"{surface.name}: heights that are all form", "heights that differ without their form")


def analyse(surface: HeightMap, progress: Callable[[Iterable], Iterable] = iter, tip_radius: Any = None) -> Analysis:
    """Statistics, spectrum, moments and asperities of a prepared scan.

    surface: heights in metres, as `prepared` gives them. progress: wraps the list of steps. tip_radius: of the stylus, metres
    or text with a unit: ends the reliable band of the spectrum where it could not follow. Raises InputError.
    """
    tip = None if tip_radius is None else metres(tip_radius, "tip_radius")
    found: dict[str, Any] = {"spikes": int(np.count_nonzero(spikes_of(surface)))}
    each: dict[str, Asperities] = {}
    failures: dict[str, str] = {}

    def spectral() -> None:
        filled = surface if surface.complete else fill_missing(surface)
        found["of_spectrum"] = "" if surface.complete else filled.history[-1]
        whole = power_spectrum(filled)
        found["spectrum"] = radial_average(whole, tip_radius=tip)
        found["by_spectrum"] = moments_by_spectrum(whole)

    def search(method: str) -> Callable[[], None]:
        def run() -> None:
            try:
                each[method] = asperities(surface, method)
            except InputError as error:
                failures[method] = str(error)

        return run

    def described() -> None:
        found["statistics"] = statistics(surface)
        found["by_differences"] = moments_by_differences(surface)

    for step in progress([described, spectral, *map(search, methods())]):
        step()
    heights = {method: height_model(one) for method, one in each.items()}
    return Analysis(surface, **found, asperities=each, heights=heights, failures=failures)


def summary(analysis: Analysis) -> dict[str, Any]:
    """The analysis as plain numbers in SI units, for JSON."""
    surface = analysis.surface
    rows, columns = surface.heights.shape
    return {
        "name": surface.name,
        "Sq": analysis.statistics.Sq,
        "size": {"x": surface.size[1], "y": None if surface.is_profile else surface.size[0]},
        "pixels": {"x": columns, "y": rows},
        "missing_points": surface.missing,
        "suspected_spikes": analysis.spikes,
        "units": {"lengths": "m", "N": "1/m^2", "m0": "m^2", "m2": "1", "m4": "1/m^2", "curvatures": "1/m"},
        "statistics": asdict(analysis.statistics),
        "spectrum_of": analysis.of_spectrum or "the heights as prepared",
        "reliable_band": _band(analysis.spectrum),
        "moments": {
            one.method: _moments(one.isotropic)
            | {"cutoff": one.cutoff, "equivalent": one.equivalent and _moments(one.equivalent)}
            for one in (analysis.by_differences, analysis.by_spectrum)
        },
        "asperities": {
            method: {
                "sigma": one.deviation,
                "R": one.radius,
                "N": one.density,
                "mean_height": one.mean_height,
                "skewness": one.skewness,
                "count": one.count,
                "height_distribution": analysis.heights[method].name,
                "note": one.note,
            }
            for method, one in analysis.asperities.items()
        },
        "failures": analysis.failures,
        "history": list(surface.history),
    }


def _band(spectrum: BinnedSpectrum) -> dict[str, float] | None:
    """Ends of the reliable band; None where too few points leave none."""
    if spectrum.shortest >= spectrum.longest:
        return None
    return {"longest": spectrum.longest, "shortest": spectrum.shortest}


def _moments(one: Moments) -> dict[str, Any]:
    return asdict(one) | {"alpha": one.alpha}


def spectrum_rows(spectrum: BinnedSpectrum) -> tuple[list[str], Iterable[list[Any]]]:
    """Heads and rows of a table: the averaged spectrum, and whether each bin is in the reliable band."""
    unit = "m^3" if spectrum.is_profile else "m^4"
    heads = ["wavevector [rad/m]", "wavelength [m]", f"density [{unit}]", "waves", "reliable"]
    columns = spectrum.wavevector, spectrum.wavelength, spectrum.density, spectrum.waves, spectrum.reliable
    return heads, ([*map(float, row[:3]), int(row[3]), bool(row[4])] for row in zip(*columns, strict=True))
