"""Describe the probability distributions of uncertain inputs: named ones, scipy.stats distributions, and samples.

In `0.5 +/- 0.1`, 0.1 is the standard deviation of a normal distribution (a standard uncertainty after JCGM 100:2008, 2.3.1). A
median with a factor is a log-normal distribution whose logarithm has the standard deviation ln(factor).
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from stiction.quantities.errors import InputError
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES

# Largest probability of values outside the bounds of the quantity; the distribution is cut off at the bounds.
_BEYOND = 0.025
# Smallest distance of quantile levels from 0 and 1, because the quantiles there may be infinite.
_LEAST_SHARE = 1e-12
LOG_UNIFORM = " (log-uniform)"  # end of the description of a range whose logarithm is uniform


@dataclass(frozen=True)
class _Values:
    """Represent the empirical distribution of n samples, `values` (n,), all equally likely.

    The quantile function `ppf` keeps the order of the samples: levels from i/n to (i + 1)/n return sample i, counted from 0.
    Two unsorted columns of one file, read at the same quantile level, therefore return values of the same row.
    """

    values: np.ndarray

    def ppf(self, level: Any) -> np.ndarray:
        index = (np.asarray(level) * self.values.size).astype(int)
        return self.values[np.minimum(index, self.values.size - 1)]

    def cdf(self, value: Any) -> Any:
        return np.searchsorted(np.sort(self.values), value, side="right") / self.values.size


@dataclass(frozen=True)
class _Normal:
    """Represent a normal distribution, or a log-normal one if `log` is true.

    mean, deviation: mean and standard deviation of the number, or of its natural logarithm if `log` is true.
    """

    mean: float
    deviation: float
    log: bool = False

    def ppf(self, level: Any) -> np.ndarray:
        from scipy.special import ndtri

        values = self.mean + self.deviation * ndtri(level)
        return np.exp(values) if self.log else values

    def cdf(self, value: float) -> float:
        from scipy.special import ndtr

        if self.log:
            value = math.log(value) if value > 0.0 else -math.inf
        return float(ndtr((value - self.mean) / self.deviation))


@dataclass(frozen=True)
class _Even:
    """Represent a uniform distribution from `low` to `high`, or a log-uniform one if `log` is true."""

    low: float
    high: float
    log: bool = False

    def ppf(self, level: Any) -> np.ndarray:
        return self.low * (self.high / self.low) ** level if self.log else self.low + (self.high - self.low) * level


# By kind of distribution, the function that makes its law (an object with ppf) from its parameters.
_LAWS: dict[str, Callable[..., Any]] = {
    "normal": _Normal,
    "log-normal": lambda median, factor: _Normal(math.log(median), math.log(factor), log=True),
    "uniform": _Even,
    "log-uniform": lambda low, high: _Even(low, high, log=True),
    "values": lambda *values: _Values(np.array(values)),
}


@dataclass(frozen=True)
class Distribution:
    """Describe the probability distribution of one uncertain input, in SI units.

    quantity: name of the quantity, e.g. "hardness". nominal: value used by computations that ignore the uncertainty. kind: type
    of the distribution, e.g. "normal". parameters: its numbers, e.g. mean and standard deviation; for a scipy.stats
    distribution, its quantiles at nine levels. words: text that describes the distribution to users. law: object with `ppf` and
    `cdf` from scipy.stats; None for the named kinds. The distribution is cut off at the bounds of the quantity.
    """

    quantity: str
    nominal: float
    kind: str
    parameters: tuple[float, ...]
    words: str
    law: Any = field(default=None, compare=False, repr=False)

    @cached_property
    def _law(self) -> Any:
        return self.law if self.law is not None else _LAWS[self.kind](*self.parameters)

    @cached_property
    def _ends(self) -> tuple[float, float]:
        """Return the probabilities of values below the lower and below the upper bound of the quantity, before the cut-off.

        They are 0 and 1 for uniform distributions and samples, whose ends are within the bounds.
        """
        quantity = QUANTITIES[self.quantity]
        if self.kind in ("uniform", "log-uniform", "values"):
            return 0.0, 1.0  # both ends were already checked as values of the quantity
        return float(self._law.cdf(quantity.lower)), float(self._law.cdf(quantity.upper))

    @property
    def beyond(self) -> float:
        """Return the probability of values outside the bounds of the quantity, before the distribution is cut off there."""
        low, high = self._ends
        return low + 1.0 - high

    def ppf(self, level: Any) -> np.ndarray:
        """Return the quantiles of the input, in SI units, at quantile levels from 0 to 1, both of shape (n,).

        Levels closer to 0 or 1 than 1e-12 are moved to this distance.
        """
        low, high = self._ends
        inside = np.clip(np.asarray(level, dtype=float), _LEAST_SHARE, 1.0 - _LEAST_SHARE)
        return np.asarray(self._law.ppf(low + inside * (high - low)), dtype=float)

    def as_table(self) -> dict[str, Any]:
        """Return kind, parameters and nominal value of the distribution, in SI units, as a table that JSON can store."""
        return {"distribution": self.kind, "parameters": list(self.parameters), "nominal": self.nominal}


def normal(quantity: str, mean: float, deviation: float, field: str, given: Any) -> Distribution:
    """Return a normal distribution with this mean and standard deviation, both in SI units; the mean is the nominal value.

    quantity: name of the quantity. field, given: address and value of the input, which the error message shows. Raises
    InputError if more than 2.5 % of the distribution is outside the bounds of the quantity.
    """
    words = f"{show(mean, quantity)} ± {show(deviation, quantity)}"
    return _checked(Distribution(quantity, mean, "normal", (mean, deviation), words), field, given)


def within_factor(quantity: str, median: float, factor: float, field: str, given: Any) -> Distribution:
    """Return a log-normal distribution with this median [SI unit] and geometric standard deviation `factor`.

    The median is the nominal value. factor: exp of the standard deviation of the natural logarithm. quantity: name of the
    quantity. field, given: address and value of the input, which the error message shows. Raises InputError if more than 2.5 %
    of the distribution is outside the bounds of the quantity.
    """
    words = f"{show(median, quantity)}, within a factor {factor:g}"
    return _checked(Distribution(quantity, median, "log-normal", (median, factor), words), field, given)


def between(quantity: str, low: float, high: float, log: bool) -> Distribution:
    """Return a uniform distribution from `low` to `high`, in SI units, with its median as nominal value.

    log: whether the logarithm is uniform instead of the number.
    """
    nominal = (low * high) ** 0.5 if log else (low + high) / 2.0
    return in_range(quantity, low, high, nominal, log)


def in_range(quantity: str, low: float, high: float, nominal: float, log: bool) -> Distribution:
    """Return a uniform distribution from `low` to `high` with the nominal value `nominal`, all in SI units.

    log: whether the logarithm is uniform instead of the number.
    """
    words = f"{show(low, quantity)} to {show(high, quantity)}" + (LOG_UNIFORM if log else "")
    return Distribution(quantity, nominal, "log-uniform" if log else "uniform", (low, high), words)


def of_samples(quantity: str, values: np.ndarray, ordered: bool) -> Distribution:
    """Return the empirical distribution of measured values (n,), in SI units, all equally likely.

    ordered: whether to sort the values. False keeps the order of the file, so that other columns sampled at the same quantile
    levels return values of the same row. The nominal value is the median.
    """
    known = np.sort(values) if ordered else values
    ends = " to ".join(show(float(end), quantity) for end in (values.min(), values.max()))
    words = f"one of {values.size} values, {ends}"
    return Distribution(quantity, float(np.median(values)), "values", tuple(known.tolist()), words)


def is_scipy_law(value: Any) -> bool:
    """Return whether a value is a distribution object: one with methods `ppf` and `cdf`, as in scipy.stats."""
    return callable(getattr(value, "ppf", None)) and callable(getattr(value, "cdf", None))


def from_scipy(quantity: str, law: Any, field: str) -> Distribution:
    """Return the distribution object `law` of scipy.stats, in SI units, as a Distribution; its median is the nominal value.

    quantity: name of the quantity. field: address of the input in error messages. Raises InputError if the parameters of `law`
    are missing, its median is not finite, or more than 2.5 % of it is outside the bounds of the quantity.
    """
    name = getattr(getattr(law, "dist", None), "name", type(law).__name__)
    stated = f"scipy.stats.{name}"
    try:
        median = float(law.ppf(0.5))
    except (TypeError, ValueError):  # a distribution of scipy.stats whose parameters are missing
        raise InputError(field, stated, "a distribution with its parameters, e.g. scipy.stats.norm(5e8, 1e8)") from None
    if not np.isfinite(median):
        raise InputError(field, stated, "a distribution with a finite median")
    levels = np.array([0.001, 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 0.999])
    parameters = tuple(np.asarray(law.ppf(levels), dtype=float).tolist())
    return _checked(Distribution(quantity, median, stated, parameters, stated, law), field, stated)


def _checked(distribution: Distribution, field: str, given: Any) -> Distribution:
    quantity = QUANTITIES[distribution.quantity]
    if distribution.beyond > _BEYOND:
        advice = "state a smaller error, { median, factor } or { low, high }"
        shown = given if not isinstance(given, Mapping) else dict(given)
        raise InputError(
            field,
            shown,
            f"{quantity.allowed} for all but {_BEYOND:.1%} of values, here {distribution.beyond:.1%} are outside: {advice}",
        )
    return distribution
