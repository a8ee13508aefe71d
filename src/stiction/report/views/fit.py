"""A fit as it is shown."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.files import record, write_csv, write_rows
from stiction.report.fit_tables import evidence_table, fit_notes, parameter_rows, parameter_table, prediction_names, row_rows
from stiction.report.number_table import few_rows
from stiction.report.view import Picture, View
from stiction.report.views.prediction import prediction_view
from stiction.report.whole_keys import WholeKeys
from stiction.studies.fit.predicted import fitted_case

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case
    from stiction.studies.fit.run import Fitting

_OTHERS = ("parameter", "other_parameter", "row", "model")


def fit_view(found: "Fitting", folder: Path | None = None) -> View:
    """Return what a fit shows. folder: where its files go, from which the fitted case names other files."""
    data, title = found.data(), found.plan.title

    def parts() -> Iterator[Any]:
        if title:
            yield Text(title, style="bold")
        yield from (f"model {data.attrs['model']}", "", parameter_table(data), "", *fit_notes(data))
        if "model" in data.dims:
            yield from ("", WholeKeys(evidence_table(data)))

    def fitted() -> Any:
        from stiction.report.fit_pictures import fit_figure

        return fit_figure(data, title)

    def profiles() -> Any:
        from stiction.report.fit_pictures import profile_figure

        return profile_figure(data)

    files = {
        "parameters.csv": lambda path: write_rows(path, *parameter_rows(data)),
        "residuals.csv": lambda path: write_rows(path, *row_rows(data)),
    }
    if folder is not None:
        files["fitted.toml"] = lambda path: path.write_text(found.case_text(folder), encoding="utf-8")
    if names := prediction_names(data):
        files["predictions.csv"] = lambda path: write_csv(data[names].drop_vars(_OTHERS, errors="ignore"), path)
    pictures = {
        "fit.png": Picture("measured and fitted", fitted),
        "profiles.png": Picture("likelihood along each fitted number", profiles),
    }
    return View("fit", data, parts, lambda: record(data, {}), files, pictures, short=lambda: _short(found.plan.title, data))


def fitted_prediction_view(given: Any, case: "Case", data: "xarray.Dataset", details: bool, out: Path | None = None) -> View:
    """Return what a prediction that knows measured friction shows; given: path of the case file."""
    view = prediction_view(case, data, str(given), details)
    if out is not None and "parameter" in data.dims:
        fitted = {"fitted.toml": lambda path: path.write_text(fitted_case(given, case, data, out), encoding="utf-8")}
        return replace(view, files={**view.files, **fitted})
    return view


def _short(title: str, data: "xarray.Dataset") -> Iterator[Any]:
    """Yield the fitted numbers, how good the fit is, and the best of the other models."""
    if title:
        yield Text(title, style="bold")
    yield from (f"model {data.attrs['model']}", parameter_table(data), *list(fit_notes(data))[:3])
    if "model" in data.dims:
        yield WholeKeys(few_rows(evidence_table(data), 4, spaced=False))
