"""Where the law of a graded film has kinks: the edges of its regimes.

Each kind of kink is a zero of a smooth function of u: they are sampled together, sign changes are refined inside their
bracket, and near misses of zero between samples are looked into. Where the load would fall although it is compressive, the
asperity keeps it until it is reached again (S5.18): that plateau has two ends more.
"""

import math

import numpy as np
from numba.np.unsafe.ndarray import to_fixed_tuple

from ..asperity.transition import FULLY_PLASTIC, plastic_share
from ..compiled import formula, kernel
from ..friction.edge_yield import coefficients
from ..heights import exponential
from .graded_law import contact, depth_coordinate, fading

PARAMETERS = 14  # of the law, before the plateaus
PLATEAUS = 3
CAPACITY = 40  # edges
CELLS = 96  # of the scan, equal in ln u
INNER = 10  # samples of the load's slope on a piece
# Kinks at more than this displacement are left alone: no asperity gets there.
_DEEPEST = 10.0  # u; x = 10^4
_END = 1e8  # u, in place of infinity
_FADED = 40.0  # exponent at which the film's share in the hardness is rounding

_PLACES = (1.0 - np.cos(np.pi * (np.arange(INNER) + 0.5) / INNER)) / 2.0


@formula
def signals(u, law):
    """Functions of u whose zeros are kinks: first yield, full plasticity, the yield resistance ceases to be real in tension
    (a branch point, S3.9), it reaches zero in compression (S3.10), and slip equals yield (S3.11, over the strength)."""
    pull, eta, n_E, n_H, per_aspect, nu, linear, square, nu_s, nu_c, Kb_s, Kb_c, yield_s, yield_c = law
    S = math.sqrt(6.0 * pull)
    w, _, Q, _, share = contact(u, S, n_E, per_aspect, nu)
    film = fading(w, linear, square)
    x = u * u * u * u
    load, flowing = Q * (Q - S), eta * (1.0 + (n_H - 1.0) * film) * x
    strength = eta * x * (yield_s + (yield_c - yield_s) * film)
    ratio = load / flowing
    n, p, q = coefficients(nu_s + (nu_c - nu_s) * share)
    d = p * p + q * q - p * q
    P = min(load, flowing) / strength
    K_beta = Kb_s + (Kb_c - Kb_s) * share
    T = 4.0 * math.sqrt(max(2.0 * pull * P + 3.0 * pull * pull / strength, 0.0) / (K_beta * strength))
    squeeze = math.sqrt(3.0) * n * P
    balance = squeeze * squeeze + 3.0 * n * (p - q) * P * T + d * T * T - 1.0
    real = 2.0 * math.sqrt(d) + (p + q) * squeeze
    return ratio - 1.0, ratio - FULLY_PLASTIC, real, 1.0 - squeeze, balance


@formula
def load_before_plateaus(u, law):
    """Load, its derivative by u, and elastic mean pressure over hardness."""
    pull, eta, n_E, n_H, per_aspect, nu, linear, square = law[:8]
    S = math.sqrt(6.0 * pull)
    w, slope, Q, growth, _ = contact(u, S, n_E, per_aspect, nu)
    film = fading(w, linear, square)
    x, dx = u * u * u * u, 4.0 * u * u * u
    elastic, d_elastic = Q * (Q - S), (2.0 * Q - S) * Q * growth / u
    hardness = eta * (1.0 + (n_H - 1.0) * film)
    d_hardness = -eta * (n_H - 1.0) * film * (linear + 2.0 * square * max(w, 0.0)) * slope
    flowing, d_flowing = hardness * x, d_hardness * x + hardness * dx
    ratio = elastic / flowing
    d_ratio = (d_elastic - ratio * d_flowing) / flowing
    f, df = plastic_share(ratio)
    full, d_full = 2.0 * (hardness * w - pull), 2.0 * (d_hardness * w + hardness * slope)
    capped, d_capped = (elastic, d_elastic) if ratio <= 1.0 else (flowing, d_flowing)
    load = capped + f * (full - capped)
    return load, d_capped + df * d_ratio * (full - capped) + f * (d_full - d_capped), ratio


@kernel
def _signal(which, u, law):
    return signals(u, law)[which]


@kernel
def _load(u, law):
    return load_before_plateaus(u, law)


