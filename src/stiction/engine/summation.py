"""Sum any asperity law over any distribution of heights.

For mean separation h (in units of sigma) and heights with density phi, a regime (a smooth part of an asperity's behaviour) adds
    Integral f(u) phi(h + w(u)) w'(u) du        (Greenwood & Williamson 1966, in the regime's own coordinate u)
for f = 1 (number of asperities), load, area, slip-limited and yield-limited resistance; w is the displacement of the asperity
in units of sigma. Every segment between two kinks is smooth and is integrated by a Gauss-Legendre rule. The engine itself
contains no law.

Two functions compute such sums. `scattered` takes one separation for each law (parameter set). `on_grid` takes many separations
that all laws share: it sums every law at a few separations, with nodes placed once, and extends these sums to all separations
by one matrix (`skeleton`). The loops are in `sum_kernels` and `nodes`. Two modules have faster sums for Gaussian heights:
`starting_separations` and `own_separations`.
"""

from collections import deque
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from itertools import pairwise

import numpy as np

from stiction.engine.expansions import TERMS, expand, read_series, series_for
from stiction.engine.heights import Heights, gaussian_density
from stiction.engine.nodes import Laws, Parts, Rows, adding, cutting, displacements, evaluate_parts
from stiction.engine.placing import Placing
from stiction.engine.regime import Regime
from stiction.engine.skeleton import carry_over, near_each_other, skeleton
from stiction.engine.stopping import raise_if_stopped
from stiction.engine.sum_kernels import LONGEST, listing, scattering, summing
from stiction.engine.tiers import ENGINE, specialised
from stiction.quantities.errors import InputError

QUANTITIES = ("touching", "load", "area", "slip_limited", "yield_limited")
_TOTALS = ("load", "area", "resistance")

# Largest separation, in units of sigma. Larger ones have no physical meaning, and their squares lose all digits to rounding.
FARTHEST = 1e6
# Numbers of nodes on a segment that is short or long compared with sigma. Errors are below 1e-10 for all valid inputs, with and
# without a film: docs/measure_accuracy.py measures them, docs/explanation/numerics.md shows them. They are multiples of eight,
# as the loops over nodes state explicitly, so that the compiler needs no loop over a remainder.
_COUNTS = np.array([24, LONGEST])


def _make_rules(counts: np.ndarray) -> np.ndarray:
    """Return integration nodes and weights (rules, 2, longest) on [0, 1], one rule for each number of nodes in `counts`.

    Gauss-Legendre nodes t are moved to t + 0.3 t (1 - t), and their weights are multiplied by the derivative of this map. The
    factor 0.3 was chosen by measured errors (docs/measure_accuracy.py).
    """
    rules = np.zeros((len(counts), 2, max(counts)))
    for rule, count in zip(rules, counts, strict=True):
        nodes, weights = np.polynomial.legendre.leggauss(count)
        t, weights = (nodes + 1.0) / 2.0, weights / 2.0
        rule[:, :count] = t + 0.3 * t * (1.0 - t), weights * (1.3 - 0.6 * t)
    return rules


_RULES = _make_rules(_COUNTS)


def check_threads(threads: object) -> None:
    """Raise an InputError unless `threads` is a whole number of 1 or more."""
    if isinstance(threads, bool) or not (isinstance(threads, int | np.integer) and threads >= 1):
        raise InputError("threads", threads, "a whole number, 1 or more")


def in_threads(work: Callable, parts: Iterable, threads: int) -> None:
    """Call `work` for every part, on up to `threads` threads, and wait until all are done.

    Threads run in parallel because compiled loops release the global interpreter lock.
    """
    if threads == 1:
        for part in parts:
            work(part)
        return
    with ThreadPoolExecutor(threads) as pool:
        under_way: deque = deque()
        for part in parts:  # few parts exist at a time, because each takes memory
            raise_if_stopped()
            under_way.append(pool.submit(work, part))
            if len(under_way) > 2 * threads:
                under_way.popleft().result()
        for future in under_way:
            future.result()


