"""Define the content of a scan file before its units and size are determined, and the interface of a file reader."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from stiction.quantities.errors import InputError

FEWEST_POINTS = 8  # along a direction; with fewer a scan has no meaningful spectrum or summits


@dataclass(frozen=True)
class RawScan:
    """Store the content of a scan file before its units and size are determined.

    - heights: (rows, columns) in the unit of the file, NaN where missing, of any real type
    - description: format of the file and channel, in words
    - size: (y, x) in the unit of the file, pitch times number of points; None if the file does not specify it
    - unit: unit of size and heights; None if the file does not specify it
    - notes: steps that brought the heights to a regular grid, in words
    - periodic: whether the file states that the map is one period of an infinite surface
    """

    heights: np.ndarray
    description: str
    size: tuple[float, float] | None = None
    unit: str | None = None
    notes: tuple[str, ...] = ()
    periodic: bool = False


@dataclass(frozen=True, kw_only=True)
class Reader:
    """Describe a reader of one file format, or of several similar formats.

    - endings: file name endings in lower case, with the dot; empty for a reader that is tried on every file, after all others
    - read(path, channel): function that returns a RawScan, or None if the file has another format. channel: name or position of
      a channel; None for the default
    - holds: content of such a file, in words; given: inputs that the user must specify for it, in words
    """

    endings: tuple[str, ...]
    read: Callable[[Path, object], RawScan | None]
    holds: str
    given: str


def no_channel(channel) -> None:
    """Raise InputError unless `channel` is None; for files that have no channels."""
    if channel is not None:
        raise InputError("channel", channel, "no value, because the file contains only one map")


def ends_in_a_line(path: Path) -> tuple[str, ...]:
    """Return a warning text, in a tuple, if the last line of a text file has no line end; otherwise an empty tuple.

    Digits of the last number may then be missing, and nothing else in the file reveals this.
    """
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 2))
        ended = file.read().rstrip(b"\0").endswith((b"\r", b"\n"))  # the line end of UTF-16 is followed by a zero
    return () if ended else ("no line end after the last number: the file may have been cut short",)
