"""Place integration nodes, evaluate a law there and sum, in separate stages that compile quickly.

Only two short loops are compiled for each regime (a smooth part of an asperity's behaviour), by `evaluating` and `inverting`.
The other stages work for every law: `cutting` finds the parts of segments that contribute, `place_nodes` puts Gauss-Legendre
nodes on them, and `adding` sums the values of the law. `placing` does the same for many separations at once. The single loop of
`sum_kernels.scattering` runs faster but takes six times as long to compile.

A "law" is one parameter set of a regime, a "segment" is the range between two neighbouring edges of a regime. Compiled loops
take `parts` as the plain tuple of arrays of `Parts`.
"""

import math
from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from stiction.engine.compiled import engine_kernel, lazy_kernel, unpack
from stiction.engine.regime import Regime, columns
from stiction.engine.sum_kernels import LONGEST, SHORT, clipping, map_segment

_BLOCK = 1024  # number of laws in a block; their values fit into the processor's cache
# Nodes and weights (rules, 2, longest) on [0, 1] of each integration rule, and their number (rules,).
Rules = tuple[np.ndarray, np.ndarray]


class Laws(NamedTuple):
    """Store the arrays of a regime for n parameter sets, as arguments of compiled loops.

    table (n, p): parameters. edges (n, m + 1): coordinates of the ends of the segments. branch (n, b): coordinates near which
    the resistance varies as the square root of the distance. two_sided: True if this holds on both sides of each coordinate,
    False if only above it (then b = 1).
    """

    table: np.ndarray
    edges: np.ndarray
    branch: np.ndarray
    two_sided: bool

    @classmethod
    def of(cls, regime: Regime) -> "Laws":
        """Return the arrays of a regime; if the regime has no branch points, `branch` is -inf."""
        edges = np.ascontiguousarray(regime.edges)
        branch = np.full(len(edges), -np.inf) if regime.branch is None else np.ascontiguousarray(regime.branch)
        two_sided = branch.ndim == 2
        return cls(columns(regime.parameters, len(edges)), edges, branch if two_sided else branch[:, None], two_sided)

    def some(self, rows: slice) -> "Laws":
        """Return the `Laws` of the parameter sets in the slice `rows`."""
        return Laws(self.table[rows], self.edges[rows], self.branch[rows], self.two_sided)


class Parts(NamedTuple):
    """Store k integration intervals; each lies within one segment of a regime and gets its own nodes.

    law (k,): index of the parameter set of the regime. owner (k,): index of the sum to which the interval contributes. ends (k,
    2): ends in the coordinate u of the law. end_w (k, 2): displacement at each end, from which `ends` is computed later; NaN if
    the interval ends where the segment ends. rule (k,): index of the integration rule. at_knot (k,): True if the interval
    starts at a knot of the height density, a height at which the density is not smooth.
    """

    law: np.ndarray
    owner: np.ndarray
    ends: np.ndarray
    end_w: np.ndarray
    rule: np.ndarray
    at_knot: np.ndarray

    @classmethod
    def room(cls, size: int) -> "Parts":
        """Return a Parts object with uninitialised arrays for `size` intervals."""
        law, owner, rule = np.empty((3, size), dtype=np.int64)
        ends, end_w = np.empty((2, size, 2))
        return cls(law, owner, ends, end_w, rule, np.empty(size, dtype=np.bool_))


class Evaluated(NamedTuple):
    """Store the values of a law at integration nodes, in r rows of at most LONGEST nodes.

    owner (r,): index of the sum to which the row is added. counts (r,): number of nodes. weights (r, LONGEST): integration
    weights. states (r, 6 LONGEST): displacement, its derivative with respect to the coordinate, load, area, slip-limited and
    yield-limited resistance, LONGEST elements for each.
    """

    owner: np.ndarray
    counts: np.ndarray
    weights: np.ndarray
    states: np.ndarray


