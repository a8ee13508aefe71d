"""Groups out of all range are refused where they are given, before sums silently lose all of their size."""

import math

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES

FILM = {"theta": 40.0, "lam": 10.0, "n_E": 1.0, "n_H": 1.0, "tau": 1.0}


@pytest.mark.parametrize(
    "given",
    [
        {"theta": 1e-60},
        {"theta": 1e-150},
        {"theta": 1e-250},
        {"theta": 1e300},
        {"lam": 1e-200},
        {"lam": 1e200},
        {"n_E": 1e308},
        {"n_E": 1e-308},
        {"n_H": 1e308},
        {"tau": 1e308},
    ],
    ids=str,
)
def test_groups_out_of_range_are_refused_with_their_bounds(given):
    ((name, value),) = given.items()
    bounds = QUANTITIES[name]
    for ask in (lambda: st.Indices(**FILM | given), lambda: st.evaluate(0.0, **FILM | given)):
        with pytest.raises(InputError) as caught:
            ask()
        assert (caught.value.field, caught.value.value, caught.value.allowed) == (name, value, bounds.allowed)


@pytest.mark.parametrize(
    "given, field", [({"theta": 1e-10, "n_E": 1e-6}, "n_E"), ({"n_E": 1e-9, "n_H": 1e9, "lam": 1e100}, "n_H")]
)
def test_a_film_alone_is_within_the_same_bounds(given, field):
    """As a half-space it has theta n_E and lambda (n_H^2/n_E)^2: the product counts, not the ratio."""
    for ask in (lambda: st.Indices(**FILM | given), lambda: st.evaluate(0.0, **FILM | given)):
        with refusal(field, ">= 1e-12" if field == "n_E" else ">= 1e-60"):
            ask()


@pytest.mark.parametrize("name", ["theta", "lam"])
def test_a_film_alone_may_be_at_a_bound(name):
    """As those of the bodies may be: a film like its substrate has the same groups."""
    for end in (QUANTITIES[name].lower, QUANTITIES[name].upper):
        assert getattr(st.Indices(**FILM | {name: end}), name) == end


@pytest.mark.parametrize("theta", [1e-8, 1e-6, 1e10, QUANTITIES["theta"].upper])
def test_within_the_bounds_nothing_is_lost(theta):
    """Far from touch the one and the other end are known: JKR's pull-off force under strong adhesion, Hertz without."""
    found = st.solve(st.Indices(theta=theta, lam=1e30), load=1.0, model="fuller_tabor_1975")
    if theta < 1.0:
        assert found["pull_off_force"].item() == pytest.approx(1.5 * np.pi / theta, rel=1e-3)
    else:
        assert found["pull_off_force"].item() == 0.0 and found["contact_area"].item() > 0.0


def test_a_film_without_thickness_is_infinitely_stiff_without_a_word():
    given = st.Indices(theta=1e3, lam=100.0, n_E=0.2, n_H=0.2, tau=0.0, film_aspect=0.0)
    assert given.film_stiffness == math.inf
    assert np.isfinite(st.solve(given, separation=1.0, film="layered")["load"])
