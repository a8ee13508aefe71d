"""States of an interface: numbers of printed sources, quantiles, and the pairs that allow them."""

import json
import re
from itertools import combinations_with_replacement

import numpy as np
import pytest
from scipy import stats
from typer.testing import CliRunner

import stiction as st
from refusals import refusal
from stiction import cli
from stiction.contact.interfaces import Interface, interface, interface_names, interface_weights, interfaces
from stiction.contact.materials import MATERIAL_CLASSES, class_of, material, material_names
from stiction.quantities.data_files import GRADES
from stiction.quantities.errors import InputError
from stiction.records.sources import bibliography

STATES = {
    "clean metal", "oxidised metal", "boundary lubricant", "monolayer", "dry polymer", "elastomer", "ceramic",
    "soft-metal film", "layered solid", "DLC dry", "DLC humid", "ice", "gold contact", "PTFE",
}  # fmt: skip


def of_class(name):
    return st.Material(youngs_modulus="100 GPa", poissons_ratio=0.3, hardness="1 GPa", material_class=name)


def test_every_state_has_numbers_with_range_source_and_grade():
    assert set(interface_names()) == STATES
    for name in interface_names():
        state = interface(name)
        numbers = {state.strength} | ({"pressure_coefficient"} if state.pressure_coefficient is not None else set())
        limit = {"pressure_limit"} if state.pressure_limit is not None else set()
        assert set(state.range) == numbers and set(state.source) == set(state.grade) == numbers | limit, name
        assert state.not_for.endswith(".") and state.pairs, name
        for number in numbers:
            low, high = state.range[number]
            assert 0 < low < getattr(state, number) < high < 101 * low, (name, number)


def test_sources_are_in_the_bibliography_and_what_is_from_memory_is_grade_c():
    for name in interface_names():
        state = interface(name)
        for number, text in state.source.items():
            keys = set(re.findall(r"\[(\w+)\]", text))
            assert keys <= bibliography().keys(), (name, number)
            assert state.grade[number] == "C" or keys or "Tresca" in text, (name, number)
            assert (state.grade[number] == "C") == text.startswith("from memory"), (name, number)
            assert state.grade[number] != "A" or "memory" not in text, (name, number)


# State, number, and what its sources print: each within the 5 and 95 % quantiles.
PRINTED = [
    ("layered solid", "interfacial_shear_strength", (24.3e6, 25.3e6)),  # Singer et al. 1990: 24.8 +/- 0.5 MPa
    ("layered solid", "interfacial_shear_strength", (62e6,)),  # Wang et al. 2024, AB-stacked graphite
    ("layered solid", "pressure_coefficient", (0.002,)),  # Singer et al. 1990: at most 0.001 + 0.001
    ("ice", "interfacial_shear_strength", (0.28e6, 0.53e6, 0.78e6)),  # ice on aluminium, AIP Advances 9:055304
    # Friction 2.2 of copper in vacuum by Tabor's growth, mu = c/3 (1 - c^2)^(-1/2), and Mises with H = 2.8 Y.
    ("clean metal", "shear_strength", (6.6 / (1 + 6.6**2) ** 0.5 / (2.8 * 3**0.5), 1 / (2.8 * 3**0.5))),
    ("oxidised metal", "shear_strength", (0.835 / 6, 0.835 / (2.8 * 3**0.5))),  # Wheeler 1976
    ("gold contact", "shear_strength", (134 / 1300, 139 / 1300)),  # Zhu et al. 2009
    ("soft-metal film", "shear_strength", (0.1, 0.2)),  # Kato and Adachi 2000: friction of Au, Ag, Pb and In films
    ("boundary lubricant", "pressure_coefficient", (0.05, 0.08, 0.09, 0.115, 0.14, 0.2)),  # Cd, Cu, ZDDP, iron
    ("monolayer", "pressure_coefficient", (0.10, 0.13)),  # FDTS and OTS on polysilicon
    ("elastomer", "interfacial_shear_strength", (0.223e6, 0.305e6)),  # silicones on PLA: mu p at 3 N and 7 N on 16 mm^2
    ("DLC dry", "pressure_coefficient", (0.001, 0.003)),  # Erdemir 2001
    ("DLC dry", "interfacial_shear_strength", (0.02 * 0.3e9,)),  # Scharf et al. 2007: friction 0.02 at 0.3 GPa
    ("DLC humid", "interfacial_shear_strength", (12e6, 31e6, 0.2 * 0.3e9)),  # WTC2005, 42029; Scharf et al. 2007
    ("PTFE", "interfacial_shear_strength", (0.8e6,)),  # shear strength of the internal interface
]


