"""Heights, slopes, curvatures and spectral moments of a height map.

All are about the mean height and nothing else: level the map first. Height parameters are those of ISO 25178-2, with means
over all points that have a height:

    Sq = <d^2>^(1/2)    Sa = <|d|>    Ssk = <d^3> / Sq^3    Sku = <d^4> / Sq^4 (Gaussian: 3)    Sz = highest - lowest

Slopes are differences of neighbouring points over the pitch (the slope midway between them), second derivatives are
(z[i+1] - 2 z[i] + z[i-1]) / pitch^2. Means go over all places whose points all have a height; nothing is carried around the
ends. Of a wave of wavevector q along the line, differences of points p apart see less than there is, by a factor of exactly
s = sin(q p / 2) / (q p / 2) for slopes and s^2 for second derivatives. ISO 25178-2 leaves open how Sdq is differentiated; a
difference over two pitches, or a polynomial through seven points, gives other numbers where the pitch is short of points.

Spectral moments are those of a profile (Nayak 1971), m0 = <z^2>, m2 = <(dz/dx)^2>, m4 = <(d2z/dx2)^2>:

    by differences   along x and along y as above, and their mean; points are as far apart along both as the coarser pitch says
    by spectrum      along x: sum_q C {1, q_x^2, q_x^4} / A over all waves |q| <= 2 pi / cutoff, along y alike; for an isotropic
                     surface from the radial average:   {1, 1/2, 3/8} (1/2 pi) Int q C(q) {1, q^2, q^4} dq

Where a surface has a lay, neither mean belongs to an isotropic surface. If it is an isotropic one stretched in any direction,
m4/m2^2 is the same along every line, and the product of the principal m2 is the determinant of the mean slope tensor: so

    m2 = (<z_x^2><z_y^2> - <z_x z_y>^2)^(1/2),        m4 = m2^2 times the geometric mean of m4/m2^2 along x and y           (1)

are those of the isotropic surface with as many summits per area, whose curvature is the geometric mean of the two principal
ones: by the affine map, derived here. On an isotropic surface both are the same.

On a surface with no shortest wave both grow without bound as the cutoff shrinks: m2 and m4 without their cutoff mean nothing.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.heightmap import HeightMap, in_metres
from stiction.surfaces.theory.moments import Moments

if TYPE_CHECKING:
    from stiction.surfaces.spectrum import PowerSpectrum  # whose module is slow to import

_BLOCK = 2**18  # points handled at once, so that a large map needs little more memory than itself
_ROUNDED = 1e-20  # share of the mean square slope that may be rounding
_ROUNDING = 1.0 + 1e-9  # a wave at the cutoff is counted in


@dataclass(frozen=True)
class Statistics:
    """Statistics of a map or profile, with the definitions at the top.

    Values are None where a profile has none.

    Sq, Sa, Sz [m]; Ssk, Sku [1]; mean: height from which they count [m]. slope_x, slope_y: root mean square slopes along x and
    y [1]; slope: of the gradient, Sdq, (slope_x^2 + slope_y^2)^(1/2). curvature_x, curvature_y: root mean square second
    derivatives [1/m]; curvature: of half the Laplacian (the mean of the two principal curvatures where slopes are small) [1/m].
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
    """Spectral moments of the profiles of a map, by one of two ways.

    x, y: of profiles along x and y, which shows the anisotropy (y: None for a profile); isotropic: of the isotropic surface
    taken in its place by the mean; equivalent: by (1), which allows for a lay; None where all slopes are along one line, so
    that there are no summits; cutoff: shortest wavelength that entered [m]; method: in words.
    """

    x: Moments
    y: Moments | None
    isotropic: Moments
    equivalent: Moments | None
    cutoff: float
    method: str


