"""Tables in .csv files. Those that begin with words are an instrument's."""

from pathlib import Path

from stiction.surfaces.raw_scan import RawScan, Reader
from stiction.surfaces.readers.shared.text import matrix, read_text

HOLDS = (
    "a matrix of heights, rows along x, or columns x z of a profile, or x y z of points on a grid, below at most one line of "
    "words"
)
GIVEN = "of a matrix size and unit, else unit"


def read(path: Path, channel) -> RawScan | None:
    """Read rows of heights along x, or columns x z or x y z."""
    return read_text(path, channel, matrix)


READER = Reader(endings=(".csv",), read=read, holds=HOLDS, given=GIVEN)
