"""Rough surfaces on a film, solved by layered boundary elements: what film laws are judged by.

    python truth/films.py

writes films.csv beside this file; five minutes on one core. Periodic maps of 256 x 256 points, 32 shortest waves on a side, on
a film under a rigid flat face; lengths over the shortest wave, pressures over E* h' of the half-space, E* its plane-strain
modulus and h' the rms gradient. Columns: the map (hurst, rolloff, longest, seed, and its alpha of Nayak), the film (modulus: of
plane strain over that of the half-space; thickness; nu, nu_below; hardness, empty: elastic), pressure, area and counted: shares
of the nominal area, corrected for pixels and as counted.
"""

import csv
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from stiction.solvers.boundary_elements.area_estimates import map_slopes
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces.generate import gaussian_surface, with_slope
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import SelfAffine

FILE = Path(__file__).parent / "films.csv"
POINTS, SIDE, GRADIENT = 256, 32.0, 0.05
# Hurst exponent, roll-off and longest wave over the shortest one.
DESIGNS = (
    (0.8, 6.0, 6.0), (0.8, 16.0, 16.0), (0.5, 4.0, 4.0), (0.3, 8.0, 8.0), (1.0, 8.0, 16.0), (0.7, 3.0, 8.0), (0.6, 2.0, 4.0),
    (0.9, 10.0, 10.0), (0.8, 1.8, 1.8), (0.4, 6.0, 16.0),
)  # fmt: skip
ELASTIC, HARD = 16, 5  # films of each kind on a map
MODULI, THICKNESSES, PRESSURES, HARDNESSES = (0.1, 10.0), (0.15, 5.0), (0.01, 0.2), (0.05, 0.5)
OF_HARDNESS = (0.1, 0.3, 0.7)  # pressures where there is one
COLUMNS = (
    "hurst", "rolloff", "longest", "seed", "alpha", "modulus", "thickness", "nu", "nu_below", "hardness", "pressure", "area",
    "counted",
)  # fmt: skip


def surface(hurst: float, rolloff: float, longest: float, seed: int) -> HeightMap:
    """The map of this design and seed; lengths in m stand for shortest waves."""
    spectrum = SelfAffine(hurst=hurst, rolloff=rolloff, shortest=1.0, deviation=1.0, longest=longest)
    return with_slope(gaussian_surface((POINTS, POINTS), (SIDE, SIDE), spectrum, seed=seed), GRADIENT)


def rows() -> Iterator[list]:
    """Every row, map by map."""
    for at, design in enumerate(DESIGNS):
        seed = 4000 + at
        one, rng = surface(*design, seed), np.random.default_rng(seed)
        slopes = map_slopes(one.heights, one.size)
        head = [*design, seed, slopes.alpha]
        for film in range(ELASTIC + HARD):
            modulus, thickness = _between(rng, *MODULI), _between(rng, *THICKNESSES)
            nu, below = rng.uniform(0.15, 0.48), rng.uniform(0.2, 0.4)
            hardness = _between(rng, *HARDNESSES) if film >= ELASTIC else None
            pressures = sorted(_between(rng, *PRESSURES) for _ in range(3))
            if hardness is not None:
                pressures = [hardness * share for share in OF_HARDNESS]
            solved = _solved(one, slopes.gradient, modulus, thickness, nu, below, hardness, pressures)
            for pressure, (area, counted) in zip(pressures, solved, strict=True):
                hard = "" if hardness is None else hardness
                yield [*head, modulus, thickness, nu, below, hard, pressure, area, counted]
        print(*design, flush=True)


def _between(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def _solved(one, gradient, modulus, thickness, nu, below, hardness, pressures) -> list[tuple[float, float]]:
    """Shares of the area, corrected and counted, at each pressure."""
    nominal = one.size[0] * one.size[1]
    film = Film(thickness, modulus * (1.0 - nu**2), nu, 1.0 - below**2, below)
    found = solve_map(
        one.heights, one.size, modulus=math.inf, film=film, loads=np.array(pressures) * gradient * nominal, periodic=True,
        hardness=None if hardness is None else hardness * gradient, stiffness=False, keep_maps=False,
    )  # fmt: skip
    assert not any(warning.quantity == "not_converged" for contact in found for warning in contact.validity_warnings)
    return [(contact.area / nominal, contact.area_pixels / nominal) for contact in found]


if __name__ == "__main__":
    with FILE.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows([value if isinstance(value, str) else f"{value:.6g}" for value in row] for row in rows())
