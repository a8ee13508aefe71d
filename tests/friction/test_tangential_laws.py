"""Tangential resistance of one asperity: printed tables and reference/asperity.csv.

Sections C, D name the compendium of published models this project works from; "theory" is docs/theory.md.
"""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

import stiction as st
from stiction.contact.indices import hardness_group, stiffness_group
from stiction.laws.asperity import jkr, roy_chowdhury_ghosh_1994
from stiction.laws.film import printed as to_the_letter
from stiction.laws.joining import Law, states
from stiction.laws.tangential import chang_etsion_bogy_1988 as ceb
from stiction.laws.tangential import hurtado_kim_1999, soft_coating_2015
from stiction.laws.tangential.savkoor_briggs_1977 import slip_resistance, slip_resistance_printed
from stiction.laws.tangential.shared.edge_yield import yield_resistance
from tables import column, groups_of, read

ROWS = read("asperity.csv")
LAWS = {
    "corrected": Law(roy_chowdhury_ghosh_1994.RECORD, soft_coating_2015.RECORD, {"branch": "loading"}),
    "published": to_the_letter.LAW,
}


@pytest.mark.parametrize(
    ("nu", "K_beta"), [(0.2, 6.0), (0.25, 6.2222), (0.3, 6.4762), (0.35, 6.7692), (0.4, 7.1111), (0.5, 8.0)]
)
def test_stiffness_group(nu, K_beta):
    """Theory 1 and section C1."""
    assert stiffness_group(nu) == pytest.approx(K_beta, abs=5e-5)


@pytest.mark.parametrize(("ratio", "T"), [(-0.5, 1.28338), (0.0, 1.81497), (2.0, 3.14362), (10.0, 6.01958)])
@pytest.mark.parametrize("theta", (0.02, 1.0, 700.0))
def test_savkoor_briggs(ratio, T, theta):
    """Table C1, nu = 0.3: T over pull-off against P over pull-off, (3/2) pi gamma R."""
    pull_off = 1.5 * math.pi / theta
    assert slip_resistance(ratio * pull_off, theta, stiffness_group(0.3)) / pull_off == pytest.approx(T, abs=5.1e-6)


def test_savkoor_briggs_is_an_energy_balance():
    """G_N + G_T = gamma (C1), with G_N = (K a^3/R - P)^2/(6 pi K a^3), G_T = beta T^2/(32 pi a^3), at the peeled radius
    K a^3/R = P + 3 pi gamma R; in the units here gamma is 1/theta and a^3 is x^(3/2)."""
    for theta, P, K_beta in ((1.0, 2.0, 6.0), (30.0, -0.1, 7.1), (1e4, 5.0, 8.0)):
        T = slip_resistance(P, theta, K_beta)
        cube = P + 3.0 * math.pi / theta
        balance = (cube - P) ** 2 / (6.0 * math.pi * cube) + K_beta * T**2 / (32.0 * math.pi * cube)
        assert balance == pytest.approx(1.0 / theta, rel=1e-13)
        # Eq. (10) as printed is the same force, in terms of the peeled radius.
        assert slip_resistance_printed(cube ** (2.0 / 3.0), theta, K_beta) == pytest.approx(T, rel=1e-12)


def test_constant_of_equation_10():
    """29.61 = 3 pi^2 (section 0.1): the printed square root vanishes where 2 pi x^(3/2) = 29.61/theta."""
    zero = (29.6088 / (2.0 * math.pi)) ** (2.0 / 3.0)
    below, above = (slip_resistance_printed(zero * (1.0 + part), 1.0, 6.0) for part in (-1e-5, 1e-5))
    assert below == 0.0 < above


