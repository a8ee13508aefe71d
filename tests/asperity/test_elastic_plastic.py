"""Elastic-plastic asperities without adhesion: Zhao-Maietta-Chang, Kogut-Etsion, Jackson-Green, Brizmer-Kligerman-Etsion.

reference/<key>.csv holds independent values at 30 digits; the tables below were computed from the published equations
before this package had them, or are the output of an independent code.
"""

import math
import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from stiction.contact.indices import Groups
from stiction.engine.heights import gaussian
from stiction.engine.summation import scattered
from stiction.laws.asperity import brizmer_kligerman_etsion_2006 as bke
from stiction.laws.asperity import chang_etsion_bogy_1987 as ceb
from stiction.laws.asperity import hertz
from stiction.laws.asperity import jackson_green_2005 as jg
from stiction.laws.asperity import kogut_etsion_2002 as ke
from stiction.laws.asperity import zhao_maietta_chang_2000 as zmc
from stiction.laws.asperity.shared.transition import FULLY_PLASTIC, plastic_share
from stiction.laws.joining import Law
from tables import column, read

LAWS = (zmc, ke, jg, bke)
each = pytest.mark.parametrize("law", LAWS, ids=lambda law: law.RECORD.key)
INPUTS = ("theta", "lam", "nu", "hardness_to_yield", "sharpness")
GIVEN = {"theta": 1e3, "lam": 100.0, "nu": 0.3, "hardness_to_yield": 2.8, "sharpness": 0.02}


def contact(**changes):
    """Groups of one contact, or of as many as the changes have."""
    values = np.broadcast_arrays(*(np.atleast_1d(np.asarray(value, dtype=float)) for value in (GIVEN | changes).values()))
    given = dict(zip(GIVEN | changes, map(np.ascontiguousarray, values), strict=True))
    return Groups(**given, K_beta=8.0 / 3.0 * (2.0 - given["nu"]) / (1.0 - given["nu"]))


def state(segment, w, i=0):
    """Load and area of one law's segment at the displacement w."""
    row = [float(column[i]) for column in segment.parameters]
    u = segment.coordinate(w, *row)
    found, slope, load, area = segment.normal(u, *row)
    assert found == pytest.approx(w, rel=1e-14) and slope == pytest.approx(2.0 * u, rel=1e-14)
    return load, area


def ends(segment, i=0):
    """Displacements at which a segment begins and ends."""
    return segment.edges[i, 0] ** 2, segment.edges[i, -1] ** 2


def load_and_area(segments, w, i=0):
    """Of the asperity at w; where segments meet, of the one that ends there."""
    for segment in segments:
        if w <= ends(segment, i)[1]:
            return state(segment, w, i)
    raise AssertionError(w)


@each
def test_independent_values(law):
    rows = read(f"{law.RECORD.key}.csv")
    groups = contact(**{name: column(rows, name) for name in INPUTS})
    segments = law.segments(groups)
    found = [load_and_area(segments, w, i) for i, w in enumerate(column(rows, "w"))]
    assert_allclose(found, np.column_stack([column(rows, "load"), column(rows, "area")]), rtol=1e-13)


@each
def test_sums_over_heights(law):
    rows = read(f"{law.RECORD.key}.csv")[::6]
    groups = contact(**{name: column(rows, name) for name in INPUTS})
    expected = np.column_stack([column(rows, "load_sum"), column(rows, "area_sum")])
    found = scattered(Law(law.RECORD).regimes(groups), column(rows, "h"), gaussian()).sum(axis=0)
    assert_allclose(found[:, 1:3], expected, rtol=law.RECORD.accuracy)
    assert np.all(found[:, 3:] == 0.0)


