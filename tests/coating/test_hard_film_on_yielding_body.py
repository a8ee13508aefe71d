"""A hard film on a body that yields: spots bear no more than the body carries through it.

.1 um of a-C:H on 304 steel had a mean pressure of 1.7 to 3.9 times the hardness of the steel, without a warning.
"""

import math

import numpy as np
import pytest

import stiction as st
from stiction.contact.layered.below import carried_at_depth
from stiction.laws.validity import doubts_of

STEEL = st.material("stainless_steel_304").hardness  # [Pa]


def contact(thickness):
    coating = {"material": "hydrogenated_amorphous_carbon", "thickness": thickness, "bodies": "first"}
    return st.Contact(
        first="stainless_steel_304", second="alumina", nominal_area="1 mm^2", interfacial_shear_strength="50 MPa",
        roughness={"asperity_height_deviation": "50 nm", "asperity_radius": "20 um", "asperity_density": "4e10 1/m^2"},
        coating=coating,
    )  # fmt: skip


def pressure_of(found):
    return float(found["load"] / found["contact_area"]) / STEEL


def test_stresses_on_the_axis_by_hand():
    """At z = a and nu = 0.3: sigma_z = -1/2, sigma_r = 1/4 - 1.3 (1 - pi/4), von Mises .47101; .6200 at .481 a is the largest
    (Johnson 1985, section 4.2). Thin films leave the hardness of the body."""
    at_radius = 0.75 - 1.3 * (1.0 - math.pi / 4.0)
    assert at_radius == pytest.approx(0.47101, abs=1e-5)
    assert carried_at_depth(np.array(1.0), np.array(0.3)) == pytest.approx(0.6200 / at_radius, rel=1e-3)
    assert carried_at_depth(np.array([0.0, 0.2, 0.45]), np.array(0.3)) == pytest.approx(1.0, abs=1e-12)
    deep = carried_at_depth(np.array([2.0, 4.0, 8.0]), np.array(0.3))
    assert (np.diff(deep) > 0.0).all() and deep[-1] > 20.0


def test_a_thin_hard_film_bears_what_the_steel_bears():
    thin = st.solve(contact("0.1 um"), load="1 N", model="rough_on_film")
    assert 0.85 < pressure_of(thin) <= 1.0
    assert float(thin["friction_coefficient"]) >= 50e6 / STEEL
    assert "the body below yields" in thin.attrs["outside_validity"]


def test_a_thick_hard_film_bears_more():
    """It is elastic there: Persson's mean pressure, above the hardness of the steel."""
    pressures = [pressure_of(st.solve(contact(t), load="1 N", model="rough_on_film")) for t in ("0.1 um", "0.4 um", "2 um")]
    assert pressures[0] < pressures[1] < pressures[2] and pressures[2] > 1.4
    thick = st.solve(contact("10 um"), load="1 N", model="rough_on_film")
    assert "pressure_over_body_below" not in {one.quantity for one in doubts_of(thick)}


def test_it_is_continuous_in_the_thickness():
    mu = [
        float(st.solve(contact(t), load="1 N", model="rough_on_film")["friction_coefficient"])
        for t in (3.0e-7, 3.06e-7, 3.12e-7)
    ]
    assert np.abs(np.diff(np.log(mu))).max() < 0.04


def test_models_that_leave_the_body_elastic_lose_weight():
    data = st.compare(contact("0.1 um"), load="1 N")
    best = data.sel(model=data.attrs["recommended"])
    assert 50e6 / STEEL * 0.99 <= float(best["friction_coefficient_at_load"]) < 0.06
    assert "the body below yields" in data.attrs["reason"]
    for model in ("halling_1979", "jackson_green_2005 + layered"):
        assert float(data["cost"].sel(model=model)) > float(best["cost"]) + 1.5
