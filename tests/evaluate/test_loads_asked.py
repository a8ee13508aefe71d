"""solve at loads: they are the loads of the result, and friction is compared to them, not to what a search makes of them."""

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose, assert_array_equal
from scipy.special import gamma

import stiction as st
from stiction.heights import height_distribution

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
