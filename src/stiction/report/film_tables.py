"""What the command line prints of the stresses in a film."""

from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table

from stiction.report.number_table import number_table, short, shown, some

if TYPE_CHECKING:
    import xarray

_ROWS = 12
# What the columns are.
MEANINGS = (
    "a/t: contact radius of the mean touching asperity over the thickness of a film",
    "stress / Y, where: largest von Mises stress over the yield stress there, and in what",
    "tension / Y_w, shear / k_w: largest at the interface, over yield and shear yield stress of the weaker of film and body",
)
_HEADS = {
    "mean_separation": "separation", "load": "load", "friction_coefficient": "mu", "contact_over_thickness": "a/t",
    "stress_over_yield": "stress\n/ Y", "yields_first": "where", "interface_tension": "tension\n/ Y_w",
    "interface_shear": "shear\n/ k_w",
}  # fmt: skip


def film_table(data: "xarray.Dataset", all_rows: bool = False) -> Table:
    """About twelve points of a result of `film_stresses`, or all; every number with its unit where it has one."""
    count = max(data["load"].size, 1)
    chosen = some(count, count if all_rows else _ROWS)
    names = [name for name in _HEADS if name in data]
    table = number_table(_HEADS[name] for name in names)
    columns = [np.broadcast_to(np.ravel(data[name].values), count)[chosen] for name in names]
    for cells in zip(*columns, strict=True):
        table.add_row(*(_cell(value, data[name]) for value, name in zip(cells, names, strict=True)))
    return table


def _cell(value: Any, variable: "xarray.DataArray") -> str:
    if variable.dtype.kind in "OU":
        return str(value) or "-"
    return short(value) if variable.attrs.get("units", "1") == "1" else shown(float(value), str(variable.name))
