"""Soft smooth bodies that adhesion presses flat: mu = tau_0 A_n/P, in place of no answer."""

import math

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.case.read import parse_case
from stiction.contact.indices import Groups
from stiction.laws.criterion.persson_tosatti_2001 import elastic_over_adhesion, energy_ratio, wavevector_sum
from stiction.laws.rough_surface.persson_tosatti_2001 import area_at_load
from stiction.laws.validity import warnings_of
from stiction.studies.comparison.criteria import criteria_of
from tables import column, groups, read

PDMS, GLASS = {"youngs_modulus": "2 MPa", "poissons_ratio": 0.49, "hardness": "1 MPa"}, "soda_lime_glass"


def contact(deviation="5 nm", radius="10 um", density="1e12 1/m^2", **more):
    rough = {"asperity_height_deviation": deviation, "asperity_radius": radius, "asperity_density": density}
    given = {"first": PDMS, "second": GLASS, "nominal_area": "1 mm^2", "work_of_adhesion": "50 mJ/m^2"}
    return st.Contact(**given | more, roughness=rough, interfacial_shear_strength="100 kPa")


def ratio_of(given):
    return float(elastic_over_adhesion(Groups.of(given.indices())[0])[0])


@pytest.mark.parametrize("load", (1e-3, 1e-2, 1e-1))
def test_full_contact_is_answered(load):
    """100 kPa on a square millimetre are 0.1 N."""
    data = st.compare(contact(), load=load)
    best = data.sel(model="persson_tosatti_2001")
    assert float(best["friction_coefficient_at_load"]) == pytest.approx(0.1 / load, rel=1e-12)
    assert float(best["contact_area_at_load"]) == pytest.approx(1e-6, rel=1e-12)


def test_energy_of_waves_of_one_length():
    """Summits of waves of one length, alpha = 3/2: the bound is the energy, E* q h^2/4 with q^2 = m4/m2 4/3, in SI units."""
    R, sigma, E, w = 10e-6, 20e-9, 2e6 / (1.0 - 0.49**2), 0.05
    deficit = 1.0 + 16.0 / math.pi - 3.0 * math.sqrt(3.0)
    m4 = 9.0 * math.pi / (64.0 * R * R)
    m0 = sigma**2 / (1.0 - deficit / 1.5)
    m2 = math.sqrt(m0 * m4 / 1.5)
    q = math.sqrt(4.0 / 3.0 * m4 / m2)
    assert q * math.sqrt(m0) == pytest.approx(math.sqrt(2.0 * m2), rel=1e-12)
    density = m4 / m2 / (6.0 * math.pi * math.sqrt(3.0))
    rigid = {"youngs_modulus": 1e20, "poissons_ratio": 0.3, "hardness": 1e18}
    given = contact(sigma, R, density, second=rigid, work_of_adhesion=w)
    assert ratio_of(given) == pytest.approx(E * q * m0 / 4.0 / w, rel=1e-9)


def test_what_stays_partial_is_refused():
    with refusal("work_of_adhesion", "4.98"):
        st.solve(contact("2 um", "20 um", "2e9 1/m^2"), load=1e-3, model="persson_tosatti_2001")
    steel = st.compare(contact(first="copper", second="copper"), load=1e-2)
    assert "persson_tosatti_2001: " in steel.attrs["not_applicable"]


def test_full_contact_needs_less_energy_than_adhesion_gains():
    """U/gamma < 1 is strict: with equal energies nothing holds the faces together."""
    density = np.linspace(0.03, 0.08, 9)
    theta = 1.0 / elastic_over_adhesion(groups(theta=1.0, roughness_parameter=density, sharpness=0.03))
    given = groups(theta=np.outer([1.0, 0.5], theta).ravel(), roughness_parameter=np.tile(density, 2), sharpness=0.03)
    equal, less = elastic_over_adhesion(given) == 1.0, elastic_over_adhesion(given) < 1.0
    area = area_at_load(np.ones((18, 1)), given)[:, 0]
    assert equal.sum() > 3 and np.isnan(area[equal]).all()
    np.testing.assert_allclose(area[less], 1.0 / (math.pi * np.tile(density, 2)[less]), rtol=1e-14)


def test_between_faces_may_need_a_load():
    """Johnson (1995): waves of one length jump into contact by themselves for U/gamma below 0.49."""
    sigmas = np.geomspace(5e-9, 2e-6, 20)
    kinds = set()
    for sigma in sigmas:
        given = contact(float(sigma), "10 um", 0.04 / (1e-5 * sigma))
        try:
            found = st.solve(given, load=1e-3, model="persson_tosatti_2001")
        except st.InputError:
            kinds.add("refused")
            continue
        ratio = ratio_of(given)
        said = "elastic_over_adhesion" in {one.quantity for one in warnings_of(found)}
        assert said == (ratio > 0.49)
        kinds.add(said)
    assert kinds == {"refused", True, False}


def test_energies_in_si_units():
    rows = read("persson_tosatti_2001.csv")
    given = groups(**{name: column(rows, name) for name in ("theta", "roughness_parameter")}, lam=1.0)
    np.testing.assert_allclose(elastic_over_adhesion(given), column(rows, "ratio"), rtol=1e-12)


def test_effective_work_of_adhesion_in_si_units():
    rows = read("effective_adhesion.csv")
    names = ("theta", "roughness_parameter", "sharpness")
    given = groups(**{name: column(rows, name) for name in names}, lam=1.0)
    ratio = energy_ratio(given)
    np.testing.assert_allclose(ratio, column(rows, "ratio"), rtol=1e-12)
    gain = elastic_over_adhesion(given) / ratio
    np.testing.assert_allclose(gain * (1.0 - ratio), column(rows, "effective"), rtol=1e-11)


