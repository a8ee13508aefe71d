"""Compute the normal displacement of a map from its pressure, by fast Fourier transforms.

Periodic map: the transform of the pressure is multiplied by the compliance C(k) at the wavenumber k (Stanley & Kato 1997, J.
Tribology 119, 481). The mean displacement of half-spaces under a periodic pressure is infinite. It is omitted, so displacements
have zero mean.

Mirrored map: a window of a larger surface, continued by mirror images along both axes. The period is twice the sides of the
window. Pressure and displacement are even about every side, so cosine transforms of the window suffice.

Free map: there is no pressure outside the map. The pressure is uniform on each pixel. The convolution uses a grid that is twice
as large along both axes, so that copies of the map have no effect (Hockney; Liu, Wang & Liu 2000, Wear 243, 101: DC-FFT). One
pixel with sides 2a, 2b displaces a half-space by (Love 1929; Johnson 1985, Contact Mechanics, eq. 3.25)

    u(x, y) = p/(pi E*) [f(x+a, y+b) - f(x+a, y-b) - f(x-a, y+b) + f(x-a, y-b)],   f = x arsinh(y/|x|) + y arsinh(x/|y|)   (1)

With a film the compliance has three parts. `far` is 1/E* for long waves, `near` is 1/E* for short waves:

    C(k) = near (2/k) + (far - near) (2/k) e^(-k c) + D(k)                                                                (2)

The first part is (1). The second is 1/(pi (r^2 + c^2)^(1/2)) for a point force at the distance r. For a pixel, f in (1) becomes

    f = x arsinh(y/(x^2 + c^2)^(1/2)) + y arsinh(x/(y^2 + c^2)^(1/2)) - c arctan(x y/(c (x^2 + y^2 + c^2)^(1/2)))         (3)

The third part D(k) is finite at k = 0, falls as e^(-2 k t) with the film thickness t, and is transformed on the doubled grid; c
= 1.5 t. (2) and (3) are derived here. Periodic copies of D change displacements by about (t/L)^3 of the largest displacement,
with L the side of the map: 1e-3 at L = 10 t.

Every operator computes in the precision of its argument, single or double, and with its array library. `inverse` divides each
wave by C(k). This is exact on a periodic or mirrored map, and approximate on a free map.
"""

import math
from functools import cached_property

import numpy as np
from scipy.fft import dctn, fftfreq, idctn, next_fast_len, rfft2, rfftfreq

from stiction.solvers.boundary_elements.arrays import backward, forward, is_numpy, like, namespace, workers
from stiction.solvers.boundary_elements.compliance import Compliance

_DEPTH = 1.5  # the length c of (2), divided by the film thickness


