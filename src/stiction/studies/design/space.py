"""Evaluate many designs at once: their objectives and their constraint violations.

A design has d choices. A choice has a position, 0 to 1, between its low and high end or along its list.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from stiction.case.read import Case, case_of, wants_ranges
from stiction.case.swept import Address
from stiction.case.uncertain import Uncertain, with_ranges
from stiction.quantities.dimensions import arranged
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.sampling import sobol_points
from stiction.quantities.shown import reason_of, show
from stiction.records.validity_warning import ValidityWarning
from stiction.solving.choice import RECOMMENDED, Choice
from stiction.solving.pointwise import REASONS, BatchResult, Region, solve_batch
from stiction.solving.problem import make_problem
from stiction.solving.yielded import YIELDED, require_states, yielded_shares
from stiction.studies.case_results import choice_of_case
from stiction.studies.design.plan import LOAD, DesignPlan, quantity_of
from stiction.studies.evaluate_many import evaluate_many, evaluate_together
from stiction.studies.prediction.many import PREDICTED, predict_many
from stiction.studies.prediction.predict import is_predicted

TOLERANCE = 1e-6  # relative constraint violation that still counts as met
_REFUSED = 1e6  # constraint violation and cost of a design that the model refuses
_DESIGN, _SAMPLE = "design", "sample"
_SURE = 0.95  # probability with which constraints hold and objectives are reached, if numbers are uncertain
_SAMPLES = 32


@dataclass(frozen=True)
class Evaluated:
    """Hold objectives, constraint violations and results of n designs.

    objectives (n, 1 or 2): costs to be minimised. excess (n, limits + 1): relative excess over each limit, 0 or below if the
    limit is met; the last column is the number of validity ranges that are violated. known: results (n,) to show, by name.
    """

    objectives: np.ndarray
    excess: np.ndarray
    known: dict[str, np.ndarray]

    @property
    def worst(self) -> np.ndarray:
        """Return the largest of the constraint violations and the number of violated validity ranges, for each design (n,)."""
        return np.maximum(self.excess, 0.0).max(axis=1, initial=0.0)

    def followed_by(self, more: "Evaluated") -> "Evaluated":
        """Return the results of these designs and of the designs in `more`, one after the other."""
        known = {name: np.concatenate([values, more.known[name]]) for name, values in self.known.items()}
        objectives, excess = np.concatenate([self.objectives, more.objectives]), np.concatenate([self.excess, more.excess])
        return Evaluated(objectives, excess, known)


@dataclass
class DesignSpace:
    """Evaluate n designs of a plan, given by the positions (n, d), 0 to 1, of their d choices; choices from lists come first.

    choice: model and laws. is_predicted: whether the prediction evaluates the designs instead. names: results to compute.
    """

    plan: DesignPlan
    case: Case = field(init=False)
    choice: Choice = field(init=False)
    names: list[str] = field(init=False)
    is_predicted: bool = field(init=False)

    def __post_init__(self):
        self.names = list(dict.fromkeys([*self.plan.quantities, "friction_coefficient"]))
        self.case = case_of(self.plan.content)
        self.is_predicted = is_predicted(self.case)
        if self.is_predicted:
            ends = ("friction_coefficient_low", "friction_coefficient_high")
            self.names = list(dict.fromkeys([*self.names, *ends]))
        if self.case.load is None and LOAD not in (one.path for one in self.plan.unknowns):
            raise InputError("solve.separation", InWords("given"), "a load, stated in [solve] or chosen in [design.choose]")
        self.choice = self._choice()

    @property
    def dimension(self) -> int:
        return len(self.plan.unknowns)

    def _choice(self) -> Choice:
        """Return the model and laws that evaluate the designs, resolved for the design in the middle of all ranges and lists.

        Raises InputError if the model, or the prediction, does not compute an objective or a limited result.
        """
        positions = np.full((1, self.dimension), 0.5)
        numbers, points = self._contacts(positions, np.arange(1))
        case = self.case.at(numbers)
        subject = case.subject
        if self.is_predicted:
            for name in self.names:
                if name not in PREDICTED and name not in subject.all_groups():
                    allowed = f"{', '.join(PREDICTED)} or a group of the contact; for others, name a model as solve.model"
                    raise InputError("design", name, allowed)
            return Choice(RECOMMENDED)
        choice = choice_of_case(case, case.choice)
        for name in set(self.names) & set(YIELDED):
            require_states(make_problem(subject, choice), name)
        solved = solve_batch(subject, choice, load=float(points["load"].values.flat[0]))
        for name in self.plan.quantities:
            if name not in solved.variables and name not in YIELDED and name not in subject.all_groups():
                raise InputError("design", name, f"a result of {choice.model_key}, or a group of the contact")
        return choice

    def _evaluated(self, numbers: Mapping, points: Mapping) -> Iterator[tuple[Region, Any, Any]]:
        """Solve designs in batches, by the chosen model or the prediction, and yield (region, case, results) of each batch.

        region: {"design": slice}. numbers: values of the choices by address (tuple of keys). points: {"load": loads}. For a
        refused design, case and results are None.
        """
        if not self.is_predicted:
            return evaluate_many(self.case, numbers, points, self.choice, self._kept, along=(_DESIGN,))
        return predict_many(self.case, numbers, points["load"], self._uncertain(list(numbers)), along=(_DESIGN,))

    def _alone(self, numbers: Mapping, points: Mapping) -> tuple[Any, Any]:
        """Return case and results of one design (see `_evaluated`); raise InputError or ArithmeticError if it is refused."""
        if not self.is_predicted:
            return evaluate_together(self.case, numbers, points, self.choice, self._kept)
        ((_, case, solved),) = self._evaluated(numbers, points)
        return case, solved

    def _uncertain(self, chosen: list[tuple[str, ...]]) -> list[Uncertain]:
        """Return the uncertain numbers of the case that the design does not set.

        Numbers with an address in `chosen`, and numbers of a material that is chosen from a list, are excluded.
        """
        replaced = [one.path for one in self.plan.options if not one.is_number]
        kept = [one for one in self.plan.uncertain if not any(one.path[: len(path)] == path for path in replaced)]
        return [one for one in kept if one.path not in chosen]

    def numbers(self, positions: np.ndarray) -> dict[Address, Any]:
        """Return the choices of one design by address in the case (tuple of keys): numbers in SI units, or list entries.

        positions (d,): of the choices, 0 to 1.
        """
        found: dict[Address, Any] = {}
        for one, share in zip(self.plan.options, positions, strict=False):
            found[one.path] = one.entries[int(one.index(share))]
        for free, share in zip(self.plan.free, positions[len(self.plan.options) :], strict=True):
            found[free.path] = float(free.at(share))
        return found

    @property
    def named(self) -> list[int]:
        """Return the indices of the choices that are made from a list of names, such as materials."""
        return [at for at, one in enumerate(self.plan.options) if not one.is_number]

    def combination(self, positions: np.ndarray) -> np.ndarray:
        """Return the combination of list entries of each of n designs, as indices (n, lists).

        positions (n, d): of the choices, 0 to 1. Lists of numbers are used only if there are no other lists.
        """
        some = self.named or range(len(self.plan.options))
        columns = [self.plan.options[at].index(positions[:, at]) for at in some]
        return np.column_stack(columns) if columns else np.zeros((len(positions), 1), dtype=int)

    def answers(self, positions: np.ndarray) -> Evaluated:
        """Return objectives, constraint violations and results of n designs; 1e6, 1e6 and NaN for a refused design.

        positions (n, d): of the choices, between their ends or along their lists, 0 to 1.
        """
        positions = np.atleast_2d(positions)
        count, limits = len(positions), len(self.plan.limits) + 1
        objectives, excess = np.full((count, len(self.plan.objectives)), _REFUSED), np.full((count, limits), _REFUSED)
        known = {name: np.full(count, np.nan) for name in self.names}
        for some in self._alike(positions):
            try:
                numbers, points = self._contacts(positions, some)
            except InputError:
                continue  # these choices together are not a valid contact
            for region, case, solved in self._taken(numbers, points):
                if solved is None or case is None:
                    continue
                rows = some[region.get(_DESIGN, slice(None))]
                part = self._judged(case.subject, solved, len(rows), points["load"].sizes.get("load", 1))
                objectives[rows], excess[rows] = part.objectives, part.excess
                for name, values in part.known.items():
                    known[name][rows] = values
        return Evaluated(objectives, excess, known)

    def _taken(self, numbers: Mapping, points: Mapping) -> Iterator[tuple[Region, Any, Any]]:
        """Yield (region, case, results) of batches of designs, as `_evaluated` does; none if all designs are refused."""
        try:
            yield from self._evaluated(numbers, points)
        except (InputError, ArithmeticError):
            return

    @property
    def _kept(self) -> list[str]:
        """Return the names of the results that the model must compute."""
        return sorted({*self.names, "mean_separation"} - set(YIELDED))

    def violations(self, positions: np.ndarray) -> list[str]:
        """Return the violated constraints and validity ranges of one design as texts; for a refused design, the reason.

        positions (d,): of the choices, 0 to 1.
        """
        try:
            numbers, points = self._contacts(positions[None, :], np.arange(1))
            case, solved = self._alone(numbers, points)
        except InputError as error:
            return [reason_of(error)]
        except ArithmeticError as error:
            return [str(error)]
        shape = _shape(case.subject, 1, points["load"].sizes.get("load", 1))
        tables = self._tables(case.subject, solved, shape)
        found = []
        for limit in self.plan.limits:
            beyond = _beyond(limit.low, limit.high, tables[limit.quantity])
            if _worst(beyond)[0] > TOLERANCE:
                value = float(tables[limit.quantity][_place_of_worst(beyond)][0])
                found.append(f"{limit.words}, but the result is {show(value, quantity_of(limit.quantity), 3)}")
        counted = _as_table(solved.validity_warnings[0], _outside(solved, self.plan.validity), shape)
        have, values = solved.validity_warnings
        bits = _as_table(have, values, shape)[_place_of_worst(counted)][0]
        return found + [words for bit, words in _validity_bits(solved, self.plan.validity).items() if bits & bit]

    def _alike(self, positions: np.ndarray) -> list[np.ndarray]:
        """Return groups of designs, as arrays of indices; in a group all lists of materials or other names have the same entry.

        Each group is sorted by the product of the free roughness numbers. If these are density N, radius R and height deviation
        sigma of asperities, the product N R sigma decides which laws apply; neighbours can then be predicted together.
        positions (n, d): of the d choices, 0 to 1.
        """
        order = np.argsort(self._product_of_roughness(positions), kind="stable")
        if not self.named:
            return [order]
        _, group = np.unique(self.combination(positions[order]), axis=0, return_inverse=True)
        return [order[group.ravel() == at] for at in range(group.max() + 1)]

    def _product_of_roughness(self, positions: np.ndarray) -> np.ndarray:
        """Return for each design (n,) the product of its free roughness numbers, by which designs are sorted."""
        product = np.ones(len(positions))
        for at, free in enumerate(self.plan.free, start=len(self.plan.options)):
            if free.path[1:-1] == ("roughness",):
                product = product * free.at(positions[:, at])
        return product

    def _contacts(self, positions: np.ndarray, some: np.ndarray) -> tuple[dict[Address, Any], dict[str, Any]]:
        """Return the chosen values of designs, with samples of uncertain numbers, and the loads as {"load": array}.

        The first dict maps addresses (tuples of keys) to arrays, or to list entries such as names of materials. positions (n,
        d): of the choices, 0 to 1. some: indices of the designs; they must have the same entry from every list of names.
        """
        from xarray import DataArray

        named: dict[Address, Any] = {}
        numbers: dict[Address, Any] = {}
        for at, one in enumerate(self.plan.options):
            index = one.index(positions[some, at])
            if one.is_number:
                numbers[one.path] = DataArray(np.array(one.entries)[index], dims=(_DESIGN,))
            else:
                named[one.path] = one.entries[int(index[0])]
        for at, free in enumerate(self.plan.free, start=len(self.plan.options)):
            numbers[free.path] = DataArray(free.at(positions[some, at]), dims=(_DESIGN,))
        for path, values in self._sampled(named, list(numbers)).items():
            numbers[path] = DataArray(values, dims=(_SAMPLE,))
        load = numbers.pop(LOAD, None)
        return named | numbers, {"load": DataArray(self.case.load, dims=("load",)) if load is None else load}

    def _sampled(self, named: Mapping[Address, Any], chosen: list[Address]) -> dict[Address, np.ndarray]:
        """Return samples (samples,) of each uncertain number that is not chosen, by address; {} for predictions.

        A prediction draws its own samples. An address is a tuple of keys of the case. named: chosen entries that are not
        numbers, such as materials, by address. chosen: addresses of chosen numbers.
        """
        if self.is_predicted:
            return {}
        kept = self._uncertain(chosen)
        if wants_ranges(self.plan.given):
            kept += [one for one in with_ranges(self.case.at(named).tables, [*chosen, *(one.path for one in kept)])]
        together = list(dict.fromkeys(one.dimension for one in kept))
        if not kept:
            return {}
        positions = sobol_points(len(together), _SAMPLES, self.plan.seed)
        return {one.path: one.at(positions[:, together.index(one.dimension)]) for one in kept}

    def _judged(self, subject: Any, solved: BatchResult, designs: int, loads: int) -> Evaluated:
        shape = _shape(subject, designs, loads)
        tables = self._tables(subject, solved, shape)
        objectives = [
            np.abs(tables[one.quantity] - target) if one.target else (-1.0 if one.maximise else 1.0) * tables[one.quantity]
            for one, target in zip(self.plan.objectives, self.plan.targets, strict=True)
        ]
        excess = [_beyond(limit.low, limit.high, tables[limit.quantity]) for limit in self.plan.limits]
        excess.append(_as_table(solved.validity_warnings[0], _outside(solved, self.plan.validity), shape))
        return Evaluated(
            np.column_stack([_worst(one) for one in objectives]),
            np.column_stack([_worst(one) for one in excess]),
            self._shown(tables, objectives, excess),
        )

    def _tables(self, subject: Any, solved: BatchResult, shape: tuple[int, int, int]) -> dict[str, np.ndarray]:
        """Return, by name, each result that the plan needs, as an array (designs, samples, loads) of the given shape."""
        groups = subject.all_groups()
        return {name: self._table(name, solved, groups, shape, subject) for name in self.names}

    def _shown(self, tables: Mapping, objectives: list[np.ndarray], excess: list[np.ndarray]) -> dict[str, np.ndarray]:
        """Return one value per design of each result, for display, as arrays (designs,) by name.

        A result with an objective or a limit is shown at its worst sample and load, any other as its median over both.
        objectives: costs. excess: violations of the limits. Both are lists of arrays (designs, samples, loads), in the order of
        the plan.
        """
        found = {name: np.median(table.reshape(len(table), -1), axis=1) for name, table in tables.items()}
        names = [*(one.quantity for one in self.plan.limits), *(one.quantity for one in self.plan.objectives)]
        for name, worst in zip(names, [*excess[: len(self.plan.limits)], *objectives], strict=True):
            rows, sample, load = _place_of_worst(worst)
            found[name] = tables[name][rows, sample, load]
        return found

    def _table(self, name: str, solved: BatchResult, groups: Mapping, shape: tuple[int, int, int], subject: Any) -> np.ndarray:
        """Return one result, or dimensionless group of the contact, as an array (designs, samples, loads); NaN if unknown."""
        if name in solved.variables:
            dims, values, _ = solved.variables[name]
            return _as_table(dims, values, shape)
        if name in YIELDED:
            return self._yielded(name, solved, shape, subject)
        value = groups[name] if name in groups else subject.known(name)
        if value is None:
            return np.full(shape, np.nan)
        return _as_table(getattr(value, "dims", ()), np.asarray(value, dtype=float), shape)

    def _yielded(self, name: str, solved: BatchResult, shape: tuple[int, int, int], subject: Any) -> np.ndarray:
        problem = make_problem(subject, self.choice)
        dims, separation, _ = solved.variables["mean_separation"]
        sigma = problem.subject.scales().separation
        over = _as_table(dims, separation, shape) / _as_table(getattr(sigma, "dims", ()), np.asarray(sigma, dtype=float), shape)
        axes = [(_DESIGN, _SAMPLE).index(dim) for dim in problem.dims]
        order = axes + [at for at in range(3) if at not in axes]
        turned = over.transpose(order)
        rows = np.nan_to_num(turned.reshape(len(problem.groups), -1))
        found = yielded_shares(problem, rows, name).reshape(turned.shape).transpose(np.argsort(order))
        return np.where(np.isfinite(over), found, np.nan)


def _shape(subject: Any, designs: int, loads: int) -> tuple[int, int, int]:
    """Return (designs, samples, loads); the number of samples is read from the arrays of the contact, 1 without samples."""
    samples = next((array.sizes[_SAMPLE] for _, array in subject.arrays() if _SAMPLE in array.dims), 1)
    return designs, samples, loads


def _as_table(dims: Any, values: np.ndarray, shape: tuple[int, int, int]) -> np.ndarray:
    return np.broadcast_to(arranged(values, dims, (_DESIGN, _SAMPLE, "load")), shape)


def _beyond(low: float, high: float, table: np.ndarray) -> np.ndarray:
    """Return how far results lie beyond the limits `low` and `high`, relative to the limit; 0 or below between the limits."""
    over = (table - high) / (abs(high) or 1.0) if np.isfinite(high) else np.full(table.shape, -np.inf)
    under = (low - table) / (abs(low) or 1.0) if np.isfinite(low) else np.full(table.shape, -np.inf)
    return np.maximum(over, under)


def _outside(solved: BatchResult, validity: str) -> np.ndarray:
    """Return the number of violated validity ranges of each contact and load; validity: which ranges count, as in [design]."""
    bits = solved.validity_warnings[1]
    return np.sum([(bits & bit) > 0 for bit in _validity_bits(solved, validity)], axis=0).astype(float)


def _validity_bits(solved: BatchResult, validity: str) -> dict[np.uint32, str]:
    """Return the bits of `validity_warnings` that count as violations, each with its text.

    validity: "claimed" counts all ranges except those about statistics, "possible" only those that make a result impossible,
    and "any" allows any violation. The bits of refused contacts always count.
    """
    found = {np.uint32(1 << at): why for at, why in enumerate(REASONS)}
    for at, rule in enumerate(solved.rules, start=len(REASONS)):
        if rule.kind == "impossible" if validity == "possible" else validity == "claimed" and rule.kind != "statistics":
            found[np.uint32(1 << at)] = ValidityWarning(rule.why, rule.quantity, low=rule.low, high=rule.high).rule
    return found


def _worst(table: np.ndarray) -> np.ndarray:
    """Return the worst value of each design (designs,): the 95 % quantile over samples of the largest value over loads.

    table (designs, samples, loads): costs or violations, higher is worse; NaN and infinity count as 1e6.
    """
    return np.maximum(_refused_as_far(table)[_place_of_worst(table)], -_REFUSED)


def _place_of_worst(table: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return three index arrays (designs,): design, sample and load of the value that `_worst` selects for each design."""
    numbers = _refused_as_far(table)
    rows, loads = np.arange(len(table)), numbers.argmax(axis=2)
    order = np.argsort(numbers.max(axis=2), axis=1, kind="stable")
    sample = order[:, int(np.ceil(_SURE * (table.shape[1] - 1)))]
    return rows, sample, loads[rows, sample]


def _refused_as_far(table: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(table) | (table == -np.inf), table, _REFUSED)
