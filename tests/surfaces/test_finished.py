"""A surface known by Sq, or by nothing but its finish: medians, draws of R and N, two bodies, refusals, case files."""

import tomllib

import numpy as np
import pytest
from scipy import stats

import stiction as st
from refusals import refusal
from stiction.case.case_tables import json_schema
from stiction.case.read import parse_case
from stiction.case.text import as_toml
from stiction.studies.sensitivity.log_sensitivities import log_sensitivities

ENDS = 2 * stats.norm.ppf(0.95)


def contact(roughness, **more):
    return st.Contact(first="iron", second="copper", roughness=roughness, nominal_area="1 mm^2", **more)


def lognormal(low, high, level):
    return stats.lognorm(s=np.log(high / low) / ENDS, scale=(low * high) ** 0.5).ppf(level)


def by_hand(sq, slope, parameter):
    """sigma, R and N of the summits of a Gaussian surface, from McCool's relations as they are printed, solved for alpha."""
    alpha = 768 * np.pi * parameter**2 + 1 + 16 / np.pi - 27**0.5
    m2 = slope**2 / 2
    m4 = alpha * m2**2 / sq**2
    sigma = (sq**2 * (1 - (1 + 16 / np.pi - 27**0.5) / alpha)) ** 0.5
    return sigma, 3 / 8 * (np.pi / m4) ** 0.5, m4 / m2 / (6 * np.pi * 3**0.5)


def numbers(rough):
    return rough.asperity_height_deviation, rough.asperity_radius, rough.asperity_density


# A ground surface: h' from 0.05 to 0.25, N R sigma from 0.03 to 0.06, Sq from 130 nm to 2 um, as docs/interfaces.md prints.
GROUND = (0.05 * 0.25) ** 0.5, (0.03 * 0.06) ** 0.5


@pytest.mark.parametrize(
    ("table", "sq"),
    [
        ({"rms_height": "0.2 um"}, 0.2e-6),
        ({"mean_height": "0.16 um"}, 1.25 * 0.16e-6),
        ({}, (130e-9 * 2e-6) ** 0.5),
    ],
)
def test_medians(table, sq):
    rough = contact({"finish": "ground"} | table).roughness
    assert numbers(rough) == pytest.approx(by_hand(sq, *GROUND), rel=1e-12)
    assert np.prod(numbers(rough)) == pytest.approx(GROUND[1], rel=1e-12)
    assert rough.asperity_radius == pytest.approx(0.54 * sq / GROUND[0] ** 2, rel=0.1)
    assert rough.surface_kind == "lay"
    assert contact({"finish": "ground", "kind": "worn"} | table).roughness.surface_kind == "worn"


def test_draws_are_those_of_lognormal_slopes_and_parameters():
    rough = contact({"finish": "ground", "rms_height": "0.2 um"}).roughness
    assert rough.unknowns == ("first.rms_slope", "first.roughness_parameter")
    levels = stats.qmc.Sobol(2, rng=1).random(64) * 0.98 + 0.01
    found = rough.drawn(levels.T)
    expected = by_hand(0.2e-6, lognormal(0.05, 0.25, levels[:, 0]), lognormal(0.03, 0.06, levels[:, 1]))
    for mine, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(mine, other, rtol=1e-10)
    np.testing.assert_allclose(np.prod(found, axis=0), lognormal(0.03, 0.06, levels[:, 1]), rtol=1e-10)
    fixed = rough.drawn([levels[:, 0], np.full(64, 0.5)])
    np.testing.assert_allclose(np.prod(fixed, axis=0), GROUND[1], rtol=1e-10)  # N R sigma stays, R and N vary


def test_without_a_height_it_is_drawn_too():
    rough = contact({"finish": "polished"}).roughness
    assert rough.unknowns[-1] == "first.rms_height" and len(rough.unknowns) == 3
    sigma, radius, density = rough.drawn([[0.3], [0.6], [0.95]])
    slope, parameter = lognormal(0.01, 0.08, 0.3), lognormal(0.03, 0.06, 0.6)
    expected = by_hand(lognormal(5e-9, 120e-9, 0.95), slope, parameter)
    assert (sigma[0], radius[0], density[0]) == pytest.approx(expected, rel=1e-10)


