"""Many separations of a few laws are summed from series: against closed forms, and against single sums."""

import numpy as np
import pytest
from scipy.special import ndtr

import stiction as st
from stiction.engine import summation
from stiction.engine.expansions import STEP, series_for
from stiction.engine.summation import scattered
from stiction.solving.choice import Choice
from stiction.solving.problem import make_problem

H = np.random.default_rng(3).uniform(-8.0, 9.9, 2000)
# theta from strong adhesion to hardly any; with a film that is pressed through
CONTACTS = (
    {"theta": 0.01, "lam": 1.0},
    {"theta": 40.0, "lam": 10.0},
    {"theta": 1e4, "lam": 0.1},
    {"theta": 40.0, "lam": 10.0, "n_E": 1.5, "n_H": 0.5, "tau": 2.0},
)


def test_hertz_spheres_against_the_closed_form():
    """Area and number of Hertz spheres under Gaussian heights: phi(h) - h Q(h) and Q(h)."""
    problem = make_problem(st.Indices(theta=1.0, lam=1.0), Choice("greenwood_williamson_1966", tangential="none"))
    touching, _, area, _, _ = scattered(problem.regimes, H, problem.heights, np.zeros(H.size, int)).sum(axis=0).T
    assert series_for(H, np.zeros(H.size, int)) is not None
    near = H < 5.0  # beyond, the closed form loses its digits
    density = np.exp(-0.5 * H * H) / np.sqrt(2.0 * np.pi)
    np.testing.assert_allclose(touching, ndtr(-H), rtol=1e-11)
    np.testing.assert_allclose(area[near], (density - H * ndtr(-H))[near], rtol=1e-10)


@pytest.mark.parametrize("groups", CONTACTS)
def test_series_give_what_single_sums_give(groups, monkeypatch):
    problem = make_problem(st.Indices(**groups), Choice())
    law = np.zeros(H.size, int)
    together = scattered(problem.regimes, H, problem.heights, law)
    monkeypatch.setattr(summation, "series_for", lambda h, law: None)
    alone = scattered(problem.regimes, H, problem.heights, law)
    largest = np.abs(alone).max(axis=0) + 1e-300
    assert alone.any() and np.max(np.abs(together - alone) / largest) < 5e-13


def test_series_of_several_laws_are_not_confused():
    contacts = st.Indices(theta=st.axis("theta", [1.0, 1e3]), lam=10.0)
    problem = make_problem(contacts, Choice())
    law = np.arange(H.size) % 2
    together = scattered(problem.regimes, H, problem.heights, law)
    for one in (0, 1):
        some = np.flatnonzero(law == one)[:50]
        np.testing.assert_allclose(
            together[:, some], scattered(problem.regimes, H[some], problem.heights, law[some]), rtol=1e-9
        )


def test_each_separation_has_a_series_within_half_a_step():
    about, laws, number = series_for(H, np.arange(H.size) % 2)
    assert np.abs(H - about[number]).max() <= STEP / 2
    assert (laws[number] == np.arange(H.size) % 2).all()


@pytest.mark.parametrize("h", [H[:900], np.append(H, 11.0), np.append(H, -1e5)], ids=["few", "far", "deep"])
def test_other_separations_are_summed_one_by_one(h):
    assert series_for(h, np.zeros(h.size, int)) is None
