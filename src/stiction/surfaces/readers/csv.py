"""Read .csv files with a table of numbers.

A .csv file that begins with more than one line of words is left to the reader of instrument formats.
"""

from pathlib import Path

from stiction.surfaces.raw_scan import RawScan, Reader
from stiction.surfaces.readers.shared.text import matrix, read_text

HOLDS = (
    "a matrix of heights, in which each row runs along x; or columns x z of a profile; or columns x y z of points on a grid. "
    "One header line is allowed"
)
GIVEN = "for a matrix size and unit, for columns the unit"


def read(path: Path, channel) -> RawScan | None:
    """Read a .csv file: a matrix of heights (rows along x), or columns x z of a profile or x y z of a map.

    channel: must be None. Returns None for a file that begins with more than one line of words.
    """
    return read_text(path, channel, matrix)


READER = Reader(endings=(".csv",), read=read, holds=HOLDS, given=GIVEN)
