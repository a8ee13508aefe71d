"""A sphere on a film, elastic: against another solution of other equations, closed forms, and itself where it must agree."""

import importlib
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from stiction.solvers.layered.compliance import Layer, compliance, modulus_without_film
from stiction.solvers.layered.curves import curves, curves_of_pairs
from stiction.solvers.layered.many_spheres import STIFFEST, respond_many
from stiction.solvers.layered.sphere import Response, respond
from tables import REFERENCE, column, read

ROWS = read("layered.csv")
FIELDS = Response._fields[:4]
LIMITS = [("soft", 0.02), ("like", 1.0), ("hard", 50.0)]


@pytest.fixture
def independent(monkeypatch):
    """The script that made the table."""
    monkeypatch.syspath_prepend(str(REFERENCE))
    return importlib.import_module("make_layered")


def pair_of(row):
    share, ratio, nu, nu_below = (float(row[name]) for name in ("share", "ratio", "nu", "nu_below"))
    return (Layer.of(share, ratio, nu, nu_below),)


def on_curves(pair, radius):
    """E_P, D, E_S and B at the radii (n,) from the curves, as their module writes them, by numpy's polynomials."""
    z = (np.sqrt(radius) - 1.0) / (np.sqrt(radius) + 1.0)
    logs, slopes = [], []
    for row, rise in zip(curves(pair), np.log(modulus_without_film(pair)) * np.array([1.0, 0.0, 1.0]), strict=True):
        whole = (
            np.polynomial.Polynomial([1.0, 0.0, -1.0]) * np.polynomial.Polynomial(row)
            + np.polynomial.Polynomial([0.5, 0.5]) * rise
        )
        logs.append(whole(z))
        slopes.append(whole.deriv()(z) * (1.0 - z * z) / 4.0)
    load, approach, edge = np.exp(logs)
    return np.array([load, approach, load * (1.0 + slopes[0] / 3.0) / (approach * (1.0 + slopes[1] / 2.0)), edge]).T


@pytest.mark.parametrize(("ratio", "nu", "nu_below"), [(0.1, 0.3, 0.2), (30.0, 0.1, 0.45), (0.0, 0.3, 0.3), (1.0, 0.2, 0.2)])
def test_compliance_of_a_wave(ratio, nu, nu_below, independent):
    """Against displacements and tractions that are continuous at the interface."""
    x = np.geomspace(0.01, 9.0, 20)
    expected = [independent.compliance(one, ratio, nu, nu_below) for one in x]
    assert_allclose(compliance(x, (Layer.of(1.0, ratio, nu, nu_below),)), expected, rtol=1e-12)


def test_exact_sphere():
    """Five materials at six radii, and 60 pairs of bodies at random, one of which may be elastic without a film."""
    found = np.array([respond(pair_of(row), float(row["radius"]))[:4] for row in ROWS])
    expected = np.stack([column(ROWS, name) for name in FIELDS], axis=1)
    assert_allclose(found[:, :3], expected[:, :3], rtol=1e-6)
    assert_allclose(found[:, 3], expected[:, 3], rtol=1e-5)  # of which the table is a difference


@pytest.mark.parametrize(("stiffest", "error"), [(100.0, 1e-8), (2000.0, 1e-4)])
def test_many_spheres_together_are_those_of_each(stiffest, error):
    """Single films and two, soft and stiff, over rigid bodies too; slopes by their own size or by 1."""
    rng = np.random.default_rng(7)
    ratios, nu, radii = stiffest ** rng.uniform(-1.5, 1.0, (12, 2)), rng.uniform(0.0, 0.5, (12, 2, 2)), [1e-5, 0.3, 20.0, 600.0]
    pairs = [tuple(Layer.of(0.5, *film) for film in zip(row, *one, strict=True)) for row, one in zip(ratios, nu, strict=True)]
    pairs[:4] = [
        (Layer.of(share, ratio, 0.2, 0.4),) for share, ratio in ((1.0, 0.0), (1.0, stiffest), (0.1, stiffest), (0.6, 0.3))
    ]
    found, expected = respond_many(pairs, radii), np.array([[respond(pair, radius) for radius in radii] for pair in pairs])
    assert_allclose(found[..., :4], expected[..., :4], rtol=error)
    assert_allclose(found[..., 4:], expected[..., 4:], rtol=error, atol=error)


def test_many_pairs_keep_their_order_and_stiff_ones_are_solved_alone():
    pairs = [(Layer.of(1.0, ratio, 0.3, 0.2),) for ratio in np.geomspace(0.1, 1e4, 70)]
    assert sum(pair[0].ratio > STIFFEST for pair in pairs) > 5
    found = curves_of_pairs(pairs)
    for place in (0, 30, 60, 69):
        assert_allclose(found[place], curves(pairs[place]), rtol=1e-3, atol=1e-5)


def test_curves():
    """The same cases from the curves: 0.2 %, and 0.5 % at the edge; dP/d delta = S is an identity of theirs."""
    found = np.array([on_curves(pair_of(row), float(row["radius"])) for row in ROWS])
    expected = np.stack([column(ROWS, name) for name in FIELDS], axis=1)
    assert_allclose(found[:, :3], expected[:, :3], rtol=2e-3)
    assert_allclose(found[:, 3], expected[:, 3], rtol=5e-3)


