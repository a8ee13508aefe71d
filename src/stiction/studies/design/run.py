"""Search the coating, roughness, materials and load that best meet an objective within constraints.

A search describes a design by one position for each choice: 0 to 1 from the low to the high end of a number, or along a list.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.case.read import tables_of
from stiction.quantities.inputs import require_callable
from stiction.studies.design.designed import dataset_of, designed_case
from stiction.studies.design.plan import DesignPlan, make_design_plan
from stiction.studies.design.space import TOLERANCE, DesignSpace, Evaluated
from stiction.studies.design.work import (
    FEW,
    FRONT,
    REFINED,
    TOGETHER,
    WAYS,
    first_designs,
    front_generations,
    front_rounds,
    most_designs,
    population,
    refinements,
)

if TYPE_CHECKING:
    import xarray

    from stiction.case.arguments import CaseFile

# Called with the number of evaluated designs, and a text on how many there will be at most and how long they take.
Callback = Callable[[int, str], None]
# Standard deviation of the steps from a Pareto front in the first round (positions, 0 to 1); factor from round to round.
_FIRST_STEP, _SHRUNK = 0.3, 0.6
_ALIKE = 1e-10  # relative scatter of the costs of a population at which a search ends
_QUIET, _QUIET_OF_DRAWS = 8, 4  # generations without gain after which a search ends, for a model and for a prediction
_GAIN, _GAIN_OF_DRAWS = 1e-9, 1e-2  # smallest gain relative to the cost, for a model and for a prediction
_MET = 1e-3  # relative distance from a target at which a search ends; a prediction is known to two digits only
_BEYOND_ALL = 1e100  # cost of a design that violates a constraint: more than any objective


@dataclass
class DesignSearch:
    """Hold the state of a design search: its plan, the evaluator of designs, and all designs evaluated so far.

    positions (n, d): for n designs with d choices, the position of each choice, 0 to 1, between its ends or along its list.
    answers: results of these designs. started: time.monotonic() at the start of the search [s]. stopped: whether the user
    interrupted it.
    """

    plan: DesignPlan
    space: DesignSpace
    positions: np.ndarray
    answers: Evaluated
    started: float
    stopped: bool = False

    def evaluate(self, positions: np.ndarray, callback: Callback) -> Evaluated:
        """Evaluate m more designs, append them to the evaluated ones, and return their results.

        positions (m, d): of the d choices, 0 to 1. callback: called with the number of designs evaluated so far and the text
        `work_left`.
        """
        answers = self.space.answers(positions)
        self.positions = np.concatenate([self.positions, positions])
        self.answers = self.answers.followed_by(answers)
        callback(len(self.positions), self.work_left)
        return answers

    @cached_property
    def most(self) -> int:
        """Return the largest number of designs that the search may evaluate."""
        return most_designs(self.space)

    @property
    def work_left(self) -> str:
        """Return a text such as "of at most 4000, at most 5 min left".

        The number is the largest number of designs in the whole search. The time is omitted up to 90 s.
        """
        count = len(self.positions)
        seconds = (time.monotonic() - self.started) / count * max(self.most - count, 0)
        minutes = f", at most {seconds / 60.0:.0f} min left" if seconds > 90.0 else ""
        return f"of at most {self.most}{minutes}"

    def best(self, number: int = 0) -> np.ndarray:
        """Return the index of the best design for each combination of list entries, the best of all first.

        The indices refer to all designs evaluated so far; combinations are those of `DesignSpace.combination`. number: index of
        the objective that decides. Designs that violate a constraint rank after all others, by the size of their violation.
        """
        order = np.lexsort((self.answers.objectives[:, number], np.maximum(self.answers.worst - TOLERANCE, 0.0)))
        _, first = np.unique(self.space.combination(self.positions[order]), axis=0, return_index=True)
        return order[np.sort(first)]

    def front(self) -> np.ndarray:
        """Return the indices of the designs on the Pareto front, among all designs evaluated so far.

        Designs that violate a constraint are excluded.
        """
        return _front(self.answers.objectives, self.answers.worst)

    def data(self) -> "xarray.Dataset":
        return dataset_of(self)

    def case_text(self, out: Path) -> str:
        """Return the text of a case file with the best design; `out` is the folder to which the file will be written."""
        return designed_case(self, out)


def design(case: "CaseFile", *, callback: Callback = lambda count, text: None) -> "xarray.Dataset":
    """Search the coating, roughness, materials and load that best meet an objective within constraints.

    Parameters
    ----------
    case : path, or dict like a case file
        Case with a table [design], which states the objective, the choices and the constraints.
    callback : callable
        Called with the number of evaluated designs and a text. The text states the largest number of designs, and the longest
        remaining time if it exceeds 90 s.

    Returns
    -------
    xarray.Dataset
        Over `design` the best design of each combination of listed choices, the best of all first: chosen numbers in SI units,
        results with an objective or a limit, `feasible` (all constraints met), `violated` (the violated constraints as text,
        one a line) and `constraint_violation` (relative). With two objectives, variables whose names begin with `pareto_`
        describe the Pareto front, over `pareto`. Variables whose names begin with `evaluated_` describe all evaluated designs,
        over `evaluated`, in order of evaluation; `best_so_far` is the lowest cost of a feasible design so far: the first
        objective, negative if it is maximised, or its distance from the target.

    Raises
    ------
    InputError
        The table [design] is missing or wrong.

    Examples
    --------
    >>> import stiction as st
    >>> contact = {
    ...     "first": "gold", "second": "gold", "nominal_area": "1 mm^2", "interfacial_shear_strength": "50 MPa",
    ...     "roughness": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
    ... }
    >>> radius = {"roughness": {"asperity_radius": {"low": "10 um", "high": "100 um"}}}
    >>> task = {"objective": {"minimise": "friction_coefficient"}, "choose": radius, "validity": "any"}
    >>> best = st.design({"contact": contact, "solve": {"load": "1 N", "model": "persson_2001"}, "design": task})
    >>> best.sizes["design"]
    1
    """
    require_callable(callback, "callback")
    return run_design(plan_of_design(case), callback, keep_on_interrupt=False).data()


def plan_of_design(case: Any) -> DesignPlan:
    """Return the checked plan of a design search from the path of a case file or a dict of its tables. Raises InputError."""
    return make_design_plan(*tables_of(case))


def run_design(plan: DesignPlan, callback: Callback, keep_on_interrupt: bool = True) -> DesignSearch:
    """Run the design search of a plan and return its final state.

    callback: called with the number of designs evaluated so far and a text. keep_on_interrupt: whether an interruption (Ctrl-C)
    after the first designs returns the state reached; otherwise KeyboardInterrupt is raised.
    """
    started, space = time.monotonic(), DesignSpace(plan)
    drawn = first_designs(space)
    found = DesignSearch(plan, space, drawn, space.answers(drawn), started)
    try:
        callback(len(drawn), found.work_left)
        if len(plan.objectives) == 2 and found.space.is_predicted:
            _evolve_front(found, callback)
            return found
        for number in range(len(plan.objectives)):
            _search_objective(found, number, None, callback)
            _refine_best(found, number, callback)
        if len(plan.objectives) == 2:
            _search_front(found, callback)
    except KeyboardInterrupt:
        if not keep_on_interrupt:
            raise
        found.stopped = True
    return found


def _search_objective(search: DesignSearch, number: int, ceiling: float | None, callback: Callback) -> None:
    """Search designs for one objective by differential evolution (Storn & Price 1997), and add them to `search`.

    number: index of the objective. ceiling: upper bound of the other objective, or None. Designs that meet all constraints rank
    before all others (Deb 2000). The search runs once for each of the best combinations of list entries, and starts from the
    best designs evaluated so far.
    """
    if not search.plan.free:
        return  # the first designs are all combinations of list entries
    from scipy.optimize import differential_evolution

    rng = np.random.default_rng([search.plan.seed, len(search.positions)])
    for members in _seeds(search, number, ceiling, rng):
        ends = np.tile([0.0, 1.0], (members.shape[1], 1))
        ends[search.space.named] = members[0, search.space.named, None]
        differential_evolution(
            lambda positions: _cost(search, number, ceiling, positions.T, callback),
            ends,
            strategy="randtobest1bin",
            maxiter=search.plan.effort if ceiling is None else front_generations(search.space),
            tol=_ALIKE,
            mutation=(0.4, 0.9),
            recombination=0.8,
            rng=rng,
            callback=_ends(search, number),
            polish=False,
            init=members,
            updating="deferred",
            vectorized=True,
        )


def _ends(search: DesignSearch, number: int) -> "_StopWithoutGain":
    """Return the rule that stops the search for the objective with index `number`."""
    if not search.space.is_predicted:
        return _StopWithoutGain(_GAIN, _QUIET)
    met = _MET * abs(search.plan.targets[number]) if search.plan.objectives[number].target else -np.inf
    return _StopWithoutGain(_GAIN_OF_DRAWS, _QUIET_OF_DRAWS, met)


@dataclass
class _StopWithoutGain:
    """Stop differential evolution when its designs no longer improve; scipy calls this rule after each generation.

    The search stops after more than `most` generations in a row in which no member of the population improved, or when the
    lowest cost is at most `met`. least: smallest improvement that counts, relative to the cost. costs: sorted costs of the last
    generation. generations: number of generations since the last improvement.
    """

    least: float
    most: int
    met: float = -np.inf
    costs: Any = np.inf
    generations: int = 0

    def __call__(self, intermediate_result: Any) -> bool:
        now = np.sort(intermediate_result.population_energies)
        gain = (now < self.costs - self.least * np.abs(now)).any()
        self.costs, self.generations = now, 0 if gain else self.generations + 1
        return bool(self.generations > self.most or now[0] <= self.met)


def _cost(search: DesignSearch, number: int, ceiling: float | None, positions: np.ndarray, callback: Callback) -> np.ndarray:
    """Return the cost (n,) of n designs for one objective; a constraint violation costs more than any objective.

    number: index of the objective. ceiling: upper bound of the other objective, or None. positions (n, d): of the d choices, 0
    to 1. The designs are evaluated and added to `search`.
    """
    answers = search.evaluate(positions, callback)
    broken = _beyond(answers.objectives, answers.worst, number, ceiling)
    return np.where(broken > 0.0, _BEYOND_ALL * (1.0 + broken), answers.objectives[:, number])


def _beyond(objectives: np.ndarray, worst: np.ndarray, number: int, ceiling: float | None) -> np.ndarray:
    """Return the largest relative constraint violation (n,) of n designs; values up to half of TOLERANCE are set to 0.

    objectives (n, 1 or 2): costs of the designs. worst (n,): violation of the constraints of the plan. number: index of the
    objective that is searched. ceiling: upper bound of the other objective, which is then a constraint too; None without a
    bound.
    """
    over = (
        np.zeros(len(worst))
        if ceiling is None
        else np.maximum(objectives[:, 1 - number] - ceiling, 0.0) / (abs(ceiling) or 1.0)
    )
    total = np.maximum(worst, over)
    return np.where(total <= 0.5 * TOLERANCE, 0.0, total)


def _seeds(search: DesignSearch, number: int, ceiling: float | None, rng: np.random.Generator) -> list[np.ndarray]:
    """Return a starting population (size, d) of designs for each of the best combinations of list entries.

    number: index of the objective. ceiling: upper bound of the other objective, or None. At most half of a population are the
    best designs of this combination evaluated so far; the others are random.
    """
    positions, objectives = search.positions, search.answers.objectives
    order = np.lexsort((objectives[:, number], _beyond(objectives, search.answers.worst, number, ceiling)))
    size = population(search.space)
    _, first, which = np.unique(search.space.combination(positions[order]), axis=0, return_index=True, return_inverse=True)
    members = []
    for combination in np.argsort(first)[:WAYS]:
        known = positions[order[which.ravel() == combination][: size // 2]]
        some = rng.random((size - len(known), search.space.dimension))
        some[:, search.space.named] = known[0, search.space.named]
        members.append(np.concatenate([known, some]))
    return members


def _refine_best(search: DesignSearch, number: int, callback: Callback) -> None:
    """Refine the free parameters of the best designs by COBYQA (Ragonneau 2022), a local optimiser.

    number: index of the objective. COBYQA fits quadratic models. It finds the optimum to many digits, even if a parameter is at
    an end of its range or a constraint is active. Designs evaluated by the prediction, which is known to two digits, are not
    refined.
    """
    if not search.plan.free or search.space.is_predicted:
        return
    for at in search.best(number)[:REFINED]:
        _refine(search, number, search.positions[at], callback)


def _refine(search: DesignSearch, number: int, start: np.ndarray, callback: Callback) -> None:
    from scipy.optimize import NonlinearConstraint, minimize

    first, known = len(search.plan.options), dict[bytes, Evaluated]()

    def at(x: np.ndarray) -> Evaluated:
        whole = np.concatenate([start[:first], np.clip(x, 0.0, 1.0)])
        if whole.tobytes() not in known:  # COBYQA calls objective and constraints separately for one design
            known[whole.tobytes()] = search.evaluate(whole[None, :], callback)
        return known[whole.tobytes()]

    size = abs(float(at(start[first:]).objectives[0, number])) or 1.0
    minimize(
        lambda x: float(at(x).objectives[0, number]) / size,
        start[first:],
        method="COBYQA",
        bounds=[(0.0, 1.0)] * (len(start) - first),
        constraints=NonlinearConstraint(lambda x: np.clip(at(x).excess[0], -1e3, 1e3), -np.inf, 0.0),
        options={"maxfev": refinements(search.space), "initial_tr_radius": 0.02, "final_tr_radius": 1e-8},
    )


def _search_front(search: DesignSearch, callback: Callback) -> None:
    """Search Pareto-optimal designs between the designs that are best for one of two objectives, and add them to `search`.

    The first objective is minimised with the second below a ceiling, for 12 ceilings (Haimes, Lasdon & Wismer 1971).
    """
    front = search.front()
    if not front.size or not search.plan.free:
        return
    others = search.answers.objectives[front, 1]
    low, high = others.min(), others.max()
    count = 2 + FRONT
    ends = np.geomspace(low, high, count) if low > 0.0 and high > 10.0 * low else np.linspace(low, high, count)
    for ceiling in ends[1:-1]:
        _search_objective(search, 0, float(ceiling), callback)


def _evolve_front(search: DesignSearch, callback: Callback) -> None:
    """Search the Pareto front of two objectives of a prediction by an evolution strategy (Rechenberg 1973).

    Each round takes normally distributed steps from designs on the front, with smaller steps than the round before. As long as
    no design meets the constraints, the steps start from the designs with the least violation.
    """
    rng = np.random.default_rng(search.plan.seed)
    step, named = _FIRST_STEP, search.space.named
    if not search.plan.free:
        return  # the first designs are all combinations of list entries
    for _ in range(front_rounds(search.space)):
        front = search.front()
        parents = search.positions[front if front.size else np.argsort(search.answers.worst)[:FEW]]
        parents = parents[rng.integers(len(parents), size=TOGETHER)]
        children = np.clip(parents + step * rng.standard_normal(parents.shape), 0.0, 1.0)
        children[:, named] = parents[:, named]
        search.evaluate(children, callback)
        step *= _SHRUNK


def _front(objectives: np.ndarray, worst: np.ndarray) -> np.ndarray:
    """Return the indices of the Pareto-optimal designs among n designs, ordered by the first objective.

    objectives (n, 1 or 2): costs, lower is better. worst (n,): relative constraint violations. Designs that violate a
    constraint by more than TOLERANCE are left out.
    """
    kept = np.flatnonzero((worst <= TOLERANCE) & np.isfinite(objectives).all(axis=1))
    order = kept[np.lexsort((objectives[kept, -1], objectives[kept, 0]))]
    lowest = np.minimum.accumulate(np.concatenate([[np.inf], objectives[order, -1]]))[:-1]
    return order[objectives[order, -1] < lowest]
