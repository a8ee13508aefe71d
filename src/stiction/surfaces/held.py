"""Convert maps of other packages to HeightMap: topographies of SurfaceTopography, xarray arrays, NumPy arrays.

The methods to_topography and to_xarray of HeightMap convert back.
"""

from typing import Any

import numpy as np

from stiction.quantities.errors import InputError, InWords, field_as
from stiction.quantities.units import has_unit
from stiction.surfaces.heightmap import HeightMap, metres, metres_per
from stiction.surfaces.read import check_numbers, check_scale

_TAKEN = (
    "a HeightMap, a topography of SurfaceTopography, an xarray.DataArray with lengths as coordinates, or (array, size), "
    'e.g. (heights, "40 um"), heights in m'
)
_ROUNDING = 1e-6  # fraction of the pitch by which coordinates may deviate from equal spacing


def as_height_map(value: Any, field: str = "scan") -> HeightMap:
    """Return a map of another package as a HeightMap, with heights in metres.

    value is one of:

    - a HeightMap, which is returned unchanged
    - a topography of SurfaceTopography with a unit
    - an xarray.DataArray with dimensions (y, x), or (x,) for a profile. Its coordinates are equally spaced lengths. The
      attribute `units` of the array and of each coordinate specifies the unit.
    - a pair (array, size). The array holds heights (rows, columns) or (columns,) in m. The size is the length along x,
      for square pixels, or (y, x), in metres or as text with a unit.

    field: name of the input, for the error. Raises InputError for any other value, and for heights that are too few, all
    missing, all equal, or implausible for the size.
    """
    if isinstance(value, HeightMap):
        return value
    with field_as(lambda own: field if own == "scan" else f"{field}.{own}".lstrip(".")):
        if _is_topography(value):
            return _of_topography(value)
        if _is_labelled(value):
            return _of_labelled(value)
        if _is_pair(value):
            return _made(*_of_pair(value), "an array", ("heights in m as given",))
    raise InputError(field, type(value).__name__, _TAKEN)


def _is_topography(value: Any) -> bool:
    return all(hasattr(value, name) for name in ("heights", "physical_sizes", "dim", "is_uniform"))


def _is_labelled(value: Any) -> bool:
    return hasattr(value, "dims") and hasattr(value, "coords") and not hasattr(value, "data_vars")


def _is_pair(value: Any) -> bool:
    return isinstance(value, tuple | list) and len(value) == 2 and hasattr(value[0], "__array__") and np.ndim(value[0]) > 0


def _made(heights: np.ndarray, size: tuple[float, float], what: str, history: tuple[str, ...], name: str = "") -> HeightMap:
    """Build a HeightMap, after the same checks as for scan files.

    heights: (rows, columns) [m]. size: (y, x) [m]. what: origin of the heights, for the history. history: further lines for it.
    name: name of the map, by default `what`. Raises InputError as `check_numbers` and `check_scale` do.
    """
    surface = HeightMap(heights, size, history=(f"taken from {what}", *history), name=name or what)
    check_numbers(surface.heights, surface.name)
    check_scale(surface.heights, surface.size, surface.name)
    return surface


def _of_pair(value: Any) -> tuple[np.ndarray, tuple[float, float]]:
    heights, size = np.atleast_2d(value[0]), value[1]
    if heights.ndim != 2:
        raise InputError(
            "heights", InWords(f"array of shape {heights.shape}"), "heights (rows, columns), or (columns,) for a profile"
        )
    rows, columns = heights.shape
    lengths = list(size) if isinstance(size, tuple | list) else [size]
    if len(lengths) not in (1, 2):
        raise InputError("size", size, "one length along x, or two (y, x)")
    x = metres(lengths[-1], "size")
    return heights, (x / columns * rows if len(lengths) == 1 else metres(lengths[0], "size"), x)


def _of_topography(topography: Any) -> HeightMap:
    from stiction.surfaces.readers.shared.topography import on_grid

    if topography.unit is None or topography.physical_sizes is None:
        raise InputError(
            "scan", InWords("a topography without unit or size"), 'a topography with both, e.g. Topography(..., unit="um")'
        )
    factor = metres_per(str(topography.unit), "unit")
    heights, size, notes = on_grid(topography)
    name = str(getattr(topography, "info", {}).get("name", "") or "")
    history = (f"unit of the topography: {topography.unit}", *notes)
    return _made(heights * factor, (size[0] * factor, size[1] * factor), "a topography", history, name)


def _of_labelled(array: Any) -> HeightMap:
    if array.ndim not in (1, 2):
        raise InputError("scan", InWords(f"DataArray of shape {array.shape}"), "heights (y, x), or (x,) for a profile")
    if array.dims == ("x", "y"):
        array = array.transpose("y", "x")
    pitches = [_pitch(array, str(dim)) for dim in array.dims]
    data = array.data
    if has_unit(data):
        heights, unit = np.asarray(data.magnitude), f"{data.units:C}"
    else:
        heights, unit = array.values, _unit_of(array, "heights")
    heights = np.atleast_2d(np.asarray(heights, dtype=float)) * metres_per(unit, "heights")
    steps = pitches if array.ndim == 2 else [pitches[0], pitches[0]]
    size = (steps[0] * heights.shape[0], steps[1] * heights.shape[1])
    return _made(heights, size, "a DataArray", (f"unit of the heights: {unit}",), str(array.name or ""))


def _pitch(array: Any, dim: str) -> float:
    """Return the point spacing [m] along a dimension of an xarray array; raise InputError unless it is uniform, in lengths."""
    if dim not in array.coords:
        raise InputError(
            dim, None, "a coordinate with the positions of the points, in m or in the unit of its attribute `units`"
        )
    coordinate = array.coords[dim]
    places = np.asarray(coordinate.values)
    if places.dtype.kind not in "iuf" or len(places) < 2:
        raise InputError(dim, InWords(f"{len(places)} positions of type {places.dtype}"), "two or more positions as lengths")
    steps = np.diff(places.astype(float))
    pitch = float(steps.mean())
    if not (np.isfinite(pitch) and pitch != 0.0 and np.abs(steps - pitch).max() <= _ROUNDING * abs(pitch)):
        raise InputError(dim, InWords(f"steps from {steps.min():.6g} to {steps.max():.6g}"), "equally spaced positions")
    return abs(pitch) * metres_per(_unit_of(coordinate, dim), dim)


def _unit_of(array: Any, field: str) -> str:
    """Return the unit in the attribute `units` of an xarray array, such as "um"; field: name of the input, for the error.

    Raises InputError if the attribute is missing. Metres are not assumed, because most maps are in um or nm.
    """
    if "units" not in array.attrs:
        raise InputError(f"units of {field}", None, 'the attribute `units` of the array, e.g. assign_attrs(units="um")')
    return str(array.attrs["units"])
