"""Minimise the energy of faces that attract each other, over gaps >= 0.

Lengths are divided by the range of attraction and energies by the work of adhesion. K is symmetric and positive semidefinite.
The energy

    1/2 <(g + h) K (g + h)> - <e^(-g)> + P <g>,      g >= 0                                                               (1)

is reduced by conjugate gradients over the free points: points apart, and points in contact whose energy falls if they
separate (Polonsky & Keer 1999, Wear 231, 206; Bugnicourt et al. 2018, Tribology Lett. 66, 29). There are three additions.
First, directions are multiplied by 1/K and restricted to the free points; K grows with the wavevector, so long waves would
otherwise converge slowly. Second, the step is Newton's along the direction. It is shortened where the attraction makes the
energy concave, limited to twice the range where attraction acts, and halved until the energy falls. Third, if the faces are
so far apart that no attraction outweighs the tension, they are moved apart at once.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from scipy.fft import irfft2, rfft2

from stiction.solvers.boundary_elements.arrays import dot

FAR = 1e3  # gap over the range, at which faces are apart
_FLAT = 0.05  # curvature along a direction, at least this share of the elastic one: below, the attraction bends it down
_RANGE = 2.0  # no farther at once, over the range
_ACTS = 1e-3  # of the largest attraction
_MOST = 3000
_HALVINGS = 40
_NONE = 40.0  # gap over the range, beyond which the attraction is below rounding
_LARGEST = 700.0  # exponent, of a floating point number


@dataclass(frozen=True)
class Faces:
    """Store the heights and the stiffness of two faces that attract each other.

    heights (rows, columns): heights h, divided by the range of attraction. stiffness: dimensionless K of every entry of
    `rfft2`, 0 for the mean. share (rows, columns): fraction of the work of adhesion that remains; None for all of it.
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
        """Return the elastic restoring pressure of a displacement: K applied to it, (rows, columns).

        shape: displacement (rows, columns), for instance gap plus heights.
        """
        return self._through(shape, self.stiffness)

    def attraction(self, gap: np.ndarray) -> np.ndarray:
        """Return the attraction e^(-g) at the gaps g (rows, columns), times the remaining fraction of the work of adhesion."""
        whole = np.exp(-gap)
        return whole if self.share is None else self.share * whole

    def smoothed(self, force: np.ndarray) -> np.ndarray:
        """Return the force divided by the stiffness K of each wave, in single precision.

        The mean, whose stiffness is 0, is divided by half of the smallest K. Search directions need no higher precision.
        """
        return self._through(force.astype(np.float32), self._smooth).astype(float)

    def _through(self, shape: np.ndarray, factors: np.ndarray) -> np.ndarray:
        waves = rfft2(shape)
        waves *= factors
        return irfft2(waves, s=self.heights.shape, overwrite_x=True)


class DescentSearch:
    """Minimise the energy (1) of attracting faces under a mean pressure P.

    gap: current gap (rows, columns), divided by the range of attraction. residual: largest gradient of the energy among points
    that are apart and touching points under tension. apart: whether the faces have separated completely.
    """

    def __init__(self, faces: Faces, gap: np.ndarray, pressure: float):
        self._faces, self._pressure = faces, pressure
        self._way: np.ndarray | None = None
        self._force, self._square = np.zeros_like(gap), 0.0
        self.gap, self._elastic = gap, faces.elastic(gap + faces.heights)
        self.apart, self.residual = False, math.inf
        self._arrive()

    def run(self, tolerance: float) -> None:
        """Minimise until the residual is below the tolerance or no step lowers the energy."""
        for _ in range(_MOST):
            if self.residual <= tolerance:
                return
            if float(self._near.max()) < -self._pressure:
                self.gap = self.gap + FAR
                self.apart = True
                return
            if not self._step(self._direction()):
                if self._way is None:
                    return  # no step lowers the energy: rounding
                self._way = None

    def _arrive(self) -> None:
        """Compute gradient, free points and residual anew after the gap has changed."""
        self._near = self._faces.attraction(self.gap)
        self._slope = self._elastic + self._near
        self._slope += self._pressure
        self._free = (self.gap > 0.0) | (self._slope < 0.0)
        self.residual = float(np.max(np.abs(self._slope * self._free)))

    def _direction(self) -> np.ndarray:
        """Return the next search direction, preconditioned and conjugate to the last one.

        The factor is the one of Polak & Ribiere. After a failed step the direction is the preconditioned gradient.
        """
        force = np.where(self._free, -self._slope, 0.0)
        smooth = self._faces.smoothed(force)
        smooth *= self._free
        square = dot(force, smooth)
        way = smooth
        if self._way is not None:
            part = (square - dot(self._force, smooth)) / self._square
            if part > 0.0:
                way = smooth + part * np.where(self._free, self._way, 0.0)
                if dot(way, force) <= 0.0:
                    way = smooth
        self._force, self._square = force, square
        return way

    def _step(self, way: np.ndarray) -> bool:
        """Take a step along a direction; return False if no step length lowers the energy.

        The step is halved until the energy falls.
        """
        answer = self._faces.elastic(way)
        down, elastic = dot(way, self._force), dot(way, answer)
        curvature = max(elastic - float(np.einsum("ij,ij,ij->", way, way, self._near)), _FLAT * elastic)
        length = self._room(way)
        if curvature * length > down:
            length = down / curvature
        for _ in range(_HALVINGS):
            gap = self.gap + length * way
            if gap.min() < 0.0:
                np.maximum(gap, 0.0, out=gap)
                force = self._faces.elastic(gap + self._faces.heights)
            else:
                force = self._elastic + length * answer
            if self._change(gap, force) < 0.0:
                self._way, self.gap, self._elastic = way, gap, force
                self._arrive()
                return True
            length *= 0.5
        return False

    def _room(self, way: np.ndarray) -> float:
        """Return the longest allowed step along a direction.

        It closes no gap by more than the gap plus twice the range of attraction, and opens attracted points by at most twice
        the range.
        """
        closes = max(-float(np.min(way / (self.gap + _RANGE))), 0.0)
        opens = max(float(np.max(way * (self._near > _ACTS))), 0.0) / _RANGE
        fastest = max(closes, opens)
        return 1.0 / fastest if fastest > 0.0 else 1.0

    def _change(self, gap: np.ndarray, elastic: np.ndarray) -> float:
        """Return the change of the energy (1) from the current gap to another, times the number of points.

        The formula avoids differences of large numbers, which round-off would spoil near the minimum.
        """
        closed = self.gap - gap
        smooth = dot(closed, self._slope) + 0.5 * dot(closed, elastic - self._elastic)
        some = np.minimum(self.gap, gap) < _NONE
        nearer = closed[some]
        grown = np.expm1(np.minimum(nearer, _LARGEST)) - nearer
        return -smooth - float(np.sum(self._near[some] * grown))
