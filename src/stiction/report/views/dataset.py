"""Build the view (terminal tables and files) of a study result for which no special view exists."""

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.quantities.sampling import spread_rows
from stiction.report.files import record, write_csv
from stiction.report.table import Table, facts, numbers, with_unit
from stiction.report.view import View

if TYPE_CHECKING:
    import xarray

_ROWS, _COLUMNS = 12, 6


def dataset_view(name: str, data: "xarray.Dataset") -> View:
    """Return the view of any dataset: its single values, and for each dimension a table and a CSV file.

    name: name of the study, which begins the names of the files.
    """
    ordered = [*data.coords, *data.data_vars]
    columns = {str(along): [variable for variable in ordered if data[variable].dims == (along,)] for along in data.dims}

    def parts() -> Iterator[Any]:
        if "case" in data.attrs:
            yield Text(data.attrs["case"], style="bold")
        yield facts([(str(variable), _cell(data[variable])) for variable in data.data_vars if not data[variable].dims])
        for along, names in columns.items():
            shown = names[:_COLUMNS]
            rows = [[_cell(data[variable][row]) for variable in shown] for row in spread_rows(data.sizes[along], _ROWS)]
            yield Table(numbers(*map(str, shown), wrap=True), rows)
            if len(names) > _COLUMNS:
                yield Text(f"{len(names) - _COLUMNS} more columns are in {name}_{along}.csv (--out)", style="dim")

    files = {f"{name}_{along}.csv": partial(write_csv, data[names]) for along, names in columns.items() if names}
    return View(name, data, parts, lambda: record(data, {}), files)


def _cell(value: "xarray.DataArray") -> str:
    return with_unit(value) if value.dtype.kind in "fiu" else str(value.item())
