"""Combine the power spectra of scans of one surface, using each scan only at wavelengths where it is reliable."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities.errors import InputError, InWords, field_as
from stiction.quantities.shown import show
from stiction.surfaces.heightmap import in_metres
from stiction.surfaces.held import as_height_map
from stiction.surfaces.spectrum import BinnedSpectrum, power_spectrum, radial_average
from stiction.surfaces.targets import line_moments
from stiction.surfaces.theory.moments import Moments

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap

_PER_DECADE = 40  # wavenumbers of the combined spectrum in each decade
_MOST_WAVES = 100.0  # largest weight of a bin; with more waves, scans differ by their instruments and not by chance
_MANY_WAVES = 30.0  # least number of waves in a bin for a comparison of its density with another scan


@dataclass(frozen=True)
class CombinedSpectrum:
    """Store the power spectrum of one surface from more than one scan; call it with wavenumbers [rad/m].

    Parameters
    ----------
    wavevector : array (bins,) [rad/m]
        Wave numbers, ascending.
    density : array (bins,) [m^4], or [m^3] of profiles
        Power spectral density C, normalised as in `SelfAffine`; between bins ln C is linear in the logarithm of the wave
        number.
    disagreement : float
        Largest ratio of the densities that two scans give at the same wavenumber. Only densities from at least 30 waves are
        compared. 1 if no two scans overlap.
    dimensions : int
        2 for a surface, 1 for a profile.

    Examples
    --------
    See `combined_spectrum`.
    """

    wavevector: np.ndarray
    density: np.ndarray
    disagreement: float
    dimensions: int = 2

    def __call__(self, q: np.ndarray) -> np.ndarray:
        """Return the power spectral density C at wavenumbers q [rad/m], 0 outside the wavelengths that the scans measured."""
        q = np.asarray(q, dtype=float)
        inside = (q >= self.wavevector[0]) & (q <= self.wavevector[-1])
        log_q = np.log(np.clip(q, self.wavevector[0], self.wavevector[-1]))
        return np.where(inside, np.exp(np.interp(log_q, np.log(self.wavevector), np.log(self.density))), 0.0)

    def __str__(self) -> str:
        longest, shortest = (show(2.0 * math.pi / self.wavevector[end], "mean_separation") for end in (0, -1))
        return f"of several scans, wavelengths {shortest} to {longest}"

    @property
    def moments(self) -> Moments:
        """Return the spectral moments m0 [m^2], m2 [1], m4 [1/m^2] of a profile, from the measured wavelengths only."""
        log_q = np.log(self.wavevector)
        powers = [self.density * self.wavevector ** (k + self.dimensions) for k in (0, 2, 4)]  # dq = q d ln q
        return line_moments(self.dimensions, (float(np.trapezoid(power, log_q)) for power in powers))


def combined_spectrum(scans: "Iterable[HeightMap]", tip_radius: "float | str | None" = None) -> CombinedSpectrum:
    """Combine scans of one surface with different sizes or instruments into one power spectrum.

    Parameters
    ----------
    scans : iterable of HeightMap
        Levelled heights; all maps or all profiles. A map that is not periodic is multiplied by Hann's window.
    tip_radius : float [m] or str with a unit, optional
        Radius of the stylus tip, which limits the short wavelengths of every scan.

    Returns
    -------
    CombinedSpectrum
        Can be passed to `gaussian_surface` as its spectrum; `moments` and `disagreement` are properties.

    Raises
    ------
    InputError
        No scan is given, maps and profiles are mixed, a scan is incomplete or has no reliable wavelength, or the
        wavelengths of the scans leave a gap.

    Notes
    -----
    Each scan contributes wavelengths from four pitches (or the limit of the tip) to a third of its size. Where scans overlap,
    the result is the geometric mean of their densities. The weight of a scan is its number of waves in the bin, at most a
    hundred.

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
    try:
        listed = list(scans)
    except TypeError:
        raise InputError("scans", scans, "a list of maps, e.g. [st.read_scan(FILE), ...]") from None
    maps = [as_height_map(scan, f"scans[{index}]") for index, scan in enumerate(listed)]
    if not maps:
        raise InputError("scans", 0, "at least one scan")
    if len({surface.is_profile for surface in maps}) > 1:
        raise InputError("scans", InWords("maps and profiles"), "all maps or all profiles")
    radius = None if tip_radius is None else in_metres(tip_radius, "tip_radius")
    spectra = [_reliable(surface, radius, f"scans[{index}]") for index, surface in enumerate(maps)]
    ends = [spectrum.wavevector[end] for spectrum in spectra for end in (0, -1)]
    count = math.ceil(_PER_DECADE * math.log10(max(ends) / min(ends))) + 1
    wavevector = np.geomspace(min(ends), max(ends), count)
    wavevector[[0, -1]] = min(ends), max(ends)  # exactly, so that round-off puts no end outside its scan
    log_density, waves = (np.array(rows) for rows in zip(*(_at(spectrum, wavevector) for spectrum in spectra), strict=True))
    if not (total := waves.sum(axis=0)).all():
        gap = 2.0 * math.pi / wavevector[total == 0.0]
        text = " to ".join(show(length, "mean_separation") for length in (gap.min(), gap.max()))
        raise InputError("scans", InWords(f"no reliable wavelength {text}"), "scans whose wavelengths overlap")
    mean = np.sum(waves * np.where(waves > 0.0, log_density, 0.0), axis=0) / total
    many = np.where(waves >= _MANY_WAVES, log_density, np.nan)
    span = np.nanmax(many, axis=0, initial=-np.inf) - np.nanmin(many, axis=0, initial=np.inf)
    return CombinedSpectrum(wavevector, np.exp(mean), math.exp(max(span.max(), 0.0)), 1 if maps[0].is_profile else 2)


def _reliable(surface: "HeightMap", tip_radius: float | None, field: str) -> BinnedSpectrum:
    """Return the power spectrum of a scan, averaged over directions in bins, for its reliable wavelengths only.

    tip_radius: radius of the stylus [m], None to ignore it. field: name of the scan, for the error. Raises InputError if no
    wavelength is reliable.
    """
    bins = "log" if surface.is_profile else "linear"  # linear bins are narrow at large q, where each has many waves
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
    """Average a binned spectrum in bins of the wavenumber, _PER_DECADE of them per decade.

    In wider bins the mean would be too large where the spectrum is steep.
    """
    _, group = np.unique(np.floor(_PER_DECADE * np.log10(binned.wavevector)), return_inverse=True)
    waves = np.bincount(group, binned.waves)
    q, density = (np.bincount(group, binned.waves * table) / waves for table in (binned.wavevector, binned.density))
    return replace(binned, wavevector=q, density=density, waves=waves)


def _at(spectrum: BinnedSpectrum, wavevector: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the logarithm of the power spectral density of a scan, and its weight, at given wavenumbers, (bins,) each.

    wavevector: wavenumbers (bins,) [rad/m]. The weight is the number of waves, at most _MOST_WAVES, and 0 outside the
    wavelengths of the scan.
    """
    log_q, own = np.log(wavevector), np.log(spectrum.wavevector)
    inside = (wavevector >= spectrum.wavevector[0]) & (wavevector <= spectrum.wavevector[-1])
    weight = np.minimum(np.interp(log_q, own, spectrum.waves), _MOST_WAVES)
    return np.interp(log_q, own, np.log(spectrum.density)), np.where(inside, weight, 0.0)
