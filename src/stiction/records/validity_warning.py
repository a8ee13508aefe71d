"""Define the warning that a result lies outside the range in which a model is valid."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from stiction.quantities.table import QUANTITIES
from stiction.records.claims import KINDS_OF_WARNING, range_in_words


@dataclass(frozen=True)
class ValidityWarning:
    """Describe a reason why a result may be wrong: one of its quantities is outside a validity range.

    - why: the reason, as text
    - quantity: key of the quantity outside its range; "" for a general warning, which has only `why` and `kind`
    - least, most: smallest and largest of the values outside the range
    - low, high: ends of the range; -inf or inf if open
    - outside, points: number of solved points outside the range, and number of all solved points. With points = 0 `why` is a
      whole sentence, otherwise it follows the quantity and its values when printed
    - kind: a key of KINDS_OF_WARNING
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
        """Return how far the values lie outside the range, relative to the bound they violate; absolute if this bound is 0.

        If both bounds are violated, the larger number is returned. The result is NaN if no bound is finite.
        """
        ends = [(self.low, self.low - self.least), (self.high, self.most - self.high)]
        excesses = [distance / abs(bound) if bound else distance for bound, distance in ends if math.isfinite(bound)]
        return max(excesses, default=math.nan)

    def as_data(self) -> dict[str, str | float | None]:
        """Return the fields and `beyond` by name, for JSON; a warning without a quantity has only `why` and `kind`.

        An infinite `least` or `most` becomes "inf" or "-inf"; any other infinite number, and NaN, becomes None.
        """
        if not self.quantity:
            return {"why": self.why, "kind": self.kind}
        data = asdict(self) | {"beyond": self.beyond}
        values = {name: str(data[name]) for name in ("least", "most") if math.isinf(data[name])}
        open_ends = {name: None for name, value in data.items() if isinstance(value, float) and not math.isfinite(value)}
        return data | open_ends | values

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> "ValidityWarning":
        """Return the warning from the dict that `as_data` returned; fields missing or None get their defaults."""
        fields = {name: value for name, value in data.items() if name != "beyond" and value is not None}
        return cls(**fields | {name: float(fields[name]) for name in ("least", "most") if name in fields})

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
        row = QUANTITIES[self.quantity]
        unit = " sigma" if row.normalised_by == "sigma" and row.unit else ""
        return f"{row.meaning} is {self._values}{unit} {where}, valid range {self._range}: {self.why}"

    @property
    def in_brief(self) -> str:
        """Return the quantity's short name and its values as text; `why` if `points` is 0."""
        return f"{QUANTITIES[self.quantity].short or self.quantity} {self._values}" if self.points else self.why

    @property
    def rule(self) -> str:
        """Return the violated range and the reason for it, as text with the symbol of the quantity but without its value.

        The text is `why` alone if the quantity is "" or unknown.
        """
        return (
            f"{QUANTITIES[self.quantity].symbol} is not {self._range}: {self.why}" if self.quantity in QUANTITIES else self.why
        )

    @property
    def short(self) -> str:
        """Return symbol, values and allowed range of the quantity with the reason, as text; `why` if `points` is 0."""
        if not self.points:
            return self.why
        return f"{QUANTITIES[self.quantity].symbol} = {self._values}, not {self._range}: {self.why}"
