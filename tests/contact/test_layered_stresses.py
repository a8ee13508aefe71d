"""Stresses in a film and its body: Hamilton's for like materials, tabulated plane waves, equilibrium, and what goes on at the
interface."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import special

from stiction.laws.tangential.shared.hamilton_field import stress
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.sphere import pressure, value_of
from stiction.solvers.layered.stresses import Stresses, _bessel, cartesian
from stiction.solvers.layered.waves import CoatedBody
from tables import read

COMPONENTS = ("x", "y", "z", "xy", "yz", "xz")
RADII = [0.02, 0.3, 1.0, 5.0, 30.0, 100.0]


def under_rigid_sphere(ratio, nu, nu_below, radius):
    return Stresses((Layer.of(1.0, ratio, nu, nu_below),), CoatedBody(ratio, nu, nu_below), radius)


def random_bodies(count):
    rng = np.random.default_rng(71)
    for _ in range(count):
        yield 10.0 ** rng.uniform(-2.0, 2.0), *rng.uniform(0.0, 0.5, 2), 10.0 ** rng.uniform(-1.0, 1.5)


@pytest.mark.parametrize("radius", RADII)
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_like_materials_have_hamiltons_stresses(radius, nu):
    """In the film, on its surface and at the edge of the contact, and below, beside the plane of symmetry too."""
    whole, traction = under_rigid_sphere(1.0, nu, nu, radius), 0.7
    r = np.array([0.0, 0.1, 0.3, 0.7, 0.95, 0.999, 1.0, 1.001, 1.1, 1.5, 2.0])
    theta = np.linspace(0.0, 6.0, r.size)
    for part, depths in ((whole.in_film, [0.0, 0.01, 0.2, 0.5, 0.9, 1.0]), (whole.in_body, [1.0, 1.2, 2.0, 5.0])):
        z = np.array(depths) * whole.thickness
        found = cartesian(part(r, z), theta, traction)
        expected = stress(r * np.cos(theta), r * np.sin(theta), z[:, None], traction, nu)
        for one, other in zip(found, expected, strict=True):
            assert_allclose(one, 1.5 * other, atol=2e-8)  # p0 is 3/2 of the mean pressure


def test_tabulated_stresses():
    """Sums of plane waves over all directions, each solved by itself."""
    rows = read("layered_stresses.csv")
    assert len(rows) == 40
    for row in rows:
        value = {name: float(text) for name, text in row.items()}
        whole = under_rigid_sphere(value["ratio"], value["nu"], value["nu_below"], value["radius"])
        part = whole.in_body if value["below"] else whole.in_film
        radial = part(np.array([value["r"]]), np.array([value["z"]]))
        theta = np.array([value["theta"]])
        pressed, both = cartesian(radial, theta, 0.0), cartesian(radial, theta, 1.0)
        assert_allclose(np.ravel(pressed), [value[f"p_{name}"] for name in COMPONENTS], atol=2e-8)
        assert_allclose(np.ravel(both) - np.ravel(pressed), [value[f"q_{name}"] for name in COMPONENTS], atol=2e-8)


@pytest.mark.parametrize("bodies", list(random_bodies(12)), ids=lambda one: f"{one[0]:.2g}-{one[3]:.2g}")
def test_tractions_and_stretch_go_on_through_the_interface(bodies):
    ratio, nu, nu_below, _ = bodies
    whole = under_rigid_sphere(*bodies)
    r, at = np.linspace(0.0, 2.0, 41), np.array([whole.thickness])
    film, body = whole.in_film(r, at), whole.in_body(r, at)
    stiffer = ratio * (1.0 - nu**2) / (1.0 - nu_below**2)  # Young's moduli
    for above, below in ((film.pressed, body.pressed), (film.dragged[:4], body.dragged[:4])):
        (rr, tt, zz, rz), (rr_below, tt_below, zz_below, rz_below) = above, below
        assert_allclose(zz, zz_below, atol=1e-8)
        assert_allclose(rz, rz_below, atol=1e-8)
        size = 1e-8 * max(1.0, stiffer)
        assert_allclose(rr - nu * (tt + zz), stiffer * (rr_below - nu_below * (tt_below + zz)), atol=size)
        assert_allclose(tt - nu * (rr + zz), stiffer * (tt_below - nu_below * (rr_below + zz)), atol=size)
    assert_allclose(film.dragged[5], body.dragged[5], atol=1e-8)
    assert_allclose(film.dragged[4], stiffer * (1.0 + nu_below) / (1.0 + nu) * body.dragged[4], atol=1e-8 * max(1.0, stiffer))


@pytest.mark.parametrize("bodies", list(random_bodies(6)), ids=lambda one: f"{one[0]:.2g}-{one[3]:.2g}")
def test_equilibrium(bodies):
    """Divergence of the stresses by differences of sixth order in r and z, in film and body: nothing, to 1e-8 of their size."""
    whole = under_rigid_sphere(*bodies)
    t, weights = whole.thickness, np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0
    for part, depth, scale in ((whole.in_film, 0.5 * t, t), (whole.in_body, 1.7 * t, 1.7 * t)):
        for place in (0.4, 0.8, 1.3):
            h = 0.012 * min(scale, 0.5)
            r, z = place + h * np.arange(-3, 4), depth + h * np.arange(-3, 4)
            pressed, dragged = (np.array(one) for one in part(r, z))
            by_r, by_z = (lambda f, h=h: f[3] @ weights / h), (lambda f, h=h: weights @ f[:, 3] / h)
            rr, tt, zz, rz = pressed
            size = 1e-8 * max(1.0, np.abs(pressed).max()) / min(scale, 0.5)
            assert by_r(rr) + by_z(rz) + (rr - tt)[3, 3] / place == pytest.approx(0.0, abs=size)
            assert by_r(rz) + by_z(zz) + rz[3, 3] / place == pytest.approx(0.0, abs=size)
            rr, tt, zz, rz, rt, tz = dragged  # times cos(theta), the last two sin(theta)
            size = 1e-8 * max(1.0, np.abs(dragged).max()) / min(scale, 0.5)
            assert by_r(rr) + by_z(rz) + (rt + rr - tt)[3, 3] / place == pytest.approx(0.0, abs=size)
            assert by_r(rt) + by_z(tz) + (2.0 * rt - tt)[3, 3] / place == pytest.approx(0.0, abs=size)
            assert by_r(rz) + by_z(zz) + (rz + tz)[3, 3] / place == pytest.approx(0.0, abs=size)


@pytest.mark.parametrize("bodies", list(random_bodies(6)), ids=lambda one: f"{one[0]:.2g}-{one[3]:.2g}")
def test_the_surface_bears_what_is_put_on_it(bodies):
    """The pressure, from g by Abel's integral; a traction as large against x; neither outside the contact."""
    whole = under_rigid_sphere(*bodies)
    ratio, nu, nu_below, radius = bodies
    g = pressure((Layer.of(1.0, ratio, nu, nu_below),), radius)
    t, weight = np.polynomial.legendre.leggauss(400)
    r = np.array([0.0, 0.2, 0.5, 0.8])
    expected = []
    for one in r:  # p = -Integral_r^1 g'(s)/sqrt(s^2 - r^2) ds, with s = sqrt(r^2 + v^2)
        v = math.sqrt(1.0 - one * one) * (t + 1.0) / 2.0
        s, step = np.sqrt(one * one + v * v), 1e-5
        slope = (value_of(g, s + step) - value_of(g, s - step)) / (2.0 * step)
        expected.append(-(slope / s) @ weight * math.sqrt(1.0 - one * one) / 2.0)
    inside, outside = whole.in_film(r, np.zeros(1)), whole.in_film(np.array([1.05, 1.5]), np.zeros(1))
    assert_allclose(-inside.pressed[2][0], expected, rtol=2e-4)
    assert_allclose(inside.dragged[3], inside.pressed[2], atol=1e-7)
    assert_allclose(inside.dragged[5], -inside.pressed[2], atol=1e-7)
    for one in (inside.pressed[3], inside.dragged[2], *outside.pressed[2:], *outside.dragged[2:4], outside.dragged[5]):
        assert_allclose(one, 0.0, atol=1e-7)


