"""Asperities along profiles, the rows and columns of a map: three-point peaks, and n-point asperities.

A profile hardly ever crosses a summit: it passes over its shoulders. So its peaks are lower than the summits and, on a smooth
Gaussian surface, blunter: their mean curvature is sqrt(pi m4/2), that of the summits (8/3) sqrt(m4/pi), 1.20 times as large
(Nayak 1971). Where there are ever smaller waves, three points see ever smaller and sharper peaks as the pitch shrinks, a fixed
share of all points, whatever carries the load. That is Greenwood's doubt about three-point peaks (Greenwood & Wu 2001): they
are here to be compared with.

From peaks per length D to asperities per area N, the relation of an isotropic Gaussian surface (Nayak 1971) is used, for either
method: peaks (1/2 pi) sqrt(m4/m2) per length, summits m4 / (6 pi sqrt(3) m2) per area, and thus

    N = 2 pi / (3 sqrt(3)) D_x D_y = 1.2092 D_x D_y.                                                                       (1)
"""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.asperity_set import Asperities, of_samples, over_mean_plane, rounding
from stiction.surfaces.heightmap import HeightMap, in_metres
from stiction.surfaces.theory.n_point import n_point_asperities

# Of equation (1).
SUMMITS_PER_PEAKS_SQUARED = 2.0 * math.pi / (3.0 * math.sqrt(3.0))
_RELATION = f"N = {SUMMITS_PER_PEAKS_SQUARED:.4f} D_x D_y (one direction: D^2) of an isotropic Gaussian surface"


def three_point(surface: HeightMap, directions: str = "xy") -> Asperities:
    """Points higher than both neighbours along a profile, with the curvature of the second difference.

    directions: "xy", "x" or "y", along which the profiles run; of a single profile only "x" is used. Peaks of all profiles are
    taken together; with one direction D_x D_y is D^2. Neighbours must be lower, not equal: plateaus are not counted. Points
    beside missing ones are left out. InputError if fewer than two peaks are found.
    """
    found = [_peaks(lines, pitch) for lines, pitch in _profiles(surface, directions)]
    heights, curvatures = np.concatenate([one[0] for one in found]), np.concatenate([one[1] for one in found])
    return of_samples(
        "three_point",
        heights,
        curvatures,
        _per_area([one[2] for one in found]),
        f"peaks higher than both neighbours on the profiles along {_said(surface, directions)}; {_RELATION}",
    )


def _peaks(lines: np.ndarray, pitch: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Heights and curvatures of the peaks of all lines (lines, points), and how many there are per length."""
    middle = lines[:, 1:-1] - rounding(lines)
    peak = (middle > lines[:, :-2]) & (middle > lines[:, 2:])  # never beside NaN
    line, point = np.nonzero(peak)
    heights = lines[line, point + 1]
    curvatures = (2.0 * heights - lines[line, point] - lines[line, point + 2]) / (pitch * pitch)
    known = np.isfinite(lines)
    triples = np.count_nonzero(known[:, :-2] & known[:, 1:-1] & known[:, 2:])
    return heights, curvatures, len(heights) / (max(int(triples), 1) * pitch)


def n_point(surface: HeightMap, level: Any = 0.0, directions: str = "xy") -> Asperities:
    """Rows of neighbouring points above a level, each one asperity: see surfaces.theory.n_point, which defines height and
    radius.

    level: [m] or text with a unit, over the mean plane. directions: as of `three_point`. Every asperity begins where the
    profile comes up through the level: these places are counted, per length of neighbours that are there. Heights and radii are
    of those asperities that no end and no missing point cuts, which are a little shorter than all. The relation (1) is that
    of peaks, for want of one for n-point asperities. InputError if fewer than two are found.
    """
    level = in_metres(level, "level")
    if not math.isfinite(level):
        raise InputError("level", level, "a finite height over the mean plane [m]")
    heights, curvatures = [np.zeros(0)], [np.zeros(0)]
    per_length: list[float] = []
    for lines, pitch in _profiles(surface, directions):
        found = [n_point_asperities(row, pitch, level) for row in _unbroken(lines)]
        heights += [one.height + level for one in found]
        curvatures += [1.0 / one.radius for one in found]
        per_length.append(_rises(lines, level) / pitch)
    return of_samples(
        "n_point",
        np.concatenate(heights),
        np.concatenate(curvatures),
        _per_area(per_length),
        f"rows of points more than {level:g} m over the mean plane on the profiles along {_said(surface, directions)}; "
        f"{_RELATION}",
    )


def _rises(lines: np.ndarray, level: float) -> float:
    """Share of the neighbours of all lines (lines, points) between which the height comes up through the level."""
    rises = np.count_nonzero((lines[:, :-1] <= level) & (lines[:, 1:] > level + rounding(lines)))  # never beside NaN
    known = np.isfinite(lines)
    return float(rises / max(int(np.count_nonzero(known[:, :-1] & known[:, 1:])), 1))


def _unbroken(lines: np.ndarray) -> Iterator[np.ndarray]:
    """The stretches of every line that have no missing point and at least three."""
    known = np.isfinite(lines)
    whole = known.all(axis=1)
    for row, (line, complete) in enumerate(zip(lines, whole.tolist(), strict=True)):
        if complete:
            yield line
        else:
            ends = np.flatnonzero(np.diff(np.concatenate([[False], known[row], [False]]).astype(np.int8)))
            yield from (line[start:stop] for start, stop in ends.reshape(-1, 2) if stop - start >= 3)


def _profiles(surface: HeightMap, directions: str) -> list[tuple[np.ndarray, float]]:
    """(lines (lines, points) [m] over the mean plane, pitch [m]) for each direction. InputError if they are too short."""
    if not directions or set(directions) - {"x", "y"}:
        raise InputError("directions", directions, "xy, x or y")
    heights = over_mean_plane(surface)
    dy, dx = surface.pitch
    along = {"x": (heights, dx), "y": (heights.T, dy)}
    chosen = [along[one] for one in _said(surface, directions)]
    if any(lines.shape[1] < 3 for lines, _ in chosen):
        raise InputError("heights", f"shape {surface.heights.shape}", "3 or more points along a profile")
    return chosen


def _said(surface: HeightMap, directions: str) -> str:
    return "x" if surface.is_profile else "".join(sorted(set(directions)))


def _per_area(per_length: Sequence[float]) -> float:
    """Equation (1); one direction stands for both."""
    return SUMMITS_PER_PEAKS_SQUARED * per_length[0] * per_length[-1]
