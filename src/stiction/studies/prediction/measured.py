"""Predictions updated by measured friction: samples are weighted by their agreement with it."""

from dataclasses import dataclass
from os import PathLike

import numpy as np

from stiction.case.measurements import Measurements, read_measurements
from stiction.case.read import Case
from stiction.quantities.errors import InputError

__all__ = ["Measured", "chosen_draws", "read_measured"]

# Relative standard error of a measured coefficient whose error is not stated: that of the values among themselves where they
# are three or more, and at least the first; else the second. Judgements (grade C).
_LEAST_ERROR, _USUAL_ERROR = 0.05, 0.15
_FEW = 50.0  # draws that count at least, for an interval


@dataclass(frozen=True)
class Measured:
    """Measured friction coefficients (k,) at loads [N], with the standard errors of their logarithms."""

    load: np.ndarray
    log_mu: np.ndarray
    error: np.ndarray


def read_measured(path: str | PathLike, case: Case) -> Measured:
    """Read measured friction from a CSV file, as `stiction fit` takes it. Raises InputError, also for other quantities."""
    found: Measurements = read_measurements(path, case.tables)
    others = set(found.quantity) - {"friction_coefficient", "friction_force"}
    if others:
        raise InputError(
            "--data",
            ", ".join(sorted(others)),
            "friction_coefficient or friction_force unless a model is named",
            "name one as solve.model",
        )
    if any(found.known):
        raise InputError(
            "--data", "numbers of the contact", "no numbers of the contact unless a model is named", "name one as solve.model"
        )
    force = np.array([one == "friction_force" for one in found.quantity])
    mu = np.where(force, found.value / found.load, found.value)
    if not (mu > 0.0).all():
        raise InputError("--data", float(mu.min()), "measured friction above 0")
    relative = np.where(force, found.error / found.load, found.error) / mu
    spread = np.std(np.log(mu), ddof=1) if len(mu) >= 3 else _USUAL_ERROR
    return Measured(found.load, np.log(mu), np.where(np.isfinite(relative), relative, max(spread, _LEAST_ERROR)))


def chosen_draws(measured: Measured, mu: np.ndarray, count: int) -> tuple[np.ndarray, list[str]]:
    """Return rows of the draws, each as often as it counts, and warnings.

    Parameters
    ----------
    measured : Measured
        k values.
    mu : numpy.ndarray, shape (n, k)
        Predicted friction at the loads of the values.
    count : int
        Number of rows that are returned.

    Notes
    -----
    A draw counts by its likelihood, exp(-chi^2/2), of values with independent lognormal errors. Where fewer than _FEW draws
    would count, as by chance or as no draw is near, errors are taken so much larger that these do: an interval of one draw has
    no width. Rows are resampled systematically in the order of mu, so that its quantiles scatter least (Kitagawa 1996).
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        squares = ((np.log(mu) - measured.log_mu) / measured.error) ** 2
    chi = np.where(np.isfinite(squares).all(axis=1), squares.sum(axis=1), np.inf)
    larger = 1.0
    while _counting(_weights(chi, larger)) < min(_FEW, np.isfinite(chi).sum()):
        larger *= 1.1
    weights = _weights(chi, larger)
    order = np.argsort(mu[:, 0], kind="stable")  # the draws are an even sequence, which even steps along it would not be
    rows = order[np.minimum(np.searchsorted(np.cumsum(weights[order]), (np.arange(count) + 0.5) / count), len(order) - 1)]
    if chi.min() / len(measured.log_mu) > 9.0:
        return rows, ["The measured friction is beyond what the stated contact allows: check the interface and the inputs."]
    text = f"Few draws meet the measured friction: its errors are taken {larger:.2g} times larger. Check the inputs."
    return rows, [text] if larger > 1.0 else []


def _weights(chi: np.ndarray, larger: float) -> np.ndarray:
    weights = np.exp(-0.5 * (chi - chi.min()) / larger**2)
    return weights / weights.sum()


def _counting(weights: np.ndarray) -> float:
    """Return the number of draws that count: of as many with the same weight a mean scatters as much (Kish 1965)."""
    return float(1.0 / np.sum(weights**2))
