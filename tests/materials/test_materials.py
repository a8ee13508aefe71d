"""Materials and their presets."""

import math
import re

import numpy as np
import pytest

from refusals import refusal
from stiction.case.read import parse_case
from stiction.contact.contact import Contact
from stiction.contact.materials import Material, material, material_names, symbols_of
from stiction.quantities.errors import InputError
from stiction.quantities.units import to_si
from stiction.records.sources import bibliography

SURFACE = {
    "nominal_area": "1 mm^2",
    "work_of_adhesion": "0.1 J/m^2",
    "roughness": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
}


def test_every_preset_is_valid_and_says_where_each_number_is_from():
    assert {"silver", "gold", "iron", "hardened_steel_52100", "silica"} <= set(material_names())
    for name in material_names():
        preset = material(name)
        numbers = {"youngs_modulus", "poissons_ratio", "hardness", "yield_stress", "surface_energy"}
        given = {field for field in numbers if getattr(preset, field) is not None}
        assert set(preset.source) == given and all(preset.source.values()), name
        # H/E of solids lies between that of pure soft metals and that of diamond-like films; an elastomer tears before it flows
        assert 5e-4 < preset.hardness / preset.youngs_modulus < (50 if preset.material_class == "elastomer" else 0.15), name


def test_every_number_of_a_preset_has_a_range_and_names_what_is_in_the_bibliography():
    for name in material_names():
        preset = material(name)
        assert set(preset.range) == set(preset.source), name
        for quantity, (low, high) in preset.range.items():
            assert low < high and low <= getattr(preset, quantity) <= high, (name, quantity)
        for text in preset.source.values():
            assert set(re.findall(r"\[(\w+)\]", text)) <= bibliography().keys(), text
            assert "[" in text or "memory" in text or ".com" in text, text


# Low and high ends as the pages print them, in GPa: two per preset, from different sources.
@pytest.mark.parametrize(
    ("name", "quantity", "low", "high"),
    [
        ("silicon", "youngs_modulus", 130, 188),  # Wikipedia, elastic properties of the elements
        ("polysilicon", "youngs_modulus", 169 - 6, 169 + 6),  # Sharpe et al. 1997
        ("tetrahedral_amorphous_carbon", "youngs_modulus", 493, 625),  # Salinas Ruiz et al. 2021, table 1
        ("tetrahedral_amorphous_carbon", "hardness", 51, 78),
        ("pdms", "youngs_modulus", 0.57e-3, 3.7e-3),  # Wang, Volinsky and Gallant 2014
        ("chromium_nitride", "hardness", 12, 19),  # Skjoldebrand et al. 2022, table 3: nanoindentation
        ("silicon_carbide", "youngs_modulus", 370, 490),  # makeitfrom.com
        ("zirconia", "youngs_modulus", 200, 220),  # ceramique-technique.com
        ("titanium_6al_4v", "youngs_modulus", 108, 122),  # Materials 14, 658, table 4
    ],
)
def test_ranges_are_those_printed(name, quantity, low, high):
    assert material(name).range[quantity] == pytest.approx((low * 1e9, high * 1e9), rel=1e-12)


def test_hardness_numbers_are_converted():
    """From Knoop's number, whose area is the projected one: kgf/mm^2, 9.80665 MPa; as far as the digits of the file go."""
    numbers = {"silicon": 1130, "soda_lime_glass": 570, "borosilicate_glass": 480}
    for name, kgf in numbers.items():
        assert material(name).hardness == pytest.approx(kgf * 9.80665e6, rel=0.01), name


@pytest.mark.parametrize(
    ("name", "number", "vickers"),
    [
        ("hardened_steel_52100", "62 HRC", 746),  # by the printed table of ASTM E140
        ("titanium_6al_4v", "349 HV", 349),
        ("stainless_steel_304", "129 HV", 129),
        ("hard_chromium_plate", "1000 HV", 1000),
    ],
)
def test_a_preset_is_as_hard_as_the_number_of_its_test(name, number, vickers):
    """The number that the source prints, typed by a user, is the same hardness: kgf over facets that are 1/sin(68 deg) larger
    than their projection."""
    assert number in material(name).source["hardness"]
    assert material(name).hardness == material(name, hardness=number).hardness
    assert material(name).hardness == pytest.approx(vickers * 9.80665e6 / math.sin(math.radians(68)), rel=3e-3)


