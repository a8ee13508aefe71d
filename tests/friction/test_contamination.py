"""Junctions of different strength: the spread of friction from contact to contact."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import stiction as st
from refusals import refusal
from stiction.engine.heights import gaussian, height_distribution
from stiction.engine.summation import scattered
from stiction.laws.asperity import hertz
from stiction.laws.contamination import independent_junctions
from stiction.laws.joining import Law
from stiction.records.registry import AsperityLaw, TangentialLaw, incompatibility, of_kind
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import column, columns_of_groups, groups, random_groups, random_others, read

PLAIN = "greenwood_williamson_1966"
LAW = "independent_junctions"
SURFACE = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="5 um", asperity_density="1.7e11 1/m^2")
CONTACT = st.Contact(
    first="copper",
    second="hardened_steel_52100",
    roughness=SURFACE,
    nominal_area="4e-4 mm^2",
    interfacial_shear_strength="50 MPa",
    strength_variation=0.5,
)


def test_variance_of_one_asperity():
    rows = read("independent_junctions.csv")
    given = groups(**columns_of_groups(rows))
    regimes = Law(hertz.RECORD, independent_junctions.RECORD).regimes(given)
    found = scattered(regimes, column(rows, "h"), gaussian()).sum(axis=0)
    assert_allclose(found[:, 3], column(rows, "variance"), rtol=1e-11)


def test_exponential_heights():
    """c sqrt(2/n) of mu, at every load."""
    contact = CONTACT.replace(roughness=SURFACE.replace(height_distribution="exponential"))
    for h in ("48 nm", "150 nm"):
        found = st.solve(contact, separation=h, model=PLAIN, tangential="bowden_tabor_1943")
        n = float(found["touching_asperities"])
        ratio = float(found["friction_coefficient_scatter"]) / float(found["friction_coefficient"])
        assert_allclose(ratio, 0.5 * np.sqrt(2.0 / n), rtol=1e-9)


def test_draws_of_contacts():
    """Strengths drawn for given junctions: the deviation of the force, averaged over the heights as a variance."""
    rng = np.random.default_rng(4)
    asperities, h, draws = 400, 0.5, 4000
    areas = np.maximum(rng.standard_normal((draws, asperities)) - h, 0.0)
    strengths = rng.lognormal(0.0, 0.6, areas.shape)  # of the variation sqrt(exp(0.36) - 1)
    strengths /= np.exp(0.18)
    forces = ((strengths - 1.0) * areas).sum(axis=1)
    given = groups(theta=1e3, lam=1e3, shear_strength=0.1, strength_variation=np.sqrt(np.exp(0.36) - 1.0),
                   roughness_parameter=0.04, nominal_width=100.0 / 0.02, sharpness=0.02)  # fmt: skip
    found = problem_of(given, Choice(PLAIN, tangential="bowden_tabor_1943")).on_grid(np.array([h]))
    unit = float(given.eta[0]) * 0.1 / asperities
    assert_allclose(found["friction_coefficient_scatter"] * found["load"], unit * forces.std(), rtol=0.04)


@pytest.mark.parametrize("tangential", of_kind(TangentialLaw).values(), ids=lambda one: one.key)
def test_any_tangential_law(tangential):
    """With every asperity law, or refused."""
    rng = np.random.default_rng(2)
    given = groups(**random_others(rng, 8), **random_groups(rng, 8, False), strength_variation=0.4)
    for asperity in of_kind(AsperityLaw).values():
        if incompatibility(tangential, asperity):
            continue
        choice = Choice(PLAIN, asperity=asperity.key, tangential=tangential.key, beside={"contamination": LAW})
        if not tangential.of_area:
            with refusal("contamination"):
                problem_of(given, choice)
            return
        found = problem_of(given, choice).on_grid(np.linspace(-1.0, 2.0, 3))
        spread, load = found["friction_coefficient_scatter"], found["load"]
        assert (spread[load > 0.0] > 0.0).all() and np.isnan(spread[load <= 0.0]).all()


def test_what_it_says():
    """Few junctions scatter; the mean stays; nothing is there that was not asked for."""
    found = st.solve(CONTACT, load=["0.1 mN", "10 mN"], model=PLAIN)
    alike = st.solve(CONTACT.replace(strength_variation=0.0), load=["0.1 mN", "10 mN"], model=PLAIN)
    assert_allclose(found["friction_coefficient"], alike["friction_coefficient"], rtol=1e-12)
    assert (alike["friction_coefficient_scatter"].values == 0.0).all()
    relative = (found["friction_coefficient_scatter"] / found["friction_coefficient"]).values
    assert relative[0] > 2.0 * relative[1] > 0.0
    assert "friction_coefficient_scatter" not in st.solve(CONTACT.replace(strength_variation=None), load="1 mN", model=PLAIN)
    film = st.Coating(material="silver", thickness="200 nm")
    coated = CONTACT.replace(coating=film, work_of_adhesion="0.1 J/m^2")
    unused = st.solve(coated, load="1 mN", model=PLAIN, film="sequential", tangential="bowden_tabor_1943")
    assert "strength_variation" in unused.attrs["inputs_not_used"]
    with refusal("contamination", "independent_junctions", "sequential"):
        st.solve(coated, load="1 mN", model=PLAIN, film="sequential", tangential="bowden_tabor_1943",
                 contamination=LAW)  # fmt: skip
    assert height_distribution("gaussian").key == "gaussian"
    closed = st.solve(CONTACT, load="1 mN", model="persson_2001")
    assert "strength_variation" in closed.attrs["inputs_not_used"]
