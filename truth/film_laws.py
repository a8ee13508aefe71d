"""How far film laws are from the truth: a sphere on a film, exactly, and rough surfaces on a film, by boundary elements.

    python truth/film_laws.py

writes what records and results say of film laws, into the package, in a minute; rough surfaces are those of films.csv, which
films.py makes. Everything is elastic, without adhesion, on one body against a rigid one.

film_errors_on_a_sphere.csv: nu = 0.3 of film and body. For every law with its options, modulus of the film over that of the
body and contact radius over thickness: area over the exact one at the exact load, load over the exact one at the exact
approach. thickness_over_radius: empty where it does not count.

film_errors_on_maps.csv: sums over asperities with the moments of the map (McCool), where the area is no more than a fifth of
the nominal one, and the area law of a surface on a film at all areas: area over that of the solved map at the same load, over
bins of the film's modulus and thickness (over the shortest wave): its geometric mean, the root mean square of its logarithm,
and how many solutions there are in the bin.
"""

import csv
import itertools
import math
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np

import films
from stiction.contact.indices import Groups, stiffness_group
from stiction.laws.joining import coordinates, states
from stiction.laws.segment import NormalSegment
from stiction.solvers.boundary_elements.area_estimates import map_slopes
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.sphere import respond
from stiction.solving.accuracy import film_tables
from stiction.solving.choice import Choice
from stiction.solving.inversion import separations_at
from stiction.solving.problem import problem_of
from stiction.surfaces.theory.moments import Moments, slope_over_sharpness

PLAIN, PAPER = "greenwood_williamson_1966", "soft_coating_2015"
# Film laws that answer elastically, with those options that change it.
LAWS = {
    ("layered", ""): Choice(PLAIN, film="layered"),
    ("sequential", ""): Choice(PLAIN, film="sequential"),
    ("graded", ""): Choice(PAPER, film="graded"),
    ("halling_1979", "modulus gao_chiu_lee_1992"): Choice(PLAIN, film="halling_1979"),
    ("halling_1979", "modulus perriot_barthel_2004"): Choice(
        PLAIN, film="halling_1979", options={"modulus": "perriot_barthel_2004"}
    ),
    ("halling_1979", "modulus bec_2006"): Choice(PLAIN, film="halling_1979", options={"modulus": "bec_2006"}),
    ("finkin_1969", "bound compressible"): Choice(PLAIN, film="finkin_1969"),
    ("finkin_1969", "bound incompressible"): Choice(PLAIN, film="finkin_1969", options={"bound": "incompressible"}),
    ("finkin_1969", "bound incompressible_frictionless"): Choice(
        PLAIN, film="finkin_1969", options={"bound": "incompressible_frictionless"}
    ),
    ("ogilvy_1993", ""): Choice(PLAIN, film="ogilvy_1993"),
}
DEPENDS_ON_RADIUS = {"sequential"}
MODULI = (0.005, 0.01, 0.03, 0.1, 0.2, 0.5, 0.8, 1.25, 2.0, 5.0, 10.0, 30.0, 100.0)
WIDTHS = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
RADII = (1e-3, 1e-2, 1e-1)  # thickness over radius
BY_MODULUS, BY_THICKNESS = (0.1, 0.32, 1.0, 3.2, 10.0), (0.15, 0.5, 1.5, 5.0)
MOST_AREA = 0.2
NU, THETA, ETA = 0.3, 1e16, 1e6  # hardly any adhesion, no yield


def groups(n: int, **given) -> Groups:
    """n contacts of bodies that hardly adhere and do not yield, with these groups."""
    lam = (ETA / math.sqrt(math.pi) / 18.0**0.25 * math.sqrt(THETA)) ** 4
    rest = {"theta": THETA, "lam": lam, "hardness_to_yield": 2.8, "n_H": 1.0, "n_g": 1.0, "shear_strength": 0.05,
            "tabor_parameter": 1.0}  # fmt: skip
    whole = {"nu": NU, "film_nu": NU, "coated_share": 1.0} | rest | given
    whole |= {"K_beta": stiffness_group(np.asarray(whole["nu"])), "film_K_beta": stiffness_group(np.asarray(whole["film_nu"]))}
    return Groups(**{name: np.broadcast_to(np.asarray(value, float), n).copy() for name, value in whole.items()}).resolved()


