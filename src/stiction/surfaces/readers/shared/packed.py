"""Limit the size to which a compressed scan file may unpack.

A file of a few megabytes may claim to unpack to more than all memory. The limit is checked before unpacking.
"""

import zipfile
from pathlib import Path

from stiction.quantities.errors import InputError

# The last digits of heights are noise, so that heights compress to a tenth of their size at best. _HARMLESS bytes always fit.
_DENSEST, _HARMLESS = 50, 1 << 26  # ratio, bytes
_HDF5 = b"\x89HDF\r\n\x1a\n"


def check_packed(path: Path) -> None:
    """Raise InputError if a compressed scan file would unpack to far more bytes than a scan of its size can have.

    The limit is _DENSEST times the file size, and at least _HARMLESS bytes. Compressed files are .zip archives (.npz, .x3p and
    others) and HDF5 files, whose directories state the unpacked sizes. Other files and damaged files are accepted.
    """
    try:
        held = _held(path)
    except Exception:  # the file is damaged, and its reader states better what is wrong
        return
    if held > max(_HARMLESS, _DENSEST * path.stat().st_size):
        value = f"{path.name}: {path.stat().st_size} bytes that unpack to {held}"
        raise InputError("scan", value, f"an archive that unpacks to at most {_DENSEST} times its size")


def _held(path: Path) -> int:
    """Return the unpacked size of a file in bytes; 0 if the file is neither a .zip archive nor HDF5."""
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
