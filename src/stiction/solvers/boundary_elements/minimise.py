"""Compute the contact pressure of a map under a given load, by minimising elastic energy.

Let h be the heights, p the pressure and u = C p its displacement, with C the compliance operator. Among all pressures of the
given mean with 0 <= p <= H, the solution minimises

    1/2 <p u> - <p h>                                                                                                      (1)

This is frictionless contact (Kalker & van Randen 1972; Polonsky & Keer 1999, Wear 231, 206) of bodies that are elastic below
H and flow at p = H, the hardness (Almqvist, Sahlin, Larsson & Glavatskih 2007, Tribology Int. 40, 574). The unique minimum
satisfies the Karush-Kuhn-Tucker conditions with an offset a and the gap g = u - h - a:

    p = 0: g >= 0        0 < p < H: g = 0        p = H: g <= 0, the depth of plastic flow                                 (2)

`residual` measures how far a solution violates (2). Maps are arrays of NumPy or of another library of `arrays`.

The method of Polonsky & Keer is used: conjugate gradients over the points with 0 < p < H. Five changes make it converge also
where points flow, in a number of steps that hardly grows with the map size.

- The gradient is divided by C(k) on these points and shifted to zero sum. In full contact one such step reaches the solution.
- The mean pressure is restored by a shift of the pressure at these points. Multiplication by a factor could exceed H.
- Polak & Ribiere's rule combines directions, also when contact changes (Bugnicourt et al. 2018, Tribology Lett. 66, 29).
- The energy must fall in each step. If not, a projected gradient step is taken, and shortened until the energy falls (Bertsekas
  1999, Nonlinear Programming, section 2.3; it converges from any start).
- Steps are in single precision. From time to time the gap is recomputed in double precision (iterative refinement: Moler 1967,
  J. ACM 14, 316). The reported `residual` is computed in double precision too.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from stiction.engine.stopping import raise_if_stopped
from stiction.solvers.boundary_elements.arrays import blocks, clip_into, dot, factor, namespace


class Boundary(Protocol):
    """Define the compliance operator of a map, which computes displacements from pressures.

    Results have the argument's precision. inverts: whether `inverse` is exact. has_mean: whether mean displacement is defined.
    """

    inverts: bool
    has_mean: bool

    def __call__(self, pressure: np.ndarray, /) -> np.ndarray:
        """Return the displacement map (rows, columns) [m] caused by a pressure map [Pa]."""

    def inverse(self, displacement: np.ndarray, /) -> np.ndarray:
        """Return a pressure map (rows, columns) [Pa] that causes this displacement map [m], exactly or approximately."""


_ENOUGH = 1e-4  # least decrease of the energy by a projected step, relative to the decrease that the gradient predicts
_SHIFTS = 100
_ROUNDING = 1e-13  # accepted error of the mean pressure, relative
_WRONG = 0.05  # fraction of the pressure that would close a wrong gap; with more, points alternately enter and leave
_DIGITS = 1e-4  # smallest residual that single precision can reach, relative to the last residual in double precision
_AIM = 0.7  # tolerance of the residual in single precision, relative to the full tolerance


@dataclass(frozen=True)
class Problem:
    """Describe the contact of a map under a mean pressure, as a minimisation problem for the pressure.

    displacement: compliance operator, from pressure [Pa] to displacement [m]. heights: (rows, columns) [m]. mean: mean pressure
    [Pa]. hardness: largest pressure [Pa]; infinite for elastic bodies. length: the residual divides gaps by it [m].
    """

    displacement: Boundary
    heights: np.ndarray
    mean: float
    hardness: float
    length: float

    @cached_property
    def point_stiffness(self) -> float:
        """Return the stiffness of a point [Pa/m]: its pressure per displacement while all other points stay in place."""
        xp = namespace(self.heights)
        point = xp.zeros_like(self.heights, dtype=xp.float32)
        point[0, 0] = 1.0
        return float(self.displacement.inverse(point)[0, 0])


@dataclass(frozen=True)
class Found:
    """Store the numerical solution of the contact of a map under a mean pressure.

    pressure [Pa] and gap [m]: (rows, columns). offset: rigid displacement of the face [m]. residual: root of the quotient of
    the summed squared gap errors and the number of points in contact, divided by the problem's length. steps: number of steps
    taken. converged: whether the residual is at most the tolerance.
    """

    pressure: np.ndarray
    gap: np.ndarray
    offset: float
    residual: float
    steps: int = 0
    converged: bool = False


def minimise(
    problem: Problem, start: np.ndarray, *, tolerance: float, most: int, seen: Callable[[int, float], None] | None = None
) -> Found:
    """Compute the pressure of a map under a mean pressure, by minimising elastic energy.

    start: first guess of the pressure (rows, columns) [Pa]. tolerance: largest accepted residual. most: largest number of
    steps. seen: called before each step with its number and the residual. Without convergence, the solution with the smallest
    residual is returned.
    """
    best = last = _in_double(problem, on_level(namespace(start).clip(start, 0.0, problem.hardness), problem))
    search = _Search(problem, seen)
    while best.residual > tolerance and search.steps < most:
        before = search.steps
        pressure = search.run(last, max(_AIM * tolerance, _DIGITS * last.residual), most)
        if search.steps == before:
            break  # round-off prevents any step that lowers the energy
        last = _in_double(problem, on_level(pressure, problem))
        if last.residual < best.residual:
            best = last
    return replace(best, steps=search.steps, converged=best.residual <= tolerance)


def _in_double(problem: Problem, pressure: np.ndarray) -> Found:
    """Return pressure, gap, offset and residual of a pressure map [Pa], computed in double precision."""
    gap = problem.displacement(pressure)
    gap -= problem.heights
    offset, residual, _ = _settle(problem, pressure, gap, problem.length)
    return Found(pressure, gap, offset, residual)


def _settle(problem: Problem, pressure: np.ndarray, gap: np.ndarray, length: float) -> tuple[float, float, bool]:
    """Subtract the offset from the gap, in place; return offset, residual and a flag.

    pressure, gap: (rows, columns). length: length by which the residual is divided, in the unit of `gap`. The offset is the
    mean gap over points whose pressure is between 0 and the hardness. If there are none, it lies midway between touching and
    open points. The residual is the root of the summed squared violations of the contact conditions per point in contact,
    divided by `length`. The flag is True if a gap is negative without pressure, or positive at the hardness.
    """
    xp = namespace(gap)
    total, count, pressed = 0.0, 0, 0
    for rows in blocks(gap):
        touches = pressure[rows] > 0.0
        free = touches & (pressure[rows] < problem.hardness)
        total += dot(gap[rows], xp.astype(free, gap.dtype))
        count += int(xp.count_nonzero(free))
        pressed += int(xp.count_nonzero(touches))
    offset = total / count if count else _between(pressure > 0.0, gap)
    missed = wrong = 0.0
    for rows in blocks(gap):
        here = gap[rows]
        here -= offset
        at_bounds = _wrong(problem, pressure[rows], here)
        wrong += dot(at_bounds, at_bounds)
        here = here * _free(problem, pressure[rows], here)
        missed += dot(here, here)
    return offset, math.sqrt((missed + wrong) / max(pressed, 1)) / length, wrong > 0.0


def _between(touches: np.ndarray, gap: np.ndarray) -> float:
    """Return the midpoint between the largest gap of touching points (mask `touches`) and the smallest gap of open points.

    If no point is open, return the largest gap of touching points.
    """
    xp = namespace(gap)
    apart = xp.full_like(gap, math.inf)
    highest, lowest = float(xp.max(xp.where(touches, gap, -apart))), float(xp.min(xp.where(touches, apart, gap)))
    return 0.5 * (highest + lowest) if math.isfinite(lowest) else highest


def _wrong(problem: Problem, pressure: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Return the gap (rows, columns) where its sign is forbidden, and 0 elsewhere.

    A negative gap is forbidden at points without pressure, and a positive gap where the pressure is the hardness.
    """
    xp = namespace(gap)
    wrong = xp.clip(gap, None, 0.0)
    wrong *= factor(pressure <= 0.0, gap)
    if math.isfinite(problem.hardness):
        wrong += xp.clip(gap, 0.0, None) * factor(pressure >= problem.hardness, gap)
    return wrong


