"""What is read off a pressure map and a height map: edges of contact, waves.

Contact counted in pixels is too large, by a part of the pixels at its edge. For elastic contact the mean excess is
(Yastrebov, Anciaux & Molinari 2017, Tribology Int. 114, 161: from a straight edge at any angle across a pixel)

    A = A_pixels - (pi - 1 + ln 2)/24 S d                                                                                 (1)

S: length of the sides of pixels between contact and none; d: the pixel's side (so that S d is the number of such sides times a
pixel's area, as it is taken here where pixels are not square). The length of the true edge is pi/4 S, whatever its angle on
average. Where the pressure at the edge is the hardness, see `EDGE_SHARE`.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.fft import rfft2

from stiction.surfaces.boundary_elements.operators import wavevectors

__all__ = ["PIXEL_EXCESS", "Edges", "Waves", "edges", "rms_step", "waves"]

PIXEL_EXCESS = (math.pi - 1.0 + math.log(2.0)) / 24.0
_SHORT = 0.01  # share of the mean square gradient in waves shorter than the shortest
_LONG = 0.5  # share of the mean square height in waves longer than the longest
_WORKERS = 2


@dataclass(frozen=True)
class Edges:
    """Sides of pixels between contact and none: along y (next to each other in x) and along x; elastic: those of them, in
    number, at whose pressed side the pressure is below the hardness."""

    along_y: int
    along_x: int
    elastic: int

    @property
    def count(self) -> int:
        return self.along_y + self.along_x

    @property
    def counted_for_area(self) -> float:
        """As many of them as (1) should count."""
        return self.elastic


def edges(pressure: np.ndarray, hardness: float, periodic: bool) -> Edges:
    """Of a pressure map [Pa]; periodic: the last point is beside the first."""
    contact, flows = pressure > 0.0, pressure >= hardness
    counts, elastic = [], 0
    for axis in (1, 0):
        ahead, behind = _neighbours(contact, axis, periodic)
        side = ahead != behind
        flow_ahead, flow_behind = _neighbours(flows, axis, periodic)
        counts.append(int(np.count_nonzero(side)))
        elastic += int(np.count_nonzero(side & ~(flow_ahead | flow_behind)))
    return Edges(counts[0], counts[1], elastic)


def _neighbours(field, axis, periodic):
    """Each point's next along the axis, and the point."""
    if periodic:
        return np.roll(field, -1, axis), field
    first, last = [slice(None)] * 2, [slice(None)] * 2
    first[axis], last[axis] = slice(1, None), slice(None, -1)
    return field[tuple(first)], field[tuple(last)]


@dataclass(frozen=True)
class Waves:
    """Waves of a map [m]. shortest: those that are shorter hold 1 % of the mean square gradient; longest: those that are longer
    hold half of the mean square height; gradient: root mean square of all waves [1]."""

    shortest: float
    longest: float
    gradient: float


def waves(heights: np.ndarray, size: tuple[float, float], periodic: bool) -> Waves:
    """Of a map; heights: (rows, columns) [m]; size: (y, x) [m]. Where it is not periodic, under Hann's window, so that the step
    between its ends is no roughness."""
    heights = heights - heights.mean()
    if not periodic:
        window = np.outer(*(np.hanning(count + 2)[1:-1] if count > 1 else np.ones(1) for count in heights.shape))
        heights *= window / math.sqrt(float(np.mean(window**2)))
    k = wavevectors(heights.shape, size)
    power = np.square(np.abs(rfft2(heights, workers=_WORKERS))) / float(heights.size) ** 2
    power[:, 1 : (heights.shape[1] + 1) // 2] *= 2.0
    bins = np.linspace(0.0, float(k.max()) * (1.0 + 1e-9), 4 * max(heights.shape))
    height, _ = np.histogram(k, bins, weights=power)
    gradient, _ = np.histogram(k, bins, weights=power * k * k)
    return Waves(
        2.0 * math.pi / _where_sum_reaches(bins, gradient, 1.0 - _SHORT),
        2.0 * math.pi / _where_sum_reaches(bins, height, _LONG),
        math.sqrt(float(gradient.sum())),
    )


def _where_sum_reaches(edge, part, share):
    total = np.cumsum(part)
    return float(edge[1 + np.searchsorted(total, share * total[-1])])


def rms_step(heights: np.ndarray) -> float:
    """Root mean square height difference of a point and its next along x and y together [m]: what gaps are measured by."""
    return math.sqrt(sum(float(np.mean(np.square(np.diff(heights, axis=axis)))) for axis in (0, 1) if heights.shape[axis] > 1))
