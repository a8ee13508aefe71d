"""Surfaces at lighter loads than those of the set: how the area goes on below its lightest pressure.

    python truth/light.py

writes light.csv beside this file; five minutes on one core, less where solutions are kept in truth/work. Designs of the set
with seeds of their own and 128 shortest waves on a side, so that enough spots touch. Columns: design, kind; pressure over
E* h'; points in contact; area: share of the nominal area; over_lightest: area over load, over that at the lightest pressure of
the set.
"""

import csv
import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import surfaces as design
from solve import WORK, _solved, described

FILE = Path(__file__).parent / "light.csv"
POINTS = 1024
PRESSURES = (0.000125, 0.0005, 0.002)
COLUMNS = ("design", "kind", "pressure", "points", "area", "over_lightest")
_CHANGES = {
    "gaussian": ((),), "skewed": (("exp", 0.45), ("exp", -0.45)),
    "worn": (("smooth", 0.7, 0.15), ("again", 0.7, 0.07), ("again", 0.7, 0.02)),
}  # fmt: skip


def some() -> Iterator[design.Surface]:
    """The surfaces."""
    for hurst, ratio in ((0.8, 8.0), (0.5, 16.0)):
        base = design.Surface("gaussian", 8, hurst, ratio, points=POINTS)
        for kind, changes in _CHANGES.items():
            yield from (replace(base, kind=kind, change=one, design=900 + number) for number, one in enumerate(changes))
        yield replace(base, kind="lay", stretch=3.0, angle=0.6)


def solved(one: design.Surface) -> dict:
    """Areas at PRESSURES, kept in WORK."""
    file = WORK / f"{one.name}.light"
    if not file.exists():
        surface = one.made()
        WORK.mkdir(exist_ok=True)
        file.write_text(json.dumps(_solved(surface, described(surface)["gradient"], PRESSURES)))
    return json.loads(file.read_text())


def rows() -> Iterator[list]:
    """Every row."""
    for one in some():
        areas = solved(one)["area"]
        for pressure, area in zip(PRESSURES, areas, strict=True):
            over = area / pressure / (areas[-1] / PRESSURES[-1])
            yield [one.name, one.kind, pressure, round(area * POINTS**2), area, over]
        print(one.name, flush=True)


if __name__ == "__main__":
    with FILE.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows([value if isinstance(value, str) else f"{value:.5g}" for value in row] for row in rows())
