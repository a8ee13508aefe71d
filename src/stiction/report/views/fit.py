"""Build the view of a fit: tables, sentences, files and pictures."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from stiction.quantities.shown import show
from stiction.report.files import record, rows_of, write_csv, write_rows
from stiction.report.table import Column, Table, numbers
from stiction.report.view import View, picture
from stiction.report.views.prediction import prediction_view
from stiction.studies.fit.predicted import fitted_case

if TYPE_CHECKING:
    import xarray

    from stiction.studies.fit.run import FitResult


def parameter_table(data: "xarray.Dataset") -> Table:
    """Return a table of the fitted parameters: best value, both ends of the 95 % interval, and searched range.

    data: result of `fit`. An end that the data do not determine is marked as open.
    """
    rows = []
    for number, name in enumerate(data["parameter"].values.tolist()):
        row, quantity = data.isel(parameter=number), name.partition(" (")[0].rpartition(".")[2]
        value, low, high, least, most = (
            show(float(row[key]), quantity, 4) for key in ("value", "low", "high", "least", "most")
        )
        ends = [f"{end} (open)" if bool(row[f"open_{side}"]) else end for end, side in ((low, "low"), (high, "high"))]
        rows.append([name, value, *ends, f"{least} to {most}"])
    return Table([Column("free", wrap=True), *numbers("best", "95 % from", "to", "searched")], rows, ranked=True)


def fit_notes(data: "xarray.Dataset") -> Iterator[Text]:
    """Yield notes on a fit: its quality, parameters that the data do not determine, and correlations of parameters."""
    used = data.attrs
    good = f"chi square {used['chi_square']:.4g} of " if "chi_square" in used else ""
    yield Text(f"{good}{used['values']} values, {used['free']} free; errors: {used['errors']}")
    for line in filter(None, used["verdict"].split("\n")):
        yield Text(line, style="yellow")
    names = data["parameter"].values
    for i, j in zip(*np.tril_indices(len(names), -1), strict=True):
        yield Text(f"correlation of {names[j]} and {names[i]}: {data['correlation'].values[i, j]:.3f}", style="dim")
    if used["stopped"]:
        yield Text("stopped before the end: predictions or other models are missing", style="bold")


def evidence_table(data: "xarray.Dataset") -> Table:
    """Return a table of the models that a fit compared, with the best supported by the data first.

    Columns: chi-square or scatter of the residuals, AICc, weight, and error of cross-validation; or why a model was not fitted.
    """
    left = "chi_square" if "chi_square" in data else "scatter"
    rows: list[list[Any]] = []
    for number, name in enumerate(data["model"].values.tolist()):
        result = data.isel(model=number)
        if str(result["why_not"].values):
            rows.append([name, Text(str(result["why_not"].values), style="dim"), "", "", ""])
            continue
        cells = [f"{float(result[key]):.4g}" for key in (left, "aicc")]
        rows.append([name, *cells, f"{float(result['weight']):.2g}", f"{float(result['cross_validation_error']):.3g}"])
    heads = left.replace("_", " "), "AICc", "weight", data["cross_validation_error"].attrs["long_name"]
    return Table([Column("model", wrap=True), *numbers(*heads, wrap=True)], rows, whole=True, ranked=True)


def parameter_rows(data: "xarray.Dataset") -> tuple[list[str], list[list[Any]]]:
    """Return the fitted parameters and their correlations as (column heads, rows) for a CSV file, in SI units."""
    keys = ["unit", "value", "low", "high", "open_low", "open_high", "standard_error"]
    heads = ["parameter", *keys]
    rows = zip(rows_of(data, heads), data["correlation"].values.tolist(), strict=True)
    return [*heads, *(f"correlation with {name}" for name in data["parameter"].values)], [[*row, *more] for row, more in rows]


def row_rows(data: "xarray.Dataset") -> tuple[list[str], list[list[Any]]]:
    """Return (column heads, rows) of a CSV file: measured and fitted values in SI units, and standardised residuals.

    A standardised residual is (measured - fitted)/standard error.
    """
    keys = ["sample", "quantity", "measured_load", "measured", "error", "fitted", "residual"]
    return keys, rows_of(data, keys)


_OTHERS = ("parameter", "other_parameter", "row", "model")


def fit_view(fit: "FitResult | tuple[Any, ...]", folder: Path | None = None) -> View:
    """Return the view (texts, tables, files and pictures) of a fit.

    fit: a fit, or the tuple (path of the case, case, prediction that uses measured friction, whether to show details, file of
    the measured friction). folder: output folder, to which the paths in the fitted case file are relative; None writes no case
    file.
    """
    if isinstance(fit, tuple):
        return _prediction_view(fit, folder)
    data, title = fit.data(), fit.plan.title

    def parts() -> Iterator[Any]:
        if title:
            yield Text(title, style="bold")
        yield from (f"model {data.attrs['model']}", "", parameter_table(data), "", *fit_notes(data))
        if "model" in data.dims:
            yield from ("", evidence_table(data))

    files = {
        "parameters.csv": lambda path: write_rows(path, *parameter_rows(data)),
        "residuals.csv": lambda path: write_rows(path, *row_rows(data)),
    }
    if folder is not None:
        files["fitted.toml"] = lambda path: path.write_text(fit.case_text(folder), encoding="utf-8")
    if names := [str(name) for name in data.data_vars if str(name).startswith("predicted_") and np.size(data[name])]:
        files["predictions.csv"] = lambda path: write_csv(data[names].drop_vars(_OTHERS, errors="ignore"), path)
    pictures = {
        "fit.png": picture("measured and fitted", "fit_pictures.fit_figure", data, title),
        "profiles.png": picture("likelihood along each fitted number", "fit_pictures.profile_figure", data),
    }
    return View("fit", data, parts, lambda: record(data, {}), files, pictures)


def _prediction_view(fit: tuple[Any, ...], out: Path | None) -> View:
    """Return the view of a prediction that uses measured friction.

    fit: (path of the case, case, prediction, whether to show details, file of the measured friction). out: output folder; None
    writes no case file.
    """
    path, case, data, details, measured = fit
    view = prediction_view(case, data, str(path), details, out is not None, measured=measured)
    if out is not None and "parameter" in data.dims:
        fitted = {"fitted.toml": lambda file: file.write_text(fitted_case(path, case, data, out), encoding="utf-8")}
        return replace(view, files={**view.files, **fitted})
    return view
