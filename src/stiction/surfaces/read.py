"""Read scan files of instruments into height maps, with heights in metres.

Arrays and text files need no other library. All other formats need SurfaceTopography, an optional dependency. Each format is a
module in `readers` with a constant READER; no other code depends on the format.

Libraries and instruments may disagree on the size, unit and height factor of a file. The user can override all three, and the
history of the map states the values used.
"""

import pkgutil
import re
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.shown import show
from stiction.surfaces import readers as formats
from stiction.surfaces.heightmap import HeightMap, metres, metres_per
from stiction.surfaces.raw_scan import FEWEST_POINTS, RawScan, Reader
from stiction.surfaces.readers.shared.packed import check_packed

if TYPE_CHECKING:
    from stiction.quantities.arguments import FilePath, QuantityLike

_FLATTEST, _STEEPEST = 1e-10, 10.0  # limits of peak to valley over size; outside them a unit or a factor must be wrong


def read_scan(
    path: "FilePath",
    *,
    size: "QuantityLike | None" = None,
    unit: str | None = None,
    height_unit: str | None = None,
    height_scale: float | None = None,
    channel: str | int | None = None,
) -> HeightMap:
    """Read a scan file as a height map, with heights in metres.

    Parameters
    ----------
    path : str or Path
        File of the scan.
    size : float [m], str with a unit, or (y, x), optional
        Size in place of the one in the file; a single length is along x, with square pixels. Text without a unit is in `unit`.
    unit : str, optional
        Unit of the numbers in the file, e.g. "nm". It applies to the heights too unless `height_unit` is specified.
    height_unit : str, optional
        Unit of the heights in the file.
    height_scale : float, optional
        Factor by which the heights are multiplied, not 0.
    channel : str or int, optional
        Name or position of a channel; by default the library's default channel if it contains heights, else the first channel
        with heights. For .npz, the name of an array, needed if there are two or more.

    Returns
    -------
    HeightMap
        Heights (rows, columns) [m], NaN where missing; `history` names the format and every overridden number.

    Raises
    ------
    InputError
        The file is absent, empty, damaged, of unknown format, too small (FEWEST_POINTS), without heights, with equal heights,
        or wrongly scaled; its size or unit is missing; or an option is not allowed.

    Notes
    -----
    Arrays (.npy, .npz) and matrices in text need `size` and `unit`; columns x y z or x z need only `unit`. Profiles with
    unequal spacing are resampled.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import numpy as np
    >>> import stiction as st
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "scan.npy"
    >>> np.save(path, np.sin(np.arange(1024.0)).reshape(32, 32))
    >>> scan = st.read_scan(path, size="10 um", unit="nm")
    >>> scan.heights.shape, scan.missing
    ((32, 32), 0)
    """
    path = _file(path)
    raw = _read(path, channel)
    check_numbers(raw.heights, path.name)
    factor, height_factor, units = _factors(raw, size, unit, height_unit, height_scale)
    extent, override = _size(raw, size, unit, factor)
    with np.errstate(over="ignore", invalid="ignore"):  # check_scale reports heights that are not finite
        heights = np.asarray(raw.heights, dtype=np.float64) * height_factor
    check_scale(heights, extent, path.name)
    surface = HeightMap(heights, extent, name=path.name)
    history = (_said(surface, raw), *raw.notes, *units, *override, *_scale_warning(heights, extent))
    return HeightMap(heights, extent, history, path.name, raw.periodic)


@cache
def readers() -> tuple[Reader, ...]:
    """Return the readers of all scan file formats in the order in which they are tried.

    They are sorted by module name; readers without a file name ending come last.
    """
    names = sorted(one.name for one in pkgutil.iter_modules(formats.__path__))
    modules = [import_module(f"{formats.__name__}.{name}") for name in names]
    found = [module.READER for module in modules if hasattr(module, "READER")]
    return tuple(sorted(found, key=lambda one: not one.endings))


def _read(path: Path, channel) -> RawScan:
    """Return the content of a scan file, read by the first reader that recognises its format.

    channel: name or position of the channel, None for the default. Only readers for the ending of the file name, and readers
    without an ending, are tried. Raises InputError if none recognises the format.
    """
    check_packed(path)
    ending = path.suffix.lower()
    asked = [one for one in readers() if ending in one.endings or not one.endings]
    for reader in asked:
        if (raw := reader.read(path, channel)) is not None:
            return raw
    known = [f"with {one.holds}" if one.endings else one.holds for one in asked]
    if not any(one.endings for one in asked):
        known.insert(0, ", ".join(ending for one in readers() for ending in one.endings))
    raise InputError("scan", str(path), f"an undamaged file of a known format: {', or '.join(known)}")


def _said(surface: HeightMap, raw: RawScan) -> str:
    rows, columns = surface.heights.shape
    (dy, dx), (y, x) = ([show(length, "scan_size") for length in pair] for pair in (surface.pitch, surface.size))
    if surface.is_profile:
        points = f"profile of {columns} points, length {x}, pitch = length/count = {dx}"
    else:
        points = f"{columns} x {rows} points, size {x} x {y} (x, y), pitch = size/count = {dx} x {dy}"
    return f"read {surface.name}, {raw.description}: {points}, {surface.missing} points missing" + (
        ", periodic" if raw.periodic else ""
    )


# ---- checks


def _file(path) -> Path:
    if not isinstance(path, str | Path):
        raise InputError("scan", path, "the name of an existing file")
    path = Path(path)
    try:
        if not path.is_file():
            raise InputError("scan", str(path), "the name of an existing file")
        with path.open("rb") as file:
            if not file.read(1 << 20).strip():
                raise InputError("scan", str(path), "a file that is not empty")
    except OSError as error:
        raise InputError("scan", str(path), f"a file that can be read ({error.strerror})") from None
    return path


