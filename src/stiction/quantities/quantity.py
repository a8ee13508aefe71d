"""A row of the table of quantities."""

from dataclasses import dataclass
from math import degrees, inf, isinf
from typing import Any

# What a number of asperities is normalised by.
COUNT = "number of asperities"


def in_degrees(value: float, unit: str) -> tuple[float, str]:
    """Return a number and its unit as people write them: angles in degrees, all else as it is."""
    return (degrees(value), "deg") if unit == "rad" else (value, unit)


@dataclass(frozen=True)
class Quantity:
    """One row of the table.

    name: the key; symbol: plain text; latex: without dollar signs; unit: SI, "" if none; meaning: a phrase;
    lower, upper: bounds in the unit, with lower_included, upper_included (infinite values are never allowed);
    normalised_by: what the dimensionless form is divided by, "" if it has none; example: an accepted input; short: a name that
    fits on an axis of a plot together with its unit.
    """

    name: str
    symbol: str
    latex: str
    unit: str
    meaning: str
    lower: float = -inf
    upper: float = inf
    lower_included: bool = False
    upper_included: bool = False
    normalised_by: str = ""
    example: str = ""
    short: str = ""

    def holds(self, values: Any) -> Any:
        """Whether a number, or each of an array, is finite and within the bounds."""
        above = values >= self.lower if self.lower_included else values > self.lower
        below = values <= self.upper if self.upper_included else values < self.upper
        return above & below & (abs(values) < inf)

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of a variable: long_name, symbol and units; comment, the meaning in full where the name is short."""
        comment = {"comment": self.meaning} if self.short else {}
        return {"long_name": self.short or self.meaning, "symbol": self.symbol, "units": self.unit or "1"} | comment

    @property
    def allowed(self) -> str:
        """The allowed range with its unit, in words: "> 0 Pa", ">= 0 and < 0.5", "any finite number of m"."""
        signs = ">=" if self.lower_included else ">", "<=" if self.upper_included else "<"
        ends = [
            " ".join([sign, f"{value:g}", unit]).rstrip()
            for sign, (value, unit) in zip(signs, (in_degrees(end, self.unit) for end in (self.lower, self.upper)), strict=True)
            if not isinf(value)
        ]
        return " and ".join(ends) or ("any finite number" + (f" in {self.unit}" if self.unit else ""))

    @property
    def wanted(self) -> str:
        """The allowed range with an example where a unit has to be written: '> 0 m, e.g. "200 nm"'."""
        return f'{self.allowed}, e.g. "{self.example}"' if self.unit and self.example else self.allowed

    @property
    def described(self) -> str:
        """Return the meaning with what is wanted."""
        return f"{self.meaning}, {self.wanted}"

    @property
    def as_text(self) -> str:
        """Return what a case file must have: text with a unit."""
        return f"text with a unit: {self.described}"

    @property
    def scale(self) -> str:
        """Return the scale of results of a whole contact (contact.subject.Scales): the SI unit, or "count" of asperities."""
        return "count" if self.normalised_by == COUNT else self.unit

    @property
    def label(self) -> str:
        """The meaning with its unit, as on an axis: "asperity tip radius [m]"."""
        return f"{self.meaning} [{self.unit}]" if self.unit else self.meaning
