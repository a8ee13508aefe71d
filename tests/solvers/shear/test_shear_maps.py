"""Shear on maps: closed forms of spheres, discs and layers, another solver, and work that is never gained."""

import math

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from refusals import refusal
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.solvers.shear.compliance import HalfSpace, ShearCompliance
from stiction.solvers.shear.minimise import shear, size_of
from stiction.solvers.shear.operators import FreeShear, MirroredShear, PeriodicShear
from stiction.solvers.shear.path import Weakening, at_force, full_shift, slide_map, through_spring

RIGID = HalfSpace(math.inf, 0.3)


def against_rigid(nu, shear_modulus=1.0):
    return ShearCompliance((HalfSpace(2.0 * (1.0 + nu) * shear_modulus, nu), RIGID))


def grid(count, side):
    x = ((np.arange(count) + 0.5) / count - 0.5) * side
    return x[None, :], x[:, None]


def free(compliance, count, side):
    return FreeShear(compliance, (count, count), (side, side))


def rough(count, seed=3):
    wave = np.fft.fftfreq(count, 1.0 / count)
    k = np.hypot(wave[:, None], wave)
    amplitude = np.divide(1.0, k**1.8, out=np.zeros_like(k), where=(k >= 2.0) & (k <= count / 8))
    heights = np.fft.ifft2(amplitude * np.fft.fft2(np.random.default_rng(seed).standard_normal((count, count)))).real
    return 0.01 * heights / heights.std()


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("directions", [1, 2])
def test_a_disc_that_sticks_is_as_stiff_as_mindlins(nu, directions):
    """Mindlin (1949): 8 G a/(2 - nu), the radius that of the area counted; within .3 %."""
    x, y = grid(128, 2.6)
    touching = np.hypot(x, y) < 1.0
    shift = np.zeros((directions, 128, 128))
    shift[0] = 1.0
    found = shear(free(against_rigid(nu), 128, 2.6), 1e6 * touching, shift, 0.0 * shift, tolerance=1e-12, most=300)
    pixel = (2.6 / 128) ** 2
    radius = math.sqrt(np.count_nonzero(touching) * pixel / math.pi)
    assert found.converged
    assert found.traction[0].sum() * pixel == pytest.approx(8.0 * radius / (2.0 - nu), rel=0.003)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_displacements_of_discs_of_traction(nu):
    """Uniform: a (2 - nu)/(2 G) q at the centre. Hertz's distribution: Johnson (1985), Contact Mechanics, eq. 3.91, within."""
    x, y = grid(201, 2.4)
    r = np.hypot(x, y)
    operator = free(against_rigid(nu), 201, 2.4)
    uniform = np.stack([(r < 1.0).astype(float), np.zeros_like(r)])
    assert operator(uniform)[0, 100, 100] == pytest.approx((2.0 - nu) / 2.0, rel=0.003)
    hertz = np.stack([np.sqrt(np.maximum(1.0 - r * r, 0.0)), np.zeros_like(r)])
    along, across = operator(hertz)
    inside = r < 0.95
    expected = math.pi / 32.0 * (4.0 * (2.0 - nu) - (4.0 - 3.0 * nu) * x**2 - (4.0 - nu) * y**2)
    np.testing.assert_allclose(along[inside], expected[inside], rtol=0.003)
    np.testing.assert_allclose(across[inside], (math.pi / 16.0 * nu * x * y)[inside], atol=1e-3)


def test_waves_along_and_across():
    """(1 - nu)/(G k) along a wave and 1/(G k) across it; a wave at 45 degrees turned by the tensor of both."""
    nu, count = 0.3, 32
    operator = PeriodicShear(against_rigid(nu), (count, count), (2.0 * math.pi, 2.0 * math.pi))
    x, y = grid(count, 2.0 * math.pi)
    zero = np.zeros((count, count))
    for wave, factor in ((np.cos(3.0 * x + 0.0 * y), (1.0 - nu) / 3.0), (np.cos(3.0 * y + 0.0 * x), 1.0 / 3.0)):
        np.testing.assert_allclose(operator(np.stack([wave, zero])), np.stack([factor * wave, zero]), atol=1e-14)
    wave = np.cos(2.0 * x + 2.0 * y)
    k = math.sqrt(8.0)
    expected = np.stack([(1.0 - 0.5 * nu) / k * wave, -0.5 * nu / k * wave])
    np.testing.assert_allclose(operator(np.stack([wave, zero])), expected, atol=1e-14)
    np.testing.assert_allclose(operator.inverse(operator(np.stack([wave, zero]))), np.stack([wave, zero]), atol=1e-13)


