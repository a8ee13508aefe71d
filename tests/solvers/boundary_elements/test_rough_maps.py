"""Rough maps: what must hold whatever the map is, limits, convergence with points, and what is said where it does not hold."""

import math
from pathlib import Path

import numpy as np
import pytest

from refusals import refusal
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.measures import PIXEL_EXCESS, Edges, edges
from stiction.solvers.boundary_elements.minimise import Problem, minimise
from stiction.solvers.boundary_elements.operators import PeriodicBoundary
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces import memory
from stiction.surfaces.generate import gaussian_surface, with_slope
from stiction.surfaces.targets import SelfAffine

UNIT = (1.0, 1.0)


def rough(count, points=8.0, rolloff=0.16, seed=1, slope=0.1):
    """A periodic Gaussian map of rms slope .1 on the unit square; points: in its shortest wave."""
    spectrum = SelfAffine(hurst=0.8, rolloff=rolloff, shortest=points / count, deviation=0.01)
    return with_slope(gaussian_surface((count, count), UNIT, spectrum, seed=seed), slope).heights


@pytest.fixture(scope="module")
def heights():
    return rough(128)


def conditions(heights, found, modulus, hardness=math.inf, film=None):
    """By how much (2) of `minimise` is missed, recomputed from the pressure alone, over the rms step between points."""
    shape = heights.shape
    moved = PeriodicBoundary(Compliance(modulus, film), shape, UNIT)(found.pressure)
    gap = moved - heights + found.separation + heights.mean()
    free = (found.pressure > 0.0) & (found.pressure < hardness)
    wrong = np.where(free, np.abs(gap), np.where(found.pressure > 0.0, gap, -gap))
    return max(float(wrong.max()), 0.0) / (0.1 / shape[0])


@pytest.mark.parametrize("film", [None, Film(0.03, 1.0, 0.5, math.inf, 0.3), Film(0.03, 0.3, 0.4, 9.0, 0.3)])
@pytest.mark.parametrize("hardness", [None, 0.03, 0.004])
def test_the_conditions_of_contact_are_met_and_the_load_is_carried(heights, hardness, film):
    modulus = 1.0 if film is None else math.inf
    loads = [1e-4, 1e-3, 3.9e-3]
    found = solve_map(heights, UNIT, modulus=modulus, loads=loads, periodic=True, hardness=hardness, film=film)
    top = math.inf if hardness is None else hardness
    for load, contact in zip(loads, found, strict=True):
        assert contact.load == pytest.approx(load) and contact.residual <= 1e-5
        assert names(contact.validity_warnings) <= {"points_in_contact"}
        assert contact.pressure.mean() == pytest.approx(load, rel=1e-11)
        assert contact.pressure.min() >= 0.0 and contact.pressure.max() <= top
        assert conditions(heights, contact, modulus, top, film) < 1e-3
        flowing = contact.pressure[contact.pressure >= top].sum() / contact.pressure.sum()
        assert contact.plastic_share == pytest.approx(flowing, rel=1e-9)
    assert (np.diff(found.array("area")) > 0.0).all()
    assert (np.diff(found.array("separation")) < 0.0).all()


def test_far_above_the_hardness_every_point_in_contact_carries_it(heights):
    (found,) = solve_map(heights, UNIT, modulus=1.0, loads=[2e-4], periodic=True, hardness=0.001)
    assert found.area_pixels == pytest.approx(2e-4 / 0.001, rel=0.01)
    assert found.area == pytest.approx(2e-4 / 0.001, rel=0.005)
    assert found.plastic_share > 0.98
    # and the heights in contact are the highest: pressure reaches no further than the bearing area
    assert heights[found.pressure == 0.0].max() <= np.quantile(heights, 1.0 - 0.2) + 0.05 * heights.std()


def test_a_hardness_above_the_largest_pressure_changes_nothing(heights):
    (elastic,) = solve_map(heights, UNIT, modulus=1.0, loads=[1e-3], periodic=True)
    (hard,) = solve_map(heights, UNIT, modulus=1.0, loads=[1e-3], periodic=True, hardness=1.01 * elastic.pressure.max())
    assert hard.pressure == pytest.approx(elastic.pressure, abs=1e-4 * elastic.pressure.max()) and hard.plastic_share == 0.0


