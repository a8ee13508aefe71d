"""What the page asks of the rooms below: a case solved, its models compared. No physics, no browser; in any thread."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.case.read import Case, case_in
from stiction.contact.contact import Contact
from stiction.contact.interfaces import allowed_interfaces, interface_names
from stiction.laws.proportion import questions
from stiction.laws.validity import doubts_of
from stiction.quantities.dimensions import dimensions
from stiction.quantities.errors import InputError
from stiction.records.registry import KINDS, all_options, of_kind
from stiction.solving.candidates import candidates
from stiction.solving.choice import LAWS
from stiction.studies.case_results import compare_case, solve_case
from stiction.studies.comparison.compare import working_load
from stiction.studies.prediction.predict import is_predicted, predict, prediction_of
from stiction.web.address import refuse_other_files
from stiction.web.fields import dropped

if TYPE_CHECKING:
    import xarray

__all__ = [
    "Answer", "Comparison", "Question", "case_asked", "compared", "make_ready", "model_names", "option_values", "solved",
    "states_of",
]  # fmt: skip

_MOST_NUMBERS = 20_000  # in a curve that is drawn anew while a knob moves
_MOST_DRAWN = 4096  # of what is uncertain
_MOST_PREDICTED = 500  # loads of a prediction


@dataclass(frozen=True)
class Question:
    """A case as the page has it: its tables, the folder from which files are named, and the files that may be."""

    tables: Mapping[str, Any]
    folder: Path = Path()
    files: frozenset[str] = frozenset()

    def with_tables(self, tables: Mapping[str, Any]) -> "Question":
        return Question(tables, self.folder, self.files)


@dataclass(frozen=True)
class Answer:
    """The result of a case: data, as `predict` or, with a model named, `solve_case` gives it; or the error in its place.
    questions: about numbers that were hardly meant."""

    question: Question
    case: Case | None = None
    data: "xarray.Dataset | None" = None
    error: InputError | None = None
    questions: list[str] = field(default_factory=list)

    @property
    def curve(self) -> "xarray.Dataset":
        """The result along one dimension: of numbers that are several, at the first of each."""
        assert self.data is not None
        along = self.data["load"].dims[-1] if self.data["load"].dims else None
        return self.data.isel({name: 0 for name in self.data["load"].dims if name != along})

    @property
    def prediction(self) -> "xarray.Dataset | None":
        """Return the data where it is a prediction, None where it is the result of one model."""
        return self.data if self.case is not None and is_predicted(self.case) else None

    @property
    def left_out(self) -> str:
        """What is not drawn of numbers that are several, "" if nothing."""
        assert self.data is not None
        more = self.data["load"].dims[:-1]
        return f"numbers are several along {', '.join(map(str, more))}: the first of each is drawn" if more else ""

    def middle(self) -> int:
        """Return the point of the curve that is told in words: the working load of a prediction, else the middle one of
        those that press."""
        if self.data is not None and "working_load" in self.data.attrs:
            return int(np.argmin(np.abs(self.data["load"].values - self.data.attrs["working_load"])))
        pressing = np.flatnonzero(np.atleast_1d(self.curve["load"].values) > 0.0)
        return int(pressing[(len(pressing) - 1) // 2]) if len(pressing) else 0

    def doubts(self) -> list[tuple[str, str]]:
        """Every doubt about the result: of which kind, and in words."""
        return [] if self.data is None else [(one.kind, str(one)) for one in doubts_of(self.data)]


def case_asked(question: Question) -> Case:
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


def solved(question: Question) -> Answer:
    """Return the case, predicted or, with a model named, solved; an InputError is in the answer and not raised."""
    try:
        case = case_asked(question)
        data = predict(case) if is_predicted(case) else solve_case(case)
        return Answer(question, case, data, questions=list(map(str, questions(case.subject))))
    except InputError as error:
        return Answer(question, error=error)


@dataclass(frozen=True)
class Comparison:
    """Every model on one case at one load with the prediction there, None where there is none; or the error in its place."""

    data: "xarray.Dataset | None" = None
    prediction: "xarray.Dataset | None" = None
    error: InputError | None = None


def compared(question: Question, load: float | None, progress: Any) -> Comparison:
    """The models of a case at a load, SI or normalised as the case is; by default its middle one."""
    try:
        case = case_asked(question)
        at = load if load is not None else working_load(case, None)
        if at is None:
            raise InputError("load", None, "a case that presses somewhere: models are judged at a load above 0")
        return Comparison(compare_case(case, at, progress), prediction_of(case, at))
    except InputError as error:
        return Comparison(error=error)


def model_names(case: Case | None) -> list[str]:
    """Names of the models that may be asked of a case."""
    from stiction.records.registry import RoughSurface

    named = [one.name for one in candidates(case.subject)] if case is not None else []
    return list(dict.fromkeys([*of_kind(RoughSurface), *named]))


def states_of(question: Question) -> list[str]:
    """Return the states of the interface that the bodies of a question allow; all where the bodies are not known."""
    try:
        case = case_asked(question.with_tables(dropped(question.tables, ("contact", "interface"))))
    except InputError:
        return interface_names()
    return allowed_interfaces(*case.subject.touching) if isinstance(case.subject, Contact) else []


def law_keys(keyword: str) -> list[str]:
    """Keys of the laws of a kind, by its keyword among LAWS."""
    return [key for kind in KINDS if kind.keyword == keyword for key in of_kind(kind)]


def option_values(data: "xarray.Dataset | None") -> dict[str, tuple[str, ...]]:
    """The options that the model and the laws of a result have, each with what it may be."""
    named = [] if data is None else str(data.attrs.get("options", "")).split()
    known = all_options()
    return {name: known[name] for name in named if name in known}


CHOSEN_BY_KEY = tuple(name for name in LAWS if name != "model")


def make_ready(answer: Answer) -> None:
    """Ask once what the form of every page asks: laws are imported when they are first asked for."""
    model_names(answer.case)
    option_values(answer.data)
    for keyword in CHOSEN_BY_KEY:
        law_keys(keyword)
