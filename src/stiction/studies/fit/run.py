"""Fit numbers of a case to measured values and collect the results in a dataset."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction import __version__
from stiction.case.read import tables_of, without_studies
from stiction.case.text import case_text, with_written
from stiction.quantities.inputs import require_callable
from stiction.quantities.progress import Progress, silent
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.studies.fit.answer import Fitted, diagnostics, fitted
from stiction.studies.fit.bands import Bands, check_predicted, predicted
from stiction.studies.fit.model import check_models, forward_model
from stiction.studies.fit.model_comparison import ComparedModel, compared_model, rank
from stiction.studies.fit.plan import RESISTANCE, FitPlan, make_fit_plan
from stiction.studies.fit.predicted import fit_prediction
from stiction.studies.fit.search import CONFIDENCE

if TYPE_CHECKING:
    import xarray

    from stiction.case.arguments import CaseFile
    from stiction.quantities.arguments import FilePath

_FEW = 100  # effective number of posterior samples below which a 95 % band is rough


@dataclass
class FitResult:
    """Hold the results of a fit, complete or interrupted.

    best: fit of the model that the case names. bands: its predictions, None before they are computed. compared_models: fits of
    alternative models. stopped: whether the user interrupted the fit.
    """

    plan: FitPlan
    best: Fitted
    bands: Bands | None = None
    compared_models: list[ComparedModel] = field(default_factory=list)
    stopped: bool = False

    def data(self) -> "xarray.Dataset":
        """Return the results as the labelled dataset that `fit` describes."""
        import xarray

        one = self.best
        names = [x.name for x in one.parameters]
        data = xarray.Dataset(_parameters(one) | _rows(one), coords={"parameter": names})
        data = data.assign_coords(row=np.arange(len(self.plan.data)), other_parameter=names)
        if self.bands is not None:
            data = data.merge(_predictions(self.bands))
        if self.compared_models:
            data = data.merge(_evidence(self.compared_models))
        return data.assign_attrs(_attributes(self))

    def case_text(self, out: Path) -> str:
        """Return the text of a case file with the fitted numbers; `out` is the folder to which the text will be written."""
        return _fitted_case(self, out)


def fit(case: "CaseFile", data: "FilePath", *, progress: Progress = silent) -> "xarray.Dataset":
    """Fit numbers of a case to measured values.

    Parameters
    ----------
    case : path, or dict like a case file
        Case whose table [fit.free] names the numbers to fit, each with its low and high end. If the case has a table [contact]
        and names no model, [fit] is optional: the prediction is then updated with the measured values.
    data : path
        CSV file of measured values, with column names such as `load [N],friction_coefficient`.
    progress : callable
        Receives a label and returns a function that wraps the list of steps.

    Returns
    -------
    xarray.Dataset
        Over `parameter`, the numbers of [fit.free], in SI units: the best `value`; `low` and `high`, the 95 % interval by the
        profile likelihood; `open_low` and `open_high`: True if the data do not limit the value at this end; `standard_error`,
        `correlation`; `least` and `most`, the ends of the search range; and the profile, `profile_value` and `profile_rise`
        (rise of chi square). Over `row`: measured values, fitted values and residuals. Over `model`, if [fit] names alternative
        models: Akaike's criterion, Akaike weights and cross-validation errors. Predictions at the points of [solve]:
        `predicted_...` with `..._low` and `..._high`. Attribute `verdict`: what the data determine poorly. If the case names no
        model, the result is that of `predict` with these measured values, with `value`, `low` and `high` of the fitted numbers.

    Raises
    ------
    InputError
        The table [fit] or the CSV file is missing or wrong.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import stiction as st
    >>> contact = {
    ...     "first": "gold", "second": "gold", "nominal_area": "1 mm^2", "interfacial_shear_strength": "50 MPa",
    ...     "roughness": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
    ... }
    >>> data = pathlib.Path(tempfile.mkdtemp()) / "measured.csv"
    >>> _ = data.write_text("load [N],friction_coefficient\\n0.1,0.03\\n1,0.028\\n")
    >>> free = {"interfacial_shear_strength": {"low": "1 MPa", "high": "1 GPa"}}
    >>> case = {"contact": contact, "solve": {"load": ["1 N"], "model": "persson_2001"}, "fit": {"free": free}}
    >>> print(f"{st.fit(case, data)['value'].item():.1e} Pa")
    2.2e+07 Pa
    """
    require_callable(progress, "progress")
    if (answer := fit_prediction(case, data)) is not None:
        return answer[1]
    return run_fit(plan_of_fit(case, data), progress, keep_on_interrupt=False).data()


def plan_of_fit(case: Any, data: Any) -> FitPlan:
    """Return the checked plan of a fit from a case and a file of measured values.

    case: path of a case file, or a dict of its tables. data: path of the CSV file. Raises InputError.
    """
    content, folder = tables_of(case)
    plan = make_fit_plan(content, data, folder)
    check_models(plan)
    check_predicted(plan)
    return plan


def run_fit(plan: FitPlan, progress: Progress, keep_on_interrupt: bool = True) -> FitResult:
    """Fit the model of the case, predict with it, and fit the alternative models, as a plan states.

    keep_on_interrupt: whether an interruption (Ctrl-C) after the first fit returns the results so far; otherwise
    KeyboardInterrupt is raised.
    """
    name = forward_model(plan).choice.model_key
    for _ in progress("Fitting")([name]):
        found = FitResult(plan, fitted("", forward_model(plan)))
    try:
        for _ in progress("Predicting")([name]):
            found.bands = predicted(plan, found.best)
        others = [one for one in dict.fromkeys(plan.models) if one != name]
        if others:
            for one in progress("Fitting other models")([name, *others]):
                found.compared_models.append(compared_model(plan, one, found.best if one == name else None))
    except KeyboardInterrupt:
        if not keep_on_interrupt:
            raise
        found.stopped = True
    return found


def _parameters(fit: Fitted) -> dict[str, tuple]:
    along = ("parameter",)
    free = fit.parameters
    ends = np.array([[float(f.at(end)) for end in (p.low, p.high)] for f, p in zip(free, fit.profiles, strict=True)])
    points = max(len(p.positions) for p in fit.profiles)
    rise, value = np.full((2, len(free), points), np.nan)
    for at, (f, p) in enumerate(zip(free, fit.profiles, strict=True)):
        rise[at, : len(p.positions)], value[at, : len(p.positions)] = p.rise, f.at(p.positions)
    return {
        "unit": (along, [QUANTITIES[f.quantity].unit or "1" for f in free]),
        "value": (along, fit.values, {"long_name": "best value, in SI units"}),
        "low": (along, ends[:, 0], {"long_name": "low end of the 95 % interval"}),
        "high": (along, ends[:, 1], {"long_name": "high end of the 95 % interval"}),
        "open_low": (along, [p.open_low for p in fit.profiles], {"long_name": "no value down to the low end is excluded"}),
        "open_high": (along, [p.open_high for p in fit.profiles], {"long_name": "no value up to the high end is excluded"}),
        "standard_error": (along, _standard_errors(fit), {"long_name": "standard error from the curvature"}),
        "least": (along, [f.low for f in free], {"long_name": "low end of the search range"}),
        "most": (along, [f.high for f in free], {"long_name": "high end of the search range"}),
        "correlation": (("parameter", "other_parameter"), fit.correlation, {"long_name": "correlation"}),
        "profile_value": (("parameter", "profile"), value, {"long_name": "values along the profile of the likelihood"}),
        "profile_rise": (("parameter", "profile"), rise, {"long_name": "rise of chi square"}),
    }


def _standard_errors(fit: Fitted) -> np.ndarray:
    """Return the standard errors (k,) of the k fitted numbers in SI units, from the curvature of chi square."""
    slope = [
        float(value) * np.log(x.high / x.low) if x.log else x.high - x.low
        for x, value in zip(fit.parameters, fit.values, strict=True)
    ]
    return np.sqrt(np.diag(fit.best.covariance)) * np.array(slope)


def _rows(fit: Fitted) -> dict[str, tuple]:
    data = fit.forward.data
    fitted = fit.forward.values(fit.best.positions)[0]
    return {
        "quantity": ("row", list(data.quantity)),
        "sample": ("row", list(data.sample)),
        "measured_load": ("row", data.load, {"units": "N", "long_name": "load"}),
        "measured": ("row", data.value, {"long_name": "measured, in SI units"}),
        "error": ("row", fit.errors, {"long_name": "standard error used"}),
        "fitted": ("row", fitted, {"long_name": "fitted, in SI units"}),
        "residual": (
            "row",
            (data.value - fitted) / fit.errors,
            {"long_name": "measured minus fitted value, over the standard error"},
        ),
    }


def _predictions(bands: Bands) -> "xarray.Dataset":
    import xarray

    variables = {}
    for name, (dims, best, low, high) in bands.tables.items():
        attributes = QUANTITIES[name].attributes
        for end, values in (("", best), ("_low", low), ("_high", high)):
            variables[f"predicted_{name}{end}"] = (dims, values, attributes)
    return xarray.Dataset(variables, coords=bands.coords)


def _evidence(compared_models: list[ComparedModel]) -> "xarray.Dataset":
    import xarray

    ranked = rank(compared_models)
    along = "model"
    stated = any(one.fit is not None and one.fit.stated for one in compared_models)
    over = "their standard errors" if stated else "the largest of all values"
    return xarray.Dataset(
        {
            "aicc": (along, [one.aicc for one, _ in ranked], {"long_name": "Akaike's criterion, corrected"}),
            "weight": (along, [weight for _, weight in ranked], {"long_name": "Akaike weight"}),
            "cross_validation_error": (
                along,
                [one.left_out for one, _ in ranked],
                {"long_name": f"cross-validation error, over {over}"},
            ),
            **_left_over([one.fit for one, _ in ranked], stated),
            "why_not": (along, [one.why_not for one, _ in ranked]),
        },
        coords={"model": [one.name for one, _ in ranked]},
    )


def _left_over(fits: Sequence[Fitted | None], stated: bool) -> dict[str, tuple]:
    """Return, by name, the dataset variable that measures how far the measured values are from the fit of each model.

    stated: whether the data file states errors. With errors the variable is chi square, without errors the standard deviation
    of the values about the fit. A model without a fit has NaN.
    """
    if stated:
        chi = [np.nan if one is None else one.best.chi_square * one.scale**2 for one in fits]
        return {"chi_square": ("model", chi, {"long_name": "sum of squared residuals"})}
    scatter = [np.nan if one is None else float(one.errors[0]) for one in fits]
    return {"scatter": ("model", scatter, {"long_name": "standard deviation of values about the fit, in SI units"})}


def _attributes(fitting: FitResult) -> dict[str, Any]:
    one, plan = fitting.best, fitting.plan
    bands = {} if fitting.bands is None else {"band_draws": fitting.bands.effective, "band_sample": fitting.bands.sample or ""}
    return {
        **({"case": plan.title} if plan.title else {}),
        "program": f"stiction {__version__}",
        "model": one.forward.choice.name,
        "values": len(plan.data),
        "free": len(one.parameters),
        "degrees_of_freedom": one.freedom,
        **({"chi_square": one.best.chi_square * one.scale**2} if one.stated else {}),
        "confidence": CONFIDENCE,
        "errors": _errors_said(one),
        "errors_stated": int(one.stated),
        "verdict": "\n".join([*diagnostics(one), *_unsure(fitting)]),
        "stopped": int(fitting.stopped),
        **bands,
    }


def _unsure(fitting: FitResult) -> list[str]:
    """Return sentences on a search that did not converge, and on prediction intervals from too few independent samples."""
    why = fitting.best.best.unfinished
    texts = [f"the search did not end at a minimum: {why}"] if why else []
    if fitting.bands is not None and fitting.bands.effective < _FEW:
        texts.append(f"predicted intervals use only {fitting.bands.effective:.0f} independent samples: they are rough")
    return texts


def _errors_said(fit: Fitted) -> str:
    if not fit.stated:
        names = sorted(set(fit.forward.data.quantity))
        one_known = len(names) == 1 and names[0] in QUANTITIES
        size = show(float(fit.errors[0]), names[0], 3) if one_known else f"{fit.errors[0]:.3g} in SI units"
        return f"none given; the scatter about the fit, {size}, is used for all values"
    if fit.scale > 1.0:
        return (
            f"multiplied by {fit.scale:.2g}, because residuals scatter that much more than the given errors: the "
            "model or the errors are wrong"
        )
    return "as given; the scatter about the fit agrees with them"


def _fitted_case(fitting: FitResult, out: Path) -> str:
    one, plan = fitting.best, fitting.plan
    numbers, comments = {}, [f"Fitted by stiction {__version__} to {len(plan.data)} measured values. 95 % intervals:"]
    for x, value, p in zip(one.parameters, one.values, one.profiles, strict=True):
        ends = [x.show(float(x.at(end))) for end in (p.low, p.high)]
        how = " (open)" if p.open_low or p.open_high else ""
        comments.append(f"{x.name} = {x.show(float(value))}, {ends[0]} to {ends[1]}{how}")
        if x.path != RESISTANCE and x.path not in numbers:
            numbers[x.path] = float(value)
    if any(x.sample is not None for x in one.parameters):
        comments.append(f"Numbers that differ between samples have the values of sample {plan.data.samples[0]}.")
    comments += [f"Note: {text}" for text in diagnostics(one)]
    return case_text(with_written(without_studies(plan.given), numbers), comments, plan.folder, out)