@pytest.mark.parametrize("ratio", (1.01, 10.0, 1e3))
def test_the_bound_is_above_the_energy(ratio):
    """By up to a factor of three, of self-affine surfaces with C ~ q^-3.6 from q to this times q, all in closed form."""

    def moment(order):
        return (ratio ** (order - 1.6) - 1.0) / (order - 1.6)

    assert 0.3 < moment(1) / math.sqrt(moment(0) * moment(2)) <= 1.0


def test_effective_work_of_adhesion_of_waves_of_one_length():
    """The numbers of the criterion's docstring: gamma_eff = gamma (1 + h'^2/2) (1 - r) = 45.25 mJ/m^2, all in SI units."""
    heights, slope, energy, work = 0.1e-6, 0.1, 2e6 * 0.1e-6 * 0.1 / 4.0, 0.05
    alpha = 1.5  # m0 m4/m2^2, with m0 = heights^2 and 2 m2 = slope^2: summits of these waves by Nayak and McCool
    m2 = slope**2 / 2.0
    m4 = alpha * m2 * m2 / heights**2
    R, density = 3.0 / 8.0 * math.sqrt(math.pi / m4), m4 / m2 / (6.0 * math.pi * math.sqrt(3.0))
    sigma = heights * math.sqrt(1.0 - (1.0 + 16.0 / math.pi - 3.0 * math.sqrt(3.0)) / alpha)
    rigid = {"youngs_modulus": 1e20, "poissons_ratio": 0.3, "hardness": 1e18}
    soft = {"youngs_modulus": 2e6 * (1.0 - 0.49**2), "poissons_ratio": 0.49, "hardness": "1 MPa"}
    given = contact(sigma, R, density, first=soft, second=rigid, work_of_adhesion=work)
    ratio = float(energy_ratio(Groups.of(given.indices())[0])[0])
    effective = work * (1.0 + slope**2 / 2.0) - energy
    assert work * (1.0 + slope**2 / 2.0) * (1.0 - ratio) == pytest.approx(effective, rel=1e-9)
    assert effective == pytest.approx(45.25e-3, rel=1e-12) and ratio == pytest.approx(0.0995, abs=5e-5)


def rough_map(periodic=True):
    spectrum = st.SelfAffine(hurst=0.8, rolloff="5 um", shortest="300 nm", deviation="200 nm")
    surface = st.gaussian_surface((128, 128), ("10 um", "10 um"), spectrum, seed=3)
    return st.HeightMap(surface.heights, (10e-6, 10e-6), periodic=periodic)


def sum_over_waves(surface):
    """The sum of |q| times the mean square height over all waves: by NumPy's transform in SI units."""
    power = np.abs(np.fft.fft2(surface.heights - surface.heights.mean())) ** 2 / surface.heights.size**2
    along = 2.0 * math.pi * np.fft.fftfreq(128, 10e-6 / 128)
    return (np.hypot(along[:, None], along) * power).sum()


def test_a_map_has_the_energy_of_its_waves():
    surface = rough_map()
    expected = sum_over_waves(surface)
    assert wavevector_sum(surface) == pytest.approx(expected, rel=1e-12)
    assert wavevector_sum(rough_map(periodic=False)) == pytest.approx(expected, rel=0.05)  # windowed
    wave = np.tile(np.cos(6.0 * math.pi * np.arange(32) / 32), (32, 1)) * 1e-8
    of_one_length = wavevector_sum(st.HeightMap(wave, (1e-6, 1e-6), periodic=True))
    assert of_one_length == pytest.approx(3 * 2.0 * math.pi / 1e-6 * 0.5e-16, rel=1e-12)  # three waves in 1 um


def test_scans_give_the_energy_and_numbers_its_bound(tmp_path):
    """A contact that the bound refuses is answered if the spectrum of its scan stores less energy than gained."""
    np.save(tmp_path / "scan.npy", rough_map().heights)
    scan = {"file": str(tmp_path / "scan.npy"), "size": "10 um", "height_unit": "m", "periodic": True}
    table = {"first": PDMS, "second": GLASS, "nominal_area": "1 mm^2", "interfacial_shear_strength": "100 kPa"}
    table |= {"work_of_adhesion": "60 mJ/m^2", "roughness": {"first": scan}}
    by_scan = parse_case({"contact": table, "solve": {"load": "1 mN"}}).subject
    by_numbers = by_scan.replace(roughness=by_scan.roughness.as_numbers())
    whole = by_scan.with_surface_moments()
    groups = Groups.of(whole.indices())[0]
    ratio, bound = (float(elastic_over_adhesion(groups, surface)[0]) for surface in (whole.map, None))
    glass = st.material(GLASS)
    modulus = 1.0 / ((1.0 - 0.49**2) / 2e6 + (1.0 - glass.poissons_ratio**2) / glass.youngs_modulus)
    assert ratio < 1.0 < bound
    assert ratio == pytest.approx(
        modulus / 4.0 * sum_over_waves(rough_map()) / 60e-3, rel=1e-3
    )  # asperities are counted after levelling
    data = st.solve(by_scan, load="1 mN", model="persson_tosatti_2001")
    assert float(data["contact_area"]) == pytest.approx(1e-6, rel=1e-12)
    (said,) = (one for one in warnings_of(data) if one.quantity == "elastic_over_adhesion")
    assert said.most == pytest.approx(ratio, rel=1e-9)
    with refusal("work_of_adhesion"):
        st.solve(by_numbers, load="1 mN", model="persson_tosatti_2001")
    lines = [line for subject in (by_scan, by_numbers) for line in criteria_of(subject) if line.startswith("persson_tosatti")]
    assert "full contact needs no load" in lines[0] and "not in full contact" in lines[1]
