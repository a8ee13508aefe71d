"""Convert heights at given positions to heights on a regular grid."""

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.raw_scan import FEWEST_POINTS

_ROUNDED = 0.75  # largest deviation of rounded positions, in units of their last digit: 0.5 and a margin


def equally_spaced(x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, tuple[float, float], tuple[str, ...]]:
    """Return a profile with equal spacing: heights (1, n), size (y, x), and notes for the history.

    x, z: positions and heights (n,). The size has the unit of x. Positions count as equally spaced if they deviate only by the
    rounding of their last written digit, because interpolation between rounded positions would create false slopes. Other
    profiles are resampled to the same number of points by linear interpolation. Raises InputError for fewer than FEWEST_POINTS
    points, missing positions, or positions that neither increase nor decrease throughout.
    """
    count = len(x)
    if count < FEWEST_POINTS:
        raise InputError("scan", InWords(f"profile of {count} points"), f"at least {FEWEST_POINTS} points")
    if x[-1] < x[0]:
        x, z = x[::-1], z[::-1]
    if not (np.isfinite(x).all() and x[-1] > x[0]):
        raise InputError("scan", InWords("positions x that are missing or all equal"), "finite positions x that increase")
    place = np.arange(count) - (count - 1) / 2.0
    pitch = float(place @ (x - x.mean()) / (place @ place))
    off = float(np.abs(x - x.mean() - pitch * place).max())
    if off <= max(_ROUNDED * _last_digit(x), 1e-6 * pitch):
        return z[None, :], (pitch, pitch * count), _rounding(off, pitch)
    if not (np.diff(x) > 0.0).all():
        raise InputError("scan", InWords("positions x that decrease"), "positions x that increase along the profile")
    pitch = float(x[-1] - x[0]) / (count - 1)
    heights = np.interp(np.linspace(x[0], x[-1], count), x, z)
    note = f"positions not equally spaced: resampled by linear interpolation to {count} points with equal spacing"
    return heights[None, :], (pitch, pitch * count), (note,)


def gridded(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, tuple[float, float], tuple[str, ...]]:
    """Arrange points on a regular grid; return heights (rows, columns), size (y, x), and notes for the history.

    x, y, z: positions and heights (n,), in any order. Grid points without a height get NaN. Points along one line, parallel to
    x or y, are a profile. Raises InputError if a position is missing, if two points coincide, or if the points are not on a
    grid or fill less than a quarter of it.
    """
    column, dx, columns, notes_x = _places(x, "x")
    row, dy, rows, notes_y = _places(y, "y")
    if columns * rows > 4 * len(z) + 16:
        raise InputError(
            "scan",
            InWords(f"{len(z)} points on a grid of {rows} x {columns}"),
            "points x y z on a regular grid, with a height at a quarter of its points or more",
        )
    flat = row * columns + column
    if np.bincount(flat).max() > 1:
        raise InputError("scan", InWords("several heights at one point x y"), "one height per point of a regular grid")
    heights = np.full((rows, columns), np.nan)
    heights.flat[flat] = z
    dx, dy = dx or dy, dy or dx  # the width of a profile is its point spacing
    notes = tuple(dict.fromkeys(notes_x + notes_y))
    if columns == 1:
        return heights.T, (dy, dy * rows), notes
    return heights, (dy * rows, dx * columns), notes


def _places(x: np.ndarray, name: str) -> tuple[np.ndarray, float, int, tuple[str, ...]]:
    """Return the grid index (n,) of each coordinate, the pitch, the number of grid points along the axis, and history notes.

    x: coordinates (n,). name: "x" or "y", for errors. The pitch is 0 if all coordinates are equal. Raises InputError if a
    coordinate is missing or the coordinates are not equally spaced.
    """
    if not np.isfinite(x).all():
        raise InputError("scan", InWords(f"missing {name}"), "finite positions x y of all points")
    start, extent = float(x.min()), float(x.max() - x.min())
    if extent == 0.0:
        return np.zeros(len(x), dtype=int), 0.0, 1, ()
    steps = np.diff(np.unique(x))
    steps = steps[steps > 1e-6 * extent]  # smaller steps are round-off
    tried = []
    for intervals in {len(steps), round(extent / float(np.median(steps)))}:  # without and with missing lines
        pitch = extent / intervals
        tried.append((float(np.abs((x - start) / pitch - np.rint((x - start) / pitch)).max()), pitch))
    off, pitch = min(tried)
    if off > max(0.1, min(_ROUNDED * _last_digit(x) / pitch, 0.45)):
        raise InputError("scan", InWords(f"positions {name} that are not equally spaced"), "points x y z on a regular grid")
    place = np.rint((x - start) / pitch).astype(int)
    return place, pitch, int(place.max()) + 1, _rounding(off * pitch, pitch)


def _rounding(off: float, pitch: float) -> tuple[str, ...]:
    if off <= 1e-6 * pitch:
        return ()
    return (f"positions equally spaced to {off / pitch:.2g} of the pitch, which is their rounding",)


def _last_digit(x: np.ndarray) -> float:
    """Return the place value of the last written digit of positions (n,): the largest power of ten that divides all of them.

    The result is 0 if the positions have more than ten digits.
    """
    largest = int(np.floor(np.log10(np.abs(x).max())))
    for exponent in range(largest, largest - 10, -1):
        multiples = x / 10.0**exponent
        if np.abs(multiples - np.rint(multiples)).max() < 1e-5:
            return 10.0**exponent
    return 0.0
