"""Film and substrate that shear in series, film_shear="in_series" of the sequential film: against the asperity of the 2015
paper written out in reference/paper_equations.py (mpmath; nothing of the package), the weaker taken at every
displacement."""

import itertools
import sys

import numpy as np
import pytest
from mpmath import mpf
from scipy.integrate import quad

import stiction as st
from tables import REFERENCE

sys.path.insert(0, str(REFERENCE))
from paper_equations import Law, film_law

THETA, LAM, NU, K, H = 100.0, 1e3, 0.3, 2.8, 1.0


def resistance(law, w):
    """Tangential force of one asperity at a displacement, in doubles."""
    return float(law.at(mpf(w))[1])


def by_hand(n_E, n_H, tau):
    """Film alone before tau, the weaker of film and substrate beyond; over Gaussian heights, between the kinks."""
    substrate = Law(mpf(THETA), mpf(LAM), mpf(NU), mpf(K))
    film = film_law(substrate, mpf(n_E), mpf(n_H))

    def one(w):
        of_film = n_E * resistance(film, w)
        return of_film if w < tau else min(of_film, resistance(substrate, w - tau))

    def weighed(w):
        return one(w) * np.exp(-((H + w) ** 2) / 2) / np.sqrt(2 * np.pi)

    grid = np.linspace(0.0, 6.0, 121)
    gap = [n_E * resistance(film, w) - (resistance(substrate, w - tau) if w >= tau else 0.0) for w in grid]
    turns = [grid[i] for i in range(120) if (gap[i] > 0) != (gap[i + 1] > 0)]
    ends = sorted({0.0, 6.0, tau, float(film.w1), float(substrate.w1) + tau, *turns})
    pieces = [(a, b) for a, b in itertools.pairwise(ends) if b <= 6.0]
    return sum(quad(weighed, a, b, limit=60, epsrel=1e-5, epsabs=1e-12)[0] for a, b in pieces)


@pytest.mark.parametrize(("n_E", "n_H", "tau"), [(3.0, 4.0, 0.3), (1.0, 1.0, 0.5), (0.3, 0.3, 0.4)])
def test_the_weaker_governs(n_E, n_H, tau):
    given = st.Indices(theta=THETA, lam=LAM, nu=NU, hardness_to_yield=K, n_E=n_E, n_H=n_H, tau=tau)
    found = st.solve(given, separation=H, film_shear="in_series")
    assert float(found["friction_force"]) == pytest.approx(by_hand(n_E, n_H, tau), rel=2e-6)
    added = st.solve(given, separation=H)
    for name in ("load", "contact_area", "touching_asperities"):
        assert float(found[name]) == float(added[name])
    assert float(found["friction_force"]) < 0.9 * float(added["friction_force"])
    assert added.attrs["film_shear"] == "added" and found.attrs["film_shear"] == "in_series"


def test_limits():
    """A strong film without thickness leaves the substrate alone, a weak one governs; without end the film is alone."""
    h = [0.0, 1.0, 2.0]
    bare = st.solve(st.Indices(theta=THETA, lam=LAM), separation=h)["friction_force"]

    def friction(n_E, n_H, tau):
        film = st.Indices(theta=THETA, lam=LAM, n_E=n_E, n_H=n_H, tau=tau)
        return st.solve(film, separation=h, film_shear="in_series")["friction_force"].values

    def alone(n_E, n_H):
        own = st.Indices(theta=THETA * n_E, lam=LAM * n_H**4 / n_E**2)
        return n_E * st.solve(own, separation=h)["friction_force"].values

    np.testing.assert_allclose(friction(3.0, 4.0, 1e-12), bare, rtol=1e-8)
    np.testing.assert_allclose(friction(1.0, 1.0, 1e-12), bare, rtol=1e-8)
    weak, film = friction(0.3, 0.3, 1e-12), alone(0.3, 0.3)
    np.testing.assert_allclose(weak, film, rtol=1e-6)
    assert np.all(weak <= film * (1 + 1e-12))
    for n_E, n_H in ((3.0, 4.0), (0.3, 0.3)):
        np.testing.assert_allclose(friction(n_E, n_H, 100.0), alone(n_E, n_H), rtol=1e-9)


def test_a_law_of_the_interface_has_nothing_to_add():
    given = st.Indices(theta=THETA, lam=LAM, n_E=0.5, n_H=0.5, tau=0.3, shear_strength=0.1)
    both = [
        st.solve(given, separation=H, tangential="bowden_tabor_1943", film="sequential", film_shear=shear)["friction_force"]
        for shear in ("added", "in_series")
    ]
    assert float(both[0]) == float(both[1])
