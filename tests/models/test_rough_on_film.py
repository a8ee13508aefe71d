"""The area law of a surface on a film: against its equations solved by other means, solved maps, and closed limits."""

import csv
import importlib
import math
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.special import erf

import stiction as st
from refusals import refusal
from stiction.contact.indices import Groups
from stiction.laws.rough_surface import persson_2001
from stiction.laws.rough_surface.rough_on_film import area_at_load, area_on_map, thickness_over_wave, waves_of_moments
from stiction.laws.validity import warnings_of
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.theory.moments import bandwidth, density_of_bandwidth, slope_over_sharpness
from tables import column, groups, read

TRUTH = Path(__file__).parents[2] / "truth"
LAW = "rough_on_film"


def share_of(pressure, hardness, density, **film):
    """A/A_n (n,) at pressures and with a film's hardness over E* h'; film: other groups of the film and the bodies."""
    density, hardness = np.asarray(density, dtype=float), np.asarray(hardness, dtype=float)
    slope = slope_over_sharpness(density)
    eta = 0.75 * math.pi * hardness * slope  # H/(E* h') = (4/3) eta/pi/slope
    given = groups(roughness_parameter=density, hardness_group=eta, n_H=1.0, tau=1.0, **film)
    load = np.asarray(pressure) * slope / (4.0 / 3.0 * density)
    return area_at_load(np.broadcast_to(load, len(given))[:, None], given)[:, 0] * math.pi * density


def test_equations():
    """The sphere of another solution of the integral equation, another sum over the spectrum, bisection: to 0.2 %."""
    rows = read("rough_on_film.csv")
    film = {name: column(rows, name) for name in ("n_E", "film_nu", "nu", "film_aspect")}
    found = share_of(*(column(rows, name) for name in ("pressure", "hardness", "density")), **film)
    assert_allclose(found, column(rows, "area"), rtol=2e-3)


@pytest.mark.parametrize("density", [0.033, 0.05, 0.2, 1.0])
def test_spectrum_has_the_moments(density):
    """Nayak's alpha and the number of summits, from the integrals of a power of the wavevector by quadrature."""
    k = waves_of_moments(np.array([density])).wavevector[0]
    t = np.polynomial.legendre.leggauss(len(k))[0]
    log_ratio = math.log(k[-1] / k[0]) * 2.0 / (t[-1] - t[0])
    highest = k[-1] / math.exp(0.5 * (t[-1] - 1.0) * log_ratio)
    lowest = highest * math.exp(-log_ratio)
    ends = math.log(lowest), math.log(highest)
    m0, m2, m4 = (quad(lambda log, n=n: math.exp(log * (n - 1.6)), *ends)[0] for n in (0, 2, 4))
    assert 1.5 * m0 * m4 / m2**2 == pytest.approx(bandwidth(density), rel=1e-3)
    assert 0.75 * m4 / m2 == pytest.approx(6.0 * math.pi * math.sqrt(3.0) * density, rel=1e-3)


def test_a_soft_film_bears_its_hardness_and_not_that_of_the_bodies():
    """A = P/H of the film, the elastic area being a tenth of it, and so less than 1e-3 of it beside."""
    film = {"youngs_modulus": 100e9, "poissons_ratio": 0.3, "hardness": 20e6}
    steel = {"youngs_modulus": 200e9, "poissons_ratio": 0.3, "hardness": 8e9}
    rough = {"asperity_height_deviation": 50e-9, "asperity_radius": 50e-6, "asperity_density": 1.6e10}
    contact = st.Contact(
        first=steel, second=steel, roughness=rough, nominal_area=1e-6, coating={"material": film, "thickness": 200e-9}
    )
    found = st.solve(contact, load=0.5, model=LAW)
    assert float(found["contact_area"]) == pytest.approx(0.5 / 20e6, rel=1e-3)


def bare(pressure, density):
    """Persson's area, widened."""
    c = 0.617 - 0.041 * math.log(bandwidth(density))
    return erf(math.sqrt(2.0) * pressure * (1.0 + c * (1.0 - math.sqrt(erf(math.sqrt(2.0) * pressure)))))


@pytest.mark.parametrize(
    ("film", "modulus"),
    [
        ({"n_E": 1.0, "film_aspect": 0.7}, 1.0),
        ({"n_E": 7.0, "film_aspect": 1e-13}, 1.0),
        ({"n_E": 7.0, "film_aspect": 1e13}, 7.0),
        ({"n_E": 0.2, "film_aspect": np.inf}, 0.2),
        ({"n_E": 0.2, "film_aspect": 0.0}, 1.0),
    ],
)
def test_limits(film, modulus):
    """No film, nothing but film, a film like its body: the bare law with that modulus; and what hardness alone makes of it."""
    for pressure in (0.003, 0.05, 0.4):
        assert share_of(pressure, 1e12, 0.06, **film)[0] == pytest.approx(bare(pressure / modulus, 0.06), rel=1e-5)
    assert share_of(0.5, 0.5, 0.06, **film)[0] == 1.0
    assert share_of(0.003, 0.0031, 0.06, **film)[0] == pytest.approx(3.0 / 3.1, rel=0.02)


