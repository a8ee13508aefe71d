"""A solved case as it is shown."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.quantities.dimensions import in_columns
from stiction.report.answer import model_record
from stiction.report.files import comments_of, record, write_csv
from stiction.report.number_table import few_rows
from stiction.report.several_tables import several_table
from stiction.report.tables import curve_table, in_brief, outside_validity, rows_shown, run_notes, run_summary
from stiction.report.uncertainty_tables import band_lines
from stiction.report.view import Picture, View, picture
from stiction.solving.method_spread import METHOD

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case


_FEW = 5  # rows of a short answer


def run_view(case: "Case", data: "xarray.Dataset", all_rows: bool = False) -> View:
    """Return what a solved case shows."""

    def table(path: Path) -> None:
        wide = in_columns(data, METHOD, "by_method")
        wide = in_columns(wide, "quantile", "quantile", lambda share: f"q{round(100.0 * share):02d}")
        write_csv(wide, path, comments_of(data))

    def found() -> dict[str, Any]:
        answer = {} if case.is_several else {"answer": model_record(data)}
        measured = {} if case.measured is None else {"measured": case.measured.record()}
        return answer | record(data, case.subject.groups()) | measured

    def short() -> Iterator[Any]:
        yield from in_brief(case, data)
        yield few_rows(several_table(data) if case.is_several else curve_table(data), _FEW)

    return View(
        "curve", data, lambda: _parts(case, data, all_rows), found, {"curve.csv": table}, _pictures(case, data), short=short
    )


def _parts(case: "Case", data: "xarray.Dataset", all_rows: bool) -> Iterator[Any]:
    table = several_table(data, all_rows) if case.is_several else curve_table(data, all_rows)
    yield from (run_summary(case, data), "", table, "")
    if not all_rows and not case.is_several and (text := rows_shown(data)):
        yield from (Text(text, style="dim"), "")
    if "uncertain_inputs" in data.attrs:
        yield from (*band_lines(data), "")
    if "point_spacing" in data:
        from stiction.report.surface_tables import map_notes

        yield from (*map_notes(data), "")
    elif case.measured is not None:
        from stiction.report.surface_tables import roughness_notes, roughness_table

        yield from (roughness_table(case.measured, data), *roughness_notes(case.measured), "")
    yield from (Text(note, style="dim") for note in run_notes(data))
    if (beyond := outside_validity(data)) is not None:
        yield beyond


def _pictures(case: "Case", data: "xarray.Dataset") -> dict[str, Picture]:
    drawn = "several_pictures.several_figure" if case.is_several else "pictures.curve_figure"
    pictures = {"curve.png": picture("friction, contact area and load", drawn, data, case.title)}
    if "friction_coefficient_by_method" in data and not case.is_several:
        told = "friction by every way of finding asperities"
        pictures["band.png"] = picture(told, "method_pictures.method_spread_figure", data, case.title)
    if "friction_coefficient_quantile" in data and not case.is_several:
        drawn = "uncertainty_pictures.uncertainty_figure"
        pictures["uncertainty.png"] = picture("friction with its band", drawn, data, case.title)
    return pictures
