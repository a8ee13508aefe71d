"""Single asperities, normal direction: printed constants, points of JKR, first yield, and reference/asperity.csv.

Sections A..D name the compendium of published models this project works from; "theory" is docs/theory.md.
"""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from stiction.contact.indices import hardness_group, stiffness_group
from stiction.laws.asperity import chang_etsion_bogy_1987 as ceb
from stiction.laws.asperity import dmt, hertz, jkr
from stiction.laws.asperity import roy_chowdhury_ghosh_1994 as plastic
from stiction.laws.joining import Law, coordinates, states
from stiction.laws.tangential import soft_coating_2015
from tables import column, groups, groups_of, read

ROWS = read("asperity.csv")
RNG = np.random.default_rng(19)


def bare(rows):
    return groups_of([row | {"n_E": ""} for row in rows])


def joined(given, branch="loading"):
    """The asperity of the 2015 paper, normal and tangential: its elastic and its plastic regime."""
    return Law(plastic.RECORD, soft_coating_2015.RECORD, {"branch": branch}).regimes(given)


def plastic_load(w, theta, eta):
    return plastic.plastic(w, theta, eta)[2]


def test_rounded_constants_have_closed_forms():
    """The paper's printed numbers (section 0.1): 4.34, 2.89, 4.125, 3.65, 7.3, 6.28."""
    assert jkr.adhesion(1.0) == pytest.approx(4.34161, abs=5e-6)
    # w = x - 2.89441 x^(1/4) at theta = 1, x = 1
    assert 1.0 - jkr.displacement(1.0, jkr.adhesion(1.0)) == pytest.approx(2.89441, abs=5e-6)
    assert jkr.coordinate(0.0, jkr.adhesion(1.0)) ** 4 == pytest.approx(4.12489, abs=5e-6)
    assert hardness_group(1.0, 1.0) == pytest.approx(3.65084, abs=5e-6)
    eta = float(hardness_group(1.0, 1.0))
    assert plastic_load(2.0, 1.0, eta) - plastic_load(1.0, 1.0, eta) == pytest.approx(7.30168, abs=1e-5)
    assert plastic_load(0.0, 1.0, eta) == pytest.approx(-6.28319, abs=5e-6)


def test_hardness_group_scales_as_printed():
    """eta = 3.65084 lambda^(1/4) theta^(-1/2) (eq. 2 of the paper)."""
    assert_allclose(hardness_group(np.array([4.0, 100.0]), np.array([16.0, 1e4])), [3.65084, 3.65084], rtol=2e-6)


JKR_POINTS = [  # x theta^(2/3), w theta^(2/3), P theta: section 0.1, five or six digits
    ("touching", 4.12489, 0.0, -4.18879),
    ("no load", 7.08273, 2.36091, 0.0),
    ("pull-off at given load", 2.81078, -0.93693, -4.71239),
    ("pull-off at given displacement", 0.64963, -1.94889, -2.61799),
]
MAUGIS_POINTS = [  # A, D, P in Maugis's units (section A2)
    (1.817121, 1.100642, 0.0),
    (1.386723, 0.0, -4.0 / 3.0),
    (1.144714, -0.436790, -1.5),
    (0.550321, -0.908560, -5.0 / 6.0),
]


@pytest.mark.parametrize("theta", (1e-3, 1.0, 40.0, 1e8))
@pytest.mark.parametrize(("name", "x", "w", "P"), JKR_POINTS)
def test_jkr_points(name, x, w, P, theta):
    S = jkr.adhesion(theta)
    u = (x * theta ** (-2 / 3)) ** 0.25
    assert jkr.area(u) * theta ** (2 / 3) == pytest.approx(x, rel=1e-12)
    assert jkr.displacement(u, S) * theta ** (2 / 3) == pytest.approx(w, abs=1.5e-5)
    assert jkr.load(u, S) * theta == pytest.approx(P, abs=3e-5)


