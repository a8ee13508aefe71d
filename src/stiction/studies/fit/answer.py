"""Fit one model to measured values, with intervals and sentences on what the data do not determine.

A free parameter is a number of the case that the fit varies between a low and a high end. The fit works with its share: the
position between the low end (0) and the high end (1), linear or logarithmic.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stiction.case.free import Free
from stiction.case.measurements import Measurements
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.shown import show
from stiction.studies.fit.model import ForwardModel
from stiction.studies.fit.search import CONFIDENCE, FAR, Best, Profile, Residuals, profiles, search

_BELIEVED = 0.99  # quantile of chi square above which stated errors are enlarged
_HIDES = 5.0  # two parameters compensate each other if one moves this many times farther than with the other fixed
_LIKE = 0.25  # smallest ratio of the changes of two logarithms that counts as a similar rate
_WIDE = 3.0  # high over low end of an interval above which a number counts as badly determined
_AT_END = 1e-3  # largest distance from an end, as a share, that counts as at the end
_SMALL = 1e-3  # smallest error in the search, relative to the largest measured value of its quantity
_FAR_OFF = 0.5  # scatter over the size of the values above which the model does not fit, if no errors are stated


@dataclass(frozen=True)
class Fitted:
    """Hold one model with its best-fit free parameters and their intervals.

    name: name of the model, "" for the model that the case names. forward: the model with its data. best: the best fit. errors:
    standard errors (n,) of the n measured values, multiplied by `scale`. stated: whether the data file states the errors.
    found: whether `scale` was estimated from the scatter of the values; otherwise it is 1. threshold: rise of chi square that
    marks the ends of an interval. freedom: number of values minus number of free parameters that affect the model. profiles:
    one likelihood profile for each free parameter, or none.
    """

    name: str
    forward: ForwardModel
    best: Best
    errors: np.ndarray
    stated: bool
    scale: float
    threshold: float
    freedom: int
    found: bool
    profiles: tuple[Profile, ...] = ()

    @property
    def parameters(self) -> tuple[Free, ...]:
        return self.forward.parameters

    @property
    def values(self) -> np.ndarray:
        """Return the best-fit values (k,) of the k free parameters, in SI units."""
        return self.at(self.best.positions)

    @property
    def correlation(self) -> np.ndarray:
        size = np.sqrt(np.diag(self.best.bounded))
        return self.best.bounded / np.outer(size, size)

    def at(self, positions: np.ndarray) -> np.ndarray:
        return np.array([one.at(share) for one, share in zip(self.parameters, positions, strict=True)])

    def log_likelihood(self, rise: np.ndarray) -> np.ndarray:
        """Return the log-likelihood minus its value at the best fit, as an array of the shape of `rise`.

        rise: increase of chi square above the best fit. If the size of the errors was estimated from the same values, it is
        integrated out (Gelman et al. 2013, section 14.2: Student's t for a linear model).
        """
        rise = np.maximum(rise, 0.0)
        return -0.5 * len(self.errors) * np.log1p(rise / self.freedom) if self.found else -0.5 * rise

    def residuals(self) -> Residuals:
        """Return a function that computes residuals, (model - measured)/standard error, for sets of the k free parameters.

        The function maps positions (sets, k) of the parameters between their ends, 0 to 1, to residuals (sets, n) of n measured
        values.
        """
        return _residuals(self.forward, self.errors)


def _residuals(forward: ForwardModel, errors: np.ndarray) -> Residuals:
    return lambda positions: (forward.values(positions) - forward.data.value) / errors


def fitted(name: str, forward: ForwardModel, with_profiles: bool = True) -> Fitted:
    """Return the least-squares fit of a model to its measured values, with intervals of the fitted parameters.

    name: name of the model for the result. forward: the model with its data. with_profiles: whether likelihood profiles are
    computed. Raises InputError if the model with the best-fit parameters cannot compute one of the measured values, and as
    `_errors` does.
    """
    errors, stated = _errors(forward.data)
    best = _searched(forward, errors, _start(forward))
    refused = np.flatnonzero(~np.isfinite(forward.values(best.positions)[0]))
    if refused.size:
        line, load = forward.data.line[refused[0]], float(forward.data.load[refused[0]])
        allowed = f"a load that {forward.choice.model_key} can carry; widen the ranges of [fit.free], or delete the line"
        raise InputError(f"line {line}, load", show(load, "load"), allowed)
    return _scaled(name, forward, best, (errors, stated), with_profiles)


def _searched(forward: ForwardModel, errors: np.ndarray, start: np.ndarray) -> Best:
    """Return the best fit of a model.

    errors: standard errors (n,). start: positions (k,) of the k free parameters between their ends, 0 to 1, at which the search
    starts. Errors far smaller than the measured values are enlarged for the search, all by one factor, which does not move the
    minimum. Without this step, residuals would be clipped everywhere except near the minimum, and the search would find no
    slope.
    """
    sizes = {
        name: np.abs(forward.data.value[np.array(forward.data.quantity) == name]).max() for name in forward.data.quantities
    }
    share = errors / np.array([sizes[name] or 1.0 for name in forward.data.quantity])
    larger = max(1.0, _SMALL / float(share.min()))
    best = search(_residuals(forward, larger * errors), start)
    if larger == 1.0:
        return best
    if larger * np.abs(best.residuals).max() < FAR:
        return search(_residuals(forward, errors), best.positions)
    return _over(best, 1.0 / larger)


def _over(best: Best, factor: float) -> Best:
    """Return the fit for standard errors that are all multiplied by a factor."""
    return replace(best, residuals=best.residuals / factor, jacobian=best.jacobian / factor)


def _scaled(name: str, forward: ForwardModel, best: Best, given: tuple[np.ndarray, bool], with_profiles: bool) -> Fitted:
    """Return a fit with its intervals, after estimating the size of the standard errors from the scatter if that is needed.

    best: best fit with the errors in `given`, which are the standard errors (n,) and whether they are stated in the data file.
    Unstated errors are scaled to the scatter. Stated errors are enlarged only if chi square exceeds its 99 % quantile.
    with_profiles: whether likelihood profiles are computed.
    """
    from scipy.stats import chi2, f

    errors, stated = given
    freedom = len(errors) - int(best.jacobian.any(axis=0).sum())  # a parameter without effect on the model does not count
    scale = 1.0
    found = freedom > 0 and (not stated or best.chi_square > chi2.ppf(_BELIEVED, freedom))
    if found:
        scale = max(np.sqrt(best.chi_square / freedom), 1e-12)
    threshold = float(f.ppf(CONFIDENCE, 1, freedom) if found else chi2.ppf(CONFIDENCE, 1))
    best = _over(best, float(scale))
    one = Fitted(name, forward, best, errors * scale, stated, float(scale), threshold, freedom, found)
    return replace(one, profiles=tuple(profiles(one.residuals(), best, threshold))) if with_profiles else one


def refitted(fit: Fitted, forward: ForwardModel) -> Fitted:
    """Fit a model to the values in `forward`, starting from the best-fit parameters of an earlier fit; without profiles."""
    errors, stated = _errors(forward.data)
    best = _searched(forward, errors, fit.best.positions)
    return _scaled(fit.name, forward, best, (errors, stated), False)


def _errors(data: Measurements) -> tuple[np.ndarray, bool]:
    """Return the standard error of each of n measured values (n,), and whether the data state the errors.

    If any error is missing, all count as unstated. Unstated errors are equal for all values; their size is estimated later from
    the scatter. Raises InputError if an error is missing and two or more quantities were measured.
    """
    there = np.isfinite(data.error)
    if there.all():
        return data.error, True
    if len(data.quantities) > 1:
        missing = data.quantity[int(np.flatnonzero(~there)[0])]
        raise InputError(
            "--data",
            InWords(f"{missing} without errors"),
            f"a column {missing}_error, because several quantities were measured",
        )
    size = np.abs(data.value).max()
    return np.full(len(data), 0.05 * size if size > 0.0 else 1.0), False


def _start(forward: ForwardModel) -> np.ndarray:
    """Return the positions (k,) at which the search starts; 0 and 1 are the ends of a free parameter.

    The search starts at the value in the case, or at 0.5 if the case has no value between the ends.
    """
    positions = []
    for one in forward.parameters:
        value = _given(forward.plan.content, one.path)
        share = float(one.share(value)) if isinstance(value, float) and (value > 0.0 or not one.log) else 0.5
        positions.append(share if 0.0 <= share <= 1.0 else 0.5)
    return np.array(positions)


def _given(content, path):
    from stiction.case.addresses import subject_table
    from stiction.case.read import case_of

    try:
        found: Any = case_of(content).subject
    except InputError:
        return None
    for name in path[1:] if path[0] == subject_table(content) else ("",):
        found = getattr(found, name, None)
    return float(found) if isinstance(found, int | float) else None


def diagnostics(fit: Fitted) -> list[str]:
    """Return one sentence for each problem of a fit, e.g. for each free parameter that the data do not determine."""
    found = []
    groups = _indistinguishable(fit)
    for group in groups:
        names = [fit.parameters[at].name for at in group]
        unresolved = f"{names[0]} from {names[1]}" if len(names) == 2 else f"{', '.join(names[:-1])} and {names[-1]} apart"
        found.append(f"these data cannot tell {unresolved}: {_two_sets_that_fit(fit, group)} fit as well")
    entangled = {at for group in groups for at in group}
    for at, profile in enumerate(fit.profiles):
        if at not in entangled:
            found += _of_one(fit, at, profile)
    size = float(np.sqrt(np.mean(fit.forward.data.value**2)))
    if not fit.stated and fit.errors[0] > _FAR_OFF * size:
        found.append(f"the model does not fit the data: residuals are {fit.errors[0] / size:.0%} of the values")
    named = fit.forward.plan.uncertain
    if named:
        found.append(f"{', '.join(named)}: uncertain, but fixed at the nominal value; the intervals leave this uncertainty out")
    return found


def _of_one(fit: Fitted, at: int, profile: Profile) -> list[str]:
    free = fit.parameters[at]
    name = free.name
    low, high = (free.show(float(free.at(end))) for end in (profile.low, profile.high))
    if profile.open_low and profile.open_high:
        return [f"these data do not determine {name}: every value from {low} to {high} fits"]
    if profile.open_low:
        return [f"these data bound {name} only from above: every value from its low end, {low}, to {high} fits"]
    if profile.open_high:
        return [f"these data bound {name} only from below: every value from {low} to its high end, {high}, fits"]
    if min(fit.best.positions[at], 1.0 - fit.best.positions[at]) < _AT_END:
        return [f"{name} is best at the end of its range, {free.show(float(fit.values[at]))}: widen the range"]
    return [f"{name} is badly determined: its interval is {low} to {high}"] if _is_wide(fit, at) else []


def _is_wide(fit: Fitted, at: int) -> bool:
    profile, free = fit.profiles[at], fit.parameters[at]
    if profile.open_low or profile.open_high:
        return True
    low, high = (float(free.at(end)) for end in (profile.low, profile.high))
    return high > _WIDE * low if free.log else high - low > abs(float(fit.values[at]))


def _indistinguishable(fit: Fitted) -> list[list[int]]:
    """Return groups of free parameters that the data cannot determine separately, as lists of indices.

    Two parameters are in one group if each moves far within the interval of the other, as `_moves_with` defines. Groups that
    share a parameter are merged.
    """
    from scipy.sparse.csgraph import connected_components

    k = range(len(fit.parameters))
    linked = np.array([[_moves_with(fit, i, j) and _moves_with(fit, j, i) for j in k] for i in k])
    count, group = connected_components(linked, directed=False)
    return [members.tolist() for at in range(count) if len(members := np.flatnonzero(group == at)) > 1]


def _moves_with(fit: Fitted, at: int, other: int) -> bool:
    """Return whether the refitted value of free parameter `other` varies widely along the interval of free parameter `at`.

    at, other: indices of the parameters. Widely means by more than 80 % of the range of `other`, or by more than five times its
    interval with all other parameters fixed. False unless the two may compensate each other (`_is_traded`).
    """
    if at == other or not _is_traded(fit, at, other):
        return False
    alone = 2.0 * np.sqrt(fit.threshold / (fit.best.jacobian[:, other] @ fit.best.jacobian[:, other] + 12.0))
    return _span(fit, at, other) > min(_HIDES * alone, 0.8)


def _is_traded(fit: Fitted, at: int, other: int) -> bool:
    """Return whether two free parameters, given by their indices, may compensate each other.

    They may if both are badly determined. They may also compensate if the interval of either parameter reaches an end of its
    range and, along the interval of `at`, the smaller of the two changes is above a quarter of the larger.
    """
    if _is_wide(fit, at) and _is_wide(fit, other):
        return True
    if not any(fit.profiles[i].open_low or fit.profiles[i].open_high for i in (at, other)):
        return False
    rates = [_span(fit, at, i) * _size(fit, i) for i in (at, other)]
    return min(rates) > _LIKE * max(rates)


def _span(fit: Fitted, at: int, other: int) -> float:
    """Return the range of free parameter `other` along the interval of free parameter `at`, as a fraction of its full range."""
    path = fit.profiles[at].others[fit.profiles[at].rise <= fit.threshold, other]
    return float(np.ptp(path)) if path.size else 0.0


def _size(fit: Fitted, at: int) -> float:
    free = fit.parameters[at]
    return float(np.log(free.high / free.low)) if free.log else 1.0


def _two_sets_that_fit(fit: Fitted, group: Sequence[int]) -> str:
    """Return, as text, two very different sets of values of some free parameters that fit about equally well.

    group: indices of these free parameters. The sets belong to the two ends of the interval of the first one.
    """
    profile = fit.profiles[group[0]]
    inside = np.flatnonzero(profile.rise <= fit.threshold)
    ways = []
    for place in (inside[0], inside[-1]):
        values = fit.at(profile.others[place])
        ways.append(", ".join(f"{fit.parameters[at].name} = {fit.parameters[at].show(float(values[at]), 3)}" for at in group))
    return " and ".join(f"({way})" for way in ways)
