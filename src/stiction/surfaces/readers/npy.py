"""Read .npy files with an array of heights."""

from pathlib import Path

from numpy.lib.format import open_memmap

from stiction.quantities.errors import InputError
from stiction.surfaces.raw_scan import RawScan, Reader, no_channel
from stiction.surfaces.readers.shared.arrays import checked, quiet


def read(path: Path, channel) -> RawScan:
    """Read the array of a .npy file: heights (rows, columns) along y and x, or (points,) of a profile.

    channel: must be None. The file is memory-mapped, so that a damaged header that claims too many values needs no memory.
    Raises InputError for a damaged file, and for an array that is not of real numbers in one or two dimensions.
    """
    no_channel(channel)
    try:
        with quiet():
            heights = open_memmap(path, mode="r")
    except Exception:  # the header is parsed as Python text, and damaged text may raise anything
        raise InputError("scan", str(path), "an undamaged .npy file with an array of numbers") from None
    return RawScan(checked(heights, path.name), "npy")


READER = Reader(endings=(".npy",), read=read, holds="an array of heights; each row runs along x", given="size and unit")
