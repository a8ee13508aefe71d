"""Prepare a measured surface for analysis: level, remove form, fill, crop, and filter to a band of wavelengths.

Each step takes a HeightMap and returns a new one, with the step added to its history. Missing points stay missing unless
filled. Fits and filters use only the points that have heights.
"""

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.fft
from numpy.polynomial.legendre import legvander

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.shown import show
from stiction.surfaces.fill import fill_missing
from stiction.surfaces.heightmap import HeightMap, in_metres, metres
from stiction.surfaces.held import as_height_map
from stiction.surfaces.spikes import mask_spikes

if TYPE_CHECKING:
    from stiction.quantities.arguments import QuantityLike

_APART = 5.0  # least ratio of height steps across the edges to those between neighbours for which a map is not one period


def prepared(
    surface: HeightMap,
    form: int = 1,
    spikes: float | None = None,
    fill: str | None = None,
    shortest: "QuantityLike | None" = None,
    longest: "QuantityLike | None" = None,
) -> HeightMap:
    """Prepare a scan for analysis: remove its form, and filter it to a band of wavelengths.

    Parameters
    ----------
    surface : HeightMap
        Heights (rows, columns) [m], as `read_scan` returns them.
    form : int, optional
        Order of the polynomial to remove: 1 (default) for the mean plane, 0 for none, at most 4.
    spikes : float, optional
        Mask points whose distance from the median height is more than this number of robust standard deviations (1.4826 times
        the median distance). The map is levelled first; the form is removed afterwards. By default no point is masked.
    fill : {"harmonic", "nearest"}, optional
        How missing points are filled, see `fill_missing`; by default they stay missing.
    shortest, longest : float [m] or str with a unit, optional
        Ends of the band of wavelengths that is kept; by default open.

    Returns
    -------
    HeightMap
        Heights of the same shape [m], with every step in `history`. They are not periodic if form, spikes or wavelengths are
        removed.

    Raises
    ------
    InputError
        An option is out of its bounds, fewer points have heights than the form has coefficients, or only round-off remains
        after spikes and form are removed.

    Examples
    --------
    >>> import stiction as st
    >>> target = st.SelfAffine(hurst=0.8, rolloff="2 um", shortest="400 nm", deviation="10 nm")
    >>> surface = st.gaussian_surface((64, 64), ("10 um", "10 um"), target, seed=1)
    >>> print(st.prepared(surface, shortest="500 nm").history[-1].split(":")[0])
    filtered to wavelengths 500 nm to all
    """
    surface = raw = as_height_map(surface)
    if spikes is not None:
        surface = mask_spikes(level(surface), spikes)
    if isinstance(form, bool) or form not in (0, 1, 2, 3, 4):
        raise InputError("form", form, "0, 1, 2, 3 or 4: the order of the polynomial that is removed; 0 for none")
    if form == 1:
        surface = level(surface)
    elif form:
        surface = remove_form(surface, order=form)
    _check_left(raw, surface)
    if fill is not None:
        surface = fill_missing(surface, fill)
    return surface if shortest is None and longest is None else filter_band(surface, shortest, longest)


def prepared_period(
    surface: HeightMap, spikes: float | None = None, fill: str | None = None, shortest: Any = None, longest: Any = None
) -> HeightMap:
    """Prepare a map that is one period of a surface: filter it to a band of wavelengths, and subtract its mean height.

    surface: the period; no form is removed from it. spikes, fill, shortest, longest: as in `prepared`. Missing points stay
    missing unless filled; a map with missing points is not filtered.
    """
    if spikes is not None:
        surface = mask_spikes(surface, spikes)
    if fill is not None:
        surface = fill_missing(surface, fill)
    if surface.complete and (shortest is not None or longest is not None):
        surface = filter_period(surface, shortest, longest)
    return surface.with_heights(surface.heights - np.nanmean(surface.heights), f"mean removed{_seam(surface)}")


