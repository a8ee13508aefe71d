"""Junctions that grow under shear, from a weak interface to full stick, and their place in models that give them nothing.

Compared with closed forms and with sums by scipy.quad of formulas written out here.
"""

import itertools
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

import stiction as st
from refusals import refusal
from stiction.engine.heights import height_distribution
from stiction.laws.asperity import hertz, zhao_maietta_chang_2000
from stiction.laws.joining import coordinates, normal_states
from stiction.laws.tangential import junction_growth, tabor_1959
from stiction.laws.tangential.shared.junctions import where_pressure_is
from stiction.records.registry import YIELDED, AsperityLaw, TangentialLaw, find, incompatibility, of_kind, resolve_options
from stiction.solving.choice import Choice
from stiction.solving.chosen import resolve_laws
from stiction.solving.problem import problem_of
from tables import groups

PLAIN = "greenwood_williamson_1966"
SURFACE = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
# Copper: H = 0.356 GPa in the presets, H/Y = 2.8 where it states no yield stress.
BULK = 1.0 / (math.sqrt(3.0) * 2.8)  # shear strength over H


def copper(strength, **more):
    return st.Contact(
        first="copper", second="copper", roughness=SURFACE, work_of_adhesion="0.1 J/m^2", nominal_area="1 mm^2",
        interfacial_shear_strength=strength, **more,
    )  # fmt: skip


def bulk_of_copper():
    contact = copper(1e6)
    return BULK * 1e6 / float(contact.groups()["shear_strength"])


# The law of Tabor -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("alpha", "c", "mu", "growth"),
    [("9", 0.1, 0.0335, 1.0050), ("9", 0.5, 0.1925, 1.1547), ("9", 0.95, 1.0141, 3.2026), ("9", 0.99, 2.3393, 7.0888),
     ("von_mises", 0.3, 0.0648, 1.0483), ("von_mises", 0.99, 1.4471, 7.0888)],
)  # fmt: skip
def test_plastic_junctions(alpha, c, mu, growth):
    """The table of the docstring: mu = c/sqrt(alpha (1 - c^2)) on the fully plastic segment of Zhao, Maietta & Chang."""
    a = 9.0 if alpha == "9" else 3.0 * 2.8**2
    given = groups(theta=1e3, lam=1.0, shear_strength=c / math.sqrt(a))
    segment = zhao_maietta_chang_2000.segments(given)[2]
    law = tabor_1959.tangential_resistance(segment, given, alpha)
    w, _, load, area = normal_states(segment, segment.edges[:, 0] * 1.3)[0]
    force = sum(law.resistance(0.0, w, load, area, *(float(one[0]) for one in law.parameters)))
    assert force / load == pytest.approx(mu, abs=5.1e-5)
    assert force / (float(given.shear_strength[0]) * load) == pytest.approx(growth, abs=5.1e-5)


@pytest.mark.parametrize("strength", [1.0, 1.2])
def test_as_strong_as_the_bulk_is_refused_with_the_reason(strength):
    with refusal("shear_strength", "0.2062", "junction_growth") as caught:
        st.solve(st.Indices(theta=40, lam=10, shear_strength=strength * BULK), load=0.01, tangential="tabor_1959", model=PLAIN)
    assert "\n" not in str(caught.value)
    weaker = st.Indices(theta=40, lam=10, shear_strength=strength * BULK)  # 9 is less than 3 (2.8)^2: the bulk is stronger
    assert st.solve(weaker, load=0.01, tangential="tabor_1959", model=PLAIN, alpha="9")["friction_coefficient"] > 0


