"""What the tests of the physics share: variant reference tables, groups from plain numbers, and comparing."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_less

from stiction.contact.indices import Groups

REFERENCE = Path(__file__).parents[1] / "reference"
SHARED = Path(__file__).parents[2] / "shared" / "reference"

GROUP_COLUMNS = {"theta": "theta", "lam": "lambda", "nu": "nu", "hardness_to_yield": "H_over_Y"}
FILM_COLUMNS = {"n_E": "n_E", "n_H": "n_H", "tau": "t"}


def read(name: str) -> list[dict[str, str]]:
    """Rows of a table in reference, or of one that is handed out beside the repository (else the test is skipped)."""
    path = REFERENCE / name
    if not path.exists():
        path = SHARED / name
    if not path.exists():
        pytest.skip(f"{name} is not beside this repository")
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def column(rows: list[dict[str, str]], name: str) -> np.ndarray:
    """One column as floats; NaN where the table has nothing."""
    return np.array([float(row[name] or math.nan) for row in rows])


def film_of(rows: list[dict[str, str]]) -> dict[str, np.ndarray]:
    """The film's columns, or nothing where the rows are of bare surfaces."""
    return {name: column(rows, title) for name, title in FILM_COLUMNS.items()} if rows[0]["n_E"] else {}


def groups_of(rows: list[dict[str, str]]) -> Groups:
    return groups(**{name: column(rows, title) for name, title in GROUP_COLUMNS.items()}, **film_of(rows))


def columns_of_groups(rows: list[dict[str, str]]) -> dict[str, np.ndarray]:
    """Every column of a table that is a group, under its name or the letter of `GROUP_COLUMNS` and `FILM_COLUMNS`."""
    titles = {title: name for name, title in (GROUP_COLUMNS | FILM_COLUMNS).items()}
    known = set(Groups.model_fields)
    if derived := [title for title in rows[0] if isinstance(getattr(Groups, title, None), property)]:
        raise ValueError(
            f"column {derived[0]}: laws do not read it from a table; give the group it follows from (eta: hardness_group)"
        )
    named = {titles.get(title, title): title for title in rows[0]}
    return {name: column(rows, title) for name, title in named.items() if name in known}


FILM_GROUPS = ("n_E", "n_H", "tau", "n_g", "film_aspect", "film_nu", "film_K_beta", "film_friction_constant")


def groups(theta=1.0, lam=1.0, nu=0.3, hardness_to_yield=2.8, **others) -> Groups:
    """Groups of arrays or numbers. K beta is that of bodies alike: (8/3)(2 - nu)/(1 - nu), docs/theory.md."""
    nu = np.asarray(nu, dtype=float)
    given = {"theta": theta, "lam": lam, "nu": nu, "hardness_to_yield": hardness_to_yield}
    given["K_beta"] = 8 / 3 * (2 - nu) / (1 - nu)
    if not others.keys().isdisjoint(FILM_GROUPS):
        others = {"n_g": 1.0, "film_aspect": np.inf, "film_nu": nu, "film_K_beta": given["K_beta"]} | others
    whole = given | others
    arrays = np.broadcast_arrays(*(np.atleast_1d(np.asarray(value, dtype=float)) for value in whole.values()))
    return Groups(**dict(zip(whole, map(np.ascontiguousarray, arrays), strict=True)))


def without_adhesion(given: Groups) -> Groups:
    """The same groups where nothing adheres: the hardness group stands for theta and lambda."""
    return given.with_changes(theta=None, lam=None, hardness_group=given.eta, n_g=1.0, tabor_parameter=None)


def assert_near(found, expected, within: float, size=None, what: str = ""):
    """|found - expected| <= within * size, size being |expected| unless given; below 1e-290 doubles lose digits: absolutely."""
    size = np.abs(expected) if size is None else size
    assert np.all(np.isfinite(found)), f"{what}: not finite"
    assert_array_less(np.abs(found - expected), within * np.asarray(size) + 1e-290, err_msg=what)


def random_groups(rng: np.random.Generator, n: int, coated: bool) -> dict[str, np.ndarray]:
    """Groups over the whole range for which the package is made; thickness as often below 8 sigma as above."""

    def decades(low, high):
        return 10.0 ** rng.uniform(low, high, n)

    drawn = {
        "theta": decades(-3, 8),
        "lam": decades(-6, 8),
        "nu": rng.uniform(0.0, 0.499, n),
        "hardness_to_yield": rng.uniform(1.5, 4.0, n),
    }
    if coated:
        thickness = np.where(rng.random(n) < 0.5, rng.uniform(0.0, 8.0, n), decades(0, 3))
        drawn |= {"n_E": decades(-2, 2), "n_H": decades(-2, 2), "tau": thickness}
    return drawn


def random_others(rng: np.random.Generator, n: int) -> dict[str, np.ndarray]:
    """The groups that only some laws need, over the range in which they have a meaning."""

    def decades(low, high):
        return 10.0 ** rng.uniform(low, high, n)

    return {
        "tabor_parameter": decades(-2, 2),
        "sharpness": decades(-3, -0.5),
        "roughness_parameter": decades(-1.3, 0),
        "nominal_width": decades(2, 6),
        "shear_strength": decades(-4, -0.9),  # weaker than any bulk here, H/(sqrt(3) k): some laws refuse what is not
        "pressure_coefficient": decades(-3, -0.5),
        "peeling": decades(-2, 0),
        "hardening": decades(-4, -0.3),
        "size_over_burgers": decades(1, 6),
    }


def load_size(load, area, theta, theta_film=None, n_E=1.0):
    """At least the integral of |load|: a JKR contact pulls with (3/2) pi/theta at most and has x >= 4.125 theta^(-2/3), so that
    sum |P| <= |sum P| + 2 (1.5 pi / 4.125) theta^(-1/3) sum x."""
    pull = theta ** (-1 / 3) if theta_film is None else np.maximum(theta ** (-1 / 3), n_E * theta_film ** (-1 / 3))
    return np.abs(load) + 3 * math.pi / 4.12489 * pull * area
