r"""Find the summits of a map: points higher than their eight neighbours, with fitted curvatures.

The result depends on the pitch, the point spacing (Greenwood 1984): where waves are sampled by too few points, some summits are
missed, and the others appear too low and too blunt. Where a long summit runs obliquely to the grid, more than one of its points
is higher than all neighbours.

*Assumes*: an asperity is a sampled point that is higher than its eight neighbours; its curvature is computed from the
least-squares paraboloid through 5, 9 (the default), 25 or 49 points around it. *Source*: [nayak_1971] for the summits that
these points represent. With $n$ such points of heights $z$ on the area $A$ where they could be, and the second derivatives of
the paraboloid,

$$
\kappa=-\tfrac12(z_{xx}+z_{yy}),\qquad N=\frac nA,\qquad\sigma^2=\overline{(z-\bar z)^2},\qquad\frac1R=\bar\kappa
$$
"""

from itertools import product

import numpy as np

from stiction.records.registry import AsperityMethod, Parameter
from stiction.records.sources import Source
from stiction.surfaces.asperity_method.shared.summits import FITS, areal, fitted
from stiction.surfaces.asperity_set import Asperities, rounding
from stiction.surfaces.heightmap import HeightMap


def eight_neighbour(surface: HeightMap, fit_points: int) -> Asperities:
    """Find the points of a map that are higher than all eight neighbours, as asperities.

    fit_points: number of points of the paraboloid fitted around each, a key of FITS. A neighbour of equal height disqualifies a
    point, so plateaus are not counted. A summit is excluded if a fitted point is missing or off the map. The density is the
    number of summits divided by the area of the positions where they could be counted. Raises InputError for a map with
    fewer than three rows or columns, for fewer than two summits, and for a mean curvature that is not positive.
    """
    heights = areal(surface)
    middle = heights[1:-1, 1:-1]
    top = np.ones(middle.shape, dtype=bool)
    rows, columns = heights.shape
    middle = middle - rounding(heights)
    for i, j in product(range(3), range(3)):
        if (i, j) != (1, 1):
            top &= middle > heights[i : rows - 2 + i, j : columns - 2 + j]  # False next to NaN
    row, column = np.nonzero(top)
    note = f"summits higher than all eight neighbours; paraboloid through {fit_points} points"
    return fitted("eight_neighbour", surface, heights, (row + 1, column + 1), fit_points, note)


RECORD = AsperityMethod(
    key="eight_neighbour",
    title="Points of a map that are higher than all eight neighbours; curvature of the least-squares paraboloid around each",
    label="eight-neighbour summits",
    grade="B",
    sources=(
        Source("nayak_1971", "", "summits of a Gaussian surface; the points found are taken as such summits"),
        Source("greenwood_1984", "", "dependence of the summits found on the pitch of the grid"),
    ),
    verified="arrays of paraboloids and an egg-crate surface in closed form; maxima and curvatures by another library; Nayak's "
    "summits of Gaussian surfaces with 8 or more points per wavelength, to 7 %",
    find=eight_neighbour,
    order=2,
    of_profiles=False,
    of_summits=True,
    parameters={"fit_points": Parameter("points of the fitted paraboloid; 5: along the two axes only", 9, tuple(FITS))},
    notes="Plateaus are not counted. With 4 points in the shortest wavelength the radius is about 20 % too large, with "
    "2 points it is wrong. If a lay is oblique to the scan, two to three times too many asperities are found.",
)
