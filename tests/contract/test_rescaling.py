"""The same contact in other units of length and force has the same groups; its results scale as their dimensions say."""

import numpy as np
import pytest

from stiction.contact.contact import Coating, Contact
from stiction.contact.materials import Material
from stiction.quantities.table import QUANTITIES
from stiction.solving.solve import solve
from stiction.surfaces.roughness import Roughness

# Exponents of length and force in each unit that a contact is given in.
DIMENSIONS = {"m": (1, 0), "m^2": (2, 0), "1/m^2": (-2, 0), "Pa": (-2, 1), "J/m^2": (-1, 1), "N/m": (-1, 1), "": (0, 0)}


def scaled(values, length, force):
    """Every number times the powers that its unit in the table of quantities asks for."""
    result = {}
    for name, value in values.items():
        powers = DIMENSIONS[QUANTITIES[name].unit]
        result[name] = value * length ** powers[0] * force ** powers[1]
    return result


def contact(length=1.0, force=1.0, coated=True):
    def body(**values):
        return Material(name="some", **scaled(values, length, force))

    roughness = {"asperity_height_deviation": 48e-9, "asperity_radius": 50e-6, "asperity_density": 1.7e10}
    film = {"thickness": 200e-9, "work_of_adhesion": 0.4, "friction_constant": 3.0}
    given = {"work_of_adhesion": 0.7, "nominal_area": 1e-6, "hardness_to_yield": 2.8}
    given |= {"interfacial_shear_strength": 2e7, "pressure_coefficient": 0.1, "peeling": 0.5}
    return Contact(
        first=body(youngs_modulus=210e9, poissons_ratio=0.29, hardness=7e9, tangent_modulus=4e9),
        second=body(youngs_modulus=120e9, poissons_ratio=0.34, hardness=4e9, tangent_modulus=2e9),
        roughness=Roughness(**scaled(roughness, length, force)),
        coating=Coating(
            material=body(youngs_modulus=60e9, poissons_ratio=0.4, hardness=1e9), **scaled(film, length, force), bodies="first"
        )
        if coated
        else None,
        **scaled(given, length, force),
    )


@pytest.mark.parametrize("coated", (False, True))
@pytest.mark.parametrize(("length", "force"), [(1e3, 1.0), (1.0, 1e3), (1e-2, 0.3), (7.0, 1e-4)])
def test_groups_have_no_unit(length, force, coated):
    one, two = contact(coated=coated), contact(length, force, coated)
    plain, other = one.indices(), two.indices()
    names = [name for name in type(plain).model_fields if getattr(plain, name) is not None]
    needed_by_some = 8
    assert len(names) == (19 if coated else 5) + (0 if coated else 1) + needed_by_some  # bare: n_g is 1 by default
    for name in names:
        if name != "tabor_parameter":
            assert getattr(other, name) == pytest.approx(getattr(plain, name), rel=1e-12), name
    # This one compares with the range of the attraction, a length of matter: it keeps its value if that is rescaled too.
    assert (plain.tabor_parameter, other.tabor_parameter) == (one.tabor_parameter(), two.tabor_parameter())
    assert two.tabor_parameter(2e-10 * length) == pytest.approx(one.tabor_parameter(2e-10), rel=1e-12)
    assert other.theta != 1.0


@pytest.mark.parametrize(("length", "force"), [(1e3, 1.0), (1.0, 1e3), (1e-2, 0.3)])
def test_results_have_their_units(length, force):
    """load as force, contact area as length^2, separation as length; the number of asperities is a number."""
    plain, other = contact().scales(), contact(length, force).scales()
    for name, factor in (("load", force), ("contact_area", length**2), ("separation", length), ("asperities", 1.0)):
        assert getattr(other, name) == pytest.approx(factor * getattr(plain, name), rel=1e-12), name


def test_numbers_of_a_contact_by_hand():
    """theta and lambda of theory 1 for two bodies alike, in SI: K = (4/3) E*, 1/E* = 2 (1 - nu^2)/E."""
    E, nu, H, sigma, R, gamma = 200e9, 0.3, 5e9, 50e-9, 20e-6, 0.5
    alike = Material(name="some", youngs_modulus=E, poissons_ratio=nu, hardness=H)
    roughness = Roughness(asperity_height_deviation=sigma, asperity_radius=R, asperity_density=1e10)
    groups = Contact(first=alike, second=alike, roughness=roughness, work_of_adhesion=gamma, nominal_area=1e-6).indices()
    K = 4.0 / 3.0 * E / (2.0 * (1.0 - nu**2))
    assert groups.theta == pytest.approx(K * sigma**1.5 / (gamma * R**0.5), rel=1e-13)
    assert groups.lam == pytest.approx(np.pi**2 * R * H**4 * sigma / (18.0 * K**2 * gamma**2), rel=1e-13)
    assert groups.K_beta == pytest.approx(6.4762, abs=5e-5)


@pytest.mark.parametrize("coated", (False, True))
def test_solutions_have_their_units(coated):
    """Every variable of a solution scales as its SI unit says when metres and newtons are replaced."""
    length, force = 1e2, 0.3
    h = np.linspace(-1.0, 4.0, 6) * 48e-9
    plain = solve(contact(coated=coated), separation=h, model="soft_coating_2015")
    other = solve(contact(length, force, coated), separation=h * length, model="soft_coating_2015")
    assert set(plain.data_vars) == set(other.data_vars) and len(plain.data_vars) > 10
    for name in plain.data_vars:
        powers = {"N": (0, 1), "m^2": (2, 0), "m": (1, 0), "1": (0, 0), "Pa": (-2, 1)}[plain[name].attrs["units"]]
        factor = length ** powers[0] * force ** powers[1]
        expected = plain[name].values * factor  # not a number: the separation at the largest tension, where there is none
        largest = np.nan_to_num(np.abs(expected)).max()
        np.testing.assert_allclose(other[name].values, expected, rtol=1e-9, atol=1e-12 * largest, err_msg=name)
