"""Compute the displacement of every point of a map under a shear traction, by fast Fourier transforms.

Arrays are (components, rows, columns), with one component (x) or two (x and y). Sliding is along x, the direction of the
columns. One component neglects the traction across the sliding direction, which only Poisson's ratio causes.

Periodic: symbol (2) of `compliance`. The mean displacement is set to 0, so that rigid shifts are relative to the mean plane.
Films on rigid substrates have a defined mean displacement and keep it.

Mirrored: the map is one quarter of a period, and its mirror images are the other three. q_x is even about every side, q_y odd.

Free: no traction acts outside the map, and the bodies are half-spaces. A uniform unit traction q_x on a pixel gives (Cerruti;
Johnson 1985, Contact Mechanics, eq. 3.75, integrated over the pixel; differences over its corners, r^2 = x^2 + y^2, S and N the
sums of `compliance`)

    2 pi u_x = (S - N) [x asinh(y/|x|) + y asinh(x/|y|)] + N y asinh(x/|y|),        2 pi u_y = -N r                      (1)
"""

import math
from functools import cached_property

import numpy as np
from scipy.fft import dctn, idctn, irfft2, next_fast_len, rfft2

from stiction.quantities.errors import InputError, InWords
from stiction.solvers.boundary_elements.operators import components
from stiction.solvers.shear.compliance import ShearCompliance


class PeriodicShear:
    """Compute tangential displacements due to shear tractions on one period of a periodic map.

    compliance: tangential compliance of the two bodies. shape: (rows, columns). size: (y, x) [m].
    """

    def __init__(self, compliance: ShearCompliance, shape: tuple[int, int], size: tuple[float, float]):
        self.shape, self.near = shape, compliance.near
        ky, kx = components(shape, size)
        k = np.hypot(ky, kx)
        lowest = float(np.min(k[k > 0.0]))
        k[0, 0] = lowest
        along, across = compliance.times_k(k) / k
        self._symbol = _tensor(along, across, kx / k, ky / k, shape)
        self._inverse = _tensor(1.0 / along, 1.0 / across, kx / k, ky / k, shape)
        self._inverse_along = 1.0 / self._symbol[0]  # for fields with one component
        for one, at_zero in zip(self._symbol, (compliance.at_zero, 0.0, compliance.at_zero), strict=True):
            one[0, 0] = at_zero
        doubled = np.where((np.arange(k.shape[1]) > 0) & (2 * np.arange(k.shape[1]) < shape[1]), 2.0, 1.0)
        self.of_point = float((self._symbol[0] * doubled).sum() / (shape[0] * shape[1]))

    def __call__(self, traction: np.ndarray) -> np.ndarray:
        """Return the displacement [m] caused by the traction [Pa], both (components, rows, columns)."""
        return _through(traction, self.shape, self._symbol)

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Return the traction [Pa] that causes a displacement [m] on a map that sticks everywhere.

        Both are (components, rows, columns). The mean is divided by the compliance of the longest wave. This inverse serves as
        a preconditioner.
        """
        alone = len(displacement) == 1
        return _through(displacement, self.shape, (self._inverse_along, None, None) if alone else self._inverse)


class MirroredShear:
    """Compute tangential displacements due to shear tractions on a map that its mirror images continue on every side.

    compliance: tangential compliance of the two bodies. shape: (rows, columns). size: (y, x) [m]. One component is even about
    every side, so cosine transforms of the map suffice. Two components need the transforms of a whole period.
    """

    def __init__(self, compliance: ShearCompliance, shape: tuple[int, int], size: tuple[float, float]):
        self.shape, self.near = shape, compliance.near
        self._compliance, self._size = compliance, size
        ky, kx = (math.pi * np.arange(count) / length for count, length in zip(shape, size, strict=True))
        k = np.hypot(ky[:, None], kx)
        k[0, 0] = math.pi / max(size)
        along, across = compliance.times_k(k) / k
        turned = (kx / k) ** 2
        self._symbol = across + (along - across) * turned
        self._inverse = 1.0 / self._symbol
        self._symbol[0, 0] = compliance.at_zero
        self.of_point = float(self._symbol.mean())

    def __call__(self, traction: np.ndarray) -> np.ndarray:
        """Return the displacement [m] caused by the traction [Pa], both (components, rows, columns)."""
        return _even(traction, self._symbol) if len(traction) == 1 else self._quarter(self._period(_mirrored(traction)))

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Return the traction [Pa] that causes a displacement [m] on a map that sticks everywhere.

        Both are (components, rows, columns). The mean is divided by the compliance of the longest wave. This inverse serves as
        a preconditioner.
        """
        if len(displacement) == 1:
            return _even(displacement, self._inverse)
        return self._quarter(self._period.inverse(_mirrored(displacement)))

    @cached_property
    def _period(self) -> PeriodicShear:
        rows, columns = self.shape
        return PeriodicShear(self._compliance, (2 * rows, 2 * columns), (2.0 * self._size[0], 2.0 * self._size[1]))

    def _quarter(self, field: np.ndarray) -> np.ndarray:
        return field[:, : self.shape[0], : self.shape[1]].copy()


