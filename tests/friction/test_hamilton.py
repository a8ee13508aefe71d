"""Hamilton's stresses, first yield anywhere in the contact, and the tangential law made of it.

Reference: stresses summed from point loads (make_hamilton_1983.py), closed forms of the axis and the surface, and first-yield
loads that another code found on the whole symmetry plane from Hamilton's equations as printed.
"""

import math
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.special import pbdv

from stiction.engine.heights import gaussian
from stiction.engine.summation import QUANTITIES, scattered
from stiction.laws.asperity import chang_etsion_bogy_1987, hertz
from stiction.laws.joining import Law
from stiction.laws.tangential import hamilton_1983 as law
from stiction.laws.tangential.shared.edge_yield import yield_resistance
from stiction.laws.tangential.shared.hamilton_field import dragged, first_yield, pressed, stress, von_mises
from stiction.records.registry import TangentialLaw, of_kind
from tables import column, groups, read

NAMES = ("xx", "yy", "zz", "xy", "yz", "xz")


@pytest.mark.parametrize(("name", "part"), [("pressed", pressed), ("dragged", dragged)])
def test_stresses_are_those_of_point_loads(name, part):
    """Beside, near and on the axis, below the edge and outside."""
    rows = [row for row in read("hamilton_1983.csv") if row["part"] == name]
    found = part(*(column(rows, one) for one in ("x", "y", "z", "nu")))
    for six, which in zip(found, NAMES, strict=True):
        assert_allclose(six, column(rows, which), rtol=1e-13, atol=4e-16, err_msg=which)


def test_on_the_axis():
    """Closed forms of the axis (Johnson 1985, eq 3.45, and Hamilton 1983), and no loss of digits beside it."""
    z, nu = np.array([0.0, 0.01, 0.3, 0.48, 2.0, 20.0])[:, None], np.array([0.0, 0.3, 0.5])
    turn = z * np.arctan2(1.0, z)
    radial = (1.0 + nu) * (turn - 1.0) + 1.0 / (2.0 * (1.0 + z * z))
    shear = -1.0 + 1.5 * turn - z * z / (2.0 * (1.0 + z * z))
    for x, y in ((0.0, 0.0), (1e-9, 0.0), (-3e-9, 4e-9)):
        normal, tangential = pressed(x, y, z, nu), dragged(x, y, z, nu)
        for one, expected in zip(normal, (radial, radial, -1.0 / (1.0 + z * z), 0.0, 0.0, 0.0), strict=True):
            assert_allclose(one, np.broadcast_to(expected, one.shape), atol=2e-8 if x else 1e-15)
        for one, expected in zip(tangential, (0.0, 0.0, 0.0, 0.0, 0.0, shear), strict=True):
            assert_allclose(one, np.broadcast_to(expected, one.shape), atol=2e-8 if x else 4e-15)
    # To first order in the distance the stresses grow from the axis in proportion: digits are kept however near it is.
    near, nearer = (dragged(one, 0.5 * one, 0.4, 0.3) for one in (1e-5, 1e-10))
    for a, b in zip(near[:4], nearer[:4], strict=True):
        assert_allclose(a * 1e-5, b, rtol=1e-9)


def test_on_the_surface():
    """Inside the contact the closed forms and the given tractions; outside no traction; nothing jumps at the edge."""
    r, angle, nu = np.array([0.1, 0.5, 0.9, 0.999999])[:, None], np.array([0.0, 0.7, 2.0, math.pi]), 0.3
    x, y = r * np.cos(angle), r * np.sin(angle)
    root = np.sqrt(1.0 - r * r)
    normal, tangential = pressed(x, y, 0.0, nu), dragged(x, y, 0.0, nu)
    part = (1.0 - 2.0 * nu) / (3.0 * r * r) * (1.0 - root**3)
    radial, hoop = part - root, -part - 2.0 * nu * root
    sin, cos = np.sin(angle), np.cos(angle)
    zero = 0.0 * x
    expected = radial * cos**2 + hoop * sin**2, radial * sin**2 + hoop * cos**2, -root + zero, (radial - hoop) * sin * cos
    for one, other in zip(normal, (*expected, zero, zero), strict=True):
        assert_allclose(one, other, atol=1e-12)
    slopes = -math.pi / 8.0 * (4.0 + nu) * x, -3.0 * math.pi / 8.0 * nu * x, zero, -math.pi / 8.0 * (2.0 - nu) * y, zero
    for one, other in zip(tangential, (*slopes, zero - root), strict=True):
        assert_allclose(one, other, atol=1e-12)
    for six in (pressed(1.5 * cos, 1.5 * sin, 0.0, nu), dragged(1.5 * cos, 1.5 * sin, 0.0, nu)):
        assert all(np.all(one == 0.0) for one in (six[2], six[4], six[5]))
    for part in (pressed, dragged):
        edge = np.array(part(cos, sin, 0.0, nu))
        assert np.all(np.isfinite(edge))
        for place in (0.9999999999, 0.0), (1.0000000001, 0.0), (1.0, 1e-10):
            assert_allclose(np.array(part(place[0] * cos, place[0] * sin, place[1], nu)), edge, atol=6e-5)
    at_edge = pressed(-1.0, 0.0, 0.0, nu)
    assert_allclose(at_edge[:3], [(1.0 - 2.0 * nu) / 3.0, -(1.0 - 2.0 * nu) / 3.0, 0.0], atol=1e-15)


