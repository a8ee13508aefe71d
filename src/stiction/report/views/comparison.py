"""A comparison of models as it is shown."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.answer import answer_lines, answer_record
from stiction.report.comparison_groups import groups_table
from stiction.report.comparison_rows import at_load_rows, comparison, comparison_rows, recommended_record
from stiction.report.files import write_netcdf, write_rows
from stiction.report.tables import comparison_summary, comparison_table, facts
from stiction.report.uncertainty_tables import models_band_table, spread_table, uncertain_notes
from stiction.report.view import Picture, View
from stiction.report.whole_keys import WholeKeys
from stiction.studies.prediction.unused import refusal_of

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case

# Rows of the answer that stand above the models, with mu.
_OF_ANSWER = ("friction force", "warning", "not used")


def comparison_view(
    case: "Case", data: "xarray.Dataset", prediction: "xarray.Dataset | None" = None, every: bool = False
) -> View:
    """Return what all models of a case show, below its prediction; every: each model in a row of its own, and all that is said
    of it."""
    measured = case.measured

    def parts() -> Iterator[Any]:
        if case.title:
            yield Text(case.title, style="bold")
        if prediction is not None:
            yield facts([row for row in answer_lines(prediction) if row[0] in _OF_ANSWER or row[0].startswith("mu")])
        elif (refusal := refusal_of(case)) is not None:
            yield facts([("no prediction", str(refusal))])
        yield from _every_model(case, data) if every or "working_load" not in data.attrs else groups_table(data)

    def record() -> dict[str, Any]:
        answer = recommended_record(data) if prediction is None else answer_record(prediction)
        return {"answer": answer} | comparison(data) | ({} if measured is None else {"measured": measured.record()})

    def compared() -> Any:
        from stiction.report.comparison_pictures import comparison_figure

        return comparison_figure(data, case.title)

    def spread() -> Any:
        from stiction.report.uncertainty_pictures import spread_figure

        return spread_figure(data, case.title)

    files = {
        "compare.csv": lambda path: write_rows(path, *comparison_rows(data)),
        "compare.nc": lambda path: write_netcdf(data, path),
    }
    if "working_load" in data.attrs:
        files["compare_at_load.csv"] = lambda path: write_rows(path, *at_load_rows(data))
    pictures = {"compare.png": Picture("friction against load by every model", compared)}
    if "spread_factor" in data:
        pictures["spread.png"] = Picture("what friction differs by: inputs, methods, models", spread)
    return View("compare", None, parts, record, files, pictures)


def _every_model(case: "Case", data: "xarray.Dataset") -> Iterator[Any]:
    """Yield a row for each model, and all that is said of them."""
    measured = case.measured
    yield from (WholeKeys(comparison_table(data)), *comparison_summary(data))
    if "spread_factor" in data:
        yield spread_table(data)
        if "uncertain_inputs" in data.attrs:
            yield from (WholeKeys(models_band_table(data)), *uncertain_notes(data))
    if measured is not None:
        from stiction.report.surface_tables import roughness_notes, roughness_table

        yield from (roughness_table(measured), *roughness_notes(measured))
        yield from (Text(f"doubtful: {doubt}", style="bold yellow") for doubt in measured.doubts)
