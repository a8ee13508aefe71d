"""What reading arrays has in common."""

import warnings
from contextlib import contextmanager

import numpy as np

from stiction.quantities.errors import InputError


@contextmanager
def quiet():
    """No warnings of headers that are odd rather than wrong."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def checked(heights: np.ndarray, name: str) -> np.ndarray:
    """The array of the file of this name as (rows, columns); InputError if it is not of real numbers of that shape, or (n,)."""
    if heights.dtype.kind not in "iuf" or heights.ndim not in (1, 2):
        told = f"{name}: {heights.dtype} of shape {heights.shape}"
        raise InputError("scan", told, "real numbers of shape (rows, columns), or (points,) of a profile")
    return np.atleast_2d(heights)
