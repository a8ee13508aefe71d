"""Turn the result of a design search into a labelled dataset and a case file."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction import __version__
from stiction.case.addresses import with_numbers
from stiction.case.read import wants_ranges, without_studies
from stiction.case.text import case_text, show_exactly, with_written
from stiction.quantities.sampling import spread_rows
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.solving.choice import RECOMMENDED
from stiction.studies.design.plan import LOAD, DesignPlan, Options, quantity_of
from stiction.studies.design.space import TOLERANCE

if TYPE_CHECKING:
    import xarray

    from stiction.studies.design.run import DesignSearch

_NEAR = 0.01  # relative distance from a target up to which the target counts as met
_SHOWN = 200  # largest number of designs on the Pareto front in a result


def dataset_of(search: "DesignSearch") -> "xarray.Dataset":
    import xarray

    best = search.best()
    data = xarray.Dataset(_columns(search, best, "design"), coords={"design": np.arange(len(best))})
    data["violated"] = (
        "design",
        _violated(search, best),
        {"long_name": "violated constraints and ranges of validity"},
    )
    if len(search.plan.objectives) == 2:
        front = search.front()
        chosen = front[spread_rows(len(front), _SHOWN)]
        more = {f"pareto_{name}": column for name, column in _columns(search, chosen, "pareto").items()}
        data = data.merge(xarray.Dataset(more, coords={"pareto": np.arange(len(chosen))}))
    good = np.where(search.answers.worst <= TOLERANCE, search.answers.objectives[:, 0], np.inf)
    every = _columns(search, np.arange(len(good)), "evaluated")
    data = data.merge(xarray.Dataset({f"evaluated_{name}": column for name, column in every.items()}))
    data["best_so_far"] = (
        "evaluated",
        np.minimum.accumulate(good),
        {"long_name": "first objective of the best design, less is better"},
    )
    return data.assign_attrs(_attributes(search, best))


def _columns(search: "DesignSearch", rows: np.ndarray, along: str) -> dict[str, tuple]:
    """Return dataset variables of some evaluated designs by name: choices, results and constraint violations.

    rows: indices of these designs among all that the search evaluated. along: name of the dimension of the variables.
    """
    positions, worst, known = search.positions[rows], search.answers.worst[rows], search.answers.known
    columns: dict[str, tuple] = {}
    for at, one in enumerate(search.plan.unknowns):
        name = "load" if one.path == LOAD else one.name
        if isinstance(one, Options):
            index = one.index(positions[:, at])
            entries = one.entries if one.is_number else one.words
            values = np.array([entries[int(i)] for i in index])
            attributes: dict[str, Any] = dict(QUANTITIES[one.path[-1]].attributes) if one.is_number else {"long_name": name}
        else:
            ends = {"searched_from": one.low, "searched_to": one.high, "spacing": "log" if one.log else "linear"}
            values, attributes = one.at(positions[:, at]), dict(QUANTITIES[one.quantity].attributes) | ends
        columns[name] = (along, values, attributes)
    for name, values in known.items():
        if name not in columns:
            columns[name] = (along, values[rows], dict(QUANTITIES[quantity_of(name)].attributes))
    for name, off in off_targets(search.plan, known):
        columns[f"{name}_off_target"] = (along, off[rows], {"long_name": "relative distance from the target"})
    columns["constraint_violation"] = (along, worst, {"long_name": "relative constraint violation"})
    columns["feasible"] = (along, worst <= TOLERANCE, {"long_name": "whether all constraints are met"})
    return columns


def _violated(search: "DesignSearch", rows: np.ndarray) -> np.ndarray:
    """Return one text for each design with the constraints that it violates, one a line; "" if it meets all.

    rows: indices of the designs among all that the search evaluated.
    """
    worst = search.answers.worst
    return np.array(["\n".join(search.space.violations(search.positions[at])) if worst[at] > TOLERANCE else "" for at in rows])


def _attributes(search: "DesignSearch", best: np.ndarray) -> dict[str, Any]:
    plan, answers = search.plan, search.answers
    unknown = ", ".join("load" if one.path == LOAD else one.name for one in plan.unknowns)
    return {
        **({"case": plan.title} if plan.title else {}),
        "program": f"stiction {__version__}",
        "model": RECOMMENDED if search.space.is_predicted else search.space.choice.name,
        "objectives": "\n".join(one.words for one in plan.objectives),
        "chosen": unknown,
        "limits": "\n".join(one.words for one in plan.limits),
        "validity": plan.validity,
        "evaluated": len(search.positions),
        "tolerance": TOLERANCE,
        "uncertain": _uncertain(plan),
        "verdict": "" if answers.worst[best[0]] <= TOLERANCE else "no design meets all limits; the nearest one is shown",
        "missed": "\n".join(missed_objectives(plan, answers.known, int(best[0]))),
        "stopped": int(search.stopped),
    }


def _uncertain(plan: DesignPlan) -> str:
    ranges = ["numbers of materials within their ranges"] if wants_ranges(plan.given) else []
    bodies = ("first", "second", "coating") if ranges else ()
    own = [".".join(one.path[1:]) for one in plan.uncertain if not (len(one.path) > 2 and one.path[1] in bodies)]
    return ", ".join([*own, *ranges])


def designed_case(search: "DesignSearch", out: Path) -> str:
    plan = search.plan
    best = int(search.best()[0])
    positions, worst, known = search.positions, search.answers.worst, search.answers.known
    comments = [f"Designed by stiction {__version__}: {', '.join(one.words for one in plan.objectives)}."]
    comments += [f"It misses the objective: {words}." for words in missed_objectives(plan, known, best)]
    if worst[best] > TOLERANCE:
        comments += [f"It violates a limit: {words}." for words in search.space.violations(positions[best])]
    content = _with_numbers(without_studies(plan.given), search.space.numbers(positions[best]))
    return case_text(content, comments, plan.folder, out)


def _with_numbers(content: Any, numbers: Mapping[tuple[str, ...], Any]) -> Any:
    """Return the tables of a case file with the choices of a design written into them.

    content: the tables. numbers: for each address in the case (tuple of keys), the chosen number in SI units or the chosen list
    entry.
    """
    for path, entry in sorted(numbers.items(), key=lambda one: one[0][-1] in QUANTITIES):  # materials before their numbers
        if path == LOAD:
            text = show_exactly(entry, "load") if "contact" in content else float(entry)
            solve = {key: value for key, value in content["solve"].items() if key != "separation"}
            content = {**content, "solve": {**solve, "load": text}}
        elif path[-1] in QUANTITIES:
            content = with_written(content, {path: entry})
        else:
            content = with_numbers(content, {path: entry})
    return content


def off_targets(plan: DesignPlan, known: Mapping[str, np.ndarray]) -> Iterator[tuple[str, np.ndarray]]:
    """Yield, for each objective with a target, the name of its result and the relative distances of n designs from the target.

    known: results (n,) of the designs by name. A distance is (result - target)/|target|, or the result itself if the target is
    0.
    """
    for objective, target in zip(plan.objectives, plan.targets, strict=True):
        if objective.target:
            yield objective.quantity, (known[objective.quantity] - target) / (abs(target) or 1.0)


def missed_objectives(plan: DesignPlan, known: Mapping[str, np.ndarray], row: int) -> list[str]:
    """Return one sentence for each target that a design misses by more than 1 %, with the difference in percent.

    known: results (n,) of n designs by name. row: index of the design among them.
    """
    targets = {objective.quantity: target for objective, target in zip(plan.objectives, plan.targets, strict=True)}
    found = []
    for name, off in off_targets(plan, known):
        if abs(off[row]) > _NEAR:
            value, target = (show(one, quantity_of(name), 4) for one in (float(known[name][row]), targets[name]))
            found.append(f"{name} = {value}, {abs(100.0 * off[row]):.3g} % {'above' if off[row] > 0.0 else 'below'} {target}")
    return found
