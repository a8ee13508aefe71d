"""Find which input should be measured better: Sobol indices, Morris effects and logarithmic sensitivities of a case."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.case.read import Case, as_case
from stiction.quantities.errors import InputError
from stiction.quantities.inputs import require_callable
from stiction.quantities.progress import Progress, silent
from stiction.quantities.sampling import spread_rows
from stiction.solving.candidates import choice_of
from stiction.solving.choice import RECOMMENDED
from stiction.solving.solve import solve
from stiction.studies.case_results import choice_of_case
from stiction.studies.comparison.compare import working_load
from stiction.studies.prediction.predict import is_predicted, predict
from stiction.studies.sensitivity.indices_of_variance import effects, points_of_indices, sobol_indices, trajectories
from stiction.studies.sensitivity.log_sensitivities import LogSensitivities, log_sensitivities, log_sensitivities_of_prediction
from stiction.studies.uncertainty.bands import sampling_attributes, warning_shares
from stiction.studies.uncertainty.drawing import OUTPUTS, Draws, Variant, draw

if TYPE_CHECKING:
    import xarray

    from stiction.case.arguments import CaseLike
    from stiction.quantities.arguments import QuantityLike

METHOD_INPUT, MODEL_INPUT = "asperity_method", "model"
_LOADS = 9  # largest number of loads of a case
_ENDS = (0.025, 0.975)  # quantile levels between which Morris effects are computed
_PER_TRAJECTORY = 16  # sample points of the Sobol indices for each Morris trajectory


def sensitivity(
    case: "CaseLike",
    *,
    load: "QuantityLike | None" = None,
    models: Sequence[str] | None = None,
    ranges: bool | None = None,
    progress: Progress = silent,
) -> "xarray.Dataset":
    """Compute how much each input affects the results of a case.

    Parameters
    ----------
    case : Case, path, or dict like a case file
        One contact; its numbers may be uncertain.
    load : float [N] or str with a unit, optional
        Only this load; by default at most nine of the loads of the case.
    models : sequence of str, optional
        Names of models as `compare` shows them, sampled with equal probability as a further input; by default the model of
        the case alone.
    ranges : bool, optional
        Whether numbers of material presets vary within their ranges; None uses the setting of the case.
    progress : callable
        Receives a label and returns a function that wraps the list of steps.

    Returns
    -------
    xarray.Dataset
        In the names of the variables, y denotes friction_coefficient, contact_area, load (at separations) or pull_off_force.
        Over `input`, the uncertain inputs: y_first_order and y_total_order, Sobol indices of ln y with 95 % intervals (`_low`,
        `_high`); y_effect, the mean absolute elementary effect of Morris on ln y from the 2.5 to the 97.5 % quantile of the
        input, with y_effect_error and y_effect_deviation. Over `number`, all numbers of the contact: y_log_sensitivity, d ln
        y/d ln x at the nominal numbers, and its error bound y_log_sensitivity_error. If neither `models` nor the case names a
        model and a load is above 0, the results are those of the prediction: friction_coefficient_share over `input`, the
        fraction of the variance of ln mu, and friction_coefficient_log_sensitivity over `number`.

    Raises
    ------
    InputError
        A number of the contact is an array, or a model is not known or does not accept the contact.

    Notes
    -----
    Methods: Sobol (2001), Morris (1991). Without uncertain inputs, a model has no Sobol indices and no Morris effects.

    Examples
    --------
    >>> import stiction as st
    >>> contact = {
    ...     "first": "hardened_steel_52100", "second": "hardened_steel_52100",
    ...     "nominal_area": "1 mm^2", "interfacial_shear_strength": "50 MPa",
    ...     "roughness": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
    ... }
    >>> slopes = st.sensitivity({"contact": contact, "solve": {"load": "1 N", "model": "persson_2001"}})
    >>> round(slopes.friction_coefficient_log_sensitivity.sel(number="interfacial_shear_strength").item(), 3)
    1.0
    """
    require_callable(progress, "progress")
    case = as_case(case, ranges)
    case.subject.require_single("one number, or an uncertain one, for sensitivity")
    case = case.at_load(load)
    at = working_load(case, None)
    if models is None and at is not None and is_predicted(case):
        return _of_prediction(case, at)
    case = _at_few_loads(case, at)
    choice = choice_of_case(case, case.choice)
    variation = _variation(case, choice, models)
    slopes = log_sensitivities(case, choice, progress=progress("LogSensitivities"))
    nominal = solve(case.subject.as_numbers(), **case.requested_points, **choice.arguments())
    found = _with_log_sensitivities(nominal, slopes)
    if variation.inputs:
        found = _with_indices(found, case, variation, progress)
    attributes = {} if at is None else {"working_load": at}
    return found.assign_attrs(nominal.attrs | attributes, case=case.title).assign_attrs(_attributes(case, variation))


def _of_prediction(case: Case, load: float) -> "xarray.Dataset":
    """Return the sensitivities of a prediction at a load [N] as a dataset.

    The dataset has the fraction of the variance of ln mu that each input causes, d ln mu/d ln x for every number x of the
    contact, and those results of `predict` that are single numbers.
    """
    import xarray

    answer, slopes = predict(case, load=load), log_sensitivities_of_prediction(case, load)
    shares = answer.attrs["shares"]
    share = {"units": "1", "long_name": "share of the variance of ln mu"}
    slope = {"units": "1", "long_name": "logarithmic sensitivity of the friction coefficient, d ln mu/d ln x"}
    variables = {
        "friction_coefficient_share": ("input", list(shares.values()), share),
        "friction_coefficient_log_sensitivity": ("number", list(slopes.values()), slope),
    }
    found = xarray.Dataset(variables, coords={"input": list(shares), "number": list(slopes), "load": answer["load"]})
    found = found.assign({name: answer[name] for name in answer if answer[name].ndim == 0})
    stated = sampling_attributes(case)["uncertain_inputs"]
    return found.assign_attrs(answer.attrs | {"case": case.title, "model": RECOMMENDED, "uncertain_inputs": stated})


def _at_few_loads(case: Case, working: float | None) -> Case:
    """Return the case with at most nine of its loads, spread over all of them.

    working: working load [N]; the load nearest to it is included. None if there is none. A case without loads is unchanged.
    """
    if case.load is None or case.load.size <= _LOADS:
        return case
    places = spread_rows(case.load.size, _LOADS)
    if working is not None:
        nearest = int(np.argmin(np.abs(case.load - working)))
        places[np.argmin(np.abs(places - nearest))] = nearest
    return replace(case, load=case.load[places])


@dataclass(frozen=True)
class _Variation:
    """Hold the inputs that the study varies: uncertain numbers, asperity methods and models.

    numbers: names of the uncertain numbers. methods, models: names, each with equal probability. variants: every combination of
    a method and a model.
    """

    numbers: list[str]
    methods: list[str]
    models: list[str]
    variants: list[Variant]

    @property
    def inputs(self) -> list[str]:
        more = [METHOD_INPUT] * (len(self.methods) > 1) + [MODEL_INPUT] * (len(self.models) > 1)
        return [*self.numbers, *more]

    def rows(self, shares: np.ndarray) -> np.ndarray:
        """Return the index in `variants` of the method and model of each of n samples, (n,).

        shares (n, inputs): sampled position of each input, 0 to 1.
        """
        rows = np.zeros(len(shares), dtype=int)
        for name, drawn in ((METHOD_INPUT, self.methods), (MODEL_INPUT, self.models)):
            if name in self.inputs:
                places = (shares[:, self.inputs.index(name)] * len(drawn)).astype(int)
                rows = rows * len(drawn) + np.minimum(places, len(drawn) - 1)
        return rows


def _variation(case: Case, choice: Any, models: Sequence[str] | None) -> _Variation:
    by_method = case.measured.by_method if case.measured is not None and case.by_method else {}
    names, choices = [choice.name], [choice]
    if models is not None and not (isinstance(models, list | tuple) and all(isinstance(one, str) for one in models)):
        raise InputError("models", models, "a list of names")
    if models:
        names = list(dict.fromkeys(models))
        choices = [choice_of(name, {}, case.subject) for name in names]
    surfaces: list[Any] = [*by_method.values()] or [None]
    variants = [Variant(one, surface) for surface, one in product(surfaces, choices)]
    return _Variation(list(case.unknowns), list(by_method), names, variants)


def _attributes(case: Case, variation: _Variation) -> dict[str, Any]:
    drawn = dict.fromkeys(variation.models, 1.0 / len(variation.models))
    return sampling_attributes(case) | {"models": json.dumps(drawn), "methods": " ".join(variation.methods)}


def _with_log_sensitivities(nominal: "xarray.Dataset", slopes: LogSensitivities) -> "xarray.Dataset":
    import xarray

    variables: dict[str, Any] = {}
    for name, table in slopes.tables.items():
        if name in nominal.coords:
            continue  # the case states this result
        text = f"logarithmic sensitivity of the {nominal[name].attrs.get('long_name', name)}, d ln y/d ln x"
        dims = ("number", *slopes.dims[name])
        for end, values, meaning in (("", table, text), ("_error", slopes.errors[name], f"error of the {text}")):
            variables[f"{name}_log_sensitivity{end}"] = (dims, values, {"units": "1", "long_name": meaning})
        variables[name] = nominal[name].variable
    coords = {str(name): one for name, one in nominal.coords.items() if name in ("load", "mean_separation", "separation")}
    return xarray.Dataset(variables, coords=coords | {"number": slopes.names})


def _with_indices(found: "xarray.Dataset", case: Case, variation: _Variation, progress: Progress) -> "xarray.Dataset":
    columns, wanted = len(variation.inputs), case.uncertainty
    points = points_of_indices(columns, wanted.count, wanted.seed)
    drawn = _drawn(case, variation, points.reshape(-1, columns), progress("Sobol indices"))
    paths = trajectories(columns, max(8, wanted.count // _PER_TRAJECTORY), wanted.seed)
    shares = _ENDS[0] + (_ENDS[1] - _ENDS[0]) * paths
    screened = _drawn(case, variation, shares.reshape(-1, columns), progress("Morris effects"))
    variables: dict[str, tuple] = {}
    for name in drawn.tables:
        if name not in found.coords:
            dims = ("input", *drawn.dims[name])
            variables |= {f"{name}_{end}": (dims, *table) for end, table in _of_result(name, drawn, screened, points, paths)}
    return (
        found.assign_coords(input=variation.inputs)
        .assign(variables)
        .assign_attrs(validity_warnings_of_points=warning_shares(drawn), impossible_draws=drawn.impossible_share)
    )


def _drawn(case: Case, variation: _Variation, shares: np.ndarray, progress: Any) -> Draws:
    rows = variation.rows(shares)
    return draw(case, shares[:, : len(variation.numbers)], variation.variants, rows, OUTPUTS, progress)


# Meaning of indices and effects, by the ending of their names.
_MEANINGS = {
    "first_order": "first Sobol index of the logarithm",
    "first_order_low": "low end of its 95 % interval, first Sobol index of the logarithm",
    "first_order_high": "high end of its 95 % interval, first Sobol index of the logarithm",
    "total_order": "total Sobol index of the logarithm",
    "total_order_low": "low end of its 95 % interval, total Sobol index of the logarithm",
    "total_order_high": "high end of its 95 % interval, total Sobol index of the logarithm",
    "effect": "mean absolute Morris effect on the logarithm, over the range of the input",
    "effect_error": "standard error of the mean absolute Morris effect",
    "effect_deviation": "standard deviation of the Morris effects: large if the effect depends on other inputs",
}


def _of_result(
    name: str, drawn: Draws, screened: Draws, points: np.ndarray, paths: np.ndarray
) -> Iterator[tuple[str, tuple[np.ndarray, dict[str, str]]]]:
    """Yield the Sobol indices and Morris effects of the logarithm of one result.

    Each item is the ending of a variable name, and (array (inputs, *shape), attributes). name: name of the result. points:
    sample points for the Sobol indices. paths: Morris trajectories in the unit cube. drawn: results at `points`. screened:
    results at `paths` rescaled to the quantile levels 0.025 to 0.975. The logarithm is NaN where the result is not above 0.
    """
    shape = drawn.tables[name].shape[1:]
    logs = [_log(one.tables[name]).reshape(*grid.shape[:-1], -1) for one, grid in ((drawn, points), (screened, paths))]
    indices = [sobol_indices(logs[0][..., at]) for at in range(logs[0].shape[-1])]
    screens = [effects(paths, logs[1][..., at]) for at in range(logs[1].shape[-1])]
    for end, text in _MEANINGS.items():
        rows = [one[end] for one in (indices if "order" in end else screens)]
        yield end, (np.stack(rows, axis=-1).reshape(-1, *shape), {"units": "1", "long_name": text})


def _log(values: np.ndarray) -> np.ndarray:
    return np.log(np.where(values > 0.0, values, np.nan))
