"""A law that knows no menisci says so where they would pull with much of the load: no model is silent about the liquid."""

import math
import re

import pytest
from scipy.integrate import quad
from scipy.stats import norm

import stiction as st
from cases import SILICON_ON_SILICON
from stiction.laws.validity import warnings_of
from stiction.quantities.table import QUANTITIES
from stiction.report.views.comparison import groups_of


def humid(humidity):
    angles = {"contact_angle_first": "10 deg", "contact_angle_second": "10 deg"}
    return SILICON_ON_SILICON.replace(liquid=st.Liquid(relative_humidity=humidity, temperature="20 degC", **angles))


def said_of_the_liquid(result):
    return [one for one in warnings_of(result) if one.quantity == "meniscus_share" and one.kind == "effect"]


@pytest.mark.parametrize("model", ["persson_2001", "persson_widened", "bush_gibson_thomas_1975"])
def test_theories_in_closed_form(model):
    (warning,) = said_of_the_liquid(st.solve(humid(0.9), load="1 mN", model=model))
    assert warning.least > 0.1
    assert not said_of_the_liquid(st.solve(humid(0.3), load="1 mN", model=model))  # 5 % of the load
    assert not said_of_the_liquid(st.solve(SILICON_ON_SILICON, load="1 mN", model=model))


def test_a_sum_that_is_told_to_leave_them_out():
    """By how much: the pull of all asperities nearer than a meniscus is high, by an integral over the heights."""
    contact, given = humid(0.9), {"load": "1 mN", "model": "greenwood_williamson_1966"}
    assert not said_of_the_liquid(st.solve(contact, **given))
    dry = st.solve(contact, meniscus="none", **given)
    (warning,) = said_of_the_liquid(dry)
    number = 1e13 * 1e-8
    apart = float(norm.isf(float(dry["touching_asperities"]) / number))
    height = contact.liquid.height / 10e-9
    near, _ = quad(lambda z: norm.pdf(z) * (1.0 - (apart - z) / height), apart - height, apart)
    whole = 4.0 * math.pi * 1e-6 * contact.liquid.tension * math.cos(math.radians(10.0))
    assert warning.most == pytest.approx(number * (near + norm.sf(apart)) * whole / 1e-3, rel=1e-3)


def test_a_comparison_says_it_of_every_theory_in_closed_form():
    data, symbol = st.compare(humid(0.9), load="1 mN"), QUANTITIES["meniscus_share"].symbol
    left_out = re.compile(re.escape(symbol) + r" = \S+, not 0 to 0\.1:")
    for model in ("bush_gibson_thomas_1975", "greenwood_2006"):
        assert left_out.search(data["outside_validity"].sel(model=model).item())
    assert not left_out.search(data["outside_validity"].sel(model="greenwood_williamson_1966").item())


@pytest.mark.parametrize("humidity", [0.3, 0.9])
def test_every_row_of_a_comparison_says_that_a_model_leaves_out_the_liquid(humidity):
    data = st.compare(humid(humidity), load="1 mN")
    told = {
        name for name, text in zip(data["model"].values, data["status"].values, strict=True) if "without the liquid" in text
    }
    assert told == DRY & set(data["model"].values) and len(told) < data.sizes["model"]
    for group in groups_of(data):
        assert len({name in DRY for name in group.names}) == 1 or not group.fits
    dry = st.compare(SILICON_ON_SILICON, load="1 mN")
    assert not any("liquid" in text for text in dry["status"].values)


# Theories of the whole surface: they have no single asperities for a liquid to bridge.
DRY = {
    "bush_gibson_thomas_1975", "ciavarella_greenwood_paggi_2008", "greenwood_2006", "hariri_zu_ben_mrad_2006", "persson_2001",
    "persson_2001_elastoplastic", "persson_widened", "wang_muser_2017", "xu_zhu_xiao_zhou_2024", "yang_persson_2008",
}  # fmt: skip
