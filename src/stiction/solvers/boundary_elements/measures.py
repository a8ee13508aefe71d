"""Measure contact edges of pressure maps and wavelengths of height maps.

A contact area counted in pixels is too large by part of the pixels at its edge. The corrected area is

    A = A_pixels - c S d                                                                                                  (1)

S: total length of the pixel sides between contact and no contact. d: side of a pixel. S d is the number of these sides times
the area of a pixel, also where pixels are not square. Yastrebov, Anciaux & Molinari (2017, Tribology Int. 114, 161) find c =
(pi - 1 + ln 2)/24 = .118 from a straight edge that crosses a pixel at any angle. For this solver, c was measured on
Westergaard's waves, whose area is known, at 23 angles (a test repeats it with fewer): c = .19 for edges along a pixel side, .11
at 14 degrees to it, .08 at 30 to 45 degrees, and .100 on average. If most edges run along one side of the pixels, as on maps
with a lay, c is larger:

    c = .100 + .090 r^4,  r = |S_x - S_y|/(S_x + S_y)                                                                     (2)

S_x and S_y are the lengths of sides along x and along y. (2) agrees with the measured c at 0 and 14 degrees. On maps with a lay
along a pixel side, it makes areas up to 4 % smaller, and as accurate as on other maps (validation/maps). The mean area of rough
maps with 8 points in the shortest wave is within 1 % of the area with 32 points; with c = .118 it is 1 to 2 % low.

c is smaller where the pressure at most of the edge is the hardness. The area is never less than the load divided by the
hardness, and is close to this limit where points yield. The length of the contact edge is pi/4 S, averaged over its directions.
"""

import math
from dataclasses import dataclass

import numpy as np

from stiction.solvers.boundary_elements.operators import wavevectors
from stiction.surfaces.spectrum import wave_power

PIXEL_EXCESS, _ALONG_PIXELS = 0.100, 0.090
_SHORT = 0.01  # fraction of the mean square gradient in waves below the wavelength called shortest
_LONG = 0.5  # fraction of the mean square height in waves above the wavelength called longest


@dataclass(frozen=True)
class Edges:
    """Count the pixel sides between contact and no contact.

    along_y: number of sides that run along y, between neighbours in x. along_x: number of sides that run along x, between
    neighbours in y.
    """

    along_y: int
    along_x: int

    @property
    def count(self) -> int:
        """Return the total number of pixel sides between contact and no contact."""
        return self.along_y + self.along_x

    @property
    def excess(self) -> float:
        """Return the number of pixels by which the contact area is too large if each pixel in contact counts fully.

        It is c times the number of pixel sides at the contact edge; c is larger if most edges run along one axis (equation (2)
        of this module).
        """
        one_way = abs(self.along_y - self.along_x) / max(self.count, 1)
        return (PIXEL_EXCESS + _ALONG_PIXELS * one_way**4) * self.count

    def perimeter(self, shape: tuple[int, ...], size: tuple[float, float]) -> float:
        """Return the length of the contact edge [m] of a map of shape (rows, columns) and size (y, x) [m]."""
        return 0.25 * math.pi * (self.along_y * size[0] / shape[0] + self.along_x * size[1] / shape[1])


def edges(contact: np.ndarray, periodic: bool) -> Edges:
    """Count the pixel sides between contact and no contact, along both axes.

    contact: mask (rows, columns) of points in contact. periodic: whether the last row and column are neighbours of the first.
    """
    return Edges(_changes(contact, periodic), _changes(contact.T, periodic))


def corrected_area(pressure: np.ndarray, pixel: float, periodic: bool, hardness: float) -> float:
    """Return the contact area [m2] of a pressure map (rows, columns) [Pa], corrected for the pixels at its edge.

    The area is at least the load divided by the hardness [Pa], which may be infinite. pixel: area of a point [m2]. periodic:
    whether the map repeats.
    """
    contact = pressure > 0.0
    counted = int(np.count_nonzero(contact)) * pixel
    return max(counted - edges(contact, periodic).excess * pixel, float(pressure.sum()) * pixel / hardness)


def _changes(contact, periodic):
    """Return the number of pairs of neighbours in a row with one point in contact and the other out of contact.

    contact: mask (rows, columns). periodic: whether the last point of a row is a neighbour of its first.
    """
    count = int(np.count_nonzero(contact[:, 1:] != contact[:, :-1]))
    return count + int(np.count_nonzero(contact[:, 0] != contact[:, -1])) if periodic else count


@dataclass(frozen=True)
class Waves:
    """Store the characteristic wavelengths and the gradient of a map.

    shortest [m]: waves shorter than this contribute 1 % of the mean square gradient. longest [m]: waves longer than this
    contribute half of the mean square height. gradient: rms gradient of all waves [1]. pitch: the larger point spacing [m].
    side: the shorter side of the map [m].
    """

    shortest: float
    longest: float
    gradient: float
    pitch: float
    side: float

    @property
    def points_in_shortest_wave(self) -> float:
        """Return the shortest wavelength divided by the larger point spacing."""
        return self.shortest / self.pitch

    @property
    def longest_waves_on_a_side(self) -> float:
        """Return the length of the shorter side of the map divided by the longest wavelength."""
        return self.side / self.longest


def waves(heights: np.ndarray, size: tuple[float, float], periodic: bool) -> Waves:
    """Return the shortest and longest wavelength, rms gradient, point spacing and shorter side of a map.

    heights: (rows, columns) [m]. size: (y, x) [m]. A map that is not periodic is multiplied by Hann's window, so that the step
    between its opposite edges does not count as roughness.
    """
    heights = heights - heights.mean()
    if not periodic:
        window = np.outer(*(np.hanning(count + 2)[1:-1] for count in heights.shape))
        heights *= window / math.sqrt(float(np.mean(window**2)))
    k = wavevectors(heights.shape, size)
    power = wave_power(heights) / float(heights.size) ** 2
    bins = np.linspace(0.0, float(k.max()) * (1.0 + 1e-9), 4 * max(heights.shape))
    places = (k * (1.0 / bins[1])).astype(np.int32).ravel()
    height = np.bincount(places, power.ravel(), minlength=bins.size - 1)
    gradient = np.bincount(places, (power * k * k).ravel(), minlength=bins.size - 1)
    return Waves(
        2.0 * math.pi / _where_sum_reaches(bins, gradient, 1.0 - _SHORT),
        2.0 * math.pi / _where_sum_reaches(bins, height, _LONG),
        math.sqrt(float(gradient.sum())),
        coarsest_pitch(heights.shape, size),
        min(size),
    )


def coarsest_pitch(shape: tuple[int, int], size: tuple[float, float]) -> float:
    """Return the larger of the two point spacings [m] of a map of shape (rows, columns) and size (y, x) [m]."""
    return max(length / count for length, count in zip(size, shape, strict=True))


def _where_sum_reaches(edge, part, share):
    total = np.cumsum(part)
    return float(edge[1 + np.searchsorted(total, share * total[-1])])


def rms_step(heights: np.ndarray) -> float:
    """Return the rms height difference of neighbouring points [m], which the solvers use as unit of gaps.

    The mean squared differences along both axes are added before the root is taken.
    """
    return math.sqrt(sum(float(np.mean(np.square(np.diff(heights, axis=axis)))) for axis in (0, 1)))
