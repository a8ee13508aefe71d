"""A law that knows no menisci says so where they would pull with much of the load: no model is silent about the liquid."""

import math

import pytest
from scipy.integrate import quad
from scipy.stats import norm

import stiction as st
from cases import SILICON_ON_SILICON
from stiction.case.read import parse_case
from stiction.laws.validity import doubts_of
from stiction.report.comparison_doubts import said_of_liquid
from stiction.report.comparison_rows import at_load_rows, comparison
from stiction.report.report_sections import comparison_lines
from stiction.report.tables import comparison_summary, comparison_table
from stiction.studies.findings import find_out


def humid(humidity):
    angles = {"contact_angle_first": "10 deg", "contact_angle_second": "10 deg"}
    return SILICON_ON_SILICON.replace(liquid=st.Liquid(relative_humidity=humidity, temperature="20 degC", **angles))


def said_of_the_liquid(result):
    return [one for one in doubts_of(result) if one.quantity == "meniscus_share" and "left out" in one.why]


@pytest.mark.parametrize("model", ["persson_2001", "persson_widened", "bush_gibson_thomas_1975"])
def test_theories_in_closed_form(model):
    (doubt,) = said_of_the_liquid(st.solve(humid(0.9), load="1 mN", model=model))
    assert "the liquid is left out" in doubt.why and doubt.kind == "effect"
    assert not said_of_the_liquid(st.solve(humid(0.3), load="1 mN", model=model))  # 5 % of the load
    assert not said_of_the_liquid(st.solve(SILICON_ON_SILICON, load="1 mN", model=model))


def test_a_sum_that_is_told_to_leave_them_out():
    """By how much: the pull of all asperities nearer than a meniscus is high, by an integral over the heights."""
    contact, given = humid(0.9), {"load": "1 mN", "model": "greenwood_williamson_1966"}
    assert not said_of_the_liquid(st.solve(contact, **given))
    dry = st.solve(contact, meniscus="none", **given)
    (doubt,) = said_of_the_liquid(dry)
    number = 1e13 * 1e-8
    apart = float(norm.isf(float(dry["touching_asperities"]) / number))
    height = contact.liquid.height / 10e-9
    near, _ = quad(lambda z: norm.pdf(z) * (1.0 - (apart - z) / height), apart - height, apart)
    whole = 4.0 * math.pi * 1e-6 * contact.liquid.tension * math.cos(math.radians(10.0))
    assert doubt.most == pytest.approx(number * (near + norm.sf(apart)) * whole / 1e-3, rel=1e-3)


def test_a_comparison_says_it_of_every_theory_in_closed_form():
    data = st.compare(humid(0.9), load="1 mN")
    for model in ("bush_gibson_thomas_1975", "greenwood_2006"):
        assert "the liquid is left out" in data["outside_validity"].sel(model=model).item()
    assert "the liquid is left out" not in data["outside_validity"].sel(model="greenwood_williamson_1966").item()


# Theories of the whole surface: they have no single asperities for a liquid to bridge.
DRY = {
    "bush_gibson_thomas_1975", "ciavarella_greenwood_paggi_2008", "greenwood_2006", "hariri_zu_ben_mrad_2006", "persson_2001",
    "persson_2001_elastoplastic", "persson_widened", "wang_muser_2017", "xu_zhu_xiao_zhou_2024", "yang_persson_2008",
}  # fmt: skip


@pytest.mark.parametrize("humidity", [0.3, 0.9])
def test_a_comparison_says_which_models_leave_out_the_liquid(humidity):
    """Also where it pulls with little: mu is then too low by the share of the load with which it pulls."""
    data = st.compare(humid(humidity), load="1 mN")
    said = dict(zip(data["model"].values.tolist(), data["liquid"].values.tolist(), strict=True))
    assert {name for name, one in said.items() if one == "left out"} == DRY
    assert {one for name, one in said.items() if name not in DRY} == {"taken"}
    pull = data["liquid_pull_left_out"].sel(model="bush_gibson_thomas_1975").item()
    share = st.solve(humid(humidity), load="1 mN", model="greenwood_williamson_1966")["load_meniscus"].item() / -1e-3
    assert pull == pytest.approx(share, rel=0.25)  # of a dry contact, whose asperities are a little farther apart
    line = said_of_liquid(data)
    assert line.startswith("the liquid is left out, which would pull with up to ") and "mu is too low" in line
    assert all(name in line for name in DRY) and "greenwood_williamson_1966" not in line
    shown = [one.plain for one in comparison_summary(data)]
    assert line in shown and [column.header for column in comparison_table(data).columns][-2] == "liquid"
    rows = {row["model"]: row for row in comparison(data)["models"]}
    assert rows["persson_2001"]["liquid"] == "left out" and rows["greenwood_williamson_1966"]["liquid"] == "taken"
    heads, cells = at_load_rows(data)
    assert {row[heads.index("liquid")] for row in cells} == {"taken", "left out"}
    best = data.attrs["recommended"]
    assert ("leaves out the liquid" in data.attrs["reason"]) == (best in DRY)


def test_the_report_says_it_too():
    tables = {
        "contact": {
            "first": "silicon", "second": "silicon", "nominal_area": "0.01 mm^2", "interfacial_shear_strength": "100 MPa",
            "roughness": {"asperity_height_deviation": "10 nm", "asperity_radius": "1 um", "asperity_density": "1e13 1/m^2"},
            "liquid": {"relative_humidity": 0.3, "contact_angle_first": "10 deg", "contact_angle_second": "10 deg"},
        },
        "solve": {"load": "1 mN", "model": "greenwood_williamson_1966"},
    }  # fmt: skip
    lines = comparison_lines(find_out(parse_case(tables)))["lines"]
    assert any(line.startswith("The liquid is left out, which would pull") for line in lines)


def test_nothing_is_said_of_a_dry_contact():
    data = st.compare(SILICON_ON_SILICON, load="1 mN")
    assert set(data["liquid"].values) == {""} and said_of_liquid(data) == ""
    assert "liquid" not in [column.header for column in comparison_table(data).columns]
    assert "liquid" not in data.attrs["reason"]