# P/P_c and A/A_c at omega/omega_c, each in its own critical values; nu = 0.3, S_y/E* = 1e-3.
TABLE = [
    (1.5, 1.836, 1.474, 1.837, 1.500, 1.837, 1.500, 1.729, 1.500),
    (2, 2.766, 2.044, 2.825, 2.021, 2.829, 2.015, 2.524, 2.002),
    (3, 4.929, 3.240, 5.111, 3.203, 4.998, 3.203, 4.257, 3.012),
    (6, 13.234, 7.120, 13.293, 7.360, 13.002, 7.074, 10.294, 6.150),
    (10, 25.652, 13.156, 26.024, 13.446, 25.885, 12.686, 20.090, 10.767),
    (20, 61.564, 29.114, 63.431, 29.619, 64.227, 28.021, 55.008, 25.868),
    (50, 195.85, 83.21, 203.18, 80.91, 202.93, 79.88, 245.10, 99.19),
    (110, 530.16, 205.38, 551.97, 187.57, 520.98, 196.75, 550.0, 220.0),
]


def table_contact():
    """S_y/E* = (4/3) eta sharpness/(pi k) = 1e-3."""
    eta = float(contact().eta[0])
    return contact(sharpness=1e-3 * 2.8 * math.pi / (4.0 / 3.0 * eta))


def critical(law, groups):
    """omega_c and the load there."""
    eta, nu, k = groups.eta, groups.nu, groups.hardness_to_yield
    if law is bke:
        w_c, load = bke.critical_values(eta, nu, k)
        return float(w_c[0]), float(load[0])
    w_c = {
        zmc: lambda: zmc.first_yield(eta),
        ke: lambda: ceb.critical_interference(eta, ceb.hardness_coefficient(nu)),
        jg: lambda: jg.critical_interference(eta, jg.yield_coefficient(nu), k),
    }[law]()
    return float(w_c[0]), float(w_c[0]) ** 1.5


@pytest.mark.parametrize(("law", "at"), [(ke, 1), (bke, 3), (jg, 5), (zmc, 7)], ids=lambda one: getattr(one, "__name__", ""))
def test_cross_model_table(law, at):
    groups = table_contact()
    w_c, P_c = critical(law, groups)
    segments = law.segments(groups)
    for row in TABLE:
        load, area = load_and_area(segments, row[0] * w_c)
        assert load / P_c == pytest.approx(row[at], rel=6e-4)
        assert area / w_c == pytest.approx(row[at + 1], rel=6e-4)


def test_finite_element_fits_agree():
    """Kogut-Etsion, Brizmer et al. and Jackson-Green: load within 6 %, area within 10 % for 1.5 <= omega/omega_c <= 110, each
    in its own critical values."""
    groups = table_contact()
    found = []
    for law in (ke, bke, jg):
        w_c, P_c = critical(law, groups)
        segments = law.segments(groups)
        found.append([np.array(load_and_area(segments, r * w_c)) / (P_c, w_c) for r in np.geomspace(1.5, 110.0, 200)])
    spread = np.max(found, axis=0) / np.min(found, axis=0)
    assert spread[:, 0].max() < 1.06 and spread[:, 1].max() < 1.10


FIRST_YIELD = [  # nu, exact p0/Y, fits: Jackson-Green, Brizmer et al., 2.8 K_H
    (0.10, 1.3945, 1.3939, 1.3596, 1.3860),
    (0.20, 1.4986, 1.5004, 1.4852, 1.5008),
    (0.25, 1.5543, 1.5566, 1.5480, 1.5582),
    (0.30, 1.6128, 1.6150, 1.6108, 1.6156),
    (0.35, 1.6741, 1.6755, 1.6736, 1.6730),
    (0.40, 1.7385, 1.7383, 1.7364, 1.7304),
    (0.45, 1.8061, 1.8035, 1.7992, 1.7878),
    (0.499, 1.8758, 1.8697, 1.8607, 1.8441),
]


@pytest.mark.parametrize(("nu", "exact", "jackson", "brizmer", "kogut"), FIRST_YIELD)
def test_fits_of_first_yield(nu, exact, jackson, brizmer, kogut):
    """Largest pressure over yield stress at first yield: the fits as tabulated, and as good as they are."""
    assert hertz.first_yield(nu)[0] == pytest.approx(exact, abs=5.1e-5)
    found = jg.yield_coefficient(nu), bke.yield_coefficient(nu), 2.8 * ceb.hardness_coefficient(nu)
    assert found == pytest.approx((jackson, brizmer, kogut), abs=5.1e-5)
    assert found == pytest.approx((exact,) * 3, rel=0.026)