def test_layers_have_their_limits():
    """Across the wave on a rigid base: tanh(k t)/(G k), antiplane shear. Thick: the film's half-space; thin: the other."""
    k = np.geomspace(0.01, 30.0, 40)
    film = Film(1.0, 2.6, 0.3, 1e9 * 2.6, 0.3)
    np.testing.assert_allclose(ShearCompliance((film, RIGID)).times_k(k)[1], np.tanh(k), rtol=1e-6)
    for thickness, modulus, nu in ((1e4, 2.6, 0.3), (1e-9, 7.0, 0.2)):
        coated = ShearCompliance((Film(thickness, 2.6, 0.3, 7.0, 0.2), RIGID)).times_k(k)
        bare = ShearCompliance((HalfSpace(modulus, nu), RIGID)).times_k(k)
        np.testing.assert_allclose(coated, bare, rtol=1e-6)
    same = ShearCompliance((Film(1.0, 2.6, 0.3, 2.6, 0.3), RIGID)).times_k(k)
    np.testing.assert_allclose(same, against_rigid(0.3).times_k(k), rtol=1e-12)


@pytest.mark.parametrize("boundary", [PeriodicShear, MirroredShear])
@pytest.mark.parametrize("directions", [1, 2])
def test_a_film_on_a_rigid_base_gives_way_to_uniform_shear(boundary, directions):
    """Stuck everywhere at a shift U it bears q = G U/t."""
    film = Film(0.04, 2.6, 0.3, math.inf, 0.3)
    operator = boundary(ShearCompliance((film, RIGID)), (16, 20), (1.0, 1.0))
    uniform = np.zeros((directions, 16, 20))
    uniform[0] = 1.0
    np.testing.assert_allclose(operator(uniform), 0.04 * uniform, atol=1e-15)
    found = shear(operator, np.full((16, 20), 10.0 / 0.04), uniform, 0.0 * uniform, tolerance=1e-10, most=200)
    assert found.converged
    np.testing.assert_allclose(found.traction, uniform / 0.04, atol=1e-6)


@pytest.fixture(scope="module")
def sphere():
    """Hertz's pressure of a unit disc under unit friction between like bodies of G = 1; the operator and the pixel."""
    x, y = grid(200, 2.4)
    body = HalfSpace(2.6, 0.3)
    pressure = np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0))
    return free(ShearCompliance((body, body)), 200, 2.4), pressure, (2.4 / 200) ** 2


def cattaneo(shift, pixel, pressure):
    """Cattaneo (1938), Mindlin (1949): force over the largest one at a shift, and that shift: 3 (2 - nu) f P/(8 G a)."""
    largest = 3.0 * 1.7 / 8.0 * float(pressure.sum()) * pixel
    return 1.0 - (1.0 - np.minimum(shift / largest, 1.0)) ** 1.5, largest


def test_a_sphere_slips_as_cattaneo_and_mindlin_say(sphere):
    """Forces to .1 %, stick radius (1 - Q/fP)^(1/3) to 1 % (a pixel is 1.2 % of the radius)."""
    operator, pressure, pixel = sphere
    _, largest = cattaneo(0.0, pixel, pressure)
    shifts = np.linspace(0.1, 0.9, 5) * largest
    path = slide_map(operator, pressure, shifts, pixel=pixel)
    share, _ = cattaneo(shifts, pixel, pressure)
    np.testing.assert_allclose(path.array("force"), share * pressure.sum() * pixel, rtol=1e-3)
    np.testing.assert_allclose(np.sqrt(path.array("stick")), (1.0 - share) ** (1.0 / 3.0), rtol=0.01)
    assert all(state.converged for state in path.states)


