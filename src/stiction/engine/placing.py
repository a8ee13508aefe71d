"""Place integration nodes once for many separations, by shared loops or by one loop compiled for the regime.

A regime is one smooth part of an asperity's behaviour, for several parameter sets ("laws").
"""

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
    """Return a compiled loop that finds the integration intervals of a sum at many separations.

    The intervals serve all separations: they contain every displacement that contributes at one or more of them.

    window: formula of the height distribution, as in `Heights`, that limits an interval to heights that are not negligible.
    """

    parts_of = reaching(window)

    @engine_kernel
    def span(reach, shape, laws, parts):
        """Fill `parts` with the integration intervals of every law (parameter set), and return their number.

        reach: lowest and highest displacement that is integrated and smallest separation, all in units of sigma. shape:
        parameters of the height distribution. laws: (edges, displacements at the edges), both (n, m + 1); each pair of
        neighbouring edges bounds a segment. parts: fields of `nodes.Parts`; the owner of an interval is the index of its law.
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
    """Fill `out` with weight * value * dw/du at each node, for one quantity (w: displacement; u: coordinate of the law).

    weight: integration weights. state: six values of the law at the nodes, stored one after the other, with LONGEST elements
    for each value; dw/du is the second value. count: number of nodes. quantity: index of the value that is summed.
    """
    for node in range(8 * (count // 8)):
        out[node] = weight[node] * state[LONGEST + node] * state[quantity * LONGEST + node]


@engine_kernel
def append_nodes(evaluated, nodes):
    """Append evaluated integration nodes, in place, to the table of nodes of each law (parameter set).

    evaluated: fields of `nodes.Evaluated`. nodes: displacements (n, room) of the nodes of n laws (room: largest number of nodes
    per law); products of weight, quantity and dw/du (n, rows, room), ready to be summed; and the number (n,) of nodes in use,
    which is increased. rows: one for the load alone; three for load, area and total resistance; or five for fraction touching,
    load, area, slip-limited and yield-limited resistance.
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

    window: formula that limits an interval to heights that are not negligible, as in `Heights`. parts: largest number of
    integration intervals of one law (parameter set). displaced (n, m + 1): displacements at the edges in units of sigma, None
    if a loop compiled for the regime is used. rows: number of summed values: 1 (load), 3 (load, area, total resistance) or 5
    (fraction touching, load, area, slip-limited and yield-limited resistance).
    """

    regime: Regime
    laws: Laws
    window: Callable
    parts: int
    displaced: np.ndarray | None
    rows: int

    @classmethod
    def of(cls, regime: Regime, window: Callable, widest: float, rows: int, specialised: bool) -> "Placing":
        """Return the `Placing` for the nodes of a regime.

        window: window formula of the height distribution, as in `Heights`. widest: largest range of displacements, in units of
        sigma, in which nodes are placed. rows: number of summed values: 1, 3 or 5. specialised: whether to use a loop compiled
        for the regime.
        """
        laws = Laws.of(regime)
        parts = (laws.edges.shape[1] - 1) * (1 + int(widest / WIDEST))
        displaced = None if specialised else displacements(regime, laws)
        return cls(regime, laws, window, parts, displaced, rows)

    @property
    def room(self) -> int:
        """Return the largest number of integration nodes that one law (parameter set) can have."""
        return self.parts * LONGEST

    def on(self, laws: int, rules: Rules) -> Callable:
        """Return append(reach, shape, block, nodes), which adds the integration nodes of a block of laws to the table `nodes`.

        laws: largest number of laws (parameter sets) in a block. rules: nodes and weights of the integration rules. Arguments
        of append: reach: lowest and highest displacement of the integral, and smallest separation, in units of sigma. shape:
        parameters of the height distribution. block: slice of the laws. nodes: (displacements, weights times values, numbers of
        nodes), one row for each law of the block.
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
