"""What the command line prints of what is uncertain: bands."""

import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table
from rich.text import Text

from stiction.quantities.table import QUANTITIES
from stiction.report.number_table import number_table, short, some
from stiction.report.several_tables import of_point, points_dimension, shown_quantity, varied
from stiction.report.whole_keys import WholeKeys

if TYPE_CHECKING:
    import xarray

_ROWS = 12


def band_table(data: "xarray.Dataset") -> Table | Text:
    """The nominal result and its quantiles at about twelve of the points, with the largest error of their sampling."""
    name = shown_quantity(data)
    if f"{name}_quantile" not in data:
        return Text(f"{name} does not vary with what is uncertain", style="dim")
    dim, several = points_dimension(data), varied(data)
    table = number_table(("at", "nominal", *(f"{share:.0%}" for share in data["quantile"].values), "sampling\nerror"))
    # Where numbers are several, of each the first: the files have them all.
    whole = data.isel({one: 0 for one in several})
    for at in some(data.sizes[dim] if dim else 1, _ROWS):
        one = whole.isel({dim: int(at)}) if dim else whole
        band, error = one[f"{name}_quantile"].values, one[f"{name}_quantile_error"].values
        worst = float(np.nanmax(error)) if np.isfinite(error).any() else np.nan
        table.add_row(of_point(data, int(at)), *(short(value) for value in (float(one[name]), *band)), short(worst, 2))
    return table


def band_lines(data: "xarray.Dataset") -> Iterator[Any]:
    """Yield the table of quantiles, whole on a terminal of any width, and what is uncertain."""
    table = band_table(data)
    yield WholeKeys(table) if isinstance(table, Table) else table
    yield from uncertain_notes(data)


def uncertain_notes(data: "xarray.Dataset") -> Iterator[Text]:
    """What is uncertain, how it was drawn, and how often nothing is known."""
    used = data.attrs
    for line in used["uncertain_inputs"].splitlines():
        yield Text(f"uncertain: {line}", style="dim")
    if "uncertainty" in used:
        yield Text(draws_in_words(used), style="dim")
    if used.get("impossible_draws"):
        yield Text(f"impossible, and excluded from the band: {used['impossible_draws']:.2g} of the draws", style="dim")
    for text, share in json.loads(used.get("doubts_of_points", "{}")).items():
        yield Text(in_draws(share, with_meaning(text)), style="dim")


def draws_in_words(used: Mapping[str, Any]) -> str:
    """How many draws there were, and by which seed, by the attributes of a result."""
    return f"random draws of what is uncertain: {used['uncertainty'].replace(' points', '')}"


def with_meaning(doubt: str) -> str:
    """A doubt that begins with the name of a quantity, with what that means in its place."""
    name, _, rest = doubt.partition(" ")
    return f"{QUANTITIES[name].meaning} {rest}" if name in QUANTITIES else doubt


def in_draws(share: float, text: str) -> str:
    """How often something holds of what was drawn."""
    return f"in {share:.1%} of the random draws, each a possible set of the uncertain inputs: {text}"
