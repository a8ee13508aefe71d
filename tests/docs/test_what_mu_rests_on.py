"""The page of assumptions: its picture shows every choice beside the base, and its numbers are those of the program."""

import math

import numpy as np
import pytest
from pages import make_tables

import stiction as st

rests = make_tables.what_mu_rests_on


def test_every_choice_is_a_dot_beside_the_base():
    """Its figure has all of them in order, hollow where the result has a validity warning, and the line of the base."""
    axes = rests.figure().axes[0]
    drawn = {line.get_label(): line for line in axes.lines if not line.get_label().startswith("_")}
    every = [one for some in rests.answers().values() for one in some]
    assert list(drawn) == [one.words for one in every]
    for one in every:
        line = drawn[one.words]
        assert tuple(line.get_xdata()) == one.mu and (line.get_markerfacecolor() == "none") == one.outside
        assert 1e-6 < min(one.mu) and max(one.mu) < 10.0
    assert axes.get_xscale() == "log" and any(set(line.get_xdata()) == {rests.base()} for line in axes.lines)
    low, high = axes.get_xlim()
    assert all(low < mu < high for one in every for mu in one.mu)


def test_the_base_is_the_example():
    found = st.solve(rests.CONTACT, load="1 N", model="greenwood_williamson_1966", asperity="brizmer_kligerman_etsion_2006",
                     tangential="bowden_tabor_1943")  # fmt: skip
    assert rests.base() == pytest.approx(float(found["friction_coefficient"]), rel=1e-12)


def test_the_assumption_of_plastic_junctions_weighs_most():
    """Three orders of magnitude and more between nothing and full stick."""
    factors = {name: np.divide(*rests.ends(some)[::-1]) for name, some in rests.answers().items()}
    assert max(factors, key=factors.get) == "resistance of plastic junctions"
    by_words = {one.words: one.mu[0] for one in rests.answers()["resistance of plastic junctions"]}
    assert by_words["full stick"] > 1e3 * by_words["none: chang_etsion_bogy_1988"]


def test_worn_heights_are_skewed_down():
    """Wear takes tops away. The skewness of a Weibull distribution in closed form, by its words and by their sign."""
    known = {}
    for one in rests.assumptions()["heights"]:
        if one.exponent is not None:
            first, second, third = (math.gamma(1.0 + power / one.exponent) for power in (1, 2, 3))
            deviation = math.sqrt(second - first**2)
            known[one.words] = (third - 3.0 * first * deviation**2 - first**3) / deviation**3
    assert all(f"skewness {skewness:.1f}" in words for words, skewness in known.items())
    assert [skewness < 0.0 for words, skewness in known.items() if "worn" in words] == [True]


def test_the_curves_from_weak_to_full_stick():
    """They begin at Bowden and Tabor, and end, above 1, in full stick or beyond."""
    left, right = rests.strength_figure().axes
    for axes in (left, right):
        curves = {line.get_label(): line.get_ydata() for line in axes.lines}
        starts = [curves[law][0] for law in ("bowden_tabor_1943", "tabor_1959", "junction_growth")]
        assert starts == pytest.approx([starts[0]] * 3, rel=1e-3)
        assert curves["junction_growth"][-1] == pytest.approx(curves["brizmer_kligerman_etsion_2007"][-1], rel=1e-9)
        assert curves["tabor_1959"][-1] > 1.0
    assert right.lines[2].get_ydata()[-1] > 1.0
