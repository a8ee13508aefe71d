"""Define the claims that the record of a law makes in addition to its formulas.

These are its grade, validity ranges, limiting cases, discontinuities and parameters.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf, nan
from numbers import Real
from typing import Any

GRADES = {
    "A": "reproduces numbers that its source prints",
    "B": "re-derived here and checked against limits or an independent code",
    "C": "reconstructed: the source was not available or is misprinted; the sources name what was reconstructed",
}

# Properties of asperity laws (traits), which tangential laws and film laws may require.
TRAITS = {
    "JKR": "while elastic, the contact follows the law of Johnson, Kendall and Roberts",
    "no adhesion": "the load is compressive, and zero at first touch",
    "Hertz": "while elastic, the contact follows the law of Hertz",
    "Hertz's shape": "while elastic, the contact follows the law of Hertz, JKR or DMT",
    "2015": "the asperity of the 2015 paper (soft_coating_2015)",
}

# Assumptions of tangential laws on the resistance of yielded junctions. The resistances differ by three orders of magnitude.
YIELDED = {
    "none": "yielded junctions have no resistance",
    "interface": "the shear strength of the interface acts on their area under the normal load",
    "junction growth": "the shear strength of the interface acts on their area, which grows under shear",
    "full stick": "yielded junctions are as strong as the bulk",
}

# Kinds of validity warnings, the most severe first.
KINDS_OF_WARNING = {
    "impossible": "the result is physically impossible",
    "effect": "the model omits an effect that matters here",
    "assumption": "an assumption of the model fails",
    "fit": "outside the data that the model was fitted to",
    "statistics": "too few asperities or waves for an average",
}


@dataclass(frozen=True)
class Validity:
    """Describe the range of one quantity in which a model is valid; a result outside this range gets a validity warning.

    - quantity: key of the quantity in the results or dimensionless groups, such as "plasticity_index"
    - low, high: ends of the range; -inf or inf for an open end
    - why: the assumption that fails outside the range
    - kind: kind of the validity warning, a key of KINDS_OF_WARNING
    - as_published: whether the range applies only while yielded junctions have no friction (plastic_junctions = "none")
    """

    quantity: str
    low: float
    high: float
    why: str
    kind: str = "assumption"
    as_published: bool = False

    @property
    def range(self) -> str:
        return range_in_words(self.low, self.high)


@dataclass(frozen=True)
class Limit:
    """Describe a limiting case in which a model must agree with another model of the same kind; a test checks it.

    - parent: key of the other model
    - groups: values of the dimensionless groups in this limit, by name
    - quantities: names of the results that must agree
    - within: largest relative difference allowed
    - options: options of the model for which the limit holds, by name
    """

    parent: str
    groups: Mapping[str, float]
    quantities: tuple[str, ...]
    within: float
    options: Mapping[str, Any] = field(default_factory=dict)


# Limits that every film law should satisfy. A test checks them; a law that fails one states a Departure.
FILM_LIMITS = {
    "thin": "at zero film thickness the result should be that of the substrate",
    "thick": "at infinite film thickness the result should be that of the film",
    "alike": "if film and substrate are equal, the film should have no effect",
}


@dataclass(frozen=True)
class Departure:
    """Describe the error of a published film law in a limit that every film law should satisfy.

    - limit: a key of FILM_LIMITS, such as "thin"
    - quantity: name of the result that has the error
    - least, most: smallest and largest relative error over soft and hard films, at plasticity indices of 0.5 and more; inf if
      unbounded

    Tests check these errors, and that the validity ranges of the law exclude every film with an error above 20 %.
    """

    limit: str
    quantity: str
    least: float
    most: float

    def __str__(self) -> str:
        ends = dict.fromkeys("any factor" if end == inf else f"{end:+.0%}" for end in (self.least, self.most))
        return f"{FILM_LIMITS[self.limit]}, but {self.quantity} differs by {' to '.join(ends)}"


@dataclass(frozen=True)
class Jump:
    """Describe a discontinuity of a published asperity law between two of its segments (smooth parts of the law).

    - segment: index of the segment that begins at the jump, 1 for the second
    - load, area: factors by which load and contact area change at the jump
    - where: place of the jump, as text
    - groups: values of the dimensionless groups for which the factors hold; empty if the factors depend on none

    A test checks the factors to 1 in 1000.
    """

    segment: int
    load: float
    area: float
    where: str
    groups: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Parameter:
    """Describe a parameter of an asperity method that the user may set: a number, a length, or one of a few values.

    - meaning: what the value means, and the default if `default` is None
    - default: value that is used if the user sets none
    - values: all allowed values; if empty, every finite number above `lower` is allowed
    - lower: lower bound; lower_included: whether the bound itself is allowed
    - unit: "m" for a length, which the user may also write as text with a unit; "" for a plain number
    """

    meaning: str
    default: Any
    values: tuple[Any, ...] = ()
    unit: str = "m"
    lower: float = -inf
    lower_included: bool = False

    @property
    def allowed(self) -> str:
        """Return the allowed values as text: "5, 9", ">= 0 m, finite" or "any finite length in m"."""
        if self.values:
            return ", ".join(map(str, self.values))
        if self.lower == -inf:
            return "any finite length in m" if self.unit else "any finite number"
        return f"{'>=' if self.lower_included else '>'} {self.lower:g}{' ' * bool(self.unit)}{self.unit}, finite"

    def allows(self, value: Any) -> bool:
        """Return whether this parameter may have the value; a length must be a number in m."""
        if self.values:
            return isinstance(value, str | Real) and value in self.values
        number: Any = value if isinstance(value, Real) else nan
        return self.lower < number < inf or (self.lower_included and number == self.lower)


def range_in_words(low: float, high: float) -> str:
    """Return a range as text with three significant digits: "0 to 0.5", "5 or more" or "5 or less"; an infinite end is open."""
    if high == inf:
        return f"{low:.3g} or more"
    return f"{high:.3g} or less" if low == -inf else f"{low:.3g} to {high:.3g}"
