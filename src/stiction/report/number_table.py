"""Tables of numbers on a terminal: no lines, names at the left, numbers at the right; how a number stands in them."""

import math
from collections.abc import Iterable
from copy import copy
from dataclasses import replace

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.table import Table
from rich.text import Text

from stiction.quantities.units import show


def number_table(heads: Iterable[str], name: str | None = None, *, wrap: bool = False, gap: int = 2) -> Table:
    """Return an empty table; name: head of a first column of names; wrap: whether cells may be broken; gap: between columns."""
    table = Table(box=None, header_style="bold", pad_edge=False, padding=(0, gap, 0, 0))
    if name is not None:
        table.add_column(Text(name), no_wrap=not wrap)
    for head in heads:
        table.add_column(Text(head), justify="right", no_wrap=not wrap)
    return table


def ruled_table(*heads: str) -> Table:
    """Return an empty table with a line below its heads; the first column of names is never broken."""
    table = Table(box=SIMPLE_HEAD, header_style="bold", pad_edge=False, padding=(0, 1, 0, 0))
    for at, head in enumerate(heads):
        table.add_column(head, no_wrap=at == 0, overflow="fold")
    return table


def few_rows(table: Table, most: int, spaced: bool = True) -> Table:
    """Return a table with at most so many of its rows: evenly spaced ones with both ends, or the first ones."""
    chosen = some(len(table.rows), most) if spaced else np.arange(min(len(table.rows), most))
    fewer = copy(table)
    fewer.columns = [replace(column, _cells=[column._cells[at] for at in chosen]) for column in table.columns]
    fewer.rows = [table.rows[at] for at in chosen]
    return fewer


def some(count: int, most: int) -> np.ndarray:
    """Return places of at most so many of `count`, evenly, both ends among them."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def short(value: float, digits: int = 4) -> str:
    """Return a number with a few digits; "-" if it is none."""
    return f"{float(f'{value:.{digits}g}'):g}" if np.isfinite(value) else "-"


def shown(value: float, name: str, digits: int = 4) -> str:
    """Return a value of the named quantity, given in SI, with a fitting prefix, to a few digits; "-" if it is no number."""
    return show(value, name, digits).replace("m^2", "m²") if np.isfinite(value) else "-"


def prefix(quantity: str, largest: float) -> tuple[float, str]:
    """Return what values up to this one, in SI, are multiplied by, and the unit with a fitting prefix that they then have."""
    size = 10.0 ** math.floor(math.log10(largest)) if largest > 0.0 else 1.0
    text, _, unit = show(size, quantity).partition(" ")
    return float(text) / size, unit.replace("m^2", "m²")
