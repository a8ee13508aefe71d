"""The answer card says mu, how sure it is, and what to do, in few words."""

import re

import numpy as np
import pytest
from scipy.stats import norm

import stiction as st
from stiction.quantities.shown import show
from stiction.report.answer import (
    answer_lines,
    at_working_load,
    confidence,
    confidence_in,
    confidence_in_words,
    working_load_in_words,
)
from stiction.report.card import Card, card_of, shortened
from stiction.studies.prediction.measured import CONTRADICTS, interval_after_measuring
from stiction.studies.prediction.regime import without_commands
from stiction.studies.prediction.uncertainty_sources import main_sources, sources_in_words

CASE = """
[contact]
first = "copper"
second = "copper"
nominal_area = "1 mm^2"
{more}
[contact.roughness]
asperity_height_deviation = "0.2 um"
asperity_radius = "10 um"
asperity_density = "2e10 1/m^2"
kind = "ground"
[solve]
load = ["0.1 N", "1 N", "10 N"]
"""


@pytest.fixture(scope="module")
def predicted(tmp_path_factory):
    path = tmp_path_factory.mktemp("card") / "case.toml"
    path.write_text(CASE.format(more=""))
    return st.predict(path)


def test_the_card_has_the_numbers_of_the_prediction(predicted):
    card, here = card_of(predicted), at_working_load(predicted)
    assert [card.low, card.mu, card.high] == [float(here[f"friction_coefficient{end}"]) for end in ("_low", "", "_high")]
    assert card.warning == "The interface is not stated"
    assert "state the interface" in card.html() and "<details>" in card.html() and "<details>" not in card.html(why=False)
    assert str(st.summary(predicted)).splitlines()[1].split()[:3] == ["mu", "=", f"{float(here['friction_coefficient']):.2g}"]
    assert card.bar() in st.summary(predicted)._repr_html_()


def test_a_case_may_repeat_a_separation(tmp_path):
    """Found by `make fuzz`: equal separations give equal loads, of which one is the working load."""
    path = tmp_path / "case.toml"
    text = CASE.format(more='work_of_adhesion = "50 mJ/m^2"')
    path.write_text(text.replace('load = ["0.1 N", "1 N", "10 N"]', "separation = [1, 1, 1]"))
    predicted = st.predict(path)
    assert at_working_load(predicted)["load"].ndim == 0
    assert card_of(predicted).mu == pytest.approx(float(predicted["friction_coefficient"][0]))
    assert len(answer_lines(predicted)) > 2


def test_the_card_is_short(predicted):
    words = re.sub(r"<[^>]*>", " ", card_of(predicted).html(why=False)).split()
    assert len(words) <= 110


@pytest.mark.parametrize(("low", "high", "word"), [(0.9, 1.1, "high"), (0.5, 2.0, "fair"), (0.1, 10.0, "low")])
def test_confidence_is_by_the_width(low, high, word):
    assert confidence(1.0, low, high) == word
    card = Card(1.0, low, high, 0.9, "1 N", word, "", "", "", [])
    centre, start, width = (
        float(re.findall(rf'{name}="([\d.]+)"', card.bar())[-1]) for name in ("<line x1", "<rect x", " width")
    )
    assert start < centre < start + width


def test_an_interval_that_begins_at_nothing_has_a_bar():
    assert "nan" not in Card(1e-4, 0.0, 50.0, 0.9, "1 N", "low", "", "", "", []).bar()


@pytest.mark.parametrize(
    "warning",
    [
        "12% of the samples are physically impossible and are excluded.",
        "The stated interface is 0.95 times as strong as the weaker body, and junctions grow: if its strength changes.",
        "The scan has 3 long waves, but needs 6: scan more area.",
        "word " * 30,
    ],
)
def test_a_warning_has_twelve_words_at_most(warning):
    assert 0 < len(shortened(warning).split()) <= 12


def test_the_load_of_several_has_their_range(predicted):
    assert card_of(predicted).load == working_load_in_words(predicted) == "1 N (middle of the loads 100 mN to 10 N)"
    assert working_load_in_words(predicted.isel(load=0)) == "100 mN"


def test_the_interval_after_one_measurement_is_that_of_two_normal_distributions():
    """ln mu is normal with s = 0.5, the error 0.15: then s is 0.15 * 0.5 / sqrt(0.15^2 + 0.5^2) = 0.14367, times 1.6449."""
    mu = 0.2 * np.exp(0.5 * norm.ppf((np.arange(512) + 0.5) / 512))
    assert interval_after_measuring(mu, 0.9) == pytest.approx([0.1579, 0.2533], rel=2e-3)


