"""Fit numbers that are bounded between 0 and 1 by least squares, and compute their likelihood profiles.

These numbers are the positions of the free parameters of a fit between their low end (0) and their high end (1). Residuals are
(model - measured)/standard error.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from stiction.quantities.sampling import sobol_points

CONFIDENCE = 0.95
# Largest standardised residual, used where a model refuses a set of numbers or gives NaN.
FAR = 1e4
_STEP = 1e-4  # step of central differences to each side, in positions
# Points of a profile; rounds in which its grid is adapted; Levenberg-Marquardt steps.
_GRID, _ROUNDS, _STEPS = 33, 4, 40
_STARTS = 3  # starting points of a search
_AGREED = 1e-12  # relative tolerance at which a search ends
# How often the grid cell with an end of an interval is divided, and into how many parts.
_NARROWINGS, _CELL = 2, 8

# Function from sets of positions (sets, k) to standardised residuals (sets, n).
Residuals = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Best:
    """Hold the best fit of k free parameters to n measured values.

    positions (k,): of the free parameters between their ends, 0 to 1. residuals (n,): (model - measured)/standard error at the
    best fit. jacobian (n, k): derivatives of the residuals with respect to the positions. unfinished: why the search did not
    converge, "" if it did.
    """

    positions: np.ndarray
    residuals: np.ndarray
    jacobian: np.ndarray
    unfinished: str = ""

    @cached_property
    def chi_square(self) -> float:
        return float((self.residuals**2).sum())

    @cached_property
    def covariance(self) -> np.ndarray:
        """Return the covariance (k, k) of the positions of the k free parameters between their ends, from the Jacobian alone.

        A position is 0 at the low end and 1 at the high end. All entries are NaN if the data leave a combination of the numbers
        undetermined.
        """
        try:
            found = np.linalg.inv(self.jacobian.T @ self.jacobian)
        except np.linalg.LinAlgError:
            found = np.full((len(self.positions),) * 2, np.nan)
        return found if np.isfinite(found).all() and (np.diag(found) > 0.0).all() else np.full(found.shape, np.nan)

    @cached_property
    def bounded(self) -> np.ndarray:
        """Return the covariance (k, k) of the positions of the k free parameters, given also that each lies between 0 and 1.

        A position is 0 at the low end and 1 at the high end of a number. The ends count as a prior with the variance 1/12 of a
        uniform distribution from 0 to 1.
        """
        return np.linalg.inv(self.jacobian.T @ self.jacobian + 12.0 * np.eye(self.jacobian.shape[1]))


@dataclass(frozen=True)
class Profile:
    """Hold the likelihood profile of one free parameter, on a grid of m positions between its ends.

    positions (m,): of the parameter, 0 at its low and 1 at its high end. rise (m,): rise of chi square, minimised over the
    other k - 1 free parameters, above the best fit. others (m, k): positions of all k numbers at these minima. low, high: ends
    of the interval as positions, where the rise reaches a threshold. open_low, open_high: whether the rise stays below the
    threshold up to the end; low is then 0, high 1.
    """

    positions: np.ndarray
    rise: np.ndarray
    others: np.ndarray
    low: float
    high: float
    open_low: bool
    open_high: bool


def finite(values: np.ndarray) -> np.ndarray:
    """Return residuals clipped to -FAR and FAR; NaN and infinite residuals become FAR."""
    return np.where(np.isfinite(values), np.clip(values, -FAR, FAR), FAR)


def jacobian(
    residuals: Residuals, positions: np.ndarray, columns: Sequence[int] | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return residuals (sets, n) and their derivatives (sets, n, columns) with respect to the free parameters.

    Derivatives are central differences, which do not step beyond the ends of a parameter. residuals: function from positions
    (sets, k) to residuals (sets, n). positions: for each set, those of the k free parameters between their ends, 0 to 1.
    columns: indices of the parameters with respect to which derivatives are computed, by default all.
    """
    sets, k = positions.shape
    columns = range(k) if columns is None else columns
    trials = [positions]
    for at in columns:
        for side in (1.0, -1.0):
            moved = positions.copy()
            moved[:, at] = np.clip(moved[:, at] + side * _STEP, 0.0, 1.0)
            trials.append(moved)
    found = finite(residuals(np.concatenate(trials)))
    parts = found.reshape(len(trials), sets, -1)
    slopes = []
    for place, at in enumerate(columns):
        width = trials[1 + 2 * place][:, at] - trials[2 + 2 * place][:, at]
        slopes.append((parts[1 + 2 * place] - parts[2 + 2 * place]) / width[:, None])
    return parts[0], np.stack(slopes, axis=-1) if slopes else np.empty((*parts[0].shape, 0))


