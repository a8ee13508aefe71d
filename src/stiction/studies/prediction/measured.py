"""Update predictions by measured friction: samples are weighted by their likelihood."""

from dataclasses import dataclass
from os import PathLike

import numpy as np

from stiction.case.measurements import Measurements, read_measurements
from stiction.case.read import Case
from stiction.quantities.errors import InputError, InWords

# Relative standard error of a measured coefficient whose error is not stated: the scatter of three or more values, but at least
# _LEAST_ERROR; USUAL_ERROR for fewer values. Judgements (grade C).
_LEAST_ERROR, USUAL_ERROR = 0.05, 0.15
_ENOUGH = 3  # number of values from which their scatter gives their error
CONTRADICTS = "The measured friction contradicts the stated contact: do not use this mu; check interface and roughness."
# Fraction of the samples beyond the measured friction below which it contradicts the contact, or is outside its 90 % interval.
_IMPOSSIBLE, _OUTSIDE = 0.005, 0.05
_DISAGREES = 2.0  # enlargement of the errors above which the measured friction contradicts the contact
_FEW = 50.0  # smallest effective number of samples behind an interval


@dataclass(frozen=True)
class Measured:
    """Store k measured friction coefficients as natural logarithms, with loads [N] and standard errors of the logarithms.

    Each array has the shape (k,). assumed: text that explains how missing errors were estimated; "" if the file states all
    errors. freedom: degrees of freedom of the errors: k - 1 if the scatter of the values gives all of them, otherwise infinite.
    """

    load: np.ndarray
    log_mu: np.ndarray
    error: np.ndarray
    assumed: str = ""
    freedom: float = np.inf


def read_measured(path: str | PathLike, case: Case) -> Measured:
    """Return measured friction coefficients from a CSV file with the columns of `stiction fit`.

    case: the case that the values belong to. A measured friction force is divided by its load. Errors that the file does not
    state are estimated from the scatter of three or more values, but are at least 5 %; with fewer values they are 15 %. Raises
    InputError for a file that cannot be read, other measured quantities, columns with numbers of the contact, and friction that
    is not above 0.
    """
    series: Measurements = read_measurements(path, case.tables)
    others = set(series.quantity) - {"friction_coefficient", "friction_force"}
    if others:
        raise InputError(
            "--data",
            ", ".join(sorted(others)),
            "friction_coefficient or friction_force",
            "for other quantities, name a model as solve.model",
        )
    if any(series.known):
        raise InputError(
            "--data",
            InWords("numbers of the contact"),
            "no columns with numbers of the contact",
            "for such columns, name a model as solve.model",
        )
    force = np.array([quantity == "friction_force" for quantity in series.quantity])
    mu = np.where(force, series.value / series.load, series.value)
    if not (mu > 0.0).all():
        raise InputError("--data", float(mu.min()), "measured friction above 0")
    relative = np.where(force, series.error / series.load, series.error) / mu
    enough = len(mu) >= _ENOUGH
    spread = max(float(np.std(np.log(mu), ddof=1)), _LEAST_ERROR) if enough else USUAL_ERROR
    assumed = ""
    if not np.isfinite(relative).all():
        why = f"from the scatter of {len(mu)} values" if enough else "assumed: the file states none"
        assumed = f"{spread:.0%} of each value, {why}; the interval is of the mean mu"
    freedom = len(mu) - 1.0 if enough and np.isnan(relative).all() else np.inf
    return Measured(series.load, np.log(mu), np.where(np.isfinite(relative), relative, spread), assumed, freedom)


def interval_after_measuring(mu: np.ndarray, level: float) -> list[float]:
    """Return the interval [low, high] of mu expected after one measurement that gives the present median.

    mu: samples (n,) of friction at one load, NaN where impossible. level: coverage probability. The measurement has a standard
    error of 15 %. The list is empty if no sample is finite and above 0.
    """
    known = mu[np.isfinite(mu) & (mu > 0.0)]
    if not known.size:
        return []
    measurement = Measured(np.ones(1), np.log([np.median(known)]), np.array([USUAL_ERROR]))
    rows, _ = chosen_draws(measurement, known[:, None], known.size)
    return np.quantile(known[rows], [0.5 - 0.5 * level, 0.5 + 0.5 * level]).tolist()


def chosen_draws(measured: Measured, mu: np.ndarray, count: int) -> tuple[np.ndarray, list[str]]:
    """Return indices (count,) of samples, repeated in proportion to their likelihood, and a list of at most one warning.

    Parameters
    ----------
    measured : Measured
        k measured friction coefficients.
    mu : numpy.ndarray, shape (n, k)
        Predicted friction coefficient of each of n samples at the loads of the measured values; NaN where impossible.
    count : int
        Number of indices to return.

    Notes
    -----
    The likelihood of a sample is exp(-chi^2/2), for measured values with independent log-normal errors. If the errors are
    estimated from the scatter of k values, it is Student's with k - 1 degrees of freedom, (1 + chi^2/(k - 1))^(-k/2), with
    chi^2 reduced by its smallest value over all samples (Gelman et al. 2013, Bayesian Data Analysis, section 3.2). An
    impossible sample has the likelihood 0. If the effective number of samples is below 50, or below the number of possible
    samples if there are fewer, all errors are enlarged until it is reached, because a few samples give no reliable interval.
    Systematic resampling in the order of mu minimises the scatter of its quantiles (Kitagawa 1996).
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        squares = ((np.log(mu) - measured.log_mu) / measured.error) ** 2
    chi = np.where(np.isfinite(squares).all(axis=1), squares.sum(axis=1), np.inf)
    larger = 1.0
    deviance = chi - chi.min()
    if np.isfinite(measured.freedom):
        deviance = (measured.freedom + 1.0) * np.log1p(deviance / measured.freedom)
    while _effective_count(_weights(deviance, larger)) < min(_FEW, np.isfinite(chi).sum()):
        larger *= 1.1
    weights = _weights(deviance, larger)
    order = np.argsort(mu[:, 0], kind="stable")  # even steps along a Sobol sequence would favour some of its regions
    rows = order[np.minimum(np.searchsorted(np.cumsum(weights[order]), (np.arange(count) + 0.5) / count), len(order) - 1)]
    below = np.mean(np.log(mu[np.isfinite(squares).all(axis=1)]) < measured.log_mu, axis=0)
    tail = float(np.median(np.minimum(below, 1.0 - below)))
    if chi.min() / len(measured.log_mu) > 9.0 or larger > _DISAGREES or tail < _IMPOSSIBLE:
        return rows, [CONTRADICTS]
    if tail < _OUTSIDE:
        return rows, ["The measured friction lies outside the interval predicted without it: check interface and roughness."]
    text = f"Few samples agree with the measured friction: its errors are enlarged {larger:.2g} times. Check the inputs."
    return rows, [text] if larger > 1.0 else []


def _weights(deviance: np.ndarray, larger: float) -> np.ndarray:
    weights = np.exp(-0.5 * deviance / larger**2)
    return weights / weights.sum()


def _effective_count(weights: np.ndarray) -> float:
    """Return the effective number of samples for weights whose sum is 1 (Kish 1965)."""
    return float(1.0 / np.sum(weights**2))
