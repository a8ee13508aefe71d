"""Tables of docs/explanation/compared-with-measurements.md: the prediction beside every measured series of validation/.

docs/make_tables.py writes them; docs/draw_guides.py draws the picture.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from markdown_table import table

import stiction as st
from stiction.quantities.shown import show
from stiction.studies.validation import LEVELS, entries_in, read_entry

if TYPE_CHECKING:
    import xarray

VALIDATION = Path(__file__).parents[1] / "validation"
# What a source leaves open, stated one way: the entry, the assumption in words, and the field of the contact.
ASSUMED = (
    ("dunkin_kim_1996", "silicon, ceramic interface", {"interface": "ceramic"}),
    ("dunkin_kim_1996", "silicon, adsorbed monolayer", {"interface": "monolayer"}),
    ("dunkin_kim_1996", "silicon, work of adhesion 20 mJ/m²", {"work_of_adhesion": "20 mJ/m^2"}),
    ("silicone_on_pla_2024", "silicone, work of adhesion 40 mJ/m²", {"work_of_adhesion": "40 mJ/m^2"}),
)


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
        yield title, show(load, "load", 3), measured, _digits(median), _range(half_low, half_high), _range(low, high)


def assumed() -> str:
    """Return the table of predictions with one further assumption each, at the smallest load of the series."""
    rows = []
    for name, words, change in ASSUMED:
        entry = read_entry(VALIDATION / f"{name}.toml")
        contact = entry.content["contact"] | change
        case, _ = replace(entry, content=entry.content | {"contact": contact}).cases()[0]
        mu = st.predict(case, load=entry.values.load[:1])
        low, median, high = (float(mu[f"friction_coefficient{end}"].item()) for end in ("_low", "", "_high"))
        rows.append((words, show(entry.values.load[0], "load", 3), _digits(median), _range(low, high)))
    return table(("assumed", "load", "predicted", "90 % interval"), rows)


def _range(low: float, high: float, digits: int = 2) -> str:
    return " to ".join(dict.fromkeys(_digits(value, digits) for value in (low, high)))


def _digits(value: float, digits: int = 2) -> str:
    return f"{float(f'{value:.{digits}g}'):g}"


TABLES: dict[str, Callable[[], str]] = {"measured series": series, "other assumptions": assumed}