_VICKERS = 1.0 / math.sin(math.radians(68))  # facets of a square pyramid over their projection
_BRINELL = 2.0 * (1.0 - math.sqrt(1.0 - 0.375**2)) / 0.375**2  # cap of a ball over its projection, d/D = 0.375
_TEST = {
    "Vickers": _VICKERS,
    "HV": 9.80665 * _VICKERS,
    "Brinell": _BRINELL,
    "HB": 9.80665 * _BRINELL,
    "ball indentation": _BRINELL,
}
_SCALES = re.compile(r"Vickers|Brinell|ball indentation|[0-9] H[VB]")


def mean_pressures(printed):
    """Return the numbers of "Brinell 206 MPa" or "Vickers 12 to 18 GPa" as forces over projected areas [Pa]."""
    scale = next(scale for scale in _TEST if scale in printed)
    unit = {"GPa": 1e9}.get(printed.split()[-1], 1e6)
    return [float(word) * _TEST[scale] * unit for word in re.findall(r"[0-9.]+", printed)]


# Where each number goes: the hardness (the middle of two numbers), its range, or one end of that.
@pytest.mark.parametrize(
    ("name", "hardness", "low", "high"),
    [
        ("silver", "Vickers 251 MPa", "Brinell 206 MPa", "Vickers 251 MPa"),
        ("gold", "Brinell 190 MPa", "Brinell 188 to 245 MPa", "Brinell 188 to 245 MPa"),
        ("copper", "Vickers 343 to 369 MPa", "Brinell 235 to 878 MPa", "Brinell 235 to 878 MPa"),
        ("aluminium", "Vickers 160 to 350 MPa", "Brinell 160 to 550 MPa", "Brinell 160 to 550 MPa"),
        ("lead", "Brinell 38 MPa", "Brinell 37 to 50 MPa", "Brinell 37 to 50 MPa"),
        ("indium", "Brinell 8.83 to 10 MPa", "Brinell 8.83 to 10 MPa", "Brinell 8.83 to 10 MPa"),
        ("nickel", "Vickers 638 MPa", "Vickers 638 MPa", "Brinell 1600 MPa"),
        ("titanium", "Vickers 830 to 3420 MPa", "Brinell 716 MPa", "Vickers 3420 MPa"),
        ("iron", "Vickers 608 MPa", "Brinell 200 to 1180 MPa", "Brinell 200 to 1180 MPa"),
        ("chromium", "Vickers 1060 MPa", "Brinell 687 to 6500 MPa", "Brinell 687 to 6500 MPa"),
        ("tungsten", "Vickers 3000 to 3400 MPa", "Brinell 2000 MPa", "Vickers 4600 MPa"),
        ("tin", "Brinell 51 to 75 MPa", "Brinell 51 to 75 MPa", "Brinell 51 to 75 MPa"),
        ("alumina", "Vickers 12 to 18 GPa", "Vickers 12 to 18 GPa", "2000 HV"),
        ("zirconia", "Vickers 12 to 16 GPa", "Vickers 12 to 16 GPa", "Vickers 12 to 16 GPa"),
        ("silicon_nitride", "Vickers 15 to 16 GPa", "Vickers 15 to 16 GPa", None),
        ("silicon_carbide", None, None, "Vickers 29.0 GPa"),
        ("silicon", None, "Vickers 9.63 GPa", None),
        ("polysilicon", None, "Vickers 9.63 GPa", None),
        ("ptfe", "ball indentation 30 MPa", "ball indentation 25 to 30 MPa", "ball indentation 27 to 37 MPa"),
        ("stainless_steel_304", "129 HV", "129 HV", "360 HB"),
        ("titanium_6al_4v", "349 HV", "338 to 374 HV", "338 to 374 HV"),
        ("hard_chromium_plate", "1000 HV", "800 HV", "1100 HV"),
    ],
)
def test_a_preset_is_the_mean_pressure_of_the_number_that_its_source_prints(name, hardness, low, high):
    body = material(name)
    ends = body.range["hardness"]
    close = {"rel": 3e-3, "abs": 0.0}  # three digits
    for printed, found, choose in ((hardness, body.hardness, np.mean), (low, ends[0], min), (high, ends[1], max)):
        if printed:
            assert printed in body.source["hardness"]
            assert found == pytest.approx(choose(mean_pressures(printed)), **close), printed


def test_every_preset_with_a_number_of_a_hardness_test_is_recomputed_above():
    (table,) = (
        mark.args[1]
        for mark in test_a_preset_is_the_mean_pressure_of_the_number_that_its_source_prints.pytestmark
        if mark.name == "parametrize"
    )
    assert {row[0] for row in table} == {name for name in material_names() if _SCALES.search(material(name).source["hardness"])}


