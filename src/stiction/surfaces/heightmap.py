"""Define the class HeightMap, which represents every measured or generated surface or profile."""

import warnings
from dataclasses import dataclass, replace
from numbers import Real
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.extras import how_to_install
from stiction.quantities.units import to_si

if TYPE_CHECKING:
    import xarray
    from SurfaceTopography import Topography, UniformLineScan

_LEAST, _MOST = 1e-60, 1e60  # limits of a side [m], within which fourth powers of the pitch neither overflow nor underflow


@dataclass(frozen=True)
class HeightMap:
    """Store heights on a regular grid, with the size of the map and its history.

    Parameters
    ----------
    heights : array_like (rows, columns) [m]
        NaN where missing. Rows run along y, columns along x; a profile is (1, columns). Stored as float64.
    size : (y, x) [m], each a number or text with a unit
        Positive. The pitch is size / count: N points span N intervals, as in one period of a periodic surface. The y size of a
        profile is only the width of its row.
    history : tuple of str, optional
        Every processing step, in words.
    name : str, optional
        Name of the scan.
    periodic : bool, optional
        Whether the map is one period of an endless surface, as generated maps are; by default not.

    Raises
    ------
    InputError
        The heights are empty, not a two-dimensional array of numbers, or include infinite values, or the size is not two
        lengths between 1e-60 and 1e60 m.

    Examples
    --------
    >>> import stiction as st
    >>> surface = st.HeightMap([[0.0, 1e-9], [2e-9, 1e-9]], size=("2 um", "4 um"))
    >>> surface.heights.shape, surface.missing
    ((2, 2), 0)
    >>> print(surface.pitch)
    (1e-06, 2e-06)
    """

    heights: np.ndarray
    size: tuple[float, float]
    history: tuple[str, ...] = ()
    name: str = ""
    periodic: bool = False

    def __post_init__(self) -> None:
        heights = _unmasked(self.heights)
        if heights.ndim != 2 or heights.size == 0 or heights.dtype.kind not in "iuf":
            raise InputError(
                "heights", InWords(f"{heights.dtype} of shape {heights.shape}"), "numbers of shape (rows, columns), in m"
            )
        heights = np.asarray(heights, dtype=np.float64)
        if np.isinf(heights).any():
            raise InputError("heights", InWords("infinite values"), "finite heights in m, NaN where missing")
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "size", size_in_metres(self.size))
        object.__setattr__(self, "history", tuple(self.history))

    @property
    def pitch(self) -> tuple[float, float]:
        """Return (dy, dx) [m], the distance between neighbouring points along y and x: size / count."""
        rows, columns = self.heights.shape
        return self.size[0] / rows, self.size[1] / columns

    @property
    def coarsest_pitch(self) -> float:
        """Return the larger of the point distances [m] along y and x; for a profile, the distance along x."""
        return self.pitch[1] if self.is_profile else max(self.pitch)

    @property
    def missing(self) -> int:
        """Return the number of points without a height."""
        return int(np.count_nonzero(np.isnan(self.heights)))

    @property
    def complete(self) -> bool:
        """Return whether every point has a height."""
        return self.missing == 0

    @property
    def is_profile(self) -> bool:
        """Return whether the map is a profile: a single row of points."""
        return self.heights.shape[0] == 1

    def to_xarray(self) -> "xarray.DataArray":
        """Return the map as an xarray.DataArray with dimensions (y, x), or (x,) for a profile.

        Heights and coordinates are in m. The history is an attribute; `periodic` is not stored. Functions that accept a
        HeightMap also accept this array, as a map that is not periodic.
        """
        import xarray

        places = {
            name: (name, pitch * np.arange(count), {"long_name": f"position along {name}", "units": "m"})
            for name, pitch, count in zip("yx", self.pitch, self.heights.shape, strict=True)
        }
        dims, heights = (("x",), self.heights[0]) if self.is_profile else (("y", "x"), self.heights)
        attributes = {"long_name": "height", "units": "m", "history": "\n".join(self.history)}
        return xarray.DataArray(heights, dims=dims, coords={one: places[one] for one in dims}, name=self.name, attrs=attributes)

    def to_topography(self) -> "Topography | UniformLineScan":
        """Return the map as a topography of the library SurfaceTopography.

        Lengths are in m. Missing points are masked. Raises InputError if the optional library is not installed.
        """
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # warnings of the library about its own dependencies
                from SurfaceTopography import Topography, UniformLineScan
        except ImportError:
            raise InputError(
                "topography", None, f"an installed library; install it with: {how_to_install('SurfaceTopography')}"
            ) from None
        heights = self.heights if self.complete else np.ma.masked_invalid(self.heights)
        about = {"name": self.name, "history": list(self.history)}
        if self.is_profile:
            return UniformLineScan(heights[0], self.size[1], unit="m", info=about)
        return Topography(heights.T, self.size[::-1], unit="m", info=about)

    def with_heights(self, heights: np.ndarray, step: str, size: tuple[float, float] | None = None) -> "HeightMap":
        """Return a copy with new heights and one more line in its history.

        heights: new heights (rows, columns) [m]. step: description of the processing step, for the history. size: new size (y,
        x) [m], None if unchanged.
        """
        return replace(self, heights=heights, size=self.size if size is None else size, history=(*self.history, step))

    def alone(self) -> "HeightMap":
        """Return the map marked as not periodic; called after a processing step that destroys periodicity."""
        return replace(self, periodic=False) if self.periodic else self


