"""The sentences of an answer agree with its numbers, and its warnings name what lies outside."""

import re

import numpy as np
import pytest

import stiction as st
from stiction.report.answer import answer_lines, confidence_in

POLYSILICON = {"first": "polysilicon", "second": "polysilicon", "nominal_area": "400 um^2"}
DEPOSITED = {"roughness": {"rms_height": "12 nm", "finish": "as deposited"}}
STOP = {
    "first": "polysilicon",
    "second": {"youngs_modulus": "80 GPa", "poissons_ratio": 0.42, "hardness": "1.5 GPa", "material_class": "soft metal"},
    "interfacial_shear_strength": "270 MPa",
    "nominal_area": "100 um^2",
    "roughness": {
        "asperity_height_deviation": "6 nm", "asperity_radius": "2 um", "asperity_density": "2e12 1/m^2", "kind": "gaussian"
    },
}  # fmt: skip


@pytest.fixture(scope="module")
def monolayer():
    return st.predict({"contact": POLYSILICON | DEPOSITED | {"interface": "monolayer"}, "solve": {"load": "100 uN"}})


@pytest.mark.parametrize("more", [{}, {"work_of_adhesion": "0.3 J/m^2"}])
def test_the_state_names_each_factor_between_the_strength_over_the_pressure_and_mu(more):
    """Of spots that are not all plastic, too: mu was several times tau_0/p, and the sentence said mu = tau_0/p."""
    answer = st.predict({"contact": STOP | more, "solve": {"load": "100 uN"}})
    share = float(re.search(r"p, .* is ([\d.]+)%", answer.regime).group(1)) / 100.0
    plain = 270e6 / (share * 1.5e9)
    mu = answer.friction_coefficient.item()
    assert mu > 1.15 * plain and "growth of junctions under shear" in answer.regime and "before shear" in answer.regime
    assert ("for adhesion" in answer.regime) == bool(more)


def test_a_contact_without_growth_or_pull_is_the_strength_over_the_pressure():
    contact = STOP | {"interfacial_shear_strength": "10 MPa", "second": "polysilicon"}
    answer = st.predict({"contact": contact, "solve": {"load": "100 uN"}})
    share = float(re.search(r"p, .* is ([\d.]+)%", answer.regime).group(1)) / 100.0
    hardness = st.material("polysilicon").hardness
    assert answer.friction_coefficient.item() == pytest.approx(10e6 / (share * hardness), rel=0.08)
    assert answer.regime.startswith("mu = tau_0/p: ")


def test_spots_beyond_the_limit_of_the_interface_are_the_main_warning(monolayer):
    """A monolayer bears 3 GPa; spots of polysilicon, of 11 to 12 GPa, bear more than a third of their hardness."""
    warning = monolayer.warnings[0]
    assert re.fullmatch(r"Contact pressure [\d.]+ GPa exceeds 3 GPa: the interface fails, mu rises\.", warning)
    assert len(warning.split()) <= 12 and dict(answer_lines(monolayer))["warning"] == warning
    soft = {"contact": STOP | {"interface": "monolayer", "first": "silicon", "second": "silicon"}, "solve": {"load": "1 mN"}}
    soft["contact"].pop("interfacial_shear_strength")
    soft["contact"]["roughness"] = STOP["roughness"] | {"asperity_radius": "50 um", "asperity_density": "8e10 1/m^2"}
    assert not any("the interface fails" in text for text in st.predict(soft).warnings)


def test_roughness_is_no_lever_where_friction_is_the_pressure_coefficient(monolayer):
    """There mu = alpha, whatever the contact area."""
    assert monolayer.lowered_by == "a weaker interface (layered solid such as MoS2)"
    ceramic = {"contact": POLYSILICON | DEPOSITED | {"interface": "ceramic"}, "solve": {"load": "1 mN"}}
    assert "rougher" in st.predict(ceramic).lowered_by


def test_few_asperities_and_small_menisci_are_warnings():
    liquid = {"relative_humidity": 0.5, "contact_angle_first": "20 deg", "contact_angle_second": "20 deg"}
    contact = POLYSILICON | DEPOSITED | {"interface": "ceramic", "liquid": liquid}
    answer = st.predict({"contact": contact, "solve": {"load": "100 uN"}})
    few, menisci = answer.warnings[-2:]
    assert re.fullmatch(r"About \d asperities touch: mu varies from one place to the next\.", few)
    assert menisci.startswith("The menisci, 0.7") and max(len(few.split()), len(menisci.split())) <= 12
    assert "for menisci" in answer.regime and "asperities touch" not in answer.regime
    damp = st.predict({"contact": contact | {"liquid": liquid | {"relative_humidity": 0.97}}, "solve": {"load": "100 uN"}})
    assert not any("menisci" in text for text in damp.warnings)


def test_an_oxide_does_not_wear_to_clean_metal_in_air():
    copper = {"first": "copper", "second": "copper", "interface": "oxidised metal", "nominal_area": "1 cm^2"}
    rough = {"roughness": {"rms_height": "0.2 um", "finish": "ground"}}
    assert st.predict({"contact": copper | rough, "solve": {"load": "10 N"}}).bare_metal == []
    greasy = copper | rough | {"interface": "boundary lubricant"}
    assert len(st.predict({"contact": greasy, "solve": {"load": "10 N"}}).bare_metal) == 2