@each
def test_jumps_are_those_of_the_record(law):
    """At every place where segments meet, from both sides: the record's factors, or no jump."""
    jumps = {jump.segment: jump for jump in law.RECORD.jumps}
    for number in range(1, len(law.segments(contact()))):
        jump = jumps.get(number)
        segments = law.segments(contact(**(jump.groups if jump else {})))
        before, after = segments[number - 1], segments[number]
        assert before.edges[0, -1] == after.edges[0, 0]
        w = ends(after)[0]
        factors = np.array(state(after, w * (1 + 1e-12))) / state(before, w * (1 - 1e-12))
        assert_allclose(factors, (jump.load, jump.area) if jump else (1.0, 1.0), rtol=1e-5 if jump else 1e-10)


def test_closed_forms_of_jumps():
    """Kogut-Etsion at 110 omega_c: load 530.2 -> 571.9 (nu = 0.3), area 205.4 -> 220; 3 % and -7 % at omega_c."""
    groups = contact()
    w_c, P_c = critical(ke, groups)
    *_, before, after = ke.segments(groups)
    load, area = state(before, 110.0 * w_c)
    assert (load / P_c, area / w_c) == (pytest.approx(530.2, abs=0.05), pytest.approx(205.4, abs=0.05))
    load, area = state(after, 110.0 * w_c)
    assert (load / P_c, area / w_c) == (pytest.approx(571.9, abs=0.05), pytest.approx(220.0, rel=1e-12))
    assert 110.0 * 3.0 / 0.577 == pytest.approx(571.9, abs=0.05)
    for nu, factor in ((0.0, 1.371), (0.499, 0.945)):  # 330/(1.4 K_H 110^1.263)
        *_, before, after = ke.segments(contact(nu=nu))
        w = ends(after)[0]
        assert state(after, w)[0] / state(before, w)[0] == pytest.approx(factor, abs=5e-4)


def test_fully_plastic_is_the_hardness():
    """Mean pressure H on twice the truncated area: P = eta x, x = 2 w."""
    groups = contact()
    for law in (ke, zmc):
        w = 5.0 * ends(law.segments(groups)[-1])[0]
        load, area = load_and_area(law.segments(groups), w)
        assert area == pytest.approx(2.0 * w) and load == pytest.approx(float(groups.eta[0]) * area)


def test_zhao_maietta_chang_is_smooth():
    """omega_1 = (3 pi k H/(4 E*))^2 R; mean pressure 0.4 H there; the slope of the area is that of pi R omega and of 2 pi R
    omega at the ends, that of the load jumps."""
    groups = contact()
    H, E, R, sigma = 1.0, 60.0, 4.0, 0.01
    eta = math.pi * H * math.sqrt(R / sigma) / (4.0 / 3.0 * E)
    assert zmc.first_yield(eta) * sigma == pytest.approx((3.0 * math.pi * 0.4 * H / (4.0 * E)) ** 2 * R, rel=1e-13)
    middle = zmc.segments(groups)[1]
    first, last = ends(middle)
    assert last / first == pytest.approx(54.0)
    load, area = state(middle, first)
    assert load / area == pytest.approx(0.4 * float(groups.eta[0]))
    for w, sign, slope in ((first, 1.0, 1.0), (last, -1.0, 2.0)):
        step = sign * 1e-6 * w
        assert (state(middle, w + step)[1] - state(middle, w)[1]) / step == pytest.approx(slope, abs=1e-4)


# Output of an independent code (TMDSimPy's reference values for the law of Ghaednia et al. 2019), two like spheres:
# E = 1.92e11 Pa, nu = 0.3, effective radius 1.4 mm, S_y = 3.3e8 Pa. Displacement, contact radius, force; without hardening
# in the last row, which is the only one beyond 1.9 omega_c.
INDEPENDENT = [
    (4.407882127871e-8, 7.855593535195e-6, 4.870544928015e-2),
    (8.815764255743e-8, 1.110948691796e-5, 1.377598138669e-1),
    (2.644729276723e-7, 1.989065002445e-5, 6.885474816181e-1),
]


