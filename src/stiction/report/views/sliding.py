"""A contact moved aside, as it is shown."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.files import comments_of, record, write_csv
from stiction.report.sliding import sliding_notes, sliding_table
from stiction.report.tables import in_brief, outside_validity, run_summary
from stiction.report.view import View, picture

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case


def sliding_view(case: "Case", data: "xarray.Dataset") -> View:
    """Return what the tangential force up to sliding shows."""

    def parts() -> Iterator[Any]:
        yield from (run_summary(case, data), "", sliding_table(data), "")
        yield from (Text(note, style="dim") for note in sliding_notes(data))
        if (beyond := outside_validity(data)) is not None:
            yield beyond

    def short() -> Iterator[Any]:
        yield from (*in_brief(case, data), sliding_table(data))

    files = {"sliding.csv": lambda path: write_csv(data, path, comments_of(data))}
    pictures = {
        "sliding.png": picture("tangential force against displacement", "sliding_pictures.sliding_figure", data, case.title)
    }
    return View("sliding", data, parts, lambda: record(data, case.subject.groups()), files, pictures, short=short)
