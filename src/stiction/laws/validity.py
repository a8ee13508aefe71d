"""Where a result goes beyond what the authors of its laws claim, as data: doubts."""

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.subject import Subject
from stiction.quantities.table import QUANTITIES
from stiction.records.claims import KINDS_OF_DOUBT, Validity, range_in_words

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class Doubt:
    """Why a result may not hold.

    why: in words. quantity: a name of the table of quantities, "" for a doubt that is of none; then all else is left out.
    least, most: of its values that are outside, at `outside` of `points` points; low, high: the range that is claimed,
    infinite where it is open. kind: which of KINDS_OF_DOUBT.
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
        if self.kind not in KINDS_OF_DOUBT:
            raise ValueError(f"a doubt is {', '.join(KINDS_OF_DOUBT)}, not {self.kind}")

    @property
    def beyond(self) -> float:
        """How far outside at the worst: over the bound that is left, or as it is where that bound is zero."""
        ends = [(self.low, self.low - self.least), (self.high, self.most - self.high)]
        return max(distance / abs(bound) if bound else distance for bound, distance in ends if math.isfinite(bound))

    def as_data(self) -> dict[str, Any]:
        """The fields with `beyond`, for programs; a doubt that is of no quantity has its words only."""
        return asdict(self) | {"beyond": self.beyond} if self.quantity else {"why": self.why, "kind": self.kind}

    @property
    def _values(self) -> str:
        return " to ".join(dict.fromkeys((f"{self.least:.3g}", f"{self.most:.3g}")))

    @property
    def _range(self) -> str:
        return range_in_words(self.low, self.high)

    def __str__(self) -> str:
        if not self.quantity:
            return self.why
        where = f"in {self.outside} of {self.points} points" if self.points > 1 else "here"
        return f"{QUANTITIES[self.quantity].meaning} is {self._values} {where}, claimed is {self._range}: {self.why}"

    @property
    def in_brief(self) -> str:
        """Which quantity is outside of what is claimed, with its value."""
        return f"{QUANTITIES[self.quantity].short or self.quantity} {self._values}" if self.quantity else self.why

    @property
    def rule(self) -> str:
        """Which range is left, without by how much."""
        return f"{QUANTITIES[self.quantity].symbol} is not {self._range}: {self.why}" if self.quantity else self.why

    @property
    def short(self) -> str:
        """The same with the quantity's symbol."""
        if not self.quantity:
            return self.why
        return f"{QUANTITIES[self.quantity].symbol} = {self._values}, not {self._range}: {self.why}"


def doubts_about(subject: Subject, rules: Iterable[Validity], results: Mapping[str, Any]) -> list[Doubt]:
    """The ranges that are left. results: normalised, by name, the mean separation over sigma; None for what is not known. What
    is not among them the contact is asked for."""
    found = []
    for rule, values, outside in ranges_left(subject, rules, results):
        ends = float(values[outside].min()), float(values[outside].max())
        points = int(outside.sum()), outside.size
        found.append(Doubt(rule.why, rule.quantity, *ends, rule.low, rule.high, *points, rule.kind))
    return found


def ranges_left(
    subject: Subject, rules: Iterable[Validity], results: Mapping[str, Any]
) -> Iterator[tuple[Validity, np.ndarray, np.ndarray]]:
    """The same, rule by rule: the rule, the values of its quantity as an array, and which of them are outside. What is not a
    number is not."""
    for rule in dict.fromkeys(rules):
        value = results[rule.quantity] if rule.quantity in results else subject.known(rule.quantity)
        if value is None:
            continue
        values = np.atleast_1d(np.asarray(value, dtype=float))
        outside = (values < rule.low) | (values > rule.high)
        if outside.any():
            yield rule, values, outside


def with_doubts(data: "xarray.Dataset", more: Iterable[Doubt]) -> "xarray.Dataset":
    """A result with these doubts beside those that it has: as text under `outside_validity`, as JSON under `doubts`."""
    return data.assign_attrs(as_attributes([*doubts_of(data), *more]))


def as_attributes(doubts: Iterable[Doubt]) -> dict[str, str]:
    """Attributes of a result that say its doubts; a netCDF file keeps them."""
    doubts = tuple(doubts)
    data = [{name: _plain(name, value) for name, value in doubt.as_data().items()} for doubt in doubts]
    return {"outside_validity": "; ".join(map(str, doubts)), "doubts": json.dumps(data, ensure_ascii=False)}


def doubts_of(data: "xarray.Dataset") -> list[Doubt]:
    """The doubts that a result carries."""
    return read_doubts(data.attrs.get("doubts", "[]"))


def read_doubts(text: str) -> list[Doubt]:
    """The doubts that `as_attributes` wrote as JSON."""
    return [_read(row) for row in json.loads(text)]


def _plain(name: str, value: Any) -> Any:
    """Return what JSON can hold: null for an open end and for what is not a number, "inf" or "-inf" for an infinite value."""
    if not isinstance(value, float) or math.isfinite(value):
        return value
    return str(value) if name in ("least", "most") and math.isinf(value) else None


def _read(row: Mapping[str, Any]) -> Doubt:
    missing: dict[str, Any] = {"low": -math.inf, "high": math.inf, "least": math.nan, "most": math.nan}
    given = {name: missing[name] if row[name] is None else row[name] for name in row if name != "beyond"}
    return Doubt(**given | {name: float(given[name]) for name in ("least", "most") if name in given})