@pytest.mark.parametrize(("name", "number", "printed"), PRINTED)
def test_printed_numbers_lie_within_the_range(name, number, printed):
    low, high = interface(name).range[number]
    assert all(low <= value <= high for value in printed)


def test_the_median_of_a_layered_solid_is_that_printed():
    assert float(st.interfaces(["layered solid"])[0]["strength"]["value"]) == pytest.approx(24.8e6, rel=0.02)


@pytest.mark.parametrize("name", sorted(STATES))
def test_quantiles_are_those_of_a_lognormal_below_and_above_the_median(name):
    state = interface(name)
    level = np.linspace(0.001, 0.999, 41)
    hardness, modulus = 2e9, 5e9
    scale = {"interfacial_shear_strength": 1.0, "shear_strength": hardness, "strength_over_shear_modulus": modulus}
    drawn = state.strength_at(level, hardness, modulus)
    median, (low, high) = getattr(state, state.strength), state.range[state.strength]
    for half, end, at in ((level < 0.5, low, 0.05), (level > 0.5, high, 0.95)):
        width = np.log(end / median) / stats.norm.ppf(at)
        expected = stats.lognorm(s=width, scale=median * scale[state.strength]).ppf(level[half])
        np.testing.assert_allclose(drawn[half], expected, rtol=1e-12)
    np.testing.assert_allclose(
        state.strength_at([0.05, 0.5, 0.95], hardness, modulus),
        np.array([low, median, high]) * scale[state.strength],
        rtol=1e-13,
    )
    assert np.all(np.diff(drawn) > 0)


def test_strength_follows_the_softer_body_and_arrays_broadcast():
    level, hardness = np.array([0.1, 0.5]), np.array([[1e9], [2e9], [4e9]])
    drawn = interface("oxidised metal").strength_at(level, hardness=hardness)
    assert drawn.shape == (3, 2)
    np.testing.assert_allclose(drawn[1:] / drawn[:-1], 2.0, rtol=1e-13)
    assert interface("ceramic").pressure_coefficient_at(level).tolist() == [0.0, 0.0]
    over_modulus = Interface(strength_over_shear_modulus=0.4, range={"strength_over_shear_modulus": (0.2, 0.8)})
    assert over_modulus.strength_at(0.95, shear_modulus=1e6) == pytest.approx(0.8e6, rel=1e-13)


@pytest.mark.parametrize("level", (0.0, 1.0, -0.1, [0.5, 1.5], float("nan")))
def test_a_level_outside_of_0_to_1_is_refused(level):
    with refusal("level", "0", "1"):
        interface("ice").strength_at(level)


def test_what_a_strength_is_given_over_has_to_be_there():
    with refusal("hardness", "ceramic"):
        interface("ceramic").strength_at(0.5)


@pytest.mark.parametrize("pair", list(combinations_with_replacement(MATERIAL_CLASSES, 2)), ids=str)
def test_every_pair_of_classes_allows_states_whose_weights_sum_to_one(pair):
    one, other = map(of_class, pair)
    weights = interface_weights(one, other)
    assert weights == interface_weights(other, one) and weights
    assert sum(weights.values()) == pytest.approx(1.0, rel=1e-14) and min(weights.values()) > 0
    assert all(interface(name).allows(one, other) for name in weights)