def _slices(size: int, threads: int) -> list[slice]:
    """Return at most `threads` slices of about equal length that together cover `size` elements."""
    ends = np.linspace(0, size, min(threads, max(size, 1)) + 1).astype(int)
    return [slice(int(start), int(stop)) for start, stop in pairwise(ends)]


def scattered(
    regimes: Sequence[Regime], h: np.ndarray, heights: Heights, law: np.ndarray | None = None, threads: int = 1
) -> np.ndarray:
    """Return the sums of every regime at m pairs of a law and a mean separation.

    regimes: smooth parts of an asperity's behaviour, each for n laws (parameter sets). h: array (m,) in units of sigma.
    heights: distribution of the heights. law: array (m,) of indices of laws; by default h[i] belongs to law i, and m = n.
    threads: largest number of threads. Returns an array (regimes, m, 5) of averages over all asperities: fraction touching,
    load, area, slip-limited and yield-limited resistance.
    """
    return Scattered(regimes, heights)(h, np.arange(np.size(h)) if law is None else law, threads)


class Scattered:
    """Sum regimes over asperity heights, for given pairs (law, separation).

    regimes: smooth parts of an asperity's behaviour, each for n laws (parameter sets). heights: distribution of the heights.
    Calculations that do not depend on the separations are done once.
    """

    def __init__(self, regimes: Sequence[Regime], heights: Heights):
        self.regimes, self.heights = regimes, heights

    def __call__(self, h: np.ndarray, law: np.ndarray, threads: int = 1) -> np.ndarray:
        """Return m sums over asperity heights, (regimes, m, 5), each for parameter set law[i] at the separation h[i].

        h: in units of sigma. threads: largest number of threads. The five values are averages over all asperities: fraction
        touching, load, area, slip-limited and yield-limited resistance.
        """
        h, law = np.ascontiguousarray(h, dtype=float), np.ascontiguousarray(law)
        out = np.empty((len(self.regimes), h.size, len(QUANTITIES)))
        ENGINE.take(len(self.regimes) * h.size)
        if self.heights.density is gaussian_density and (series := series_for(h, law)) is not None:
            self._fill_by_series(h, *series, out)
            return out
        for fill, sums in zip(self._fills(h.size), out, strict=True):

            def fill_slice(part: slice, fill=fill, sums=sums) -> None:
                fill(h[part], law[part], sums[part])

            in_threads(fill_slice, _slices(h.size, threads), threads)
        return out

    def _fill_by_series(self, h: np.ndarray, about: np.ndarray, law: np.ndarray, number: np.ndarray, out: np.ndarray) -> None:
        """Store sums computed from Taylor series about a few separations in `out` (regimes, m, 5).

        h (m,): separations in units of sigma. about, law (s,): separation, and index of the parameter set, of each series.
        number (m,): index of the series of each sum.
        """
        for fill, sums in zip(self._expanded, out, strict=True):
            coefficients = np.empty((about.size, TERMS, len(QUANTITIES)))
            fill(about, law, coefficients)
            read_series(h - about[number], number, coefficients, sums)

    @cached_property
    def _expanded(self) -> list[Callable]:
        return [_summing_in_stages(regime, self.heights, expand) for regime in self.regimes]

    def _fills(self, pairs: int) -> list[Callable]:
        if self.heights.listed.size:
            return self._listed
        return self._alone if self.regimes and specialised(len(self.regimes[0].edges), pairs) else self._in_stages

    @cached_property
    def _listed(self) -> list[Callable]:
        return [_summing_listed(regime, self.heights) for regime in self.regimes]

    @cached_property
    def _alone(self) -> list[Callable]:
        return [_summing_alone(regime, self.heights) for regime in self.regimes]

    @cached_property
    def _in_stages(self) -> list[Callable]:
        add = adding(self.heights.density)
        return [_summing_in_stages(regime, self.heights, add) for regime in self.regimes]


