"""Maps moved aside until they slide: the largest force over the sum of strengths, to fit the compact law of efficiency.

    python truth/slides.py

writes slides.csv beside this file; half an hour on one core, less where rows are kept in truth/work. Elastic maps of 128 x 128
points of gradient .1, spots of one strength, like bodies of nu 0.3. Columns: design, held: whether the row is for judging, not
for fits; edges: whether nothing is beside the map, or its next period; pressure over E* h'; share: contact over nominal area;
radius: of spots, weighted by their area, over the side; numbers: that of `spot_radius` from the numbers of the asperities;
density: eta R sigma; spread: standard deviation over the contact of the displacement under its strength, over strength,
compliance S and side; length: l_c over the side; residual: share of the strength that stays; efficiency. Then it prints the
constants of stiction.solving.sliding_efficiency that fit the rows, and what they leave on rows that are held out.
"""

import csv
import json
import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.ndimage import label
from scipy.optimize import least_squares

import stiction as st
import surfaces as design
from solve import WORK
from stiction.solvers.boundary_elements.measures import waves
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.solvers.shear.compliance import HalfSpace, ShearCompliance
from stiction.solvers.shear.operators import FreeShear, PeriodicShear
from stiction.solvers.shear.path import Weakening, full_shift, slide_map, weakening_length
from stiction.solving import sliding_efficiency as law
from stiction.solving.sliding_efficiency import spot_radius

FILE = Path(__file__).parent / "slides.csv"
POINTS = 128
PRESSURES = (0.01, 0.06, 0.25)
RADII = (0.1, 0.5, 2.0, 4.0, 8.0)  # of spots over l_c
SIZES = (0.5, 2.0, 6.0, 12.0)  # of the nominal side times the share of contact, over l_c
RESIDUALS = (0.0, 0.5, 0.8)
LEAST_POINTS = 3.0  # in l_c
_STRONG = 0.93  # efficiency above which no point has lost all that it can: the residual strength does not matter
COLUMNS = (
    "design",
    "held",
    "edges",
    "pressure",
    "share",
    "radius",
    "numbers",
    "density",
    "spread",
    "length",
    "residual",
    "efficiency",
)
_STEPS = 20
_BODY = HalfSpace(2.6, 0.3)  # of G = 1


def some() -> Iterator[design.Surface]:
    """The surfaces: two seeds of each design, the second held out, and designs that are held out as a whole."""
    for number, (fineness, ratio, hurst) in enumerate(((1.0, 4.0, 0.8), (2.0, 2.0, 0.8), (4.0, 1.0, 0.8), (2.0, 1.0, 0.3))):
        base = design.Surface("gaussian", 0, hurst, ratio, points=POINTS, fineness=fineness, design=950 + number)
        yield from (replace(base, seed=seed) for seed in (1, 3))
    for number, (fineness, ratio, change) in enumerate(
        ((2.0, 1.5, ("exp", 0.45)), (2.5, 1.0, ("smooth", 0.7, 0.15)), (1.4, 4.0, ()))
    ):
        kind = {"exp": "skewed", "smooth": "worn"}[change[0]] if change else "gaussian"
        yield design.Surface(kind, 3, 0.6, ratio, points=POINTS, fineness=fineness, change=change, design=960 + number)


def radius_of_spots(touching: np.ndarray, periodic: bool) -> float:
    """Radius of the spots of a map, weighted by their area, over its side."""
    spots, count = label(touching)
    if periodic:  # join spots across the sides
        parent = np.arange(count + 1)
        for first, last in ((spots[0], spots[-1]), (spots[:, 0], spots[:, -1])):
            for one, other in zip(first[(first > 0) & (last > 0)], last[(first > 0) & (last > 0)], strict=True):
                parent[parent == parent[other]] = parent[one]
        spots = parent[spots]
    areas = np.bincount(spots[spots > 0]) / touching.size
    return float(np.sum(areas * np.sqrt(areas / math.pi)) / areas.sum())


def rows_of(surface: design.Surface) -> list[list]:
    """All rows of a surface, kept in WORK."""
    file = WORK / f"{surface.name}_f{surface.fineness:g}.slides"
    if not file.exists():
        WORK.mkdir(exist_ok=True)
        file.write_text(json.dumps(list(_moved(surface))))
    return json.loads(file.read_text())


