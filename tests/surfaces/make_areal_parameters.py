"""Write areal_parameters.csv: parameters of real scans by surfalize (pip install surfalize; MIT licence), run by hand.

python tests/surfaces/make_areal_parameters.py ../shared/scans

Heights are those that stiction reads and levels, in micrometres; all that follows is surfalize's own.
"""

import csv
import sys
from pathlib import Path

from surfalize import Surface
from surfalize.abbottfirestone import AbbottFirestoneCurve

from stiction.surfaces.prepare import level
from stiction.surfaces.read import read_scan

FILES = ("di-3.di", "stp-1.stp", "top-1.top", "al3d-1.al3d", "tmd-1.tmd")


def row(path: Path) -> dict[str, float]:
    scan = level(read_scan(path))
    surface = Surface(scan.heights * 1e6, *(step * 1e6 for step in scan.pitch[::-1]))
    curve = AbbottFirestoneCurve(surface.center(), nbins=10_001)
    shape = {"Ssk": surface.Ssk(), "Sku": surface.Sku()}
    ratios = {"Sdr": surface.Sdr() / 100, "Str": surface.Str(), "Smr1": curve.mr1() / 100, "Smr2": curve.mr2() / 100}
    lengths = {
        "Sq": surface.Sq(),
        "Sa": surface.Sa(),
        "Sz": surface.Sz(),
        "Sp": surface.Sp(),
        "Sv": surface.Sv(),
        "Sal": surface.Sal(),
        "Sk": curve.k(),
        "Spk": curve.pk(),
        "Svk": curve.vk(),
    }
    return shape | ratios | {name: value * 1e-6 for name, value in lengths.items()}


if __name__ == "__main__":
    rows = [{"file": name, **row(Path(sys.argv[1]) / name)} for name in FILES]
    with Path(__file__).with_name("areal_parameters.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