def test_a_wide_contact_leaves_the_body_hertzs_stresses_and_stretches_the_film():
    """By hand: under the axis the film has the strain of the body's surface, -(1 - 2 nu)(1 + nu) p/(2 E) both ways, and p on
    it."""
    ratio, nu, nu_below = 0.5, 0.3, 0.2
    whole = under_rigid_sphere(ratio, nu, nu_below, 1000.0)
    film = whole.in_film(np.zeros(1), np.array([0.5 * whole.thickness])).pressed
    stiffer = ratio * (1.0 - nu**2) / (1.0 - nu_below**2)
    strain = -1.5 * (1.0 - 2.0 * nu_below) * (1.0 + nu_below) / 2.0  # times E of the body; p is 3/2 of the mean
    expected = (stiffer * strain - 1.5 * nu) / (1.0 - nu)
    assert float(film[0][0, 0]) == pytest.approx(expected, rel=3e-3)
    assert float(film[2][0, 0]) == pytest.approx(-1.5, rel=3e-3)
    body = whole.in_body(np.array([0.0, 0.5]), np.array([0.3, 0.6])).pressed
    exact = stress(np.array([0.0, 0.5]), 0.0, np.array([0.3, 0.6])[:, None], 0.0, nu_below)
    assert_allclose(body[2], 1.5 * exact[2], atol=3e-3)
    assert_allclose(body[0], 1.5 * exact[0], atol=3e-3)


def test_bessel_functions_of_small_and_of_large_arguments():
    """Both sides of the argument where series take over, against scipy's functions of integer order."""
    x = np.array([1e-3, 0.01, 0.03, 0.0499, 0.0501, 0.2, 1.0, 7.0])
    found = _bessel(np.array([1.0]), x)[:, 0]
    assert_allclose(found, [special.jn(order, x) for order in range(4)], rtol=2e-8)
