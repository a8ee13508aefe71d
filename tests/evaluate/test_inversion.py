"""The search for a separation, where it is hard: what is found from a load is compared with sums and closed forms written here,
on heights whose tension is far out, narrow or met more than once, and among very many contacts."""

import math
from dataclasses import replace

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose
from scipy.optimize import brentq, minimize_scalar

import stiction as st
from refusals import refusal
from stiction.engine.heights import height_distribution
from stiction.solving.choice import Choice
from stiction.solving.inversion import Unreachable, separations_at
from stiction.solving.problem import make_problem


def test_a_closed_form_without_a_first_estimate_has_the_same_loads():
    """As a law of a user may be: its loads are computed for one contact after the other."""
    density = xarray.DataArray([0.05, 0.08], dims="n")
    problem = make_problem(st.Indices(theta=20.0, lam=10.0, roughness_parameter=density), Choice("greenwood_2006"))
    record = replace(problem.record, separation_near=None)
    alone = replace(problem, chosen=replace(problem.chosen, model=record))
    h, law = np.array([1.0, 2.0, 1.5]), np.array([0, 1, 0])
    assert_allclose(alone.loads(h, law), problem.loads(h, law), rtol=1e-12)


def test_some_of_several_contacts_are_those_that_are_chosen():
    theta = np.array([20.0, 30.0, 40.0])
    problem = make_problem(st.Indices(theta=xarray.DataArray(theta, dims="n"), lam=10.0), Choice())
    for rows in (slice(1, 2), slice(0, 2), np.array([2, 0, 1])):
        assert_allclose(problem.with_groups(rows).groups.theta, theta[rows])
    assert problem.with_groups(slice(0, 3)) is problem


# ---- tension far out in the tail of Weibull heights


class Tail:
    """Johnson, Kendall & Roberts' asperities, let go, under heights of Weibull's density with this exponent k: y = m + d z of
    density k y^(k-1) exp(-y^k). P = u^6 - S u^3 and w = u^4 - 2 S u/3, S = sqrt(6 pi/theta), from the fold 4 u^3 = 2 S/3 on."""

    def __init__(self, theta, k):
        self.S, self.k = math.sqrt(6.0 * math.pi / theta), k
        self.mean = math.gamma(1.0 + 1.0 / k)
        self.deviation = math.sqrt(math.gamma(1.0 + 2.0 / k) - self.mean**2)
        self.fold = (self.S / 6.0) ** (1.0 / 3.0)

    def density(self, z):
        y = self.mean + self.deviation * z
        return self.deviation * self.k * y ** (self.k - 1.0) * np.exp(-(y**self.k))

    def load(self, h):
        """Per asperity, at a separation h > 2, from which all heights that touch have a density. To w = 30, on short panels."""
        t, weights = np.polynomial.legendre.leggauss(40)
        ends = np.linspace(self.fold, 30.0**0.25 + 0.1, 13)
        half = np.diff(ends)[:, None] / 2.0
        u = ends[:-1, None] + half * (1.0 + t)
        slope = 4.0 * u**3 - 2.0 * self.S / 3.0
        density = self.density(h + u**4 - 2.0 * self.S * u / 3.0)
        return float(np.sum(half * weights * (u**6 - self.S * u**3) * slope * density))

    def pull_off(self, low, high):
        """Largest tension between two separations, and where."""
        size = self.density(low)
        found = minimize_scalar(lambda h: self.load(h) / size, bounds=(low, high), options={"xatol": 1e-10})
        return -found.fun * size, found.x


# theta, k: the tension is at 19 sigma and 1e-17 of the loads that are pressed with; before it the load is compressive.
FAR_OUT = (16.445159362943635, 1.3)


