"""Persson's area widened to that of solved maps: limits, the formula by itself, and a scan that is solved."""

import math

import numpy as np
import pytest

import stiction as st
from refusals import outside, refusal
from stiction.contact.indices import Groups, Indices
from stiction.laws.rough_surface import persson_2001, persson_widened
from stiction.solvers.boundary_elements.map_area import map_area
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces.generate import gaussian_surface, with_slope
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import SelfAffine
from stiction.surfaces.theory.moments import bandwidth, density_of_bandwidth, slope_over_sharpness
from tables import read

SIDE = 10e-6
SOFT = {"youngs_modulus": "2 GPa", "poissons_ratio": 0.3, "hardness": "40 MPa"}
STIFF = {"youngs_modulus": "1e9 GPa", "poissons_ratio": 0.3, "hardness": "1e9 GPa"}


def groups(density, hardness=1e9):
    """Hardness over E* h'."""
    eta = hardness * 0.75 * math.pi * slope_over_sharpness(density)
    return Groups.of(Indices(hardness_group=eta, roughness_parameter=density, sharpness=0.1))[0]


def share(pressure, density, hardness=1e9, law=persson_widened):
    """A/A0 at a pressure over E* h'."""
    load = pressure * slope_over_sharpness(density) / (4.0 / 3.0 * density)
    return law.area_at_load(np.array([[load]]), groups(density, hardness)).item() * math.pi * density


def test_the_formula():
    """By mpmath, in more digits."""
    for row in read("persson_widened.csv"):
        pressure, alpha, hardness, area = (float(row[name]) for name in ("pressure", "alpha", "hardness", "area"))
        density = float(density_of_bandwidth(alpha))
        assert bandwidth(density) == pytest.approx(alpha, rel=1e-12)
        assert share(pressure, density, hardness or 1e12) == pytest.approx(area, rel=1e-9)


def test_light_load_is_between_persson_and_bush_gibson_thomas():
    """kappa = A E* h'/P: 1.60 of Persson (2001), 2.51 of Bush, Gibson & Thomas (1975); solved maps lie between."""
    kappa = share(1e-6, 0.05) / 1e-6
    assert math.sqrt(8.0 / math.pi) < kappa < math.sqrt(2.0 * math.pi)


def test_heavy_loads_meet_persson():
    for pressure in (1.5, 3.0):
        assert share(pressure, 0.05) == pytest.approx(share(pressure, 0.05, law=persson_2001), rel=2e-3)


def test_soft_bodies_bear_their_hardness():
    assert share(0.01, 0.05, hardness=0.012) == pytest.approx(0.01 / 0.012, rel=1e-3)
    assert share(0.02, 0.05, hardness=0.012) == 1.0
    elastic = share(0.05, 0.05)
    assert share(0.05, 0.05, hardness=0.2) == pytest.approx((elastic**3.5 + 0.25**3.5) ** (1.0 / 3.5), rel=1e-9)


def test_nothing_touches_without_load():
    none = persson_widened.area_at_load(np.array([[-1.0, 0.0]]), groups(0.05))
    assert none.tolist() == [[0.0, 0.0]]


@pytest.fixture(scope="module")
def worn():
    """One period of a worn surface, where moments alone are far off."""
    spectrum = SelfAffine(hurst=0.8, rolloff=SIDE / 6.0, shortest=SIDE / 16.0, deviation=1e-8)
    surface = gaussian_surface((128, 128), (SIDE, SIDE), spectrum, seed=3)
    z = surface.heights / surface.heights.std()
    worn = with_slope(surface.with_heights(np.minimum(z, 0.7) * 1e-8, "cut"), 0.05)
    return HeightMap(worn.heights, worn.size, periodic=True)


def contact(roughness):
    return st.Contact(
        first=SOFT, second=STIFF, roughness=roughness, work_of_adhesion=0, nominal_area=SIDE**2,
        interfacial_shear_strength="5 MPa",
    )  # fmt: skip


