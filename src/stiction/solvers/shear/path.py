"""Compute the friction force on a height map that is shifted step by step, with slip history and slip weakening.

Each point keeps the slip of earlier steps. With slip weakening, the strength falls with slip. Each step then solves slip and
strength alternately, starting from the earlier slip. Slip only grows in these iterations, so they end at the first equilibrium.
If the force drops abruptly at one shift, the contact has ruptured, as it would on a stiff machine.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np
from scipy.optimize import brentq

from stiction.quantities.errors import InputError, InWords, nearest
from stiction.solvers.shear.minimise import Sheared, shear, size_of
from stiction.solvers.shear.operators import ShearOperator

TOLERANCE = 1e-6
MOST_STEPS = 2000
_MOST_TURNS = 400
_SETTLED = 1e-3  # largest change of a point's strength in the last iteration, relative to its first strength
_TURNING = 1e-4  # tolerance of the traction while strengths change; a tolerance of 1e-6 changes peaks by 1e-5 only
_NONE = np.empty(0)  # replaces a map that is not stored
_FINER = 8  # number of smaller steps that replace each of the two steps around the largest force

SHAPES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "linear": lambda slip: np.maximum(1.0 - slip, 0.0),
    "exponential": lambda slip: np.exp(-slip),
}
"""Functions of slip divided by characteristic slip that return the remaining fraction of the strength that slip can remove."""


@dataclass(frozen=True)
class Weakening:
    """Describe how the shear strength falls with slip.

    slip: characteristic slip [m], > 0. residual: fraction of the strength that remains after large slip, 0 to 1. shape: a key
    of SHAPES, "linear" or "exponential". Raises InputError for other values.
    """

    slip: float
    residual: float = 0.0
    shape: str = "linear"

    def __post_init__(self) -> None:
        if not self.slip > 0.0:
            raise InputError("weakening.slip", self.slip, "> 0 m")
        if not 0.0 <= self.residual <= 1.0:
            raise InputError("weakening.residual", self.residual, "0 to 1")
        if self.shape not in SHAPES:
            raise InputError("weakening.shape", self.shape, nearest(self.shape, list(SHAPES)))

    def share(self, slip: np.ndarray) -> np.ndarray:
        """Return the fraction of the strength that remains after a slip [m], given as an array of any shape."""
        return self.residual + (1.0 - self.residual) * SHAPES[self.shape](slip / self.slip)


@dataclass(frozen=True)
class State:
    """Store the state of a map at one rigid shift.

    shift [m]. force: sum of the traction along x over all points [Pa]; multiplied by the area of a point, it is the force [N].
    traction [Pa] and slip since the start [m], both (components, rows, columns). slipped: length of the slip path of each point
    [m]; slides: whether the point is at its strength; touching: whether it is in contact; all three (rows, columns). stick:
    fraction of the touching points that stick; 0 if none touches. loss: work dissipated by slip so far, summed over points
    [Pa m]. converged: whether the iterations of this step converged.
    """

    shift: float
    force: float
    traction: np.ndarray = field(repr=False)
    slip: np.ndarray = field(repr=False)
    slipped: np.ndarray = field(repr=False)
    slides: np.ndarray = field(repr=False)
    touching: np.ndarray = field(repr=False)
    stick: float
    loss: float
    converged: bool


StateT = TypeVar("StateT", bound=State)


@dataclass(frozen=True)
class SlidingPath:
    """Store the states of a map at all rigid shifts, and the state with the largest force.

    peak: state with the largest force. strength: strength of each point before any slip (rows, columns) [Pa]. pixel: area of a
    point [m2]. limit: sum of the tractions of all points at very large shifts [Pa]; times `pixel` it is a force. None if
    strength falls with slip.
    """

    states: tuple[State, ...]
    peak: State
    strength: np.ndarray = field(repr=False)
    pixel: float
    limit: float | None = None

    @property
    def efficiency(self) -> float:
        """Return the largest force of all states divided by the sum of the strengths of all points."""
        return self.peak.force / float(self.strength.sum())

    @property
    def largest(self) -> float:
        """Return the largest friction force [N] of the path.

        If strength does not fall with slip, the force at very large shifts is included, even if no state was computed there.
        """
        return max(self.peak.force, self.limit or 0.0) * self.pixel

    def array(self, name: str) -> np.ndarray:
        """Return one attribute of all states (states,), by its name: shift [m], stick [1], force [N] or loss [J]."""
        values = np.array([getattr(state, name) for state in self.states], dtype=float)
        return values * self.pixel if name in ("force", "loss") else values


def through_spring(path: SlidingPath, stiffness: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the drive displacement [m] at each state of a map that a spring pulls, and a mask of the states that are reached.

    path: states of the map. stiffness: stiffness of the spring [N/m], > 0. At the shift U and the force F the drive is at U +
    F/stiffness. The drive only moves forward. A state at which the drive would have to move back is not reached; the map jumps
    to the next reachable state (slow drive, no inertia). Raises InputError for a stiffness that is not positive.
    """
    if not stiffness > 0.0:
        raise InputError("stiffness", stiffness, "> 0 N/m")
    drive = path.array("shift") + path.array("force") / stiffness
    return drive, drive >= np.maximum.accumulate(drive)


