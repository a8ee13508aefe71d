"""The engine: sums any asperity law over any distribution of heights. The only place that integrates.

For mean separation h (over sigma) and heights with density phi, a regime contributes
    Integral f(u) phi(h + w(u)) w'(u) du        (Greenwood & Williamson 1966, in the regime's own coordinate u)
for f = 1 (number of asperities), load, area, slip-limited and yield-limited resistance. Gauss-Legendre on every piece
between kinks, where everything is smooth; the engine knows nothing of any model.

Two ways. `scattered`: each law has its own h. `on_grid`: all laws share many h. Sums are smooth in h, and so alike that a
few separations tell all others: every law is summed at those (its nodes are placed only once), and one matrix, which knows
the heights but no law, carries the sums over to all separations. What loses digits on the way is summed at its own
separation after all.
"""

import math
from collections.abc import Sequence
from functools import cache, lru_cache

import numpy as np
from numba.np.unsafe.ndarray import to_fixed_tuple

from stiction.engine.compiled import bind, formula, kernel
from stiction.engine.heights import Heights
from stiction.engine.regime import Regime

QUANTITIES = ("touching", "load", "area", "slip_limited", "yield_limited")

# Nodes on a piece that is short or long against sigma. Errors are below 1e-10 over all inputs the package is made for, with and
# without a film: docs/measure_accuracy.py measures them, docs/numerics.md shows them.
_SHORT = 1.0
# A piece that is longer, over sigma, is cut: that of asperities that hold on below w = 0 is, seen from many separations.
_WIDEST = 17.0
# Separations beyond this, over sigma, have no meaning, and their squares no digits.
FARTHEST = 1e6
# Multiples of eight, which the loops over nodes spell out: the compiler then leaves out its loop over a remainder.
_COUNTS = np.array([24, 56])
_LONGEST = int(_COUNTS[-1])


def _make_rules(counts: np.ndarray) -> np.ndarray:
    """Nodes and weights (rules, 2, longest) on [0, 1]: Gauss-Legendre in t, placed at t + 0.3 t (1 - t), which leans on
    the left end, where asperities are most."""
    rules = np.zeros((len(counts), 2, max(counts)))
    for rule, count in zip(rules, counts, strict=True):
        nodes, weights = np.polynomial.legendre.leggauss(count)
        t, weights = (nodes + 1.0) / 2.0, weights / 2.0
        rule[:, :count] = t + 0.3 * t * (1.0 - t), weights * (1.3 - 0.6 * t)
    return rules


_RULES = _make_rules(_COUNTS)


# The functions named _*_template are compiled anew for each kind of regime and of heights, with these names bound.
along = coordinate = density = window = _cuts = _put_nodes = None
PARAMETERS = 0


@formula
def _map_piece(low, high, origins, two_sided):
    """Coefficients of u = low + linear t + square t^2, t in [0, 1]: linear, or in the square root of the distance to a square
    root branch point of the integrand at or shortly below `low` or, if two_sided, at or shortly above `high`."""
    nearest, origin = 0.1 * (high - low), math.inf
    for at in range(origins.size):
        distance = max(low - origins[at], origins[at] - high) if two_sided else low - origins[at]
        if 0.0 <= distance < nearest:
            nearest, origin = distance, origins[at]
    if origin <= low:
        near, far = math.sqrt(low - origin), math.sqrt(high - origin)
        return 2.0 * near * (far - near), (far - near) ** 2
    if origin < math.inf:
        near, far = math.sqrt(origin - high), math.sqrt(origin - low)
        return 2.0 * far * (far - near), -((far - near) ** 2)
    return high - low, 0.0


def _cuts_template(left, right, h, row, heights, knots):
    """The piece [left, right] without what is negligible: its ends in height, and the first and last knot inside."""
    z_left, z_right = h + along(left, *row)[0], h + along(right, *row)[0]
    z_low, z_high = window(z_left, z_right, heights)
    first = last = 0
    if z_high > z_low:
        while first < knots.size and knots[first] <= z_low:
            first += 1
        last = first
        while last < knots.size and knots[last] < z_high:
            last += 1
    low = left if z_low == z_left else max(left, coordinate(z_low - h, *row))
    high = right if z_high == z_right else min(right, coordinate(z_high - h, *row))
    return z_low, z_high, low, high, first, last


