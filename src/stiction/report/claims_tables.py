"""What the command line prints of the claims of the 2015 paper."""

from collections.abc import Iterable, Mapping
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.table import Table
from rich.text import Text

from stiction.report.tables import facts


def claims_table(rows: Iterable[Mapping[str, Any]], here: str) -> Table:
    """The claims map in words: for each claim and reading the share of the plane where it holds, and where. here: the indices
    at which the last column tells the share of films for which it holds."""
    table = Table(header_style="bold", box=SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    for head in ("claim", "reading"):
        table.add_column(head, no_wrap=True)
    table.add_column("holds for all films")
    table.add_column("for some", justify="right")
    table.add_column("for none")
    table.add_column("not com-\nparable", justify="right")
    table.add_column(here, justify="right")
    for row in rows:
        cells = (
            f"({row['claim']})",
            row["reading"],
            f"{row['holds_for_all']:.0%}: {row['where_all']}",
            f"{row['holds_for_some']:.0%}",
            f"{row['holds_for_none']:.0%}: {row['where_none']}",
            f"{row['not_comparable']:.0%}",
            "-" if row["share_here"] is None else f"{row['share_here']:.0%}",
        )
        table.add_row(*map(Text, cells))
    return table


def claims_meaning(rows: Iterable[Mapping[str, Any]]) -> Table:
    """What each claim says and how it was made precise."""
    unique = {row["claim"]: f"{row['says']}\nholds if {row['definition']}" for row in rows}
    return facts((f"({key})", text) for key, text in unique.items())
