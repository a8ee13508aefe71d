"""Array operations of the map solver that depend on the array library.

The solver computes with NumPy. It also runs with a library that meets the array API standard (Consortium for Python Data API
Standards 2024, https://data-apis.org/array-api), on a device of that library. Every function takes the library from its
argument. Slices must be views, so JAX cannot be used.

NumPy has paths of its own: SciPy's transforms on two threads, and blocks of rows that stay in the processor's cache. For
other libraries a block is the whole map, because each call of a device takes time.
"""

from collections.abc import Iterator
from importlib import import_module
from typing import Any

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.extras import installed, require

LIBRARIES = ("torch", "cupy", "array_api_strict")
_THREADED = 2**19  # points from which on two threads are faster than one
_BLOCK = 2**16  # points that are worked on together: their numbers stay in the processor's cache


def on_device(values: np.ndarray, device: str | None) -> np.ndarray:
    """Return a map of double precision as array of another library.

    device: name of the library, optionally with a device of it, such as "torch:cuda"; None for NumPy. Raises InputError for a
    library or device that is not there.
    """
    if device is None:
        return values
    library, _, place = device.partition(":")
    if library not in LIBRARIES:
        raise InputError("device", device, f"one of {', '.join(LIBRARIES)}, optionally with a device, e.g. torch:cuda")
    require("device", "array_api_compat")
    if not installed(library):
        raise InputError("device", InWords(f"{library} is not installed"), "a library that is installed")
    array = import_module(library).asarray(values)
    try:
        xp = namespace(array)
        return xp.asarray(array, device=place) if place else array
    except Exception as error:  # each library has errors of its own for a device that is not there
        reason = str(error).strip().splitlines()[:1]
        raise InputError("device", device, f"a device that {library} can use: {''.join(reason)}") from error


def to_numpy(array: np.ndarray) -> np.ndarray:
    """Return an array of any library as NumPy array."""
    if is_numpy(array):
        return array
    from array_api_compat import is_array_api_strict_namespace, to_device

    return np.asarray(array if is_array_api_strict_namespace(namespace(array)) else to_device(array, "cpu"))


def is_numpy(array: np.ndarray) -> bool:
    """Return whether an array belongs to NumPy."""
    return isinstance(array, np.ndarray)


def namespace(array: np.ndarray) -> Any:
    """Return the array API namespace of an array: NumPy itself, or that of another library."""
    if is_numpy(array):
        return np
    from array_api_compat import array_namespace

    return array_namespace(array)


def like(values: np.ndarray, array: np.ndarray) -> np.ndarray:
    """Return NumPy values as array with the library, device and precision of another array."""
    if is_numpy(array):
        return np.asarray(values, dtype=array.dtype)
    from array_api_compat import device

    return namespace(array).asarray(values, dtype=array.dtype, device=device(array))


def forward(values: np.ndarray, grid: tuple[int, int]) -> np.ndarray:
    """Return the real Fourier transform of a map, which is first padded with zeros to the grid."""
    if is_numpy(values):
        from scipy.fft import rfft2  # here, because records of models load this module

        return rfft2(values, s=grid, workers=workers(grid[0] * grid[1]))
    return namespace(values).fft.rfftn(values, s=grid, axes=(0, 1))


def backward(waves: np.ndarray, grid: tuple[int, int]) -> np.ndarray:
    """Return the map of a real Fourier transform on the grid; the transform is overwritten."""
    if is_numpy(waves):
        from scipy.fft import ifft, irfft

        threads = workers(grid[0] * grid[1])
        waves = ifft(waves, axis=0, workers=threads, overwrite_x=True)  # by itself: irfft2 would copy the waves
        return irfft(waves, n=grid[1], axis=1, workers=threads)
    return namespace(waves).fft.irfftn(waves, s=grid, axes=(0, 1))


def workers(points: int) -> int:
    """Return the number of threads for a transform."""
    return 1 if points < _THREADED else 2


def blocks(array: np.ndarray) -> Iterator[tuple[slice, slice]]:
    """Yield indices of blocks of rows that are small enough for the processor's cache; of other libraries, of all rows."""
    rows, columns = array.shape
    step = max(1, _BLOCK // columns) if is_numpy(array) else rows
    for first in range(0, rows, step):
        yield slice(first, first + step), slice(None)


def dot(first: np.ndarray, second: np.ndarray) -> float:
    """Return the dot product of two maps, without BLAS threads, which start slowly."""
    if is_numpy(first):
        return float(np.einsum("ij,ij->i", first, second).sum(dtype=np.float64))
    xp = namespace(first)
    return float(xp.sum(xp.vecdot(first, second), dtype=xp.float64))


def factor(mask: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return a mask as factor of values. NumPy multiplies by the mask itself, which saves a copy."""
    return mask if is_numpy(mask) else namespace(mask).astype(mask, values.dtype)


def clip_into(target: np.ndarray, values: np.ndarray, low: float, high: float) -> None:
    """Write values into a target of the same shape, limited to the range from low to high."""
    if is_numpy(values):
        np.clip(values, low, high, out=target)
    else:
        target[:, :] = namespace(values).clip(values, low, high)


def total(values: np.ndarray) -> float:
    """Return the sum of a map, in double precision."""
    xp = namespace(values)
    return float(xp.sum(xp.sum(values, axis=1), dtype=xp.float64))
