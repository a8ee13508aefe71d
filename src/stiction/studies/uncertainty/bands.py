"""Bands over what is uncertain, with the error that their own sampling leaves them."""

import json
from typing import TYPE_CHECKING

import numpy as np

from stiction.case.read import Case
from stiction.laws.validity import with_warnings
from stiction.quantities.progress import Steps
from stiction.records.validity_warning import ValidityWarning
from stiction.solving.choice import Choice
from stiction.solving.pointwise import WHY_NOT
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

# Scramblings of the sequence, each on its own: their scatter is the error of the sampling.
_PARTS = 8
_LEAST_KNOWN = 0.5  # the share of the points that must be known for a quantile of them
_MANY = 0.05  # the share of impossible draws from which on a warning says so


def levels(coverage: float) -> np.ndarray:
    """Return the quantile levels: the ends of the band, the quarters and the median."""
    return np.array(sorted({(1.0 - coverage) / 2.0, 0.25, 0.5, 0.75, (1.0 + coverage) / 2.0}))


def quantiles(values: np.ndarray, shares: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Quantiles (shares, ...) of values (parts, n, ...), and their standard errors, from the scatter of the parts.

    Each part is a scrambled sequence of its own, so that the parts scatter independently (Owen 1997). Not a number where less
    than half of the values are known.
    """
    parts, count = values.shape[:2]
    whole = _quantile(values.reshape(parts * count, *values.shape[2:]), shares)
    each = np.array([_quantile(one, shares) for one in values])
    return whole, each.std(axis=0, ddof=1) / np.sqrt(parts)


def _quantile(values: np.ndarray, shares: np.ndarray) -> np.ndarray:
    known = np.isfinite(values)
    if known.all():
        return np.quantile(values, shares, axis=0)
    enough = known.mean(axis=0) >= _LEAST_KNOWN
    safe = np.where(known & enough, values, np.where(enough, np.nan, 0.0))
    return np.where(enough, np.nanquantile(safe, shares, axis=0), np.nan)


def with_bands(data: "xarray.Dataset", case: Case, choice: Choice, progress: Steps = iter) -> "xarray.Dataset":
    """Return the result of a case with quantiles over its uncertain numbers.

    Added are NAME_quantile (quantile, ...), and NAME_quantile_error, its standard error of sampling. Unchanged where nothing is
    uncertain.
    """
    if not case.uncertain:
        return data
    if solves_maps(choice):
        why = f"no interval is given: {choice.model_key} would have to solve the map for every sample"
        return with_warnings(data, [ValidityWarning(why)])
    wanted = case.uncertainty
    names = [name for name in OUTPUTS if name in data.data_vars]
    shares = scrambled(len(case.unknowns), wanted.count, wanted.seed, _PARTS)
    found = draw(case, shares.reshape(wanted.count, -1), [Variant(choice)], names=names, progress=progress)
    variables: dict[str, tuple] = {}
    for name in found.tables:
        variables |= _as_variables(name, found, levels(wanted.coverage))
    data = data.assign_coords(quantile=("quantile", levels(wanted.coverage), {"long_name": "share of the points below"}))
    return _said(data.assign(variables), case, found)


def _as_variables(name: str, found: Draws, shares: np.ndarray) -> dict[str, tuple]:
    table = found.tables[name]
    values, errors = quantiles(table.reshape(_PARTS, len(table) // _PARTS, *table.shape[1:]), shares)
    dims, meaning = ("quantile", *found.dims[name]), dict(found.attributes[name])
    said = meaning.pop("comment", meaning["long_name"])
    return {
        f"{name}_quantile": (dims, values, meaning | {"long_name": f"{said}, quantiles over what is uncertain"}),
        f"{name}_quantile_error": (dims, errors, meaning | {"long_name": f"{said}, standard error of its quantiles"}),
    }


def _said(data: "xarray.Dataset", case: Case, found: Draws) -> "xarray.Dataset":
    """With what is uncertain, how it was drawn, and where nothing is known."""
    lost = sum(found.shares().get(why, 0.0) for why in WHY_NOT[:2])
    impossible = found.impossible_share
    if lost:
        why = f"{lost:.0%} of the samples have no result: intervals are over the others"
        data = with_warnings(data, [ValidityWarning(why)])
    if impossible > _MANY:
        why = f"{impossible:.0%} of the samples exceed nominal area or hardness and are excluded"
        left = "no interval is given" if impossible > 1.0 - _LEAST_KNOWN else "the interval of mu is over the others"
        data = with_warnings(data, [ValidityWarning(f"{why}: {left}")])
    return data.assign_attrs(
        drawing_said(case),
        validity_warnings_of_points=warning_shares(found),
        impossible_draws=impossible,
        coverage=case.uncertainty.coverage,
    )


def drawing_said(case: Case) -> dict[str, str]:
    """Return what is uncertain of a case, and how it is drawn, as attributes of a result."""
    words = (f"{name}: {together[0].distribution.words}" for name, together in case.unknowns.items())
    drawn = f"{case.uncertainty.count} points, seed {case.uncertainty.seed}"
    return {"uncertain_inputs": "\n".join(words), "uncertainty": drawn}


def warning_shares(found: Draws) -> str:
    """Return the share of all points at which each range is left, as JSON."""
    return json.dumps(found.shares(), ensure_ascii=False)
