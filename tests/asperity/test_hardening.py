"""The asperity of a hardening material, Ghaednia et al. 2019.

reference/ghaednia_2019.csv holds independent values at 30 digits; the table below is the output of an independent code.
"""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from stiction.engine.heights import gaussian
from stiction.engine.summation import scattered
from stiction.laws.asperity import ghaednia_2019 as law
from stiction.laws.asperity import jackson_green_2005 as jg
from stiction.laws.joining import Law, normal_states
from tables import column, groups, read

RECORD = law.RECORD
INPUTS = ("theta", "lam", "nu", "hardness_to_yield", "sharpness", "hardening")
BODIES = ("alike", "rigid")
GIVEN = {"theta": 1e3, "lam": 100.0, "sharpness": 0.02, "hardening": 0.01}
GAMMA = 1.0  # no part of the law: only theta and lambda need one


def contact(**changes):
    return groups(**(GIVEN | changes))


def states(segment, w):
    """Displacement, slope, load and area of every law at its displacement w."""
    u = np.array([segment.coordinate(one, *row) for one, *row in zip(w, *segment.parameters, strict=True)])
    found = normal_states(segment, u)
    assert_allclose(found[:, 0], w, rtol=1e-14)
    assert_allclose(found[:, 1], 2.0 * u, rtol=1e-14)
    return found


def load_and_area(given, w, **options):
    """Of every law at its displacement; where segments meet, of the one that ends there."""
    elastic, yielding = law.segments(given, **options)
    w = np.broadcast_to(np.asarray(w, dtype=float), given.theta.shape)
    return np.where(w[:, None] <= elastic.edges[:, -1:] ** 2, states(elastic, w)[:, 2:4], states(yielding, w)[:, 2:4])


def made_of(E_star, R, nu, S_y, E_t, E, k=2.8, sigma=1e-7):
    """Groups of a contact in pascals and metres; its units of displacement, load and area; eta from its definition."""
    K, H = 4.0 / 3.0 * E_star, k * S_y
    theta = K * sigma**1.5 / (GAMMA * math.sqrt(R))
    lam = math.pi**2 * R * H**4 * sigma / (18.0 * K**2 * GAMMA**2)
    given = contact(theta=theta, lam=lam, nu=nu, hardness_to_yield=k, sharpness=math.sqrt(sigma / R), hardening=E_t / E)
    return given, (sigma, K * math.sqrt(R) * sigma**1.5, math.pi * R * sigma)


# Two like spheres: E, nu, effective radius, S_y, E_t; displacement, contact radius, force. Reference values of TMDSimPy, of its
# normal law on first loading; SI units.
STEEL = (1.92e11, 0.3, 1.4e-3, 3.3e8, 6.2e8)
OTHER = (2.5e11, 0.2, 5e-3, 2e8, 8e8)
PERFECT = (1.92e11, 0.3, 1.4e-3, 3.3e8, 0.0)
INDEPENDENT = [
    (STEEL, 4.407882127871e-08, 7.855593535195e-06, 4.870544928015e-02),
    (STEEL, 8.815764255743e-08, 1.110948691796e-05, 1.377598138669e-01),
    (STEEL, 2.644729276723e-07, 1.982362642132e-05, 6.888366827256e-01),
    (STEEL, 3.526305702297e-07, 2.332476313491e-05, 1.027539609829e00),
    (STEEL, 4.848670340659e-07, 2.792710944737e-05, 1.592598956089e00),
    (STEEL, 5.289458553446e-07, 2.933583720063e-05, 1.793586193990e00),
    (STEEL, 7.052611404594e-07, 3.452008361584e-05, 2.649302530405e00),
    (OTHER, 3.276106613331e-08, 1.279864565751e-05, 7.279466611154e-02),
    (OTHER, 6.552213226661e-08, 1.810001826886e-05, 2.058944081667e-01),
    (OTHER, 1.965663967998e-07, 3.225058324276e-05, 1.052855831184e00),
    (PERFECT, 4.407882127871e-08, 7.855593535195e-06, 4.870544928015e-02),
    (PERFECT, 8.815764255743e-08, 1.110948691796e-05, 1.377598138669e-01),
    (PERFECT, 2.644729276723e-07, 1.989065002445e-05, 6.885474816181e-01),
]


@pytest.mark.parametrize(("body", "displacement", "radius", "force"), INDEPENDENT)
def test_against_an_independent_code(body, displacement, radius, force):
    """That code flattens one of the spheres against the plane between them, which is rigid by symmetry: twice the effective
    radius, E/(1 - nu^2), half the displacement, the same force."""
    E, nu, R, S_y, E_t = body
    given, (unit, unit_load, unit_area) = made_of(E / (1.0 - nu * nu), 2.0 * R, nu, S_y, E_t, E)
    ((load, area),) = load_and_area(given, displacement / 2.0 / unit, other_body="rigid")
    assert load * unit_load == pytest.approx(force, rel=2e-12)
    assert math.sqrt(area * unit_area / math.pi) == pytest.approx(radius, rel=2e-12)


