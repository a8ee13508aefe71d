"""How the load answers to an approach while contact stays where it is: a linear system over the points that are free.

An increment q of the pressure that moves the face of all free points alike (0 < p < H; those that flow carry no more, those
that do not touch nothing) has C q = w on them. The compliance of a map is w over the mean of q; by Rayleigh's principle

    w/<q> = minimum of <q C q>/<q>^2 over all q on these points                                                           (1)

so that a small error of q enters with its square (for rough contact: Barber 2003, Proc. R. Soc. A 459, 53), and single
precision is enough.
"""

import math

import numpy as np

from stiction.solvers.boundary_elements.minimise import Boundary, dot, total

_TOLERANCE = 1e-2
_MOST = 300


def stiffness_per_area(displacement: Boundary, free: np.ndarray, start: np.ndarray) -> float:
    """Return the change of mean pressure with approach [Pa/m] at fixed contact.

    NaN where no point is free, infinite in full contact of unbounded half-spaces. free: points that respond, bool, of the
    map's shape; start: any positive increment, for instance the pressure.
    """
    count = int(np.count_nonzero(free))
    if not count:
        return math.nan
    q = np.ones(free.shape, np.float32) if count == free.size else (start * free).astype(np.float32)
    q *= q.dtype.type(free.size / total(q))
    moved = displacement(q)
    direction, square = None, 0.0
    for _ in range(_MOST):
        level = total(moved * free) / count
        rest = (q.dtype.type(level) - moved) * free
        if math.sqrt(dot(rest, rest) / count) <= _TOLERANCE * abs(level):
            break
        stiff = displacement.inverse(rest) * free
        stiff -= free * q.dtype.type(total(stiff) / count)
        last, square = square, dot(rest, stiff)
        direction = stiff if direction is None else stiff + q.dtype.type(square / last) * direction
        answer = displacement(direction)
        length = q.dtype.type(square / dot(direction, answer))
        q += length * direction
        moved += length * answer
    curvature = dot(q, moved) / free.size
    return 1.0 / curvature if curvature > 0.0 else math.inf
