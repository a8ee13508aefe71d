"""Minimise the energy of faces that attract each other, over gaps >= 0.

Lengths are divided by the range of attraction and energies by the work of adhesion per area. g is the gap, h the heights, P the
mean pressure, and <> the mean over the map. The stiffness K, which gives the elastic pressure of a displacement, is symmetric
and positive semidefinite. The energy

    1/2 <(g + h) K (g + h)> - <e^(-g)> + P <g>,      g >= 0                                                               (1)

is reduced by conjugate gradients over the free points (Polonsky & Keer 1999, Wear 231, 206; Bugnicourt et al. 2018, Tribology
Lett. 66, 29). Free points are out of contact, or in contact where separation lowers the energy. Three steps
are added to this method. First, directions are multiplied by 1/K and restricted to the free points; K grows with the
wavevector, so long waves would otherwise converge slowly. Second, the step is Newton's along the direction. It is shortened
where the attraction makes the energy concave, limited to twice the range where attraction acts, and halved until the energy
falls. Third, if the faces are so far apart that no attraction outweighs the tension, they are moved apart at once.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from scipy.fft import irfft2, rfft2

from stiction.solvers.boundary_elements.arrays import dot

FAR = 1e3  # distance by which separated faces are moved apart, divided by the range of attraction
_FLAT = 0.05  # least curvature along a direction, relative to the elastic curvature; attraction makes it smaller or negative
_RANGE = 2.0  # largest step, divided by the range of attraction
_ACTS = 1e-3  # attraction, divided by the largest attraction, above which a point counts as attracted
_MOST = 3000
_HALVINGS = 40
_NONE = 40.0  # gap, divided by the range, beyond which the attraction is below round-off
_LARGEST = 700.0  # largest exponent whose exponential is a finite number


@dataclass(frozen=True)
class Faces:
    """Store the combined heights and the combined stiffness of two faces that attract each other.

    heights (rows, columns): heights divided by the range of attraction. stiffness: dimensionless stiffness (elastic pressure
    per displacement) of each wave, in the order of `rfft2`; 0 for the mean. share (rows, columns): fraction of the work of
    adhesion that acts at each point, for example after shear has lowered it; None if it is 1 everywhere.
    """

    heights: np.ndarray
    stiffness: np.ndarray
    share: np.ndarray | None = None
    _smooth: np.ndarray = field(init=False, repr=False)

    def __post_init__(self) -> None:
        inverse = self.stiffness.copy()
        inverse[0, 0] = 0.5 * min(inverse[0, 1], inverse[1, 0])
        object.__setattr__(self, "_smooth", (1.0 / inverse).astype(np.float32))

    def elastic(self, shape: np.ndarray) -> np.ndarray:
        """Return the elastic restoring pressure (rows, columns) of a displacement, divided by the largest attraction.

        shape: displacement (rows, columns), divided by the range of attraction, for instance gap plus heights.
        """
        return self._through(shape, self.stiffness)

    def attraction(self, gap: np.ndarray) -> np.ndarray:
        """Return the attraction at the gaps g (rows, columns): e^(-g) times the remaining fraction of the work of adhesion.

        Gaps are divided by the range of attraction, and the result by the largest attraction.
        """
        whole = np.exp(-gap)
        return whole if self.share is None else self.share * whole

    def smoothed(self, force: np.ndarray) -> np.ndarray:
        """Return the displacement (rows, columns): each wave of a pressure map divided by its stiffness.

        force: pressure map (rows, columns). The mean, whose stiffness is 0, is divided by half of the smallest stiffness. The
        transforms have single precision, which is enough for search directions; the result is float64.
        """
        return self._through(force.astype(np.float32), self._smooth).astype(float)

    def _through(self, shape: np.ndarray, factors: np.ndarray) -> np.ndarray:
        waves = rfft2(shape)
        waves *= factors
        return irfft2(waves, s=self.heights.shape, overwrite_x=True)


class DescentSearch:
    """Minimise the energy of two attracting faces under a mean pressure, over gaps >= 0.

    The energy is (1) of this module: elastic energy, minus attraction, plus work of the pressure. pressure: mean pressure
    divided by the largest attraction, < 0 if it pulls. gap: current gap (rows, columns), divided by the range of attraction.
    residual: largest gradient of the energy among points that are apart and touching points that should open. apart: whether
    the faces have separated completely.
    """

    def __init__(self, faces: Faces, gap: np.ndarray, pressure: float):
        self._faces, self._pressure = faces, pressure
        self._previous: np.ndarray | None = None
        self._force, self._square = np.zeros_like(gap), 0.0
        self.gap, self._elastic = gap, faces.elastic(gap + faces.heights)
        self.apart, self.residual = False, math.inf
        self._arrive()

    def run(self, tolerance: float) -> None:
        """Reduce the energy until the residual is below the tolerance, the faces have separated, or no step lowers the energy.

        At most 3000 steps are taken. The result is in the attributes gap, residual and apart.
        """
        for _ in range(_MOST):
            if self.residual <= tolerance:
                return
            if float(self._near.max()) < -self._pressure:
                self.gap = self.gap + FAR
                self.apart = True
                return
            if not self._step(self._direction()):
                if self._previous is None:
                    return  # only round-off prevents a lower energy
                self._previous = None

    def _arrive(self) -> None:
        """Recompute gradient, free points and residual after the gap has changed."""
        self._near = self._faces.attraction(self.gap)
        self._slope = self._elastic + self._near
        self._slope += self._pressure
        self._free = (self.gap > 0.0) | (self._slope < 0.0)
        self.residual = float(np.max(np.abs(self._slope * self._free)))

    def _direction(self) -> np.ndarray:
        """Return the next search direction (rows, columns), preconditioned and conjugate to the last direction.

        The last direction is weighted by the rule of Polak & Ribiere. At the first step, after a failed step, or if the weight
        is not positive or the sum does not lower the energy, the direction is the preconditioned negative gradient.
        """
        force = np.where(self._free, -self._slope, 0.0)
        smooth = self._faces.smoothed(force)
        smooth *= self._free
        square = dot(force, smooth)
        direction = smooth
        if self._previous is not None:
            part = (square - dot(self._force, smooth)) / self._square
            if part > 0.0:
                direction = smooth + part * np.where(self._free, self._previous, 0.0)
                if dot(direction, force) <= 0.0:
                    direction = smooth
        self._force, self._square = force, square
        return direction

    def _step(self, direction: np.ndarray) -> bool:
        """Take a step along `direction` (rows, columns); return False if no step length lowers the energy.

        The step is halved until the energy falls.
        """
        answer = self._faces.elastic(direction)
        down, elastic = dot(direction, self._force), dot(direction, answer)
        curvature = max(elastic - float(np.einsum("ij,ij,ij->", direction, direction, self._near)), _FLAT * elastic)
        length = self._room(direction)
        if curvature * length > down:
            length = down / curvature
        for _ in range(_HALVINGS):
            gap = self.gap + length * direction
            if gap.min() < 0.0:
                np.maximum(gap, 0.0, out=gap)
                force = self._faces.elastic(gap + self._faces.heights)
            else:
                force = self._elastic + length * answer
            if self._change(gap, force) < 0.0:
                self._previous, self.gap, self._elastic = direction, gap, force
                self._arrive()
                return True
            length *= 0.5
        return False

    def _room(self, direction: np.ndarray) -> float:
        """Return the largest allowed factor of `direction` (rows, columns) in one step.

        A step reduces no gap by more than the gap itself plus twice the range of attraction, and increases the gaps of
        attracted points by at most twice the range.
        """
        closes = max(-float(np.min(direction / (self.gap + _RANGE))), 0.0)
        opens = max(float(np.max(direction * (self._near > _ACTS))), 0.0) / _RANGE
        fastest = max(closes, opens)
        return 1.0 / fastest if fastest > 0.0 else 1.0

    def _change(self, gap: np.ndarray, elastic: np.ndarray) -> float:
        """Return the change of the energy from the current gap to the gap `gap` (rows, columns), times the number of points.

        elastic: elastic pressure at `gap`. The formula avoids differences of large numbers, which round-off would spoil near
        the minimum.
        """
        closed = self.gap - gap
        smooth = dot(closed, self._slope) + 0.5 * dot(closed, elastic - self._elastic)
        some = np.minimum(self.gap, gap) < _NONE
        nearer = closed[some]
        grown = np.expm1(np.minimum(nearer, _LARGEST)) - nearer
        return -smooth - float(np.sum(self._near[some] * grown))