def statistics(surface: HeightMap) -> Statistics:
    """Compute height parameters, slopes and curvatures over the points with heights.

    Raises InputError if no point has one, all heights are alike, or no three neighbouring points along x (and along y) have
    one.
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
    """Compute spectral moments by finite differences.

    The points are half a cutoff wavelength apart, rounded to whole pitches.

    cutoff: [m], > 0, by default two of the larger pitches: differences of neighbours. Shorter waves are not smoothed away first
    but sampled, as by an instrument of that pitch: m0 still includes all points. Raises InputError as for `statistics`, or if
    the cutoff is too long.
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
    """Integrate the power spectrum over all waves not shorter than the cutoff.

    cutoff: wavelength [m], >= 0, by default two (of the larger) pitches, Nyquist's; 0 takes every wave on the grid, the
    shortest of which are along its diagonals. Reliable only if it is not below `spectrum.shortest`. `isotropic` belongs to the
    radial average; x and y are integrated each. Raises InputError if no wave is that long.
    """
    cutoff = 2.0 * spectrum.pitch if cutoff is None else in_metres(cutoff, "cutoff")
    if not (cutoff >= 0.0 and math.isfinite(cutoff)):
        raise InputError("cutoff", cutoff, ">= 0 m, finite")
    powers = _powers(spectrum, math.inf if cutoff == 0.0 else 2.0 * math.pi / cutoff * _ROUNDING)
    if not powers[0, 0] > 0.0:
        longest = 2.0 * math.pi / spectrum.lowest
        raise InputError("cutoff", cutoff, f"at most {longest:.4g} m, the longest wave, and heights that are not all alike")
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
    """Return the mean [m] and (Sq, Sa, Sz, Ssk, Sku)."""
    count = int(np.count_nonzero(~np.isnan(heights)))
    if not count:
        raise InputError("heights", "all missing", "some points that have a height")
    highest, lowest = float(np.nanmax(heights)), float(np.nanmin(heights))
    if not highest > lowest:
        raise InputError("heights", highest, "heights that are not all alike")
    start = (highest + lowest) / 2.0  # near the mean, so that a large offset costs no digits
    mean = start + sum(float(np.nansum(block - start)) for block in _blocks(heights)) / count
    span = highest - lowest  # heights over it: their fourth powers do not underflow
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
    """Yield views of _BLOCK points in rows, and `overlap` more rows of the next block."""
    rows = max(1, _BLOCK // heights.shape[1])
    for start in range(0, max(1, heights.shape[0] - overlap), rows):
        yield heights[start : start + rows + overlap]


def _difference(heights: np.ndarray, order: int, step: int) -> np.ndarray:
    """Return first or second differences along the rows, of points `step` apart."""
    for _ in range(order):
        heights = heights[:, step:] - heights[:, :-step]
    return heights


def _rms_difference(heights: np.ndarray, axis: int, order: int, step: int = 1) -> float:
    """Return the rms of the differences of an order along an axis.

    Only differences whose points all have a height count.
    """
    total, count = 0.0, 0
    if heights.shape[axis] > order * step:
        for block in _blocks(heights if axis == 1 else heights.T):
            part, number = _sum_of_squares(_difference(block, order, step))
            total, count = total + part, count + number
    return _root_mean(total, count, heights, f"{order * step + 1} points in a row along {'yx'[axis]}")


def _rms_laplacian(heights: np.ndarray, dy: float, dx: float) -> float:
    """Return the rms sum of both second derivatives, where all five points have a height."""
    total, count = 0.0, 0
    if min(heights.shape) > 2:
        for block in _blocks(heights, overlap=2):
            along_x = _difference(block[1:-1], 2, 1) / dx**2
            along_y = _difference(block[:, 1:-1].T, 2, 1).T / dy**2
            part, number = _sum_of_squares(along_x + along_y)
            total, count = total + part, count + number
    return _root_mean(total, count, heights, "a point with its four neighbours")


def _sum_of_squares(values: np.ndarray) -> tuple[float, int]:
    """Return the sum of squares and the number of the values that are not missing."""
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
    """Return equation (1), from the moments along both axes.

    It also needs the correlation of the slopes along them.
    """
    if not (min(x.m2, y.m2) > _ROUNDED * max(x.m2, y.m2) and abs(correlation) < 1.0 - 1e-9):
        return None
    m2 = math.sqrt(x.m2 * y.m2 * (1.0 - correlation * correlation))
    return Moments(x.m0, m2, m2 * m2 * math.sqrt(x.m4 * y.m4) / (x.m2 * y.m2))


def _slope_correlation(heights: np.ndarray, along_y: int, along_x: int) -> float:
    """Return the correlation of the slopes along x and y, in the middle of cells.

    A cell has four points, all with heights, that many points apart. The result is 1 where there are no slopes along one axis.
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
_EVEN = [0, 2, 3]  # their places of 0, 2 and 4


def _powers(spectrum: "PowerSpectrum", highest: float) -> np.ndarray:
    """Return (4, 4): sum_q C q_y^i q_x^j / A over 0 < |q| <= highest, i and j of _POWERS."""
    qy, qx = spectrum.wavevectors
    columns = spectrum.waves[:, None] * qx[:, None] ** _POWERS
    reach = np.sqrt(np.maximum(highest * highest - qy * qy, 0.0))
    ends = np.where(np.abs(qy) <= highest, np.searchsorted(qx, reach, side="right"), 0)
    sums = np.array([row[:end] @ columns[:end] for row, end in zip(spectrum.density, ends.tolist(), strict=True)])
    sums[0, 0] -= spectrum.density[0, 0]  # the wave q = 0
    return (qy[:, None] ** _POWERS).T @ sums / spectrum.extent
