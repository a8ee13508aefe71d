"""Represent a result for all outputs: terminal text, files, pictures and JSON."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from stiction.contact.contact import Contact
from stiction.report.files import write_folder, write_netcdf, write_picture
from stiction.report.table import Table

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from stiction.contact.subject import Subject

MOST_LINES = 15  # largest number of lines of a short answer on a terminal of 80 columns
_COLUMNS, _ROWS, _LEAST_ROWS = 80, 5, 3


def lines_of(part: Any, columns: int = _COLUMNS) -> int:
    """Return how many lines a text or a table takes on a terminal that is `columns` characters wide."""
    from rich.text import Text

    from stiction.report.terminal import Terminal

    console = Terminal(width=columns)
    return len(console.render_lines(Text(part) if isinstance(part, str) else part, console.options, pad=False))


def in_short(parts: Iterable[Any], columns: int = _COLUMNS, written: bool = False) -> Iterator[Any]:
    """Yield the parts of an answer that fit into MOST_LINES lines, then a line on how to see the rest.

    parts: texts and tables. Tables are shortened to five rows; ranked tables to three or four if more tables then fit. A part
    that does not fit is left out. columns: width of the terminal in characters. written: whether to reserve room for a line
    about the written files.
    """
    parts, most = [*filter(None, parts)], MOST_LINES - 1 - 2 * written
    shown = _fitting(parts, _ROWS, columns, most)
    if len(shown) < len(parts):
        fewer = (_fitting(parts, rows, columns, most) for rows in range(_ROWS - 1, _LEAST_ROWS - 1, -1))
        shown = max(shown, *fewer, key=_tables_in)
    yield from shown
    yield "Details: --details"


def _fitting(parts: Iterable[Any], rows: int, columns: int, most: int) -> list[Any]:
    """Return the parts that fit into `most` lines, with `rows` rows of each ranked table.

    parts: texts and tables of an answer. Tables without a ranking have at most five rows. columns: width of the terminal in
    characters. A part that does not fit is omitted; later, shorter parts may still fit.
    """
    shown: list[Any] = []
    for part in parts:
        part = part.few(rows if part.ranked else _ROWS) if isinstance(part, Table) else part
        lines = lines_of(part, columns)
        if lines <= most:
            most -= lines
            shown.append(part)
    return shown


def _tables_in(parts: list[Any]) -> tuple[int, int]:
    """Return the number of ranked tables, and of all tables, among the parts of an answer."""
    tables = [part for part in parts if isinstance(part, Table)]
    return sum(table.ranked for table in tables), len(tables)


class Picture(NamedTuple):
    """Store how to draw a picture, so that it is drawn only when it is needed.

    description: text for screen readers. draw: function that returns the figure.
    """

    description: str
    draw: "Callable[[], Figure]"

    def write(self, path: Path) -> None:
        """Draw the picture and write it to a file."""
        write_picture(self.draw(), path)


def picture(description: str, place: str, *arguments: Any) -> Picture:
    """Return a Picture that a function of this package draws from the given arguments.

    place: the function as "module.function". It is imported only when the picture is drawn, because matplotlib may be missing.
    """

    def draw() -> "Figure":
        module, _, name = place.partition(".")
        figure: Figure = getattr(import_module(f"stiction.report.{module}"), name)(*arguments)
        return figure

    return Picture(description, draw)


def regime_picture(subject: "Subject", data: "xarray.Dataset", title: str) -> dict[str, Picture]:
    """Return the picture of the adhesion and plasticity maps of a contact, by file name.

    The dict is empty for dimensionless groups, and for a coated contact without adhesion. data: result of the contact.
    """
    if not isinstance(subject, Contact) or (subject.coating is not None and not subject.work_of_adhesion):
        return {}
    description = "the contact on maps of adhesion and of plasticity"
    return {"regimes.png": picture(description, "regime_pictures.regime_figure", subject, data, title)}


@dataclass(frozen=True)
class View:
    """Store the texts, tables, files and pictures of one result, for terminal, page and files.

    data: the dataset, written as `name`.nc; None if there is none. parts: function that returns all texts and tables for a
    terminal. record: function that returns the content for JSON. files: functions that write a file to a path, by file name.
    pictures: pictures by file name. warnings: sentences. short: function that returns the short answer, most important part
    first; by default it is `parts`. is_brief: whether `parts` already is the short answer.
    """

    name: str
    data: "xarray.Dataset | None"
    parts: Callable[[], Iterable[Any]]
    record: Callable[[], dict[str, Any]]
    files: Mapping[str, Callable[[Path], None]] = field(default_factory=dict)
    pictures: Mapping[str, Picture] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    short: Callable[[], Iterable[Any]] | None = None
    is_brief: bool = False

    def writers(self) -> dict[str, Callable[[Path], None]]:
        """Return, by file name, the functions that write the tables, the dataset and the pictures to a path."""
        files, data = dict(self.files), self.data
        if data is not None:
            files[f"{self.name}.nc"] = lambda path: write_netcdf(data, path)
        return files | {name: drawn.write for name, drawn in self.pictures.items()}

    def write(self, folder: Path) -> list[str]:
        """Write tables, dataset and pictures to a folder, and return the file names."""
        files = self.writers()
        write_folder(folder, files)
        return list(files)
