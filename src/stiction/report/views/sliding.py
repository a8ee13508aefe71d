"""Build the view of `slide`, the tangential force from rest to sliding: a table, sentences, files and pictures."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stiction.quantities.extras import installed
from stiction.report.files import comments_of, record, write_csv
from stiction.report.table import Table, notes
from stiction.report.tables import curve_table, in_brief, outside_validity, run_notes, run_summary
from stiction.report.view import View, picture

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case


_HEADS = {
    "mean_separation": "separation",
    "load": "load",
    "friction_coefficient": "mu",
    "largest_friction_coefficient": "largest F/P",
    "sliding_displacement": "at displacement",
    "tangential_stiffness": "stiffness",
}


_ONE_MODEL = "This is mu of one model. `stiction run` predicts mu of the contact, with its interval."


def sliding_table(data: "xarray.Dataset") -> Table:
    """Return a table of a result of `slide`, one row for each load.

    Columns: separation, load, mu, largest tangential force over load, displacement of this force, tangential stiffness at rest.
    """
    return curve_table(data.drop_dims("displacement"), True, _HEADS)


def sliding_notes(data: "xarray.Dataset") -> Iterator[str]:
    """Yield notes on a result of `slide`, one line each."""
    used = data.attrs
    yield f"mu assumes that all contacts reach full strength at the same time; {used['sliding']}"
    if used["residual_strength"] == 1.0 and "sheared_contact_area" not in data:
        yield "the tangential force approaches mu times the load; the table has the displacement at 99 % of this limit"
    yield from run_notes(data)


def _animate(data: "xarray.Dataset", path: Path) -> None:
    from stiction.report.sliding_pictures import write_animation  # imports matplotlib

    write_animation(data, path)


def sliding_view(case: "Case", data: "xarray.Dataset") -> View:
    """Return the view (texts, tables, files and pictures) of a result of `slide`.

    data: the result for the case.
    """
    numbers = data.drop_dims(["row", "column"], errors="ignore")  # a solved map also has the state of each of its points

    def parts() -> Iterator[Any]:
        yield from (run_summary(case, data), "", sliding_table(numbers), "")
        yield from notes(sliding_notes(data))
        yield _ONE_MODEL
        yield from outside_validity(data)

    def short() -> Iterator[Any]:
        yield from (*in_brief(case, data), sliding_table(numbers), _ONE_MODEL)

    files = {"sliding.csv": lambda path: write_csv(numbers, path, comments_of(data))}
    if {"row", "displacement"} <= set(data.dims) and installed("matplotlib"):
        files["sliding.gif"] = lambda path: _animate(data, path)
    pictures = {
        "sliding.png": picture("tangential force against displacement", "sliding_pictures.sliding_figure", data, case.title)
    }
    return View("sliding", data, parts, lambda: record(numbers, case.subject.groups()), files, pictures, short=short)