def _seam(surface: HeightMap) -> str:
    """Return a warning for the history if opposite edges of one period do not match; "" if they match.

    They do not match if the rms height step across the edges is at least 5 times the rms step between neighbouring points.
    """
    heights = surface.heights
    far = 0.0
    for axis in (axis for axis in (0, 1) if heights.shape[axis] > 1):
        within = float(np.nanmean(np.square(np.diff(heights, axis=axis))))
        across = np.square(np.take(heights, 0, axis=axis) - np.take(heights, -1, axis=axis))
        if np.isfinite(across).any() and within > 0.0:
            far = max(far, math.sqrt(float(np.nanmean(across)) / within))
    if far < _APART:
        return ""
    return (
        " of one period, whose opposite edges do not match: "
        f"height steps across them are {far:.0f} times those between neighbouring points"
    )


def _check_left(raw: HeightMap, surface: HeightMap) -> None:
    """Raise InputError if only round-off remains after spikes and form are removed.

    raw, surface: the map before and after the removal.
    """
    if surface is raw or not np.isfinite(surface.heights).any():
        return
    before, after = (float(np.nanmax(one.heights) - np.nanmin(one.heights)) for one in (raw, surface))
    offset = max(abs(float(np.nanmax(raw.heights))), abs(float(np.nanmin(raw.heights))))
    if after <= 1e-12 * before + 8.0 * np.finfo(float).eps * offset:
        raise InputError(
            "scan", InWords(f"{surface.name} is flat once its form is removed"), "a scan that is rough after form removal"
        )


# ---- form


def level(surface: HeightMap) -> HeightMap:
    """Return the map minus its least-squares mean plane, or a profile minus its mean line.

    The result is not periodic. Raises InputError if fewer points have heights than the plane or line has coefficients.
    """
    fitted = "line" if surface.is_profile else "plane"
    return surface.with_heights(_without_polynomial(surface, 1), f"levelled: least-squares {fitted} removed").alone()


def remove_form(surface: HeightMap, order: int) -> HeightMap:
    """Return the map minus its least-squares polynomial in x and y.

    order: total order of the polynomial, 1 to 4. It is fitted to the points with heights. The result is not periodic.
    Raises InputError for another order, or if fewer points have heights than the polynomial has coefficients.
    """
    if isinstance(order, bool) or order not in (1, 2, 3, 4):
        raise InputError("order", order, "1, 2, 3 or 4, the order of the polynomial to remove")
    step = f"form removed: least-squares polynomial of order {order}"
    return surface.with_heights(_without_polynomial(surface, order), step).alone()


def _without_polynomial(surface: HeightMap, order: int) -> np.ndarray:
    """Return the heights (rows, columns) [m] of a map minus their least-squares polynomial of total order `order` in x and y.

    Legendre polynomials over -1..1 keep the normal equations well conditioned; they are summed row by row, so that the matrix
    of all points and terms never exists. A second fit to the residual removes the round-off of the first. Raises InputError if
    there are fewer points than coefficients.
    """
    heights = surface.heights
    rows, columns = heights.shape
    there = None if surface.complete else ~np.isnan(heights)
    along_x, along_y = legvander(_unit(columns), order), legvander(_unit(rows), order)
    terms = [(i, j) for i in range(order + 1) for j in range(order + 1 - i) if rows > 1 or j == 0]
    if heights.size - surface.missing < len(terms):
        raise InputError(
            "scan",
            InWords(f"{heights.size - surface.missing} points with heights"),
            f"at least {len(terms)} points with heights for this fit",
        )
    left = heights - np.nanmean(heights)
    gram = _gram(there, along_x, along_y, terms)
    for _ in range(2):
        known = left if there is None else np.where(there, left, 0.0)
        moments = along_y.T @ (known @ along_x)
        solved = np.linalg.lstsq(gram, np.array([moments[j, i] for i, j in terms]), rcond=1e-13)[0]
        coefficients = np.zeros((order + 1, order + 1))  # by order in y and order in x
        coefficients[[j for _, j in terms], [i for i, _ in terms]] = solved
        left -= along_y @ coefficients @ along_x.T
    return left


def _unit(count: int) -> np.ndarray:
    return np.linspace(-1.0, 1.0, count) if count > 1 else np.zeros(1)


