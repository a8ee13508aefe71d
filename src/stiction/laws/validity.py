"""Where a result goes beyond what the authors of its laws claim."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from stiction.contact.contact import Contact, Indices
from stiction.laws.registry import Record, Validity
from stiction.quantities.table import QUANTITIES


@dataclass(frozen=True)
class Breach:
    """A range of validity that is left: by which values, at how many points of how many."""

    rule: Validity
    ends: tuple[str, ...]
    outside: int
    points: int

    def __str__(self) -> str:
        where = f"in {self.outside} of {self.points} points" if self.points > 1 else "here"
        meaning = QUANTITIES[self.rule.quantity].meaning
        return f"{meaning} is {' to '.join(self.ends)} {where}, claimed is {self.rule.range}: {self.rule.why}"

    @property
    def short(self) -> str:
        """The same with the quantity's symbol."""
        return f"{QUANTITIES[self.rule.quantity].symbol} = {' to '.join(self.ends)}, not {self.rule.range}: {self.rule.why}"


def breaches(contact: Contact | Indices, records: Iterable[Record], results: Mapping[str, np.ndarray]) -> list[Breach]:
    """The ranges of validity that are left. results: normalised, by name; the mean separation over sigma."""
    found = []
    for rule in dict.fromkeys(rule for record in records for rule in record.validity):
        values = _known(contact, results, rule.quantity)
        if values is None or not np.any(outside := (values < rule.low) | (values > rule.high)):
            continue
        ends = dict.fromkeys((f"{values[outside].min():.3g}", f"{values[outside].max():.3g}"))
        found.append(Breach(rule, tuple(ends), int(outside.sum()), outside.size))
    return found


def _known(contact: Contact | Indices, results: Mapping[str, np.ndarray], name: str) -> np.ndarray | None:
    """Values of a quantity that a range of validity speaks of, as far as this contact decides it."""
    if name in results:
        return np.atleast_1d(results[name])
    known = contact if hasattr(contact, name) or isinstance(contact, Indices) else contact.indices()
    value = getattr(known, name, None)
    return None if value is None else np.atleast_1d(np.asarray(value() if callable(value) else value, dtype=float))