def search(residuals: Residuals, start: np.ndarray, seed: int = 0) -> Best:
    """Return the best fit of k free parameters by bounded least squares (Branch, Coleman & Li 1999).

    residuals: function from sets (sets, k) of positions of the free parameters between their ends, 0 to 1, to residuals (sets,
    n). start: positions (k,). Three points, `start` and the best of many Sobol points, are first improved by `polished`; the
    search starts from the best of the three.
    """
    from scipy.optimize import least_squares

    k = len(start)
    trials = np.concatenate([np.clip(start, 0.0, 1.0)[None, :], sobol_points(k, 2 ** min(5 + k, 9), seed)])
    sums = (finite(residuals(trials)) ** 2).sum(axis=1)
    order = np.argsort(sums, kind="stable")[:_STARTS]
    begun = trials[order] if 0 in order else np.concatenate([trials[:1], trials[order[: _STARTS - 1]]])
    begun, sums = polished(residuals, np.clip(begun, 0.01, 0.99), range(k))
    found = least_squares(
        lambda positions: finite(residuals(positions[None, :]))[0],
        np.clip(begun[np.argmin(sums)], 1e-6, 1.0 - 1e-6),
        lambda positions: jacobian(residuals, positions[None, :])[1][0],
        bounds=(0.0, 1.0),
        xtol=_AGREED,
        ftol=_AGREED,
        gtol=_AGREED,
    )
    return Best(found.x, found.fun, found.jac, "" if found.success else found.message)


