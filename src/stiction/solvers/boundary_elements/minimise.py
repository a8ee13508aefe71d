"""The pressure under a given load: the minimum of a convex energy between bounds.

With u = C p the displacement of the pressure p and h the heights, among all p of the given mean with 0 <= p <= H

    minimise  1/2 <p u> - <p h>                                                                                            (1)

which is a contact without friction (Kalker & van Randen 1972; Polonsky & Keer 1999, Wear 231, 206) of bodies that are elastic
until the pressure is H, and then flow under it (Almqvist, Sahlin, Larsson & Glavatskih 2007, Tribology Int. 40, 574). C has
only positive eigenvalues, the bounds are convex: there is one minimum, known by its conditions (Karush, Kuhn & Tucker), with
one length a, and the gap g = u - h - a:

    p = 0: g >= 0        0 < p < H: g = 0        p = H: g <= 0, the depth to which the point has flowed                   (2)

so how it was found needs no belief: `residual` says how far (2) is from being met.

The way there is that of Polonsky & Keer, conjugate gradients over the points of 0 < p < H, with five changes, to converge
also where points flow, and in a number of steps that hardly grows with the map: the gradient is turned into a pressure by one
over C(k) before it is followed, on the free points and with zero sum, which near full contact is the solution itself; the
pressure is brought back to its mean by a shift of the pressed points instead of a factor, which would lift it over H;
directions are combined by the rule of Polak & Ribiere and go on where points come and go, instead of beginning anew (as
Bugnicourt et al. 2018, Tribology Lett. 66, 29); the energy must fall in each step. Where it does not, the step is one along
the gradient, projected, and shortened until it does (Bertsekas 1999, Nonlinear Programming, section 2.3: converges from
anywhere). And steps are in single precision while the residual is far above its rounding; double precision goes on from there,
and `residual` is always that of a state computed in double. Equation numbers of Polonsky & Keer could not be compared with
print.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np


class Boundary(Protocol):
    """How the face of a map answers to pressure, in the precision of what it is given."""

    def __call__(self, pressure: np.ndarray, /) -> np.ndarray:
        """Return the displacement [m] of the pressure [Pa]."""

    def inverse(self, displacement: np.ndarray, /) -> np.ndarray:
        """Return a pressure [Pa] of about this displacement [m]."""


_ENOUGH = 1e-4  # share of the decrease along the gradient that a projected step must bring
_SHIFTS = 100
_ROUNDING = {"f": 1e-6, "d": 1e-13}  # of the mean pressure, by precision
_WRONG = 0.05  # of the pressure that would close a wrong gap: more lets points come and go
_SINGLE = 3e-5  # residual down to which single precision leads
_SINGLE_DIGITS = 2e-7  # of the range of heights: the rounding of gaps in single precision


@dataclass(frozen=True)
class Problem:
    """Quadratic problem (1).

    displacement: C, from pressure [Pa] to displacement [m]; heights [m]; mean: pressure [Pa]; hardness: H [Pa], infinite:
    elastic; length: [m], unit of gaps.
    """

    displacement: Boundary
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
    """Pressure, its displacement and the gap (2); the arrays belong to the state.

    exact: whether the displacement was computed from this pressure, not added up on the way.
    """

    def __init__(self, problem: Problem, pressure: np.ndarray, displacement: np.ndarray, *, exact: bool = False):
        self.pressure, self.displacement, self.exact = pressure, displacement, exact
        pressed = pressure > 0.0
        flows = pressure >= problem.hardness if math.isfinite(problem.hardness) else None
        self.free = pressed if flows is None else pressed & ~flows
        self.count = int(np.count_nonzero(self.free))
        self.gap = displacement - problem.heights
        self.offset = self._offset(pressed)
        self.gap -= self.gap.dtype.type(self.offset)
        self.wrong = (self.gap < 0.0) & ~pressed
        if flows is not None:
            self.wrong |= flows & (self.gap > 0.0)
        self.any_wrong = bool(self.wrong.any())
        missed = self.gap * (self.free | self.wrong)
        points = max(int(np.count_nonzero(pressed)), 1)
        self.residual = math.sqrt(dot(missed, missed) / points) / problem.length

    def _offset(self, pressed: np.ndarray) -> float:
        """Return a of (2), the mean over the free points.

        Where no point is free, it lies midway between the flowing and the untouched points.
        """
        if self.count:
            return total(self.gap * self.free) / self.count
        highest = float(np.max(self.gap, where=pressed, initial=-math.inf))
        lowest = float(np.min(self.gap, where=~pressed, initial=math.inf))
        return 0.5 * (highest + lowest) if math.isfinite(lowest) else highest


def minimise(
    problem: Problem, start: np.ndarray, *, tolerance: float, most: int, seen: Callable[[int, float], None] | None = None
) -> Found:
    """Return the minimum of (1).

    start: any pressure of the map's shape [Pa]; tolerance: of the residual; most: number of steps; seen: called with the
    number of the step and the residual before each. Without convergence the state of least residual is returned.
    """
    rounding = _SINGLE_DIGITS * float(np.ptp(problem.heights)) / problem.length
    rough = _Search(replace(problem, heights=problem.heights.astype(np.float32)), seen)
    pressure = rough.run(start.astype(np.float32), max(_SINGLE, rounding, tolerance), most).pressure
    fine = _Search(problem, seen, rough.steps)
    best = fine.run(pressure.astype(np.float64), tolerance, most)
    return Found(best.pressure, best.gap, best.offset, best.residual, fine.steps, best.residual <= tolerance)


class _Search:
    """The steps of one precision, that of the heights of the problem.

    steps: how many were taken, with those before it.
    """

    def __init__(self, problem: Problem, seen: Callable[[int, float], None] | None, steps: int = 0):
        self.problem, self.steps = problem, steps
        self._seen = seen
        self._directions = _Directions()
        self._point_stiffness = _point_stiffness(problem)

    def run(self, start: np.ndarray, tolerance: float, most: int) -> _State:
        """Return the state of least residual from this start; steps end below the tolerance."""
        state = best = self._at(on_level(start, self.problem))
        while True:
            if state.residual <= tolerance and not state.exact:
                state = self._at(state.pressure)  # what was added up on the way has its rounding
            if self._seen is not None:
                self._seen(self.steps, state.residual)
            if state.residual <= best.residual:
                best = state
            if state.residual <= tolerance or self.steps >= most:
                break
            moved = self._conjugate_step(state)
            if moved is None:
                self._directions.forget()
                moved = self._projected_step(state)
            if moved is None:
                break  # no step lowers the energy: rounding
            state = moved
            self.steps += 1
        return best if best.exact else self._at(best.pressure)

    def _at(self, pressure: np.ndarray) -> _State:
        return _State(self.problem, pressure, self.problem.displacement(pressure), exact=True)

    def _conjugate_step(self, state: _State) -> _State | None:
        """Return the next state, None if energy rises."""
        if not state.count:
            return None
        direction = self._directions.next(self.problem, state)
        response = self.problem.displacement(direction)
        bent = dot(direction, response)
        length = -dot(direction, state.gap) / bent if bent > 0.0 else 0.0
        if not length > 0.0:
            return None
        kind = direction.dtype.type
        pressure = state.pressure + kind(length) * direction
        if not state.any_wrong and within(pressure, self.problem):
            response *= kind(length)
            response += state.displacement
            return _State(self.problem, pressure, response)
        pressure -= kind(_WRONG * self._point_stiffness) * (state.gap * state.wrong)
        moved = self._at(on_level(pressure, self.problem))
        return moved if _energy_change(state, moved) < 0.0 else None

    def _projected_step(self, state: _State) -> _State | None:
        """Step along the gradient, projected on the bounds and halved until energy falls.

        None if no step lowers the energy enough.
        """
        length = self._point_stiffness
        for _ in range(60):
            way = state.gap.dtype.type(length) * state.gap
            moved = self._at(_nearest(state.pressure - way, self.problem))
            change = moved.pressure - state.pressure
            if _energy_change(state, moved) <= -_ENOUGH / length * dot(change, change) < 0.0:
                return moved
            length *= 0.5
        return None


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

    def next(self, problem: Problem, state: _State) -> np.ndarray:
        """Return the direction from this state, with zero sum over the free points."""
        gradient = state.gap * state.free
        downhill = _balanced(problem.displacement.inverse(gradient), state)
        np.negative(downhill, out=downhill)
        square = -dot(gradient, downhill)
        direction = downhill
        if self._direction is not None and self._gradient is not None and self._square > 0.0:
            part = (square + dot(downhill, self._gradient)) / self._square
            if part > 0.0:
                direction = _balanced(self._direction, state)
                direction *= direction.dtype.type(part)
                direction += downhill
                if dot(direction, gradient) >= 0.0:
                    direction = downhill
        self._gradient, self._square, self._direction = gradient, square, direction
        return direction


def _balanced(values: np.ndarray, state: _State) -> np.ndarray:
    """Return the values on the free points, less their mean there."""
    kept = values * state.free
    kept -= state.free * kept.dtype.type(total(kept) / state.count)
    return kept


def _point_stiffness(problem: Problem) -> float:
    """Return the pressure on one point that would move it alone, over its displacement [Pa/m]."""
    point = np.zeros(problem.heights.shape, dtype=problem.heights.dtype)
    point[0, 0] = 1.0
    return float(problem.displacement.inverse(point)[0, 0])


def _energy_change(state: _State, moved: _State) -> float:
    """Return the change of (1) times the number of points.

    Formed without the difference of two large numbers.
    """
    change = moved.pressure - state.pressure
    return dot(change, state.gap) + 0.5 * dot(change, moved.displacement - state.displacement)


def dot(first: np.ndarray, second: np.ndarray) -> float:
    """Return the dot product of two arrays, added up by rows, without the threads of a BLAS library.

    Those are slow to wake next to the threads of the transforms.
    """
    return float(np.einsum("ij,ij->i", first, second).sum(dtype=np.float64))


def total(values: np.ndarray) -> float:
    """Return the sum of an array, in double precision."""
    return float(values.sum(axis=1).sum(dtype=np.float64))


def within(pressure: np.ndarray, problem: Problem) -> bool:
    """Return whether no pressure is outside of 0 ... H."""
    return bool(pressure.min() >= 0.0) and (math.isinf(problem.hardness) or bool(pressure.max() <= problem.hardness))


def on_level(pressure: np.ndarray, problem: Problem) -> np.ndarray:
    """Return the pressure cut to 0 ... H and shifted to the right mean.

    Only pressed points are shifted; others where the pressed ones cannot carry the load.
    """
    top, wanted = problem.hardness, problem.mean * pressure.size
    cut = np.clip(pressure, 0.0, top)
    rounding = _ROUNDING[cut.dtype.char]
    for _ in range(_SHIFTS):
        missing = wanted - total(cut)
        if abs(missing) <= rounding * wanted:
            break
        movable = (cut > 0.0) & (cut < top) if missing > 0.0 else cut > 0.0
        count = int(np.count_nonzero(movable))
        if count == 0:
            return _nearest(pressure, problem)
        cut += cut.dtype.type(missing / count) * movable
        np.clip(cut, 0.0, top, out=cut)
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
    kind = pressure.dtype.type
    for _ in range(_SHIFTS):
        cut = np.clip(pressure + kind(shift), 0.0, top)
        missing = wanted - total(cut) / cut.size
        if abs(missing) <= _ROUNDING[cut.dtype.char] * wanted:
            break
        low, high = (shift, high) if missing > 0.0 else (low, shift)
        slope = float(np.count_nonzero((cut > 0.0) & (cut < top))) / cut.size
        shift = shift + missing / slope if slope > 0.0 else low
        if not low < shift < high:
            shift = 0.5 * (low + high)
    return cut
