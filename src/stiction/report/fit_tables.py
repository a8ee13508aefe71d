"""What the command line prints of a fit, and the tables that it writes."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table
from rich.text import Text

from stiction.quantities.units import show
from stiction.report.files import rows_of
from stiction.report.number_table import number_table

if TYPE_CHECKING:
    import xarray


def parameter_table(data: "xarray.Dataset") -> Table:
    """A row for each free number: its best value, and its interval."""
    table = number_table(("best", "95 % from", "to", "searched"), "free")
    table.columns[0].no_wrap = False
    for at, name in enumerate(data["parameter"].values.tolist()):
        one, quantity = data.isel(parameter=at), name.partition(" (")[0].rpartition(".")[2]
        value, low, high, least, most = (
            show(float(one[key]), quantity, 4) for key in ("value", "low", "high", "least", "most")
        )
        ends = [f"{end} (open)" if bool(one[f"open_{side}"]) else end for end, side in ((low, "low"), (high, "high"))]
        table.add_row(name, value, *ends, f"{least} to {most}")
    return table


def fit_notes(data: "xarray.Dataset") -> Iterator[Text]:
    """How good the fit is, and what the data do not say."""
    used = data.attrs
    good = f"chi square {used['chi_square']:.4g} of " if "chi_square" in used else ""
    yield Text(f"{good}{used['values']} values, {used['free']} free; errors: {used['errors']}")
    for line in filter(None, used["verdict"].split("\n")):
        yield Text(line, style="yellow")
    names = data["parameter"].values
    for i, j in zip(*np.tril_indices(len(names), -1), strict=True):
        yield Text(f"correlation of {names[j]} and {names[i]}: {data['correlation'].values[i, j]:.3f}", style="dim")
    if used["stopped"]:
        yield Text("stopped before the end: predictions or other models are missing", style="bold")


def evidence_table(data: "xarray.Dataset") -> Table:
    """Models by what the data say for them."""
    left = "chi_square" if "chi_square" in data else "scatter"
    table = number_table([left.replace("_", " "), "AICc", "weight", data["left_out"].attrs["long_name"]], "model", wrap=True)
    for at, name in enumerate(data["model"].values.tolist()):
        one = data.isel(model=at)
        if str(one["why_not"].values):
            table.add_row(name, Text(str(one["why_not"].values), style="dim"))
            continue
        cells = [f"{float(one[key]):.4g}" for key in (left, "aicc")]
        table.add_row(name, *cells, f"{float(one['weight']):.2g}", f"{float(one['left_out']):.3g}")
    return table


def parameter_rows(data: "xarray.Dataset") -> tuple[list[str], list[list[Any]]]:
    """Heads and rows of the table of free numbers, for a file."""
    keys = ["unit", "value", "low", "high", "open_low", "open_high", "standard_error"]
    heads = ["parameter", *keys]
    rows = zip(rows_of(data, heads), data["correlation"].values.tolist(), strict=True)
    return [*heads, *(f"correlation with {name}" for name in data["parameter"].values)], [[*row, *more] for row, more in rows]


def row_rows(data: "xarray.Dataset") -> tuple[list[str], list[list[Any]]]:
    """Heads and rows of the measured values with what the model says, in SI units."""
    keys = ["sample", "quantity", "measured_load", "measured", "error", "fitted", "residual"]
    return keys, rows_of(data, keys)


def prediction_names(data: "xarray.Dataset") -> list[str]:
    return [str(name) for name in data.data_vars if str(name).startswith("predicted_") and np.size(data[name])]