@pytest.mark.parametrize("c", [0.2, 0.9])
def test_sum_of_growing_junctions(c):
    """Over Gaussian heights: asperities of Zhao et al., elastic to plastic, written out, with kinks given to the integrator."""
    given = groups(theta=1e3, lam=300.0, shear_strength=c * BULK)
    eta, h = float(given.eta[0]), 0.7
    first, last = (0.4 * eta) ** 2, 54 * (0.4 * eta) ** 2

    def pressure(w):  # over H, and the area
        if w < first:
            return math.sqrt(w) / eta, w
        if w > last:
            return 1.0, 2 * w
        done = (w - first) / (last - first)
        return 0.4 + 0.6 * math.log(w / first) / math.log(54), w * (1 + 3 * done**2 - 2 * done**3)

    def force(w):
        p, area = pressure(w)
        return c * BULK * eta * area * max(1.0, p / math.sqrt(1 - c * c))

    threshold = math.sqrt(1 - c * c)
    kink = eta**2 * threshold**2 if threshold < 0.4 else first * 54 ** ((threshold - 0.4) / 0.6)
    ends = sorted({0.0, first, min(kink, 12.0), min(last, 12.0), 12.0})
    expected = sum(
        quad(lambda w: force(w) * math.exp(-((h + w) ** 2) / 2) / math.sqrt(2 * math.pi), a, b, epsabs=0, epsrel=1e-12)[0]
        for a, b in itertools.pairwise(ends)
    )
    choice = Choice(PLAIN, "zhao_maietta_chang_2000", "tabor_1959")
    assert problem_of(given, choice).at(np.array([[h]]))["friction_force"][0, 0] == pytest.approx(expected, rel=1e-9)


def test_where_a_pressure_is_reached():
    """Hertz's mean pressure is eta w^(1/2)/eta: load w^(3/2) over area w; nowhere on a segment that is plastic all along."""
    given = groups(theta=1e3, lam=1e3)
    segment = hertz.elastic(np.full(1, np.inf))
    assert where_pressure_is(segment, np.array([0.3]))[0, 0] == pytest.approx(0.3, rel=1e-12)
    flow = zhao_maietta_chang_2000.segments(given)[2]
    assert_allclose(where_pressure_is(flow, given.eta), np.tile(flow.edges[:, :1], 2))


# From a weak interface to full stick -----------------------------------------------------------------------------------------


def friction(tangential, shares, **contact):
    """mu of copper on copper at the shares of the bulk's strength."""
    strength = st.axis("interfacial_shear_strength", shares * bulk_of_copper())
    found = st.solve(copper(strength, **contact), load="0.1 N", model=PLAIN, asperity="brizmer_kligerman_etsion_2006",
                     tangential=tangential)  # fmt: skip
    return found["friction_coefficient"].values


def test_clean_copper_runs_from_bowden_tabor_to_above_one_without_a_step():
    """The interface is made stronger, from next to nothing to within 1 in 10,000 of the bulk's strength."""
    shares = 1.0 - np.geomspace(1.0 - 1e-4, 1e-4, 400)
    mu = friction("tabor_1959", shares)
    constant = friction("bowden_tabor_1943", shares)
    weak = shares < 0.05
    assert weak.sum() > 2
    assert_allclose(mu[weak], constant[weak], rtol=2e-3)
    assert mu[0] < 1e-4 and mu[-1] > 1.0
    assert (np.diff(mu) > 0.0).all()
    # mu is as c (1 - c^2)^(-1/2) at the steepest: from one share to the next no more than that.
    most = np.diff(np.log(shares / np.sqrt(1.0 - shares**2)))
    assert (np.diff(np.log(mu)) <= 1.0001 * most).all()


def test_growth_ends_where_full_stick_slides():
    """The same way up to full stick and beyond: smooth copper, of which asperities are loaded to about first yield."""
    smooth = {
        "roughness": st.Roughness(asperity_height_deviation="0.2 nm", asperity_radius="200 um", asperity_density="1e9 1/m^2")
    }

    def at(tangential, shares):
        strength = st.axis("interfacial_shear_strength", shares * bulk_of_copper())
        contact = copper(strength).replace(work_of_adhesion=None, **smooth)
        return st.solve(contact, load="1 mN", model=PLAIN, asperity="brizmer_kligerman_etsion_2006", tangential=tangential)[
            "friction_coefficient"
        ].values

    shares = np.linspace(1e-3, 1.2, 600)
    mu = at("junction_growth", shares)
    stick = at("brizmer_kligerman_etsion_2007", shares[:1])[0]
    assert stick > 1.0
    assert_allclose(mu[:2], at("bowden_tabor_1943", shares[:2]), rtol=1e-4)
    assert_allclose(mu[shares >= 1.0], stick, rtol=1e-12)
    assert (np.diff(mu)[shares[1:] < 1.0] > 0.0).all() and np.diff(mu).max() < 0.02 * stick
    assert abs(at("junction_growth", np.array([1.0 - 1e-9]))[0] / stick - 1.0) < 1e-7
    # d ln T/d ln c = 1/(1 - c^2 + (tau_0 A/T_s)^2) is less than that of c (1 - c^2)^(-1/2), which bounds any step.
    grows = shares[shares < 0.99]
    most = np.diff(np.log(grows / np.sqrt(1.0 - grows**2)))
    assert (np.diff(np.log(mu[shares < 0.99])) <= 1.0001 * most).all()


