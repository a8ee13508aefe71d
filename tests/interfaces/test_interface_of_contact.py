"""A contact that states the state of its interface: medians as strengths, refusals, case files."""

import json
import tomllib

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.case.case_tables import json_schema
from stiction.case.read import parse_case
from stiction.case.text import as_toml
from stiction.contact.interfaces import Interface, interface
from stiction.quantities.errors import InputError
from stiction.studies.sensitivity.log_sensitivities import log_sensitivities

ROUGHNESS = {"asperity_height_deviation": "0.2 um", "asperity_radius": "20 um", "asperity_density": "1e10 1/m^2"}
STEEL = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": "3 GPa", "material_class": "metal"}
SOFTER = STEEL | {"hardness": "2 GPa", "youngs_modulus": "100 GPa"}
LAWS = {"model": "greenwood_williamson_1966", "load": "1 N"}


def contact(**more) -> st.Contact:
    return st.Contact(**{"first": STEEL, "second": SOFTER, "roughness": ROUGHNESS, "nominal_area": "1 mm^2"} | more)


def friction(**more) -> float:
    given, laws = {}, {}
    for name, value in more.items():
        (laws if name == "tangential" else given)[name] = value
    return float(st.solve(contact(**given), **LAWS, **laws).friction_coefficient)


# State, and tau_0 [Pa] and alpha by hand: the medians that docs/interfaces.md prints, times 2 GPa of the softer body.
@pytest.mark.parametrize(
    ("state", "strength", "slope"),
    [("oxidised metal", 0.178 * 2e9, None), ("clean metal", 0.2045 * 2e9, None), ("boundary lubricant", 5e6, 0.12)],
)
def test_the_median_of_the_state_is_the_strength(state, strength, slope):
    stated = {"interfacial_shear_strength": strength} | ({"pressure_coefficient": slope} if slope else {})
    for order in ({}, {"first": SOFTER, "second": STEEL}):
        assert friction(interface=state, **order) == pytest.approx(friction(**stated, **order), rel=1e-14)
    assert contact(interface=state).interface_at() == (pytest.approx(strength), slope)


def test_of_a_coated_body_the_film_counts_and_the_softer_of_what_meets():
    for hardness, softer in (("0.5 GPa", 0.5e9), ("8 GPa", 2e9)):
        film = st.material("silver", hardness=hardness)
        coated = {"coating": {"material": film, "thickness": "2 um", "bodies": "first"}}
        said = {"interface": "soft-metal film"}, {"interfacial_shear_strength": 0.15 * softer}
        groups = [contact(**coated, **one).indices() for one in said]
        assert groups[0].shear_strength == pytest.approx(groups[1].shear_strength, rel=1e-14)
        assert contact(**coated).touching == (film, contact().second)


def test_hardness_that_depends_on_the_size_is_that_of_asperities():
    small = SOFTER | {"characteristic_depth": "1 um"}
    taken = contact(second=small, interface="oxidised metal").interface_at()[0]
    assert taken > 1.02 * 0.178 * 2e9
    assert contact(second=small, interface="oxidised metal").indices().shear_strength == pytest.approx(0.178)


def test_a_strength_over_shear_modulus_is_over_that_of_the_softer_body():
    state = {"strength_over_shear_modulus": 1e-3}
    assert contact(interface=state).interface_at()[0] == pytest.approx(1e-3 * 100e9 / 2.6)


def test_a_state_stronger_than_the_bodies_is_capped_as_a_stated_strength_is():
    own = Interface(name="welded", shear_strength=0.5)
    assert friction(interface=own) == pytest.approx(friction(interfacial_shear_strength=0.5 * 2e9), rel=1e-14)
    assert contact(interface=own).interface_strength == pytest.approx(2e9 / (3**0.5 * 2.8))


