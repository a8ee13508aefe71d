"""Tables of the command line as tables of a page."""

from dataclasses import dataclass
from typing import Any

from rich.table import Table as Printed
from rich.text import Text

__all__ = ["Table", "of_printed"]


@dataclass(frozen=True)
class Table:
    """A table of a page. The first cell of a row is its head; numbers: of each column whether it stands at the right; marked: of
    each row its look, "" or "best" or "faint"."""

    caption: str
    heads: list[str]
    rows: list[list[str]]
    numbers: list[bool]
    marked: list[str]


def of_printed(printed: Printed, caption: str) -> Table:
    """What the command line prints, as it stands there."""
    heads = [_plain(column.header).replace("\n", " ") for column in printed.columns]
    cells = [[_plain(cell) for cell in column.cells] for column in printed.columns]
    rows = [list(row) for row in zip(*cells, strict=True)]
    looks = [_look(str(row.style or "")) for row in printed.rows]
    return Table(caption, heads, rows, [column.justify == "right" for column in printed.columns], looks)


def _plain(content: Any) -> str:
    return content.plain if isinstance(content, Text) else Text.from_markup(str(content)).plain


def _look(style: str) -> str:
    return "best" if "bold" in style else "faint" if "dim" in style else ""
