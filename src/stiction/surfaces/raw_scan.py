"""What a file says of a scan, before units and size are settled."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from stiction.quantities.errors import InputError

__all__ = ["FEWEST_POINTS", "RawScan", "ends_in_a_line", "no_channel", "unreadable"]

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


def unreadable(path) -> InputError:
    """The error for a file that no reader takes."""
    text = ".csv and .xyz (rows of heights, or columns x z or x y z, below at most one line of words)"
    allowed = f"an undamaged file of a known format: .npy, .npz, {text} or one that SurfaceTopography reads"
    return InputError("scan", str(path), allowed)