def _gram(there: np.ndarray | None, along_x: np.ndarray, along_y: np.ndarray, terms) -> np.ndarray:
    """Return the matrix (terms, terms) of the sums over points of the products of two terms P_i(x) P_j(y).

    - there: mask of the points with heights (rows, columns); None for all
    - along_x, along_y: Legendre polynomials P at all columns (columns, order + 1) and rows (rows, order + 1)
    - terms: list of (i, j)
    """
    n = along_x.shape[1]
    pairs_x = (along_x[:, :, None] * along_x[:, None, :]).reshape(-1, n * n)
    pairs_y = (along_y[:, :, None] * along_y[:, None, :]).reshape(-1, n * n)
    if there is None:
        sums = np.outer(pairs_y.sum(axis=0), pairs_x.sum(axis=0))
    else:
        sums = pairs_y.T @ np.stack([row @ pairs_x for row in there])
    sums = sums.reshape(n, n, n, n)
    return np.array([[sums[j, q, i, p] for p, q in terms] for i, j in terms])


# ---- crop


def crop(surface: HeightMap, *, y: tuple | None = None, x: tuple | None = None) -> HeightMap:
    """Return the part of the map between two positions along y and along x.

    y, x: (start, stop), in metres or text with a unit ("2 um"), from the first row or column; None keeps all points. Point
    i lies at i times the pitch and is kept if start <= i pitch < stop. The new size is count times pitch. Raises InputError if
    a position is outside the map or no point is left.
    """
    kept, sizes, words = [], [], []
    for name, given, count, pitch in zip("yx", (y, x), surface.heights.shape, surface.pitch, strict=True):
        first, last = (0, count) if given is None else _range(name, given, count, pitch)
        kept.append(slice(first, last))
        sizes.append((last - first) * pitch)
        if given is not None:
            words.append(f"{name} {show(first * pitch, 'scan_size')} to {show(last * pitch, 'scan_size')}")
    step = "cropped: " + (", ".join(words) or "nothing")
    return surface.with_heights(surface.heights[tuple(kept)].copy(), step, size=(sizes[0], sizes[1])).alone()


def _range(name: str, given, count: int, pitch: float) -> tuple[int, int]:
    """Return the index of the first point to keep along an axis, and the index after the last.

    name: "y" or "x", for the error. given: (start, stop), in metres or text with a unit. count: number of points. pitch: their
    distance [m]. Raises InputError if a position is outside the map or no point is left.
    """
    largest = show(count * pitch, "scan_size")
    allowed = f"(start, stop) with 0 m <= start < stop <= {largest}, and at least one map point between them"
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise InputError(f"crop {name}", given, allowed)
    start, stop = (in_metres(place, f"crop {name}") for place in given)
    if not 0.0 <= start < stop < math.inf:
        raise InputError(f"crop {name}", given, allowed)
    first, last = (math.ceil(place / pitch - 1e-6) for place in (start, stop))  # 1e-6: rounding of text and of the pitch
    if not first < last <= count:
        raise InputError(f"crop {name}", given, allowed)
    return first, last


# ---- filter


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
    low = None if shortest is None else metres(shortest, "shortest")
    high = None if longest is None else metres(longest, "longest")
    if low is None and high is None:
        raise InputError("band", None, "the shortest wavelength, the longest, or both")
    finest = 2.0 * surface.coarsest_pitch
    size = surface.size[1] if surface.is_profile else max(surface.size)
    for name, given, end in (("shortest", shortest, low), ("longest", longest, high)):
        if end is not None and not finest * (1.0 - 1e-9) <= end <= size * (1.0 + 1e-9):
            allowed = f"{show(finest, 'scan_size')} (twice the pitch) to {show(size, 'scan_size')} (the size)"
            raise InputError(name, _as_given(given, end), allowed)
    if low is not None and high is not None and not low < high:
        raise InputError("longest", _as_given(longest, high), f"more than {show(low, 'scan_size')}, the shortest wavelength")
    ends = " to ".join("all" if end is None else show(end, "scan_size") for end in (low, high))
    return low, high, f"filtered to wavelengths {ends}: Gaussian ISO 16610, 50 % at the cutoffs"


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