def test_jackson_green_against_an_independent_code():
    """That code flattens one of the spheres against the plane between them: radius 2 R, modulus 2 E*, half the displacement,
    the same force. Its hardness is the later 2.84 - 0.92 (1 - cos(pi a/R)), which is put in for the last digits."""
    E, nu, S_y, R = 1.92e11, 0.3, 3.3e8, 2.0 * 1.4e-3
    E_star = E / (1.0 - nu * nu)
    C, B = float(jg.yield_coefficient(nu)), float(jg.area_power(S_y / E_star))
    d_c = (math.pi * C * S_y / (2.0 * E_star)) ** 2 * R
    P_c = 4.0 / 3.0 * (R / E_star) ** 2 * (C * math.pi * S_y / 2.0) ** 3
    for displacement, radius, force in INDEPENDENT[:2]:
        d = displacement / 2.0
        assert d < 1.9 * d_c
        assert math.sqrt(R * d) == pytest.approx(radius, rel=1e-12)
        assert hertz.load(d / d_c) * P_c == pytest.approx(force, rel=1e-11)
    displacement, radius, force = INDEPENDENT[2]
    d = displacement / 2.0
    assert d / d_c == pytest.approx(3.0, rel=1e-12)
    a = math.sqrt(R * d * jg.area_ratio(d / d_c, B))
    assert a == pytest.approx(radius, rel=1e-11)
    later = 2.84 - 0.92 * (1.0 - math.cos(math.pi * a / R))
    assert jg.load_ratio(d / d_c, C, later) * P_c == pytest.approx(force, rel=1e-11)
    assert jg.load_ratio(d / d_c, C, jg.hardness(a / R)) * P_c == pytest.approx(force, rel=3e-5)


def test_jackson_green_hardness():
    """2.84 S_y on a blunt contact, less on a sharp one, by hand; the law's file says the same, and so does the page."""
    assert jg.hardness(1e-3) == pytest.approx(2.84, rel=1e-12)
    (said,) = re.findall(r"\$H_G/Y=(\d\.\d{4})\$ at \$a/R=0\.2\$ and (\d\.\d{4}) at 0\.5", jg.__doc__)
    for radius, printed in zip((0.2, 0.5), said, strict=True):
        by_hand = 2.84 * (1.0 - math.exp(-0.82 / math.exp(0.7 * math.log(radius))))
        assert float(printed) == pytest.approx(by_hand, abs=5.1e-5)
        assert jg.hardness(radius) == pytest.approx(by_hand, rel=1e-13)
    groups = contact(sharpness=np.array([1e-4, 0.05]), lam=1e4)
    segments = jg.segments(groups)
    assert state(segments[1], 20.0, 0)[0] > state(segments[1], 20.0, 1)[0]


def test_stick_over_slip():
    """Critical load and interference in full stick over those in slip: 0.8507, 0.8825 (nu = 0.3), 1.006, 0.994 (nu = 1/2); held
    below nu = 0.2; critical interference in slip as in pascals and metres."""
    assert bke.stick_load_ratio(0.3) == pytest.approx(0.8507, abs=5e-5)
    assert bke.stick_displacement_ratio(0.3) == pytest.approx(0.8825, abs=5.1e-5)
    assert bke.stick_load_ratio(0.5) == pytest.approx(1.006, abs=5.1e-4)
    assert bke.stick_displacement_ratio(0.5) == pytest.approx(0.994, abs=5.1e-4)
    for ratio in (bke.stick_load_ratio, bke.stick_displacement_ratio):
        assert ratio(0.0) == ratio(0.2) > 0.0
    E, nu, Y, R, sigma, k = 2e11, 0.3, 3e8, 1e-4, 1e-7, 2.8
    E_star = E / (1.0 - nu * nu)  # against a rigid flat
    K = 4.0 / 3.0 * E_star
    eta = math.pi * k * Y * math.sqrt(R / sigma) / K
    C = 1.234 + 1.256 * nu
    slip_limited = (math.pi * C * (1.0 - nu * nu) / 2.0 * Y / E) ** 2 * R
    load = math.pi**3 * Y / 6.0 * C**3 * (R * (1.0 - nu * nu) * Y / E) ** 2
    w_c, L_c = bke.critical_values(eta, nu, k)
    assert w_c * sigma == pytest.approx(bke.stick_displacement_ratio(nu) * slip_limited, rel=1e-13)
    assert L_c * K * math.sqrt(R) * sigma**1.5 == pytest.approx(bke.stick_load_ratio(nu) * load, rel=1e-13)


