"""A design as it is shown."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.design_tables import design_notes, design_rows, design_table
from stiction.report.files import record, write_rows
from stiction.report.number_table import few_rows
from stiction.report.view import Picture, View

if TYPE_CHECKING:
    from stiction.studies.design.run import Designing


def design_view(found: "Designing", folder: Path | None = None) -> View:
    """Return what a design shows. folder: where its files go, from which the designed case names other files."""
    data = found.data()

    def parts() -> Iterator[Any]:
        if "case" in data.attrs:
            yield Text(data.attrs["case"], style="bold")
        yield from (f"model {data.attrs['model']}; {data.attrs['asked']} designs asked", "")
        yield "best for each choice from the lists" if data.sizes["design"] > 1 else "best"
        yield from (design_table(data, "design"), "")
        if data.sizes.get("front"):
            yield from ("none is better in both wishes than any of these", design_table(data, "front"), "")
        yield from design_notes(data)

    def short() -> Iterator[Any]:
        if "case" in data.attrs:
            yield Text(data.attrs["case"], style="bold")
        yield f"model {data.attrs['model']}; {data.attrs['asked']} designs asked"
        yield few_rows(design_table(data, "design"), 4, spaced=False)
        yield from design_notes(data)
        if data.sizes.get("front"):
            yield few_rows(design_table(data, "front"), 4)

    def drawn() -> Any:
        from stiction.report.design_pictures import design_figure

        return design_figure(data)

    files = {"design.csv": lambda path: write_rows(path, *design_rows(data, "design"))}
    if data.sizes.get("front"):
        files["front.csv"] = lambda path: write_rows(path, *design_rows(data, "front"))
    if folder is not None:
        files["designed.toml"] = lambda path: path.write_text(found.case_text(folder), encoding="utf-8")
    missed = [f"Objective missed: {words}." for words in data.attrs["missed"].split("\n") if words]
    pictures = {"design.png": Picture("designs by how near they come to the wish", drawn)}
    return View("design", data, parts, lambda: record(data.drop_vars("best_so_far"), {}), files, pictures, tuple(missed), short)
