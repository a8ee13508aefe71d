"""What a file says of a scan, before units and size are settled, and what reads it."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from stiction.quantities.errors import InputError

FEWEST_POINTS = 8  # along a direction: fewer have no spectrum and no summits to speak of


@dataclass(frozen=True)
class RawScan:
    """Heights in the file's own numbers, and what it says of them.

    heights: (rows, columns), NaN where missing, of any real type. said: the format and the channel, in words. size: (y, x) in
    numbers of the file, pitch times count. unit: of size and heights. Both None where the file does not say. notes: what was
    done to the heights to bring them to a grid.
    """

    heights: np.ndarray
    said: str
    size: tuple[float, float] | None = None
    unit: str | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Reader:
    """A format of files, or several that are alike.

    endings: of their names, in lower case and with the dot; none of one that is asked where no other takes a file. read(path,
    channel) -> RawScan, or None where a file of that name is of another format; channel: its name or place, None for the one
    that there is. holds: what is in such a file; given: what has to be given beside it. Both in words, for tables and errors.
    """

    endings: tuple[str, ...]
    read: Callable[[Path, object], RawScan | None]
    holds: str
    given: str


def no_channel(channel) -> None:
    """InputError if a channel is asked for in a file that has none."""
    if channel is not None:
        raise InputError("channel", channel, "none: the file holds one map")


def ends_in_a_line(path: Path) -> tuple[str, ...]:
    """What to say of a text file whose last line has no end: nothing else would show that its last number lacks digits."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 2))
        ended = file.read().rstrip(b"\0").endswith((b"\r", b"\n"))  # the line end of UTF-16 is followed by a zero
    return () if ended else ("no line end after the last number: the file may have been cut short",)