def test_full_stick_starts_smoothly():
    """At first yield the law leaves (delta/delta_c)^(3/2) with all derivatives: exp(-1/x)."""
    _, yielding = bke.segments(contact())
    w_c, P_c = critical(bke, contact())
    for beyond in (-1e-15, 0.0, 1e-12, 1e-6, 1e-3, 0.05):
        ratio = 1.0 + beyond
        load, area = state(yielding, ratio * w_c)
        assert load / P_c == pytest.approx(ratio**1.5, rel=1e-13) and area / w_c == pytest.approx(ratio, rel=1e-13)


@each
def test_a_hard_asperity_is_elastic(law):
    """Yield moves out of reach; and nothing overflows beyond it."""
    groups = contact(theta=1.0, lam=1e24, nu=np.array([0.0, 0.3, 0.499]))
    segments = law.segments(groups)
    for i in range(3):
        load, area = load_and_area(segments, 7.0, i)
        nu = groups.nu[i]
        stiffer = bke.stick_load_ratio(nu) / bke.stick_displacement_ratio(nu) ** 1.5 if law is bke else 1.0
        assert 1.0 <= stiffer < 1.045
        assert (load, area) == (pytest.approx(7.0**1.5 * stiffer, rel=1e-12), pytest.approx(7.0, rel=1e-14))
        for segment in segments[1:]:
            assert np.all(np.isfinite(state(segment, 2.0 * ends(segment, i)[0], i)))


@each
def test_finite_everywhere(law):
    """Over the whole range of the groups, to 1e6 critical interferences: load and area positive, area growing."""
    n = 300
    rng = np.random.default_rng(5)
    groups = contact(
        theta=10.0 ** rng.uniform(-3, 8, n),
        lam=10.0 ** rng.uniform(-6, 8, n),
        nu=rng.uniform(0.0, 0.499, n),
        hardness_to_yield=rng.uniform(1.0, 4.0, n),
        sharpness=10.0 ** rng.uniform(-4, 0, n),
    )
    segments = law.segments(groups)
    for i in range(n):
        first = ends(segments[0], i)[1]
        for segment in segments:
            low, high = ends(segment, i)
            w = np.geomspace(max(low, 1e-9 * first), min(high, 1e6 * first), 12)
            found = np.array([state(segment, one, i) for one in w])
            assert np.all(np.isfinite(found)) and np.all(found > 0.0) and np.all(np.diff(found[:, 1]) > 0.0)


def test_records():
    for law in LAWS:
        record = law.RECORD
        assert record.key == law.__name__.rsplit(".", 1)[-1]
        assert "no adhesion" in record.traits and ("Hertz" in record.traits) == (law is not bke)
        assert law.segments(contact())[0].state == "elastic"


def test_the_share_that_flows_is_the_step_of_zhao_maietta_and_chang():
    """3 xi^2 - 2 xi^3 of the square of the pressure over hardness r, xi from 0 at r = 1 to 1 at r^2 = 54 x 0.4^2; slopes by
    differences."""
    end = math.sqrt(54.0) * 0.4
    assert FULLY_PLASTIC == pytest.approx(end, rel=1e-15)
    assert plastic_share(0.3) == plastic_share(1.0) == (0.0, 0.0)
    assert plastic_share(end) == plastic_share(9.0) == (pytest.approx(1.0), pytest.approx(0.0, abs=1e-12))
    for r in (1.01, 1.5, 2.2, 2.9):
        xi = (r**2 - 1.0) / (end**2 - 1.0)
        share, slope = plastic_share(r)
        assert share == pytest.approx(3.0 * xi**2 - 2.0 * xi**3, rel=1e-13)
        near, far = plastic_share(r - 1e-5)[0], plastic_share(r + 1e-5)[0]
        assert slope == pytest.approx((far - near) / 2e-5, rel=1e-6)
