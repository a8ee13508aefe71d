"""Which model a comparison recommends: the weighted median of its family, each weighing by how well it is founded.

All that is said of the ranking is in this file and in test_six_contacts: on answers made by hand, where one thing decides at a
time, and on contacts, where it is said beside each what decides.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import stiction as st
from cases import STEEL_ON_STEEL
from stiction.case.read import read_case
from stiction.laws.validity import Doubt
from stiction.solving.accuracy.errors_near import NORMAL_SCORES
from stiction.solving.accuracy.measured_error import MeasuredErrors
from stiction.solving.candidates import Candidate
from stiction.solving.choice import Choice
from stiction.studies.comparison.compare import compare, working_load
from stiction.studies.comparison.recommendation import TOO_MUCH, Answer, recommend

STEEL = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "nominal_area": "1 mm^2"}
SURFACE = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
STATED = {"interfacial_shear_strength": "200 MPa"}


def contact(film=None, **more):
    """Steel on steel, bare or with a film of silver of this thickness."""
    silver = {"material": {"preset": "silver", "hardness": "0.4 GPa"}, "bodies": "first"}
    coated = {} if film is None else {"coating": st.Coating(**silver, thickness=film)}
    return st.Contact(**STEEL, roughness=st.Roughness(**SURFACE), **({"work_of_adhesion": "0.1 J/m^2"} | coated | more))


# ---- answers made by hand


def doubt(kind="assumption", factor=2.0, quantity="area_fraction"):
    """A range of this quantity is left by this factor."""
    return Doubt("why", quantity, factor, factor, 0.0, 1.0, 1, 1, kind)


def answer(name, mu, *outside, grade="B", effects=(), of_interface=False, **more):
    """What a model of this name is taken to have said."""
    at_load = None if mu is None else {"friction_coefficient": mu}
    given = {"outside": list(outside), "effects": list(effects), "of_interface": of_interface}
    return Answer(Candidate(name, Choice()), grade, at_load=at_load, **given, **more)


EFFECT, IMPOSSIBLE = doubt("effect", 4.0), doubt("impossible", 1.01)
# What decides -> answers, of which the first is to be recommended.
DECIDES = {
    "an effect left out weighs more than a grade": [answer("a", 0.9, grade="C"), answer("b", 0.2, EFFECT, grade="A")],
    "by how far": [answer("a", 0.9, doubt(factor=1.01)), answer("b", 0.2, doubt(factor=8.0))],
    "not by how many": [
        answer("a", 0.9, *(doubt(factor=1.01, quantity=name) for name in ("area_fraction", "touching_share", "rms_slope"))),
        answer("b", 0.2, EFFECT),
    ],
    "what kind": [answer("a", 0.9, doubt("fit")), answer("b", 0.2, doubt("effect"))],
    "few asperities meet all alike": [answer("a", 0.2, doubt("statistics", 1e3)), answer("b", 0.9, EFFECT)],
    "what cannot be so has no say": [answer("a", 0.9, doubt(), grade="B"), answer("b", 0.2, IMPOSSIBLE, grade="A")],
    "the stated strength": [answer("a", 0.9, doubt(), of_interface=True, grade="C"), answer("b", 0.2, grade="A")],
    "not where it cannot be so": [answer("a", 0.9), answer("b", 0.2, IMPOSSIBLE, of_interface=True)],
    "the grade of two": [answer("a", 0.9, grade="A"), answer("b", 0.2, grade="C")],
    "no outlier": [answer("a", 0.30), answer("b", 0.5, grade="A"), answer("c", 0.2), answer("d", 0.25), answer("e", 0.33)],
    "the better founded of those alike": [answer("a", 0.301), answer("b", 0.3, EFFECT), answer("c", 0.302, doubt())],
    "the lower middle of two": [answer("a", 0.2), answer("b", 0.3)],
    "the middle of five": [answer("a", 0.3), answer("b", 0.2), answer("c", 0.9), answer("d", 0.1), answer("e", 0.8)],
    "that something is said": [answer("a", 0.9, EFFECT, grade="C"), answer("b", np.nan, grade="A"), answer("c", None)],
    "adhesion that pulls little need not be exact": [
        answer("a", 0.3, doubt(factor=64.0, quantity="tabor_parameter"), adhesion=1e-3),
        answer("b", 0.2, doubt(factor=4.0)),
    ],
    "adhesion that pulls much must": [
        answer("a", 0.2, doubt(factor=4.0)),
        answer("b", 0.3, doubt(factor=64.0, quantity="tabor_parameter"), adhesion=1.0),
    ],
}


@pytest.mark.parametrize("turned", (False, True))
@pytest.mark.parametrize("what", DECIDES)
def test_what_decides(what, turned):
    answers = DECIDES[what]
    assert recommend(answers[::-1] if turned else answers).best is answers[0]


def test_the_same_limit_in_two_records_counts_once():
    twice = answer("a", 0.2, doubt("effect", 3.0), doubt("assumption", 3.0))
    assert twice.cost == answer("b", 0.2, doubt("effect", 3.0)).cost == pytest.approx(0.1 + 3.0 * np.log2(3.0))


def test_cost_is_continuous_at_every_bound():
    just, far = (answer("a", 0.2, doubt("effect", 1.0 + by)).cost for by in (1e-9, 1.0))
    assert just == pytest.approx(answer("a", 0.2).cost, abs=1e-8) and far == pytest.approx(0.1 + 3.0)
    low = Doubt("why", "tabor_parameter", 4.999, 4.999, 5.0, np.inf, 1, 1)
    assert 0.0 < low.doublings < 1e-3 and Doubt("why", "tabor_parameter", 1.25, 1.25, 5.0, np.inf, 1, 1).doublings == 2.0


def test_the_range_is_the_middle_two_thirds_of_the_weight():
    found = recommend([answer(str(mu), mu) for mu in (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)])
    assert (found.low, found.best.mu, found.high) == (0.1, 0.3, 0.5)
    alone = recommend([answer("a", 0.3)])
    assert (alone.low, alone.high) == (0.3, 0.3) and "the only model" in alone.reason


def test_the_reason_says_what_decided():
    found = recommend(
        [
            answer("a", 0.2, effects=("adhesion", "plasticity"), of_interface=True),
            answer("b", 0.1, EFFECT, of_interface=True),
            answer("c", 0.4),
        ]
    )
    assert found.best.candidate.name == "a"
    for said in (
        "the best founded of 2 models",
        "no range",
        "interface strength as stated",
        "takes account of adhesion and plasticity",
    ):
        assert said in found.reason
    assert "another family (strength derived from the yield or the adhesion of the bodies) say 0.4" in found.reason
    assert "A/A_n = 4, not 0 to 1" in recommend([answer("a", 0.2, EFFECT)]).reason


def test_two_opinions_are_said_and_none_between_them_is_taken():
    """Five models at 0.1, five at 0.4, and one between that counts for nothing: it is not recommended."""
    low = [answer(f"a{i}", 0.1 + 1e-3 * i) for i in range(5)]
    high = [answer(f"b{i}", 0.4 + 1e-3 * i) for i in range(5)]
    found = recommend([*low, answer("between", 0.2, EFFECT), *high])
    assert found.best.candidate.name != "between" and (found.low, found.high) == (0.101, 0.403)
    assert "of two opinions: 50% of the weight is at 0.104 or below, the rest from 0.4 on" in found.reason
    assert "opinions" not in recommend(low).reason


def measured(error, scatter=0.05):
    """A contact area that is off by this much on average, of a model that is measured near the contact."""
    one, nothing = np.ones(1), np.zeros(1)
    levels, rms = error + scatter * np.array([NORMAL_SCORES]), math.hypot(error, scatter)
    return MeasuredErrors(
        "a|b",
        error * one,
        levels,
        rms * one,
        rms * one,
        error * one,
        nothing,
        one,
        one,
        nothing,
    )


def off_by(error, name="b", mu=0.3, scatter=0.05):
    return answer(name, mu, measured=measured(error, scatter))


def set_aside(*answers):
    return recommend([answer("a", 0.2, measured=measured(0.0)), *answers]).set_aside


@pytest.mark.parametrize("error", [-0.02, -0.03, -0.04, -0.05, -0.1])
def test_errors_within_the_scatter_of_solved_surfaces_set_nothing_aside(error):
    """Also where many models share the weight: neither of two a percent apart is far from the solved surfaces."""
    others = [off_by(error - 0.01 * at, f"b{at}") for at in range(2)]
    many = [off_by(0.0, f"c{at}") for at in range(20)]
    assert set_aside(*others) == set_aside(*others, *many) == ""


def test_an_error_beyond_the_scatter_sets_aside_and_is_said():
    said = set_aside(off_by(-0.35), off_by(-0.04, "c"))
    assert (
        said == "its contact area differs from solved surfaces near this contact by more than these scatter: b 0.3 (area -30%)"
    )
    assert set_aside(off_by(-0.35, scatter=0.3), off_by(-0.04, "c")) == ""  # within its own interval


def test_by_numbers_the_scatter_that_sets_aside_is_that_of_gaussian_surfaces():
    """The interval over all kinds, beside it, is wider."""
    far = off_by(-0.35)
    far = replace(far, measured=replace(far.measured, kind_known=False))
    assert set_aside(far, off_by(-0.04, "c")).startswith(
        "its contact area differs from solved Gaussian surfaces by more than Gaussian surfaces scatter: b"
    )


def test_the_recommended_number_has_no_leap_where_a_model_comes_to_be_set_aside():
    """The weight of a model falls by a fiftieth for every thousandth of its error, on both sides of the border."""

    def mu(error):
        family = [answer("a", 0.2, measured=measured(0.0)), off_by(error), off_by(error, "c", 0.31), off_by(0.02, "d", 0.25)]
        found = recommend(family)
        return found.best.mu, found.low, found.high

    errors = np.linspace(0.05, 0.5, 451)
    border = next(at for at, error in enumerate(errors) if set_aside(off_by(error)))
    assert mu(errors[border]) == mu(errors[border - 1])


def test_what_is_set_aside_is_said_with_what_weighs_most():
    light = doubt("assumption", 1.1, "touching_share")
    found = recommend(
        [answer("a", 0.2), answer("b", 0.1, EFFECT, light), answer("c", 0.4, IMPOSSIBLE), answer("d", 0.3, EFFECT)]
    )
    assert found.set_aside.splitlines() == ["A/A_n is not 0 to 1: why: b 0.1, d 0.3, c 0.4"]
    assert recommend([answer("a", 0.2), answer("b", 0.3)]).set_aside == ""


def test_nothing_is_recommended_where_nothing_holds():
    found = recommend([answer("a", 0.2, IMPOSSIBLE), answer("b", 0.3, IMPOSSIBLE), answer("c", None)])
    assert found.best is None and found.reason == "no model holds: A/A_n is not 0 to 1: why (2 of 2 models)"
    assert "larger nominal area" in found.advice
    silent = recommend([answer("a", None, why_not=f"{TOO_MUCH} 1 N"), answer("b", np.nan)])
    assert silent.best is None and silent.reason == "no model says anything of friction at this load"
    assert silent.advice.startswith("less load") and recommend([answer("a", None)]).advice == ""


# ---- contacts


def said(subject, load):
    """name -> (number of ranges left, grade, friction coefficient, those ranges) of the models that predict friction; and the
    dataset."""
    data = compare(subject, load=load)
    told = {}
    for name in data["model"].values:
        one = data.sel(model=name)
        mu = float(one["friction_coefficient_at_load"])
        if np.isfinite(mu):
            left = [line for line in one["outside_validity"].item().split("; ") if line]
            told[str(name)] = len(left), one["grade"].item(), mu, left
    return told, data


def test_what_is_possible_by_leaving_out_the_most_is_not_recommended():
    """Where adhesion presses PDMS flat, the one model left was that whose Tabor parameter is out by a factor of a thousand."""
    far, near = doubt("effect", 16.0, "tabor_parameter"), doubt("effect", 2.0, "tabor_parameter")
    flat = answer("b", 5.0, IMPOSSIBLE)
    nothing = recommend([answer("a", 0.2, far, adhesion=9.0), flat])
    assert nothing.best is None and "better founded" in nothing.reason and nothing.advice
    assert recommend([answer("a", 0.2, far, adhesion=9.0), answer("b", 5.0, IMPOSSIBLE, near, far)]).best is not None
    assert recommend([answer("a", 0.2, doubt("fit", 2.0)), flat]).best is not None


def test_a_load_lost_in_rounding_is_no_answer():
    data = compare(st.Indices(theta=1.0, lam=10.0), load=1e-18)
    lost = [("lost here in the rounding" in text) for text in data["outside_validity"].values]
    assert any(lost) and np.isinf(data["cost"].values[lost]).all()


def test_the_middle_of_those_that_are_within():
    """Where asperities yield and the strength of the interface is stated: elastic theories leave their range, and what derives
    a strength from the metal is of another family."""
    told, data = said(contact(**STATED, work_of_adhesion="1 mJ/m^2"), "30 N")
    alike = [
        name
        for name, (left, *_) in told.items()
        if not left and data["family_of_curve"].sel(model=name).item().startswith("inter")
    ]
    assert {"jackson_green_2005", "zhao_maietta_chang_2000", "persson_2001_elastoplastic"} <= set(alike)
    low, high = data.attrs["recommended_range"]
    assert low <= told[data.attrs["recommended"]][2] <= high
    assert min(told[name][2] for name in alike) <= low and high <= max(told[name][2] for name in alike)


def test_without_a_stated_strength_the_best_grade():
    """Three are within their validity; one of them has the grade B."""
    told, data = said(contact(), "10 N")
    grades = {name: grade for name, (left, grade, *_) in told.items() if left == 0}
    assert grades == {"chang_etsion_bogy_1988": "B", "kogut_etsion_2004": "C", "cohen_kligerman_etsion_2008": "C"}
    assert data.attrs["recommended"] == "chang_etsion_bogy_1988"


def test_what_knows_more_but_not_the_stated_strength_comes_after():
    """The graded film takes account of adhesion too, but of its own friction its asperities that flow have none:
    without a stated strength what gives them some is the one to take."""
    told, data = said(contact("200 nm", interfacial_shear_strength="50 MPa"), "1 N")
    assert told["halling_1979"][:2] == (0, "C") and told["graded"][:2] == (2, "C")
    assert "bear more than their hardness" in told["graded"][3][0]
    assert told["chang_1997"][0] and told["liu_neville_reuben_2002"][0]  # all of the film is not plastic
    assert data.attrs["recommended"] == "rough_on_film"
    assert compare(contact("200 nm"), load="1 N").attrs["recommended"] == "cohen_kligerman_etsion_2008 + sequential"


def _of(material, sigma, radius, density, area, **more):
    roughness = st.Roughness(asperity_height_deviation=sigma, asperity_radius=radius, asperity_density=density)
    return st.Contact(first=material, second=more.pop("second", material), roughness=roughness, nominal_area=area, **more)


def test_load_without_friction_weighs_by_the_rest_of_it():
    """Clean gold, 98 % of it frictionless: mu of 0.012 was recommended, and 0.03 at a hundredth of the load."""
    gold = {"youngs_modulus": 78e9, "poissons_ratio": 0.42, "hardness": 0.3e9}
    for load in (1e-6, 1e-4):
        data = compare(_of(gold, 30e-9, 3e-6, 5e11, 1e-10, work_of_adhesion=0.8), load=load)
        mu = data["friction_coefficient_at_load"].sel(model=data.attrs["recommended"])
        assert data["cost"].sel(model="soft_coating_2015") > 10.0 and 0.2 < mu < 0.4


def test_full_contact_is_recommended_where_a_contact_sticks():
    """PDMS pulled onto glass: from mu = 18 to 1.06, of no adhesion, where Derjaguin's area passed the nominal
    one; and then none. 0.1 MPa on a square centimetre under 1 N are mu = 10."""
    silicone = {"youngs_modulus": 2e6, "poissons_ratio": 0.499, "hardness": 0.6e6}
    glass = {"youngs_modulus": 70e9, "poissons_ratio": 0.22, "hardness": 6e9}
    given = {"second": glass, "interfacial_shear_strength": 0.1e6}
    data = compare(_of(silicone, 50e-9, 2e-6, 5e11, 1e-4, work_of_adhesion=0.09, **given), load=1.0)
    assert data.attrs["recommended"] == "persson_tosatti_2001"
    assert float(data["friction_coefficient_at_load"].sel(model="persson_tosatti_2001")) == pytest.approx(10.0, rel=1e-9)
    slight = compare(_of(silicone, 50e-9, 2e-6, 5e11, 1e-4, work_of_adhesion=0.0005, **given), load=1.0)
    assert slight.attrs["recommended"] not in ("none", "persson_tosatti_2001")


def test_nothing_is_recommended_where_no_model_that_knows_the_pull_is_possible():
    pulled = answer("a", 0.9, doubt("effect", 30.0, "adhesion_share"), grade="A")
    found = recommend([pulled, answer("b", 5.0, doubt("impossible"), grade="A")])
    assert found.best is None and "more than the load" in found.reason and "less work of adhesion" in found.advice


@pytest.mark.parametrize(("load", "recommended", "share"), (("1 N", ("rough_on_film",), 0), ("1 kN", ("none",), 1)))
def test_validity_is_that_at_the_working_load(load, recommended, share):
    """The film law of the paper is for contact spots that are smaller than the film is thick: so they are under a light load
    and not under a heavy one, and the curves, pressed to a mean separation of -2 sigma, go through both. Silver is pressed flat
    by 1 kN on 1 mm^2, and nothing is recommended."""
    subject = contact("1.5 um", **STATED)
    name = "maugis_1992 + sequential"
    told, data = said(subject, load)
    assert any("half-space: contact radius" in line for line in told[name][3]) == bool(share)
    assert data.attrs["recommended"] in recommended
    single = st.solve(
        subject, load=load, model="greenwood_williamson_1966", asperity="maugis_1992", tangential="bowden_tabor_1943",
        film="sequential",
    )  # fmt: skip
    assert (float(single["load_share_beyond_film"]) > 0.5) == bool(share)
    assert_allclose(told[name][2], float(single["friction_coefficient"]), rtol=1e-9)
    assert ("contact radius below thickness" in single.attrs["outside_validity"]) == bool(share)
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


def test_the_word_recommended_is_no_model_of_solve_but_it_says_where_to_look():
    with pytest.raises(
        st.InputError, match=r"model: 'recommended'; allowed: the key of a model; `stiction compare` prints which"
    ):
        st.solve(contact(), load="1 N", model="recommended")
