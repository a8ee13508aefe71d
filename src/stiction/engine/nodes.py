"""Place nodes and evaluate a law there, in stages: only two short loops are compiled for each law.

`evaluating` and `inverting` make the two loops of a regime. All else knows no law: `cutting` finds the parts of pieces that
count, `place_nodes` puts Gauss-Legendre nodes on them, `adding` sums what the law gives
there; `placing` is for many separations.
A loop that does everything for one regime (`sum_kernels.scattering`) runs faster and takes six times as long to compile.

parts: the arrays of `Parts`, as the kernels take them.
"""

import math
from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from stiction.engine.compiled import kernel, lazy_kernel, unpack
from stiction.engine.regime import Regime, columns
from stiction.engine.sum_kernels import LONGEST, SHORT, clipping, map_piece

_BLOCK = 512  # laws at a time: their values stay in the processor's cache
# Nodes and weights (rules, 2, longest) on [0, 1], and how many of them (rules,).
Rules = tuple[np.ndarray, np.ndarray]


class Laws(NamedTuple):
    """A regime as the kernels take it: parameters (n, p), edges (n, m + 1), branch (n, b), whether that is two-sided."""

    table: np.ndarray
    edges: np.ndarray
    branch: np.ndarray
    two_sided: bool

    @classmethod
    def of(cls, regime: Regime) -> "Laws":
        """Return the arrays of a regime."""
        edges = np.ascontiguousarray(regime.edges)
        branch = np.full(len(edges), -np.inf) if regime.branch is None else np.ascontiguousarray(regime.branch)
        two_sided = branch.ndim == 2
        return cls(columns(regime.parameters, len(edges)), edges, branch if two_sided else branch[:, None], two_sided)

    def some(self, rows: slice) -> "Laws":
        """Return a block of the laws."""
        return Laws(self.table[rows], self.edges[rows], self.branch[rows], self.two_sided)


class Parts(NamedTuple):
    """Hold k parts of pieces.

    The law, the sum that each part is added to, its ends (k, 2) in the coordinate of the law, which are those of its piece
    where `asked` (k, 2) is NaN, and else at that displacement; the number of its rule, and whether it starts at a knot of the
    heights.
    """

    law: np.ndarray
    owner: np.ndarray
    ends: np.ndarray
    asked: np.ndarray
    rule: np.ndarray
    at_knot: np.ndarray

    @classmethod
    def room(cls, size: int) -> "Parts":
        """Return arrays for so many parts."""
        law, owner, rule = np.empty((3, size), dtype=np.int64)
        ends, asked = np.empty((2, size, 2))
        return cls(law, owner, ends, asked, rule, np.empty(size, dtype=np.bool_))


class Evaluated(NamedTuple):
    """Hold a law evaluated at the nodes of parts, in rows of at most LONGEST nodes.

    The owner of each row (r,), its number of nodes (r,), their weights (r, LONGEST), and the six values of the law (r, 6
    LONGEST), one after another.
    """

    owner: np.ndarray
    counts: np.ndarray
    weights: np.ndarray
    states: np.ndarray