def at_force(operator: ShearOperator, strength: np.ndarray, force: float, *, pixel: float, directions: int = 1) -> State:
    """Return the state of a map under a tangential force [N] along x, at constant strength.

    The map starts without traction. operator: tangential compliance. strength: (rows, columns) [Pa]. pixel: area of a point
    [m2]. directions: 1 neglects the traction across the sliding direction, 2 includes it. Raises InputError if the force is
    negative or not below the sum of the strengths times the pixel area.
    """
    most = float(strength.sum()) * pixel
    if not 0.0 <= force < most:
        raise InputError("force", force, f"from 0 to less than the largest friction force, {most:.6g} N")

    def state(shift: float) -> State:
        return slide_map(operator, strength, [shift], pixel=pixel, directions=directions).peak

    def missing(shift: float) -> float:
        return state(shift).force * pixel - force

    high = full_shift(operator, strength)
    while missing(high) < 0.0:
        high *= 2.0
    return state(brentq(missing, 0.0, high, xtol=1e-7 * high, rtol=1e-7))


def full_shift(operator: ShearOperator, strength: np.ndarray, weakening: Weakening | None = None) -> float:
    """Return a rigid shift [m] at which every point of a map slips.

    operator: tangential compliance. strength: (rows, columns) [Pa]. With a linear `weakening`, all points have also reached
    their residual strength at this shift.
    """
    displaced = float(operator(strength[None])[0].max(where=strength > 0.0, initial=0.0))
    return displaced + (weakening.slip if weakening is not None else 0.0)


def stuck_stiffness(operator: ShearOperator, touching: np.ndarray) -> float:
    """Return the tangential stiffness [Pa/m] of a map while all touching points stick.

    It is the traction summed over points, divided by the rigid shift. operator: tangential compliance. touching: mask (rows,
    columns).
    """
    strength = np.where(touching, 1e3 / operator.of_point, 0.0)
    shift = np.ones((1, *touching.shape))
    return float(shear(operator, strength, shift, 0.0 * shift, tolerance=1e-9, most=MOST_STEPS).traction.sum())


def weakening_length(operator: ShearOperator, strength: float, weakening: Weakening) -> float:
    """Return the length [m] of the zone behind the tip of slip in which the strength falls.

    operator: tangential compliance. weakening: how strength falls with slip. The length is D_c/(S (tau_p - tau_r)) with the
    characteristic slip D_c, the strength tau_p = `strength` [Pa], the residual strength tau_r, and S the sum of 1/G over the
    two surface materials (G: shear modulus). tau_r must be less than tau_p.
    """
    return weakening.slip / (operator.near * strength * (1.0 - weakening.residual))


def slide_map(
    operator: ShearOperator, strength: np.ndarray, shifts: Sequence[float], *, pixel: float,
    weakening: Weakening | None = None, directions: int = 1, tolerance: float = TOLERANCE, most_steps: int = MOST_STEPS,
    keep_maps: bool = True, done: Callable[[State], None] | None = None,
) -> SlidingPath:  # fmt: skip
    """Shift a map through rigid shifts along x [m], in the given order, starting without traction; return all states.

    operator: tangential compliance. strength: (rows, columns) [Pa], 0 outside of contact. pixel: area of a point [m2].
    weakening: how strength falls with slip; None for constant strength. directions: 1 neglects the traction across the sliding
    direction, 2 includes it. tolerance, most_steps: largest residual and number of steps of the traction solver at each shift.
    keep_maps: whether all states keep traction and slip, or only the peak. done: called with each state. With weakening, the
    steps around the largest force are repeated with smaller steps. Raises InputError for strengths that are negative, not
    finite, or all 0, and for other directions.
    """
    strength = np.asarray(strength, dtype=float)
    if not np.isfinite(strength).all() or strength.min() < 0.0 or not strength.max() > 0.0:
        raise InputError(
            "strength", InWords("negative, infinite, NaN, or 0 everywhere"), "finite, >= 0 Pa, and > 0 at some point"
        )
    if directions not in (1, 2):
        raise InputError("directions", directions, "1 or 2")

    def advance(state: State, shift: float) -> State:
        moved = np.zeros_like(state.slip)
        moved[0] = shift
        moved -= state.slip
        step = slip_step(operator, strength, weakening, state, moved, tolerance, most_steps)
        return State(shift, **after_step(state, step, touching))

    touching, zero = strength > 0.0, np.zeros((directions, *strength.shape))
    start = State(0.0, 0.0, zero, zero, np.zeros_like(strength), strength < 0.0, touching, 1.0, 0.0, True)
    states, peak = follow(advance, start, shifts, finer=weakening is not None, keep_maps=keep_maps, done=done)
    return SlidingPath(states, peak, strength, pixel, float(strength.sum()) if weakening is None else None)


