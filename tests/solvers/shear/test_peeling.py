"""Adhesive maps that shear peels: Savkoor and Briggs's sphere, discs, and the laws of mode mixity."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from refusals import refusal
from stiction.solvers.shear.compliance import HalfSpace, ShearCompliance
from stiction.solvers.shear.mode_mixity import MODE_MIXITIES
from stiction.solvers.shear.operators import FreeShear
from stiction.solvers.shear.peeling import energy_released, peel_map

POINTS = 128
RADIUS, JKR = POINTS / 2.0, POINTS / 5.0  # of the sphere, and of its contact without load; E* = 1 and points of 1
WORK = 2.0 * JKR**3 / (9.0 * math.pi * RADIUS**2)
K, PULL_OFF = 4.0 / 3.0, 1.5 * math.pi * WORK * RADIUS


def bodies(nu):
    like = HalfSpace(2.0 * (1.0 - nu**2), nu)
    return ShearCompliance((like, like)), 2.0 * (2.0 - nu) / like.shear_modulus


def sphere():
    x, y = np.arange(POINTS) - POINTS / 2 + 0.37, np.arange(POINTS) - POINTS / 2 + 0.21
    return -(x[None] ** 2 + y[:, None] ** 2) / (2.0 * RADIUS)


def peeled(forces, nu=0.0, load=0.0, **law):
    return peel_map(
        sphere(), (float(POINTS), float(POINTS)), modulus=1.0, load=load, work=WORK, reach=math.sqrt(2.0 * WORK),
        compliance=bodies(nu)[0], forces=[force * PULL_OFF for force in forces], **law,
    )  # fmt: skip


def opens(law, zeta, x):
    """y at this x, from the functions of Hutchinson and Suo themselves."""
    functions = {
        "savkoor_briggs_1977": lambda sine: 1.0 / (1.0 + (zeta - 1.0) * sine),
        "waters_guduru_2010": lambda sine: 1.0 + math.tan((1.0 - zeta) * math.asin(math.sqrt(sine))) ** 2,
        "papangelo_ciavarella_2018": lambda sine: 1.0 + (1.0 - zeta) * sine / (1.0 - sine),
    }
    return brentq(lambda y: x + y - functions[law](x / (x + y)), 1e-9, 1.0, xtol=1e-12)


@pytest.mark.parametrize("law", ["savkoor_briggs_1977", "waters_guduru_2010", "papangelo_ciavarella_2018"])
@pytest.mark.parametrize("zeta", [0.2, 0.6, 1.0])
@pytest.mark.parametrize("x", [0.1, 0.5, 0.9])
def test_the_laws_meet_their_balance(law, zeta, x):
    assert MODE_MIXITIES[law].share(np.array([x]), zeta)[0] == pytest.approx(opens(law, zeta, x), abs=1e-5)


@pytest.mark.parametrize("law", sorted(MODE_MIXITIES))
def test_no_shear_and_no_coupling_leave_the_work_of_adhesion(law):
    share = MODE_MIXITIES[law].share
    assert share(np.zeros(1), 0.7)[0] == pytest.approx(1.0)
    assert share(np.array([0.5, 2.0, 30.0]), 0.0) == pytest.approx(1.0)
    assert (np.diff(share(np.linspace(0.0, 20.0, 200), 0.7)) <= 0.0).all()


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("radius", [7.0, 16.0, 30.0])
def test_a_disc_releases_what_savkoor_and_briggs_have(nu, radius):
    """beta T^2/(32 pi a^3) on the average around the edge, within 3 %."""
    count = int(2.6 * radius) // 2 * 2
    x = np.arange(count) - count / 2 + 0.63
    touching = np.hypot(x[None], x[:, None] - 0.2) < radius
    one = HalfSpace(2.0 * (1.0 + nu), nu)
    operator = FreeShear(ShearCompliance((one, HalfSpace(math.inf, 0.3))), (count, count), (float(count), float(count)))
    released = energy_released(operator, touching, 1.0)
    inner = touching
    for axis in (0, 1):
        inner = inner & np.roll(touching, 1, axis) & np.roll(touching, -1, axis)
    counted = math.sqrt(np.count_nonzero(touching) / math.pi)
    assert released[touching & ~inner].mean() == pytest.approx((2.0 - nu) / (32.0 * math.pi * counted**3), rel=0.03)


def test_the_energy_at_the_edge_turns_with_the_contact():
    """An ellipse off its middle, turned by half a turn: shear along one axis of like points cannot tell both apart."""
    count, nu = 40, 0.3
    x = np.arange(count) - count / 2 + 0.63
    touching = np.hypot(x[None] / 11.0, (x[:, None] + 2.4) / 7.0) < 1.0
    half_spaces = HalfSpace(2.0 * (1.0 + nu), nu), HalfSpace(math.inf, 0.3)
    operator = FreeShear(ShearCompliance(half_spaces), (count, count), (float(count), float(count)))
    edge = touching & (sum(np.roll(~touching, step, axis) for axis in (0, 1) for step in (1, -1)) > 0)
    released = energy_released(operator, touching, 1.0)[edge]
    turned = energy_released(operator, touching[::-1, ::-1], 1.0)[::-1, ::-1][edge]
    np.testing.assert_allclose(turned, released, rtol=1e-6)


@pytest.mark.parametrize(
    ("law", "zeta"),
    [
        ("savkoor_briggs_1977", 1.0),
        ("savkoor_briggs_1977", 0.3),
        ("waters_guduru_2010", 0.5),
        ("papangelo_ciavarella_2018", 0.5),
    ],
)
def test_the_area_of_a_sphere_falls_as_in_closed_form(law, zeta):
    """(K a^3/R)^2/(6 pi K a^3) = y w with G_T = beta T^2/(32 pi a^3): within 4 % up to T = 1.44 P_c, Tabor's parameter 2.3."""
    beta, forces = bodies(0.0)[1], [0.0, 0.5, 1.0, 1.44]

    def open_edge(radius, force):
        x = beta * (force * PULL_OFF) ** 2 / (32.0 * math.pi * radius**3) / WORK
        return K * radius**3 / (6.0 * math.pi * RADIUS**2) / WORK - MODE_MIXITIES[law].share(np.array([x]), zeta)[0]

    found = peeled(forces, mode_mixity=law, zeta=zeta)
    assert all(one.converged and not one.peeled for one in found)
    areas = np.array([one.area for one in found])
    closed = np.array([brentq(open_edge, 0.75 * JKR, 1.1 * JKR, (force,)) for force in forces]) ** 2
    np.testing.assert_allclose(areas / areas[0], closed / closed[0], rtol=0.04)
    assert (np.diff(areas) < 0.0).all() and areas[-1] < 0.97 * areas[0]


