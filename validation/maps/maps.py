"""Solve maps that are in no set of the package, to score predictions of the contact area against.

    python validation/maps/maps.py     # a minute on one core; goes on where it was stopped

Kinds are those a contact may state; numbers of the transforms, Hurst exponents, roll-offs and seeds are others than those of
the benchmark set (truth/surfaces.py), whose makers of surfaces are used. Each map is solved as an elastic body, at three
hardnesses, and with two elastic films, by the boundary elements of the package, with twice as many points along each side as
a prediction is given: what the width of points leaves is part of the error.
"""

import json
import sys
from dataclasses import replace
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parents[1] / "truth"))

import numpy as np  # noqa: E402

from solve import _solved, described  # noqa: E402
from stiction.solvers.boundary_elements.compliance import Compliance, Film  # noqa: E402
from stiction.surfaces.heightmap import HeightMap  # noqa: E402
from surfaces import Surface  # noqa: E402

FILE = HERE / "solved.json"
_BASES = ((0.7, 3.0), (0.9, 6.0), (0.45, 12.0), (0.75, 1.5), (0.55, 5.0))
# Mean pressures over E* h', E* that which a shortest wave of pressure meets; hardnesses over E* h'.
ELASTIC, HARDNESSES = (0.003, 0.015, 0.08), (0.02, 0.12, 0.7)
FLOWING = (0.0005, 0.004, 0.015)
# Modulus of the film over that of the substrate, thickness over the shortest wave.
FILMS, ON_FILMS = ((0.2, 0.5), (5.0, 0.6)), (0.01, 0.1)
POISSON = 0.3


def maps() -> dict[str, tuple[str, Surface]]:
    """Return name -> kind of surface as a contact states it, and how it is made."""
    found = {}
    for at, (hurst, ratio) in enumerate(_BASES):
        base = Surface("held", 0, hurst, ratio, points=320, fineness=2.0)
        of_kind = {
            "gaussian": (base,),
            "skewed": tuple(replace(base, change=("exp", s)) for s in (0.33, -0.33)),
            "worn": (replace(base, change=("again", 0.4, 0.04)), replace(base, change=("smooth", 1.1, 0.15))),
            "lay": (replace(base, stretch=5.0, angle=0.4),),
            "two-scale": (replace(base, change=("bands", 1.0 + at)),),
        }
        for number, (kind, surfaces) in enumerate(of_kind.items()):
            for more, one in enumerate(surfaces):
                found[f"{kind} {at + 1}.{more + 1}"] = kind, replace(one, design=7000 + 100 * at + 10 * number + more, seed=1)
    return found


def substrate_modulus(shortest: float, film: tuple[float, float] | None) -> float:
    """Return the modulus that a shortest wave of pressure meets over that of the substrate."""
    return (
        1.0 if film is None else 1.0 / float(compliance_of(shortest, film).times_half_k(np.array([2.0 * np.pi / shortest]))[0])
    )


def compliance_of(shortest: float, film: tuple[float, float]) -> Compliance:
    """Return the compliance of a substrate of plane-strain modulus 1 with a film under a rigid face."""
    modulus, thickness = film
    strain = 1.0 - POISSON**2
    return Compliance(float("inf"), Film(thickness * shortest, modulus * strain, POISSON, strain, POISSON))


def given(surface: HeightMap) -> HeightMap:
    """Return the map with every second point, as a prediction is given it."""
    return surface.with_heights(surface.heights[::2, ::2], "every second point")


def solved(one: Surface) -> dict:
    """Return rms slope and shortest wave [m] of a map, and its states: hardness, film, pressures, shares of the area.

    Pressures are means over E* h', E* that of the substrate.
    """
    surface = one.made()
    record = described(surface)
    slope, shortest = record["gradient"], record["shortest"]
    states = [{"hardness": None, "film": None, **_areas(surface, slope, ELASTIC)}]
    states += [{"hardness": h, "film": None, **_areas(surface, slope, FLOWING, hardness=h)} for h in HARDNESSES]
    for film in FILMS:
        pressures = [p * substrate_modulus(shortest, film) for p in ON_FILMS]
        modulus = compliance_of(shortest, film)
        found = _areas(surface, slope, pressures, film=modulus.film, modulus=float("inf"))
        states.append({"hardness": None, "film": film, **found})
    return {"slope": slope, "shortest": shortest, "states": states}


def _areas(*given, **how) -> dict:
    found = _solved(*given, **how)
    return {name: [float(f"{one:.5g}") for one in found[name]] for name in ("pressure", "area")}


def main() -> None:
    found = json.loads(FILE.read_text()) if FILE.exists() else {}
    for name, (kind, one) in maps().items():
        if name not in found:
            found[name] = {"kind": kind, **solved(one)}
            FILE.write_text(json.dumps(found, indent=1) + "\n")
            print(name, flush=True)


if __name__ == "__main__":
    main()
