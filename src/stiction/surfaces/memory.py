"""Memory needed to solve a map, checked before any array is allocated."""

import os
from pathlib import Path

from stiction.quantities.errors import InputError

_NUMBER = 8  # bytes
# Arrays as large as the map that are alive at once. Measured as the largest resident size of a fresh process, elastic, hard and
# with a film, 512^2 to 2048^2: up to 14.4; without a period, elastic and hard, 512^2 and 1024^2: up to 15.6.
_PERIODIC, _FREE = 16, 18
_GIGA = 1e9


def needed_memory(shape: tuple[int, int], *, free: bool = False, kept: int = 1) -> int:
    """Return the bytes of memory that `solve_map` needs in addition to the heights.

    shape: (rows, columns) of the map. free: True if there is no pressure outside the map (not periodic). kept: number of
    pressure maps to store.
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
    """Raise InputError if solving a map of this shape needs more memory than there is.

    It is called before the map is generated or read.
    """
    _require(shape, needed_memory(shape, free=free, kept=kept))


def require_arrays(shape: tuple[int, int], arrays: int) -> None:
    """Raise InputError unless this number of arrays of this shape fits into memory."""
    _require(shape, shape[0] * shape[1] * _NUMBER * arrays)


def _require(shape: tuple[int, int], needed: int) -> None:
    there = available_memory()
    if there is not None and needed > there:
        allowed = f"a smaller map: this one needs {needed / _GIGA:.2g} GB of memory, and {there / _GIGA:.2g} GB are free"
        raise InputError("heights", f"{shape[0]} x {shape[1]} points", allowed)
