"""Read the file formats of instruments with the optional library SurfaceTopography."""

import math
from pathlib import Path

from stiction.quantities.errors import InputError
from stiction.quantities.extras import how_to_install
from stiction.surfaces.raw_scan import RawScan, Reader, ends_in_a_line
from stiction.surfaces.readers.shared.topography import on_grid, quiet_library

# These formats are accepted only if the file name has their ending. The library recognises the first two in any file of
# suitable length, because they have no identifying mark. For arrays the library assumes that the first index runs along x.
_BY_NAME = ("hgt", "nms", "npy", "npz")
_DENSEST = 32  # largest number of points per byte of a file; more mean a wrong header: compressed heights have about one


def read(path: Path, channel) -> RawScan | None:
    """Read a file in the format of an instrument; return None for an unknown format.

    channel: name or position (from 0) of a channel with heights. By default the library's default channel is read if it holds
    heights, else the first channel that does. Raises InputError for a damaged file, for a file without a channel of heights or
    without the requested one, and if the library is not installed.
    """
    with quiet_library():
        try:
            from SurfaceTopography.Exceptions import CannotDetectFileFormat
            from SurfaceTopography.IO import open_topography
        except ImportError:
            raise InputError(
                "scan", str(path), f"another format; to read instrument files: {how_to_install('SurfaceTopography')}"
            ) from None
        try:
            with open_topography(str(path)) as reader:
                return _library(reader, channel, path)
        except InputError:
            raise
        except CannotDetectFileFormat:
            return None
        except Exception as error:  # the 42 readers of the library may raise anything for a damaged file
            problem = " ".join(str(error).split())[:120] or type(error).__name__
            raise InputError("scan", str(path), f"an undamaged file (its reader says: {problem})") from None


def _library(reader, channel, path: Path) -> RawScan | None:
    form = reader.format()
    if form in _BY_NAME and path.suffix.lower() != f".{form}":
        return None
    chosen = _channel(reader, channel)
    points = math.prod(chosen.nb_grid_pts or ())
    if points > _DENSEST * path.stat().st_size:
        raise InputError(
            "scan", str(path), f"an undamaged file (the header states {points} points, more than the file can hold)"
        )
    unknown = chosen.physical_sizes is None or any(length is None for length in chosen.physical_sizes)
    topography = chosen.topography(physical_sizes=(1.0,) * chosen.dim) if unknown else chosen.topography()
    names = [each.name for each in reader.channels]
    description = f"format {form}" + (f", channel {chosen.name!r} of {', '.join(names)}" if len(names) > 1 else "")
    heights, size, notes = on_grid(topography)
    if form == "xyz":
        _no_line_lost(path, heights.size)
        notes += ends_in_a_line(path)
    return RawScan(heights, description, None if unknown else size, str(topography.unit) if topography.unit else None, notes)


def _no_line_lost(path: Path, points: int) -> None:
    """Raise InputError if the library read fewer points from a text file than the file has lines of numbers.

    points: number of points that the library read. If the library cannot read a line, it silently skips all lines above it.
    """
    with path.open("rb") as file:
        lines = sum(line.lstrip()[:1] in b"+-.0123456789" and bool(line.strip()) for line in file)
    if lines > points:
        raise InputError("scan", str(path), f"an undamaged file (only {points} of its {lines} lines of numbers could be read)")


def _channel(reader, wanted):
    """Return the requested channel of a file that the library has opened, or a default one.

    reader: opened file. wanted: name or position (from 0); None for the library's default channel, or the first with heights.
    Raises InputError if none matches, or if no channel has heights.
    """
    channels = list(reader.channels)
    with_heights = [each for each in channels if each.is_height_channel and not isinstance(each.unit, tuple)]
    names = ", ".join(f"{place} {each.name!r}" for place, each in enumerate(channels) if each in with_heights)
    if not with_heights:
        raise InputError("scan", ", ".join(each.name for each in channels), "a file with a channel of heights")
    if wanted is None:
        default = reader.default_channel
        return default if default in with_heights else with_heights[0]
    for place, each in enumerate(channels):
        if each in with_heights and (wanted in (each.name, each.channel_id) or str(wanted) == str(place)):
            return each
    raise InputError("channel", wanted, f"a channel with heights: {names}")


READER = Reader(
    endings=(),
    read=read,
    holds="instrument files (.di, .sur, .al3d, .opdx, .stp and many more), read with the library SurfaceTopography",
    given="usually nothing",
)
