"""Adhesive contact of a periodic map: faces that attract each other over a stated range.

Per area, faces a gap g >= 0 apart have the energy -w e^(-g/rho) (w: work of adhesion, rho: range; the law of the
contact-mechanics challenge, Mueser et al. 2017, Tribology Lett. 65, 118); they never overlap. Under the mean pressure P the gap
is a minimum of

    1/2 <u K u> - w <e^(-g/rho)> + P <g>,        u = g + h less its mean,  K = 1/C(k),        over all g >= 0             (1)

(Pastewka & Robbins 2014, PNAS 111, 3298; solved as Bugnicourt et al. 2018, Tribology Lett. 66, 29, by a descent between bounds,
here L-BFGS-B). Its gradient is the pressure of the contact; it vanishes where g > 0. Where rho is short against what the edge
of contact deforms, this is the limit of Johnson, Kendall & Roberts; where long, that of Derjaguin, Muller & Toporov.

The attraction makes (1) have more than one minimum: what is found is the one downhill from where it starts, at the first load
the contact without adhesion, at every further load the one before. So loads in falling order are a separation, and beyond the
largest pull there is no contact: `detached`.

The grid must see the edge: e^(-g/rho) pulls over a length of about E* rho^2/w, which has to hold two points. Counted areas are
not corrected for pixels: at an adhesive edge the gap opens otherwise than at the edges that correction is of.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft2, rfft2
from scipy.optimize import Bounds, minimize

from stiction.quantities.errors import InputError
from stiction.surfaces.boundary_elements.compliance import Compliance, Film
from stiction.surfaces.boundary_elements.doubts import MapDoubt
from stiction.surfaces.boundary_elements.limits import LEAST_POINTS, MOST_ATTRACTION_LEFT
from stiction.surfaces.boundary_elements.measures import edges, rms_step
from stiction.surfaces.boundary_elements.memory import require_memory
from stiction.surfaces.boundary_elements.minimise import Problem, minimise
from stiction.surfaces.boundary_elements.operators import PeriodicBoundary, wavevectors
from stiction.surfaces.boundary_elements.solve import usable_map
from stiction.surfaces.heightmap import size_in_metres

__all__ = ["AdhesiveContact", "solve_adhesive"]

_FAR = 1e3  # mean gap over range and height of the map, at which faces are apart
_MOST = 5000
_ARRAYS = 20  # as large as the map, of the descent


@dataclass(frozen=True)
class AdhesiveContact:
    """One load. load [N], > 0 pressing; area: of points that touch, counted in pixels [m2]; perimeter: of them [m]; mean_gap
    [m]; attraction: of all points, also those that touch [N]; detached: no contact at this load, and then area 0; residual:
    largest pressure left where faces do not touch, over w/rho; pressure: of contact less attraction, (rows, columns) [Pa]."""

    load: float
    area: float
    perimeter: float
    mean_gap: float
    attraction: float
    detached: bool
    residual: float
    doubts: tuple[MapDoubt, ...]
    pressure: np.ndarray


@dataclass(frozen=True)
class _Faces:
    """What (1) needs, lengths over rho and energies over w. stiffness: K rho^2/w of every wave."""

    heights: np.ndarray
    stiffness: np.ndarray

    def elastic(self, gap: np.ndarray) -> np.ndarray:
        """K u."""
        waves = rfft2(gap + self.heights)
        waves *= self.stiffness
        return irfft2(waves, s=self.heights.shape, overwrite_x=True)

    def energy(self, flat: np.ndarray, pressure: float) -> tuple[float, np.ndarray]:
        """(1) times the number of points, and its gradient."""
        gap = flat.reshape(self.heights.shape)
        force, near = self.elastic(gap), np.exp(-gap)
        total = 0.5 * float(np.sum(force * (gap + self.heights))) - float(near.sum()) + pressure * float(gap.sum())
        return total, (force + near + pressure).ravel()


def solve_adhesive(
    heights: np.ndarray, size: tuple[float, float], *, modulus: float, loads: Sequence[float], work: float, reach: float,
    film: Film | None = None,
) -> list[AdhesiveContact]:  # fmt: skip
    """Contact of a periodic map with a flat face at loads [N] in the order given, negative: pulled; each from the one before.

    heights, size, modulus, film: as in `solve_map`; work: of adhesion [J/m2], > 0; reach: rho [m], > 0. InputError for what
    cannot be used, also for a film on a rigid base under a rigid face, where mean displacements count.
    """
    loads = [float(load) for load in loads]
    if not loads or not np.isfinite(loads).all():
        raise InputError("loads", loads, "a list of finite loads, in N")
    require_memory(np.shape(heights), kept=len(loads) + _ARRAYS)
    size, heights = size_in_metres(size), usable_map(heights)
    for name, value in (("work", work), ("reach", reach)):
        if not (0.0 < value < math.inf):
            raise InputError(name, value, "> 0, finite")
    compliance = Compliance(modulus, film)
    if compliance.far == 0.0:
        raise InputError("film.substrate_modulus", film and film.substrate_modulus, "finite, where the other body is rigid")
    faces = _faces(heights, size, compliance, work, reach)
    nominal = size[0] * size[1]
    gap = _without_adhesion(heights, size, compliance, max(loads[0], 0.0) / nominal, work) / reach
    of_grid = tuple(_doubts_of_edge(heights.shape, size, compliance, work, reach))
    found = []
    for load in loads:
        gap, residual = _descent(faces, gap, load / nominal * reach / work)
        found.append(_contact(faces, gap, residual, load, work / reach, reach, size, of_grid))
    return found


def _faces(heights, size, compliance, work, reach) -> _Faces:
    waves = wavevectors(heights.shape, size)
    waves[0, 0] = 1.0
    stiffness = 0.5 * waves / compliance.times_half_k(waves) * (reach**2 / work)
    stiffness[0, 0] = 0.0
    return _Faces((heights - heights.mean()) / reach, stiffness)


def _without_adhesion(heights, size, compliance, mean, work) -> np.ndarray:
    """Gap [m] of the contact without adhesion, pressed at least lightly."""
    length = rms_step(heights)
    least = 1e-3 * length / (size[0] / heights.shape[0]) / compliance.near
    displacement = PeriodicBoundary(compliance, heights.shape, size)
    problem = Problem(displacement, heights, max(mean, least), math.inf, length)
    return np.maximum(minimise(problem, np.full(heights.shape, problem.mean), tolerance=1e-3, most=500).gap, 0.0)


def _descent(faces: _Faces, gap: np.ndarray, pressure: float) -> tuple[np.ndarray, float]:
    """The minimum downhill of the gap, both over rho, and its residual."""
    most = _FAR * (1.0 + float(np.ptp(faces.heights)))
    found = minimize(
        faces.energy, gap.ravel(), args=(pressure,), jac=True, method="L-BFGS-B", bounds=Bounds(0.0, most),
        options={"maxiter": _MOST, "maxfun": 2 * _MOST, "gtol": 0.1 * MOST_ATTRACTION_LEFT, "ftol": 0.0, "maxcor": 8},
    )  # fmt: skip
    gap = found.x.reshape(gap.shape)
    slope = faces.energy(found.x, pressure)[1].reshape(gap.shape)
    left = np.where(gap > 0.0, np.abs(slope), np.maximum(-slope, 0.0))
    return gap, float(left.max())


def _contact(faces, gap, residual, load, largest, reach, size, of_grid) -> AdhesiveContact:
    """The numbers of one load; largest: attraction, w/rho [Pa]."""
    touch = gap <= 0.0
    apart = not touch.any() and float(gap.mean()) > 0.5 * _FAR
    nominal = size[0] * size[1]
    pixel, pitch = nominal / gap.size, (size[0] / gap.shape[0], size[1] / gap.shape[1])
    sides = edges(touch, True)
    doubts = of_grid
    if residual > MOST_ATTRACTION_LEFT and not apart:
        why = f"not converged: pressure of {residual:.2g} of the largest attraction is left where faces do not touch"
        doubts = (*of_grid, MapDoubt("not_converged", residual, MOST_ATTRACTION_LEFT, why))
    return AdhesiveContact(
        load=load,
        area=int(np.count_nonzero(touch)) * pixel,
        perimeter=0.25 * math.pi * (sides.along_y * pitch[0] + sides.along_x * pitch[1]),
        mean_gap=math.inf if apart else float(gap.mean()) * reach,
        attraction=0.0 if apart else float(np.exp(-gap).mean()) * nominal * largest,
        detached=apart,
        residual=0.0 if apart else residual,
        doubts=doubts,
        pressure=faces.elastic(gap) * largest + load / nominal,
    )


def _doubts_of_edge(shape, size, compliance, work, reach):
    pitch = max(length / count for length, count in zip(size, shape, strict=True))
    points = reach**2 / (compliance.near * work) / pitch
    if points < LEAST_POINTS:
        why = f"the edge of contact is pulled over {points:.2g} points, at least {LEAST_POINTS:g} are needed"
        yield MapDoubt("points_at_edge", points, LEAST_POINTS, why)
