"""Adhesive asperities on a film that peel or yield, whichever comes first: at the trailing edge, and anywhere."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from stiction.engine import summation
from stiction.engine.heights import gaussian
from stiction.engine.summation import scattered
from stiction.laws.film.layered import elastic
from stiction.laws.joining import Law, states
from stiction.laws.tangential.shared.hamilton_field import von_mises
from stiction.records.registry import AsperityLaw, TangentialLaw, find, resolve_options
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.stresses import Stresses, cartesian
from stiction.solvers.layered.waves import CoatedBody
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import groups

PLAIN = "greenwood_williamson_1966"
FILM = {"n_E": 1.0, "n_H": 1.0, "tau": 1.0, "film_aspect": 1.0}
EDGE = "soft_coating_2015"


def law_of(tangential, **options):
    law = find("jkr", AsperityLaw)
    return Law(law, find(tangential, TangentialLaw), resolve_options([law], options))


def on_film(tangential, given, **options):
    """The elastic segment of the film law with a tangential law."""
    law = law_of(tangential, **options)
    return law.join(elastic(given.resolved(), law), given, body="film")


def both(regime, u):
    """Slip- and yield-limited force at the coordinate u of one asperity, and its load and area."""
    _, _, load, area, slip, torn = states(regime, np.array([u]))[0]
    return slip, torn, load, area


def sums(given, tangential, asperity, film="layered", h=(2.0, 1.0, 0.0, -1.0)):
    return problem_of(given, Choice(PLAIN, asperity, tangential, film)).on_grid(np.array(h))["friction_force"]


@pytest.mark.parametrize(("key", "within"), [(EDGE, 1e-5)])
@pytest.mark.parametrize("asperity", ["jkr", "roy_chowdhury_ghosh_1994"])
def test_ends(key, within, asperity):
    """No film, one of the body's own material, and one without end, in its own groups times n_E: the law of half-spaces."""
    rng, n = np.random.default_rng(5), 6
    given = {"theta": 10.0 ** rng.uniform(0, 3, n), "lam": 10.0 ** rng.uniform(1, 4, n), "nu": 0.25, "n_E": 6.0, "n_H": 1.5,
             "tau": 1.0}  # fmt: skip
    like = {"n_E": 1.0, "n_H": 1.0, "film_aspect": 10.0 ** rng.uniform(-2, 2, n), "film_nu": 0.25, "layer_nu": 0.25}
    thick = {"tau": 1e9, "film_aspect": 1e9, "film_nu": 0.4, "layer_nu": 0.4, "film_K_beta": 8 / 3 * 1.6 / 0.6}
    none, like, thick = (groups(**given | more) for more in ({"tau": 0.0, "film_aspect": 0.0}, like, thick))
    for one, half_space, unit in ((none, none.substrate(), 1.0), (like, like.substrate(), 1.0), (thick, thick.film(), 6.0)):
        expected = unit * sums(half_space, key, asperity, None)
        assert (expected > 0.0).all()
        assert_allclose(sums(one, key, asperity), expected, rtol=within)


CASES = [(0.1, 0.3, 0.4, 2.0), (0.1, 3.0, 0.02, 1.0), (6.0, 1.0, 1.0, 1.0), (30.0, 10.0, 0.3, 4.0)]


@pytest.mark.parametrize(("n_E", "n_H", "aspect", "theta"), CASES)
def test_yield_at_the_trailing_edge_of_one_asperity(n_E, n_H, aspect, theta):
    """What never peels holds until the von Mises stress at the trailing edge, solved at this very radius for the mean pressure
    that is there, tension or not, is the film's yield stress."""
    eta, k, nu = 4.0, 2.8, 0.3
    given = groups(
        theta=theta, **FILM | {"n_E": n_E, "n_H": n_H, "film_aspect": aspect}, nu=nu, hardness_to_yield=k, peeling=0.0
    )
    given = given.with_changes(hardness_group=np.array([eta]))
    regime = on_film(EDGE, given)
    held = 0
    for u in regime.edges[0, 0] * np.array([1.0, 1.05, 1.3, 1.8, 3.0]):
        slip, torn, load, area = both(regime, u)
        assert slip == 0.0
        if torn == 0.0:
            continue
        held += 1
        whole = Stresses((Layer.of(1.0, n_E, nu, nu),), CoatedBody(n_E, nu, nu), math.sqrt(area) / aspect)
        mean, traction = (k * one / (eta * area) for one in (load, torn))  # over the body's yield stress
        six = cartesian(whole.in_film(np.array([1.0]), np.array([0.0])), np.array([math.pi]), traction / mean)
        assert abs(mean) * float(von_mises(tuple(one[0, 0] for one in six))) == pytest.approx(n_H, rel=5e-3)
    assert held >= 2


