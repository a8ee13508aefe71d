"""Pressure and shear that feel each other: CONTACT's example of Spence, his self-similar solution, and reciprocity."""

import math

import numpy as np
import pytest

from refusals import refusal
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.solvers.layered.waves import CoatedBody, film_function, waves
from stiction.solvers.shear.compliance import HalfSpace, ShearCompliance
from stiction.solvers.shear.coupled import Coupling, at_rest, press_and_shear
from stiction.solvers.shear.operators import FreeShear

ELASTIC, RIGID = HalfSpace(1.0, 0.0), HalfSpace(math.inf, 0.0)  # of G = 0.5


def pressed_in_steps(bodies, steps, count=45, pitch=0.2, friction=0.2986):
    """A sphere pressed at loads (k/count)^3, so that the contact grows by a point a step: states after each."""
    side = (count * pitch, count * pitch)
    x = (np.arange(count) - (count - 1) / 2.0) * pitch
    heights = -0.004116 * (x[None, :] ** 2 + x[:, None] ** 2)
    compliance = ShearCompliance(bodies)
    operator = FreeShear(compliance, (count, count), side)
    coupling = Coupling(compliance, (count, count), side, periodic=False)

    def press(load, parted):
        more = {"modulus": 1.0, "loads": [load], "periodic": False, "free": True, "tolerance": 1e-8, "stiffness": False}
        return solve_map(heights - parted, side, **more)[0].pressure

    states = [at_rest((count, count))]
    for k in steps:
        load = (k / count) ** 3
        states.append(
            press_and_shear(operator, coupling, states[-1], lambda u, load=load: press(load, u), lambda p: friction * p)
        )
    return states[1:]


@pytest.fixture(scope="module")
def spence():
    return pressed_in_steps((ELASTIC, RIGID), range(1, 36))


def test_spence_as_contact_prints(spence):
    """CONTACT (open source, Apache-2.0), example spence35: 45 x 45 points of 0.2 mm, 35 steps; N and mm.

    Printed after the last: largest pressure 2.392e-2, 225 points stick, 921 touch (its grid is off the centre by 1e-4),
    friction work of the last step 1.842e-8 J.
    """
    before, last = spence[-2:]
    assert all(state.converged and state.turns <= 10 for state in spence)
    assert last.pressure.max() == pytest.approx(2.392e-2, rel=3e-4)
    touching = np.count_nonzero(last.pressure)
    assert touching == pytest.approx(921, abs=6) and last.stick * touching == pytest.approx(225, abs=0.5)
    assert (last.loss - before.loss) * 0.2**2 * 1e-3 == pytest.approx(1.842e-8, rel=1e-3)


def test_the_stick_radius_stays_the_same_share(spence):
    """Spence (1968), Proc. R. Soc. A 305, 55: self-similar, so that the stick radius is one share of a radius that grows; here
    within a point."""
    for state in spence[14:]:
        radius = math.sqrt(np.count_nonzero(state.pressure) / math.pi)
        assert math.sqrt(state.stick) == pytest.approx(0.503, abs=0.5 / radius)


def test_like_bodies_do_not_shear_when_they_are_pressed():
    (state,) = pressed_in_steps((ELASTIC, ELASTIC), [20])
    assert not state.traction.any() and state.stick == 1.0 and state.loss == 0.0


@pytest.mark.parametrize("periodic", [True, False])
def test_the_operator_is_that_of_cerruti_and_its_own_transpose(periodic):
    """A point force P presses points at a distance r by M P/(2 pi r) (Johnson 1985, eq. 3.22); q.Dp = p.D^T q."""
    count, rng = 64, np.random.default_rng(0)
    coupling = Coupling(ShearCompliance((ELASTIC, RIGID)), (count, count), (1.0, 1.0), periodic=periodic)
    pressure, traction = rng.random((count, count)), rng.random((2, count, count))
    one, other = np.sum(traction * coupling.dragged(pressure)), np.sum(pressure * coupling.parted(traction))
    assert one == pytest.approx(other, rel=1e-9)
    point = np.zeros((count, count))
    point[32, 32] = 1.0
    if not periodic:
        dragged = coupling.dragged(point)[:, 32, 48]
        np.testing.assert_allclose(dragged, [(1.0 / count) ** 2 / (2.0 * math.pi * 0.25), 0.0], rtol=1e-3, atol=1e-12)


def test_films_couple_as_their_material_and_as_what_is_below():
    """Thick: M of the film's half-space; thin: of the substrate; of one material: of that, at every wave."""
    k = np.geomspace(0.01, 30.0, 40)
    for thickness, modulus, nu in ((1e4, 2.6, 0.3), (1e-9, 7.0, 0.2)):
        coated = ShearCompliance((Film(thickness, 2.6, 0.3, 7.0, 0.2), RIGID)).coupling(k)
        np.testing.assert_allclose(coated, (1.0 - 2.0 * nu) * (1.0 + nu) / modulus, rtol=1e-6)
    same = ShearCompliance((RIGID, Film(1.0, 2.6, 0.3, 2.6, 0.3))).coupling(k)
    np.testing.assert_allclose(same, -0.2, rtol=1e-12)


@pytest.mark.parametrize("ratio", [0.1, 7.0])
def test_a_film_is_moved_aside_by_pressure_as_it_is_parted_by_shear(ratio):
    """Maxwell and Betti's reciprocity: u_x of a wave of pressure is u_z of a wave of shear, found from other derivatives."""
    k, nu = np.geomspace(0.05, 20.0, 30), 0.35
    found = waves(k, CoatedBody(ratio, nu, 0.1))
    derivatives = [film_function(found, depth)[:, 1] for depth in (0.0, 1e-4, 2e-4)]
    F1, F2 = derivatives[0][1], derivatives[0][2]
    F3 = (-3.0 * F2 + 4.0 * derivatives[1][2] - derivatives[2][2]) / (2e-4 * k)  # towards the depth, which is k t
    parted = 0.5 * (
        (1.0 - nu) * (3.0 - F3) - (2.0 - nu) * (1.0 - F1)
    )  # the first and third derivative of -z exp(-z) are -1 and -3
    np.testing.assert_allclose(found.surface_coupling(nu), parted, atol=1e-5)


def test_films_are_refused_on_a_map_that_ends():
    coated = ShearCompliance((Film(1.0, 2.6, 0.3, 7.0, 0.2), RIGID))
    with refusal("film", "not periodic"):
        Coupling(coated, (8, 8), (1.0, 1.0), periodic=False)
