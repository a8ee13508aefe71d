"""One block of a sweep: its contacts solved, those that are refused left out, and what is stored of them."""

import math
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from stiction.laws.claims import Validity
from stiction.quantities.errors import InputDoubt, InputError
from stiction.solving.choice import Choice
from stiction.solving.pointwise import Pointwise, solve_pointwise
from stiction.studies.sweep.plan import Plan
from stiction.studies.sweep.table import MOMENTS

__all__ = ["Block", "merged", "solve_block", "solve_region", "statistics_of"]


@dataclass(frozen=True)
class Block:
    """Results of a region of the contacts: name -> array (dimensions of the contacts and the points), and doubts as bits."""

    results: dict[str, np.ndarray]
    doubts: np.ndarray


def solve_region(plan: Plan, choice: Choice, region: Mapping[str, slice], keep: Sequence[str] | None = None) -> Pointwise:
    """Results of the contacts of a region. Raises InputError where they are refused, ArithmeticError where the model does not
    converge."""
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore", InputDoubt)  # each of these is among the doubts of its points
        case = plan.case(region)
        return solve_pointwise(case.subject, choice, separation=case.separation, load=case.load, keep=keep)


def solve_block(plan: Plan, choice: Choice, block: int, dims: Mapping[str, tuple[str, ...]], sizes: Mapping[str, int]) -> Block:
    """A block. dims: name -> dimensions of each result that is kept; sizes: of the dimensions of the points.

    Contacts that are refused are not numbers, with that as their doubt; all that are not are solved together, as far as halving
    the region parts them.
    """
    region = plan.region(block)
    shape = {dim: some.stop - some.start for dim, some in region.items()} | dict(sizes)
    results = {name: np.full([shape[dim] for dim in of], np.nan) for name, of in dims.items()}
    doubts = np.full(tuple(shape.values()), 1, dtype=np.uint32)
    for part in _solvable(plan, choice, region, list(dims)):
        within, solved = part
        place = {dim: slice(some.start - region[dim].start, some.stop - region[dim].start) for dim, some in within.items()}
        for name, of in dims.items():
            if name in solved.variables:
                have, values, _ = solved.variables[name]
                results[name][tuple(place.get(dim, slice(None)) for dim in of)] = _ordered(values, have, of)
        have, bits = solved.doubts
        doubts[tuple(place.get(dim, slice(None)) for dim in shape)] = _ordered(bits, have, tuple(shape))
    return Block(results, doubts)


def _ordered(values: np.ndarray, have: Sequence[str], wanted: Sequence[str]) -> np.ndarray:
    return values.transpose([list(have).index(dim) for dim in wanted])


def _solvable(plan: Plan, choice: Choice, region: dict[str, slice], keep: list[str]):
    """Regions that can be solved, with their results."""
    waiting = plan.pieces(region)[::-1]
    while waiting:
        one = waiting.pop()
        try:
            yield one, solve_region(plan, choice, one, keep)
        except (InputError, ArithmeticError):
            waiting += _halves(one)


def _halves(region: dict[str, slice]) -> list[dict[str, slice]]:
    """The two halves along the longest dimension; none of a single contact."""
    dim = max(region, key=lambda name: region[name].stop - region[name].start)
    start, stop = region[dim].start, region[dim].stop
    if stop - start == 1:
        return []
    middle = (start + stop) // 2
    return [region | {dim: slice(middle, stop)}, region | {dim: slice(start, middle)}]


def statistics_of(values: np.ndarray, contacts: int) -> np.ndarray:
    """Of values whose first so many dimensions are contacts: number, mean, sum of squared deviations, least and most of those
    that are numbers, (5, points)."""
    rows = values.reshape(math.prod(values.shape[:contacts]), -1)
    there = np.isfinite(rows)
    count = there.sum(axis=0)
    safe = np.where(there, rows, 0.0)
    mean = np.divide(safe.sum(axis=0), count, where=count > 0, out=np.zeros(len(count)))
    squares = (np.where(there, rows - mean, 0.0) ** 2).sum(axis=0)
    least, most = (end(np.where(there, rows, fill), axis=0) for end, fill in ((np.min, np.inf), (np.max, -np.inf)))
    return np.array([count, mean, squares, least, most])


def merged(parts: Iterable[np.ndarray]) -> dict[str, np.ndarray]:
    """The statistics (points,) of all parts, each as `statistics_of` gives, one after another.

    Source: Chan, Golub & LeVeque 1983, eqs 2.1: sums of squared deviations of two samples together. The standard deviation
    is over n - 1.
    """
    waiting = iter(parts)
    count, mean, squares, least, most = (row.copy() for row in next(waiting))
    for part in waiting:
        both = count + part[0]
        safe = np.where(both > 0.0, both, 1.0)
        step = part[1] - mean
        squares += part[2] + step**2 * count * part[0] / safe
        mean += step * part[0] / safe
        count, least, most = both, np.minimum(least, part[3]), np.maximum(most, part[4])
    none, few = count == 0.0, count < 2.0
    spread = np.sqrt(squares / np.where(few, 1.0, count - 1.0))
    rows = (
        count,
        np.where(none, np.nan, mean),
        np.where(few, np.nan, spread),
        *(np.where(none, np.nan, end) for end in (least, most)),
    )
    return dict(zip(MOMENTS, rows, strict=True))


def rules_as_data(rules: Sequence[Validity]) -> list[dict[str, Any]]:
    """The rules, for programs."""
    return [
        {"quantity": rule.quantity, "low": rule.low, "high": rule.high, "why": rule.why, "kind": rule.kind} for rule in rules
    ]
