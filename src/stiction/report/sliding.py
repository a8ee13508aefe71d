"""From rest to sliding: the table of points, and what is said of them."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from rich.table import Table

from stiction.report.tables import curve_table, run_notes

if TYPE_CHECKING:
    import xarray

_HEADS = {
    "mean_separation": "separation",
    "load": "load",
    "friction_coefficient": "mu",
    "largest_friction_coefficient": "largest F/P",
    "sliding_displacement": "at displacement",
    "tangential_stiffness": "stiffness",
}


def sliding_table(data: "xarray.Dataset") -> Table:
    """A row for each point: mu, the largest force on the way over the load, where it is, and the stiffness at rest."""
    return curve_table(data.drop_dims("displacement"), True, _HEADS)


def sliding_notes(data: "xarray.Dataset") -> Iterator[str]:
    """What a user should know of this result, one line each."""
    used = data.attrs
    yield f"mu: all asperities at their strength together; {used['sliding']}"
    if used["kept"] == 1.0:
        yield "the force then tends to that, and the displacement is where it has come to 99 % of it"
    yield from run_notes(data)