def test_without_an_end_growth_is_tabors():
    """T_s without end: tau_0 A/sqrt(1 - c^2), that of a plastic junction."""
    for c in (0.1, 0.6, 0.95):
        assert junction_growth.growing_force(2.0, 1e9, c) == pytest.approx(2.0 / math.sqrt(1 - c * c), rel=1e-12)
        assert junction_growth.growing_force(1e-9, 3.0, c) == pytest.approx(1e-9 / math.sqrt(1 - c * c), rel=1e-12)
    assert junction_growth.growing_force(2.0, 3.0, 1.0) == 3.0
    assert junction_growth.growing_force(0.0, 3.0, 0.5) == junction_growth.growing_force(2.0, 0.0, 0.5) == 0.0


@pytest.mark.parametrize("heights", ["exponential", "weibull"])
@pytest.mark.parametrize(("asperity", "tangential"), [("jkr", "tabor_1959"), ("jackson_green_2005", "tabor_1959"),
                                                      ("jackson_green_2005", "junction_growth")])  # fmt: skip
def test_with_any_heights(asperity, tangential, heights):
    """Against trapezoidal sums over the displacement, which know nothing of kinks, knots and nodes."""
    given = groups(theta=100.0, lam=1e3, shear_strength=0.15, sharpness=0.05)
    chosen = height_distribution(heights, **({"exponent": 2.5} if heights == "weibull" else {}))
    problem = problem_of(given, Choice(PLAIN, asperity, tangential), chosen)
    found = problem.at(np.array([[0.4]]))["friction_force"][0, 0]
    expected = 0.0
    for segment in problem.law.segments(given):
        law = problem.law.tangential.tangential_resistance(segment, given, "von_mises")
        parameters = [float(one[0]) for one in law.parameters]
        u = np.linspace(segment.edges[0, 0], max(float(coordinates(segment, 40.0)[0]), segment.edges[0, 0]), 60001)
        if u[-1] == u[0]:
            continue
        rows = [float(one[0]) for one in segment.parameters]
        states = np.array([segment.normal(float(one), *rows) for one in u])
        forces = [sum(law.resistance(float(at), *state[[0, 2, 3]], *parameters)) for at, state in zip(u, states, strict=True)]
        dense = np.array([chosen.density(0.4 + w, chosen.shape) for w in states[:, 0]])
        expected += np.trapezoid(np.array(forces) * states[:, 1] * dense, u)
    assert found == pytest.approx(expected, rel=2e-5)


# In the three models that give plastic junctions nothing ---------------------------------------------------------------------

THREE = ["soft_coating_2015", "chang_etsion_bogy_1988", "kogut_etsion_2004"]
TAKEN = ["bowden_tabor_1943", "tabor_1959", "junction_growth", "brizmer_kligerman_etsion_2007"]


@pytest.mark.parametrize("model", THREE)
def test_the_published_law_stays_as_it_is(model):
    """none is the default and changes nothing; every other adds friction, says how much, and is cited."""
    contact = copper("20 MPa").replace(second="hardened_steel_52100")
    plain = st.solve(contact, load=["0.1 N", "1 N"], model=model)
    same = st.solve(contact, load=["0.1 N", "1 N"], model=model, plastic_junctions="none")
    assert same.drop_attrs().equals(plain.drop_attrs()) and "change_by_junctions" not in plain.attrs
    before = plain["friction_coefficient"]
    for key in TAKEN:
        found = st.solve(contact, load=["0.1 N", "1 N"], model=model, plastic_junctions=key)
        assert_allclose(found["friction_coefficient_published"], before, rtol=1e-9)
        assert (found["friction_coefficient"] > 1.05 * before).all()
        for name in ("load", "contact_area", "mean_separation"):
            assert_allclose(found[name], plain[name], rtol=1e-12)
        ratio = (found["friction_coefficient"] / before).values
        assert f"{ratio.min():.3g}" in found.attrs["change_by_junctions"] and key in found.attrs["change_by_junctions"]
        assert {source.key for source in find(key, TangentialLaw).sources} <= set(found.attrs["sources"].split())


