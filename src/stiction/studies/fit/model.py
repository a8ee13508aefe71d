"""Evaluate a model at the measured points, for many sets of its free parameters at once.

A free parameter is a number of the case that the fit varies between a low and a high end.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.case.free import Free
from stiction.case.measurements import Measurements
from stiction.case.swept import Address
from stiction.quantities.dimensions import arranged
from stiction.quantities.errors import InputError
from stiction.solving.candidates import choice_of
from stiction.solving.choice import Choice
from stiction.solving.pointwise import solve_batch
from stiction.studies.case_results import choice_of_case
from stiction.studies.evaluate_many import evaluate_many
from stiction.studies.fit.plan import RESISTANCE, FitPlan, middle_of

if TYPE_CHECKING:
    from stiction.case.read import Case

_SET, _ROW = "set", "row"


@dataclass(frozen=True)
class _Group:
    """Describe a group of measured values that are evaluated together.

    rows: indices of these values in the data. known: numbers of the contact that columns of the data file state, arrays (rows,)
    by address (tuple of keys). columns: indices of the free parameters on which these values depend.
    """

    rows: np.ndarray
    known: Mapping[Address, np.ndarray]
    columns: tuple[int, ...]


@dataclass(frozen=True)
class ForwardModel:
    """Hold a model with its free parameters and the measured values that the model should reproduce.

    plan: input of the fit. choice: the model with its laws. parameters: the free parameters. data: the measured values. groups:
    measured values that are evaluated together.
    """

    plan: FitPlan
    choice: Choice
    parameters: tuple[Free, ...]
    data: Measurements
    groups: tuple[_Group, ...]

    def values(self, positions: np.ndarray) -> np.ndarray:
        """Return the values of the model for the n measured values, (sets, n) in SI units; NaN where the model refuses.

        positions (sets, k): for each set, those of the k free parameters between their ends, 0 to 1.
        """
        positions = np.atleast_2d(positions)
        numbers = [one.at(positions[:, at]) for at, one in enumerate(self.parameters)]
        found = np.full((len(positions), len(self.data)), np.nan)
        for group in self.groups:
            of = {self.parameters[at].path: numbers[at] for at in group.columns}
            found[:, group.rows] = self._of_group(group, of)
        return found

    def _of_group(self, group: _Group, numbers: Mapping[Address, np.ndarray]) -> np.ndarray:
        some = self.data.some(group.rows)
        names = {result_of(name) for name in some.quantity}
        contact = {path: values for path, values in numbers.items() if path != RESISTANCE}
        tables = solved_sets(self.plan.case, self.choice, contact, group.known, some.load, sorted(names))
        resistance = numbers.get(RESISTANCE, self.plan.resistance)
        columns = [derived(tables, name, resistance)[:, at] for at, name in enumerate(some.quantity)]
        return np.column_stack(columns)


def result_of(name: str) -> str:
    """Return the name of the model result from which a measured quantity is computed: contact_area for contact_resistance.

    Every other quantity is a result of the same name.
    """
    return "contact_area" if name == "contact_resistance" else name


def derived(tables: Mapping[str, np.ndarray], name: str, resistance: Any) -> np.ndarray:
    """Return a measured quantity (sets, ...) computed from results of the model.

    tables: results (sets, ...) by name. name: name of the quantity. resistance: specific resistance of the interface [ohm m^2],
    one number or (sets,). Contact resistance is this number over the contact area (Holm 1967: resistance of a film, sigma/A),
    NaN if the area is 0. Every other quantity is returned as the model computes it.
    """
    table = tables[result_of(name)]
    if name != "contact_resistance":
        return table
    size = np.reshape(resistance, (-1, *[1] * (table.ndim - 1)))
    return np.divide(size, table, where=table > 0.0, out=np.full(table.shape, np.nan))


def solved_sets(
    case: "Case",
    choice: Choice,
    numbers: Mapping[Address, np.ndarray],
    known: Mapping[Address, np.ndarray],
    load: np.ndarray,
    keep: Sequence[str],
) -> dict[str, np.ndarray]:
    """Solve several contacts (rows) for many sets of numbers, and return results (sets, rows) by name.

    numbers: values (sets,) that differ between sets, by address (tuple of keys). known: values (rows,) that differ between
    rows, by address. load: load of each row [N] (rows,); if any is NaN, all rows are solved at the mean separation 0 instead.
    keep: names of the results. A set that the model refuses gives NaN.
    """
    from xarray import DataArray

    sets = len(next(iter(numbers.values()))) if numbers else 1
    found = {name: np.full((sets, len(load)), np.nan) for name in keep}
    arrays: dict[Address, Any] = {path: DataArray(values, dims=(_SET,)) for path, values in numbers.items()}
    arrays |= {path: float(v[0]) if (v == v[0]).all() else DataArray(v, dims=(_ROW,)) for path, v in known.items()}
    points: dict[str, Any] = {"load": DataArray(load, dims=(_ROW,))} if np.isfinite(load).all() else {"separation": 0.0}
    batches = evaluate_many(case, arrays, points, choice, keep, along=(_SET,), check_validity=False)
    for region, _, solved in batches:
        for name in keep:
            if solved is not None and name in solved.variables:
                dims, values, _ = solved.variables[name]
                found[name][region.get(_SET, slice(None))] = arranged(values, dims, (_SET, _ROW))
    return found


def forward_model(plan: FitPlan, model: str | None = None, data: Measurements | None = None) -> ForwardModel:
    """Return the model of a fit plan with its free parameters and measured values.

    model: name of a model to use instead of the one that the case names. data: some of the measured values, to use instead of
    all. Raises InputError if the model does not compute a measured quantity.
    """
    data = plan.data if data is None else data
    parameters = _parameters(plan)
    case = case_between_the_ends(plan, data)
    choice = choice_of_case(case, case.choice) if model is None else choice_of(model, {}, case.subject)
    forward = ForwardModel(plan, choice, parameters, data, _groups(data, parameters))
    _check_answers(forward, case.subject)
    return forward


def case_between_the_ends(plan: FitPlan, data: Measurements) -> "Case":
    """Return the case of a plan at the measured loads, with each free parameter in the middle of its range (`middle_of`).

    data: measured values. Where columns of the data are inputs of the contact, the values of the first row are used. If the
    data state no load, the case keeps its own loads or separations.
    """
    case = plan.case.at({**data.known[0], **middle_of(plan.free)})
    load = np.sort(data.load[np.isfinite(data.load)])
    return replace(case, load=load, separation=None) if load.size else case


def check_models(plan: FitPlan) -> None:
    """Raise InputError if the key `models` of the table [fit] has the name of an unknown model."""
    if not plan.models:
        return
    subject = case_between_the_ends(plan, plan.data).subject
    for name in plan.models:
        try:
            choice_of(name, {}, subject)
        except InputError as error:
            raise InputError("fit.models", name, error.allowed) from None


def _parameters(plan: FitPlan) -> tuple[Free, ...]:
    """Return the free parameters of a fit: each once, or once for every measured sample if samples have values of their own."""
    return tuple(
        replace(one, sample=sample) for one in plan.free for sample in (plan.data.samples if one.each_sample else [None])
    )


def _groups(data: Measurements, parameters: Sequence[Free]) -> tuple[_Group, ...]:
    """Return groups of measured values that can be solved together.

    All values of a group have the same inputs of the contact stated in columns of the data file; the numbers may differ. They
    depend on the same free parameters, and either all or none have a load.
    """
    found: dict[tuple, list[int]] = {}
    own = any(one.sample is not None for one in parameters)
    for at in range(len(data)):
        key = (tuple(sorted(data.known[at])), data.sample[at] if own else None, bool(np.isfinite(data.load[at])))
        found.setdefault(key, []).append(at)
    return tuple(
        _Group(
            np.array(rows),
            {path: np.array([data.known[at][path] for at in rows]) for path in paths},
            tuple(at for at, one in enumerate(parameters) if one.sample is None or one.sample == sample),
        )
        for (paths, sample, _), rows in found.items()
    )


def _check_answers(forward: ForwardModel, subject: Any) -> None:
    """Raise InputError if the model does not compute one of the measured quantities.

    subject: the contact of the test solution; its free parameters are in the middle of their ranges.
    """
    load = forward.data.load[np.isfinite(forward.data.load)]
    point: dict[str, Any] = {"load": float(load[0])} if load.size else {"separation": 0.0}
    known = set(solve_batch(subject, forward.choice, **point).variables)
    for name in forward.data.quantities:
        if result_of(name) not in known:
            raise InputError("model", forward.choice.model_key, f"a model that computes the measured {name}")
