"""Compute the power spectrum of a height map, its average over directions, and its reliable wavelengths.

Wavevectors are q = 2 pi / wavelength [rad/m]. A is the area of a map, L the length of a profile, h the height. The
normalisation is

    C(q) = |pitch_x pitch_y sum_points h exp(-i q r)|^2 / A   [m^4]      so that  <h^2> = Int C d^2q / (2 pi)^2 = sum_q C / A
    C(q) = |pitch sum_points h exp(-i q x)|^2 / L             [m^3]      so that  <h^2> = Int C dq / (2 pi)     = sum_q C / L

where q takes both signs. These are the definitions of Jacobs, Junge & Pastewka (2017). The mean height is subtracted and q =
0 is left out. Without a window, sum_q C / A equals Sq^2 to round-off (Parseval).

A map that is not periodic needs a window. Otherwise the step from one end to the other spreads over all wavelengths. Windows
are scaled to a mean square of 1, so they do not change mean squares of statistically homogeneous heights. Two errors remain.
Hann's window adds m0 (2 pi / size)^2 / 3 to the mean square slope along a direction, which matters only if the longest waves
carry most of the slope. It also gives every wave a width of two wavenumbers, so that wavelengths above size / 3 are mixed
with the mean.

This package limits the reliable band by these criteria:

    longest   smallest size / LEAST_PERIODS: fewer waves give no reliable average, and the window mixes them with mean and tilt
    shortest  POINTS_PER_WAVE largest pitch, i.e. half of the Nyquist wavevector q_N. Waves beyond q_N appear at smaller q
              (aliasing). At q_N/2, for a self-affine map with spectrum q^(-2 - 2H), they add 5, 15 and 37 % to the true value
              if H is 0.8, 0.5 and 0.3; for a profile 9, 23 and 53 %
    shortest  with a tip of radius R: the wavelength where all longer waves together have the rms curvature (half the
              Laplacian) 1/(2 R). A tip cannot follow a valley that is more curved than the tip. Below this wavelength the scan
              shows the shape of the tip
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.fft

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.heightmap import HeightMap

LEAST_PERIODS = 3
POINTS_PER_WAVE = 4
LEAST_POINTS = 8  # along a line, for any spectrum; with fewer than 12 no wavelength is reliable
_WORKERS = 2  # threads of a transform
_ROUNDING = 1.0 + 1e-9  # includes a wave on the edge of a bin or at the cutoff in spite of round-off


@dataclass(frozen=True)
class PowerSpectrum:
    """Store the power spectral density C of every wave on the grid of a map or profile (defined in the module docstring).

    - density: C on the half plane q_x >= 0: (rows, columns // 2 + 1) [m^4], or (1, columns // 2 + 1) [m^3] for a profile; q_y
      in the order of numpy.fft
    - columns: number of columns of the map; size: (y, x) [m] of the map
    - window: window by which the heights were multiplied, a key of WINDOWS
    """

    density: np.ndarray
    columns: int
    size: tuple[float, float]
    window: str

    @property
    def is_profile(self) -> bool:
        """Return whether this is the spectrum of a profile."""
        return self.density.shape[0] == 1

    @property
    def extent(self) -> float:
        """Return the area of the map [m^2], or the length of the profile [m]."""
        return self.size[1] if self.is_profile else self.size[0] * self.size[1]

    @property
    def pitch(self) -> float:
        """Return the larger of the point distances [m] along y and x; for a profile, the distance along x."""
        along_x = self.size[1] / self.columns
        return along_x if self.is_profile else max(along_x, self.size[0] / self.density.shape[0])

    @property
    def wavevectors(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the wavevectors q_y (rows,) and q_x (columns // 2 + 1,) [rad/m] of the rows and columns of `density`."""
        return _wavevectors(self.density.shape[0], self.size[0], np.fft.fftfreq), _wavevectors(
            self.columns, self.size[1], np.fft.rfftfreq
        )

    @property
    def waves(self) -> np.ndarray:
        """Return how many waves each column of `density` represents, (columns // 2 + 1,).

        The number is two where the wave at -q is not stored, and one elsewhere.
        """
        return waves_of(self.columns)

    @property
    def lowest(self) -> float:
        """Return the smallest wavevector on the grid that is not zero [rad/m]."""
        return 2.0 * math.pi / (self.size[1] if self.is_profile else max(self.size))

    @property
    def longest(self) -> float:
        """Return the longest reliable wavelength [m]: a third of the shorter side of the map."""
        return (self.size[1] if self.is_profile else min(self.size)) / LEAST_PERIODS

    @property
    def shortest(self) -> float:
        """Return the shortest reliable wavelength [m]: four times the larger pitch; a stylus tip may raise it."""
        return POINTS_PER_WAVE * self.pitch


@dataclass(frozen=True)
class BinnedSpectrum:
    """Store a power spectrum averaged over bins of the wavevector |q|; arrays (bins,) run from long to short waves.

    - wavevector: mean |q| of the waves in a bin [rad/m]; waves: number of waves in a bin, q and -q counted as two
    - density: mean power spectral density C in a bin, [m^4] for a map and [m^3] for a profile
    - longest, shortest: ends of the reliable wavelengths [m]
    - is_profile: whether it is the spectrum of a profile; window: a key of WINDOWS
    """

    wavevector: np.ndarray
    density: np.ndarray
    waves: np.ndarray
    longest: float
    shortest: float
    is_profile: bool
    window: str

    @property
    def wavelength(self) -> np.ndarray:
        """Return the wavelength 2 pi / wavevector [m] of each bin."""
        return 2.0 * math.pi / self.wavevector

    @property
    def reliable(self) -> np.ndarray:
        """Return a mask (bins,) of the bins whose wavelength is reliable, from `shortest` to `longest`."""
        return (self.wavelength <= self.longest * _ROUNDING) & (self.wavelength * _ROUNDING >= self.shortest)


# ---- windows: functions of the shape (rows, columns) and the size (y, x), before scaling


def _rectangle(shape, size) -> np.ndarray:
    return np.ones((1, 1))


def _hann(shape, size) -> np.ndarray:
    """Return Hann's window of this shape (rows, columns): the product of one-dimensional Hann windows along y and x."""
    # SciPy's window is equal, but importing scipy.signal takes half a second.
    rows, columns = (np.hanning(count + 1)[:-1] if count > 1 else np.ones(1) for count in shape)
    return rows[:, None] * columns


def _radial_hann(shape, size) -> np.ndarray:
    """Return Hann's window (rows, columns) as a function of the distance from the middle of the map.

    shape: (rows, columns). size: (y, x) [m]. The window is zero outside the largest circle that fits, so it uses pi/4 of a
    square map and less of a long one. Source: Jacobs, Junge & Pastewka 2017.
    """
    y, x = (length * (np.arange(count) - count // 2) / count for count, length in zip(shape, size, strict=True))
    edge = min(length for count, length in zip(shape, size, strict=True) if count > 1) / 2.0
    distance = np.hypot(y[:, None], x)
    return np.where(distance > edge, 0.0, 0.5 + 0.5 * np.cos(math.pi / edge * distance))


WINDOWS: dict[str, Callable[..., np.ndarray]] = {"hann": _hann, "radial hann": _radial_hann, "none": _rectangle}


def _window(name: str, shape, size) -> np.ndarray:
    """Return the window of this name (rows, columns) for a map of this shape and size (y, x) [m], scaled to a mean square of 1.

    Raises InputError for an unknown name.
    """
    if name not in WINDOWS:
        raise InputError("window", name, ", ".join(WINDOWS))
    window = WINDOWS[name](shape, size)
    window /= math.sqrt(np.mean(window * window))
    return window


# ---- spectra


def power_spectrum(surface: HeightMap, window: str = "hann") -> PowerSpectrum:
    """Compute the power spectrum of a map or a profile, after its mean height is subtracted.

    window: a key of WINDOWS, by which the heights are multiplied; use "none" for periodic surfaces. Raises InputError for
    an unknown window, and if points are missing or a side has fewer than LEAST_POINTS points. Needs four times the memory of
    the heights.
    """
    heights = _complete(surface)
    heights = heights - heights.mean()
    heights *= _window(window, heights.shape, surface.size)
    waves = scipy.fft.rfft2(heights, overwrite_x=True, workers=_WORKERS)
    spectrum = PowerSpectrum(_squares(waves), heights.shape[1], surface.size, window)
    spectrum.density[...] *= spectrum.extent / heights.size**2
    return spectrum


def radial_average(spectrum: PowerSpectrum, bins: str = "log", tip_radius: float | None = None) -> BinnedSpectrum:
    """Average a power spectrum over all directions, in bins of |q| up to the Nyquist wavevector of the larger pitch.

    bins: "log" or "linear", the spacing of the bins; bins without a wave are left out. tip_radius: radius of the stylus [m], >
    0, or None; a blunt tip raises the shortest reliable wavelength. The spectrum of a profile is only averaged in bins.
    Raises InputError for unknown bins, and for a tip_radius that is not > 0.
    """
    edges = _edges(bins)(spectrum.lowest, math.pi / spectrum.pitch)
    sums = _average_over_directions(spectrum, edges)
    shortest = spectrum.shortest if tip_radius is None else max(spectrum.shortest, tip_cutoff(spectrum, tip_radius))
    return _binned(*sums, longest=spectrum.longest, shortest=shortest, is_profile=spectrum.is_profile, window=spectrum.window)


def tip_cutoff(spectrum: PowerSpectrum, tip_radius: float) -> float:
    """Return the wavelength [m] below which a scan shows the shape of the stylus tip instead of the surface.

    spectrum: power spectrum of the scan. tip_radius: radius of the tip [m]. All waves longer than this one together have the
    rms curvature 1/(2 tip_radius). The result is 0 if the surface is so smooth that the tip follows every wave. Raises
    InputError unless tip_radius is > 0.
    """
    if not (tip_radius > 0.0 and math.isfinite(tip_radius)):
        raise InputError("tip_radius", tip_radius, "> 0 m, finite")
    waves, power, magnitudes = _average_over_directions(spectrum, _linear_edges(spectrum.lowest, math.pi / spectrum.pitch))
    q = magnitudes / np.maximum(waves, 1)
    # The mean square Laplacian of an isotropic surface is 8/3 m4, and a profile shows only m4.
    share = 8.0 / 3.0 if spectrum.is_profile else 1.0
    curvature = np.sqrt(np.cumsum(share * q**4 * power) / (4.0 * spectrum.extent))
    beyond = np.flatnonzero(curvature > 0.5 / tip_radius)
    return float(2.0 * math.pi / q[beyond[0]]) if len(beyond) else 0.0


# ---- bins: edges from the lowest wavevector to the highest


def _log_edges(low: float, high: float, per_decade: int = 10) -> np.ndarray:
    """Return the edges [rad/m] of logarithmic bins of the wavevector, `per_decade` in each decade.

    low, high: lowest and highest wavevector [rad/m]. The edges start below the lowest and end at the highest.
    """
    count = math.ceil(per_decade * math.log10(high / low)) + 1
    return high * _ROUNDING * 10.0 ** (np.arange(-count, 1) / per_decade)


def _linear_edges(low: float, high: float) -> np.ndarray:
    """Return the edges [rad/m] of bins of the wavevector that are centred on multiples of the lowest one.

    low, high: lowest and highest wavevector [rad/m]. On a square map no wave along an axis lies on an edge.
    """
    return low * np.append(np.arange(0.5, high / low * (1.0 - 1e-9)), high / low * _ROUNDING)


BINS: dict[str, Callable[[float, float], np.ndarray]] = {"log": _log_edges, "linear": _linear_edges}


def _edges(bins: str) -> Callable[[float, float], np.ndarray]:
    if bins not in BINS:
        raise InputError("bins", bins, ", ".join(BINS))
    return BINS[bins]


def _sums_in_bins(q, density, waves, edges) -> np.ndarray:
    """Return the number of waves, the sum of C and the sum of |q| in each bin, as (3, bins).

    q, density, waves: |q| [rad/m], power spectral density C and number of waves of each entry of a spectrum, of one shape.
    edges: edges of the bins [rad/m].
    """
    place = np.searchsorted(edges, q.ravel(), side="right")
    count = len(edges) + 1
    weight = np.ravel(waves)
    sums = [np.bincount(place, weight * value, count)[1:-1] for value in (1.0, np.ravel(density), q.ravel())]
    return np.array(sums)


def _average_over_directions(spectrum: PowerSpectrum, edges: np.ndarray, block: int = 128) -> np.ndarray:
    """Sum a spectrum over all directions: return the number of waves, the sum of C and the sum of |q| in each ring, (3, rings).

    edges: edges of the rings of |q| [rad/m]. C: power spectral density. The sum runs over `block` rows at a time to save
    memory.
    """
    qy, qx = spectrum.wavevectors
    sums = np.zeros((3, len(edges) - 1))
    for start in range(0, len(qy), block):
        q = np.hypot(qy[start : start + block, None], qx)
        waves = np.broadcast_to(spectrum.waves, q.shape)
        sums += _sums_in_bins(q, spectrum.density[start : start + block], waves, edges)
    return sums


def _binned(waves, power, magnitudes, **settings) -> BinnedSpectrum:
    """Return the averaged spectrum from the sums in each bin; empty bins are omitted.

    waves, power, magnitudes: number of waves, sum of the power spectral density C and sum of |q|, (bins,) each. settings: the
    other fields of BinnedSpectrum.
    """
    full = waves > 0
    count = waves[full]
    return BinnedSpectrum(magnitudes[full] / count, power[full] / count, np.rint(count).astype(int), **settings)


# ---- helpers


def _complete(surface: HeightMap) -> np.ndarray:
    """Return the heights (rows, columns) [m] of a map; raise InputError if points are missing or a side is too short."""
    heights = surface.heights
    if surface.missing:
        raise InputError(
            "heights",
            InWords(f"{surface.missing} of {heights.size} points missing"),
            "no missing points; fill them first",
        )
    short = heights.shape[1] if surface.is_profile else min(heights.shape)
    if short < LEAST_POINTS:
        raise InputError(
            "heights", InWords(f"{heights.shape[0]} x {heights.shape[1]} points"), f"at least {LEAST_POINTS} along a side"
        )
    return heights


def _squares(waves: np.ndarray) -> np.ndarray:
    """Return the squared absolute values of a complex array, with only one temporary array."""
    squares = waves.real**2
    squares += waves.imag**2
    return squares


def _wavevectors(count: int, length: float, frequencies: Callable) -> np.ndarray:
    return 2.0 * math.pi * frequencies(count, length / count)


def wave_power(heights: np.ndarray) -> np.ndarray:
    """Return |h|^2 of the Fourier waves of a map, of shape (rows, columns // 2 + 1), in the order of `rfft2`.

    heights: (rows, columns) [m]. Where `rfft2` omits the conjugate of a wave, the entry is doubled (see `waves_of`). The sum of
    all entries is the mean square height times the squared number of points.
    """
    return np.square(np.abs(scipy.fft.rfft2(heights, workers=_WORKERS))) * waves_of(heights.shape[1])


def waves_of(columns: int) -> np.ndarray:
    """Return the number of waves, 2 or 1, that each column of a real Fourier transform represents, (columns // 2 + 1,).

    columns: number of points along x. The number is 1 for the mean and for the Nyquist wavevector, which exists if `columns` is
    even.
    """
    waves = np.full(columns // 2 + 1, 2.0)
    waves[0] = 1.0
    if columns % 2 == 0:
        waves[-1] = 1.0
    return waves
