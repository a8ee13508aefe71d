"""Write areal_parameters.csv: parameters of real scans by other libraries, run by hand.

pip install surfalize scikit-image shapely
python tests/surfaces/make_areal_parameters.py ../shared/scans

Heights are those that stiction reads and levels, in micrometres. The rest is surfalize's, but for four parameters that it
reads off at the nearest of its points: Sal and Str come from contours of its autocorrelation by scikit-image, Spk and Svk from
areas of polygons by shapely. surfalize's own values differ from these by up to 1.4e-3 (Sal, Str) and 2.2e-3 (Spk, Svk).
"""

import csv
import sys
from pathlib import Path

import numpy as np
from matplotlib.path import Path as Outline
from shapely.geometry import Polygon, box
from skimage.measure import find_contours
from surfalize import Surface
from surfalize.abbottfirestone import AbbottFirestoneCurve
from surfalize.autocorrelation import AutocorrelationFunction

from stiction.surfaces.prepare import level
from stiction.surfaces.read import read_scan

FILES = ("di-3.di", "stp-1.stp", "top-1.top", "al3d-1.al3d", "tmd-1.tmd")


def decay_lengths(surface: Surface) -> tuple[float, float]:
    """Return the shortest distance on all contours at 0.2, and the longest on the first contour around the origin [um]."""
    found = AutocorrelationFunction(surface)
    contours = find_contours(found.data, 0.2 * found.data[tuple(found.center)])
    radii = [np.hypot(*((contour - found.center) * (surface.step_y, surface.step_x)).T) for contour in contours]
    around = [Outline(contour).contains_point(found.center) for contour in contours]
    outer = min(radius.max() for radius, encloses in zip(radii, around, strict=True) if encloses)
    return min(radius.min() for radius in radii), outer


def reduced_heights(curve: AbbottFirestoneCurve) -> tuple[float, float]:
    """Return Spk and Svk [um]: heights of the triangles with the areas of hills and dales."""
    height, ratio = curve._height, curve._material_ratio / 100
    top, bottom = height[0] + 1, height[-1] - 1
    line = [*zip(ratio, height, strict=True)]
    hills = Polygon([*line, (1, bottom), (0, bottom)]).buffer(0).intersection(box(0, curve._yupper, 1, top)).area
    dales = Polygon([(0, top), *line, (1, top)]).buffer(0).intersection(box(0, bottom, 1, curve._ylower)).area
    return 200 * hills / curve.mr1(), 200 * dales / (100 - curve.mr2())


def row(path: Path) -> dict[str, float]:
    scan = level(read_scan(path))
    surface = Surface(scan.heights * 1e6, *(step * 1e6 for step in scan.pitch[::-1]))
    curve = AbbottFirestoneCurve(surface.center(), nbins=10_001)
    shortest, longest = decay_lengths(surface)
    hills, dales = reduced_heights(curve)
    shape = {"Ssk": surface.Ssk(), "Sku": surface.Sku()}
    ratios = {"Sdr": surface.Sdr() / 100, "Str": shortest / longest, "Smr1": curve.mr1() / 100, "Smr2": curve.mr2() / 100}
    lengths = {
        "Sq": surface.Sq(),
        "Sa": surface.Sa(),
        "Sz": surface.Sz(),
        "Sp": surface.Sp(),
        "Sv": surface.Sv(),
        "Sal": shortest,
        "Sk": curve.k(),
        "Spk": hills,
        "Svk": dales,
    }
    return shape | ratios | {name: value * 1e-6 for name, value in lengths.items()}


if __name__ == "__main__":
    rows = [{"file": name, **row(Path(sys.argv[1]) / name)} for name in FILES]
    with Path(__file__).with_name("areal_parameters.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
