"""Compare alternative models on the same data, by Akaike's criterion and cross-validation."""

from dataclasses import dataclass

import numpy as np

from stiction.quantities.errors import InputError
from stiction.quantities.shown import reason_of
from stiction.studies.fit.answer import Fitted, fitted, refitted
from stiction.studies.fit.model import forward_model
from stiction.studies.fit.plan import FitPlan

_FOLDS = 5


@dataclass(frozen=True)
class ComparedModel:
    """Hold an alternative model with its fit, or with the reason `why_not` if it could not be fitted.

    aicc: Akaike's criterion, lower is better. left_out: cross-validation error. The error is the root mean square of
    (prediction - measured value) over values that were left out of the fit. Each difference is divided by the standard error,
    or by the largest measured value if no errors are stated. Both numbers are infinite without a fit.
    """

    name: str
    fit: Fitted | None
    aicc: float = np.inf
    left_out: float = np.inf
    why_not: str = ""


def compared_model(plan: FitPlan, name: str, fit: Fitted | None = None) -> ComparedModel:
    """Fit and cross-validate the model with the name `name`; a model that raises InputError is returned with the reason.

    fit: an existing fit of this model, which is then used instead of a new one.
    """
    try:
        one = fit or fitted(name, forward_model(plan, name), with_profiles=False)
        return ComparedModel(name, one, aicc_of(one), _cross_validation_error(plan, one))
    except InputError as error:
        return ComparedModel(name, None, why_not=reason_of(error))


def aicc_of(fit: Fitted) -> float:
    """Return Akaike's criterion of a fit, corrected for few values (Hurvich & Tsai 1989).

    For n values with Gaussian errors and k fitted numbers that affect the model, it is chi square + 2k + 2k(k+1)/(n-k-1) with
    stated errors. If the size of the errors is estimated, it counts as one of the k numbers, and n ln(sum of squares/n)
    replaces chi square. The criterion is infinite for n <= k + 1.
    """
    n, k = len(fit.errors), int(fit.best.jacobian.any(axis=0).sum())  # a parameter without effect on the model does not count
    chi_square = fit.best.chi_square * fit.scale**2  # with the original errors instead of the enlarged ones
    if fit.stated:
        value = chi_square + 2 * k
    else:
        k += 1
        value = n * np.log(max(chi_square, 1e-300) / n) + 2 * k
    return float(value + 2 * k * (k + 1) / (n - k - 1)) if n > k + 1 else float("inf")


def _cross_validation_error(plan: FitPlan, fit: Fitted) -> float:
    """Return the cross-validation error of a fit: each fold of the data is predicted from a fit to all other folds.

    It is the root mean square of (prediction - measured value), divided by the standard errors, or by the largest measured
    value if no errors are stated. It is NaN if there are fewer than two folds, and infinite if a fit fails or the model refuses
    a left-out value.
    """
    data = plan.data
    folds = _folds(plan)
    if len(folds) < 2:
        return float("nan")
    errors = fit.errors / fit.scale if fit.stated else (np.abs(data.value).max() or 1.0)
    total, name = np.empty(len(data)), fit.name or None
    for fold in folds:
        rest = np.setdiff1d(np.arange(len(data)), fold)
        try:
            other = refitted(fit, forward_model(plan, name, data.some(rest)))
            predicted = forward_model(plan, name, data.some(fold)).values(other.best.positions)[0]
        except InputError:
            return float("inf")
        total[fold] = predicted - data.value[fold]
    total /= errors
    return float(np.sqrt(np.mean(total**2))) if np.isfinite(total).all() else float("inf")


def _folds(plan: FitPlan) -> list[np.ndarray]:
    """Return the folds (parts of the data) of the cross-validation, each an array of indices of measured values.

    With three or more samples, and no free parameter fitted per sample, each sample is a fold. Otherwise the values are sorted
    by sample and load, and every fifth goes into one fold, so that each fold covers the whole range; the list is then empty if
    any fold leaves too few values for a fit.
    """
    data, each = plan.data, any(one.each_sample for one in plan.free)
    if len(data.samples) >= 3 and not each:
        return [np.array([at for at, name in enumerate(data.sample) if name == one]) for one in data.samples]
    order = np.lexsort((np.nan_to_num(data.load), np.unique(data.sample, return_inverse=True)[1]))
    count = min(_FOLDS, len(data))
    folds = [np.sort(order[at::count]) for at in range(count)]
    return folds if all(_is_enough(plan, np.setdiff1d(np.arange(len(data)), fold)) for fold in folds) else []


def _is_enough(plan: FitPlan, rest: np.ndarray) -> bool:
    """Return whether the measured values with the indices `rest` suffice for a fit.

    They must outnumber the free parameters. If any number is fitted per sample, every sample must occur among them.
    """
    each = sum(one.each_sample for one in plan.free)
    samples = {plan.data.sample[at] for at in rest}
    count = len(plan.free) + each * (len(plan.data.samples) - 1)
    return len(rest) > count and (not each or len(samples) == len(plan.data.samples))


def rank(compared_models: list[ComparedModel]) -> list[tuple[ComparedModel, float]]:
    """Return (model, Akaike weight) for all models, best first; models without a fit come last.

    The weights sum to 1, or are NaN if no criterion is finite. Source: Burnham & Anderson 2002, eq. 2.9.
    """
    ordered = sorted(compared_models, key=lambda one: (one.fit is None, one.aicc))
    values = np.array([one.aicc for one in ordered])
    if not np.isfinite(values).any():
        return [(one, float("nan")) for one in ordered]
    weights = np.exp(-0.5 * (values - values.min()))
    return [(one, float(weight)) for one, weight in zip(ordered, weights / weights.sum(), strict=True)]
