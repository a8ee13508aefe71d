"""From the pressure on every point of a map to the displacement of every point, by fast Fourier transforms.

Periodic: the transform of the pressure times C(k) (Stanley & Kato 1997, J. Tribology 119, 481). Where the bodies are
half-spaces, the mean displacement of one period is infinite; it is left out, and displacements are about their mean.

Mirrored: the map is a window of a larger surface, continued by its mirror images along both axes, to a period of twice its
sides. Pressure and displacement are even about every side, so that cosine transforms of the window alone do what Fourier
transforms of the period would.

Free: the map ends, and nothing presses outside of it. Pressure is uniform on each pixel; convolution on a grid twice as large
along both axes, so that no copy of the map is seen (Hockney; Liu, Wang & Liu 2000, Wear 243, 101: DC-FFT). The influence of one
pixel of sides 2a, 2b on a half-space is (Love 1929; Johnson 1985, Contact Mechanics, eq. 3.25)

    u(x, y) = p/(pi E*) [f(x+a, y+b) - f(x+a, y-b) - f(x-a, y+b) + f(x-a, y-b)],   f = x arsinh(y/|x|) + y arsinh(x/|y|)   (1)

and with a film three parts, far = 1/E* of long, near = 1/E* of short waves:

    C(k) = near (2/k) + (far - near) (2/k) e^(-k c) + D(k)                                                                (2)

The first is (1). The second is 1/(pi (r^2 + c^2)^(1/2)) of a point force; over a pixel, in place of f of (1),

    f = x arsinh(y/(x^2 + c^2)^(1/2)) + y arsinh(x/(y^2 + c^2)^(1/2)) - c arctan(x y/(c (x^2 + y^2 + c^2)^(1/2)))         (3)

D is finite at k = 0, falls off as e^(-2 k t), and is transformed on the doubled grid; c = 1.5 t. (2) and (3) derived here.
The copies of D that this leaves shift displacements by about (t/L)^3 of the largest, L the side of the map: 1e-3 at L = 10 t.

Every boundary computes in the precision of the pressure it is given, single or double. Its `inverse` divides each wave by C(k):
exact on a periodic or mirrored map, and only near to it on a map that ends.
"""

import math
from functools import cached_property

import numpy as np
from scipy.fft import dctn, fftfreq, idctn, ifft, irfft, next_fast_len, rfft2, rfftfreq

from stiction.solvers.boundary_elements.compliance import Compliance

_THREADED = 2**19  # points from which on two threads are faster than one
_DEPTH = 1.5  # c over t