def asperity(choice: Choice, n_E: float, aspect: float, tau: float, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Load and area (n,) of one asperity at the displacements w (n,) over sigma."""
    given = groups(len(w), n_E=n_E, film_aspect=aspect, tau=tau, sharpness=0.01)
    load, area = np.zeros((2, len(w)))
    for regime in problem_of(given, choice).regimes:
        edges = np.broadcast_to(regime.edges, (len(w), regime.edges.shape[1]))
        parameters = tuple(np.broadcast_to(one, len(w)) for one in regime.parameters)
        for at in range(edges.shape[1] - 1):
            segment = NormalSegment(regime.along, regime.coordinate, parameters, edges[:, at : at + 2], regime.state)
            found = states(regime, coordinates(segment, w))
            there = (edges[:, at + 1] > edges[:, at]) & np.isclose(found[:, 0], w, rtol=1e-7, atol=0.0)
            load += np.where(there, found[:, 2], 0.0)
            area += np.where(there, found[:, 3], 0.0)
    return load, area


def on_a_sphere() -> Iterator[list]:
    """Rows of film_errors_on_a_sphere.csv."""
    for (key, options), choice in LAWS.items():
        for ratio in RADII if key in DEPENDS_ON_RADIUS else (RADII[0],):
            for n_E in MODULI:
                aspect = math.sqrt(ratio)  # sigma = t
                w = np.geomspace(1e-6, 1e5, 6000) * ratio
                load, area = asperity(choice, n_E, aspect, 1.0, w)
                for width in WIDTHS:
                    exact = respond((Layer.of(1.0, n_E, NU, NU),), width)
                    x = (width * aspect) ** 2
                    pressed, approach = n_E * exact.load * x**1.5, exact.approach * x
                    first = int(np.argmax(load >= pressed))
                    pair = slice(first - 1, first + 1)
                    there = float(np.interp(math.log(pressed), np.log(load[pair]), np.log(area[pair])))
                    felt = float(np.interp(approach, w, load))
                    radius = ratio if key in DEPENDS_ON_RADIUS else ""
                    yield [key, options, radius, n_E, width, math.exp(there) / x, felt / pressed]


def on_maps() -> Iterator[list]:
    """Rows of film_errors_on_maps.csv."""
    solved = read_films()
    solved = {name: column[np.isnan(solved["hardness"])] for name, column in solved.items()}
    density, given, load = as_groups(solved)
    choices = LAWS | {("rough_on_film", ""): Choice("rough_on_film", tangential="none")}
    for (key, options), choice in choices.items():
        problem = problem_of(given, choice)
        if problem.needs_load:
            area = problem.at_load(load[:, None])["contact_area"][:, 0]
        else:
            area = problem.at(np.nan_to_num(separations_at(problem, load[:, None], refuse=False).h))["contact_area"][:, 0]
        off = np.log(math.pi * density * area / solved["area"])
        asked = np.full(len(off), True) if problem.needs_load else solved["area"] <= MOST_AREA
        for (low, high), (thin, thick) in itertools.product(pairwise(BY_MODULUS), pairwise(BY_THICKNESS)):
            here = off[asked & _within(solved["modulus"], low, high) & _within(solved["thickness"], thin, thick)]
            yield [key, options, low, high, thin, thick, math.exp(here.mean()), float(np.sqrt(np.mean(here**2))), len(here)]


def _within(values: np.ndarray, low: float, high: float) -> np.ndarray:
    return (values >= low) & (values < high)


def read_films() -> dict[str, np.ndarray]:
    """The columns of films.csv; not a number where a hardness is none."""
    with films.FILE.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name] or math.nan) for row in rows]) for name in films.COLUMNS}


def as_groups(solved: dict[str, np.ndarray]) -> tuple[np.ndarray, Groups, np.ndarray]:
    """N R sigma (n,), the groups of the contacts, and the loads per asperity (n,)."""
    found = {seed: _asperities(*design, seed) for design, seed in _maps(solved)}
    density, unit, sharpness = np.array([found[int(seed)] for seed in solved["seed"]]).T
    thickness = solved["thickness"] / unit  # over sqrt(R sigma)
    given = groups(
        len(density), n_E=solved["modulus"], nu=solved["nu_below"], film_nu=solved["nu"], film_aspect=thickness,
        tau=thickness / sharpness, sharpness=sharpness, roughness_parameter=density,
    )  # fmt: skip
    load = solved["pressure"] * slope_over_sharpness(density) / (4.0 / 3.0 * density)
    return density, given, load


def _maps(solved) -> list[tuple[tuple[float, float, float], int]]:
    names = ("hurst", "rolloff", "longest", "seed")
    found = dict.fromkeys(zip(*(solved[name].tolist() for name in names), strict=True))
    return [((hurst, rolloff, longest), int(seed)) for hurst, rolloff, longest, seed in found]


def _asperities(hurst, rolloff, longest, seed) -> tuple[float, float, float]:
    """N R sigma, sqrt(R sigma) and sqrt(sigma/R) of the map."""
    one = films.surface(hurst, rolloff, longest, seed)
    slopes = map_slopes(one.heights, one.size)
    m0, m2 = float(one.heights.var()), 0.5 * slopes.gradient**2
    deviation, radius, number = Moments(m0, m2, slopes.alpha * m2**2 / m0).asperities()
    return number * radius * deviation, math.sqrt(radius * deviation), math.sqrt(deviation / radius)


def _write(path: Path, columns: tuple[str, ...], rows: Iterator[list]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([one if isinstance(one, str) else f"{one:.4g}" for one in row] for row in rows)


if __name__ == "__main__":
    _write(film_tables.ON_A_SPHERE, film_tables.SPHERE_COLUMNS, on_a_sphere())
    _write(film_tables.ON_MAPS, film_tables.MAP_COLUMNS, on_maps())