def test_against_a_body_alike():
    """E* is half as large then, E the same: a sphere of 200 GPa on a flat of 200 GPa, the equations written out in SI units."""
    E, nu, R, S_y, E_t, d = 2e11, 0.33, 1e-3, 5e8, 0.04 * 2e11, 1e-5
    E_star = E / 2.0 / (1.0 - nu * nu)
    given, (unit, unit_load, unit_area) = made_of(E_star, R, nu, S_y, E_t, E)
    C = 1.295 * math.exp(0.736 * nu)
    d_c = (math.pi * C * S_y / (2.0 * E_star)) ** 2 * R
    a_e, a_p = math.sqrt(R * d), math.sqrt(R * d * (d / d_c / 1.9) ** (0.14 * math.exp(23.0 * S_y / E_star)))
    root, e = math.sqrt(E / S_y), E_t / E
    upsilon = -2.0 * root * e ** (1.0 - (d - d_c) / R) / ((4.0 - 3.0 * math.exp(-2.0 * root * e)) * (1.0 - e))
    a = a_e + (a_p - a_e) * math.exp(upsilon)
    H = 2.84 - 0.92 * (1.0 - math.cos(math.pi * a / R))
    x = d / d_c
    F_c = 4.0 / 3.0 * (R / E_star) ** 2 * (C * math.pi * S_y / 2.0) ** 3
    F_p = F_c * (math.exp(-0.25 * x ** (5 / 12)) * x**1.5 + 4.0 * H / C * (1.0 - math.exp(-(x ** (5 / 9)) / 25.0)) * x)
    F = F_p + (4.0 / 3.0 * E_star * math.sqrt(R) * d**1.5 - F_p) * (1.0 - math.exp(-3.3 * e))
    ((load, area),) = load_and_area(given, d / unit)
    assert a_e < a < a_p
    assert (load * unit_load, area * unit_area) == (pytest.approx(F, rel=1e-12), pytest.approx(math.pi * a * a, rel=1e-12))


def reference():
    rows = read(f"{RECORD.key}.csv")
    for body in BODIES:
        yield body, [row for row in rows if row["other_body"] == body]


def test_independent_values():
    for body, rows in reference():
        found = load_and_area(contact(**{name: column(rows, name) for name in INPUTS}), column(rows, "w"), other_body=body)
        assert_allclose(found, np.column_stack([column(rows, "load"), column(rows, "area")]), rtol=2e-13)


def test_sums_over_heights():
    for body, rows in reference():
        rows = rows[::6]
        given = contact(**{name: column(rows, name) for name in INPUTS})
        found = scattered(Law(RECORD, options={"other_body": body}).regimes(given), column(rows, "h"), gaussian()).sum(axis=0)
        expected = np.column_stack([column(rows, "load_sum"), column(rows, "area_sum")])
        assert_allclose(found[:, 1:3], expected, rtol=RECORD.accuracy)


def beyond(given, ratios, **options):
    """Displacements at these multiples of where the second segment begins, for the first law."""
    return ratios * law.segments(given, **options)[1].edges[0, 0] ** 2


RATIOS = np.geomspace(1.001, 1e5, 40)


def test_without_hardening_it_is_jackson_and_green():
    """The area is theirs. The load is theirs with another limiting hardness: the same 2.84 S_y on a blunt contact, and within
    3 in 1000 of theirs up to a/R = 0.1."""
    for sharpness, widest, within in ((1e-8, 1.0, 1e-10), (0.02, 0.1, 3e-3)):
        given = contact(sharpness=np.full(40, sharpness), hardening=0.0)
        w = beyond(given, RATIOS)
        theirs = states(jg.segments(given)[1], w)[:, 2:4]
        found = load_and_area(given, w)
        assert_allclose(found[:, 1], theirs[:, 1], rtol=1e-13)
        blunt = np.sqrt(found[:, 1]) * sharpness < widest
        assert blunt.sum() > 15
        assert_allclose(found[blunt, 0], theirs[blunt, 0], rtol=within)


def test_little_hardening_is_nearly_none():
    given = contact(hardening=np.array([0.0, 1e-300, 1e-12]))
    found = load_and_area(given, 30.0 * law.segments(given)[1].edges[0, 0] ** 2)
    assert_allclose(found[1:], np.tile(found[0], (2, 1)), rtol=1e-9)


