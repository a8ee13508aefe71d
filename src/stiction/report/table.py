"""Represent tables as data that terminal, page and report can render, and format their numbers."""

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.cells import cell_len
from rich.console import Console, ConsoleOptions
from rich.segment import Segment
from rich.table import Table as Printed
from rich.text import Text

from stiction.quantities.sampling import spread_rows
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES

if TYPE_CHECKING:
    import xarray

_MARK = "\ue000"  # a character for private use, which no name contains
_WIDE = 10_000
_MICRO = re.compile(r"(?<![A-Za-z])u(?=(?:m|N|Pa|J)\b)")  # the prefix micro, typed as u


@dataclass(frozen=True)
class Column:
    """Describe a column of a table.

    head: text above the column. right: whether it is right-aligned. wrap: whether its cells may wrap. most: largest width in
    characters; None for no limit.
    """

    head: str
    right: bool = False
    wrap: bool = False
    most: int | None = None


def numbers(*heads: str, wrap: bool = False) -> list[Column]:
    """Return right-aligned columns with these heads.

    wrap: whether their cells may wrap.
    """
    return [Column(head, True, wrap) for head in heads]


@dataclass(frozen=True)
class Table:
    """Store a table as rows of cells; the first cell of a row is its name.

    A cell is a text or, on a page, a list of lines. looks: style of each row, "bold", "dim" or "". ruled: whether a line
    separates heads and rows. gap: number of spaces between columns. whole: never shorten a name; a name that does not fit is
    printed on a line above its row. stacked: on a narrow page, put the cells of a row below one another, each with the head of
    its column. ranked: whether the first rows are the most important.
    """

    columns: Sequence[Column]
    rows: Sequence[Sequence[Any]]
    caption: str = ""
    looks: Sequence[str] = ()
    ruled: bool = False
    gap: int = 2
    whole: bool = False
    stacked: bool = False
    ranked: bool = False

    @property
    def heads(self) -> list[str]:
        """Return the heads of the columns; each may be empty."""
        return [column.head for column in self.columns]

    def few(self, most: int) -> "Table":
        """Return this table with at most `most` rows.

        A ranked table keeps its first rows. Another table keeps evenly spaced rows, including the first and the last.
        """
        chosen = range(min(len(self.rows), most)) if self.ranked else spread_rows(len(self.rows), most)
        looks = [self.looks[row] for row in chosen] if self.looks else ()
        return replace(self, rows=[self.rows[row] for row in chosen], looks=looks)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[Any]:
        names = [row[0] for row in self.rows]
        if not self.whole:
            yield self._printed(names, self.heads[0])
            return
        others = console.measure(self._printed([""] * len(names)), options=options.update(width=_WIDE))
        # The other columns get their full width if the shortest name then has room; otherwise they are wrapped.
        room = options.max_width - others.maximum
        room = room if room >= min(map(len, names), default=0) else options.max_width - others.minimum
        above = [name for name in names if len(name) > room]
        table = self._printed([_MARK if name in above else name for name in names], self.heads[0] if room else "")
        for line in console.render_lines(table, options, pad=False):
            for part in line:
                edge, mark, _ = part.text.partition(_MARK)
                yield Segment(edge + above.pop(0), part.style) if mark else part
                if mark:
                    break
            yield Segment.line()

    def _printed(self, names: list[Any], head: str = "") -> Printed:
        """Return a rich table with these row names.

        The name _MARK replaces a long name. The cells of its row are moved down by one line, to make room for the long name.
        """
        headed = any(self.heads)
        box = SIMPLE_HEAD if self.ruled else None
        table = Printed(box=box, header_style="bold", pad_edge=False, padding=(0, self.gap, 0, 0), show_header=headed)
        for number, column in enumerate(self.columns):
            unbroken, fixed = self.whole and not number, self.whole and number and not column.wrap
            cells = [column.head, *(str(row[number]) for row in self.rows)]
            table.add_column(
                Text(column.head if number else head),
                justify="right" if column.right else "left",
                no_wrap=unbroken or not column.wrap,
                overflow="fold" if self.ruled or column.most else "ellipsis",
                max_width=None if unbroken else column.most,
                min_width=max(cell_len(line) for cell in cells for line in cell.splitlines() or [""]) if fixed else None,
                style="" if headed or number else "bold",
            )
        for number, (name, row) in enumerate(zip(names, self.rows, strict=True)):
            texts = [cell if isinstance(cell, Text) else Text(cell) for cell in (name, *row[1:])]
            if name == _MARK:
                texts[1:] = [Text.assemble("\n", text) for text in texts[1:]]
            table.add_row(*texts, style=self.looks[number] if self.looks else None)
        return table