@kernel
def _zero(which, low, at_low, high, at_high, law):
    """The zero of one signal in a bracket: false position (Anderson & Bjorck 1973), halving where that is slow."""
    last = low
    for turn in range(80):
        u = high - at_high * (high - low) / (at_high - at_low)
        if turn % 4 == 3 or not low < u < high:
            u = 0.5 * (low + high)
        value = _signal(which, u, law)
        if value == 0.0 or abs(u - last) <= 3e-15 * u:
            return u
        if (value > 0.0) == (at_high > 0.0):
            shrink = 1.0 - value / at_high
            at_low *= shrink if shrink > 0.0 else 0.5
            high, at_high = u, value
        else:
            shrink = 1.0 - value / at_low
            at_high *= shrink if shrink > 0.0 else 0.5
            low, at_low = u, value
        last = u
    return u


@kernel
def _nearest_to_zero(which, low, high, sign, law):
    """The least of sign * signal in (low, high), by thirds, and its place; stops as soon as it is negative."""
    u = value = 0.0
    for _ in range(50):
        third = (high - low) / 3.0
        left, right = sign * _signal(which, low + third, law), sign * _signal(which, high - third, law)
        if left < right:
            u, value, high = low + third, left, high - third
        else:
            u, value, low = high - third, right, low + third
        if value < 0.0:
            break
    return u, value


@formula
def _add(out, count, u):
    """Append u to the edges, while there is room."""
    if count < out.size:
        out[count] = u
        return count + 1
    return count


@kernel
def _add_zeros(which, places, values, law, out, count):
    """Append the zeros of one signal that was sampled at `places`."""
    last = places.size - 1
    for j in range(last):
        here, there = values[j], values[j + 1]
        if (here > 0.0) != (there > 0.0):
            count = _add(out, count, _zero(which, places[j], here, places[j + 1], there, law))
        elif 0 < j and (here > 0.0) == (values[j - 1] > 0.0) and abs(here) <= min(abs(there), abs(values[j - 1])):
            bend = there - 2.0 * here + values[j - 1]
            vertex = here - (there - values[j - 1]) ** 2 / (8.0 * bend) if bend != 0.0 else here
            if vertex / here < 0.5:  # the parabola through the three comes near to zero
                sign = math.copysign(1.0, here)
                u, value = _nearest_to_zero(which, places[j - 1], places[j + 1], sign, law)
                if value < 0.0:
                    value *= sign
                    count = _add(out, count, _zero(which, places[j - 1], values[j - 1], u, value, law))
                    count = _add(out, count, _zero(which, u, value, places[j + 1], there, law))
    return count


@kernel
def _summit(low, high, law):
    """Where the load stops rising between low, where it rises, and high, where it falls: bisection."""
    for _ in range(48):
        middle = 0.5 * (low + high)
        if _load(middle, law)[1] > 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@kernel
def _regained(low, high, level, law):
    """Where the load comes up to `level` again between low, where it is lower, and high: bisection."""
    for _ in range(48):
        middle = 0.5 * (low + high)
        if _load(middle, law)[0] < level:
            low = middle
        else:
            high = middle
    return high


@kernel
def _add_plateaus(law, out, count, levels, loads, slopes):
    """Append the ends of the plateaus of the load to the sorted edges out[:count]; levels: (start, level) of each."""
    first = 0  # the load can fall only once the asperity flows
    while first < count - 1 and not _signal(0, 0.5 * (out[first] + out[first + 1]), law) > 0.0:
        first += 1
    pieces = count - 1 - first
    for piece in range(pieces):
        low, high = out[first + piece], out[first + piece + 1]
        for k in range(INNER):
            state = load_before_plateaus(low + (high - low) * _PLACES[k], law)
            loads[piece * INNER + k], slopes[piece * INNER + k] = state[0], state[1]
    known, at, held, level = count, 0, False, 0.0
    previous = out[first]
    for piece in range(pieces):
        low, high = out[first + piece], out[first + piece + 1]
        if not high > low:
            continue
        for k in range(INNER):
            u, load, slope = low + (high - low) * _PLACES[k], loads[piece * INNER + k], slopes[piece * INNER + k]
            if held and load > level:
                previous = _regained(previous, u, level, law)
                known, held = _add(out, known, previous), False
            if not held and slope < 0.0 and at < PLATEAUS:
                start = _summit(previous, u, law)
                level = _load(start, law)[0]
                known, held = _add(out, known, start), True
                levels[2 * at], levels[2 * at + 1] = start, level
                at += 1
            previous = u
    return known


@formula
def _fixed_edges(law, tau, out):
    """Start, film pressed through, film faded, contact as wide as the film is thick, end of the scan; their number."""
    pull, _, n_E, n_H, per_aspect, nu, linear, square = law[:8]
    S = math.sqrt(6.0 * pull)
    start = depth_coordinate(0.0, S, n_E, per_aspect, nu)
    top = max(_DEEPEST, 2.5 * start)
    out[0], out[1] = start, top
    through = depth_coordinate(tau, S, n_E, per_aspect, nu) if tau < top**4 else top
    out[2] = max(through, start)
    count = 3
    if n_E != 1.0:
        count = _add(out, count, 1.0 / math.sqrt(per_aspect))
    if n_H != 1.0 and max(linear, square) > 0.0:
        faded = _FADED / linear if linear > 0.0 else math.sqrt(_FADED / square)
        if faded < top**4:
            count = _add(out, count, depth_coordinate(faded, S, n_E, per_aspect, nu))
    return start, top, through, count


