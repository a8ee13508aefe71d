"""Tables in other text files, as in .csv. Those with remarks at their head are an instrument's, which may say more there."""

from pathlib import Path

from stiction.surfaces.raw_scan import RawScan, Reader
from stiction.surfaces.readers.csv import GIVEN, HOLDS
from stiction.surfaces.readers.shared.text import matrix, read_text


def read(path: Path, channel) -> RawScan | None:
    """Rows of heights along x, or columns x z or x y z; None of a file that begins with a remark."""
    with path.open("rb") as file:
        remarks = file.read(1) == b"#"
    return None if remarks else read_text(path, channel, matrix)


READER = Reader(endings=(".txt", ".asc", ".dat"), read=read, holds=HOLDS, given=GIVEN)