def test_quantiles_of_the_state_and_of_a_stated_number():
    state = {"interfacial_shear_strength": "5 MPa", "range": {"interfacial_shear_strength": ["1 MPa", "25 MPa"]}}
    strengths, slope = contact(interface=state).interface_at(np.array([0.05, 0.5, 0.95]))
    np.testing.assert_allclose(strengths, [1e6, 5e6, 25e6], rtol=1e-12)
    assert slope is None
    assert contact(interfacial_shear_strength="3 MPa").interface_at(0.9) == (3e6, None)
    assert contact().interface_at() == (None, None)


def test_a_strength_that_is_swept_in_an_own_state():
    swept = st.axis("interfacial_shear_strength", ["5 MPa", "10 MPa"])
    found = st.solve(contact(interface={"interfacial_shear_strength": swept}), **LAWS).friction_coefficient
    assert float(found.squeeze()[1] / found.squeeze()[0]) == pytest.approx(2.0)


def test_compare_and_solve_take_it_alone():
    table = st.compare(contact(interface="oxidised metal"), load="1 N")
    stated = st.compare(contact(interfacial_shear_strength=0.178 * 2e9), load="1 N")
    assert np.isfinite(table.friction_coefficient).sum() > 5
    np.testing.assert_allclose(table.friction_coefficient, stated.friction_coefficient, rtol=1e-13)


@pytest.mark.parametrize(("name", "value"), [("interfacial_shear_strength", "5 MPa"), ("pressure_coefficient", 0.1)])
def test_a_state_and_a_number_are_refused_together(name, value):
    with refusal("interface", "oxidised metal", name):
        contact(interface="oxidised metal", **{name: value})


def test_a_state_that_the_bodies_do_not_allow_is_refused_with_those_that_they_allow():
    with pytest.raises(InputError) as refused:
        contact(interface="ice")
    words = str(refused.value)
    assert words.startswith("interface: 'ice'; allowed: ") and "\n" not in words
    assert "oxidised metal" in words and not {"elastomer", "soft-metal film"} & set(words.split(", "))
    film = {"material": "TiN", "thickness": "2 um", "bodies": "first"}
    assert contact(interface="ceramic", coating=film)
    with refusal("interface", "clean metal", "titanium_nitride"):
        contact(interface="clean metal", coating=film | {"bodies": "both"})
    with refusal("interface", "oxidized metal", "oxidised metal"):
        contact(interface="oxidized metal")
    with refusal("interface", "3", "oxidised metal"):
        contact(interface=3)


def test_it_is_never_ignored_in_silence():
    with refusal("interface", "oxidised metal", "soft_coating_2015"):
        st.solve(contact(interface="oxidised metal", work_of_adhesion="0.1 J/m^2"), load="1 N")
    lubricated = contact(interface="boundary lubricant")
    told = json.loads(st.solve(lubricated, tangential="bowden_tabor_1943", **LAWS).attrs["unused_inputs"])
    assert {row["input"]: row["laws"] for row in told}["interface.pressure_coefficient"] == {
        "tangential": ["briscoe_tabor_1978"]
    }


CASE = """
[contact]
first = "iron"
second = "iron"
nominal_area = "1 mm^2"
interface = {state}
roughness = {{ asperity_height_deviation = "0.2 um", asperity_radius = "20 um", asperity_density = "1e10 1/m^2" }}

[solve]
load = "1 N"
model = "greenwood_williamson_1966"
"""
OWN = (
    '{ interfacial_shear_strength = "5 MPa", range = { interfacial_shear_strength = ["1 MPa", "9 MPa"] }, '
    'source = { interfacial_shear_strength = "5 +/- 1 MPa by our own pull test" } }'
)


@pytest.mark.parametrize(("state", "median"), [('"oxidised metal"', None), (OWN, 5e6)])
def test_a_case_states_it_and_keeps_it_in_its_text(state, median):
    tables = tomllib.loads(CASE.format(state=state))
    case = parse_case(tables)
    assert median is None or case.subject.interface_at()[0] == median
    assert parse_case(tomllib.loads(as_toml(tables))).subject.interface == case.subject.interface
    assert case.subject.replace(nominal_area="2 mm^2").interface == case.subject.interface


