"""Solve the contact of a rigid sphere with many pairs of coated bodies at once.

The equation of `sphere` depends on the bodies through the compliance of each wave alone, and is linear in it. Between the
wavenumbers _ENDS, the compliance is interpolated by polynomials. The matrices of these polynomials depend on no material. They
are computed once for each contact radius, which takes as long as 40 calls of `sphere.respond`. After that, a pair needs sums
over 210 nodes instead of up to 8,000 waves, which takes a tenth of the time of one call of `sphere.respond`. Responses differ
from those of `sphere.respond` by up to 1e-9 where films are at most 100 times as stiff as their body, and by up to 1e-5 at the
limit STIFFEST.
"""

from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from stiction.solvers.layered.compliance import Pair, compliance
from stiction.solvers.layered.sphere import response_of, right_sides, waves

# Values of x = k t between which the compliance is a polynomial, and the number of nodes of each polynomial.
_ENDS = (0.0, 0.004, 0.012, 0.03, 0.06, 0.1, 0.2, 0.3, 0.5, 0.8, 1.3, 2.0, 3.0, 4.5, 7.5, 12.0)
_NODES = 14
_PLACES = np.cos(np.pi * (np.arange(_NODES) + 0.5) / _NODES)  # positions of the nodes in their interval, -1 to 1
_WAVES = np.concatenate([0.5 * (low + high) + 0.5 * (high - low) * _PLACES for low, high in pairwise(_ENDS)])
STIFFEST = 2000.0  # largest modulus ratio of film and body; the error grows with its cube
_AT_ONCE = 32  # number of pairs solved at a time, to bound the memory


class _Sums(NamedTuple):
    """Store k sets of sums over all waves, one per node of the compliance; `_respond` combines them into equations of a sphere.

    The equations are linear in the excess compliance: the compliance divided by the compliance of half-spaces of the surface
    materials, minus 1. Each set is computed for an excess compliance of 1 at its node and 0 at all other nodes. matrix (k, n,
    n): part of the matrix of the equations. to_edge, to_edge_slope (k, n), edge (k,): the arguments of `sphere.response_of`.
    """

    matrix: np.ndarray
    to_edge: np.ndarray
    to_edge_slope: np.ndarray
    edge: np.ndarray


def respond_many(pairs: Sequence[Pair], radii: Iterable[float]) -> np.ndarray:
    """Return the 7 fields of `sphere.Response` for p pairs of bodies at r contact radii: (p, r, 7).

    radii (r,): contact radii divided by the film thickness (the same for all films).
    """
    softer = np.array([compliance(_WAVES, pair) for pair in pairs]) - 1.0
    parts = np.split(softer, range(_AT_ONCE, len(softer), _AT_ONCE))
    return np.stack([np.concatenate([_respond(part, _sums(radius)) for part in parts]) for radius in map(float, radii)], axis=1)


def _respond(softer: np.ndarray, sums: _Sums) -> np.ndarray:
    """Return the fields of `sphere.Response` (p, 7) from the excess compliances `softer` (p, k) of p pairs at k nodes."""
    nodes, size = sums.to_edge.shape
    matrix = (softer @ sums.matrix.reshape(nodes, -1)).reshape(-1, size, size)
    matrix[:, range(size), range(size)] += 1.0
    to_edge, to_edge_slope, edge = softer @ sums.to_edge, softer @ sums.to_edge_slope, softer @ sums.edge
    sides = np.empty((len(softer), size, 3))
    sides[:, :, :2], sides[:, :, 2] = right_sides(size), -to_edge
    solutions = np.moveaxis(np.linalg.solve(matrix, sides), -1, 0)
    return np.array([response_of(*each) for each in zip(*solutions, to_edge, to_edge_slope, edge, strict=True)])


@lru_cache(maxsize=32)
def _sums(radius: float) -> _Sums:
    k, weights, even, at_edge, edge_slope = waves(radius)
    to_nodes = np.linalg.inv(chebyshev.chebvander(_PLACES, _NODES - 1))
    rows = []
    for low, high in pairwise(_ENDS):
        some = slice(*np.searchsorted(k, (low * radius, high * radius)))
        places = (2.0 * k[some] / radius - low - high) / (high - low)
        weighted = weights[some] * (chebyshev.chebvander(places, _NODES - 1) @ to_nodes).T
        part, edge = even[:, some], at_edge[some]
        matrix = np.array([(part * row) @ part.T for row in weighted])
        rows.append((matrix, weighted @ (part * edge).T, weighted @ (part * edge_slope[some]).T, weighted @ edge**2))
    return _Sums(*(np.concatenate(parts) for parts in zip(*rows, strict=True)))
