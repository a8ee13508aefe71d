"""Find the kinks of the law of a graded film (modulus and hardness depend on depth), which are the edges of its regimes.

Each kind of kink is a zero of a function of the coordinate u, a signal (`graded_signals`). A signal is smooth, except for a
kink where the asperity begins to flow plastically. All signals are sampled together. Each sign change brackets a zero, which
is then refined. Where a signal nears zero without a sign change, a pair of zeros is searched for. Where a compressive load
would fall with growing displacement, it is held constant until the law regains it (S5.19). This plateau adds two edges.
"""

import math

import numpy as np

from stiction.engine.compiled import formula, lazy_kernel, unpack
from stiction.engine.sorting import sort_few
from stiction.engine.vectorised import exponential
from stiction.laws.film.shared.graded_law import ALONE, WHOLE, contact, depth_coordinate
from stiction.laws.film.shared.graded_signals import (
    ABOVE,
    BALANCE,
    NEARER,
    NUMBERS,
    REAL,
    SLOPE,
    SQUEEZED,
    beyond_zero,
    comes_near,
    load_before_plateaus,
    signal,
    signals,
    zero,
)

PARAMETERS = WHOLE  # number of parameters of the law before the plateaus
PLATEAUS = 3
BRANCHES = 4  # largest number of coordinates at which the yield resistance begins or ceases to be real
CAPACITY = 40  # largest number of edges
FAR = 79  # number of cells of the scan that are equal in ln u
SPARE = 8  # number of samples that can be inserted at kinks
INNER = 16  # number of samples of the load's slope on a segment
# Kinks at larger displacements are not searched for, because no asperity is pressed that far.
_DEEPEST = 10.0  # largest u, a displacement of 10^4 sigma
# Cells near the start are equal in ln(u - start): relative distances of the first and the last, number per factor e.
_NEAREST, _APART, _DENSE = 1e-9, 0.2, 4.0
NEAR = math.ceil(_DENSE * math.log(_APART / _NEAREST))
_SMALL = 0.5  # a signal smaller than this is searched for zeros even if the parabola through the samples is far from zero
_END = 1e8  # u, in place of infinity
_FADING, _FADED = 8.0, 40.0  # exponents at which the film's weight in the hardness is small, and below rounding

_PLACES = np.clip((1.0 - np.cos(np.pi * np.linspace(0.0, 1.0, INNER))) / 2.0, 1e-9, 1.0 - 1e-9)  # ends are kinks


@formula
def _add(out, count, u):
    """Append the coordinate u to the first `count` edges in `out` unless `out` is full, and return the new number of edges."""
    if count < out.size:
        out[count] = u
        return count + 1
    return count


@lazy_kernel(worth=100_000)
def _add_zeros(which, places, values, law, out, count):
    """Append the zeros of one signal, and the near misses of REAL, to the edges `out`; return the new number of edges.

    which: index of the signal, a function of u whose zeros are kinks. places, values: coordinates u of the samples, and the
    values of the signal there. law: parameters of an asperity on a graded film. count: number of edges so far.
    """
    before = values[0]
    # A branch point affects the integrand nearby, and the balance has sharp extrema. Other signals may be nearly constant.
    small = _SMALL if which in (REAL, BALANCE) else 0.0
    for j in range(places.size - 1):
        current, following = values[j], values[j + 1]
        if (current > 0.0) != (following > 0.0):
            count = _add(out, count, zero(which, places[j], current, places[j + 1], following, law, 0.0))
        elif comes_near(before, current, following, small):
            u, value = beyond_zero(which, places[j - 1], before, places[j], current, places[j + 1], following, law)
            if (value > 0.0) != (current > 0.0):
                count = _add(out, count, zero(which, places[j - 1], before, u, value, law, 0.0))
                count = _add(out, count, zero(which, u, value, places[j + 1], following, law, 0.0))
            elif which == REAL:  # a branch point at complex u near the real axis
                count = _add(out, count, u)
        before = current
    return count


