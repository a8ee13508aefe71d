"""The engine: sums any asperity law over any distribution of heights. The only place that integrates.

For mean separation h (over sigma) and heights with density phi, a regime contributes
    Integral f(u) phi(h + w(u)) w'(u) du        (Greenwood & Williamson 1966, in the regime's own coordinate u)
for f = 1 (number of asperities), load, area, slip-limited and yield-limited resistance. Gauss-Legendre on every piece
between kinks, where everything is smooth; the engine knows nothing of any model.

Two ways. `scattered`: each law has its own h; every node meets the density. `on_grid`: all laws share many h. There
phi(h + w) is expanded in Chebyshev polynomials of w, so that a law is reduced, once, to a few dozen moments
    M_j = Integral f(u) T_j(w(u)) w'(u) du,       sums(h) = sum_j M_j C_j(h),
and all separations are one matrix product. Where the product loses digits by cancellation, `scattered` steps in.
"""

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
from numba.np.unsafe.ndarray import to_fixed_tuple

from .asperity.regime import Regime
from .compiled import bind, formula, kernel
from .heights import Heights

QUANTITIES = ("touching", "load", "area", "slip_limited", "yield_limited")

# Nodes on a piece that is short or long against sigma: errors against 160 nodes are below 1e-11 of the sum of sizes for
# P, A and T over 6e5 random laws (docs/numerics.md).
_SHORT = 1.0
_COUNTS = np.array([24, 48])


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
along = coordinate = density = window = _cuts = None
PARAMETERS = 0


@formula
def _map_piece(low, high, origin):
    """Coefficients of u = low + linear t + square t^2, t in [0, 1]: linear, or in the square root of u - origin where the
    integrand has a square root branch point at `origin`, at or shortly below `low`."""
    if 0.0 <= low - origin < 0.1 * (high - low):
        near, far = math.sqrt(low - origin), math.sqrt(high - origin)
        return 2.0 * near * (far - near), (far - near) ** 2
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


def _scattered_template(h, law, heights, knots, parameters, edges, branch, rules, counts, out):
    """Sums out[i, quantity] of one regime, for the law number law[i] at the separation h[i]."""
    for i in range(h.size):
        row = to_fixed_tuple(parameters[law[i]], PARAMETERS)
        touching = load = area = slip = tear = 0.0
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
                linear, square = _map_piece(low, high, low if at_knot else branch[law[i]])
                for node in range(counts[rule]):
                    t = rules[rule, 0, node]
                    state = along(low + t * (linear + square * t), *row)
                    weight = rules[rule, 1, node] * (linear + 2.0 * square * t) * state[1]
                    weight *= density(h[i] + state[0], heights)
                    touching += weight
                    load += weight * state[2]
                    area += weight * state[3]
                    slip += weight * state[4]
                    tear += weight * state[5]
                low, z_low = high, z_cut
        out[i, 0] = touching
        out[i, 1] = load
        out[i, 2] = area
        out[i, 3] = slip
        out[i, 4] = tear


@kernel
def _expand(values, place, before, now, used, out):
    """Add sum_m values[q, m] T_j(place[m]) to out[q, j], by the three-term recurrence of the T_j."""
    for m in range(used):
        before[m] = place[m]  # T_(-1) = T_1
        now[m] = 1.0
    for j in range(out.shape[1]):
        a = b = c = d = e = 0.0
        for m in range(used):
            polynomial = now[m]
            a += values[0, m] * polynomial
            b += values[1, m] * polynomial
            c += values[2, m] * polynomial
            d += values[3, m] * polynomial
            e += values[4, m] * polynomial
            now[m] = 2.0 * place[m] * polynomial - before[m]
            before[m] = polynomial
        out[0, j] += a
        out[1, j] += b
        out[2, j] += c
        out[3, j] += d
        out[4, j] += e


