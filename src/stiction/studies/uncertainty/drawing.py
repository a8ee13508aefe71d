"""Sample the uncertain numbers of a contact, and solve all samples together.

One model may solve all samples, or each sample may have its own model.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from stiction.case.read import Case
from stiction.case.swept import Address
from stiction.case.uncertain import SAMPLE
from stiction.quantities.dimensions import arranged
from stiction.quantities.errors import InputError
from stiction.quantities.sampling import sobol_points
from stiction.records.registry import RoughSurface, find
from stiction.solving.choice import Choice
from stiction.solving.conditions import excludes
from stiction.solving.pointwise import REASONS, BatchResult, meanings_of
from stiction.solving.problem import with_surface_moments
from stiction.studies.evaluate_many import evaluate_many, evaluate_together

# Results that are computed for samples.
OUTPUTS = ("friction_coefficient", "contact_area", "load", "pull_off_force")
_AT_ONCE = 65_536  # points that are solved at once, to limit the memory
_MOST = 50_000_000  # largest number of stored points


@dataclass(frozen=True)
class Variant:
    """Describe a model with its laws and, for a measured surface, the roughness that one asperity method finds.

    roughness: None for the roughness of the case.
    """

    choice: Choice
    roughness: Any = None

    def case(self, case: Case) -> Case:
        """Return the case with the roughness of this variant; unchanged if the variant has none."""
        return case if self.roughness is None else case.at({("contact", "roughness"): self.roughness})


@dataclass
class Draws:
    """Store the results of n samples of a contact.

    A point is a sample at a load or separation. points: number of loads or separations of one contact. tables: arrays (n,
    *shape) by name, NaN where a result is missing or, for results at a point, impossible. dims: dimensions of `shape`, by name.
    attributes: meaning and unit, by name. validity_warnings: number of points by the text of a violated validity range, or of
    the reason for a missing result. impossible: number of points whose results are excluded: physically impossible, or with a
    mean pressure above the hardness.
    """

    points: int = 0
    tables: dict[str, np.ndarray] = field(default_factory=dict)
    dims: dict[str, tuple[str, ...]] = field(default_factory=dict)
    attributes: dict[str, dict[str, str]] = field(default_factory=dict)
    validity_warnings: Counter[str] = field(default_factory=Counter)
    impossible: int = 0

    def shares(self) -> dict[str, float]:
        """Return the fraction of all points for each validity warning or reason for a missing result, by text.

        A point is a sample at a load or separation. The most frequent text is first; texts without points are left out.
        """
        return {text: count / self._every for text, count in self.validity_warnings.most_common() if count}

    @property
    def impossible_share(self) -> float:
        """Return the fraction of all points (samples at a load or separation) whose results are excluded as impossible."""
        return self.impossible / self._every

    @property
    def _every(self) -> int:
        return self.points * max((len(table) for table in self.tables.values()), default=1)


def scrambled(columns: int, count: int, seed: int, parts: int = 1) -> np.ndarray:
    """Return quantile levels, 0 to 1, from `parts` independently scrambled Sobol sequences, (parts, count / parts, columns).

    columns: number of quantities to sample. count: number of samples in all sequences together. seed: determines the Owen
    scrambling of every sequence.
    """
    return np.array([sobol_points(columns, count // parts, sequence) for sequence in np.random.SeedSequence(seed).spawn(parts)])


def _steps(variants: Sequence[Variant], rows: np.ndarray, points: int) -> list[tuple[int, np.ndarray]]:
    """Return the batches to solve: (index of a variant, indices of samples), each of at most 65,536 points if possible.

    rows: index of the variant that solves each sample. points: number of loads or separations of one contact.
    """
    size = max(1, _AT_ONCE // max(points, 1))
    steps = []
    for variant in range(len(variants)):
        mine = np.flatnonzero(rows == variant)
        steps += [(variant, mine[start : start + size]) for start in range(0, len(mine), size)]
    return steps


def draw(
    case: Case,
    levels: np.ndarray,
    variants: Sequence[Variant],
    rows: np.ndarray | None = None,
    names: Sequence[str] = OUTPUTS,
    progress: Any = iter,
) -> Draws:
    """Solve a case for samples of its uncertain numbers, and return their results.

    levels: quantile levels (n, k) of the n samples, one column for each of the k entries in the case's `unknowns`. variants:
    models that may be used. rows: index of the variant that solves each sample, by default the first. names: results to return.
    progress: receives the list of batches and returns an iterable over it. Raises InputError if a variant solves height maps,
    or if there are too many points. Raises InputError or ArithmeticError if the first variant refuses the nominal contact,
    which is not solved if one batch has all samples.
    """
    for variant in variants:
        if solves_maps(variant.choice):
            raise InputError(
                "model", variant.choice.model_key, "a model that can solve many samples, because numbers are uncertain"
            )
    count = len(levels)
    if alone := len(variants) == 1 and case.load is not None and count * case.load.size <= _AT_ONCE and not case.swept:
        with suppress(InputError, ArithmeticError):
            return _all_together(case, levels, variants[0], names)
    draws = _layout(case, variants, names)
    if count * draws.points > _MOST:
        raise InputError("uncertainty.count", count, f"at most {_MOST // draws.points} for {draws.points} points per contact")
    draws.tables = {name: np.full((count, *table.shape), np.nan) for name, table in draws.tables.items()}
    rows = np.zeros(count, dtype=int) if rows is None else rows
    cases, points = [variant.case(case) for variant in variants], _points(case)
    for index, some in progress(_steps(variants, rows, draws.points)):
        numbers, choice = case.numbers_at(levels[some]), variants[index].choice
        if not alone:  # otherwise this is the one batch that was refused above
            with suppress(InputError, ArithmeticError):
                _, together = evaluate_together(cases[index], numbers, points, choice, names)
                _keep(draws, some, together)
                continue
        possible = _are_possible(cases[index], numbers, choice, len(some))
        _keep(draws, some[~possible], None)
        some = some[possible]
        if not some.size:
            continue
        numbers = case.numbers_at(levels[some])
        for region, _, solved in evaluate_many(cases[index], numbers, points, choice, names, along=(SAMPLE,)):
            _keep(draws, some[region.get(SAMPLE, slice(None))], solved)
    return draws


def _all_together(case: Case, levels: np.ndarray, variant: Variant, names: Sequence[str]) -> Draws:
    """Solve all samples in one batch, and return their results; the nominal contact is not solved.

    levels: quantile levels (n, k) of the samples. Raises InputError or ArithmeticError if the model refuses a sample.
    """
    numbers = case.numbers_at(levels)
    _, solved = evaluate_together(variant.case(case), numbers, _points(case), variant.choice, names)
    draws, count = Draws(points=1 if case.load is None else case.load.size), len(levels)
    for name, (dims, values, attributes) in solved.variables.items():
        if name in names:
            sizes = {dim: size for dim, size in zip(dims, values.shape, strict=True) if dim != SAMPLE}
            draws.tables[name] = np.full((count, *sizes.values()), np.nan)
            draws.dims[name], draws.attributes[name] = tuple(sizes), attributes
    _keep(draws, np.arange(count), solved)
    return draws


def _are_possible(case: Case, numbers: Mapping[Address, Any], choice: Choice, count: int) -> np.ndarray:
    """Return a mask (count,) of the samples in which every dimensionless group is within its bounds.

    Impossible samples are removed before a batch is solved, because bisecting a refused batch would take longer. The mask is
    True everywhere if the contact cannot be built from the numbers, or if no group varies between samples.
    """
    try:
        impossible: Any = with_surface_moments(case.at(numbers).subject, choice.model_key).impossible
    except (InputError, ArithmeticError):
        return np.ones(count, dtype=bool)
    if SAMPLE not in getattr(impossible, "dims", ()):
        return np.ones(count, dtype=bool)
    return np.asarray(~impossible.any([dim for dim in impossible.dims if dim != SAMPLE]))


def _points(case: Case) -> dict[str, Any] | None:
    """Return the loads of the case as {"load": loads}; None if it states separations.

    None makes the case compute its separations for each sample, because they may be multiples of an uncertain sigma.
    """
    return None if case.load is None else {"load": case.load}


def solves_maps(choice: Choice) -> bool:
    """Return whether a model solves a height map, which is too slow for thousands of samples."""
    return find(choice.model_key, RoughSurface).of_map is not None


def _layout(case: Case, variants: Sequence[Variant], names: Sequence[str]) -> Draws:
    """Return Draws with the shapes and meanings of the results `names`, from the nominal contact, but without samples.

    The tables have the nominal values. Variants that refuse the nominal contact are ignored, except for the first. Raises
    InputError or ArithmeticError if the first variant refuses it.
    """
    draws = Draws()
    for index, variant in enumerate(variants):
        try:
            _, solved = evaluate_together(variant.case(case), case.swept, _points(case), variant.choice, names)
        except (InputError, ArithmeticError):
            if index == 0:
                raise
            continue
        draws.points = max(draws.points, solved.validity_warnings[1].size)
        for name, (dims, values, attributes) in solved.variables.items():
            if name in names:
                draws.tables.setdefault(name, values)
                draws.dims.setdefault(name, tuple(dims))
                draws.attributes.setdefault(name, attributes)
    return draws


def _extend(draws: Draws, name: str, sizes: Mapping[str, int]) -> None:
    """Add the dimensions that samples of a result have and the nominal contact lacks.

    If the nominal result depends only on one body, it lacks the dimensions of the other body's inputs. A sample may depend on
    both bodies and have these dimensions. sizes: length of each dimension of the samples.
    """
    table, dims = draws.tables[name], draws.dims[name]
    if more := [dim for dim in sizes if dim not in (SAMPLE, *dims)]:
        shape = (*table.shape, *(sizes[dim] for dim in more))
        draws.tables[name] = np.broadcast_to(table[(..., *[np.newaxis] * len(more))], shape).copy()
        draws.dims[name] = (*dims, *more)


def _keep(draws: Draws, rows: np.ndarray, solved: BatchResult | None) -> None:
    if solved is None:
        draws.validity_warnings[REASONS[0]] += len(rows) * draws.points
        return
    points, bits = solved.validity_warnings
    rules = [bit for bit, rule in enumerate(solved.rules, start=len(REASONS)) if excludes(rule)]
    impossible = bits & np.uint32(sum(1 << bit for bit in rules)) != 0
    for name, (dims, values, _) in solved.variables.items():
        if name in draws.tables:
            values = np.where(impossible, np.nan, values) if tuple(dims) == points else values
            wanted = draws.dims[name]  # the dimension of separations is called "separation" where sigma is sampled
            have = ["mean_separation" if dim == "separation" and dim not in wanted else dim for dim in dims]
            _extend(draws, name, dict(zip(have, values.shape, strict=True)))
            draws.tables[name][rows] = arranged(values, have, (SAMPLE, *draws.dims[name]))
    count = len(rows) * draws.points
    draws.impossible += round(count * float(impossible.mean()))
    for bit, text in enumerate(meanings_of(solved.rules)):
        draws.validity_warnings[text] += round(count * float(((bits >> np.uint32(bit)) & 1).mean()))
