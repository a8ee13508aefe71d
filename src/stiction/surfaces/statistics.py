"""Compute heights, slopes, curvatures and spectral moments of a height map.

All heights d refer to the mean height; a tilt is not removed, so level the map first. The height parameters are those of ISO
25178-2. Means < > run over all points with a height:

    Sq = <d^2>^(1/2)    Sa = <|d|>    Ssk = <d^3> / Sq^3    Sku = <d^4> / Sq^4 (Gaussian: 3)    Sz = highest - lowest

A slope is the height difference of neighbouring points over their pitch. A second derivative is (z[i+1] - 2 z[i] + z[i-1]) /
pitch^2. Means run over all positions whose points all have a height. The map is not continued periodically. For a wave with
wavevector q along the line, differences of points at distance p underestimate the slope by exactly the factor s = sin(q p /
2) / (q p / 2) and the second derivative by s^2. ISO 25178-2 does not prescribe how Sdq is differentiated. A difference over
two pitches, or a polynomial through seven points, gives other values if the pitch does not resolve the shortest waves.

Spectral moments are those of a profile (Nayak 1971), m0 = <z^2>, m2 = <(dz/dx)^2>, m4 = <(d2z/dx2)^2>:

    by differences   along x and along y as above, and their mean; both directions use nearly equal point distances, set by
                     the coarser pitch or the cutoff
    by spectrum      along x: sum_q C {1, q_x^2, q_x^4} / A over all waves |q| <= 2 pi / cutoff, and likewise along y; for an
                     isotropic surface from the radial average:   {1, 1/2, 3/8} (1/2 pi) Int q C(q) {1, q^2, q^4} dq

For a surface with a lay these means do not describe an isotropic surface. Equation (1) assumes an isotropic surface that was
stretched along one direction. Then m4/m2^2 is the same along every line, and the product of the principal m2 is the determinant
of the mean slope tensor. Hence

    m2 = (<z_x^2><z_y^2> - <z_x z_y>^2)^(1/2),        m4 = m2^2 times the geometric mean of m4/m2^2 along x and y           (1)

are the moments of an isotropic surface with the same number of summits per area. Its curvature is the geometric mean of the
two principal curvatures. (1) is derived here from the affine map. For an isotropic surface, (1) equals the means above.

On a surface without a shortest wave, m2 and m4 grow without bound as the cutoff decreases: state the cutoff with them.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.heightmap import HeightMap, in_metres
from stiction.surfaces.theory.moments import Moments

if TYPE_CHECKING:
    from stiction.surfaces.spectrum import PowerSpectrum  # whose module is slow to import

_BLOCK = 2**18  # points processed at once, so that a large map needs little more memory than itself
_ROUNDED = 1e-20  # fraction of the mean square slope that may be round-off
_ROUNDING = 1.0 + 1e-9  # includes a wave at the cutoff in spite of round-off


@dataclass(frozen=True)
class Statistics:
    """Store the height, slope and curvature parameters of a map or profile (definitions in the module docstring).

    - Sq, Sa, Sz [m]: rms height, mean absolute height, highest minus lowest; Ssk, Sku [1]: skewness and kurtosis
    - mean: mean height [m], from which heights are measured
    - slope_x, slope_y: rms slopes along x and y [1]; slope: rms gradient Sdq = (slope_x^2 + slope_y^2)^(1/2)
    - curvature_x, curvature_y: rms second derivatives [1/m]; curvature: rms of half the Laplacian [1/m], which is the mean of
      the two principal curvatures for small slopes

    For a profile slope_y, slope, curvature_y and curvature are None.
    """

    Sq: float
    Sa: float
    Sz: float
    Ssk: float
    Sku: float
    mean: float
    slope_x: float
    slope_y: float | None
    slope: float | None
    curvature_x: float
    curvature_y: float | None
    curvature: float | None


@dataclass(frozen=True)
class ProfileMoments:
    """Store the spectral moments m0, m2, m4 of the profiles of a map.

    - x, y: moments of profiles along x and along y; y is None for a profile
    - isotropic: moments of an isotropic surface, from averages over the directions
    - equivalent: moments from equation (1) of the module docstring, which allows for a lay; None if all slopes lie along one
      line, so that the surface has no summits
    - cutoff: shortest wavelength included [m]; for finite differences, twice the distance of the points used
    - method: how they were computed, "finite differences" or "power spectrum"

    For a profile, isotropic and equivalent equal x.
    """

    x: Moments
    y: Moments | None
    isotropic: Moments
    equivalent: Moments | None
    cutoff: float
    method: str


def statistics(surface: HeightMap) -> Statistics:
    """Compute height parameters, rms slopes and rms curvatures of a map or profile; missing points are left out.

    Raises InputError if no point has a height, if all heights are equal, or if no three neighbouring points along x have
    heights; for a map, also if no point has four neighbours with heights.
    """
    heights, (dy, dx) = surface.heights, surface.pitch
    mean, heights_of = _height_parameters(heights)
    slope_x = _rms_difference(heights, 1, 1) / dx
    curvature_x = _rms_difference(heights, 1, 2) / dx**2
    if surface.is_profile:
        return Statistics(*heights_of, mean, slope_x, None, None, curvature_x, None, None)
    slope_y = _rms_difference(heights, 0, 1) / dy
    curvature_y = _rms_difference(heights, 0, 2) / dy**2
    curvature = 0.5 * _rms_laplacian(heights, dy, dx)
    return Statistics(
        *heights_of,
        mean,
        slope_x,
        slope_y,
        math.hypot(slope_x, slope_y),
        curvature_x,
        curvature_y,
        curvature,
    )


def moments_by_differences(surface: HeightMap, cutoff: float | None = None) -> ProfileMoments:
    """Compute the spectral moments m0, m2, m4 of a map or profile by finite differences.

    cutoff: wavelength [m], > 0. The points used for a difference are half a cutoff apart, rounded to whole pitches. By default
    the cutoff is twice the larger pitch: the points are neighbours where both pitches are equal. Shorter waves are not removed:
    the map is sampled as by an instrument with half a cutoff as its pitch, and m0 includes all points. Raises InputError if all
    heights are missing or equal, if no three points at this distance along a direction have heights, and for a cutoff that is
    not > 0 or too long.
    """
    cutoff = None if cutoff is None else in_metres(cutoff, "cutoff")
    if cutoff is not None and not (cutoff > 0.0 and math.isfinite(cutoff)):
        raise InputError("cutoff", cutoff, "> 0 m, finite")
    heights, pitches = surface.heights, surface.pitch
    _, (deviation, *_) = _height_parameters(heights)
    wanted = 2.0 * surface.coarsest_pitch if cutoff is None else cutoff
    profiles, steps, reached = [], [], 0.0
    for axis in (1,) if surface.is_profile else (1, 0):
        step = max(1, round(wanted / (2.0 * pitches[axis])))
        distance = step * pitches[axis]
        if step > 1 and heights.shape[axis] <= 2 * step:
            longest = (heights.shape[axis] - 1) * pitches[axis]
            raise InputError("cutoff", wanted, f"at most {longest:.4g} m, from the first to the last point along {'yx'[axis]}")
        slope = _rms_difference(heights, axis, 1, step) / distance
        second = _rms_difference(heights, axis, 2, step) / distance**2
        profiles.append(Moments(deviation**2, slope**2, second**2))
        steps.append(step)
        reached = max(reached, 2.0 * distance)
    if surface.is_profile:
        return ProfileMoments(profiles[0], None, profiles[0], profiles[0], reached, "finite differences")
    x, y = profiles
    equivalent = _equivalent(x, y, _slope_correlation(heights, steps[1], steps[0]))
    return ProfileMoments(x, y, _mean(x, y), equivalent, reached, "finite differences")


def moments_by_spectrum(spectrum: "PowerSpectrum", cutoff: float | None = None) -> ProfileMoments:
    """Compute the spectral moments m0, m2, m4 by integrating a power spectrum down to a cutoff wavelength.

    cutoff: wavelength [m], >= 0. The default is twice the larger pitch (Nyquist). 0 includes every wave on the grid; the
    shortest of these run along its diagonals. The moments are reliable only if the cutoff is at least `spectrum.shortest`.
    Raises InputError for another cutoff, if no wave is at least as long as the cutoff, and if all heights are equal.
    """
    cutoff = 2.0 * spectrum.pitch if cutoff is None else in_metres(cutoff, "cutoff")
    if not (cutoff >= 0.0 and math.isfinite(cutoff)):
        raise InputError("cutoff", cutoff, ">= 0 m, finite")
    powers = _powers(spectrum, math.inf if cutoff == 0.0 else 2.0 * math.pi / cutoff * _ROUNDING)
    if not powers[0, 0] > 0.0:
        longest = 2.0 * math.pi / spectrum.lowest
        raise InputError("cutoff", cutoff, f"at most {longest:.4g} m, the longest wavelength of a map of unequal heights")
    x = Moments(*map(float, powers[0, _EVEN]))
    if spectrum.is_profile:
        return ProfileMoments(x, None, x, x, cutoff, "power spectrum")
    y = Moments(*map(float, powers[_EVEN, 0]))
    fourth = powers[0, 3] + 2.0 * powers[2, 2] + powers[3, 0]
    isotropic = Moments(x.m0, (x.m2 + y.m2) / 2.0, float(3.0 / 8.0 * fourth))  # means of cos^2 and cos^4 over directions
    correlation = float(powers[1, 1]) / math.sqrt(x.m2 * y.m2) if x.m2 * y.m2 > 0.0 else 1.0
    return ProfileMoments(x, y, isotropic, _equivalent(x, y, correlation), cutoff, "power spectrum")


# ---- heights


def _height_parameters(heights: np.ndarray) -> tuple[float, tuple[float, float, float, float, float]]:
    """Return the mean height [m] of a map, and (Sq, Sa, Sz, Ssk, Sku) as defined in the module docstring.

    heights: (rows, columns) [m], NaN where missing. Raises InputError if no height is known or all are equal.
    """
    count = int(np.count_nonzero(~np.isnan(heights)))
    if not count:
        raise InputError("heights", InWords("all missing"), "a map with heights at some points")
    highest, lowest = float(np.nanmax(heights)), float(np.nanmin(heights))
    if not highest > lowest:
        raise InputError("heights", highest, "heights that differ")
    start = (highest + lowest) / 2.0  # close to the mean, so that a large offset costs no digits
    mean = start + sum(float(np.nansum(block - start)) for block in _blocks(heights)) / count
    span = highest - lowest  # heights are divided by it, so that their fourth powers do not underflow
    sums = np.zeros(4)
    for block in _blocks(heights):
        d = (block[~np.isnan(block)] - mean) / span
        squares = d * d
        sums += np.abs(d).sum(), squares.sum(), squares @ d, squares @ squares
    first, second, third, fourth = (float(value) for value in sums / count)
    deviation = math.sqrt(second)
    return mean, (deviation * span, first * span, span, third / deviation**3, fourth / deviation**4)


# ---- differences


def _blocks(heights: np.ndarray, overlap: int = 0) -> Iterator[np.ndarray]:
    """Yield consecutive blocks of whole rows of a map, of about _BLOCK points each.

    overlap: number of rows of the next block that are added to each block.
    """
    rows = max(1, _BLOCK // heights.shape[1])
    for start in range(0, max(1, heights.shape[0] - overlap), rows):
        yield heights[start : start + rows + overlap]


def _difference(heights: np.ndarray, order: int, step: int) -> np.ndarray:
    """Return the first (order 1) or second (order 2) differences along each row, between points `step` columns apart."""
    for _ in range(order):
        heights = heights[:, step:] - heights[:, :-step]
    return heights


def _rms_difference(heights: np.ndarray, axis: int, order: int, step: int = 1) -> float:
    """Return the rms of the first or second differences of heights along an axis, in the unit of the heights.

    axis: 0 along y, 1 along x. order: 1 or 2. step: distance of the points, in pitches. Differences with a missing point are
    left out; raises InputError if none is left.
    """
    total, count = 0.0, 0
    if heights.shape[axis] > order * step:
        for block in _blocks(heights if axis == 1 else heights.T):
            part, number = _sum_of_squares(_difference(block, order, step))
            total, count = total + part, count + number
    return _root_mean(total, count, heights, f"{order * step + 1} points in a row along {'yx'[axis]}")


def _rms_laplacian(heights: np.ndarray, dy: float, dx: float) -> float:
    """Return the rms Laplacian [1/m] of a map; positions with a missing point among the five points needed are left out.

    heights: (rows, columns) [m]. dy, dx: pitches [m].
    """
    total, count = 0.0, 0
    if min(heights.shape) > 2:
        for block in _blocks(heights, overlap=2):
            along_x = _difference(block[1:-1], 2, 1) / dx**2
            along_y = _difference(block[:, 1:-1].T, 2, 1).T / dy**2
            part, number = _sum_of_squares(along_x + along_y)
            total, count = total + part, count + number
    return _root_mean(total, count, heights, "a point with its four neighbours")


def _sum_of_squares(values: np.ndarray) -> tuple[float, int]:
    """Return the sum of squares of all values of a two-dimensional array that are not NaN, and their number."""
    total, count = float(np.einsum("ij,ij->", values, values)), values.size
    if math.isnan(total):
        there = values[~np.isnan(values)]
        total, count = float(there @ there), there.size
    return total, count


def _root_mean(total: float, count: int, heights: np.ndarray, needed: str) -> float:
    if not count:
        missing = int(np.count_nonzero(np.isnan(heights)))
        shape = f"{heights.shape[0]} x {heights.shape[1]} points, {missing} missing"
        raise InputError("heights", shape, f"at least {needed}, none of them missing")
    return math.sqrt(total / count)


# ---- moments


def _mean(x: Moments, y: Moments) -> Moments:
    return Moments((x.m0 + y.m0) / 2.0, (x.m2 + y.m2) / 2.0, (x.m4 + y.m4) / 2.0)


def _equivalent(x: Moments, y: Moments, correlation: float) -> Moments | None:
    """Return the moments of the isotropic surface that, when stretched, gives this surface: equation (1) of the module.

    x, y: moments of profiles along x and along y. correlation: correlation coefficient of the slopes along x and y. The result
    is None if all slopes lie along one line, because the surface then has no summits.
    """
    if not (min(x.m2, y.m2) > _ROUNDED * max(x.m2, y.m2) and abs(correlation) < 1.0 - 1e-9):
        return None
    m2 = math.sqrt(x.m2 * y.m2 * (1.0 - correlation * correlation))
    return Moments(x.m0, m2, m2 * m2 * math.sqrt(x.m4 * y.m4) / (x.m2 * y.m2))


def _slope_correlation(heights: np.ndarray, along_y: int, along_x: int) -> float:
    """Return the correlation coefficient of the slopes along x and along y, taken at the centres of cells of the map.

    A cell has four corner points, `along_y` rows and `along_x` columns apart. Cells with a missing corner are left out. The
    result is 1 if all slopes along x or along y are zero.
    """
    sums = np.zeros(3)
    for block in _blocks(heights, overlap=along_y):
        if block.shape[0] <= along_y:
            continue
        x, y = block[:, along_x:] - block[:, :-along_x], block[along_y:] - block[:-along_y]
        x, y = x[along_y:] + x[:-along_y], y[:, along_x:] + y[:, :-along_x]
        if np.isnan(block).any():
            there = ~np.isnan(x + y)
            x, y = x[there], y[there]
        sums += np.vdot(x, x), np.vdot(y, y), np.vdot(x, y)
    xx, yy, xy = map(float, sums)
    return xy / math.sqrt(xx * yy) if xx * yy > 0.0 else 1.0


_POWERS = np.array([0, 1, 2, 4])
_EVEN = [0, 2, 3]  # indices of the powers 0, 2 and 4


def _powers(spectrum: "PowerSpectrum", highest: float) -> np.ndarray:
    """Return the sums (4, 4) of C q_y^i q_x^j over the waves with 0 < |q| <= highest, divided by the size of the map.

    The size is the area of a map or the length of a profile. C: power spectral density. q_y, q_x: components of the wavevector
    [rad/m]. i, j: row and column of the result, each 0, 1, 2, 4.
    """
    qy, qx = spectrum.wavevectors
    columns = spectrum.waves[:, None] * qx[:, None] ** _POWERS
    reach = np.sqrt(np.maximum(highest * highest - qy * qy, 0.0))
    ends = np.where(np.abs(qy) <= highest, np.searchsorted(qx, reach, side="right"), 0)
    sums = np.array([row[:end] @ columns[:end] for row, end in zip(spectrum.density, ends.tolist(), strict=True)])
    sums[0, 0] -= spectrum.density[0, 0]  # the wave q = 0
    return (qy[:, None] ** _POWERS).T @ sums / spectrum.extent
