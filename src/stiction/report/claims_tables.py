"""What the command line prints of the claims of the 2015 paper."""

from collections.abc import Iterable, Mapping
from typing import Any

from rich.table import Table
from rich.text import Text

from stiction.report.number_table import ruled_table
from stiction.report.tables import facts


def claims_table(rows: Iterable[Mapping[str, Any]], here: str) -> Table:
    """The claims map in words: for each claim and reading the share of the plane where it holds, and where. here: the indices
    at which the last column tells the share of films for which it holds."""
    table = ruled_table("claim", "reading", "holds for all films", "for some", "for none", "not com-\nparable", here)
    table.columns[1].no_wrap = True
    for at in (3, 5, 6):
        table.columns[at].justify = "right"
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