def test_a_sphere_slips_as_contact_prints():
    """CONTACT (open source, Apache-2.0), example cattaneo: like bodies, nu .42, G 200 MPa, f .4, 19 x 19 points, one step.

    Lengths in mm, forces in N. Printed: shift 8.155e-3, force 3.218 (seven eighths of f P), 45 points stick, 132 slip.
    """
    count, pitch = 19, 0.13333
    x, y = grid(count, count * pitch)
    modulus = 2.0 * 200.0 * 1.42
    side = (count * pitch, count * pitch)
    (one,) = solve_map(
        -0.01 * (x**2 + y**2), side, modulus=modulus / (2.0 * (1.0 - 0.42**2)), loads=[9.1954], periodic=False, free=True
    )
    body = HalfSpace(modulus, 0.42)
    operator = free(ShearCompliance((body, body)), count, count * pitch)
    path = slide_map(operator, 0.4 * one.pressure, [8.155e-3], pixel=pitch**2, directions=2)
    assert path.array("force")[0] == pytest.approx(3.218, rel=0.001)
    assert np.count_nonzero(one.pressure > 0.0) == 45 + 132
    assert path.states[0].stick * 177 == pytest.approx(45, abs=0.5)
    assert path.array("loss")[0] * 1e-3 == pytest.approx(2.750e-6, rel=0.005)  # J, of N mm
    given = at_force(operator, 0.4 * one.pressure, 3.218, pixel=pitch**2, directions=2)
    assert given.shift == pytest.approx(8.155e-3, rel=0.001)
    with refusal("force", 4.0):
        at_force(operator, 0.4 * one.pressure, 4.0, pixel=pitch**2)


def test_a_cycle_loses_what_mindlin_and_deresiewicz_say(sphere):
    """Mindlin & Deresiewicz (1953), J. Appl. Mech. 20, 327: on the way back F = F(d1) - 2 F((d1 - d)/2); the loop is lost."""
    operator, pressure, pixel = sphere
    _, largest = cattaneo(0.0, pixel, pressure)
    reach, whole = 0.7 * largest, float(pressure.sum()) * pixel
    turn = np.linspace(1.0, -1.0, 9)[1:] * reach
    path = slide_map(operator, pressure, [reach, *turn, *-turn], pixel=pixel)
    forces, loss = path.array("force") / whole, path.array("loss") / whole
    first = cattaneo(reach, pixel, pressure)[0]
    np.testing.assert_allclose(forces[1:9], first - 2.0 * cattaneo((reach - turn) / 2.0, pixel, pressure)[0], atol=1e-3)
    np.testing.assert_allclose(forces[9:], -forces[1:9], atol=1e-3)
    fine = np.linspace(-reach, reach, 4001)
    loop = -2.0 * np.trapezoid(first - 2.0 * cattaneo((reach - fine) / 2.0, pixel, pressure)[0], fine)
    assert loss[-1] - loss[0] == pytest.approx(loop, rel=0.05)  # a step loses its last traction times its slip
    assert (np.diff(path.array("loss")) >= 0.0).all()


def test_a_rough_map_slips_as_ciavarella_and_jaeger_say():
    """Uncoupled, nu = 0: the traction is f times the pressure less that at a smaller load (Ciavarella 1998, Jaeger 1998)."""
    count = 64
    one, less = solve_map(rough(count), (1.0, 1.0), modulus=1.0, loads=[0.02, 0.012], periodic=True, tolerance=1e-10)
    body = HalfSpace(2.0, 0.0)
    operator = PeriodicShear(ShearCompliance((body, body)), (count, count), (1.0, 1.0))
    expected = 0.4 * (one.pressure - less.pressure)
    stuck = less.pressure > 0.0
    shift = float(np.mean(operator(expected[None])[0], where=stuck))
    path = slide_map(operator, 0.4 * one.pressure, [shift], pixel=1.0, tolerance=1e-9)
    np.testing.assert_allclose(path.states[0].traction[0], expected, atol=1e-4 * expected.max())


@pytest.mark.parametrize("nu", [0.0, 0.5])
@pytest.mark.parametrize("directions", [1, 2])
def test_fixed_strengths_add_up(nu, directions):
    """The largest force is the sum of strengths, whatever the bodies; no step gains work."""
    count = 48
    (one,) = solve_map(rough(count), (1.0, 1.0), modulus=1.0, loads=[0.01], periodic=True)
    strength = np.where(one.pressure > 0.0, 0.002 + 0.3 * one.pressure, 0.0)
    operator = PeriodicShear(against_rigid(nu), (count, count), (1.0, 1.0))
    shifts = np.linspace(0.2, 40.0 if directions == 2 else 1.2, 6) * full_shift(operator, strength)
    path = slide_map(operator, strength, shifts, pixel=1.0 / count**2, directions=directions)
    assert path.efficiency == pytest.approx(1.0, abs=1e-6 if directions == 1 else 1e-4)
    assert (np.diff(path.array("loss")) >= 0.0).all() and (np.diff(path.array("stick")) <= 0.0).all()
    assert (size_of(path.peak.traction) <= strength * (1.0 + 1e-12)).all()


