"""solve at loads: they are the loads of the result, and friction is compared to them, not to what a search makes of them."""

import math
from contextlib import nullcontext

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import gamma

import stiction as st
from refusals import refusal
from stiction.contact.indices import Groups
from stiction.engine import blocks
from stiction.engine.heights import height_distribution
from stiction.laws.rough_surface import (
    bush_gibson_thomas_1975,
    ciavarella_greenwood_paggi_2008,
    greenwood_2006,
    hariri_zu_ben_mrad_2006,
)
from stiction.solving import inversion
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from stiction.surfaces.theory import moments
from stiction.surfaces.theory.start_table import lone_separation
from tables import groups

ADHESIVE = st.Contact(
    first="hardened_steel_52100",
    second="hardened_steel_52100",
    nominal_area="1 mm^2",
    work_of_adhesion="1 J/m^2",
    interfacial_shear_strength="200 MPa",
    roughness=st.Roughness(asperity_height_deviation="5.8 nm", asperity_radius="72 um", asperity_density="5.7e10 1/m^2"),
)
INDICES = st.Indices(theta=3.0, lam=100.0)


@pytest.mark.parametrize("load", (["-1 mN", "0 N", "1 N"], xarray.DataArray([-1e-3, 0.0, 1.0], dims="pressed")))
def test_friction_is_not_a_number_unless_the_load_presses(load):
    data = st.solve(ADHESIVE, load=load, model="soft_coating_2015")
    assert_array_equal(np.isfinite(data["friction_coefficient"]), [False, False, True])
    assert_array_equal(data["load"], [-1e-3, 0.0, 1.0])
    assert (data["friction_force"] > 0.0).all()
    assert abs(data["load_residual"]).max() < 1e-12


@pytest.mark.parametrize("contact", (ADHESIVE, INDICES))
def test_one_load_of_nothing(contact):
    data = st.solve(contact, load=0.0, model="soft_coating_2015")
    assert float(data["load"]) == 0.0 and np.isnan(float(data["friction_coefficient"]))


def test_of_many_contacts_too():
    contacts = st.Indices(theta=st.axis("theta", [2.0, 3.0, 4.0]), lam=100.0)
    data = st.solve(contacts, load=[-1e-4, 0.0, 1e-3])
    assert data["friction_coefficient"].dims == ("theta", "load")
    assert_array_equal(np.isfinite(data["friction_coefficient"]), np.tile([False, False, True], (3, 1)))


def test_a_tiny_load_is_what_friction_is_compared_to():
    data = st.solve(ADHESIVE, load="1e-8 N", model="soft_coating_2015")
    nothing = st.solve(ADHESIVE, load="0 N", model="soft_coating_2015")
    assert_allclose(float(data["friction_coefficient"]), float(nothing["friction_force"]) / 1e-8, rtol=1e-6)


@pytest.mark.parametrize("model", ("persson_2001", "persson_2001_elastoplastic"))
def test_theories_that_know_loads_only(model):
    data = st.solve(ADHESIVE, load=["0 N", "1 N"], model=model, tangential="bowden_tabor_1943")
    assert_array_equal(np.isfinite(data["friction_coefficient"]), [False, True])
    assert "mean_separation" not in data and "pull_off_force" not in data


def test_at_separations_the_load_is_found():
    h = float(st.solve(INDICES, load=0.01)["mean_separation"])
    assert_allclose(float(st.solve(INDICES, separation=h)["load"]), 0.01, rtol=1e-12)


@pytest.mark.parametrize("theta", (1e-2, 1e-4, 1e-6))
def test_strong_adhesion_makes_one_sphere_of_all_asperities(theta):
    """Far beyond the heights: Johnson, Kendall & Roberts 1971 have the pull-off force (3/2) pi gamma R, and at no load the
    displacement (6 pi gamma R^2 / K)^(2/3) / (3 R). Corrections are of the order of sigma over that, squared."""
    data = st.solve(st.Indices(theta=theta, lam=1e30), load=[0.0, 1.0], model="fuller_tabor_1975")
    displacement = (6.0 * np.pi / theta) ** (2.0 / 3.0) / 3.0
    assert_allclose(data["mean_separation"][0], -displacement, rtol=displacement**-2)
    assert_allclose(data["pull_off_force"], 1.5 * np.pi / theta, rtol=displacement**-1.5)
    assert float(data["pull_off_separation"]) > 0.3 * displacement