def test_coefficients_of_equation_11():
    """C1..C7 (theory 2; section D4), nu = 0.3, H/Y = 2.8: the yield force T of a JKR contact obeys
    C1 x^3 + C2 x^(9/4) + C3 x^2 + C4 x^(3/2) + (C5 x^(3/2) + C6 x^(3/4)) T + C7 T^2 = 0; solved for C2..C7 with C1 = .24."""
    theta, lam = 1.0, 100.0
    eta, S = float(hardness_group(theta, lam)), jkr.adhesion(theta)
    x = np.linspace(5.0, 160.0, 400)
    P = x**1.5 - S * x**0.75
    T = np.array([yield_resistance(P[i], eta * x[i] / (math.pi * 2.8), 0.3) for i in range(x.size)])
    assert T.min() > 0.0
    terms = np.stack([x**2.25, x**2, x**1.5, x**1.5 * T, x**0.75 * T, T * T], axis=1)
    scale = np.abs(terms).max(axis=0)
    found = np.linalg.lstsq(terms / scale, -0.24 * x**3, rcond=None)[0] / scale
    printed = [-2.08397, -3.40017 * math.sqrt(lam), 4.52389, 2.40332, -10.43427, 10.70775]
    assert_allclose(found, printed, rtol=3e-6)


def test_coefficients_scale_with_the_indices():
    """C2, C6 as theta^(-1/2), C3 as lambda^(1/2)/theta, C4 as 1/theta: the same polynomial vanishes elsewhere too."""
    for theta, lam in ((10.0, 10.0), (0.1, 3.0), (1e4, 1e3)):
        eta, S = float(hardness_group(theta, lam)), jkr.adhesion(theta)
        x = 9.0 * theta ** (-2.0 / 3.0)
        P = x**1.5 - S * x**0.75
        T = yield_resistance(P, eta * x / (math.pi * 2.8), 0.3)
        root = theta**-0.5
        parts = [
            0.24 * x**3, -2.08397 * root * x**2.25, -3.40017 * math.sqrt(lam) / theta * x**2, 4.52389 / theta * x**1.5,
            2.40332 * x**1.5 * T, -10.43427 * root * x**0.75 * T, 10.70775 * T * T,
        ]  # fmt: skip
        assert T > 0.0 and abs(sum(parts)) < 5e-6 * max(map(abs, parts))


def test_yield_without_adhesion_or_load():
    """Pure shear: at the edge sigma_x = (pi/8)(4 + nu) q0 and sigma_y = (3 pi/8) nu q0 (section C2) with q0 = 3T/(2 pi a^2),
    von Mises. The strength is Y a^2, here 1."""
    for nu in (0.0, 0.3, 0.499):
        x, y = math.pi / 8.0 * (4.0 + nu), 3.0 * math.pi / 8.0 * nu
        q0 = 1.0 / math.sqrt(x * x + y * y - x * y)  # over Y
        assert yield_resistance(0.0, 1.0, nu) == pytest.approx(q0 * 2.0 * math.pi / 3.0, rel=1e-13)


def test_a_tension_that_yields_by_itself_leaves_nothing():
    """No real root: the asperity has yielded under its normal load alone (theory 2)."""
    assert yield_resistance(-1e3, 1.0, 0.2) == 0.0
    assert yield_resistance(1e3, 1.0, 0.2) == 0.0


@pytest.mark.parametrize("formulation", ("corrected", "published"))
def test_slip_and_yield(formulation):
    """reference/asperity.csv: both resistances, and which of them the asperity is said to have."""
    rows = [row for row in ROWS if row["formulation"] == formulation]
    groups = groups_of([row | {"n_E": ""} for row in rows])
    x, P, slip_limited, yield_limited = (column(rows, name) for name in ("x", "load", "slip", "yield"))
    eta = hardness_group(groups.theta, groups.lam)
    found_states = states(LAWS[formulation].regimes(groups)[0], x**0.25)
    for i in range(len(rows)):
        theta, K_beta, nu, k = (float(one[i]) for one in (groups.theta, groups.K_beta, groups.nu, groups.hardness_to_yield))
        if formulation == "corrected":
            found = slip_resistance(P[i], theta, K_beta)
        else:
            found = slip_resistance_printed(x[i], theta, K_beta)
        # Near its own zero the slip force is the square root of a rounded difference.
        assert found == pytest.approx(slip_limited[i], rel=1e-12, abs=1e-7 / theta)
        assert yield_resistance(P[i], eta[i] * x[i] / (math.pi * k), nu) == pytest.approx(yield_limited[i], rel=1e-9)
        smaller = [slip_limited[i], 0.0] if slip_limited[i] <= yield_limited[i] else [0.0, yield_limited[i]]
        assert tuple(found_states[i, 4:]) == (pytest.approx(smaller[0], rel=1e-9), pytest.approx(smaller[1], rel=1e-9))


