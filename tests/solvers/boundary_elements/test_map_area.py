"""The area of a map by the solution of enough of its points, against the solution of all of them."""

import math

import numpy as np
import pytest
from test_rough_maps import UNIT, rough

from stiction.solvers.boundary_elements import map_area as module
from stiction.solvers.boundary_elements.area_estimates import by_ranks, map_slopes
from stiction.solvers.boundary_elements.map_area import MapArea, map_area
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import SelfAffine
from stiction.surfaces.theory.widened_area import with_hardness

PRESSURES = np.array([0.01, 0.05, 0.2])  # over E* h'


def solved(heights, pressures, hardness=None):
    """Shares at pressures over E*."""
    found = solve_map(heights, UNIT, modulus=1.0, loads=pressures, periodic=True, hardness=hardness, stiffness=False)
    return found.array("area")


def test_as_solved_where_every_point_is():
    """8 points in the shortest wave cannot be thinned to 4 on 96 points a side, as too few would be in contact."""
    heights = rough(96)
    area = MapArea(heights, UNIT, True)
    pressures = PRESSURES[:2] * area.slopes.gradient
    assert area.way == "solution"
    assert area.share(pressures, math.inf) == pytest.approx(solved(heights, pressures), rel=1e-4)
    hardness = 0.1 * area.slopes.gradient
    assert area.share(pressures, hardness) == pytest.approx(solved(heights, pressures, hardness), rel=1e-3)


@pytest.mark.parametrize("shape", [lambda z: z, lambda z: np.exp(0.5 * z), lambda z: -np.exp(-0.5 * z)])
def test_within_three_percent_from_some_of_the_points(shape):
    heights = rough(256, points=16.0)
    heights = shape(heights / heights.std()) * 1e-3
    area = MapArea(heights, UNIT, True)
    pressures = PRESSURES * area.slopes.gradient
    assert area.solvable[0] > 1
    assert area.share(pressures, math.inf) == pytest.approx(solved(heights, pressures), rel=0.03)


def test_a_whole_curve_goes_through_few_solutions():
    heights = rough(128)
    area = MapArea(heights, UNIT, True)
    h = area.slopes.gradient
    pressures = np.geomspace(1e-5, 3.0, 60) * h
    shares = area.share(pressures, math.inf)
    assert (np.diff(shares) > 0.0).all() and shares[-1] <= 1.0 and shares[-1] > 0.999
    assert shares[0] / pressures[0] == pytest.approx(shares[1] / pressures[1], rel=0.05)  # in proportion at light loads
    some = np.array([0.03, 0.12]) * h
    assert np.interp(some, pressures, shares) == pytest.approx(solved(heights, some), rel=0.04)
    assert len(area._curves[math.inf]._nodes) < 25


def test_what_does_not_press_touches_nothing_and_what_is_pressed_flat_everything():
    area = MapArea(rough(64), UNIT, True)
    hardness = 0.05 * area.slopes.gradient
    assert area.share(np.array([[0.0, hardness]]), hardness).tolist() == [[0.0, 1.0]]


def test_a_map_too_large_takes_a_formula(monkeypatch):
    heights = np.tanh(rough(64) / 0.01) * 0.01
    monkeypatch.setattr(module, "MOST_POINTS", 100)
    area = MapArea(heights, UNIT, True)
    assert area.way == "ranks" and not area.solvable
    p, h = 0.04, area.slopes.gradient
    wanted = with_hardness(by_ranks(p, area.slopes), p, 0.3)
    assert area.share(np.array([p * h]), 0.3 * h) == pytest.approx([wanted], rel=1e-12)
    assert MapArea(rough(64), UNIT, True).way == "top slopes"


def test_windows_touch_as_the_surface_that_they_are_cut_from():
    """Quarters of one period: their mean is that of the whole but for their scatter; with nothing outside it would be less."""
    heights = rough(256)
    pressure = 0.1 * map_slopes(heights, UNIT).gradient
    whole = solved(heights, [pressure])[0]
    areas = [
        MapArea(np.ascontiguousarray(heights[y : y + 128, x : x + 128]), (0.5, 0.5), False) for y in (0, 128) for x in (0, 128)
    ]
    shares = np.array([one.share(np.array([pressure]), math.inf)[0] for one in areas])
    assert np.mean(shares) == pytest.approx(whole, rel=0.03)
    alone = [
        solve_map(one.heights, one.size, modulus=1.0, loads=[pressure / 4], periodic=False, free=True)[0].area * 4
        for one in areas
    ]
    assert np.mean(alone) < 0.95 * whole
    parts = MapArea(heights, UNIT, False)
    few_waves = 1.0 + 0.8 * max(6.0 / parts.waves.longest_waves_on_a_side - 1.0, 0.0)
    scatter = few_waves * np.std(np.log(shares), ddof=1) / 2.0
    assert parts.sample_error(np.array([pressure]), math.inf) == pytest.approx([scatter], rel=1e-9)
    assert MapArea(heights, UNIT, True).sample_error(np.array([pressure]), math.inf) == [0.0]