@formula
def _sample_loads(law, edges, count, places, loads, slopes):
    """Sample load and slope at INNER coordinates in each segment between the first `count` edges.

    law: parameters of an asperity on a graded film. places, loads, slopes: arrays to be filled with the coordinates u, and
    with loads and slopes from `load_before_plateaus`.
    """
    for segment in range(count - 1):
        low, high = edges[segment], edges[segment + 1]
        inner = places[segment * INNER :]
        for k in range(INNER):
            inner[k] = low + (high - low) * _PLACES[k]
    for k in range(INNER * (count - 1)):
        load, slope, _ = load_before_plateaus(places[k], law)
        loads[k] = load
        slopes[k] = slope


@lazy_kernel(worth=100_000)
def _summit(low, kink, high, at_high, law):
    """Return the coordinate u of the load maximum between `low`, where the load rises, and `high`, where it falls.

    kink: an edge between them, at which the slope may jump, or `low`. at_high: slope of the load at `high`.
    """
    below, above = kink * (1.0 - 1e-13), kink * (1.0 + 1e-13)
    at_low = signal(NUMBERS[SLOPE], low, law, 0.0)
    if low < kink:
        before, after = signal(NUMBERS[SLOPE], below, law, 0.0), signal(NUMBERS[SLOPE], above, law, 0.0)
        if before < 0.0:
            high, at_high = below, before
        elif after < 0.0:
            return kink
        else:
            low, at_low = above, after
    return low if at_low <= 0.0 else zero(NUMBERS[SLOPE], low, at_low, high, at_high, law, 0.0)


@lazy_kernel(worth=100_000)
def _descent(low, high, law):
    """Return a coordinate between low and high at which the load falls, and the slope there, or (high, 0) if none is found."""
    for m in range(1, 64):
        u = low + (high - low) * m / 64.0
        slope = signal(NUMBERS[SLOPE], u, law, 0.0)
        if slope < 0.0:
            return u, slope
    return high, 0.0


@formula
def _first_flowing(part, count):
    """Return the index of the first segment in which the asperity flows plastically, or of the last edge if there is none.

    part: code for body and state of each segment, from `_name_parts`; odd codes are plastic. count: number of edges.
    """
    first = 0
    while first < count - 1 and (part[first] < 0 or part[first] % 2 == 0):
        first += 1
    return first


@lazy_kernel(worth=100_000)
def _regained(low, high, above, law, level):
    """Return the coordinate between low and high at which the load, after a drop, reaches `level` again.

    above: load minus `level` at `high`. law: parameters of an asperity on a graded film.
    """
    lacking = min(signal(NUMBERS[ABOVE], low, law, level), 0.0)
    return zero(NUMBERS[ABOVE], low, lacking, high, above, law, level)


