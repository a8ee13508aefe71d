"""Contact stiffness of a map at fixed contact area, from a linear system over the free points.

Free points have 0 < p < H. An approach w moves the face equally at all of them, and changes their pressure by q with C q = w.
Points that flow carry no more load, and points outside the contact touch nothing. The compliance of the map is w divided by
the mean of q. By Rayleigh's principle

    w/<q> = minimum of <q C q>/<q>^2 over all q on these points                                                           (1)

so that a small error of q changes the compliance only by its square (for rough contact: Barber 2003, Proc. R. Soc. A 459,
53). Single precision is therefore enough.
"""

import math

import numpy as np

from stiction.solvers.boundary_elements.minimise import Boundary, blocks, dot, total

_TOLERANCE = 1e-2
_MOST = 300


def stiffness_per_area(displacement: Boundary, free: np.ndarray, start: np.ndarray) -> float:
    """Return the contact stiffness per nominal area [Pa/m] at fixed contact area: change of mean pressure per approach.

    The result is NaN without elastic contact points, and infinite in full contact of half-spaces. displacement: compliance
    operator. free: mask (rows, columns) of the points in elastic contact. start: first guess of the pressure change, > 0, for
    instance the pressure.
    """
    count = int(np.count_nonzero(free))
    if not count:
        return math.nan
    rows_of = list(blocks(free.shape))
    q = np.ones(free.shape, np.float32) if count == free.size else (start * free).astype(np.float32)
    q *= np.float32(free.size / total(q))
    moved, direction, rest = displacement(q), np.zeros_like(q), np.empty_like(q)
    square = math.inf
    for _ in range(_MOST):
        level = sum(dot(moved[rows], free[rows].astype(np.float32)) for rows in rows_of) / count
        missed = 0.0
        for rows in rows_of:
            here = np.subtract(np.float32(level), moved[rows], out=rest[rows])
            here *= free[rows]
            missed += dot(here, here)
        if math.sqrt(missed / count) <= _TOLERANCE * abs(level):
            break
        stiff = displacement.inverse(rest)
        mean = sum(dot(stiff[rows], free[rows].astype(np.float32)) for rows in rows_of) / count
        last, square = square, sum(dot(rest[rows], stiff[rows]) for rows in rows_of)
        for rows in rows_of:
            here = direction[rows]
            here *= np.float32(square / last)
            here += (stiff[rows] - np.float32(mean)) * free[rows]
        answer = displacement(direction)
        length = np.float32(square / sum(dot(direction[rows], answer[rows]) for rows in rows_of))
        for rows in rows_of:
            q[rows] += length * direction[rows]
            moved[rows] += length * answer[rows]
    curvature = dot(q, moved) / free.size
    return 1.0 / curvature if curvature > 0.0 else math.inf
