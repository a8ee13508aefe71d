"""Size of a packed file after unpacking, checked before it is unpacked.

A few megabytes can claim all available memory.
"""

import zipfile
from pathlib import Path

from stiction.quantities.errors import InputError

# Heights are noise in their last digits and pack to a tenth at best; what is smaller than this is no danger.
_DENSEST, _HARMLESS = 50, 1 << 26  # bytes
_HDF5 = b"\x89HDF\r\n\x1a\n"


def check_packed(path: Path) -> None:
    """Raise InputError where an archive holds far more than a scan of its length can.

    Archives are .zip files (.npz, .x3p and others) and HDF5 files. The sizes are those in the directory, which unpacking uses
    too.
    """
    try:
        held = _held(path)
    except Exception:  # of a damaged file; what is wrong with it, its reader says better
        return
    if held > max(_HARMLESS, _DENSEST * path.stat().st_size):
        told = f"{path.name}: {path.stat().st_size} bytes that unpack to {held}"
        raise InputError("scan", told, f"an archive that unpacks to at most {_DENSEST} times its size")


def _held(path: Path) -> int:
    """Return the bytes of the unpacked contents; 0 for a file that is no archive."""
    with path.open("rb") as file:
        start = file.read(len(_HDF5))
    if start == _HDF5:
        return _held_in_hdf5(path)
    if not zipfile.is_zipfile(path):
        return 0
    with zipfile.ZipFile(path) as archive:
        return sum(member.file_size for member in archive.infolist())


def _held_in_hdf5(path: Path) -> int:
    import h5py

    sizes = []
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: sizes.append(item.nbytes) if isinstance(item, h5py.Dataset) else None)
    return sum(sizes)