def test_another_solver_finds_the_same_traction():
    """The minimum as bounded least squares with a dense matrix, by SciPy."""
    count = 12
    rng = np.random.default_rng(1)
    touching = rng.random((count, count)) < 0.4
    strength = np.where(touching, rng.uniform(0.5, 1.5, (count, count)), 0.0)
    operator = free(against_rigid(0.3), count, 1.0)
    unit = np.eye(count * count).reshape(-1, 1, count, count)
    at = np.flatnonzero(touching)
    matrix = np.stack([operator(one)[0].ravel()[at] for one in unit[at]])
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-15)
    lower = np.linalg.cholesky(matrix)
    shift = 0.5 * full_shift(operator, strength)
    limits = strength.ravel()[at]
    found = lsq_linear(lower.T, np.linalg.solve(lower, np.full(at.size, shift)), (-limits, limits), tol=1e-13).x
    path = slide_map(operator, strength, [shift], pixel=1.0, tolerance=1e-10)
    np.testing.assert_allclose(path.states[0].traction[0].ravel()[at], found, atol=1e-5)
    assert 0.1 < path.states[0].stick < 0.9


def test_in_two_directions_points_slip_along_their_traction():
    """The conditions of Coulomb's law, point by point: slip only at the strength, and along the traction."""
    count = 40
    (one,) = solve_map(rough(count), (1.0, 1.0), modulus=1.0, loads=[0.01], periodic=True)
    operator = PeriodicShear(against_rigid(0.5), (count, count), (1.0, 1.0))
    strength = 0.3 * one.pressure
    shift = 0.5 * full_shift(operator, strength)
    path = slide_map(operator, strength, [shift], pixel=1.0, directions=2, tolerance=1e-8)
    state = path.states[0]
    traction, slip = state.traction, state.slip
    assert state.converged and 0.05 < state.stick < 0.95
    rigid = np.stack([np.full((count, count), shift), np.zeros((count, count))])
    touching = strength > 0.0
    np.testing.assert_allclose(slip[:, touching], (rigid - operator(traction))[:, touching], atol=1e-12 * shift)
    turned = slip[0] * traction[1] - slip[1] * traction[0]
    assert np.abs(turned).max() <= 1e-4 * shift * strength.max()
    assert np.abs(traction[1]).max() > 0.01 * strength.max()  # Poisson's ratio draws it aside
    sticking = touching & (size_of(traction) < 0.999 * strength)
    assert size_of(slip)[sticking].max() <= 1e-4 * shift


@pytest.mark.parametrize("components", [1, 2])
def test_a_mirrored_window_is_a_quarter_of_its_period(components):
    """Traction along x is even about every side, across it odd about both; so are displacements."""
    count = 16
    quarter = np.random.default_rng(2).random((components, count, count))
    parts = []
    for component, sign in zip(quarter, (1.0, -1.0), strict=False):
        rows = np.concatenate([component, sign * component[::-1]])
        parts.append(np.concatenate([rows, sign * rows[:, ::-1]], axis=1))
    compliance = against_rigid(0.3)
    mirrored = MirroredShear(compliance, (count, count), (1.0, 1.5))
    period = PeriodicShear(compliance, (2 * count, 2 * count), (2.0, 3.0))
    np.testing.assert_allclose(mirrored(quarter), period(np.stack(parts))[:, :count, :count], atol=1e-15)
    if components == 1:
        centred = quarter - quarter.mean()
        np.testing.assert_allclose(mirrored.inverse(mirrored(centred)), centred, atol=1e-12)


def disc(count, over_length, steps=30, shape="linear", residual=0.0, side=2.2):
    """The efficiency of a uniform disc of radius 1, nu = 0, over the length l_c = D_c/(B tau), with B = 1/G = 1."""
    x, y = grid(count, side)
    strength = (np.hypot(x, y) < 1.0).astype(float)
    operator, weakening = free(against_rigid(0.0), count, side), Weakening(1.0 / over_length, residual, shape)
    shifts = np.linspace(0.0, full_shift(operator, strength, weakening), steps + 1)[1:]
    path = slide_map(operator, strength, shifts, pixel=1.0, weakening=weakening, tolerance=1e-5)
    assert all(state.converged for state in path.states)
    return path.efficiency


