"""What the width of points leaves: areas of maps as a prediction finds them, against those of finer maps.

    python truth/points.py

writes points.csv beside this file; ten minutes on one core, less where solutions are kept in truth/work. Surfaces are designs
of the set (surfaces.py) with seeds of their own, 24 points in the shortest wave of a Gaussian one; a prediction is given every
third point. Columns: design, kind; hardness over E* h' (empty: elastic); film: modulus over that of the body (empty: none),
half a shortest wave thick; pressure over E* h'; points: of the given map in contact; solved: area over the nominal one; error:
ln of the predicted over the solved area.
"""

import csv
import json
import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

import surfaces as design
from solve import _POISSON, WORK, _solved, described
from stiction.contact.coating import Coating
from stiction.contact.contact import Contact
from stiction.contact.materials import Material
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solving.choice import Choice
from stiction.solving.problem import make_problem

FILE = Path(__file__).parent / "points.csv"
FINER, EVERY = 3, 8  # points along a side over those given; of the designs every eighth is solved
MOST = 11  # designs
PRESSURES = (0.0006, 0.002, 0.006, 0.02, 0.08)
HARDNESSES, OF_HARDNESS = (0.5,), (0.01, 0.1, 0.4)
FILMS, ON_FILMS = (0.3, 4.0), (0.003, 0.06)
COLUMNS = ("design", "kind", "hardness", "film", "pressure", "points", "solved", "error")
_MODULUS = 1e11


def some() -> Iterator[design.Surface]:
    """Designs of the set, with points and seeds of their own."""
    designs = {one.design: one for one in design.surfaces() if one.points == 256}
    for one in list(designs.values())[::EVERY][:MOST]:
        yield replace(one, seed=7, points=256 * FINER, fineness=float(FINER))


def _states() -> list[tuple[float | None, float | None, tuple[float, ...]]]:
    """Hardness, film and pressures of each state."""
    hard = [(h, None, tuple(h * part for part in OF_HARDNESS)) for h in HARDNESSES]
    return [(None, None, PRESSURES), *hard, *((None, film, tuple(p * film**0.5 for p in ON_FILMS)) for film in FILMS)]


def solved(one: design.Surface) -> list[list[float]]:
    """Areas of each state of a surface, kept in WORK."""
    file = WORK / f"{one.name}.points"
    if file.exists():
        return json.loads(file.read_text())
    surface = one.made()
    record, found = described(surface), []
    for hardness, film, pressures in _states():
        layer = None
        if film is not None:
            strain = 1.0 - _POISSON**2
            layer = Film(0.5 * record["shortest"], film * strain, _POISSON, strain, _POISSON)
        modulus = 1.0 if film is None else math.inf
        found.append(_solved(surface, record["gradient"], pressures, hardness=hardness, film=layer, modulus=modulus)["area"])
    WORK.mkdir(exist_ok=True)
    file.write_text(json.dumps(found))
    return found


def rows(one: design.Surface) -> Iterator[list]:
    """Rows of a surface."""
    areas, surface = solved(one), one.made()
    given = surface.with_heights(np.ascontiguousarray(surface.heights[::FINER, ::FINER]), "every third point")
    record = described(surface)
    for (hardness, film, pressures), of_state in zip(_states(), areas, strict=True):
        predicted = _predicted(given, record["gradient"], pressures, hardness, film, 0.5 * record["shortest"])
        for pressure, area, own in zip(pressures, of_state, predicted, strict=True):
            error = math.log(own / area) if own > 0.0 else math.nan
            yield [one.name, one.kind, hardness or "", film or "", pressure, round(area * given.heights.size), area, error]


def _predicted(given, slope, pressures, hardness, film, thickness) -> np.ndarray:
    strain = 1.0 - _POISSON**2
    body = Material(youngs_modulus=_MODULUS * strain, poissons_ratio=_POISSON, hardness=(hardness or 1e6) * _MODULUS * slope)
    rigid = Material(youngs_modulus=1e30, poissons_ratio=_POISSON, hardness=1e30)
    coating = None
    if film is not None:
        layer = Material(youngs_modulus=film * _MODULUS * strain, poissons_ratio=_POISSON, hardness=body.hardness)
        coating = Coating(material=layer, thickness=thickness, bodies="first")
    contact = Contact(
        first=body, second=rigid, roughness=given, nominal_area=given.size[0] * given.size[1], coating=coating,
        work_of_adhesion=0.0, interfacial_shear_strength=1e3,
    )  # fmt: skip
    problem = make_problem(contact, Choice("persson_widened" if film is None else "rough_on_film", tangential="none"))
    factors = problem.subject.scales().factors()
    loads = np.array(pressures) * _MODULUS * slope * contact.nominal_area / float(np.ravel(factors["N"])[0])
    area = np.ravel(problem.at_load(loads[None, :])["contact_area"]) * float(np.ravel(factors["m^2"])[0])
    return area / contact.nominal_area


def main() -> None:
    every = [row for one in some() for row in rows(one)]
    with FILE.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows([value if isinstance(value, str) else f"{value:.5g}" for value in row] for row in every)


if __name__ == "__main__":
    main()