def test_a_brinell_number_is_force_over_the_projection_of_the_cap():
    """An imprint of 3.75 mm by a ball of 10 mm under 3000 kgf: the printed table of ISO 6506-4 gives 262 HBW."""
    assert to_si("262 HBW", "hardness") == pytest.approx(3000 * 9.80665 / (math.pi / 4 * 3.75e-3**2), rel=3e-3)
    assert to_si("262 HB", "hardness") == to_si("262 HBS", "hardness") == to_si("262 HBW", "hardness")


# Symbol or formula, and the printed Young's modulus in GPa: tin, the metal, has 50, its namesake TiN 525.
@pytest.mark.parametrize(
    ("symbol", "name", "modulus"),
    [
        ("TiN", "titanium_nitride", 525),
        ("tin", "tin", 50),
        ("Sn", "tin", 50),
        ("Ag", "silver", 82),
        ("ag", "silver", 82),
        ("In", "indium", 11),
        ("Al2O3", "alumina", 360),
        ("a-C:H", "hydrogenated_amorphous_carbon", 173),
        ("ta-C", "tetrahedral_amorphous_carbon", 572),
        ("PTFE", "ptfe", 0.6),
        ("Ti-6Al-4V", "titanium_6al_4v", 114),
        ("100Cr6", "hardened_steel_52100", 210),
        ("DLC", "diamond_like_carbon", 250),
    ],
)
def test_a_symbol_or_formula_is_its_material(symbol, name, modulus):
    assert material(symbol).name == name
    assert material(symbol).youngs_modulus == pytest.approx(modulus * 1e9, rel=1e-12)
    contact = {"first": symbol, "second": {"preset": symbol, "hardness": "5 GPa"}}
    subject = parse_case({"contact": contact | SURFACE, "solve": {"load": "1 N"}}).subject
    assert (subject.first, subject.second) == (material(name), material(name, hardness="5 GPa"))


@pytest.mark.parametrize(
    ("word", "candidates"),
    [
        ("TIN", {"tin", "titanium_nitride"}),
        ("Tin", {"tin", "titanium_nitride"}),
    ],
)
def test_a_word_for_several_presets_is_asked_back(word, candidates):
    """Offer every preset that is meant by the word, and no other one, also in a case with materials of its own."""
    contact = {"first": "silver", "second": word, **SURFACE}
    own = {"mine": {"youngs_modulus": "1 GPa", "poissons_ratio": 0.3, "hardness": "1 GPa"}}
    for asked in (
        lambda: material(word),
        lambda: parse_case({"contact": contact, "solve": {"load": "1 N"}}),
        lambda: parse_case({"contact": contact, "materials": own, "solve": {"load": "1 N"}}),
    ):
        with pytest.raises(InputError) as caught:
            asked()
        assert caught.value.value == word
        assert {name for name in material_names() if re.search(rf"\b{name} \(", caught.value.allowed)} == candidates


def test_no_symbol_is_the_name_of_another_preset():
    every = [symbol for name in material_names() for symbol in symbols_of(name)]
    assert len(every) == len(set(every)) and not set(every) & set(material_names())


def test_a_material_of_the_case_goes_before_a_symbol():
    own = {"Ag": {"youngs_modulus": "1 GPa", "poissons_ratio": 0.3, "hardness": "1 GPa"}}
    contact = {"first": "Ag", "second": "Au", **SURFACE}
    subject = parse_case({"contact": contact, "materials": own, "solve": {"load": "1 N"}}).subject
    assert (subject.first.youngs_modulus, subject.second) == (1e9, material("gold"))


def test_a_replaced_number_loses_its_source_and_its_range():
    for changed in (material("silver", hardness="1 GPa"), material("silver").replace(hardness="1 GPa")):
        assert changed.hardness == 1e9 and "hardness" not in changed.range and "hardness" not in changed.source
        assert changed.range["youngs_modulus"] == (82e9, 83e9)
    own = material("silver", hardness="1 GPa", range={"hardness": ("0.8 GPa", "1.2 GPa")})
    assert own.range["hardness"] == (0.8e9, 1.2e9) and own.range["youngs_modulus"] == (82e9, 83e9)
    assert own.replace(name="film").range == own.range
    assert "range of hardness: 800 MPa to 1.2 GPa" in own.notes()


def test_ranges_survive_in_a_contact():
    contact = Contact(
        first={"preset": "gold", "range": {"hardness": ["0.1 GPa", "0.3 GPa"]}},
        second="silica",
        roughness={"asperity_height_deviation": 5e-8, "asperity_radius": 5e-5, "asperity_density": 1e10},
        work_of_adhesion=0.1,
        nominal_area=1e-6,
    )
    assert contact.first.range["hardness"] == (0.1e9, 0.3e9)
    assert contact.second.range == material("silica").range
    again = Material(**material("gold").model_dump())
    assert again == material("gold")