def _summing_listed(regime: Regime, heights: Heights) -> Callable:
    """Return a function fill(h, law, sums) that averages one regime over heights listed one by one.

    fill stores five averages (see `on_grid`) in row i of `sums` (m, 5): at separation h[i], for the law (parameter set) with
    index law[i].
    """
    average, laws = listing(regime.along, regime.coordinate, len(regime.parameters)), tuple(Laws.of(regime))
    return lambda h, law, sums: average(h, law, heights.listed, laws, sums)


def _summing_alone(regime: Regime, heights: Heights) -> Callable:
    """Return a function fill(h, law, sums) that sums one regime over heights, in one loop compiled for this regime.

    fill stores five averages (see `on_grid`) in row i of `sums` (m, 5): at separation h[i], for the law (parameter set) with
    index law[i].
    """
    compiled = scattering(regime.along, regime.coordinate, heights.density, heights.window, len(regime.parameters))
    arguments = (heights.shape, heights.knots), tuple(Laws.of(regime)), (_RULES, _COUNTS)
    return lambda h, law, sums: compiled(h, law, *arguments, sums)


def _summing_in_stages(regime: Regime, heights: Heights, add: Callable) -> Callable:
    """Return a function fill(h, law, sums) that sums one regime over heights, mostly in loops that all regimes share.

    Only two short loops are compiled for the regime. add: the compiled loop of the last stage, which fills `sums`;
    `nodes.adding` and `expansions` provide such loops. fill stores five averages (see `on_grid`) in `sums`, (m, 5) or as `add`
    requires: row i at separation h[i], for the law (parameter set) with index law[i].
    """
    laws = Laws.of(regime)
    at_edges = laws.edges, displacements(regime, laws)
    cut, of_heights = cutting(heights.window), (heights.shape, heights.knots)
    most = (laws.edges.shape[1] - 1) * (1 + heights.knots.size)
    block = max(1, _PARTS // most)

    def fill(h: np.ndarray, law: np.ndarray, sums: np.ndarray) -> None:
        parts = Parts.room(min(block, h.size) * most)
        rows = Rows.room(len(parts.law), (_RULES, _COUNTS))
        for start in range(0, h.size, block):
            some = slice(start, min(start + block, h.size))
            used = cut(h[some], law[some], of_heights, at_edges, tuple(parts))
            evaluated = evaluate_parts(regime, laws, parts, used, (_RULES, _COUNTS), rows)
            add(h[some], heights.shape, tuple(evaluated), sums[some])

    return fill


_PARTS = 4096  # most integration intervals at a time, to bound the memory; most separations use a quarter of them
# Fewer pairs of a law and a separation are summed one by one, which then takes less time than the matrix.
_MANY = 4000
_BLOCK = 128  # number of laws in a block; their nodes fit into the processor's cache


def on_grid(regimes: Sequence[Regime], h: np.ndarray, heights: Heights, threads: int = 1) -> np.ndarray:
    """Return the sums of every regime for n laws (parameter sets) at H mean separations that all laws share.

    regimes: smooth parts of an asperity's behaviour, each for n laws. h: array (H,) in units of sigma. heights: distribution of
    the heights. threads: largest number of threads. Returns an array (regimes, n, 5, H) of averages over all asperities:
    fraction touching, load, area, slip-limited and yield-limited resistance.
    """
    sums = np.empty((len(regimes), len(regimes[0].edges), len(QUANTITIES), np.size(h)))
    for regime, out in zip(regimes, sums, strict=True):
        _on_grid([regime], h, heights, out, threads)
    return sums


def totals_on_grid(
    regimes: Sequence[Regime], h: np.ndarray, heights: Heights, out: np.ndarray | None = None, threads: int = 1
) -> np.ndarray:
    """Return load, area and resistance (n, 3, H) of n laws, summed over all regimes, at H mean separations that all laws share.

    regimes: smooth parts of an asperity's behaviour, each for n laws (parameter sets). h (H,): separations in units of sigma.
    heights: distribution of the heights. out: array (n, 3, H) for the result, if given. threads: largest number of threads.
    """
    sums = np.empty((len(regimes[0].edges), len(_TOTALS), np.size(h))) if out is None else out
    _on_grid(regimes, h, heights, sums, threads)
    return sums


def _on_grid(regimes, h, heights, sums, threads) -> None:
    """Fill `sums` (n, 5 or 3, H) with sums over asperity heights, of n laws (parameter sets) at H separations that they share.

    The sums of all regimes are added. With 5 rows: fraction touching, load, area, slip-limited and yield-limited resistance.
    With 3 rows: load, area, resistance.
    """
    h = np.ascontiguousarray(h, dtype=float)
    laws = len(sums)
    single = []
    for part in near_each_other(h):
        complete = part.size == h.size
        some = sums if complete else np.empty((*sums.shape[:2], part.size))
        near = h if complete else h[part]
        if not (heights.entire and laws * part.size >= _MANY and _by_skeleton(regimes, near, heights, some, threads)):
            single.append(part)
        elif not complete:
            sums[:, :, part] = some
    if single:
        rest = np.concatenate(single)
        numbers = np.repeat(np.arange(laws), rest.size)
        exact = scattered(regimes, np.tile(h[rest], laws), heights, numbers, threads).sum(axis=0)
        if sums.shape[1] == len(_TOTALS):
            exact = np.column_stack([exact[:, 1:3], exact[:, 3] + exact[:, 4]])
        sums[:, :, rest] = np.moveaxis(exact.reshape(laws, rest.size, sums.shape[1]), 1, 2)


def _by_skeleton(regimes, h, heights, sums, threads) -> bool:
    """Fill `sums` (n, 5 or 3, H) by a matrix that extends sums at a few separations to all; return whether this was possible.

    regimes, h, heights, threads, and the rows of `sums`: as in `_on_grid`. False is returned, and `sums` stays as it is, if no
    matrix is accurate enough for these separations.
    """
    # Heights that are negligible in the total may matter for one quantity, so the window is three times as wide as usual,
    # down to densities of exp(-9 NEGLIGIBLE).
    lowest = 3.0 * heights.window(-np.inf, np.inf, heights.shape)[0] - h.max()
    w_low = max(min(regime.lowest for regime in regimes), lowest)
    nearest = h.min()
    w_high = heights.window(nearest + w_low, np.inf, heights.shape)[1] - nearest
    few_h, tiles, threshold = skeleton(h.tobytes(), w_low, w_high, heights)
    if not few_h.size:
        return False
    reach = np.array([heights.window(few + w_low, np.inf, heights.shape)[1] for few in few_h]) - few_h
    rows, totals = sums.shape[1], sums.shape[1] == len(_TOTALS)
    signed = (_TOTALS if totals else QUANTITIES).index("load")
    sum_rows = summing(heights.density, totals)
    ENGINE.take(len(regimes) * len(sums) * h.size)
    alone = specialised(len(sums), len(sums) * h.size)
    placing = [Placing.of(regime, heights.window, w_high - w_low, sums.shape[1], alone) for regime in regimes]
    room = sum(placed.room for placed in placing)
    everywhere = np.full(h.size, np.inf)

    def fill(share: slice) -> None:
        places, values = np.empty((_BLOCK, room)), np.empty((_BLOCK, rows, room))
        few, every = np.empty((_BLOCK, rows, few_h.size)), np.ones((_BLOCK, few_h.size), dtype=np.bool_)
        inaccurate = np.empty((_BLOCK, h.size), dtype=np.bool_)
        appenders = [placed.on(_BLOCK, (_RULES, _COUNTS)) for placed in placing]
        for start in range(share.start, share.stop, _BLOCK):
            block = slice(start, min(start + _BLOCK, share.stop))
            nodes = places, values, np.zeros(block.stop - start, dtype=np.int64)
            for append in appenders:
                append((w_low, np.inf, nearest), heights.shape, block, nodes)
            sum_rows(few_h, reach, heights.shape, nodes, every, few)
            if carry_over(few.reshape(-1, few_h.size), tiles, threshold, nodes, signed, sums[block], inaccurate):
                sum_rows(h, everywhere, heights.shape, nodes, inaccurate, sums[block])

    in_threads(fill, _slices(len(sums), threads), threads)
    return True
