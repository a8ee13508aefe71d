"""Maps of any size and of points that are no squares: lengths and areas in their own units, edges along both directions."""

import math
from dataclasses import replace

import numpy as np
import pytest

from stiction.solvers.boundary_elements import descent
from stiction.solvers.boundary_elements.adhesive import solve_adhesive
from stiction.solvers.boundary_elements.adhesive_curve import shortest_range
from stiction.solvers.boundary_elements.area_estimates import map_slopes
from stiction.solvers.boundary_elements.bodies import Bodies
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.curve import of_map
from stiction.solvers.boundary_elements.map_warnings import share_at_ends, warnings_of_load
from stiction.solvers.boundary_elements.measures import waves
from stiction.solvers.boundary_elements.minimise import Found
from stiction.solvers.boundary_elements.operators import FreeBoundary
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces.heightmap import HeightMap

ROUGH = 0.01 * np.random.default_rng(5).normal(size=(32, 32))
# One wave along x, on points four times as long along y as along x.
STRIPS, SIZE = 0.05 * np.cos(2.0 * math.pi * np.arange(128) / 128) * np.ones((8, 1)), (1.0, 4.0)


def sticking(scale, loads=(1e-3, 1e-4)):
    return solve_adhesive(
        scale * ROUGH,
        (scale, scale),
        modulus=1.0,
        loads=[scale**2 * one for one in loads],
        work=scale * 8e-5,
        reach=scale * 1.3e-3,
    )


def test_a_contact_that_adheres_scales_with_its_lengths():
    """At the same modulus energies per area go with lengths, forces with their squares."""
    for small, large in zip(sticking(1.0), sticking(10.0), strict=True):
        assert small.area > 0.0 and small.perimeter > 0.0 and small.attraction > 0.0
        assert large.area == pytest.approx(100.0 * small.area, rel=1e-9)
        assert large.perimeter == pytest.approx(10.0 * small.perimeter, rel=1e-9)
        assert large.mean_gap == pytest.approx(10.0 * small.mean_gap, rel=1e-4)
        assert large.attraction == pytest.approx(100.0 * small.attraction, rel=1e-3)
        (warning,), (same,) = ([d for d in one.validity_warnings if d.quantity == "points_at_edge"] for one in (small, large))
        assert warning.least == pytest.approx((1.3e-3) ** 2 / 8e-5 * 32.0, rel=1e-12)  # E* rho^2/w over the pitch
        assert same.least == pytest.approx(warning.least, rel=1e-12)


def test_a_descent_that_is_cut_short_says_so(monkeypatch):
    assert not any(one.quantity == "not_converged" for one in sticking(1.0)[0].validity_warnings)
    monkeypatch.setattr(descent, "_MOST", 2)
    (warning,) = [one for one in sticking(1.0)[0].validity_warnings if one.quantity == "not_converged"]
    assert warning.most > warning.high


def test_the_edges_of_a_strip_are_as_long_as_the_map():
    """Two straight edges along y: pi/4 of their length, on average over directions."""
    exact = 0.25 * math.pi * 2.0 * SIZE[0]
    (pressed,) = solve_map(STRIPS, SIZE, modulus=1.0, loads=[0.05], periodic=True)
    (stuck,) = solve_adhesive(STRIPS, SIZE, modulus=1.0, loads=[0.05], work=1e-7, reach=1e-3)
    assert 0.0 < pressed.area < 4.0
    assert pressed.perimeter == pytest.approx(exact, rel=1e-12)
    assert stuck.perimeter == pytest.approx(exact, rel=1e-12)


def test_a_point_that_is_no_square_moves_others_as_love_says():
    """Johnson 1985, eq. 3.25, by the integral of 1/(pi E* r) over the point, far off and from both sides."""
    pitch = (0.125, 0.25)
    pressure = np.zeros((8, 16))
    pressure[0, 0] = 1.0
    moved = FreeBoundary(Compliance(2.0), pressure.shape, (1.0, 4.0))(pressure)
    t, weight = np.polynomial.legendre.leggauss(24)
    y, x = 0.5 * pitch[0] * t[:, None], 0.5 * pitch[1] * t
    area = np.outer(weight, weight) * 0.25 * pitch[0] * pitch[1]
    for row, column in ((0, 1), (1, 0), (3, 2)):
        exact = float(np.sum(area / np.hypot(row * pitch[0] - y, column * pitch[1] - x))) / (2.0 * math.pi)
        assert moved[row, column] == pytest.approx(exact, rel=1e-6)


