"""Adhesive single asperities beyond JKR and DMT: Maugis 1992 between them, Thornton & Ning 1998 with a limiting pressure."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_less

from stiction.laws import joining as law
from stiction.laws.asperity import dmt, jkr
from stiction.laws.asperity import maugis_1992 as maugis
from stiction.laws.asperity import thornton_ning_1998 as thornton
from tables import column, groups, read

RING = read("maugis_1992.csv")
YIELDED = read("thornton_ning_1998.csv")
TABOR = np.logspace(-2, 2, 9)


def states_at(segment, w):
    """Displacement, its slope, load and area (n, 4) of a segment at the displacements w (n,)."""
    return law.normal_states(segment, law.coordinates(segment, w))


def ring(tabor, branch="loading", theta=40.0):
    tabor, theta = np.broadcast_arrays(np.asarray(tabor, dtype=float), np.asarray(theta, dtype=float))
    (segment,) = maugis.segments(groups(theta=theta, tabor_parameter=tabor), branch)
    return segment


def test_the_stress_of_lennard_jones_makes_lambda_of_the_tabor_parameter():
    """The largest (8 gamma/(3 eps)) (z^-3 - z^-9), at z = 3^(1/6), as s_0 in lambda_M = 2 s_0 (R/(pi gamma K^2))^(1/3)."""
    z = 3 ** (1 / 6)
    stress = 8 / 3 * (z**-3 - z**-9)
    assert stress == pytest.approx(16 / (9 * math.sqrt(3)), rel=1e-14)
    assert maugis.LAMBDA_OVER_TABOR == pytest.approx(2 * stress * (1 / (math.pi * (4 / 3) ** 2)) ** (1 / 3), rel=1e-14)
    assert maugis.LAMBDA_OVER_TABOR == pytest.approx(1.1570, abs=5e-5)


def test_ring_agrees_with_its_equations_solved_at_30_digits():
    """Where the table's point is on the stable side of the fold."""
    tabor, theta, w = (column(RING, name) for name in ("tabor_parameter", "theta", "w"))
    segment = ring(tabor, "unloading", theta)
    first = law.normal_states(segment, segment.edges[:, 0])
    stable = (column(RING, "area") > 1.01 * first[:, 3]) & np.array([row["kind"] == "" for row in RING])
    assert stable.sum() > 75
    found = states_at(segment, w)[stable]
    size = theta[stable] ** (-1 / 3)
    assert_allclose(found[:, 0], w[stable], rtol=1e-13, atol=1e-14)
    assert_allclose(found[:, 3], column(RING, "area")[stable], rtol=2e-12)
    assert_array_less(np.abs(found[:, 2] - column(RING, "load")[stable]), 1e-11 * (np.abs(found[:, 2]) + size**3))


def test_ring_is_lost_at_the_fold():
    rows = [row for row in RING if row["kind"]]
    assert len(rows) >= 10
    segment = ring(column(rows, "tabor_parameter"), "unloading", column(rows, "theta"))
    w, _, load, area = law.normal_states(segment, segment.edges[:, 0]).T
    assert_allclose(w, column(rows, "w"), rtol=1e-13)
    assert_allclose(load, column(rows, "load"), rtol=1e-11)
    assert_allclose(area, column(rows, "area"), rtol=1e-11)
    assert segment.lowest == pytest.approx(w.min())


def test_ring_that_shrinks_stably_ends_in_a_point():
    """At a = 0: (pi/4) lambda c^2 + (4/3) (pi/2 - 1) lambda^2 c = 1, D = -(4/3) lambda c, P = -(pi/2) lambda c^2."""
    tabor = np.array([1e-6, 0.01, 0.3, 0.7])
    segment = ring(tabor, "unloading", math.pi)
    assert np.all(segment.edges[:, 0] == 0.0)
    w, _, load, area = law.normal_states(segment, segment.edges[:, 0]).T
    for at, lam in enumerate(maugis.LAMBDA_OVER_TABOR * tabor):
        c = np.roots([math.pi / 4 * lam, 4 / 3 * (math.pi / 2 - 1) * lam**2, -1.0]).max()
        assert w[at] == pytest.approx(-4 / 3 * lam * c, rel=1e-12)
        assert load[at] == pytest.approx(-math.pi / 2 * lam * c * c, rel=1e-12)
    assert np.all(area == 0.0)


def test_ring_touches_at_no_displacement_in_loading():
    tabor = np.logspace(-100, 100, 201)
    segment = ring(tabor)
    w, slope, _, area = law.normal_states(segment, segment.edges[:, 0]).T
    assert_array_less(np.abs(w), 1e-14 * area + 1e-300)
    assert np.all(slope > 0)
    assert segment.lowest == 0.0
    assert np.all(ring(tabor, "unloading").edges[tabor > 1, 0] > 0)


