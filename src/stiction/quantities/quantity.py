"""Define the class Quantity: name, unit, bounds and texts of one physical quantity."""

from dataclasses import dataclass
from math import degrees, inf, isinf
from typing import Any

# Value of `normalised_by` for results that count asperities.
COUNT = "number of asperities"


def in_degrees(value: float, unit: str) -> tuple[float, str]:
    """Return a number and its unit for display: an angle in rad is converted to degrees, anything else is unchanged."""
    return (degrees(value), "deg") if unit == "rad" else (value, unit)


@dataclass(frozen=True)
class Quantity:
    """Store one row of the table of quantities, such as asperity_radius.

    - name: key in QUANTITIES; symbol: as plain text; latex: symbol in LaTeX, without dollar signs
    - unit: SI unit, "" if dimensionless; meaning: a phrase
    - lower, upper: bounds in this unit; lower_included, upper_included: whether a bound itself is allowed. Infinite values are
      never allowed
    - normalised_by: scale by which a result is divided to be dimensionless, "" if there is none
    - example: an accepted input; short: name for a plot axis, "" to use the meaning
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
        """Return, for each value (in the unit of the quantity), whether it is finite and within the bounds."""
        above = values >= self.lower if self.lower_included else values > self.lower
        below = values <= self.upper if self.upper_included else values < self.upper
        return above & below & (abs(values) < inf)

    @property
    def attributes(self) -> dict[str, str]:
        """Return the attributes of an xarray variable with this quantity: long_name, symbol and units.

        long_name is the short name if there is one, and the attribute `comment` then holds the full meaning.
        """
        comment = {"comment": self.meaning} if self.short else {}
        return {"long_name": self.short or self.meaning, "symbol": self.symbol, "units": self.unit or "1"} | comment

    @property
    def allowed(self) -> str:
        """Return the allowed range as text with unit: "> 0 Pa", ">= 0 and < 0.5", "any finite number in m"."""
        signs = ">=" if self.lower_included else ">", "<=" if self.upper_included else "<"
        ends = [
            " ".join([sign, f"{value:g}", unit]).rstrip()
            for sign, (value, unit) in zip(signs, (in_degrees(end, self.unit) for end in (self.lower, self.upper)), strict=True)
            if not isinf(value)
        ]
        return " and ".join(ends) or ("any finite number" + (f" in {self.unit}" if self.unit else ""))

    @property
    def wanted(self) -> str:
        """Return the allowed range as text, with an example for a quantity with a unit: '> 0 m, e.g. "200 nm"'."""
        return f'{self.allowed}, e.g. "{self.example}"' if self.unit and self.example else self.allowed

    @property
    def described(self) -> str:
        """Return the meaning and the allowed range as text: 'asperity tip radius, > 0 m, e.g. "50 um"'."""
        return f"{self.meaning}, {self.wanted}"

    @property
    def as_text(self) -> str:
        """Describe, for an error message, the text with a unit that a case file needs for this quantity."""
        return f"text with a unit: {self.described}"

    @property
    def scale(self) -> str:
        """Return the key in `Scales.factors()` for the factor that converts a dimensionless result to SI units.

        The key is the SI unit, or "count" for a number of asperities.
        """
        return "count" if self.normalised_by == COUNT else self.unit

    @property
    def label(self) -> str:
        """Return the meaning with the unit in brackets, as on a plot axis: "asperity tip radius [m]"."""
        return f"{self.meaning} [{self.unit}]" if self.unit else self.meaning