def components(shape: tuple[int, int], size: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Return k_y as a column and k_x as a row [1/m] of the entries of `rfft2`.

    size: (y, x) [m] of the grid.
    """
    (rows, columns), (high, wide) = shape, size
    along_y = 2.0 * math.pi * fftfreq(rows, high / rows)
    return along_y[:, None], 2.0 * math.pi * rfftfreq(columns, wide / columns)


def wavevectors(shape: tuple[int, int], size: tuple[float, float]) -> np.ndarray:
    """Return |k| of the entries of `rfft2` [1/m]; size: (y, x) [m] of the grid."""
    return np.hypot(*components(shape, size))


class _Kernel:
    """The factors of all waves in single and double precision."""

    def __init__(self, factors: np.ndarray):
        self._double = factors

    @cached_property
    def _single(self) -> np.ndarray:
        return self._double.astype(np.float32)

    def like(self, values: np.ndarray) -> np.ndarray:
        """Return the factors in the precision of these values."""
        return self._single if values.dtype == np.float32 else self._double


class PeriodicBoundary:
    """The compliance operator of a periodic map.

    shape: (rows, columns). size: (y, x) [m]. knows_approach: whether displacements are absolute; if not, their mean is zero.
    """

    inverts = True

    def __init__(self, compliance: Compliance, shape: tuple[int, int], size: tuple[float, float]):
        self.shape = shape
        self.knows_approach = compliance.far == 0.0
        self._kernel = _Kernel(compliance.at(wavevectors(shape, size)))

    def __call__(self, pressure: np.ndarray) -> np.ndarray:
        """Return the displacement [m], positive away from the pressure [Pa]."""
        return _through(pressure, self.shape, self._kernel)

    @cached_property
    def _stiffness(self) -> _Kernel:
        return _Kernel(_inverted(self._kernel.like(np.empty(0))))

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Return the pressure [Pa] whose displacement [m] this is, of zero mean where C(0) is not defined."""
        return _through(displacement, self.shape, self._stiffness)


class MirroredBoundary:
    """The compliance operator of a window that is continued by its mirror images.

    shape: (rows, columns). size: (y, x) [m]. knows_approach: as in PeriodicBoundary.
    """

    inverts = True

    def __init__(self, compliance: Compliance, shape: tuple[int, int], size: tuple[float, float]):
        self.knows_approach = compliance.far == 0.0
        along_y, along_x = (math.pi * np.arange(count) / length for count, length in zip(shape, size, strict=True))
        self._kernel = _Kernel(compliance.at(np.hypot(along_y[:, None], along_x)))

    def __call__(self, pressure: np.ndarray) -> np.ndarray:
        """Return the displacement [m], positive away from the pressure [Pa]."""
        return _through_cosines(pressure, self._kernel)

    @cached_property
    def _stiffness(self) -> _Kernel:
        return _Kernel(_inverted(self._kernel.like(np.empty(0))))

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Return the pressure [Pa] whose displacement [m] this is, of zero mean where C(0) is not defined."""
        return _through_cosines(displacement, self._stiffness)


class FreeBoundary:
    """The compliance operator of a map with no pressure outside of it.

    shape: (rows, columns). size: (y, x) [m].
    """

    knows_approach = True
    inverts = False

    def __init__(self, compliance: Compliance, shape: tuple[int, int], size: tuple[float, float]):
        self.shape = shape
        self._periodic = PeriodicBoundary(compliance, shape, size)
        pitch = (size[0] / shape[0], size[1] / shape[1])
        self._doubled = tuple(next_fast_len(2 * count, real=True) for count in shape)
        kernel = compliance.near * _of_pixels(self._doubled, pitch)
        if compliance.films:
            kernel += (compliance.far - compliance.near) * _of_pixels(self._doubled, pitch, _DEPTH * compliance.depth)
        waves = rfft2(kernel).real.copy()  # even in both directions: no imaginary part
        if compliance.films:
            waves += _rest(compliance, self._doubled, pitch)
        self._kernel = _Kernel(waves)

    def __call__(self, pressure: np.ndarray) -> np.ndarray:
        """Return the displacement [m], positive away from the pressure [Pa]."""
        return _through(pressure, self._doubled, self._kernel)[: self.shape[0], : self.shape[1]].copy()

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Return an approximate pressure [Pa] for this displacement [m].

        It is exact for a periodic map, but not for a map that ends.
        """
        return self._periodic.inverse(displacement)


def _through(pressure, grid, kernel):
    """Return the pressure, zero-padded to the grid, convolved with the kernel."""
    workers = _workers(grid[0] * grid[1])
    waves = rfft2(pressure, s=grid, workers=workers)
    waves *= kernel.like(pressure)
    waves = ifft(waves, axis=0, workers=workers, overwrite_x=True)  # by itself: irfft2 would copy the waves
    return irfft(waves, n=grid[1], axis=1, workers=workers)


def _through_cosines(pressure, kernel):
    """Multiply the pressure with the kernel in the cosines of a window."""
    workers = _workers(pressure.size)
    waves = dctn(pressure, workers=workers)
    waves *= kernel.like(pressure)
    return idctn(waves, workers=workers, overwrite_x=True)


def _inverted(factors):
    """Return 1/C(k), and 0 where C(k) is 0."""
    return np.divide(1.0, factors, out=np.zeros_like(factors), where=factors > 0.0)


def _workers(points):
    return 1 if points < _THREADED else 2


def _distances(shape, pitch):
    """Return (y, x) [m] from the first point of a periodic grid to nearest copies."""
    rows, columns = shape
    return fftfreq(rows, 1.0 / (rows * pitch[0]))[:, None], fftfreq(columns, 1.0 / (columns * pitch[1]))


def _of_pixels(shape, pitch, depth=0.0):
    """Return (1), or its replacement (3), times E*/p [m]."""
    y, x = _distances(shape, pitch)
    b, a = 0.5 * pitch[0], 0.5 * pitch[1]
    total = _corner(x + a, y + b, depth)
    total -= _corner(x + a, y - b, depth)
    total -= _corner(x - a, y + b, depth)
    total += _corner(x - a, y - b, depth)
    return total / math.pi


def _corner(x, y, depth):
    """Return f of (1) and (3); no corner of a pixel lies on an axis."""
    if depth == 0.0:
        return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    corner = x * np.arcsinh(y / np.hypot(x, depth))
    corner += y * np.arcsinh(x / np.hypot(y, depth))
    corner -= depth * np.arctan(x * y / (depth * np.sqrt(x * x + y * y + depth * depth)))
    return corner


def _rest(compliance, shape, pitch):
    """Return D(k) of (2) [m/Pa] on a grid, for a pixel of uniform pressure."""
    k = wavevectors(shape, (shape[0] * pitch[0], shape[1] * pitch[1]))
    depth = _DEPTH * compliance.depth
    k[0, 0] = 1e-3 / depth  # D is finite at 0, and this near to it
    rest = compliance.times_half_k(k) - compliance.near
    rest -= (compliance.far - compliance.near) * np.exp(-depth * k)
    return 2.0 * rest / k