@pytest.mark.parametrize(("A", "D", "P"), MAUGIS_POINTS)
def test_jkr_in_maugis_units(A, D, P):
    """a = A (pi gamma R^2/K)^(1/3), omega = D (pi^2 gamma^2 R/K^2)^(1/3), P = P' pi gamma R: here at theta = 1, where
    x = A^2 pi^(2/3), w = D pi^(2/3) and P = P' pi."""
    u = math.sqrt(A) * math.pi ** (1 / 6)
    S = jkr.adhesion(1.0)
    assert jkr.displacement(u, S) / math.pi ** (2 / 3) == pytest.approx(D, abs=3e-6)
    assert jkr.load(u, S) / math.pi == pytest.approx(P, abs=5e-6)


def test_jkr_inverse_formula():
    """a^3 = (R/K)[P + 3 pi gamma R + sqrt(6 pi gamma R P + (3 pi gamma R)^2)] (section A2), on the loading branch."""
    for theta in (0.01, 1.0, 500.0):
        S = jkr.adhesion(theta)
        for P in np.array([-4.7, -1.0, 0.0, 3.0, 1e4]) / theta:
            pull = 3.0 * math.pi / theta
            cube = P + pull + math.sqrt(2.0 * pull * P + pull * pull)
            assert jkr.load(cube ** (1 / 6), S) == pytest.approx(P, rel=1e-12, abs=1e-12 / theta)


def test_jkr_stiffness():
    """dP/d(omega) = 2 E* a (3 sqrt(P1) - 3 sqrt(Pc))/(3 sqrt(P1) - sqrt(Pc)) (section A2); with K = 4/3 E* and in units of
    K sqrt(R sigma), 2 E* a is (3/2) u^2."""
    theta = 7.0
    S, pull_off = jkr.adhesion(theta), 1.5 * math.pi / theta
    for u in (0.9, 1.2, 3.0):
        step = 1e-5
        rise = jkr.load(u + step, S) - jkr.load(u - step, S)
        found = rise / (jkr.displacement(u + step, S) - jkr.displacement(u - step, S))
        p1, pc = math.sqrt(u**6), math.sqrt(pull_off)
        assert found == pytest.approx(1.5 * u * u * 3.0 * (p1 - pc) / (3.0 * p1 - pc), rel=1e-8)
        assert jkr.stretch(u, S) == pytest.approx(
            (jkr.displacement(u + step, S) - jkr.displacement(u - step, S)) / (2 * step), rel=1e-8
        )


@pytest.mark.parametrize("theta", (1e-3, 0.1, 1.0, 1e3, 1e8))
def test_jkr_coordinate_inverts_displacement(theta):
    S = jkr.adhesion(theta)
    start = (S / 6.0) ** (1 / 3)  # dw/du = 0
    for u in start * np.geomspace(1.0 + 1e-6, 1e4, 60):
        found = jkr.coordinate(jkr.displacement(u, S), S)
        # Near the turning point of w(u) the coordinate is the square root of a rounded difference.
        assert found == pytest.approx(u, rel=1e-12 if u > 1.01 * start else 1e-8)
    assert jkr.coordinate(-1e9, S) == pytest.approx(start)
    assert jkr.coordinate(math.inf, S) == math.inf


def test_hertz():
    """P = (4/3) E* R^(1/2) omega^(3/2), a^2 = R omega (section A1)."""
    for w in (0.0, 1e-8, 0.25, 4.0, 1e6):
        displacement, slope, load, area = hertz.normal(hertz.root_of(w))
        assert (displacement, load, area) == (pytest.approx(w), pytest.approx(w**1.5), pytest.approx(w))
        assert slope == pytest.approx(2.0 * math.sqrt(w))
    assert hertz.load(4.0) == 8.0


@pytest.mark.parametrize("law", (hertz, dmt, ceb), ids=lambda law: law.RECORD.key)
def test_nothing_resists_without_a_tangential_law(law):
    for regime in Law(law.RECORD).regimes(groups(3.0, np.ones(4))):
        assert not states(regime, regime.edges[:, 0] + np.array([0.0, 0.1, 0.3, 2.0]))[:, 4:].any()