def _unmasked(heights) -> np.ndarray:
    """Return heights as an array; masked values of a masked array of real numbers become NaN.

    Raises InputError for rows of different lengths. The type of the array is not checked.
    """
    if not isinstance(heights, np.ma.MaskedArray) or heights.dtype.kind not in "iuf":
        try:
            return np.asarray(heights)
        except (TypeError, ValueError):  # rows of different lengths, or a dataset
            raise InputError("heights", heights, "numbers of shape (rows, columns), in m") from None
    return np.ma.filled(heights.astype(np.float64), np.nan)


def every_point(heights: np.ndarray, size: tuple[float, float], every: int) -> tuple[np.ndarray, tuple[float, float]]:
    """Return every n-th point of a map along both axes, and the size (y, x) [m] of this coarser map.

    heights: (rows, columns). size: (y, x) [m] of the map. every: the number n; 1 returns all points. The coarser map has n
    times the point spacing.
    """
    points = np.ascontiguousarray(heights[::every, ::every])
    high, wide = (length / full * every * few for length, full, few in zip(size, heights.shape, points.shape, strict=True))
    return points, (high, wide)


def size_in_metres(size) -> tuple[float, float]:
    """Return the size (y, x) of a map in metres, from a pair of numbers [m] or texts with units.

    Raises InputError unless both lie between 1e-60 and 1e60 m.
    """
    try:
        y, x = (float(in_metres(one, "size")) for one in size)
    except (TypeError, ValueError):
        y = x = 0.0
    if not (_LEAST < y < _MOST and _LEAST < x < _MOST):
        raise InputError("size", size, f"(y, x), two lengths from {_LEAST:g} to {_MOST:g} m")
    return y, x


def in_metres(value, field: str) -> float:
    """Return a length in metres, from a number [m] or text such as "10 um"; it may be negative or zero.

    field: name of the input, for the error. Raises InputError for text that is not a length, and for an integer above the
    range of a float. NaN and infinity are returned.
    """
    try:
        return float(value) if isinstance(value, Real) else to_si(str(value), "mean_separation")
    except OverflowError:  # an integer with hundreds of digits
        raise InputError(field, value, "a finite length, in m") from None
    except InputError as error:
        raise InputError(field, error.value, 'a length, e.g. "10 um"') from None


def metres_per(unit: str, field: str) -> float:
    """Return the length in metres of one unit, such as 1e-9 for "nm"; raise InputError for an unknown unit.

    field: name of the input, for the error.
    """
    try:
        return metres(f"1 {unit}", field)
    except InputError:
        raise InputError(field, unit, 'a length unit, e.g. "nm"') from None


def metres(value, field: str) -> float:
    """Return a length > 0 in metres, from a number [m] or text such as "10 um".

    field: name of the input, for the error. Raises InputError if the value is not a single length > 0.
    """
    try:
        length = to_si(value, "scan_size")
    except InputError as error:
        hint = "" if "e.g." in error.allowed else ', e.g. "10 um"'
        raise InputError(field, error.value, error.allowed + hint) from None
    if not isinstance(length, float):
        raise InputError(field, value, "one length")
    return length
