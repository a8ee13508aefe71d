"""Solve one block of contacts of a sweep, and compute and merge statistics of blocks.

A block is a part of the contacts whose results are stored at once.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from stiction.quantities.dimensions import arranged
from stiction.quantities.errors import InputError
from stiction.quantities.quotient import quotient
from stiction.solving.choice import RECOMMENDED, Choice
from stiction.solving.pointwise import BatchResult, Region
from stiction.studies.evaluate_many import evaluate_many
from stiction.studies.prediction.many import count_of, predict_many
from stiction.studies.sweep.maps import PLACE
from stiction.studies.sweep.plan import Plan
from stiction.studies.sweep.table import MOMENTS


def solve_block(
    plan: Plan, choice: Choice, block: int, dims: Mapping[str, tuple[str, ...]], sizes: Mapping[str, int]
) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Solve the contacts of one block of a sweep; return results by name, and validity warnings as an array of bits.

    choice: the model. block: number of the block, a part of the contacts that is stored at once. dims: dimensions of each
    result to store, by name. sizes: number of loads or separations, by dimension. A result has the dimensions in `dims`; the
    warnings have all dimensions of the contacts and `sizes`. The results of a contact that the model refuses are NaN, and the
    reason is among its bits.
    """
    shape = {dim: some.stop - some.start for dim, some in plan.region(block).items()} | dict(sizes)
    results = {name: np.full([shape[dim] for dim in of], np.nan) for name, of in dims.items()}
    validity_warnings = np.full(tuple(shape.values()), 1, dtype=np.uint32)
    for place, solved in _solved(plan, choice, block, list(dims)):
        for name, of in dims.items():
            if name in solved.variables:
                have, values, _ = solved.variables[name]
                results[name][tuple(place.get(dim, slice(None)) for dim in of)] = arranged(values, have, of)
        have, bits = solved.validity_warnings
        validity_warnings[tuple(place.get(dim, slice(None)) for dim in shape)] = arranged(bits, have, shape)
    return results, validity_warnings


def _solved(plan: Plan, choice: Choice, block: int, keep: list[str]) -> Iterator[tuple[Region, BatchResult]]:
    """Yield (region, results) for the contacts of a block, without those that cannot be solved.

    region: slices within the block, by dimension. keep: names of the results.
    """
    first = plan.region(block)
    for piece in plan.pieces(block):
        starts = {dim: some.start - first[dim].start for dim, some in piece.items()}
        for region, solved in solved_of(plan, choice, piece, keep):
            if solved is not None:
                moved = {dim: (some, starts.get(dim, 0)) for dim, some in region.items()}
                yield {dim: slice(some.start + start, some.stop + start) for dim, (some, start) in moved.items()}, solved


def solved_of(plan: Plan, choice: Choice, piece: Region, keep: list[str] | None) -> Iterator[tuple[Region, BatchResult | None]]:
    """Yield (region, results) for all parts of `piece`, a region of the sweep; results are None for refused contacts.

    region: slices within the piece, by dimension. The results come from the model in `choice`, or from the prediction if it is
    "recommended". keep: names of the results, None for all; a prediction ignores it.
    """
    try:
        case, arrays = plan.case_at(piece), plan.arrays(piece)
    except InputError:  # a map cannot be read, or has no asperities
        yield piece, None
        return
    if choice.model == RECOMMENDED:
        found = predict_many(case, arrays, plan.load, plan.uncertain, count=count_of(plan.case, plan.size), refuse=False)
    else:
        found = evaluate_many(case, arrays, None, choice, keep, along=tuple(piece))
    yield from ((region, _along_places(solved) if plan.maps and solved else solved) for region, _, solved in found)


def _along_places(solved: BatchResult) -> BatchResult:
    """Return the results of one contact with a leading dimension `place` of length 1.

    A sweep over maps joins the results of its maps along this dimension.
    """
    variables = {
        name: ((PLACE, *dims), np.asarray(values)[None], *rest) for name, (dims, values, *rest) in solved.variables.items()
    }
    dims, bits = solved.validity_warnings
    return replace(solved, variables=variables, validity_warnings=((PLACE, *dims), np.asarray(bits)[None]))


def statistics_of(values: np.ndarray, contacts: int) -> np.ndarray:
    """Return statistics of the finite values over all contacts, at each load or separation, (5, points).

    The rows are count, mean, sum of squared deviations, minimum and maximum; without finite values 0, 0, 0, inf and -inf.
    values: array over contacts and points (loads or separations). contacts: how many of its leading dimensions run over
    contacts.
    """
    rows = values.reshape(math.prod(values.shape[:contacts]), -1)
    there = np.isfinite(rows)
    count = there.sum(axis=0)
    safe = np.where(there, rows, 0.0)
    mean = quotient(safe.sum(axis=0), count, 0.0)
    squares = (np.where(there, rows - mean, 0.0) ** 2).sum(axis=0)
    least, most = (end(np.where(there, rows, fill), axis=0) for end, fill in ((np.min, np.inf), (np.max, -np.inf)))
    return np.array([count, mean, squares, least, most])


def merged(parts: Iterable[np.ndarray]) -> dict[str, np.ndarray]:
    """Merge the statistics of blocks into count, mean, standard deviation, minimum and maximum, (points,) by name.

    parts: arrays (5, points) as `statistics_of` returns them, at least one. The names are those of MOMENTS. The standard
    deviation divides by n - 1 and is NaN for fewer than two values; without values, all but the count are NaN. Source: Chan,
    Golub & LeVeque 1983, eqs 2.1.
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