def follow(
    advance: Callable[[StateT, float], StateT], start: StateT, shifts: Sequence[float], *, finer: bool,
    keep_maps: bool = True, done: Callable[[StateT], None] | None = None,
) -> tuple[tuple[StateT, ...], StateT]:  # fmt: skip
    """Compute the states at rigid shifts [m] in the given order; return them and the state with the largest force.

    advance: function (state, shift) that returns the state at the next shift. start: state before the first shift. finer:
    whether the steps around the largest force are repeated with smaller steps. keep_maps: whether all states keep traction
    and slip, or only the one with the largest force. done: called with each state.
    """
    states, state, before, peak, top = [], start, start, start, -1
    for index, shift in enumerate(shifts):
        last, state = state, advance(state, float(shift))
        if state.force > peak.force:
            before, peak, top = last, state, index
        states.append(state if keep_maps else replace(state, traction=_NONE, slip=_NONE, slipped=_NONE))
        if done is not None:
            done(state)
    if finer and 0 <= top < len(states) - 1:
        state = before
        for shift in np.linspace(before.shift, states[top + 1].shift, 2 * _FINER + 1)[1:-1]:
            state = advance(state, float(shift))
            peak = max(peak, state, key=lambda state: state.force)
    return tuple(states), peak


@dataclass(frozen=True)
class SlipStep:
    """Store the result of one step of slip.

    found: traction and slip. left: strength that remains after the slip (rows, columns) [Pa]. settled: whether the iteration of
    slip and strength converged.
    """

    found: Sheared
    left: np.ndarray
    settled: bool


def slip_step(
    operator: ShearOperator, strength: np.ndarray, weakening: Weakening | None, state: State, moved: np.ndarray,
    tolerance: float, most: int,
) -> SlipStep:  # fmt: skip
    """Solve traction, slip and remaining strength of one step.

    operator: tangential compliance. strength: shear strength of points that have not slipped (rows, columns) [Pa]. weakening:
    how strength falls with slip; None for constant strength. state: before the step. moved: rigid shift minus all earlier slip
    [m] (components, rows, columns). tolerance, most: largest residual and number of steps of the traction solver.
    """
    traction, left, settled = state.traction, strength, True
    if weakening is not None:
        traction, left, settled = _weakened(operator, strength, weakening, state, moved, max(tolerance, _TURNING), most)
    found = shear(operator, left, moved, traction, tolerance=tolerance, most=most)
    if weakening is not None:  # points that have lost all strength slip with the motion of the faces
        bare = (strength > 0.0) & (left == 0.0)
        found = replace(found, slip=np.where(bare, moved - operator(found.traction), found.slip))
    return SlipStep(found, left, settled)


def _weakened(
    operator: ShearOperator, strength: np.ndarray, weakening: Weakening, state: State, moved: np.ndarray, tolerance: float,
    most: int,
) -> tuple[np.ndarray, np.ndarray, bool]:  # fmt: skip
    """Return traction [Pa], remaining strength (rows, columns) [Pa], and whether the iteration converged.

    The arguments are those of `slip_step`. Traction and strength are computed alternately. Single precision is enough here, and
    takes a third of the time.
    """
    left, settled = strength * weakening.share(state.slipped), False
    traction, moved = state.traction.astype(np.float32), moved.astype(np.float32)
    for _ in range(_MOST_TURNS):
        found = shear(operator, left, moved, traction, tolerance=tolerance, most=most)
        traction = found.traction
        weaker = np.minimum(left, strength * weakening.share(state.slipped + size_of(found.slip)))
        settled = bool((left - weaker <= _SETTLED * strength).all())
        left = weaker
        if settled:
            break
    return traction.astype(float), left, settled


def after_step(state: State, step: SlipStep, touching: np.ndarray, apart: np.ndarray | float = 0.0) -> dict[str, Any]:
    """Return all attributes of the state after a step, except the shift, as a dict by name.

    state: the state before the step. step: result of the step. touching: mask (rows, columns) of points in contact. apart: slip
    of the points without contact in this step [m].
    """
    found, slid = step.found, size_of(step.found.slip)
    sliding = touching & (size_of(found.traction) >= step.left * (1.0 - 1e-9))
    count = np.count_nonzero(touching)
    return {
        "force": float(found.traction[0].sum()),
        "traction": found.traction,
        "slip": state.slip + np.where(touching, found.slip, apart),
        "slipped": state.slipped + np.where(touching, slid, 0.0),
        "slides": sliding,
        "touching": touching,
        "stick": 1.0 - np.count_nonzero(sliding) / count if count else 0.0,
        # Only sliding points count, because the slip of sticking points is a numerical residual.
        "loss": state.loss + float(np.sum(found.traction * found.slip, where=sliding)),
        "converged": step.settled and found.converged,
    }