def test_a_load_is_the_same_in_a_curve_and_alone_and_from_any_start(heights):
    curve = solve_map(heights, UNIT, modulus=1.0, loads=[4e-3, 1e-3], periodic=True, hardness=0.03)
    assert curve.array("load") == pytest.approx([4e-3, 1e-3])
    alone = solve_map(heights, UNIT, modulus=1.0, loads=[4e-3], periodic=True, hardness=0.03)
    assert curve[0].area_pixels == pytest.approx(alone[0].area_pixels, rel=2e-4)
    displacement = PeriodicBoundary(Compliance(1.0), heights.shape, UNIT)
    problem = Problem(displacement, heights, 4e-3, 0.03, 0.1 / 128)
    for seed in range(4):
        start = np.random.default_rng(seed).exponential(4e-3, heights.shape)
        if seed == 3:  # most of the load where it does not belong, at the hardness
            start = np.where(start > np.quantile(start, 0.88), 0.03, (4e-3 - 0.03 * 0.12) / 0.88)
        found = minimise(problem, start, tolerance=1e-5, most=500)
        assert found.converged
        assert found.pressure == pytest.approx(alone[0].pressure, abs=2e-3 * 0.03)


def test_flow_where_faces_do_not_touch_is_no_solution(heights):
    """All points at the hardness but the highest: nothing else is missed than that the lowest do not reach the face."""
    hardness = 0.01
    start = np.full(heights.shape, hardness)
    start[np.unravel_index(heights.argmax(), heights.shape)] *= 0.5
    problem = Problem(PeriodicBoundary(Compliance(1.0), heights.shape, UNIT), heights, start.mean(), hardness, 0.1 / 128)
    assert minimise(problem, start, tolerance=1e-5, most=0).residual > 1.0
    assert minimise(problem, start, tolerance=1e-5, most=500).converged


def test_the_stiffness_is_the_slope_of_load_against_separation(heights):
    low, mid, high = solve_map(heights, UNIT, modulus=1.0, loads=[0.999e-3, 1e-3, 1.001e-3], periodic=True, tolerance=1e-7)
    slope = (high.load - low.load) / (low.separation - high.separation)
    assert mid.stiffness == pytest.approx(slope, rel=2e-3)


def test_units_scale_out():
    """Lengths by s, moduli by m: areas by s^2, pressures by m, at loads m s^2."""
    heights = rough(64)
    (one,) = solve_map(heights, UNIT, modulus=1.0, loads=[1e-3], periodic=True, hardness=0.05)
    scaled = solve_map(1e-5 * heights, (1e-5, 1e-5), modulus=1e11, loads=[1e-3 * 10.0], periodic=True, hardness=0.05e11)
    assert scaled[0].area == pytest.approx(1e-10 * one.area, rel=1e-6)
    assert scaled[0].separation == pytest.approx(1e-5 * one.separation, rel=1e-6)
    assert scaled[0].stiffness == pytest.approx(1e6 * one.stiffness, rel=1e-6)


@pytest.mark.parametrize("hardness", [None, 0.03, 0.01])
def test_the_corrected_area_hardly_depends_on_the_points(hardness):
    """Four surfaces at 32, 16, 8 points in the shortest wave: counted area rises by 5 %, the corrected stays within 1 %."""
    counted, corrected = np.zeros((4, 3)), np.zeros((4, 3))
    for seed in range(4):
        finest = rough(256, points=32.0, rolloff=0.25, seed=seed)
        for column, every in enumerate((1, 2, 4)):
            sampled = np.ascontiguousarray(finest[::every, ::every])
            how = {"hardness": hardness, "periodic": True, "stiffness": False}
            (found,) = solve_map(sampled, UNIT, modulus=1.0, loads=[5e-3], **how)
            counted[seed, column], corrected[seed, column] = found.area_pixels, found.area
    grows = counted.mean(axis=0)
    assert grows[2] / grows[0] > (1.04 if hardness is None else 1.01)
    steady = corrected.mean(axis=0)
    assert steady == pytest.approx(steady[0], rel=0.01)


