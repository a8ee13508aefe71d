"""The pressure under a given load: the minimum of a convex energy between bounds.

With u = C p the displacement of the pressure p and h the heights, among all p of the given mean with 0 <= p <= H

    minimise  1/2 <p u> - <p h>                                                                                            (1)

which is a contact without friction (Kalker & van Randen 1972; Polonsky & Keer 1999, Wear 231, 206) of bodies that are elastic
until the pressure is H, and then flow under it (Almqvist, Sahlin, Larsson & Glavatskih 2007, Tribology Int. 40, 574). C has
only positive eigenvalues, the bounds are convex: there is one minimum, known by its conditions (Karush, Kuhn & Tucker), with
one length a, and the gap g = u - h - a:

    p = 0: g >= 0        0 < p < H: g = 0        p = H: g <= 0, the depth to which the point has flowed                   (2)

so how it was found needs no belief: `residual` says how far (2) is from being met.

The way there is that of Polonsky & Keer, conjugate gradients over the points of 0 < p < H, with three changes, all to converge
also where points flow: the pressure is brought back to its mean by a shift of the pressed points instead of a factor, which
would lift it over H; directions are combined by the rule of Polak & Ribiere and go on where points come and go, instead of
beginning anew (as Bugnicourt et al. 2018, Tribology Lett. 66, 29); and the energy must fall in each step. Where it does not,
the step is one along the gradient, projected, and shortened until it does (Bertsekas 1999, Nonlinear Programming, section 2.3:
converges from anywhere). Equation numbers of Polonsky & Keer could not be compared with print.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Displacement = Callable[[np.ndarray], np.ndarray]

_ENOUGH = 1e-4  # share of the decrease along the gradient that a projected step must bring
_SHIFTS = 100
_ROUNDING = 1e-13  # of the mean pressure


@dataclass(frozen=True)
class Problem:
    """Quadratic problem (1).

    displacement: C, from pressure [Pa] to displacement [m]; heights [m]; mean: pressure [Pa]; hardness: H [Pa], infinite:
    elastic; length: [m], unit of gaps.
    """

    displacement: Displacement
    heights: np.ndarray
    mean: float
    hardness: float
    length: float


@dataclass(frozen=True)
class Found:
    """Solution of (1).

    pressure [Pa], gap [m] as in (2), with a = `offset` [m]; residual: rms violation of (2) over the length, per point in
    contact; steps: number taken; converged: whether the residual is below the tolerance.
    """

    pressure: np.ndarray
    gap: np.ndarray
    offset: float
    residual: float
    steps: int
    converged: bool


class _State:
    """Pressure, its displacement and the gap (2); the arrays belong to the state."""

    def __init__(self, problem: Problem, pressure: np.ndarray, displacement: np.ndarray):
        self.pressure, self.displacement = pressure, displacement
        self.free = (pressure > 0.0) & (pressure < problem.hardness)
        self.count = int(np.count_nonzero(self.free))
        self.gap = displacement - problem.heights
        self.offset = self._offset(problem)
        self.gap -= self.offset
        self.wrong = (pressure <= 0.0) & (self.gap < 0.0)
        if math.isfinite(problem.hardness):
            self.wrong |= (pressure >= problem.hardness) & (self.gap > 0.0)
        missed = np.sum(np.square(self.gap), where=self.free | self.wrong)
        pressed = max(int(np.count_nonzero(pressure > 0.0)), 1)
        self.residual = math.sqrt(float(missed) / pressed) / problem.length

    def _offset(self, problem: Problem) -> float:
        """Return a of (2), the mean over the free points.

        Where no point is free, it lies midway between the flowing and the untouched points.
        """
        if self.count:
            return float(np.mean(self.gap, where=self.free))
        touched = self.pressure > 0.0
        highest = float(np.max(self.gap, where=touched, initial=-math.inf))
        lowest = float(np.min(self.gap, where=~touched, initial=math.inf))
        return 0.5 * (highest + lowest) if math.isfinite(lowest) else highest


def minimise(
    problem: Problem, start: np.ndarray, *, tolerance: float, most: int, seen: Callable[[int, float], None] | None = None
) -> Found:
    """Return the minimum of (1).

    start: any pressure of the map's shape [Pa]; tolerance: of the residual; most: number of steps; seen: called with the
    number of the step and the residual before each. Without convergence the state of least residual is returned.
    """
    state = _at(problem, on_level(start, problem))
    best, step_length = state, 0.0
    search = _Directions()
    steps = 0
    for steps in range(most + 1):
        if seen is not None:
            seen(steps, state.residual)
        if state.residual <= best.residual:
            best = state
        if state.residual <= tolerance or steps == most:
            break
        moved, step_length = _conjugate_step(problem, state, search, step_length)
        if moved is None:
            search.forget()
            moved, step_length = _projected_step(problem, state, step_length)
        if moved is None:
            break  # no step lowers the energy: rounding
        state = moved
    return Found(best.pressure, best.gap, best.offset, best.residual, steps, best.residual <= tolerance)


class _Directions:
    """Conjugate directions over the free points.

    By the rule of Polak & Ribiere, never negative: it restarts by itself where conjugacy is lost.
    """

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Restart along the gradient."""
        self._gradient: np.ndarray | None = None
        self._direction: np.ndarray | None = None
        self._square = 0.0

    def next(self, state: _State) -> np.ndarray:
        """Return the direction from this state, with zero sum over the free points."""
        gradient = np.where(state.free, state.gap, 0.0)
        square = dot(gradient, gradient)
        direction = -gradient
        if self._direction is not None and self._gradient is not None and self._square > 0.0:
            part = (square - dot(gradient, self._gradient)) / self._square
            if part > 0.0:
                kept = np.where(state.free, self._direction, 0.0)
                kept -= np.where(state.free, kept.sum() / state.count, 0.0)
                kept *= part
                direction += kept
                if dot(direction, gradient) >= 0.0:
                    direction = -gradient
        self._gradient, self._square, self._direction = gradient, square, direction
        return direction