def test_light_loads_are_carried_far_out():
    """Exponential heights: the load is Gamma(5/2) exp(-(h + 1)) of elastic spheres, at every separation beyond -1."""
    loads = np.array([1e-60, 1e-20, 1e-6, 0.5])
    data = st.solve(INDICES, load=loads, model="greenwood_williamson_1966", heights="exponential")
    assert_allclose(data["mean_separation"], np.log(gamma(2.5) / loads) - 1.0, rtol=1e-11)
    assert float(data["pull_off_force"]) == 0.0 and np.isnan(float(data["pull_off_separation"]))


def test_heights_with_one_far_out():
    """The one sample of 100 that is far from the others carries light loads: that height alone, spread over a cell."""
    samples = np.concatenate([np.linspace(-1.0, 1.0, 99), [60.0]])
    heights = height_distribution("empirical", samples=samples, cells=400)
    highest = heights.shape[0] + heights.shape[1] * (heights.shape.size - 3)
    data = st.solve(INDICES, load=1e-4, model="greenwood_williamson_1966", heights=heights)
    h = float(data["mean_separation"])
    assert 9.0 < h < highest and abs(float(data["load_residual"])) < 1e-12


def test_no_load_is_refused_where_nothing_adheres():
    with refusal("load", "0"):
        st.solve(INDICES, load=0.0, model="greenwood_williamson_1966")


@pytest.mark.parametrize("model", ("rough_dmt", "soft_coating_2015"))
@pytest.mark.parametrize(("far", "theta"), ((30.0, 10.0), (30.0, 100.0), (50.0, 1e3), (100.0, 1e4)))
def test_no_tension_is_missed_below_a_gap_in_the_heights(model, far, theta):
    """One or many asperities high above all others adhere over a distance that no even grid of separations would see."""
    samples = np.random.default_rng(0).standard_normal(2000)
    samples = np.append(samples, far if far < 40.0 else samples + far)
    heights = height_distribution("empirical", samples=samples)
    contact = st.Indices(theta=theta, lam=10.0, tabor_parameter=1.0)
    options = {} if model == "rough_dmt" else {"branch": "unloading"}
    found = st.solve(contact, load=1e-3, model=model, heights=heights)
    knots = heights.shape[0] + heights.shape[1] * np.arange(heights.shape.size - 2)
    fine = (knots[:, None] + theta ** (-2.0 / 3.0) * np.linspace(-20.0, 5.0, 300)).ravel()
    dense = np.concatenate([fine, np.linspace(12.0, -6.0, 1000)])
    loads = st.solve(contact, separation=dense, model=model, heights=heights, **options)["load"].values
    assert loads.min() < 0.0
    assert_allclose(found["pull_off_force"], -loads.min(), rtol=2e-3)
    held = st.solve(contact, load=loads.min() / 2.0, model=model, heights=heights, **options)
    assert abs(float(held["load_residual"])) < 1e-10


def test_no_tension_of_a_film_is_missed_either():
    """Adhesion may be the film's alone: Liu, Neville & Reuben's, on asperities that have none."""
    samples = np.append(np.random.default_rng(0).standard_normal(500), 30.0)
    heights = height_distribution("empirical", samples=samples)
    contact = st.Indices(theta=3e3, lam=10.0, n_E=0.5, n_H=0.5, tau=2.0, film_aspect=0.5, tabor_parameter=1.0, hardening=0.01)
    laws = {"model": "greenwood_williamson_1966", "film": "liu_neville_reuben_2002", "heights": heights}
    dense = np.concatenate([(heights.tops[:, None] + np.linspace(-0.2, 0.02, 2000)).ravel(), np.linspace(12.0, -6.0, 1000)])
    loads = st.solve(contact, separation=dense, **laws)["load"].values
    assert loads.min() < 0.0
    assert_allclose(st.solve(contact, load=1.0, **laws)["pull_off_force"], -loads.min(), rtol=5e-3)


def test_what_one_contact_carries_does_not_depend_on_others():
    """The search goes farther for the second contact, which adheres a million times as strongly."""
    alone = st.solve(st.Indices(theta=311.36, lam=0.01), load=1e-4, model="fuller_tabor_1975")
    both = st.Indices(theta=xarray.DataArray([311.36, 0.01], dims="sort"), lam=0.01)
    together = st.solve(both, load=1e-4, model="fuller_tabor_1975").isel(sort=0)
    for name in ("pull_off_force", "pull_off_separation", "mean_separation", "contact_area"):
        assert_allclose(together[name], alone[name], rtol=1e-9, err_msg=name)


