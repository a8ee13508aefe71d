"""Adhesive contact of maps: a sphere around one axis, finer maps, long range, no adhesion, and the least energy."""

import math

import numpy as np
import pytest
from test_rough_maps import UNIT, rough

from refusals import refusal
from stiction.solvers.boundary_elements import adhesive
from stiction.solvers.boundary_elements.adhesive import solve_adhesive
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.descent import DescentSearch
from stiction.solvers.boundary_elements.solve import solve_map


def sphere(count):
    step = (np.arange(count) - count // 2) / count
    return -(step[:, None] ** 2 + step**2) / 2.0


WORK = 2.0 * 0.15**3 / (9.0 * math.pi)  # 0.15: radius without load (Johnson, Kendall & Roberts), R = E* = 1
REACH = (WORK**2 / 3.0**3) ** (1.0 / 3.0)  # Tabor's parameter 3
PULL = 1.5 * math.pi * WORK


def test_a_sphere_on_the_way_to_johnson_kendall_roberts():
    """Largest pull 1.0276 and radii .973, .898, .820 over those of Johnson, Kendall & Roberts (1971) at loads 0, -.4, -.7 of
    their largest pull: by rings of pressure around one axis, of the same attraction, 13 points at the edge (1.0276 with 20)."""
    loads = np.array([0.0, -0.4, -0.7, -0.9, -1.0, -1.02, -1.04, -1.1])
    found = solve_adhesive(sphere(128), UNIT, modulus=1.0, loads=loads * PULL, work=WORK, reach=REACH)
    for contact, radius in zip(found, (0.973, 0.898, 0.820), strict=False):
        assert math.sqrt(contact.area / math.pi) == pytest.approx(0.15 * radius, rel=0.005)
        assert not contact.validity_warnings and contact.points_at_edge >= 2.0
        assert contact.pressure.mean() == pytest.approx(contact.load, abs=1e-9 * PULL)
    assert [contact.detached for contact in found] == [False] * 6 + [True] * 2
    assert found[7].area == 0.0 and found[7].mean_gap == math.inf


def test_a_map_too_coarse_for_the_edge_has_a_warning():
    (found,) = solve_adhesive(sphere(64), UNIT, modulus=1.0, loads=[0.0], work=WORK, reach=REACH)
    assert {warning.quantity for warning in found.validity_warnings} == {"points_at_edge"}
    assert found.points_at_edge == pytest.approx(64 * REACH**2 / WORK, rel=1e-12)


def test_once_apart_faces_stay_apart_until_they_are_pressed():
    loads = [0.0, -1.3 * PULL, -0.3 * PULL, 0.0, 0.5 * PULL]
    found = solve_adhesive(sphere(64), UNIT, modulus=1.0, loads=[2.0 * load for load in loads], work=WORK, reach=REACH)
    assert [contact.detached for contact in found] == [False, True, True, True, False]


def refined(heights, times):
    """The same waves on a grid so many times as fine."""
    count = len(heights)
    waves, padded = np.fft.fft2(heights), np.zeros((times * count, times * count), dtype=complex)
    order = np.fft.fftfreq(count, 1.0 / count).astype(int)
    padded[np.ix_(order, order)] = np.where((np.abs(order)[:, None] < count // 2) & (np.abs(order) < count // 2), waves, 0.0)
    return np.fft.ifft2(padded).real * times**2


@pytest.mark.parametrize(("work", "points"), [(3e-6, 2.0), (3e-5, 2.0), (3e-5, 5.0)])
def test_areas_are_those_of_finer_maps(work, points):
    """8 points in the shortest wave, against 16 and 32, whose counted areas are extrapolated in the distance of points."""
    heights = rough(64, slope=0.1, seed=418)
    how = {"modulus": 1.0, "loads": [1e-2, 3e-3], "work": work, "reach": math.sqrt(points / 64.0 * work)}
    coarse, fine, finest = (solve_adhesive(refined(heights, times), UNIT, **how) for times in (1, 2, 4))
    for one, two, four in zip(coarse, fine, finest, strict=True):
        limit = 2.0 * four.area_pixels - two.area_pixels
        assert one.area == pytest.approx(limit, rel=0.015)
        assert one.area_pixels > 1.02 * limit
        assert two.area == pytest.approx(limit, rel=0.01) and four.area == pytest.approx(limit, rel=0.01)


def test_long_range_adds_to_the_load():
    """Attraction that is the same everywhere: the contact without adhesion, under the load and the attraction."""
    heights = rough(64)
    reach = 100.0 * float(np.ptp(heights))
    (found,) = solve_adhesive(heights, UNIT, modulus=1.0, loads=[5e-4], work=1e-3 * reach, reach=reach)
    assert found.attraction == pytest.approx(1e-3, rel=0.02)
    (same,) = solve_map(heights, UNIT, modulus=1.0, loads=[5e-4 + found.attraction], periodic=True)
    assert found.area_pixels == pytest.approx(same.area_pixels, abs=4.0 / 64**2)
    assert found.area == pytest.approx(same.area, abs=4.0 / 64**2)
    assert found.mean_gap == pytest.approx(same.mean_gap, rel=0.002)


@pytest.mark.parametrize("film", [None, Film(0.02, 0.2, 0.45, 5.0, 0.3)])
def test_no_adhesion_is_the_contact_without(film):
    heights = rough(64)
    (found,) = solve_adhesive(heights, UNIT, modulus=1.0, loads=[1e-3], work=1e-9, reach=1e-3, film=film)
    (plain,) = solve_map(heights, UNIT, modulus=1.0, loads=[1e-3], periodic=True, film=film)
    assert found.mean_gap == pytest.approx(plain.mean_gap, rel=1e-3)
    assert np.maximum(found.pressure, 0.0) == pytest.approx(plain.pressure, abs=0.02 * plain.pressure.max())


def test_no_change_of_the_gaps_lowers_the_energy():
    """Energy of elasticity, attraction and load, summed here, of gaps that the solution leaves to each side."""
    heights = rough(32, points=4.0)
    modulus, work, reach, load = 2.0, 1e-4, 2e-3, 1e-3
    faces = adhesive._faces(heights, UNIT, Compliance(modulus), work, reach)
    way = DescentSearch(faces, np.full(heights.shape, 0.5), load * reach / work)
    way.run(1e-7)
    k = 2.0 * math.pi * np.hypot(*np.meshgrid(*(np.fft.fftfreq(32, 1.0 / 32),) * 2))

    def energy(gap):
        raised = gap + heights
        elastic = np.fft.ifft2(0.5 * modulus * k * np.fft.fft2(raised)).real
        return float(np.mean(0.5 * raised * elastic - work * np.exp(-gap / reach) + load * gap))

    gap, draw = way.gap * reach, np.random.default_rng(2)
    assert 10 < np.count_nonzero(gap == 0.0) < 900
    for _ in range(20):
        other = np.maximum(gap + 1e-4 * reach * draw.normal(size=gap.shape), 0.0)
        assert energy(other) > energy(gap)


def test_drawing_apart_holds_on_longer_than_pressing_together():
    """The same small load, come to from above and from no contact: adhesion keeps what touched."""
    heights = rough(64, slope=0.05)
    how = {"modulus": 1.0, "work": 3e-6, "reach": 1e-3}
    pressed = solve_adhesive(heights, UNIT, loads=[1e-2, 1e-4], **how)
    (first,) = solve_adhesive(heights, UNIT, loads=[1e-4], **how)
    assert pressed[1].area >= first.area > 0.0
    assert pressed[0].area > pressed[1].area


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("work", {"work": 0.0}),
        ("reach", {"reach": math.nan}),
        ("loads", {"loads": [math.inf]}),
        ("loads", {"loads": []}),
        ("film.substrate_modulus", {"modulus": math.inf, "film": Film(0.1, 1.0, 0.3, math.inf, 0.3)}),
    ],
)
def test_what_cannot_be_is_refused(name, changes):
    good = {"modulus": 1.0, "loads": [1e-3], "work": 1e-5, "reach": 1e-3}
    with refusal(name):
        solve_adhesive(rough(32, points=4.0), UNIT, **{**good, **changes})
