"""Filter a height map to a band of wavelengths with the Gaussian filters of ISO 16610."""

import math
from typing import Any

import numpy as np
import scipy.fft

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.shown import show
from stiction.surfaces.heightmap import HeightMap, metres


def filter_band(surface: HeightMap, shortest=None, longest=None) -> HeightMap:
    """Return the map with only the wavelengths between two cutoffs (Gaussian filters, ISO 16610).

    shortest, longest: cutoffs, numbers in metres or text with a unit ("800 nm"); None for no such cutoff. Along x and along y
    the weights are exp(-pi (x / (alpha lambda))^2) / (alpha lambda) with the cutoff lambda and alpha = sqrt(ln 2 / pi). The
    transmission is exp(-ln 2 (lambda / wavelength)^2), 50 % at the cutoff (ISO 16610-21 and -61). At edges and missing points
    the remaining weights are renormalised, and the filter does not reproduce a slope. Therefore level the map first, and
    exclude half a cutoff at each edge from statistics. Missing points stay missing. The result is not periodic. Raises
    InputError unless 2 pitch (the larger one) <= shortest < longest <= size (of the longest side), or if both are None.
    """
    low, high, band = _band(surface, shortest, longest)
    heights = surface.heights
    if low is not None:
        heights = _smooth(heights, surface.pitch, low)
    if high is not None:
        heights = heights - _smooth(heights, surface.pitch, high)
    return surface.with_heights(heights, f"{band}, weights renormalised at edges and missing points").alone()


def filter_period(surface: HeightMap, shortest=None, longest=None) -> HeightMap:
    """Return one period of a surface with only the wavelengths between two cutoffs; the result is a period too.

    The Gaussian filters of `filter_band` wrap around the edges. shortest, longest: as in `filter_band`. Raises InputError as
    `filter_band` does, and for missing points.
    """
    low, high, band = _band(surface, shortest, longest)
    if not surface.complete:
        raise InputError(
            "heights", InWords(f"{surface.missing} missing points"), "a map without missing points; fill them first"
        )
    along = [scipy.fft.fftfreq(surface.heights.shape[0], surface.pitch[0])]
    along.append(scipy.fft.rfftfreq(surface.heights.shape[1], surface.pitch[1]))
    squared = along[0][:, None] ** 2 + along[1] ** 2
    kept = np.ones(squared.shape)
    for cutoff, sign in ((low, 1.0), (high, -1.0)):
        if cutoff is not None:
            passed = np.exp(-np.minimum(math.log(2.0) * cutoff**2 * squared, 700.0))
            kept *= passed if sign > 0.0 else 1.0 - passed
    heights = scipy.fft.irfft2(scipy.fft.rfft2(surface.heights) * kept, s=surface.heights.shape)
    return surface.with_heights(heights, f"{band}, continued periodically over the edges")


def _as_given(given, length: float) -> str:
    """Return a length for an error: the text of the user, or a number [m] with a prefixed unit."""
    return given if isinstance(given, str) else InWords(show(length, "scan_size"))


def _band(surface: HeightMap, shortest: Any, longest: Any) -> tuple[float | None, float | None, str]:
    """Return both cutoffs of a filter [m] (None for an open end) and a description of the filter.

    shortest, longest: as in `filter_band`. Raises InputError if both are None or one is out of range.
    """
    if shortest is None and longest is None:
        raise InputError("band", None, "the shortest wavelength, the longest, or both")
    finest = 2.0 * surface.coarsest_pitch
    size = surface.size[1] if surface.is_profile else max(surface.size)
    ends = []
    for name, given in (("shortest", shortest), ("longest", longest)):
        end = None if given is None else metres(given, name)
        if end is not None and not finest * (1.0 - 1e-9) <= end <= size * (1.0 + 1e-9):
            allowed = f"{show(finest, 'scan_size')} (twice the pitch) to {show(size, 'scan_size')} (the size)"
            raise InputError(name, _as_given(given, end), allowed)
        ends.append(end)
    low, high = ends
    if low is not None and high is not None and not low < high:
        raise InputError("longest", _as_given(longest, high), f"more than {show(low, 'scan_size')}, the shortest wavelength")
    words = " to ".join("all" if end is None else show(end, "scan_size") for end in ends)
    return low, high, f"filtered to wavelengths {words}: Gaussian ISO 16610, 50 % at the cutoffs"


def _smooth(heights: np.ndarray, pitch: tuple[float, float], cutoff: float) -> np.ndarray:
    """Return the Gaussian mean of the heights around each point (rows, columns) [m]; NaN at missing points.

    pitch: distance (dy, dx) of neighbouring points [m]. cutoff: wavelength [m] at which the mean transmits 50 %. Weights beyond
    edges and at missing points are 0, and the others are renormalised.
    """
    missing = np.isnan(heights)
    axes = [axis for axis in (0, 1) if heights.shape[axis] > 1]
    if not missing.any():
        mean = heights.copy()
        for axis in axes:
            shape = [1, 1]
            shape[axis] = heights.shape[axis]
            _convolve(mean, axis, cutoff / pitch[axis])
            weight = np.ones(shape)
            _convolve(weight, axis, cutoff / pitch[axis])
            mean /= weight
        return mean
    mean = np.where(missing, 0.0, heights)
    weight = (~missing).astype(float)
    for axis in axes:
        _convolve(mean, axis, cutoff / pitch[axis])
        _convolve(weight, axis, cutoff / pitch[axis])
    weight[missing] = 1.0
    mean /= weight
    mean[missing] = np.nan
    return mean


_REACH = 1.5  # padding in cutoffs, where the weight is 1e-14 of the largest (1e-3 for cutoffs of 2 or 3 pitches, which ring)
_AT_ONCE = 1 << 21  # numbers that are transformed together; the limit bounds the memory of a filter


def _convolve(values: np.ndarray, axis: int, cutoff: float) -> None:
    """Convolve every line of an array along one axis with a Gaussian, in place, with zeros beyond the ends.

    cutoff: wavelength, in points, at which the Gaussian transmits 50 %. Lines are padded, transformed in groups, and multiplied
    by the transmission of the Gaussian.
    """
    lines = np.moveaxis(values, axis, 1)
    count = lines.shape[1]
    padded = scipy.fft.next_fast_len(count + min(count, math.ceil(_REACH * cutoff)), real=True)
    exponent = math.log(2.0) * (cutoff * scipy.fft.rfftfreq(padded)) ** 2
    passed = np.exp(-np.minimum(exponent, 700.0))
    block = max(1, _AT_ONCE // padded)
    for start in range(0, lines.shape[0], block):
        part = scipy.fft.rfft(lines[start : start + block], padded, axis=1, workers=2)
        part *= passed
        lines[start : start + block] = scipy.fft.irfft(part, padded, axis=1, workers=2)[:, :count]
