"""What a packed file would unpack to, before anything of it is unpacked: a few megabytes can claim all memory there is."""

import zipfile
from pathlib import Path

from stiction.quantities.errors import InputError

# Heights are noise in their last digits and pack to a tenth at best; what is smaller than this is no danger.
_DENSEST, _HARMLESS = 50, 1 << 26  # bytes
_HDF5 = b"\x89HDF\r\n\x1a\n"


def check_packed(path: Path) -> None:
    """Raise InputError where a .zip archive (.npz, .x3p and others are such) or an HDF5 file holds far more than a scan of its
    length can. The sizes are those that its directory states; those who unpack it go by the same."""
    try:
        held = _held(path)
    except Exception:  # of a damaged file; what is wrong with it, its reader says better
        return
    if held > max(_HARMLESS, _DENSEST * path.stat().st_size):
        told = f"{path.name}: {path.stat().st_size} bytes that unpack to {held}"
        raise InputError("scan", told, f"an archive that unpacks to {_DENSEST} times its size at most")


def _held(path: Path) -> int:
    """Bytes of the unpacked contents; 0 of a file that is no archive."""
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