def short(value: float, digits: int = 4) -> str:
    """Format a number with a few significant digits; "-" for NaN or infinity."""
    return f"{float(f'{value:.{digits}g}'):g}" if np.isfinite(value) else "-"


def with_signs(text: str) -> str:
    """Replace um by µm, m^2 by m² and m^3 by m³ in a text with units.

    >>> with_signs("50 um, 1.7e10 1/m^2")
    '50 µm, 1.7e10 1/m²'
    """
    return _MICRO.sub("µ", text).replace("m^2", "m²").replace("m^3", "m³")


def notes(lines: Iterable[str], look: str = "dim") -> list[Table]:
    """Return a list with one table of the lines as bulleted notes; [] without lines.

    look: style of the notes.
    """
    rows = [("-", line) for line in lines]
    return [Table([Column(""), Column("", wrap=True)], rows, gap=1, looks=[look] * len(rows))] if rows else []


def shown(value: float, name: str, digits: int = 4) -> str:
    """Format an SI value of a quantity with a prefixed unit; "-" for NaN or infinity.

    name: key of QUANTITIES.
    """
    return with_signs(show(value, name, digits)) if np.isfinite(value) else "-"


def with_unit(variable: "xarray.DataArray", value: float | None = None, digits: int = 4) -> str:
    """Format a value of a variable with a prefixed unit, or as a plain number if it has no unit.

    value: SI value; by default the only value of `variable`. NaN and infinity give "-".
    """
    value, name = float(variable if value is None else value), str(variable.name)
    plain = variable.attrs.get("units", "1") == "1" or name not in QUANTITIES
    return short(value, digits) if plain else shown(value, name, digits)


def prefix(quantity: str, largest: float) -> tuple[float, str]:
    """Return (factor, unit): a prefixed unit that suits a quantity, and the factor from its SI unit.

    quantity: key of QUANTITIES. largest: largest SI value to be shown.
    """
    size = 10.0 ** math.floor(math.log10(largest)) if largest > 0.0 else 1.0
    text, _, unit = show(size, quantity).partition(" ")
    return float(text) / size, with_signs(unit)


def unit_for(quantity: str, largest: float) -> tuple[float, str]:
    """Return (factor, unit) for drawing a quantity: SI values times the factor are in the unit.

    largest: largest SI value to be drawn. Only lengths and asperity densities get a unit; other quantities are drawn in SI, as
    (1.0, "").
    """
    if quantity == "asperity_density":
        return next(((per, unit) for per, unit in ((1e-12, "1/µm²"), (1e-6, "1/mm²")) if largest * per >= 0.1), (1.0, "1/m²"))
    return prefix(quantity, largest) if QUANTITIES[quantity].unit == "m" else (1.0, "")


_LOOKS = {"mu": "bold", "warning": "yellow", "outside": "yellow"}  # style of a row by the first word of its name


def facts(pairs: Iterable[tuple[str, Any]]) -> Table:
    """Return a table of pairs (name, text), with mu and warnings highlighted; pairs without text are left out."""
    rows = [pair for pair in pairs if pair[1]]
    looks = [_LOOKS.get(name.partition(" ")[0], "") for name, _ in rows]
    return Table([Column(""), Column("", wrap=True)], rows, looks=looks)
