"""Questions of the page to the rooms below, a case solved or models compared, and answers in words. In any thread."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray

from stiction.case.read import Case, case_in
from stiction.contact.contact import Contact
from stiction.contact.interfaces import allowed_interfaces, interface_names
from stiction.laws.proportion import input_warnings
from stiction.quantities.dimensions import dimensions
from stiction.quantities.errors import InputError
from stiction.records.registry import all_options, kinds, of_kind
from stiction.report.answer import answer_lines, grade_line, model_line
from stiction.report.honest_digits import rounded
from stiction.report.report_answer import interval_of, value_in_words
from stiction.solving.candidates import candidates
from stiction.solving.choice import LAWS
from stiction.studies.case_results import compare_case, solve_case
from stiction.studies.comparison.compare import working_load
from stiction.studies.prediction.predict import is_predicted, predict, prediction_of
from stiction.web.address import refuse_other_files
from stiction.web.fields import placed

_MOST_NUMBERS = 20_000  # in a curve that is drawn anew while a knob moves
_MOST_DRAWN = 4096  # of what is uncertain
_MOST_PREDICTED = 500  # loads of a prediction


@dataclass(frozen=True)
class Query:
    """A case as the page has it: its tables, the folder from which files are named, and the files that may be."""

    tables: Mapping[str, Any]
    folder: Path = Path()
    files: frozenset[str] = frozenset()

    def with_tables(self, tables: Mapping[str, Any]) -> "Query":
        return replace(self, tables=tables)

    def at_load(self, load: Any) -> "Query":
        """Return the question at one load, as a case file has it."""
        solve = {name: one for name, one in self.tables.get("solve", {}).items() if name not in ("load", "separation")}
        return self.with_tables({**self.tables, "solve": {**solve, "load": [load]}})


@dataclass(frozen=True, eq=False)
class Answer:
    """The result of a case: data, as `predict` or, with a model named, `solve_case` gives it; or the error in its place.
    input_warnings: about numbers that were hardly meant."""

    question: Query
    case: Case | None = None
    data: xarray.Dataset | None = None
    error: InputError | None = None
    input_warnings: list[str] = field(default_factory=list)

    @property
    def curve(self) -> xarray.Dataset:
        """Return the result along one dimension, a prediction by its loads: of a parameter sweep, at the first of each."""
        assert self.data is not None
        *several, along = self.data["load"].dims or (None,)
        curve = self.data.isel(dict.fromkeys(several, 0))
        return curve if along is None or self.prediction is None else curve.sortby("load")

    def at(self, here: int) -> xarray.Dataset:
        """Return the results at a point of the curve."""
        curve = self.curve
        return curve.isel(dict.fromkeys(curve["load"].dims, here))

    @property
    def prediction(self) -> xarray.Dataset | None:
        """Return the data where it is a prediction, None where it is the result of one model."""
        return self.data if self.case is not None and is_predicted(self.case) else None

    def middle(self) -> int:
        """Return the point of the curve that is described in words: the working load of a prediction, else the middle one of
        those that press."""
        load = np.atleast_1d(self.curve["load"].values)
        if "working_load" in self.curve.attrs:
            return int(np.argmin(np.abs(load - self.curve.attrs["working_load"])))
        pressing = np.flatnonzero(load > 0.0)
        return int(pressing[(len(pressing) - 1) // 2]) if len(pressing) else 0


def case_asked(question: Query) -> Case:
    """The case of a question. Raises InputError, also for one that is too large for a page."""
    refuse_other_files(question.tables, question.files)
    case = case_in(question.tables, question.folder)
    points = case.load if case.load is not None else case.separation
    count = math.prod(dimensions([*(array for _, array in case.subject.arrays()), points]).values())
    count *= 1 if hasattr(points, "dims") else np.size(points)
    if is_predicted(case) and count > _MOST_PREDICTED:
        allowed = f"{_MOST_PREDICTED} loads at most on a page where no model is named; `stiction run` takes more"
        raise InputError("solve", f"{count} points", allowed)
    if count > _MOST_NUMBERS:
        raise InputError("case", f"{count} points", f"{_MOST_NUMBERS} at most on a page; `stiction run` takes a million")
    if case.uncertain and case.uncertainty.count > _MOST_DRAWN:
        raise InputError(
            "uncertainty.count", case.uncertainty.count, f"{_MOST_DRAWN} at most on a page; `stiction run` takes more"
        )
    return case


def solved(question: Query) -> Answer:
    """Return the case, predicted or, with a model named, solved; an InputError is in the answer and not raised."""
    try:
        case = case_asked(question)
        data = predict(case) if is_predicted(case) else solve_case(case)
        return Answer(question, case, data, input_warnings=list(map(str, input_warnings(case.subject))))
    except InputError as error:
        return Answer(question, error=error)


def compared(question: Query, load: float | None, progress: Any) -> tuple[Case, xarray.Dataset, xarray.Dataset | None]:
    """Return the case, every model and the prediction, None where there is none, at a load, SI or normalised as the case is; by
    default its middle one. Raises InputError."""
    case = case_asked(question)
    at = load if load is not None else working_load(case, None)
    if at is None:
        raise InputError("load", None, "a case that presses somewhere: models are judged at a load above 0")
    return case, compare_case(case, at, progress), prediction_of(case, at)


def predicted_beside(answer: Answer, load: float) -> xarray.Dataset | None:
    """Return the prediction at a load beside the answer of a named model; None where there is none."""
    try:
        return None if answer.case is None or not load > 0.0 else prediction_of(answer.case, load)
    except InputError:
        return None


def keys_by_choice(case: Case | None) -> dict[str, list[str]]:
    """Return what each choice of laws may be: models that may be asked of the case, and the laws of every kind."""
    keys: dict[str, list[str]] = {choice: [] for choice in LAWS}
    for kind in kinds():
        keys.get(kind.keyword, []).extend(of_kind(kind))
    names = [] if case is None else [one.name for one in candidates(case.subject)]
    return keys | {"model": list(dict.fromkeys([*keys["model"], *names]))}


def states_of(question: Query) -> list[str]:
    """Return the states of the interface that the bodies of a question allow; all where the bodies are not known."""
    try:
        case = case_asked(question.with_tables(placed(question.tables, ("contact", "interface"), None)))
    except InputError:
        return interface_names()
    return allowed_interfaces(*case.subject.touching) if isinstance(case.subject, Contact) else []


def option_values(data: xarray.Dataset | None) -> dict[str, tuple[str, ...]]:
    """The options that the model and the laws of a result have, each with what it may be."""
    named = [] if data is None else str(data.attrs.get("options", "")).split()
    return {name: values for name, values in all_options().items() if name in named}


_MU = "friction_coefficient"
_WHERE = {"load": "at a load of", "contact_area": "real contact area", "mean_separation": "mean separation"}


def headline(answer: Answer, at: int) -> tuple[str, str]:
    """Return the number and where it holds: of a prediction with its interval, of one model with as many digits as its
    uncertainty leaves it."""
    if answer.prediction is not None:
        return answer_lines(answer.prediction)[0]
    here = answer.at(at)
    said = {name: value_in_words(here[name], float(here[name]), 4) for name in (_MU, *_WHERE) if name in here}
    if _MU not in said:
        return f"real contact area {said['contact_area']}", f"at a load of {said['load']}; this model is of contact only"
    where = ", ".join(f"{head} {said[name]}" for name, head in _WHERE.items() if name in said)
    if said[_MU] == "not defined":
        return "mu is not defined: the surfaces hold themselves together", where
    return f"mu ≈ {rounded(float(here[_MU]), interval_of(here))}", f"{where}, mu to four digits {said[_MU]}"


def remarks(answer: Answer) -> list[str]:
    """What else is to be said of an answer: model, grade, input warnings, inputs that change nothing."""
    assert answer.data is not None
    said, (*several, _) = answer.data.attrs, answer.data["load"].dims or ("",)
    found = [] if answer.prediction is not None else [f"Model {model_line(said)}; grade {grade_line(said)}."]
    found += [f"Warning: {one}" for one in said.get("warnings", [])[1:]]
    found += [f"Input warning: {one}" for one in answer.input_warnings]
    found += [f"Not used: {said['inputs_not_used']}"] if said.get("inputs_not_used") else []
    found += [f"Remark: {one}" for one in str(said.get("remarks", "")).splitlines() if one]
    return [
        *found,
        *([f"numbers are several along {', '.join(map(str, several))}: the first of each is drawn"] if several else []),
    ]
