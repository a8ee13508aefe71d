"""Place integration nodes once for many separations, by shared loops or by one loop compiled for the regime."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from stiction.engine.compiled import engine_kernel, loop
from stiction.engine.nodes import Laws, Parts, Rows, Rules, displacements, evaluate_parts
from stiction.engine.regime import Regime
from stiction.engine.sum_kernels import LONGEST, WIDEST, placing, reaching


@cache
def spanning(window: Callable) -> Any:
    """Return the kernel that finds the parts of segments that contribute at any of many separations."""

    parts_of = reaching(window)

    @engine_kernel
    def span(reach, shape, laws, parts):
        """Fill `parts` for every law, with the index of the law as owner, and return the number of parts.

        reach: as in `sum_kernels.reaching`. laws: as in `nodes.cutting`.
        """
        edges, displaced = laws
        laws_of, owner, ends, end_w, rule, at_knot = parts
        used = 0
        for i in range(edges.shape[0]):
            for segment in range(edges.shape[1] - 1):
                left, right = edges[i, segment], edges[i, segment + 1]
                if not right > left:
                    continue
                w_left, w_right = displaced[i, segment], displaced[i, segment + 1]
                first, step, count, last, number = parts_of(w_left, w_right, reach, shape)
                for part in range(count):
                    laws_of[used], owner[used] = i, i
                    ends[used, 0], ends[used, 1] = left, right
                    end_w[used, 0] = math.nan if part == 0 and first == w_left else first + part * step
                    end_w[used, 1] = first + (part + 1) * step
                    if part == count - 1:
                        end_w[used, 1] = math.nan if last == w_right else last
                    rule[used], at_knot[used] = number, False
                    used += 1
        return used

    return span


@loop
def _copy(state, count, out):
    for node in range(8 * (count // 8)):
        out[node] = state[node]


@loop
def _weigh(weight, state, count, quantity, out):
    """Fill `out` with the summand of one quantity at each node: weight times value times dw/du.

    w: displacement; u: coordinate of the law.
    """
    for node in range(8 * (count // 8)):
        out[node] = weight[node] * state[LONGEST + node] * state[quantity * LONGEST + node]


@engine_kernel
def append_nodes(evaluated, nodes):
    """Append evaluated nodes to the table of nodes of each law.

    nodes: (displacements, values, used) as described in `sum_kernels`. values (n, rows, room) has one row for the load alone,
    three for load, area and total resistance, or five for all QUANTITIES.
    """
    (owner, counts, weights, states), (places, values, used) = evaluated, nodes
    rows = values.shape[1]
    for i in range(owner.size):
        law, count, state, weight = owner[i], counts[i], states[i], weights[i]
        some = slice(used[law], used[law] + count)
        _copy(state, count, places[law, some])
        if rows == 5:
            for node in range(count):
                values[law, 0, used[law] + node] = weight[node] * state[LONGEST + node]
            for quantity in range(1, 5):
                _weigh(weight, state, count, quantity + 1, values[law, quantity, some])
        else:
            _weigh(weight, state, count, 2, values[law, 0, some])
        if rows == 3:
            _weigh(weight, state, count, 3, values[law, 1, some])
            for node in range(count):
                both = state[4 * LONGEST + node] + state[5 * LONGEST + node]
                values[law, 2, used[law] + node] = weight[node] * state[LONGEST + node] * both
        used[law] += count


@dataclass(frozen=True)
class Placing:
    """Describe how the integration nodes of one regime are placed once for many separations.

    window: window of the height distribution. parts: largest number of intervals of one law. displaced (n, m + 1):
    displacements at the edges, None if the loop compiled for the regime is used. rows: number of summed values, as in
    `append_nodes`.
    """

    regime: Regime
    laws: Laws
    window: Callable
    parts: int
    displaced: np.ndarray | None
    rows: int

    @classmethod
    def of(cls, regime: Regime, window: Callable, widest: float, rows: int, specialised: bool) -> "Placing":
        """Return the description of a regime under heights with this window.

        widest: largest span of displacements in which nodes are placed. specialised: whether to use a loop compiled for the
        regime.
        """
        laws = Laws.of(regime)
        parts = (laws.edges.shape[1] - 1) * (1 + int(widest / WIDEST))
        displaced = None if specialised else displacements(regime, laws)
        return cls(regime, laws, window, parts, displaced, rows)

    @property
    def room(self) -> int:
        """Return the largest number of nodes of one law."""
        return self.parts * LONGEST

    def on(self, laws: int, rules: Rules) -> Callable:
        """Return append(reach, shape, block, nodes), which adds the integration nodes of a block of laws to `nodes`.

        laws: largest number of laws in a block. rules: nodes and weights of the integration rules. reach: as in
        `sum_kernels.reaching`. shape: parameters of the height distribution. block: slice of the laws. nodes: table of
        nodes, as described in `sum_kernels`.
        """
        regime, displaced = self.regime, self.displaced
        if displaced is None:
            place = placing(regime.along, regime.coordinate, self.window, self.laws.table.shape[1], self.rows)
            return lambda reach, shape, block, nodes: place(reach, shape, tuple(self.laws.some(block)), rules, nodes)
        span, parts, rows = spanning(self.window), Parts.room(laws * self.parts), Rows.room(laws * self.parts, rules)

        def append(reach: tuple[float, float, float], shape: np.ndarray, block: slice, nodes: tuple) -> None:
            some = self.laws.some(block)
            used = span(reach, shape, (some.edges, displaced[block]), tuple(parts))
            append_nodes(tuple(evaluate_parts(regime, some, parts, used, rules, rows)), nodes)

        return append
