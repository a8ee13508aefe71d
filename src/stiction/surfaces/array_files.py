"""Reading arrays of heights: .npy, and .npz with one array or the one that is named as channel."""

import warnings
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from numpy.lib.format import open_memmap

from stiction.quantities.errors import InputError
from stiction.surfaces.raw_scan import RawScan, no_channel

__all__ = ["read_npy", "read_npz"]


def read_npy(path: Path, channel) -> RawScan:
    """The array of a .npy file: (rows, columns) along y and x, or (points,) of a profile.

    Mapped rather than loaded: a damaged header that claims more than the file holds takes no memory.
    """
    no_channel(channel)
    try:
        with _quiet():
            heights = open_memmap(path, mode="r")
    except Exception:  # the header is read as Python text, which fails in as many ways as that can be damaged
        raise InputError("scan", str(path), "an undamaged .npy file with an array of numbers") from None
    return RawScan(_checked(heights, path.name), "npy")


def read_npz(path: Path, channel) -> RawScan:
    """One array of a .npz file, laid out as in .npy; channel: its name, needed if there are several."""
    try:
        with _quiet(), path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            names = ", ".join(archive.files) or "it has none"
            if channel not in archive and (channel is not None or len(archive) != 1):
                raise InputError("channel", channel, f"the name of an array of {path.name}: {names}")
            name = channel or archive.files[0]
            heights = archive[name]
    except InputError:
        raise
    except Exception:  # of a damaged archive the unpacking raises anything, a MemoryError of a false header included
        raise InputError("scan", str(path), "an undamaged .npz file with arrays of numbers") from None
    return RawScan(_checked(heights, path.name), f"npz, array {name!r} of {names}")


@contextmanager
def _quiet():
    """No warnings of headers that are odd rather than wrong."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def _checked(heights: np.ndarray, name: str) -> np.ndarray:
    if heights.dtype.kind not in "iuf" or heights.ndim not in (1, 2):
        told = f"{name}: {heights.dtype} of shape {heights.shape}"
        raise InputError("scan", told, "real numbers of shape (rows, columns), or (points,) of a profile")
    return np.atleast_2d(heights)
