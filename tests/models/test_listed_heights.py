"""Asperities of listed heights against sums that are written out here, sphere by sphere."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq
from scipy.stats import norm

import stiction as st
from refusals import refusal
from stiction.contact.indices import Groups
from stiction.engine.heights import discrete, gaussian
from stiction.engine.summation import scattered
from stiction.engine.tiers import VARIABLE
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of

PLAIN = "greenwood_williamson_1966"
AREA, RADIUS, STRENGTH = 1e-4, 0.5e-3, 0.3e6
HEIGHTS = np.array([0.0, 3.0, 7.0, 7.0, 12.0, 30.0, 41.0]) * 1e-6  # two alike
SILICONE = st.Material(name="silicone", youngs_modulus="1.4 MPa", poissons_ratio=0.49, hardness="10 MPa")


def contact(heights=HEIGHTS, **more):
    rough = st.Roughness(
        asperity_height_deviation=np.std(heights), asperity_radius=RADIUS, asperity_density=len(heights) / AREA,
        height_distribution="discrete", height_parameters={"samples": heights},
    )  # fmt: skip
    given = {"first": SILICONE, "second": "silicon", "nominal_area": AREA, "interfacial_shear_strength": STRENGTH}
    return st.Contact(roughness=rough, **given | more)


def pressed(gap, modulus):
    """Load and area of Hertz's spheres below a plane at the height `gap`."""
    depth = np.maximum(HEIGHTS - gap, 0.0)
    return 4.0 / 3.0 * modulus * math.sqrt(RADIUS) * (depth**1.5).sum(), math.pi * RADIUS * depth.sum()


@pytest.mark.parametrize("load", [1e-6, 1e-4, 3e-3, 0.1, 2.0])
def test_friction_is_the_strength_times_the_areas_of_all_spheres(load):
    """F = sum of tau A_i (Aymard et al. 2024), Hertz's areas at the plane on which the spheres carry the load."""
    given = contact()
    gap = brentq(lambda at: pressed(at, given.contact_modulus)[0] - load, -1.0, HEIGHTS.max(), xtol=1e-18, rtol=1e-15)
    found = st.solve(given, load=load, model=PLAIN, tangential="bowden_tabor_1943")
    area = pressed(gap, given.contact_modulus)[1]
    assert float(found["contact_area"]) == pytest.approx(area, rel=1e-9)
    assert float(found["friction_force"]) == pytest.approx(STRENGTH * area, rel=1e-9)
    assert float(found["mean_separation"]) == pytest.approx(gap - HEIGHTS.mean(), rel=1e-9)
    assert round(float(found["touching_asperities"])) == (HEIGHTS > gap).sum()


def test_spheres_that_stick():
    """JKR's equations in SI, each sphere's radius of contact by bisection on the stable branch."""
    given, work = contact(work_of_adhesion="50 mJ/m^2"), 0.05
    modulus = given.contact_modulus

    def depth(a):
        return a * a / RADIUS - math.sqrt(2.0 * math.pi * work * a / modulus)

    separation, loads, areas = -5e-6, 0.0, 0.0
    for height in HEIGHTS - HEIGHTS.mean():
        if height > separation:
            a = brentq(lambda a, w=height - separation: depth(a) - w, 1e-6, 1e-3, xtol=1e-20)
            loads += 4.0 * modulus * a**3 / (3.0 * RADIUS) - math.sqrt(8.0 * math.pi * work * modulus * a**3)
            areas += math.pi * a * a
    found = st.solve(given, separation=separation, model=PLAIN, asperity="jkr", tangential="bowden_tabor_1943")
    assert float(found["load"]) == pytest.approx(loads, rel=1e-8)
    assert float(found["contact_area"]) == pytest.approx(areas, rel=1e-8)


def flat(count):
    ones = np.ones(count)
    return Groups(theta=30.0 * ones, lam=3.0 * ones, nu=0.3 * ones, hardness_to_yield=2.8 * ones, K_beta=6.5 * ones)


@pytest.mark.parametrize("asperity", ["hertz", "jkr", "kogut_etsion_2002", "roy_chowdhury_ghosh_1994"])
def test_very_many_heights_are_their_distribution(asperity):
    """Midpoints of 20,000 equal shares of the Gaussian distribution: the sum tends to the integral as one over their number."""
    h = np.array([-1.0, 0.0, 1.0, 2.0])
    regimes = problem_of(flat(h.size), Choice(PLAIN, asperity)).regimes
    listed = discrete(norm.ppf((np.arange(20000) + 0.5) / 20000))
    found, expected = (scattered(regimes, h, heights).sum(axis=0)[:, :3] for heights in (listed, gaussian()))
    assert_allclose(found, expected, rtol=3e-3, atol=1e-4)


def test_plain_python_and_compiled_loops_agree(monkeypatch):
    h, heights = np.linspace(-2.0, 2.0, 9), discrete([0.0, 1.0, 1.0, 4.0])
    regimes = problem_of(flat(h.size), Choice("soft_coating_2015")).regimes
    sums = []
    for loops in ("interpreted", "shared"):
        monkeypatch.setenv(VARIABLE, loops)
        sums.append(scattered(regimes, h, heights))
    assert_allclose(sums[0], sums[1], rtol=1e-12, atol=1e-15)
    assert sums[0].any()


def test_listed_spheres_are_no_statistics():
    """Few of them, all of them touching: no warning about averages or about random surfaces."""
    told = st.solve(contact(), load="0.5 N", model=PLAIN, tangential="bowden_tabor_1943").attrs["outside_validity"]
    alike = contact().replace(roughness=contact().roughness.replace(height_distribution="gaussian", height_parameters={}))
    random = st.solve(alike, load="0.5 N", model=PLAIN, tangential="bowden_tabor_1943").attrs["outside_validity"]
    assert "random surface" in random and "random surface" not in told
    assert "average" in random and "average" not in told


def test_sliding_and_unloading_take_listed_heights():
    slid = st.slide(contact(), load="10 mN", model=PLAIN, tangential="bowden_tabor_1943")
    assert float(slid["tangential_force"][-1]) == pytest.approx(float(slid["friction_force"]), rel=1e-9)
    given = contact(work_of_adhesion="50 mJ/m^2")
    back = st.unload(given, max_load="10 mN", separation_increase=["0 um", "5 um"], model=PLAIN, asperity="jkr")["load"].values
    assert back[0] == pytest.approx(0.01, rel=1e-9) and back[1] < back[0]


def test_heights_that_differ_by_rounding_are_refused():
    with refusal("height_distribution.samples", "heights that differ by more than rounding"):
        discrete([1e-6, 1e-6 * (1.0 + 2e-16)])
    alike = 5e-6 + 1e-14 * np.arange(4.0)
    with refusal("load", "below the mean of the listed heights"):
        st.solve(contact(alike), load=1.0, model=PLAIN, tangential="bowden_tabor_1943")


def test_listed_heights_are_not_scaled_in_silence():
    """A list in another unit of length is meant as it is; one with another deviation is scaled, which a warning says."""
    samples = {"height_distribution": "discrete", "height_parameters": {"samples": HEIGHTS * 1e6}}
    assert contact().roughness.notes() == contact().roughness.replace(**samples).notes() == []
    (note,) = contact().roughness.replace(asperity_height_deviation="48 nm").notes()
    assert note.startswith("input warning: listed heights are scaled from a deviation of 1.416e-05")
