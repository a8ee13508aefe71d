"""Write results: one JSON object, or a folder with a table, a netCDF file and a picture."""

import csv
import io
import json
import math
import re
import shutil
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.laws.validity import warnings_of
from stiction.quantities.errors import InputError
from stiction.quantities.extras import installed
from stiction.quantities.paths import require_place
from stiction.report.answer import grade_line, model_line

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

_DOTS_PER_INCH = 150
_TOLD = ("normalised_by", "symbol", "long_name", "comment")  # attributes of a variable that go into JSON
_ABANDONED = 600.0  # s; a running program writes to its temporary folder more often than this


def as_json(content: Any, only_ascii: bool = False) -> str:
    """Return content as strict JSON text; NaN and infinities become null.

    content: nested dicts, lists, arrays, texts and numbers. only_ascii: whether to escape all characters outside ASCII.
    """
    return json.dumps(_plain(content), ensure_ascii=only_ascii, allow_nan=False, indent=2)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def unit_of(variable: "xarray.DataArray") -> str:
    """Return the unit of a variable or, if it is normalised, the formula of its divisor; "" if it has neither."""
    unit = variable.attrs.get("normalised_by") or variable.attrs.get("units", "")
    return "" if unit == "1" else unit


def record(data: "xarray.Dataset", groups: Mapping[str, float]) -> dict[str, Any]:
    """Return a result as a dict for JSON: its attributes, dimensionless groups, and variables.

    groups: dimensionless groups of the contact, by name. Each variable is a dict with unit, meaning, dimensions and values.
    """
    variables = {}
    for name in _names(data):
        variable = data[name]
        variables[name] = {
            "name": name,
            "unit": variable.attrs.get("units", "1"),
            **{key: variable.attrs[key] for key in _TOLD if key in variable.attrs},
            "dims": list(variable.dims),
            "values": variable.values,
        }
    warnings = [warning.as_data() for warning in warnings_of(data)]
    unused = json.loads(data.attrs.get("unused_inputs", "[]"))
    measured = json.loads(data.attrs.get("measured_error", "null"))
    attrs = {**data.attrs, "validity_warnings": warnings, "unused_inputs": unused, "measured_error": measured}
    return {"attrs": attrs, "groups": dict(groups), "variables": variables}


def _names(data: "xarray.Dataset") -> list[str]:
    """Return the names of all coordinates, followed by those of all variables."""
    return [str(name) for name in (*data.coords, *data.data_vars)]


def comments_of(data: "xarray.Dataset") -> list[str]:
    """Return comment lines for the CSV file of a result: model, validity warnings, inputs, and the meaning of each column.

    data: result of `solve` or a similar function.
    """
    used = data.attrs
    comments: dict[str, Any] = {
        "title": used.get("case") or used.get("title"),
        "program": used.get("program"),
        "model": model_line(used),
        "grade": grade_line(used),
        "validity warning": [str(warning) for warning in warnings_of(data)] or "none: within the claimed ranges",
        "measured error": used.get("measured_error_in_words"),
        "area": used.get("area_by"),
        "not used": used.get("inputs_not_used"),
        "remark": used.get("remarks"),
        "sources": used.get("sources"),
        "input": used.get("inputs", "").splitlines(),
        "scan": used.get("scans", "").splitlines(),
    }
    return comment_lines(comments, data)


def comment_lines(comments: Mapping[str, Any], data: "xarray.Dataset") -> list[str]:
    """Return comment lines "heading: text" for a CSV file, followed by the meaning of every column.

    comments: text, or list of texts, by heading; headings without text are left out. data: the dataset that the file holds.
    """
    columns = []
    for name in _names(data):
        variable, unit = data[name], unit_of(data[name])
        meaning = variable.attrs.get("comment") or variable.attrs.get("long_name") or "as given"
        columns.append(f"{name}: {meaning}" + (f" [{unit}]" if unit else ""))
    comments = {**comments, "column": columns, "read with": 'pandas.read_csv(path, comment="#")'}
    lines = [
        (head, text) for head, texts in comments.items() for text in (texts if isinstance(texts, list) else [texts]) if text
    ]
    return [" ".join(f"{head}: {text}".split()) for head, text in lines]