@pytest.mark.parametrize("nu", (0.0, 0.3, 0.5))
@pytest.mark.parametrize("mu", (0.0, 0.7))
def test_equilibrium_and_compatibility(mu, nu):
    """No force on any piece of the half-space, and a mean stress without sources (Beltrami & Michell), by differences."""
    rng = np.random.default_rng(7)
    at = np.stack([rng.uniform(-1.8, 1.8, 200), rng.uniform(-1.8, 1.8, 200), rng.uniform(0.25, 2.0, 200)])
    h = 2e-3

    def moved(axis, step):
        place = at.copy()
        place[axis] += step * h
        return np.array(stress(*place, mu, nu))

    slopes = [(8.0 * (moved(i, 1) - moved(i, -1)) - (moved(i, 2) - moved(i, -2))) / (12.0 * h) for i in range(3)]
    for row in ((0, 3, 5), (3, 1, 4), (5, 4, 2)):
        assert_allclose(sum(slopes[axis][which] for axis, which in enumerate(row)), 0.0, atol=2e-8)
    middle = 30.0 * moved(0, 0)
    second = [16.0 * (moved(i, 1) + moved(i, -1)) - (moved(i, 2) + moved(i, -2)) - middle for i in range(3)]
    assert_allclose(sum(one[:3].sum(axis=0) for one in second) / (12.0 * h * h), 0.0, atol=1e-6)


FIRST_YIELD = [  # nu, mu, p0/Y and, where known, the place
    (0.3, 0.0, 1.6128, (0.0, 0.481)),
    (0.3, 0.05, 1.6099, (0.055, 0.481)),
    (0.3, 0.1, 1.6014, (0.111, 0.475)),
    (0.3, 0.2, 1.5682, (0.218, 0.457)),
    (0.3, 0.25, 1.5442, (0.269, 0.445)),
    (0.3, 0.3, 1.5157, (0.318, 0.430)),
    (0.3, 0.35, 1.3713, (-1.0, 0.0)),
    (0.3, 0.4, 1.2426, (-1.0, 0.0)),
    (0.3, 0.5, 1.0453, (-1.0, 0.0)),
    (0.3, 0.6, 0.9015, (-1.0, 0.0)),
    (0.3, 0.8, 0.7034, (-0.376, 0.0)),
    (0.3, 1.0, 0.5677, (-0.310, 0.0)),
    (0.3, 2.0, 0.2874, (-0.162, 0.0)),
    (0.25, 0.0, 1.5543, None),
    (0.25, 0.2, 1.5141, None),
    (0.25, 1.0, 0.5633, None),
    (0.4, 0.0, 1.7385, None),
    (0.4, 0.2, 1.6819, None),
    (0.4, 0.3, 1.6155, None),
    (0.4, 0.5, 1.1334, None),
    (0.4, 1.0, 0.5745, None),
]


@pytest.mark.parametrize(("nu", "mu", "ratio", "place"), FIRST_YIELD)
def test_first_yield(nu, mu, ratio, place):
    """To the digits of the table; its places, found on a grid, to the width of that."""
    found, where = first_yield(mu, nu)
    assert found == pytest.approx(ratio, abs=6e-5)
    if place:
        assert_allclose(where, place, atol=2.5e-3)


