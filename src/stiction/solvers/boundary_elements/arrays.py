"""Provide the array operations of the map solver that depend on the array library.

The solver computes with NumPy. It also runs with a library that meets the array API standard (Consortium for Python Data API
Standards 2024, https://data-apis.org/array-api), on a device of that library. Every function infers the library from its
argument. Slices must be views, so JAX cannot be used.

For NumPy, SciPy's transforms run on two threads, and loops run over blocks of rows that stay in the processor's cache. For
other libraries a block is the whole map, because each call to a device takes time.
"""

from collections.abc import Iterator
from importlib import import_module
from typing import Any

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.extras import installed, require

LIBRARIES = ("torch", "cupy", "array_api_strict")
_THREADED = 2**19  # two threads are faster than one for this many points or more
_BLOCK = 2**16  # number of points in a block; their values fit into the processor's cache


def on_device(values: np.ndarray, device: str | None) -> np.ndarray:
    """Return a map of double precision as an array of another library, on a device of that library.

    device: name of the library, optionally followed by a device, such as "torch:cuda"; None returns the NumPy array itself.
    Raises InputError for a library or device that is not available.
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
    except Exception as error:  # for a device that is not available, every library raises a different error
        reason = str(error).strip().splitlines()[:1]
        raise InputError("device", device, f"a device that {library} can use: {''.join(reason)}") from error


def to_numpy(array: np.ndarray) -> np.ndarray:
    """Return an array of any library as a NumPy array in the memory of the processor."""
    if is_numpy(array):
        return array
    from array_api_compat import is_array_api_strict_namespace, to_device

    return np.asarray(array if is_array_api_strict_namespace(namespace(array)) else to_device(array, "cpu"))


def is_numpy(array: np.ndarray) -> bool:
    """Return whether an array belongs to NumPy."""
    return isinstance(array, np.ndarray)


def namespace(array: np.ndarray) -> Any:
    """Return the array API namespace of an array: NumPy itself, or the namespace of another library."""
    if is_numpy(array):
        return np
    from array_api_compat import array_namespace

    return array_namespace(array)


def like(values: np.ndarray, array: np.ndarray) -> np.ndarray:
    """Return NumPy values as an array with the library, device and precision of the array `array`."""
    if is_numpy(array):
        return np.asarray(values, dtype=array.dtype)
    from array_api_compat import device

    return namespace(array).asarray(values, dtype=array.dtype, device=device(array))


def forward(values: np.ndarray, grid: tuple[int, int]) -> np.ndarray:
    """Return the real two-dimensional Fourier transform of a map, which is first padded with zeros to the shape `grid`."""
    if is_numpy(values):
        from scipy.fft import rfft2  # imported only here, because listing the models imports this module

        return rfft2(values, s=grid, workers=workers(grid[0] * grid[1]))
    return namespace(values).fft.rfftn(values, s=grid, axes=(0, 1))


def backward(waves: np.ndarray, grid: tuple[int, int]) -> np.ndarray:
    """Return the map, of the shape `grid`, whose real two-dimensional Fourier transform is `waves`; `waves` is overwritten."""
    if is_numpy(waves):
        from scipy.fft import ifft, irfft

        threads = workers(grid[0] * grid[1])
        waves = ifft(waves, axis=0, workers=threads, overwrite_x=True)  # axis by axis, because irfft2 would copy the waves
        return irfft(waves, n=grid[1], axis=1, workers=threads)
    return namespace(waves).fft.irfftn(waves, s=grid, axes=(0, 1))


def workers(points: int) -> int:
    """Return the number of threads for a Fourier transform of this many points: 1, or 2 for large maps."""
    return 1 if points < _THREADED else 2


def blocks(array: np.ndarray) -> Iterator[tuple[slice, slice]]:
    """Yield the indices of blocks of whole rows that together cover a map.

    The blocks of a NumPy array are small enough for the processor's cache; an array of another library is one block.
    """
    rows, columns = array.shape
    step = max(1, _BLOCK // columns) if is_numpy(array) else rows
    for first in range(0, rows, step):
        yield slice(first, first + step), slice(None)


def dot(first: np.ndarray, second: np.ndarray) -> float:
    """Return the sum of the products of two maps; only the final sum, over rows, is in double precision.

    BLAS is not used, because its threads start slowly.
    """
    if is_numpy(first):
        return float(np.einsum("ij,ij->i", first, second).sum(dtype=np.float64))
    xp = namespace(first)
    return float(xp.sum(xp.vecdot(first, second), dtype=xp.float64))


def factor(mask: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Convert a mask to a factor for arrays like `values`.

    For NumPy this is the mask itself, which saves a copy; for other libraries the mask as ones and zeros.
    """
    return mask if is_numpy(mask) else namespace(mask).astype(mask, values.dtype)


def clip_into(target: np.ndarray, values: np.ndarray, low: float, high: float) -> None:
    """Write `values` into the array `target` of the same shape, limited to the range from low to high."""
    if is_numpy(values):
        np.clip(values, low, high, out=target)
    else:
        target[:, :] = namespace(values).clip(values, low, high)


def total(values: np.ndarray) -> float:
    """Return the sum of a map; the sums of the rows are added in double precision."""
    xp = namespace(values)
    return float(xp.sum(xp.sum(values, axis=1), dtype=xp.float64))
