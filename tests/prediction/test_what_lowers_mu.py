"""What an answer says to lower mu does so: each change that it names, made in the contact."""

import pytest

import stiction as st
from stiction.report.answer import answer_record

ROUGH = {"asperity_height_deviation": 2e-7, "asperity_radius": 2e-5, "asperity_density": 1e10, "kind": "gaussian"}
RIGID = {"youngs_modulus": 1e12, "poissons_ratio": 0.3, "hardness": 1e11, "material_class": "ceramic"}
SOFT = {"youngs_modulus": 2e6, "poissons_ratio": 0.49, "hardness": 1e7, "material_class": "elastomer"}
PLASTIC = {"youngs_modulus": 1e12, "poissons_ratio": 0.3, "hardness": 1e8, "material_class": "polymer"}
ELASTIC = {"youngs_modulus": 2e9, "poissons_ratio": 0.35, "hardness": 2e9, "material_class": "polymer"}
STEEL = {"youngs_modulus": 2.1e11, "poissons_ratio": 0.3, "hardness": 2e9, "material_class": "metal"}
FILM = {"material": "titanium_nitride", "thickness": "1 um", "bodies": "first"}


def predicted(load, **given):
    contact = {"second": RIGID, "roughness": ROUGH, "nominal_area": 1e-4, "interfacial_shear_strength": 1e6} | given
    return st.predict(st.Contact(**contact), load=load)


@pytest.mark.parametrize(
    ("given", "load", "said", "changes"),
    [
        ({"first": SOFT}, 500.0, "more load, a smaller nominal area or", [{"load": 900.0}, {"nominal_area": 5e-5}]),
        ({"first": PLASTIC}, 1.0, "higher hardness of the softer body", [{"first": PLASTIC | {"hardness": 2e8}}]),
        (
            {"first": ELASTIC}, 1.0, "stiffer or rougher surfaces",
            [{"first": ELASTIC | {"youngs_modulus": 4e9}}, {"roughness": ROUGH | {"asperity_radius": 1e-5}}],
        ),
        ({"first": SOFT, "work_of_adhesion": 0.05}, 1.0, "less adhesion or", [{"work_of_adhesion": 0.01}]),
        ({"first": STEEL, "coating": FILM}, 1.0, "a harder body below the film", [{"first": STEEL | {"hardness": 4e9}}]),
    ],
)  # fmt: skip
def test_each_change_lowers_mu(given, load, said, changes):
    before = predicted(load, **given)
    record = answer_record(before)
    assert said in record["lowered_by"] and "a lower strength tau_0" in record["lowered_by"]
    for change in [{"interfacial_shear_strength": 5e5}, *changes]:
        changed = given | change
        after = answer_record(predicted(changed.pop("load", load), **changed))
        assert after["friction_coefficient"] < 0.95 * record["friction_coefficient"], change


@pytest.mark.parametrize(
    ("first", "interface", "said"),
    [
        (STEEL | {"hardness": 2e8}, "clean metal", "a weaker interface (boundary lubricant)"),
        (ELASTIC, {"strength_over_shear_modulus": 0.01}, "rougher surfaces; no weaker interface is known"),
    ],
)
def test_a_strength_that_is_relative_to_the_body_grows_with_it(first, interface, said):
    """Hardness or stiffness that raises pressure and strength alike is no way to a lower mu."""
    given = {"first": first, "interface": interface, "interfacial_shear_strength": None}
    name = "hardness" if interface == "clean metal" else "youngs_modulus"
    before, after = (answer_record(predicted(1.0, **given | {"first": first | {name: f * first[name]}})) for f in (1.0, 2.0))
    assert before["lowered_by"] == said
    assert after["friction_coefficient"] == pytest.approx(before["friction_coefficient"], rel=0.1)


SILVER = {"coating": {"material": "silver", "thickness": "1 um", "bodies": "first"}}


@pytest.mark.parametrize(
    ("bodies", "interface", "weaker"),
    [
        ("copper", "oxidised metal", "boundary lubricant"),
        ("copper", None, "monolayer"),
        ("copper", "boundary lubricant", "monolayer"),
        ("copper", "monolayer", None),  # it is the weakest at the pressure of so soft a metal
        ("silicon", None, "boundary lubricant"),
        ("silicon", "monolayer", "layered solid"),
        ("hardened_steel_52100", "soft-metal film", "monolayer"),
        ("diamond_like_carbon", "DLC humid", "DLC dry"),
        ("ice", None, None),
        ("silicone_rubber", "elastomer", None),
    ],
)
def test_a_weaker_state_is_named_and_lowers_mu(bodies, interface, weaker):
    """A reader was told to use a weaker interface, and not which."""
    given = {"first": bodies, "second": bodies, "interfacial_shear_strength": None} | (
        SILVER if interface == "soft-metal film" else {}
    )
    before = answer_record(predicted(1.0, **given, interface=interface))
    if weaker is None:
        assert "no weaker interface is known" in before["lowered_by"]
        return
    assert f"a weaker interface ({weaker}" in before["lowered_by"]
    after = answer_record(predicted(1.0, **given, interface=weaker))
    assert after["friction_coefficient"] < 0.95 * before["friction_coefficient"]