def test_the_shortest_wave_of_one_wave_is_that_wave():
    """To the width of the bins, and never longer: it is up to there that waves were counted."""
    heights = np.cos(2.0 * math.pi * 8.0 * np.arange(64) / 64) * np.ones((64, 1))
    seen = waves(heights, (1.0, 1.0), True)
    for found in (seen.shortest, seen.longest):
        assert 0.97 / 8.0 < found <= 1.0 / 8.0


def test_a_slope_that_ends_is_the_same_everywhere():
    y, x = np.mgrid[:32, :48] * 0.1
    found = map_slopes(0.01 * y + 0.03 * x, (3.2, 4.8), periodic=False)
    np.testing.assert_allclose(found.squares, 1.0, rtol=1e-9)
    assert found.gradient == pytest.approx(math.hypot(0.01, 0.03), rel=1e-9)


def test_the_window_of_a_map_that_ends_takes_no_slope():
    """The root mean square gradient of one wave is k a/2^(1/2)."""
    heights = 1e-3 * np.cos(2.0 * math.pi * 16.0 * np.arange(256) / 256) * np.ones((256, 1))
    exact = 2.0 * math.pi * 16.0 * 1e-3 / math.sqrt(2.0)
    assert waves(heights, (1.0, 1.0), True).gradient == pytest.approx(exact, rel=1e-9)
    assert waves(heights, (1.0, 1.0), False).gradient == pytest.approx(exact, rel=0.01)


def test_the_shortest_wave_of_an_odd_number_of_points_lies_as_it_lies():
    """One wave across both directions: its gradient is along one line, so that the tensor of gradients has one eigenvalue 0."""
    row = np.arange(27)
    for waves_on_a_side in (1, 13):
        heights = np.cos(2.0 * math.pi * waves_on_a_side * (row[:, None] + row) / 27)
        assert map_slopes(heights, (1.0, 1.0)).lay > 1e3


def test_a_hundredth_of_the_load_may_be_on_the_ends():
    """Of five by four points fourteen are the outermost; of two rows all are."""
    for share, warned in ((0.0, False), (0.00995, False), (0.01005, True), (0.7, True)):
        pressure = np.full((5, 4), share / 14.0)
        pressure[1:-1, 1:-1] = (1.0 - share) / 6.0
        assert share_at_ends(pressure) == pytest.approx(share)
        found = Found(pressure, np.zeros((5, 4)), 0.0, 0.0, 1, True)
        said = [(one.quantity, one.least, one.high) for one in warnings_of_load(found, 0.0, True, 1e-5)]
        assert [one for one in said if one[0] == "load_at_ends"] == [("load_at_ends", pytest.approx(share), 0.01)] * warned
        assert "load_at_ends" not in {one.quantity for one in warnings_of_load(found, 0.0, False, 1e-5)}
    assert share_at_ends(np.ones((2, 9))) == share_at_ends(np.ones((9, 1))) == 1.0


def test_the_shortest_range_is_two_of_the_longer_sides_of_points():
    """E* rho^2/w is twice the longer side of points that are 1/8 by 1/32 long."""
    surface = HeightMap(STRIPS, SIZE, periodic=True)
    found = shortest_range(surface, Bodies(2.0), 1e-3)
    assert 2.0 * found**2 / 1e-3 == pytest.approx(2.0 / 8.0, rel=1e-12)


def test_a_film_is_counted_in_points():
    """A map of 2 by 8, its points 1/4 by 1/16, of which every second is solved; a film 1/8 thick."""
    bodies, surface = Bodies(2.0, Film(0.125, 1.0, 0.3, 2.0, 0.3)), HeightMap(STRIPS, (2.0, 8.0))
    alone, period = of_map(surface, bodies, 2), of_map(replace(surface, periodic=True), bodies, 2)
    assert alone["points_in_film"] == period["points_in_film"] == pytest.approx(0.125 / (2 * 0.25))
