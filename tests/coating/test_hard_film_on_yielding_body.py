"""A hard film on a body that yields: spots bear no more than the body carries through it.

.1 um of a-C:H on 304 steel had a mean pressure of 1.7 to 3.9 times the hardness of the steel, without a warning.
"""

import math

import numpy as np
import pytest

import stiction as st
from refusals import outside
from stiction.laws.validity import warnings_of
from stiction.solvers.layered.below import carried_at_depth

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
    assert "pressure_over_body_below" in outside(thin)


def test_a_thick_hard_film_bears_more():
    """It is elastic there: Persson's mean pressure, above the hardness of the steel."""
    pressures = [pressure_of(st.solve(contact(t), load="1 N", model="rough_on_film")) for t in ("0.1 um", "0.4 um", "2 um")]
    assert pressures[0] < pressures[1] < pressures[2] and pressures[2] > 1.4
    thick = st.solve(contact("10 um"), load="1 N", model="rough_on_film")
    assert "pressure_over_body_below" not in {one.quantity for one in warnings_of(thick)}


def test_it_is_continuous_in_the_thickness():
    mu = [
        float(st.solve(contact(t), load="1 N", model="rough_on_film")["friction_coefficient"])
        for t in (3.0e-7, 3.06e-7, 3.12e-7)
    ]
    assert np.abs(np.diff(np.log(mu))).max() < 0.04


def punched():
    """A film of .1 um, 15 GPa, on steel of 1.25 GPa that many small asperities press: N R sigma = .0075."""
    return st.Contact(
        first={"youngs_modulus": "193 GPa", "poissons_ratio": 0.29, "hardness": "1.25 GPa"},
        second={"youngs_modulus": "380 GPa", "poissons_ratio": 0.22, "hardness": "20 GPa"},
        coating={
            "material": {"youngs_modulus": "150 GPa", "poissons_ratio": 0.2, "hardness": "15 GPa"},
            "thickness": "0.1 um", "bodies": "first",
        },
        roughness={"asperity_height_deviation": "100 nm", "asperity_radius": "15 um", "asperity_density": "5e9 1/m^2"},
        interfacial_shear_strength="100 MPa", nominal_area="2 mm^2",
    )  # fmt: skip


def test_no_mean_pressure_punches_the_film_through():
    """A plug of radius a that the film's shear strength H_f/(sqrt(3) 2.8) holds along t, over a body that flows at H_b:
    p <= H_b + 2 (t/a) H_f/(sqrt(3) 2.8), by the radius of the mean spot."""
    found = st.solve(punched(), load="2 N", model="jackson_green_2005 + layered")
    pressure, spots = float(found["load"] / found["contact_area"]), float(found["touching_asperities"])
    radius = math.sqrt(float(found["contact_area"]) / spots / math.pi)
    bound = 1.25e9 + 2.0 * (0.1e-6 / radius) * 15e9 / (math.sqrt(3.0) * 2.8)
    assert pressure > 1.1 * bound
    warning = next(one for one in warnings_of(found) if one.quantity == "pressure_over_punching")
    assert warning.kind == "impossible"
    assert warning.most == pytest.approx(pressure / bound, rel=1e-9)


def test_a_counterbody_softer_than_the_film_leaves_the_film_its_strength():
    """What holds the plug is the shear strength of the film, 15 GPa/(sqrt(3) 2.8), also below a counterbody of 5 GPa. By
    that of the counterbody the bound would be 1.25 GPa + 2 (t/a) 1.03 GPa, and a pressure that can be would be excluded."""
    counter = {"youngs_modulus": "380 GPa", "poissons_ratio": 0.22, "hardness": "5 GPa"}
    found = st.solve(punched().replace(second=counter), load="2 N", model="jackson_green_2005 + layered")
    pressure, spots = float(found["load"] / found["contact_area"]), float(found["touching_asperities"])
    plug = 2.0 * 0.1e-6 / math.sqrt(float(found["contact_area"]) / spots / math.pi) / (math.sqrt(3.0) * 2.8)
    validity_warnings = [one for one in warnings_of(found) if one.quantity == "pressure_over_punching"]
    assert 1.25e9 + plug * 5e9 < 0.9 * pressure < pressure < 1.25e9 + plug * 15e9 and not validity_warnings


@pytest.mark.parametrize("hardness", [2e9, 5e9, 9e9])
@pytest.mark.parametrize("load", ["0.5 N", "5 N"])
def test_a_prediction_bears_the_softer_of_counterbody_and_film_and_no_punching(hardness, load):
    """p <= min(H_counter, H_film, H_body + 2 (t/a) tau_film), a of as many spots as a sum of asperities has in touch."""
    counter = {"youngs_modulus": "380 GPa", "poissons_ratio": 0.22, "hardness": hardness}
    contact = punched().replace(second=counter)
    found = st.predict(contact, load=load)
    pressure = float(found["load"] / found["contact_area_low"])
    sums = st.solve(contact, load=load, model="greenwood_williamson_1966", film="layered", tangential="none")
    radius = math.sqrt(float(found["contact_area_low"]) / float(sums["touching_asperities"]) / math.pi)
    assert pressure < 1.001 * min(hardness, 1.25e9 + 2.0 * (0.1e-6 / radius) * 15e9 / (math.sqrt(3.0) * 2.8))