@cache
def evaluating(along: Callable, parameters: int, values: int = 6) -> Any:
    """Return a compiled loop that evaluates an asperity law at integration nodes.

    along: formula of the law, along(u, *parameters) -> six values at the coordinate u, as in `Regime`. parameters: number of
    parameters of the law. values: how many of the six values are stored, the first 4 or all.
    """

    @lazy_kernel(worth=400_000)
    def evaluate(u, law, count, table, out):
        """Store in out[i] the values of the parameter set law[i] at the coordinates u[i, :count[i]].

        law (r,): index of the parameter set, a row of `table`. count (r,): number of coordinates; it is rounded down here to a
        multiple of eight. Each quantity of the law fills LONGEST elements of the row out[i]. With this fixed distance the
        compiler can prove that the stores do not overlap, and vectorises the loop.
        """
        for i in range(law.size):
            places, row, filled = u[i], unpack(table[law[i]], parameters), out[i]
            for node in range(8 * (count[i] // 8)):
                state = along(float(places[node]), *row)
                filled[node] = state[0]
                filled[LONGEST + node] = state[1]
                filled[2 * LONGEST + node] = state[2]
                filled[3 * LONGEST + node] = state[3]
                if values == 6:
                    filled[4 * LONGEST + node] = state[4]
                    filled[5 * LONGEST + node] = state[5]

    return evaluate


@cache
def inverting(coordinate: Callable, parameters: int) -> Any:
    """Return a compiled loop that computes the coordinates u of a law at given displacements.

    coordinate: formula coordinate(displacement, *parameters) -> u, as in `Regime`. parameters: number of parameters of the law.
    """

    @lazy_kernel(worth=10_000)
    def invert(w, law, table, out):
        for i in range(w.size):
            out[i] = coordinate(float(w[i]), *unpack(table[law[i]], parameters))

    return invert


def displacements(regime: Regime, laws: Laws) -> np.ndarray:
    """Return the displacements (n, m + 1), in units of sigma, at the edges of a regime with n parameter sets."""
    return np.ascontiguousarray(values_at(regime.along, laws.table, laws.edges)[:, 0])


def values_at(along: Callable, table: np.ndarray, u: np.ndarray, values: int = 6) -> np.ndarray:
    """Return the values (n, values, k) of n laws (parameter sets) at the coordinates u (n, k).

    along: formula of the law; the first 4 or all 6 of its values are returned: displacement, its derivative with respect to u,
    load, area, slip-limited and yield-limited resistance. table (n, p): parameters.
    """
    evaluate, result = evaluating(along, table.shape[1], values), np.empty((len(u), values, u.shape[1]))
    out, eight = np.empty((min(len(u), _BLOCK), values * LONGEST)), np.empty((min(len(u), _BLOCK), 8))
    law, count = np.arange(len(out)), np.full(len(out), 8)
    for start in range(0, len(u), _BLOCK):
        rows = slice(start, start + _BLOCK)
        for first in range(0, u.shape[1], 8):
            some = u[rows, first : first + 8]
            laws, columns = some.shape
            eight[:laws, :columns] = some
            eight[:laws, columns:] = some[:, -1:]  # padded, because the loop evaluates eight at a time
            evaluate(eight[:laws], law[:laws], count, table[rows], out)
            result[rows, :, first : first + columns] = out[:laws].reshape(-1, values, LONGEST)[:, :, :columns]
    return result


@cache
def cutting(window: Callable) -> Any:
    """Return a compiled loop that finds, for each separation, the parts of segments where the height density is not negligible.

    window: formula that limits an interval to heights that are not negligible, as in `Heights`.
    """

    clip = clipping(window)

    @engine_kernel
    def cut(h, law, heights, laws, parts):
        """Fill `parts` with the intervals of the parameter set law[i] at the separation h[i], and return their number.

        h, law (m,): separation in units of sigma and index of the parameter set of each sum. heights: parameters of the
        density, and heights at which it is not smooth. laws: edges of the segments and displacements at them, (n, m + 1) each.
        parts: fields of `Parts`; the owner of an interval is i.
        """
        (_, knots), (edges, displaced), (laws_of, owner, ends, end_w, rule, at_knot) = heights, laws, parts
        used = 0
        for i in range(h.size):
            for segment in range(edges.shape[1] - 1):
                left, right = edges[law[i], segment], edges[law[i], segment + 1]
                if not right > left:
                    continue
                z_left, z_right = h[i] + displaced[law[i], segment], h[i] + displaced[law[i], segment + 1]
                z_low, z_high, first, last = clip(z_left, z_right, heights)
                if not z_high > z_low:
                    continue
                w_low = math.nan if z_low == z_left else z_low - h[i]
                for knot in range(first, last + 1):
                    z_cut = z_high if knot == last else knots[knot]
                    w_high = math.nan if knot == last and z_high == z_right else z_cut - h[i]
                    laws_of[used], owner[used] = law[i], i
                    ends[used, 0], ends[used, 1], end_w[used, 0], end_w[used, 1] = left, right, w_low, w_high
                    rule[used] = 0 if z_cut - z_low <= SHORT else 1
                    at_knot[used] = 0 < knot and knots[knot - 1] == z_low
                    used += 1
                    w_low, z_low = w_high, z_cut
        return used

    return cut


@engine_kernel
def place_nodes(parts, branch, two_sided, rules, nodes):
    """Fill `nodes` with the coordinates and weights of all integration intervals, and return the number of filled rows.

    parts: fields of `Parts`, the intervals. branch (n, b): coordinates of each parameter set near which the nodes are denser,
    because the resistance varies as the square root of the distance there. two_sided: whether an interval may also end at such
    a coordinate. rules: nodes and weights on [0, 1], and their numbers. nodes: fields of `Rows`.
    """
    (law, owner, ends, _, rule, at_knot), (rule_table, counts) = parts, rules
    u, weights, row_law, row_owner, row_count, _ = nodes
    used = 0
    for i in range(law.size):
        low, high = ends[i, 0], ends[i, 1]
        if not high > low:
            continue
        linear, square = 0.0, high - low
        if not at_knot[i]:
            linear, square = map_segment(low, high, branch[law[i]], two_sided)
        x, weight, count = rule_table[rule[i], 0], rule_table[rule[i], 1], counts[rule[i]]
        for first in range(0, count, LONGEST):
            row_law[used], row_owner[used], row_count[used] = law[i], owner[i], min(LONGEST, count - first)
            for node in range(row_count[used]):
                t = x[first + node]
                u[used, node] = low + t * (linear + square * t)
                weights[used, node] = weight[first + node] * (linear + 2.0 * square * t)
            used += 1
    return used


class Rows(NamedTuple):
    """Store r rows of at most LONGEST integration nodes, which `place_nodes` and `evaluating` fill.

    u, weights (r, LONGEST): coordinates and integration weights. law, owner, counts (r,): index of the parameter set, index of
    the sum to which the row is added, number of nodes. states (r, 6 LONGEST): the six values of the law, LONGEST elements for
    each.
    """

    u: np.ndarray
    weights: np.ndarray
    law: np.ndarray
    owner: np.ndarray
    counts: np.ndarray
    states: np.ndarray

    @classmethod
    def room(cls, parts: int, rules: Rules) -> "Rows":
        """Return uninitialised arrays with enough rows for the nodes of `parts` integration intervals."""
        rows = parts * -(-int(rules[1].max()) // LONGEST)
        u, weights = np.empty((2, rows, LONGEST))
        law, owner, count = np.empty((3, rows), dtype=np.int64)
        return cls(u, weights, law, owner, count, np.empty((rows, 6 * LONGEST)))


def evaluate_parts(regime: Regime, laws: Laws, parts: Parts, used: int, rules: Rules, rows: Rows) -> Evaluated:
    """Evaluate a regime at the integration nodes of the first `used` intervals in `parts`, and return the values.

    laws: the arrays of the regime's parameter sets. rules: nodes and weights on [0, 1], and their numbers. rows: work arrays;
    the result refers to their memory.
    """
    parts = Parts(*(array[:used] for array in parts))
    _settle(regime, laws, parts)
    count = place_nodes(tuple(parts), laws.branch, laws.two_sided, rules, tuple(rows))
    u, weights, law, owner, counts, states = (array[:count] for array in rows)
    evaluating(regime.along, laws.table.shape[1])(u, law, counts, laws.table, states)
    return Evaluated(owner, counts, weights, states)


def _settle(regime: Regime, laws: Laws, parts: Parts) -> None:
    """Convert interval ends given as displacements to coordinates u, and store the coordinates in `parts.ends`."""
    w, coordinates = np.empty((2, parts.end_w.size))
    law, place = np.empty((2, parts.end_w.size), dtype=np.int64)
    count = list_end_displacements(tuple(parts), w, law, place)
    inverting(regime.coordinate, laws.table.shape[1])(w[:count], law[:count], laws.table, coordinates)
    put_ends(coordinates, place[:count], parts.ends)


@engine_kernel
def list_end_displacements(parts, w, law, place):
    """List the interval ends that are given as displacements (not NaN in `Parts.end_w`), and return how many there are.

    parts: fields of `Parts`. For each such end the output arrays receive: w: displacement in units of sigma; law: index of the
    parameter set; place: 2 i for the start of interval i, 2 i + 1 for its end.
    """
    law_of, _, _, end_w, _, _ = parts
    used = 0
    for i in range(law_of.size):
        for end in range(2):
            if not math.isnan(end_w[i, end]):
                w[used], law[used], place[used] = end_w[i, end], law_of[i], 2 * i + end
                used += 1
    return used


@engine_kernel
def put_ends(coordinates, place, ends):
    """Store the computed `coordinates` (k,) as ends of integration intervals, clipped to the segments of the intervals.

    place (k,): where each coordinate belongs: 2 i for the start of interval i, 2 i + 1 for its end. ends (intervals, 2): on
    input the ends of the segments, on output the ends of the intervals.
    """
    for j in range(place.size):
        i, end = place[j] // 2, place[j] % 2
        ends[i, end] = max(ends[i, 0], coordinates[j]) if end == 0 else min(ends[i, 1], coordinates[j])


@cache
def adding(density: Callable) -> Any:
    """Return a compiled loop that sums the values of asperity laws at integration nodes, weighted by a height density.

    density: formula density(z, shape) of the height z in units of sigma.
    """

    @engine_kernel
    def add(h, shape, evaluated, out):
        """Store m sums in `out` (m, 5): fraction touching, load, area, slip-limited and yield-limited resistance.

        h (m,): mean separation of each sum in units of sigma. shape: parameters of the density. evaluated: fields of
        `Evaluated`, the values of the laws at nodes; each row of nodes is added to the sum that is its owner. Sums are averages
        over all asperities.
        """
        owner, counts, weights, states = evaluated
        out[:] = 0.0
        for row in range(owner.size):
            state, weight, separation = states[row], weights[row], h[owner[row]]
            touching = load = area = slip_limited = yield_limited = 0.0
            for node in range(8 * (counts[row] // 8)):
                dense = weight[node] * state[LONGEST + node] * density(separation + state[node], shape)
                touching += dense
                load += dense * state[2 * LONGEST + node]
                area += dense * state[3 * LONGEST + node]
                slip_limited += dense * state[4 * LONGEST + node]
                yield_limited += dense * state[5 * LONGEST + node]
            sums = out[owner[row]]
            sums[0] += touching
            sums[1] += load
            sums[2] += area
            sums[3] += slip_limited
            sums[4] += yield_limited

    return add