def test_dmt():
    """Hertz less 2 pi gamma R (section A3): its pull-off is 4/3 of JKR's."""
    displacement, _, load, area = dmt.normal(0.0, 5.0)
    assert (displacement, area) == (0.0, 0.0)
    assert load == pytest.approx(4.0 / 3.0 * -4.71239 / 5.0, abs=1e-5)
    assert dmt.normal(2.0, 5.0)[2] == pytest.approx(8.0 - 2.0 * math.pi / 5.0)


FIRST_YIELD = [  # nu, z/a, p0/Y: table A5
    (0.10, 0.4149, 1.3945),
    (0.20, 0.4478, 1.4986),
    (0.25, 0.4643, 1.5543),
    (0.30, 0.4809, 1.6128),
    (0.35, 0.4975, 1.6741),
    (0.40, 0.5142, 1.7385),
    (0.45, 0.5310, 1.8061),
    (0.499, 0.5475, 1.8758),
]


@pytest.mark.parametrize(("nu", "depth", "pressure"), FIRST_YIELD)
def test_first_yield_of_a_hertz_contact(nu, depth, pressure):
    assert hertz.first_yield(nu) == (pytest.approx(pressure, abs=5.1e-5), pytest.approx(depth, abs=5.1e-5))


@pytest.mark.parametrize(("nu", "fit"), [(0.2, 1.5008), (0.3, 1.6156), (0.4, 1.7304)])
def test_hardness_coefficient_is_first_yield(nu, fit):
    """2.8 (0.454 + 0.41 nu) = p0/Y within 0.5 % (table A5, last column)."""
    assert 2.8 * ceb.hardness_coefficient(nu) == pytest.approx(fit, abs=5e-5)
    assert fit == pytest.approx(hertz.first_yield(nu)[0], rel=5e-3)


CEB_TABLE = [(1.5, 3.0, 2.0), (2, 4.5, 3.0), (3, 7.5, 5.0), (6, 16.5, 11), (20, 58.5, 39), (110, 328.5, 219)]


@pytest.mark.parametrize(("w_ratio", "load", "area"), CEB_TABLE)
def test_chang_etsion_bogy_1987(w_ratio, load, area):
    """P/P_c and A/A_c at w/w_c (cross-model table, column CEB): P_c = w_c^(3/2), A_c = pi R w_c."""
    eta, K_H = 2.3, float(ceb.hardness_coefficient(0.3))
    w_c = float(ceb.critical_interference(eta, K_H))
    _, _, found_load, found_area = ceb.plastic(w_ratio * w_c, w_c, eta, K_H)
    assert (found_load / w_c**1.5, found_area / w_c) == (pytest.approx(load, rel=1e-12), pytest.approx(area, rel=1e-12))


def test_critical_interference():
    """omega_c = (pi K_H H/(2 E*))^2 R (A6), in pascals and metres."""
    H, E, R, sigma, nu = 7e9, 115e9, 50e-6, 48e-9, 0.3
    eta = math.pi * H * math.sqrt(R / sigma) / (4.0 / 3.0 * E)
    K_H = 0.454 + 0.41 * nu
    assert ceb.critical_interference(eta, K_H) * sigma == pytest.approx((math.pi * K_H * H / (2.0 * E)) ** 2 * R, rel=1e-13)


def test_elastic_range():
    """reference/asperity.csv: first contact x0, yield x1 and w1, and the load just plastic: 1e-13."""
    given = bare(ROWS)
    elastic, flow = joined(given)
    edges = elastic.edges
    assert np.all(np.diff(edges, axis=1) >= 0.0)
    assert_allclose(edges[:, 0] ** 4, column(ROWS, "x0"), rtol=1e-13)
    assert_allclose(edges[:, -1] ** 4, column(ROWS, "x1"), rtol=1e-13)
    u1, w1 = plastic.onset(given)
    assert_allclose(w1, column(ROWS, "w1"), rtol=1e-12)
    assert_allclose(edges[:, -1], u1, rtol=1e-14)  # one may be computed by Python, the other by compiled code
    assert_allclose(flow.edges, np.stack([w1, np.full_like(w1, np.inf)], axis=1), rtol=1e-14)
    found = [plastic_load(*one) for one in zip(w1, given.theta, given.eta, strict=True)]
    assert_allclose(found, column(ROWS, "plastic_load_at_w1"), rtol=1e-12)
    assert_allclose(stiffness_group(given.nu), column(ROWS, "K_beta"), rtol=1e-14)


