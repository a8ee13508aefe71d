r"""Find the peaks of profiles: points higher than both neighbours along a row or a column of a map.

A profile hardly ever passes over the top of a summit, so its peaks are lower than the summits. On a
smooth Gaussian surface they are also blunter: the mean curvature of peaks is sqrt(pi m4/2), while the mean curvature of summits
is (8/3) sqrt(m4/pi), 1.20 times as large (Nayak 1971). On a surface with waves of every size the peaks get ever smaller and
sharper as the pitch shrinks. The peaks are then a fixed fraction of all points, regardless of which points carry load. This is
Greenwood's objection to three-point peaks (Greenwood & Wu 2001); the method is included for comparison.

*Assumes*: an asperity is a sampled point of a profile that is higher than both neighbours. *Source*:
[greenwood_williamson_1966] for the peaks, [nayak_1971] for the number of summits of an isotropic Gaussian surface from the
number of peaks of its profiles, $D$ per length. With the pitch $\ell$,

$$
\kappa_i=\frac{2z_i-z_{i-1}-z_{i+1}}{\ell^2},\qquad N=\frac{2\pi}{3\sqrt3}D_xD_y,\qquad\frac1R=\bar\kappa
$$
"""

import numpy as np

from stiction.records.registry import AsperityMethod
from stiction.records.sources import Source
from stiction.surfaces.asperity_method.shared.profiles import DIRECTIONS, RELATION, directions_of, per_area, places_of, profiles
from stiction.surfaces.asperity_set import Asperities, of_samples, rounding
from stiction.surfaces.heightmap import HeightMap


def three_point(surface: HeightMap, directions: str) -> Asperities:
    """Find the points of profiles of a map that are higher than both neighbours, as asperities.

    directions: "x", "y" or "xy", the directions of the profiles, whose peaks are pooled. The curvature of a peak is the second
    difference of the heights. The density per area follows from the peaks per length, 1.2092 D_x D_y, or 1.2092 D^2 for
    profiles along one direction. A neighbour of equal height disqualifies a point, so plateaus are not counted. Points next to
    missing ones are excluded. Raises InputError for profiles of fewer than three points, for fewer than two
    peaks, and if the profiles along one direction have none.
    """
    found = [_peaks(lines, pitch) for lines, pitch in profiles(surface, directions)]
    heights, curvatures = np.concatenate([one[0] for one in found]), np.concatenate([one[1] for one in found])
    return of_samples(
        "three_point",
        heights,
        curvatures,
        per_area([one[2] for one in found]),
        f"peaks higher than both neighbours on the profiles along {directions_of(surface, directions)}; {RELATION}",
        places=places_of([one[3] for one in found], surface, directions),
    )


def _peaks(lines: np.ndarray, pitch: float) -> tuple[np.ndarray, np.ndarray, float, tuple[np.ndarray, np.ndarray]]:
    """Return heights (n,) [m] and curvatures (n,) [1/m] of all peaks, their number per length [1/m], and their indices.

    lines: heights (lines, points) [m]. pitch: point spacing [m]. The indices are two arrays (n,): index of the line, index of
    the point.
    """
    middle = lines[:, 1:-1] - rounding(lines)
    peak = (middle > lines[:, :-2]) & (middle > lines[:, 2:])  # False next to NaN
    line, point = np.nonzero(peak)
    heights = lines[line, point + 1]
    curvatures = (2.0 * heights - lines[line, point] - lines[line, point + 2]) / (pitch * pitch)
    known = np.isfinite(lines)
    triples = np.count_nonzero(known[:, :-2] & known[:, 1:-1] & known[:, 2:])
    return heights, curvatures, len(heights) / (max(int(triples), 1) * pitch), (line, point + 1)


RECORD = AsperityMethod(
    key="three_point",
    title="Points of a profile that are higher than both neighbours; curvature by the second difference",
    label="three-point peaks",
    grade="B",
    sources=(
        Source("greenwood_williamson_1966", "", "asperities as points of a profile that are higher than both neighbours"),
        Source("nayak_1971", "", "conversion from peaks per length to summits per area"),
        Source("whitehouse_archard_1970", "", "fraction of the points that are peaks"),
        Source("greenwood_wu_2001", "", "why such peaks are not asperities"),
    ),
    verified="arrays of paraboloids in closed form; peaks of Gaussian profiles (Nayak) to 3 %; the fraction of points that are "
    "peaks in sampled profiles (Whitehouse & Archard)",
    find=three_point,
    order=1,
    parameters={"directions": DIRECTIONS},
    notes="A profile rarely passes over the top of a summit, so the radii are at least 1.20 times too large. If there are "
    "waves shorter than the pitch, a fixed fraction of all points are peaks, so N and R depend on the instrument. "
    "Plateaus are not counted. The conversion from peaks per length to N assumes an isotropic Gaussian surface.",
)
