"""Which part of a prediction its width comes from: shares of the variance of ln mu."""

from collections.abc import Callable

import numpy as np

from stiction.studies.prediction.levels import PARTS, Levels
from stiction.studies.prediction.mixture import Mixture

__all__ = ["shares_of_variance"]

_EXCHANGES = range(8)  # seeds of the orders in which a part is exchanged; rows moved by a number would stay correlated
_LEAST = 0.005  # share that is left out

# What the variance is of: from levels and rows of the inputs, an array (n,).
Quantity = Callable[[Levels, np.ndarray], np.ndarray]


def shares_of_variance(mixture: Mixture, levels: Levels, at: int) -> dict[str, float]:
    """Return the share of each part, the largest first; they sum to 1. Empty where nothing varies.

    at: the number of the load. The share of a part is its total Sobol index of ln mu (Jansen 1999), found by exchanging it
    alone between draws, over the sum of all; inputs are divided among their numbers by a linear fit to their normal scores.
    """
    mixture = mixture.at_load(at)

    def log_mu(levels: Levels, inputs: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.log(mixture.samples(levels, inputs).force[:, 0])

    whole = log_mu(levels, np.arange(len(levels)))
    found = {part: _total(log_mu, levels, part, whole) for part in PARTS if part != "inputs" or levels.inputs.size}
    if "inputs" in found:
        found |= _of_each_input(mixture, levels, log_mu, found.pop("inputs"))
    total = sum(found.values())
    if not total > 0.0:
        return {}
    ordered = sorted(found.items(), key=lambda pair: -pair[1])
    return {name: float(value / total) for name, value in ordered if value / total >= _LEAST}


def _total(log_mu: Quantity, levels: Levels, part: str, whole: np.ndarray) -> float:
    """Return half the mean square change of ln mu where one part is exchanged between draws."""
    every = range(len(levels))
    rows = np.tile(every, len(_EXCHANGES))
    moved = np.concatenate([np.random.default_rng(seed).permutation(every) for seed in _EXCHANGES])
    other = log_mu(levels.with_rows(part, moved, rows), moved if part == "inputs" else rows)
    return 0.5 * float(np.nanmean((whole[rows] - other) ** 2))


def _of_each_input(mixture: Mixture, levels: Levels, log_mu: Quantity, share: float) -> dict[str, float]:
    """Divide the share of all inputs among them."""
    from scipy.special import ndtri

    middle = Levels(levels.inputs, {name: np.full(len(levels), 0.5) for name in levels.others})
    value = log_mu(middle, np.arange(len(levels)))
    known = np.isfinite(value)
    scores = ndtri(levels.inputs[known])
    slopes = np.linalg.lstsq(np.column_stack([np.ones(known.sum()), scores]), value[known], rcond=None)[0][1:]
    squares = slopes**2
    if not squares.sum() > 0.0:
        return {}
    return {name: share * square / squares.sum() for name, square in zip(mixture.asked.case.unknowns, squares, strict=True)}