def test_crossings_of_slip_and_yield():
    """The same table: the number of places between x0 and x1 where the two are equal; all lie on edges."""
    for row in {tuple(row[name] for name in list(row)[:11]): row for row in ROWS}.values():
        groups = groups_of([row | {"n_E": ""}])
        printed = row["formulation"] == "published"
        edges = LAWS[row["formulation"]].regimes(groups)[0].edges
        theta, eta, K_beta, nu, k = (
            float(one[0]) for one in (groups.theta, groups.eta, groups.K_beta, groups.nu, groups.hardness_to_yield)
        )

        def excess(u):
            x, P = u**4, jkr.load(u, jkr.adhesion(theta))  # noqa: B023
            slip_limited = slip_resistance_printed(x, theta, K_beta) if printed else slip_resistance(P, theta, K_beta)  # noqa: B023
            yield_limited = yield_resistance(P, eta * x / (math.pi * k), nu)  # noqa: B023
            return (slip_limited - yield_limited) / max(slip_limited, yield_limited)

        inner = np.unique(edges[0])
        inner = inner[(inner > edges[0, 0]) & (inner < edges[0, -1])]
        crossings = [u for u in inner if abs(excess(float(u))) < 1e-9]
        assert len(crossings) == int(row["crossings"]), row
        # Between neighbouring edges the sign does not change: nothing was missed.
        for low, high in zip(np.unique(edges[0])[:-1], np.unique(edges[0])[1:], strict=True):
            signs = {math.copysign(1.0, excess(float(low + part * (high - low)))) for part in np.linspace(0.001, 0.999, 201)}
            assert len(signs) == 1, row


@pytest.mark.parametrize(("theta", "lam", "printed"), [  # section D4, "Consequence", nu = 0.3, H/Y = 2.8
    (1, 86.3, True), (3, 180, True), (10, 401, True), (30, 834, True), (100, 1860, True),
    (1, 1.17, False), (3, 2.43, False), (10, 5.43, False), (30, 11.3, False), (100, 25.2, False),
])  # fmt: skip
def test_smallest_lambda_with_a_slip_window(theta, lam, printed):
    """Where, at first contact, the asperity slips just before it yields."""
    K_beta, S = stiffness_group(0.3), jkr.adhesion(float(theta))
    u = jkr.coordinate(0.0, S)
    x, P = u**4, jkr.load(u, S)
    slip_limited = slip_resistance_printed(x, float(theta), K_beta) if printed else slip_resistance(P, float(theta), K_beta)

    def excess(log_lam):
        eta = float(hardness_group(float(theta), math.exp(log_lam)))
        return yield_resistance(P, eta * x / (math.pi * 2.8), 0.3) - slip_limited

    assert math.exp(brentq(excess, math.log(1e-3), math.log(1e6))) == pytest.approx(lam, rel=5e-3)