def write_csv(data: "xarray.Dataset", path: Path, comments: Iterable[str] = ()) -> None:
    """Write a dataset as CSV, with one column "name [unit]" for each coordinate and variable, in full precision.

    A variable that lacks a dimension is repeated along it. comments: lines to write above the table.
    """
    import xarray

    names = _names(data)
    heads = [f"{name} [{unit}]" if (unit := unit_of(data[name])) else name for name in names]
    columns = xarray.broadcast(*(data[name] for name in names))
    write_rows(path, heads, zip(*(column.values.ravel().tolist() for column in columns), strict=True), comments)


def rows_of(data: "xarray.Dataset", names: Iterable[str]) -> list[list[Any]]:
    """Return one-dimensional variables of a dataset as table rows: a list of lists, with one column for each name."""
    return [list(row) for row in zip(*(data[name].values.tolist() for name in names), strict=True)]


def write_rows(path: Path, heads: Iterable[str], rows: Iterable[Iterable[Any]], comments: Iterable[str] = ()) -> None:
    """Write a CSV file: comment lines, one line of column heads, then the rows."""
    with path.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {line}\n" for line in comments)
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heads)
        writer.writerows(rows)


def write_netcdf(data: "xarray.Dataset", path: Path) -> None:
    """Write a dataset as a netCDF4 file, to be read by xarray.open_dataset(path).

    The file is built in memory first, because the netCDF library aborts the process on a full disk.
    """
    made = io.BytesIO()
    data.to_netcdf(made, engine="h5netcdf")
    path.write_bytes(made.getbuffer())


def write_picture(figure: "Figure", path: Path) -> None:
    """Write a figure as a PNG file."""
    figure.savefig(path, dpi=_DOTS_PER_INCH)


def undrawn_of(names: Iterable[str]) -> list[str]:
    """Return the file names that end in .png if matplotlib, which draws them, is not installed; otherwise []."""
    return [] if installed("matplotlib") else [name for name in names if name.endswith(".png")]


def check_folder(folder: Path) -> None:
    """Raise InputError if no output folder can be created at this path, so that the error comes before the computation."""
    require_place(folder, "a folder, new or existing")
    if folder.exists() and not folder.is_dir():
        raise InputError("--out", str(folder), "a new or existing folder, but this is a file")


def write_folder(folder: Path, files: Mapping[str, Callable[[Path], None]]) -> None:
    """Write files into a folder, which is created if it is missing.

    files: file name -> function that writes the file to a path. All files are written to a temporary folder first, and moved
    when all are complete. Files with other names stay in the folder. PNG files are skipped if matplotlib is not installed.
    Raises InputError if a file cannot be written.
    """
    check_folder(folder)
    undrawn = set(undrawn_of(files))
    files = {name: write for name, write in files.items() if name not in undrawn}
    folder = folder.resolve()
    try:
        place = folder if folder.exists() else folder.parent  # the same file system, so that files can be moved
        place.mkdir(parents=True, exist_ok=True)
        _clear_abandoned(folder)
        with tempfile.TemporaryDirectory(dir=place, prefix=f".{folder.name}-") as temporary:
            made = Path(temporary) / "files"  # mkdir gives the usual permissions, a temporary folder is private
            made.mkdir()
            for name, write in files.items():
                write(made / name)
            if not folder.exists():
                made.replace(folder)
                return
            for name in files:
                (made / name).replace(folder / name)
    except OSError as error:
        raise InputError(
            "--out", str(folder), f"a folder that can be written; the system reports: {error.strerror or error}"
        ) from None


def _clear_abandoned(folder: Path) -> None:
    """Remove the temporary folders that killed programs left in or next to the output folder `folder`.

    A temporary folder is removed if nothing was written to it during the last ten minutes.
    """
    made_up = re.compile(rf"\.{re.escape(folder.name)}-[a-z0-9_]{{8}}")  # names that tempfile makes
    for beside in (*folder.glob(".*"), *folder.parent.glob(".*")):
        if made_up.fullmatch(beside.name) and beside.is_dir() and not beside.is_symlink():
            inside = [path.name for path in beside.iterdir()]
            written = [path.lstat().st_mtime for path in (beside, *beside.rglob("*"))]
            if inside in ([], ["files"]) and max(written) < time.time() - _ABANDONED:
                shutil.rmtree(beside, ignore_errors=True)
