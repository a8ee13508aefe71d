"""Build the view of a design study: tables, sentences, files and pictures."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from stiction.quantities.table import QUANTITIES
from stiction.report.files import record, write_csv
from stiction.report.table import Table, numbers, shown
from stiction.report.view import View, picture
from stiction.solving.choice import RECOMMENDED
from stiction.studies.design.plan import quantity_of

if TYPE_CHECKING:
    import xarray

    from stiction.studies.design.run import DesignSearch


_ROWS = 12


def columns_of(data: "xarray.Dataset", along: str) -> dict[str, str]:
    """Return the names of the variables along a dimension of a design result, by column name.

    along: "design" for the best designs, "pareto" for the Pareto front, "evaluated" for all evaluated designs. The column name
    is the variable name without that prefix.
    """
    before = "" if along == "design" else f"{along}_"
    names = [str(name) for name in data.data_vars if data[name].dims == (along,)]
    return {name.removeprefix(before): name for name in names}


def design_table(data: "xarray.Dataset", along: str) -> Table:
    """Return a table of the designs along a dimension, one row for each, at most twelve.

    data: result of `design`. along: "design" or "pareto", as for `columns_of`.
    """
    columns = columns_of(data, along)
    shown_columns = [name for name in columns if name not in ("constraint_violation", "violated")]
    rows = [[_cell(name, data[columns[name]].values[row]) for name in shown_columns] for row in range(data.sizes[along])]
    return Table(numbers(*map(_head, shown_columns), wrap=True), rows, ranked=along == "design").few(_ROWS)


def _head(name: str) -> str:
    last = name.rpartition(".")[2]
    if name.endswith("_off_target"):
        return "off target"
    if last != quantity_of(last):
        return f"{QUANTITIES[quantity_of(last)].symbol} {last.rpartition('_')[2]}"
    return {"feasible": "constraints"}.get(last, QUANTITIES[last].symbol if last in QUANTITIES else last.replace("_", " "))


def _cell(name: str, value: Any) -> str:
    if name == "feasible":
        return "met" if value else "violated"
    if name.endswith("_off_target"):
        percent = 100.0 * float(value)
        return f"{percent:+.3g} %" if abs(percent) >= 0.005 else "0 %"
    last = name.rpartition(".")[2]
    if isinstance(value, str | np.str_):
        return str(value)
    return shown(float(value), quantity_of(last), 3) if quantity_of(last) in QUANTITIES else f"{float(value):.3g}"


def design_notes(data: "xarray.Dataset") -> Iterator[Text]:
    """Yield notes on a design result: its objectives and constraints, and whether they are met."""
    used = data.attrs
    yield Text("objective: " + "; ".join(used["objectives"].split("\n")))
    if used["limits"]:
        yield Text("limits: " + "; ".join(used["limits"].split("\n")))
    if used["uncertain"]:
        yield Text(f"uncertain inputs ({used['uncertain']}): objectives and limits hold for 95 % of the samples")
    for words in filter(None, used["missed"].split("\n")):
        yield Text(
            f"objective missed: {words.replace('_', ' ')}; widen the ranges or choose another number", style="bold yellow"
        )
    if used["verdict"]:
        yield Text(used["verdict"], style="bold yellow")
    for row in range(min(data.sizes["design"], _ROWS)):
        for words in filter(None, data["violated"].values[row].split("\n")):
            yield Text(f"violated{_which(data, row)}: {words}", style="yellow")
    if used["stopped"]:
        yield Text("stopped before the end: the best so far", style="bold")


def _which(data: "xarray.Dataset", row: int) -> str:
    """Return a text in brackets that identifies a design; "" if there is only one design.

    The text states what was chosen from the lists of the case, or "design N", counted from 1, if the case has no lists. row:
    index of the design.
    """
    taken = [
        data[name].values[row]
        for name in data.data_vars
        if name != "violated" and data[name].dims == ("design",) and data[name].dtype.kind in "UO"
    ]
    return f" ({', '.join(map(str, taken)) or f'design {row + 1}'})" if data.sizes["design"] > 1 else ""


def design_view(design: "DesignSearch", folder: Path | None = None) -> View:
    """Return the view (texts, tables, files and pictures) of a design study.

    folder: output folder, to which the paths in the designed case file are relative; None writes no case file.
    """
    data = design.data()

    def parts() -> Iterator[Any]:
        if "case" in data.attrs:
            yield Text(data.attrs["case"], style="bold")
        model = data.attrs["model"]
        by = "the prediction" if model == RECOMMENDED else f"the model {model}"
        yield from (
            f"{data.attrs['evaluated']} designs evaluated by {by}; with several loads, columns are values at the worst load",
            "",
        )
        yield "best for each choice from the lists" if data.sizes["design"] > 1 else "best"
        yield from (design_table(data, "design"), "", *design_notes(data))
        if data.sizes.get("pareto"):
            yield from (
                "",
                "Pareto front: no design improves one objective without worsening the other",
                design_table(data, "pareto"),
            )

    files: dict[str, Any] = {}
    for along in ("design", *(["pareto"] if data.sizes.get("pareto") else [])):
        columns = {name: head for head, name in columns_of(data, along).items()}
        files[f"{along}.csv"] = partial(write_csv, data[list(columns)].rename(columns).drop_vars(along, errors="ignore"))
    if folder is not None:
        files["designed.toml"] = lambda path: path.write_text(design.case_text(folder), encoding="utf-8")
    missed = [f"Objective missed: {words.replace('_', ' ')}." for words in data.attrs["missed"].split("\n") if words]
    pictures = {"design.png": picture("designs, the nearest to the objective first", "design_pictures.design_figure", data)}
    return View("design", data, parts, lambda: record(data.drop_dims("evaluated"), {}), files, pictures, tuple(missed))
