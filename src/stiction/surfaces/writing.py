"""Write a height map in the file formats of other programs, with the optional library SurfaceTopography or as text."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.heightmap import HeightMap


def write_map(surface: HeightMap, path: "Path | str") -> None:
    """Write a height map to a .gwy, .x3p or .sdf file; the ending of the file name selects the format.

    Lengths are in metres, in double precision. Raises InputError for another ending, a profile, a file that cannot be written,
    or if the library that a format needs is not installed.
    """
    path = Path(path)
    write = _FORMATS.get(path.suffix.lower())
    if write is None:
        raise InputError("save_map", str(path), f"a name that ends in {', '.join(_FORMATS)}")
    if surface.is_profile:
        raise InputError("save_map", surface.name, "a map with rows and columns, not a profile")
    try:
        write(surface, path)
    except OSError as error:
        raise InputError("save_map", str(path), f"a file that can be written ({error.strerror})") from None


def _write_gwy(surface: HeightMap, path: Path) -> None:
    surface.to_topography().to_gwy(str(path))


def _write_x3p(surface: HeightMap, path: Path) -> None:
    surface.to_topography().to_x3p(str(path))


def _write_sdf(surface: HeightMap, path: Path) -> None:
    """Write a map in the text form of ISO 25178-71: a header, one line per row of heights [m], BAD for missing points."""
    rows, columns = surface.heights.shape
    dy, dx = surface.pitch
    header = {
        "ManufacID": "stiction", "CreateDate": "000000000000", "ModDate": "000000000000", "NumPoints": columns,
        "NumProfiles": rows, "Xscale": repr(dx), "Yscale": repr(dy), "Zscale": "1", "Zresolution": "-1", "Compression": "0",
        "DataType": "7", "CheckType": "0",
    }  # fmt: skip
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.write("aISO-1.0\n" + "".join(f"{name} = {value}\n" for name, value in header.items()) + "*\n")
        for row in surface.heights:
            file.write(" ".join("BAD" if np.isnan(height) else repr(float(height)) for height in row) + "\n")
        file.write("*\n")


_FORMATS: dict[str, Callable[[HeightMap, Path], None]] = {".gwy": _write_gwy, ".x3p": _write_x3p, ".sdf": _write_sdf}
