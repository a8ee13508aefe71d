"""Build the compiled loops of the sums over heights, each specialised to a height distribution, to a regime or to both.

A regime is a smooth part of an asperity's behaviour; a law is one parameter set of a regime. Arguments of the loops are tuples,
because compiled loops accept these directly:

- heights: (shape, knots) of a `Heights`.
- laws: the fields of `nodes.Laws`: parameters (n, p), edges (n, m + 1), branch points (n, b), two_sided.
- rules: nodes and weights (rules, 2, longest) on [0, 1], and number of nodes (rules,).
- nodes: displacements (n, capacity), weights times summed values (n, rows, capacity), number of nodes used (n,). `append_nodes`
  of the module `placing`, and the loop that the function `placing` of this module returns, fill them for one block of laws.
"""

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.engine.compiled import engine_kernel, formula, kernel, loop, unpack

# Segments up to this length, in units of sigma, use the first integration rule, longer segments the second.
SHORT = 1.0
# Segments longer than this, in units of sigma, are divided. Adhering asperities that are stretched have such segments.
WIDEST = 17.0
# Number of elements in one row of a table of nodes, and largest number of nodes of a segment part on a grid.
LONGEST = 56


@formula
def map_segment(low, high, origins, two_sided):
    """Return the coefficients `linear` and `square` of the map u = low + linear t + square t^2 from t in [0, 1] to [low, high].

    The map is linear, unless a square-root branch point of the integrand lies at or slightly below `low` (if two_sided, also at
    or slightly above `high`). Then t is linear in the square root of the distance to that point. origins: coordinates of the
    branch points.
    """
    nearest, origin = 0.1 * (high - low), math.inf
    for i in range(origins.size):
        distance = max(low - origins[i], origins[i] - high) if two_sided else low - origins[i]
        if 0.0 <= distance < nearest:
            nearest, origin = distance, origins[i]
    if origin <= low:
        near, far = math.sqrt(low - origin), math.sqrt(high - origin)
        return 2.0 * near * (far - near), (far - near) ** 2
    if origin < math.inf:
        near, far = math.sqrt(origin - high), math.sqrt(origin - low)
        return 2.0 * far * (far - near), -((far - near) ** 2)
    return high - low, 0.0


@cache
def clipping(window: Callable) -> Any:
    """Return a formula that clips an interval of heights to the part in which the density is not negligible.

    window: window formula of the height distribution, as in `Heights`. The returned formula maps (z_left, z_right, heights),
    with heights = (shape, knots), to (z_low, z_high, first, last): the clipped interval, and the indices first to last - 1 of
    the knots inside it. The interval contributes nothing if z_low >= z_high.
    """

    @formula
    def clip(z_left, z_right, heights):
        shape, knots = heights
        z_low, z_high = window(z_left, z_right, shape)
        first = last = 0
        if z_high > z_low:
            while first < knots.size and knots[first] <= z_low:
                first += 1
            last = first
            while last < knots.size and knots[last] < z_high:
                last += 1
        return z_low, z_high, first, last

    return clip