# What must not be assumed of a pair: (first, second, states that may not be among the weights).
FORBIDDEN = [
    ("copper", "copper", {"ice", "dry polymer", "DLC humid", "gold contact", "elastomer", "layered solid"}),
    ("pdms", "soda_lime_glass", STATES - {"elastomer"}),
    ("ptfe", "silver", {"soft-metal film", "clean metal", "oxidised metal"}),
    ("silver", "hardened_steel_52100", {"gold contact", "ceramic"}),
    ("tetrahedral_amorphous_carbon", "iron", {"clean metal", "oxidised metal"}),
]


@pytest.mark.parametrize(("first", "second", "forbidden"), FORBIDDEN)
def test_a_mixture_leaves_out_what_the_pair_does_not_allow(first, second, forbidden):
    assert not interface_weights(st.material(first), st.material(second)).keys() & forbidden


def test_gold_contact_needs_gold_and_some_states_have_to_be_stated():
    gold, silver, steel = (st.material(name) for name in ("gold_film", "silver", "hardened_steel_52100"))
    assert "gold contact" in interface_weights(gold, steel)
    assert not interface("gold contact").allows(silver, steel)
    plated = st.material("gold_film", hardness="1.7 GPa", name="hard gold")  # of the user, who knows that it is gold
    assert interface("gold contact").allows(plated, plated) and "gold contact" not in interface_weights(plated, plated)
    assert not interface("gold contact").allows(st.material("titanium_nitride", name="mine"), steel)
    assert interface("monolayer").allows(steel, steel) and "monolayer" not in interface_weights(steel, steel)
    assert not interface("ice").allows(steel, steel)


def test_a_refusal_names_the_class_that_was_guessed():
    own = st.Material(youngs_modulus="80 GPa", poissons_ratio=0.42, hardness="1.7 GPa", name="hard gold")
    rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1e9 /m^2")
    contact = dict(first=own, second="hardened_steel_52100", nominal_area="1 mm^2", roughness=rough, interface="gold contact")
    with pytest.raises(st.InputError) as refused:
        st.Contact(**contact)
    assert "hard gold is taken as metal" in refused.value.hint and "material_class" in refused.value.hint
    gold = own.replace(material_class="soft metal")
    assert st.Contact(**contact | {"first": gold}).interface.name == "gold contact"


def test_a_state_of_soft_metal_films_needs_a_film_between_hard_metals():
    bare = dict(first="hardened_steel_52100", second="hardened_steel_52100", interface="soft-metal film", nominal_area="1 mm^2")
    bare["roughness"] = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1e9 /m^2")
    with pytest.raises(st.InputError) as refused:
        st.Contact(**bare)
    assert refused.value.field == "interface" and "soft-metal film" not in refused.value.allowed
    silver = st.Coating(material="silver", bodies="first", thickness="1 um")
    assert st.Contact(**bare, coating=silver).interface.name == "soft-metal film"
    assert st.Contact(**bare | {"first": "silver"}).interface.name == "soft-metal film"


def test_every_preset_has_a_class_and_numbers_give_one():
    assert {st.material(name).material_class for name in material_names()} == set(MATERIAL_CLASSES)
    guessed = {name: class_of(st.material(name).replace(material_class=None)) for name in material_names()}
    wrong = {name for name in guessed if guessed[name] != st.material(name).material_class}
    # by two numbers alone neither softness of a metal nor layers, carbon, ice and concrete are seen
    hidden = {"soft metal", "layered solid", "carbon film", "ceramic", "ice"}
    assert {st.material(name).material_class for name in wrong} <= hidden