def test_many_contacts_in_blocks(monkeypatch):
    thetas = st.axis("theta", np.geomspace(0.5, 50.0, 23))
    whole = st.solve(st.Indices(theta=thetas, lam=30.0), load=[1e-3, 0.1])
    monkeypatch.setattr(blocks, "_TOGETHER", 100)  # five contacts of the 23
    parts = st.solve(st.Indices(theta=thetas, lam=30.0), load=[1e-3, 0.1])
    for name in whole.data_vars:
        if name != "load_residual":
            assert_allclose(parts[name], whole[name], rtol=1e-9, err_msg=name)
    with refusal("load"):
        st.solve(st.Indices(theta=thetas, lam=30.0), load=[1e-3, 1e9])


def test_residuals_are_of_what_they_can_be_compared_with():
    with np.errstate(all="raise"):
        data = st.solve(st.Indices(theta=1e-4, lam=10.0), load=[1e-300, 1e-12, 0.0, 1.0], model="fuller_tabor_1975")
    assert abs(data["load_residual"]).max() < 1e-9


@pytest.mark.parametrize("model", ("soft_coating_2015", "fuller_tabor_1975"))
def test_narrow_weibull_heights_at_any_separation(model):
    """Far below all heights the density is nothing: all asperities are then nearly at the mean, and carry what one does."""
    heights = height_distribution("weibull", exponent=100.0)
    contact = st.Indices(theta=1.0, lam=1e8)
    data = st.solve(contact, separation=[-10.0, -1e3], model=model, heights=heights)
    even = st.solve(contact, separation=[-10.0, -1e3], model=model)  # Gaussian: deviation 1 about the same mean
    assert_allclose(data["load"], even["load"], rtol=2e-3)
    assert float(data["pull_off_force"]) > 0.0


def test_a_load_that_a_theory_of_loads_refuses_is_named_in_its_unit():
    with refusal("load", "-1 mN", "0", "persson_2001"):
        st.solve(ADHESIVE, load="-1 mN", model="persson_2001")


# ---- found from nodes placed once, or from a table: against roots that are found otherwise


def load_by_itself(h: float, theta: float, lam: float) -> float:
    """The bare corrected model's load, by 300 Gauss points on each of three parts: eqs. (1) to (4) of the 2015 paper, as in
    docs/theory.md."""
    S = math.sqrt(6.0 * math.pi / theta)
    eta = math.sqrt(math.pi) * 18.0**0.25 * lam**0.25 / math.sqrt(theta)
    first = (2.0 / 3.0 * S) ** (1.0 / 3.0)
    last = brentq(lambda u: u**3 - eta * u - S, first, 2.0 + 2.0 * S ** (1.0 / 3.0) + 2.0 * math.sqrt(eta), xtol=1e-15)
    onset = last**4 - 2.0 / 3.0 * S * last

    def density(z):
        return np.exp(-z * z / 2.0) / math.sqrt(2.0 * math.pi)

    def elastic(u):
        return (u**6 - S * u**3) * density(h + u**4 - 2.0 / 3.0 * S * u) * (4.0 * u**3 - 2.0 / 3.0 * S)

    def plastic(w):
        return (2.0 * eta * w - 2.0 * math.pi / theta) * density(h + w)

    node, weight = np.polynomial.legendre.leggauss(300)

    def integral(integrand, low, high):
        return float(np.sum(weight * integrand((high + low + (high - low) * node) / 2.0))) * (high - low) / 2.0

    reach = first + 1.0
    while reach < last and reach**4 - 2.0 / 3.0 * S * reach < 12.0 - min(h, 0.0):
        reach += 0.1
    middle = min(reach, last)
    far = onset + 12.0 + max(-h - onset, 0.0)
    return (
        integral(elastic, first, (first + middle) / 2.0)
        + integral(elastic, (first + middle) / 2.0, middle)
        + (integral(plastic, onset, far))
    )


