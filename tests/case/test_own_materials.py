"""Materials of a case's own, in the case or in a file beside it."""

import json

import pytest
from typer.testing import CliRunner

from refusals import refusal
from stiction import cli
from stiction.case.case_tables import json_schema
from stiction.case.read import read_case
from stiction.contact.materials import Material, material
from stiction.quantities.errors import InputError

MATERIALS = """
[materials.bronze]
youngs_modulus = "110 GPa"
poissons_ratio = 0.34
hardness = "1.2 GPa"
range = { hardness = ["1 GPa", "1.5 GPa"], poissons_ratio = [0.33, 0.35] }
[materials.soft_silver]
preset = "silver"
hardness = "0.2 GPa"
"""
CONTACT = """
[contact]
first = "bronze"
second = { preset = "bronze", hardness = "2 GPa" }
work_of_adhesion = "1 J/m^2"
nominal_area = "1 mm^2"
[contact.roughness]
asperity_height_deviation = "50 nm"
asperity_radius = "50 um"
asperity_density = "1e10 1/m^2"
[contact.coating]
material = "soft_silver"
thickness = "200 nm"
[solve]
load = "1 N"
"""
BESIDE = 'materials = "my_materials.toml"\n' + CONTACT
BRONZE = Material(
    name="bronze",
    youngs_modulus=110e9,
    poissons_ratio=0.34,
    hardness=1.2e9,
    range={"hardness": (1e9, 1.5e9), "poissons_ratio": (0.33, 0.35)},
)


@pytest.fixture
def read(tmp_path):
    def _read(case, materials=None):
        (tmp_path / "case.toml").write_text(case, encoding="utf-8")
        if materials is not None:
            (tmp_path / "my_materials.toml").write_text(materials, encoding="utf-8")
        return read_case(tmp_path / "case.toml")

    return _read


def test_names_stand_for_the_tables(read):
    contact = read(MATERIALS + CONTACT).subject
    assert contact.first == BRONZE
    assert contact.second.hardness == 2e9 and contact.second.youngs_modulus == 110e9
    assert contact.second.range == {"poissons_ratio": (0.33, 0.35)}
    film = contact.coating.material
    assert (film.name, film.hardness, film.youngs_modulus) == ("soft_silver", 0.2e9, material("silver").youngs_modulus)


def test_a_file_beside_the_case_says_the_same(read):
    assert read(BESIDE, MATERIALS).subject == read(MATERIALS + CONTACT).subject


def test_numbers_in_the_file_may_be_uncertain(tmp_path):
    """The same as in the case itself; values from a file are beside the file of materials."""
    uncertain = MATERIALS.replace('"1.2 GPa"', '"1.2 +/- 0.1 GPa"').replace(
        '"110 GPa"', '{ samples = "moduli.txt", unit = "GPa" }'
    )
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "my_materials.toml").write_text(uncertain, encoding="utf-8")
    for folder in (tmp_path, tmp_path / "elsewhere"):
        (folder / "moduli.txt").write_text("100\n110\n120\n", encoding="utf-8")
    (tmp_path / "one.toml").write_text(uncertain + CONTACT, encoding="utf-8")
    (tmp_path / "two.toml").write_text('materials = "elsewhere/my_materials.toml"\n' + CONTACT, encoding="utf-8")
    one, two = (read_case(tmp_path / f"{name}.toml") for name in ("one", "two"))
    assert [x.as_table() for x in one.uncertain] == [x.as_table() for x in two.uncertain] and len(one.uncertain) == 3
    assert {x.where for x in two.uncertain} == {x.where for x in one.uncertain}
    assert two.subject == one.subject and two.subject.first.hardness == 1.2e9
    (tmp_path / "elsewhere" / "moduli.txt").unlink()
    with refusal("materials: my_materials.toml: materials.bronze.youngs_modulus.samples", "moduli.txt"):
        read_case(tmp_path / "two.toml")


