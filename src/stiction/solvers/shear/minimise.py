"""Compute the shear traction of a map under a rigid shift, by minimising elastic energy.

C is the compliance, u = C q the displacement of the traction q, b the rigid shift minus all earlier slip, s >= 0 the shear
strength, and <> the mean over the map. The traction solves

    minimise  1/2 <q u> - <q b>    among all |q| <= s                                                                     (1)

(Kalker 1990, Three-Dimensional Elastic Bodies in Rolling Contact, section 4.2, at fixed strength). Its optimality conditions
are those of frictional contact: the slip r = b - u is 0 where |q| < s, and is parallel to q where |q| = s.

The method uses conjugate gradients over the sticking points. The preconditioner is the inverse of C for a map that sticks
everywhere. Tractions beyond the strength are projected back to it. If the energy does not fall, the step follows the projected
gradient and is shortened until the energy falls. This converges from any start (Bertsekas 1999, Nonlinear Programming, 2.3).
"""

import math
from dataclasses import dataclass

import numpy as np

from stiction.engine.stopping import raise_if_stopped
from stiction.solvers.shear.operators import ShearOperator

_ENOUGH = 1e-4  # least decrease of the energy by a projected step, relative to the decrease that the gradient predicts
_AT = 8.0  # a traction at most this many rounding units below the strength counts as equal to it


@dataclass(frozen=True)
class Sheared:
    """Store the traction and slip of a map that is sheared by a rigid shift.

    traction [Pa] and slip [m]: (components, rows, columns), one component (x) or two (x and y); the slip is 0 at points without
    strength. residual: distance of the traction from its projected-gradient update, summed over points, divided by the summed
    strength. steps: iterations used. converged: whether the residual reached the tolerance.
    """

    traction: np.ndarray
    slip: np.ndarray
    residual: float
    steps: int
    converged: bool


def size_of(vectors: np.ndarray) -> np.ndarray:
    """Return the magnitude (...) of a vector field (components, ...)."""
    return np.abs(vectors[0]) if len(vectors) == 1 else np.hypot(*vectors)


def within(traction: np.ndarray, strength: np.ndarray) -> np.ndarray:
    """Return the traction (components, rows, columns), shortened where its magnitude exceeds the strength (rows, columns)."""
    if len(traction) == 1:
        return np.clip(traction, -strength, strength)
    length = size_of(traction)
    return traction * np.divide(strength, length, out=np.ones_like(length), where=length > strength)


def shear(
    operator: ShearOperator, strength: np.ndarray, shift: np.ndarray, start: np.ndarray, *, tolerance: float, most: int
) -> Sheared:
    """Compute the shear traction and slip of a map under a rigid shift, by minimising elastic energy.

    operator: tangential compliance. strength: (rows, columns) [Pa], 0 outside of contact. shift: rigid shift minus earlier slip
    [m]; start: first guess of the traction [Pa]; both are (components, rows, columns). tolerance: largest accepted residual.
    most: largest number of steps. The computation has the precision of `start`. Without convergence the last state is returned
    with `converged` False.
    """
    touching = _Touching(operator, strength.astype(start.dtype, copy=False))
    traction, shift = within(touching.read(start), touching.strength), touching.read(shift.astype(start.dtype, copy=False))
    total = float(touching.strength.sum())
    gradient = touching.displacement(traction) - shift
    search = _Search(touching)
    residual, steps = math.inf, 0
    for steps in range(most + 1):
        raise_if_stopped()
        wanted = within(traction - gradient / operator.of_point, touching.strength)
        residual = float(size_of(traction - wanted).sum()) / total if total > 0.0 else 0.0
        if residual <= tolerance or steps == most:
            break
        moved = search.conjugate(traction, gradient) or search.projected(traction, gradient)
        if moved is None:
            break  # round-off prevents any step that lowers the energy
        traction, gradient = moved
    return Sheared(touching.map(traction), touching.map(-gradient), residual, steps, residual <= tolerance)


