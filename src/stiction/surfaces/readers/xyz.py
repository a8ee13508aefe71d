"""Read .xyz files with heights at given positions.

A file that begins with more than one line of words is left to the reader of instrument formats.
"""

from pathlib import Path

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.raw_scan import RawScan, Reader
from stiction.surfaces.readers.shared.text import read_text


def read(path: Path, channel) -> RawScan | None:
    """Read a .xyz file: columns x z of a profile, or columns x y z of a map.

    channel: must be None. Returns None for a file that begins with more than one line of words. Raises InputError unless the
    table has two or three columns.
    """
    return read_text(path, channel, _no_positions)


def _no_positions(table: np.ndarray, notes: tuple[str, ...], name: str) -> RawScan:
    raise InputError("scan", InWords(f"{name} with {table.shape[1]} columns"), "columns x y z, or x z for a profile")


READER = Reader(
    endings=(".xyz",),
    read=read,
    holds="columns x z of a profile, or columns x y z of points on a grid. One header line is allowed",
    given="unit",
)
