"""Case files: the examples, the two kinds of points, and one line about everything that is wrong."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest

from refusals import refusal
from stiction.case.case_tables import json_schema
from stiction.case.read import parse_case, read_case
from stiction.case.study_tables import study_tables
from stiction.contact.contact import Contact, Indices
from stiction.quantities.errors import InputError
from stiction.solving.choice import Choice

EXAMPLES = Path(__file__).parents[2] / "examples"

CONTACT = """
title = "test"
[contact]
first = "silver"
second = { youngs_modulus = "210 GPa", poissons_ratio = 0.3, hardness = "7 GPa" }
work_of_adhesion = "1 J/m^2"
nominal_area = "1 mm^2"
[contact.roughness]
asperity_height_deviation = "50 nm"
asperity_radius = "50 um"
asperity_density = "1e10 1/m^2"
[contact.coating]
material = { preset = "gold", hardness = "0.5 GPa" }
thickness = "200 nm"
[solve]
"""
INDICES = """
[indices]
theta = 40
lam = 10
[solve]
"""


@pytest.fixture
def read(tmp_path):
    def _read(text):
        path = tmp_path / "case.toml"
        path.write_text(text, encoding="utf-8")
        return read_case(path)

    return _read


@pytest.fixture
def refused(read):
    def _refused(text):
        with pytest.raises(InputError) as error:
            read(text)
        assert "\n" not in str(error.value)
        return str(error.value)

    return _refused


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_examples_are_valid(path):
    case = read_case(path)
    assert case.title and (case.separation is None) != (case.load is None)
    assert not case.choice.options
    if isinstance(case.subject, Contact):
        indices = case.subject.indices()
        assert indices.has_film or indices.shear_strength is not None  # what the example is about


def test_paper_figure():
    case = read_case(EXAMPLES / "paper_figure.toml")
    assert case.subject == Indices(theta=40, lam=10, n_E=1.5, n_H=0.5, tau=2)
    assert len(case.separation) == 81 and case.separation[0] == 4 and case.separation[-1] == -4


def test_points_of_a_contact_are_si(read):
    # plain separations are in units of sigma, here 50 nm
    assert np.allclose(read(CONTACT + "separation = [1, -2]").separation, [50e-9, -100e-9], rtol=1e-15)
    mixed = read(CONTACT + 'separation = ["10 nm", 0.5]').separation
    assert np.allclose(mixed, [10e-9, 25e-9], rtol=1e-15)
    evenly = read(CONTACT + 'separation = { start = "0.2 um", stop = 0, count = 5 }').separation
    assert np.allclose(evenly, [200e-9, 150e-9, 100e-9, 50e-9, 0], atol=1e-22)
    load = read(CONTACT + 'load = { start = "1 mN", stop = "1 N", count = 4, spacing = "log" }').load
    assert np.allclose(load, [1e-3, 1e-2, 1e-1, 1], rtol=1e-14)
    assert read(CONTACT + 'load = "2 N"').load == [2.0]


def test_points_of_indices_are_plain(read):
    assert np.array_equal(read(INDICES + "separation = [1, 2.5]").separation, [1, 2.5])
    assert np.array_equal(read(INDICES + "load = { start = 0, stop = 1, count = 3 }").load, [0, 0.5, 1])


def test_settings(read):
    case = read(INDICES + 'separation = [1]\nvariant = "published"\nfilm = "graded"\nbranch = "unloading"')
    options = {"variant": "published", "branch": "unloading"}
    assert case.choice == Choice(film="graded", options=options)
    laws = 'model = "greenwood_williamson_1966"\nasperity = "jkr"\ntangential = "none"\ntransition = "jump"\n'
    case = read(INDICES + "separation = [1]\n" + laws + 'options = { some_option = "one" }')
    options = {"transition": "jump", "some_option": "one"}
    assert case.choice == Choice("greenwood_williamson_1966", "jkr", "none", None, options)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"200 nm"', "200", "contact.coating.thickness: 200; allowed: text with a unit: film thickness"),
        ('"200 nm"', '"200"', "contact.coating.thickness: '200'; allowed: a number with its unit: > 0 m"),
        ('"200 nm"', "nan", "contact.coating.thickness: nan; allowed: "),
        ('"200 nm"', '"-200 nm"', "contact.coating.thickness: '-200 nm'; allowed: > 0 m"),
        ('"200 nm"', "[1]", "contact.coating.thickness: 1; allowed: text with a unit"),
        ('"200 nm"', "2024-01-01", "contact.coating.thickness: datetime.date(2024, 1, 1); allowed: "),
        ("thickness", "thicknes", "contact.coating.thicknes: unknown key; allowed: thickness (all: "),
        ('"210 GPa"', '"-210 GPa"', "contact.second.youngs_modulus: '-210 GPa'; allowed: >= 1000 Pa"),
        ('"210 GPa"', "2.1e11", "contact.second.youngs_modulus: 210000000000.0; allowed: text with a unit"),
        ('"0.5 GPa"', "5e8", "contact.coating.material.hardness: 500000000.0; allowed: text with a unit"),
        ("0.3,", "0.5,", "contact.second.poissons_ratio: 0.5; allowed: >= 0 and < 0.5"),
        ("0.3,", "nan,", "contact.second.poissons_ratio: nan; allowed: finite, >= 0"),
        ('"1e10 1/m^2"', '"1e10 m"', "contact.roughness.asperity_density: '1e10 m'; allowed: > 0 1/m^2"),
        ('"silver"', '"silvr"', "contact.first: 'silvr'; allowed: a preset: silver"),
        ("[contact.roughness]", "[contact.rougness]", "contact.rougness: "),
        ("[solve]", "[solver]", "solver: "),
        ("[solve]", "[indices]\ntheta = 1\nlam = 1\n[solve]", "contact and indices: both given; allowed: exactly one of"),
        ("[1]", "[true]", "solve.separation: True; allowed: "),
        ("[1]", "[nan]", "solve.separation: nan; allowed: a finite number"),
        ("[1]", "[1" + "0" * 400 + "]", "solve.separation: 1"),
        ("[1]", "[]", "solve.separation: []; allowed: a list with at least one value"),
        ("[1]", '["1"]', "solve.separation: '1'; allowed: a number with its unit"),
        ("[1]", '["1 N"]', "solve.separation: '1 N'; allowed: any finite number in m"),
        (
            "[1]",
            "{ start = 4, stop = -4 }",
            "solve.separation.count: not given; allowed: a whole number, 2 to",
        ),
        ("[1]", "{ start = 4, stop = -4, count = 1 }", "solve.separation.count: 1; allowed: a whole number"),
        (
            "[1]",
            "{ start = 4, stop = -4, count = 2.5 }",
            "solve.separation.count: 2.5; allowed: a whole number",
        ),
        ("[1]", "{ start = 4, stop = -4, cont = 9 }", "solve.separation.cont: unknown key; allowed: count (all: "),
        (
            "[1]",
            '{ start = 4, stop = -4, count = 9, spacing = "log" }',
            "solve.separation.stop: -4; allowed: above 0 with spacing",
        ),
        ("separation = [1]", "load = [1]", "solve.load: 1; allowed: text with a unit: normal load"),
        ("separation = [1]", 'load = ["1 m"]', "solve.load: '1 m'; allowed: any finite number in N"),
        (
            "separation = [1]",
            'separation = [1]\nload = ["1 N"]',
            "solve.separation and load: both given; allowed: exactly one",
        ),
        ("separation = [1]", "", "solve.separation and load: not given; allowed: exactly one of"),
        (
            "separation = [1]",
            "separation = [1]\nvariant = 1",
            "solve.variant: 1; allowed: corrected, published",
        ),
    ],
)
def test_bad_case_is_one_line_naming_field_value_and_range(refused, old, new, message):
    text = CONTACT + "separation = [1]"
    assert old in text
    assert refused(text.replace(old, new, 1)).startswith(message)


def test_loads_of_indices_have_no_unit(refused):
    assert refused(INDICES + 'load = ["1 N"]').startswith("solve.load: '1 N'; allowed: a plain number")


def test_a_case_needs_a_subject_and_points(refused):
    assert refused("").startswith("solve: not given; allowed: a table with separation or load")
    assert refused("[solve]\nseparation = [1]").startswith("contact and indices: not given; allowed: exactly one of")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"this is no case", "this is not TOML: Expected '=' after a key"),
        (bytes(range(256)), "this file is not UTF-8 text"),
        (b"a = " + b"[" * 100_000, "too long to read"),
        (b"a = " + b"1" * 10_000, "too long to read"),
    ],
)
def test_a_file_that_is_no_case(tmp_path, content, message):
    path = tmp_path / "x.toml"
    path.write_bytes(content)
    with pytest.raises(InputError) as error:
        read_case(path)
    assert message in str(error.value) and str(error.value).startswith("case file: '")
    assert "\n" not in str(error.value)


def test_a_path_that_is_no_file(tmp_path):
    with refusal("case file"):
        read_case(tmp_path)
    with refusal("case file"):
        read_case(tmp_path / "missing.toml")


def test_json_schema_states_units_and_bounds():
    schema = json_schema()
    json.dumps(schema)
    tables = {"title", "materials", "contact", "indices", "solve", "uncertainty", *study_tables()}
    assert set(schema["properties"]) == tables
    definitions = schema["$defs"]
    thickness = definitions["Coating"]["properties"]["thickness"]
    assert thickness["anyOf"][0]["type"] == "string" and "[m]; > 0 m" in thickness["description"]
    nu = definitions["Indices"]["properties"]["nu"]
    one = nu["anyOf"][0]
    assert (one["minimum"], one["exclusiveMaximum"], nu["default"]) == (0, 0.5, 0.3)
    assert "silver" in definitions["Material"]["properties"]["preset"]["anyOf"][0]["enum"]
    assert "additionalProperties" in definitions["Indices"]


def test_json_schema_has_no_null_since_toml_has_none():
    assert '"null"' not in json.dumps(json_schema())


def test_a_mark_of_the_encoding_is_no_content(tmp_path):
    """As editors put it at the beginning of a file."""
    plain = "[indices]\ntheta = 40\nlam = 10\n[solve]\nseparation = 1\n"
    (tmp_path / "case.toml").write_text(plain, encoding="utf-8-sig")
    assert (tmp_path / "case.toml").read_bytes().startswith(b"\xef\xbb\xbf")
    assert read_case(tmp_path / "case.toml").subject.theta == 40.0


def test_every_study_with_a_table_has_it_in_the_case_file():
    folder = Path(__file__).parents[2] / "src" / "stiction" / "studies"
    found = {path.parent.name for path in folder.glob("*/table.py")}
    assert set(study_tables()) == found >= {"design", "fit", "sweep"}
    with refusal("swep", "sweep"):
        parse_case({**tomllib.loads(INDICES + "load = [1.0]\n"), "swep": {}})
    with refusal("sweep.precision", "float16", "float64", "float32"):
        parse_case({**tomllib.loads(INDICES + "load = [1.0]\n"), "sweep": {"precision": "float16"}})


@pytest.mark.parametrize(
    ("symbol", "field"), [("Ra", "mean_height"), ("Sa", "mean_height"), ("Sq", "rms_height"), ("Rq", "rms_height")]
)
def test_a_symbol_in_place_of_a_field_is_answered_with_the_field(symbol, field):
    body = {"finish": "ground", symbol: "0.2 um"}
    with pytest.raises(InputError) as refused:
        Contact(first="copper", second="copper", nominal_area="1 mm^2", roughness={"first": body, "second": body})
    assert refused.value.field.endswith(symbol) and refused.value.allowed.startswith(f"{field} for {symbol}")
