"""Find starting values of the separation at a given load, for Gaussian heights.

Under Gaussian heights the load at a separation h is a sum over integration nodes of a weight times exp(-(h + w)^2 / 2), where w
is the displacement at the node; h and w are in units of sigma. The nodes therefore do not depend on h and are placed once. On a
grid of equally spaced separations, the term of a node at one grid point is its term at the previous grid point times a constant
factor (a recurrence). Between grid points, the slope and curvature of the load are computed from the same exponentials as the
load.

The results are starting values. The caller refines them with the functions of `summation`, which place new nodes at each
separation.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from stiction.engine.compiled import engine_kernel, formula
from stiction.engine.heights import NEGLIGIBLE, gaussian_density, gaussian_window
from stiction.engine.placing import Placing
from stiction.engine.regime import Regime
from stiction.engine.summation import _COUNTS, _RULES
from stiction.engine.tiers import ENGINE, specialised
from stiction.engine.vectorised import exponential

# Equally spaced separations in units of sigma. Above 10 almost nothing touches, and below -8 no model is valid.
GRID = np.linspace(10.0, -8.0, 73)

# Range of the displacements, in units of sigma, that contribute to the load at any of these separations.
NODE_RANGE = -3.0 * math.sqrt(2.0 * NEGLIGIBLE) - GRID[0], 2.5 + math.sqrt(2.0 * NEGLIGIBLE) - GRID[-1]
_BLOCK = 256  # number of laws in a block; their nodes fit into the processor's cache

# Iterations end when the step is smaller than these tolerances (in sigma). The remaining error is of the order of the step
# cubed for Halley's method, and of the step squared for Newton's method.
_NEAR, _NEARER = 1e-5, 1e-7
# Both are fractions of the largest load. Loads below the first count as no contact. Tensions below the second count as no
# tension, because only heights beyond nine sigma cause them.
NOTHING, NO_TENSION = 1e-12, 1e-20
_MOST_STEPS = 60
# Plain Python takes as long for this number of sums as for the starting values of one law (see `tiers.ENGINE`).
_PAIRS = 8


@engine_kernel
def _sample(grid, w_top, nodes):
    """Compute the load of n laws (parameter sets), and its derivative, on a grid of equally spaced separations.

    grid: tuple (h, loads, slopes). h (H,): separations in units of sigma, equally spaced, in descending order. loads, slopes
    (n, H): output arrays for the load and its derivative with respect to h. w_top: displacement in units of sigma at which the
    recurrence factors are scaled to 1, to avoid overflow. nodes: displacements (n, room), weights (n, room) and number (n,) of
    integration nodes; room: largest number of nodes per law.
    """
    h, loads, slopes = grid
    place, weights, used = nodes
    step = h[0] - h[1]
    term, factor = np.empty(place.shape[1]), np.empty(place.shape[1])
    scale = np.empty(h.size)
    for k in range(h.size):
        scale[k] = math.exp(0.5 * (h[0] - h[k]) * (h[0] + h[k]) + (h[0] - h[k]) * w_top)
    for i in range(used.size):
        x, load = place[i], weights[i]
        count = 8 * (used[i] // 8)
        for node in range(count):
            term[node] = load[node] * gaussian_density(h[0] + x[node], x)
            factor[node] = exponential(step * (x[node] - w_top))
        for k in range(h.size):
            total = first = 0.0
            for node in range(count):
                total += term[node]
                first += x[node] * term[node]
                term[node] *= factor[node]
            loads[i, k] = scale[k] * total
            slopes[i, k] = -scale[k] * (first + h[k] * total)


@engine_kernel
def _sums(h, place, weights, count):
    """Return the load of one law at the separation h, its first two derivatives with respect to h, and its size.

    A law is one parameter set of an asperity law. The size is the sum of the absolute values of the terms of the load; the
    round-off is proportional to it. h: in units of sigma. place, weights: displacements in units of sigma and weights of the
    integration nodes (one array each). count: number of nodes.
    """
    total = first = second = size = 0.0
    for node in range(8 * (count // 8)):
        z = h + place[node]
        term = weights[node] * gaussian_density(z, place)
        total += term
        first += z * term
        second += z * z * term
        size += abs(term)
    return total, -first, second - total, size


@engine_kernel
def _turning_point(far, near, slope_far, slope_near, place, weights, count):
    """Return the separation between `far` and `near` at which the derivative of the load is zero.

    slope_far, slope_near: derivatives of the load with respect to the separation, at `far` (the larger separation) and at
    `near`. They must have opposite signs. All separations and displacements are in units of sigma. place, weights, count:
    displacements, weights and number of the integration nodes with which the load is summed.
    """
    x = far - (far - near) * (slope_far / (slope_far - slope_near) if slope_far != 0.0 else 0.5)
    for _ in range(_MOST_STEPS):
        _, slope, curvature, _ = _sums(x, place, weights, count)
        if (slope > 0.0) == (slope_far > slope_near):
            far = x
        else:
            near = x
        before = x
        x = before - slope / curvature
        if not near < x < far:
            x = 0.5 * (near + far)
        if abs(x - before) <= _NEARER:
            break
    return x


@engine_kernel
def _find_lowest(grid, lowest, nodes):
    """Find the largest tension (negative load) of each law (parameter set), and store it with its separation in `lowest`.

    grid: (h, loads, slopes). h (H,): grid of separations in units of sigma, in descending order. loads, slopes (n, H): loads at
    these separations, and their derivatives with respect to h. nodes: displacements, weights and numbers of the integration
    nodes of the laws. lowest: (tension, where, nearer), each (n,). tension: largest tension, 0 if the load is never negative.
    where: separation of the largest tension, else NaN. nearer: index of the first separation in h that is smaller than `where`,
    1 without tension.
    """
    h, loads, slopes = grid
    tension, where, nearer = lowest
    place, weights, used = nodes
    for i in range(used.size):
        tension[i], where[i], nearer[i] = 0.0, np.nan, 1
        largest = 0.0
        for load in loads[i]:
            largest = max(largest, abs(load))
        least = NO_TENSION * largest
        for k in range(1, h.size):
            rising, falling = slopes[i, k - 1], slopes[i, k]  # on approach the load falls, then rises
            bound = min(loads[i, k - 1], loads[i, k]) - (h[k - 1] - h[k]) * rising
            if not (rising > 0.0 >= falling and bound < -max(tension[i], least)):
                continue
            x = _turning_point(h[k - 1], h[k], rising, falling, place[i], weights[i], used[i])
            load = _sums(x, place[i], weights[i], used[i])[0]
            if load < -max(tension[i], least):
                tension[i], where[i], nearer[i] = -load, x, k
        if 0.0 < tension[i] < 100.0 * least and tension[i] <= NO_TENSION * abs(_sums(-h[0], place[i], weights[i], used[i])[0]):
            tension[i], where[i], nearer[i] = 0.0, np.nan, 1


@formula
def _between(target, far, near, load_far, load_near, slope_far, slope_near):
    """Return the separation between `far` and `near` at which the interpolated load equals `target`.

    far, near: neighbouring separations in units of sigma, far the larger. load_far, load_near, slope_far, slope_near: loads at
    both, and their derivatives with respect to the separation. A cubic is fitted to these four numbers, or to the logarithm of
    the load if the loads are compressive.
    """
    span = far - near
    if load_far > 0.0:
        slope_far, slope_near = slope_far / load_far, slope_near / load_near
        rise, wanted = math.log(load_near / load_far), math.log(target / load_far)
    else:
        rise, wanted = load_near - load_far, target - load_far
    a, b = -span * slope_far, -span * slope_near  # slopes by t, which rises from 0 at far to 1 at near
    square, cube = 3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise
    low, high, t = 0.0, 1.0, wanted / rise
    for _ in range(30):
        value = t * (a + t * (square + t * cube)) - wanted
        if value < 0.0:
            low = t
        else:
            high = t
        before = t
        t -= value / (a + t * (2.0 * square + t * 3.0 * cube))
        if not low < t < high:
            t = 0.5 * (low + high)
        if abs(t - before) <= 1e-7:
            break
    return far - span * t


@engine_kernel
def _root(target, far, near, x, place, weights, count):
    """Find the separation at which the load equals `target`; return it with the slope and the size of the load there.

    Halley's method starts at the separation x and stays between the separations `far` and `near`, all in units of sigma. slope:
    derivative of the load with respect to the separation. size: sum of the absolute values of the terms of the load. place,
    weights, count: displacements, weights and number of the integration nodes with which the load is summed.
    """
    slope = size = 0.0
    for _ in range(_MOST_STEPS):
        load, slope, curvature, size = _sums(x, place, weights, count)
        excess = load - target
        if excess < 0.0:
            far = x
        else:
            near = x
        before = x
        x = before - excess / (slope - 0.5 * excess * curvature / slope)
        if not near <= x <= far:
            x = 0.5 * (near + far)
        slope += (x - before) * curvature
        if abs(x - before) <= _NEAR:
            break
    return x, slope, size


@engine_kernel
def _carried(h, loads, slopes, start, first, most, bound, unsure):
    """Store in `most`, `bound` and `unsure` (H,) how the load may vary on approach, beginning at grid point `start`.

    h, loads, slopes (H,): separations in units of sigma, in descending order, the loads at them, and the derivatives of these
    loads with respect to h. first: (separation, load, slope) of the point before grid point `start`. most: largest load at the
    grid points so far. bound: upper bound of the load so far, also between grid points. unsure: True if the load rises on
    approach at both ends of an interval, but the cubic between them may not be monotonic (criterion of Fritsch & Carlson 1980).
    """
    most[:start], bound[:start] = -np.inf, -np.inf
    for k in range(start, h.size):
        far, before, slope = first if k == start else (h[k - 1], loads[k - 1], slopes[k - 1])
        most[k] = max(most[k - 1], loads[k])
        steepest, rise = (far - h[k]) * max(abs(slopes[k]), -slope), loads[k] - before
        squares = (far - h[k]) ** 2 * (slope * slope + slopes[k] * slopes[k])
        unsure[k] = slopes[k] <= 0.0 and slope <= 0.0 and not squares <= 9.0 * rise * rise
        peaks = unsure[k] or slopes[k] > 0.0 >= slope
        bound[k] = max(bound[k - 1], max(before, loads[k]) + (steepest if peaks else 0.0))


@formula
def _first_not_below(ascending, value):
    """Return the index of the first element of `ascending` that is not below `value`; its length if all are below.

    This replaces `searchsorted`, which takes about a second to compile.
    """
    low, high = 0, ascending.size
    while low < high:
        middle = (low + high) // 2
        if ascending[middle] < value:
            low = middle + 1
        else:
            high = middle
    return low


@engine_kernel
def _find_roots(grid, lowest, targets, nodes, roots):
    """Find the separation at which each law i (parameter set) carries the load targets[i, k], and store it in roots[i, k].

    roots[i, k] receives the separation in units of sigma, the derivative of the load with respect to the separation, and the
    sum of the absolute values of the terms of the load. All three are NaN if the load is not reached on the grid, or if two
    such separations may be too close together for the grid to resolve them. If more than one separation carries the load, the
    first on approach is stored. The approach starts at the separation of the largest tension, or at the far end of the grid if
    the law has no tension. grid, lowest, nodes: as in `_find_lowest`.
    """
    h, loads, slopes = grid
    tension, where, nearer = lowest
    place, weights, used = nodes
    most, bound, unsure = np.empty(h.size), np.empty(h.size), np.empty(h.size, dtype=np.bool_)
    for i in range(used.size):
        start = nearer[i]
        first = h[start - 1], loads[i, start - 1], slopes[i, start - 1]
        if tension[i] > 0.0:
            first = where[i], -tension[i], 0.0
        _carried(h, loads[i], slopes[i], start, first, most, bound, unsure)
        for k in range(targets.shape[1]):
            target = targets[i, k]
            roots[i, k, :] = np.nan
            index, sooner = _first_not_below(most, target), _first_not_below(bound, target)
            if sooner == h.size or not target >= first[1] - _NEARER * tension[i]:
                continue
            near, load_near, slope_near = 0.0, -np.inf, 0.0
            # The load may reach the target at a peak between two grid points at which it is smaller.
            while sooner < index and load_near < target and not unsure[sooner]:
                far, slope = (first[0], first[2]) if sooner == start else (h[sooner - 1], slopes[i, sooner - 1])
                if slopes[i, sooner] > 0.0 >= slope:
                    near = _turning_point(far, h[sooner], slope, slopes[i, sooner], place[i], weights[i], used[i])
                    load_near = _sums(near, place[i], weights[i], used[i])[0]
                sooner += 1
            if load_near >= target:
                index = sooner - 1
            elif sooner >= index and index < h.size and not unsure[index]:
                near, load_near, slope_near = h[index], loads[i, index], slopes[i, index]
            else:
                continue
            far, load_far, slope_far = first if index == start else (h[index - 1], loads[i, index - 1], slopes[i, index - 1])
            x, slope, size = far, slope_far, abs(load_far)
            if target > load_far:
                x = _between(target, far, near, load_far, load_near, slope_far, slope_near)
                x, slope, size = _root(target, far, near, x, place[i], weights[i], used[i])
            roots[i, k, 0], roots[i, k, 1], roots[i, k, 2] = x, slope, size


@dataclass(frozen=True)
class Starts:
    """Store starting values of the separation for n laws (parameter sets) at m loads each; NaN if no value was found.

    tension (n,): largest tensile load (> 0), 0 without tension. where (n,): separation of the largest tension. h (n, m):
    separations at the loads. All separations are in units of sigma. slope (n, m): derivative of the load with respect to h, at
    h. size (n, m): sum of the absolute values of the terms of the load, at h. covers_approach (n,): whether the grid of
    separations reaches from negligible load to a compressive load of at least the largest tension.
    """

    tension: np.ndarray
    where: np.ndarray
    h: np.ndarray
    slope: np.ndarray
    size: np.ndarray
    covers_approach: np.ndarray


class Approach:
    """Find starting values of the separations at which n laws (parameter sets) carry given loads (Gaussian heights).

    regimes: smooth parts of an asperity's behaviour, each for the n laws. The loads on a grid of separations are computed
    before the requested loads are known; with few laws they are reused in later calls.
    """

    def __init__(self, regimes: Sequence[Regime]):
        self._regimes, self._laws = regimes, len(regimes[0].edges)
        self._lowest: tuple[np.ndarray, np.ndarray, np.ndarray] | None = None

    @property
    def lowest(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return three arrays (n,): largest tension, its separation, and whether the grid covers the whole approach.

        The separation is in units of sigma. Laws without tension have the tension 0 and the separation NaN.
        """
        if self._lowest is None:
            self.starts(np.empty((self._laws, 0)))
        assert self._lowest is not None
        return self._lowest

    def starts(self, targets: np.ndarray) -> Starts:
        """Return starting values for the separations at which n laws carry given loads.

        targets (n, m): m loads for each law. Separations are in units of sigma and accurate to about 1e-9. A separation is NaN
        if none was found. The other results are described in `Starts`.
        """
        targets = np.ascontiguousarray(targets)
        tension, where = np.empty((2, self._laws))
        roots, covers_approach = np.empty((*targets.shape, 3)), np.empty(self._laws, dtype=np.bool_)
        for some, nodes, grid, lowest in [self._only_block] if self._laws <= _BLOCK else self._blocks():
            tension[some], where[some], covers_approach[some] = lowest[0], lowest[1], _covers_approach(grid[1], lowest[0])
            _find_roots(grid, lowest, targets[some], nodes, roots[some])
        self._lowest = tension, where, covers_approach
        return Starts(tension, where, roots[:, :, 0], roots[:, :, 1], roots[:, :, 2], covers_approach)

    @cached_property
    def _only_block(self) -> tuple:
        (block,) = self._blocks()
        return block

    def _blocks(self) -> Iterator[tuple]:
        """Compute the load on the grid of separations for blocks of laws (parameter sets), and yield the blocks one by one.

        Yields the slice of the laws; their integration nodes; the grid with loads and slopes (see `_sample`); and their largest
        tensions (see `_find_lowest`). The arrays of a block are overwritten when the next block is computed.
        """
        w_low = max(min(regime.lowest for regime in self._regimes), NODE_RANGE[0])
        ENGINE.take(_PAIRS * len(self._regimes) * self._laws)
        alone, most = specialised(self._laws), min(_BLOCK, max(self._laws, 1))
        placing = [Placing.of(regime, gaussian_window, NODE_RANGE[1] - w_low, 1, alone) for regime in self._regimes]
        room, shape = sum(placed.room for placed in placing), np.zeros(1)
        place, weights = np.empty((most, room)), np.empty((most, 1, room))
        loads, slopes = np.empty((2, most, GRID.size))
        appenders = [placed.on(most, (_RULES, _COUNTS)) for placed in placing]
        for start in range(0, max(self._laws, 1), most):
            some = slice(start, min(start + most, self._laws))
            count = some.stop - some.start
            used, nearer = np.zeros((2, count), dtype=np.int64)
            nodes, grid = (place, weights[:, 0], used), (GRID, loads[:count], slopes[:count])
            lowest = (*np.empty((2, count)), nearer)
            for append in appenders:
                append((w_low, NODE_RANGE[1], GRID[-1]), shape, some, (place, weights, used))
            _sample(grid, NODE_RANGE[1], nodes)
            _find_lowest(grid, lowest, nodes)
            yield some, nodes, grid, lowest


def _covers_approach(loads: np.ndarray, tension: np.ndarray) -> np.ndarray:
    """Return, for each of n laws (parameter sets), whether the grid of separations covers the whole approach: (n,).

    Three conditions must hold: the load at the far end is negligible, the largest tension is not at the far end, and the load
    at the near end is at least the largest tension. loads (n, H): loads on the grid, far end first. tension (n,): largest
    tension.
    """
    lowest = loads.min(axis=1)
    size, farthest = np.maximum(loads.max(axis=1), -lowest), loads[:, 0]
    apart = (np.abs(farthest) <= NOTHING * size) & ((farthest >= -NO_TENSION * size) | (farthest > lowest))
    return apart & (loads[:, -1] >= tension)
