"""Compute the fractions of the variance of ln mu that are due to each part of a prediction."""

from collections.abc import Callable
from functools import cache

import numpy as np

from stiction.studies.prediction.levels import PARTS, Levels
from stiction.studies.prediction.mixture import Mixture

_STRENGTH = "interfacial_shear_strength"
_EXCHANGES = range(8)  # seeds of random orders of exchange; samples shifted by a fixed number would stay correlated
_LEAST = 0.005  # smallest fraction of the variance that is returned
_NEGLIGIBLE = 4e-4  # variance of ln mu below which it is not divided: mu varies by 2 %

# Function of quantile levels and indices of the sampled inputs that returns the quantity (n,) whose variance is divided.
Quantity = Callable[[Levels, np.ndarray], np.ndarray]


def shares_of_variance(mixture: Mixture, levels: Levels, index: int) -> dict[str, float]:
    """Return the fraction of the variance of ln mu that each part of a prediction causes, by name, the largest first.

    The fraction is the part's total Sobol index (Jansen 1999), found by exchanging the part between samples, over the sum of
    all indices. The fraction of the inputs is divided among the uncertain numbers by a linear fit to their normal scores; an
    uncertain interfacial_shear_strength also has the fraction of the interface. Fractions below 0.5 % are left out. The dict is
    empty if the variances of all parts together are below 4e-4 (mu varies by 2 %). index: position of the load among the loads
    of the prediction.
    """
    mixture = mixture.at_load(index)

    def log_mu(levels: Levels, inputs: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.log(mixture.samples(levels, inputs).force[:, 0])

    variances = _totals(log_mu, levels)
    if "inputs" in variances:
        variances |= _of_each_input(mixture, levels, log_mu, variances.pop("inputs"))
    if _STRENGTH in variances:  # one name for a stated strength and for its scatter near the strength of the body
        variances[_STRENGTH] += variances.pop("interface")
    total = sum(variances.values())
    if not total > _NEGLIGIBLE:
        return {}
    ordered = sorted(variances.items(), key=lambda pair: -pair[1])
    return {name: float(value / total) for name, value in ordered if value / total >= _LEAST}


def _totals(log_mu: Quantity, levels: Levels) -> dict[str, float]:
    """Return the total Sobol variance of each part: half the mean square change of a quantity if samples exchange this part.

    log_mu: function that returns ln mu (n,) from levels and rows of the inputs. Samples that are impossible before or after the
    exchange are left out. Without uncertain inputs, the part "inputs" is left out.
    """
    every, (first, *others) = np.arange(len(levels)), _orders(len(levels))
    reference = log_mu(levels, every)
    parts = [part for part in PARTS if part != "inputs" or levels.inputs.size]

    def changes(parts: list[str], rows: np.ndarray, moved: np.ndarray) -> np.ndarray:
        return reference[rows] - log_mu(*levels.exchanged(parts, rows, moved)).reshape(len(parts), -1)

    variances, more = dict.fromkeys(parts, 0.0), (np.tile(every, len(others)), np.concatenate(others))
    for part, change in zip(parts, changes(parts, every, first), strict=True):
        if np.nan_to_num(change).any():  # otherwise the part has no effect on this contact
            variances[part] = 0.5 * float(np.nanmean(np.append(change, changes([part], *more)) ** 2))
    return variances


@cache
def _orders(count: int) -> list[np.ndarray]:
    """Return the random orders (count,) in which the samples are exchanged, one for each seed."""
    return [np.random.default_rng(seed).permutation(count) for seed in _EXCHANGES]


def _of_each_input(mixture: Mixture, levels: Levels, log_mu: Quantity, share: float) -> dict[str, float]:
    """Return the variance of ln mu that each uncertain number causes, by name; {} if the fit finds no effect.

    Numbers that are sampled together have one entry. log_mu: function that returns ln mu (n,) from levels and rows of the
    inputs. share: variance that all inputs cause together. This variance is divided in proportion to the squared slopes of a
    linear fit of ln mu to the normal scores of the inputs.
    """
    from scipy.special import ndtri

    middle = Levels(levels.inputs, {name: np.full(len(levels), 0.5) for name in levels.others})
    value = log_mu(middle, np.arange(len(levels)))
    known = np.isfinite(value)
    scores = ndtri(levels.inputs[known])
    slopes = np.linalg.lstsq(np.column_stack([np.ones(known.sum()), scores]), value[known], rcond=None)[0][1:]
    squares = slopes**2
    if not squares.sum() > 0.0:
        return {}
    return {name: share * square / squares.sum() for name, square in zip(mixture.sampled.case.unknowns, squares, strict=True)}
