"""What the program knows of its models: one record each, found in the folders of models and films, and in entry points.

A model is a module with a RECORD. Adding one is one file in `models/` (or, outside the package, an entry point in the
group "stiction"), one file of reference numbers in the tests and one bibliography entry; tables, command line, citations
and contract tests are made from the record.
"""

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import entry_points
from math import inf

from .errors import InputError
from .sources import Source

PLACES = ("stiction.models", "stiction.coating")

GRADES = {
    "A": "reproduces numbers that its source prints",
    "B": "re-derived here and checked against limits or an independent code",
    "C": "reconstructed: the source was not available or is misprinted; what was reconstructed is said",
}


@dataclass(frozen=True)
class Validity:
    """A range in which the authors claim their model, or beyond which an assumption fails.

    quantity: a name in `quantities`, in the sense used there; low and high: the range; why: what fails outside.
    """

    quantity: str
    low: float
    high: float
    why: str

    @property
    def range(self) -> str:
        """The range in words: "0 to 0.5", "5 or more"."""
        if self.high == inf:
            return f"{self.low:g} or more"
        return f"{self.high:g} or less" if self.low == -inf else f"{self.low:g} to {self.high:g}"


@dataclass(frozen=True)
class Limit:
    """The model becomes `parent` when these groups take these values: a test over the registry holds it to that.

    groups: values of groups that make the limit. quantities: result names that must agree. within: relative difference.
    """

    parent: str
    groups: Mapping[str, float]
    quantities: tuple[str, ...]
    within: float
    options: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Record:
    """All that is said of one model or film law.

    key: author_year, or a name. kind: "rough surface" or "film". grade: see GRADES. needs: names of the groups it depends
    on. regimes: for a rough surface, regimes(groups, **options) -> list of Regime; for a film,
    regimes(substrate, film, groups) -> list of Regime. own_options: option name -> allowed values, the first is the default.
    default_film: the film law of a coated surface, if the model knows films. interchangeable: False for a film that belongs
    to one reading only. friction: False where the source has no tangential law. load_falls: the source's load falls with
    growing separation wherever it is compressive. accuracy: sums are good to this, relative to each law's own; larger where
    kinks of a law are found by scanning. verified: what the numbers were checked against. notes: what a user should know.
    """

    key: str
    kind: str
    title: str
    grade: str
    sources: tuple[Source, ...]
    regimes: Callable
    verified: str
    needs: tuple[str, ...] = ()
    validity: tuple[Validity, ...] = ()
    limits: tuple[Limit, ...] = ()
    own_options: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    default_film: str = ""
    interchangeable: bool = True
    friction: bool = True
    load_falls: bool = True
    accuracy: float = 1e-10
    notes: str = ""
    entries: Mapping[str, str] = field(default_factory=dict)

    @property
    def coating(self) -> bool:
        """Whether the model knows films."""
        return bool(self.default_film)

    @property
    def options(self) -> dict[str, tuple[str, ...]]:
        """Option name -> allowed values, the first is the default; every interchangeable film is a coating_law."""
        if not self.default_film:
            return dict(self.own_options)
        others = [one.key for one in records().values() if one.kind == "film" and one.interchangeable]
        others.remove(self.default_film)
        return {**self.own_options, "coating_law": (self.default_film, *others)}


@cache
def records() -> dict[str, Record]:
    """Every record: key -> Record, rough surfaces first, each kind in alphabetical order."""
    found = []
    for place in PLACES:
        package = importlib.import_module(place)
        for module in pkgutil.iter_modules(package.__path__, f"{place}."):
            found.append(getattr(importlib.import_module(module.name), "RECORD", None))
    found += [entry.load() for entry in entry_points(group="stiction")]
    known = sorted((record for record in found if record), key=lambda record: (record.kind != "rough surface", record.key))
    return {record.key: record for record in known}


def find(key: str, kind: str) -> Record:
    """The record of this key and kind; InputError otherwise."""
    allowed = {name: record for name, record in records().items() if record.kind == kind}
    if key not in allowed:
        raise InputError("model" if kind == "rough surface" else "coating_law", key, ", ".join(allowed))
    return allowed[key]


def settle(record: Record, options: Mapping[str, str | None]) -> dict[str, str]:
    """Every option of the record, with its default where None or nothing is given; InputError for what it does not have."""
    for name, value in options.items():
        if value is not None and value not in record.options.get(name, ()):
            allowed = ", ".join(record.options.get(name, ())) or f"nothing: {record.key} has no such option"
            raise InputError(name, value, allowed)
    return {name: options.get(name) or allowed[0] for name, allowed in record.options.items()}