def test_a_small_disc_has_its_strength_and_a_large_one_griffiths():
    """Griffith: T^2 = 8 pi a^3 tau D_c/B, so efficiency sqrt(8/pi) (a/l_c)^-1/2, Savkoor & Briggs' force without load;
    reached from below, as the zone that weakens shrinks against the disc."""
    assert disc(32, 0.01) == pytest.approx(1.0, abs=0.005)
    over = [disc(count, size) / math.sqrt(8.0 / math.pi / size) for count, size in ((48, 4.0), (80, 8.0), (144, 16.0))]
    assert over[0] < over[1] < over[2] < 1.0
    assert over[2] > 0.92


def test_a_strip_slips_on_its_own_from_the_length_of_uenishi_and_rice_on():
    """Uenishi & Rice (2003), J. Geophys. Res. 108, 2042: 2 h = 1.158 mu*/W, whatever the loading; mu* = 2/S, W = tau_p/D_c.

    So h = 1.158 l_c: of a stuck plane, weakest in the middle, a zone that slips grows steadily up to there and then leaps. The
    plane is the face of a film that is 20 l_c thick; l_c has 24 points.
    """
    count = 512
    length = 24 / count
    film = ShearCompliance((Film(1.0, 2.0, 0.0, math.inf, 0.3), RIGID))
    operator = PeriodicShear(film, (1, count), (1.0 / count, 1.0))
    x = (np.arange(count) + 0.5) / count - 0.5
    strength = 1.0 + 0.05 * (x[None] / (1.158 * length)) ** 2
    low, high = 1.0, 1.06
    for _ in range(3):
        shifts = np.linspace(low, high, 31)
        path = slide_map(operator, strength, shifts, pixel=1.0, weakening=Weakening(length), tolerance=1e-9)
        leap = int(np.argmin(path.array("stick")))
        assert path.states[leap].stick == 0.0 and path.states[leap - 1].stick > 0.8
        low, high = shifts[leap - 1], shifts[leap]
    assert 0.5 * (1.0 - path.states[leap - 1].stick) / length == pytest.approx(1.158, abs=1.0 / 24)


def dense_curve(matrix, strength, weakening, shifts):
    """Forces by another algorithm: each point in turn is given the traction of its own law, until none changes."""
    traction, before = np.zeros(len(strength)), np.zeros(len(strength))
    own, slope = np.diag(matrix), strength * (1.0 - weakening.residual) / weakening.slip
    forces = []
    for shift in shifts:
        change = 1.0
        while change > 1e-8:
            change = 0.0
            for i in range(len(strength)):
                free = shift - matrix[i] @ traction + own[i] * traction[i]  # slip of the point without its own traction
                new = (free - before[i]) / own[i]
                if new > strength[i] * weakening.share(before[i]):
                    slip = (free - own[i] * strength[i]) / (1.0 - own[i] * slope[i])
                    new = strength[i] * weakening.share(max(slip, before[i]))
                change, traction[i] = max(change, abs(new - traction[i])), new
        before = np.maximum(before, shift - matrix @ traction)
        forces.append(traction.sum())
    return np.array(forces)


def test_another_algorithm_finds_the_same_peak():
    """Point by point with a dense matrix, without frozen strengths; in the curve within 1e-3, in the peak within 1e-3."""
    count = 16
    (one,) = solve_map(rough(count), (1.0, 1.0), modulus=1.0, loads=[0.012], periodic=True)
    strength = np.where(one.pressure > 0.0, 0.3 + one.pressure / one.pressure.max(), 0.0)
    operator = free(against_rigid(0.3), count, 1.0)
    at = np.flatnonzero(strength)
    matrix = np.stack([operator(unit)[0].ravel()[at] for unit in np.eye(count**2).reshape(-1, 1, count, count)[at]])
    weakening = Weakening(3.0 / count * operator.near, 0.3)
    shifts = np.linspace(0.0, full_shift(operator, strength), 41)[1:]
    path = slide_map(operator, strength, shifts, pixel=1.0, weakening=weakening, tolerance=1e-7)
    expected = dense_curve(matrix, strength.ravel()[at], weakening, shifts)
    assert path.efficiency < 0.95
    assert path.peak.force == pytest.approx(expected.max(), rel=1e-3)
    np.testing.assert_allclose(path.array("force"), expected, atol=1e-3 * expected.max())


