"""A comparison of models as it is shown."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.answer import answer_lines, answer_record
from stiction.report.comparison_groups import groups_of, groups_table
from stiction.report.comparison_rows import at_load_rows, comparison, comparison_rows
from stiction.report.files import write_netcdf, write_rows
from stiction.report.tables import facts
from stiction.report.view import MOST_LINES, View, lines_of, picture
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
    groups = groups_of(data, every) if "working_load" in data.attrs else []

    def parts() -> Iterator[Any]:
        above: list[Any] = [Text(case.title, style="bold")] if case.title else []
        if prediction is not None:
            above.append(facts([row for row in answer_lines(prediction) if row[0] in _OF_ANSWER or row[0].startswith("mu")]))
        elif (refusal := refusal_of(case)) is not None:
            above.append(facts([("no prediction", str(refusal))]))
        if not groups:
            above.append(Text("no model says anything of friction at a load above 0 here"))
        yield from above
        yield from groups_table(groups, None if every else MOST_LINES - sum(map(lines_of, above)))
        if every:
            yield from (Text(line) for line in data.attrs["criteria"].splitlines())
            yield from (Text(f"left out: {line}", style="dim") for line in data.attrs["left_out"].splitlines())
            if measured is not None:
                from stiction.report.surface_tables import roughness_notes, roughness_table

                yield from (roughness_table(measured), *roughness_notes(measured))

    def record() -> dict[str, Any]:
        answer = None if prediction is None else answer_record(prediction)
        return {"answer": answer} | comparison(data) | ({} if measured is None else {"measured": measured.record()})

    files = {
        "compare.csv": lambda path: write_rows(path, *comparison_rows(data)),
        "compare.nc": lambda path: write_netcdf(data, path),
    }
    pictures = {}
    if "working_load" in data.attrs:
        files["compare_at_load.csv"] = lambda path: write_rows(path, *at_load_rows(data))
        told = "friction at the working load by models that say the same"
        pictures["compare.png"] = picture(told, "model_pictures.models_figure", data, groups, prediction, case.title)
    return View("compare", None, parts, record, files, pictures)
