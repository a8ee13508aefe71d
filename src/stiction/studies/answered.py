"""How far may I trust this: the result of a case with its band, and what its friction differs by."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.case.read import Case, as_case
from stiction.quantities.inputs import require_callable
from stiction.quantities.progress import Progress, silent
from stiction.studies.case_results import compare_case, solve_case
from stiction.studies.comparison.compare import working_load
from stiction.studies.uncertainty.spreads import ends_of_band, ends_of_models, with_spreads

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient"


def uncertainty(
    case: Any,
    *,
    load: Any = None,
    ranges: bool | None = None,
    progress: Progress = silent,
) -> "xarray.Dataset":
    """The result of a case, how it varies with what is uncertain of it, and what its friction differs by.

    case: path of a case file, its tables as a dict, or a Case. load: the working load [N]; by default the middle one of the
    case. ranges: whether numbers of materials vary within their ranges, in place of what the case says. progress: from a text,
    what wraps a list of steps.

    Returns what `solve_case` gives, with NAME_quantile (quantile, ...) of friction, area, load and pull-off over what is
    uncertain and NAME_quantile_error, the standard error of the sampling; and over `spread` the ends spread_low, spread_high
    and their ratio spread_factor of the friction coefficient at the working load (attribute `working_load`): over the inputs,
    by the model of the case, the band that holds `coverage` of the points; over the methods of finding asperities, by this
    model; over the models, that share of their weight, of the family that `compare` recommends, on the nominal contact. They
    are not added: each is what would be left if the others were known. Raises InputError for bad input.
    """
    require_callable(progress, "progress")
    case = as_case(case, ranges)
    return answered(case, working_load(case, load), progress, bands=False).data


@dataclass(frozen=True)
class Answered:
    """A case: data, what `uncertainty` gives; load: its working load [N], or normalised, or None; here: the case at it; told:
    all models at it."""

    data: "xarray.Dataset"
    load: float | None
    here: "xarray.Dataset | None" = None
    told: "xarray.Dataset | None" = None


def answered(case: Case, load: float | None, progress: Progress, bands: bool = True) -> Answered:
    """A case with what its friction differs by at a working load, and that from which it follows; bands: whether also the band
    of every model, which the answer does not need, and which takes as long as the slowest of them. Raises InputError."""
    data = solve_case(case, progress=progress)
    if load is None:
        return Answered(data, load)
    here = solve_case(replace(case, separation=None, load=np.array([load])), progress=progress).squeeze("load")
    told = compare_case(case, load, progress, bands)
    if _MU not in data:
        return Answered(data, load, here, told)
    inputs = ends_of_band(here[f"{_MU}_quantile"]) if f"{_MU}_quantile" in here else []
    methods = [float(here[f"{_MU}_{end}"]) for end in ("low", "high")] if f"{_MU}_low" in here else []
    models = ends_of_models(told, case.uncertainty.coverage) if told.attrs.get("recommended", "none") != "none" else []
    data = with_spreads(data, inputs, methods, models, float(here[_MU])).assign_attrs(working_load=load)
    return Answered(data, load, here, told)
