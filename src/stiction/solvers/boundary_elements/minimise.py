"""The pressure under a given load: the minimum of a convex energy between bounds.

With u = C p the displacement of the pressure p and h the heights, among all p of the given mean with 0 <= p <= H

    minimise  1/2 <p u> - <p h>                                                                                            (1)

which is a contact without friction (Kalker & van Randen 1972; Polonsky & Keer 1999, Wear 231, 206) of bodies that are elastic
until the pressure is H, and then flow under it (Almqvist, Sahlin, Larsson & Glavatskih 2007, Tribology Int. 40, 574). C has
only positive eigenvalues, the bounds are convex: there is one minimum, known by its conditions (Karush, Kuhn & Tucker), with
one length a, and the gap g = u - h - a:

    p = 0: g >= 0        0 < p < H: g = 0        p = H: g <= 0, the depth to which the point has flowed                   (2)

so how it was found needs no belief: `residual` says how far (2) is from being met.

The way there is that of Polonsky & Keer, conjugate gradients over the points of 0 < p < H, with five changes, so that it
converges also where points flow, and in a number of steps that hardly grows with the map:

- the gradient is turned into a pressure by one over C(k) before it is followed, on the free points and with zero sum, which
  near full contact is the solution itself;
- the pressure is brought back to its mean by a shift of the free points instead of a factor, which would lift it over H;
- directions are combined by the rule of Polak & Ribiere and go on where points come and go, instead of beginning anew (as
  Bugnicourt et al. 2018, Tribology Lett. 66, 29);
- the energy must fall in each step. Where it does not, the step is one along the gradient, projected, and shortened until it
  does (Bertsekas 1999, Nonlinear Programming, section 2.3: converges from anywhere);
- steps change the gap in single precision. From time to time it is computed from the pressure in double precision, and steps
  go on from there (iterative refinement: Moler 1967, J. ACM 14, 316). `residual` is always that of a gap in double.

Equation numbers of Polonsky & Keer could not be compared with print.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np


class Boundary(Protocol):
    """The interface of a map's compliance operator: displacement from pressure.

    It computes in the precision of its argument. inverts: whether `inverse` is exact.
    """

    inverts: bool

    def __call__(self, pressure: np.ndarray, /) -> np.ndarray:
        """Return the displacement map [m] caused by a pressure map [Pa]."""

    def inverse(self, displacement: np.ndarray, /) -> np.ndarray:
        """Return a pressure map [Pa] that causes about this displacement map [m]."""


_ENOUGH = 1e-4  # share of the decrease along the gradient that a projected step must bring
_SHIFTS = 100
_ROUNDING = 1e-13  # of the mean pressure
_WRONG = 0.05  # of the pressure that would close a wrong gap: more lets points come and go
_DIGITS = 1e-4  # residual over the last one in double at which single precision has done its part
_AIM = 0.7  # of the tolerance, for the residual in single precision
_BLOCK = 2**16  # points that are worked on together: their numbers stay in the processor's cache


@dataclass(frozen=True)
class Problem:
    """The quadratic minimisation problem (1).

    displacement: C, from pressure [Pa] to displacement [m]. heights: map [m]. mean: mean pressure [Pa]. hardness: H [Pa];
    infinite for elastic bodies. length: unit of gaps [m].
    """

    displacement: Boundary
    heights: np.ndarray
    mean: float
    hardness: float
    length: float

    @cached_property
    def point_stiffness(self) -> float:
        """Return the pressure on one point that would move it alone, over its displacement [Pa/m]."""
        point = np.zeros(self.heights.shape, dtype=np.float32)
        point[0, 0] = 1.0
        return float(self.displacement.inverse(point)[0, 0])


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


def minimise(
    problem: Problem, start: np.ndarray, *, tolerance: float, most: int, seen: Callable[[int, float], None] | None = None
) -> Found:
    """Return the solution of the minimisation problem (1).

    start: any pressure map [Pa]. tolerance: of the residual. most: largest number of steps. seen: called before each step
    with its number and the residual. Without convergence, the state with the smallest residual is returned.
    """
    best = last = _in_double(problem, on_level(np.clip(start, 0.0, problem.hardness), problem))
    search = _Search(problem, seen)
    while best.residual > tolerance and search.steps < most:
        before = search.steps
        pressure = search.run(last, max(_AIM * tolerance, _DIGITS * last.residual), most)
        if search.steps == before:
            break  # no step lowers the energy: rounding
        last = _in_double(problem, on_level(pressure, problem))
        if last.residual < best.residual:
            best = last
    return Found(best.pressure, best.gap, best.offset, best.residual, search.steps, best.residual <= tolerance)


@dataclass(frozen=True)
class _State:
    """Pressure [Pa] with its gap [m], offset [m] and residual, in double precision."""

    pressure: np.ndarray
    gap: np.ndarray
    offset: float
    residual: float


def _in_double(problem: Problem, pressure: np.ndarray) -> _State:
    gap = problem.displacement(pressure)
    gap -= problem.heights
    offset, residual, _ = _settle(problem, pressure, gap, problem.length)
    return _State(pressure, gap, offset, residual)


def _settle(problem: Problem, pressure: np.ndarray, gap: np.ndarray, length: float) -> tuple[float, float, bool]:
    """Take the offset from the gap; return it with the residual and whether (2) is missed where points are not free.

    length: unit of gaps, in the unit of this gap. The offset is the mean over the free points; where no point is free, it
    lies midway between the flowing and the untouched ones.
    """
    total, count, pressed = 0.0, 0, 0
    for rows in blocks(gap.shape):
        touches = pressure[rows] > 0.0
        free = touches & (pressure[rows] < problem.hardness)
        total += dot(gap[rows], free.astype(gap.dtype))
        count += int(np.count_nonzero(free))
        pressed += int(np.count_nonzero(touches))
    offset = total / count if count else _between(pressure > 0.0, gap)
    missed = wrong = 0.0
    for rows in blocks(gap.shape):
        here = gap[rows]
        here -= here.dtype.type(offset)
        at_bounds = _wrong(problem, pressure[rows], here)
        wrong += dot(at_bounds, at_bounds)
        here = here * ((pressure[rows] > 0.0) & (pressure[rows] < problem.hardness))
        missed += dot(here, here)
    return offset, math.sqrt((missed + wrong) / max(pressed, 1)) / length, wrong > 0.0


def _between(touches: np.ndarray, gap: np.ndarray) -> float:
    """Return the middle between the highest gap that touches and the lowest that does not."""
    highest = float(np.max(gap, where=touches, initial=-math.inf))
    lowest = float(np.min(gap, where=~touches, initial=math.inf))
    return 0.5 * (highest + lowest) if math.isfinite(lowest) else highest


def _wrong(problem: Problem, pressure: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Return the gap where (2) forbids its sign: negative without pressure, positive at the hardness."""
    wrong = np.minimum(gap, 0.0)
    wrong *= pressure <= 0.0
    if math.isfinite(problem.hardness):
        wrong += np.maximum(gap, 0.0) * (pressure >= problem.hardness)
    return wrong