class FreeShear:
    """Compute tangential displacements due to shear tractions on a map that is not repeated; no traction acts outside it.

    compliance: tangential compliance of the two bodies. shape: (rows, columns). size: (y, x) [m]. Raises InputError for bodies
    with films.
    """

    def __init__(self, compliance: ShearCompliance, shape: tuple[int, int], size: tuple[float, float]):
        if compliance.layered:
            raise InputError("film", InWords("on a map that is not periodic"), "no film, or a map that is periodic or mirrored")
        self.shape, self.near = shape, compliance.near
        pitch = size[0] / shape[0], size[1] / shape[1]
        self._doubled = tuple(next_fast_len(2 * count, real=True) for count in shape)
        pixels = _of_pixels(self._doubled, pitch, *compliance.sums)
        self._symbol = tuple(rfft2(kernel).real.copy() for kernel in pixels)  # even, or odd twice: no imaginary part
        self.of_point = float(pixels[0][0, 0])
        self._stuck = PeriodicShear(compliance, shape, size)

    def __call__(self, traction: np.ndarray) -> np.ndarray:
        """Return the displacement [m] caused by the traction [Pa], both (components, rows, columns)."""
        return _through(traction, self._doubled, self._symbol)[:, : self.shape[0], : self.shape[1]].copy()

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Return a traction [Pa] that approximately causes this displacement [m], both (components, rows, columns).

        It is exact for a periodic map that sticks everywhere, and serves as preconditioner.
        """
        return self._stuck.inverse(displacement)


_THREADED = 1 << 17  # number of points from which two threads are faster than one

ShearOperator = PeriodicShear | MirroredShear | FreeShear


def _tensor(along, across, x, y, shape) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the components xx, xy and yy of the compliance tensor of every wave.

    The tensor is `across` I + (`along` - `across`) k k^T/k^2; (x, y) is the unit vector of the wavevector k. shape: (rows,
    columns) of the map.
    """
    both = (along - across) * x * y
    if shape[0] % 2 == 0:
        both[shape[0] // 2] = 0.0  # on the grid this wave is identical to the opposite wave, for which x y has the other sign
    if shape[1] % 2 == 0:
        both[:, -1] = 0.0
    return across + (along - across) * x * x, both, across + (along - across) * y * y


def _through(field: np.ndarray, grid, symbol) -> np.ndarray:
    """Zero-pad the field to the shape `grid`, multiply it by the symbol in Fourier space, and return the product on that grid.

    field: (components, rows, columns); the result has the same precision. symbol: components xx, xy and yy of a tensor for each
    wave.
    """
    xx, xy, yy = (None if part is None else part.astype(field.dtype, copy=False) for part in symbol)
    workers = _workers(grid[0] * grid[1])
    waves = rfft2(field, s=grid, workers=workers)
    if len(field) == 1:
        waves *= xx
    else:
        x, y = waves
        mixed = xy * x
        x *= xx
        x += xy * y
        y *= yy
        y += mixed
    return irfft2(waves, s=grid, workers=workers, overwrite_x=True)


def _workers(points: int) -> int:
    return 2 if points >= _THREADED else 1


def _even(field: np.ndarray, symbol: np.ndarray) -> np.ndarray:
    """Multiply a field with one component by the symbol in cosine-transform space, and return the product.

    field: (1, rows, columns), whose precision the result has. symbol: (rows, columns), factor of each wave.
    """
    workers = _workers(symbol.size)
    waves = dctn(field[0], workers=workers)
    waves *= symbol.astype(field.dtype, copy=False)
    return idctn(waves, workers=workers, overwrite_x=True)[None]


def _mirrored(field: np.ndarray) -> np.ndarray:
    """Return one period (components, 2 rows, 2 columns) that a field forms with its mirror images.

    The first component is even about every side of the field, the second odd.
    """
    parts = []
    for component, sign in zip(field, (1.0, -1.0), strict=False):
        rows = np.concatenate([component, sign * component[::-1]])
        parts.append(np.concatenate([rows, sign * rows[:, ::-1]], axis=1))
    return np.stack(parts)


def _of_pixels(shape, pitch, S, N) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the displacement of half-spaces at every grid point per unit traction on the first pixel [m/Pa].

    The three arrays (rows, columns) are xx, xy and yy: displacement along the first letter, traction along the second. S, N:
    sums of 1/G and nu/G over the bodies [1/Pa], with the shear modulus G and Poisson's ratio nu. The result is equation (1) of
    this module.
    """
    y, x = (np.fft.fftfreq(count, 1.0 / (count * step)) for count, step in zip(shape, pitch, strict=True))
    xx, xy, yy = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    for across, sign_x in ((0.5, 1.0), (-0.5, -1.0)):
        for down, sign_y in ((0.5, 1.0), (-0.5, -1.0)):
            at_x, at_y = x + across * pitch[1], (y + down * pitch[0])[:, None]
            first, second = at_x * np.arcsinh(at_y / np.abs(at_x)), at_y * np.arcsinh(at_x / np.abs(at_y))
            sign = sign_x * sign_y / (2.0 * math.pi)
            xx += sign * ((S - N) * first + S * second)
            yy += sign * ((S - N) * second + S * first)
            xy -= sign * N * np.hypot(at_x, at_y)
    for axis, count in enumerate(shape):
        if count % 2 == 0:
            np.moveaxis(xy, axis, 0)[count // 2] = 0.0  # xy is odd, so 0 where both sides are equally far
    return xx, xy, yy