def test_hardening_takes_it_towards_hertz():
    """The more it hardens, the smaller the area and the higher the load, between those of the sphere that does not harden and
    Hertz's; for E_t -> E the area is Hertz's and the load 1 - exp(-3.3) of the way."""
    hardening = np.array([0.0, 1e-3, 0.01, 0.05, 0.2, 0.5, 1.0 - 1e-12])
    given = contact(hardening=hardening)
    w = beyond(given, 50.0)
    load, area = load_and_area(given, w).T
    assert np.all(np.diff(area) <= 0.0) and area[1] < area[0] and np.all(np.diff(load) > 0.0)
    assert area[-1] == pytest.approx(w, rel=1e-13)
    nearly = contact(hardening=np.array([1.0 - 1e-12]), sharpness=1e-9)  # blunt: H_G = 2.84 S_y at any area
    w = beyond(nearly, 50.0)
    soft = load_and_area(contact(hardening=0.0, sharpness=1e-9), w)[0, 0]
    share = (load_and_area(nearly, w)[0, 0] - soft) / (w**1.5 - soft)
    assert share == pytest.approx(1.0 - math.exp(-3.3), rel=1e-9)


def test_limiting_hardness():
    """2.84 S_y on a blunt contact, 1.92 where the contact radius is half that of the sphere, S_y from a = R on."""
    assert [law.hardness(one) for one in (1e-9, 0.5, 1.0, 1.5)] == pytest.approx([2.84, 1.92, 1.0, 1.0], rel=1e-14)


def test_the_second_segment_is_split_where_it_is_not_smooth():
    """Edges in order, one of them where a = R, and one where Upsilon = -1: a is then 1/e of the way from a_e to a_p."""
    given = contact(theta=30.0, lam=1.0, sharpness=0.3, hardening=np.array([1e-4, 1e-2, 0.1]))
    segment = law.segments(given)[1]
    assert np.all(np.diff(segment.edges, axis=1) >= 0.0)
    w_c, _, B, sharpness = segment.parameters[:4]
    for i in range(3):
        w = segment.edges[i, :-1] ** 2
        row = [float(one[i]) for one in segment.parameters]
        area = np.array([segment.normal(math.sqrt(one), *row)[3] for one in w])
        assert np.any(np.abs(np.sqrt(area) * sharpness[i] - 1.0) < 1e-12)
        share = (np.sqrt(area) - np.sqrt(w))[1:] / (np.sqrt(w) * (np.sqrt((w / w_c[i] / 1.9) ** B[i]) - 1.0))[1:]
        assert np.any(np.abs(share - math.exp(-1.0)) < 1e-10) or row[4] > 1.0


@pytest.mark.parametrize("other_body", BODIES)
def test_finite_everywhere(other_body):
    """Over the whole range of the groups, to 1e6 critical interferences: load and area positive, never below Hertz's area."""
    n = 2000
    rng = np.random.default_rng(5)
    given = contact(
        theta=10.0 ** rng.uniform(-3, 8, n),
        lam=10.0 ** rng.uniform(-6, 8, n),
        nu=rng.uniform(0.0, 0.499, n),
        hardness_to_yield=rng.uniform(1.0, 4.0, n),
        sharpness=10.0 ** rng.uniform(-4, 0, n),
        hardening=np.where(rng.random(n) < 0.1, 0.0, 1.0 - 10.0 ** rng.uniform(-9, 0, n)),
    )
    for segment in law.segments(given, other_body=other_body):
        assert not np.isnan(segment.edges).any() and np.all(np.isfinite(segment.edges[:, :-1]))
        for ratio in (1.0, 1.5, 30.0, 1e3, 1e6):
            w = ratio * np.maximum(segment.edges[:, 0] ** 2, 1e-300)
            found = states(segment, w)
            assert np.all(np.isfinite(found)) and np.all(found[:, 2:] >= 0.0) and np.all(found[:, 3] >= w * (1.0 - 1e-14))


def test_the_jump_at_yield_is_that_of_the_record():
    (jump,) = RECORD.jumps
    for hardening in (0.0, 0.1):
        given = contact(**(dict(jump.groups) | {"hardening": hardening}))
        elastic, yielding = law.segments(given)
        factors = normal_states(yielding, yielding.edges[:, 0])[0, 2:4] / normal_states(elastic, elastic.edges[:, -1])[0, 2:4]
        left = math.exp(-3.3 * hardening)
        assert factors == pytest.approx((1.0 + (jump.load - 1.0) * left, jump.area), rel=1e-5)


def test_record():
    assert RECORD.key == "ghaednia_2019" and RECORD.traits == {"no adhesion", "Hertz", "Hertz's shape"}
    assert [segment.state for segment in law.segments(contact())] == ["elastic", "elastic-plastic"]