@pytest.mark.parametrize("option", ["plastic_junctions", "tangential"])
@pytest.mark.parametrize("model", THREE)
def test_only_the_published_law_warns_of_missing_friction(model, option):
    contact = copper("20 MPa").replace(second="hardened_steel_52100")
    published = st.solve(contact, load="1 N", model=model).attrs["outside_validity"]
    other = st.solve(contact, load="1 N", model=model, **{option: "bowden_tabor_1943"}).attrs["outside_validity"]
    assert "friction" in published and "no friction" not in other and "without friction" not in other


def test_three_orders_of_magnitude():
    """What plastic junctions resist decides: after Chang, Etsion and Bogy nothing, in full stick a thousandfold."""
    contact = copper("20 MPa").replace(second="hardened_steel_52100")
    found = st.solve(contact, load="1 N", model="chang_etsion_bogy_1988", plastic_junctions="brizmer_kligerman_etsion_2007")
    assert found["friction_coefficient"] > 1e3 * found["friction_coefficient_published"]


@pytest.mark.parametrize("h", [0.5, 2.0])
def test_what_is_added_to_chang_etsion_and_bogy(h):
    """tau_0 A of the asperities beyond their critical interference, 2w - w_c there: by scipy.quad."""
    given = groups(theta=1e3, lam=300.0, shear_strength=0.1)
    eta = float(given.eta[0])
    K_H = 0.454 + 0.41 * 0.3
    w_c = (2.0 / 3.0 * K_H * eta) ** 2
    choice = Choice("chang_etsion_bogy_1988", options={"plastic_junctions": "bowden_tabor_1943"})
    found = problem_of(given, choice).at(np.array([[h]]))
    added = found["friction_force"] - found["friction_coefficient_published"] * found["load"]
    ends = (w_c, max(w_c, 12.0))
    expected = quad(
        lambda w: 0.1 * eta * (2 * w - w_c) * math.exp(-((h + w) ** 2) / 2) / math.sqrt(2 * math.pi),
        *ends,
        epsabs=0,
        epsrel=1e-12,
    )[0]
    assert added[0, 0] == pytest.approx(expected, rel=1e-8)


def test_on_a_grid_and_at_single_points():
    given = groups(theta=np.geomspace(10, 1e4, 9), lam=300.0, shear_strength=0.1)
    problem = problem_of(given, Choice("kogut_etsion_2004", options={"plastic_junctions": "tabor_1959"}))
    h = np.linspace(-1.0, 3.0, 7)
    grid, single = problem.on_grid(h), problem.at(np.tile(h, (9, 1)))
    for name in ("friction_coefficient", "friction_coefficient_published"):
        assert_allclose(grid[name], single[name], rtol=1e-9)


def test_on_a_film():
    """sequential: of film and substrate alike; a film that brings its own friction refuses, and so do other readings."""
    film = st.Coating(material="silver", thickness="200 nm")
    contact = copper("1 MPa", coating=film)
    found = st.solve(contact, load="1 N", plastic_junctions="tabor_1959")
    assert found["friction_coefficient"] > found["friction_coefficient_published"] > 0.0
    for laws, coated, why in (
        ({"film": "graded"}, True, ("plastic_junctions", "graded", "soft_coating_2015")),
        ({"variant": "published"}, True, ("plastic_junctions",)),
        ({"variant": "published"}, False, ("plastic_junctions",)),
        ({"transition": "gradual"}, False, ("plastic_junctions",)),
    ):
        given = contact if coated else copper("1 MPa")
        with refusal(*why):
            st.solve(given, load="1 N", plastic_junctions="tabor_1959", **laws)


@pytest.mark.parametrize("key", ["tabor_1959", "junction_growth", "brizmer_kligerman_etsion_2007"])
def test_on_a_film_solved_as_one_yielded_junctions_are_those_of_the_interface(key):
    """Of a film that is all the asperity feels the others would say what they say of the body under it."""
    given = st.Indices(theta=1e3, lam=100.0, nu=0.3, hardness_to_yield=2.8, n_E=0.2, n_H=0.2, tau=1e10, film_aspect=1e10)
    given = given.with_changes(shear_strength=0.03)
    with refusal("plastic_junctions", key, "layered"):
        st.solve(given, separation=1.0, film="layered", plastic_junctions=key)
    sheared, held = (
        st.solve(given, separation=1.0, model="soft_coating_2015", film="layered", plastic_junctions=law)
        for law in ("bowden_tabor_1943", "none")
    )
    more = float(sheared["friction_force"] - held["friction_force"])
    assert more == pytest.approx(0.03 * given.eta * float(sheared["contact_area_plastic"]), rel=1e-6)


