"""Tables and picture of docs/explanation/calibration.md, from the scores in validation/.

    python docs/calibration_tables.py     # draws docs/explanation/calibration.svg

The tables are written by docs/make_tables.py.
"""

import csv
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from markdown_table import table
from matplotlib.figure import Figure

from stiction.report.pictures import BLUE, GREEN, GREY, ORANGE, RED, SKY, finish

HERE = Path(__file__).parent
VALIDATION = HERE.parent / "validation"
sys.path.append(str(VALIDATION / "maps"))
import score  # noqa: E402 - of the maps

CONTACTS = VALIDATION / "contacts" / "results.csv"
SETS = ("first", "second", "third", "fourth", "fifth", "sixth")  # the page lists what was corrected after each
KNOWN = {
    "map": "the map", "kind and shape": "numbers, kind, shape", "shape": "numbers and shape", "kind": "numbers and kind",
    "numbers": "numbers alone", "finish": "Sq and the finish",
}  # fmt: skip
_COLOURS = (BLUE, SKY, GREY, GREEN, RED, ORANGE)


def coverage() -> str:
    """Return the table of how often the intervals contain the solved area, for each set of maps."""
    rows = []
    for name in SETS:
        scored = score.read_scored(name)
        for known, words in KNOWN.items():
            some = [row for row in scored if row["known"] == known]
            if not some:  # this set was not predicted from these inputs
                continue
            left = score.open_rows(some)
            rows.append((name, words, f"{len(some)}", *_cells(some), f"{len(left)}", *_cells(left)[:2]))
    head = ("set", "known input", "areas", "in 50 %", "in 90 %", "width", "areas, width above 2 %", "in 50 %", "in 90 %")
    return table(head, rows)


def by_class() -> str:
    """Return the same for the last set, by state and by kind of surface: 50 %, 90 %, width."""
    scored = _mended()
    classes = [("state", value) for value in dict.fromkeys(row["state"] for row in scored)]
    classes += [("kind", value) for value in dict.fromkeys(row["kind"] for row in scored)]
    rows = []
    for column, value in classes:
        mine = [row for row in scored if row[column] == value]
        each = ([row for row in mine if row["known"] == known] for known in KNOWN)
        rows.append((value, *(", ".join(_cells(some)) if some else "-" for some in each)))
    return table(("state or kind", *KNOWN.values()), rows)


def _mended() -> list[dict[str, str]]:
    """Return the rows of the set that was scored last."""
    return score.read_scored("sixth")


def by_numbers() -> str:
    """Return how often the 90 % interval from numbers contains the area in the last two sets, and its width, by kind."""
    scored = [row for name in ("fifth", "sixth") for row in score.read_scored(name)]
    known = {name: words for name, words in KNOWN.items() if name not in ("map", "finish")}
    rows = []
    for kind in (None, *dict.fromkeys(row["kind"] for row in scored)):
        mine = [row for row in scored if kind is None or row["kind"] == kind]
        each = (_cells([row for row in mine if row["known"] == name])[1:] for name in known)
        rows.append((kind or "all", *(", ".join(cells) for cells in each)))
    return table(("kind", *known.values()), rows)


def _cells(rows: list[dict]) -> tuple[str, str, str]:
    half, most, wide, _ = score.coverage(rows)
    return f"{half:.0%}", f"{most:.0%}", f"{wide:.3g}"


def contacts() -> str:
    """Return the table of all contacts with published friction."""
    rows = [
        (
            row["contact"].replace("_", " "), row["interface"], _span(row, "printed_low", "printed_high"), row["median"],
            _span(row, "low_90", "high_90"), "yes" if _held(row, 0.9) else "no",
        )
        for row in _contacts()
    ]  # fmt: skip
    return table(("contact", "interface", "published friction", "median", "90 % interval", "inside"), rows)


def contacts_together() -> str:
    """Return the table of how often the intervals contain the published friction."""
    rows = _contacts()
    widths = np.array([float(row["high_90"]) / float(row["low_90"]) for row in rows])
    held = (f"{np.mean([_held(row, level) for row in rows]):.0%}" for level in (0.5, 0.9))
    cells = (f"{len(rows)}", *held, f"{np.median(widths):.2g}", f"{np.mean(widths < 10.0):.0%}")
    return table(("contacts", "in 50 %", "in 90 %", "median width", "width below 10"), [cells])


def _contacts() -> list[dict[str, str]]:
    with CONTACTS.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def _held(row: dict[str, str], level: float) -> bool:
    return abs(float(row["draws_below"]) - 0.5) <= 0.5 * level


def _span(row: dict[str, str], low: str, high: str) -> str:
    return " to ".join(dict.fromkeys((row[low], row[high])))


TABLES: dict[str, Callable[[], str]] = {
    "coverage": coverage, "by class": by_class, "contacts together": contacts_together, "contacts": contacts,
}  # fmt: skip


def figure() -> Figure:
    """Draw the fraction of areas and contacts inside intervals of every level, without areas that are certain."""
    picture = Figure(figsize=(9.5, 4.6), layout="constrained")
    panels = picture.subplots(1, 2)
    levels = np.linspace(0.0, 1.0, 101)
    for axes, rows in zip(panels, (score.read_scored("first"), _mended()), strict=True):
        scored, mended = score.open_rows(rows), axes is panels[1]
        for colour, (known, words) in zip(_COLOURS, KNOWN.items(), strict=True):
            below = np.array([float(row["level"]) for row in scored if row["known"] == known])
            if below.size:
                axes.plot(levels, _within(below, levels), color=colour, label=words)
        if mended:
            below = np.array([float(row["draws_below"]) for row in _contacts()])
            axes.plot(levels, _within(below, levels), "k--", label="contacts with published friction")
        axes.plot((0.0, 1.0), (0.0, 1.0), color="0.6", linewidth=1.0)
        axes.set(xlabel="nominal probability of the interval", title="sixth set" if mended else "first set")
        axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
        axes.set_aspect("equal")
        finish(axes)
    panels[0].set_ylabel("fraction inside the interval")
    panels[1].legend(fontsize=8, loc="upper left", frameon=False)
    return picture


def _within(below: np.ndarray, levels: np.ndarray) -> np.ndarray:
    """Return the share of draws' levels within central intervals."""
    return np.array([np.mean(np.abs(below - 0.5) <= 0.5 * level) for level in levels])


if __name__ == "__main__":
    figure().savefig(HERE / "explanation" / "calibration.svg")