def _scattered_template(h, law, heights, knots, parameters, edges, branch, two_sided, rules, counts, out):
    """Sums out[i, quantity] of one regime, for the law number law[i] at the separation h[i]."""
    for i in range(h.size):
        row = to_fixed_tuple(parameters[law[i]], PARAMETERS)
        touching = load = area = slip_limited = yield_limited = 0.0
        for piece in range(edges.shape[1] - 1):
            left, right = edges[law[i], piece], edges[law[i], piece + 1]
            if not right > left:
                continue
            z_low, z_high, low, end, first, last = _cuts(left, right, h[i], row, heights, knots)
            if not z_high > z_low:
                continue
            for cut in range(first, last + 1):
                high = end if cut == last else coordinate(knots[cut] - h[i], *row)
                z_cut = z_high if cut == last else knots[cut]
                rule = 0 if z_cut - z_low <= _SHORT else 1
                at_knot = 0 < cut and knots[cut - 1] == z_low
                linear, square = (0.0, high - low) if at_knot else _map_piece(low, high, branch[law[i]], two_sided)
                for node in range(8 * (counts[rule] // 8)):
                    t = rules[rule, 0, node]
                    state = along(low + t * (linear + square * t), *row)
                    weight = rules[rule, 1, node] * (linear + 2.0 * square * t) * state[1]
                    weight *= density(h[i] + state[0], heights)
                    touching += weight
                    load += weight * state[2]
                    area += weight * state[3]
                    slip_limited += weight * state[4]
                    yield_limited += weight * state[5]
                low, z_low = high, z_cut
        out[i, 0] = touching
        out[i, 1] = load
        out[i, 2] = area
        out[i, 3] = slip_limited
        out[i, 4] = yield_limited


def _put_nodes_template(low, high, row, branch, two_sided, rule, count, scratch):
    """Displacements at the nodes of one piece, and its weights times the five quantities and times the resistance, one after
    another: an array at fixed distances, in which the compiler sees that rows do not overlap, and vectorises."""
    linear, square = _map_piece(low, high, branch, two_sided)
    for node in range(count):
        t = rule[0, node]
        state = along(low + t * (linear + square * t), *row)
        weight = rule[1, node] * (linear + 2.0 * square * t) * state[1]
        scratch[node] = state[0]
        scratch[_LONGEST + node] = weight
        scratch[2 * _LONGEST + node] = weight * state[2]
        scratch[3 * _LONGEST + node] = weight * state[3]
        scratch[4 * _LONGEST + node] = weight * state[4]
        scratch[5 * _LONGEST + node] = weight * state[5]
        scratch[6 * _LONGEST + node] = weight * (state[4] + state[5])


def _place_template(w_low, nearest, heights, parameters, edges, branch, two_sided, rules, counts, place, values, used):
    """Append to the table of each law i the nodes of one regime, from the displacement w_low on.

    Every piece reaches to where the density is negligible against its own left end, at the nearest separation and so at
    all others. place[i]: displacements; values[i, row]: weights times the five quantities, and times the resistance;
    used[i]: how many nodes there are.
    """
    scratch = np.empty(7 * _LONGEST)
    for i in range(edges.shape[0]):
        row = to_fixed_tuple(parameters[i], PARAMETERS)
        for piece in range(edges.shape[1] - 1):
            left, right = edges[i, piece], edges[i, piece + 1]
            if not right > left:
                continue
            w_left, w_right = along(left, *row)[0], along(right, *row)[0]
            if not w_right > w_low:
                continue
            w_left = max(w_left, w_low)
            w_high = min(w_right, window(nearest + w_left, np.inf, heights)[1] - nearest)
            low = left if w_left > w_low else max(left, coordinate(w_low, *row))
            high = right if w_high == w_right else min(right, coordinate(w_high, *row))
            if not high > low:
                continue
            rule = 0 if w_high - w_left <= _SHORT else 1
            parts = 1 + int((w_high - w_left) / _WIDEST)
            end, step = high, (w_high - w_left) / parts
            for part in range(parts):
                last = end if part == parts - 1 else coordinate(w_left + (part + 1) * step, *row)
                _put_nodes(low, last, row, branch[i], two_sided, rules[rule], 8 * (counts[rule] // 8), scratch)
                first = used[i]
                used[i] += counts[rule]
                place[i, first : used[i]] = scratch[: counts[rule]]
                for q in range(6):
                    values[i, q, first : used[i]] = scratch[(q + 1) * _LONGEST : (q + 1) * _LONGEST + counts[rule]]
                low = last


def _sum_rows_template(h, reach, heights, place, values, used, rows, wanted, out):
    """Sums out[i, column, at] of the three rows of values at the separation h[at], where wanted[i, at], leaving out
    displacements beyond reach[at]."""
    for i in range(used.size):
        x, a, b, c = place[i], values[i, rows[0]], values[i, rows[1]], values[i, rows[2]]
        for at in range(h.size):
            if not wanted[i, at]:
                continue
            eights = used[i] // 8
            while eights > 0 and x[8 * eights - 8] > reach[at]:  # the nodes of a piece ascend
                eights -= 1
            first_sum = second_sum = third_sum = 0.0
            for node in range(8 * eights):
                dense = density(h[at] + x[node], heights)
                first_sum += dense * a[node]
                second_sum += dense * b[node]
                third_sum += dense * c[node]
            out[i, 0, at] = first_sum
            out[i, 1, at] = second_sum
            out[i, 2, at] = third_sum


@cache
def _scattered_kernel(along, coordinate, density, window, parameters: int):
    cuts = formula(bind(_cuts_template, along=along, coordinate=coordinate, window=window))
    bound = {"along": along, "coordinate": coordinate, "density": density, "_cuts": cuts, "PARAMETERS": parameters}
    return kernel(bind(_scattered_template, **bound))


def _density_template(z, heights, out):
    for i in range(z.size):
        out[i] = density(z[i], heights)


@cache
def _density_kernel(density):
    return kernel(bind(_density_template, density=density))


@cache
def _place_kernel(along, coordinate, window, parameters: int):
    put = formula(bind(_put_nodes_template, along=along))
    bound = {"along": along, "coordinate": coordinate, "window": window, "_put_nodes": put, "PARAMETERS": parameters}
    return kernel(bind(_place_template, **bound))


@cache
def _sum_rows_kernel(density):
    return kernel(bind(_sum_rows_template, density=density))


def _arrays(regime: Regime) -> tuple[np.ndarray, np.ndarray, np.ndarray, bool]:
    """Parameters (n, p), edges (n, m), branch (n, b) and whether that is two-sided, as the kernels take them."""
    edges = np.ascontiguousarray(regime.edges)
    columns = [np.broadcast_to(column, len(edges)) for column in regime.parameters]
    branch = np.full(len(edges), -np.inf) if regime.branch is None else np.ascontiguousarray(regime.branch)
    two_sided = branch.ndim == 2
    branch = branch if two_sided else branch[:, None]
    # Not np.stack, which wants a column: a law may have no parameter at all (Hertz).
    return np.ascontiguousarray(np.reshape(columns, (len(columns), len(edges))).T), edges, branch, two_sided


def _one_regime(regime: Regime, h: np.ndarray, law: np.ndarray, heights: Heights) -> np.ndarray:
    parameters, edges, *branch = _arrays(regime)
    compiled = _scattered_kernel(regime.along, regime.coordinate, heights.density, heights.window, parameters.shape[1])
    out = np.empty((h.size, len(QUANTITIES)))
    compiled(h, law, heights.shape, heights.knots, parameters, edges, *branch, _RULES, _COUNTS, out)
    return out


def scattered(regimes: Sequence[Regime], h: np.ndarray, heights: Heights, law: np.ndarray | None = None) -> np.ndarray:
    """Sums of every regime at single pairs of a law and a mean separation.

    regimes: each for n laws. h: array (m,), over sigma. law: array (m,) of numbers of laws; by default m = n and h[i]
    belongs to law i. Returns an array (regimes, m, 5), per asperity, in the order of QUANTITIES.
    """
    h = np.ascontiguousarray(h, dtype=float)
    law = np.arange(h.size) if law is None else np.ascontiguousarray(law)
    return np.stack([_one_regime(regime, h, law, heights) for regime in regimes])


# Less than this many pairs of a law and a separation are cheaper one by one than the matrix.
_MANY = 4000
_SKELETONS = (16, 20, 24, 28, 32, 40, 48, 64)
# Separations farther apart than this, over sigma, have no skeleton of 64, and are taken in parts.
_SPAN = 14.0
# The matrix is good to this; far out the density itself is not, whose exponent h^2/2 is rounded.
_RESIDUAL, _ROUNDING = 5e-15, 2.3e-16
# A sum that may have lost more than this (see _carry_over) is taken again.
_LOST = 8e-11
_BLOCK = 256  # laws at a time: their nodes stay in the processor's cache


def on_grid(regimes: Sequence[Regime], h: np.ndarray, heights: Heights) -> np.ndarray:
    """Sums of every regime for n laws at H mean separations that they share.

    h: array (H,), over sigma. Returns an array (regimes, n, 5, H) of what `scattered` gives.
    """
    halves = (0, 1, 2), (3, 4, 5)
    return np.stack([np.concatenate([_on_grid([regime], h, heights, half) for half in halves], axis=1) for regime in regimes])[
        :, :, :5
    ]


def totals_on_grid(regimes: Sequence[Regime], h: np.ndarray, heights: Heights, out: np.ndarray | None = None) -> np.ndarray:
    """Load, area and resistance (n, 3, H) of n laws at H mean separations that they share: all regimes together.

    out: where to put them, if given.
    """
    return _on_grid(regimes, h, heights, (1, 2, 5), out)


def _on_grid(regimes, h, heights, rows, out=None):
    """Sums (n, 3, H) of three of the rows: the five QUANTITIES and the resistance, which is the last two together."""
    h = np.ascontiguousarray(h, dtype=float)
    laws = len(regimes[0].edges)
    sums = np.empty((laws, 3, h.size)) if out is None else out
    single = []
    for part in _near_each_other(h):
        whole = part.size == h.size
        some = sums if whole else np.empty((laws, 3, part.size))
        near = h if whole else h[part]
        if not (heights.entire and laws * part.size >= _MANY and _by_skeleton(regimes, near, heights, np.array(rows), some)):
            single.append(part)
        elif not whole:
            sums[:, :, part] = some
    if single:
        rest = np.concatenate(single)
        exact = scattered(regimes, np.tile(h[rest], laws), heights, np.repeat(np.arange(laws), rest.size)).sum(axis=0)
        exact = np.column_stack([exact, exact[:, 3] + exact[:, 4]])
        sums[:, :, rest] = np.moveaxis(exact[:, rows].reshape(laws, rest.size, 3), 1, 2)
    return sums


def _near_each_other(h) -> list[np.ndarray]:
    """The numbers of the separations h (H,), in parts none of which spans more than _SPAN."""
    if not h.size or np.ptp(h) <= _SPAN:
        return [np.arange(h.size)]
    order = np.argsort(h, kind="stable")
    span = np.ptp(h) / np.ceil(np.ptp(h) / _SPAN)
    parts = np.ceil((h[order] - h[order[0]]) / span)
    return np.split(order, np.flatnonzero(np.diff(np.maximum(parts, 1.0))) + 1)


def _by_skeleton(regimes, h, heights, rows, sums) -> bool:
    """Fill sums (n, 3, H); False where these separations have no skeleton that is good enough."""
    # What is negligible beside all that touches need not be so for one quantity: down to densities of exp(-9 NEGLIGIBLE).
    lowest = 3.0 * heights.window(-np.inf, np.inf, heights.shape)[0] - h.max()
    w_low = max(min(regime.lowest for regime in regimes), lowest)
    nearest = h.min()
    w_high = heights.window(nearest + w_low, np.inf, heights.shape)[1] - nearest
    skeleton, carry, doubtful_below = _skeleton(h.tobytes(), w_low, w_high, heights)
    if not skeleton.size:
        return False
    reach = np.array([heights.window(few + w_low, np.inf, heights.shape)[1] for few in skeleton]) - skeleton
    # The load, which changes sign, is as good as the area beside it; all else is positive.
    positive = np.array([column for column, row in enumerate(rows) if row != 1])
    sum_rows = _sum_rows_kernel(heights.density)
    placed = [
        (_place_kernel(regime.along, regime.coordinate, heights.window, len(regime.parameters)), _arrays(regime))
        for regime in regimes
    ]
    parts = 1 + int((w_high - w_low) / _WIDEST)
    room = sum((regime.edges.shape[1] - 1) * parts * _LONGEST for regime in regimes)
    place, values = np.empty((_BLOCK, room)), np.empty((_BLOCK, 6, room))
    few, doubtful = np.empty((_BLOCK, 3, skeleton.size)), np.empty((_BLOCK, h.size), dtype=np.bool_)
    every, everywhere = np.ones((_BLOCK, skeleton.size), dtype=np.bool_), np.full(h.size, np.inf)
    for start in range(0, len(sums), _BLOCK):
        block = slice(start, min(start + _BLOCK, len(sums)))
        used = np.zeros(block.stop - start, dtype=np.int64)
        for put, (parameters, edges, branch, two_sided) in placed:
            pieces = parameters[block], edges[block], branch[block], two_sided
            put(w_low, nearest, heights.shape, *pieces, _RULES, _COUNTS, place, values, used)
        nodes = heights.shape, place, values, used, rows
        sum_rows(skeleton, reach, *nodes, every, few)
        _carry_over(few, carry, doubtful_below, values, used, rows[positive], positive, sums[block], doubtful)
        sum_rows(h, everywhere, *nodes, doubtful, sums[block])
    return True


@kernel
def _multiply(few, carry, total):
    """total = few @ carry, one row. A loop of our own: a threaded product and threads of callers would fight for the
    processors. Four terms at a time halve the traffic of `total`; every skeleton has a multiple of four."""
    total[:] = 0.0
    for at in range(0, few.size, 4):
        a, b, c, d = few[at], few[at + 1], few[at + 2], few[at + 3]
        for to in range(total.size):
            total[to] += a * carry[at, to] + b * carry[at + 1, to] + c * carry[at + 2, to] + d * carry[at + 3, to]


@kernel
def _mark_cancelled(total, size, doubtful_below, doubtful):
    for to in range(total.size):
        doubtful[to] = doubtful[to] | (total[to] < size * doubtful_below[to])


@kernel
def _carry_over(few, carry, doubtful_below, values, used, rows, positive, sums, doubtful):
    """sums[i] = few[i] @ carry, and what is doubtful: a positive sum too small against its size, the sum without the density.
    rows: those of the positive columns."""
    for i in range(sums.shape[0]):
        for q in range(sums.shape[1]):
            _multiply(few[i, q], carry, sums[i, q])
        doubtful[i, :] = False
        for at in range(rows.size):
            size = np.sum(values[i, rows[at], : used[i]])
            _mark_cancelled(sums[i, positive[at]], size, doubtful_below, doubtful[i])


@lru_cache(maxsize=64)
def _skeleton(h_bytes: bytes, w_low: float, w_high: float, heights: Heights) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Few separations (L,), the matrix (L, H) that carries sums at those over to h, and the share (H,) of its size, the sum
    without the density, below which a positive sum is doubtful.

    For a law that is a single spike at the displacement w, sums are the density at h + w. The matrix is the one that is best
    for all spikes w_low to w_high (least squares), and so for every law. Empty where no such matrix is good.
    """
    h = np.frombuffer(h_bytes)
    spikes = w_low + (w_high - w_low) * (1.0 - np.cos(np.linspace(0.0, math.pi, 300))) / 2.0
    wanted, largest = _spike_sums(h, spikes, heights)
    middle, half = (h.max() + h.min()) / 2.0, np.ptp(h) / 2.0
    good = max(_RESIDUAL, _ROUNDING * max(h.max() + w_low, 0.0) ** 2)
    for count in _SKELETONS:
        angle = (np.arange(count) + 0.5) * math.pi / count
        few = middle + half * np.cos(angle) / np.cos(angle[0])  # Chebyshev's points, stretched to both ends
        known, scale = _spike_sums(few, spikes, heights)
        left, values, right = np.linalg.svd(known, full_matrices=False)
        kept = values > 1e-15 * values[0]
        carry = (wanted @ right[kept].T / values[kept]) @ left[:, kept].T
        if np.abs(carry @ known - wanted).max() <= good:
            return few, np.ascontiguousarray((carry / scale).T * largest), good / _LOST * largest
    return np.empty(0), np.empty((0, h.size)), largest


def _spike_sums(h, spikes, heights: Heights) -> tuple[np.ndarray, np.ndarray]:
    """Density at h + w (H, spikes) over its largest value at each h, and that value (H,)."""
    z = np.add.outer(h, spikes)
    density = np.empty(z.size)
    _density_kernel(heights.density)(z.ravel(), heights.shape, density)
    table = density.reshape(z.shape)
    largest = np.maximum(table.max(axis=1), 1e-300)  # there may be no height in reach
    return table / largest[:, None], largest