@pytest.mark.parametrize(("nu", "mu"), [(0.3, 0.0), (0.3, 0.25), (0.3, 0.5), (0.3, 1.0), (0.0, 0.1), (0.45, 0.7), (0.5, 3.0)])
def test_nothing_yields_earlier_off_the_symmetry_plane(nu, mu):
    x, y, z = np.ogrid[-1.2:1.2:73j, -1.2:1.2:73j, 0.0:0.8:25j]
    assert von_mises(stress(x, y, z, mu, nu)).max() * first_yield(mu, nu)[0] <= 1.0 + 1e-12


def edge_load(mu, nu):
    """p0/Y at which the trailing edge yields: Chang, Etsion & Bogy's condition 3 alpha^2 + ... = Y^2."""
    square = (1 - 2 * nu) ** 2 / 3 + math.pi / 2 * (1 - 2 * nu) * (1 - nu / 2) * mu
    return (square + math.pi**2 / 8 * (2 - nu / 2 + 7 / 8 * nu**2) * mu**2) ** -0.5


@pytest.mark.parametrize(("nu", "low", "high"), [(0.3, 0.30, 0.31), (0.25, 0.27, 0.28), (0.4, 0.35, 0.36)])
def test_where_the_surface_takes_over(nu, low, high):
    assert first_yield(low, nu)[1][1] > 0.3
    assert first_yield(high, nu)[1][1] == 0.0


@pytest.mark.parametrize(
    ("nu", "mu", "percent"),
    [(0.3, 0.5, 0), (0.3, 1.0, 2), (0.3, 2.0, 7), (0.4, 0.4, 1), (0.4, 0.6, 4), (0.4, 1.0, 7), (0.4, 2.0, 9)],
)
def test_two_places_are_not_enough(nu, mu, percent):
    """The trailing edge alone puts first yield at too large a load; at nu = 0.3 it is the true place from mu = 0.31 to 0.6."""
    assert 100.0 * (edge_load(mu, nu) / first_yield(mu, nu)[0] - 1.0) == pytest.approx(percent, abs=0.5)


@pytest.mark.parametrize(("mu", "percent"), [(0.2, 1.6), (0.3, 3.5)])
def test_the_axis_is_not_enough(mu, percent):
    """nu = 0.3: below the surface the true place is off the axis; the one of 1988 is at the depth 0.48 a."""
    axis = 1.0 / von_mises(stress(0.0, 0.0, 0.48, mu, 0.3))
    assert 100.0 * (axis / first_yield(mu, 0.3)[0] - 1.0) == pytest.approx(percent, abs=0.1)


def test_limits_of_first_yield():
    """mu = 0: Hertz. Mostly shear: the middle yields at q0 = Y/sqrt(3)."""
    for nu in (0.0, 0.25, 0.499):
        assert_allclose(first_yield(0.0, nu)[0], hertz.first_yield(nu)[0], rtol=1e-13)
        assert first_yield(1e9, nu)[0] * 1e9 == pytest.approx(1.0 / math.sqrt(3.0), rel=1e-8)


@cache
def made_for(nu):
    steps, series = law.series_for(np.array([nu]))
    return steps[:, 0], series[:, 0]


def shear_at(s, nu):
    """q0/Y of the law at p0/Y = s, with hardness group, H/Y and area 1: then P = s/1.5 and Q = q/1.5."""
    steps, series = made_for(nu)
    slip_limited, yield_limited = law.resistance(0.0, 0.0, s / 1.5, 1.0, 1.0, 1.0, nu, *steps, *series)
    assert slip_limited == 0.0
    return 1.5 * yield_limited


@pytest.mark.parametrize("nu", (0.0, 0.123, 0.3, 0.388, 0.395, 0.45, 0.499))
def test_law_is_the_inverse_of_first_yield(nu):
    """p0/Y from Q/P by search over the whole plane gives back the p0/Y that the law's series started from."""
    inside, below, end, *_ = made_for(nu)[0]
    shares = np.array([0.001, 0.3, 0.7, 0.999])
    for s in (*(inside * shares), *(inside + (below - inside) * shares), *(below + (end - below) * shares)):
        assert first_yield(shear_at(s, nu) / s, nu)[0] == pytest.approx(s, rel=1e-10)
    assert shear_at(end * (1.0 - 1e-12), nu) < 1e-5
    assert shear_at(end * (1.0 + 1e-12), nu) == shear_at(2.0 * end, nu) == 0.0
    assert shear_at(0.0, nu) == pytest.approx(1.0 / math.sqrt(3.0), rel=1e-12)