def test_splitting_a_film_changes_nothing():
    """One film on a rigid counterbody's other side: two halves on like bodies are one whole of each against a rigid plane."""
    one = share_of(0.05, 1.0, 0.06, n_E=3.0, film_aspect=0.8, coated_share=1.0)
    two = share_of(0.05, 1.0, 0.06, n_E=3.0, film_aspect=1.6, films=2.0, coated_share=0.5)
    assert_allclose(one, two, rtol=1e-12)


def solved_films():
    with (TRUTH / "films.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name] or 1e12) for row in rows]) for name in rows[0]}


@pytest.fixture
def films(monkeypatch):
    """The script that made the maps."""
    monkeypatch.syspath_prepend(str(TRUTH))
    return importlib.import_module("films")


def in_units(found):
    """N R sigma of Gaussian maps of this alpha and t/sqrt(R sigma), where the thickness is over the shortest wave."""
    density = density_of_bandwidth(found["alpha"])
    unit = thickness_over_wave(groups(roughness_parameter=density, n_E=1.0, n_H=1.0, tau=1.0, film_aspect=1.0, films=1.0))
    return density, found["thickness"] / unit


def test_solved_maps():
    """Area within 10 % of layered boundary elements on 90 % of 630 solutions, from alpha alone: film moduli of .1 to 10,
    thickness .15 to 5 of the shortest wave, p/(E* h') .01 to .2, elastic and with hardness."""
    found = solved_films()
    density, aspect = in_units(found)
    film = {"n_E": found["modulus"], "film_nu": found["nu"], "nu": found["nu_below"], "film_aspect": aspect}
    area = share_of(found["pressure"], found["hardness"], density, **film)
    off = np.abs(area / found["area"] - 1.0)
    hard = found["hardness"] < 1e3
    assert len(off) == 630 and hard.sum() == 150
    assert np.mean(off[~hard] < 0.1) > 0.9 and np.mean(off[hard] < 0.1) > 0.98
    assert np.sqrt(np.mean(off**2)) < 0.06 and off.max() < 0.3
    # without the film it would not do: the bodies alone, and the film alone
    for blind in ({"n_E": np.ones_like(aspect)}, {"film_aspect": np.full_like(aspect, np.inf)}):
        other = share_of(found["pressure"], found["hardness"], density, **film | blind)
        assert np.mean(np.abs(other / found["area"] - 1.0)[~hard] < 0.1) < 0.6


def test_a_solution_again(films):
    """One row of the table solved anew: map, film and pixels are what the table says."""
    found = solved_films()
    at = 3 * 5 + 1
    row = {name: float(values[at]) for name, values in found.items()}
    one = films.surface(row["hurst"], row["rolloff"], row["longest"], int(row["seed"]))
    given = [row[name] for name in ("modulus", "thickness", "nu", "nu_below")]
    ((area, counted),) = films._solved(one, films.GRADIENT, *given, None, [row["pressure"]])
    assert area == pytest.approx(row["area"], rel=2e-3) and counted == pytest.approx(row["counted"], rel=2e-3)


def test_a_map_by_its_own_spectrum(films):
    """One of them, nearer than by its moments."""
    found = solved_films()
    one = found["seed"] == 4003.0
    found = {name: values[one] for name, values in found.items()}
    surface = films.surface(0.3, 8.0, 8.0, 4003)
    density, aspect = in_units(found)
    slope = slope_over_sharpness(density)
    given = groups(
        roughness_parameter=density, sharpness=films.GRADIENT / slope, n_H=1.0,
        hardness_group=0.75 * math.pi * found["hardness"] * slope, tau=1.0, n_E=found["modulus"], film_nu=found["nu"],
        nu=found["nu_below"], film_aspect=aspect,
    )  # fmt: skip
    load = (found["pressure"] * slope / (4.0 / 3.0 * density))[:, None]
    off, by_moments = (
        np.log(area[:, 0] * math.pi * density / found["area"])
        for area in (area_on_map(load, given, surface), area_at_load(load, given))
    )
    assert np.mean(np.abs(off) < 0.1) > 0.95 and np.sqrt(np.mean(off**2)) < 0.7 * np.sqrt(np.mean(by_moments**2))


def test_a_scan_with_a_film(films):
    """It is asked of the map where the contact names one, with lengths in metres: against that map and film solved."""
    surface = films.surface(0.8, 6.0, 6.0, 4000)
    scale = 1e-7
    surface = surface.with_heights(surface.heights * scale, "in metres", tuple(scale * side for side in surface.size))
    film = {"youngs_modulus": 20e9, "poissons_ratio": 0.3, "hardness": 1e13}
    body, rigid = film | {"youngs_modulus": 100e9}, film | {"youngs_modulus": 1e18}
    contact = st.Contact(
        first=body, second=rigid, roughness=surface, nominal_area=surface.size[0] * surface.size[1],
        coating={"material": film, "thickness": 0.7 * scale, "bodies": "first"},
    )  # fmt: skip
    load = 0.05 * 100e9 / 0.91 * films.GRADIENT * contact.nominal_area
    found = st.solve(contact, load=load, model=LAW)
    assert "spectrum" in found.attrs["area_by"]
    solved = films._solved(surface, films.GRADIENT, 0.2, 0.7 * scale, 0.3, 0.3, None, [0.05])
    assert float(found["area_fraction"]) == pytest.approx(solved[0][0], rel=0.05)
    numbers = contact.replace(roughness=contact.with_surface_moments().roughness.replace())
    assert "moments" in st.solve(numbers, load=load, model=LAW).attrs["area_by"]


def test_warnings():
    """Thin stiff films, and moduli with which nothing was compared; a bare contact, tension and a film law are refused."""
    film = {"n_E": 8.0, "n_H": 1.0, "tau": 1.0, "film_aspect": 0.05, "roughness_parameter": 0.06}

    def quantities(**more):
        given = st.Indices(hardness_group=20.0, **film | more)
        return {one.quantity for one in warnings_of(st.solve(given, load=0.1, model=LAW))}

    assert "stiff_film_over_wave" in quantities() and "n_E" not in quantities()
    assert "stiff_film_over_wave" not in quantities(n_E=4.0) and "stiff_film_over_wave" not in quantities(film_aspect=1.0)
    assert "n_E" in quantities(n_E=20.0)
    for given, load, more, said in (
        (st.Indices(hardness_group=20.0, roughness_parameter=0.06), 0.1, {}, ("model",)),
        (st.Indices(hardness_group=20.0, **film), 0.1, {"film": "layered"}, ("film",)),
        (st.Indices(hardness_group=20.0, **film), -0.1, {}, ("load",)),
        (
            st.Indices(hardness_group=20.0, **film | {"roughness_parameter": 0.01}),
            0.1,
            {},
            ("roughness_parameter", "0.01", ">= 0.01581"),
        ),
    ):
        with refusal(*said):
            st.solve(given, load=load, model=LAW, **more)


def test_many_contacts_are_each_by_itself():
    """Chunks and broadcasting: the same numbers one by one."""
    rng = np.random.default_rng(3)
    given = groups(
        roughness_parameter=rng.uniform(0.035, 0.3, 50), hardness_group=rng.uniform(1.0, 50.0, 50),
        n_H=rng.uniform(0.2, 2.0, 50), n_E=10.0 ** rng.uniform(-1, 1, 50), film_aspect=10.0 ** rng.uniform(-1, 1, 50), tau=1.0,
    )  # fmt: skip
    load = rng.uniform(0.0, 2.0, (50, 7))
    whole = area_at_load(load, given)
    alone = np.concatenate([area_at_load(load[i : i + 1], given[i : i + 1]) for i in range(50)])
    assert_allclose(whole, alone, rtol=1e-12)
    assert (np.diff(area_at_load(np.sort(load, axis=1), given), axis=1) >= 0.0).all()
    assert isinstance(given, Groups) and persson_2001.RECORD.on_film is False


@pytest.mark.parametrize("decades", [4.0, 40.0])
def test_many_loads_are_each_by_itself(decades):
    """Many loads share an interpolated modulus, as far as it is accurate; one load does not; a load of 0 has no area."""
    n_E, aspect = (one.ravel() for one in np.meshgrid([0.02, 0.5, 30.0], [0.01, 0.3, 10.0]))
    given = groups(roughness_parameter=0.05, hardness_group=1e9, n_H=1.0, tau=1.0, n_E=n_E, film_aspect=aspect)
    load = np.broadcast_to(np.concatenate([[0.0], 10.0 ** np.linspace(-decades, 0.0, 40)]), (len(given), 41))
    alone = np.hstack([area_at_load(load[:, [at]], given) for at in range(41)])
    assert_allclose(area_at_load(load, given), alone, rtol=2e-13)
    assert (alone[:, 0] == 0.0).all() and (np.diff(alone) > 0.0).all()


def test_the_area_of_a_map_with_a_film_at_a_load_does_not_depend_on_the_other_loads():
    """Too few points touch at the lighter loads: the ratio to the area law is that of one pressure, whatever else is asked."""
    ky, kx = np.fft.fftfreq(64)[:, None] * 64, np.fft.rfftfreq(64)[None] * 64
    waves = np.hypot(ky, kx)
    power = np.where((waves >= 2.0) & (waves <= 10.0), np.maximum(waves, 1.0) ** -1.8, 0.0)
    heights = np.fft.irfft2(np.fft.rfft2(np.random.default_rng(3).normal(size=(64, 64))) * power, s=(64, 64))
    surface = HeightMap(20e-9 * heights / heights.std(), (1e-5, 1e-5), periodic=True)
    film = st.Coating(material="diamond_like_carbon", thickness="500 nm", bodies="first")
    contact = st.Contact(first="silicon", second="silicon", roughness=surface, nominal_area=1e-10, coating=film)
    loads = [1e-5, 1e-4, 1e-3, 2e-2]
    together = st.solve(contact, load=loads, model=LAW, tangential="none").contact_area.values
    alone = [st.solve(contact, load=load, model=LAW, tangential="none").contact_area.item() for load in loads]
    assert alone == pytest.approx(list(together), rel=1e-9)