def test_the_largest_tension_far_out_in_a_long_tail():
    """Within the first 10 sigma nothing pulls, and at the last separation but one that is searched the tension is largest."""
    theta, k = FAR_OUT
    tail = Tail(theta, k)
    assert tail.load(10.0) > 0.0 > tail.load(19.0)
    found = st.solve(
        st.Indices(theta=theta, lam=1e30), load=1.0, model="fuller_tabor_1975",
        heights=height_distribution("weibull", exponent=k), branch="unloading",
    )  # fmt: skip
    tension, where = tail.pull_off(18.0, 20.0)
    assert_allclose(found["pull_off_force"], tension, rtol=1e-7)
    assert_allclose(found["pull_off_separation"], where, rtol=1e-5)


class GaussianTail(Tail):
    """The same asperities under Gaussian heights."""

    def __init__(self, theta):
        super().__init__(theta, 1.0)

    def density(self, z):
        return np.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi)


@pytest.mark.parametrize("theta", (120.0, 131.1133937421563))
def test_a_tension_whose_load_turns_right_after_a_separation_that_is_looked_at(theta):
    """8 sigma is one of the separations. Near 131.1 the load falls there so fast that it could be compressive all along."""
    tension, where = GaussianTail(theta).pull_off(7.0, 9.0)
    found = st.solve(st.Indices(theta=theta, lam=1e6), load=1e-6, model="fuller_tabor_1975", branch="unloading")
    assert_allclose(float(found["pull_off_force"]), tension, rtol=1e-9)
    assert_allclose(float(found["pull_off_separation"]), where, rtol=0, atol=1e-4)


def test_loads_carried_far_out_in_a_long_tail():
    """The first load that is met beyond the largest tension: from nothing upwards."""
    theta, k = FAR_OUT
    tail = Tail(theta, k)
    loads = [0.0, 1e-15, 1e-9]
    found = st.solve(
        st.Indices(theta=theta, lam=1e30), load=loads, model="fuller_tabor_1975",
        heights=height_distribution("weibull", exponent=k), branch="unloading",
    )  # fmt: skip
    where = tail.pull_off(18.0, 20.0)[1]
    expected = [brentq(lambda h: tail.load(h) - load, 9.0, where, xtol=1e-13) for load in loads]  # noqa: B023
    assert_allclose(found["mean_separation"], expected, rtol=1e-9)


# ---- tension in a narrow place below the top of the heights


@pytest.mark.parametrize("theta", (1e5, 1e6, 1e7))
def test_narrow_tension_below_the_highest_of_all(theta):
    """One of 2001 asperities is far above the others. Below the top of its heights, where their density rises by s from
    nothing, asperities of P = w^(3/2) - 2 pi/theta carry s (4/35 y^(7/2) - pi/theta y^2) at y below the top, the least of
    which is at y^(3/2) = 5 pi/theta: -(3/7) s (pi/theta) y^2."""
    samples = np.append(np.random.default_rng(0).standard_normal(2000), 30.0)
    heights = height_distribution("empirical", samples=samples)
    first, spacing, *density = heights.shape
    top, slope = first + spacing * (len(density) - 1), density[-2] / spacing
    y = (5.0 * math.pi / theta) ** (2.0 / 3.0)
    assert y < spacing and density[-1] == 0.0
    contact = st.Indices(theta=theta, lam=10.0, tabor_parameter=1.0)
    found = st.solve(contact, load=1e-3, model="rough_dmt", heights=heights)
    assert_allclose(found["pull_off_force"], 3.0 / 7.0 * slope * math.pi / theta * y**2, rtol=1e-6)
    assert_allclose(top - found["pull_off_separation"], y, rtol=1e-3)


# ---- several separations for one load


def two_plateaus(apart, below):
    """Three of five asperities are higher than the others, and a few far below: the load rises, falls and rises again."""
    lowest = [np.full(below, -6.0), np.full(below, -8.0)]
    samples = np.concatenate([np.zeros(1200), np.full(800, -apart), *lowest])
    return height_distribution("empirical", samples=samples, cells=200)


# How far the lower ones are below the upper, how many are far below, theta, and a load that is met three times.
SEVERAL = ((1.0, 30, 10.0, -0.17), (1.2, 45, 10.0, -0.165), (1.0, 90, 16.0, -0.133), (0.8, 30, 16.0, -0.063))


