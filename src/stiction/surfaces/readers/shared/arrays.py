"""Check arrays of heights from .npy and .npz files."""

import warnings
from contextlib import contextmanager

import numpy as np

from stiction.quantities.errors import InputError


@contextmanager
def quiet():
    """Suppress NumPy's warnings about unusual but valid file headers, inside a with-block."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def checked(heights: np.ndarray, name: str) -> np.ndarray:
    """Return an array of heights as (rows, columns); an array (n,) becomes a profile (1, n).

    name: name of the file, for the error. Raises InputError unless the array holds real numbers in one or two dimensions.
    """
    if heights.dtype.kind not in "iuf" or heights.ndim not in (1, 2):
        value = f"{name}: {heights.dtype} of shape {heights.shape}"
        raise InputError("scan", value, "real numbers of shape (rows, columns), or (points,) for a profile")
    return np.atleast_2d(heights)