@pytest.mark.parametrize("hardness", (math.inf, 1.0, 0.5))
def test_windows_with_few_waves_are_as_uncertain_as_they_scatter(hardness):
    """Sixteen windows of two maps with a quarter of the side as their longest wave, against the whole period; hardness: over
    E* h', where most of what touches flows."""
    apart = []
    for seed in (3, 4):
        wide = SelfAffine(hurst=0.8, rolloff=0.25, shortest=1.0 / 48.0, deviation=1e-3)
        heights = gaussian_surface((384, 384), (1.0, 1.0), wide, seed=seed).heights
        whole = MapArea(np.ascontiguousarray(heights), UNIT, True)
        pressure = np.array([0.005 * whole.slopes.gradient])
        for y, x in [(y, x) for y in range(0, 384, 96) for x in range(0, 384, 192)]:
            window = MapArea(np.ascontiguousarray(np.roll(heights, (-y, -x), (0, 1))[:144, :144]), (0.375, 0.375), False)
            assert window.waves.longest_waves_on_a_side < 6.0
            hard = hardness * whole.slopes.gradient
            error = np.log(window.share(pressure, hard) / whole.share(pressure, hard))
            apart.append((error / window.sample_error(pressure, hard)).item())
    assert np.mean(np.abs(apart) < 1.645) >= 0.8


def test_a_flat_quarter_leaves_the_scatter_unknown():
    heights = rough(64)
    heights[:32, :32] = -1.0
    assert np.isnan(MapArea(heights, UNIT, False).sample_error(np.array([0.01]), math.inf))


def test_a_map_is_kept_by_its_content():
    heights = rough(64)
    first = map_area(HeightMap(heights, UNIT, periodic=True))
    assert map_area(HeightMap(heights.copy(), UNIT, periodic=True)) is first
    assert map_area(HeightMap(heights, UNIT)) is not first
    assert map_area(HeightMap(2.0 * heights, UNIT, periodic=True)) is not first


def test_slopes_of_a_map_that_ends():
    """Differences of fourth order see what the waves of the whole period say."""
    spectrum = SelfAffine(hurst=0.8, rolloff=0.1, shortest=8.0 / 256, deviation=0.01)
    heights = gaussian_surface((256, 256), UNIT, spectrum, seed=4, stretch=2.0, angle=0.5).heights
    whole, ends = map_slopes(heights, UNIT), map_slopes(heights, UNIT, periodic=False)
    assert ends.gradient == pytest.approx(whole.gradient, rel=0.01)
    assert ends.alpha == pytest.approx(whole.alpha, rel=0.1)
    assert ends.lay == pytest.approx(whole.lay, rel=0.05)
    assert ends.top(0.05) == pytest.approx(whole.top(0.05), rel=0.02)
    steep = np.arange(64.0)[:, None] + np.zeros(64)
    assert map_slopes(steep + 1e-6 * rough(64), UNIT, periodic=False).gradient == pytest.approx(64.0, rel=1e-4)


@pytest.mark.parametrize("hardness", [math.inf, 0.3])
def test_the_area_at_a_pressure_does_not_depend_on_the_other_pressures(hardness):
    """At the two lightest pressures too few points touch: the formula is scaled to a solution that is always the same."""
    heights = rough(128)
    h = MapArea(heights, UNIT, True).slopes.gradient
    pressures = np.array([1e-5, 3e-4, 0.03, 0.2]) * h
    together = MapArea(heights, UNIT, True).share(pressures, hardness * h)
    for pressure, share in zip(pressures, together, strict=True):
        assert MapArea(heights, UNIT, True).share(np.array([pressure]), hardness * h) == pytest.approx([share], rel=1e-9)
