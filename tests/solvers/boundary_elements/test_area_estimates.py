"""Formulas for the area of a map, and its solution from some of its points, against the solution from all of them."""

import math

import numpy as np
import pytest
from test_rough_maps import UNIT, rough

from stiction.solvers.boundary_elements.area_estimates import by_ranks, by_top_slopes, map_slopes
from stiction.solvers.boundary_elements.sampled import solve_sampled
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.targets import SelfAffine
from stiction.surfaces.theory.widened_area import of_moments, widened

PRESSURES = np.array([0.005, 0.02, 0.1, 0.3])  # over E* h'


def by_moments(pressure, slopes):
    return of_moments(pressure, slopes.alpha)


def areas(heights):
    loads = PRESSURES * map_slopes(heights, UNIT).gradient
    return solve_map(heights, UNIT, modulus=1.0, loads=loads, periodic=True, stiffness=False).array("area")


def errors(formula, heights, solved):
    slopes = map_slopes(heights, UNIT)
    return np.array([formula(pressure, slopes) for pressure in PRESSURES]) / solved - 1.0


@pytest.mark.parametrize(("first", "second"), [((5, 0), (0, 5)), ((3, 3), (3, -3)), ((4, 2), (-2, 4))])
def test_slopes_of_two_crossed_waves(first, second):
    """a cos(k1 x) + b cos(k2 x), |k1| = |k2| = k, k1 across k2: h'^2 = (a^2 + b^2) k^2/2, alpha = 3/2, R = a/b."""
    step = 2.0 * math.pi * np.arange(48) / 48
    heights = 3e-3 * np.cos(first[0] * step[:, None] + first[1] * step)
    heights += 2e-3 * np.cos(second[0] * step[:, None] + second[1] * step)
    slopes = map_slopes(heights, UNIT)
    assert slopes.gradient == pytest.approx(2.0 * math.pi * math.hypot(*first) * math.sqrt(6.5e-6), rel=1e-9)
    assert slopes.alpha == pytest.approx(1.5, rel=1e-9)
    assert slopes.lay == pytest.approx(1.5, rel=1e-9)
    assert slopes.squares.mean() == pytest.approx(1.0, rel=1e-9) and slopes.ranks[-1] == 1.0


def test_slopes_of_a_paraboloid_that_is_not_periodic():
    """a x^2 + b y^2 + c, whose differences of fourth order are exact; c must not count."""
    x = np.arange(24) / 24
    a, b = 0.03, 0.02
    slopes = map_slopes(a * x[:, None] ** 2 + b * x**2 + 0.4, UNIT, periodic=False)
    between, inner = np.mean(((x[1:-2] + x[2:-1]) / 2.0) ** 2), x[2:-2]
    along, across, both = 4.0 * a * a * between, 4.0 * b * b * between, 4.0 * a * b * inner.mean() ** 2
    variance = (a * a + b * b) * np.var(inner**2)
    assert slopes.gradient == pytest.approx(math.sqrt(along + across), rel=1e-9)
    assert slopes.alpha == pytest.approx(1.5 * variance * (2.0 * (a + b)) ** 2 / (along + across) ** 2, rel=1e-9)
    least, most = np.linalg.eigvalsh([[along, both], [both, across]])
    assert slopes.lay == pytest.approx(math.sqrt(most / least), rel=1e-9)


def test_light_and_heavy_loads():
    assert widened(1e-9, 0.5) == pytest.approx(math.sqrt(8.0 / math.pi) * 1.5e-9, rel=1e-3)
    assert widened(3.0, 0.5) == pytest.approx(1.0, abs=1e-8)
    slopes = map_slopes(rough(64), UNIT)
    for formula in (by_moments, by_top_slopes, by_ranks):
        assert formula(3.0, slopes) == pytest.approx(1.0, abs=0.01)
        assert (np.diff([formula(p, slopes) for p in np.geomspace(1e-3, 1.0, 30)]) > 0.0).all()


def test_formulas_on_a_gaussian_map():
    heights = rough(256)
    solved = areas(heights)
    for formula, largest in ((by_moments, 0.06), (by_top_slopes, 0.08), (by_ranks, 0.13)):
        assert np.abs(errors(formula, heights, solved)).max() < largest


def test_ranks_allow_for_a_lay():
    spectrum = SelfAffine(hurst=0.8, rolloff=0.16, shortest=12.0 / 256, deviation=0.01)
    heights = gaussian_surface((256, 256), UNIT, spectrum, seed=1, stretch=3.0).heights
    solved = areas(heights)
    assert map_slopes(heights, UNIT).lay == pytest.approx(3.0, rel=0.1)
    assert np.abs(errors(by_ranks, heights, solved)).max() < 0.11


def test_ranks_follow_a_worn_map_where_moments_do_not():
    heights = rough(256)
    worn = np.tanh(heights / heights.std()) * 0.01
    solved = areas(worn)
    assert np.abs(errors(by_ranks, worn, solved)).max() < 0.10
    assert np.abs(errors(by_moments, worn, solved)).max() > 0.5


def test_some_points_are_enough():
    heights = rough(256, points=16.0)
    loads = PRESSURES[2:] * map_slopes(heights, UNIT).gradient
    solved = solve_map(heights, UNIT, modulus=1.0, loads=loads, periodic=True, stiffness=False)
    sampled = solve_sampled(heights, UNIT, modulus=1.0, loads=loads, periodic=True, stiffness=False)
    assert sampled.every in (2, 4)
    assert sampled.contacts.array("area") == pytest.approx(solved.array("area"), rel=0.03)
    light = solve_sampled(heights, UNIT, modulus=1.0, loads=[1e-4], periodic=True, stiffness=False)
    assert light.every == 1
    alone = solve_sampled(heights[:250], (250 / 256, 1.0), modulus=1.0, loads=[3e-2], periodic=False, stiffness=False)
    assert alone.every > 1 and alone.contacts[0].nominal_area == pytest.approx(250 / 256, rel=0.03)