def _adding(along: Callable, density: Callable) -> Any:
    @loop
    def add(sums, h, shape, row, mapped, rule, count):
        """Add one integration interval to five sums and return them.

        sums: fraction touching, load, area, slip-limited and yield-limited resistance. h: mean separation in units of sigma.
        shape: parameters of the height density. row: parameters of the law. mapped: (low, linear, square) of the change of
        variable u = low + linear t + square t^2. rule (2, count): nodes t and weights on [0, 1].
        """
        touching, load, area, slip_limited, yield_limited = sums
        low, linear, square = mapped
        for node in range(8 * (count // 8)):
            t = rule[0, node]
            state = along(low + t * (linear + square * t), *row)
            weight = rule[1, node] * (linear + 2.0 * square * t) * state[1]
            weight *= density(h + state[0], shape)
            touching += weight
            load += weight * state[2]
            area += weight * state[3]
            slip_limited += weight * state[4]
            yield_limited += weight * state[5]
        return touching, load, area, slip_limited, yield_limited

    return add


@cache
def scattering(along: Callable, coordinate: Callable, density: Callable, window: Callable, parameters: int) -> Any:
    """Return a compiled loop that sums one regime at pairs of a law (parameter set) and a separation.

    along, coordinate: formulas of the regime, as in `Regime`. density, window: formulas of the heights, as in `Heights`.
    parameters: number of parameters of a law.
    """
    clip, add = clipping(window), _adding(along, density)

    @kernel
    def scatter(h, law, heights, laws, rules, out):
        """Store in out[i] five sums over asperity heights, for parameter set law[i] at the mean separation h[i].

        The sums are averages over all asperities: fraction touching, load, area, slip-limited and yield-limited resistance. h:
        in units of sigma. heights: parameters and knots of the density. laws: fields of `nodes.Laws`. rules: nodes and weights
        on [0, 1], and their numbers.
        """
        (shape, knots), (table, edges, branch, two_sided), (rule_table, counts) = heights, laws, rules
        for i in range(h.size):
            row = unpack(table[law[i]], parameters)
            sums = (0.0, 0.0, 0.0, 0.0, 0.0)
            for segment in range(edges.shape[1] - 1):
                left, right = edges[law[i], segment], edges[law[i], segment + 1]
                if not right > left:
                    continue
                z_left, z_right = h[i] + along(left, *row)[0], h[i] + along(right, *row)[0]
                z_low, z_high, first, last = clip(z_left, z_right, heights)
                if not z_high > z_low:
                    continue
                low = left if z_low == z_left else max(left, coordinate(z_low - h[i], *row))
                end = right if z_high == z_right else min(right, coordinate(z_high - h[i], *row))
                for cut in range(first, last + 1):
                    high = end if cut == last else coordinate(knots[cut] - h[i], *row)
                    z_cut = z_high if cut == last else knots[cut]
                    rule = 0 if z_cut - z_low <= SHORT else 1
                    at_knot = 0 < cut and knots[cut - 1] == z_low
                    linear, square = (0.0, high - low) if at_knot else map_segment(low, high, branch[law[i]], two_sided)
                    sums = add(sums, h[i], shape, row, (low, linear, square), rule_table[rule], counts[rule])
                    low, z_low = high, z_cut
            for quantity in range(5):
                out[i, quantity] = sums[quantity]

    return scatter


@cache
def listing(along: Callable, coordinate: Callable, parameters: int) -> Any:
    """Return a compiled loop that averages one regime over heights that are listed one by one.

    along, coordinate: formulas of the regime, as in `Regime`. parameters: number of parameters of a law.
    """

    @engine_kernel
    def average(h, law, listed, laws, out):
        """Store in out[i] five averages over the heights `listed`, for the law with index law[i] at separation h[i].

        They are the fraction touching, load, area, slip-limited and yield-limited resistance. h (m,), listed: separations and
        heights in units of sigma; `listed` ascends. law (m,): index of the parameter set. laws: fields of `nodes.Laws`. out:
        (m, 5).
        """
        table, edges, _, _ = laws
        for i in range(h.size):
            row = unpack(table[law[i]], parameters)
            touching = load = area = slip_limited = yield_limited = 0.0
            for piece in range(edges.shape[1] - 1):
                left, right = edges[law[i], piece], edges[law[i], piece + 1]
                if not right > left:
                    continue
                lowest, end = along(left, *row)[0], along(right, *row)[0]
                for place in range(listed.size):
                    displacement = listed[listed.size - 1 - place] - h[i]  # the highest asperity comes first
                    if displacement < lowest:
                        break
                    if displacement < end:  # strictly, so that a height on the border of two segments counts once
                        state = along(min(max(coordinate(displacement, *row), left), right), *row)
                        touching += 1.0
                        load += state[2]
                        area += state[3]
                        slip_limited += state[4]
                        yield_limited += state[5]
            out[i, 0], out[i, 1], out[i, 2] = touching / listed.size, load / listed.size, area / listed.size
            out[i, 3], out[i, 4] = slip_limited / listed.size, yield_limited / listed.size

    return average


def _putting(along: Callable, rows: int) -> Any:
    @formula
    def put(mapped, row, rule, count, scratch):
        """Fill `scratch` with displacements, and weights times values to be summed, at the nodes of one integration interval.

        mapped: (low, linear, square) of the change of variable u = low + linear t + square t^2. row: parameters of the law.
        rule: nodes t and weights on [0, 1]; the first `count` are used. Each quantity has LONGEST elements. With this fixed
        distance the compiler can prove that the stores do not overlap, and vectorises the loop.
        """
        low, linear, square = mapped
        for node in range(count):
            t = rule[0, node]
            state = along(low + t * (linear + square * t), *row)
            weight = rule[1, node] * (linear + 2.0 * square * t) * state[1]
            scratch[node] = state[0]
            if rows == 1:
                scratch[LONGEST + node] = weight * state[2]
            elif rows == 3:
                scratch[LONGEST + node] = weight * state[2]
                scratch[2 * LONGEST + node] = weight * state[3]
                scratch[3 * LONGEST + node] = weight * (state[4] + state[5])
            else:
                scratch[LONGEST + node] = weight
                scratch[2 * LONGEST + node] = weight * state[2]
                scratch[3 * LONGEST + node] = weight * state[3]
                scratch[4 * LONGEST + node] = weight * state[4]
                scratch[5 * LONGEST + node] = weight * state[5]

    return put


@cache
def reaching(window: Callable) -> Any:
    """Return a formula that finds the displacements of a segment that contribute to a sum, and splits this range into parts.

    window: window formula of the height distribution, as in `Heights`. The returned formula maps (w_left, w_right, reach,
    shape) to: displacement at the start, width of each part, number of parts (0 if nothing contributes), displacement at the
    end, index of the integration rule. w_left, w_right: displacements at the ends of the segment. reach: (w_low, w_top,
    nearest), lowest and highest displacement that is integrated, and smallest separation, in units of sigma. The range ends
    where, at the smallest separation, the density has become negligible compared with its maximum beyond the start; at larger
    separations it is then negligible too.
    """

    @formula
    def parts_of(w_left, w_right, reach, shape):
        w_low, w_top, nearest = reach
        if not (w_right > w_low and w_left < w_top):
            return w_left, 0.0, 0, w_left, 0
        first = max(w_left, w_low)
        end = min(w_right, w_top, window(nearest + first, np.inf, shape)[1] - nearest)
        parts = 1 + int((end - first) / WIDEST) if end > first else 0
        return first, (end - first) / max(parts, 1), parts, end, 0 if end - first <= SHORT else 1

    return parts_of


@cache
def placing(along: Callable, coordinate: Callable, window: Callable, parameters: int, rows: int) -> Any:
    """Return a compiled loop that places the integration nodes of one regime and stores the values to be summed there.

    along, coordinate, window: formulas as in `Regime` and `Heights`. parameters: number of parameters of a law. rows = 1: the
    load. rows = 3: load, area and total resistance. rows = 5: fraction touching, load, area, slip-limited and yield-limited
    resistance.
    """
    put, parts_of = _putting(along, rows), reaching(window)

    @kernel
    def place(reach, shape, laws, rules, nodes):
        """Append the integration nodes of the regime to the table of nodes of each law (parameter set).

        reach: lowest and highest displacement that is integrated and smallest separation, in units of sigma. shape: parameters
        of the height density. laws: fields of `nodes.Laws`. rules: nodes and weights on [0, 1], and their numbers. nodes:
        displacements, weights times values, and number of nodes so far.
        """
        (table, edges, branch, two_sided), (rule_table, counts), (places, values, used) = laws, rules, nodes
        scratch = np.empty(6 * LONGEST)
        for i in range(edges.shape[0]):
            row = unpack(table[i], parameters)
            for segment in range(edges.shape[1] - 1):
                low, end = edges[i, segment], edges[i, segment + 1]
                if not end > low:
                    continue
                w_left, w_right = along(low, *row)[0], along(end, *row)[0]
                first_w, step, parts, last_w, rule = parts_of(w_left, w_right, reach, shape)
                if first_w > w_left:
                    low = max(low, coordinate(first_w, *row))
                if last_w < w_right:
                    end = min(end, coordinate(last_w, *row))
                for part in range(parts if end > low else 0):
                    last = end if part == parts - 1 else coordinate(first_w + (part + 1) * step, *row)
                    linear, square = map_segment(low, last, branch[i], two_sided)
                    put((low, linear, square), row, rule_table[rule], 8 * (counts[rule] // 8), scratch)
                    first, count = used[i], counts[rule]
                    used[i] += count
                    places[i, first : first + count] = scratch[:count]
                    for q in range(rows):
                        values[i, q, first : first + count] = scratch[(q + 1) * LONGEST : (q + 1) * LONGEST + count]
                    low = last

    return place


@cache
def summing(density: Callable, totals: bool) -> Any:
    """Return a compiled loop that sums the values stored at integration nodes, times the height density, at many separations.

    density: formula density(z, shape), as in `Heights`. totals: True for load, area and total resistance; False for fraction
    touching, load, area, slip-limited and yield-limited resistance.
    """

    @kernel
    def sum_rows(h, reach, shape, nodes, wanted, out):
        """Store in out[i, row, k] the sum of quantity `row` for parameter set i at mean separation h[k], if wanted[i, k].

        The sums over the nodes are of the quantities listed in `summing` (load, area, ...). h and displacements are in units of
        sigma. nodes: three arrays, displacements (i, node), integration weight times each quantity (i, row, node), and number
        of nodes of each parameter set (i). shape: parameters of the height density. reach[k]: displacement beyond which nodes
        are skipped at h[k].
        """
        places, values, used = nodes
        last = values.shape[1] - 1
        for i in range(used.size):
            x, a, b, c = places[i], values[i, 0], values[i, 1], values[i, 2]
            d, e = values[i, min(3, last)], values[i, last]  # with totals these rows do not exist and are not read
            for k in range(h.size):
                if not wanted[i, k]:
                    continue
                eights = used[i] // 8
                while eights > 0 and x[8 * eights - 8] > reach[k]:  # the nodes of a segment are in ascending order
                    eights -= 1
                sum_a = sum_b = sum_c = sum_d = sum_e = 0.0
                for node in range(8 * eights):
                    dense = density(h[k] + x[node], shape)
                    sum_a += dense * a[node]
                    sum_b += dense * b[node]
                    sum_c += dense * c[node]
                    if not totals:
                        sum_d += dense * d[node]
                        sum_e += dense * e[node]
                out[i, 0, k] = sum_a
                out[i, 1, k] = sum_b
                out[i, 2, k] = sum_c
                if not totals:
                    out[i, 3, k] = sum_d
                    out[i, 4, k] = sum_e

    return sum_rows