def test_sources_of_uncertainty_are_three_at_most_and_above_5_per_cent():
    sources = main_sources({"a": 0.04, "b": 0.3, "c": 0.2, "d": 0.4, "e": 0.06})
    assert sources[:3] == [("d", 0.4), ("b", 0.3), ("c", 0.2)] and sources[3:] == [("other", pytest.approx(0.1))]
    assert main_sources({"a": 0.03, "b": 0.04})[0] == ("b", 0.04) and main_sources({}) == []


def test_shares_that_are_shown_add_up_to_100_per_cent():
    shares = {"interface": 0.484, "area model": 0.384, "junctions": 0.079, "chance": 0.03}
    assert sources_in_words(shares) == "48% interface strength, 38% contact area model, 8% growth of junctions, 6% other"
    assert sources_in_words({"interface": 0.996}) == "100% interface strength"


@pytest.mark.parametrize(
    ("step", "words"),
    [
        ("measure mu once: stiction fit CASE.toml --data FILE", "measure mu once and fit the case to it"),
        ("measure the surface and give a scan (stiction surface FILE)", "measure the surface and give a scan"),
        ('state the kind of surface, e.g. kind = "ground", and the interface (stiction interfaces)',
         "state the kind of surface, e.g. ground, and the interface"),
    ],
)  # fmt: skip
def test_a_reader_without_a_terminal_gets_no_command(step, words):
    assert without_commands(step) == words


def test_card_and_terminal_say_why_confidence_is_low(predicted):
    names = [f"friction_coefficient{end}" for end in ("_low", "_high")]
    narrow = predicted.assign({name: predicted["friction_coefficient"] for name in names})
    few, contradicted = {"in_handbooks": (1, 2)}, {"measured": 3, "warnings": [CONTRADICTS]}
    for data, words in (
        (predicted.assign_attrs(in_handbooks=(5, 6)), "low (wide interval)"),  # beside "low" their number would contradict it
        (narrow.assign_attrs(few), "low (only 1 of 2 handbook contacts agree)"),
        (narrow.assign_attrs(contradicted), "low (measured friction contradicts the contact)"),
    ):
        said = confidence_in_words(data)
        assert said == words == dict(card_of(data).lines)["Confidence"]
    assert answer_lines(narrow.assign_attrs(few))[0][1].endswith("; confidence: low (only 1 of 2 handbook contacts agree)")


def test_the_card_says_how_many_handbook_contacts_agree(predicted):
    fair = predicted.assign(friction_coefficient_low=0.5 * predicted.friction_coefficient)
    fair["friction_coefficient_high"] = 2.0 * predicted.friction_coefficient
    for contacts, agree in ((6, "5 of 6"), (5, "all 5")):
        told = dict(card_of(fair.assign_attrs(in_handbooks=(5, contacts))).lines)["Confidence"]
        assert told == f"fair; {agree} handbook contacts agree"
    fitted = {"measured": 3, "strength": (2e7, 1e7, 3e7), "grows_with_pressure": True}
    for none in ({"in_handbooks": (0, 0)}, {"in_handbooks": (5, 6)} | fitted):
        assert "handbook" not in dict(card_of(fair.assign_attrs(**none)).lines)["Confidence"]


def test_a_warning_leaves_at_most_fair_confidence(predicted):
    sure = predicted.assign(friction_coefficient_low=0.9 * predicted.friction_coefficient)
    sure["friction_coefficient_high"] = 1.1 * predicted.friction_coefficient
    words = [
        confidence_in(sure.assign_attrs(in_handbooks=(1, 1), warnings=warnings)) for warnings in ([], ["The scan is small."])
    ]
    assert words == ["high", "fair"]


def test_the_scale_of_confidence_stands_beside_its_word(predicted):
    rows = dict(answer_lines(predicted, terminal=False))
    assert rows["confidence"].startswith(
        "low (high: the interval ends within a factor of 1.5 of μ, without a warning; fair: within a factor of 3; low: "
    )
    assert "confidence" not in dict(answer_lines(predicted)) and "stiction" not in " ".join(rows.values())


@pytest.mark.parametrize(
    ("area", "text"), [(5.2e-13, "0.52 µm^2"), (9e-15, "9000 nm^2"), (2.5e-8, "0.025 mm^2"), (1e-6, "1 mm^2")]
)
def test_an_area_has_four_digits_at_most_before_the_point(area, text):
    assert show(area, "contact_area") == text