@pytest.mark.parametrize(
    ("ends", "message"),
    [
        ({"hardness": ["8 GPa", "9 GPa"]}, "range.hardness: '8 to 9 GPa'; allowed: a range that includes hardness = 7 GPa"),
        ({"hardness": ["8 GPa", "6 GPa"]}, "range.hardness: ['8 GPa', '6 GPa']; allowed: the low value before"),
        ({"hardness": ["6 GPa"]}, "range.hardness: ['6 GPa']; allowed: two values, low and high: "),
        ({"hardness": "6 GPa"}, "range.hardness: '6 GPa'; allowed: two values, low and high: "),
        ({"hardness": ["6 GPa", "8 N"]}, "range.hardness: '8 N'; allowed: "),
        (
            {"hardness": ["6 GPa", [8e9, 9e9]]},
            "range.hardness: ['6 GPa', [8000000000.0, 9000000000.0]]; allowed: two single values",
        ),
        (
            {"hardnes": ["6 GPa", "8 GPa"]},
            "range.hardnes: ['6 GPa', '8 GPa']; allowed: a range of a material property; hardnes is not one",
        ),
        ({"surface_energy": [1, 2]}, "range.surface_energy: ['1 J/m^2', '2 J/m^2']; not supported: "),
        ({"load": [1, 2]}, "range.load: ['1 N', '2 N']; not supported: the material has no load"),
        ([1, 2], "range: [1, 2]; allowed: a table of low and high values"),
    ],
)
def test_bad_range_is_one_line(ends, message):
    with pytest.raises(InputError) as error:
        Material(youngs_modulus="210 GPa", poissons_ratio=0.3, hardness="7 GPa", range=ends)
    assert str(error.value).startswith(message) and "\n" not in str(error.value)


def test_preset_values():
    # electrical-contacts-wiki.com table 1 and Wikipedia "Hardnesses of the elements"
    silver = material("silver")
    assert (silver.youngs_modulus, silver.poissons_ratio, silver.hardness) == (82e9, 0.37, 271e6)
    assert silver.shear_modulus == pytest.approx(29.93e9, rel=1e-3)  # 82/2.74


def test_preset_with_changes_drops_the_source_of_what_was_changed():
    silver = material("silver", hardness="1 GPa", name="sputtered silver")
    assert silver.hardness == 1e9 and silver.name == "sputtered silver"
    assert "hardness" not in silver.source and "youngs_modulus" in silver.source


def test_unknown_preset_lists_near_names():
    with pytest.raises(InputError) as error:
        material("silvr")
    assert str(error.value).startswith("material: 'silvr'; allowed: a preset: silver")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"youngs_modulus": -1}, "youngs_modulus: -1.0; allowed: >= 1000 Pa"),
        ({"youngs_modulus": "210"}, "youngs_modulus: '210'; allowed: a number with its unit: >= 1000 Pa"),
        ({"youngs_modulus": "210 N"}, "youngs_modulus: '210 N'; allowed: >= 1000 Pa"),
        ({"poissons_ratio": 0.5}, "poissons_ratio: 0.5; allowed: >= 0 and < 0.5"),
        ({"hardness": float("nan")}, "hardness: nan; allowed: finite, >= 1000 Pa"),
        ({"hardness": None}, "hardness: not given; allowed: >= 1000 Pa"),
        (
            {"hardness": [1e9, 2e9]},
            "hardness: array of shape (2,); allowed: one number, or an array with a named",
        ),
        ({"hardnes": 1}, "hardnes: unknown key; allowed: hardness or range (all: "),
        ({"name": 3}, "name: 3; allowed: "),
    ],
)
def test_bad_material_is_one_line(change, message):
    with pytest.raises(InputError) as error:
        Material(**{"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": "7 GPa"} | change)
    assert str(error.value).startswith(message) and "\n" not in str(error.value)


def test_missing_number_is_named():
    with refusal("hardness", ">= 1000 Pa"):
        Material(youngs_modulus="210 GPa", poissons_ratio=0.3)


def test_docstring_comes_from_the_table():
    assert "youngs_modulus: Young's modulus [Pa], >= 1000 Pa" in Material.__doc__


@pytest.mark.parametrize(("given", "meant"), [("SLVER", "silver"), ("TTANIUM", "titanium"), ("PTE", "ptfe")])
def test_a_misspelt_preset_is_suggested_whatever_its_case(given, meant):
    with pytest.raises(InputError) as caught:
        material(given)
    assert meant in caught.value.allowed.partition(" (all:")[0]