def polished(residuals: Residuals, positions: np.ndarray, columns: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
    """Minimise the sum of squared residuals over some of the free parameters, for many starting points at once.

    residuals: function that returns the residuals (sets, n) for positions (sets, k). positions: starting points; a position is
    0 at the lower end of a parameter and 1 at its upper end. columns: indices of the parameters that may change. Returns the
    improved positions (sets, k) and their sums of squares (sets,). Method: Levenberg-Marquardt steps (Marquardt 1963), clipped
    between 0 and 1.
    """
    positions, columns = positions.copy(), list(columns)
    sums = (finite(residuals(positions)) ** 2).sum(axis=1)
    if not columns:
        return positions, sums
    damping = np.full(len(positions), 1e-3)
    going = np.arange(len(positions))
    for _ in range(_STEPS):
        values, slopes = jacobian(residuals, positions[going], columns)
        trial = positions[going]
        trial[:, columns] = np.clip(trial[:, columns] - _damped(values, slopes, damping[going], trial[:, columns]), 0.0, 1.0)
        now = (finite(residuals(trial)) ** 2).sum(axis=1)
        gain = sums[going] - now
        better = gain > 0.0
        positions[going[better]], sums[going[better]] = trial[better], now[better]
        damping[going] = np.where(better, damping[going] * 0.2, damping[going] * 8.0)
        small = 1e-9 * (1.0 + sums[going])
        done = (better & (gain < small)) | (~better & (damping[going] > 1e7))
        going = going[~done]
        if not going.size:
            break
    return positions, sums


def _damped(values: np.ndarray, slopes: np.ndarray, damping: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return Levenberg-Marquardt steps (sets, columns), to be subtracted from the positions of the free parameters.

    The step is 0 for a parameter at an end of its range that would otherwise leave the range. values (sets, n): residuals.
    slopes (sets, n, columns): their derivatives. damping (sets,): Levenberg-Marquardt parameter. at (sets, columns): positions
    of the free parameters in their ranges, 0 to 1.
    """
    gradient = np.einsum("snk,sn->sk", slopes, values)
    held = ((at <= 0.0) & (gradient > 0.0)) | ((at >= 1.0) & (gradient < 0.0))
    slopes = np.where(held[:, None, :], 0.0, slopes)
    normal = np.einsum("snk,snl->skl", slopes, slopes)
    size = np.einsum("skk->sk", normal)
    scale = np.maximum(size, 1e-9 * np.maximum(size.max(axis=1, keepdims=True), 1e-30))
    whole = normal + np.einsum("sk,kl->skl", damping[:, None] * scale + 1e-14, np.eye(at.shape[1]))
    whole += np.einsum("sk,kl->skl", np.where(held, 1.0, 0.0), np.eye(at.shape[1]))
    return np.linalg.solve(whole, np.where(held, 0.0, gradient)[..., None])[..., 0]


def profiles(residuals: Residuals, best: Best, threshold: float) -> list[Profile]:
    """Return the likelihood profile of each free parameter about the best fit.

    residuals: function from sets (sets, k) of positions of the k free parameters between their ends, 0 to 1, to residuals
    (sets, n). threshold: rise of chi square that marks the ends of an interval.
    """
    return [_profile(residuals, best, at, threshold) for at in range(len(best.positions))]


def _profile(residuals: Residuals, best: Best, at: int, threshold: float) -> Profile:
    """Return the likelihood profile of the free parameter with index `at`, on a grid about the best fit.

    threshold: rise of chi square that marks the ends of the interval. The grid is narrowed or widened until it resolves the
    interval.
    """
    centre = best.positions[at]
    reach = 2.0 * np.sqrt(threshold * best.bounded[at, at])
    below = above = max(reach, 1e-6)
    for _ in range(_ROUNDS):
        ends = [max(0.0, centre - below), min(1.0, centre + above)]
        grid = np.unique(np.linspace(ends, centre, _GRID // 2 + 1))
        others, rise = _along(residuals, best, at, grid)
        under, over = grid <= centre, grid >= centre
        down, up = (grid[under][::-1], rise[under][::-1]), (grid[over], rise[over])
        (low, open_low), (high, open_high) = _crossing(*down, threshold), _crossing(*up, threshold)
        wanted_below = _wanted(centre - low, below, open_low, centre - grid[0] < centre)
        wanted_above = _wanted(high - centre, above, open_high, grid[-1] < 1.0)
        if wanted_below == below and wanted_above == above:
            break
        below, above = wanted_below, wanted_above
    if not open_low:
        low = _narrowed(residuals, best, at, *down, threshold)
    if not open_high:
        high = _narrowed(residuals, best, at, *up, threshold)
    return Profile(grid, rise, others, 0.0 if open_low else low, 1.0 if open_high else high, open_low, open_high)


def _narrowed(residuals: Residuals, best: Best, at: int, grid: np.ndarray, rise: np.ndarray, threshold: float) -> float:
    """Return the position of a free parameter, 0 to 1, at which the rise of chi square reaches the threshold.

    at: index of the parameter. grid, rise: positions (m,) outwards from the best fit, and the rise at these positions. The grid
    cell in which the threshold is reached is divided further, because the square root of the rise has a kink where another
    parameter reaches an end of its range.
    """
    for _ in range(_NARROWINGS):
        over = int(np.argmax(rise >= threshold))
        if over == 0:
            break
        cell = np.linspace(grid[over - 1], grid[over], _CELL + 1)
        grid, rise = (
            cell,
            np.concatenate([rise[over - 1 : over], _along(residuals, best, at, cell[1:-1])[1], rise[over : over + 1]]),
        )
    return _crossing(grid, rise, threshold)[0]


def _wanted(found: float, reach: float, is_open: bool, more: bool) -> float:
    """Return how far the grid of a profile should reach on one side of the best fit.

    All lengths are differences of positions, 0 to 1, of the free parameter between its ends. found: half-width of the interval
    on this side. reach: present half-width of the grid. is_open: whether the interval ends beyond the grid. more: whether the
    grid can still be widened. The grid is narrowed if the interval is less than a quarter of the grid.
    """
    if is_open:
        return 4.0 * reach if more else reach
    return reach if found > 0.25 * reach else max(1.8 * found, 1e-9)


def _along(residuals: Residuals, best: Best, at: int, grid: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the best fit with one free parameter fixed at each grid value, and the rise of chi square above the overall best.

    at: index of the fixed parameter. grid (m,): its positions between its ends, 0 to 1. The results are positions of all k
    parameters (m, k) and the rise (m,).
    """
    slope = best.bounded[:, at] / best.bounded[at, at]
    sets = np.clip(best.positions + slope * (grid - best.positions[at])[:, None], 0.0, 1.0)
    sets[:, at] = grid
    columns = [one for one in range(len(best.positions)) if one != at]
    sets, sums = polished(residuals, sets, columns)
    for _ in range(2 if columns else 0):  # restart from the solution at a neighbouring grid point if that lowers chi square
        for shift in (1, -1):
            neighbours = np.roll(sets, shift, axis=0)
            neighbours[0 if shift == 1 else -1] = best.positions
            neighbours[:, at] = grid
            other = (finite(residuals(neighbours)) ** 2).sum(axis=1)
            some = np.flatnonzero(other < sums - 1e-6)
            if some.size:
                better, lower = polished(residuals, neighbours[some], columns)
                sets[some], sums[some] = better, lower
    return sets, sums - best.chi_square


def _crossing(grid: np.ndarray, rise: np.ndarray, threshold: float) -> tuple[float, bool]:
    """Return the grid position at which the rise of chi square first reaches the threshold, and True if it never does.

    grid, rise: positions (m,), 0 to 1, of a free parameter outwards from the best fit, and the rise at these positions. The
    square root of the rise, which is almost linear, is interpolated. If the threshold is never reached, the last position of
    the grid is returned.
    """
    over = np.flatnonzero(rise >= threshold)
    if not over.size:
        return float(grid[-1]), True
    at = over[0]
    if at == 0:
        return float(grid[0]), False
    left, right = (np.sqrt(max(rise[one], 0.0)) for one in (at - 1, at))
    weight = (np.sqrt(threshold) - left) / (right - left)
    return float(grid[at - 1] + weight * (grid[at] - grid[at - 1])), False