def test_what_is_needed_is_asked_for():
    bare = copper(None)
    with refusal("interfacial_shear_strength", "tabor_1959"):
        st.solve(bare, load="1 N", plastic_junctions="tabor_1959")
    assert st.solve(bare, load="1 N", plastic_junctions="brizmer_kligerman_etsion_2007")["friction_coefficient"] > 0.2


# What a law says of itself --------------------------------------------------------------------------------------------------


def plastic_segments(law, given):
    """The plastic segments of asperity laws that the law goes with."""
    for asperity in of_kind(AsperityLaw).values():
        if not incompatibility(law, asperity) and all(given.has(name) for name in asperity.needs):
            yield from (one for one in asperity.segments(given, **resolve_options([asperity], {})) if one.state == "plastic")


def force_on(law, segment, **more):
    """Tangential force, load and area of an asperity far beyond yield."""
    given = groups(theta=1e3, lam=1e4, nu=0.3, sharpness=0.01, pressure_coefficient=0.0, size_over_burgers=1e3, **more)
    w, _, load, area = normal_states(segment, coordinates(segment, 3.0))[0]
    held = law.tangential_resistance(segment, given, **resolve_options([law], {}))
    if held is None:
        return 0.0, load, area
    parameters = [float(np.broadcast_to(one, 1)[0]) for one in held.parameters]
    return sum(held.resistance(float(coordinates(segment, 3.0)[0]), w, load, area, *parameters)), load, area


@pytest.mark.parametrize("law", of_kind(TangentialLaw).values(), ids=lambda law: law.key)
def test_what_plastic_junctions_resist_is_as_the_record_says(law):
    """By its own formula, whatever the interface: nothing; tau_0 A; more than that, the more the stronger; or all the same."""
    assert law.yielded in YIELDED
    given = groups(theta=1e3, lam=1e4, nu=0.3, sharpness=0.01, shear_strength=0.1)
    segments = list(plastic_segments(law, given))
    if law.yielded == "junction growth":  # of those that are plastic all over: a lower pressure leaves room for shear
        segments = [one for one in segments if np.divide(*force_on(law, one, shear_strength=0.1)[1:]) > 0.999 * given.eta[0]]
    assert segments
    of_interface = "shear_strength" in law.needs  # else the strength is one of its own
    for segment in segments:
        weak, strong = (force_on(law, segment, shear_strength=tau) for tau in (0.05, 0.15))
        sheared = [tau * float(given.eta[0]) * area for tau, (_, _, area) in ((0.05, weak), (0.15, strong))]
        grown = [weak[0] / sheared[0], strong[0] / sheared[1]]
        assert {
            "none": grown == [0.0, 0.0],
            "interface": grown == pytest.approx([1.0, 1.0], rel=1e-12) if of_interface else weak[0] == strong[0],
            "junction growth": 1.0 < grown[0] < grown[1],
            "full stick": weak[0] == strong[0] > 0.0,
        }[law.yielded]


@pytest.mark.parametrize("law", [one for one in of_kind(TangentialLaw).values() if one.junctions], ids=lambda law: law.key)
def test_only_a_law_that_gives_yielded_junctions_nothing_takes_another(law):
    assert law.yielded == "none"
    assert {find(key, TangentialLaw).yielded for key in law.junctions} == set(YIELDED) - {"none"}


@pytest.mark.parametrize("key", TAKEN)
def test_the_law_that_is_taken_says_what_they_resist(key):
    chosen = resolve_laws(Choice("kogut_etsion_2004", options={"plastic_junctions": key}), coated=False)
    assert chosen.yielded == find(key, TangentialLaw).yielded
    assert resolve_laws(Choice("kogut_etsion_2004"), coated=False).yielded == "none"
    assert resolve_laws(Choice(PLAIN, tangential="none"), coated=False).yielded == ""
