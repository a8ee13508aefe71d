"""Solve the case of a visitor, compare models for it, and describe the answer; safe to call from any thread."""

import os
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import xarray

from stiction.case.read import Case, case_in
from stiction.case.text import as_toml
from stiction.contact.contact import Contact
from stiction.contact.interfaces import allowed_interfaces, interface_names
from stiction.laws.proportion import input_warnings
from stiction.quantities.errors import InputError
from stiction.records.registry import all_options, kinds, of_kind
from stiction.report.answer import answer_lines, at_working_load, grade_line, model_line
from stiction.report.report_answer import interval_of, value_in_words
from stiction.report.significant_digits import rounded
from stiction.solving.candidates import candidates
from stiction.solving.choice import LAWS
from stiction.studies.case_results import compare_case, solve_case
from stiction.studies.comparison.compare import working_load
from stiction.studies.prediction.around import predict_with_curve
from stiction.studies.prediction.predict import is_predicted, prediction_of
from stiction.web.address import files_named, refuse_other_files
from stiction.web.fields import INTERFACE, value_at, with_points, with_value_at

_MAX_POINTS = 20_000  # largest number of points, because the curve is computed again while a slider moves
_MAX_SAMPLES = 4096  # largest number of samples of uncertain inputs
_MAX_PREDICTED = 500  # largest number of loads of a prediction
_KEPT = 64  # number of answers that are kept, each of about half a megabyte
_MORE = "on a page; `stiction run` accepts more"


@dataclass(frozen=True)
class Query:
    """Hold a case as the page edits it.

    tables: nested dicts, as read from a case file. folder: folder to which the paths in the tables are relative. files: the
    paths that the case may name.
    """

    tables: Mapping[str, Any]
    folder: Path = Path()
    files: frozenset[str] = frozenset()

    def with_tables(self, tables: Mapping[str, Any]) -> "Query":
        """Return the same query with the tables of another case."""
        return replace(self, tables=tables)

    def at_load(self, load: Any) -> "Query":
        """Return the same query at one load, which is a number or a text with a unit, as in a case file."""
        return self.with_tables(with_points(self.tables, {"load": [load]}))


