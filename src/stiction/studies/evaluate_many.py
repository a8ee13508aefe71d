"""Evaluate one model for many variants of a case; the model may refuse some of them.

All studies of many contacts (uncertainty, sensitivity, sweep, fit, design) use it. The numbers that vary are labelled arrays
(xarray.DataArray), given by their addresses in the case. The contacts are all combinations along the dimensions of these
arrays.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from stiction.case.read import Case
from stiction.case.swept import Address
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
    check_validity: bool = True,
) -> tuple[Case, BatchResult]:
    """Evaluate one model for all variants of a case at once; raise an error if a variant is not a valid contact.

    Parameters
    ----------
    case : Case
        The case with its nominal numbers.
    numbers : dict
        Numbers that replace those of the case, by address, e.g. ("contact", "first", "hardness"): each a number or an
        xarray.DataArray in SI units.
    points : dict, optional
        {"load": ...} [N] or {"separation": ...} [m]; by default the points of the case.
    model : Choice
        The model with its laws and options.
    keep : sequence of str, optional
        Names of the results to return, by default all.
    check_validity : bool, optional
        Whether to check validity ranges and set the bits of those that the results exceed. Without the check, a small batch
        takes two thirds of the time.

    Returns
    -------
    tuple
        The case with these numbers, and its BatchResult. A result is NaN where the model gives none; the bits in
        `validity_warnings` give the reason. Warnings and floating-point errors are not raised, but set bits too.

    Raises
    ------
    InputError, ArithmeticError
        A number is out of bounds, or the model refuses all contacts.
    """
    with np.errstate(all="ignore"):
        case = case.at(numbers)
        points = case.requested_points if points is None else points
        return case, solve_batch(case.subject, model, **points, keep=keep, check_validity=check_validity)


def evaluate_many(
    case: Case,
    numbers: Numbers,
    points: Mapping[str, Any] | None,
    model: Choice,
    keep: Sequence[str] | None = None,
    *,
    along: Sequence[str],
    check_validity: bool = True,
) -> Iterator[tuple[Region, Case | None, BatchResult | None]]:
    """Evaluate one model for all variants of a case, and yield (region, case, results) in batches.

    The other arguments, and the case and results of a batch, are as in `evaluate_together`. along: dimensions along which
    batches may be split. region: slice of each of these dimensions that the batch covers. A batch that raises InputError or
    ArithmeticError is bisected along its longest dimension. For a single refused contact, case and results are None.
    """
    varied = [*numbers.values(), *(points or {}).values()]
    sizes = {dim: size for dim, size in dimensions(varied).items() if dim in along}

    def evaluated(region: Region) -> tuple[Case, BatchResult]:
        part = {dim: some for dim, some in region.items() if some != slice(0, sizes[dim])}
        some = None if points is None else {name: part_of(value, part) for name, value in points.items()}
        some_numbers = {path: part_of(value, part) for path, value in numbers.items()}
        return evaluate_together(case, some_numbers, some, model, keep, check_validity)

    for region, outcome in bisected({dim: slice(0, size) for dim, size in sizes.items()}, evaluated):
        yield (region, None, None) if isinstance(outcome, Exception) else (region, *outcome)


def part_of(value: Any, region: Region) -> Any:
    """Return the part of an xarray.DataArray inside a region; return any other value unchanged.

    region: slice by dimension; dimensions that the array does not have are ignored.
    """
    mine = {dim: some for dim, some in region.items() if dim in getattr(value, "dims", ())}
    return value.isel(mine) if mine else value