def test_law_at_random():
    rng = np.random.default_rng(11)
    for nu, share in zip(rng.uniform(0.0, 0.499, 40), rng.uniform(0.0, 1.0, 40), strict=True):
        s = share * hertz.first_yield(nu)[0]
        assert first_yield(shear_at(s, nu) / s, nu)[0] == pytest.approx(s, rel=1e-10)


def test_nowhere_above_the_trailing_edge():
    """The yield resistance of the trailing edge alone bounds this law, and is reached where that edge is the place."""
    for nu in (0.1, 0.3, 0.45):
        inside, below, end, *_ = made_for(nu)[0]
        for s in np.linspace(0.001, 0.999, 50) * end:
            edge = 1.5 * yield_resistance(s / 1.5, 1.0 / math.pi, nu)
            here = inside <= s < below
            assert shear_at(s, nu) == edge if here else shear_at(s, nu) < edge


@pytest.mark.parametrize("asperity", (hertz, chang_etsion_bogy_1987))
@pytest.mark.parametrize("nu", (0.1, 0.3, 0.45))
def test_sum_over_heights(asperity, nu):
    """Against an adaptive integral that knows the kinks; Q = (2/3) pi a^2 q0 with q0 from the law of one contact."""
    given = groups(theta=100.0, lam=40.0, nu=nu)
    eta, k = given.eta[0], 2.8
    last = eta if asperity is hertz else 2.0 / 3.0 * chang_etsion_bogy_1987.hardness_coefficient(nu) * eta
    kinks = [one * eta / (1.5 * k) for one in made_for(nu)[0][:3]]
    for h in (0.0, 2.0):

        def part(v, h=h):
            """sqrt(w) = u = end - v^2 takes the square root of the end away."""
            u = kinks[2] - v * v
            yield_limited = 2.0 / 3.0 * eta / k * u * u * shear_at(1.5 * k * u / eta, nu)
            return yield_limited * math.exp(-0.5 * (h + u * u) ** 2) / math.sqrt(2.0 * math.pi) * 2.0 * u * 2.0 * v

        inner = [math.sqrt(kinks[2] - one) for one in (0.0, *kinks[:2], min(last, kinks[2]))]
        cuts = sorted({one for one in inner if one >= inner[-1]})
        expected = sum(quad(part, a, b, epsabs=0.0, epsrel=1e-12)[0] for a, b in pairwise(cuts))
        regimes = Law(asperity.RECORD, law.RECORD).regimes(given)
        sums = scattered(regimes, np.array([h]), gaussian()).sum(axis=0)[0]
        assert sums[QUANTITIES.index("yield_limited")] == pytest.approx(expected, rel=1e-9)
        assert sums[QUANTITIES.index("slip_limited")] == 0.0


def test_load_is_untouched_by_the_kinks():
    """Hertz: Int_0^inf w^(3/2) phi(h + w) dw in parabolic cylinder functions; the last segment reaches to infinity."""
    given, h = groups(theta=100.0, lam=[1e-3, 1.0, 40.0], nu=[0.0, 0.3, 0.45]), np.array([0.5, 1.0, 2.0])
    sums = scattered(Law(hertz.RECORD, law.RECORD).regimes(given), h, gaussian())[0]
    expected = np.exp(-h * h / 4.0) * math.gamma(2.5) * pbdv(-2.5, h)[0] / math.sqrt(2.0 * math.pi)
    assert_allclose(sums[:, QUANTITIES.index("load")], expected, rtol=1e-10)


def test_record():
    """Found by its key; of many laws each has its own Poisson's ratio; a plastic asperity bears nothing."""
    assert of_kind(TangentialLaw)["hamilton_1983"] is law.RECORD
    rough = groups(theta=100.0, lam=40.0, nu=[0.3, 0.1, 0.3])
    elastic, plastic = chang_etsion_bogy_1987.segments(rough)
    assert law.tangential_resistance(plastic, rough) is None
    kinks = law.tangential_resistance(elastic, rough).kinks
    assert np.all(kinks[0] == kinks[2]) and np.all(kinks[0] != kinks[1])