def test_a_scan_is_solved(worn):
    loads = np.array([2e-5, 2e-4])
    one = contact(worn)
    data = st.solve(one, load=loads, model="persson_widened")
    solved = solve_map(
        worn.heights, worn.size, modulus=one.contact_modulus, loads=loads, periodic=True, hardness=40e6, stiffness=False
    )
    assert data["contact_area"].values == pytest.approx(solved.array("area"), rel=0.03)
    assert data["friction_force"].values == pytest.approx(5e6 * data["contact_area"].values, rel=1e-9)
    assert data.attrs["area_by"] == persson_widened.WAYS["solution"]
    by_numbers = st.solve(one.as_numbers().with_surface_moments(), load=loads, model="persson_widened")
    assert by_numbers["contact_area"].values[0] < 0.5 * solved[0].area


def test_numbers_say_that_they_are(worn):
    roughness = st.Roughness(asperity_height_deviation="20 nm", asperity_radius="2 um", asperity_density="2e12 1/m^2")
    data = st.solve(contact(roughness), load="10 uN", model="persson_widened")
    assert data.attrs["area_by"] == persson_widened.WAYS["moments"]
    with refusal("separation", "1 nm", "persson_widened"):
        st.solve(contact(worn), separation="1 nm", model="persson_widened")


def test_across_a_lay_and_just_where_fewer_points_begin_to_do():
    """Patches are narrower than waves there: every second point, 4 in the shortest wave, would give 5 to 10 % too much."""
    target = SelfAffine(0.6, SIDE / 6.0, SIDE / 32.0, 20e-9)
    laid = gaussian_surface((256, 256), (SIDE, SIDE), target, seed=4, stretch=6.0)
    area, slope = map_area(laid), map_area(laid).slopes.gradient
    pressures = np.array([0.03, 0.06]) * slope
    solved = solve_map(laid.heights, laid.size, modulus=1.0, loads=list(pressures * SIDE**2), periodic=True)
    assert area.slopes.lay > 3.0
    assert area.share(pressures, math.inf) == pytest.approx(solved.array("area") / SIDE**2, rel=0.02)


def on_scan(size, shortest, **how):
    side = 20e-6
    surface = gaussian_surface((size, size), (side, side), SelfAffine(0.8, side / 8, shortest, 30e-9), seed=1)
    contact = st.Contact(
        first="hardened_steel_52100", second="silicon_nitride", roughness=surface,
        interfacial_shear_strength="300 MPa", nominal_area="1 mm^2", **how,
    )  # fmt: skip
    model = "rough_on_film" if how else "persson_widened"
    return st.solve(contact, load="30 N", model=model)


@pytest.mark.parametrize("film", ({}, {"coating": {"material": "silver", "thickness": "300 nm", "bodies": "first"}}))
def test_a_map_that_is_not_resolved_has_a_warning(film):
    """Three points in the shortest wave are too few, six are not."""
    assert "points_in_shortest_wave" in outside(on_scan(64, 20e-6 / 21, **film))
    assert "points_in_shortest_wave" not in outside(on_scan(64, 20e-6 / 10, **film))


def test_a_soft_map_bears_its_hardness():
    """A = P/H, the pressure of every point in contact being the hardness: the elastic area is a small part of it."""
    surface = gaussian_surface((64, 64), (20e-6, 20e-6), SelfAffine(0.8, 5e-6, 2.5e-6, 1e-7), 3)
    soft = {"youngs_modulus": 200e9, "poissons_ratio": 0.3, "hardness": 20e6}
    contact = st.Contact(first=soft, second=soft, roughness=surface, nominal_area=400e-12)
    found = st.solve(contact, load=0.1 * 20e6 * 400e-12, model="persson_widened")
    assert float(found["area_fraction"]) == pytest.approx(0.1, rel=0.03)