@cache
def evaluating(along: Callable, parameters: int, values: int = 6) -> Any:
    """Return the kernel that fills a table with the values of a law at nodes; parameters, values: how many there are."""

    @lazy_kernel(worth=400_000)
    def evaluate(u, law, count, table, out):
        """Fill out[i] with the values at u[i, :count[i]], of the law number law[i]; counts are multiples of eight.

        The values lie at fixed distances in one array: the compiler then sees that rows do not overlap, and vectorises.
        """
        for i in range(law.size):
            places, row, found = u[i], unpack(table[law[i]], parameters), out[i]
            for node in range(8 * (count[i] // 8)):
                state = along(float(places[node]), *row)
                found[node] = state[0]
                found[LONGEST + node] = state[1]
                found[2 * LONGEST + node] = state[2]
                found[3 * LONGEST + node] = state[3]
                if values == 6:
                    found[4 * LONGEST + node] = state[4]
                    found[5 * LONGEST + node] = state[5]

    return evaluate


@cache
def inverting(coordinate: Callable, parameters: int) -> Any:
    """Return the kernel that fills an array with the coordinates of displacements."""

    @lazy_kernel(worth=10_000)
    def invert(w, law, table, out):
        for i in range(w.size):
            out[i] = coordinate(float(w[i]), *unpack(table[law[i]], parameters))

    return invert


def displacements(regime: Regime, laws: Laws) -> np.ndarray:
    """Return the displacements (n, m + 1) at the edges of a regime."""
    return np.ascontiguousarray(values_at(regime.along, laws.table, laws.edges)[:, 0])


def values_at(along: Callable, table: np.ndarray, u: np.ndarray, values: int = 6) -> np.ndarray:
    """Return the values (n, values, k) of n laws at coordinates (n, k)."""
    evaluate, found = evaluating(along, table.shape[1], values), np.empty((len(u), values, u.shape[1]))
    out = np.empty((min(len(u), _BLOCK), values * LONGEST))
    law, eight = np.arange(len(out)), np.full(len(out), 8)
    for start in range(0, len(u), _BLOCK):
        rows = slice(start, start + _BLOCK)
        for first in range(0, u.shape[1], 8):
            columns = slice(first, first + 8)
            some = u[rows, columns]
            evaluate(_eight(some), law[: len(some)], eight, table[rows], out)
            found[rows, :, columns] = out[: len(some)].reshape(-1, values, LONGEST)[:, :, : some.shape[1]]
    return found


def _eight(u: np.ndarray) -> np.ndarray:
    """Return up to eight columns as eight, the last one repeated."""
    return np.concatenate([u, np.repeat(u[:, -1:], 8 - u.shape[1], axis=1)], axis=1)


@cache
def cutting(window: Callable) -> Any:
    """Return the kernel that finds the parts of pieces whose heights count at single separations."""

    clip = clipping(window)

    @kernel
    def cut(h, law, heights, laws, parts):
        """Fill `parts` for the laws number law[i] at the separations h[i], their owners i, and return how many there are.

        laws: edges and the displacements there, both (n, m + 1).
        """
        (_, knots), (edges, displaced), (laws_of, owner, ends, asked, rule, at_knot) = heights, laws, parts
        used = 0
        for i in range(h.size):
            for piece in range(edges.shape[1] - 1):
                left, right = edges[law[i], piece], edges[law[i], piece + 1]
                if not right > left:
                    continue
                z_left, z_right = h[i] + displaced[law[i], piece], h[i] + displaced[law[i], piece + 1]
                z_low, z_high, first, last = clip(z_left, z_right, heights)
                if not z_high > z_low:
                    continue
                w_low = math.nan if z_low == z_left else z_low - h[i]
                for at in range(first, last + 1):
                    z_cut = z_high if at == last else knots[at]
                    w_high = math.nan if at == last and z_high == z_right else z_cut - h[i]
                    laws_of[used], owner[used] = law[i], i
                    ends[used, 0], ends[used, 1], asked[used, 0], asked[used, 1] = left, right, w_low, w_high
                    rule[used] = 0 if z_cut - z_low <= SHORT else 1
                    at_knot[used] = 0 < at and knots[at - 1] == z_low
                    used += 1
                    w_low, z_low = w_high, z_cut
        return used

    return cut


@kernel
def place_nodes(parts, branch, two_sided, rules, nodes):
    """Fill rows of nodes with coordinates and weights, and return how many rows there are."""
    (law, owner, ends, _, rule, at_knot), (rule_table, counts) = parts, rules
    u, weights, row_law, row_owner, row_count, _ = nodes
    used = 0
    for i in range(law.size):
        low, high = ends[i, 0], ends[i, 1]
        if not high > low:
            continue
        linear, square = 0.0, high - low
        if not at_knot[i]:
            linear, square = map_piece(low, high, branch[law[i]], two_sided)
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
    """Hold rows of nodes, as `place_nodes` and `evaluating` fill them.

    Coordinates and weights (r, LONGEST), the law, the owner and the number of nodes of each row, and the values of the law
    (r, 6 LONGEST), one after another.
    """

    u: np.ndarray
    weights: np.ndarray
    law: np.ndarray
    owner: np.ndarray
    counts: np.ndarray
    states: np.ndarray

    @classmethod
    def room(cls, parts: int, rules: Rules) -> "Rows":
        """Return arrays for the nodes of so many parts."""
        rows = parts * -(-int(rules[1].max()) // LONGEST)
        u, weights = np.empty((2, rows, LONGEST))
        law, owner, count = np.empty((3, rows), dtype=np.int64)
        return cls(u, weights, law, owner, count, np.empty((rows, 6 * LONGEST)))


def evaluate_parts(regime: Regime, laws: Laws, parts: Parts, used: int, rules: Rules, rows: Rows) -> Evaluated:
    """Evaluate a regime at the nodes of the first so many parts; rows: where to put them."""
    parts = Parts(*(array[:used] for array in parts))
    _settle(regime, laws, parts)
    count = place_nodes(tuple(parts), laws.branch, laws.two_sided, rules, tuple(rows))
    u, weights, law, owner, counts, states = (array[:count] for array in rows)
    evaluating(regime.along, laws.table.shape[1])(u, law, counts, laws.table, states)
    return Evaluated(owner, counts, weights, states)


def _settle(regime: Regime, laws: Laws, parts: Parts) -> None:
    """Replace the ends of pieces by the coordinates of the requested displacements."""
    w, found = np.empty((2, parts.asked.size))
    law, place = np.empty((2, parts.asked.size), dtype=np.int64)
    count = list_asked(tuple(parts), w, law, place)
    inverting(regime.coordinate, laws.table.shape[1])(w[:count], law[:count], laws.table, found)
    put_ends(found, place[:count], parts.ends)


@kernel
def list_asked(parts, w, law, place):
    """List the requested displacements, their laws and the numbers of their ends; return their number."""
    law_of, _, _, asked, _, _ = parts
    used = 0
    for i in range(law_of.size):
        for end in range(2):
            if not math.isnan(asked[i, end]):
                w[used], law[used], place[used] = asked[i, end], law_of[i], 2 * i + end
                used += 1
    return used


@kernel
def put_ends(found, place, ends):
    """Store coordinates at the ends of their pieces, clipped to the piece."""
    for at in range(place.size):
        i, end = place[at] // 2, place[at] % 2
        ends[i, end] = max(ends[i, 0], found[at]) if end == 0 else min(ends[i, 1], found[at])


@cache
def adding(density: Callable) -> Any:
    """Return the kernel that sums a law over heights at single separations."""

    @kernel
    def add(h, shape, evaluated, out):
        """Fill out (m, 5) with the sums of every owner."""
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