def _conjugate_step(problem, state, search, step_length):
    """Take one step; return the next state and step length, or None if energy rises."""
    if not state.count:
        return None, step_length
    direction = search.next(state)
    response = problem.displacement(direction)
    bent = dot(direction, response)
    if bent > 0.0:
        step_length = -dot(direction, state.gap) / bent
    if not step_length > 0.0:
        return None, 0.0
    pressure = state.pressure + step_length * direction
    leaves = pressure.min() < 0.0 or (math.isfinite(problem.hardness) and pressure.max() > problem.hardness)
    if not state.wrong.any() and not leaves:
        response *= step_length
        response += state.displacement
        return _State(problem, pressure, response), step_length
    np.subtract(pressure, step_length * state.gap, out=pressure, where=state.wrong)
    moved = _at(problem, on_level(pressure, problem))
    return (moved if _energy_change(state, moved) < 0.0 else None), step_length


def _projected_step(problem, state, step_length):
    """Step along the gradient, projected on the bounds and halved until energy falls.

    None if no step lowers the energy enough.
    """
    length = step_length if step_length > 0.0 else problem.mean / problem.length
    for _ in range(60):
        moved = _at(problem, _nearest(state.pressure - length * state.gap, problem))
        change = moved.pressure - state.pressure
        if _energy_change(state, moved) <= -_ENOUGH / length * dot(change, change) < 0.0:
            return moved, length
        length *= 0.5
    return None, length


def _at(problem: Problem, pressure: np.ndarray) -> _State:
    return _State(problem, pressure, problem.displacement(pressure))


def _energy_change(state: _State, moved: _State) -> float:
    """Return the change of (1) times the number of points.

    Formed without the difference of two large numbers.
    """
    change = moved.pressure - state.pressure
    return dot(change, state.gap) + 0.5 * dot(change, moved.displacement - state.displacement)


def dot(first: np.ndarray, second: np.ndarray) -> float:
    """Return the dot product of two arrays without the threads of a BLAS library.

    Those are slow to wake next to the threads of the transforms.
    """
    return float(np.einsum("ij,ij->", first, second))


def on_level(pressure: np.ndarray, problem: Problem) -> np.ndarray:
    """Return the pressure cut to 0 ... H and shifted to the right mean.

    Only pressed points are shifted; others where the pressed ones cannot carry the load.
    """
    top, wanted = problem.hardness, problem.mean * pressure.size
    cut = np.clip(pressure, 0.0, top)
    for _ in range(_SHIFTS):
        missing = wanted - float(cut.sum())
        if abs(missing) <= _ROUNDING * wanted:
            break
        movable = (cut > 0.0) & (cut < top) if missing > 0.0 else cut > 0.0
        count = int(np.count_nonzero(movable))
        if count == 0:
            return _nearest(pressure, problem)
        cut = np.clip(np.add(cut, missing / count, out=cut, where=movable), 0.0, top, out=cut)
    return cut


def _nearest(pressure: np.ndarray, problem: Problem) -> np.ndarray:
    """Return the admissible pressure of (1) nearest to this one.

    All points are shifted and cut to 0 ... H; the shift is found by Newton's rule, with bisection where it leaves the
    bracket.
    """
    top, wanted = problem.hardness, problem.mean
    low = -float(pressure.max())
    high = (top if math.isfinite(top) else wanted * pressure.size) - float(pressure.min())
    shift = min(max(0.0, low), high)
    for _ in range(_SHIFTS):
        cut = np.clip(pressure + shift, 0.0, top)
        missing = wanted - float(cut.mean())
        if abs(missing) <= _ROUNDING * wanted:
            break
        low, high = (shift, high) if missing > 0.0 else (low, shift)
        slope = float(np.count_nonzero((cut > 0.0) & (cut < top))) / cut.size
        shift = shift + missing / slope if slope > 0.0 else low
        if not low < shift < high:
            shift = 0.5 * (low + high)
    return cut
