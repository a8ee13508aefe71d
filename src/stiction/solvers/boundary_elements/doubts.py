"""What makes a solved map doubtful, as data: few points in the shortest wave, few of the longest waves, and the like."""

import math
from dataclasses import dataclass

import numpy as np

from stiction.quantities.units import show
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.limits import (
    LEAST_CONTACT,
    LEAST_LOAD_ERROR,
    LEAST_PIXELS,
    LEAST_WAVES,
    MOST_AT_ENDS,
    STEEPEST,
)
from stiction.solvers.boundary_elements.measures import waves
from stiction.solvers.boundary_elements.minimise import Found


@dataclass(frozen=True)
class MapDoubt:
    """Reason why the solution of a map may not hold.

    name: for programs; value, limit: in SI; why: sentence for users.
    """

    name: str
    value: float
    limit: float
    why: str

    def __str__(self) -> str:
        return self.why


def doubts_of_map(heights: np.ndarray, size: tuple[float, float], film: Film | None, periodic: bool) -> tuple[MapDoubt, ...]:
    """Return the warnings that hold for a map at any load.

    heights: (rows, columns) [m]; size: (y, x) [m].
    """
    pitch = max(length / count for length, count in zip(size, heights.shape, strict=True) if count > 1)
    side = min(length for length, count in zip(size, heights.shape, strict=True) if count > 1)
    seen = waves(heights, size, periodic)
    return (*_doubts_of_waves(seen, pitch, side), *(() if film is None else _doubts_of_film(film, pitch)))


def _doubts_of_waves(seen, pitch, side):
    points, periods = seen.shortest / pitch, side / seen.longest
    if points < LEAST_PIXELS:
        length = show(seen.shortest, "scan_size")
        why = f"the shortest waves ({length}) have {points:.2g} points, at least {LEAST_PIXELS:g} make the area converge"
        yield MapDoubt("points_in_shortest_wave", points, LEAST_PIXELS, why)
    if periods < LEAST_WAVES:
        length = show(seen.longest, "scan_size")
        why = f"a side holds {periods:.2g} of the longest waves ({length}), with fewer than {LEAST_WAVES:g} it is no sample"
        yield MapDoubt("longest_waves_on_a_side", periods, LEAST_WAVES, why)
    if seen.gradient > STEEPEST:
        why = f"the rms gradient is {seen.gradient:.2g}; small slopes are assumed, up to about {STEEPEST:g}"
        yield MapDoubt("rms_gradient", seen.gradient, STEEPEST, why)


def _doubts_of_film(film, pitch):
    if film.thickness < pitch:
        thickness, width = show(film.thickness, "thickness"), show(pitch, "scan_size")
        why = f"the film ({thickness}) is thinner than a point of the map is wide ({width})"
        yield MapDoubt("film_thickness", film.thickness, pitch, why)


def doubts_of_load(solution: Found, load_error: float, ends: bool, tolerance: float) -> tuple[MapDoubt, ...]:
    """Return the warnings about one solution; ends: nothing presses outside the map."""
    return (*_doubts_of_solution(solution, load_error, tolerance), *(_doubts_of_ends(solution.pressure) if ends else ()))


def _doubts_of_solution(solution, load_error, tolerance):
    if not solution.converged:
        why = f"not converged: residual {solution.residual:.2g} after {solution.steps} steps, {tolerance:g} asked for"
        yield MapDoubt("not_converged", solution.residual, tolerance, why)
    if not load_error <= LEAST_LOAD_ERROR:
        yield MapDoubt(
            "load_error", load_error, LEAST_LOAD_ERROR, f"the pressures carry the load but for {load_error:.2g} of it"
        )
    points = int(np.count_nonzero(solution.pressure))
    if points < LEAST_CONTACT:
        why = f"{points} points of the map are in contact, fewer than {LEAST_CONTACT} give a rough area only"
        yield MapDoubt("points_in_contact", float(points), float(LEAST_CONTACT), why)


def share_at_ends(pressure: np.ndarray) -> float:
    """Return the share of the load on the outermost points of a (rows, columns) map."""
    total = float(pressure.sum())
    if total <= 0.0:
        return 0.0  # of a load below the smallest number: nothing
    if min(pressure.shape) <= 2:
        return 1.0
    ends = (pressure[0], pressure[-1], pressure[1:-1, 0], pressure[1:-1, -1])  # never below 0, as a difference would be
    return math.fsum(float(side.sum()) for side in ends) / total


def _doubts_of_ends(pressure):
    share = share_at_ends(pressure)
    if share > MOST_AT_ENDS:
        why = f"the outermost points of the map carry {100.0 * share:.2g} % of the load: the map ends within the contact"
        yield MapDoubt("load_at_ends", share, MOST_AT_ENDS, why)
