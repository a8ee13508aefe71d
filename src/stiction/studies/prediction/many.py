"""Predict many contacts at once, with the same quantile levels for all contacts."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.case.read import Case
from stiction.case.uncertain import SAMPLE, Uncertain
from stiction.contact.contact import Contact
from stiction.quantities.dimensions import arranged, coordinates, dimensions
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.shown import show
from stiction.solving.choice import RECOMMENDED
from stiction.solving.pointwise import REFUSED, BatchResult, Region, bisected, pieces
from stiction.studies.evaluate_many import part_of
from stiction.studies.prediction.mixture import Mixture
from stiction.studies.prediction.predict import COUNT, draws_of, intervals, stated_count, with_uncertain
from stiction.studies.prediction.sampled_case import SampledCase
from stiction.studies.prediction.sources import sources_of
from stiction.studies.prediction.unused import refusal_of

if TYPE_CHECKING:
    import xarray

# Names of the predicted results: medians, and ends of the interval.
PREDICTED = tuple(
    f"{name}{end}" for name in ("friction_coefficient", "friction_force", "contact_area") for end in ("", "_low", "_high")
)
_CONTACTS = "contacts along sample"  # replaces a dimension SAMPLE of the contacts, because a prediction uses this name itself
_AT_ONCE = 128  # points of a batch, which bounds the memory; errors on benchmark surfaces are computed for as many at once


def count_of(case: Case, points: int) -> int:
    """Return the number of samples per prediction: that of the case or, if it states none, 512 if points <= 128, else 256."""
    return stated_count(case, COUNT if points <= _AT_ONCE else COUNT // 2)


def predict_many(
    case: Case,
    numbers: Mapping[tuple[str, ...], Any],
    load: Any,
    uncertain: Sequence[Uncertain] = (),
    *,
    level: float = 0.9,
    count: int = COUNT,
    along: Sequence[str] | None = None,
    refuse: bool = True,
) -> Iterator[tuple[Region, Case | None, BatchResult | None]]:
    """Predict many variants of a case, and yield (region, case, results) in batches, as `evaluate_many` does.

    Parameters
    ----------
    case : Case
        The case with its nominal numbers; its own uncertain numbers are not sampled.
    numbers : dict
        Number or labelled array (xarray) in SI units by address, e.g. ("contact", "first", "hardness"). The contacts are all
        combinations along the dimensions of these arrays.
    load : numpy.ndarray or xarray.DataArray
        Loads [N] for every contact, or a labelled array along dimensions of the contacts.
    uncertain : sequence of Uncertain
        Uncertain numbers to sample. Ranges of materials are sampled too, unless the case states the key `ranges`.
    level : float
        Coverage probability of the intervals.
    count : int
        Number of samples for every contact, if the case states none.
    along : sequence of str, optional
        Dimensions along which batches may be split; by default all, including the loads.
    refuse : bool
        If all contacts are refused: whether the iterator raises the InputError or ArithmeticError of the last one at its end.

    Returns
    -------
    iterator
        Of region, case and results. The results are friction_coefficient, friction_force [N] and contact_area [m2], each also
        with _low and _high, and friction_efficiency if a sample has one below 1. A region maps dimensions to slices. A batch
        that raises an error is bisected; for one that cannot be divided, case and results are None.
    """
    from xarray import DataArray

    if not hasattr(load, "dims"):
        load = DataArray(np.atleast_1d(load), dims=("load",))
    numbers, load = {path: _apart(value) for path, value in numbers.items()}, _apart(load)

    def predicted(region: Region) -> tuple[Case, BatchResult]:
        some = {path: part_of(value, region) for path, value in numbers.items()}
        return _together(case, some, part_of(load, region), tuple(uncertain), level, count)

    refusal, taken = None, False
    sizes = dimensions([*numbers.values(), load])
    ranges = {dim: slice(0, size) for dim, size in sizes.items() if along is None or _named(dim) in along}
    for piece in pieces(ranges, _AT_ONCE):
        for region, outcome in bisected(piece, predicted):
            region = {_named(dim): some for dim, some in region.items()}
            if isinstance(outcome, Exception):
                refusal = outcome
                yield region, None, None
            else:
                taken = True
                yield region, outcome[0], _named_back(outcome[1])
    if refuse and refusal is not None and not taken:
        raise refusal


def _apart(value: Any) -> Any:
    """Return a labelled array (xarray) with its dimension `sample` renamed, because the samples of a prediction need that name.

    Other values are returned unchanged.
    """
    return value.rename({SAMPLE: _CONTACTS}) if SAMPLE in getattr(value, "dims", ()) else value


def _named(dim: str) -> str:
    return SAMPLE if dim == _CONTACTS else dim


def _named_back(result: BatchResult) -> BatchResult:
    """Return the results with the name `sample` restored for the dimension that `_apart` renamed."""
    variables = {name: (tuple(map(_named, dims)), *rest) for name, (dims, *rest) in result.variables.items()}
    return replace(
        result,
        variables=variables,
        validity_warnings=(tuple(map(_named, result.validity_warnings[0])), result.validity_warnings[1]),
    )


def _together(
    case: Case, numbers: Mapping, load: Any, uncertain: tuple[Uncertain, ...], level: float, count: int
) -> tuple[Case, BatchResult]:
    """Return the case with these numbers, and its predictions for all contacts at once.

    numbers: number or labelled array (xarray) by address (tuple of keys). load: labelled array [N]. uncertain: numbers to
    sample. level: coverage probability of the intervals. count: number of samples if the case states none. A point with a load
    above hardness times nominal area is NaN and has the bit REFUSED. Raises InputError or ArithmeticError if all points have
    such loads, or if a contact is refused for another reason.
    """
    with np.errstate(all="ignore"):
        numbers = _one_finish(case, numbers)
        case = case.at(numbers)
        if not isinstance(case.subject, Contact):
            raise InputError("indices", InWords("given"), "[contact] instead, because a prediction needs materials and lengths")
        if (refusal := refusal_of(case)) is not None:
            raise refusal
        swept = {path: value for path, value in numbers.items() if hasattr(value, "dims")}
        case = with_uncertain(replace(case, swept=swept, uncertain=uncertain))
        loads = load.values if load.dims == ("load",) else load
        levels = draws_of(case, count)
        sampled = SampledCase(case, loads, levels.inputs)
        if not (sampled.loads > 0.0).all():
            raise InputError(
                "load",
                InWords(show(sampled.loads.min(), "load")),
                "> 0 N, because mu is the friction force divided by the load",
            )
        mixture = Mixture.of(sampled)
        samples = mixture.samples(levels, np.arange(len(levels)))
        tables = intervals(samples, sampled.loads, level)
    shape, dims = tuple(sampled.dims.values()), tuple(sampled.dims)
    variables = {name: (dims, values.reshape(shape), attributes) for name, (values, attributes) in tables.items()}
    refused = np.isnan(tables["friction_coefficient"][0]).reshape(shape)
    return case, BatchResult(
        variables, (dims, refused.astype(np.uint32) << np.uint32(REFUSED)), [], case.subject, {"sources": sources_of(mixture)}
    )


def _one_finish(case: Case, numbers: Mapping) -> dict[tuple[str, ...], Any]:
    """Replace roughness arrays of length one by floats if the surface has a finish; return the numbers.

    numbers: number or labelled array (xarray) by address (tuple of keys). `with_finish` raises InputError for longer arrays;
    `predict_many` then bisects the batch until each part has a single value.
    """
    finished = isinstance(case.subject, Contact) and case.subject.roughness.unknowns
    rows = dict(numbers)
    for path, value in numbers.items():
        if finished and path[:2] == ("contact", "roughness") and getattr(value, "size", 0) == 1:
            rows[path] = value.item()
    return rows


def predict_swept(case: Case, level: float = 0.9) -> "xarray.Dataset":
    """Return the predictions of a case with array parameters, over the dimensions of these arrays and of the loads.

    level: coverage probability of the intervals. Variables are named as in `predict`. Refused points, each a contact at a load,
    are NaN, also at loads that are not above 0. The attribute `refused` is their number; `why_refused`, the reason for the
    first of them, is present if there is any. The attribute `draws` is the number of samples per contact, `sources` lists
    bibliography keys. Raises InputError if the case has separations instead of loads, and InputError or ArithmeticError if all
    points are refused.
    """
    import xarray

    if case.load is None:
        raise InputError("solve.separation", InWords("given"), "a load; for separations, name a model as solve.model")
    sizes = dimensions([*case.swept.values(), xarray.DataArray(case.load, dims=("load",))])
    count = count_of(case, math.prod(sizes.values()))
    contacts = math.prod(size for dim, size in sizes.items() if dim != "load")
    pressing = np.flatnonzero(case.load > 0.0)
    if not pressing.size:
        raise InputError(
            "load", InWords(show(case.load.max(), "load")), "> 0 N, because mu is the friction force divided by the load"
        )
    loads = xarray.DataArray(case.load[pressing], dims=("load",))
    tables: dict[str, tuple] = {}
    sources: dict[str, None] = {}
    refused = contacts * (case.load.size - pressing.size)
    for region, _, solved in predict_many(case, case.swept, loads, case.uncertain, level=level, count=count):
        if solved is None:
            refused += 1
            continue
        refused += int(np.count_nonzero(solved.validity_warnings[1]))
        sources |= dict.fromkeys(solved.attributes["sources"].split())
        for name, (dims, values, attributes) in solved.variables.items():
            table = tables.setdefault(name, (tuple(sizes), np.full(tuple(sizes.values()), np.nan), attributes))[1]
            places: dict[str, Any] = {**region, "load": pressing[region["load"]]}
            table[np.ix_(*(np.arange(size)[places[dim]] for dim, size in sizes.items()))] = arranged(values, dims, sizes)
    coords = coordinates(case.subject.arrays())
    coords["load"] = xarray.Variable("load", case.load, {"units": "N", "long_name": "load"})
    attributes = {"level": level, "draws": count, "refused": refused, "model": RECOMMENDED, "sources": " ".join(sources)}
    if refused:
        missing = np.argwhere(np.isnan(tables["friction_coefficient"][1]))[0]
        attributes["why_refused"] = _why_refused(case, {dim: slice(at, at + 1) for dim, at in zip(sizes, missing, strict=True)})
    return xarray.Dataset(tables, coords=coords, attrs=attributes | ({"case": case.title} if case.title else {}))


def _why_refused(case: Case, place: Region) -> str:
    """Return the reason why one contact of a parameter sweep is refused at one load; "" if it is not refused alone.

    place: slice of length 1 along each dimension, also `load`.
    """
    import xarray

    loads = xarray.DataArray(case.load, dims=("load",))
    numbers = {path: part_of(value, place) for path, value in case.swept.items()}
    try:
        _together(case, numbers, part_of(loads, place), tuple(case.uncertain), 0.9, COUNT)
    except (InputError, ArithmeticError) as error:
        return str(error)
    return ""
