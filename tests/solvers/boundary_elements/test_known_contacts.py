"""Maps whose contact is known in closed form: a sphere, waves, and what a direct solution of few points gives."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize
from scipy.special import j0

from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.operators import FreeBoundary, PeriodicBoundary
from stiction.solvers.boundary_elements.solve import solve_map

MODULUS = 7e10


def grid(count, size):
    """Points of a square map, their origin in the middle."""
    axis = (np.arange(count) - count // 2) * (size / count)
    return np.meshgrid(axis, axis, indexing="ij")


def paraboloid(count, size, radius):
    y, x = grid(count, size)
    return -(x**2 + y**2) / (2.0 * radius)


def test_hertz_to_one_per_cent_at_forty_points_across():
    """Johnson 1985, section 4.2: F = 4 E* a^3/(3 R), delta = a^2/R, p0 = 2 E* a/(pi R), dF/d delta = 2 E* a."""
    radius, size, count = 1e-3, 60e-6, 60
    a = 20.3 * size / count
    load = 4.0 * MODULUS * a**3 / (3.0 * radius)
    heights = 3e-6 + paraboloid(count, size, radius)  # where heights count from does not matter
    (found,) = solve_map(heights, (size, size), modulus=MODULUS, loads=[load], periodic=False, free=True)
    assert found.area == pytest.approx(math.pi * a**2, rel=0.01)
    assert found.separation == pytest.approx(3e-6 - a**2 / radius - heights.mean(), rel=0.005)
    assert found.area_pixels == pytest.approx(math.pi * a**2, rel=0.03)
    assert found.perimeter == pytest.approx(2.0 * math.pi * a, rel=0.02)
    assert found.approach == pytest.approx(a**2 / radius, rel=0.005)
    assert found.pressure.max() == pytest.approx(2.0 * MODULUS * a / (math.pi * radius), rel=0.005)
    assert found.stiffness == pytest.approx(2.0 * MODULUS * a, rel=0.02)
    y, x = grid(count, size)
    hertz = 2.0 * MODULUS / (math.pi * radius) * np.sqrt(np.maximum(a**2 - x**2 - y**2, 0.0))
    well_inside = x**2 + y**2 < (0.9 * a) ** 2
    assert found.pressure[well_inside] == pytest.approx(hertz[well_inside], rel=0.01)


def test_two_maps_touch_like_one_of_their_sum():
    size, load = 60e-6, 0.1
    of_one = solve_map(paraboloid(48, size, 1e-3), (size, size), modulus=MODULUS, loads=[load], periodic=False, free=True)
    both = paraboloid(48, size, 2e-3) + paraboloid(48, size, 2e-3)
    of_two = solve_map(both, (size, size), modulus=MODULUS, loads=[load], periodic=False, free=True)
    assert of_two[0].area == pytest.approx(of_one[0].area, rel=1e-9)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_a_wave_in_one_direction(share):
    """Westergaard 1939; Johnson 1985, eqs. 13.6 and 13.7: p = p* sin^2(pi a/lambda), p* = pi E* Delta/lambda."""
    count, wave, height = 512, 1e-5, 2e-8
    x = np.arange(count) / count
    heights = np.tile(height * np.cos(2.0 * math.pi * x), (16, 1))
    full = math.pi * MODULUS * height / wave
    size = (wave / 32.0, wave)
    (found,) = solve_map(heights, size, modulus=MODULUS, loads=[share * full * size[0] * size[1]], periodic=True)
    half = math.asin(math.sqrt(share)) / math.pi
    assert found.area_pixels / found.nominal_area == pytest.approx(2.0 * half, abs=2.0 / count)
    distance = np.minimum(x, 1.0 - x)
    bracket = np.maximum(share - np.sin(math.pi * distance) ** 2, 0.0)
    exact = 2.0 * full * np.cos(math.pi * distance) * np.sqrt(bracket)
    assert np.abs(found.pressure - exact).max() < 0.06 * exact.max()  # at the edge
    inside = distance < half - 6.0 / count
    assert found.pressure[:, inside] == pytest.approx(np.tile(exact[inside], (16, 1)), rel=0.01)


def egg_box(count, height):
    x = np.cos(2.0 * math.pi * np.arange(count) / count)
    return height * np.outer(x, x)


EGG_FULL = math.sqrt(2.0) * math.pi * 1e-3 * MODULUS  # p* of Johnson, Greenwood & Higginson 1985, at height/wave 1e-3


def test_a_wave_in_two_directions_in_light_contact_is_hertz_on_its_peaks():
    """Two peaks on wave^2, 1/R = Delta (2 pi/lambda)^2; the peaks are not quite parabolic: some (a/lambda)^2."""
    mean = 0.002 * EGG_FULL
    (found,) = solve_map(egg_box(256, 1e-3), (1.0, 1.0), modulus=MODULUS, loads=[mean], periodic=True)
    radius = 1.0 / (1e-3 * (2.0 * math.pi) ** 2)
    a = (3.0 * 0.5 * mean * radius / (4.0 * MODULUS)) ** (1.0 / 3.0)
    assert found.area == pytest.approx(2.0 * math.pi * a**2, rel=0.02)


def test_a_wave_in_two_directions_close_to_full_contact():
    """Holes of radius b round the lowest points, at whose rim no stress is singular: b^2 = 3 lambda^2 (1 - p/p*)/(4 pi^2), so
    that 1 - A = 3/(2 pi) (1 - p/p*) (Johnson, Greenwood & Higginson 1985, from the penny crack)."""
    (found,) = solve_map(egg_box(256, 1e-3), (1.0, 1.0), modulus=MODULUS, loads=[0.95 * EGG_FULL], periodic=True)
    assert 1.0 - found.area == pytest.approx(3.0 / (2.0 * math.pi) * 0.05, rel=0.05)


def test_full_contact_has_the_pressure_of_its_wave():
    (found,) = solve_map(egg_box(48, 1e-3), (1.0, 1.0), modulus=MODULUS, loads=[1.1 * EGG_FULL], periodic=True)
    assert found.area == found.area_pixels == found.nominal_area
    assert found.pressure == pytest.approx(EGG_FULL * (1.1 + egg_box(48, 1.0)), rel=1e-4, abs=1e-4 * EGG_FULL)
    assert found.stiffness == math.inf and found.perimeter == 0.0
    assert found.mean_gap == pytest.approx(0.0, abs=1e-9) and found.separation == pytest.approx(0.0, abs=1e-9)


def love(x, y, a, b):
    """Johnson 1985, eq. 3.25, times E*/p, as printed."""

    def term(u, v, w):
        return u * math.log((v + math.hypot(v, u)) / (w + math.hypot(w, u)))

    return (
        term(x + a, y + b, y - b) + term(y + b, x + a, x - a) + term(x - a, y - b, y + b) + term(y - b, x - a, x + a)
    ) / math.pi


def dense(count, periodic, size=1.0):
    """The matrix of displacements of a map of count^2 points on a half-space of E* = 1, without transforms."""
    step = size / count
    places = [(i, j) for i in range(count) for j in range(count)]
    if not periodic:
        return np.array([[love((j - n) * step, (i - m) * step, step / 2, step / 2) for m, n in places] for i, j in places])
    waves = [(m, n) for m in range(-(count // 2), count // 2) for n in range(-(count // 2), count // 2) if m or n]
    matrix = np.zeros((count**2, count**2))
    i, j = np.array(places).T
    for m, n in waves:
        phase = 2.0 * math.pi * (m * (i[:, None] - i) + n * (j[:, None] - j)) / count
        matrix += np.cos(phase) * 2.0 / (2.0 * math.pi * math.hypot(m, n) / size) / count**2
    return matrix


@pytest.mark.parametrize("hardness", [None, 0.7])
@pytest.mark.parametrize("periodic", [True, False])
def test_few_points_solved_as_a_quadratic_program(periodic, hardness):
    count, mean = 8, 0.15
    heights = np.random.default_rng(4).normal(size=(count, count)) * 0.15
    matrix = dense(count, periodic)
    flat = heights.ravel()
    direct = minimize(
        lambda p: 0.5 * p @ matrix @ p - p @ flat,
        np.full(flat.size, mean),
        jac=lambda p: matrix @ p - flat,
        bounds=[(0.0, hardness)] * flat.size,
        constraints=[{"type": "eq", "fun": lambda p: p.mean() - mean, "jac": lambda p: np.full(flat.size, 1.0 / flat.size)}],
        method="SLSQP",
        options={"ftol": 1e-13, "maxiter": 500},
    )
    (found,) = solve_map(heights, (1.0, 1.0), modulus=1.0, loads=[mean], periodic=periodic, free=True, hardness=hardness)
    assert direct.success
    assert found.pressure.ravel() == pytest.approx(direct.x, abs=2e-4)
    assert (found.plastic_share > 0.2) is (hardness is not None)


@pytest.mark.parametrize(("thickness", "substrate"), [(0.4, 5.0), (0.15, 0.2), (0.3, math.inf)])
def test_a_film_under_a_map_that_ends_gives_way_as_the_integral_over_its_waves_says(thickness, substrate):
    """u(r) = 1/(2 pi) Int C(k) p(k) J0(k r) k dk of the pressure exp(-r^2/2 w^2), transformed 2 pi w^2 exp(-k^2 w^2/2)."""
    compliance = Compliance(3.0, Film(thickness, 1.0, 0.45, substrate, 0.3))
    y, x = grid(160, 8.0)
    width = 0.5
    moved = FreeBoundary(compliance, x.shape, (8.0, 8.0))(np.exp(-(x**2 + y**2) / (2.0 * width**2)))
    for column in (80, 90, 106):
        r = abs(float(x[80, column]))

        def wave(k, r=r):
            return float(compliance.at(np.array([k]))[0]) * width**2 * math.exp(-0.5 * (k * width) ** 2) * float(j0(k * r)) * k

        exact = quad(wave, 0.0, 12.0 / width, limit=400)[0]
        assert moved[80, column] == pytest.approx(exact, rel=1.5e-3)


def test_a_thick_film_under_a_sphere_is_a_half_space_and_a_thin_one_is_not_there():
    radius, size, load = 1e-3, 60e-6, 0.15
    heights = paraboloid(48, size, radius)

    def area(modulus, film=None):
        return solve_map(heights, (size, size), modulus=modulus, loads=[load], periodic=False, free=True, film=film)[0].area

    hard, soft = 7e10 / (1.0 - 0.3**2), 2e10 / (1.0 - 0.4**2)
    assert area(math.inf, Film(1e-9, 2e10, 0.4, 7e10, 0.3)) == pytest.approx(area(hard), rel=0.005)
    thick = solve_map(
        heights, (size, size), modulus=math.inf, loads=[load], periodic=True, film=Film(1.0, 2e10, 0.4, 7e10, 0.3)
    )
    assert thick[0].area == pytest.approx(
        solve_map(heights, (size, size), modulus=soft, loads=[load], periodic=True)[0].area, rel=1e-6
    )


def test_periodic_displacement_of_a_single_wave():
    compliance = Compliance(2.0)
    x = 2.0 * math.pi * np.arange(32) / 32
    pressure = np.cos(3.0 * x)[None, :] * np.ones((8, 1))
    assert PeriodicBoundary(compliance, (8, 32), (1.0, 4.0))(pressure) == pytest.approx(
        pressure * 2.0 / (2.0 * 3.0 * 2.0 * math.pi / 4.0), abs=1e-15
    )


@pytest.mark.parametrize("film", (None, Film(2e-7, 3e10, 0.3, 1e11, 0.3)))
def test_a_window_touches_as_its_mirrored_period(film):
    """Four times the points of one period, of which the window is a quarter; the same cosines, no transform shared."""
    rng, size = np.random.default_rng(41), (6e-6, 8e-6)
    y, x = np.arange(48)[:, None] / 48, np.arange(64) / 64
    window = sum(
        1e-8 * rng.normal() / (1 + j * j + i * i) ** 0.7 * np.sin(2.1 * (j * y + i * x) + rng.uniform(0.0, 6.0))
        for j in range(-8, 9) for i in range(9)
    )  # fmt: skip
    period = np.block([[window, window[:, ::-1]], [window[::-1], window[::-1, ::-1]]])
    loads = np.array([2e-5, 2e-4])
    found = solve_map(window, size, modulus=MODULUS, loads=loads, periodic=False, film=film)
    whole = solve_map(period, (2 * size[0], 2 * size[1]), modulus=MODULUS, loads=4 * loads, periodic=True, film=film)
    for name, times in (("area", 4.0), ("stiffness", 4.0), ("separation", 1.0), ("perimeter", 4.0)):
        assert times * found.array(name) == pytest.approx(whole.array(name), rel=2e-3)
    assert found[1].pressure == pytest.approx(whole[1].pressure[:48, :64], abs=1e-3 * whole[1].pressure.max())
