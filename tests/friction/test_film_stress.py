"""`st.film_stresses`: the mean asperity of a contact in SI, by hand; validity warnings; what is refused."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import stiction as st
from refusals import refusal
from stiction.laws.tangential.shared.hamilton_field import stress
from stiction.laws.validity import warnings_of
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.first_yield import at_interface, first_yield
from stiction.solvers.layered.stresses import Stresses, cartesian
from stiction.solvers.layered.waves import CoatedBody

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3, "hardness": 7e9}
RIGID = {"youngs_modulus": 1e18, "poissons_ratio": 0.3, "hardness": 1e13}
ROUGH = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
LAWS = {"model": "greenwood_williamson_1966", "asperity": "chang_etsion_bogy_1987", "tangential": "bowden_tabor_1943"}


def coated(film, thickness, shear_strength):
    coating = st.Coating(material=film, thickness=thickness, bodies="first")
    return st.Contact(first=STEEL, second=RIGID, nominal_area="1 mm^2", roughness=ROUGH, coating=coating,
                      interfacial_shear_strength=shear_strength)  # fmt: skip


@pytest.mark.parametrize("modulus", [20e9, 800e9])
def test_the_mean_asperity_by_hand(modulus):
    film, t = {"youngs_modulus": modulus, "poissons_ratio": 0.25, "hardness": 5e9}, 400e-9
    found = st.film_stresses(coated(film, t, "150 MPa"), load=["0.1 N", "2 N"], **LAWS)
    ratio = modulus / (1 - 0.25**2) / (210e9 / (1 - 0.3**2))
    body = CoatedBody(ratio, 0.25, 0.3)
    for at in range(2):
        one = found.isel(load=at) if "load" in found.dims else found.isel({found["load"].dims[0]: at})
        n = float(one["touching_asperities"])
        area, load, friction = (float(one[name]) / n for name in ("contact_area", "load", "friction_force"))
        radius = math.sqrt(area / math.pi) / t
        assert float(one["contact_over_thickness"]) == pytest.approx(radius, rel=1e-9)
        stresses = Stresses((Layer.of(1.0, ratio, 0.25, 0.3),), body, radius)
        pressure, strengths = load / area, (5e9 / 2.8, 7e9 / 2.8)
        first = first_yield(stresses, friction / load, strengths[0] / strengths[1])
        assert str(one["yields_first"].values) == first.where
        assert float(one["stress_over_yield"]) == pytest.approx(pressure * first.excess / strengths[1], rel=1e-5)
        tension, shear = at_interface(stresses, friction / load)
        assert float(one["interface_tension"]) == pytest.approx(pressure * tension / strengths[0], rel=1e-5)
        assert float(one["interface_shear"]) == pytest.approx(pressure * shear * math.sqrt(3) / strengths[0], rel=1e-5)


@pytest.mark.parametrize("traction", [0.0, 0.4, 2.0])
def test_at_the_interface_by_a_search(traction):
    """Of like materials by Hamilton's stresses on the plane z = t; of unlike ones at all angles."""
    x, y = np.meshgrid(np.linspace(-3.0, 3.0, 401), np.linspace(0.0, 3.0, 201))
    for radius in (0.7, 2.0, 8.0):
        whole = Stresses((Layer.of(1.0, 1.0, 0.3, 0.3),), CoatedBody(1.0, 0.3, 0.3), radius)
        _, _, zz, _, yz, xz = stress(x, y, np.full(x.shape, 1.0 / radius), traction, 0.3)
        tension, shear = at_interface(whole, traction)
        assert tension == pytest.approx(1.5 * max(zz.max(), 0.0), rel=2e-2, abs=2e-3)
        assert shear == pytest.approx(1.5 * np.hypot(yz, xz).max(), rel=1e-2)
        stiff = Stresses((Layer.of(1.0, 9.0, 0.2, 0.3),), CoatedBody(9.0, 0.2, 0.3), radius)
        r, at = np.linspace(0.0, 3.0, 401), np.array([1.0 / radius])
        radial = stiff.in_film(r, at)
        fields = [cartesian(radial, np.full(r.size, theta), traction) for theta in np.linspace(0.0, math.pi, 25)]
        tension, shear = at_interface(stiff, traction)
        assert tension == pytest.approx(max(max(one[2].max() for one in fields), 0.0), rel=2e-2, abs=2e-3)
        assert shear == pytest.approx(max(np.hypot(one[4], one[5]).max() for one in fields), rel=1e-2)


def test_warnings():
    """A weak film on steel under a heavy load: it flows, and its bond bears more than it does. A strong one of no stress:
    neither."""
    weak = {"youngs_modulus": 200e9, "poissons_ratio": 0.3, "hardness": 0.2e9}
    found = st.film_stresses(coated(weak, 300e-9, "100 MPa"), load="1 N", **LAWS | {"asperity": "hertz"})
    said = {warning.quantity for warning in warnings_of(found)}
    assert {"stress_over_yield", "interface_shear"} <= said
    assert float(found["interface_shear"]) > 1.0
    strong = STEEL | {"hardness": 700e9}
    quiet = st.film_stresses(
        st.Contact(first=strong, second=RIGID, nominal_area="1 mm^2", roughness=ROUGH, interfacial_shear_strength="1 MPa",
                   coating=st.Coating(material=strong, thickness="300 nm", bodies="first")), load="0.01 N", **LAWS
    )  # fmt: skip
    assert not {"stress_over_yield", "interface_shear", "interface_tension"} & {
        warning.quantity for warning in warnings_of(quiet)
    }


def test_groups_and_nothing_that_touches():
    """Normalised, the same; without friction; far apart nothing presses, and nothing is said of it."""
    contact = coated({"youngs_modulus": 20e9, "poissons_ratio": 0.3, "hardness": 5e9}, 400e-9, "150 MPa")
    found = st.film_stresses(contact, separation=["48 nm"], **LAWS)
    same = st.film_stresses(contact.indices(), separation=[1.0], **LAWS)
    for name in ("contact_over_thickness", "stress_over_yield", "interface_tension", "interface_shear"):
        assert_allclose(same[name].values, found[name].values, rtol=1e-9)
    apart = st.film_stresses(contact.indices(), separation=60.0, model=LAWS["model"], asperity="hertz", tangential="none")
    assert str(apart["yields_first"].values) == "" and np.isnan(float(apart["stress_over_yield"]))


def test_refused():
    contact = coated({"youngs_modulus": 20e9, "poissons_ratio": 0.3, "hardness": 5e9}, 400e-9, "150 MPa")
    with refusal("coating"):
        st.film_stresses(st.Indices(theta=1, lam=1), separation=1)
    with refusal("film", "sequential", "layered"):
        st.film_stresses(contact, load="1 N", film="sequential", **LAWS)
    with refusal("contact", "theta"):
        many = st.Indices(theta=st.axis("theta", [1, 2]), lam=1, n_E=1, n_H=1, tau=1)
        st.film_stresses(many, separation=1, **LAWS)
