"""Sums of the graded film against the equations of docs/theory.md, 5.3, written out a second time: reference/graded.csv,
in which nothing of the package takes part."""

import numpy as np
import pytest

from stiction.engine import heights, summation
from stiction.laws.film import graded
from tables import column, groups, read

ROWS = read("graded.csv")


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row['name']}-{row['h']}")
def test_sums(row):
    names = ("theta", "lam", "nu", "film_nu", "k", "film_k", "n_E", "n_H", "tau", "film_aspect", "n_g")
    theta, lam, nu_s, nu_c, k_s, k_c, n_E, n_H, tau, aspect, n_g = (column([row], name) for name in names)
    bodies = [(theta, lam, nu_s, k_s), (theta * n_E / n_g, lam * n_H**4 / (n_E * n_g) ** 2, nu_c, k_c)]
    substrate, film = (groups(*body) for body in bodies)
    regimes = graded.graded_regimes(substrate, film, n_E, n_H, tau, aspect, n_g)
    found = summation.scattered(regimes, column([row], "h"), heights.gaussian()).sum(axis=0)[0]
    load, area, resistance = (float(row[name]) for name in ("load", "area", "friction"))
    # The trapezoidal sums are good to some parts in 10^7 where the resistance jumps, and of the
    # load to some in 10^8, where a plateau has its ends.
    assert abs(found[1] - load) <= 1e-7 * (abs(load) + area)
    np.testing.assert_allclose(found[2], area, rtol=1e-9)
    np.testing.assert_allclose(found[3] + found[4], resistance, rtol=2e-6)