def test_a_measurement_states_its_assumed_error_and_few_values_are_fair_at_most(tmp_path):
    case = {"contact": STOP | {"interfacial_shear_strength": {"low": "50 MPa", "high": "300 MPa"}}, "solve": {"load": "100 uN"}}
    file = tmp_path / "one.csv"
    file.write_text("load [uN],friction_coefficient\n100,0.2\n", encoding="utf-8")
    answer = st.predict(case, measured=file)
    assert "15%" in dict(answer_lines(answer))["its error"] and answer.bare_metal == []
    assert confidence_in(answer) == "fair"
    file.write_text("load [uN],friction_coefficient\n100,0.2\n150,0.21\n200,0.19\n", encoding="utf-8")
    three = st.predict(case, measured=file)
    assert "scatter of 3 values" in three.measured_error
    file.write_text("load [uN],friction_coefficient,friction_coefficient_error\n100,0.2,0.01\n", encoding="utf-8")
    assert st.predict(case, measured=file).measured_error == ""


def test_sources_of_an_answer_are_those_of_its_models_interface_and_laws():
    copper = {"first": "copper", "second": "copper", "interface": "oxidised metal", "nominal_area": "1 cm^2"}
    rough = {"roughness": {"rms_height": "0.2 um", "finish": "ground"}}
    answer = st.predict({"contact": copper | rough, "solve": {"load": "10 N"}})
    cited = st.cite(answer)
    assert all(f"{{{key}," in cited for key in ("wheeler_1976", "tabor_1959", "persson_2001", "greenwood_williamson_1966"))
    assert "maugis_1992" not in cited
    sticky = st.predict({"contact": copper | rough | {"work_of_adhesion": "0.1 J/m^2"}, "solve": {"load": "10 N"}})
    assert "{maugis_1992," in st.cite(sticky)
    swept = st.predict({"contact": copper | rough | {"nominal_area": ["1 cm^2", "2 cm^2"]}, "solve": {"load": "10 N"}})
    assert set(swept.sources.split()) == set(answer.sources.split()) and np.isfinite(swept.friction_coefficient).all()


@pytest.mark.parametrize(("height", "load", "sticks"), [("20 nm", 1.0, True), ("2 um", 1.0, False), ("2 um", 1e-3, True)])
def test_only_a_pull_off_force_above_the_load_is_a_reason_to_use_the_friction_force(height, load, sticks):
    """Adhesion enlarges all three areas more than twice; but a rough surface lets go of its rubber at a few millinewtons."""
    rough = {"rms_height": height, "finish": "polished" if height == "20 nm" else "ground"}
    pair = {"first": "pdms", "second": "soda_lime_glass", "interface": "elastomer", "work_of_adhesion": "0.05 J/m^2"}
    contact = st.Contact(**pair, roughness=rough, nominal_area="1 cm^2")
    answer = st.predict(contact, load=load)
    pull_off = st.solve(contact, load=load, model="soft_coating_2015").pull_off_force.item()
    assert (pull_off > load) is sticks and ("use the friction force, not mu" in answer.regime) is sticks
    assert "less adhesion" in answer.lowered_by and ("pulled flat" in answer.regime) == (height == "20 nm")


def test_an_interface_a_little_stronger_than_the_body_is_not_called_once_as_strong():
    """The softer body, of 1.5 GPa, shears at 1.5 GPa/(2.8 sqrt 3) = 309 MPa."""
    contact = STOP | {"interfacial_shear_strength": "320 MPa"}
    warnings = st.predict({"contact": contact, "solve": {"load": "100 uN"}}).warnings
    assert any(re.search(r"is 1\.0\d times as strong as the weaker body, which limits mu", text) for text in warnings), warnings


def test_a_height_that_the_finish_does_not_make_is_the_first_warning():
    """A wrong unit, 200 um in place of 0.2 um, beside ground surfaces with the range of finishes.toml."""
    copper = {"first": "copper", "second": "copper", "interface": "oxidised metal", "nominal_area": "1 cm^2"}
    first = {}
    for height in ("0.2 um", "200 um"):
        warnings = st.predict(st.Contact(**copper, roughness={"rms_height": height, "finish": "ground"}), load="10 N").warnings
        first[height] = next(iter(warnings), "")
    assert first["0.2 um"] == "" and "check unit and finish" in first["200 um"]


def test_a_friction_far_above_all_handbooks_is_said():
    """Worn steel at 0.13 MPa: benchmark plateaus are smooth, and mu is several times that of any oxidised metal."""
    steel = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "interface": "oxidised metal"}
    for finish, far in (("worn", True), ("ground", False)):
        contact = st.Contact(**steel, nominal_area="3 cm^2", roughness={"rms_height": "0.1 um", "finish": finish})
        found = st.predict(contact, load="40 N")
        assert any("far above all 21 handbook contacts" in warning for warning in found.warnings) == far
        assert (found.friction_coefficient.item() > 1.5 * 1.9) == far  # the largest published mu of these contacts is 1.9
