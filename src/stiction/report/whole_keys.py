"""Tables whose first column can be copied: names stand whole on a terminal of any width."""

from collections.abc import Iterator
from copy import copy
from dataclasses import replace
from typing import Any

from rich.cells import cell_len
from rich.console import Console, ConsoleOptions
from rich.segment import Segment
from rich.table import Column, Table
from rich.text import Text

__all__ = ["WholeKeys"]

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
        table, marked = copy(self.table), [_MARK in name for name in names]
        head: Any = self.table.columns[0].header if room else ""
        first = replace(self.table.columns[0], header=head, no_wrap=True, _cells=[Text(name) for name in names])
        table.columns = [first, *(_lowered(one, marked) for one in self.table.columns[1:])]
        return table


def _lowered(column: Column, marked: list[bool]) -> Column:
    """The column with an empty line above the cells of the rows that are marked; no narrower than its cells, if these are not
    to be wrapped."""
    cells = [_text(cell) for cell in column._cells]
    least = max((cell_len(line) for one in (_text(column.header), *cells) for line in one.plain.splitlines()), default=0)
    lowered: list[Any] = [Text.assemble("\n", cell) if lower else cell for cell, lower in zip(cells, marked, strict=True)]
    return replace(column, _cells=lowered, min_width=least if column.no_wrap else column.min_width)


def _text(cell: Any) -> Text:
    return cell if isinstance(cell, Text) else Text.from_markup(cell)
