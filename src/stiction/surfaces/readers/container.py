"""Read one measurement from a container of contact.engineering: a .zip file with scans, usually of one surface."""

import warnings
from pathlib import Path

from stiction.quantities.errors import InputError
from stiction.quantities.extras import how_to_install
from stiction.surfaces.raw_scan import RawScan, Reader
from stiction.surfaces.readers.shared.topography import on_grid, quiet_library


def read(path: Path, channel) -> RawScan:
    """Read one measurement from a container, after applying the filters that the container specifies.

    channel: name or position (from 0) of the measurement, by default the first. Raises InputError for a .zip file that is
    damaged or not such a container, for an unknown channel, or if the library SurfaceTopography is not installed.
    """
    try:
        from SurfaceTopography.Container.IO import CEReader
    except ImportError:
        allowed = f"another format; to read a container: {how_to_install('SurfaceTopography')}"
        raise InputError("scan", str(path), allowed) from None
    try:
        with quiet_library(), path.open("rb") as file, warnings.catch_warnings(record=True) as remarks:
            warnings.simplefilter("always", UserWarning)
            container = CEReader(file)
            surfaces = [(container.container(at), container.members(at)) for at in range(container.nb_containers)]
            names = [member.name for _, members in surfaces for member in members]
            place = _place(channel, names)
            topography = [surface[at] for surface, members in surfaces for at in range(len(members))][place]
            heights, size, notes = on_grid(topography)
    except InputError:
        raise
    except Exception:  # the library may raise anything for a damaged archive
        raise InputError("scan", str(path), "an undamaged .zip file of contact.engineering") from None
    notes += tuple(f"input warning: {' '.join(str(remark.message).split())}" for remark in remarks)
    description = f"container, measurement {names[place]!r} of {', '.join(names)}"
    unit = str(topography.unit) if topography.unit else None
    return RawScan(heights, description, size, unit, notes, periodic=bool(topography.is_periodic))


def _place(wanted, names: list[str]) -> int:
    """Return the position (from 0) of the requested measurement in a container.

    wanted: name or position; None for the first. names: names of all measurements. Raises InputError if none matches.
    """
    if wanted is None:
        return 0
    if wanted in names:
        return names.index(wanted)
    if str(wanted).isdecimal() and int(wanted) < len(names):
        return int(wanted)
    known = ", ".join(f"{place} {name!r}" for place, name in enumerate(names))
    raise InputError("channel", wanted, f"a measurement of the container: {known}")


READER = Reader(
    endings=(".zip",),
    read=read,
    holds="scans of one surface, a container of contact.engineering; `channel` names the one to read",
    given="nothing",
)