def _moved(surface: design.Surface) -> Iterator[list]:
    made = surface.made()
    gradient = waves(made.heights, made.size, True).gradient
    loads = [pressure * gradient * made.size[0] ** 2 for pressure in PRESSURES]
    compliance = ShearCompliance((_BODY, _BODY))
    name = f"{surface.name}_f{surface.fineness:g}"
    for pressure, one in zip(
        PRESSURES, solve_map(made.heights, made.size, modulus=1.0, loads=loads, periodic=True), strict=True
    ):
        strength = (one.pressure > 0.0).astype(float)
        share = float(strength.mean())
        for edges, boundary in ((False, PeriodicShear), (True, FreeShear)):
            operator = boundary(compliance, strength.shape, (1.0, 1.0))
            radius = radius_of_spots(strength > 0.0, not edges)
            unit = weakening_length(operator, 1.0, Weakening(1.0))  # l_c of a slip of 1
            spread = float(np.std(operator(strength[None])[0][strength > 0.0])) * unit
            for size in SIZES if edges else RADII:
                length = share / size if edges else radius / size
                if length * POINTS < LEAST_POINTS:
                    continue
                for residual in RESIDUALS:
                    weakening = Weakening(length / unit * (1.0 - residual), residual)
                    shifts = np.linspace(0.0, full_shift(operator, strength), _STEPS + 1)[1:]  # the peak is before all slips
                    path = slide_map(operator, strength, shifts, pixel=1.0, weakening=weakening, tolerance=1e-5)
                    held = surface.held_out
                    yield [name, held, edges, pressure, share, radius, spread, length, residual, path.efficiency]
                    if path.efficiency > _STRONG:
                        break


def rows() -> Iterator[list]:
    """Every row."""
    for surface in some():
        yield from _with_numbers(surface, rows_of(surface))
        print(surface.name, flush=True)


def _with_numbers(surface: design.Surface, found: list[list]) -> Iterator[list]:
    """Add the radius of spots that the numbers of the asperities give."""
    made = surface.made()
    area = made.size[0] ** 2
    rough = st.Contact(first="silicon", second="silicon", roughness=made, nominal_area=area).as_numbers().roughness
    numbers = rough.asperity_height_deviation, rough.asperity_radius, rough.asperity_density
    at = COLUMNS.index("numbers")
    for row in found:
        radius = float(spot_radius(row[COLUMNS.index("share")], *numbers)) / made.size[0]
        yield [*row[:at], radius, float(np.prod(numbers)), *row[at:]]


def fit(table: dict[str, np.ndarray]) -> None:
    """Print constants that fit the rows, and the error of the law on those held out."""
    used, held = table["held"] == 0, table["held"] == 1
    spread, residual, wanted = table["spread"] / table["length"], table["residual"], np.log(table["efficiency"])

    def error(constants: np.ndarray) -> np.ndarray:
        return (np.log(law.efficiency(spread / (1.0 - residual), residual, constants)) - wanted)[used]

    print("b, m, w:", least_squares(error, law.FITTED).x)
    left = np.log(law.efficiency(spread / (1.0 - residual), residual)) - wanted
    for name, some in (("fitted", used), ("held out", held)):
        rms, largest = np.sqrt(np.mean(left[some] ** 2)), abs(left[some]).max()
        print(f"{name}: {np.count_nonzero(some)} rows, {rms:.4f} rms, {largest:.4f} at most")
    endless, first = table["edges"] == 0, np.unique(table["spread"], return_index=True)[1]
    one = np.intersect1d(np.flatnonzero(endless), first)
    ratio = np.log(table["spread"][one] / table["numbers"][one] / (1.0 - 0.5 * _BODY.poisson))
    known = np.column_stack([np.ones(len(one)), np.log1p(-table["share"][one]), np.log(table["density"][one])])
    constants = np.linalg.lstsq(known, ratio, rcond=None)[0]
    factor, *powers = np.exp(constants[0]), *constants[1:]
    print(f"k_a {factor:.3f}, q {powers[0]:.3f}, d {powers[1]:.3f}, deviation {np.std(ratio - known @ constants):.3f}")


if __name__ == "__main__":
    with FILE.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(
            [value if isinstance(value, str) else int(value) if isinstance(value, bool) else f"{value:.5g}" for value in row]
            for row in rows()
        )
    with FILE.open(encoding="utf-8") as file:
        found = list(csv.DictReader(file))
    fit({name: np.array([float(row[name]) for row in found]) for name in COLUMNS[1:]})