def _moments_template(w_low, w_high, parameters, edges, branch, rules, counts, out, missed):
    """Add to out[i, quantity, j] the moments of one regime with T_j on displacements [w_low, w_high]; mark in missed[i]
    that a piece of the law lies wholly beyond."""
    room = (edges.shape[1] - 1) * counts[1]
    values, place = np.empty((5, room)), np.empty(room)
    before, now = np.empty(room), np.empty(room)
    for i in range(edges.shape[0]):
        row = to_fixed_tuple(parameters[i], PARAMETERS)
        used = 0
        for piece in range(edges.shape[1] - 1):
            left, right = edges[i, piece], edges[i, piece + 1]
            if not right > left:
                continue
            w_left, w_right = along(left, *row)[0], along(right, *row)[0]
            if not (w_right > w_low and w_left < w_high):
                missed[i] = True
                continue
            low = left if w_left >= w_low else max(left, coordinate(w_low, *row))
            high = right if w_right <= w_high else min(right, coordinate(w_high, *row))
            if not high > low:
                continue
            rule = 0 if min(w_right, w_high) - max(w_left, w_low) <= _SHORT else 1
            linear, square = _map_piece(low, high, branch[i])
            for node in range(counts[rule]):
                t = rules[rule, 0, node]
                state = along(low + t * (linear + square * t), *row)
                weight = rules[rule, 1, node] * (linear + 2.0 * square * t) * state[1]
                at = used + node
                place[at] = (2.0 * state[0] - (w_low + w_high)) / (w_high - w_low)
                values[0, at] = weight
                values[1, at] = weight * state[2]
                values[2, at] = weight * state[3]
                values[3, at] = weight * state[4]
                values[4, at] = weight * state[5]
            used += counts[rule]
        _expand(values, place, before, now, used, out[i])


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
def _moments_kernel(along, coordinate, parameters: int):
    return kernel(bind(_moments_template, along=along, coordinate=coordinate, PARAMETERS=parameters))


