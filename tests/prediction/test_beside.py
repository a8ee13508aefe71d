"""What stands beside a prediction: bare metal, and what it was checked against."""

import re

import numpy as np
import pytest

import stiction as st
from stiction.contact.interfaces import interface_names
from stiction.report.answer import answer_lines, answer_record
from stiction.studies.prediction.beside import published_contacts

ROUGH = {"asperity_height_deviation": 2e-7, "asperity_radius": 2e-5, "asperity_density": 1e10, "kind": "gaussian"}
STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3, "hardness": 1e9, "material_class": "metal"}
GLASS = {"youngs_modulus": 70e9, "poissons_ratio": 0.22, "hardness": 6e9, "material_class": "ceramic"}
TIN = {"material": "titanium_nitride", "thickness": "2 um", "bodies": "first"}


def predicted(second=STEEL, **more):
    contact = st.Contact(first=STEEL, second=second, roughness=ROUGH, nominal_area=1e-4, **more)
    return st.predict(contact, load="10 N")


@pytest.mark.parametrize("more", [{"interface": "boundary lubricant"}, {"interface": "ceramic", "coating": TIN}])
def test_bare_metal_is_the_prediction_of_clean_metal(more):
    """Where all is plastic the prediction with the interface "clean metal" and no film is the same."""
    clean = predicted(interface="clean metal")
    low, high = predicted(**more).attrs["bare_metal"]
    assert low == pytest.approx(clean.friction_coefficient_low.item(), rel=0.05)
    assert high == pytest.approx(clean.friction_coefficient_high.item(), rel=0.05)


def test_nothing_is_said_of_bare_metal_where_none_is_parted_or_met():
    assert predicted(interface="clean metal").attrs["bare_metal"] == []
    assert predicted(st.material("gold"), interface="gold contact").attrs["bare_metal"] == []
    assert predicted(interfacial_shear_strength=1e7).attrs["bare_metal"] == []
    assert predicted(second=GLASS, interface="boundary lubricant").attrs["bare_metal"] == []


def test_what_was_checked_is_said_with_the_contacts_of_the_state():
    stated, number = predicted(interface="oxidised metal"), predicted(interfacial_shear_strength=1e7)
    counted = published_contacts()["oxidised metal"]
    assert f"{counted['held']} of {counted['contacts']} handbook contacts" in stated.attrs["checked_against"]
    assert number.attrs["checked_against"].endswith("never against measured friction")
    assert dict(answer_lines(stated))["checked against"] == stated.attrs["checked_against"]


def test_the_record_has_both():
    record = answer_record(predicted(interface="boundary lubricant"))
    assert np.shape(record["bare_metal"]) == (2,) and "handbook contacts" in record["checked_against"]
    assert answer_record(predicted(interface="clean metal"))["bare_metal"] is None


def test_states_that_were_checked_are_states():
    assert published_contacts().keys() <= set(interface_names())
    assert all(0 <= one["held"] <= one["contacts"] for one in published_contacts().values())


def test_the_checked_area_is_as_wide_as_its_draws():
    """Pointed, elastic and of no kind: the area comes from the model alone, and its interval is the printed factor."""
    body = {"youngs_modulus": 2e9, "poissons_ratio": 0.35, "hardness": 1.2e9, "material_class": "polymer"}
    rough = {"asperity_height_deviation": 1.5e-7, "asperity_radius": 5e-7, "asperity_density": 5e11}
    contact = st.Contact(first=body, second=body, roughness=rough, nominal_area=1e-6, interfacial_shear_strength=1.2e7)
    found = st.predict(contact, load="5 N")
    said = re.search(r"area within a factor of ([0-9.]+)\)", found.attrs["checked_against"])
    assert float(said[1]) == pytest.approx((found.contact_area_high / found.contact_area_low).item() ** 0.5, rel=0.2)
