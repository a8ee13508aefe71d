"""Combine the power spectra of several scans of one surface, each in its reliable wavelengths."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities.errors import InputError, field_as
from stiction.quantities.units import show
from stiction.surfaces.heightmap import in_metres
from stiction.surfaces.held import as_height_map
from stiction.surfaces.spectrum import BinnedSpectrum, power_spectrum, radial_average
from stiction.surfaces.targets import line_moments
from stiction.surfaces.theory.moments import Moments

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap

_PER_DECADE = 40  # wave numbers of the combined spectrum
_MOST_WAVES = 100.0  # largest weight of a bin: beyond, scans differ by their instruments and not by chance
_MANY_WAVES = 30.0  # of a bin, from which on its density is compared with that of another scan


@dataclass(frozen=True)
class CombinedSpectrum:
    """The power spectrum of one surface from several scans; call it with wave numbers [rad/m].

    Parameters
    ----------
    wavevector : array (bins,) [rad/m]
        Wave numbers, ascending.
    density : array (bins,) [m^4], or [m^3] of profiles
        Power spectral density, normalised as that of `SelfAffine`; between bins ln C is linear in ln q.
    disagreement : float
        Largest ratio of the densities that two scans give at the same wave number; 1 if no two scans overlap.
    dimensions : int
        2 of a surface, 1 of a profile.

    Examples
    --------
    See `combined_spectrum`.
    """

    wavevector: np.ndarray
    density: np.ndarray
    disagreement: float
    dimensions: int = 2

    def __call__(self, q: np.ndarray) -> np.ndarray:
        """Return C at wave numbers q [rad/m], 0 outside the wavelengths that were measured."""
        q = np.asarray(q, dtype=float)
        inside = (q >= self.wavevector[0]) & (q <= self.wavevector[-1])
        log_q = np.log(np.clip(q, self.wavevector[0], self.wavevector[-1]))
        return np.where(inside, np.exp(np.interp(log_q, np.log(self.wavevector), np.log(self.density))), 0.0)

    def __str__(self) -> str:
        longest, shortest = (show(2.0 * math.pi / self.wavevector[end], "mean_separation") for end in (0, -1))
        return f"of several scans, wavelengths {shortest} to {longest}"

    @property
    def moments(self) -> Moments:
        """Return m0 [m^2], m2 [1], m4 [1/m^2] of a line, of the measured wavelengths only."""
        log_q = np.log(self.wavevector)
        powers = [self.density * self.wavevector ** (k + self.dimensions) for k in (0, 2, 4)]  # dq = q d ln q
        return line_moments(self.dimensions, (float(np.trapezoid(power, log_q)) for power in powers))


def combined_spectrum(scans: "Iterable[HeightMap]", tip_radius: "float | str | None" = None) -> CombinedSpectrum:
    """Combine scans of one surface with different sizes or instruments into one power spectrum.

    Parameters
    ----------
    scans : iterable of HeightMap
        Levelled heights; all maps or all profiles. A map that is not periodic is windowed.
    tip_radius : float [m] or str with a unit, optional
        Radius of the stylus tip, which limits the short wavelengths of every scan.

    Returns
    -------
    CombinedSpectrum
        Serves `gaussian_surface` as its spectrum; `moments` and `disagreement` are properties.

    Raises
    ------
    InputError
        No scan is given, maps and profiles are mixed, a scan is incomplete or has no reliable wavelength, or the
        wavelengths of the scans leave a gap.

    Notes
    -----
    Each scan counts from four pitches (or the limit of the tip) to a third of its size. Where scans overlap, the result is
    the geometric mean of their densities, each weighted by its number of waves in the bin up to a hundred.

    Examples
    --------
    >>> import stiction as st
    >>> target = st.SelfAffine(hurst=0.8, rolloff="8 um", shortest="100 nm", deviation="10 nm")
    >>> coarse = st.gaussian_surface((256, 256), ("50 um", "50 um"), st.SelfAffine(0.8, "8 um", "400 nm", "10 nm"), seed=1)
    >>> fine = st.gaussian_surface((256, 256), ("6 um", "6 um"), target, seed=2)
    >>> spectrum = st.combined_spectrum([coarse, fine])
    >>> print(spectrum)
    of several scans, wavelengths 93.7573 nm to 16.4569 µm
    >>> surface = st.gaussian_surface((512, 512), ("12 um", "12 um"), spectrum, seed=3)
    """
    if not isinstance(scans, Iterable) or isinstance(scans, str):
        raise InputError("scans", scans, "a list of maps, e.g. [st.read_scan(FILE), ...]")
    maps = [as_height_map(scan, f"scans[{index}]") for index, scan in enumerate(scans)]
    if not maps:
        raise InputError("scans", 0, "at least one scan")
    if len({surface.is_profile for surface in maps}) > 1:
        raise InputError("scans", "maps and profiles", "all maps or all profiles")
    radius = None if tip_radius is None else in_metres(tip_radius, "tip_radius")
    spectra = [_reliable(surface, radius, f"scans[{index}]") for index, surface in enumerate(maps)]
    ends = [spectrum.wavevector[end] for spectrum in spectra for end in (0, -1)]
    count = math.ceil(_PER_DECADE * math.log10(max(ends) / min(ends))) + 1
    wavevector = np.geomspace(min(ends), max(ends), count)
    wavevector[[0, -1]] = min(ends), max(ends)  # to the last bit, so that no end lies outside its scan
    log_density, waves = (np.array(rows) for rows in zip(*(_at(spectrum, wavevector) for spectrum in spectra), strict=True))
    if not (total := waves.sum(axis=0)).all():
        gap = 2.0 * math.pi / wavevector[total == 0.0]
        text = " to ".join(show(length, "mean_separation") for length in (gap.min(), gap.max()))
        raise InputError("scans", f"no reliable wavelength {text}", "scans whose wavelengths overlap")
    mean = np.sum(waves * np.where(waves > 0.0, log_density, 0.0), axis=0) / total
    many = np.where(waves >= _MANY_WAVES, log_density, np.nan)
    span = np.nanmax(many, axis=0, initial=-np.inf) - np.nanmin(many, axis=0, initial=np.inf)
    return CombinedSpectrum(wavevector, np.exp(mean), math.exp(max(span.max(), 0.0)), 1 if maps[0].is_profile else 2)


def _reliable(surface: "HeightMap", tip_radius: float | None, field: str) -> BinnedSpectrum:
    """Return the binned spectrum of a scan in its reliable wavelengths. Raises InputError if there is none."""
    bins = "log" if surface.is_profile else "linear"  # narrow where many waves share one
    with field_as(lambda own: f"{field}.{own}"):
        spectrum = power_spectrum(surface, "none" if surface.periodic else "hann")
        binned = radial_average(spectrum, bins, tip_radius)
    used = binned.reliable & (binned.density > 0.0)
    if np.count_nonzero(used) < 2:
        allowed = "a scan with reliable wavelengths, from four pitches to a third of its size"
        raise InputError(field, str(surface.name or "scan"), allowed)
    return _smoothed(
        replace(binned, wavevector=binned.wavevector[used], density=binned.density[used], waves=binned.waves[used])
    )


def _smoothed(binned: BinnedSpectrum) -> BinnedSpectrum:
    """Return a spectrum averaged in bins of at most 1/_PER_DECADE of a decade.

    In wider bins the mean would be too large where the spectrum is steep.
    """
    _, group = np.unique(np.floor(_PER_DECADE * np.log10(binned.wavevector)), return_inverse=True)
    waves = np.bincount(group, binned.waves)
    q, density = (np.bincount(group, binned.waves * table) / waves for table in (binned.wavevector, binned.density))
    return replace(binned, wavevector=q, density=density, waves=waves)


def _at(spectrum: BinnedSpectrum, wavevector: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return ln C of a scan and its weight, (bins,) each, at wave numbers; the weight is 0 outside the band of the scan."""
    log_q, own = np.log(wavevector), np.log(spectrum.wavevector)
    inside = (wavevector >= spectrum.wavevector[0]) & (wavevector <= spectrum.wavevector[-1])
    weight = np.minimum(np.interp(log_q, own, spectrum.waves), _MOST_WAVES)
    return np.interp(log_q, own, np.log(spectrum.density)), np.where(inside, weight, 0.0)