def test_errors_of_a_case_name_the_field():
    for state, words in (
        ('"elastomer"', "contact.interface: 'elastomer'; allowed: "),
        ("{ interfacial_shear_strength = 5 }", "contact.interface.interfacial_shear_strength: 5; allowed: text with a unit"),
        ('{ shear_strength = 0.1, interfacial_shear_strength = "5 MPa" }', "contact.interface"),
        ("{ strength = 0.1 }", "contact.interface.strength: unknown key; allowed: "),
    ):
        with pytest.raises(InputError) as refused:
            parse_case(tomllib.loads(CASE.format(state=state)))
        assert str(refused.value).startswith(words)


def test_the_json_schema_takes_a_name_or_a_table():
    definitions = json_schema()["$defs"]
    assert definitions["Contact"]["properties"]["interface"]["anyOf"] == [{"type": "string"}, {"$ref": "#/$defs/Interface"}]
    assert {"interfacial_shear_strength", "range", "source", "grade"} <= definitions["Interface"]["properties"].keys()


def test_mu_is_proportional_to_the_median_of_a_state_by_its_elasticities():
    """An elastic area knows no hardness, and an oxide's strength is a share of it."""
    elastic = CASE.format(state='"oxidised metal"').replace('"0.2 um"', '"5 nm"').replace('"1 N"', '"0.01 N"')
    case = parse_case(tomllib.loads(elastic))
    found = log_sensitivities(case, case.choice)
    slopes = dict(zip(found.names, found.tables["friction_coefficient"].ravel(), strict=True))
    assert slopes["first.hardness"] + slopes["second.hardness"] == pytest.approx(1.0, abs=1e-6)


def test_a_state_that_is_changed_loses_what_was_said_of_the_number():
    changed = interface("boundary lubricant").replace(pressure_coefficient=0.5)
    assert changed.pressure_coefficient == 0.5 and changed.range.keys() == changed.source.keys() == changed.grade.keys()
    assert changed.range.keys() == {"interfacial_shear_strength"}


def predicted(**interface):
    tables = {"first": STEEL, "second": SOFTER, "roughness": ROUGHNESS, "nominal_area": "1 mm^2", "interface": interface}
    found = st.predict({"contact": tables, "solve": {"load": ["1 N"]}})
    return np.array([found[f"friction_coefficient{end}"].values.ravel() for end in ("", "_low", "_high")])


@pytest.mark.parametrize(
    ("name", "values", "more"),
    [
        ("interfacial_shear_strength", ["50 MPa", "200 MPa"], {}),
        ("shear_strength", [0.01, 0.1], {"pressure_coefficient": 0.1}),
        ("pressure_coefficient", [0.0, 0.1, 0.3], {"strength_over_shear_modulus": 1e-3}),
    ],
)
def test_swept_numbers_of_a_stated_interface_are_predicted_one_by_one(name, values, more):
    together = predicted(**{name: values}, **more)
    alone = [predicted(**{name: value}, **more) for value in values]
    np.testing.assert_allclose(together, np.concatenate(alone, axis=1), rtol=1e-12)


def test_uncertain_numbers_of_a_stated_interface_widen_the_interval_by_their_quantiles():
    """Logarithms of independent factors add in quadrature: the strength's, 3.29 log 3, and those of a certain strength."""
    _, low, high = predicted(interfacial_shear_strength="5 MPa")
    certain = np.log(high[0] / low[0])
    _, low, high = predicted(interfacial_shear_strength={"median": "5 MPa", "factor": 3})
    assert np.log(high[0] / low[0]) == pytest.approx(np.hypot(certain, 3.29 * np.log(3.0)), rel=0.08)
    _, low, high = predicted(interfacial_shear_strength="1 MPa", pressure_coefficient={"low": 0.0, "high": 0.5})
    assert float(high[0] - low[0]) == pytest.approx(0.45, rel=0.02)
