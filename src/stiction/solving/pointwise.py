"""Solve many contacts at once.

A contact that the model does not accept, or that cannot carry the load, gets NaN and a reason code.
"""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any, TypeVar

import numpy as np

from stiction.contact.subject import Subject
from stiction.engine.heights import Heights
from stiction.quantities.errors import InputError
from stiction.records.claims import Validity
from stiction.solving.choice import Choice
from stiction.solving.conditions import rules_of, rules_violated
from stiction.solving.inversion import Inversion
from stiction.solving.points import Points, Solved, points_of, solve_points
from stiction.solving.problem import lost_in_rounding, make_problem
from stiction.solving.results import summary_of, variables_of, with_shares

T = TypeVar("T")
# A part of many contacts, as a slice along each dimension.
Region = dict[str, slice]

# Reasons for a missing result, bits 0 to 2 of the validity warnings of a point.
REASONS = (
    "the contact is invalid: one of its numbers is out of bounds, or the model does not converge",
    "the contact cannot carry the load at any separation",
    "the load is below round-off: it is the small difference of large adhesive and compressive loads",
)
REFUSED, _NOT_CARRIED, _LOST = range(3)
# The last bit marks a point that has not been computed yet.
NOT_COMPUTED = np.uint32(1 << 31)


@dataclass(frozen=True)
class BatchResult:
    """Store the results of many contacts.

    variables: (dimensions, values in the units of the contact, attributes) by name. validity_warnings: dimensions, and an
    array of bits (uint32): first one bit for each reason in REASONS, then one for each range in `rules`. rules: validity
    ranges that results can violate. subject: the contacts in the form that the model uses. attributes: attributes as in
    `solve`; {} if only some results are requested.
    """

    variables: dict[str, tuple]
    validity_warnings: tuple[tuple[str, ...], np.ndarray]
    rules: list[Validity]
    subject: Subject
    attributes: dict[str, str]


def solve_batch(
    subject: Subject,
    choice: Choice,
    *,
    separation: Any = None,
    load: Any = None,
    keep: Collection[str] | None = None,
    heights: Heights | str | None = None,
    check_validity: bool = True,
) -> BatchResult:
    """Solve many contacts at separations or loads, without building a dataset.

    subject: the contacts. choice: model and laws. separation, load: exactly one of them, as in `solve`. keep: names of the
    requested results, None for all. check_validity: whether to compare the results with the validity ranges; otherwise `rules`
    is empty. Results are NaN where a load cannot be carried, and where the model does not accept a contact or does not
    converge. Raises InputError if the request is invalid or no contact is accepted, ArithmeticError if no contact converges.
    """
    points = points_of(make_problem(subject, choice, heights), load, separation)
    problem = points.problem
    solved, why_not = _solve(points)
    tables = with_shares(problem, solved.tables)
    refused = why_not == 1 << REFUSED
    variables = variables_of(points, solved, tables, keep, refused.all(axis=1))
    validity_warnings = why_not.astype(np.uint32)
    for bit, violated in enumerate(rules_violated(problem, tables) if check_validity else (), start=len(REASONS)):
        validity_warnings |= violated.astype(np.uint32) << np.uint32(bit)
    validity_warnings = np.where(refused, why_not, validity_warnings).reshape(points.wanted.shape)
    attributes = summary_of(problem.subject, problem, tables) if keep is None else {}
    rules = rules_of(problem) if check_validity else []
    return BatchResult(variables, (tuple(points.dims), validity_warnings), rules, problem.subject, attributes)


def meanings_of(rules: Sequence[Validity]) -> list[str]:
    """Return the meaning of each bit of `BatchResult.validity_warnings` as text, starting with bit 0."""
    return [*REASONS, *(f"{rule.quantity} is not {rule.range}: {rule.why}" for rule in rules)]


def _solve(points: Points) -> tuple[Solved, np.ndarray]:
    """Return the results at the points, and bits (contacts, points): bit i is set if REASONS[i] prevents a result."""
    try:
        return _solve_together(points)
    except (InputError, ArithmeticError):
        if len(points.problem.groups) == 1:
            raise
    return _solve_in_parts(points)


