"""What every model says of the solved surfaces: shares of the area at the same loads, one file a surface.

    python truth/models.py [FOLDER]

Every rough-surface model and asperity law that `compare` asks, under every way of finding asperities, with heights as each
finds them; theories of the whole surface with its moments; this project's law also with the map ("map"). Hardnesses are those
of the solutions. Models that know adhesion get too little of it to matter.
"""

import json
import math
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import surfaces as design
from solve import WORK
from stiction.contact.coating import Coating
from stiction.contact.contact import Contact
from stiction.contact.materials import Material
from stiction.quantities.dimensions import axis
from stiction.quantities.errors import InputError
from stiction.records.registry import RoughSurface, find
from stiction.solvers.boundary_elements.map_area import MapArea
from stiction.solving.candidates import Candidate, candidates
from stiction.solving.inversion import Unreachable, separations_at
from stiction.solving.problem import make_problem, takes_surface_moments
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.measured import MeasuredRoughness, measure
from stiction.surfaces.roughness import Roughness

MODULUS = 1e11  # E*, of the substrate where there is a film [Pa]
WEAK = 1e-6  # work of adhesion [J/m2]
ELASTIC = 1e6  # hardness over E* h' of what does not flow
OWN, MAP = "persson_widened", "map"
MAP_SEED = 3  # it is solved anew: one surface of each design is enough
_POISSON, _RIGID = 0.3, 1e30
_MOMENTS, _ON_FILM = "moments", "mccool"  # on films one way of finding asperities is enough: laws differ more


def contact(nominal: float, roughness: Roughness, hardness, coating: Coating | None = None) -> Contact:
    """A rigid smooth body on a rough one of nominal area [m2]; hardness: [Pa], an array over "hardness", of the rough body."""
    strain = 1.0 - _POISSON**2
    soft = Material(youngs_modulus=MODULUS * strain, poissons_ratio=_POISSON, hardness=hardness)
    rigid = Material(youngs_modulus=_RIGID, poissons_ratio=_POISSON, hardness=_RIGID)
    more = {} if coating is None else {"coating": coating}
    return Contact(
        first=soft, second=rigid, roughness=roughness, work_of_adhesion=WEAK, nominal_area=nominal,
        interfacial_shear_strength=1e6, **more,
    )  # fmt: skip


def shares(one: Contact, candidate: Candidate, loads: np.ndarray) -> np.ndarray:
    """A/A0 (n, m) at loads [N] (n, m), not a number where the model does not carry one."""
    problem = make_problem(one, candidate.choice)
    factors = (
        one.scales().factors() if not takes_surface_moments(candidate.choice.model) else problem.subject.scales().factors()
    )
    targets = loads / float(np.ravel(factors["N"])[0])
    if problem.needs_load:
        area = problem.at_load(targets)["contact_area"]
    else:
        h = separations_at(problem, targets, refuse=False).h
        area = np.full(h.shape, np.nan)
        for row, known in enumerate(np.isfinite(h)):
            if known.any():
                found = problem.with_groups(np.array([row])).at(h[row : row + 1, known])
                area[row, known] = found["contact_area"][0]
    return area * float(np.ravel(factors["m^2"])[0]) / one.nominal_area


def said(one: design.Surface, record: dict) -> dict:
    """Column -> shares, by what was solved: "elastic", hardnesses, and numbers of films; and the asperities of each method."""
    surface = one.made()
    found = measure(MeasuredRoughness(first=surface))
    answer = {"asperities": _asperities(found), "standing": found.method, "asked": [], "bare": {}, "films": []}
    hardnesses, pressures = _bare_loads(record)
    strength = MODULUS * record["gradient"]
    nominal = surface.size[0] * surface.size[1]
    axis_of = axis("hardness", np.array(hardnesses) * strength)
    for column, candidate, roughness in _columns(found, contact(nominal, found.roughness(), axis_of)):
        _ask(answer, column, contact(nominal, roughness, axis_of), candidate, pressures * strength * nominal)
    if one.seed == MAP_SEED:
        answer["bare"][f"{OWN}|{MAP}"] = _own(surface, record, hardnesses, pressures)
    for film in record["films"]:
        answer["films"].append(_on_film(surface, found, record, film))
    return answer