@dataclass(frozen=True, eq=False)
class Answer:
    """Hold the results of a query.

    data: the prediction, or the result of the model that the case names. curve_data: results along loads or separations:
    `data` itself, or for a prediction at a single load a prediction at loads around it. input_warnings: texts about improbable
    inputs.
    """

    query: Query
    case: Case
    data: xarray.Dataset
    curve_data: xarray.Dataset
    input_warnings: list[str]

    @property
    def is_prediction(self) -> bool:
        """Return whether the result is a prediction, and not the result of a model that the case names."""
        return is_predicted(self.case)

    @property
    def arrays(self) -> list[str]:
        """Return the names of the array parameters."""
        return [str(name) for name in self.data["contact_area"].dims[:-1]]

    @cached_property
    def curve(self) -> xarray.Dataset:
        """Return the results along the loads or separations, for the first value of every array parameter.

        The results of a prediction are sorted by load.
        """
        curve = self.curve_data.isel(dict.fromkeys(self.arrays, 0))
        return curve.sortby("load") if curve["load"].dims and self.is_prediction else curve

    def at(self, point: int) -> xarray.Dataset:
        """Return the results at the point of the curve with index `point`."""
        curve = self.curve
        return curve.isel(dict.fromkeys(curve["load"].dims, point))

    def middle(self) -> int:
        """Return the index of the curve point at the working load, or at the middle compressive load.

        Only a prediction has a working load. For a model without compressive loads the index is 0.
        """
        load = np.atleast_1d(self.curve["load"].values)
        if "working_load" in self.curve.attrs:
            return int(np.argmin(np.abs(load - self.curve.attrs["working_load"])))
        pressing = np.flatnonzero(load > 0.0)
        return int(pressing[(len(pressing) - 1) // 2]) if len(pressing) else 0


def read_query(query: Query) -> Case:
    """Return the case of a query.

    Raises InputError if the case is invalid, names a file that it may not use, or is too large for the page.
    """
    refuse_other_files(query.tables, query.files)
    try:
        case = case_in(query.tables, query.folder)
    except InputError as error:
        raise _without_folders(error, query) from None
    samples = case.uncertainty.count if case.uncertain else 0
    most = _MAX_PREDICTED if is_predicted(case) else _MAX_POINTS
    for field, size, limit in (("solve", case.size, most), ("uncertainty.count", samples, _MAX_SAMPLES)):
        if size > limit:
            raise InputError(field, size, f"at most {limit} {_MORE}")
    if is_predicted(case) and case.is_swept:
        path = next(iter(case.swept), ("sweep",))
        raise InputError(".".join(path), value_at(query.tables, path), f"one number for a prediction {_MORE}")
    return case


def _without_folders(error: InputError, query: Query) -> InputError:
    """Return an error in which files are named without their folders, which visitors must not see."""
    folders = [f"{Path(query.folder, name).resolve().parent}{os.sep}" for name in query.files]

    def bare(text: Any) -> Any:
        for folder in folders:
            text = type(text)(text.replace(folder, "")) if isinstance(text, str) else text  # keeps InWords
        return text

    return InputError(bare(error.field), bare(error.value), bare(error.allowed), bare(error.hint))


def solved(query: Query) -> Answer:
    """Return the answer of a query: the prediction or, if the case names a model, the result of that model.

    Raises InputError if the case is invalid, or if the model or the prediction does not support it.
    """
    case = read_query(query)
    data, curve = predict_with_curve(case) if is_predicted(case) else (solve_case(case),) * 2
    return Answer(query, case, data, curve, list(map(str, input_warnings(case.subject))))


def answered(query: Query) -> Answer:
    """Return the answer of a query as `solved` does; the last answers of all visitors are kept.

    Visitors open the same examples, and return to earlier numbers. Cases that name files are solved each time, because a file
    may change.
    """
    return solved(query) if files_named(query.tables) else replace(_kept(as_toml(query.tables)), query=query)


@lru_cache(maxsize=_KEPT)
def _kept(text: str) -> Answer:
    """Return the answer of a case that names no file, from its text as a case file."""
    return solved(Query(tomllib.loads(text)))


def compared(query: Query, load: float | None, progress: Any) -> tuple[Case, xarray.Dataset, xarray.Dataset | None]:
    """Return the case, the comparison of all models, and the prediction (None if no prediction is possible).

    load: in N, or normalised as in the case; None for the middle load of the case. progress: records the progress. Raises
    InputError if the case is invalid or has no compressive load.
    """
    case = read_query(query)
    load = load if load is not None else working_load(case, None)
    if load is None:
        raise InputError("load", None, "a case with a compressive load, because models are compared at that load")
    return case, compare_case(case, load, progress), prediction_of(case, load)


def predicted_beside(answer: Answer, load: float) -> xarray.Dataset | None:
    """Return the prediction for a case that names a model, at one load; None if no prediction is possible.

    load: in N, or normalised as in the answer.
    """
    try:
        return prediction_of(answer.case, load) if load > 0.0 else None
    except InputError:
        return None


def law_names(case: Case) -> dict[str, list[str]]:
    """Return the names of all models and laws, by key of the table [solve] of a case file.

    The list of the key "model" also has the other models that a comparison tries for the case.
    """
    names: dict[str, list[str]] = {choice: [] for choice in LAWS}
    for kind in kinds():
        names.get(kind.keyword, []).extend(of_kind(kind))
    return names | {"model": list(dict.fromkeys([*names["model"], *(one.name for one in candidates(case.subject))]))}


def states_of(query: Query) -> list[str]:
    """Return the interface states that the bodies allow; all if the bodies have an error, [] for dimensionless groups."""
    try:
        subject = read_query(query.with_tables(with_value_at(query.tables, INTERFACE, None))).subject
    except InputError:
        return interface_names()
    return allowed_interfaces(*subject.touching, coated=subject.has_film) if isinstance(subject, Contact) else []


def option_values(data: xarray.Dataset) -> dict[str, tuple[str, ...]]:
    """Return the options of the model and laws of a result, with the values that each option may have."""
    named = str(data.attrs.get("options", "")).split()
    return {name: values for name, values in all_options().items() if name in named}


_MU = "friction_coefficient"
_WHERE = {"load": "at a load of", "contact_area": "real contact area", "mean_separation": "mean separation"}


def headline(answer: Answer, point: int) -> tuple[str, str]:
    """Return two texts for the head of the page: mu, and the load, contact area and separation at which it holds.

    point: index on the curve. A prediction is stated at its working load, with its interval.
    """
    if answer.is_prediction:
        return answer_lines(at_working_load(answer.data))[0]  # without the range of loads, which the form shows
    here = answer.at(point)
    texts = {name: value_in_words(here[name], float(here[name]), 4) for name in (_MU, *_WHERE) if name in here}
    if _MU not in texts:
        return f"real contact area {texts['contact_area']}", f"at a load of {texts['load']}; this model has no friction"
    where = ", ".join(f"{head} {texts[name]}" for name, head in _WHERE.items() if name in texts)
    if texts[_MU] == "not defined":
        return "mu is not defined: the load is not compressive", where
    return f"mu ≈ {rounded(float(here[_MU]), interval_of(here))}", f"{where}, mu to four digits {texts[_MU]}"


def remarks(answer: Answer) -> list[str]:
    """Return sentences on an answer: model and grade, warnings and remarks.

    A prediction has no sentence on model and grade. The first warning of a prediction is left out, because the card shows it.
    The other sentences list input warnings, inputs that were not used, remarks, and array parameters for which the curves
    show only the first value.
    """
    attrs, arrays = answer.data.attrs, answer.arrays
    lines = [] if answer.is_prediction else [f"Model {model_line(attrs)}; grade {grade_line(attrs)}."]
    lines += [f"Warning: {one}" for one in attrs.get("warnings", [])[1:]]
    lines += [f"Input warning: {one}" for one in answer.input_warnings]
    lines += [f"Not used: {attrs['inputs_not_used']}"] if attrs.get("inputs_not_used") else []
    lines += [f"Remark: {one}" for one in str(attrs.get("remarks", "")).splitlines() if one]
    return lines + ([f"The curves show the first value of each array: {', '.join(arrays)}."] if arrays else [])