@pytest.mark.parametrize(("theta", "lam"), ((1.5, 30.0), (10.0, 1.0), (100.0, 0.05), (600.0, 800.0)))
@pytest.mark.parametrize("load", (1e-9, 1e-4, 0.03, 2.0))
def test_the_root_is_that_of_an_independent_sum(theta, lam, load):
    contact = st.Indices(theta=theta, lam=lam)
    found = st.solve(contact, load=load)
    h, where = float(found["mean_separation"]), 9.0
    root = brentq(lambda x: load_by_itself(x, theta, lam) - load, h - 0.05, h + 0.05, xtol=1e-14)
    assert_allclose(h, root, rtol=0, atol=1e-10)
    # No other separation farther out, on the way from the largest tension, carries the load.
    dense = np.linspace(h + 0.01, where, 400)
    loads = st.solve(contact, separation=dense)["load"].values
    outward = loads[: int(np.argmin(loads)) + 1] if loads.min() < 0.0 else loads
    assert (outward < load).all()


def strongly_adhesive(count: int, seed: int) -> Groups:
    """Laws whose load falls again where asperities turn plastic: some loads are carried at several separations."""
    rng, ones = np.random.default_rng(seed), np.ones(count)
    theta, lam = 10.0 ** rng.uniform(0.0, 1.5, count), 10.0 ** rng.uniform(-4.0, 1.0, count)
    return Groups(theta=theta, lam=lam, nu=0.3 * ones, hardness_to_yield=2.8 * ones, K_beta=6.4762 * ones)


def test_of_several_separations_the_first_after_the_largest_tension():
    groups = strongly_adhesive(300, seed=3)
    problem = problem_of(groups, Choice())
    tension, where = inversion.pull_off(problem)
    dense = np.linspace(9.0, -7.0, 6401)
    loads = st.evaluate(dense, groups.theta[:, None], groups.lam[:, None]).load
    several = 0
    for i in np.flatnonzero(tension > 0.0):
        way = dense < where[i]
        h, load = dense[way], loads[i, way]
        assert_allclose(tension[i], -loads[i].min(), rtol=1e-4)
        peaks = np.flatnonzero((load[1:-1] > load[:-2]) & (load[1:-1] > load[2:])) + 1
        target = load[0] + np.random.default_rng(i).uniform(0.1, 0.9) * (load.max() - load[0])
        if peaks.size:
            target = (load[peaks[0]] + load[peaks[0] :].min()) / 2.0
        first = int(np.argmax(load >= target))
        several += np.sum(np.diff(np.sign(load - target)) != 0) > 1
        found = inversion.separations_at(problem.with_groups(np.array([i])), np.array([[target]])).h.item()
        assert h[first] <= found <= h[max(first - 1, 0)] + 1e-12, (groups.theta[i], groups.lam[i], target)
    assert several > 5


def test_a_load_carried_on_a_peak_between_two_separations_that_do_not_carry_it():
    groups = strongly_adhesive(300, seed=4)
    problem = problem_of(groups, Choice())
    _, where = inversion.pull_off(problem)
    dense = np.linspace(9.0, -7.0, 6401)
    loads = st.evaluate(dense, groups.theta[:, None], groups.lam[:, None]).load
    tried = 0
    for i in np.flatnonzero(np.isfinite(where)):
        h = dense[dense < where[i]]
        load = loads[i, dense < where[i]]
        peaks = np.flatnonzero((load[1:-1] > load[:-2]) & (load[1:-1] > load[2:])) + 1
        if peaks.size and load[-1] > load[peaks[0]]:
            target = load[peaks[0]] - 1e-3 * (load[peaks[0]] - load[peaks[0] :].min())
            found = inversion.separations_at(problem.with_groups(np.array([i])), np.array([[target]])).h.item()
            assert h[peaks[0]] <= found <= h[peaks[0]] + 0.1
            tried += 1
    assert tried > 5


@pytest.mark.parametrize("theta", (0.5, 3.0, 40.0))
def test_loads_near_the_largest_tension(theta):
    contact, model = st.Indices(theta=theta, lam=50.0), {"branch": "unloading"}
    one = st.solve(contact, load=0.01, **model)
    tension, where = float(one["pull_off_force"]), float(one["pull_off_separation"])
    share = np.array([0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.5])
    found = st.solve(contact, load=-tension * (1.0 - share), **model)
    h = found["mean_separation"].values
    assert (h <= where + 1e-7).all() and (np.diff(h) <= 1e-7).all()
    assert abs(found["load_residual"]).max() < 1e-12
    # by the curvature there, load = -tension + curvature (h - where)^2 / 2
    around = st.solve(contact, separation=where + np.array([-1e-3, 0.0, 1e-3]), **model)["load"].values
    curvature = np.diff(around, 2).item() / 1e-6
    assert_allclose(where - h[2:5], np.sqrt(2.0 * share[2:5] * tension / curvature), rtol=0.05, atol=3e-8)
    with refusal("load"):
        st.solve(contact, load=-tension * (1.0 + 1e-9), **model)


