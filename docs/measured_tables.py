"""Table of docs/explanation/compared-with-measurements.md: the prediction beside every measured series of validation/.

docs/make_tables.py writes it; docs/draw_guides.py draws the picture.
"""

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from markdown_table import table

import stiction as st
from stiction.quantities.units import show
from stiction.studies.validation import LEVELS, entries_in, read_entry

if TYPE_CHECKING:
    import xarray

VALIDATION = Path(__file__).parents[1] / "validation"


@cache
def measured_series() -> "tuple[xarray.Dataset, ...]":
    """Return the comparison with every measured series; synthetic ones are left out."""
    entries = map(read_entry, entries_in(VALIDATION))
    return tuple(st.validate(entry) for entry in entries if entry.origin.kind == "measured")


def series() -> str:
    """Return the table: measured range, predicted median and both intervals of each row."""
    head = ("series", "load", "measured", "predicted", "50 % interval", "90 % interval")
    return table(head, [cells for data in measured_series() for cells in _rows(data)])


def _rows(data: "xarray.Dataset") -> Iterator[tuple[str, ...]]:
    for at, load in enumerate(data["load"].values):
        low, half_low, median, half_high, high = (float(data["prediction"].sel(quantile=level)[at]) for level in LEVELS)
        measured = _range(float(data["measured_low"][at]), float(data["measured_high"][at]), 3)
        title = data.attrs["title"] if at == 0 else ""
        yield title, show(load, "load", 3), measured, f"{median:.2g}", _range(half_low, half_high), _range(low, high)


def _range(low: float, high: float, digits: int = 2) -> str:
    return " to ".join(dict.fromkeys(f"{value:.{digits}g}" for value in (low, high)))


TABLES: dict[str, Callable[[], str]] = {"measured series": series}