def test_moments_of_two_bodies_add():
    table = {"first": {"finish": "ground", "rms_height": "0.2 um"}, "second": {"finish": "polished", "rms_height": "50 nm"}}
    rough, turned = contact(table).roughness, contact({"first": table["second"], "second": table["first"]}).roughness
    assert numbers(rough) == pytest.approx(numbers(turned), rel=1e-12)
    slopes = GROUND[0], (0.01 * 0.08) ** 0.5
    sigma, radius, density = numbers(rough)
    m4 = np.pi * (3 / 8 / radius) ** 2
    m2 = m4 / (6 * np.pi * 3**0.5 * density)
    assert m2 == pytest.approx(sum(slope**2 for slope in slopes) / 2, rel=1e-10)
    assert sigma**2 + (1 + 16 / np.pi - 27**0.5) * m2**2 / m4 == pytest.approx(0.2e-6**2 + 50e-9**2, rel=1e-10)
    alone = [contact(one).roughness for one in table.values()]
    assert m4 == pytest.approx(sum(np.pi * (3 / 8 / one.asperity_radius) ** 2 for one in alone), rel=1e-10)
    assert rough.surface_kind == "lay" and len(rough.unknowns) == 4  # the ground body is much the steeper
    low, high = (rough.drawn(np.full((4, 1), level))[1][0] for level in (0.05, 0.95))
    assert low > radius > high


def test_beside_numbers_and_beside_a_scan():
    stated = {"asperity_height_deviation": "50 nm", "asperity_radius": "20 um", "asperity_density": "4e10 1/m^2"}
    rough = contact({"first": {"finish": "ground", "rms_height": "0.2 um"}, "second": stated}).roughness
    assert rough.unknowns == ("first.rms_slope", "first.roughness_parameter")
    assert rough.asperity_radius < contact({"finish": "ground", "rms_height": "0.2 um"}).roughness.asperity_radius
    heights = np.random.default_rng(3).normal(0.0, 1e-8, (64, 64))
    scan = st.HeightMap(heights, (1e-5, 1e-5))
    with_finish = contact({"first": scan, "second": {"finish": "wafer"}}).roughness
    assert with_finish.measured is not None
    assert with_finish.asperity_height_deviation == pytest.approx(contact(scan).roughness.asperity_height_deviation, rel=0.05)


def test_what_does_not_go_together_is_refused():
    for table, words in (
        (
            {"finish": "ground", "asperity_radius": "1 um"},
            ("roughness.finish", "ground", "asperity_radius"),
        ),
        ({"finish": "grounded"}, ("roughness.finish", "grounded")),
        ({"rms_height": "0.2 um"}, ("roughness.finish",)),
        (
            {"finish": "ground", "rms_height": "1 um", "mean_height": "1 um"},
            ("roughness.mean_height", "1 µm", "rms_height"),
        ),
        ({"finish": "ground", "kind": "rough"}, ("roughness.kind", "rough")),
        ({"finish": "ground", "rms_height": "-1 um"}, ("roughness.rms_height", "> 0 m")),
        ({"first": {"finish": "grounded"}}, ("roughness.first.finish", "grounded")),
    ):
        with refusal(*words):
            contact(table)
    with refusal("levels", "1", "first.rms_slope", "first.roughness_parameter"):
        contact({"finish": "ground", "rms_height": "1 um"}).roughness.drawn([[0.5]])
    stated = st.Roughness(asperity_height_deviation="1 um", asperity_radius="1 um", asperity_density="4e10 1/m^2")
    assert stated.unknowns == ()
    with refusal("levels"):
        stated.drawn([[0.5]])


