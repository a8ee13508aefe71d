"""A model whose numbers are outside all sense is named with the reason, not printed as a number."""

import math

import numpy as np
import pytest

import stiction as st
from stiction.laws.validity import warnings_of

ROUGH = {"asperity_height_deviation": 1e-7, "asperity_radius": 3e-7, "asperity_density": 0.02 / 3e-14}


def contact(hardness_over_modulus):
    """E* = E/(2 (1 - nu^2)) of two bodies alike, Y = H/2.8."""
    body = {"youngs_modulus": 1e9, "hardness": hardness_over_modulus * 1e9, "poissons_ratio": 0.3}
    return st.Contact(
        first=body, second=body, nominal_area=1e-6, interfacial_shear_strength=1e7,
        roughness=ROUGH,
    )  # fmt: skip


def strain(hardness_over_modulus):
    """Y/E*."""
    return hardness_over_modulus / 2.8 * 2.0 * (1.0 - 0.3**2)


def test_jackson_and_green_stays_finite_where_its_exponent_has_no_meaning():
    """0.14 exp(23 Y/E*) is 0.14 to 0.2 of the metals it was fitted to and 240 at Y/E* = 0.33: mu was 6e104."""
    given, load = contact(0.5), 50.0
    assert 0.14 * math.exp(23.0 * strain(0.5)) > 200.0
    found = st.solve(given, load=load, model="jackson_green_2005")
    elastic = st.solve(given, load=load, model="greenwood_williamson_1966")
    assert float(found["friction_coefficient"]) == pytest.approx(float(elastic["friction_coefficient"]), rel=0.5)
    said = next(one for one in warnings_of(found) if one.quantity == "yield_strain")
    assert said.kind == "effect" and said.most == pytest.approx(strain(0.5), rel=1e-12)


def test_metals_are_as_printed():
    """Below Y/E* = 0.1 nothing changed, nor is anything said."""
    found = st.solve(contact(0.15), load=1.0, model="jackson_green_2005")
    assert strain(0.15) < 0.1 and "yield_strain" not in {one.quantity for one in warnings_of(found)}


def test_an_area_far_above_the_nominal_one_is_a_failure():
    """Adhesive spheres that overlap a hundredfold: DMT of a soft smooth body."""
    silicone = {"youngs_modulus": 2e5, "poissons_ratio": 0.49, "hardness": 1e5}
    rough = {"asperity_height_deviation": 2e-9, "asperity_radius": 1e-5, "asperity_density": 0.1 / 2e-14}
    given = st.Contact(
        first=silicone, second="soda_lime_glass", roughness=rough, nominal_area=1e-6,
        work_of_adhesion=0.05, interfacial_shear_strength=1e4,
    )  # fmt: skip
    data = st.compare(given, load=1e-3)
    failed = data.sel(model="rough_dmt")
    assert np.isnan(float(failed["friction_coefficient_at_load"]))
    assert "times the nominal area" in str(failed["why_not"].item())
    fractions = data["contact_area_at_load"].values / 1e-6
    assert np.nanmax(fractions) <= 100.0
