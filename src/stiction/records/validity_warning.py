"""Describe where a result leaves the range in which it is claimed to hold."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from stiction.quantities.table import QUANTITIES
from stiction.records.claims import KINDS_OF_WARNING, range_in_words


@dataclass(frozen=True)
class ValidityWarning:
    """State why a result may not hold.

    why: in words. quantity: by name, "" for a warning about none; then all else is left out. least, most: of its values that
    are outside, at `outside` of `points` points; low, high: the range that is claimed, infinite where it is open. Without
    points `why` is the whole sentence, else it follows the quantity, which is one of the table, and its values. kind: which of
    KINDS_OF_WARNING.
    """

    why: str
    quantity: str = ""
    least: float = math.nan
    most: float = math.nan
    low: float = -math.inf
    high: float = math.inf
    outside: int = 0
    points: int = 0
    kind: str = "assumption"

    def __post_init__(self):
        if self.kind not in KINDS_OF_WARNING:
            raise ValueError(f"a warning is {', '.join(KINDS_OF_WARNING)}, not {self.kind}")

    @property
    def beyond(self) -> float:
        """Return the worst value over the bound that it leaves, or the value itself where that bound is zero."""
        ends = [(self.low, self.low - self.least), (self.high, self.most - self.high)]
        found = [distance / abs(bound) if bound else distance for bound, distance in ends if math.isfinite(bound)]
        return max(found, default=math.nan)

    def as_data(self) -> dict[str, Any]:
        """Return the fields with `beyond` as JSON has them; a warning without a quantity has only its words.

        NaN and an open end are null; an infinite value is "inf" or "-inf".
        """
        if not self.quantity:
            return {"why": self.why, "kind": self.kind}
        data = asdict(self) | {"beyond": self.beyond}
        values = {name: str(data[name]) for name in ("least", "most") if math.isinf(data[name])}
        open_ends = {name: None for name, value in data.items() if isinstance(value, float) and not math.isfinite(value)}
        return data | open_ends | values

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> "ValidityWarning":
        """Return the warning that `as_data` wrote; what is missing or null has its default."""
        given = {name: value for name, value in data.items() if name != "beyond" and value is not None}
        return cls(**given | {name: float(given[name]) for name in ("least", "most") if name in given})

    @property
    def _values(self) -> str:
        return " to ".join(dict.fromkeys((f"{self.least:.3g}", f"{self.most:.3g}")))

    @property
    def _range(self) -> str:
        return range_in_words(self.low, self.high)

    def __str__(self) -> str:
        if not self.points:
            return self.why
        where = f"in {self.outside} of {self.points} points" if self.points > 1 else "here"
        return f"{QUANTITIES[self.quantity].meaning} is {self._values} {where}, claimed is {self._range}: {self.why}"

    @property
    def in_brief(self) -> str:
        """Return which quantity is outside of the claimed range, with its value."""
        return f"{QUANTITIES[self.quantity].short or self.quantity} {self._values}" if self.points else self.why

    @property
    def rule(self) -> str:
        """Return which claimed range is left, by symbol, without the value."""
        return (
            f"{QUANTITIES[self.quantity].symbol} is not {self._range}: {self.why}" if self.quantity in QUANTITIES else self.why
        )

    @property
    def short(self) -> str:
        """Return the warning with the quantity's symbol, value and claimed range."""
        if not self.points:
            return self.why
        return f"{QUANTITIES[self.quantity].symbol} = {self._values}, not {self._range}: {self.why}"
