"""Tables of numbers on a terminal: no lines, names at the left, numbers at the right."""

from collections.abc import Iterable

from rich.table import Table
from rich.text import Text

__all__ = ["number_table"]


def number_table(heads: Iterable[str], name: str | None = None, *, wrap: bool = False, gap: int = 2) -> Table:
    """Return an empty table; name: head of a first column of names; wrap: whether cells may be broken; gap: between columns."""
    table = Table(box=None, header_style="bold", pad_edge=False, padding=(0, gap, 0, 0))
    if name is not None:
        table.add_column(Text(name), no_wrap=not wrap)
    for head in heads:
        table.add_column(Text(head), justify="right", no_wrap=not wrap)
    return table