def test_other_numbers_forget_the_finish_and_its_ranges():
    rough = contact({"finish": "ground", "rms_height": "0.2 um"}).roughness
    assert contact(rough).replace(nominal_area="2 mm^2").roughness.unknowns == rough.unknowns
    other = rough.replace(asperity_radius="7 um")
    assert other.unknowns == () and other.asperity_density == rough.asperity_density and other.surface_kind == "lay"
    higher = rough.replace(rms_height="0.4 um")
    assert numbers(higher) == pytest.approx(by_hand(0.4e-6, *GROUND), rel=1e-12) and higher.unknowns == rough.unknowns


CASE = """
[contact]
first = "iron"
second = "copper"
nominal_area = "1 mm^2"
interface = "oxidised metal"
roughness = ROUGH

[solve]
load = "0.01 N"
model = "persson_widened"
"""


@pytest.mark.parametrize(
    "rough",
    [
        '{ rms_height = "0.2 um", finish = "ground" }',
        '{ first = { mean_height = "0.2 um", finish = "ground" }, second = { finish = "polished" } }',
    ],
)
def test_a_case_states_it(rough):
    tables = tomllib.loads(CASE.replace("ROUGH", rough))
    case, again = parse_case(tables), parse_case(tomllib.loads(as_toml(tables)))
    assert numbers(again.subject.roughness) == numbers(case.subject.roughness)
    assert again.subject.roughness.unknowns == case.subject.roughness.unknowns != ()
    assert any("as of a ground surface: h' 0.11 (90 % within 0.05 to 0.25, grade C)" in line for line in case.subject.remarks())
    assert np.isfinite(log_sensitivities(case, case.choice).tables["friction_coefficient"]).any()


def test_heights_of_a_case_that_are_several_or_lack_a_unit():
    swept = CASE.replace("ROUGH", '{ rms_height = ["0.2 um", "0.4 um"], finish = "ground" }')
    found = parse_case(tomllib.loads(swept)).subject.roughness
    assert found.asperity_radius.values == pytest.approx([by_hand(sq, *GROUND)[1] for sq in (0.2e-6, 0.4e-6)], rel=1e-12)
    with refusal("contact.roughness.rms_height", "2e-07", "> 0 m"):
        parse_case(tomllib.loads(CASE.replace("ROUGH", '{ rms_height = 2e-7, finish = "ground" }')))
    with refusal("contact.roughness.finish", "grounded"):
        parse_case(tomllib.loads(CASE.replace("ROUGH", '{ finish = "grounded" }')))


def test_the_json_schema_has_both_forms():
    definitions = json_schema()["$defs"]
    forms = [one["$ref"].rpartition("/")[2] for one in definitions["Contact"]["properties"]["roughness"]["anyOf"]]
    assert forms == ["Roughness", "MeasuredRoughness", "Finished", "FinishedBodies"]
    assert definitions["Finished"]["required"] == ["finish"]


def test_kinds_of_two_bodies_are_mixed_by_their_slopes():
    """Mean square slopes of moulded and turned bodies are .03 x .13 and .05 x .25: 76 % of 20 to 80 % is the share 0.937."""
    turned = {"finish": "turned", "mean_height": "0.8 um"}
    assert contact({"first": {"finish": "moulded"}, "second": turned}).roughness.surface_kind == "0.063 gaussian + 0.937 lay"
    assert contact({"first": turned, "second": {"finish": "moulded"}}).roughness.surface_kind == "0.937 lay + 0.063 gaussian"
    same = {"first": {"finish": "moulded", "kind": "worn"}, "second": turned | {"kind": "worn"}}
    assert contact(same).roughness.surface_kind == "worn"
    same["first"]["kind"] = "skewed"
    assert contact(same).roughness.surface_kind == "0.063 skewed + 0.937 worn"
    stated = {"asperity_height_deviation": "50 nm", "asperity_radius": "5 um", "asperity_density": "4e10 1/m^2"}
    assert contact({"first": stated, "second": turned}).roughness.surface_kind is None
    assert contact({"first": stated | {"kind": "worn"}, "second": turned}).roughness.surface_kind.endswith("lay")
