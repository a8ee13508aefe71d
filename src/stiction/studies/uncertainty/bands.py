"""Compute prediction intervals of one model over uncertain inputs, with their sampling errors."""

import json
from typing import TYPE_CHECKING

import numpy as np

from stiction.case.read import Case
from stiction.laws.validity import with_warnings
from stiction.quantities.progress import Steps
from stiction.records.validity_warning import ValidityWarning
from stiction.solving.choice import Choice
from stiction.solving.pointwise import REASONS
from stiction.studies.uncertainty.drawing import (
    OUTPUTS,
    Draws,
    Variant,
    draw,
    scrambled,
    solves_maps,
)

if TYPE_CHECKING:
    import xarray

# Number of independently scrambled Sobol sequences; the scatter between them gives the sampling error.
_PARTS = 8
_LEAST_KNOWN = 0.5  # fraction of the samples with a result below which no quantile is given
_MANY = 0.05  # fraction of impossible samples above which a warning is issued


def levels(coverage: float) -> np.ndarray:
    """Return the quantile levels of results (5 or fewer): the ends of the prediction interval, the quartiles and the median.

    coverage: coverage probability of the interval.
    """
    return np.array(sorted({(1.0 - coverage) / 2.0, 0.25, 0.5, 0.75, (1.0 + coverage) / 2.0}))


def quantiles(values: np.ndarray, levels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return quantiles (L, ...) of values (parts, n, ...), and their standard errors of the same shape.

    levels (L,): quantile levels. The first axis of `values` is over independently scrambled Sobol sequences (Owen 1997);
    the scatter between them gives the standard error. A quantile is NaN if less than half of the values are finite; its error
    is NaN if this holds for any part.
    """
    parts, count = values.shape[:2]
    overall = _quantile(values.reshape(parts * count, *values.shape[2:]), levels)
    by_part = np.array([_quantile(part, levels) for part in values])
    return overall, by_part.std(axis=0, ddof=1) / np.sqrt(parts)


def _quantile(values: np.ndarray, levels: np.ndarray) -> np.ndarray:
    known = np.isfinite(values)
    if known.all():
        return np.quantile(values, levels, axis=0)
    enough = known.mean(axis=0) >= _LEAST_KNOWN
    safe = np.where(known & enough, values, np.where(enough, np.nan, 0.0))
    return np.where(enough, np.nanquantile(safe, levels, axis=0), np.nan)


def with_bands(data: "xarray.Dataset", case: Case, choice: Choice, progress: Steps = iter) -> "xarray.Dataset":
    """Return the results of a case with quantiles over its uncertain numbers added.

    data: results of the nominal contact. choice: the model. For each result of OUTPUTS in `data`, the function adds
    NAME_quantile (quantile, ...) and NAME_quantile_error, its standard error due to sampling. Without uncertain numbers the
    results are returned unchanged. For a model that solves height maps, only a warning is added. Raises InputError if there are
    too many samples.
    """
    if not case.uncertain:
        return data
    if solves_maps(choice):
        why = f"no interval is given: {choice.model_key} would have to solve the map for each sample"
        return with_warnings(data, [ValidityWarning(why)])
    wanted = case.uncertainty
    names = [name for name in OUTPUTS if name in data.data_vars]
    samples = scrambled(len(case.unknowns), wanted.count, wanted.seed, _PARTS)
    draws = draw(case, samples.reshape(wanted.count, -1), [Variant(choice)], names=names, progress=progress)
    variables: dict[str, tuple] = {}
    for name in draws.tables:
        variables |= _as_variables(name, draws, levels(wanted.coverage))
    data = data.assign_coords(quantile=("quantile", levels(wanted.coverage), {"long_name": "quantile level"}))
    return _with_stated_values_beyond(_with_notes(data.assign(variables), case, draws))


def _with_stated_values_beyond(data: "xarray.Dataset") -> "xarray.Dataset":
    """Return the dataset, with a warning if mu of the nominal contact is outside the interval of mu by more than 1 %.

    This happens if mu has a maximum or minimum at the nominal values: mu of all samples is then smaller, or larger, than the
    nominal mu.
    """
    if "friction_coefficient_quantile" not in data:
        return data
    mu, ends = data["friction_coefficient"], data["friction_coefficient_quantile"]
    if not ((1.01 * mu < ends.isel(quantile=0)) | (0.99 * mu > ends.isel(quantile=-1))).any():
        return data
    why = "mu at the stated values lies outside its interval: it is nearly the largest or the smallest mu of all samples"
    return with_warnings(data, [ValidityWarning(why)])


def _as_variables(name: str, draws: Draws, levels: np.ndarray) -> dict[str, tuple]:
    table = draws.tables[name]
    values, errors = quantiles(table.reshape(_PARTS, len(table) // _PARTS, *table.shape[1:]), levels)
    dims, meaning = ("quantile", *draws.dims[name]), dict(draws.attributes[name])
    long_name = meaning.pop("comment", meaning["long_name"])
    return {
        f"{name}_quantile": (dims, values, meaning | {"long_name": f"{long_name}, quantiles over the uncertain inputs"}),
        f"{name}_quantile_error": (dims, errors, meaning | {"long_name": f"{long_name}, standard error of its quantiles"}),
    }


def _with_notes(data: "xarray.Dataset", case: Case, draws: Draws) -> "xarray.Dataset":
    """Return the dataset with attributes on the uncertain inputs, and with warnings of missing or impossible samples.

    A warning of impossible samples is added if they are more than 5 % of all points (samples at a load or separation).
    """
    lost = sum(draws.shares().get(why, 0.0) for why in REASONS[:2])
    impossible = draws.impossible_share
    if lost:
        why = f"{lost:.0%} of the samples have no result: intervals are computed from the others"
        data = with_warnings(data, [ValidityWarning(why)])
    if impossible > _MANY:
        why = f"{impossible:.0%} of the samples exceed nominal area or hardness and are excluded"
        left = "no interval is given" if impossible > 1.0 - _LEAST_KNOWN else "the interval of mu is computed from the others"
        data = with_warnings(data, [ValidityWarning(f"{why}: {left}")])
    return data.assign_attrs(
        sampling_attributes(case),
        validity_warnings_of_points=warning_shares(draws),
        impossible_draws=impossible,
        coverage=case.uncertainty.coverage,
    )


def sampling_attributes(case: Case) -> dict[str, str]:
    """Return two attributes of a result, as texts: its uncertain inputs, and the number of samples with the seed."""
    words = (f"{name}: {together[0].distribution.words}" for name, together in case.unknowns.items())
    drawn = f"{case.uncertainty.count} points, seed {case.uncertainty.seed}"
    return {"uncertain_inputs": "\n".join(words), "uncertainty": drawn}


def warning_shares(draws: Draws) -> str:
    """Return JSON text: the fraction of all points with each validity warning or reason for a missing result.

    A point is a sample at a load or separation.
    """
    return json.dumps(draws.shares(), ensure_ascii=False)