@pytest.mark.parametrize("branch", ["loading", "unloading"])
def test_wide_ring_and_narrow_ring(branch):
    """Soft asperities are JKR's; stiff ones DMT's, which has no other branch than loading; departures as the record says."""
    theta = np.array([0.1, 1.0, 40.0, 1e4])
    w = np.array([0.02, 0.4, 1.5, 6.0])
    known = groups(theta=theta)
    for tabor, within in ((1e3, 1e-5), (1e4, 1e-7)):
        found = states_at(ring(tabor, branch, theta), w)
        expected = states_at(jkr.segments(known, branch)[0], w)
        assert_allclose(found[:, 2:], expected[:, 2:], rtol=within)
    for tabor, within in ((1e-6, 0.02), (1e-10, 2e-4), (1e-16, 2e-7)):
        found = states_at(ring(tabor, branch, theta), w)
        expected = states_at(dmt.segments(known)[0], w)
        size = expected[:, 2] + 4 * math.pi / theta  # the two terms of the load, both counted
        assert_array_less(np.abs(found[:, 2] - expected[:, 2]), within * size)
        assert_array_less(np.abs(found[:, 3] - expected[:, 3]), within * (w + (math.pi / theta) ** (2 / 3)))


def test_ring_pulls_with_between_jkr_and_dmt():
    """Pull-off force over pi gamma R falls from 2 to 3/2 as lambda_M grows."""
    segment = ring(TABOR, "unloading", math.pi)
    s = segment.edges[:, :1] + np.linspace(0, 1, 4001)[1:] * (law.coordinates(segment, 3.0)[:, None] - segment.edges[:, :1])
    each = zip(s, segment.parameters[1], strict=True)
    pull = np.array([max(-maugis.normal(at, 1.0, lam)[2] for at in row) for row, lam in each])
    assert np.all(np.diff(pull) < 0)
    assert pull[0] == pytest.approx(2.0, abs=0.02)
    assert pull[-1] == pytest.approx(1.5, abs=1e-3)


def test_ring_does_work_along_its_curve():
    """The coordinate's slope is the derivative of the displacement, at either side of where the series takes over."""
    for lam in (0.02, 0.9, 30.0):
        for s in (0.3, 1.7, 3.9999, 4.0001, 25.0):
            step = 1e-5 * s
            numeric = (maugis.normal(s + step, 0.7, lam)[0] - maugis.normal(s - step, 0.7, lam)[0]) / (2 * step)
            assert maugis.normal(s, 0.7, lam)[1] == pytest.approx(numeric, rel=1e-6, abs=1e-9 * lam)
    below, above = (np.array(maugis.normal(at, 0.7, 0.9)) for at in (np.nextafter(4.0, 0.0), 4.0))
    assert_allclose(below, above, rtol=1e-13)


@pytest.fixture(scope="module")
def yielded():
    """The table's groups and segments, with the limiting pressure as hardness."""
    known = groups(theta=column(YIELDED, "theta"), lam=column(YIELDED, "lambda"))
    return known, thornton.segments(known, "hardness")


def test_yielded_asperity_agrees_with_its_integrated_stiffness(yielded):
    _, (_, plastic) = yielded
    found = states_at(plastic, column(YIELDED, "w"))
    assert_allclose(found[:, 0], column(YIELDED, "w"), rtol=1e-12)
    assert_allclose(found[:, 2], column(YIELDED, "load"), rtol=1e-11)
    assert_allclose(found[:, 3], column(YIELDED, "area"), rtol=1e-12)


def test_yielding_begins_without_a_jump(yielded):
    """Load and stiffness, except where the asperity has yielded before it touches: then the elastic segment is empty."""
    known, (elastic, plastic) = yielded
    from_start = column(YIELDED, "lambda") < 1  # one case of the table
    assert from_start.any() and not from_start.all()
    assert np.all((elastic.edges[:, 0] == elastic.edges[:, 1]) == from_start)
    assert np.all(elastic.edges[:, 1] == plastic.edges[:, 0])
    at = elastic.edges[:, 1]
    before, after = law.normal_states(elastic, at)[~from_start], law.normal_states(plastic, at)[~from_start]
    assert_allclose(before, after, rtol=1e-13)
    u = at[~from_start]
    S, eta = np.sqrt(6 * math.pi / known.theta)[~from_start], known.eta[~from_start]
    assert_allclose(6 * u**5 - 3 * S * u**2, 4 * eta * u**3 - S * u**2, rtol=1e-12)  # dP/du of either, by hand
    assert_allclose(law.normal_states(plastic, plastic.edges[:, 0])[from_start, 0], 0.0, atol=1e-15)


