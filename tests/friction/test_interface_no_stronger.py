"""No interface is stronger than the weaker of the surfaces that meet: its strength is capped, and junctions grow.

Expected numbers are closed forms: the bulk shears at H/(2.8 sqrt(3)) (von Mises, H/Y = 2.8), a plastic contact has
mu = tau_0/H, and Tabor's (1959) junction c/sqrt(alpha (1 - c^2)), alpha = 3 2.8^2.
"""

import math

import numpy as np
import pytest

import stiction as st
from stiction.laws.validity import warnings_of

BULK = 1.0 / (2.8 * math.sqrt(3.0))  # of the shear strength over H
COPPER, SILVER, STEEL = st.material("copper").hardness, st.material("silver").hardness, 7e9  # hardness [Pa]


def contact(strength, **more):
    rough = {"asperity_height_deviation": "150 nm", "asperity_radius": "20 um", "asperity_density": "1.2e10 1/m^2"}
    given = {"first": "copper", "second": "copper", "roughness": rough, "nominal_area": "1 mm^2"}
    return st.Contact(**given | more, interfacial_shear_strength=strength)


@pytest.mark.parametrize("strength", (1.001 * BULK * COPPER, 2e9, 1e12))
def test_a_plastic_contact_shears_at_the_strength_of_the_bulk_at_most(strength):
    """Copper of 73 MPa under a stated 2 GPa had mu = 5.6 without a warning."""
    found = st.solve(contact(strength), load="1 N", model="persson_2001_elastoplastic")
    assert float(found["friction_coefficient"]) == pytest.approx(BULK, rel=1e-3)
    said = next(one for one in warnings_of(found) if one.quantity == "strength_over_bodies")
    assert said.most == pytest.approx(strength / (BULK * COPPER), rel=1e-9)


def test_a_weaker_interface_is_as_stated():
    found = st.solve(contact(0.5 * BULK * COPPER), load="1 N", model="persson_2001_elastoplastic")
    assert float(found["friction_coefficient"]) == pytest.approx(0.5 * BULK, rel=1e-3)
    assert not [one for one in warnings_of(found) if one.quantity in ("strength_over_bodies", "grown_area_ratio")]


def test_the_yield_stress_of_the_weaker_body_decides():
    soft = {"youngs_modulus": "110 GPa", "poissons_ratio": 0.34, "hardness": COPPER, "yield_stress": 100e6}
    given = contact("1 GPa", first=soft, second="tungsten")
    assert given.interface_strength == pytest.approx(100e6 / math.sqrt(3.0), rel=1e-12)
    assert contact("10 MPa").interface_strength == pytest.approx(10e6, rel=1e-12)
    assert contact(None).interface_strength is None


@pytest.mark.parametrize(("film", "expected"), (("silver", SILVER), ("titanium_nitride", STEEL)))
def test_a_film_counts_where_it_meets_the_other_body(film, expected):
    """A soft film gives way itself; a hard one meets a body that is softer."""
    steel = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": STEEL}
    coating = {"material": film, "thickness": "1 um", "bodies": "first"}
    given = contact("1e12 Pa", first=steel, second=steel, coating=coating)
    assert given.interface_strength == pytest.approx(BULK * expected, rel=1e-12)


def test_groups_are_capped_where_they_are_arrays():
    strength = st.axis("shear_strength", [0.1, 0.3, 0.5])
    given = st.Indices(hardness_group=0.1, shear_strength=strength, hardness_to_yield=st.axis("hardness_to_yield", [2.0, 3.0]))
    taken = given.interface_strength.transpose("hardness_to_yield", "shear_strength").values
    assert np.allclose(taken, np.minimum([[0.1, 0.3, 0.5]] * 2, 1.0 / (math.sqrt(3.0) * np.array([[2.0], [3.0]]))), rtol=1e-14)


def test_growing_junctions_stand_beside_those_that_do_not_grow():
    data = st.compare(contact("60 MPa"), load="1 N")
    share = 60e6 / (BULK * COPPER)
    mu = data["friction_coefficient_at_load"]
    assert float(mu.sel(model="tabor_1959")) == pytest.approx(BULK * share / math.sqrt(1.0 - share**2), rel=0.01)
    assert 60e6 / COPPER < float(mu.sel(model="junction_growth")) < float(mu.sel(model="tabor_1959"))


def test_the_growth_that_is_left_out():
    """A_s/A = 1/sqrt(1 - c^2) of plastic contacts: 3.2026 at c = 0.95 (Tabor 1959)."""
    found = st.solve(contact(0.95 * BULK * COPPER), load="1 N", model="persson_2001_elastoplastic")
    said = next(one for one in warnings_of(found) if one.quantity == "grown_area_ratio")
    assert said.kind == "effect" and said.most == pytest.approx(3.2026, rel=1e-3)