def _arrays(regime: Regime, laws: slice = slice(None)) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Parameters (n, p), edges (n, m) and branch (n,) as the kernels take them."""
    edges = np.ascontiguousarray(regime.edges[laws])
    columns = [np.broadcast_to(column, len(regime.edges))[laws] for column in regime.parameters]
    branch = np.full(len(edges), -np.inf) if regime.branch is None else np.ascontiguousarray(regime.branch[laws])
    return np.stack(columns, axis=1), edges, branch


def _one_regime(regime: Regime, h: np.ndarray, law: np.ndarray, heights: Heights) -> np.ndarray:
    parameters, edges, branch = _arrays(regime)
    compiled = _scattered_kernel(regime.along, regime.coordinate, heights.density, heights.window, parameters.shape[1])
    out = np.empty((h.size, len(QUANTITIES)))
    compiled(h, law, heights.shape, heights.knots, parameters, edges, branch, _RULES, _COUNTS, out)
    return out


def scattered(
    regimes: Sequence[Regime], h: np.ndarray, heights: Heights, law: np.ndarray | None = None
) -> np.ndarray:
    """Sums of every regime at single pairs of a law and a mean separation.

    regimes: each for n laws. h: array (m,), over sigma. law: array (m,) of numbers of laws; by default m = n and h[i]
    belongs to law i. Returns an array (regimes, m, 5), per asperity, in the order of QUANTITIES.
    """
    h = np.ascontiguousarray(h, dtype=float)
    law = np.arange(h.size) if law is None else np.ascontiguousarray(law)
    return np.stack([_one_regime(regime, h, law, heights) for regime in regimes])


# Fewer separations than this are cheaper one by one; a wider range would need too long an expansion.
_GRID_FROM = 12
_GRID_SPAN = 24.0
_CHEBYSHEV = 160
# A sum that is smaller than this times the sum of its terms' sizes has lost too many digits.
_CANCELLED = 1e-5
_BLOCK = 256  # laws at a time: their moments and sums stay in the processor's cache


def on_grid(regimes: Sequence[Regime], h: np.ndarray, heights: Heights, merge: bool = False) -> np.ndarray:
    """Sums of every regime for n laws at H mean separations that they share.

    h: array (H,), over sigma. Returns an array (regimes, n, 5, H) of what `scattered` gives; with merge, the regimes are
    added up and the first axis has length 1.
    """
    h = np.ascontiguousarray(h, dtype=float)
    laws, groups = len(regimes[0].edges), 1 if merge else len(regimes)
    sums = np.empty((groups, laws, len(QUANTITIES), h.size))
    doubtful = np.ones((groups, laws, h.size), dtype=np.bool_)
    if heights.entire and h.size >= _GRID_FROM and np.ptp(h) <= _GRID_SPAN:
        _by_moments(regimes, h, heights, sums, doubtful)
    for at in range(groups):
        law, place = np.nonzero(doubtful[at])
        if law.size:
            group = regimes if merge else [regimes[at]]
            sums[at, law, :, place] = scattered(group, h[place], heights, law).sum(axis=0)
    return sums


def _by_moments(regimes, h, heights, sums, doubtful):
    """Fill sums (groups, n, 5, H), and mark in doubtful (groups, n, H) those that lost digits to cancellation."""
    w_low = max(min(regime.lowest for regime in regimes), heights.window(-np.inf, np.inf, heights.shape)[0] - h.max())
    w_high = heights.window(h.min() + w_low, np.inf, heights.shape)[1] - h.min()
    expansion = _expansion(w_low, w_high, h, heights)
    largest = np.abs(expansion).max(axis=0)
    for start in range(0, sums.shape[1], _BLOCK):
        block = slice(start, min(start + _BLOCK, sums.shape[1]))
        moments = np.zeros((len(sums), block.stop - start, len(QUANTITIES), len(expansion)))
        missed = np.zeros(moments.shape[:2], dtype=np.bool_)
        for at, regime in enumerate(regimes):
            parameters, edges, branch = _arrays(regime, block)
            compiled = _moments_kernel(regime.along, regime.coordinate, parameters.shape[1])
            group = at % len(sums)
            compiled(w_low, w_high, parameters, edges, branch, _RULES, _COUNTS, moments[group], missed[group])
        _assemble(moments, expansion, largest, missed, sums[:, block], doubtful[:, block])


@kernel
def _assemble(moments, expansion, largest, missed, sums, doubtful):
    """sums = moments @ expansion; doubtful where a sum of positive terms is small against its bound sum_j |M_j| max_j |C_j|.

    It is doubtful too where it is zero because pieces were missed. The load, which changes sign, is as good as the area beside it. A loop of our own, because a threaded matrix product
    and threads of callers would fight for the processors.
    """
    for group in range(moments.shape[0]):
        for i in range(moments.shape[1]):
            moment, total = moments[group, i], sums[group, i]
            total[:, :] = 0.0
            for j in range(expansion.shape[0]):
                a, b, c, d, e = moment[0, j], moment[1, j], moment[2, j], moment[3, j], moment[4, j]
                for at in range(expansion.shape[1]):
                    term = expansion[j, at]
                    total[0, at] += a * term
                    total[1, at] += b * term
                    total[2, at] += c * term
                    total[3, at] += d * term
                    total[4, at] += e * term
            for q in (0, 2, 3, 4):
                size = 0.0
                for j in range(expansion.shape[0]):
                    size += abs(moment[q, j])
                for at in range(largest.size):
                    lost = abs(total[q, at]) < _CANCELLED * size * largest[at] or (size == 0.0 and missed[group, i])
                    doubtful[group, i, at] = lost or (q > 0 and doubtful[group, i, at])


@cache
def _cosines() -> np.ndarray:
    """cos(j angle_i) of the Chebyshev points angle_i = (2i + 1) pi / 2N, with whole turns taken off before rounding."""
    j, i = np.arange(_CHEBYSHEV)[:, None], np.arange(_CHEBYSHEV)
    return np.cos((j * (2 * i + 1)) % (4 * _CHEBYSHEV) * (math.pi / (2 * _CHEBYSHEV)))


def _expansion(w_low: float, w_high: float, h: np.ndarray, heights: Heights) -> np.ndarray:
    """Chebyshev coefficients (J, H) of the density at h + w, w in [w_low, w_high]; J is where they reach rounding."""
    cosines = _cosines()
    w = (w_low + w_high) / 2.0 + (w_high - w_low) / 2.0 * cosines[1]
    z = (h + w[:, None]).ravel()
    density = np.empty_like(z)
    _density_kernel(heights.density)(z, heights.shape, density)
    coefficients = (2.0 / _CHEBYSHEV) * (cosines @ density.reshape(_CHEBYSHEV, h.size))
    coefficients[0] /= 2.0
    share = (np.abs(coefficients) / np.abs(coefficients).max(axis=0)).max(axis=1)
    return np.ascontiguousarray(coefficients[: np.flatnonzero(share > 1e-14)[-1] + 1])
