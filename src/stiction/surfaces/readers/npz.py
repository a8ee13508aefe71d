"""Read .npz files with one or more arrays of heights."""

from pathlib import Path

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.raw_scan import RawScan, Reader
from stiction.surfaces.readers.shared.arrays import checked, quiet


def read(path: Path, channel) -> RawScan:
    """Read one array of a .npz file: heights (rows, columns) along y and x, or (points,) of a profile.

    channel: name of the array; it may be None if the file has only one array. Raises InputError for a damaged file, if
    it has no such array, and for an array that is not of real numbers in one or two dimensions.
    """
    try:
        with quiet(), path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            names = ", ".join(archive.files) or "it has none"
            if channel not in archive and (channel is not None or len(archive) != 1):
                raise InputError("channel", channel, f"the name of an array of {path.name}: {names}")
            name = channel or archive.files[0]
            heights = archive[name]
            if not isinstance(heights, np.ndarray):  # NumPy returns other content of the archive as bytes
                raise TypeError
    except InputError:
        raise
    except Exception:  # a damaged archive may raise anything, including a MemoryError because of a false header
        raise InputError("scan", str(path), "an undamaged .npz file with arrays of numbers") from None
    return RawScan(checked(heights, path.name), f"npz, array {name!r} of {names}")


READER = Reader(
    endings=(".npz",),
    read=read,
    holds="arrays of heights; each row runs along x; `channel` selects an array",
    given="size and unit",
)
