"""A sensitivity study as it is shown."""

from collections.abc import Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from rich.table import Table
from rich.text import Text

from stiction.report.answer import answer_record, headline
from stiction.report.files import record, write_csv
from stiction.report.number_table import few_rows
from stiction.report.sensitivity_tables import elasticities_table, indices_table, sensitivity_notes, share_tables
from stiction.report.view import Picture, View
from stiction.report.views.prediction import plain
from stiction.report.whole_keys import WholeKeys

if TYPE_CHECKING:
    import xarray

_SHARE = "friction_coefficient_share"
# Table -> dimension of its rows.
_TABLES = {"sensitivity.csv": "input", "elasticities.csv": "number"}


def sensitivity_view(data: "xarray.Dataset", groups: Mapping[str, float] | None = None) -> View:
    """Return what a sensitivity study shows."""

    def parts() -> Iterator[Any]:
        if _SHARE in data:
            yield from (Text(f"{data.attrs['case']}: {headline(data)}".removeprefix(": "), style="bold"), *share_tables(data))
            return
        if "input" in data.dims:
            yield from (WholeKeys(indices_table(data)), "")
        yield from (elasticities_table(data), "", *sensitivity_notes(data))

    def short() -> Iterator[Any]:
        for part in parts():
            table = part.table if isinstance(part, WholeKeys) else part
            yield few_rows(table, 5, spaced=False) if isinstance(table, Table) else part

    def drawn() -> Any:
        from stiction.report.sensitivity_pictures import sensitivity_figure

        return sensitivity_figure(data)

    def found() -> dict[str, Any]:
        if _SHARE not in data:
            return record(data, groups or {})
        slopes = dict(zip(data["number"].values.tolist(), data["friction_coefficient_elasticity"].values.tolist(), strict=True))
        return {"answer": answer_record(data), "elasticities": slopes}

    files = {
        name: partial(write_csv, data[[one for one in data.data_vars if dim in data[one].dims]])
        for name, dim in _TABLES.items()
        if dim in data.dims
    }
    pictures = {"sensitivity.png": Picture("inputs by what they change", drawn)}
    return View("sensitivity", plain(data), parts, found, files, pictures, short=short)