@lazy_kernel(worth=100_000)
def _add_plateaus(law, edges, count, part, levels, places, loads, slopes):
    """Append start and end of each load plateau to the edges, and return the new number of edges.

    On a plateau the load of an asperity is held constant, because it would otherwise fall. law: parameters of an asperity
    on a graded film. The first `count` edges are sorted. part: code for body and state of each segment, from `_name_parts`.
    levels: filled with the start and the load of each plateau. places, loads, slopes: work arrays.
    """
    out = edges[_first_flowing(part, count) : count]  # an elastic asperity's load cannot fall
    _sample_loads(law, out, out.size, places, loads, slopes)
    known, plateau, on_plateau, level = count, 0, False, 0.0
    previous = out[0]
    for k in range(INNER * (out.size - 1)):
        kink, u, falling = out[k // INNER], places[k], slopes[k]
        if not u > kink:
            continue
        turn = u
        if not on_plateau and falling > 0.0 and k % INNER > 1 and comes_near(slopes[k - 2], slopes[k - 1], falling, NEARER):
            turn, falling = beyond_zero(
                NUMBERS[SLOPE], places[k - 2], slopes[k - 2], places[k - 1], slopes[k - 1], u, falling, law
            )
            previous = places[k - 1] if turn > places[k - 1] else places[k - 2]
        if not on_plateau and falling > 0.0 and k % INNER > 0 and loads[k] < loads[k - 1]:
            turn, falling = _descent(max(previous, places[k - 1]), u, law)
        elif on_plateau and falling < 0.0 and k % INNER > 0 and slopes[k - 1] > 0.0 and loads[k] < level:
            summit = _summit(places[k - 1], places[k - 1], u, falling, law)
            above = signal(NUMBERS[ABOVE], summit, law, level)
            if above > 0.0 and plateau < PLATEAUS:  # a peak between two samples
                previous = _regained(previous, summit, above, law, level)
                known, on_plateau = _add(edges, known, previous), False
        # The second pass is for a load that returns to the level and falls again before the sample.
        for _ in range(2):
            if not on_plateau and falling < 0.0 and plateau < PLATEAUS:
                start = _summit(previous, max(kink, previous), turn, falling, law)
                level = signal(NUMBERS[ABOVE], start, law, 0.0)
                known, on_plateau = _add(edges, known, start), True
                levels[2 * plateau], levels[2 * plateau + 1] = start, level
                plateau += 1
                previous = max(turn, start)
            if on_plateau and loads[k] > level:
                previous = _regained(previous, u, loads[k] - level, law, level)
                known, on_plateau = _add(edges, known, previous), False
            turn, falling = u, slopes[k]
        previous = u
    return known


@formula
def _fixed_edges(law, tau, out):
    """Fill `out` with the edges that are known in advance, and return three coordinates and the number of edges.

    The three are the start of the contact, the end of the range that `_scan` samples, and the coordinate at which the film is
    pressed through (the end of the range if this is farther). tau: displacement at which this happens, in units of sigma.
    Further edges split long segments. law: parameters of an asperity on a graded film.
    """
    pull, _, n_H, linear, square = law[:5]
    S, bodies = math.sqrt(6.0 * pull), law[ALONE:]
    start = depth_coordinate(0.0, S, bodies)
    top = max(_DEEPEST, 2.5 * start)
    out[0], out[1] = start, top
    through = depth_coordinate(tau, S, bodies) if tau < top**4 else top
    out[2] = max(through, start)
    out[3] = math.sqrt(math.sqrt(start**4 + 2.0))  # at w of about 2, because long segments are hard to integrate
    count = 4
    if n_H != 1.0 and max(linear, square) > 0.0:
        # The effect of a hard film fades over many times its own thickness, which is split by an edge.
        for exponent in (_FADED, _FADING):
            faded = exponent / linear if linear > 0.0 else math.sqrt(exponent / square)
            if faded < top**4 and (exponent == _FADED or n_H > 1.0):
                count = _add(out, count, depth_coordinate(faded, S, bodies))
    return start, top, through, count


@lazy_kernel(worth=1_000_000)
def _scan(start, top, law, places, values):
    """Sample all signals from the coordinate `start` to `top`, and return the number of samples.

    Signals are functions of u whose zeros are kinks. places, values: filled with coordinates and signals. law: parameters
    of an asperity on a graded film. Samples are dense near the start, because a thin film matters only there.
    """
    pull, _, n_H, linear, square = law[:5]
    slope = contact(start, math.sqrt(6.0 * pull), law[ALONE:])[1]
    soon = 1.0 / ((linear + math.sqrt(square)) * slope * start) if n_H != 1.0 and linear + square > 0.0 else _APART
    nearest = max(_NEAREST, min(0.02 * soon, 0.5 * _APART))
    cells = math.ceil(_DENSE * math.log(_APART / nearest))
    near, far = math.log(nearest / _APART) / cells, math.log(top / (start * (1.0 + _APART))) / FAR
    places[0], places[1] = start, start * (1.0 + 1e-3 * nearest)  # shows whether signals rise or fall at the start
    for j in range(1, cells):
        places[1 + j] = start * (1.0 + _APART * exponential(near * (cells - j)))
    for j in range(FAR + 1):
        places[1 + cells + j] = top * exponential(far * (j - FAR))
    size = cells + FAR + 2
    for j in range(size):
        _sample(j, law, places, values)
    return size


@formula
def _sample(j, law, places, values):
    values[0, j], values[1, j], values[2, j], values[3, j], values[4, j] = signals(places[j], law)


@lazy_kernel(worth=100_000)
def _insert(kinks, law, places, values, size):
    """Insert samples of all signals at the coordinates `kinks`, and return the total number of samples.

    At a kink of one signal the others may have an extremum. Coordinates already sampled are skipped; full arrays are not
    extended. places, values: coordinates u and signals, in ascending order, `size` of each. law: parameters of a graded film.
    """
    for u in kinks:
        position = size
        while position > 0 and places[position - 1] > u:
            position -= 1
        if size == places.size or (position > 0 and places[position - 1] == u):
            continue
        for to in range(size, position, -1):  # element by element: assigning slices takes seconds to compile
            places[to] = places[to - 1]
            for row in range(values.shape[0]):
                values[row, to] = values[row, to - 1]
        places[position] = u
        _sample(position, law, places, values)
        size += 1
    return size


@lazy_kernel(worth=1_200)
def _fill(parameters, tau, edges, part, levels, branch):
    samples, scan = np.empty((5, NEAR + FAR + 2 + SPARE)), np.empty(NEAR + FAR + 2 + SPARE)
    places, loads, slopes = np.empty(CAPACITY * INNER), np.empty(CAPACITY * INNER), np.empty(CAPACITY * INNER)
    for i in range(tau.size):
        law = unpack(parameters[i], PARAMETERS)
        out = edges[i]
        start, top, through, count = _fixed_edges(law, tau[i], out)
        before, size = count, _scan(start, top, law, scan, samples)
        count = _add_zeros(NUMBERS[0], scan[:size], samples[0], law, out, count)
        size = _insert(out[before:count], law, scan, samples, size)  # because the load has kinks there
        count = _add_zeros(NUMBERS[1], scan[:size], samples[1], law, out, count)
        before = count
        count = _add_zeros(NUMBERS[REAL], scan[:size], samples[REAL], law, out, count)
        count = _add_branches(start, samples[REAL, 0], law, out, before, count, branch[i])
        plastic = size - 1  # index of the first of the last samples, which are fully plastic and have no resistance
        while plastic > 0 and samples[1, plastic - 1] > 0.0:
            plastic -= 1
        count = _add_zeros(NUMBERS[SQUEEZED], scan[: plastic + 1], samples[SQUEEZED], law, out, count)
        count = _add_zeros(NUMBERS[BALANCE], scan[: plastic + 1], samples[BALANCE], law, out, count)
        for j in range(count):
            out[j] = min(max(out[j], start), top)
        sort_few(out[:count])
        levels[i, 0::2], levels[i, 1::2] = math.inf, 0.0
        _name_parts(law, through, out, count, part[i])
        known = _add_plateaus(law, out, count, part[i], levels[i], places, loads, slopes)
        if known > count:
            sort_few(out[:known])
            _name_parts(law, through, out, known, part[i])


@lazy_kernel(worth=100_000)
def _add_branches(start, at_start, law, out, first, count, branch):
    """Fill `branch` with the branch points of the yield resistance, and return the new number of edges.

    start: first coordinate of the contact. at_start: value there of a signal that is positive where the yield resistance is
    real. law: parameters of an asperity on a graded film. out[:count]: edges; out[first:count]: those that are
    branch points. If at_start > 0, one more branch point is estimated at the start or below (-inf if there is none). An edge is
    added between neighbouring branch points, because the substitution that removes a square root works at one end of a segment.
    """
    branch[:] = -math.inf
    kinks = out[first:count]
    sort_few(kinks)
    known = 0
    if at_start > 0.0:
        low, at_low, below = start, at_start, 0.005
        while at_low > 0.0 and below < 0.2:
            high, at_high = low, at_low
            low = start * (1.0 - below)
            at_low, below = signal(NUMBERS[REAL], low, law, 0.0), 3.0 * below
        if at_low < 0.0:
            branch[0] = low - at_low * (high - low) / (at_high - at_low)  # an estimate is enough, because no segment is there
        elif at_start < _SMALL:  # at complex u near the real axis
            branch[0] = start
        known = 1
    for u in kinks[: branch.size - known]:
        branch[known] = u
        known += 1
    for j in range(known - 1):  # a branch point at -inf gives an edge below the start, which has no effect
        count = _add(out, count, 0.5 * (branch[j] + branch[j + 1]))
    return count


@formula
def _name_parts(law, through, edges, count, part):
    """Fill `part` with a code for body and state of every segment between the edges.

    The codes are 0 elastic film, 1 plastic film, 2 elastic substrate, 3 plastic substrate, -1 no segment. The unbounded
    segment after the last edge is included. through: coordinate at which the film is pressed through. edges: the first
    `count` are used, the others are set to _END. law: parameters of an asperity on a graded film.
    """
    edges[count:] = _END
    part[:] = -1
    for segment in range(count):
        low, high = edges[segment], edges[segment + 1]
        plastic = signals(0.5 * (low + min(high, 2.0 * low)), law)[0] > 0.0
        name = (0 if high <= through else 2) + (1 if plastic else 0)
        part[segment] = name if high > low else -1


def find_kinks(parameters: np.ndarray, tau: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return edges, part codes, plateaus and branch points of asperities on graded films, for n contacts.

    parameters: (n, PARAMETERS) of the law. tau (n,): displacement, in units of sigma, at which the film is pressed through.

    The edges (n, CAPACITY) are coordinates u. The part codes (n, CAPACITY - 1) give body and state of each segment between
    them: 0 elastic film, 1 plastic film, 2 elastic substrate, 3 plastic substrate, -1 no segment. The plateaus (n, 6) are
    three pairs (start, level): for u >= `start` the load is at least `level`; an unused pair is (inf, 0). The branch points
    (n, 4), -inf if unused, are coordinates at which the yield resistance begins or ceases to be real, with an infinite slope.
    """
    laws = len(parameters)
    edges, part = np.empty((laws, CAPACITY)), np.empty((laws, CAPACITY - 1), dtype=np.int8)
    levels, branch = np.empty((laws, 2 * PLATEAUS)), np.empty((laws, BRANCHES))
    _fill(np.ascontiguousarray(parameters), np.ascontiguousarray(tau), edges, part, levels, branch)
    return edges, part, levels, branch


@lazy_kernel(worth=3_000)
def _gather(edges, part, wanted, out):
    for i in range(edges.shape[0]):
        column = 0
        for segment in range(part.shape[1] - 1, -1, -1):
            if part[i, segment] == wanted:
                out[i, column], out[i, column + 1] = edges[i, segment], edges[i, segment + 1]
                column += 2
        out[i, column:] = edges[i, 0]


def gather(edges: np.ndarray, part: np.ndarray, wanted: int) -> np.ndarray:
    """Return the edges (n, m) of a regime that consists of all segments of one body in one state.

    edges (n, CAPACITY): from `find_kinks`. part (n, CAPACITY - 1): code from 0 to 3 for body and state of each segment,
    also from `find_kinks`. wanted: the code whose segments are returned. Segments are listed as pairs (low, high) in
    descending order. The gap between two of them is therefore a pair of edges that does not increase, which the engine
    skips. Shorter rows are filled with the first edge.
    """
    most = int((part == wanted).sum(axis=1).max(initial=1))
    out = np.empty((len(edges), 2 * most))
    _gather(edges, part, wanted, out)
    return out
