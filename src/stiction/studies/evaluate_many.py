"""Evaluate one case at many sets of numbers at once, some of which may be refused.

Every study of many contacts (uncertainty, sensitivity, sweep, fit, design) asks here. What it varies are labelled arrays in the
places of numbers of the case, so that contacts are the combinations of their dimensions.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from stiction.case.read import Case
from stiction.case.several import Address
from stiction.quantities.dimensions import dimensions
from stiction.solving.choice import Choice
from stiction.solving.pointwise import BatchResult, Region, bisected, solve_batch

Numbers = Mapping[Address, Any]


def evaluate_together(
    case: Case,
    numbers: Numbers,
    points: Mapping[str, Any] | None,
    model: Choice,
    keep: Sequence[str] | None = None,
) -> tuple[Case, BatchResult]:
    """Evaluate a case at these numbers, which must all make a contact.

    Parameters
    ----------
    case : the case, with its nominal numbers.
    numbers : address, ("contact", "first", "hardness") -> float or labelled array, in SI units.
    points : {"load": ...} or {"separation": ...}; by default those of the case.
    model : the model with its laws and options.
    keep : names of results, by default all.

    Returns
    -------
    The case with these numbers, and its results: NaN where there are none, with the reason as bits. Warnings and floating-point
    errors are not raised: they are among the bits of the results.

    Raises
    ------
    InputError, ArithmeticError
        Where a number is out of bounds, or the model refuses all contacts.
    """
    with np.errstate(all="ignore"):
        case = case.at(numbers)
        points = {"separation": case.separation, "load": case.load} if points is None else points
        return case, solve_batch(case.subject, model, **points, keep=keep)


def evaluate_many(
    case: Case,
    numbers: Numbers,
    points: Mapping[str, Any] | None,
    model: Choice,
    keep: Sequence[str] | None = None,
    *,
    along: Sequence[str],
) -> Iterator[tuple[Region, Case | None, BatchResult | None]]:
    """Yield (region, case, results) in batches; arguments as of `evaluate_together`.

    A region maps each dimension of `along` that the numbers or points have to a slice. A batch that raises is bisected along
    the longest of these dimensions; a single refused contact yields None, None.
    """
    varied = [*numbers.values(), *(points or {}).values()]
    sizes = {dim: size for dim, size in dimensions(varied).items() if dim in along}

    def evaluated(region: Region) -> tuple[Case, BatchResult]:
        part = {dim: some for dim, some in region.items() if some != slice(0, sizes[dim])}
        some = None if points is None else {name: part_of(value, part) for name, value in points.items()}
        return evaluate_together(case, {path: part_of(value, part) for path, value in numbers.items()}, some, model, keep)

    for region, found in bisected({dim: slice(0, size) for dim, size in sizes.items()}, evaluated):
        yield (region, None, None) if isinstance(found, Exception) else (region, *found)


def part_of(value: Any, region: Region) -> Any:
    """Return the part of a labelled array in a region; anything else as it is."""
    mine = {dim: some for dim, some in region.items() if dim in getattr(value, "dims", ())}
    return value.isel(mine) if mine else value