@pytest.mark.parametrize(("apart", "below", "theta", "target"), SEVERAL)
def test_of_several_separations_the_first_after_the_largest_tension(apart, below, theta, target):
    """The upper asperities pull most; they are pressed, less than 0.3 sigma nearer, when the lower ones begin to hold. A load
    between is met three times, and the surfaces, as they approach from the largest tension, meet the farthest first."""
    laws = {"model": "fuller_tabor_1975", "heights": two_plateaus(apart, below), "branch": "unloading"}
    contact = st.Indices(theta=theta, lam=1e30)

    def excess(h):
        return st.solve(contact, separation=h, **laws)["load"].values - target

    dense = np.linspace(2.0, -2.0, 2001)
    over = excess(dense)
    crossings = np.flatnonzero(np.sign(over[:-1]) != np.sign(over[1:]))
    largest = int(np.argmin(over))
    after = crossings[crossings >= largest]
    assert len(after) == 3 and 0.3 > dense[after[0]] - dense[after[1]] > 0.12
    expected = brentq(lambda h: float(excess(h)), dense[after[0] + 1], dense[after[0]], xtol=1e-13)
    found = st.solve(contact, load=target, **laws)
    assert_allclose(found["mean_separation"], expected, rtol=1e-9)
    assert_allclose(found["pull_off_separation"], dense[largest], atol=2e-3)


@pytest.mark.parametrize("theta", (0.3, 2.0, 9.0))
def test_the_largest_tension_is_carried_where_it_is(theta):
    """Asked for just the pull-off force, and for a little less: the separations are those of the pull-off and near it."""
    contact = st.Indices(theta=theta, lam=1e30)
    most = st.solve(contact, load=0.0, model="fuller_tabor_1975", branch="unloading")
    force, where = float(most["pull_off_force"]), float(most["pull_off_separation"])
    found = st.solve(contact, load=[-force, -force * (1.0 - 1e-6)], model="fuller_tabor_1975", branch="unloading")
    assert_allclose(found["mean_separation"][0], where, rtol=1e-7)
    assert where - 0.1 < float(found["mean_separation"][1]) < where
    with refusal("load"):
        st.solve(contact, load=-force * (1.0 + 1e-9), model="fuller_tabor_1975", branch="unloading")


# ---- one among very many


def many(count=10_500):
    """Loads of as many contacts, one of which cannot carry its own, and which."""
    wrong = 10_321
    loads = np.geomspace(1e-6, 1.0, count)
    loads[wrong] = 4321.0
    return loads, wrong


def test_the_contact_that_cannot_carry_its_load_is_named():
    """Not the one that has its place among the contacts that are searched together."""
    loads, wrong = many()
    theta = np.geomspace(20.0, 2e3, len(loads))
    problem = make_problem(st.Indices(theta=st.axis("theta", theta), lam=10.0), Choice("greenwood_williamson_1966"))
    with pytest.raises(Unreachable) as caught:
        separations_at(problem, loads[:, None])
    assert (caught.value.law, caught.value.at) == (wrong, 0) and caught.value.high < 4321.0
    contacts = st.Indices(theta=xarray.DataArray(theta, dims="sort"), lam=10.0)
    with refusal("load", "4321"):
        st.solve(contacts, load=xarray.DataArray(loads, dims="sort"), model="greenwood_williamson_1966")


def test_very_many_contacts_are_each_at_their_own_load():
    """Exponential heights: Gamma(5/2) exp(-(h + 1)) of elastic spheres, whatever theta."""
    loads, wrong = many()
    loads[wrong] = 0.3
    contacts = st.Indices(theta=xarray.DataArray(np.geomspace(20.0, 2e3, len(loads)), dims="sort"), lam=10.0)
    found = st.solve(
        contacts, load=xarray.DataArray(loads, dims="sort"), model="greenwood_williamson_1966", heights="exponential"
    )
    assert_allclose(found["mean_separation"], np.log(math.gamma(2.5) / loads) - 1.0, rtol=0.0, atol=1e-11)


