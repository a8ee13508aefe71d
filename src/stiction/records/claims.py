"""Claims of a record besides its formulas: grade, range of validity, limits, jumps, options."""

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

# What a tangential law or a film may want of an asperity law, and an asperity law may be.
TRAITS = {
    "JKR": "while elastic, adhesion acts inside the contact as Johnson, Kendall and Roberts have it",
    "no adhesion": "the load is compressive, and nothing at first touch",
    "Hertz": "while elastic, the contact is Hertz's",
    "Hertz's shape": "while elastic, the contact is Hertz's, alone, with JKR's adhesion or with DMT's",
    "2015": "the asperity of the 2015 paper",
}

# What a junction that has yielded resists, after a tangential law: from first to last are three orders of magnitude.
YIELDED = {
    "none": "junctions that have yielded resist nothing",
    "interface": "the strength of the interface acts on their area as the load leaves it",
    "junction growth": "the strength of the interface acts on their area, which grows under shear",
    "full stick": "they are as strong as the bulk",
}

# What it means to leave a range, the worst first.
KINDS_OF_WARNING = {
    "impossible": "cannot be so",
    "effect": "leaves out what matters here",
    "assumption": "an assumption of the model fails",
    "fit": "beyond the numbers it was fitted to",
    "statistics": "too few asperities or waves for an average",
}


@dataclass(frozen=True)
class Validity:
    """A range in which the authors claim their model, or beyond which an assumption fails.

    quantity: a name in `quantities`, in the sense used there; low and high: the range; why: what fails outside; kind: which
    of KINDS_OF_WARNING that is.
    """

    quantity: str
    low: float
    high: float
    why: str
    kind: str = "assumption"

    @property
    def range(self) -> str:
        return range_in_words(self.low, self.high)


@dataclass(frozen=True)
class Limit:
    """State that the model becomes `parent` (of the same kind) at these values of groups.

    A test over the registry checks it.

    groups: values of groups that make the limit. quantities: result names that must agree. within: relative difference.
    options: with which it does so.
    """

    parent: str
    groups: Mapping[str, float]
    quantities: tuple[str, ...]
    within: float
    options: Mapping[str, Any] = field(default_factory=dict)


# What a film has to become, whatever its law: under which a law is held by a test over the registry, or says how far it is off.
FILM_LIMITS = {
    "thin": "a film of no thickness leaves the substrate alone",
    "thick": "a film without end is the film alone",
    "alike": "a film like its substrate is not felt",
}


@dataclass(frozen=True)
class Departure:
    """A published film law does not become what it has to: by how much a result is off there, relative to what it should be.

    limit: see FILM_LIMITS. least, most: over soft and hard films, at plasticity indices of 0.5 and more; infinite where it has
    no bound. A test over the registry holds the record to them, and to a range of validity that is left wherever a result is
    off by more than a fifth.
    """

    limit: str
    quantity: str
    least: float
    most: float

    def __str__(self) -> str:
        ends = dict.fromkeys("any factor" if end == inf else f"{end:+.0%}" for end in (self.least, self.most))
        return f"{FILM_LIMITS[self.limit]}, but here {self.quantity} is off by {' to '.join(ends)}"


@dataclass(frozen=True)
class Jump:
    """A published law is not continuous: what its load and area are multiplied by where one piece gives way to the next.

    piece: the number of the piece that begins there, 1 for the second. load, area: the factors; groups: for which values of
    groups, where they depend on them. A test over the registry holds the record to them, to 1 in 1000.
    """

    piece: int
    load: float
    area: float
    where: str
    groups: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Parameter:
    """A number, a length or one of a few values that a user may give to a way of finding asperities.

    meaning: of its value and, where `default` is None, of what is then taken. values: all that is allowed, where that is few;
    else it is a finite number above `lower`, or from it on if lower_included. unit: "m" of a length, which may also be text
    with its unit, "" of a plain number.
    """

    meaning: str
    default: Any
    values: tuple[Any, ...] = ()
    unit: str = "m"
    lower: float = -inf
    lower_included: bool = False

    @property
    def allowed(self) -> str:
        """Return the allowed values in words: "5, 9", ">= 0 m, finite", "any finite length in m"."""
        if self.values:
            return ", ".join(map(str, self.values))
        if self.lower == -inf:
            return "any finite length in m" if self.unit else "any finite number"
        return f"{'>=' if self.lower_included else '>'} {self.lower:g}{' ' * bool(self.unit)}{self.unit}, finite"

    def allows(self, value: Any) -> bool:
        """Return whether a value (a length in metres) is allowed."""
        if self.values:
            return isinstance(value, str | Real) and value in self.values
        number: Any = value if isinstance(value, Real) else nan
        return self.lower < number < inf or (self.lower_included and number == self.lower)


def range_in_words(low: float, high: float) -> str:
    """ "0 to 0.5", "5 or more"."""
    if high == inf:
        return f"{low:g} or more"
    return f"{high:g} or less" if low == -inf else f"{low:g} to {high:g}"
