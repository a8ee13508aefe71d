"""Fits the constants of `area_estimates` to the surfaces of the set with seeds 1 and 2, and judges them by the others.

    python truth/fit.py [FOLDER]

It prints; the constants stand, rounded, in `stiction.solvers.boundary_elements.area_estimates`. Those of the moments and the
top slopes are fitted to Gaussian isotropic surfaces, those of the ranks to all.
"""

import json
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

import surfaces as design
from solve import WORK
from stiction.solvers.boundary_elements.area_estimates import MapSlopes, first_crossing, map_slopes
from stiction.surfaces.theory.widened_area import widened

PRESSURES = np.array(design.LOADS)
JUDGED = slice(0, 8)  # .002 to .3
Formula = Callable[[np.ndarray, MapSlopes], np.ndarray]


@dataclass(frozen=True)
class Solved:
    """A surface, its slopes, and its elastic area at PRESSURES."""

    surface: design.Surface
    slopes: MapSlopes
    area: np.ndarray


def by_moments(c: np.ndarray, slopes: MapSlopes) -> np.ndarray:
    return widened(PRESSURES, c[0] - c[1] * np.log(slopes.alpha))


def by_top_slopes(c: np.ndarray, slopes: MapSlopes) -> np.ndarray:
    of_log = c[0] - c[1] * np.log(slopes.alpha)
    ratio = np.sqrt(np.cumsum(slopes.squares) / np.arange(1, len(slopes.squares) + 1))
    reach = np.minimum(0.5 * slopes.ranks, 1.0)
    return np.array([first_crossing(reach, widened(p / ratio, of_log), float(widened(p, of_log))) for p in PRESSURES])


def by_ranks(c: np.ndarray, slopes: MapSlopes) -> np.ndarray:
    of_log = c[0] - c[1] * np.log(slopes.alpha) + c[2] * np.log(slopes.lay)
    mean = (np.cumsum(slopes.squares ** (0.5 * c[3])) / np.arange(1, len(slopes.squares) + 1)) ** (1.0 / c[3])
    area = slopes.ranks / (c[4] + c[5] * mean)
    return np.array([first_crossing(area, widened(p / mean, of_log), float(widened(p, of_log))) for p in PRESSURES])


def errors(formula: Formula, constants: np.ndarray, some: list[Solved]) -> np.ndarray:
    """(surfaces, pressures), relative."""
    return np.array([formula(constants, one.slopes) / one.area - 1.0 for one in some])


def fitted(formula: Formula, start: tuple[float, ...], some: list[Solved]) -> np.ndarray:
    """Constants, by a loss that outliers do not rule; up to p = .5."""

    def left(constants: np.ndarray) -> np.ndarray:
        return np.log1p(errors(formula, constants, some))[:, :9].ravel()

    return least_squares(left, start, loss="soft_l1", f_scale=0.04, x_scale=np.abs(start), diff_step=1e-3, max_nfev=15).x


def judged(name: str, error: np.ndarray) -> None:
    error = error[:, JUDGED]
    rms, within, worst = np.sqrt(np.mean(error**2)), np.mean(np.abs(error) < 0.05), np.abs(error).max()
    print(f"  {name}: rms {rms:.1%}, {within:.0%} within 5 %, largest {worst:.0%}")


def main(folder: Path) -> None:
    every = []
    for one in design.surfaces():
        surface, record = one.made(), json.loads((folder / f"{one.name}.json").read_text())
        every.append(Solved(one, map_slopes(surface.heights, surface.size), np.array(record["elastic"]["area"])))
    gaussian = [one for one in every if one.surface.kind == "gaussian"]
    for formula, start, some in (
        (by_moments, (0.6, 0.05), gaussian), (by_top_slopes, (0.6, 0.05), gaussian),
        (by_ranks, (0.6, 0.05, 0.16, 1.0, 1.0, 0.6), every),
    ):  # fmt: skip
        constants = fitted(formula, start, [one for one in some if not one.surface.held_out])
        print(formula.__name__, np.round(constants, 3).tolist())
        held = [one for one in some if one.surface.held_out]
        for kind in dict.fromkeys(one.surface.kind for one in held):
            judged(kind, errors(formula, constants, [one for one in held if one.surface.kind == kind]))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else WORK)
