"""Compute the results that a report shows of one case: its answer at a working load, all models, and its scans."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stiction.case.read import Case
from stiction.case.swept import Address
from stiction.contact.contact import Contact
from stiction.laws.proportion import input_warnings
from stiction.quantities.errors import InputError
from stiction.quantities.progress import Progress, silent
from stiction.studies.case_results import compare_case, solve_case
from stiction.studies.comparison.compare import working_load
from stiction.studies.prediction.around import predict_with_curve
from stiction.studies.prediction.predict import is_predicted, prediction_of
from stiction.surfaces.finished import Finished

if TYPE_CHECKING:
    import xarray

    from stiction.contact.subject import Subject
    from stiction.studies.scans.analysis import Analysis


@dataclass(frozen=True)
class ReportData:
    """Store the results that a report of one case shows.

    text: the case file as written; "" without a file. data: the prediction, or the results of the model of the case at all its
    points. load: working load in N, or dimensionless for [indices]; None if no load is above 0, or if a number of the case is
    an array. working_results: results of this model at the working load; None for a prediction or without a working load.
    comparison: results of all models at the working load; None without a working load. not_compared: reason why models are not
    compared; "" if they are. analyses: analysis of the scan of each body, by body. input_warnings: warnings of unlikely inputs.
    recommended: the prediction, also if the case names a model; None for array parameters, or if no prediction is possible.
    curve: the prediction over a range of loads around a single load, otherwise `data`; None if the case names a model.
    """

    case: Case
    text: str
    data: "xarray.Dataset"
    load: float | None = None
    working_results: "xarray.Dataset | None" = None
    comparison: "xarray.Dataset | None" = None
    not_compared: str = ""
    analyses: "Mapping[str, Analysis]" = field(default_factory=dict)
    input_warnings: tuple[str, ...] = ()
    recommended: "xarray.Dataset | None" = None
    curve: "xarray.Dataset | None" = None

    @property
    def prediction(self) -> "xarray.Dataset | None":
        """Return `data` if it is a prediction of a single contact; None if the case names a model or has array parameters."""
        return self.data if "shares" in self.data.attrs else None

    @property
    def result(self) -> Any:
        """Return the results of the model at the working load; `data` for a prediction or without a working load."""
        return self.data if self.working_results is None else self.working_results


def collect_report_data(case: Case, text: str = "", *, load: Any = None, progress: Progress = silent) -> ReportData:
    """Compute the results that a report of a case shows.

    text: the case file as written. load: working load [N], by default that of `pressing_loads`. A case with array parameters
    has no working load, and its models are not compared. progress: receives a label and returns a function that wraps the list
    of steps. Raises InputError.
    """
    if case.is_swept and load is not None:
        raise InputError("--load", load, "not supported with array parameters; the case is solved at its own loads")
    at_load = None if case.is_swept else working_load(case, load)
    why = "the case has array parameters, and models are compared for a single contact" if case.is_swept else ""
    why = why or ("" if at_load is not None else "no load of the case is above 0, and models are compared at a load above 0")
    at_working_load = curve = None
    if is_predicted(case) and (at_load is not None or case.is_swept):
        data, curve = predict_with_curve(case.at_load(load))
    else:
        data = solve_case(case, progress=progress)
        if at_load is not None:
            at_working_load = solve_case(case.at_load(at_load), progress=progress).squeeze("load")
    predicted = data if "shares" in data.attrs else None if case.is_swept else prediction_of(case, at_load)
    comparison = None if at_load is None else compare_case(case, at_load, progress)
    warnings = tuple(str(warning) for warning in input_warnings(case.subject))
    return ReportData(
        case, text, data, at_load, at_working_load, comparison, why, _analyses(case, progress), warnings, predicted, curve
    )


def _analyses(case: Case, progress: Progress) -> "dict[str, Analysis]":
    if case.measured is None:
        return {}
    from stiction.studies.scans.analysis import analyse

    maps = case.measured.solvable.maps
    return {body: analyse(surface, progress=progress(f"Analysing the {body} body")) for body, surface in maps.items()}


def stated_in(text: str) -> dict[Address, Any]:
    """Return all values in the text of a case file, including tables, by address, e.g. ("contact", "first", "hardness").

    The dict is empty if the text is not TOML.
    """
    stated: dict[Address, Any] = {}

    def walk(table: Mapping, path: Address) -> None:
        for key, value in table.items():
            stated[(*path, key)] = value
            if isinstance(value, Mapping):
                walk(value, (*path, key))

    try:
        walk(tomllib.loads(text), ())
    except tomllib.TOMLDecodeError:
        return {}
    return stated


def text_of_file(path: Path) -> str:
    """Return the text of a case file that has been read successfully before, so that no error is expected."""
    return path.read_text(encoding="utf-8-sig")


_OF_FINISH = {f"roughness.{name}" for name in ("asperity_height_deviation", "asperity_radius", "asperity_density", "kind")}


def source_of_finish(subject: "Subject", name: str) -> str:
    """Return a text on the origin of a number in a contact with a finish; "" if the number does not follow from the finish.

    name: dotted name, e.g. "roughness.asperity_radius".
    """
    if name not in _OF_FINISH or not isinstance(subject, Contact) or not subject.roughness.unknowns:
        return ""
    bodies = [subject.roughness.part(body) for body in ("first", "second")]
    has_height = any(isinstance(body, Finished) and body.height is not None for body in bodies)
    return f"drawn from the stated {'Sq and ' * has_height}finish"
