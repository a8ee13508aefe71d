"""Compute the memory that the solution of a map needs, and check it before any array is allocated."""

import os
from pathlib import Path

from stiction.quantities.errors import InputError, InWords

_NUMBER = 8  # bytes
# Number of arrays as large as the map that exist at once, with some margin. The largest resident size of a fresh process was up
# to 14.4 such arrays for periodic maps (elastic, with a hardness, with a film; 512^2 to 2048^2 points), and up to 15.6 for
# others (elastic, with a hardness; 512^2 and 1024^2 points).
_PERIODIC, _FREE = 16, 18
_GIGA = 1e9


def needed_memory(shape: tuple[int, int], *, free: bool = False, kept: int = 1) -> int:
    """Return the memory [bytes] that `solve_map` needs to solve the contact of a map, in addition to its heights.

    - shape: (rows, columns) of the map
    - free: True for a map with free edges, with no pressure outside; False if the map is continued beyond its edges
    - kept: number of pressure maps that are stored
    """
    rows, columns = shape
    return rows * columns * _NUMBER * ((_FREE if free else _PERIODIC) + kept)


def available_memory() -> int | None:
    """Return the memory available without swapping [bytes]; None if the system does not report it."""
    try:
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) * 1024
    except OSError:
        pass
    try:
        return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return None


def require_memory(shape: tuple[int, int], *, free: bool = False, kept: int = 1) -> None:
    """Raise InputError if the contact of a map of this shape needs more memory to be solved than is available.

    Nothing is raised if the system does not report the available memory. Call this function before the map is generated
    or read. shape, free, kept: as in `needed_memory`; kept is the number of stored pressure maps.
    """
    _require(shape, needed_memory(shape, free=free, kept=kept))


def require_arrays(shape: tuple[int, int], arrays: int) -> None:
    """Raise InputError unless memory is available for a number `arrays` of float64 arrays of this shape (rows, columns)."""
    _require(shape, shape[0] * shape[1] * _NUMBER * arrays)


def _require(shape: tuple[int, int], needed: int) -> None:
    there = available_memory()
    if there is not None and needed > there:
        allowed = f"a smaller map: this one needs {needed / _GIGA:.2g} GB of memory, and {there / _GIGA:.2g} GB are free"
        raise InputError("heights", InWords(f"{shape[0]} x {shape[1]} points"), allowed)
