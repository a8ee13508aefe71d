"""Tables of the command line as tables of a page."""

from dataclasses import dataclass, field
from typing import Any

from rich.table import Table as Printed
from rich.text import Text

from stiction.report.html_words import letters


@dataclass(frozen=True)
class Table:
    """A table of a page. The first cell of a row is its head, and a cell may be a list of lines.

    numbers: of each column whether it stands at the right; marked: of each row its look, "" or "best" or "faint". Cells under
    FORMULAS are of the table of quantities. stacked: where there is little room, cells stand below one another, each beside
    the head of its column.
    """

    caption: str
    heads: list[str]
    rows: list[list[Any]]
    numbers: list[bool] = field(default_factory=list)
    marked: list[str] = field(default_factory=list)
    stacked: bool = False

    def right(self, column: int) -> bool:
        """Whether a column is of numbers."""
        return column < len(self.numbers) and self.numbers[column]

    def look(self, row: int) -> str:
        """How a row is marked."""
        return self.marked[row] if row < len(self.marked) else ""


# Columns whose cells are symbols and meanings of the table of quantities.
FORMULAS = ("symbol", "quantity", "group")


def of_printed(printed: Printed, caption: str) -> Table:
    """What the command line prints, as it stands there."""
    heads = [letters(_plain(column.header).replace("\n", " ")) for column in printed.columns]
    cells = [[_plain(cell) for cell in column.cells] for column in printed.columns]
    rows = [list(row) for row in zip(*cells, strict=True)]
    looks = ["best" if "bold" in str(row.style) else "faint" if "dim" in str(row.style) else "" for row in printed.rows]
    return Table(caption, heads, rows, [column.justify == "right" for column in printed.columns], looks)


def _plain(content: Any) -> str:
    return content.plain if isinstance(content, Text) else Text.from_markup(str(content)).plain
