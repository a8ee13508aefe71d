"""Bound the error of a computed pressure on its grid, from the pressure and its gap alone.

Let s be the gap that must be added for the conditions (2) of `minimise` to hold: -g at free points (pressure between 0 and the
hardness), -min(g, 0) at points without pressure, -max(g, 0) at the hardness. The pressure p then solves the same problem
exactly for the heights h - s. Let p* be the solution for h, e = p - p*, C the compliance operator, and <> the mean over the
map. The dual problem (Boyd & Vandenberghe 2004, Convex Optimization, section 5.5) bounds the energy E. It also bounds e,
because E exceeds its minimum by at least <e C e>/2:

    E(p) - E(p*) <= 1/2 <s C^-1 s>        <e C e> <= <s C^-1 s>                                                             (1)

where the mean of s is omitted if C(0) is not defined. (1) is derived here. For a map with free edges, C^-1 is not known, and
the weaker bound

    <e C e> <= <g p> - min <g q>   over all q of the same mean and bounds                                                   (2)

is used (Frank & Wolfe 1956, Naval Res. Logist. 3, 95). Both bounds hold for any pressure that has the right mean and lies
between 0 and the hardness. They do not include the error of representing the surface by the points of the map.
"""

import math
from dataclasses import dataclass

import numpy as np

from stiction.solvers.boundary_elements.arrays import blocks, dot, factor, namespace, to_numpy
from stiction.solvers.boundary_elements.minimise import Found, Problem, missed_gap

_ROUNDED = 1.0 + 1e-6  # margin for the round-off of single precision, because the bound is an equality in full contact
_MARGIN = 3.0  # times the largest gap error; a point with a smaller margin may be in the wrong state


@dataclass(frozen=True)
class Certificate:
    """Store bounds of the error of a computed pressure, relative to the exact solution on the same grid.

    overlap: deepest overlap of the faces at points without pressure [m]. opening: largest magnitude of the gap at points in
    elastic contact, where it should be 0 [m]. lift: largest positive gap at points whose pressure is the hardness [m].
    pressure_error: bound on the relative error of the pressure in the energy norm, (<e C e>/<p C p>)^(1/2). area_error:
    estimated number of points that may wrongly count as in or out of contact, divided by the number of points in contact.
    Points count as uncertain if a change of three times the largest gap error would bring them into contact or out of it.
    """

    overlap: float
    opening: float
    lift: float
    pressure_error: float
    area_error: float


def certify(problem: Problem, found: Found) -> Certificate:
    """Return the error bounds of a computed pressure.

    problem: the minimisation problem. found: its numerical solution with pressure [Pa] and gap [m].
    """
    missed = missed_gap(problem, found.pressure, found.gap)
    pressure, gap, xp = found.pressure, found.gap, namespace(found.gap)
    flows = pressure >= problem.hardness
    free = (pressure > 0.0) & ~flows
    overlap, lift, opening = _largest(missed, pressure <= 0.0), _largest(missed, flows), _largest(missed, free)
    largest = _MARGIN * max(overlap, opening, lift)
    doubted = int(xp.count_nonzero((pressure <= 0.0) & (gap < largest)))
    doubted += int(xp.count_nonzero(free & (pressure < largest * problem.point_stiffness)))
    return Certificate(
        overlap=overlap,
        opening=opening,
        lift=lift,
        pressure_error=math.sqrt(max(_energy_left(problem, found, missed), 0.0) / _energy(problem, found)),
        area_error=float(doubted) / max(int(xp.count_nonzero(pressure)), 1),
    )


def _largest(values: np.ndarray, mask: np.ndarray) -> float:
    """Return the largest magnitude of the values inside the mask, 0 if the mask is empty."""
    xp = namespace(values)
    return float(xp.max(xp.abs(values) * factor(mask, values)))


def _energy(problem: Problem, found: Found) -> float:
    """Return the elastic energy norm <p C p> of a solution, multiplied by the number of points [Pa m].

    p: pressure, C: compliance operator, <>: mean over the map.
    """
    raised = sum(dot(found.pressure[rows], found.gap[rows] + problem.heights[rows]) for rows in blocks(found.pressure))
    return raised + found.offset * float(namespace(found.pressure).sum(found.pressure))


def _energy_left(problem: Problem, found: Found, missed: np.ndarray) -> float:
    """Return a bound on <e C e>, the energy of the pressure error e, times the number of points [Pa m].

    C: compliance operator, <>: mean over the map. missed: error of the gap at every point (rows, columns) [m]. The bound is
    (1) of this module, or the weaker (2) if the map has free edges.
    """
    if problem.displacement.inverts:
        xp = namespace(missed)
        scale = float(xp.max(xp.abs(missed))) or 1.0
        missed = xp.astype(missed / scale, xp.float32)
        return _ROUNDED * scale**2 * dot(missed, problem.displacement.inverse(missed))
    gap, mean = to_numpy(found.gap), problem.mean
    carried = sum(dot(found.gap[rows], found.pressure[rows]) for rows in blocks(found.gap))
    if math.isinf(problem.hardness):
        return carried - mean * gap.size * float(gap.min())
    full, rest = divmod(mean * gap.size, problem.hardness)
    lowest = np.sort(np.partition(gap, int(full), axis=None)[: int(full) + 1])
    return carried - problem.hardness * float(lowest[:-1].sum()) - rest * float(lowest[-1])