def with_new_theories(one: design.Surface, record: dict, answer: dict) -> bool:
    """Adds what theories of the whole surface say that joined since the answer was made; whether there are any."""
    sigma, radius, density, _ = answer["asperities"]["mccool"]
    moments = Roughness(asperity_height_deviation=sigma, asperity_radius=radius, asperity_density=density)
    hardnesses, pressures = _bare_loads(record)
    strength, nominal = MODULUS * record["gradient"], design.SIDE**2
    bare = contact(nominal, moments, axis("hardness", np.array(hardnesses) * strength))
    new = [
        candidate
        for candidate in candidates(bare)
        if takes_surface_moments(candidate.choice.model) and f"{candidate.name}|{_MOMENTS}" not in answer["asked"]
    ]
    for candidate in new:
        _ask(answer, f"{candidate.name}|{_MOMENTS}", bare, candidate, pressures * strength * nominal)
    return bool(new)


def _ask(answer: dict, column: str, one: Contact, candidate: Candidate, loads: np.ndarray) -> None:
    answer["asked"].append(column)
    try:
        answer["bare"][column] = _plain(shares(one, candidate, loads))
    except (InputError, Unreachable):
        return  # what it does not know or carry is not measured


def _asperities(found) -> dict:
    return {
        method: [one.asperity_height_deviation, one.asperity_radius, one.asperity_density, one.height_distribution]
        for method, one in found.by_method.items()
    }


def _bare_loads(record: dict) -> tuple[list[float], np.ndarray]:
    """Hardnesses over E* h', the first elastic, and pressures over E* h' (n, m), the last repeated where there are fewer."""
    every = [(ELASTIC, record["elastic"]), *((float(h), one) for h, one in record["plastic"].items())]
    most = len(record["elastic"]["pressure"])
    rows = [one["pressure"] + [one["pressure"][-1]] * (most - len(one["pressure"])) for _, one in every]
    return [hardness for hardness, _ in every], np.array(rows)


def _columns(found, one: Contact) -> Iterator[tuple[str, Candidate, Roughness]]:
    """Name of a column, "model|method", what to ask and with which roughness."""
    for candidate in candidates(one):
        if find(candidate.choice.model, RoughSurface).of_map is not None:
            continue  # the solution itself
        if takes_surface_moments(candidate.choice.model):
            surface = found.by_method[found.of_moments].replace(surface=None)
            yield f"{candidate.name}|{_MOMENTS}", candidate, surface
            continue
        for method, roughness in found.by_method.items():
            yield f"{candidate.name}|{method}", candidate, roughness


def _own(surface: HeightMap, record: dict, hardnesses: list[float], pressures: np.ndarray) -> list:
    area, h = MapArea(surface.heights, surface.size, True), record["gradient"]
    known = [math.inf if hardness == ELASTIC else hardness * h for hardness in hardnesses]
    return _plain(np.array([area.share(row * h, hardness) for row, hardness in zip(pressures, known, strict=True)]))


def _on_film(surface: HeightMap, found, record: dict, film: dict) -> dict:
    strain, strength = 1.0 - _POISSON**2, MODULUS * record["gradient"]
    body = Material(youngs_modulus=film["modulus"] * MODULUS * strain, poissons_ratio=_POISSON, hardness=ELASTIC * strength)
    coating = Coating(material=body, thickness=film["thickness"] * record["shortest"], bodies="first")
    nominal = surface.size[0] * surface.size[1]
    loads = np.array([film["pressure"]]) * strength * nominal
    answer = {}
    for column, candidate, roughness in _columns(found, contact(nominal, found.roughness(), ELASTIC * strength, coating)):
        if not column.endswith((_MOMENTS, _ON_FILM)):
            continue
        try:
            answer[column] = _plain(shares(contact(nominal, roughness, ELASTIC * strength, coating), candidate, loads))
        except (InputError, Unreachable):
            continue
    return answer


def _plain(table: np.ndarray) -> list:
    return [[None if not math.isfinite(value) else float(f"{value:.4g}") for value in row] for row in table]


def main(folder: Path) -> None:
    todo = design.surfaces()
    for number, one in enumerate(todo, start=1):
        solved, path = folder / f"{one.name}.json", folder / f"{one.name}.models"
        record = json.loads(solved.read_text())
        kept = path.exists() and path.stat().st_mtime > solved.stat().st_mtime  # of this solution, not of one before
        answer = json.loads(path.read_text()) if kept else said(one, record)
        if kept and not with_new_theories(one, record, answer):
            continue
        part = path.with_suffix(".part2")
        part.write_text(json.dumps(answer))
        part.rename(path)
        print(f"{number} of {len(todo)}: {one.name}", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else WORK)