def test_without_adhesion_the_load_after_yield_is_linear():
    """Thornton's non-adhesive sphere: P = P_y + pi R p_y (delta - delta_y), and w_y = ((2/3) eta_y)^2 as p0 = (3/2) sqrt(w)."""
    known = groups(theta=1e18, lam=1e40, hardness_to_yield=2.8, nu=0.3)
    _, plastic = thornton.segments(known, "hardness")
    w_y = (2 / 3 * known.eta) ** 2
    assert_allclose(law.normal_states(plastic, plastic.edges[:, 0])[:, 0], w_y, rtol=1e-9)
    assert_allclose(states_at(plastic, 3 * w_y)[:, 2], w_y**1.5 + known.eta * 2 * w_y, rtol=1e-8)


def test_limiting_pressure_of_first_yield():
    """1.6128 Y at nu = 0.3, 1.7385 Y at nu = 0.4 (first yield below a Hertz contact), the hardness over H/Y being Y."""
    known = groups(nu=np.array([0.3, 0.4, 0.3]), hardness_to_yield=np.array([2.8, 2.8, 3.0]))
    eta = thornton.segments(known, "first_yield")[1].parameters[1]
    assert_allclose(eta / known.eta, [1.6128 / 2.8, 1.7385 / 2.8, 1.6128 / 3.0], rtol=4e-5)


def test_unloading_agrees_with_the_table(yielded):
    known, _ = yielded
    for at, row in enumerate(YIELDED):
        value = {name: float(text) for name, text in row.items() if name != "limiting_pressure"}
        S, u_max = math.sqrt(6 * math.pi / known.theta[at]), value["area"] ** 0.25
        assert thornton.unloading_radius(u_max, value["load"], S) == pytest.approx(value["radius"], rel=1e-11)
        assert thornton.pull_off(u_max, value["load"], S) == pytest.approx(value["pull_off"], rel=1e-11)
        w, _, load, _ = thornton.unloading(value["area_back"] ** 0.25, u_max, value["load"], S)
        assert w == pytest.approx(value["w_back"], rel=1e-10, abs=1e-11 * value["w"])
        assert load == pytest.approx(value["load_back"], rel=1e-9)
        u = thornton.unloading_coordinate(value["w_back"], u_max, value["load"], S)
        assert u**4 == pytest.approx(value["area_back"], rel=1e-9)


@pytest.mark.parametrize("beyond", [0.8, 1.0, 1.001, 1.5, 4.0])
def test_turning_point_is_on_both_curves(beyond):
    """Before yield, unloading is JKR's own curve. Pull-off and loss of contact at the forces of JKR with R_p."""
    S, eta = 0.4, 3.0
    u_y = thornton.onset(eta, S)
    u = beyond * u_y
    P = thornton.loading(u, S, eta, u_y)
    w, slope, load, area = thornton.unloading(u, u, P, S)
    assert (w, load, area) == pytest.approx((jkr.displacement(u, S), P, u**4), rel=1e-13)
    radius = thornton.unloading_radius(u, P, S)
    if beyond <= 1.0:
        v = 0.6 * u
        assert radius == pytest.approx(1.0, abs=1e-14)
        assert thornton.unloading(v, u, P, S) == pytest.approx(
            (jkr.displacement(v, S), jkr.stretch(v, S), jkr.load(v, S), v**4)
        )
    else:
        assert radius > 1.0
        assert 0.0 < slope < jkr.stretch(u, S)
    lost = thornton.unloading_coordinate(-math.inf, u, P, S)
    w, slope, load, _ = thornton.unloading(lost, u, P, S)
    assert slope == pytest.approx(0.0, abs=1e-13 * u**3)
    assert load == pytest.approx(-5 / 9 * thornton.pull_off(u, P, S), rel=1e-12)
    loads = [thornton.unloading(at, u, P, S)[2] for at in np.linspace(lost, u, 20001)]
    assert min(loads) == pytest.approx(-thornton.pull_off(u, P, S), rel=1e-6)


@pytest.mark.parametrize(("S", "u"), [(0.5, 1.2), (2.0, 1.5), (1e-3, 3.0)])
def test_an_asperity_at_the_onset_of_yield_recovers_as_jkr(S, u):
    """JKR: w = u^4 - (2/3) S u, and contact is lost where dw/du = 0, at u^3 = S/6 and w = -(S/2) (S/6)^(1/3)."""
    expected = u**4 - 2.0 / 3.0 * S * u + 0.5 * S * (S / 6.0) ** (1.0 / 3.0)
    assert thornton.recovery(u, S, 0.9, u) == pytest.approx(expected, rel=1e-13)
