r"""Find n-point asperities: each run of neighbouring points above a level in a row or column of a map is one asperity.

Hariri, Zu & Ben Mrad (2006) let the level move with the separation of the surfaces. Here the level is fixed, because the sum
over asperities needs heights that do not depend on the separation. Height and radius of an asperity are reconstructed: see
stiction.surfaces.theory.n_point.

*Assumes*: an asperity is $n$ neighbouring sampled points of a profile whose $n-2$ middle ones are above a level. *Source*:
[hariri_zu_ben_mrad_2006], its abstract. *Unknown*: every formula. *Reconstruction*: $R_n$ is the radius of the parabola of
height $t$ (highest point above the level) over the chord $L=(n-1)\ell$ with the point spacing $\ell$. $D$ is the number of
upward crossings of the level per length; $N$ follows from it by the relation for peaks:

$$
R_n=\frac{L^2}{8t},\qquad N=\frac{2\pi}{3\sqrt3}D_xD_y
$$
"""

from collections.abc import Iterator

import numpy as np

from stiction.records.registry import AsperityMethod, Parameter
from stiction.records.sources import Source
from stiction.surfaces.asperity_method.shared.profiles import DIRECTIONS, RELATION, directions_of, per_area, places_of, profiles
from stiction.surfaces.asperity_set import Asperities, of_samples, rounding
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.theory.n_point import n_point_asperities


def n_point(surface: HeightMap, level: float, directions: str) -> Asperities:
    """Find runs of neighbouring profile points above a level; each run is one asperity.

    - level: height [m] above the mean plane
    - directions: "x", "y" or "xy", the directions of the profiles

    The module stiction.surfaces.theory.n_point defines height and radius of an asperity. The density per length is the number
    of upward crossings of the level. The density per area follows from it by the relation for peaks of a Gaussian surface,
    because none is published for n-point asperities. Heights and radii exclude asperities cut by the end of a profile or by a
    missing point, which biases them towards shorter asperities. Raises InputError for profiles of fewer than three points,
    for fewer than two asperities, and if the profiles along one direction have none.
    """
    heights, curvatures = [np.zeros(0)], [np.zeros(0)]
    per_length: list[float] = []
    points: list[tuple[np.ndarray, np.ndarray]] = []
    for lines, pitch in profiles(surface, directions):
        found = [(line, start, n_point_asperities(row, pitch, level)) for line, start, row in _unbroken(lines)]
        heights += [one.height + level for _, _, one in found]
        curvatures += [1.0 / one.radius for _, _, one in found]
        each = [np.column_stack((np.full(len(one.middle), line), start + one.middle)) for line, start, one in found]
        points.append(tuple(np.concatenate([np.zeros((0, 2), dtype=int), *each]).T))
        per_length.append(_rises(lines, level) / pitch)
    return of_samples(
        "n_point",
        np.concatenate(heights),
        np.concatenate(curvatures),
        per_area(per_length),
        f"rows of points more than {level:g} m over the mean plane on the profiles along {directions_of(surface, directions)}; "
        f"{RELATION}",
        places=places_of(points, surface, directions),
    )


def _rises(lines: np.ndarray, level: float) -> float:
    """Return the fraction of neighbouring point pairs between which the height rises through the level.

    lines: heights (lines, points) [m]. level: [m]. Pairs with a missing point are left out.
    """
    rises = np.count_nonzero((lines[:, :-1] <= level) & (lines[:, 1:] > level + rounding(lines)))  # False next to NaN
    known = np.isfinite(lines)
    return float(rises / max(int(np.count_nonzero(known[:, :-1] & known[:, 1:])), 1))


def _unbroken(lines: np.ndarray) -> Iterator[tuple[int, int, np.ndarray]]:
    """Yield each run of at least three neighbouring points with known heights, as (line, first point, heights).

    lines: heights (lines, points) [m], NaN where missing. Each item holds the index of the line, the index of the first point
    of the run, and the heights of the run [m].
    """
    known = np.isfinite(lines)
    whole = known.all(axis=1)
    for row, (line, complete) in enumerate(zip(lines, whole.tolist(), strict=True)):
        if complete:
            yield row, 0, line
        else:
            ends = np.flatnonzero(np.diff(np.concatenate([[False], known[row], [False]]).astype(np.int8)))
            yield from ((row, start, line[start:stop]) for start, stop in ends.reshape(-1, 2) if stop - start >= 3)


RECORD = AsperityMethod(
    key="n_point",
    title="Runs of neighbouring profile points above a level; radius of the parabola through height and length of a run",
    label="n-point asperities",
    grade="C",
    sources=(
        Source(
            "hariri_zu_ben_mrad_2006",
            "abstract",
            "reconstructed: height and radius of an asperity (the abstract does not print their definitions), and the level, "
            "which is fixed here, but moves with the separation in the paper",
        ),
        Source("nayak_1971", "", "conversion from asperities per length to N, as for peaks; a convention"),
    ),
    verified="profiles made by hand and sinusoids in closed form; on Gaussian surfaces N is the number of summits over alpha, "
    "as by Rice's and Nayak's formulas, to 4 %",
    find=n_point,
    order=4,
    accuracy=0.02,
    parameters={
        "level": Parameter("height above the mean plane; points above it are counted", 0.0),
        "directions": DIRECTIONS,
    },
    notes="An asperity at the level of the mean plane is a hill with many summits, and the radius is that of the hill. "
    "Runs of points above a level are not summits, so N follows by a convention. The length of a run is measured "
    "between the points below the level: for a run of n points the radius is up to 4/n too large.",
)
