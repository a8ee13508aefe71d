"""Compute Sobol indices and Morris effects of any function of inputs between 0 and 1.

SciPy computes the Sobol indices. The effects are computed here, not by SALib, which gives the same values up to round-off
(2e-16): in SALib a single refused contact makes all effects NaN, and it requires Matplotlib and multiprocess.
"""

import numpy as np

from stiction.studies.uncertainty.drawing import scrambled

# Number of independently scrambled sequences; the scatter between them gives the error of the indices.
PARTS = 8
_T = 2.364624  # 97.5 % quantile of Student's t with 7 degrees of freedom
_LEVELS = 4


def points_of_indices(columns: int, count: int, seed: int) -> np.ndarray:
    """Return sample points for Sobol indices in the unit cube, (PARTS, columns + 2, count / PARTS, columns).

    columns: number of inputs. count: number of points, a power of two, divided among 8 (PARTS) independently scrambled
    sequences. Along the second dimension are sample A, sample B, and for each input a copy of A with this input from B. Source:
    Saltelli et al. 2010, section 3: a sequence of twice the columns gives A and B.
    """
    both = scrambled(2 * columns, count, seed, PARTS)
    first, second = both[..., :columns], both[..., columns:]
    mixed = np.repeat(first[:, None], columns, axis=1)
    for at in range(columns):
        mixed[:, at, :, at] = second[..., at]
    return np.concatenate([first[:, None], second[:, None], mixed], axis=1)


def sobol_indices(values: np.ndarray) -> dict[str, np.ndarray]:
    """Return Sobol indices of k inputs from values (parts, k + 2, n) of a function at the points of `points_of_indices`.

    The parts are independently scrambled sequences of n points. The result has arrays (k,) by name: first_order, total_order,
    and the ends of their 95 % intervals with `_low` and `_high`. `points` is the number of sample points used. A point is valid
    if all its k + 2 values are finite. The indices are NaN and `points` is 0 if less than half of the points are valid, or
    fewer than two in any part.

    Source: Saltelli et al. 2010, table 2: (b) for the first-order and (f), Jansen 1999, for the total index. The interval is
    Student's t interval over the parts. Invalid points are excluded. Further points are then excluded until a power of two
    remains.
    """
    columns = values.shape[1] - 2
    known = np.isfinite(values).all(axis=1)
    rest = [one[:, good] for one, good in zip(values, known, strict=True)]
    whole = np.concatenate(rest, axis=1)
    if min(one.shape[1] for one in rest) < 2 or not known.mean() >= 0.5:
        estimate, points, wide = np.full((2, columns), np.nan), 0, np.nan
    else:
        estimate, points = _estimated(whole)
        each = np.array([_estimated(one)[0] for one in rest])
        wide = _T * each.std(axis=0, ddof=1) / np.sqrt(len(each))
    ends = {"": estimate, "_low": estimate - wide, "_high": estimate + wide}
    found = {f"{name}_order{end}": rows[at] for at, name in enumerate(("first", "total")) for end, rows in ends.items()}
    return found | {"points": np.array(points)}


def _estimated(values: np.ndarray) -> tuple[np.ndarray, int]:
    """Return first-order and total Sobol indices (2, k) from finite values (k + 2, n), and the number of points used.

    The first 2^m of the n points are used, with the largest possible m. The indices are 0 if the values do not vary.
    """
    from scipy.stats import sobol_indices as estimated

    count = 1 << (values.shape[1].bit_length() - 1)
    used = values[:, :count]
    if np.ptp(used) <= 1e-12 * np.abs(used).max():
        return np.zeros((2, len(values) - 2)), count
    inputs = len(values) - 2
    mixed = used[2:] if inputs > 1 else np.concatenate([used[2:], used[2:]])  # scipy does not support a function of one number
    found = estimated(func={"f_A": used[None, 0], "f_B": used[None, 1], "f_AB": mixed[:, None]}, n=count)
    return np.array([found.first_order[:inputs], found.total_order[:inputs]]), count


def trajectories(columns: int, count: int, seed: int) -> np.ndarray:
    """Return `count` Morris trajectories in the unit cube of the inputs, (count, columns + 1, columns).

    columns: number of inputs. From one point of a trajectory to the next, one input changes by 2/3, each input once. Source:
    Morris 1991, section 3: levels 0, 1/3, 2/3, 1 and steps of p/(2 (p - 1)), p = 4, in random order and direction.
    """
    rng = np.random.default_rng(seed)
    step = _LEVELS / (2.0 * (_LEVELS - 1.0))
    base = rng.integers(0, _LEVELS // 2, (count, columns)) / (_LEVELS - 1.0)
    up = rng.random((count, columns)) < 0.5
    order = rng.permuted(np.tile(np.arange(columns), (count, 1)), axis=1)
    moved = order.argsort(axis=1)[:, None, :] < np.arange(columns + 1)[None, :, None]
    return base[:, None] + step * np.where(up[:, None], moved, ~moved)


def effects(points: np.ndarray, values: np.ndarray) -> dict[str, np.ndarray]:
    """Return statistics of the elementary effects of k inputs, arrays (k,) by name.

    points: trajectories (count, k + 1, k). values: values (count, k + 1) of a function at these points. An elementary effect is
    the change of the value by a step, divided by the step. The statistics are `effect` (mean absolute effect), `effect_error`
    (its standard error), `mean`, and `effect_deviation` (standard deviation), over the finite effects. They are NaN for an
    input with fewer than two finite effects, or with finite effects in fewer than half of the trajectories (rounded down).
    Source: Morris 1991, eq. 1; the mean of absolute effects Campolongo, Cariboni & Saltelli 2007, eq. 3.
    """
    from pandas import DataFrame

    steps = np.diff(points, axis=1)
    column = np.abs(steps).argmax(axis=2)
    ratio = np.diff(values, axis=1) / np.take_along_axis(steps, column[:, :, None], axis=2)[..., 0]
    each = np.take_along_axis(ratio, column.argsort(axis=1), axis=1)
    enough = np.isfinite(each).sum(axis=0) >= max(2, len(each) // 2)
    known = DataFrame(np.where(enough & np.isfinite(each), each, np.nan))  # pandas skips NaN
    sizes = known.abs()
    columns = {"effect": sizes.mean(), "effect_error": sizes.sem(), "mean": known.mean(), "effect_deviation": known.std()}
    return {name: values_of.to_numpy() for name, values_of in columns.items()}
