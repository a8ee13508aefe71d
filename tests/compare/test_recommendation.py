"""Which model a comparison recommends: the least outside its validity, then what uses a stated shear strength of the interface,
then the best grade, then what takes account of most, and of those alike the middle one by friction.

All that is said of the ranking is in this file: on answers made by hand, where one thing decides at a time, and on contacts,
where it is said beside each what decides.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import stiction as st
from cases import STEEL_ON_STEEL
from stiction.solving.choice import Choice
from stiction.studies.case import read_case
from stiction.studies.comparison import compare, working_load
from stiction.studies.recommendation import Answer, Candidate, recommend

STEEL = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "nominal_area": "1 mm^2"}
SURFACE = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
STATED = {"interfacial_shear_strength": "200 MPa"}


def contact(film=None, **more):
    """Steel on steel, bare or with a film of silver of this thickness."""
    silver = {"material": {"preset": "silver", "hardness": "0.4 GPa"}, "bodies": "first"}
    coated = {} if film is None else {"coating": st.Coating(**silver, thickness=film)}
    return st.Contact(**STEEL, roughness=st.Roughness(**SURFACE), work_of_adhesion="0.1 J/m^2", **coated, **more)


# ---- answers made by hand


def answer(name, mu, outside=0, grade="B", effects=(), of_interface=False):
    """What a model of this name is taken to have said."""
    left = [f"range {number}" for number in range(outside)]
    at_load = None if mu is None else {"friction_coefficient": mu}
    return Answer(
        Candidate(name, Choice()), grade, at_load=at_load, outside=left, effects=list(effects), of_interface=of_interface
    )


BOTH = ("adhesion", "plasticity")
# What decides -> answers, of which the first is to be recommended.
DECIDES = {
    "fewest ranges left": [
        answer("a", 0.9, 1, "C"),
        answer("b", 0.2, 2, "A", BOTH, True),
        answer("c", 0.1, 3, "A", BOTH, True),
    ],
    "none left": [answer("a", 0.9, 0, "C"), answer("b", 0.2, 1, "A", BOTH, True)],
    "the stated strength": [answer("a", 0.9, of_interface=True, grade="C"), answer("b", 0.2, grade="A", effects=BOTH)],
    "the stated strength, also below": [answer("a", 0.1, of_interface=True), answer("b", 0.2, effects=BOTH)],
    "the grade": [answer("a", 0.9, grade="A"), answer("b", 0.2, grade="B", effects=BOTH), answer("c", 0.1, grade="C")],
    "what is taken account of": [answer("a", 0.9, effects=BOTH), answer("b", 0.2, effects=BOTH[:1]), answer("c", 0.1)],
    "the middle of three": [answer("a", 0.5), answer("b", 0.9), answer("c", 0.1)],
    "the lower middle of two": [answer("a", 0.2), answer("b", 0.3)],
    "the lower middle of four": [answer("a", 0.2), answer("b", 0.3), answer("c", 0.9), answer("d", 0.1)],
    "the middle of five": [answer("a", 0.3), answer("b", 0.2), answer("c", 0.9), answer("d", 0.1), answer("e", 0.8)],
    "that something is said": [answer("a", 0.9, 5, "C"), answer("b", np.nan, 0, "A"), answer("c", None, 0, "A", BOTH, True)],
}


@pytest.mark.parametrize("turned", (False, True))
@pytest.mark.parametrize("what", DECIDES)
def test_what_decides(what, turned):
    answers = DECIDES[what]
    best, _ = recommend(answers[::-1] if turned else answers)
    assert best is answers[0]


def test_the_reason_says_what_decided():
    best, reason = recommend([answer("a", 0.2, effects=BOTH, of_interface=True), answer("b", 0.1, 2), answer("c", 0.4, 1)])
    assert best.candidate.name == "a"
    assert reason.startswith("within its validity here, as 1 of the 3 models that predict friction are; ")
    assert "uses the stated shear strength of the interface" in reason and "takes account of adhesion and plasticity" in reason
    _, reason = recommend([answer("a", 0.2, 1), answer("b", 0.1, 2)])
    assert reason.startswith("no model is within its validity here, and this leaves the fewest ranges (1); grade B")
    _, reason = recommend([answer(name, mu) for name, mu in (("a", 0.1), ("b", 0.2), ("c", 0.3))])
    assert reason.endswith("; the middle one of 3 alike")
    assert "shear strength" not in reason and "takes account" not in reason


def test_nothing_is_recommended_where_nothing_is_said():
    assert recommend([answer("a", None), answer("b", np.nan)]) == (None, "no model says anything of friction at this load")


# ---- contacts


def said(subject, load):
    """name -> (ranges left, grade, friction coefficient) of the models that predict friction, and the dataset."""
    data = compare(subject, load=load)
    told = {}
    for name in data["model"].values:
        one = data.sel(model=name)
        mu = float(one["friction_coefficient_at_load"])
        if np.isfinite(mu):
            left = [line for line in one["outside_validity"].item().split("; ") if line]
            told[str(name)] = len(left), one["grade"].item(), mu
    return told, data


def test_the_lower_middle_one_of_four_elastic_plastic_ones():
    """Four laws of grade B know of yield or of adhesion beside the stated strength; by friction the second is taken. More are
    as good but take account of neither, and are not: Greenwood & Williamson, Bush, Gibson & Thomas, Persson."""
    alike = ["maugis_1992", "jackson_green_2005", "zhao_maietta_chang_2000", "persson_2001_elastoplastic"]
    told, data = said(contact(**STATED), "3 kN")
    assert [told[name][:2] for name in alike] == [(0, "B")] * 4
    mu = [told[name][2] for name in alike]
    assert np.all(np.diff(mu) > 1e-4)
    assert told["greenwood_williamson_1966"][:2] == told["bush_gibson_thomas_1975"][:2] == (0, "B")
    assert data.attrs["recommended"] == "jackson_green_2005" and "the middle one of 4 alike" in data.attrs["reason"]


def test_without_a_stated_strength_the_best_grade():
    """Three are within their validity; one of them has the grade B."""
    told, data = said(contact(), "10 N")
    grades = {name: grade for name, (left, grade, _) in told.items() if left == 0}
    assert grades == {"chang_etsion_bogy_1988": "B", "kogut_etsion_2004": "C", "cohen_kligerman_etsion_2008": "C"}
    assert data.attrs["recommended"] == "chang_etsion_bogy_1988"


def test_what_knows_more_but_not_the_stated_strength_comes_after():
    """The graded film takes account of adhesion too, within its validity, but has a friction of its own; without a stated
    strength it is the one to take."""
    told, data = said(contact("200 nm", **STATED), "1 N")
    assert [told[name][:2] for name in ("halling_1979", "graded")] == [(0, "C")] * 2
    assert told["chang_1997"][0] and told["liu_neville_reuben_2002"][0]  # all of the film is not plastic
    assert data.attrs["recommended"] == "halling_1979"
    assert compare(contact("200 nm"), load="1 N").attrs["recommended"] == "graded"


@pytest.mark.parametrize(
    ("load", "recommended", "share"), (("1 N", "maugis_1992 + sequential", 0), ("1 kN", "halling_1979", 1))
)
def test_validity_is_that_at_the_working_load(load, recommended, share):
    """The film law of the paper is for contact spots that are smaller than the film is thick: so they are under a light load
    and not under a heavy one, and the curves, pressed to a mean separation of -2 sigma, go through both."""
    subject = contact("1.5 um", **STATED)
    name = "maugis_1992 + sequential"
    told, data = said(subject, load)
    assert told[name][0] == share and data.attrs["recommended"] == recommended
    single = st.solve(
        subject, load=load, model="greenwood_williamson_1966", asperity="maugis_1992", tangential="bowden_tabor_1943",
        film="sequential",
    )  # fmt: skip
    assert (float(single["load_share_beyond_film"]) > 0.5) == bool(share)
    assert_allclose(told[name][2], float(single["friction_coefficient"]), rtol=1e-9)
    assert bool(single.attrs["outside_validity"]) == bool(share)
    anywhere = compare(subject).sel(model=name)["outside_validity"].item()  # no working load: along the curve
    assert "contact radius below thickness" in anywhere


# Points of a case -> the working load by default: the lower of two middle ones.
MIDDLES = {
    'load = ["1 N", "10 N"]': 1.0,
    'load = ["1 N", "2 N", "10 N", "20 N"]': 2.0,
    'load = ["20 N", "10 N", "2 N", "1 N"]': 10.0,
    'load = ["0 N", "-1 mN", "3 N", "4 N"]': 3.0,
}


@pytest.mark.parametrize("points", MIDDLES)
def test_the_working_load_of_an_even_number(points, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(f'title = "Steel on steel"\n{STEEL_ON_STEEL}[solve]\n{points}\n')
    assert working_load(read_case(path), None) == MIDDLES[points]
