"""Compute ISO 25178-2 areal parameters that `statistics` does not compute, and name profile parameters as in ISO 21920-2.

The height d of a point is measured from the mean of the map. Level and filter the map first. Missing points are excluded.

    Sp, Sv          height of the highest point, and depth of the lowest
    Sdr             area of the surface divided by its projected area, minus 1. The area of each cell of four points is the mean
                    of both ways to cut it into two triangles (ISO 25178-2:2021, D.3)
    Sal, Str        Sal is the shortest distance at which the normalised autocorrelation falls to 0.2. Str is Sal divided by
                    the longest such distance, None if that distance exceeds the map. The autocorrelation at a distance is
                    the mean product of the heights d of all pairs of points at this distance, divided by its value at 0
    Sk, Spk, Svk,   parameters of the material ratio curve (annex B.1). A straight line is fitted to the 40 % of the curve with
    Smr1, Smr2      the least steep secant. Between the ratios 0 and 100 % it spans the core height Sk. Smr1 and Smr2 are the
                    ratios where the curve leaves the core. Spk and Svk are the heights of triangles with the areas above and
                    below the core

The curve has 10,001 quantiles. On maps with more than 1024 points along a side the autocorrelation uses every second (third,
...) point. The parameters agree with surfalize 0.19.2, scikit-image and shapely to 1e-8
(tests/surfaces/test_areal_parameters.py). The autocorrelation is linear between neighbouring points; a cubic spline changes
Sal by up to 4e-4. surfalize takes Sal, Str, Spk and Svk at the nearest of its points and differs by up to 2.2e-3.
"""

import math
from dataclasses import dataclass

import numpy as np

from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.statistics import Statistics

_LEVELS, _WINDOW = 10_001, 4_000  # quantiles of the material ratio curve, and how many steps make 40 % of it
_FALLEN = 0.2
_MOST_POINTS = 1024  # along a side, for the autocorrelation


@dataclass(frozen=True)
class ArealParameters:
    """Store the areal parameters of a map, with the names and definitions of ISO 25178-2.

    Lengths (Sp, Sv, Sal, Sk, Spk, Svk) are in m, the others are fractions (0.1 for 10 %). Sal is None if the autocorrelation
    falls to 0.2 in no direction within the map. Str is None if, in some direction, it stays above 0.2 within the map.
    """

    Sp: float
    Sv: float
    Sdr: float
    Sal: float | None
    Str: float | None
    Sk: float
    Spk: float
    Svk: float
    Smr1: float
    Smr2: float


def areal_parameters(surface: HeightMap) -> ArealParameters:
    """Return the ISO 25178-2 areal parameters of a levelled map.

    surface: a map, not a profile, because a profile has no areal parameters; this is not checked.
    """
    depth = surface.heights - np.nanmean(surface.heights)
    shortest, longest = _decay(depth, surface.pitch)
    aspect = None if shortest is None or longest is None else shortest / longest
    heights = float(np.nanmax(depth)), -float(np.nanmin(depth))
    return ArealParameters(*heights, _developed(depth, surface.pitch), shortest, aspect, *_material_ratio(depth))


def profile_parameters(surface: HeightMap, found: Statistics) -> dict[str, float]:
    """Return the roughness parameters of a profile over its whole length, by their names in ISO 21920-2; lengths in m.

    found: statistics of this profile, from `statistics`. Names begin with R (Ra, Rq ...) if a filter has removed long
    wavelengths, otherwise with P (Pa, Pq ...), for the primary profile.
    """
    steps = [step for step in surface.history if step.startswith("filtered to wavelengths")]
    letter = "R" if any(" to all:" not in step for step in steps) else "P"
    values = {"a": found.Sa, "q": found.Sq, "t": found.Sz, "sk": found.Ssk, "ku": found.Sku, "dq": found.slope_x}
    return {letter + name: value for name, value in values.items()}


