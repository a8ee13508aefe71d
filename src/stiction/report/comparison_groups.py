"""A comparison in a few rows: models that say the same are one row, families apart."""

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from rich.table import Table
from rich.text import Text

from stiction.report.answer import number
from stiction.report.number_table import number_table
from stiction.report.view import lines_of
from stiction.report.whole_keys import WholeKeys
from stiction.studies.comparison.compare import FAMILIES

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient_at_load"
_ALIKE = 1.1  # ratio of mu within which models say the same
GROUP_HEADS = ("models that say the same", "mu", "area off by", "status")


@dataclass(frozen=True)
class Group:
    """Models that say the same.

    family: what their friction rests on. names: in the order of mu. low, high: of mu. errors: mean errors of the area on solved
    surfaces, of the models of which it is known. least, most: mu without its error there, at the ends of 90 %; as low and high
    where nothing is known. status: of the first.
    """

    family: str
    names: list[str]
    low: float
    high: float
    errors: list[float]
    least: float
    most: float
    status: str

    @property
    def title(self) -> str:
        """Return the first model, and how many say the same."""
        return self.names[0] + (f" +{len(self.names) - 1}" if len(self.names) > 1 else "")

    @property
    def fits(self) -> bool:
        """Return whether the contact fits the models."""
        return self.status.startswith("fits")

    @property
    def kind(self) -> tuple[str, bool, str]:
        """Return what models of one row have in common beside mu."""
        return self.family, self.possible, self.status if self.fits else ""

    @property
    def possible(self) -> bool:
        """Return whether they can be right here."""
        return not self.status.startswith("cannot")


def groups_of(data: "xarray.Dataset", every: bool = False) -> list[Group]:
    """Return the groups of a comparison at its working load: those that fit first, then possible ones, by family and mu.

    every: each model by itself.
    """
    models = [data.isel(model=at) for at in range(data.sizes["model"])]
    alone = [_group([one]) for one in models if np.isfinite(one[_MU].item())]
    alone.sort(key=lambda one: (not one.fits, not one.possible, one.family == FAMILIES[False], one.low))
    if every:
        return alone
    by_name = {str(one["model"].item()): one for one in models}
    found: list[list[Group]] = []
    for one in alone:
        last = found[-1][0] if found else None
        alike = last is not None and last.kind == one.kind
        if last is not None and alike and one.high <= _ALIKE * max(last.low, 1e-300):
            found[-1].append(one)
        else:
            found.append([one])
    return [_group([by_name[one.names[0]] for one in some]) for some in found]


def _group(models: "list[xarray.Dataset]") -> Group:
    mu = [float(one[_MU].item()) for one in models]
    ends = [end for one, value in zip(models, mu, strict=True) for end in _ends(one, value)]
    errors = [float(one["measured_area_error"].item()) for one in models]
    names = [str(one["model"].item()) for one in models]
    known = [one for one in errors if math.isfinite(one)]
    first = models[0]
    return Group(
        first["family_of_curve"].item(), names, mu[0], mu[-1], known, min(ends), max(ends), str(first["status"].item())
    )


def _ends(one: "xarray.Dataset", mu: float) -> list[float]:
    """Return mu, over 1 plus its error on solved surfaces at the ends of 90 %."""
    errors = json.loads(one["measured_error"].item()) or {}
    ends = [errors.get(f"area_{end}") or [None] for end in ("high", "low")]
    return [mu if end[0] is None else mu / (1.0 + end[0]) for end in ends]


def group_row(group: Group) -> tuple[str, str, str, str]:
    """Return the texts of GROUP_HEADS for a group."""
    mu = " to ".join(dict.fromkeys((number(group.low), number(group.high))))
    ends = dict.fromkeys(f"{end:+.0%}" for end in (min(group.errors), max(group.errors))) if group.errors else ["-"]
    return group.title, mu, " to ".join(ends), group.status


def groups_table(groups: list[Group], room: int | None = None) -> Iterator[Table | WholeKeys | Text]:
    """Yield rows for groups, as many as fit into so many lines, and a line on what is left out."""
    shown = groups if room is None else [group for group in groups if group.possible]
    while room is not None and shown and lines_of(_table(shown)) > room - 1:
        shown = shown[:-1]
    if shown:
        yield _table(shown) if room is not None else WholeKeys(_table(shown))
    if text := left_out_in_words(groups, shown):
        yield Text(text, style="dim")


def _table(groups: list[Group]) -> Table:
    table = number_table(GROUP_HEADS[1:3], GROUP_HEADS[0])
    table.columns[0].no_wrap, table.columns[0].overflow, table.columns[0].max_width = False, "fold", 34
    table.add_column(GROUP_HEADS[3])
    for group in groups:
        table.add_row(*map(Text, group_row(group)))
    return table


def left_out_in_words(groups: list[Group], shown: list[Group]) -> str:
    """Return how many models the rows leave out, "" for none."""
    counts = [
        (sum(len(one.names) for one in groups if one.possible and one not in shown), "not shown"),
        (sum(len(one.names) for one in groups if not one.possible and one not in shown), "cannot be right here"),
    ]
    words = [f"{count} {text}" for count, text in counts if count]
    return "; ".join([*words, "--all lists every model"]) if words else ""