def wave_contact(along_y, along_x, share, draw):
    """The contact of Westergaard's waves of a random phase on 96 points, its exact area, and its sides in points."""
    step = np.arange(96) / 96
    wave = 2.0 * math.pi * (along_y * step[:, None] + along_x * step) + draw.uniform(0.0, 6.0)
    full = 0.5 * 2.0 * math.pi * math.hypot(along_y, along_x) * 1e-3
    (found,) = solve_map(1e-3 * np.cos(wave), UNIT, modulus=1.0, loads=[share * full], periodic=True, stiffness=False)
    return found, 2.0 * math.asin(math.sqrt(share)) / math.pi, found.perimeter * 4.0 / math.pi / 96


def test_the_excess_of_pixels_at_edges_of_all_directions():
    """Westergaard's waves at angles to the pixels: A = 2 arcsin(sqrt(p/p*))/pi."""
    excess, sides, draw = [], [], np.random.default_rng(0)
    for along_y, along_x in ((4, 0), (4, 1), (5, 1), (5, 2), (5, 3), (5, 4), (9, 1), (7, 2), (7, 4), (7, 6)):
        for share in draw.uniform(0.1, 0.8, 6):
            found, exact, around = wave_contact(along_y, along_x, share, draw)
            excess.append(found.area_pixels - exact)
            sides.append(around)
    assert sum(excess) / sum(sides) == pytest.approx(0.1, abs=0.015)


def test_the_area_of_waves_along_the_pixels():
    """Westergaard's waves along the pixels and at 14 degrees. With one coefficient .01 to .09 of a pixel would be left."""
    draw = np.random.default_rng(1)
    for along_y, along_x in ((4, 0), (0, 5), (4, 1)):
        left, sides = [], []
        for share in draw.uniform(0.1, 0.8, 12):
            found, exact, around = wave_contact(along_y, along_x, share, draw)
            left.append(found.area - exact)
            sides.append(around)
        assert sum(left) / sum(sides) == pytest.approx(0.0, abs=0.035)


def test_sides_between_contact_and_none_are_counted():
    contact = np.zeros((4, 5), dtype=bool)
    contact[0, 0] = contact[2, 2] = contact[2, 3] = True
    assert edges(contact, periodic=True) == Edges(along_y=2 + 2, along_x=2 + 4)
    assert edges(contact, periodic=False) == Edges(along_y=1 + 2, along_x=1 + 4)


def test_alone_and_periodic_agree_far_from_the_ends():
    """A bump in the middle of a map: its copies are far away."""
    x = (np.arange(96) - 48) / 96.0
    heights = 0.01 * np.exp(-(x[:, None] ** 2 + x**2) / (2.0 * 0.05**2))
    areas = [solve_map(heights, UNIT, modulus=1.0, loads=[1e-5], periodic=periodic)[0].area for periodic in (True, False)]
    assert areas[0] == pytest.approx(areas[1], rel=0.01)


# ---- what is said, and what is refused


def names(validity_warnings):
    return {warning.quantity for warning in validity_warnings}


def test_pages_state_the_coefficient_at_edges_that_is_used():
    root = Path(__file__).parents[3]
    law = "src/stiction/laws/rough_surface/boundary_elements.py"
    for page in ("docs/explanation/boundary-elements.md", law, "docs/explanation/truth.md"):
        text = (root / page).read_text(encoding="utf-8")
        assert f"{PIXEL_EXCESS:.3f}".lstrip("0") in text and r"\pi-1+\ln2" not in text


