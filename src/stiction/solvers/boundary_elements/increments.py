"""Compute the contact stiffness of a map at fixed contact area, from a linear system over the free points.

Free points have a pressure p between 0 and the hardness H. An approach w moves the face equally at all of them, and changes
their pressure by q with C q = w (C: compliance operator). Points with p = H carry no more load, and points outside the contact
carry none. The compliance of the map is w divided by the mean <q>. By Rayleigh's principle

    w/<q> = minimum of <q C q>/<q>^2 over all q on these points                                                           (1)

so that a small error of q changes the compliance only by its square (for rough contact: Barber 2003, Proc. R. Soc. A 459, 53).
Single precision is therefore enough.
"""

import math

import numpy as np

from stiction.solvers.boundary_elements.arrays import blocks, dot, namespace, total
from stiction.solvers.boundary_elements.minimise import Boundary

_TOLERANCE = 1e-2
_MOST = 300


def stiffness_per_area(displacement: Boundary, free: np.ndarray, start: np.ndarray) -> float:
    """Return the contact stiffness per nominal area [Pa/m] at fixed contact area: change of mean pressure per approach.

    displacement: compliance operator, from pressure to displacement. free: mask (rows, columns) of the points in elastic
    contact. start: first guess of the pressure change (rows, columns), > 0, for instance the pressure. The result is NaN
    without elastic contact points, and infinite in full contact of half-spaces.
    """
    xp, points = namespace(start), math.prod(start.shape)
    count = int(xp.count_nonzero(free))
    if not count:
        return math.nan
    rows_of = list(blocks(free))
    mask = xp.astype(free, xp.float32)
    q = xp.ones_like(mask) if count == points else xp.astype(start * mask, xp.float32)
    q *= points / total(q)
    moved, direction, rest = displacement(q), xp.zeros_like(q), xp.empty_like(q)
    square = math.inf
    for _ in range(_MOST):
        level = sum(dot(moved[rows], mask[rows]) for rows in rows_of) / count
        missed = 0.0
        for rows in rows_of:
            rest[rows] = (level - moved[rows]) * mask[rows]
            missed += dot(rest[rows], rest[rows])
        if math.sqrt(missed / count) <= _TOLERANCE * abs(level):
            break
        stiff = displacement.inverse(rest)
        mean = sum(dot(stiff[rows], mask[rows]) for rows in rows_of) / count
        last, square = square, sum(dot(rest[rows], stiff[rows]) for rows in rows_of)
        for rows in rows_of:
            here = direction[rows]
            here *= square / last
            here += (stiff[rows] - mean) * mask[rows]
        answer = displacement(direction)
        length = square / sum(dot(direction[rows], answer[rows]) for rows in rows_of)
        for rows in rows_of:
            q[rows] += length * direction[rows]
            moved[rows] += length * answer[rows]
    curvature = dot(q, moved) / points
    return 1.0 / curvature if curvature > 0.0 else math.inf
