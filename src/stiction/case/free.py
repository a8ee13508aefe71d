"""Numbers of a case that are free between two ends: what is fitted, or chosen."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from pydantic import Field

from stiction.case.several import Address, read_ends
from stiction.quantities.errors import InputError, field_below
from stiction.quantities.inputs import Input
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import show


class Interval(Input):
    """Hold the ends of a free number.

    spacing: "log" searches evenly in the logarithm, the default where both ends are above 0.
    """

    low: Any = Field(description="the lower end, with its unit")
    high: Any = Field(description="the upper end, with its unit")
    spacing: Literal["linear", "log"] | None = Field(None, description="linear, log")
    each_sample: bool = Field(False, strict=True, description="true: every sample has its own")


@dataclass(frozen=True)
class Free:
    """A number that is free. path: where it stands; name: without the table; low, high: SI; share 0 is low, 1 is high."""

    path: Address
    low: float
    high: float
    log: bool
    each_sample: bool = False

    @property
    def name(self) -> str:
        return ".".join(self.path[1:])

    @property
    def quantity(self) -> str:
        return self.path[-1]

    def at(self, share: np.ndarray) -> np.ndarray:
        """Values at shares of the way, evenly in the number or its logarithm; at 0 and 1 exactly the ends."""
        share = np.clip(share, 0.0, 1.0)
        inner = self.low * (self.high / self.low) ** share if self.log else self.low + share * (self.high - self.low)
        return np.where(share >= 1.0, self.high, np.where(share <= 0.0, self.low, inner))

    def share(self, value: Any) -> np.ndarray:
        """Return the shares of the interval at which these values are."""
        value = np.asarray(value, dtype=float)
        if self.log:
            return np.log(value / self.low) / np.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def show(self, value: float, digits: int = 4) -> str:
        return show(value, self.quantity, digits) if np.isfinite(value) else "?"


def read_free(path: Address, entry: Any, where: str) -> Free:
    """Return the free number of a table {low, high}. Raises InputError."""
    if not isinstance(entry, Mapping):
        example = QUANTITIES[path[-1]].example or "1"
        raise InputError(where, entry, f'a table with its ends, e.g. {{ low = "{example}", high = "..." }}')
    with field_below(where):
        given = Interval(**entry)
    low, high = read_ends(given, path[-1], where)
    if not np.isfinite(high / low if low > 0.0 else high - low):
        raise InputError(where, [given.low, given.high], "ends that are less than a factor 1e300 apart")
    log = low > 0.0 if given.spacing is None else given.spacing == "log"
    return Free(path, low, high, log, given.each_sample)
