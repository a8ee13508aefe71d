"""Power spectrum of a height map, its radial average, and its reliable wavelengths.

The normalisation, with wavevectors q = 2 pi / wavelength [rad/m] on an area A (a profile: on a length L):

    C(q) = |pitch_x pitch_y sum_points h exp(-i q r)|^2 / A   [m^4]      so that  <h^2> = Int C d^2q / (2 pi)^2 = sum_q C / A
    C(q) = |pitch sum_points h exp(-i q x)|^2 / L             [m^3]      so that  <h^2> = Int C dq / (2 pi)     = sum_q C / L

where q runs over both signs; these are the definitions of Jacobs, Junge & Pastewka (2017). The mean height is taken off, and
q = 0 left out, so that a map without window has sum_q C / A = Sq^2 to the last digits (Parseval).

A map that is not periodic needs a window, or the step from one end to the other spreads over all wavelengths. Windows are
scaled to a mean square of 1: of heights that are alike everywhere they leave mean squares as they are. What remains: Hann's
window adds m0 (2 pi / size)^2 / 3 to the mean square slope along a direction, which matters only if the longest waves have all
the slope, and gives every wave a width of two wavenumbers, so that what is longer than size / 3 is mixed with the mean.

The reliable band, criteria of this package:

    longest   smallest size / LEAST_PERIODS: fewer waves are no average, and the window mixes them with mean and tilt
    shortest  POINTS_PER_WAVE largest pitch: half of Nyquist's wavevector q_N. Waves beyond q_N appear folded back: at q_N/2
              all of them together are, of a self-affine spectrum q^(-2 - 2H), 5 % of what belongs there for H = 0.8, 15 %
              for 0.5 and 37 % for 0.3; of a profile 9, 23 and 53 %
    shortest  with a tip radius R: where waves up to q have together a root mean square curvature (half the Laplacian) 1/(2 R).
              A tip cannot follow a valley more curved than itself; what it drew below this wavelength is its own shape
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.fft
from scipy.signal.windows import hann

from stiction.quantities.errors import InputError
from stiction.surfaces.heightmap import HeightMap

LEAST_PERIODS = 3
POINTS_PER_WAVE = 4
LEAST_POINTS = 8  # along a line: with fewer, the two ends of the band meet
_WORKERS = 2  # threads of a transform
_ROUNDING = 1.0 + 1e-9  # a wave on the edge of a bin, or at the cutoff, is counted in


@dataclass(frozen=True)
class PowerSpectrum:
    """Power of every wave on the grid of a map or profile, as defined at the top.

    density: C on the half plane q_x >= 0 (rows, columns // 2 + 1) [m^4], of a profile (1, columns // 2 + 1) [m^3]; q_y in the
    order of numpy's fft. columns: of the map. size: (y, x) [m]. window: a key of WINDOWS.
    """

    density: np.ndarray
    columns: int
    size: tuple[float, float]
    window: str

    @property
    def is_profile(self) -> bool:
        """Return whether this is the spectrum of one line."""
        return self.density.shape[0] == 1

    @property
    def extent(self) -> float:
        """Return the area of the map [m^2], or the length of the profile [m]."""
        return self.size[1] if self.is_profile else self.size[0] * self.size[1]

    @property
    def pitch(self) -> float:
        """Return the larger of the two pitches, of a profile the only one [m]."""
        along_x = self.size[1] / self.columns
        return along_x if self.is_profile else max(along_x, self.size[0] / self.density.shape[0])

    @property
    def wavevectors(self) -> tuple[np.ndarray, np.ndarray]:
        """Return q_y (rows,) and q_x (columns // 2 + 1,) [rad/m]."""
        return _wavevectors(self.density.shape[0], self.size[0], np.fft.fftfreq), _wavevectors(
            self.columns, self.size[1], np.fft.rfftfreq
        )

    @property
    def waves(self) -> np.ndarray:
        """Return the number of waves per entry, by column (columns // 2 + 1,).

        An entry counts twice where the whole plane also has the wave at -q.
        """
        return _waves(self.columns)

    @property
    def lowest(self) -> float:
        """Return the smallest nonzero wavevector on the grid [rad/m]."""
        return 2.0 * math.pi / (self.size[1] if self.is_profile else max(self.size))

    @property
    def longest(self) -> float:
        """Return the longest reliable wavelength [m]."""
        return (self.size[1] if self.is_profile else min(self.size)) / LEAST_PERIODS

    @property
    def shortest(self) -> float:
        """Return the shortest reliable wavelength [m], ignoring the tip."""
        return POINTS_PER_WAVE * self.pitch


@dataclass(frozen=True)
class BinnedSpectrum:
    """A spectrum averaged in bins of |q|; arrays (bins,), from long waves to short.

    wavevector: mean |q| of the waves in a bin [rad/m]; density: mean C [m^4], of lines [m^3]; waves: how many they are, q and
    -q being two. longest, shortest: ends of the reliable band [m]. is_profile: whether C belongs to lines. window: a key of
    WINDOWS.
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
        """Return 2 pi / wavevector [m]."""
        return 2.0 * math.pi / self.wavevector

    @property
    def reliable(self) -> np.ndarray:
        """Return a mask of the bins in the reliable band."""
        return (self.wavelength <= self.longest * _ROUNDING) & (self.wavelength * _ROUNDING >= self.shortest)


# ---- windows: of (rows, columns) and the size (y, x), not yet scaled


def _rectangle(shape, size) -> np.ndarray:
    return np.ones((1, 1))


def _hann(shape, size) -> np.ndarray:
    """Return Hann's window along x times Hann's window along y."""
    rows, columns = (hann(count, sym=False) for count in shape)
    return rows[:, None] * columns


def _radial_hann(shape, size) -> np.ndarray:
    """Return Hann's window over the distance from the middle.

    It is zero outside the largest circle, so it uses pi/4 of the points, and fewer of a long map. Source: Jacobs, Junge &
    Pastewka 2017.
    """
    y, x = (length * (np.arange(count) - count // 2) / count for count, length in zip(shape, size, strict=True))
    edge = min(length for count, length in zip(shape, size, strict=True) if count > 1) / 2.0
    distance = np.hypot(y[:, None], x)
    return np.where(distance > edge, 0.0, 0.5 + 0.5 * np.cos(math.pi / edge * distance))


WINDOWS: dict[str, Callable[..., np.ndarray]] = {"hann": _hann, "radial hann": _radial_hann, "none": _rectangle}


def _window(name: str, shape, size) -> np.ndarray:
    """Return the named window with a mean square of 1."""
    if name not in WINDOWS:
        raise InputError("window", name, ", ".join(WINDOWS))
    window = WINDOWS[name](shape, size)
    window /= math.sqrt(np.mean(window * window))
    return window


# ---- spectra


def power_spectrum(surface: HeightMap, window: str = "hann") -> PowerSpectrum:
    """Compute the power spectrum of a map or a profile, about its mean height.

    window: a key of WINDOWS; "none" for periodic surfaces. Raises InputError if points are missing or there are fewer than
    LEAST_POINTS along a side. Takes four times the memory of the heights.
    """
    heights = _complete(surface)
    heights = heights - heights.mean()
    heights *= _window(window, heights.shape, surface.size)
    waves = scipy.fft.rfft2(heights, overwrite_x=True, workers=_WORKERS)
    spectrum = PowerSpectrum(_squares(waves), heights.shape[1], surface.size, window)
    spectrum.density[...] *= spectrum.extent / heights.size**2
    return spectrum


def line_spectrum(surface: HeightMap, along: str = "x", window: str = "hann", bins: str = "log") -> BinnedSpectrum:
    """Average the spectra of the lines of a map along "x" or "y", in bins.

    Each line is taken about its own mean. window: "hann" or another key of WINDOWS, along the line; bins: a key of BINS. Raises
    Raises InputError as `power_spectrum` does.
    """
    if along not in _LINES:
        raise InputError("along", along, " or ".join(_LINES))
    lines = _LINES[along](_complete(surface))
    count, length = lines.shape[1], surface.size[1 if along == "x" else 0]
    if count < LEAST_POINTS:
        raise InputError("along", along, f"the direction of a line of at least {LEAST_POINTS} points")
    lines = lines - lines.mean(axis=1, keepdims=True)
    lines *= _window(window, (1, count), (length, length))
    density = _squares(scipy.fft.rfft(lines, axis=1, workers=_WORKERS)).mean(axis=0) * (length / count**2)
    q = _wavevectors(count, length, np.fft.rfftfreq)
    edges = _edges(bins)(q[1], math.pi * count / length)
    sums = _sums_in_bins(q[1:], density[1:], _waves(count)[1:], edges)
    longest, shortest = length / LEAST_PERIODS, POINTS_PER_WAVE * length / count
    return _binned(*sums, longest=longest, shortest=shortest, is_profile=True, window=window)


_LINES: dict[str, Callable[[np.ndarray], np.ndarray]] = {"x": lambda heights: heights, "y": np.transpose}


def radial_average(spectrum: PowerSpectrum, bins: str = "log", tip_radius: float | None = None) -> BinnedSpectrum:
    """Average a spectrum over directions, in bins of |q| up to the Nyquist wavevector.

    It is the Nyquist wavevector of the larger pitch.

    bins: a key of BINS; bins without a wave are left out. tip_radius [m], > 0: of the stylus, ends the reliable band earlier.
    Of a profile: averaged in bins.
    """
    edges = _edges(bins)(spectrum.lowest, math.pi / spectrum.pitch)
    sums = _average_over_directions(spectrum, edges)
    shortest = spectrum.shortest if tip_radius is None else max(spectrum.shortest, tip_cutoff(spectrum, tip_radius))
    return _binned(*sums, longest=spectrum.longest, shortest=shortest, is_profile=spectrum.is_profile, window=spectrum.window)


def tip_cutoff(spectrum: PowerSpectrum, tip_radius: float) -> float:
    """Return the wavelength [m] below which a stylus tip drew its own shape.

    It is defined at the top, and 0 if the surface is too smooth. tip radius in m; raises InputError unless it is > 0.
    """
    if not (tip_radius > 0.0 and math.isfinite(tip_radius)):
        raise InputError("tip_radius", tip_radius, "> 0 m, finite")
    waves, power, magnitudes = _average_over_directions(spectrum, _linear_edges(spectrum.lowest, math.pi / spectrum.pitch))
    q = magnitudes / np.maximum(waves, 1)
    # a profile shows m4 of the 8/3 m4 in the mean square Laplacian of an isotropic surface
    share = 8.0 / 3.0 if spectrum.is_profile else 1.0
    curvature = np.sqrt(np.cumsum(share * q**4 * power) / (4.0 * spectrum.extent))
    beyond = np.flatnonzero(curvature > 0.5 / tip_radius)
    return float(2.0 * math.pi / q[beyond[0]]) if len(beyond) else 0.0


# ---- bins: edges from the lowest wavevector to the highest


def _log_edges(low: float, high: float, per_decade: int = 10) -> np.ndarray:
    """Return edges of `per_decade` bins per decade.

    They run down from the highest wavevector to below the lowest.
    """
    count = math.ceil(per_decade * math.log10(high / low)) + 1
    return high * _ROUNDING * 10.0 ** (np.arange(-count, 1) / per_decade)


def _linear_edges(low: float, high: float) -> np.ndarray:
    """Return edges of bins as wide as the lowest wavevector, around its multiples.

    No wave along an axis of a square map is on an edge.
    """
    return low * np.append(np.arange(0.5, high / low * (1.0 - 1e-9)), high / low * _ROUNDING)


BINS: dict[str, Callable[[float, float], np.ndarray]] = {"log": _log_edges, "linear": _linear_edges}


def _edges(bins: str) -> Callable[[float, float], np.ndarray]:
    if bins not in BINS:
        raise InputError("bins", bins, ", ".join(BINS))
    return BINS[bins]


def _sums_in_bins(q, density, waves, edges) -> np.ndarray:
    """Return (3, bins): number of waves, sum of C and sum of |q|.

    q, density and waves have the same shape.
    """
    place = np.searchsorted(edges, q.ravel(), side="right")
    count = len(edges) + 1
    weight = np.ravel(waves)
    sums = [np.bincount(place, weight * value, count)[1:-1] for value in (1.0, np.ravel(density), q.ravel())]
    return np.array(sums)


def _average_over_directions(spectrum: PowerSpectrum, edges: np.ndarray, block: int = 128) -> np.ndarray:
    """Return (3, bins): number of waves, sum of C and sum of |q| in rings.

    edges: of the rings; `block` rows are summed at a time.
    """
    qy, qx = spectrum.wavevectors
    sums = np.zeros((3, len(edges) - 1))
    for start in range(0, len(qy), block):
        q = np.hypot(qy[start : start + block, None], qx)
        waves = np.broadcast_to(spectrum.waves, q.shape)
        sums += _sums_in_bins(q, spectrum.density[start : start + block], waves, edges)
    return sums


def _binned(waves, power, magnitudes, **settings) -> BinnedSpectrum:
    """Return the means from the sums, without empty bins."""
    full = waves > 0
    count = waves[full]
    return BinnedSpectrum(magnitudes[full] / count, power[full] / count, np.rint(count).astype(int), **settings)


# ---- parts


def _complete(surface: HeightMap) -> np.ndarray:
    """Return the heights. Raises InputError if points are missing or too few."""
    heights = surface.heights
    if surface.missing:
        raise InputError("heights", f"{surface.missing} of {heights.size} points missing", "none missing: fill or crop first")
    short = heights.shape[1] if surface.is_profile else min(heights.shape)
    if short < LEAST_POINTS:
        raise InputError("heights", f"{heights.shape[0]} x {heights.shape[1]} points", f"at least {LEAST_POINTS} along a side")
    return heights


def _squares(waves: np.ndarray) -> np.ndarray:
    """Return |waves|^2, without a third array of their size."""
    squares = waves.real**2
    squares += waves.imag**2
    return squares


def _wavevectors(count: int, length: float, frequencies: Callable) -> np.ndarray:
    return 2.0 * math.pi * frequencies(count, length / count)


def _waves(columns: int) -> np.ndarray:
    """Return 2 for every entry of a real transform, 1 for the mean and Nyquist's.

    Nyquist's entry exists for an even number of points.
    """
    waves = np.full(columns // 2 + 1, 2.0)
    waves[0] = 1.0
    if columns % 2 == 0:
        waves[-1] = 1.0
    return waves