def test_an_own_state_needs_neither_range_nor_pairs():
    own = Interface(
        name="mine", interfacial_shear_strength="30 MPa", range={"interfacial_shear_strength": ("20 MPa", "40 MPa")}
    )
    np.testing.assert_allclose(own.strength_at([0.05, 0.5, 0.95]), [20e6, 30e6, 40e6], rtol=1e-13)
    assert Interface(shear_strength=0.1).strength_at([0.01, 0.99], hardness=1e9).tolist() == [1e8, 1e8]
    assert Interface(interfacial_shear_strength=0.0).strength_at(0.3) == 0.0
    assert own.allows(st.material("copper"), st.material("pdms"))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({}, "interface: not given; allowed: one of interfacial_shear_strength, "),
        ({"shear_strength": 0.1, "interfacial_shear_strength": 1e6}, "interface: 'interfacial_shear_strength, shear_strength'"),
        ({"interfacial_shear_strength": "30"}, "interfacial_shear_strength: '30'; allowed: a number with its unit"),
        ({"shear_strength": 0.1, "range": {"shear_strength": [0.2, 0.3]}}, "range.shear_strength: '0.2 to 0.3'"),
        ({"shear_strength": 0.1, "range": {"shear_strength": [0, 0.3]}}, "range.shear_strength: 0.0; allowed: "),
        ({"shear_strength": 0.1, "grade": {"shear_strength": "D"}}, "grade.shear_strength: 'D'"),
    ],
)
def test_a_bad_state_is_one_line(given, message):
    with pytest.raises(InputError) as error:
        Interface(**given)
    assert str(error.value).startswith(message) and "\n" not in str(error.value)


def test_an_unknown_state_lists_those_near_to_it():
    with refusal("interface", "oxidized metal", "oxidised metal"):
        interface("oxidized metal")


@pytest.mark.parametrize("word", ["anodised_aluminium", "Anodized aluminum", "anodic oxide"])
@pytest.mark.parametrize("called", [interface, material])
def test_an_anodised_surface_is_a_film_of_alumina_with_the_interface_ceramic(called, word):
    with pytest.raises(InputError) as error:
        called(word)
    assert "aluminium, with coating" in error.value.allowed and 'interface = "ceramic"' in error.value.allowed


def shown(*words, width="80"):
    result = CliRunner().invoke(cli.app, ["interfaces", *words], env={"COLUMNS": width})
    assert result.exit_code == 0, result.output
    return result.stdout


def test_the_command_prints_every_state_within_80_columns():
    text = shown()
    assert all(len(line) <= 80 for line in text.splitlines()) and "…" not in text
    rows = {line.strip().partition("  ")[0]: line for line in text.splitlines()}
    assert rows.keys() >= STATES and all(letter in text for letter in GRADES)
    assert " ".join(rows["layered solid"].split()) == "layered solid 25 MPa 12 to 70 MPa (A) 0.015 0.002 to 0.08 (B)"
    assert " ".join(rows["elastomer"].split()) == "elastomer 400 kPa 150 kPa to 1 MPa (B) none"


def test_the_command_says_how_a_case_and_python_state_it():
    for words, name in ((), "oxidised metal"), (("DLC dry",), "DLC dry"):
        text = shown(*words)
        assert f'interface = "{name}"' in text and f'st.Contact(..., interface="{name}")' in text
        assert all(len(line) <= 80 for line in text.splitlines())


def test_the_command_says_of_a_state_where_it_must_not_be_used():
    text = " ".join(shown("DLC dry").split())
    assert "not for: carbon without hydrogen" in text and "[erdemir_2001]" in text and "grade B" in text
    refused = CliRunner().invoke(cli.app, ["interfaces", "rust"])
    assert (refused.exit_code, refused.stderr.count("\n")) == (2, 1)
    assert "allowed: a name that `stiction interfaces` lists" in refused.stderr


def test_the_command_gives_the_rows_of_python_as_json():
    assert json.loads(shown("--json")) == json.loads(json.dumps(interfaces())) == json.loads(json.dumps(st.interfaces()))
    rows = st.interfaces(["ice"])
    rows[0]["pairs"].clear()
    assert st.interfaces(["ice"])[0]["pairs"]


def test_a_common_name_leads_to_the_state():
    with pytest.raises(InputError, match="'monolayer'"):
        interface("SAM")


def test_the_monolayer_bears_a_limited_pressure_with_a_source():
    (row,) = interfaces(["monolayer"])
    assert row["pressure_limit"]["value"] == 3e9 and row["pressure_limit"]["grade"] == "C" and row["pressure_limit"]["source"]
    assert interfaces(["ceramic"])[0]["pressure_limit"] is None
