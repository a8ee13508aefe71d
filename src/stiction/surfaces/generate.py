"""Generate random surfaces with a given power spectrum, Gaussian or with given skewness and kurtosis.

Gaussian surfaces are filtered white noise (linear filter, Hu & Tonder 1992). The Fourier transform of the noise is multiplied
by sqrt(C / (dx dy)), with the power spectral density C and the point spacings dx and dy. Every wave on the grid then has the
mean square C / (area of the map), and the sum over all waves approximates the integral of C. Waves of the spectrum that are
shorter than two pitches or longer than the map are missing from the heights.

Non-Gaussian surfaces start from a Gaussian one. Its heights are replaced, rank by rank, by heights of Johnson's distribution.
This changes the spectrum, so an iteration alternately restores the amplitudes of the waves and the distribution of heights
(Schreiber & Schmitz 1996, for time series). A finite map cannot meet both exactly. The remaining error is written into the
history of the map.

Stretching an isotropic surface by a factor s along a direction gives h(x / s, y). Along this direction the mean square slope is
divided by s^2 and the mean square second derivative by s^4. Heights, and slopes across this direction, keep their statistics.
The spectrum becomes s C(s q_along, q_across).

Save a generated surface to read it with `stiction surface made.npy --size "10 um" --unit m`:

    target = SelfAffine(hurst=0.8, rolloff=2e-6, shortest=50e-9, deviation=10e-9)
    surface = gaussian_surface((512, 512), (10e-6, 10e-6), target, seed=1)
    np.save("made.npy", surface.heights)
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypedDict, Unpack

import numpy as np
from scipy.fft import irfft2, rfft2
from scipy.special import ndtri

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.inputs import require_positive
from stiction.quantities.keywords import with_keywords
from stiction.surfaces.heightmap import HeightMap, size_in_metres
from stiction.surfaces.johnson import johnson
from stiction.surfaces.memory import require_arrays
from stiction.surfaces.spectrum import wave_power
from stiction.surfaces.targets import SelfAffine

Spectrum = Callable[[np.ndarray], np.ndarray]

_BLOCK = 2**19  # waves filtered at once, few enough to need little memory compared to the map
_WORKERS = 2
_LEAST_POINTS = 8
_ARRAYS = 3  # arrays as large as the map that exist at once while a surface is generated
_SETTLED = 0.01  # the iteration ends when a step reduces the error of the spectrum by less than this fraction


class Lay(TypedDict, total=False):
    """Define the optional keyword arguments shared by `gaussian_surface` and `non_gaussian_surface`."""

    stretch: float
    angle: float
    random_amplitudes: bool


@dataclass(frozen=True)
class _Periodic:
    """Store the checked arguments of `gaussian_surface`, with the size in metres.

    Raises InputError if an argument is not allowed.
    """

    shape: tuple[int, int]
    size: tuple[float, float]
    spectrum: Spectrum
    seed: int
    stretch: float = 1.0
    angle: float = 0.0
    random_amplitudes: bool = True

    def __post_init__(self) -> None:
        _check_grid(self.shape, self.seed)
        require_positive(stretch=self.stretch)
        if not math.isfinite(self.angle):
            raise InputError("angle", self.angle, "a finite number of rad")
        self._check_spectrum()

    def heights(self) -> np.ndarray:
        """Return the Gaussian heights (rows, columns) [m] that these arguments define."""
        waves = rfft2(np.random.default_rng(self.seed).standard_normal(self.shape), workers=_WORKERS)
        self._colour(waves)
        return irfft2(waves, s=self.shape, workers=_WORKERS, overwrite_x=True)

    def history_line(self, kind: str) -> str:
        """Return one line that describes how the surface was made, for its history; kind: "Gaussian" or "non-Gaussian"."""
        text = f"made: {kind} {'profile' if self.shape[0] == 1 else 'surface'}, seed {self.seed}, spectrum {self.spectrum}"
        if self.stretch != 1.0:
            text += f", stretched {self.stretch:g} times along {math.degrees(self.angle):g} degrees from x"
        return text + ("" if self.random_amplitudes else ", random phases only")

    def _check_spectrum(self) -> None:
        spectrum, profile = self.spectrum, self.shape[0] == 1
        if getattr(spectrum, "dimensions", 1 if profile else 2) != (1 if profile else 2):
            allowed = f"one of dimensions={1 if profile else 2}, for a map of shape {self.shape}"
            raise InputError("spectrum", str(spectrum), allowed)
        if profile and (self.stretch != 1.0 or self.angle != 0.0):
            raise InputError("stretch", self.stretch, "1 with angle 0, because a profile has only one direction")
        if isinstance(spectrum, SelfAffine):
            pitches = [length / count for length, count in zip(self.size, self.shape, strict=True)]
            least = 2.0 * (pitches[1] if profile else max(pitches)) / min(self.stretch, 1.0)
            if spectrum.shortest < least * (1.0 - 1e-9):
                allowed = f">= {least:g} m, two pitches of the map (over the stretch, if < 1)"
                raise InputError("shortest", spectrum.shortest, allowed)

    def _colour(self, waves: np.ndarray) -> None:
        """Multiply the Fourier transform of white noise by the square root of the power spectrum, in place; set the mean to 0.

        waves: output of `rfft2`. The factor is sqrt(s C / (dx dy)) for a map and sqrt(C / dx) for a profile, with the stretch
        s, the power spectral density C at the wavenumber (s q_along, q_across), and the point spacings dx, dy. Unless
        amplitudes are random, the amplitudes of the noise are first set to their rms value. Raises InputError for an unusable
        spectrum.
        """
        (rows, columns), size, spectrum = self.shape, self.size, self.spectrum
        cosine, sine = math.cos(self.angle), math.sin(self.angle)
        cell = size[1] / columns * (size[0] / rows if rows > 1 else 1.0)
        smallest = 2.0 * math.pi / max(size)
        for part, along_y, along_x in _blocks(self.shape, size):
            along = self.stretch * (cosine * along_x + sine * along_y)
            across = cosine * along_y - sine * along_x
            q = np.hypot(along, across)
            if part.start == 0:
                q[0, 0] = smallest  # a power law has no value at q = 0, the mean, which is set to 0 below
            density = np.asarray(spectrum(q) if callable(spectrum) else np.nan, dtype=float)
            if density.shape != q.shape or not (density >= 0.0).all() or np.isinf(density).any():
                raise InputError(
                    "spectrum", str(spectrum), "a function of an array q > 0 that returns finite values >= 0 of the same shape"
                )
            if not self.random_amplitudes:
                waves[part] *= math.sqrt(rows * columns) / np.maximum(np.abs(waves[part]), 1e-300)
            waves[part] *= np.sqrt(density * (self.stretch / cell))
        waves[0, 0] = 0.0
        if not waves.any():
            raise InputError(
                "spectrum", str(spectrum), "a spectrum with waves between twice the point spacing and the size of the map"
            )


def gaussian_surface(
    shape: tuple[int, int], size: tuple[float | str, float | str], spectrum: Spectrum, seed: int, *,
    stretch: float = 1.0, angle: float = 0.0, random_amplitudes: bool = True,
) -> HeightMap:  # fmt: skip
    """Generate a random periodic Gaussian surface or profile with a given power spectrum and mean height 0.

    Parameters
    ----------
    shape : (rows, columns)
        Number of points; (1, columns) makes a profile.
    size : (y, x) [m], each a number or text with a unit
        Size of the period.
    spectrum : callable
        Power spectral density C(q) at wavenumbers q [rad/m]: m^4 for a surface, m^3 for a profile, normalised as in
        `SelfAffine`, which is such a callable.
    seed : int
        Seed of the random numbers, at least 0. The same arguments give the same heights.
    stretch : float, optional
        Factor > 0 by which the surface is stretched along `angle`, by default 1 (isotropic).
    angle : float [rad], optional
        Direction of the stretch, from x towards y.
    random_amplitudes : bool, optional
        True (default): a Gaussian process, whose rms height scatters about the value from the spectrum. False: every wave has
        exactly its amplitude in the spectrum, only phases are random, and rms height and slope do not scatter.

    Returns
    -------
    HeightMap
        Heights of shape `shape` [m], periodic.

    Raises
    ------
    InputError
        A number is out of bounds, the map is too small, or it needs too much memory. The spectrum is negative or not finite,
        has no waves on the grid, has the wrong dimensions, or is a `SelfAffine` with waves shorter than two pitches. A
        profile has a stretch or an angle.

    Examples
    --------
    >>> import stiction as st
    >>> target = st.SelfAffine(hurst=0.8, rolloff="2 um", shortest="400 nm", deviation="10 nm")
    >>> surface = st.gaussian_surface((64, 64), ("10 um", "10 um"), target, seed=1, random_amplitudes=False)
    >>> surface.heights.shape
    (64, 64)
    >>> print(f"{1e9 * surface.heights.std():.1f} nm")
    10.0 nm
    """
    asked = _Periodic(shape, size_in_metres(size), spectrum, seed, stretch, angle, random_amplitudes)
    return HeightMap(asked.heights(), asked.size, (asked.history_line("Gaussian"),), periodic=True)


@with_keywords(Lay)
def non_gaussian_surface(
    shape: tuple[int, int], size: tuple[float | str, float | str], spectrum: Spectrum, seed: int, *,
    skewness: float, kurtosis: float, steps: int = 50, exact_spectrum: bool = False, **lay: Unpack[Lay],
) -> HeightMap:  # fmt: skip
    """Generate a random periodic surface with a given skewness and kurtosis of its heights and, nearly, a given spectrum.

    Parameters
    ----------
    shape, size, spectrum, seed
        As in `gaussian_surface`.
    skewness, kurtosis : float
        Skewness and kurtosis of the heights; a Gaussian surface has 0 and 3. Allowed: skewness^2 + 1 < kurtosis <= 50.
    steps : int, optional
        Largest number of iterations; 0 only replaces Gaussian heights by heights of the distribution, rank by rank.
    exact_spectrum : bool, optional
        True: meet the spectrum exactly and the distribution of heights nearly. False (default): the reverse. Choose True where
        slopes and curvatures matter: False adds waves that are too short for the spectrum, low in height but steep.
    **lay : float or bool
        stretch, angle [rad] and random_amplitudes, as in `gaussian_surface`.

    Returns
    -------
    HeightMap
        Heights of shape `shape` [m], periodic; the remaining error is in `history`.

    Raises
    ------
    InputError
        For the reasons listed in `gaussian_surface`, for a skewness and kurtosis that no heights can have, or for steps below
        0.

    Examples
    --------
    >>> import stiction as st
    >>> target = st.SelfAffine(hurst=0.8, rolloff="2 um", shortest="400 nm", deviation="10 nm")
    >>> worn = st.non_gaussian_surface((64, 64), ("10 um", "10 um"), target, seed=1, skewness=-1.0, kurtosis=5.0)
    >>> print(f"{(worn.heights**3).mean() / worn.heights.std() ** 3:.1f}")
    -1.0
    """
    curve = johnson(skewness, kurtosis)
    if steps < 0:
        raise InputError("steps", steps, ">= 0")
    asked = _Periodic(shape, size_in_metres(size), spectrum, seed, **lay)
    start = asked.heights()
    amplitudes = np.abs(rfft2(start, workers=_WORKERS))
    wanted = curve(ndtri((np.arange(start.size) + 0.5) / start.size))
    wanted = (wanted - wanted.mean()) * (start.std() / wanted.std())
    ranked, spectral, error, taken = _alternate(start, amplitudes, wanted, steps)
    step = asked.history_line("non-Gaussian")
    step += f", aimed at skewness {skewness:g} and kurtosis {kurtosis:g}; after {taken} steps the amplitudes of its waves "
    step += f"were {100.0 * error:.2g} % off in rms, and "
    step += "the spectrum was restored exactly" if exact_spectrum else "the heights are those of the distribution"
    return HeightMap(spectral if exact_spectrum else ranked, asked.size, (step,), periodic=True)


def with_slope(surface: HeightMap, slope: float) -> HeightMap:
    """Return a periodic map with all heights multiplied by one factor, so that its rms gradient is `slope` [1].

    Raises InputError if all heights are equal, points are missing, or `slope` is not above 0.
    """
    require_positive(slope=slope)
    found = rms_slope(surface)
    if not found > 0.0:
        raise InputError("heights", InWords("constant"), "heights that differ")
    return surface.with_heights(surface.heights * (slope / found), f"heights multiplied to an rms slope of {slope:g}")


def rms_slope(surface: HeightMap) -> float:
    """Return the rms gradient [1] of a periodic map, from the sum of q^2 |h|^2 over its Fourier waves (Parseval).

    All waves on the grid count fully; finite differences would underestimate the slope of short waves. Raises InputError if
    points are missing.
    """
    if not surface.complete:
        raise InputError("heights", InWords(f"{surface.missing} missing points"), "a map without missing points")
    rows, columns = surface.heights.shape
    power = wave_power(surface.heights)
    total = 0.0
    for part, along_y, along_x in _blocks(surface.heights.shape, surface.size):
        total += float(np.sum(power[part] * (along_y**2 + along_x**2)))
    return math.sqrt(total) / (rows * columns)


def _check_grid(shape, seed) -> None:
    pair = isinstance(shape, tuple | list) and len(shape) == 2
    whole = pair and all(isinstance(count, int | np.integer) and count > 0 for count in shape)
    if not whole or shape[1] < _LEAST_POINTS or 1 < shape[0] < _LEAST_POINTS:
        raise InputError("shape", shape, f"(rows, columns), at least {_LEAST_POINTS} each, or (1, columns) for a profile")
    require_arrays(shape, _ARRAYS)
    if not isinstance(seed, int | np.integer) or seed < 0:
        raise InputError("seed", seed, "an integer >= 0")


def _blocks(shape, size):
    """Yield blocks of rows of the output of `rfft2` for a map, as (slice of rows, q_y, q_x).

    shape: (rows, columns) of the map. size: (y, x) [m]. q_y (n, 1) and q_x (1, columns // 2 + 1) are the wavenumbers [rad/m]
    of the waves in the block.
    """
    rows, columns = shape
    along_y = 2.0 * math.pi * np.fft.fftfreq(rows, size[0] / rows)[:, np.newaxis]
    along_x = 2.0 * math.pi * np.fft.rfftfreq(columns, size[1] / columns)[np.newaxis, :]
    if rows == 1:
        along_y = np.zeros((1, 1))
    step = max(1, _BLOCK // along_x.size)
    for first in range(0, rows, step):
        part = slice(first, min(first + step, rows))
        yield part, along_y[part], along_x


def _alternate(start, amplitudes, wanted, steps):
    """Impose a distribution of heights and a spectrum in turn, until the error of the spectrum settles.

    - start: Gaussian heights (rows, columns) [m] from which the iteration starts
    - amplitudes: wanted absolute values of their `rfft2`
    - wanted: all heights [m] of the wanted distribution, ascending
    - steps: largest number of iterations after the first one

    Returns four values: the heights with the exact distribution; the heights with the exact spectrum; the relative rms error
    of the amplitudes of the heights with the exact distribution; and the number of steps.
    """
    spectral, last = start, math.inf
    size = math.sqrt(float(np.sum(amplitudes**2)))
    taken = -1
    while taken < steps:
        taken += 1
        ranked = np.empty_like(start)
        ranked.ravel()[np.argsort(spectral, axis=None)] = wanted
        waves = rfft2(ranked, workers=_WORKERS)
        found = np.abs(waves)
        error = math.sqrt(float(np.sum((found - amplitudes) ** 2))) / size
        waves *= amplitudes / np.maximum(found, 1e-300)
        spectral = irfft2(waves, s=start.shape, workers=_WORKERS, overwrite_x=True)
        if error > (1.0 - _SETTLED) * last:
            break
        last = error
    return ranked, spectral, error, taken
