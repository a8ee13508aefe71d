"""Persson's theory with a corrected diffusion, and surfaces that attract weakly, against independent solutions and limits.

Tables: reference/make_corrected_diffusion.py.
"""

import json
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import erf

import stiction as st
from refusals import outside, refusal
from stiction.contact.indices import Groups
from stiction.laws.rough_surface import (
    pastewka_robbins_2014_area,
    persson_2001,
    wang_muser_2017,
    xu_zhu_xiao_zhou_2024,
    yang_persson_2008,
)
from stiction.laws.rough_surface.shared.corrected_diffusion import area_share
from stiction.surfaces.theory.moments import reduced_pressure
from tables import column, read

CORRECTED = (yang_persson_2008, wang_muser_2017, xu_zhu_xiao_zhou_2024)
# kappa at light load is Persson's over the root of the rate where nothing touches.
LIGHT = {"yang_persson_2008": 0.45, "wang_muser_2017": 5 / 9, "xu_zhu_xiao_zhou_2024": 0.45}
each = pytest.mark.parametrize("module", CORRECTED, ids=lambda module: module.RECORD.key)


def given(**values) -> Groups:
    """Groups of these, all others 1."""
    arrays = np.broadcast_arrays(*(np.atleast_1d(np.asarray(one, dtype=float)) for one in values.values()))
    ones = {name: np.ones_like(arrays[0]) for name in ("theta", "lam", "nu", "hardness_to_yield", "K_beta")}
    return Groups(**ones | dict(zip(values, arrays, strict=True)))


def share(module, pressure, density=0.04):
    """A/A0 at reduced pressures."""
    load = np.asarray(pressure) / reduced_pressure(1.0, density)
    area = module.area_at_load(np.atleast_2d(load), given(roughness_parameter=density))
    return math.pi * density * area[0]


@each
def test_against_an_independent_solution(module):
    rows = read(f"{module.RECORD.key}.csv")
    for density in (0.02, 0.04, 0.3):  # the area depends on the reduced pressure only
        assert_allclose(share(module, column(rows, "pressure"), density), column(rows, "area"), rtol=1e-12)


@each
def test_light_and_full_contact(module):
    light = np.array([1e-150, 1e-30, 1e-9])
    slope = math.sqrt(8 / math.pi / LIGHT[module.RECORD.key])
    assert_allclose(share(module, light) / light, slope, rtol=1e-6)
    assert share(module, [0.0, -1.0]).tolist() == [0.0, 0.0]
    assert_allclose(share(module, [5.0, 1e3, 1e100]), 1.0, rtol=1e-15)


@each
def test_between_its_bounds(module):
    """More area than Persson's, since the pressure spreads more slowly, less than if it were slowest at all times; and it grows
    with the load."""
    pressure = np.geomspace(1e-6, 5.0, 400)
    found, least = share(module, pressure), share(persson_2001, pressure)
    slowest = {"wang_muser_2017": 5 / 9 - 1 / 54}.get(module.RECORD.key, 0.45)  # (5 - 2 y + 6 y^2)/9 is least at y = 1/6
    assert np.all(found >= least * (1 - 1e-14))
    assert np.all(found <= erf(math.sqrt(2 / slowest) * pressure) * (1 + 1e-14))
    assert np.all(np.diff(found) >= 0)


def test_the_quadrature_is_perssons_at_rate_one():
    """With S = 1 it is erf(sqrt2 x); with S = s everywhere erf(sqrt(2/s) x)."""
    x = np.geomspace(1e-12, 2.0, 60)
    assert_allclose(area_share(x, np.ones_like), erf(math.sqrt(2) * x), rtol=1e-13)


def test_in_units():
    """Area at a load of a contact in SI units, from the gradient of its surface; and friction of its interface."""
    sigma, R, N, E, nu, load, nominal = 48e-9, 50e-6, 1.7e10, 100e9, 0.3, 5.0, 1e-6
    body = {"youngs_modulus": E, "poissons_ratio": nu, "hardness": 1e12}
    rough = {"asperity_height_deviation": sigma, "asperity_radius": R, "asperity_density": N}
    contact = st.Contact(
        first=body,
        second=body,
        roughness=rough,
        nominal_area=nominal,
        interfacial_shear_strength=1e8,
        pressure_coefficient=0.02,
    )
    slope = math.sqrt(math.sqrt(3) / (64 * N * R * R))
    reduced = load / nominal / (E / (2 * (1 - nu * nu)) * slope)
    for module in CORRECTED:
        found = st.solve(contact, load=load, model=module.RECORD.key, tangential="briscoe_tabor_1978")
        assert_allclose(float(found["contact_area"]) / nominal, share(module, [reduced])[0], rtol=1e-12)
        assert_allclose(float(found["friction_force"]), 1e8 * float(found["contact_area"]) + 0.02 * load, rtol=1e-12)


# ---- weak attraction


def test_attraction():
    rows = read("pastewka_robbins_2014_area.csv")
    names = ("theta", "roughness_parameter", "tabor_parameter")
    groups = given(**{name: column(rows, name) for name in names})
    density, reduced = groups.roughness_parameter, column(rows, "reduced_pressure")
    area = pastewka_robbins_2014_area.area_at_load((reduced / reduced_pressure(1.0, density))[:, None], groups)
    assert_allclose(math.pi * density * area[:, 0], column(rows, "area_fraction"), rtol=1e-11)


def test_a_sticky_surface_has_no_area():
    """Of two contacts the one that sticks, by a ratio of 0.213, is impossible; the other is answered."""
    indices = st.Indices(
        theta=st.axis("theta", [1e6, 5.962847939999437]),
        lam=1e9,
        roughness_parameter=0.04,
        tabor_parameter=368.40314986403854,
    )
    found = st.solve(indices, load=1e-4, model="pastewka_robbins_2014_area")
    assert np.isnan(found["contact_area"].values).tolist() == [False, True]
    (sticks,) = (one for one in json.loads(found.attrs["validity_warnings"]) if one["quantity"] == "stickiness_ratio")
    assert sticks["kind"] == "impossible" and sticks["outside"] == 1
    assert sticks["least"] == pytest.approx(0.21305189015310966, rel=1e-12)  # reference/pastewka_robbins_2014.csv


def test_a_sticky_surface_alone_is_refused():
    sticky = given(theta=5.962847939999437, roughness_parameter=0.04, tabor_parameter=368.40314986403854)
    with refusal("tabor_parameter", "0.213", "1"):
        pastewka_robbins_2014_area.area_at_load(np.ones((1, 1)), sticky)


def test_attraction_of_long_range_has_a_warning():
    """The range over (16/3) h'^2/h'', in SI units: 0.0226, and fifty times as much."""
    sigma, R, N, E, w = 48e-9, 50e-6, 1.7e10, 115e9, 1.0
    m4 = 9 * math.pi / (64 * R * R)
    m2 = m4 / (6 * math.pi * math.sqrt(3) * N)
    gap = 16 / 3 * 2 * m2 / math.sqrt(2 * m4 / 3)
    for reach, warned in ((0.09 * gap, False), (0.11 * gap, True)):
        indices = st.Indices(
            theta=4 / 3 * E * sigma**1.5 / (w * math.sqrt(R)),
            lam=1e9,
            roughness_parameter=N * R * sigma,
            tabor_parameter=(R * w * w / (E * E * reach**3)) ** (1 / 3),
        )
        found = st.solve(indices, load=1e-4, model="pastewka_robbins_2014_area")
        assert ("range_over_gap" in outside(found)) is warned
