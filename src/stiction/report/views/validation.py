"""Models against measured series, as they are shown."""

from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.files import write_rows
from stiction.report.validation_tables import origin_lines, row_rows, validation_record, validation_table
from stiction.report.view import View
from stiction.report.whole_keys import WholeKeys

if TYPE_CHECKING:
    import xarray


def validation_view(found: "Mapping[str, xarray.Dataset]") -> View:
    """Return what models against the measured series of these names show."""

    def parts() -> Iterator[Any]:
        for data in found.values():
            yield from (*origin_lines(data), WholeKeys(validation_table(data)))
            yield from (Text(f"left out: {line}", style="dim") for line in data.attrs["left_out"].splitlines())

    def record() -> dict[str, Any]:
        return {name: validation_record(data) for name, data in found.items()}

    files = {f"{name}.csv": partial(_write_rows, data) for name, data in found.items()}
    return View("validation", None, parts, record, files)


def _write_rows(data: "xarray.Dataset", path: Path) -> None:
    write_rows(path, *row_rows(data))
