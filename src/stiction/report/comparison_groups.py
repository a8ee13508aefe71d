"""A comparison in a few rows: models that say the same are one row, families apart."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from rich.table import Table
from rich.text import Text

from stiction.laws.validity import read_doubts
from stiction.quantities.units import show
from stiction.report.answer import number

if TYPE_CHECKING:
    import xarray

__all__ = ["GROUP_HEADS", "Group", "group_rows", "groups_of", "groups_table", "left_out_in_words"]

_MU, _AREA = "friction_coefficient_at_load", "contact_area_at_load"
_ALIKE = 1.1  # ratio of mu within which models say the same
_MOST, _LONG = 8, 28  # lines in all; characters of a title in one
GROUP_HEADS = ("models that say the same", "mu", "real contact", "status")


@dataclass(frozen=True)
class Group:
    """Models that say the same.

    names: in the order of mu. low, high: of mu. area [m^2 or normalised]: the median. outside: whether they leave what their
    authors claim. possible: whether they can be right here.
    """

    family: str
    names: list[str]
    low: float
    high: float
    area: float
    outside: bool
    possible: bool

    @property
    def title(self) -> str:
        """Return the first model, and how many say the same."""
        return self.names[0] + (f" +{len(self.names) - 1}" if len(self.names) > 1 else "")


def groups_of(data: "xarray.Dataset") -> list[Group]:
    """Return the groups of a comparison at its working load, possible ones first, by family and mu."""
    models = [data.isel(model=at) for at in range(data.sizes["model"])]
    able = [one for one in models if np.isfinite(one[_MU].item())]
    keyed = [
        (not _possible(one), one["family_of_curve"].item(), bool(read_doubts(one["doubts"].item())), one[_MU].item(), one)
        for one in able
    ]
    keyed.sort(key=lambda row: row[:4])
    found: list[list[tuple]] = []
    for row in keyed:
        last = found[-1] if found else None
        if last and row[:3] == last[0][:3] and (row[0] or row[3] <= _ALIKE * max(last[0][3], 1e-300)):
            last.append(row)
        else:
            found.append([row])
    return [_group(rows) for rows in found]


def _group(rows: list[tuple]) -> Group:
    models = [row[-1] for row in rows]
    area = float(np.median([one[_AREA].item() for one in models]))
    names = [str(one["model"].item()) for one in models]
    return Group(rows[0][1], names, rows[0][3], rows[-1][3], area, rows[0][2], not rows[0][0])


def _possible(one: "xarray.Dataset") -> bool:
    return not any(doubt.kind == "impossible" for doubt in read_doubts(one["doubts"].item()))


def group_rows(data: "xarray.Dataset") -> list[tuple[str, str, str, str]]:
    """Return the texts of GROUP_HEADS for each group that is shown."""
    rows = []
    for group in rows_shown(groups_of(data)):
        ends = dict.fromkeys((number(group.low), number(group.high)))
        area = show(group.area, "contact_area", 2).replace("m^2", "m²") if _in_metres(data) else number(group.area)
        rows.append((group.title, " to ".join(ends), area, "outside its claims" if group.outside else "within its claims"))
    return rows


def groups_table(data: "xarray.Dataset") -> Iterator[Table | Text]:
    """Yield the rows of a comparison and a line on what is left out."""
    table = Table(box=None, header_style="bold", pad_edge=False, padding=(0, 2, 0, 0))
    for head in GROUP_HEADS:
        table.add_column(head, justify="right" if head == "real contact" else "left", no_wrap=head != GROUP_HEADS[0])
    for row in group_rows(data):
        table.add_row(*row)
    yield table
    yield Text("; ".join(filter(None, (left_out_in_words(data), "--all lists every model"))), style="dim")


def rows_shown(groups: list[Group]) -> list[Group]:
    """Return the first groups of possible models, as many as fit into _MOST lines; a long name takes two."""
    lines = np.cumsum([1 + (len(group.title) > _LONG) for group in groups if group.possible])
    return [group for group in groups if group.possible][: int(np.searchsorted(lines, _MOST, side="right"))]


def left_out_in_words(data: "xarray.Dataset") -> str:
    """Return how many models the rows leave out, "" for none."""
    shown = groups_of(data)
    impossible = sum(len(group.names) for group in shown if not group.possible)
    rest = [group for group in shown if group.possible][len(rows_shown(shown)) :]
    silent = data.sizes["model"] - sum(len(group.names) for group in shown)
    counts = [
        (impossible, "cannot be right here"),
        (sum(len(group.names) for group in rest), "not shown"),
        (silent, "say nothing of friction here"),
    ]
    return ", ".join(f"{count} {text}" for count, text in counts if count)


def _in_metres(data: "xarray.Dataset") -> bool:
    return data[_AREA].attrs.get("units", "1") == "m^2"
