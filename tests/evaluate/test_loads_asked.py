"""solve at loads: they are the loads of the result, and friction is compared to them, not to what a search makes of them."""

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose, assert_array_equal
from scipy.special import gamma

import stiction as st
from stiction.engine.heights import height_distribution
from stiction.solving import inversion

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
    data = st.solve(ADHESIVE, load=load)
    assert_array_equal(np.isfinite(data["friction_coefficient"]), [False, False, True])
    assert_array_equal(data["load"], [-1e-3, 0.0, 1.0])
    assert (data["friction_force"] > 0.0).all()
    assert abs(data["load_residual"]).max() < 1e-12


@pytest.mark.parametrize("contact", (ADHESIVE, INDICES))
def test_one_load_of_nothing(contact):
    data = st.solve(contact, load=0.0)
    assert float(data["load"]) == 0.0 and np.isnan(float(data["friction_coefficient"]))


def test_of_many_contacts_too():
    contacts = st.Indices(theta=st.axis("theta", [2.0, 3.0, 4.0]), lam=100.0)
    data = st.solve(contacts, load=[-1e-4, 0.0, 1e-3])
    assert data["friction_coefficient"].dims == ("theta", "load")
    assert_array_equal(np.isfinite(data["friction_coefficient"]), np.tile([False, False, True], (3, 1)))


def test_a_tiny_load_is_what_friction_is_compared_to():
    data = st.solve(ADHESIVE, load="1e-20 N")
    nothing = st.solve(ADHESIVE, load="0 N")
    assert_allclose(float(data["friction_coefficient"]), float(nothing["friction_force"]) / 1e-20, rtol=1e-12)


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
    with pytest.raises(st.InputError, match="'0'; allowed: more than 0 under this model"):
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
    monkeypatch.setattr(inversion, "_AT_ONCE", 5)
    parts = st.solve(st.Indices(theta=thetas, lam=30.0), load=[1e-3, 0.1])
    for name in whole.data_vars:
        if name != "load_residual":
            assert_allclose(parts[name], whole[name], rtol=1e-9, err_msg=name)
    with pytest.raises(st.InputError, match="at most"):
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
    with pytest.raises(st.InputError, match="load: '-1 mN'; allowed: 0 or more: persson_2001"):
        st.solve(ADHESIVE, load="-1 mN", model="persson_2001")
