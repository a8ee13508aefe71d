"""Sum asperity laws at several separations, which differ between the laws, for Gaussian heights.

A law is one parameter set of a regime. Its integration nodes are placed once for all its separations, which takes a fifth of
the time that new nodes at each separation would take. The sums differ from those with new nodes by round-off only.
"""

import numpy as np

from stiction.engine.compiled import engine_kernel
from stiction.engine.heights import gaussian_density, gaussian_window
from stiction.engine.placing import Placing
from stiction.engine.starting_separations import GRID, NODE_RANGE
from stiction.engine.summation import _COUNTS, _RULES, QUANTITIES, Scattered, _slices, in_threads
from stiction.engine.tiers import ENGINE, specialised

_BLOCK = 128  # number of laws in a block; their nodes fit into the processor's cache


@engine_kernel
def _sum_each(h, laws, nodes, out):
    """Store in out[law, k] five sums over asperity heights, for n laws (parameter sets) at their separations h[law, k].

    The sums are fraction touching, load, area, slip-limited and yield-limited resistance. h: in units of sigma. laws (n,):
    indices of the laws. nodes: displacements (n, room), integration weights times each quantity (n, 5, room), and number of
    nodes of each of these laws (n,).
    """
    places, values, used = nodes
    for i in range(used.size):
        law, x, a, b, c, d, e = laws[i], places[i], values[i, 0], values[i, 1], values[i, 2], values[i, 3], values[i, 4]
        count = 8 * (used[i] // 8)
        for k in range(h.shape[1]):
            separation = h[law, k]
            touching = load = area = slip_limited = yield_limited = 0.0
            for node in range(count):
                dense = gaussian_density(separation + x[node], x)
                touching += dense * a[node]
                load += dense * b[node]
                area += dense * c[node]
                slip_limited += dense * d[node]
                yield_limited += dense * e[node]
            out[law, k, 0], out[law, k, 1], out[law, k, 2] = touching, load, area
            out[law, k, 3], out[law, k, 4] = slip_limited, yield_limited


def sums_of_each(scattered: Scattered, h: np.ndarray, threads: int = 1) -> np.ndarray:
    """Return the sums (regimes, n, m, 5) of n laws (parameter sets), each at its own m separations h (n, m).

    h: in units of sigma. The five values are averages over all asperities: fraction touching, load, area, slip-limited and
    yield-limited resistance. scattered: the regimes and the heights. threads: largest number of threads. All separations of a
    law share its nodes. Exceptions, with new nodes at each separation, are a single law, one separation per law, heights that
    are not Gaussian, and laws with a separation outside -8 to 10 sigma.
    """
    laws, each = h.shape
    sums = np.empty((len(scattered.regimes), laws, each, len(QUANTITIES)))
    if not h.size:
        return sums
    near = ((h <= GRID[0]) & (h >= GRID[-1])).all(axis=1)
    if laws == 1 or each == 1 or scattered.heights.density is not gaussian_density:
        near[:] = False
    if near.any():
        _fill(scattered, np.flatnonzero(near), h, sums, threads)
    if (rest := np.flatnonzero(~near)).size:
        single = scattered(h[rest].reshape(-1), np.repeat(rest, each), threads)
        sums[:, rest] = single.reshape(len(sums), rest.size, each, len(QUANTITIES))
    return sums


def _fill(scattered: Scattered, laws: np.ndarray, h: np.ndarray, sums: np.ndarray, threads: int) -> None:
    """Fill `sums` (regimes, n, m, 5) for some of n laws, each at its own separations, from nodes placed once for each law.

    A law is one parameter set. scattered: holds the regimes. laws (k,): indices of the laws to sum. h (n, m): separations in
    units of sigma.
    """
    ENGINE.take(len(sums) * laws.size * h.shape[1])
    w_low = max(min(regime.lowest for regime in scattered.regimes), NODE_RANGE[0])
    reach, shape = (w_low, NODE_RANGE[1], GRID[-1]), np.zeros(1)
    for regime, out in zip(scattered.regimes, sums, strict=True):
        placed = Placing.of(regime, gaussian_window, NODE_RANGE[1] - w_low, len(QUANTITIES), specialised(len(h)))

        def fill_slice(share: slice, placed: Placing = placed, out: np.ndarray = out) -> None:
            append = placed.on(_BLOCK, (_RULES, _COUNTS))
            places, values = np.empty((_BLOCK, placed.room)), np.empty((_BLOCK, len(QUANTITIES), placed.room))
            for start in range(share.start, share.stop, _BLOCK):
                rows = laws[start : min(start + _BLOCK, share.stop)]
                nodes = places, values, np.zeros(rows.size, dtype=np.int64)
                append(reach, shape, rows, nodes)
                _sum_each(h, rows, nodes, out)

        in_threads(fill_slice, _slices(laws.size, threads), threads)
