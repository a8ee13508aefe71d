"""Models against measured series: tables, sentences and files."""

from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from stiction.report.files import rows_of, write_rows
from stiction.report.table import Column, Table, notes, numbers, short
from stiction.report.view import View

if TYPE_CHECKING:
    import xarray


_HOW = {
    "printed": "as printed",
    "digitised": "read off a picture",
    "data file": "from a data file",
    "computed": "computed, to show the format",
}


def origin_lines(data: "xarray.Dataset") -> Iterator[Text]:
    """Title, source and what else is said of the values."""
    about = data.attrs
    if about["kind"] == "synthetic":
        yield Text("SYNTHETIC: these values were made up; nobody measured them.", style="bold yellow")
    if about["title"]:
        yield Text(about["title"], style="bold")
    where = [about["source"], about["place"], about["doi"], _HOW[about["read"]]]
    yield Text("; ".join(part for part in where if part))
    if about["note"]:
        yield Text(about["note"])
    count, quantities = data.sizes["row"], dict.fromkeys(map(str, data["quantity"].values))
    yield Text(f"{count} value{'s' * (count > 1)} of {' and '.join(quantities)}")


def validation_table(data: "xarray.Dataset") -> Table:
    """Model by model: grade, how many values it answers, how far it is off, and what it is outside of."""
    errors = {"bias": "mean ratio", "factor": "factor off"}
    if np.isfinite(data["error"].values).any():
        errors["in_errors"] = "in errors"
    rows = []
    for name in data["model"].values:
        one = data.sel(model=name)
        cells = [short(float(one[key]), 3) for key in errors]
        outside = Text(str(one["outside"].values), style="dim")
        rows.append([str(name), str(one["grade"].values), str(int(one["answered"])), *cells, outside])
    heads = numbers("values", *errors.values(), wrap=True)
    columns = [Column("model"), Column("grade", wrap=True), *heads, Column("outside of", wrap=True)]
    return Table(columns, rows, ruled=True, gap=1, whole=True)


def row_rows(data: "xarray.Dataset") -> tuple[list[str], list[list[Any]]]:
    """Heads and rows of a file: every measured value, and beside it what each model says, in SI units."""
    columns = ["quantity", "sample", "load", "measured", "error"]
    rows = zip(rows_of(data, columns), data["predicted"].values.T.tolist(), strict=True)
    return [*columns, *map(str, data["model"].values)], [[*row, *predicted] for row, predicted in rows]


def validation_record(data: "xarray.Dataset") -> dict[str, Any]:
    """All of it as data for JSON."""
    over_models = ("grade", "answered", "bias", "factor", "in_errors", "outside_validity")
    keys = ["model", *over_models, "predicted"]
    models = [dict(zip(keys, row, strict=True)) for row in rows_of(data, keys)]
    rows = {name: data[name].values.tolist() for name in ("quantity", "sample", "load", "measured", "error")}
    return {**data.attrs, "rows": rows, "models": models}


def validation_view(found: "Mapping[str, xarray.Dataset]") -> View:
    """Return what models against the measured series of these names show."""

    def parts() -> Iterator[Any]:
        for data in found.values():
            yield from (*origin_lines(data), validation_table(data))
            yield from notes(f"left out: {line}" for line in data.attrs["left_out"].splitlines())

    def record() -> dict[str, Any]:
        return {name: validation_record(data) for name, data in found.items()}

    files = {f"{name}.csv": partial(_write_rows, data) for name, data in found.items()}
    return View("validation", None, parts, record, files)


def _write_rows(data: "xarray.Dataset", path: Path) -> None:
    write_rows(path, *row_rows(data))
