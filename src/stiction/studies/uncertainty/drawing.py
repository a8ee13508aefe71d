"""Many contacts that are drawn from what is uncertain, solved together: by one model, or each by the one drawn for it."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from stiction.case.read import Case
from stiction.case.uncertain import SAMPLE
from stiction.quantities.dimensions import arranged
from stiction.quantities.errors import InputError
from stiction.quantities.sampling import sobol_points
from stiction.records.registry import RoughSurface, find
from stiction.solving.choice import Choice
from stiction.solving.conditions import excludes
from stiction.solving.pointwise import WHY_NOT, BatchResult, meanings_of
from stiction.studies.evaluate_many import evaluate_many, evaluate_together

# What is asked of contacts that are drawn.
OUTPUTS = ("friction_coefficient", "contact_area", "load", "pull_off_force")
_AT_ONCE = 65_536  # points that are solved at once: bounds the memory
_MOST = 50_000_000  # points that are kept


@dataclass(frozen=True)
class Variant:
    """Who answers: a model with its laws and, of a measured surface, the roughness that one method finds."""

    choice: Choice
    roughness: Any = None

    def case(self, case: Case) -> Case:
        """Return the case as it is asked."""
        return case if self.roughness is None else case.at({("contact", "roughness"): self.roughness})


@dataclass
class Draws:
    """Results of contacts that are drawn.

    tables: name -> array (n, *shape), NaN where nothing is known and where the result is impossible; dims: name -> the
    dimensions of that shape; attributes: name -> meaning and unit. validity_warnings: range of validity, or why nothing is
    known -> in how many points. impossible: in how many points the result is impossible.
    """

    points: int = 0
    tables: dict[str, np.ndarray] = field(default_factory=dict)
    dims: dict[str, tuple[str, ...]] = field(default_factory=dict)
    attributes: dict[str, dict[str, str]] = field(default_factory=dict)
    validity_warnings: Counter[str] = field(default_factory=Counter)
    impossible: int = 0

    def shares(self) -> dict[str, float]:
        """Range of validity, or why nothing is known -> in which share of all points; those that are nowhere left out."""
        return {text: count / self._every for text, count in self.validity_warnings.most_common() if count}

    @property
    def impossible_share(self) -> float:
        """Return the share of all points whose result is impossible."""
        return self.impossible / self._every

    @property
    def _every(self) -> int:
        return self.points * max((len(table) for table in self.tables.values()), default=1)


def scrambled(columns: int, count: int, seed: int, parts: int = 1) -> np.ndarray:
    """Points (parts, count / parts, columns) in the unit cube: of Sobol's sequence, each part scrambled on its own (Owen)."""
    return np.array([sobol_points(columns, count // parts, one) for one in np.random.SeedSequence(seed).spawn(parts)])


def _steps(variants: Sequence[Variant], rows: np.ndarray, points: int) -> list[tuple[int, np.ndarray]]:
    """Return the steps, each a variant and the indices of its rows.

    rows: the variant of each row.
    """
    size = max(1, _AT_ONCE // max(points, 1))
    found = []
    for at in range(len(variants)):
        mine = np.flatnonzero(rows == at)
        found += [(at, mine[start : start + size]) for start in range(0, len(mine), size)]
    return found


def draw(
    case: Case,
    shares: np.ndarray,
    variants: Sequence[Variant],
    rows: np.ndarray | None = None,
    names: Sequence[str] = OUTPUTS,
    progress: Any = iter,
) -> Draws:
    """Solve the case at these quantile levels (n, k) of its `unknowns`.

    Each row is solved by its variant, by default the first. names: results to keep. progress: wraps the list of steps. Raises
    InputError where the first variant refuses the nominal contact, or where there are too many points.
    """
    for one in variants:
        if solves_maps(one.choice):
            raise InputError("model", one.choice.model_key, "a model that solves many contacts at once: numbers are uncertain")
    found = _layout(case, variants, names)
    count = len(shares)
    if count * found.points > _MOST:
        raise InputError("uncertainty.count", count, f"{_MOST // found.points} at most at {found.points} points of a contact")
    found.tables = {name: np.full((count, *table.shape), np.nan) for name, table in found.tables.items()}
    rows = np.zeros(count, dtype=int) if rows is None else rows
    cases, points = [one.case(case) for one in variants], _points(case)
    for at, some in progress(_steps(variants, rows, found.points)):
        numbers, choice = case.numbers_at(shares[some]), variants[at].choice
        for region, _, solved in evaluate_many(cases[at], numbers, points, choice, names, along=(SAMPLE,)):
            _keep(found, some[region.get(SAMPLE, slice(None))], solved)
    return found


def _points(case: Case) -> dict[str, Any] | None:
    """Return the loads of the case; separations follow from the tables, whose sigma may vary."""
    return None if case.load is None else {"load": case.load}


def solves_maps(choice: Choice) -> bool:
    """Whether this model solves the map of one contact, point by point: not for thousands that are drawn."""
    return find(choice.model_key, RoughSurface).of_map is not None


def _layout(case: Case, variants: Sequence[Variant], names: Sequence[str]) -> Draws:
    """Shapes and meanings of all results, of the nominal contact; a variant that refuses it says nothing of them."""
    found = Draws()
    for at, one in enumerate(variants):
        try:
            _, solved = evaluate_together(one.case(case), case.several, _points(case), one.choice, names)
        except (InputError, ArithmeticError):
            if at == 0:
                raise
            continue
        found.points = max(found.points, solved.validity_warnings[1].size)
        for name, (dims, values, attributes) in solved.variables.items():
            if name in names:
                found.tables.setdefault(name, values)
                found.dims.setdefault(name, tuple(dims))
                found.attributes.setdefault(name, attributes)
    return found


def _keep(found: Draws, rows: np.ndarray, solved: BatchResult | None) -> None:
    if solved is None:
        found.validity_warnings[WHY_NOT[0]] += len(rows) * found.points
        return
    points, bits = solved.validity_warnings
    rules = [bit for bit, rule in enumerate(solved.rules, start=len(WHY_NOT)) if excludes(rule)]
    impossible = bits & np.uint32(sum(1 << bit for bit in rules)) != 0
    for name, (dims, values, _) in solved.variables.items():
        if name in found.tables:
            values = np.where(impossible, np.nan, values) if tuple(dims) == points else values
            wanted = found.dims[name]  # separations over a sigma that is drawn have a name of their own
            have = ["mean_separation" if dim == "separation" and dim not in wanted else dim for dim in dims]
            found.tables[name][rows] = arranged(values, have, (SAMPLE, *wanted))
    times = len(rows) * found.points // bits.size
    found.impossible += times * int(impossible.sum())
    for bit, text in enumerate(meanings_of(solved.rules)):
        found.validity_warnings[text] += times * int(((bits >> np.uint32(bit)) & 1).sum())