@kernel
def _scan(start, top, law, places, values):
    """Sample the signals at CELLS + 1 places, equal in ln u."""
    step = math.log(top / start) / (places.size - 1)
    for j in range(places.size):
        u = top * exponential(-step * (places.size - 1 - j))
        state = signals(u, law)
        places[j] = u
        values[0, j], values[1, j], values[2, j], values[3, j], values[4, j] = state


@kernel
def _fill(parameters, tau, edges, part, levels, branch):
    samples = np.empty((5, CELLS + 1))
    places = np.empty(CELLS + 1)
    loads, slopes = np.empty(CAPACITY * INNER), np.empty(CAPACITY * INNER)
    for i in range(tau.size):
        law = to_fixed_tuple(parameters[i], PARAMETERS)
        out = edges[i]
        start, top, through, count = _fixed_edges(law, tau[i], out)
        _scan(start, top, law, places, samples)
        count = _add_zeros(0, places, samples[0], law, out, count)
        count = _add_zeros(1, places, samples[1], law, out, count)
        before = count
        count = _add_zeros(2, places, samples[2], law, out, count)
        branch[i] = -math.inf
        if count > before:
            branch[i] = out[count - 1]
        elif _signal(2, 0.5 * start, law) < 0.0 < samples[2, 0]:
            branch[i] = _zero(2, 0.5 * start, _signal(2, 0.5 * start, law), start, samples[2, 0], law)
        flowing = CELLS  # beyond the last sample that is not fully plastic nothing resists
        while flowing > 0 and samples[1, flowing - 1] > 0.0:
            flowing -= 1
        used = places[: flowing + 1]
        count = _add_zeros(3, used, samples[3, : flowing + 1], law, out, count)
        count = _add_zeros(4, used, samples[4, : flowing + 1], law, out, count)
        for at in range(count):
            out[at] = min(max(out[at], start), top)
        out[:count].sort()
        levels[i, 0::2], levels[i, 1::2] = math.inf, 0.0
        count = _add_plateaus(law, out, count, levels[i], loads, slopes)
        out[:count].sort()
        out[count:] = _END
        for piece in range(CAPACITY - 1):
            low, high = out[piece], out[piece + 1]
            part[i, piece] = -1
            if high > low:
                plastic = _signal(0, 0.5 * (low + min(high, 2.0 * low)), law) > 0.0
                part[i, piece] = (0 if high <= through else 2) + (1 if plastic else 0)


def find_kinks(parameters: np.ndarray, tau: np.ndarray) -> tuple[np.ndarray, ...]:
    """Edges (n, CAPACITY) in u, the part (n, CAPACITY - 1) of each piece between them, plateaus (n, 6) and branch (n,).

    parameters: array (n, 14). Part: 0 elastic film, 1 plastic film, 2 elastic substrate, 3 plastic substrate, -1 no piece;
    the film is pressed through at the displacement tau (n,). Plateaus: from start on the load is at least level, thrice.
    """
    laws = len(parameters)
    edges, part = np.empty((laws, CAPACITY)), np.empty((laws, CAPACITY - 1), dtype=np.int8)
    levels, branch = np.empty((laws, 2 * PLATEAUS)), np.empty(laws)
    _fill(np.ascontiguousarray(parameters), np.ascontiguousarray(tau), edges, part, levels, branch)
    return edges, part, levels, branch


@kernel
def _gather(edges, part, wanted, out):
    for i in range(edges.shape[0]):
        at = 0
        for piece in range(part.shape[1] - 1, -1, -1):
            if part[i, piece] == wanted:
                out[i, at], out[i, at + 1] = edges[i, piece], edges[i, piece + 1]
                at += 2
        out[i, at:] = edges[i, 0]


def gather(edges: np.ndarray, part: np.ndarray, wanted: int) -> np.ndarray:
    """Edges (n, m) of a regime that consists of the pieces of this part. They need not touch: the deepest piece comes first,
    so that what lies between two of them is a pair of edges that does not increase, which the engine passes over."""
    most = int((part == wanted).sum(axis=1).max(initial=1))
    out = np.empty((len(edges), 2 * most))
    _gather(edges, part, wanted, out)
    return out