@pytest.mark.parametrize("key", [EDGE])
def test_the_lesser_of_both(key):
    """Beside `layered_peeling`, and what never peels: whichever is less, in its own part; kinks where they cross."""
    rng, n = np.random.default_rng(2), 40
    given = {"theta": 10.0 ** rng.uniform(0, 3, n), "lam": 10.0 ** rng.uniform(-1, 4, n),
             "n_E": np.array([0.2, 1.0, 6.0, 6.0] * 10), "n_H": 10.0 ** rng.uniform(-0.5, 0.7, n),
             "film_aspect": 10.0 ** rng.uniform(-1, 1, n), "tau": 1.0}  # fmt: skip
    peeling, whole = (on_film(one, groups(**given, peeling=0.4)) for one in ("layered_peeling", key))
    yielding = on_film(key, groups(**given, peeling=0.0))
    crossed = 0
    for share in np.geomspace(1.0, 40.0, 60):
        u = share * whole.edges[:, 0]
        slip, torn = states(peeling, u)[:, 4], states(yielding, u)[:, 5]
        found = states(whole, u)[:, 4:]
        assert_allclose(found.sum(axis=1), np.minimum(slip, torn), rtol=1e-9, atol=1e-12)
        assert ((found[:, 0] == 0.0) | (found[:, 1] == 0.0)).all()
    for i, edges in enumerate(whole.edges):
        inside = edges[(edges > edges[0]) & (edges < 1e3 * edges[0])]
        for at in inside:
            u = np.full(n, at)
            slip, torn = states(peeling, u)[i, 4], states(yielding, u)[i, 5]
            crossed += abs(slip - torn) < 1e-6 * (slip + torn)
    assert crossed > n / 3


def test_two_coated_bodies():
    """Alike, they are one against a rigid plane between them; unlike ones may be swapped."""
    two = {"films": 2.0, "coated_share": 0.5, "coated_nu": 0.3, "counter_nu": 0.3, "layer_nu": 0.3}
    for key in (EDGE,):
        one = groups(theta=20.0, lam=50.0, **FILM | {"n_E": 4.0, "film_aspect": 0.5})
        pair = groups(theta=20.0, lam=50.0, **FILM | {"n_E": 4.0, "film_aspect": 1.0}, **two)
        assert_allclose(sums(pair, key, "jkr"), sums(one, key, "jkr"), rtol=1e-9)
        unlike = groups(theta=20.0, lam=50.0, **FILM | {"n_E": 4.0}, **two | {"coated_share": 0.3, "counter_nu": 0.2})
        swapped = groups(theta=20.0, lam=50.0, **FILM | {"n_E": 4.0}, **two | {"coated_share": 0.7, "coated_nu": 0.2})
        assert_allclose(sums(unlike, key, "jkr"), sums(swapped.with_changes(nu=unlike.nu), key, "jkr"), rtol=1e-9)


def test_drawn_apart():
    """A contact that is drawn apart holds by what is left of it, and never more than it peels at."""
    given = groups(theta=3.0, **FILM | {"n_E": 0.2})
    peels, whole = (on_film(one, given, branch="unloading") for one in ("layered_peeling", EDGE))
    u = np.linspace(whole.edges[0, 0], 3.0, 300)
    found, slip = (np.array([states(one, np.array([at]))[0, 4:].sum() for at in u]) for one in (whole, peels))
    assert (found <= slip + 1e-12).all() and found.max() > 0.0


@pytest.mark.parametrize("key", [EDGE])
def test_sums_converge(key, monkeypatch):
    """The engine's nodes against 160, to what the records say."""
    rng, n = np.random.default_rng(11), 120
    given = groups(
        theta=10.0 ** rng.uniform(0, 3, n), lam=10.0 ** rng.uniform(0, 4, n),
        n_E=np.array([0.1, 2.0, 8.0])[rng.integers(0, 3, n)], n_H=10.0 ** rng.uniform(-0.5, 0.7, n),
        tau=rng.uniform(0.1, 3.0, n), film_aspect=10.0 ** rng.uniform(-2, 1, n),
        peeling=rng.uniform(0.1, 1.0, n),
    )  # fmt: skip
    h = rng.uniform(-3.0, 4.0, n)
    found = problem_of(given, Choice(PLAIN, "jkr", key, "layered"))
    shipped = scattered(found.regimes, h, gaussian()).sum(axis=0)
    monkeypatch.setattr(summation, "_COUNTS", np.array([160, 160]))
    monkeypatch.setattr(summation, "_RULES", summation._make_rules(np.array([160, 160])))
    best = scattered(found.regimes, h, gaussian()).sum(axis=0)
    assert_allclose(shipped[:, 3:].sum(axis=1), best[:, 3:].sum(axis=1), rtol=1e-6)
