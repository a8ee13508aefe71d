"""Build the view of a validation: how well the models and the prediction agree with measured series."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from stiction.quantities.shown import span
from stiction.report.files import rows_of, write_rows
from stiction.report.table import Column, Table, notes, numbers, short, shown
from stiction.report.view import View, picture

if TYPE_CHECKING:
    import xarray


_HOW = {
    "printed": "as printed",
    "digitised": "read from a figure",
    "data file": "from a data file",
    "computed": "computed, to show the format",
}


def origin_lines(data: "xarray.Dataset") -> Iterator[Text]:
    """Yield title, source, note and number of values of a measured series; synthetic data begin with a warning."""
    about = data.attrs
    if about["kind"] == "synthetic":
        yield Text("SYNTHETIC: these values were made up; they were not measured.", style="bold yellow")
    if about["title"]:
        yield Text(about["title"], style="bold")
    where = [about["source"], about["place"], about["doi"], _HOW[about["read"]]]
    yield Text("; ".join(part for part in where if part))
    if about["note"]:
        yield Text(about["note"])
    count, quantities = data.sizes["row"], dict.fromkeys(map(str, data["quantity"].values))
    yield Text(f"{count} value{'s' * (count > 1)} of {' and '.join(quantities)}")


def validation_table(data: "xarray.Dataset") -> Table:
    """Return a table of the models: grade, number of predicted values, error, and violated validity ranges."""
    errors = {"bias": "mean ratio", "factor": "factor off"}
    if np.isfinite(data["error"].values).any():
        errors["in_errors"] = "in errors"
    rows = []
    for name in data["model"].values:
        result = data.sel(model=name)
        cells = [short(float(result[key]), 3) for key in errors]
        outside = Text(str(result["outside"].values), style="dim")
        rows.append([str(name), str(result["grade"].values), str(int(result["answered"])), *cells, outside])
    heads = numbers("values", *errors.values(), wrap=True)
    columns = [Column("model"), Column("grade", wrap=True), *heads, Column("outside of", wrap=True)]
    return Table(columns, rows, ruled=True, gap=1, whole=True)


def prediction_table(data: "xarray.Dataset") -> Table | None:
    """Return a table of measured and predicted friction at each load; None if nothing was predicted.

    Each row states whether the 50 % and the 90 % interval contain the measured value.
    """
    rows = []
    for index in np.flatnonzero(np.isfinite(data["prediction"].sel(quantile=0.5))):
        result = data.isel(row=index)
        ends = {float(q): float(value) for q, value in zip(data["quantile"].values, result["prediction"].values, strict=True)}
        measured = span((float(result["measured_low"]), float(result["measured_high"])))
        intervals = [f"{ends[first]:.2g} to {ends[last]:.2g}" for first, last in ((0.25, 0.75), (0.05, 0.95))]
        words = [f"{text}, {result[f'within_{share}'].item()}" for text, share in zip(intervals, (50, 90), strict=True)]
        rows.append([shown(float(result["load"]), "load", 3), measured, f"{ends[0.5]:.2g}", *words])
    columns = [Column("load"), *numbers("measured", "predicted"), *(Column(head) for head in ("50% interval", "90% interval"))]
    return Table(columns, rows, ruled=True) if rows else None


def row_rows(data: "xarray.Dataset") -> tuple[list[str], list[list[Any]]]:
    """Return (column heads, rows) with measured and predicted values in SI units, for a CSV file."""
    columns = ["quantity", "sample", "load", "measured", "error"]
    levels = [f"prediction_{level:g}" for level in data["quantile"].values]
    rows = zip(rows_of(data, columns), data["prediction"].values.T.tolist(), data["predicted"].values.T.tolist(), strict=True)
    heads = [*columns, *levels, *map(str, data["model"].values)]
    return heads, [[*row, *prediction, *predicted] for row, prediction, predicted in rows]


def validation_record(data: "xarray.Dataset") -> dict[str, Any]:
    """Return all results of one measured series as a dict for JSON."""
    over_models = ("grade", "answered", "bias", "factor", "in_errors", "outside_validity")
    keys = ["model", *over_models, "predicted"]
    models = [dict(zip(keys, row, strict=True)) for row in rows_of(data, keys)]
    over_rows = ("quantity", "sample", "load", "measured", "error", "measured_low", "measured_high", "within_50", "within_90")
    rows = {name: data[name].values.tolist() for name in over_rows}
    prediction = {f"{level:g}": data["prediction"].sel(quantile=level).values.tolist() for level in data["quantile"].values}
    return {**data.attrs, "rows": rows | {"prediction": prediction}, "models": models}


def validation_view(series: "Mapping[str, xarray.Dataset]") -> View:
    """Return the view of models and prediction compared with measured series.

    series: result of `validate` by name of the series.
    """

    def parts() -> Iterator[Any]:
        for data in series.values():
            yield from origin_lines(data)
            if (predicted := prediction_table(data)) is not None:
                yield predicted
            yield validation_table(data)
            yield from notes(f"not applicable: {line}" for line in data.attrs["not_applicable"].splitlines())

    def record() -> dict[str, Any]:
        return {name: validation_record(data) for name, data in series.items()}

    files = {f"{name}.csv": lambda path, data=data: write_rows(path, *row_rows(data)) for name, data in series.items()}
    pictures = {
        f"{name}.png": picture("measured friction and its prediction", "prediction_pictures.validation_figure", data)
        for name, data in series.items()
        if np.isfinite(data["prediction"]).any()
    }
    return View("validation", None, parts, record, files, pictures)