def _developed(heights: np.ndarray, pitch: tuple[float, float]) -> float:
    dy, dx = pitch
    y, x = (np.diff(heights, axis=axis) / step for axis, step in ((0, dy), (1, dx)))
    corners = [np.sqrt(1.0 + a**2 + b**2) for a in (x[:-1], x[1:]) for b in (y[:, :-1], y[:, 1:])]
    return float(np.nanmean(sum(corners)) / 4.0 - 1.0)


def _decay(depth: np.ndarray, pitch: tuple[float, float]) -> tuple[float | None, float | None]:
    """Return the shortest and the longest distance [m] at which the autocorrelation of a map falls to 0.2.

    depth: heights (rows, columns) [m] above their mean. pitch: distance (dy, dx) of neighbouring points [m]. The
    autocorrelation is 1 at distance 0. The shortest distance is None if the autocorrelation falls to 0.2 in no direction within
    the map. The longest distance is None unless the autocorrelation falls to 0.2 within the map in every direction.
    """
    from scipy.ndimage import label
    from scipy.signal import fftconvolve

    every = math.ceil(max(depth.shape) / _MOST_POINTS)
    some = depth[::every, ::every]
    known = np.isfinite(some)
    filled = np.where(known, some, 0.0)
    pairs = fftconvolve(known.astype(float), known[::-1, ::-1].astype(float))
    table = fftconvolve(filled, filled[::-1, ::-1]) / np.maximum(pairs, 1.0)
    centre = tuple(size - 1 for size in some.shape)
    table = table / table[centre] - _FALLEN
    regions = label(table > 0.0)[0]
    inside = regions == regions[centre]
    edges = np.concatenate([inside[0], inside[-1], inside[:, 0], inside[:, -1]])
    y, x = ((np.arange(size) - at) * step * every for size, at, step in zip(table.shape, centre, pitch, strict=True))
    radii = []
    for axis in (0, 1):
        first, last = [slice(None)] * 2, [slice(None)] * 2
        first[axis], last[axis] = slice(None, -1), slice(1, None)
        start, end = tuple(first), tuple(last)
        crossed = inside[start] ^ inside[end]
        share = (table[start] / np.where(crossed, table[start] - table[end], 1.0))[crossed]
        ends = [np.broadcast_to(one, table.shape) for one in (y[:, None], x[None, :])]
        at = [one[start][crossed] + share * (one[end] - one[start])[crossed] for one in ends]
        radii.append(np.hypot(*at))
    found = np.concatenate(radii)
    return (float(found.min()) if found.size else None), (float(found.max()) if found.size and not edges.any() else None)


def _material_ratio(depth: np.ndarray) -> tuple[float, float, float, float, float]:
    """Return the parameters Sk [m], Spk [m], Svk [m], Smr1 and Smr2 of the material ratio curve (ISO 25178-2, annex B.1).

    depth: heights (rows, columns) [m] above their mean. Smr1 and Smr2 are fractions.
    """
    ratio = np.linspace(0.0, 1.0, _LEVELS)
    curve = np.quantile(depth[np.isfinite(depth)], 1.0 - ratio)
    start = int(np.argmin(curve[:-_WINDOW] - curve[_WINDOW:]))
    core = slice(start, start + _WINDOW + 1)
    slope, upper = np.polyfit(ratio[core], curve[core], 1)
    lower = upper + slope
    first, second = (float(np.interp(-height, -curve, ratio)) for height in (upper, lower))
    above, below = (_positive_area(excess) / (_LEVELS - 1) for excess in (curve - upper, lower - curve))
    peaks, dales = 2.0 * above / first if first > 0.0 else 0.0, 2.0 * below / (1.0 - second) if second < 1.0 else 0.0
    return float(upper - lower), float(peaks), float(dales), first, second


def _positive_area(values: np.ndarray) -> float:
    """Return the area between the zero line and the positive parts of a polyline through values (n,), one unit apart."""
    first, last = values[:-1], values[1:]
    high = np.maximum(np.maximum(first, last), 0.0)
    crossed = high**2 / (2.0 * np.maximum(np.abs(last - first), 1e-300))
    return float(np.where(np.minimum(first, last) >= 0.0, (first + last) / 2.0, crossed).sum())
