"""Adhesive contact of maps: the limits of short and long range and of no adhesion, and the gradient of the energy."""

import math

import numpy as np
import pytest
from test_rough_maps import UNIT, rough

from stiction.quantities.errors import InputError
from stiction.surfaces.boundary_elements import adhesive
from stiction.surfaces.boundary_elements.adhesive import solve_adhesive
from stiction.surfaces.boundary_elements.compliance import Compliance, Film
from stiction.surfaces.boundary_elements.solve import solve_map


def sphere(count):
    step = (np.arange(count) - count // 2) / count
    return -(step[:, None] ** 2 + step**2) / 2.0


def test_short_range_is_johnson_kendall_roberts():
    """a^3 = 3R/(4 E*) [P + 3 pi w R + (6 pi w R P + (3 pi w R)^2)^(1/2)], largest pull 3/2 pi w R (Johnson, Kendall & Roberts
    1971); R = E* = 1, Tabor's parameter 3, where the pull is some 5 % larger (Maugis 1992)."""
    work = 2.0 * 0.15**3 / (9.0 * math.pi)
    reach = (work**2 / 3.0**3) ** (1.0 / 3.0)
    pull = 1.5 * math.pi * work
    loads = [0.5 * pull, 0.0, -0.5 * pull, -0.7 * pull, -1.2 * pull]
    found = solve_adhesive(sphere(96), UNIT, modulus=1.0, loads=loads, work=work, reach=reach)
    for load, contact in zip(loads[:4], found, strict=False):
        root = math.sqrt(6.0 * math.pi * work * load + (3.0 * math.pi * work) ** 2)
        radius = (0.75 * (load + 3.0 * math.pi * work + root)) ** (1.0 / 3.0)
        assert math.sqrt(contact.area / math.pi) == pytest.approx(radius, rel=0.05)
        assert not contact.detached and contact.residual < 1e-3
        assert contact.pressure.mean() == pytest.approx(load, abs=1e-9 * pull)
    assert {doubt.name for doubt in found[0].doubts} == {"points_at_edge"}  # and so it is not nearer than 5 %
    assert found[4].detached and found[4].area == 0.0 and found[4].mean_gap == math.inf


def test_long_range_adds_to_the_load():
    """Attraction that is the same everywhere: the contact without adhesion, under the load and the attraction."""
    heights = rough(64)
    reach = 100.0 * float(np.ptp(heights))
    (found,) = solve_adhesive(heights, UNIT, modulus=1.0, loads=[5e-4], work=1e-3 * reach, reach=reach)
    assert found.attraction == pytest.approx(1e-3, rel=0.02)
    (same,) = solve_map(heights, UNIT, modulus=1.0, loads=[5e-4 + found.attraction], periodic=True)
    assert found.area == pytest.approx(same.area_pixels, abs=4.0 / 64**2)
    assert found.mean_gap == pytest.approx(same.mean_gap, rel=0.002)


@pytest.mark.parametrize("film", [None, Film(0.02, 0.2, 0.45, 5.0, 0.3)])
def test_no_adhesion_is_the_contact_without(film):
    heights = rough(64)
    (found,) = solve_adhesive(heights, UNIT, modulus=1.0, loads=[1e-3], work=1e-9, reach=1e-3, film=film)
    (plain,) = solve_map(heights, UNIT, modulus=1.0, loads=[1e-3], periodic=True, film=film)
    assert found.mean_gap == pytest.approx(plain.mean_gap, rel=1e-3)
    assert np.maximum(found.pressure, 0.0) == pytest.approx(plain.pressure, abs=0.02 * plain.pressure.max())


def test_the_pressure_is_the_gradient_of_the_energy():
    heights = rough(32, points=4.0)
    faces = adhesive._faces(heights, UNIT, Compliance(2.0), 1e-4, 2e-3)
    draw = np.random.default_rng(2)
    gap, way = draw.exponential(1.0, 1024), draw.normal(size=1024)
    slope = float(faces.energy(gap, 0.7)[1] @ way)
    ahead, behind = (faces.energy(gap + step * way, 0.7)[0] for step in (1e-5, -1e-5))
    assert slope == pytest.approx((ahead - behind) / 2e-5, rel=1e-6)


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
    with pytest.raises(InputError, match=name):
        solve_adhesive(rough(32, points=4.0), UNIT, **{**good, **changes})