def _solve_in_parts(points: Points) -> tuple[Solved, np.ndarray]:
    """Solve contacts in parts, so that contacts that the model does not accept get NaN and all others get results.

    Returns the results and the reason bits (contacts, points), see REASONS. Raises the last error if no contact is
    accepted.
    """
    shape, every = points.table.shape, np.arange(len(points.problem.groups))
    tables: dict[str, np.ndarray] = {}
    inversion, refusal, why_not = None, None, np.full(shape, 1 << REFUSED, dtype=np.uint32)
    for region, part in bisected(
        {"contact": slice(0, len(every))}, lambda some: _solve_together(points.rows(every[some["contact"]]))
    ):
        rows = every[region["contact"]]
        if isinstance(part, Exception):
            refusal = part
            continue
        solved, why_not[rows] = part
        for name, table in solved.tables.items():
            tables.setdefault(name, np.full(shape, np.nan))[rows] = table
        if solved.found is not None:
            h, residual, tension, where = (np.full(size, np.nan) for size in (shape, shape, shape[:1], shape[:1]))
            inversion = (inversion or Inversion(h, residual, tension, where)).with_rows(rows, solved.found)
    if refusal is not None and not tables:
        raise refusal
    return Solved({name: table.reshape(points.wanted.shape) for name, table in tables.items()}, inversion), why_not


def bisected(region: Region, solve: Callable[[Region], T]) -> Iterator[tuple[Region, T | Exception]]:
    """Solve a region of contacts in parts that are as large as possible, and yield (part, result) for each part.

    A part for which `solve` raises InputError or ArithmeticError is bisected along its longest dimension. A single contact that
    raises an error yields this error as its result.
    """
    waiting = [region]
    while waiting:
        part = waiting.pop()
        try:
            result: T | Exception = solve(part)
        except (InputError, ArithmeticError) as error:
            halves = _halves(part)
            waiting += halves
            if halves:
                continue
            result = error
        yield part, result


def tiles(sizes: Mapping[str, int], room: int) -> dict[str, int]:
    """Return the length of a tile along each dimension, chosen so that a tile holds at most `room` contacts.

    sizes: lengths of the dimensions. Tiles extend along the last dimensions first.
    """
    lengths: dict[str, int] = {}
    for dim in reversed(list(sizes)):
        lengths[dim] = max(1, min(sizes[dim], room))
        room //= lengths[dim]
    return {dim: lengths[dim] for dim in sizes}


def pieces(region: Region, room: int) -> Iterator[Region]:
    """Divide a region into parts of at most `room` contacts each, and yield the parts."""
    steps = tiles({dim: some.stop - some.start for dim, some in region.items()}, room)
    starts = (range(some.start, some.stop, steps[dim]) for dim, some in region.items())
    for corner in product(*starts):
        yield {dim: slice(start, min(start + steps[dim], region[dim].stop)) for dim, start in zip(region, corner, strict=True)}


def _halves(region: Region) -> list[Region]:
    """Return the two halves of a region along its longest dimension, the second half first; [] for a single contact."""
    dim = max(region, key=lambda name: region[name].stop - region[name].start, default="")
    if not dim or region[dim].stop - region[dim].start == 1:
        return []
    middle = (region[dim].start + region[dim].stop) // 2
    return [region | {dim: slice(middle, region[dim].stop)}, region | {dim: slice(region[dim].start, middle)}]


def _solve_together(points: Points) -> tuple[Solved, np.ndarray]:
    """Return the results at the points, NaN where a load cannot be carried, and the bits of REASONS (contacts, points).

    For a model that computes no separations, tensile loads are treated as loads that cannot be carried.
    """
    lost = rounded = np.zeros(points.wanted.shape, dtype=bool)
    if points.problem.needs_load:
        lost = points.wanted < 0.0
        solved = solve_points(replace(points, wanted=np.where(lost, 0.0, points.wanted)))
    else:
        solved = solve_points(points, refuse=False)
    if solved.found is not None and solved.carried is not None:
        lost = np.isnan(solved.tables["mean_separation"])
        rounded = lost_in_rounding(solved.carried, points.wanted) & ~lost
    why_not = (lost.astype(np.uint32) << _NOT_CARRIED) | (rounded.astype(np.uint32) << _LOST)
    return replace(solved, tables=_without(solved.tables, lost)), why_not.reshape(points.table.shape)


def _without(tables: Mapping[str, np.ndarray], lost: np.ndarray) -> dict[str, np.ndarray]:
    """Return the result tables with NaN where the mask `lost` is True; the requested load is kept."""
    if not lost.any():
        return dict(tables)
    return {name: np.where(lost, np.nan, table) if name != "load" else table for name, table in tables.items()}
