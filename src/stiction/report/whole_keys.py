"""Tables whose first column can be copied: names stand whole on a terminal of any width."""

from collections.abc import Iterator
from copy import copy
from dataclasses import fields
from typing import Any

from rich.cells import cell_len
from rich.console import Console, ConsoleOptions
from rich.segment import Segment
from rich.table import Column, Table
from rich.text import Text

_MARK = "\ue000"  # of private use: no name has it
_WIDE = 10_000


class WholeKeys:
    """A table whose first column is never broken: a name that has no room beside its row stands on a line above it."""

    def __init__(self, table: Table):
        self.table = table

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[Any]:
        names = [str(cell) for cell in self.table.columns[0].cells]
        room = self._room(names, console, options)
        above = [name for name in names if len(name) > room]
        table = self._with_names([_MARK if name in above else name for name in names], room)
        for line in console.render_lines(table, options, pad=False):
            if not any(_MARK in part.text for part in line):
                yield from (*line, Segment.line())
                continue
            style = next(part.style for part in line if _MARK in part.text)
            edge = "".join(part.text for part in line).partition(_MARK)[0]
            yield from (Segment(edge + above.pop(0), style), Segment.line())

    def _room(self, names: list[str], console: Console, options: ConsoleOptions) -> int:
        """What all other columns leave to the names: as wide as they would be, if one name has room then, else wrapped."""
        others = console.measure(self._with_names([""] * len(names), 0), options=options.update(width=_WIDE))
        left = options.max_width - others.maximum
        return left if left >= min(map(len, names), default=0) else options.max_width - others.minimum

    def _with_names(self, names: list[str], room: int) -> Table:
        """The table with these names; the row of one that is marked begins with a line that is empty but for the mark."""
        first, *others = self.table.columns
        table = copy(self.table)
        table.columns, table.rows = [], []
        table.add_column(**_options(first) | {"header": first.header if room else "", "no_wrap": True})
        columns = [[_text(cell) for cell in column.cells] for column in others]
        for column, cells in zip(others, columns, strict=True):
            table.add_column(**_options(column) | {"min_width": _least_width(column, cells)})
        for row, name, *texts in zip(self.table.rows, names, *columns, strict=True):
            lowered = (Text.assemble("\n", text) if _MARK in name else text for text in texts)
            table.add_row(Text(name), *lowered, style=row.style, end_section=row.end_section)
        return table


def _options(column: Column) -> dict[str, Any]:
    return {one.name: getattr(column, one.name) for one in fields(column) if not one.name.startswith("_")}


def _least_width(column: Column, cells: list[Text]) -> int | None:
    """Return the width of the widest cell where none may wrap; a column that wraps keeps its own least width."""
    if not column.no_wrap:
        return column.min_width
    return max((cell_len(line) for text in (_text(column.header), *cells) for line in text.plain.splitlines()), default=0)


def _text(cell: Any) -> Text:
    return cell if isinstance(cell, Text) else Text.from_markup(cell)
