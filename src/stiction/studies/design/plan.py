"""Read and check the table [design] of a case: choices, objectives and constraints of a design search."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from stiction.case.addresses import address_of, as_numbers, leaves_of, subject_table
from stiction.case.free import Free, read_free
from stiction.case.read import with_single_numbers
from stiction.case.study_tables import study_table
from stiction.case.swept import Address, number_of
from stiction.case.uncertain import Uncertain
from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError, InWords, field_below, nearest
from stiction.quantities.inputs import require_names
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.studies.design.table import Design, Objective

LOAD = ("solve", "load")
_NAMED = ("material", "bodies", "first", "second")  # entries of a contact that may be chosen and are not numbers
_MOST_FREE, _MOST_OPTIONS, _MOST_WAYS = 8, 100, 2000


@dataclass(frozen=True)
class Options:
    """Describe a list in [design.choose] from which the search chooses one entry.

    path: address (tuple of keys) of the chosen number or material in the case. entries: numbers in SI units, or names and
    tables as in a case file. words: the entries as text. is_number: whether the entries are numbers.
    """

    path: Address
    entries: tuple[Any, ...]
    words: tuple[str, ...]
    is_number: bool

    @property
    def name(self) -> str:
        return ".".join(self.path[1:])

    def index(self, share: Any) -> np.ndarray:
        return np.minimum((np.asarray(share) * len(self.entries)).astype(int), len(self.entries) - 1)


@dataclass(frozen=True)
class Limit:
    """Describe a constraint of a design: the result `quantity` must lie between `low` and `high`, in SI units.

    An infinite `low` or `high` sets no constraint.
    """

    quantity: str
    low: float
    high: float

    @property
    def words(self) -> str:
        low, high = (show(end, quantity_of(self.quantity)) for end in (self.low, self.high))
        if not np.isfinite(self.low):
            return f"{self.quantity} {high} at most"
        return f"{self.quantity} {low} at least" if not np.isfinite(self.high) else f"{self.quantity} {low} to {high}"


@dataclass(frozen=True)
class DesignPlan:
    """Hold the checked input of a design search.

    content: tables of the case, without the tables of studies; the files that they name have been read. given: tables as the
    user wrote them. folder: folder at which relative paths in the tables start. free: numbers chosen between two ends. options:
    lists to choose from. objectives: one or two. targets: target value of each objective in SI units, NaN for an objective
    without a target. limits: constraints on results. validity: which validity warnings are constraints too, as in [design].
    effort: largest number of generations of the search. uncertain: uncertain numbers of the case.
    """

    content: Mapping[str, Any]
    given: Mapping[str, Any]
    folder: Path
    title: str
    free: tuple[Free, ...]
    options: tuple[Options, ...]
    objectives: tuple[Objective, ...]
    targets: tuple[float, ...]
    limits: tuple[Limit, ...]
    validity: str
    effort: int
    seed: int
    uncertain: tuple[Uncertain, ...]

    @property
    def quantities(self) -> list[str]:
        """Return the names of the results that are objectives or have constraints."""
        return [*(one.quantity for one in self.objectives), *(one.quantity for one in self.limits)]

    @property
    def unknowns(self) -> tuple[Free | Options, ...]:
        return (*self.options, *self.free)


def quantity_of(name: str) -> str:
    """Return the quantity of a result, e.g. friction_coefficient for the interval end friction_coefficient_low."""
    return name if name in QUANTITIES else name.removesuffix("_low").removesuffix("_high")


def make_design_plan(content: Mapping[str, Any], folder: Path = Path()) -> DesignPlan:
    """Return the checked design plan that the tables of a case file describe.

    folder: folder at which relative paths in the tables start. Raises InputError.
    """
    require_names(content)
    wanted = 'a table [design] with objective = { minimise = "friction_coefficient" } and [design.choose]'
    design: Design = study_table(content, "design", wanted)
    plain, uncertain = with_single_numbers(content, folder, "lists to choose from go under [design.choose]")
    plain = as_numbers(plain)
    free, options = _unknowns(design, plain)
    objectives, targets = _objectives(design)
    return DesignPlan(
        content=plain,
        given=dict(content),
        folder=folder,
        title=str(content.get("title", "")),
        free=free,
        options=options,
        objectives=objectives,
        targets=targets,
        limits=tuple(_limit(name, entry) for name, entry in design.limits.items()),
        validity=design.validity,
        effort=design.effort,
        seed=design.seed,
        uncertain=tuple(uncertain.values()),
    )


def _unknowns(design: Design, content: Mapping) -> tuple[tuple[Free, ...], tuple[Options, ...]]:
    free: list[Free] = []
    options: list[Options] = []
    for name, entry in leaves_of(design.choose, "design.choose", lambda table: bool(table.keys() & {"low", "high"})):
        where = f"design.choose.{name}"
        path = _path(name, content, where)
        if path in [one.path for one in free] + [one.path for one in options]:
            raise InputError(where, name, "each number only once; delete the repetition")
        if isinstance(entry, list):
            options.append(_options(path, entry, where))
        elif path[-1] in _NAMED:
            raise InputError(where, entry, "a list to choose from")
        else:
            free.append(read_free(path, entry, where))
            if free[-1].each_sample:
                raise InputError(f"{where}.each_sample", True, "not supported: a design has no samples")
    if not free and not options:
        raise InputError(
            "design.choose", None, 'something to choose, e.g. coating.thickness = { low = "50 nm", high = "1 um" }'
        )
    if len(free) > _MOST_FREE:
        raise InputError("design.choose", InWords(f"{len(free)} numbers with low and high"), f"{_MOST_FREE} at most")
    ways = int(np.prod([float(len(one.entries)) for one in options if not one.is_number] or [1.0]))
    if ways > _MOST_WAYS:
        raise InputError("design.choose", InWords(f"{ways} combinations of materials and bodies"), f"{_MOST_WAYS} at most")
    return tuple(free), tuple(options)


def _path(name: str, content: Mapping, where: str) -> Address:
    if name == "load":
        return LOAD
    last = name.rpartition(".")[2]
    if last not in _NAMED:
        return address_of(name, content, where, of_finish=True)
    table = subject_table(content)
    contact: Any = content.get("contact", {})
    named = {"coating.material", "coating.bodies", "material", "bodies", "first", "second"}
    film = isinstance(contact, Mapping) and "coating" in contact
    if table != "contact" or name not in named or (last in ("material", "bodies") and not film):
        raise InputError(
            where, name, f"a number of the contact, first, second{', coating.material, coating.bodies' if film else ''}"
        )
    return (table, "coating", last) if last in ("material", "bodies") else (table, last)


def _options(path: Address, entries: list, where: str) -> Options:
    if not 1 <= len(entries) <= _MOST_OPTIONS:
        raise InputError(where, InWords(f"{len(entries)} entries"), f"a list of 1 to {_MOST_OPTIONS}")
    if path[-1] not in _NAMED:
        numbers = tuple(number_of(one, path[-1], where) for one in entries)
        return Options(path, numbers, tuple(str(one) for one in entries), True)
    words = tuple(str(one.get("preset", one.get("name", "table"))) if isinstance(one, Mapping) else str(one) for one in entries)
    words = tuple(f"{word} ({at + 1})" if words.count(word) > 1 else word for at, word in enumerate(words))
    return Options(path, tuple(entries), words, False)


def _objectives(design: Design) -> tuple[tuple[Objective, ...], tuple[float, ...]]:
    given = design.objective if isinstance(design.objective, list) else [design.objective]
    if not 1 <= len(given) <= 2:
        raise InputError("design.objective", InWords(f"{len(given)} objectives"), "one or two")
    objectives, targets = [], []
    for at, one in enumerate(given):
        where = "design.objective" + (f"[{at}]" if len(given) > 1 else "")
        if not isinstance(one, Mapping):
            raise InputError(where, one, 'a table, e.g. { minimise = "friction_coefficient" }')
        with field_below(where):
            objective = Objective(**one)
        _check_quantity(objective.quantity, where)
        objectives.append(objective)
        targets.append(
            number_of(objective.value, quantity_of(objective.quantity), f"{where}.value") if objective.target else float("nan")
        )
    return tuple(objectives), tuple(targets)


def _check_quantity(name: str, where: str) -> None:
    if quantity_of(name) not in QUANTITIES or (name in Contact.model_fields):
        results = [one.name for one in QUANTITIES.values() if not one.example or one.name in ("load", "mean_separation")]
        raise InputError(where, name, "a result or a group of the contact: " + nearest(name, results))


def _limit(name: str, entry: Any) -> Limit:
    where = f"design.limits.{name}"
    _check_quantity(name, where)
    if not isinstance(entry, Mapping) or not entry or entry.keys() - {"low", "high"}:
        unit = QUANTITIES[quantity_of(name)].unit
        raise InputError(
            where, entry, f'a table with low, high or both, e.g. {{ high = "1 {unit}" }}' if unit else "low, high or both"
        )
    low, high = (
        number_of(entry[end], quantity_of(name), f"{where}.{end}") if end in entry else np.nan for end in ("low", "high")
    )
    if np.isfinite(low) and np.isfinite(high) and low > high:
        raise InputError(where, [entry["low"], entry["high"]], "low not above high")
    return Limit(name, -np.inf if np.isnan(low) else low, np.inf if np.isnan(high) else high)
