"""Analyse one scan: statistics, spectrum, spectral moments, and asperities by every method."""

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.quantities.errors import InputError
from stiction.quantities.progress import Steps
from stiction.solving.accuracy.solved_near import kind_of_map
from stiction.surfaces.areal_parameters import areal_parameters, profile_parameters
from stiction.surfaces.fill import fill_missing
from stiction.surfaces.finding import Asperities, asperities, methods
from stiction.surfaces.height_model import HeightModel, height_model
from stiction.surfaces.heightmap import HeightMap, metres
from stiction.surfaces.held import as_height_map
from stiction.surfaces.measured import default_method, separate_count
from stiction.surfaces.spectrum import BinnedSpectrum, power_spectrum, radial_average
from stiction.surfaces.spikes import spikes as spikes_of
from stiction.surfaces.statistics import ProfileMoments, Statistics, moments_by_differences, moments_by_spectrum, statistics
from stiction.surfaces.theory.moments import Moments

if TYPE_CHECKING:
    from stiction.quantities.arguments import QuantityLike


@dataclass(frozen=True)
class Analysis:
    """Store the analysis of a scan.

    surface: the prepared map. statistics: moments and distribution of its heights. spectrum: radial average of the power
    spectrum. of_spectrum: how gaps were filled for the spectrum, "" if there were none. spikes: number of points farther than
    SUSPICIOUS robust deviations from the median. by_differences, by_spectrum: spectral moments from differences and from the
    spectrum, with the same cutoff. asperities, heights, failures: dicts by asperity method, with the asperities, their height
    distribution, and the reason if the method found no asperities. standing: method recommended for the surface, "" if no
    method found asperities. kind: kind of surface, one of finishes.SURFACE_KINDS, estimated from the heights; None if
    undecided.
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
    standing: str
    kind: str | None


def analyse(surface: HeightMap, progress: Steps = iter, tip_radius: "QuantityLike | None" = None) -> Analysis:
    """Compute statistics, spectrum, moments and asperities of a scan.

    Parameters
    ----------
    surface : HeightMap
        Heights (rows, columns) [m], as `prepared` returns them.
    progress : callable
        Receives the list of methods and returns an iterable over it.
    tip_radius : float [m] or str with a unit, optional
        Radius of the stylus tip. Wavelengths too short for this tip are not in the reliable band of the spectrum.

    Returns
    -------
    Analysis
        Its attributes are the surface, statistics of the heights, spectrum, number of spikes, spectral moments, recommended
        asperity method and kind of surface. For each asperity method, they also include the asperities and their height
        distribution, or the reason why the method found no asperities.

    Raises
    ------
    InputError
        The map or the tip radius is not usable.

    Examples
    --------
    >>> import stiction as st
    >>> target = st.SelfAffine(hurst=0.8, rolloff="2 um", shortest="400 nm", deviation="10 nm")
    >>> surface = st.gaussian_surface((64, 64), ("10 um", "10 um"), target, seed=1)
    >>> "mccool" in st.analyse(surface).asperities
    True
    """
    surface = as_height_map(surface)
    tip = None if tip_radius is None else metres(tip_radius, "tip_radius")
    each: dict[str, Asperities] = {}
    failures: dict[str, str] = {}
    for method in progress(list(methods())):
        try:
            each[method] = asperities(surface, method)
        except InputError as error:
            failures[method] = str(error)
    filled = surface if surface.complete else fill_missing(surface)
    spectrum = power_spectrum(filled)
    return Analysis(
        surface,
        statistics(surface),
        radial_average(spectrum, tip_radius=tip),
        "" if surface.complete else filled.history[-1],
        int(np.count_nonzero(spikes_of(surface))),
        moments_by_differences(surface),
        moments_by_spectrum(spectrum),
        each,
        {method: height_model(one) for method, one in each.items()},
        failures,
        default_method(each, {method: separate_count(one, surface) for method, one in each.items()}),
        kind_of_map(surface),
    )


def summary(analysis: Analysis) -> dict[str, Any]:
    """Return the analysis of a scan as a dict for JSON, with numbers in SI units."""
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
        "iso_25178_2": None if surface.is_profile else asdict(areal_parameters(surface)),
        "iso_21920_2": profile_parameters(surface, analysis.statistics) if surface.is_profile else None,
        "pitch": {"x": surface.pitch[1], "y": None if surface.is_profile else surface.pitch[0]},
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
        "standing": analysis.standing,
        "kind": analysis.kind,
        "history": list(surface.history),
    }


def _band(spectrum: BinnedSpectrum) -> dict[str, float] | None:
    """Return the longest and shortest wavelength [m] of the reliable band of a spectrum; None if there is no such band."""
    if spectrum.shortest >= spectrum.longest:
        return None
    return {"longest": spectrum.longest, "shortest": spectrum.shortest}


def _moments(one: Moments) -> dict[str, Any]:
    return asdict(one) | {"alpha": one.alpha}


def spectrum_rows(spectrum: BinnedSpectrum) -> tuple[list[str], Iterable[list[Any]]]:
    """Return column names and rows of the averaged spectrum; the last column tells whether a row is in the reliable band."""
    unit = "m^3" if spectrum.is_profile else "m^4"
    heads = ["wavevector [rad/m]", "wavelength [m]", f"density [{unit}]", "waves", "reliable"]
    columns = spectrum.wavevector, spectrum.wavelength, spectrum.density, spectrum.waves, spectrum.reliable
    return heads, ([*map(float, row[:3]), int(row[3]), bool(row[4])] for row in zip(*columns, strict=True))