def check_numbers(heights: np.ndarray, name: str) -> None:
    """Raise InputError if heights (rows, columns) are too few, all missing or all equal.

    The unit of the heights does not matter. name: name of the file, for the error.
    """
    rows, columns = heights.shape
    if columns < FEWEST_POINTS or (rows != 1 and rows < FEWEST_POINTS):
        hint = "; columns x z or x y z are read from .csv and .xyz" if columns in (2, 3) else ""
        allowed = f"at least {FEWEST_POINTS} points along a profile or each direction of a map{hint}"
        raise InputError("scan", InWords(f"{name} of {rows} x {columns} points"), allowed)
    if np.isnan(heights).all():
        raise InputError("scan", InWords(f"{name}: all {heights.size} points missing"), "a scan with heights")
    if np.nanmax(heights) == np.nanmin(heights):
        raise InputError("scan", InWords(f"{name}: constant heights"), "heights that differ")


def check_scale(heights: np.ndarray, size: tuple[float, float], name: str) -> None:
    """Raise InputError unless the heights [m] are finite or NaN, and their range is plausible for the size (y, x) [m].

    The range must be 1e-10 to 10 times the longer side. name: name of the file, for the error.
    """
    if np.isinf(heights).any():
        raise InputError("scan", InWords(f"{name} with infinite heights"), "finite heights, nan where missing")
    with np.errstate(over="ignore"):
        range_ = float(np.nanmax(heights) - np.nanmin(heights))
    if not _FLATTEST * max(size) <= range_ <= _STEEPEST * max(size):
        value = f"{name}: peak to valley {range_:.3g} m on a size of {max(size):.3g} m"
        raise InputError("scan", value, f"{_FLATTEST:g} to {_STEEPEST:g} of the size; check unit, height unit and size")


def _scale_warning(heights: np.ndarray, size: tuple[float, float]) -> tuple[str, ...]:
    if np.nanmax(heights) - np.nanmin(heights) > max(size):
        return ("input warning: peak to valley is larger than the size; check unit, height unit and size",)
    return ()


# ---- units and size


def _factors(raw: RawScan, size, unit, height_unit, height_scale) -> tuple[float, float, tuple[str, ...]]:
    """Return metres per lateral unit (1 if no unit is known), metres per height unit, and remarks on both for the history.

    raw: content of the file. unit, height_unit, height_scale: as specified by the user, else None. size: the specified size or
    None. Raises InputError for an unknown or missing unit, and for a height_scale that is 0 or not finite.
    """
    taken = unit or raw.unit
    heights_in = height_unit or taken
    if heights_in is None or (taken is None and size is None and raw.size is not None):
        raise InputError("unit", None, 'the length unit of the numbers in the file, e.g. "nm"')
    scale = 1.0 if height_scale is None else height_scale
    if isinstance(scale, bool) or not isinstance(scale, int | float) or not 0.0 < abs(scale) <= 1e300:
        raise InputError("height_scale", height_scale, "a finite number other than 0")
    steps = []
    if unit and raw.unit:
        steps.append(f"unit overridden: {unit} for {raw.unit} of the file")
    elif taken:
        steps.append(f"unit as given: {unit}" if unit else f"unit of the file: {raw.unit}")
    if height_unit:
        steps.append(f"unit of heights overridden: {height_unit}" if raw.unit else f"unit of heights as given: {height_unit}")
    if height_scale is not None:
        steps.append(f"heights multiplied by {height_scale:g} as given")
    lateral = metres_per(taken, "unit") if taken else 1.0
    return lateral, metres_per(heights_in, "height_unit" if height_unit else "unit") * scale, tuple(steps)


def _size(raw: RawScan, size, unit, factor: float) -> tuple[tuple[float, float], tuple[str, ...]]:
    """Return the size (y, x) [m] of a scan, as specified or from the file, and remarks for the history.

    size: as specified by the user, None to use the file. unit: unit of a size without one. factor: metres per unit of the file.
    Raises InputError if neither states a size, or if the size is not allowed.
    """
    rows, columns = raw.heights.shape
    if size is None:
        if raw.size is None:
            raise InputError("size", None, 'the length along x ("10 um") or (y, x), because the file does not state it')
        y, x = raw.size[0] * factor, raw.size[1] * factor
        if not (np.isfinite([y, x]).all() and y > 0.0 and x > 0.0):
            raise InputError(
                "size", InWords(f"{y:g} m x {x:g} m in the file"), "finite lengths > 0 m; state size if the file is wrong"
            )
        return (y, x), ()
    lengths = [_given(entry, unit) for entry in (size if isinstance(size, tuple | list) else (size,))]
    if len(lengths) not in (1, 2):
        raise InputError("size", size, "one length along x, or two (y, x)")
    x = lengths[-1]
    y = x / columns * rows if len(lengths) == 1 or rows == 1 else lengths[0]
    return (y, x), (_override(raw),)


def _override(raw: RawScan) -> str:
    if raw.size is None:
        return "size as given"
    return f"size overridden: in the file {raw.size[1]:g} x {raw.size[0]:g} {raw.unit or 'without unit'} (x, y)"


def _given(length, unit) -> float:
    if isinstance(length, str) and unit and re.fullmatch(r"[\s\d.eE+-]+", length):
        length = f"{length} {unit}"
    return metres(length, "size")