def components(shape: tuple[int, int], size: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Return the wavevector components k_y (rows, 1) and k_x (1, columns of the transform) of `rfft2` [rad/m].

    shape: (rows, columns) of the grid. size: (y, x) of the grid [m].
    """
    (rows, columns), (high, wide) = shape, size
    along_y = 2.0 * math.pi * fftfreq(rows, high / rows)
    return along_y[:, None], 2.0 * math.pi * rfftfreq(columns, wide / columns)


def wavevectors(shape: tuple[int, int], size: tuple[float, float]) -> np.ndarray:
    """Return the wavenumbers (2 pi / wavelength) of the entries of `rfft2` [rad/m].

    shape: (rows, columns) of the grid. size: (y, x) of the grid [m].
    """
    return np.hypot(*components(shape, size))


class _Kernel:
    """Store the factors by which Fourier or cosine components are multiplied, for every library, device and precision in use.

    factors: in the order of the transform.
    """

    def __init__(self, factors: np.ndarray):
        self.factors = factors
        self._copies: dict[tuple, np.ndarray] = {}

    def like(self, values: np.ndarray) -> np.ndarray:
        """Return the factors of all waves as an array with the library, device and precision of `values`."""
        key = type(values), values.dtype, values.device

        if key not in self._copies:
            self._copies[key] = like(self.factors, values)
        return self._copies[key]

    @cached_property
    def mirrored(self) -> "_Kernel":
        """Return the factors of a cosine transform in the order of the real Fourier transform of the mirrored map.

        The mirrored map consists of the map and its mirror images and is twice as large along both axes.
        """
        padded = np.pad(self.factors, ((0, 1), (0, 1)))  # an even map has no wave of the shortest length
        return _Kernel(np.concatenate([padded, padded[-2:0:-1]]))


class PeriodicBoundary:
    """Compute displacements of a periodic map from its pressure.

    compliance: elastic compliance of both bodies at each wavenumber. shape: (rows, columns). size: (y, x) [m]. The attribute
    `has_mean` is True if the mean displacement is defined; otherwise it is set to zero.
    """

    inverts = True

    def __init__(self, compliance: Compliance, shape: tuple[int, int], size: tuple[float, float]):
        self.has_mean = compliance.far == 0.0
        self._kernel = _Kernel(compliance.at(self._wavenumbers(shape, size)))

    def __call__(self, pressure: np.ndarray) -> np.ndarray:
        """Return the displacement (rows, columns) [m] due to a pressure map [Pa], positive where the face is pushed back."""
        return self._convolved(pressure, self._kernel)

    @cached_property
    def _stiffness(self) -> _Kernel:
        factors = self._kernel.factors
        return _Kernel(np.divide(1.0, factors, out=np.zeros_like(factors), where=factors > 0.0))

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Return the pressure (rows, columns) [Pa] that causes a displacement map [m].

        Its mean is zero if the mean displacement is not defined, as for half-spaces.
        """
        return self._convolved(displacement, self._stiffness)

    def _wavenumbers(self, shape, size):
        return wavevectors(shape, size)

    def _convolved(self, values, kernel):
        return _through(values, values.shape, kernel)


class MirroredBoundary(PeriodicBoundary):
    """Compute displacements of a window of a larger surface, continued by mirror images on all sides.

    Window and mirror images together are a periodic map with twice the sides. Array libraries other than NumPy have no cosine
    transforms, and use the Fourier transform of this larger map.
    """

    def _wavenumbers(self, shape, size):
        along_y, along_x = (math.pi * np.arange(count) / length for count, length in zip(shape, size, strict=True))
        return np.hypot(along_y[:, None], along_x)

    def _convolved(self, values, kernel):
        if not is_numpy(values):
            shape, xp = values.shape, namespace(values)
            for axis in (0, 1):
                values = xp.concat([values, xp.flip(values, axis=axis)], axis=axis)
            return _corner_of(_through(values, values.shape, kernel.mirrored), shape)
        threads = workers(values.size)
        waves = dctn(values, workers=threads)
        waves *= kernel.like(values)
        return idctn(waves, workers=threads, overwrite_x=True)


class FreeBoundary:
    """Compute displacements of a map with no pressure outside it.

    compliance: elastic compliance of both bodies at each wavenumber. shape: (rows, columns). size: (y, x) [m].
    """

    has_mean = True
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
        """Return the displacement (rows, columns) [m] due to a pressure map [Pa], positive where the face is pushed back."""
        return _corner_of(_through(pressure, self._doubled, self._kernel), self.shape)

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Return a pressure (rows, columns) [Pa] that approximately causes this displacement map [m].

        The pressure is exact for a periodic map, but only approximate for this map, which is not periodic.
        """
        return self._periodic.inverse(displacement)


def _through(pressure, grid, kernel):
    """Return the convolution of a pressure map with a kernel.

    grid: shape (rows, columns) to which the map is first padded with zeros. kernel: Fourier transform of the kernel on this
    grid.
    """
    waves = forward(pressure, grid)
    waves *= kernel.like(pressure)
    return backward(waves, grid)


def _corner_of(values, shape):
    """Return a copy of the corner of a map with the first rows and columns; shape: (rows, columns) of the corner."""
    return namespace(values).asarray(values[: shape[0], : shape[1]], copy=True)


def _distances(shape, pitch):
    """Return the signed distances from the first point of a periodic grid to all points, (rows, 1) and (columns,) [m].

    The first array is along y, the second along x. pitch: point spacings (y, x) [m]. Each distance is to the nearest periodic
    copy of the first point.
    """
    rows, columns = shape
    return fftfreq(rows, 1.0 / (rows * pitch[0]))[:, None], fftfreq(columns, 1.0 / (columns * pitch[1]))


def _of_pixels(shape, pitch, depth=0.0):
    """Return the displacement of a half-space at every point due to a uniform pressure on the first pixel: (rows, columns).

    The displacement is multiplied by E*/p [m], with the contact modulus E* and the pressure p. shape: (rows, columns). pitch:
    point spacings (y, x) [m]. depth: length c [m]; 0 gives equation (1) of this module, > 0 the smoother response (3) of a
    film.
    """
    y, x = _distances(shape, pitch)
    b, a = 0.5 * pitch[0], 0.5 * pitch[1]
    total = _corner(x + a, y + b, depth)
    total -= _corner(x + a, y - b, depth)
    total -= _corner(x - a, y + b, depth)
    total += _corner(x - a, y - b, depth)
    return total / math.pi


def _corner(x, y, depth):
    """Evaluate, at one corner of each pixel, the function whose differences over all four corners give the displacement.

    x, y: coordinates of the corners [m]. depth: 0 for f of equation (1) of this module, or the length c [m] of f of (3). No
    corner lies on an axis, where f would be singular.
    """
    if depth == 0.0:
        return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    corner = x * np.arcsinh(y / np.hypot(x, depth))
    corner += y * np.arcsinh(x / np.hypot(y, depth))
    corner -= depth * np.arctan(x * y / (depth * np.sqrt(x * x + y * y + depth * depth)))
    return corner


def _rest(compliance, shape, pitch):
    """Return the part of a film's compliance [m/Pa] that the closed forms for pixels do not contain, for the waves of a grid.

    It is D(k) of equation (2) of this module. shape: (rows, columns). pitch: point spacings (y, x) [m].
    """
    k = wavevectors(shape, (shape[0] * pitch[0], shape[1] * pitch[1]))
    depth = _DEPTH * compliance.depth
    k[0, 0] = 1e-3 / depth  # D is finite at k = 0; its value at this small k is almost the same
    rest = compliance.times_half_k(k) - compliance.near
    rest -= (compliance.far - compliance.near) * np.exp(-depth * k)
    return 2.0 * rest / k
