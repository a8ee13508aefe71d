"""Solve the adhesive contact of a periodic map whose faces attract each other over a given range.

Faces at a gap g >= 0 have the energy -w e^(-g/rho) per area (w: work of adhesion, rho: range), and never overlap. This is the
law of the contact-mechanics challenge (Mueser et al. 2017, Tribology Lett. 65, 118). Under the mean pressure P the gap is a
minimum of

    1/2 <u K u> - w <e^(-g/rho)> + P <g>,        u = g + h minus its mean,  K = 1/C(k),        over all g >= 0         (1)

(Pastewka & Robbins 2014, PNAS 111, 3298), with the heights h, the displacement u, the compliance C(k) at the wavevector k, and
<> the mean over the map. `descent` finds it. The gradient of (1) is the contact pressure; it vanishes where g > 0. If rho is
short compared with the deformation at the contact edge, this is the limit of Johnson, Kendall & Roberts. If rho is long, it is
the limit of Derjaguin, Muller & Toporov.

Because of the attraction, (1) has more than one minimum. The solver finds the minimum that lies downhill from its starting gap.
At the first load it starts from the contact without adhesion, and at every further load from the solution at the previous load.
Loads in descending order therefore describe a separation. Beyond the largest pull there is no contact (`detached`).

The grid must resolve the contact edge, where e^(-g/rho) pulls over a length of about E* rho^2/w. With m points along this
length, the contact edge of a sphere cannot move smoothly past the points. Its largest pull (Tabor's parameter 3; 1.0276 times
the value of Johnson, Kendall & Roberts, by an axisymmetric solution) is then too high by 5 % at m = .9, 2 % at 1.1, 1.5 % at
1.3, and .2 to .8 % at 2 to 3. If m is below 2, the map is solved on a finer grid, to which its heights are interpolated by
Fourier series, provided that this is accurate enough (m >= .8). Otherwise the result has a validity warning. The contact area
is corrected by c S d for the pixels at its edge, as in contacts without adhesion (S: length of the pixel sides at the edge, d:
side of a pixel; see `measures`), with

    c = .100 + .085/m     (m >= 1)                                                                                        (2)

c was measured on rough maps with 8 points in the shortest wave, compared with the same maps with 32: c = .11 (m = 8), .12 (4),
.14 (2), .19 (1), each +- .015 (standard deviation), for contact on 3 to 80 % of the map.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import require_positive
from stiction.records.validity_warning import ValidityWarning
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.descent import FAR, DescentSearch, Faces
from stiction.solvers.boundary_elements.limits import LEAST_POINTS, MOST_ATTRACTION_LEFT
from stiction.solvers.boundary_elements.measures import PIXEL_EXCESS, coarsest_pitch, edges, rms_step
from stiction.solvers.boundary_elements.minimise import Problem, minimise
from stiction.solvers.boundary_elements.operators import PeriodicBoundary, wavevectors
from stiction.solvers.boundary_elements.solve import usable_map
from stiction.surfaces.heightmap import size_in_metres
from stiction.surfaces.memory import require_memory

_ARRAYS = 20  # number of arrays of the size of the map that the minimisation needs
_BETWEEN = 2.5  # largest refinement of the grid relative to the map, along each side
_AT_EDGE = 0.085  # in equation (2)
# Largest unbalanced pressure where faces do not touch: divided by the largest attraction, and divided by the tension. With a
# larger pressure, faces could still touch beyond the largest pull.
_LEFT, _OF_TENSION = 0.1 * MOST_ATTRACTION_LEFT, 3e-3


@dataclass(frozen=True)
class AdhesiveContact:
    """Store the adhesive contact of a map at one load.

    load [N], > 0 if pressed together. area: contact area, corrected for pixel size [m2]. area_pixels: contact area without this
    correction [m2]. points: number of points in contact. perimeter: length of the contact edge [m]. mean_gap: mean distance of
    the faces [m], infinite if they have separated. attraction: sum of the attractive forces at all points, also at those in
    contact [N]. detached: whether there is no contact at this load; area, attraction and residual are then 0. residual: largest
    unbalanced pressure, divided by the largest attraction, at points that are out of contact or should be. points_at_edge:
    number of points across the zone at the contact edge where attraction acts on separated faces (cohesive zone).
    validity_warnings: limits of the solver that this solution exceeds. pressure: contact pressure minus attraction [Pa], (rows,
    columns) of the solved grid, which is at least as fine as the map.
    """

    load: float
    area: float
    area_pixels: float
    points: int
    perimeter: float
    mean_gap: float
    attraction: float
    detached: bool
    residual: float
    points_at_edge: float
    validity_warnings: tuple[ValidityWarning, ...]
    pressure: np.ndarray


def solve_adhesive(
    heights: np.ndarray, size: tuple[float, float], *, modulus: float, loads: Sequence[float], work: float, reach: float,
    film: Film | None = None,
) -> list[AdhesiveContact]:  # fmt: skip
    """Solve the adhesive contact of a periodic map with a flat face at a series of loads, and return one contact per load.

    heights: (rows, columns) [m]. size: (y, x) of the map [m]. modulus: contact modulus E* [Pa] of both bodies or, with a film,
    of the uncoated body alone; infinite if this body is rigid. loads [N]: solved in the order given, each starting from the
    previous solution; negative loads pull. work: work of adhesion [J/m2], > 0. reach: range of attraction [m], > 0. film:
    elastic film on one body, or None. Raises InputError for unusable arguments, and if both the substrate of the film and the
    counterbody are rigid.
    """
    loads = [float(load) for load in loads]
    if not loads or not np.isfinite(loads).all():
        raise InputError("loads", loads, "a list of finite loads, in N")
    require_memory(np.shape(heights), kept=len(loads) + _ARRAYS)
    size, heights = size_in_metres(size), usable_map(heights)
    require_positive(work=work, reach=reach)
    compliance = Compliance(modulus, film)
    if compliance.far == 0.0:
        raise InputError(
            "film.substrate_modulus", film and film.substrate_modulus, "a finite modulus, because the other body is rigid"
        )
    heights = _between_points(heights, size, reach**2 / (compliance.near * work))
    require_memory(heights.shape, kept=len(loads) + _ARRAYS)
    start = _before_adhesion(heights, size, compliance, loads[0], work, reach)
    faces, gap, grid = start.faces, start.gap, start.grid
    contacts = []
    for load in loads:
        descent = _descended(faces, gap, load / grid.nominal / grid.largest)
        gap = descent.gap
        contacts.append(_contact(faces, descent, load, grid))
    return contacts


def _descended(faces: Faces, gap: np.ndarray, pressure: float) -> DescentSearch:
    """Minimise the energy of attracting faces from a starting gap under a mean pressure, and return the finished search.

    gap: starting gap (rows, columns), divided by the range of attraction. pressure: divided by the largest attraction, < 0 if
    it pulls.
    """
    descent = DescentSearch(faces, gap, pressure)
    descent.run(min(_LEFT, -_OF_TENSION * pressure) if pressure < 0.0 else _LEFT)
    return descent


@dataclass(frozen=True)
class AdhesiveState:
    """Store the adhesive contact of a map at one load, so that it can be solved again with less adhesion.

    faces: heights and stiffness. gap: solved gap (rows, columns), divided by the range of attraction. grid: quantities that do
    not depend on load. pressure: mean pressure, divided by the largest attraction (work of adhesion divided by range).
    """

    faces: Faces
    gap: np.ndarray
    grid: "_Grid"
    pressure: float

    @property
    def touching(self) -> np.ndarray:
        """Return a mask (rows, columns) of the points in contact."""
        return self.gap <= 0.0

    @property
    def pixel(self) -> float:
        """Return the area of one grid point [m2]."""
        return self.grid.nominal / self.gap.size

    @property
    def area(self) -> float:
        """Return the contact area [m2], corrected for pixel size."""
        touching = self.touching
        return self.grid.area(int(np.count_nonzero(touching)), edges(touching, True).count) * self.pixel

    def with_share(self, share: np.ndarray | None) -> "AdhesiveState":
        """Return the contact at the same load with only a fraction of the work of adhesion.

        share: remaining fraction at every point (rows, columns); None for the full work of adhesion. The energy is minimised
        again, starting from the present gap.
        """
        faces = replace(self.faces, share=share)
        return replace(self, faces=faces, gap=_descended(faces, self.gap, self.pressure).gap)


def adhesive_state(
    heights: np.ndarray, size: tuple[float, float], *, modulus: float, load: float, work: float, reach: float,
    film: Film | None = None, finer: bool = False,
) -> AdhesiveState:  # fmt: skip
    """Solve the adhesive contact of a periodic map at one load [N], and return its state.

    heights: (rows, columns) [m]. size: (y, x) of the map [m]. modulus: contact modulus E* [Pa] of both bodies or, with a film,
    of the uncoated body alone. work: work of adhesion [J/m2]. reach: range of attraction [m]. film: elastic film on one body,
    or None. finer: whether to refine a grid that is too coarse for the contact edge. Raises InputError for unusable
    arguments.
    """
    if not math.isfinite(load):
        raise InputError("load", load, "finite, in N")
    require_memory(np.shape(heights), kept=_ARRAYS)
    size, heights = size_in_metres(size), usable_map(heights)
    require_positive(work=work, reach=reach)
    compliance = Compliance(modulus, film)
    heights = _between_points(heights, size, reach**2 / (compliance.near * work)) if finer else heights
    return _before_adhesion(heights, size, compliance, load, work, reach).with_share(None)


def _before_adhesion(heights, size, compliance, load, work, reach) -> AdhesiveState:
    """Return the starting state of an adhesive solution, whose gap is the gap of the same contact without adhesion.

    heights: (rows, columns) [m]. size: (y, x) [m]. load [N]; a pulling load starts from a light contact. work: work of adhesion
    [J/m2]. reach: range of attraction [m].
    """
    points_at_edge = reach**2 / (compliance.near * work) / coarsest_pitch(heights.shape, size)
    grid = _Grid(size, work / reach, reach, points_at_edge)
    gap = _without_adhesion(heights, size, compliance, max(load, 0.0) / grid.nominal) / reach
    return AdhesiveState(_faces(heights, size, compliance, work, reach), gap, grid, load / grid.nominal / grid.largest)


@dataclass(frozen=True)
class _Grid:
    """Store the quantities of an adhesive map that are the same at all loads.

    size: (y, x) [m]. largest: largest attraction [Pa], work of adhesion divided by range. reach: range of attraction [m].
    points: number of points across the cohesive zone at the contact edge.
    """

    size: tuple[float, float]
    largest: float
    reach: float
    points: float

    @property
    def nominal(self) -> float:
        return self.size[0] * self.size[1]

    @property
    def excess(self) -> float:
        """Return the coefficient c of equation (2) of this module, by which the contact area is corrected.

        The area counted in pixels is too large by c pixels for each pixel side at the contact edge.
        """
        return PIXEL_EXCESS + _AT_EDGE / max(self.points, 1.0)

    def area(self, points: int, sides: int) -> float:
        """Return the contact area, corrected for the pixels at its edge, in units of the pixel area.

        points: number of touching points. sides: number of pixel sides between contact and no contact.
        """
        return max(points - self.excess * sides, 0.0)

    @property
    def validity_warnings(self) -> tuple[ValidityWarning, ...]:
        if self.points >= LEAST_POINTS * (1.0 - 1e-9):
            return ()
        why = f"adhesion acts over {self.points:.2g} points at the contact edge; at least {LEAST_POINTS:g} are needed"
        return (ValidityWarning(why, "points_at_edge", self.points, self.points, low=LEAST_POINTS),)


def _between_points(heights: np.ndarray, size: tuple[float, float], edge: float) -> np.ndarray:
    """Return the heights (rows, columns) [m] on a grid fine enough for the contact edge, by Fourier interpolation.

    size: (y, x) of the map [m]. edge: width of the cohesive zone at the contact edge [m]. The map is returned unchanged if it
    is fine enough, or if it would need more than 2.5 times as many points along a side.
    """
    finer = LEAST_POINTS * coarsest_pitch(heights.shape, size) / edge
    if not 1.0 + 1e-9 < finer <= _BETWEEN:
        return heights
    rows, columns = (next_fast_len(math.ceil(finer * count), real=True) for count in heights.shape)
    waves = rfft2(heights)
    padded = np.zeros((rows, columns // 2 + 1), dtype=complex)
    up, down, across = (heights.shape[0] + 1) // 2, (heights.shape[0] - 1) // 2, (heights.shape[1] + 1) // 2
    padded[:up, :across] = waves[:up, :across]
    padded[rows - down :, :across] = waves[heights.shape[0] - down :, :across]
    return irfft2(padded, s=(rows, columns)) * (rows * columns / heights.size)


def _faces(heights, size, compliance, work, reach) -> Faces:
    waves = wavevectors(heights.shape, size)
    waves[0, 0] = 1.0
    stiffness = 0.5 * waves / compliance.times_half_k(waves) * (reach**2 / work)
    stiffness[0, 0] = 0.0
    return Faces((heights - heights.mean()) / reach, stiffness)


def _without_adhesion(heights, size, compliance, mean) -> np.ndarray:
    """Return the gap (rows, columns) [m] of the same contact without adhesion.

    heights: (rows, columns) [m]. size: (y, x) [m]. mean: mean pressure [Pa]; if it is too small to be solved, a small positive
    pressure is used instead.
    """
    length = rms_step(heights)
    least = 1e-3 * length / (size[0] / heights.shape[0]) / compliance.near
    displacement = PeriodicBoundary(compliance, heights.shape, size)
    problem = Problem(displacement, heights, max(mean, least), math.inf, length)
    return np.maximum(minimise(problem, np.full(heights.shape, problem.mean), tolerance=1e-3, most=500).gap, 0.0)


def _contact(faces: Faces, descent: DescentSearch, load: float, grid: _Grid) -> AdhesiveContact:
    """Return the AdhesiveContact of one load [N] from the finished minimisation `descent`."""
    gap, apart = descent.gap, descent.apart or (float(descent.gap.min()) > 0.5 * FAR)
    touch = gap <= 0.0
    pixel = grid.nominal / gap.size
    sides, points = edges(touch, True), int(np.count_nonzero(touch))
    validity_warnings = grid.validity_warnings
    if descent.residual > MOST_ATTRACTION_LEFT and not apart:
        why = (
            f"not converged: at points that are or should be out of contact, the unbalanced pressure is {descent.residual:.2g} "
            "of the largest attraction"
        )
        validity_warnings = (
            *validity_warnings,
            ValidityWarning(why, "not_converged", descent.residual, descent.residual, high=MOST_ATTRACTION_LEFT),
        )
    return AdhesiveContact(
        load=load,
        area=grid.area(points, sides.count) * pixel,
        area_pixels=points * pixel,
        points=points,
        perimeter=sides.perimeter(gap.shape, grid.size),
        mean_gap=math.inf if apart else float(gap.mean()) * grid.reach,
        attraction=0.0 if apart else float(np.exp(-gap).mean()) * grid.nominal * grid.largest,
        detached=apart,
        residual=0.0 if apart else descent.residual,
        points_at_edge=grid.points,
        validity_warnings=validity_warnings,
        pressure=faces.elastic(gap + faces.heights) * grid.largest + load / grid.nominal,
    )