@pytest.mark.parametrize("model", ("soft_coating_2015", "greenwood_williamson_1966", "bush_gibson_thomas_1975"))
def test_loads_far_below_and_above_what_is_typical(model):
    contact = st.Indices(theta=100.0, lam=10.0, roughness_parameter=0.05)
    loads = np.array([1e-14, 1e-12, 1e-6, 1e-2, 1.0])
    found = st.solve(contact, load=loads, model=model)
    h = found["mean_separation"].values
    assert (np.diff(h) < 0.0).all() and abs(found["load_residual"]).max() < 1e-12
    for x, load in zip(h, loads, strict=True):
        assert_allclose(float(st.solve(contact, separation=x, model=model)["load"]), load, rtol=1e-12)
    with refusal("load", "1e+12"):
        st.solve(contact, load=[1e-2, 1e12], model=model)


def test_more_than_ten_thousand_contacts_at_one_load_each():
    count = 10_050
    theta = np.geomspace(1.0, 1e3, count)
    load = np.geomspace(1e-6, 1.0, count)
    many = st.Indices(theta=xarray.DataArray(theta, dims="contact"), lam=20.0)
    found = st.solve(many, load=xarray.DataArray(load, dims="contact"))
    assert found["mean_separation"].dims == ("contact",)
    for i in (0, 255, 256, 9_999, 10_000, count - 1):  # at the ends of blocks
        one = st.solve(st.Indices(theta=theta[i], lam=20.0), load=load[i])
        for name in ("mean_separation", "contact_area", "friction_force", "pull_off_force", "pull_off_separation"):
            assert_allclose(found[name][i], one[name], rtol=1e-12, err_msg=name)
    load[10_020] = -1.0
    with pytest.raises(st.InputError) as many_refused:
        st.solve(many, load=xarray.DataArray(load, dims="contact"))
    with pytest.raises(st.InputError) as one_refused:
        st.solve(st.Indices(theta=theta[10_020], lam=20.0), load=-1.0)
    assert str(many_refused.value) == str(one_refused.value)


LAWS = (
    {"model": "soft_coating_2015", "branch": "unloading"},
    {"model": "fuller_tabor_1975"},
    {"model": "rough_dmt"},
    {"model": "kogut_etsion_2004"},
    {"model": "greenwood_williamson_1966", "asperity": "thornton_ning_1998"},
    {"model": "soft_coating_2015", "variant": "published"},
)


@pytest.mark.parametrize("laws", LAWS, ids=lambda laws: "-".join(laws.values()))
def test_the_quick_way_and_the_robust_one_agree(monkeypatch, laws):
    rng = np.random.default_rng(8)
    count = 200
    draw = {"theta": 10.0 ** rng.uniform(-2.0, 6.0, count), "lam": 10.0 ** rng.uniform(-1.0, 4.0, count)}
    contacts = st.Indices(**{name: xarray.DataArray(values, dims="contact") for name, values in draw.items()}, nu=0.3)
    load = xarray.DataArray(10.0 ** rng.uniform(-12.0, -2.0, (count, 2)), dims=("contact", "asked"))
    quick = st.solve(contacts, load=load, **laws)
    monkeypatch.setattr(inversion, "_of_block", lambda *given: (inversion._robustly(*given), None))
    robust = st.solve(contacts, load=load, **laws)
    assert_allclose(quick["mean_separation"], robust["mean_separation"], rtol=1e-12, atol=1e-12)
    assert_allclose(quick["contact_area"], robust["contact_area"], rtol=1e-11)
    assert_allclose(quick["pull_off_force"], robust["pull_off_force"], rtol=1e-12)
    assert_allclose(quick["pull_off_separation"], robust["pull_off_separation"], atol=1e-6)  # a minimum, found by its value