# ---- what is refused


@pytest.mark.parametrize("model", ("bush_gibson_thomas_1975", "persson_2001"))
@pytest.mark.parametrize("heights", ("exponential", height_distribution("weibull", exponent=3.0)))
def test_theories_in_closed_form_know_gaussian_heights_only(model, heights):
    name = heights if isinstance(heights, str) else heights.key
    contact = st.Indices(theta=40.0, lam=10.0, sharpness=0.01, roughness_parameter=0.05)
    with refusal("heights", name, "gaussian", model):
        st.solve(contact, load=0.01, model=model, heights=heights)
    assert float(st.solve(contact, load=0.01, model=model, heights="gaussian")["contact_area"]) > 0.0


@pytest.mark.parametrize("separation", (1.001e6, -1.001e6, [0.0, -2e6], np.array([1.0, 1e300])))
def test_separations_beyond_the_farthest(separation):
    farthest = np.abs(separation).max()
    with pytest.raises(st.InputError) as caught:
        st.solve(st.Indices(theta=40.0, lam=10.0), separation=separation, model="fuller_tabor_1975")
    assert str(caught.value) == f"separation: {farthest:.4g} sigma; allowed: at most 1e+06 sigma"


@pytest.mark.parametrize("separation", (1e6, -1e6))
def test_the_farthest_separations_themselves(separation):
    """Elastic spheres over heights of deviation 1: nothing, or all pressed by a million sigma."""
    found = st.solve(st.Indices(theta=40.0, lam=10.0), separation=separation, model="greenwood_williamson_1966")
    assert_allclose(found["load"], max(-separation, 0.0) ** 1.5, rtol=1e-9)
    assert_allclose(found["contact_area"], max(-separation, 0.0), rtol=1e-9)


def test_sigmas_of_a_contact_are_counted():
    """A Contact's separations are lengths: a million times 48 nm is 48 mm."""
    surface = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
    contact = st.Contact(
        first="hardened_steel_52100", second="hardened_steel_52100", nominal_area="1 mm^2", work_of_adhesion="0.1 J/m^2",
        roughness=st.Roughness(**surface),
    )  # fmt: skip
    assert float(st.solve(contact, separation="47.9 mm", model="greenwood_williamson_1966")["load"]) == 0.0
    with refusal("separation", "1e+06"):
        st.solve(contact, separation="48.1 mm", model="greenwood_williamson_1966")


def test_sparse_asperities_of_nearly_equal_heights_are_pressed_until_they_carry_the_load():
    """All of them touch at -16 sigma: the mean of (z + 16)^(3/2) over a Gaussian, by Gauss-Hermite quadrature."""
    radius, sigma, density, area = 1e-5, 2e-8, 8e9, 1e-4
    rough = {"asperity_height_deviation": sigma, "asperity_radius": radius, "asperity_density": density}
    body = {"youngs_modulus": 4e6, "poissons_ratio": 0.4, "hardness": 1e9}
    contact = st.Contact(first=body, second=body, roughness=rough, nominal_area=area)
    z, weights = np.polynomial.hermite_e.hermegauss(20)
    mean = weights @ (z + 16.0) ** 1.5 / math.sqrt(2.0 * math.pi)
    load = density * area * 4.0 / 3.0 * (4e6 / 1.68) * math.sqrt(radius) * sigma**1.5 * mean
    for asperity in ("chang_etsion_bogy_1987", "zhao_maietta_chang_2000"):
        solved = st.solve(contact, load=load, model="greenwood_williamson_1966", tangential="none", asperity=asperity)
        assert float(solved["mean_separation"]) == pytest.approx(-16.0 * sigma, rel=1e-9)
        assert float(solved["contact_area"]) == pytest.approx(math.pi * radius * 16.0 * sigma * density * area, rel=1e-9)
    with refusal("load"):  # the spheres would fill the plane before
        st.solve(contact, load=1e4 * load, model="greenwood_williamson_1966", asperity=asperity, tangential="none")
