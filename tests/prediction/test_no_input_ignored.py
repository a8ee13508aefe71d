"""Every field of a contact and its case changes a prediction, is named as not used, or is refused in one line."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import stiction as st
from stiction.case.read import parse_case
from stiction.cli import app
from stiction.contact.coating import Coating
from stiction.contact.liquid import Liquid
from stiction.contact.materials import Material
from stiction.surfaces.measured import MeasuredRoughness
from stiction.surfaces.roughness import Roughness

BODY = {
    "youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": "2 GPa", "yield_stress": "0.65 GPa",
    "tangent_modulus": "4 GPa", "characteristic_depth": "100 nm", "surface_energy": "1 J/m^2", "material_class": "metal",
}  # fmt: skip
SURFACE = {"asperity_height_deviation": "50 nm", "asperity_radius": "5 um", "asperity_density": "1.6e11 1/m^2"}
SHAPE = {"kind": "worn", "skewness": -0.7, "kurtosis": 9.0, "texture_aspect_ratio": 0.8}
ROUGH = {**SURFACE, **SHAPE, "height_distribution": "weibull", "height_parameters": {"exponent": 3.0}}
LIQUID = {
    "relative_humidity": 0.6, "contact_angle_first": "10 deg", "contact_angle_second": "20 deg", "temperature": "290 K",
    "surface_tension": "70 mN/m", "molar_volume": "18 cm^3/mol",
}  # fmt: skip
FILM = {
    "material": {**BODY, "hardness": "1 GPa", "youngs_modulus": "80 GPa", "yield_stress": "0.3 GPa"}, "thickness": "100 nm",
    "work_of_adhesion": "0.2 J/m^2", "bodies": "first",
}  # fmt: skip
BARE = {
    "first": BODY, "second": {**BODY, "hardness": "2.02 GPa"}, "roughness": {**SURFACE, **SHAPE},
    "work_of_adhesion": "0.3 J/m^2", "nominal_area": "1 mm^2", "interfacial_shear_strength": "100 MPa",
    "pressure_coefficient": 0.05, "strength_variation": 0.4, "weakening_slip": "5 nm",
    "residual_strength": 0.6, "hold_time": "100 s", "reference_time": "1 s",
    "ageing_rate": 0.02, "liquid": LIQUID,
}  # fmt: skip
CONTACTS = {
    "bare": BARE,
    "coated": {**BARE, "coating": FILM},
    "coated, other heights": {**BARE, "coating": FILM, "roughness": ROUGH},
    "interface at its limit": {**BARE, "interfacial_shear_strength": "0.5 GPa", "hardness_to_yield": 2.9},
    "coated, yield stated twice": {**BARE, "coating": FILM, "hardness_to_yield": 2.9},
}
OTHER = {
    "material_class": "ceramic", "bodies": "both", "kind": "gaussian", "height_distribution": "exponential",
    "height_parameters": {"exponent": 2.0}, "range": {"poissons_ratio": [0.2, 0.4]}, "interface": "oxidised metal",
    "surface": {**SURFACE, "asperity_radius": "4 um"}, "hardness_to_yield": 2.6, "friction_constant": "2 N/m", "peeling": 0.5,
}  # fmt: skip
# What tells of where numbers are from, and is no input.
NOTES = {"name", "source"}
FIELDS = {
    "": st.Contact, "first": Material, "second": Material, "coating": Coating, "coating.material": Material,
    "roughness": Roughness, "liquid": Liquid,
}  # fmt: skip
TABLES = {"first", "second", "coating", "coating.material", "roughness", "liquid"}
PLACES = [
    (place, field)
    for place, form in FIELDS.items()
    for field in form.model_fields
    if field not in NOTES and f"{place}.{field}".strip(".") not in TABLES
]


def predicted(contact, load="0.5 N", **tables):
    return st.predict({"contact": contact, "solve": {"load": load}, "uncertainty": {"count": 64}} | tables)


def scaled(value, factor):
    """A number with its unit, changed by a factor."""
    if not isinstance(value, str):
        return factor * value
    head, _, unit = value.partition(" ")
    return f"{factor * float(head)!r} {unit}"


def with_other(contact, place, field, factor):
    """The contact with another value of the field; None where it has no such place."""
    tree = {name: dict(part) if isinstance(part, dict) else part for name, part in contact.items()}
    table = tree
    for step in place.split(".") if place else []:
        if step not in table:
            return None
        table[step] = dict(table[step])
        table = table[step]
    if field == "interface":
        for name in ("interfacial_shear_strength", "pressure_coefficient"):
            tree.pop(name)
    if field == "height_parameters" and "height_distribution" not in table:
        return None
    if field == "height_distribution":
        table.pop("height_parameters", None)
    if field not in OTHER and field not in table:
        return None
    if field in OTHER and table.get(field) == OTHER[field]:
        return None
    table[field] = OTHER[field] if field in OTHER else scaled(table[field], factor)
    return tree


@pytest.fixture(scope="module")
def nominal():
    return {name: predicted(contact) for name, contact in CONTACTS.items()}


def named(data, place, field):
    return any(text.startswith(f"{place}.{field} (".lstrip(".")) for text in data.attrs["inputs_not_used"])


@pytest.mark.parametrize(("place", "field"), PLACES, ids=lambda part: part or "contact")
def test_no_field_is_ignored(place, field, nominal):
    if field == "burgers_vector":  # only one law uses it
        with pytest.raises(st.InputError) as refused:
            predicted(BARE | {field: "0.25 nm"})
        assert refused.value.field == field and "hurtado_kim_1999" in str(refused.value) + refused.value.hint
        return
    seen = 0
    for name, contact in CONTACTS.items():
        for factor in (0.8, 0.2):
            changed = with_other(contact, place, field, factor)
            if changed is None:
                continue
            seen += 1
            try:
                found = predicted(changed)
            except st.InputError as error:
                assert error.field == f"{place}.{field}".strip("."), error
                assert "--model" in error.hint
                return
            if named(found, place, field):
                continue
            names = [str(one) for one in found.data_vars]
            if all(np.array_equal(found[one], nominal[name][one]) for one in names):
                continue
            return  # somewhere it counts
    if field == "material_class":  # of a stated interface it decides whether junctions grow
        free = {key: part for key, part in BARE.items() if key not in ("interfacial_shear_strength", "pressure_coefficient")}
        free |= {"coating": FILM} if place.startswith("coating") else {}
        one, other = (predicted(part) for part in (free, with_other(free, place, field, 1.0)))
        assert not np.array_equal(one.friction_coefficient, other.friction_coefficient)
        return
    assert seen and named(found, place, field)


@pytest.mark.parametrize("place", ["first", "coating.material"])
def test_what_is_named_changes_nothing_and_what_is_not_does(place):
    """A yield stress counts where the interface is about as strong as the body, and not where it is weak."""
    brittle = {"material_class": "ceramic"}  # no metal junction, which grows
    film = {**FILM, "material": {**FILM["material"], **brittle}}
    for strength, counts in (("1 MPa", False), ("10 GPa", True)):
        coating = {"coating": film} if place.startswith("coating") else {}
        contact = {**BARE, **coating, "interfacial_shear_strength": strength, "first": {**BODY, **brittle}}
        found = predicted(contact)
        assert named(found, place, "yield_stress") is not counts
        changed = predicted(with_other(contact, place, "yield_stress", 0.7))
        assert np.array_equal(found.friction_coefficient, changed.friction_coefficient) is not counts


def test_a_pressure_coefficient_counts_beside_no_strength():
    left = ("interfacial_shear_strength", "pressure_coefficient", "weakening_slip", "residual_strength")
    contact = {key: part for key, part in BARE.items() if key not in left}
    without, small, large = (
        predicted({**contact, **more}) for more in ({}, *({"pressure_coefficient": c} for c in (0.1, 0.5)))
    )
    assert (
        large.friction_coefficient > small.friction_coefficient + 0.3
        and small.friction_coefficient != without.friction_coefficient
    )


def test_a_scan_names_the_ways_of_finding_asperities_that_do_not_count():
    spectrum = st.SelfAffine(hurst=0.8, rolloff=10e-6, shortest=1e-6, deviation=8e-9)
    surface = st.gaussian_surface((64, 64), (20e-6, 20e-6), spectrum, seed=3)
    stated = {
        "method": "mccool", "form": 2, "spikes": 3.0, "fill": "nearest", "shortest": "2 um", "longest": "8 um",
        "heights": "empirical", "kind": "ground",
    }  # fmt: skip
    assert {"first", "second", *stated} == set(MeasuredRoughness.model_fields)
    contact = {**BARE, "first": {**BODY, "hardness": "90 GPa"}, "second": {**BODY, "hardness": "80 GPa"}}
    del contact["liquid"], contact["work_of_adhesion"]
    plain = predicted({**contact, "roughness": {"first": surface}})
    for name, value in stated.items():
        more = {"spikes": 3.0} if name == "fill" else {}  # so that there is something to fill
        found = predicted({**contact, "roughness": {"first": surface, name: value, **more}})
        other = predicted({**contact, "roughness": {"first": surface, **more}}) if more else plain
        if not named(found, "roughness", name):
            assert not np.array_equal(found.contact_area, other.contact_area), name


def test_the_kind_of_a_profile_counts_and_is_advised_until_it_is_stated():
    spectrum = st.SelfAffine(hurst=0.8, rolloff=20e-6, shortest=2e-6, deviation=2e-7)
    heights = st.gaussian_surface((512, 512), (200e-6, 200e-6), spectrum, seed=3).heights[:1]
    hard = {**BODY, "hardness": "90 GPa", "material_class": "ceramic"}
    contact = {"first": hard, "second": hard, "nominal_area": "1 mm^2", "interfacial_shear_strength": "100 MPa"}
    rough = {"first": st.HeightMap(heights, size=(0.4e-6, 200e-6))}
    unstated = predicted({**contact, "roughness": rough})
    assert "kind of surface is not stated" in unstated.attrs["warnings"][0] and "kind = " in unstated.attrs["next_step"]
    for kind in ("gaussian", "worn"):
        stated = predicted({**contact, "roughness": {**rough, "kind": kind}})
        assert not np.array_equal(stated.contact_area, unstated.contact_area) and not named(stated, "roughness", "kind")
        assert "kind = " not in stated.attrs["next_step"]
    by_averages = predicted({**contact, "roughness": {**rough, "heights": "empirical"}})
    assert named(by_averages, "roughness", "heights")
    listed = {**rough, "heights": "empirical", "method": "three_point"}
    areas = [predicted({**contact, "roughness": {**listed, **more}}).contact_area for more in ({}, {"kind": "worn"})]
    assert not np.array_equal(*areas)


def test_laws_that_a_case_names_are_named():
    case = {"contact": BARE, "solve": {"load": "0.5 N", "tangential": "tabor_1959", "model": "soft_coating_2015"}}
    said = st.predict(parse_case(case)).attrs["inputs_not_used"]
    assert [text.split(" (")[0] for text in said[-2:]] == ["solve.model = soft_coating_2015", "solve.tangential = tabor_1959"]


def test_the_table_of_uncertainty_counts():
    wide = predicted(BARE)
    assert wide.sizes["sample"] == 64 and wide.attrs["level"] == 0.9
    narrow = predicted(BARE, uncertainty={"count": 128, "coverage": 0.5, "seed": 7})
    assert narrow.sizes["sample"] == 128 and narrow.attrs["level"] == 0.5
    mu = narrow.friction_coefficient_samples.values
    assert narrow.friction_coefficient_low.item() == pytest.approx(np.quantile(mu, 0.25), rel=1e-12)
    other = predicted(BARE, uncertainty={"count": 128, "coverage": 0.5, "seed": 8})
    assert not np.array_equal(mu, other.friction_coefficient_samples)


COMMAND = """
[contact]
first = "copper"
second = "copper"
nominal_area = "1 mm^2"
interfacial_shear_strength = "30 MPa"
work_of_adhesion = "50 mJ/m^2"
[contact.roughness]
asperity_height_deviation = "0.1 um"
asperity_radius = "10 um"
asperity_density = "3e10 1/m^2"
[solve]
load = "1 N"
"""


def called(tmp_path, text, *words):
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    done = CliRunner().invoke(app, [words[0], str(tmp_path / "case.toml"), *words[1:]], terminal_width=300)
    return done.exit_code, " ".join(done.output.split())


def test_a_refused_input_ends_in_one_line_and_models_are_compared_all_the_same(tmp_path):
    text = COMMAND.replace("[contact]", "[contact]\npeeling = 0.5")
    code, said = called(tmp_path, text, "run")
    assert code == 2 and said.startswith("stiction: peeling: 0.5; allowed: no value in a prediction, which cannot use it")
    assert said.endswith("use --model soft_coating_2015")
    named = called(tmp_path, text.replace("interfacial_shear_strength", "# "), "run", "--model", "soft_coating_2015")
    assert named[0] == 0 and "peeling is not used" not in named[1]
    code, said = called(tmp_path, text, "compare")
    assert code == 0 and "no prediction peeling: 0.5" in said and "soft_coating_2015" in said


def test_the_commands_name_what_is_not_used(tmp_path):
    text = COMMAND.replace('"copper"', '{ preset = "copper", tangent_modulus = "1 GPa" }', 1)
    line = "not used first.tangent_modulus (no area model includes hardening)"
    for command in ("run", "compare"):
        assert line in called(tmp_path, text, command)[1] and "not used" not in called(tmp_path, COMMAND, command)[1]
    answer = json.loads(called(tmp_path, text, "run", "--json")[1])["answer"]
    assert answer["inputs_not_used"] == [line.removeprefix("not used ")]


def test_a_kind_counts_beside_heights_that_are_not_gaussian():
    contact = {
        "first": "hardened_steel_52100",
        "second": "silicon_nitride",
        "interface": "ceramic",
        "nominal_area": "0.01 mm^2",
        "roughness": {
            "asperity_height_deviation": "32 nm",
            "asperity_radius": "330 nm",
            "asperity_density": "1.7e13 1/m^2",
            "height_distribution": "weibull",
            "height_parameters": {"exponent": 12.2},
        },
    }
    without = predicted(contact)
    known = predicted(contact | {"roughness": contact["roughness"] | {"kind": "gaussian"}})
    assert known.friction_coefficient_high < 0.5 * without.friction_coefficient_high
    assert not any("roughness.kind" in one for one in known.inputs_not_used)