def test_presets_stay_what_they_are(read):
    case = MATERIALS + CONTACT.replace('first = "bronze"', 'first = "iron"')
    assert read(case).subject.first == material("iron")
    assert read("[materials]\n[indices]\ntheta = 40\nlam = 10\n[solve]\nload = 1").subject.theta == 40


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            'first = "bronze"',
            'first = "bronse"',
            "contact.first: 'bronse'; allowed: a material of the case, or a preset: bronze",
        ),
        ('material = "soft_silver"', 'material = "x"', "contact.coating.material: 'x'; allowed: a material of the case, or"),
        ("[materials.bronze]", "[materials.silver]", "materials.silver: 'silver'; allowed: a name that no preset has"),
        ('hardness = "1.2 GPa"', 'hardness = "-1 GPa"', "materials.bronze.hardness: '-1 GPa'; allowed: "),
        ('hardness = "1.2 GPa"', "hardness = 1.2e9", "materials.bronze.hardness: 1200000000.0; allowed: text with a unit"),
        (
            '["1 GPa", "1.5 GPa"]',
            "[1e9, 1.5e9]",
            "materials.bronze.range.hardness: [1000000000.0, 1500000000.0]; allowed: text",
        ),
        (
            '["1 GPa", "1.5 GPa"]',
            '["2 GPa", "3 GPa"]',
            "materials.bronze.range.hardness: '2 to 3 GPa'; allowed: a range that includes",
        ),
        ('hardness = "1.2 GPa"', "", "materials.bronze.hardness: not given; allowed: hardness"),
        ('preset = "silver"', 'preset = "silvr"', "materials.soft_silver: 'silvr'; allowed: a preset: silver"),
        (
            'preset = "bronze", hardness',
            'preset = "bronze", hardnes',
            "contact.second.hardnes: unknown key; allowed: hardness",
        ),
    ],
)
def test_what_is_wrong_is_said_in_one_line(read, old, new, message):
    text = MATERIALS + CONTACT
    assert old in text
    for case, materials, where in ((text, None, ""), (BESIDE, MATERIALS, "materials: my_materials.toml: ")):
        with pytest.raises(InputError) as error:
            read(case.replace(old, new), materials and materials.replace(old, new))
        said = str(error.value)
        in_file = materials is not None and old in MATERIALS
        assert said.startswith((where if in_file else "") + message) and "\n" not in said


@pytest.mark.parametrize(
    ("case", "materials", "message"),
    [
        (BESIDE, None, "materials: my_materials.toml: '"),
        (BESIDE, "[materials", "materials: my_materials.toml: '"),
        (BESIDE, MATERIALS + '[steel]\nhardness = "7 GPa"', "materials: my_materials.toml: steel: "),
        (BESIDE, "", "materials: my_materials.toml: materials: not given; allowed: tables [materials.NAME]"),
        ("materials = 3\n" + CONTACT, None, "materials: 3; allowed: tables [materials.NAME], or the path of a file"),
        ("materials = { bronze = 3 }\n" + CONTACT, None, "materials.bronze: 3; allowed: a table [materials.bronze]"),
    ],
)
def test_a_bad_file_of_materials_is_one_line(read, case, materials, message):
    with pytest.raises(InputError) as error:
        read(case, materials)
    assert str(error.value).startswith(message) and "\n" not in str(error.value)


def test_the_schema_knows_them():
    tables, file = json_schema()["properties"]["materials"]["anyOf"]
    assert {"$ref": "#/$defs/Material"} in tables["additionalProperties"]["anyOf"] and file["type"] == "string"


def test_the_command_lists_every_preset():
    def printed(*words, code=0):
        result = CliRunner(env={"COLUMNS": "200"}).invoke(cli.app, ["materials", *words])
        assert result.exit_code == code, result.output
        return result

    table = printed().stdout
    assert "tetrahedral_amorphous_carbon" in table and "130 to 188 GPa" in table and "713 MPa to 6.75 GPa" in table
    in_full = printed("ptfe").stdout
    assert "E, Young's modulus: 600 MPa (300 to 800 MPa)" in in_full and "[finemech_2026]" in in_full
    (silicon,) = json.loads(printed("silicon", "--json").stdout)
    modulus = silicon["numbers"]["youngs_modulus"]
    assert (silicon["name"], modulus["value"], modulus["unit"], modulus["range"]) == ("silicon", 160e9, "Pa", [130e9, 188e9])
    assert modulus["source"] == material("silicon").source["youngs_modulus"]
    assert len(json.loads(printed("--json").stdout)) > 30
    assert printed("silicn", code=2).stderr.startswith("stiction: material: 'silicn'; allowed: a preset: silicon")
