"""Read text files with a table of numbers, as in .csv files.

Lines that begin with # may specify the units of columns x y z. A file with any other line "# name: value"
(except "# Channel: ..."), or with an unknown or a single unit, is left to the reader of instrument formats.
"""

import re
from dataclasses import replace
from pathlib import Path

from stiction.quantities.errors import InputError
from stiction.surfaces.heightmap import metres_per
from stiction.surfaces.raw_scan import RawScan, Reader
from stiction.surfaces.readers.csv import GIVEN, HOLDS
from stiction.surfaces.readers.shared.text import matrix, read_text


def read(path: Path, channel) -> RawScan | None:
    """Read a text file: a matrix of heights (rows along x), or columns x z of a profile or x y z of a map.

    channel: must be None. Returns None if `_units` does, because the # lines are of another format, if # lines specify units
    above a matrix, or if the file begins with more than one line of words.
    """
    units = _units(path)
    if units is None:
        return None
    scan = read_text(path, channel, matrix)
    if scan is None or not units:
        return scan
    lateral, vertical = units
    heights = scan.heights * (metres_per(vertical, "unit") / metres_per(lateral, "unit"))
    return replace(scan, heights=heights, unit=lateral) if scan.size else None


# Lines that Gwyddion writes above columns; other lines with a colon come from unknown programs.
_REMARK = re.compile(r"#\s*(Channel|Lateral units|Value units):\s*(.*?)\s*")


def _units(path: Path) -> tuple[str, ...] | None:
    """Return (lateral unit, height unit) from the lines at the start of a file that begin with #; () if they specify none.

    Returns None if one of these lines has a colon but is not "Channel", "Lateral units" or "Value units", if only one unit is
    specified, or if a unit is unknown.
    """
    remarks: dict[str, str] = {}
    with path.open(encoding="utf-8-sig", errors="replace") as file:
        for line in file:
            if not line.startswith("#"):
                break
            remark = _REMARK.fullmatch(line)
            if remark is None and ":" in line:
                return None
            if remark is not None:
                remarks[remark[1]] = remark[2]
    found = tuple(remarks[name] for name in ("Lateral units", "Value units") if name in remarks)
    try:
        return found if len(found) in (0, 2) and all(metres_per(unit, "unit") for unit in found) else None
    except InputError:
        return None


READER = Reader(endings=(".txt", ".asc", ".dat"), read=read, holds=HOLDS, given=GIVEN)
