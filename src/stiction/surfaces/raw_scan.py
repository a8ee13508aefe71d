"""Content of a scan file before its units and size are settled, and the interface of a file reader."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from stiction.quantities.errors import InputError

FEWEST_POINTS = 8  # along a direction: fewer have no spectrum and no summits to speak of


@dataclass(frozen=True)
class RawScan:
    """Heights in the numbers of the file, with its statements about them.

    heights: (rows, columns), NaN where missing, of any real type. said: the format and the channel, in words. size: (y, x) in
    numbers of the file, pitch times count. unit: of size and heights. Both None if missing in the file. notes: steps that
    brought the heights to a grid.
    """

    heights: np.ndarray
    said: str
    size: tuple[float, float] | None = None
    unit: str | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Reader:
    """A format of files, or several similar ones.

    endings: of their names, in lower case and with the dot; empty for the reader of last resort. read(path, channel) ->
    RawScan, or None if the file has another format; channel: its name or position, None for the only one. holds: the content of
    such a file; given: the inputs that the user must state. Both in words, for tables and errors.
    """

    endings: tuple[str, ...]
    read: Callable[[Path, object], RawScan | None]
    holds: str
    given: str


def no_channel(channel) -> None:
    """Raise InputError if a channel is requested from a file without channels."""
    if channel is not None:
        raise InputError("channel", channel, "no value, because the file holds only one map")


def ends_in_a_line(path: Path) -> tuple[str, ...]:
    """Return a warning text if the last line of a text file has no line end.

    Digits of its last number may then be missing, which nothing else reveals.
    """
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 2))
        ended = file.read().rstrip(b"\0").endswith((b"\r", b"\n"))  # the line end of UTF-16 is followed by a zero
    return () if ended else ("no line end after the last number: the file may have been cut short",)