class _Touching:
    """Represent the points whose strength is above 0.

    Fields at these points are stored as (components, points), which saves memory.

    strength: (rows, columns) [Pa]; the attribute of this name holds it at the points, (points,).
    """

    def __init__(self, operator: ShearOperator, strength: np.ndarray):
        self._operator, self._shape = operator, strength.shape
        self._at = np.flatnonzero(strength > 0.0)
        self.of_point, self.strength = operator.of_point, strength.ravel()[self._at]

    def read(self, field: np.ndarray) -> np.ndarray:
        """Return the values (components, points) of a field (components, rows, columns) at the points with strength."""
        return field.reshape(len(field), -1)[:, self._at]

    def map(self, values: np.ndarray) -> np.ndarray:
        """Return a field (components, rows, columns) with these values at the points with strength, and 0 elsewhere."""
        field = np.zeros((len(values), math.prod(self._shape)), dtype=values.dtype)
        field[:, self._at] = values
        return field.reshape(-1, *self._shape)

    def displacement(self, traction: np.ndarray) -> np.ndarray:
        """Return the displacement [m] that the traction [Pa] causes; both (components, points), at points with strength > 0."""
        return self.read(self._operator(self.map(traction)))

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Return the traction [Pa] that would cause a displacement [m] on a map that sticks everywhere.

        Both are (components, points). The result serves as preconditioner.
        """
        return self.read(self._operator.inverse(self.map(displacement)))


class _Search:
    """Take minimisation steps and store the previous search direction; tractions and gradients are (components, points)."""

    def __init__(self, points: _Touching):
        self.points, self.strength, self.of_point = points, points.strength, points.of_point
        self._last: tuple[np.ndarray, np.ndarray, float] | None = None

    def conjugate(self, traction, gradient):
        """Take a step along a conjugate direction; return the new traction and gradient, or None if the energy would rise."""
        outward = -np.sum(gradient * traction, axis=0)
        at = 1.0 - _AT * float(np.finfo(traction.dtype).eps)
        bound = (size_of(traction) >= self.strength * at) & (outward > 0.0)
        free = np.where(bound, 0.0, gradient)
        prepared = np.where(bound, 0.0, self.points.inverse(free))
        stiffness = np.zeros(())
        if len(traction) == 2:  # the traction of a slipping point may turn; a longer slip makes this stiffer
            stiffness = np.divide(outward, self.strength**2, out=np.zeros_like(outward), where=bound)
            turning = np.where(bound, _across(gradient, traction), 0.0)
            free += turning
            prepared += turning / (self.of_point + stiffness)
        direction = self._conjugated(-prepared, free, bound, traction)
        bent_by = self.points.displacement(direction)
        bent = float(np.sum(direction * bent_by) + np.sum(stiffness * direction * direction))
        if not bent > 0.0:
            self._last = None
            return None
        step = -float(np.sum(direction * free)) / bent
        trial = traction + step * direction
        moved = within(trial, self.strength)
        if np.array_equal(moved, trial):
            return moved, gradient + step * bent_by
        found = self._lower(traction, gradient, moved)
        if found is None:
            self._last = None  # the next direction is the gradient alone
        return found

    def projected(self, traction, gradient):
        """Take a step along the projected gradient, halved until the energy falls enough; return the new traction and gradient.

        Returns None if the energy never falls enough.
        """
        length = 1.0 / self.of_point
        for _ in range(60):
            moved = within(traction - length * gradient, self.strength)
            change = moved - traction
            enough = _ENOUGH / length * float(np.sum(change * change))
            found = self._lower(traction, gradient, moved, enough)
            if found is not None:
                return found
            length *= 0.5
        return None

    def _lower(self, traction, gradient, moved, enough: float = 0.0):
        """Return the traction `moved` and its gradient if its energy is lower by more than `enough`, otherwise None."""
        change = moved - traction
        turned = self.points.displacement(change)
        energy = float(np.sum(change * gradient) + 0.5 * np.sum(change * turned))
        return (moved, gradient + turned) if energy < -enough else None

    def _conjugated(self, direction, free, bound, traction):
        """Return the search direction (components, points), conjugate to the last direction by the rule of Polak and Ribiere.

        direction: preconditioned descent direction. free: gradient without the part that the strength blocks. bound: mask of
        points at their strength. The factor of the last direction is never negative.
        """
        descent = -float(np.sum(direction * free))
        if self._last is not None:
            before, old_free, old_descent = self._last
            share = (descent + float(np.sum(direction * old_free))) / old_descent if old_descent > 0.0 else 0.0
            if share > 0.0:
                kept = np.where(bound, _across(before, traction) if len(traction) == 2 else 0.0, before)
                combined = direction + share * kept
                if float(np.sum(combined * free)) < 0.0:
                    direction = combined
        self._last = direction, free, descent
        return direction


def _across(vectors: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Return the component of each vector (2, points) perpendicular to the vectors `along` (2, points)."""
    square = np.sum(along * along, axis=0)
    share = np.divide(np.sum(vectors * along, axis=0), square, out=np.zeros_like(square), where=square > 0.0)
    return vectors - share * along