CEB_TABLE = [  # omega/omega_c, mu, Q/P_c: table C2, nu = 0.3
    (0.01, 3.8499, 0.00385), (0.05, 1.6575, 0.01853), (0.1, 1.1372, 0.03596), (0.2, 0.7685, 0.06873), (0.3, 0.6046, 0.09934),
    (0.4, 0.5066, 0.12815), (0.5, 0.4395, 0.15537), (0.6, 0.3898, 0.18115), (0.7, 0.3510, 0.20558), (0.8, 0.3197, 0.22874),
    (0.9, 0.2936, 0.25071), (0.95, 0.2822, 0.26126), (0.99, 0.1250, 0.12317),
]  # fmt: skip


@pytest.mark.parametrize(("w_ratio", "mu", "Q"), CEB_TABLE)
def test_chang_etsion_bogy_1988(w_ratio, mu, Q):
    found = ceb.friction_coefficient(w_ratio, 0.3, 0.577)
    assert found == pytest.approx(mu, abs=5.1e-5)
    assert found * w_ratio**1.5 == pytest.approx(Q, abs=6e-6)


def test_chang_etsion_bogy_constants():
    """Section C2, nu = 0.3: c1 = -.284869. From omega_c on there is no friction."""
    assert ceb.axis_coefficient(0.3) == pytest.approx(-0.284869, abs=5e-7)
    assert ceb.friction_coefficient(1.0, 0.3, 0.577) == ceb.friction_coefficient(50.0, 0.3, 0.577) == 0.0


@pytest.mark.parametrize("nu", (0.0, 0.1, 0.3, 0.499))
def test_chang_etsion_bogy_branches_meet_once(nu):
    """Where the axis takes over from the edge, and that it does so once."""
    K_H = 0.454 + 0.41 * nu
    at = float(ceb.first_on_axis(np.array([nu]), np.array([K_H]))[0])
    assert ceb.on_axis(at, nu, K_H) == pytest.approx(ceb.at_edge(at, nu, K_H), rel=1e-12)
    for w in np.linspace(0.01, 0.9999, 300):
        assert (ceb.on_axis(w, nu, K_H) > ceb.at_edge(w, nu, K_H)) == (w < at)


def test_strength_by_size_has_the_printed_plateaus_and_line():
    """tau/G is 1/43 up to 28 b, 1/1290 from 8e4 b on, and on a straight line in decades between."""
    strength = hurtado_kim_1999.strength_over_modulus
    assert strength(1.0) == strength(28.0) == pytest.approx(1 / 43, rel=1e-14)
    assert strength(8e4) == strength(1e9) == pytest.approx(1 / 1290, rel=1e-13)
    middle = np.sqrt(28.0 * 8e4)
    assert strength(middle) == pytest.approx(np.sqrt(1 / 43 / 1290), rel=1e-13)
    assert [round(1e3 * strength(size), 4) for size in (100.0, 1000.0, 10000.0)] == [13.497, 5.0445, 1.8854]


@pytest.mark.parametrize(("burgers", "share"), [("1 mm", 1 / 43), ("1e-18 m", 1 / 1290)])
def test_strength_by_size_is_constant_for_very_small_and_very_large_contacts(burgers, share):
    """A contact far below or above both sizes has Bowden and Tabor's friction with a share of the shear modulus."""
    body = st.Material(youngs_modulus="100 GPa", poissons_ratio=0.25, hardness="20 GPa")  # its own strength is no limit
    rough = st.Roughness(asperity_height_deviation="20 nm", asperity_radius="5 um", asperity_density="1e10 1/m^2")
    contact = st.Contact(first=body, second=body, roughness=rough, nominal_area="1 mm^2", burgers_vector=burgers)
    how = {"load": ["1 mN", "1 N"], "model": "greenwood_williamson_1966", "asperity": "hertz"}
    sized = st.solve(contact, **how, tangential="hurtado_kim_1999")
    stated = contact.replace(burgers_vector=None, interfacial_shear_strength=share * 40e9)  # G = E/(2 (1 + nu)) = 40 GPa
    constant = st.solve(stated, **how, tangential="bowden_tabor_1943")
    assert_allclose(sized.friction_coefficient, constant.friction_coefficient, rtol=1e-12)
