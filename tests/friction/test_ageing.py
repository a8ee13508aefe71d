"""Strengthening at rest: the law of creep behind it, what it changes, and what refuses it."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import stiction as st
from refusals import refusal
from stiction.laws.ageing import berthoud_1999
from stiction.quantities.errors import InputError
from stiction.records.registry import AsperityLaw, FilmLaw, RoughSurface, TangentialLaw, incompatibility, of_kind
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import column, columns_of_groups, groups, random_groups, random_others, read

PLAIN = "greenwood_williamson_1966"
REST = {"hold_time": "1 h", "reference_time": "0.5 s", "ageing_rate": 0.03}
SURFACE = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="5 um", asperity_density="1.7e11 1/m^2")
CONTACT = st.Contact(
    first="copper",
    second="hardened_steel_52100",
    roughness=SURFACE,
    nominal_area="1 mm^2",
    interfacial_shear_strength="50 MPa",
    pressure_coefficient=0.1,
)


def test_the_creep_behind_it():
    """dA/dt = (m A_0/t_c) exp(-(A - A_0)/(m A_0)), integrated."""
    rows = read("berthoud_1999.csv")
    assert_allclose(berthoud_1999.factor(groups(**columns_of_groups(rows))), column(rows, "factor"), rtol=1e-13)


def test_a_line_over_the_logarithm_of_time():
    """Slope m for every factor of e; flat before the cut-off time; nothing at no time."""
    times = np.array([1e-4, 1e6, 1e6 * np.e])
    waited = st.axis("hold_time", times)
    contact = CONTACT.replace(**REST | {"hold_time": waited, "reference_time": "1 s"})
    mu = st.solve(contact, load="1 N", model=PLAIN, tangential="bowden_tabor_1943")["friction_coefficient"].values
    first = float(st.solve(CONTACT, load="1 N", model=PLAIN, tangential="bowden_tabor_1943")["friction_coefficient"])
    assert_allclose((mu[2] - mu[1]) / first, 0.03, rtol=1e-5)
    assert_allclose(mu[0] / first, 1.0, atol=4e-6)
    none = st.solve(contact.replace(hold_time="0 s"), load="1 N", model=PLAIN, tangential="bowden_tabor_1943")
    assert float(none["friction_coefficient"]) == first


def test_what_rises_with_pressure_does_not_grow():
    """T = tau_0 A s + alpha P, by hand."""
    rested = st.solve(CONTACT.replace(**REST), load="1 N", model=PLAIN, tangential="briscoe_tabor_1978")
    s = 1.0 + 0.03 * np.log(1.0 + 3600.0 / 0.5)
    expected = 50e6 * float(rested["contact_area"]) * s + 0.1 * 1.0
    assert_allclose(float(rested["friction_force"]), expected, rtol=1e-9)
    without = st.solve(CONTACT.replace(**REST), load="1 N", model=PLAIN, tangential="briscoe_tabor_1978", ageing="none")
    first = st.solve(CONTACT, load="1 N", model=PLAIN, tangential="briscoe_tabor_1978")
    assert float(without["friction_force"]) == float(first["friction_force"])
    assert float(rested["contact_area"]) == float(first["contact_area"])


def draw(n, coated=False):
    rng = np.random.default_rng(8)
    rest = {"waiting": 10.0 ** rng.uniform(-2, 6, n), "ageing_rate": rng.uniform(0.0, 0.1, n)}
    return groups(**random_others(rng, n), **random_groups(rng, n, coated), **rest)


@pytest.mark.parametrize("tangential", of_kind(TangentialLaw).values(), ids=lambda one: one.key)
def test_any_tangential_law(tangential):
    """Refused with its reason, or stronger by no more than the interface is; with any asperity law."""
    given, h = draw(10), np.linspace(-1.0, 3.0, 4)
    if not tangential.of_area:
        with refusal("ageing"):
            laws = {"tangential": tangential.key, "asperity": suiting(tangential), "ageing": "berthoud_1999"}
            problem_of(given, Choice.of(PLAIN, laws))
        return
    grown = berthoud_1999.factor(given)[:, None]
    for asperity in of_kind(AsperityLaw).values():
        if incompatibility(tangential, asperity):
            continue
        choice = {"model": PLAIN, "asperity": asperity.key, "tangential": tangential.key}
        rested, first = (problem_of(given, Choice(**choice, beside={"ageing": key})).on_grid(h) for key in (None, "none"))
        ratio = rested["friction_force"] / np.maximum(first["friction_force"], 1e-300)
        assert (ratio >= 1.0 - 1e-12).all() and (ratio <= grown * (1.0 + 1e-12)).all()
        if tangential.key == "bowden_tabor_1943":
            assert_allclose(rested["friction_force"], first["friction_force"] * grown, rtol=1e-12)
        assert_allclose(rested["load"], first["load"], rtol=1e-12)


def suiting(tangential):
    return next((one.key for one in of_kind(AsperityLaw).values() if not incompatibility(tangential, one)), None)


@pytest.mark.parametrize("film", ("sequential", "layered", "halling_1979"))
def test_films(film):
    """The interface is where it is, with a film too."""
    asperity = next(key for key, one in of_kind(AsperityLaw).items() if not incompatibility(of_kind(FilmLaw)[film], one))
    choice = {"model": PLAIN, "asperity": asperity, "tangential": "bowden_tabor_1943", "film": film}
    given, h = draw(6, coated=True), np.linspace(-1.0, 3.0, 4)
    rested, first = (problem_of(given, Choice(**choice, beside={"ageing": key})).on_grid(h) for key in (None, "none"))
    grown = berthoud_1999.factor(given)[:, None]
    assert_allclose(rested["friction_force"], first["friction_force"] * grown, rtol=1e-11)


@pytest.mark.parametrize("key", [key for key, one in of_kind(RoughSurface).items() if one.area_at_load and not one.adheres])
def test_theories_without_asperities(key):
    if of_kind(RoughSurface)[key].on_film:
        pytest.skip("a bare contact has no film")
    rested, first = (st.solve(one, load="1 N", model=key) for one in (CONTACT.replace(**REST), CONTACT))
    s = 1.0 + 0.03 * np.log(1.0 + 3600.0 / 0.5)
    area = float(first["contact_area"])
    grown = (float(rested["friction_force"]) - float(first["friction_force"])) / (50e6 * area)
    assert_allclose(grown, s - 1.0, rtol=1e-9)


def test_refusals():
    for left_out in REST:
        with pytest.raises(InputError) as caught:
            CONTACT.replace(**{name: value for name, value in REST.items() if name != left_out})
        assert caught.value.field == left_out
    with pytest.raises(InputError) as caught:
        CONTACT.replace(**REST | {"reference_time": "0 s"})
    assert caught.value.field == "reference_time"
    unused = st.solve(CONTACT.replace(**REST), load="1 N", model="chang_etsion_bogy_1988")
    assert "hold_time" in unused.attrs["inputs_not_used"] and "ageing_rate" in unused.attrs["inputs_not_used"]
    rested = st.solve(CONTACT.replace(**REST), load="1 N", model=PLAIN)
    assert rested.attrs["inputs_not_used"] == "" and "dieterich_1978" in rested.attrs["sources"]
