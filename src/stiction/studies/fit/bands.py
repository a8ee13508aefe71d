"""Predict with a fitted model, with 95 % intervals from the uncertainty of its free parameters.

A free parameter is a number of the case that the fit varies. Its position is 0 at its low end and 1 at its high end.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from stiction.case.free import Free
from stiction.case.swept import Address
from stiction.quantities.dimensions import arranged
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.sampling import sobol_points
from stiction.solving.pointwise import BatchResult
from stiction.studies.evaluate_many import evaluate_together
from stiction.studies.fit.answer import Fitted
from stiction.studies.fit.model import derived, result_of
from stiction.studies.fit.plan import RESISTANCE, FitPlan
from stiction.studies.fit.search import CONFIDENCE, finite

_DRAWS, _TRIED = 1024, 4096  # posterior samples, and proposals from which they are chosen
_AT_ONCE = 256  # proposals evaluated in one batch
_MOST = 50_000  # predicted points in one batch
_MOST_PREDICTED = 20_000  # largest number of points, each predicted for all samples
_SET = "set"


@dataclass(frozen=True)
class Bands:
    """Store the predictions of a fitted model for each measured quantity; the pull-off force only if it is the only one.

    tables: by name of the quantity, (dimensions, best values, low and high ends of the 95 % interval) in SI units. coords:
    coordinates of the dimensions. sample: name of the measured sample that is predicted, if samples have free parameters of
    their own. effective: effective number of posterior samples behind the intervals.
    """

    tables: dict[str, tuple[tuple[str, ...], np.ndarray, np.ndarray, np.ndarray]]
    coords: dict[str, Any]
    sample: str | None
    effective: float


def draws_of(fit: Fitted, seed: int = 1) -> tuple[np.ndarray, float]:
    """Return posterior samples (m, k) of the k free parameters, and the effective number of samples.

    A sample holds the position of each parameter between its ends, 0 to 1. Method: importance sampling with Sobol points. The
    proposal mixes a wide Student's t distribution about the best fit with a uniform distribution.
    """
    k = len(fit.parameters)
    points = sobol_points(k + 1, _TRIED, seed)
    root = np.linalg.cholesky(fit.best.bounded) * 1.5
    narrow = points[:, -1] < 0.75
    inner = fit.best.positions + _student(np.clip(points[:, :k], 1e-9, 1.0 - 1e-9)) @ root.T
    sets = np.where(narrow[:, None], inner, points[:, :k])
    sets = sets[((sets >= 0.0) & (sets <= 1.0)).all(axis=1)]
    residuals = fit.residuals()
    parts = [finite(residuals(sets[at : at + _AT_ONCE])) for at in range(0, len(sets), _AT_ONCE)]
    rise = (np.concatenate(parts) ** 2).sum(axis=1) - fit.best.chi_square
    density = 0.75 * _density(np.linalg.solve(root, (sets - fit.best.positions).T).T, root) + 0.25
    weights = np.exp(fit.log_likelihood(rise)) / density
    weights /= weights.sum()
    effective = float(1.0 / (weights**2).sum())
    at = (np.arange(_DRAWS) + 0.5) / _DRAWS
    mixed = np.random.default_rng(seed).permutation(len(sets))  # every eighth Sobol point lies in the same octant
    chosen = np.searchsorted(np.cumsum(weights[mixed]), at, side="right")
    return sets[mixed[np.minimum(chosen, len(sets) - 1)]], effective


_DEGREES = 4.0  # degrees of freedom of Student's t, so that its tails are wider than the tails of the likelihood


def _student(uniform: np.ndarray) -> np.ndarray:
    from scipy.stats import t

    return t.ppf(uniform, _DEGREES)


def _density(standard: np.ndarray, root: np.ndarray) -> np.ndarray:
    from scipy.stats import t

    return np.exp(t.logpdf(standard, _DEGREES).sum(axis=1)) / abs(np.linalg.det(root))


def predicted(plan: FitPlan, fit: Fitted) -> Bands:
    """Predict the measured quantities at the loads or separations of [solve], with 95 % bands, and return `Bands`.

    Numbers of the table [fit.predict] replace those of the case. If samples have free parameters of their own, the first sample
    is predicted. Raises InputError if the contact cannot be solved.
    """
    sample = plan.data.samples[0] if any(x.sample is not None for x in fit.parameters) else None
    columns = [at for at, x in enumerate(fit.parameters) if x.sample in (None, sample)]
    sets, effective = draws_of(fit)
    sets = np.concatenate([fit.best.positions[None, :], sets])[:, columns]
    named = [fit.parameters[at] for at in columns]
    arrays = _predicted_numbers(plan)
    names = [name for name in plan.data.quantities if name != "pull_off_force"] or list(plan.data.quantities)
    found: dict[str, list[np.ndarray]] = {name: [] for name in names}
    dims: dict[str, tuple[str, ...]] = {}
    at, step = 0, 1
    while at < len(sets):
        numbers = _numbers(named, sets[at : at + step], {path for path in arrays})
        solved, coords = _solved(plan, fit, arrays, numbers, names)
        for name in names:
            dims[name], values = _of(solved, name, numbers.get(RESISTANCE, plan.resistance), len(sets[at : at + step]))
            found[name].append(values)
        at += step
        step = max(1, min(128, _MOST // values[0].size))
    tail = 0.5 * (1.0 - CONFIDENCE)
    tables = {}
    for name, parts in found.items():
        values = np.concatenate(parts)
        low, high = np.nanquantile(values[1:], [tail, 1.0 - tail], axis=0) if np.isfinite(values).any() else values[:2]
        tables[name] = (dims[name], values[0], low, high)
    return Bands(tables, coords, sample, effective)


def check_predicted(plan: FitPlan) -> None:
    """Raise InputError if [fit.predict] names something that is not a number of the contact, or contains too many points."""
    arrays = _predicted_numbers(plan)
    solve = plan.content.get("solve", {})
    given = (solve.get("load") or solve.get("separation")) if isinstance(solve, Mapping) else None
    points = given.get("count", 1) if isinstance(given, Mapping) else len(given) if isinstance(given, list) else 1
    sizes = {dim: size for array in arrays.values() for dim, size in getattr(array, "sizes", {}).items()}
    count = math.prod(sizes.values()) * (points if isinstance(points, int) else 1)
    if count > _MOST_PREDICTED:
        raise InputError("fit.predict", InWords(f"{count} points with the points of [solve]"), f"{_MOST_PREDICTED} at most")


def _predicted_numbers(plan: FitPlan) -> dict[Address, Any]:
    """Return the numbers of the table [fit.predict] by address (tuple of keys), in SI units.

    Lists and ranges become labelled arrays (xarray).
    """
    from stiction.case.addresses import address_of, leaves_of
    from stiction.case.swept import number_of, swept_numbers

    arrays: dict[Address, Any] = {}
    leaf = {"start", "stop", "values", "along", "count"}
    for name, entry in leaves_of(plan.predict, "fit.predict", lambda table: bool(table.keys() & leaf)):
        where = f"fit.predict.{name}"
        path = address_of(name, plan.content, where)
        if isinstance(entry, list | Mapping):
            nested: Any = entry
            for key in reversed(path):
                nested = {key: nested}
            try:
                one = swept_numbers(nested)[path]
            except InputError as error:
                raise InputError(error.field.replace(path[0], "fit.predict", 1), error.value, error.allowed) from None
            arrays[path] = one.array(one.numbers())
        else:
            arrays[path] = number_of(entry, path[-1], where)
    return arrays


def _numbers(named: list[Free], sets: np.ndarray, taken: set[Address]) -> dict[Address, Any]:
    """Return the values (sets,) of free parameters, in SI units by address (tuple of keys), except for some addresses.

    named: the free parameters. sets (sets, k): positions of the k free parameters between their ends, 0 to 1. taken: the
    addresses that are left out, because [fit.predict] sets these numbers.
    """
    return {x.path: x.at(sets[:, at]) for at, x in enumerate(named) if x.path not in taken}


def _solved(plan, one, arrays, numbers, names) -> tuple[BatchResult, dict[str, Any]]:
    import xarray

    along = {path: xarray.DataArray(v, dims=(_SET,)) for path, v in numbers.items() if path != RESISTANCE}
    together, keep = {**plan.data.known[0], **along, **arrays}, [*map(result_of, names), "load"]
    case, solved = evaluate_together(plan.case, together, None, one.forward.choice, keep)
    coords = {}
    for array in arrays.values():
        for name, value in getattr(array, "coords", {}).items():
            coords[str(name)] = (value.dims, value.values, dict(value.attrs))
    point = ("load", case.load) if case.load is not None else ("mean_separation", case.separation)
    if not hasattr(point[1], "dims"):
        coords[point[0]] = ((point[0],), np.asarray(point[1], dtype=float), case.subject.attributes(point[0]))
    return solved, coords


def _of(solved: BatchResult, name: str, resistance: Any, sets: int) -> tuple[tuple[str, ...], np.ndarray]:
    """Return the model's values of a measured quantity: dimensions, and values (sets, *dimensions) in SI units.

    name: name of the quantity. resistance: specific contact resistance [ohm m^2], one number or (sets,). sets: number of sets
    of free parameters.
    """
    result = result_of(name)
    dims, values, _ = solved.variables[result]
    others = tuple(dim for dim in dims if dim != _SET)
    table = arranged(values, dims, (_SET, *others))
    return others, derived({result: np.broadcast_to(table, (sets, *table.shape[1:]))}, name, resistance)