def test_a_sphere_peels_at_the_force_of_savkoor_and_briggs():
    """T = 4 (K beta)^(-1/2) sqrt(3) pi w R at no load: the map, with an attraction of finite range, at .88 to 1 of it."""
    largest = 4.0 * math.sqrt(3.0) * math.pi * WORK * RADIUS / math.sqrt(K * bodies(0.0)[1]) / PULL_OFF
    found = peeled([0.88 * largest, largest], mode_mixity="savkoor_briggs_1977")
    assert not found[0].peeled and found[-1].peeled and len(found) == 2


def test_the_area_stays_without_a_law_and_after_menga_carbone_and_dini():
    alone, uniform = peeled([0.0, 3.0]), peeled([0.0, 3.0], mode_mixity="menga_carbone_dini_2018")
    assert alone[0].area == alone[1].area
    assert uniform[1].area == pytest.approx(alone[0].area, rel=1e-3) and uniform[1].released > 0.5 * WORK


def test_refusals():
    with refusal("mode_mixity", "savkor", "savkoor_briggs_1977"):
        peeled([1.0], mode_mixity="savkor")
    with refusal("zeta", "2", "0 to 1"):
        peeled([1.0], mode_mixity="savkoor_briggs_1977", zeta=2.0)
    with refusal("forces", "rising"):
        peeled([1.0, 0.5])