def test_films_are_found_from_nodes_too():
    contact = st.Indices(theta=40.0, lam=10.0, n_E=0.5, n_H=0.4, tau=2.0)
    found = st.solve(contact, load=[1e-8, 1e-3, 0.5])
    assert int(found.attrs["convergence"].split()[-2]) <= 4  # not the dozen of a bracketed search
    again = st.solve(contact, separation=found["mean_separation"].values)
    assert_allclose(again["load"], found["load"], rtol=1e-12)


CURVES = (bush_gibson_thomas_1975, greenwood_2006, ciavarella_greenwood_paggi_2008, hariri_zu_ben_mrad_2006)


@pytest.mark.parametrize("module", CURVES, ids=lambda module: module.RECORD.key)
def test_theories_in_closed_form_at_loads(module):
    """Against a bracketed root of the theory's own curve, one contact and one load at a time; and the first guess is near."""
    rng, count = np.random.default_rng(2), 40
    least, largest = getattr(module, "LEAST_DENSITY", moments.LEAST_DENSITY), getattr(module, "LARGEST_DENSITY", 10.0)
    density = np.exp(rng.uniform(np.log(least * 1.001), np.log(largest * 0.999), count))
    ones = np.ones(count)
    groups = Groups(
        theta=100.0 * ones, lam=10.0 * ones, nu=0.3 * ones, hardness_to_yield=2.8 * ones, K_beta=6.4762 * ones,
        roughness_parameter=density, sharpness=0.03 * ones, nominal_width=30.0 * ones,
    )  # fmt: skip
    load = 10.0 ** rng.uniform(-20.0, -2.5, (count, 2))
    problem = problem_of(groups, Choice(module.RECORD.key))
    found = inversion.separations_at(problem, load)
    assert_allclose(problem.near(load), found.h, atol=0.02)  # largest just below a maximum of the load, where it is flat
    assert np.abs(found.residual).max() < 1e-13 and found.evaluations < 7
    for i in range(count):
        for k in range(2):
            excess = lambda h, i=i, k=k: np.log(module.curve(np.array([h]), groups[i : i + 1])[0].item() / load[i, k])  # noqa: E731
            assert_allclose(found.h[i, k], brentq(excess, found.h[i, k] - 0.1, found.h[i, k] + 0.1, xtol=1e-14), atol=1e-11)


def test_a_theory_in_closed_form_refuses_what_it_carries_nowhere():
    contact = st.Indices(theta=xarray.DataArray([100.0, 200.0, 300.0], dims="contact"), lam=10.0, roughness_parameter=0.05)
    load = xarray.DataArray([0.01, 1e-3, 1e4], dims="contact")
    with refusal("load", "10000"):
        st.solve(contact, load=load, model="bush_gibson_thomas_1975")
    for beyond in (1e-100, 1e6, 1e300):  # and of the tables, too
        refused = refusal("load") if beyond > 1.0 else nullcontext()
        with np.errstate(divide="raise", invalid="raise"), refused:
            one = st.solve(st.Indices(theta=100.0, lam=10.0, roughness_parameter=0.05), load=beyond, model="greenwood_2006")
            assert abs(float(one["load_residual"])) < 1e-12
    with refusal("load", "0"):
        st.solve(contact, load=0.0, model="greenwood_2006")


@pytest.mark.parametrize(("asperity", "covers"), [("hertz", True), ("dmt", False)])
def test_an_approach_covered_ends_with_more_load_than_tension(asperity, covers):
    """The grid ends at h = -8. There all DMT asperities of theta = 0.27 touch: 8^1.5 + 3/8 8^-0.5 - 2 pi/0.27 = -0.51."""
    choice = Choice("rough_dmt") if asperity == "dmt" else Choice("greenwood_williamson_1966")
    tension, _, whole = problem_of(groups(theta=0.27, lam=10.0), choice).approach.lowest
    assert whole.tolist() == [covers] and (tension > 0.51).tolist() == [not covers]


@pytest.mark.parametrize("x", (-20.0, -3.0, 0.0, 2.5, 9.0, 30.0))
def test_lone_spheres_have_this_separation(x):
    peak = max(-x, 0.0)
    load, _ = quad(
        lambda w: w**1.5 * math.exp(-0.5 * w * (w + 2.0 * x)), 0.0, peak + 12.0, epsabs=0.0, points=[peak, peak / 2.0]
    )
    load *= math.exp(-x * x / 2.0) / math.sqrt(2.0 * math.pi)
    assert_allclose(lone_separation(np.array([[load]])), x, atol=1e-6)
