"""Read the formats that Gwyddion can read and `instruments` cannot, with the optional library gwyddionpy."""

from pathlib import Path

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.raw_scan import RawScan, Reader


def read(path: Path, channel) -> RawScan | None:
    """Read a file that Gwyddion can read; return None for others, or if gwyddionpy or its converter is not installed.

    channel: name of a channel with heights, or its position (from 0) among these; by default the first. Raises InputError if
    the file has no channel with heights, or not the requested one.
    """
    try:
        import gwyddionpy

        found = gwyddionpy.load(str(path)).channels
    except Exception:  # not installed, or the converter cannot read the file
        return None
    channels = {name: one for name, one in found.items() if one.si_unit_xy == one.si_unit_z == "m"}
    if not channels:
        raise InputError("scan", ", ".join(found) or "no channels", "a file with a channel of heights")
    names = list(channels)
    name = names[int(channel)] if str(channel).isdecimal() and int(channel) < len(names) else channel or names[0]
    if name not in channels:
        listed = ", ".join(f"{place} {each!r}" for place, each in enumerate(names))
        raise InputError("channel", channel, f"a channel with heights: {listed}")
    chosen = channels[name]
    description = "read by Gwyddion" + (f", channel {name!r} of {', '.join(names)}" if len(names) > 1 else "")
    return RawScan(np.asarray(chosen.data), description, (chosen.yreal, chosen.xreal), "m")


READER = Reader(
    endings=(),
    read=read,
    holds="other formats of Gwyddion, read with the library gwyddionpy if it is installed",
    given="usually nothing",
)