def test_a_good_map_has_no_warnings_and_bad_ones_are_named():
    good = solve_map(rough(256, rolloff=0.12), UNIT, modulus=1.0, loads=[1e-3], periodic=True)
    assert not good.validity_warnings and not good[0].validity_warnings and good.complete
    coarse = solve_map(rough(64, points=3.0), UNIT, modulus=1.0, loads=[1e-3], periodic=True)
    assert "points_in_shortest_wave" in names(coarse.validity_warnings)
    few = solve_map(rough(64, rolloff=0.5), UNIT, modulus=1.0, loads=[1e-5], periodic=True)
    assert "longest_waves_on_a_side" in names(few.validity_warnings) and "points_in_contact" in names(few[0].validity_warnings)
    steep = solve_map(rough(64, slope=2.0), UNIT, modulus=1.0, loads=[1e-3], periodic=True, film=Film(1e-3, 1.0, 0.3, 2.0, 0.3))
    assert {"rms_gradient", "film_thickness"} <= names(steep.validity_warnings)
    x = np.arange(32) / 32.0
    tilted = np.tile(0.01 * x, (32, 1)) + 1e-4 * np.cos(40.0 * x)
    ends = solve_map(tilted, UNIT, modulus=1.0, loads=[1e-4], periodic=False, free=True)
    assert "load_at_ends" in names(ends[0].validity_warnings)


@pytest.mark.parametrize("load", (1e-4, 5.1e-4, 2e-3))
def test_a_load_that_is_within_the_map_leaves_its_ends_bare(load):
    """Exactly: the rest of a difference of sums may be below 0, and then was said to be outside of its range."""
    at = (np.arange(128) - 63.9) / 128.0
    sphere = -(np.square(at)[:, None] + np.square(at)[None, :]) / 20.0
    assert solve_map(sphere, UNIT, modulus=1.0, loads=[load], periodic=False, free=True)[0].load_at_ends == 0.0


def test_what_did_not_converge_says_so(heights):
    found = solve_map(heights, UNIT, modulus=1.0, loads=[1e-3], periodic=True, most_steps=2)
    assert "not_converged" in names(found[0].validity_warnings) and found[0].residual > 1e-5
    assert "not converged" in str(found[0].validity_warnings[0])


def test_an_interruption_keeps_the_loads_that_are_done(heights):
    def stop_in_the_second(now):
        assert now.loads == 3 and now.residual > 0.0
        if now.load == 1:
            raise KeyboardInterrupt

    found = solve_map(heights, UNIT, modulus=1.0, loads=[2e-3, 1e-3, 3e-3], periodic=True, progress=stop_in_the_second)
    assert [contact.load for contact in found] == pytest.approx([1e-3]) and not found.complete

    def stop_at_once(_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        solve_map(heights, UNIT, modulus=1.0, loads=[1e-3], periodic=True, progress=stop_at_once)


def refused(match, heights, **changes):
    arguments = {"modulus": 1.0, "loads": [1e-3], "periodic": True, **changes}
    with refusal(*match) as caught:
        solve_map(heights, UNIT, **arguments)
    assert "\n" not in str(caught.value)


def test_bad_maps_and_loads_get_a_line(heights):
    broken = heights.copy()
    broken[3, 4] = math.nan
    refused(("heights", "1", "16384"), broken)
    refused(("heights",), np.zeros((32, 32)))
    refused(("heights",), np.arange(40.0)[None, :])
    refused(("loads",), heights, loads=[])
    refused(("loads",), heights, loads=[0.0])
    refused(("loads",), heights, loads=[math.nan])
    refused(("loads",), heights, hardness=5e-4)
    refused(("hardness",), heights, hardness=-1.0)
    refused(("modulus",), heights, modulus=math.inf)
    refused(("tolerance",), heights, tolerance=0.0)
    refused(("colour",), heights, colour="red")


def test_one_spike_is_solved():
    heights = 1e-3 * rough(64)
    heights[20, 20] = 1.0
    (found,) = solve_map(heights, UNIT, modulus=1.0, loads=[1e-5], periodic=True)
    assert found.area_pixels == pytest.approx(1.0 / 64**2) and "points_in_contact" in names(found.validity_warnings)


def test_memory_is_asked_for_before_it_is_taken(heights, monkeypatch):
    with refusal("heights", "100000 x 100000"):
        memory.require_memory((100_000, 100_000))
    monkeypatch.setattr(memory, "available_memory", lambda: 10**6)
    refused(("heights",), heights)
    monkeypatch.setattr(memory, "available_memory", lambda: None)
    memory.require_memory((100_000, 100_000))