def test_elastic_points():
    """The same table: displacement and load at five places of the elastic range."""
    given = bare(ROWS)
    S = np.array([jkr.adhesion(theta) for theta in given.theta])
    x, w, P = (column(ROWS, name) for name in ("x", "w", "load"))
    u = x**0.25
    near_zero = np.maximum(np.abs(w), x)
    assert np.all(np.abs([jkr.displacement(*one) for one in zip(u, S, strict=True)] - w) < 1e-14 * near_zero)
    assert np.all(np.abs([jkr.load(*one) for one in zip(u, S, strict=True)] - P) < 1e-14 * np.maximum(np.abs(P), x**1.5))
    segment = plastic.segments(given, "loading")[0]
    assert_allclose(coordinates(segment, w), u, rtol=1e-12)
    assert_allclose(states(joined(given)[0], u)[:, :4], np.stack([w, 4.0 * u**3 - 2.0 / 3.0 * S, P, x], axis=1), rtol=1e-11)


@pytest.mark.parametrize(("theta", "lam", "x1", "w1", "jump"), [  # section 0.2.5
    (10, 0.125, 2.9937, 1.7897, 0.890), (10, 1, 4.4166, 3.0897, 1.276), (10, 10, 8.2039, 6.6549, 1.585),
    (1, 1, 30.2699, 23.4808, 1.495), (100, 10, 1.1430, 0.8437, 1.392),
    (1, 100, None, None, 1.870), (100, 1000, None, None, 1.832),
])  # fmt: skip
def test_load_jumps_where_it_becomes_plastic(theta, lam, x1, w1, jump):
    """P_pl(w1)/P_el(x1), a property of the published model that is kept; its mean elastic pressure there is the hardness."""
    given = groups(float(theta), float(lam))
    u1, found_w1 = (float(one[0]) for one in plastic.onset(given))
    found_x1, eta = u1**4, float(given.eta[0])
    if x1 is not None:
        assert (found_x1, found_w1) == (pytest.approx(x1, abs=5.1e-5), pytest.approx(w1, abs=5.1e-5))
    elastic_load = jkr.load(u1, jkr.adhesion(float(theta)))
    # P/(pi a^2) = H is P = eta x: loads are over K R^(1/2) sigma^(3/2), and eta = pi H sqrt(R/sigma)/K.
    assert elastic_load == pytest.approx(eta * found_x1, rel=1e-12)
    assert plastic_load(found_w1, float(theta), eta) / elastic_load == pytest.approx(jump, abs=5.1e-4)


def test_jump_without_adhesion_is_two():
    """Section 0.2.5: tends to exactly 2, from below."""
    given = groups(1e10, 1e16)
    u1, w1 = (float(one[0]) for one in plastic.onset(given))
    ratio = plastic_load(w1, 1e10, float(given.eta[0])) / jkr.load(u1, jkr.adhesion(1e10))
    assert 1.999 < ratio < 2.0


def test_plastic_range_starts_above_touch():
    """Always x1 > x0 and w1 > 0 (theory 2), over the whole range."""
    n = 20000
    theta, lam = 10.0 ** RNG.uniform(-3, 8, n), 10.0 ** RNG.uniform(-6, 8, n)
    nu, k = RNG.uniform(0, 0.499, n), RNG.uniform(1.5, 4.0, n)
    given = groups(theta, lam, nu, k)
    elastic, flow = joined(given)
    assert np.all(elastic.edges[:, -1] > elastic.edges[:, 0]) and np.all(flow.edges[:, 0] > 0.0)
    assert np.all(elastic.branch < elastic.edges[:, -1])
