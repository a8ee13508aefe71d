"""Generate the validity warnings of a solved map, for example that the shortest wave has too few points."""

import math

import numpy as np

from stiction.quantities.shown import show
from stiction.records.validity_warning import ValidityWarning
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


def warnings_of_map(
    heights: np.ndarray, size: tuple[float, float], film: Film | None, periodic: bool
) -> tuple[ValidityWarning, ...]:
    """Return the validity warnings of a map that hold at any load.

    heights: (rows, columns) [m]; size: (y, x) [m]. film: film on one of the bodies, or None. periodic: whether the map is one
    period of an endless surface.
    """
    seen = waves(heights, size, periodic)
    return (*_warnings_of_waves(seen), *(() if film is None else _warnings_of_film(film, seen.pitch)))


def _warnings_of_waves(seen):
    points, periods = seen.points_in_shortest_wave, seen.longest_waves_on_a_side
    if points < LEAST_PIXELS:
        length = show(seen.shortest, "scan_size")
        why = f"the shortest waves ({length}) have {points:.2g} points, but an accurate area needs {LEAST_PIXELS:g}"
        yield ValidityWarning(why, "points_in_shortest_wave", points, points, low=LEAST_PIXELS)
    if periods < LEAST_WAVES:
        length = show(seen.longest, "scan_size")
        why = f"a side holds {periods:.2g} of the longest waves ({length}), but a sample needs at least {LEAST_WAVES:g}"
        yield ValidityWarning(why, "longest_waves_on_a_side", periods, periods, low=LEAST_WAVES)
    if seen.gradient > STEEPEST:
        why = f"the rms gradient is {seen.gradient:.2g}, but the solver assumes slopes up to about {STEEPEST:g}"
        yield ValidityWarning(why, "rms_gradient", seen.gradient, seen.gradient, high=STEEPEST)


def _warnings_of_film(film, pitch):
    if film.thickness < pitch:
        thickness, width = show(film.thickness, "thickness"), show(pitch, "scan_size")
        why = f"the film ({thickness}) is thinner than the point spacing ({width}): the contact area may be inaccurate"
        yield ValidityWarning(why, "film_thickness", film.thickness, film.thickness, low=pitch)


def warnings_of_load(solution: Found, load_error: float, ends: bool, tolerance: float) -> tuple[ValidityWarning, ...]:
    """Return the validity warnings of the solution at one load.

    load_error: relative error of the summed pressures. ends: whether the map has free edges, with no pressure outside.
    tolerance: largest accepted residual.
    """
    return (*_warnings_of_solution(solution, load_error, tolerance), *(_warnings_of_ends(solution.pressure) if ends else ()))


def _warnings_of_solution(solution, load_error, tolerance):
    if not solution.converged:
        why = f"not converged: residual {solution.residual:.2g} after {solution.steps} steps, tolerance {tolerance:g}"
        yield ValidityWarning(why, "not_converged", solution.residual, solution.residual, high=tolerance)
    if not load_error <= LEAST_LOAD_ERROR:
        why = f"the computed pressures do not add up to the load; the relative error is {load_error:.2g}"
        yield ValidityWarning(why, "load_error", load_error, load_error, high=LEAST_LOAD_ERROR)
    points = int(np.count_nonzero(solution.pressure))
    if points < LEAST_CONTACT:
        why = f"{points} points of the map are in contact, but an accurate area needs at least {LEAST_CONTACT}"
        yield ValidityWarning(why, "points_in_contact", float(points), float(points), low=float(LEAST_CONTACT))


def share_at_ends(pressure: np.ndarray) -> float:
    """Return the fraction of the load on the outermost points of a pressure map (rows, columns); 0 without load."""
    total = float(pressure.sum())
    if total <= 0.0:
        return 0.0  # the load is below the smallest floating-point number
    if min(pressure.shape) <= 2:
        return 1.0
    # The sides are summed, because total minus inner sum could be negative by round-off.
    ends = (pressure[0], pressure[-1], pressure[1:-1, 0], pressure[1:-1, -1])
    return math.fsum(float(side.sum()) for side in ends) / total


def _warnings_of_ends(pressure):
    share = share_at_ends(pressure)
    if share > MOST_AT_ENDS:
        why = f"the outermost points of the map carry {100.0 * share:.2g} % of the load, so the contact reaches beyond the map"
        yield ValidityWarning(why, "load_at_ends", share, share, high=MOST_AT_ENDS)