def _free(problem: Problem, pressure: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Return a mask of the points with a pressure between 0 and the hardness, as a factor for `gap` (see `factor`)."""
    return factor((pressure > 0.0) & (pressure < problem.hardness), gap)


def missed_gap(problem: Problem, pressure: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Return the violation of the contact conditions by the gap at every point, (rows, columns) [m].

    The gap must be 0 in elastic contact, >= 0 at points without pressure, and <= 0 at points whose pressure is the hardness.
    """
    missed = _wrong(problem, pressure, gap)
    missed += gap * _free(problem, pressure, gap)
    return missed


class _Search:
    """Lower the energy of a problem step by step, in single precision; gaps are divided by the problem's length."""

    def __init__(self, problem: Problem, seen: Callable[[int, float], None] | None):
        self.steps = 0
        self._problem, self._seen = problem, seen

    def run(self, start: Found, aim: float, most: int) -> np.ndarray:
        """Take steps from the solution `start` and return the pressure (rows, columns) [Pa] reached.

        Steps end when the residual is at most `aim`, when `steps` reaches `most`, or when no step lowers the energy.
        """
        xp = namespace(start.gap)
        self._pressure = xp.asarray(start.pressure, copy=True)
        self._gap = xp.astype(start.gap, xp.float32)
        self._gap *= 1.0 / self._problem.length
        self._other = xp.empty_like(self._pressure)
        self._direction, self._gradient, self._spare, self._change = (xp.zeros_like(self._gap) for _ in range(4))
        self._restart()
        self._settle()
        while True:
            raise_if_stopped()
            if self._seen is not None:
                self._seen(self.steps, self._residual)
            if self._residual <= aim or self.steps >= most:
                break
            if not self._conjugate_step():
                self._restart()
                if not self._projected_step():
                    break
            self.steps += 1
        return self._pressure

    def _restart(self) -> None:
        """Discard the last search direction, so that the next one is the gradient alone."""
        self._square = math.inf

    def _settle(self) -> None:
        _, self._residual, self._any_wrong = _settle(self._problem, self._pressure, self._gap, 1.0)

    def _conjugate_step(self) -> bool:
        """Take a conjugate gradient step and return True; return False, without a step, if it would not lower the energy."""
        slope = self._turn()
        if not slope < 0.0:
            return False
        response = self._respond(self._direction)
        bent = sum(dot(self._direction[rows], response[rows]) for rows in blocks(response))
        if not bent > 0.0:
            return False
        length = -slope / bent
        pressure, inside = self._along(length)
        if inside and not self._any_wrong:
            self._arrive(pressure, response, length)
            return True
        return self._accept(on_level(pressure, self._problem))

    def _along(self, length: float) -> tuple[np.ndarray, bool]:
        """Return the clipped pressure after a step along the search direction, and whether nothing had to be clipped.

        length: factor of the direction. Where the gap has a sign that the pressure forbids, the pressure is also changed in
        proportion to the gap, so that the gap closes.
        """
        problem, pressure, inside, xp = self._problem, self._other, True, namespace(self._other)
        mend = _WRONG * problem.point_stiffness * problem.length
        for rows in blocks(pressure):
            here = self._pressure[rows] + length * self._direction[rows]
            if self._any_wrong:
                here -= mend * _wrong(problem, self._pressure[rows], self._gap[rows])
            inside = inside and bool(xp.min(here) >= 0.0) and bool(xp.max(here) <= problem.hardness)
            clip_into(pressure[rows], here, 0.0, problem.hardness)
        return pressure, inside

    def _accept(self, pressure: np.ndarray, least: float = 0.0) -> bool:
        """Adopt the pressure map `pressure` [Pa] if it lowers the energy enough; return whether it did.

        least: smallest accepted decrease of the energy, divided by the squared change of pressure.
        """
        change, xp = self._change, namespace(self._change)
        for rows in blocks(change):
            change[rows] = xp.astype(pressure[rows] - self._pressure[rows], xp.float32)
        response = self._respond(change)
        energy = square = 0.0
        for rows in blocks(change):
            energy += dot(change[rows], self._gap[rows]) + 0.5 * dot(change[rows], response[rows])
            square += dot(change[rows], change[rows]) if least else 0.0
        falls = energy < 0.0 and energy <= -least * square
        if falls:
            self._arrive(pressure, response)
        return falls

    def _arrive(self, pressure: np.ndarray, response: np.ndarray, part: float | None = None) -> None:
        """Adopt the pressure map `pressure` [Pa] and update the gap.

        response: displacement that changes the gap, divided by the problem's length. part: factor of the response; None for 1.
        """
        self._pressure, self._other = pressure, self._pressure
        for rows in blocks(response):
            self._gap[rows] += response[rows] if part is None else part * response[rows]
        self._settle()

    def _respond(self, change: np.ndarray) -> np.ndarray:
        """Return the displacement due to a change of pressure [Pa], divided by the problem's length."""
        response = self._problem.displacement(change)
        response *= 1.0 / self._problem.length
        return response

    def _turn(self) -> float:
        """Compute the next search direction by conjugate gradients; return the energy's slope in this direction.

        The direction has zero sum over the points with a pressure between 0 and the hardness, and is zero elsewhere. The last
        direction is weighted by the rule of Polak & Ribiere, with a weight of at least 0.
        """
        gradient, before, last, xp = self._spare, self._gradient, self._direction, namespace(self._gap)
        for rows in blocks(gradient):
            gradient[rows] = self._gap[rows] * self._free(rows)
        downhill = self._problem.displacement.inverse(gradient)
        sums = np.zeros(6)
        for rows in blocks(gradient):
            free, down = self._free(rows), downhill[rows]
            down *= free
            sums += (
                float(xp.sum(free)), float(xp.sum(down)), dot(down, gradient[rows]), dot(down, before[rows]),
                dot(free, before[rows]), dot(free, last[rows]),
            )  # fmt: skip
        count, total, square, mixed, before_total, last_total = sums.tolist()
        if not count:
            return 0.0
        mean = total / count
        part = max(0.0, square - mixed + mean * before_total) / self._square
        shift = mean - part * last_total / count
        slope = 0.0
        for rows in blocks(gradient):
            here = last[rows]
            here *= part
            here += shift
            here *= self._free(rows)
            here -= downhill[rows]
            slope += dot(here, gradient[rows])
        self._gradient, self._spare, self._square = gradient, before, square
        return slope

    def _free(self, rows: tuple[slice, slice]) -> np.ndarray:
        """Return a mask of the points in these rows with a pressure between 0 and the hardness, as ones and zeros."""
        here, xp = self._pressure[rows], namespace(self._pressure)
        return xp.astype((here > 0.0) & (here < self._problem.hardness), xp.float32)

    def _projected_step(self) -> bool:
        """Take a projected gradient step, halved until the energy falls enough; return whether it fell."""
        length = self._problem.point_stiffness * self._problem.length
        for _ in range(60):
            if self._accept(_nearest(self._pressure - length * self._gap, self._problem), _ENOUGH / length):
                return True
            length *= 0.5
        return False


def on_level(pressure: np.ndarray, problem: Problem) -> np.ndarray:
    """Return the pressure map, shifted to the mean pressure of the problem and clipped between 0 and the hardness.

    Only points with a pressure between 0 and the hardness are shifted, in place. If this does not reach the mean, all points
    are shifted, in a new array.
    """
    top, wanted, xp = problem.hardness, problem.mean * math.prod(pressure.shape), namespace(pressure)
    pressed = pressure > 0.0
    values = pressure[pressed]
    for _ in range(_SHIFTS):
        missing = wanted - float(xp.sum(values))
        if abs(missing) <= _ROUNDING * wanted:
            pressure[pressed] = values
            return pressure
        free = (values > 0.0) & (values < top)
        count = int(xp.count_nonzero(free))
        if not count:
            break
        values += (missing / count) * factor(free, values)
        values = xp.clip(values, 0.0, top)
    return _nearest(pressure, problem)


def _nearest(pressure: np.ndarray, problem: Problem) -> np.ndarray:
    """Return the pressure map nearest to `pressure` (least squares) with the mean and the bounds of the problem.

    All points are shifted equally and clipped between 0 and the hardness. The shift is found by Newton's method, safeguarded by
    bisection.
    """
    top, wanted, xp = problem.hardness, problem.mean, namespace(pressure)
    low = -float(xp.max(pressure))
    high = (top if math.isfinite(top) else wanted * math.prod(pressure.shape)) - float(xp.min(pressure))
    shift = min(max(0.0, low), high)
    for _ in range(_SHIFTS):
        cut = xp.clip(pressure + shift, 0.0, top)
        missing = wanted - float(xp.mean(cut))
        if abs(missing) <= _ROUNDING * wanted:
            break
        low, high = (shift, high) if missing > 0.0 else (low, shift)
        slope = float(xp.count_nonzero((cut > 0.0) & (cut < top))) / math.prod(cut.shape)
        shift = shift + missing / slope if slope > 0.0 else low
        if not low < shift < high:
            shift = 0.5 * (low + high)
    return cut
