"""Solves the surfaces of the set, one file a surface, so that what is done is not done again.

    python truth/solve.py [FOLDER]

Periodic, elastic bodies of E* = 1, or with pressures up to a hardness, or one of them with a film; see `surfaces.py`.
"""

import json
import sys
from pathlib import Path

import numpy as np
from scipy.stats import kurtosis, skew

import surfaces as design
from stiction.solvers.boundary_elements.area_estimates import map_slopes
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.measures import waves
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces.heightmap import HeightMap

WORK = Path(__file__).parent / "work"
_POISSON = 0.3


def described(surface: HeightMap) -> dict:
    """What is kept of the surface itself."""
    heights, size = surface.heights, surface.size
    slopes, seen = map_slopes(heights, size), waves(heights, size, True)
    flat = heights.ravel()
    return {
        "alpha": slopes.alpha, "gradient": slopes.gradient, "lay": slopes.lay, "deviation": float(flat.std()),
        "skewness": float(skew(flat)), "kurtosis": float(kurtosis(flat)) + 3.0,
        "top": slopes.top(design.TOP), "shortest": seen.shortest, "longest": seen.longest, "pixel": size[0] / heights.shape[0],
    }  # fmt: skip


def _solved(surface: HeightMap, gradient: float, pressures, *, hardness=None, film=None, modulus=1.0) -> dict:
    """Shares of the area at pressures over E* h', with E* = 1: counted, and sides of pixels at edges over points."""
    nominal = surface.size[0] * surface.size[1]
    found = solve_map(
        surface.heights, surface.size, modulus=modulus, loads=np.asarray(pressures) * gradient * nominal, periodic=True,
        hardness=None if hardness is None else hardness * gradient, film=film, keep_maps=False, stiffness=False,
    )  # fmt: skip
    assert not any(warning.quantity == "not_converged" for contact in found for warning in contact.validity_warnings)
    return {"pressure": list(pressures), "area": (found.array("area") / nominal).tolist(),
            "counted": (found.array("area_pixels") / nominal).tolist()}  # fmt: skip


def solved(one: design.Surface) -> dict:
    """Everything of one surface."""
    surface = one.made()
    record = described(surface)
    gradient = record["gradient"]
    record["elastic"] = _solved(surface, gradient, design.LOADS)
    record["plastic"] = {}
    for hardness in design.HARDNESSES if one.with_hardness else ():
        pressures = [p for p in design.LOADS if p < design.MOST_OF_HARDNESS * hardness]
        record["plastic"][str(hardness)] = _solved(surface, gradient, pressures, hardness=hardness)
    record["films"] = [] if not one.with_films else [_with_film(surface, record, *film) for film in _films()]
    return record


def _films():
    return [(modulus, thickness) for modulus in design.FILM_MODULI for thickness in design.FILM_THICKNESSES]


def _with_film(surface: HeightMap, record: dict, modulus: float, thickness: float) -> dict:
    """A film on a substrate of plane-strain modulus 1 under a rigid face; pressures are over that of the substrate times h'."""
    strain = 1.0 - _POISSON**2
    film = Film(thickness * record["shortest"], modulus * strain, _POISSON, strain, _POISSON)
    rigid = Compliance(np.inf, film)
    at_shortest = 1.0 / float(rigid.times_half_k(np.array([2.0 * np.pi / record["shortest"]]))[0])
    pressures = [p * at_shortest for p in design.FILM_LOADS]
    found = _solved(surface, record["gradient"], pressures, film=film, modulus=np.inf)
    return {"modulus": modulus, "thickness": thickness, **found}


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    todo = design.surfaces()
    for number, one in enumerate(todo, start=1):
        path = folder / f"{one.name}.json"
        if path.exists():
            continue
        part = path.with_suffix(".part")
        part.write_text(json.dumps(solved(one)))
        part.rename(path)
        print(f"{number} of {len(todo)}: {one.name}", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else WORK)