@pytest.mark.parametrize(("name", "ratio"), LIMITS)
def test_curves_far_out(name, ratio):
    """Very thin and very thick films against the exact sphere, and film and substrate alone at the ends."""
    pair = (Layer.of(1.0, ratio, 0.4, 0.2),)
    radius = np.array([0.01, 0.02, 200.0, 900.0])
    expected = np.array([respond(pair, one)[:4] for one in radius])
    assert_allclose(on_curves(pair, radius)[:, :3], expected[:, :3], rtol=2e-3)
    assert_allclose(on_curves(pair, radius)[:, 3], expected[:, 3], rtol=5e-3)
    assert_allclose(on_curves(pair, np.array([1e-12, 1e16])), [[1.0] * 4, [1 / ratio, 1.0, 1 / ratio, 1 / ratio]], rtol=1e-4)


@pytest.mark.parametrize("radius", [0.03, 0.7, 4.0, 25.0])
@pytest.mark.parametrize(("name", "ratio"), LIMITS)
def test_stiffness_is_the_slope_of_the_load(name, ratio, radius):
    """dP = S d delta and dS/da = 2 B, and the slopes that are returned, by differences of the radius."""
    pair, step = (Layer.of(0.8, ratio, 0.45, 0.1),), 1e-4
    here, wider, narrower = (Response(*respond(pair, radius * factor)) for factor in (1.0, 1.0 + step, 1.0 - step))
    width = radius * (1.0 + step), radius * (1.0 - step)
    load = 4.0 / 3.0 * (wider.load * width[0] ** 3 - narrower.load * width[1] ** 3)
    approach = wider.approach * width[0] ** 2 - narrower.approach * width[1] ** 2
    assert load == pytest.approx(2.0 * radius * here.stiffness * approach, rel=1e-6)
    stiffness = wider.stiffness * width[0] - narrower.stiffness * width[1]
    assert stiffness == pytest.approx(here.edge * (width[0] - width[1]), rel=1e-6)
    for name in ("load", "approach", "edge"):
        difference = math.log(getattr(wider, name) / getattr(narrower, name)) / (2.0 * step)
        assert getattr(here, f"{name}_slope") == pytest.approx(difference, abs=2e-6)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.49])
def test_a_film_of_the_bodys_material_is_none(nu):
    pair = (Layer.of(0.3, 1.0, nu, nu),)
    assert_allclose(respond(pair, 2.0), [1, 1, 1, 1, 0, 0, 0], atol=1e-14)
    assert_allclose(curves(pair), 0.0, atol=1e-12)


def test_thin_film_on_a_rigid_body():
    """Springs side by side, of the modulus M of uniaxial strain (Johnson 1985, section 5.8), except at an edge as wide as it:
    delta = a^2/(2R), P = pi M a^4/(4Rt)."""
    nu, radius = 0.3, 1000.0
    response = respond((Layer.of(1.0, 0.0, nu, nu),), radius)
    uniaxial = (1.0 - nu) ** 2 / (1.0 - 2.0 * nu)  # M over E/(1 - nu^2)
    assert response.approach == pytest.approx(0.5, rel=1e-3)
    assert response.load == pytest.approx(3.0 * math.pi / 16.0 * uniaxial * radius, rel=2e-3)


def test_bodies_may_be_swapped_and_films_halved():
    """Two like films on like bodies are each pressed against a rigid plane between them: half the compliance of one each."""
    first, second = Layer.of(0.5, 0.2, 0.4, 0.3), Layer.of(0.5, 3.0, 0.4, 0.1)
    assert_allclose(respond((first, second), 2.0), respond((second, first), 2.0), rtol=1e-12)
    assert_allclose(respond((first, first), 2.0), respond((Layer.of(1.0, 0.2, 0.4, 0.3),), 2.0), rtol=1e-12)


def test_a_sphere_is_a_sum_of_flat_punches():
    """As the contact grows by da, all of it sinks by d delta/da as a flat punch: load and approach are integrals of that."""
    pair, largest = (Layer.of(1.0, 0.3, 0.45, 0.1),), 2.0
    t, weight = np.polynomial.legendre.leggauss(40)
    radii = largest * (t + 1.0) / 2.0
    punches = [respond(pair, a) for a in radii]
    sinking = np.array([(2.0 + one.approach_slope) * one.approach * a for a, one in zip(radii, punches, strict=True)])
    whole = respond(pair, largest)
    assert weight @ sinking * largest / 2.0 == pytest.approx(whole.approach * largest**2, rel=1e-9)
    stiffness = np.array([2.0 * a * one.stiffness for a, one in zip(radii, punches, strict=True)])
    assert weight @ (stiffness * sinking) * largest / 2.0 == pytest.approx(4.0 / 3.0 * whole.load * largest**3, rel=1e-9)


@pytest.mark.parametrize("ratio", [0.1, 10.0])
def test_the_displaced_surface(ratio, independent):
    """The pressure of the table's method, as a sum of waves J_0(kr), makes the paraboloid where there is contact, and leaves a
    gap outside: nothing of Abel's transform is used."""
    from scipy.special import j0

    radius, nu, nu_below = 1.5, 0.3, 0.2
    _, approach, _, (s, w, g) = independent.solve(1.0, ratio, nu, nu_below, radius)
    t, weight = np.polynomial.legendre.leggauss(12)
    starts = np.arange(0.0, 60.0, 1.5)[:, None]
    k, weight = (starts + 0.75 * (t + 1.0)).ravel(), np.tile(0.75 * weight, starts.size)
    c = np.array([independent.compliance(min(one / radius, 30.0), ratio, nu, nu_below) for one in k])
    pressed = 2.0 / np.pi * c * (np.cos(np.outer(k, s)) @ (w * g)) * weight
    r = np.array([0.0, 0.3, 0.7, 0.95, 1.2, 1.5])
    surface = j0(np.outer(r, k)) @ pressed
    assert_allclose(surface[:4], approach - r[:4] ** 2 / 2.0, atol=1e-3)
    assert (surface[4:] > approach - r[4:] ** 2 / 2.0 + 0.01).all()
