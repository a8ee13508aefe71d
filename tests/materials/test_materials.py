"""Materials and their presets."""

import pytest

from stiction.contact.materials import Material, material, material_names
from stiction.quantities.errors import InputError


def test_every_preset_is_valid_and_says_where_each_number_is_from():
    assert {"silver", "gold", "iron", "hardened_steel_52100", "silica"} <= set(material_names())
    for name in material_names():
        preset = material(name)
        numbers = {"youngs_modulus", "poissons_ratio", "hardness", "yield_stress", "surface_energy"}
        given = {field for field in numbers if getattr(preset, field) is not None}
        assert set(preset.source) == given and all(preset.source.values()), name
        # H/E of solids lies between that of pure soft metals and that of diamond-like films
        assert 5e-4 < preset.hardness / preset.youngs_modulus < 0.15, name


def test_preset_values():
    # electrical-contacts-wiki.com table 1 and Wikipedia "Hardnesses of the elements"
    silver = material("silver")
    assert (silver.youngs_modulus, silver.poissons_ratio, silver.hardness) == (82e9, 0.37, 251e6)
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
            "hardness: 'array of shape (2,)'; allowed: one number, or an array with a named",
        ),
        ({"hardnes": 1}, "hardnes: 1; allowed: hardness (all: "),
        ({"name": 3}, "name: 3; allowed: "),
    ],
)
def test_bad_material_is_one_line(change, message):
    with pytest.raises(InputError) as error:
        Material(**{"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": "7 GPa"} | change)
    assert str(error.value).startswith(message) and "\n" not in str(error.value)


def test_missing_number_is_named():
    with pytest.raises(InputError, match=r"^hardness: not given; allowed: hardness, .*>= 1000 Pa"):
        Material(youngs_modulus="210 GPa", poissons_ratio=0.3)


def test_docstring_comes_from_the_table():
    assert "youngs_modulus: Young's modulus [Pa], >= 1000 Pa" in Material.__doc__
