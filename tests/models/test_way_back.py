"""Rough surfaces drawn apart: the largest tension on the way back and where nothing is carried, where they are hard to find,
and the grade of what is said. What one asperity does is in test_unloading_sums.py."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import minimize_scalar

import stiction as st
from stiction.engine.heights import height_distribution
from stiction.records.registry import AsperityLaw, of_kind
from tables import column, read


def unload(contact, min_separation, **more):
    return st.unload(contact, **{"asperity": "jkr", "min_separation": min_separation, "separation_increase": 0.0} | more)


@pytest.mark.parametrize("min_separation", (-4.9, -9.0))
@pytest.mark.parametrize("row", read("fuller_tabor_1975.csv")[3:], ids=lambda row: f"{row['inverse_delta_c']}")
def test_the_largest_tension_of_surfaces_pressed_deep(row, min_separation):
    """reference/pull_off.csv, of asperities on the branch of unloading: all that can still hold had touched. Where it is
    largest as little as 1e-6 of the contact area is left."""
    theta, largest, h = column([row], "theta")[0], column([row], "largest_tension")[0], column([row], "h")[0]
    found = unload(st.Indices(theta=theta, lam=1.0), min_separation)
    assert_allclose(found["pull_off_force"], largest * 1.5 * math.pi / theta, rtol=1e-9)
    assert_allclose(found["pull_off_separation"], h, atol=2e-6)


@pytest.mark.parametrize("min_separation", (-4.6, -4.9, -12.6))
def test_the_tension_of_hardly_any_area(min_separation):
    """At theta = 40 and 3.53 sigma, pressed deep, less than 1e-5 of the area is left. The load of what holds is the sum of
    Johnson, Kendall & Roberts' asperities from their fold on, P = u^6 - S u^3 at w = u^4 - 2 S u/3, S = sqrt(6 pi/theta)."""
    theta = 40.0
    S = math.sqrt(6.0 * math.pi / theta)
    fold = (S / 6.0) ** (1.0 / 3.0)
    t, weights = np.polynomial.legendre.leggauss(400)
    u = fold + (t + 1.0) / 2.0 * (1.8 - fold)
    w, slope, load = u**4 - 2.0 / 3.0 * S * u, 4.0 * u**3 - 2.0 / 3.0 * S, u**6 - S * u**3

    def carried(h):
        return float(
            np.sum(weights * (1.8 - fold) / 2.0 * load * slope * np.exp(-((h + w) ** 2) / 2.0)) / math.sqrt(2.0 * math.pi)
        )

    expected = minimize_scalar(lambda h: 1e6 * carried(h), bounds=(3.4, 3.7), options={"xatol": 1e-9})
    found = unload(st.Indices(theta=theta, lam=1.0), min_separation)
    assert_allclose(found["pull_off_force"], -1e-6 * expected.fun, rtol=1e-9)
    assert_allclose(found["pull_off_separation"], expected.x, atol=1e-6)


def one_far_above():
    """Of 2000 asperities one is 45 sigma above the others, which are nearly alike."""
    return height_distribution("empirical", samples=[0.0] * 1999 + [3.0], cells=400)


@pytest.mark.parametrize("theta", (10.0, 20.0))
def test_what_is_near_is_not_missed_where_the_way_is_long(theta):
    """All but one tear off within half of sigma, that one after 45 sigma, until when it presses."""
    contact, more = st.Indices(theta=theta, lam=1.0), {"heights": one_far_above()}
    distance = np.concatenate([np.linspace(0.0, 3.0, 1501), np.linspace(3.1, 50.0, 500)])
    loads = unload(contact, -0.2, separation_increase=distance, **more)["load"].values
    found = unload(contact, -0.2, **more)
    assert_allclose(found["pull_off_force"], -loads.min(), rtol=1e-4)
    assert_allclose(found["pull_off_separation"], -0.2 + distance[np.argmin(loads)], atol=4e-3)
    if loads[0] > 0.0:
        first = np.argmax(loads < 0.0)
        assert -0.2 + distance[first - 1] <= float(found["zero_load_separation"]) <= -0.2 + distance[first]


@pytest.mark.parametrize("min_separation", (3.0, 3.5, 4.0))
def test_what_was_never_pressed_has_no_turn(min_separation):
    """Where the surfaces only just met they pull from the first: the load does not fall to nothing, it never was any."""
    found = unload(st.Indices(theta=3.0, lam=1.0), min_separation)
    assert float(found["load"]) < 0.0 < float(found["pull_off_force"])
    assert np.isnan(float(found["zero_load_separation"]))
    both = unload(st.Indices(theta=3.0, lam=1.0), [-3.0, min_separation])["zero_load_separation"].values
    assert -3.0 < both[0] < min_separation and np.isnan(both[1])


# Asperity law -> its grade, and that of a plain sum of it on the way back.
GRADES = {"jkr": ("A", "B"), "thornton_ning_1998": ("B", "B"), "brizmer_kligerman_etsion_2006": ("C", "C")}


@pytest.mark.parametrize("asperity", GRADES)
def test_the_grade_is_the_worst_of_all_that_answers(asperity):
    """That of the law, of the sum (B) and of how it is drawn apart, which is derived here (B)."""
    own, expected = GRADES[asperity]
    contact = st.Indices(theta=40.0, lam=10.0)
    assert of_kind(AsperityLaw)[asperity].grade == own
    assert unload(contact, 0.0, asperity=asperity).attrs["grade"] == expected
    laws = {"model": "greenwood_williamson_1966", "tangential": "none"}
    assert st.solve(contact, separation=0.0, asperity=asperity, **laws).attrs["grade"] == expected
