"""Everything a report needs of one case: its answer at a working load, all models, and its scans."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.case.read import Case
from stiction.case.several import Address
from stiction.laws.proportion import input_warnings
from stiction.quantities.errors import InputError
from stiction.quantities.progress import Progress, silent
from stiction.studies.case_results import compare_case, solve_case
from stiction.studies.comparison.compare import working_load
from stiction.studies.prediction.predict import is_predicted, predict, prediction_of

if TYPE_CHECKING:
    import xarray

    from stiction.studies.scans.analysis import Analysis


@dataclass(frozen=True)
class ReportData:
    """Hold the results that a report shows.

    case. text: its file as it was written, "" where there was none. data: its prediction, or the results of the named model.
    load: the working load [N], or normalised; here: the results of a named model at it; told: all models at it; None
    where nothing presses. not_compared: why models are not compared, "" if they are. analyses: body -> analysis of its
    scan. input_warnings: about unlikely numbers. recommended: the prediction of one contact, also where a
    model is named; None for array parameters and normalised contacts.
    """

    case: Case
    text: str
    data: "xarray.Dataset"
    load: float | None = None
    here: "xarray.Dataset | None" = None
    told: "xarray.Dataset | None" = None
    not_compared: str = ""
    analyses: "Mapping[str, Analysis]" = field(default_factory=dict)
    input_warnings: tuple[str, ...] = ()
    recommended: "xarray.Dataset | None" = None

    @property
    def prediction(self) -> "xarray.Dataset | None":
        """Return the prediction where it is the answer; None where a model is named, or numbers are several."""
        return self.data if "shares" in self.data.attrs else None

    @property
    def result(self) -> Any:
        """The result at the working load; where there is none, all of it."""
        return self.data if self.here is None else self.here


def find_out(case: Case, text: str = "", *, load: Any = None, progress: Progress = silent) -> ReportData:
    """Compute the results that a report of a case shows.

    load: the working load [N]; by default the middle one of the case; a case with array parameters has none, and its models are
    not compared. progress: callable(label) that returns an iterator wrapper. Raises InputError.
    """
    if case.is_several and load is not None:
        raise InputError("--load", load, "not supported with array parameters; the case is solved at its own points")
    at = None if case.is_several else working_load(case, load)
    why = "numbers of the case are several, and models are compared for one contact" if case.is_several else ""
    why = why or ("" if at is not None else "nothing presses at any of its points, and models are judged at a load above 0")
    here = None
    if is_predicted(case) and (at is not None or case.is_several):
        data = predict(case) if load is None or at is None else predict(case, load=[at])
    else:
        data = solve_case(case, progress=progress)
        if at is not None:
            here = solve_case(replace(case, separation=None, load=np.array([at])), progress=progress).squeeze("load")
    predicted = data if "shares" in data.attrs else None if case.is_several else prediction_of(case, at)
    told = None if at is None else compare_case(case, at, progress)
    asked = tuple(str(one) for one in input_warnings(case.subject))
    return ReportData(case, text, data, at, here, told, why, _analyses(case, progress), asked, predicted)


def _analyses(case: Case, progress: Progress) -> "dict[str, Analysis]":
    if case.measured is None:
        return {}
    from stiction.studies.scans.analysis import analyse

    maps = case.measured.solvable.maps
    return {body: analyse(one, progress=progress(f"Analysing the {body} body")) for body, one in maps.items()}


def places_in(text: str) -> frozenset[Address]:
    """Return the addresses of all values in the text of a case file; none for invalid TOML."""
    found: set[Address] = set()

    def walk(table: Mapping, path: Address) -> None:
        for key, value in table.items():
            found.add((*path, key))
            if isinstance(value, Mapping):
                walk(value, (*path, key))

    try:
        walk(tomllib.loads(text), ())
    except tomllib.TOMLDecodeError:
        return frozenset()
    return frozenset(found)


def text_of_file(path: Path) -> str:
    """Return the text of a case file that was read already."""
    return path.read_text(encoding="utf-8-sig")