def missed_gap(problem: Problem, pressure: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Return the part of the gap [m] by which (2) is missed."""
    missed = _wrong(problem, pressure, gap)
    missed += gap * ((pressure > 0.0) & (pressure < problem.hardness))
    return missed


class _Search:
    """Steps in single precision, gaps in units of the problem's length.

    steps: how many were taken.
    """

    def __init__(self, problem: Problem, seen: Callable[[int, float], None] | None):
        self.steps = 0
        self._problem, self._seen = problem, seen

    def run(self, start: _State, aim: float, most: int) -> np.ndarray:
        """Return the pressure at which the residual is below this aim, or after which no step lowers the energy."""
        self._pressure = start.pressure.copy()
        self._gap = np.multiply(start.gap, 1.0 / self._problem.length, dtype=np.float32, casting="same_kind")
        self._other = np.empty_like(self._pressure)
        self._direction, self._gradient, self._spare, self._change = (np.zeros_like(self._gap) for _ in range(4))
        self._restart()
        self._settle()
        while True:
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
        """Forget the last direction."""
        self._square = math.inf

    def _settle(self) -> None:
        _, self._residual, self._any_wrong = _settle(self._problem, self._pressure, self._gap, 1.0)

    def _conjugate_step(self) -> bool:
        """Go along the next direction; return False if energy rises."""
        slope = self._turn()
        if not slope < 0.0:
            return False
        response = self._respond(self._direction)
        bent = sum(dot(self._direction[rows], response[rows]) for rows in blocks(response.shape))
        if not bent > 0.0:
            return False
        length = np.float32(-slope / bent)
        pressure, inside = self._along(length)
        if inside and not self._any_wrong:
            self._arrive(pressure, response, length)
            return True
        return self._accept(on_level(pressure, self._problem))

    def _along(self, length: np.float32) -> tuple[np.ndarray, bool]:
        """Return the pressure so far along the direction, mended where (2) is missed and cut, and whether nothing was cut."""
        problem, pressure, inside = self._problem, self._other, True
        mend = _WRONG * problem.point_stiffness * problem.length
        for rows in blocks(pressure.shape):
            here = np.add(self._pressure[rows], length * self._direction[rows], out=pressure[rows])
            if self._any_wrong:
                here -= mend * _wrong(problem, self._pressure[rows], self._gap[rows])
            inside = inside and bool(here.min() >= 0.0) and bool(here.max() <= problem.hardness)
            np.clip(here, 0.0, problem.hardness, out=here)
        return pressure, inside

    def _accept(self, pressure: np.ndarray, least: float = 0.0) -> bool:
        """Go to this pressure if energy falls; least: [1/(Pa m)] decrease over the square of the change."""
        change = self._change
        for rows in blocks(change.shape):
            np.subtract(pressure[rows], self._pressure[rows], out=change[rows], casting="same_kind")
        response = self._respond(change)
        energy = square = 0.0
        for rows in blocks(change.shape):
            energy += dot(change[rows], self._gap[rows]) + 0.5 * dot(change[rows], response[rows])
            square += dot(change[rows], change[rows]) if least else 0.0
        falls = energy < 0.0 and energy <= -least * square
        if falls:
            self._arrive(pressure, response)
        return falls

    def _arrive(self, pressure: np.ndarray, response: np.ndarray, part: np.float32 | None = None) -> None:
        """Take this pressure, and the gap with this response or part of it."""
        self._pressure, self._other = pressure, self._pressure
        for rows in blocks(response.shape):
            self._gap[rows] += response[rows] if part is None else part * response[rows]
        self._settle()

    def _respond(self, change: np.ndarray) -> np.ndarray:
        """Return the displacement of a change of the pressure, in lengths."""
        response = self._problem.displacement(change)
        response *= np.float32(1.0 / self._problem.length)
        return response

    def _turn(self) -> float:
        """Find the next direction, with zero sum over the free points; return the slope of the energy along it.

        By the rule of Polak & Ribiere, never negative: it restarts by itself where conjugacy is lost.
        """
        gradient, before, last = self._spare, self._gradient, self._direction
        for rows in blocks(gradient.shape):
            np.multiply(self._gap[rows], self._free(rows), out=gradient[rows])
        downhill = self._problem.displacement.inverse(gradient)
        sums = np.zeros(6)
        for rows in blocks(gradient.shape):
            free, down = self._free(rows), downhill[rows]
            down *= free
            sums += (
                free.sum(), down.sum(), dot(down, gradient[rows]), dot(down, before[rows]), dot(free, before[rows]),
                dot(free, last[rows]),
            )  # fmt: skip
        count, total, square, mixed, before_total, last_total = sums.tolist()
        if not count:
            return 0.0
        mean = total / count
        part = max(0.0, square - mixed + mean * before_total) / self._square
        shift = np.float32(mean - part * last_total / count)
        slope = 0.0
        for rows in blocks(gradient.shape):
            here = last[rows]
            here *= np.float32(part)
            here += shift
            here *= self._free(rows)
            here -= downhill[rows]
            slope += dot(here, gradient[rows])
        self._gradient, self._spare, self._square = gradient, before, square
        return slope

    def _free(self, rows: slice) -> np.ndarray:
        """Return 1 at the free points of these rows, 0 at others."""
        here = self._pressure[rows]
        return ((here > 0.0) & (here < self._problem.hardness)).astype(np.float32)

    def _projected_step(self) -> bool:
        """Step along the gradient, projected on the bounds and halved until energy falls enough."""
        length = self._problem.point_stiffness * self._problem.length
        for _ in range(60):
            if self._accept(_nearest(self._pressure - length * self._gap, self._problem), _ENOUGH / length):
                return True
            length *= 0.5
        return False


def blocks(shape: tuple[int, ...]) -> Iterator[slice]:
    """Yield the rows of a map in blocks that fit into the processor's cache."""
    step = max(1, _BLOCK // shape[1])
    for first in range(0, shape[0], step):
        yield slice(first, first + step)


def dot(first: np.ndarray, second: np.ndarray) -> float:
    """Return the dot product of two arrays, added up by rows, without the threads of a BLAS library.

    Those are slow to wake next to the threads of the transforms.
    """
    return float(np.einsum("ij,ij->i", first, second).sum(dtype=np.float64))


def total(values: np.ndarray) -> float:
    """Return the sum of an array, in double precision."""
    return float(values.sum(axis=1).sum(dtype=np.float64))


def on_level(pressure: np.ndarray, problem: Problem) -> np.ndarray:
    """Return the pressure shifted to the wanted mean and kept in 0 ... H.

    Points strictly between 0 and H are shifted, in place. If that does not reach the mean, all points are shifted, in a new
    array.
    """
    top, wanted = problem.hardness, problem.mean * pressure.size
    pressed = pressure > 0.0
    values = pressure[pressed]
    for _ in range(_SHIFTS):
        missing = wanted - float(values.sum())
        if abs(missing) <= _ROUNDING * wanted:
            pressure[pressed] = values
            return pressure
        free = (values > 0.0) & (values < top)
        count = int(np.count_nonzero(free))
        if not count:
            break
        values += (missing / count) * free
        np.clip(values, 0.0, top, out=values)
    return _nearest(pressure, problem)


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
