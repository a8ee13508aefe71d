"""Functions for reading arrays."""

import warnings
from contextlib import contextmanager

import numpy as np

from stiction.quantities.errors import InputError


@contextmanager
def quiet():
    """Suppress warnings of headers that are odd instead of wrong."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def checked(heights: np.ndarray, name: str) -> np.ndarray:
    """Return the array of this file as (rows, columns).

    Raises InputError unless it is of real numbers of that shape, or (n,).
    """
    if heights.dtype.kind not in "iuf" or heights.ndim not in (1, 2):
        told = f"{name}: {heights.dtype} of shape {heights.shape}"
        raise InputError("scan", told, "real numbers of shape (rows, columns), or (points,) of a profile")
    return np.atleast_2d(heights)
