"""Describe free parameters of a case: numbers that a fit or a design search varies within an interval."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from pydantic import Field

from stiction.case.swept import Address, read_ends
from stiction.quantities.errors import InputError, field_below
from stiction.quantities.inputs import Input
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES


class Interval(Input):
    """Define the table of a free parameter in a case file: its lower and upper limit.

    spacing: "log" searches uniformly in the logarithm of the parameter, "linear" in the parameter itself. The default is "log"
    if both limits are positive. each_sample: whether a fit finds one value for each measured sample instead of one value for
    all.
    """

    low: Any = Field(description="the lower limit, with its unit")
    high: Any = Field(description="the upper limit, with its unit")
    spacing: Literal["linear", "log"] | None = Field(None, description="linear, log")
    each_sample: bool = Field(False, strict=True, description="true or false: whether each sample has its own value")


@dataclass(frozen=True)
class Free:
    """Describe a parameter of a case that a fit or a design search varies from `low` to `high`, in SI units.

    path: address in the case, e.g. ("contact", "first", "hardness"). log: whether the search is uniform in the logarithm of the
    parameter. each_sample: whether a fit finds one value for each measured sample. sample: name of the measured sample for
    which this parameter holds; None if it holds for all samples.
    """

    path: Address
    low: float
    high: float
    log: bool
    each_sample: bool = False
    sample: str | None = None

    @property
    def name(self) -> str:
        name = ".".join(self.path[1:])
        return name if self.sample is None else f"{name} ({self.sample})"

    @property
    def quantity(self) -> str:
        return self.path[-1]

    def at(self, share: Any) -> np.ndarray:
        """Return the parameter at positions `share` in its interval, in SI units and the shape of `share`.

        Position 0 is `low`, position 1 is `high`; positions outside 0 to 1 are clipped. Between them, the parameter, or its
        logarithm if `log` is true, is linear in the position.
        """
        share = np.clip(share, 0.0, 1.0)
        inner = self.low * (self.high / self.low) ** share if self.log else self.low + share * (self.high - self.low)
        return np.where(share >= 1.0, self.high, np.where(share <= 0.0, self.low, inner))

    def share(self, value: Any) -> np.ndarray:
        """Return the positions of values [SI unit] in the interval, 0 at `low` and 1 at `high`; this inverts `at`."""
        value = np.asarray(value, dtype=float)
        if self.log:
            return np.log(value / self.low) / np.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def show(self, value: float, digits: int = 4) -> str:
        return show(value, self.quantity, digits) if np.isfinite(value) else "?"


def read_free(path: Address, entry: Any, where: str) -> Free:
    """Return the free parameter that a table {low, high} of a case file describes.

    path: address of the parameter in the case. entry: the table. where: name of the table in error messages. Raises InputError
    for anything else, and for limits that are not allowed.
    """
    if not isinstance(entry, Mapping):
        example = QUANTITIES[path[-1]].example or "1"
        raise InputError(where, entry, f'a table with both limits, e.g. {{ low = "{example}", high = "..." }}')
    with field_below(where):
        interval = Interval(**entry)
    low, high = read_ends(interval, path[-1], where)
    if not np.isfinite(high / low if low > 0.0 else high - low):
        raise InputError(where, [interval.low, interval.high], "limits less than a factor of 1e300 apart")
    log = low > 0.0 if interval.spacing is None else interval.spacing == "log"
    return Free(path, low, high, log, interval.each_sample)