@pytest.mark.parametrize(
    ("nu", "weakening", "directions", "early", "largest"),
    [
        (0.3, Weakening(0.3, 0.2, "exponential"), 1, 0.66942, 0.74263),
        (0.0, Weakening(0.15, 0.0, "exponential"), 1, 0.54418, 0.54418),
        (0.5, Weakening(0.3, 0.3), 2, 0.72986, 0.74792),
    ],
)
def test_an_uneven_disc_weakens_as_another_solver_finds(nu, weakening, directions, early, largest):
    """Forces over the sum of strengths by a solver of slips, point by point, with the inverse of its own dense matrix.

    In two directions by tractions point by point, with strengths that are frozen until all have converged.
    """
    x, y = grid(24, 2.2)
    strength = np.where(np.hypot(x, y) < 1.0, 1.0 + 0.5 * x, 0.0)
    shifts = np.linspace(0.0, 2.5, 51)[1:16]
    path = slide_map(free(against_rigid(nu), 24, 2.2), strength, shifts, pixel=1.0, weakening=weakening, directions=directions)
    force = path.array("force") / strength.sum()
    assert force[9] == pytest.approx(early, rel=1e-3)
    assert force.max() == pytest.approx(largest, rel=1e-3)
    assert (np.diff(path.array("loss")) >= 0.0).all()


def test_a_soft_spring_leaps_past_what_a_rigid_shift_meets():
    """Where the force falls by more than the stiffness of the spring, its drive would have to go back."""
    x, y = grid(48, 2.2)
    strength = (np.hypot(x, y) < 1.0).astype(float)
    operator, weakening = free(against_rigid(0.0), 48, 2.2), Weakening(1.0)
    shifts = np.linspace(0.0, full_shift(operator, strength, weakening), 41)[1:]
    path = slide_map(operator, strength, shifts, pixel=1.0, weakening=weakening)
    force = path.array("force")
    falls = -float(np.gradient(force, shifts).min())
    drive, met = through_spring(path, 10.0 * falls)
    assert met.all() and (drive > shifts).any()
    _, met = through_spring(path, 0.2 * falls)
    assert met[: int(np.argmax(force)) + 1].all() and 0 < np.count_nonzero(~met) < len(met)
    with refusal("stiffness", 0.0, "> 0"):
        through_spring(path, 0.0)


def test_points_that_have_lost_all_strength_do_not_regain_it():
    """Slip goes on where nothing resists, so that a map that has ruptured stays without force when it is moved on."""
    x, y = grid(32, 2.2)
    strength = (np.hypot(x, y) < 1.0).astype(float)
    operator, weakening = free(against_rigid(0.0), 32, 2.2), Weakening(0.2)
    far = full_shift(operator, strength, weakening)
    path = slide_map(operator, strength, [0.9 * far, far, 0.5 * far], pixel=1.0, weakening=weakening)
    touching = strength > 0.0
    np.testing.assert_allclose(path.states[1].slip[0][touching], far, rtol=1e-6)
    assert (path.array("force") == 0.0).all()


def test_steps_and_pixels_do_not_matter():
    whole = disc(64, 3.0)
    assert disc(64, 3.0, steps=90) == pytest.approx(whole, rel=0.004)
    assert disc(128, 3.0) == pytest.approx(whole, rel=0.012)


def test_a_residual_strength_stays():
    """Efficiency lies between that without a residual strength and 1; a spot far larger than l_c falls to no less than it."""
    brittle, half = disc(64, 4.0), disc(64, 4.0, residual=0.5)
    assert brittle < half < 1.0
    assert disc(64, 4.0, residual=1.0) == pytest.approx(1.0, abs=1e-6)
    assert disc(48, 4.0, shape="exponential") < 1.0


def test_unusable_input_is_refused():
    with refusal("weakening.slip", 0.0, "> 0"):
        Weakening(0.0)
    with refusal("weakening.shape", "cubic", "linear"):
        Weakening(1.0, 0.0, "cubic")
    with refusal("bodies", "both rigid", "elastic"):
        ShearCompliance((RIGID, RIGID))
    with refusal("film", "not periodic"):
        free(ShearCompliance((Film(1.0, 2.6, 0.3, 7.0, 0.2), RIGID)), 8, 1.0)
    with refusal("strength", "negative", ">= 0"):
        slide_map(free(against_rigid(0.3), 8, 1.0), np.zeros((8, 8)), [1.0], pixel=1.0)
