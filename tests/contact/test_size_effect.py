"""Hardness under small asperities: dislocations counted loop by loop, and what of a contact changes."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

import stiction as st
from stiction.contact.size_effect import radius_of
from stiction.quantities.errors import InputError

COPPER = st.Material(name="copper", youngs_modulus="128 GPa", poissons_ratio=0.34, hardness="0.6 GPa", yield_stress="0.2 GPa")
SURFACE = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="5 um", asperity_density="1.7e11 1/m^2")
CONTACT = st.Contact(
    first=COPPER, second="hardened_steel_52100", roughness=SURFACE, nominal_area="1 mm^2", interfacial_shear_strength="50 MPa"
)
DEEP = COPPER.replace(characteristic_depth="1.6 um")


def density(slope, radius):
    """Length of the loops that make an imprint of this slope, over the hemisphere as wide; Burgers vector 1."""
    length = quad(lambda r: 2.0 * np.pi * r * slope(r), 0.0, radius)[0]
    return length / (2.0 / 3.0 * np.pi * radius**3)


def test_a_sphere_and_a_pyramid_of_one_hardness():
    """At the depth h* a pyramid has as many dislocations as a sphere of the radius R*, however deep that is pressed."""
    steep = 1.0 / np.tan(np.radians(70.3))
    depth = 1.6e-6
    under_pyramid = density(lambda r: steep, depth / steep)
    for radius in (1e-7, 3e-6):
        assert_allclose(density(lambda r: r / radius_of(depth), radius), under_pyramid, rtol=1e-10)


def test_a_contact_is_one_of_harder_bodies():
    """H sqrt(1 + R*/R), the yield stress with it; the strength of the interface as it is."""
    steep = 1.0 / np.tan(np.radians(70.3))
    factor = np.sqrt(1.0 + 2.0 / 3.0 * 1.6e-6 / steep**2 / 5e-6)
    assert 1.5 < factor < 1.7
    by_hand = COPPER.replace(hardness=0.6e9 * factor, yield_stress=0.2e9 * factor)
    sized, same = (CONTACT.replace(first=body) for body in (DEEP, by_hand))
    for name, value in same.indices().resolved().listed():
        assert dict(sized.indices().resolved().listed())[name] == value
    for model in ("jackson_green_2005", "persson_2001_elastoplastic"):
        one, other = (st.solve(contact, load="10 N", model=model) for contact in (sized, same))
        assert_allclose(one["contact_area"], other["contact_area"], rtol=1e-12)
        assert_allclose(one["friction_force"], other["friction_force"], rtol=1e-12)
        assert float(one["contact_area"]) < float(st.solve(CONTACT, load="10 N", model=model)["contact_area"])
    assert sized.plasticity_index == pytest.approx(CONTACT.plasticity_index / factor)


def test_large_asperities_find_the_hardness_of_large_imprints():
    large = CONTACT.replace(first=DEEP, roughness=SURFACE.replace(asperity_radius="1 m"))
    assert_allclose(large.indices().hardness_group, large.replace(first=COPPER).indices().hardness_group, rtol=1e-5)


def test_the_softer_body_is_that_under_asperities():
    """A soft body may be the harder one where imprints are small."""
    other = COPPER.replace(name="other", hardness="0.8 GPa", poissons_ratio=0.3)
    swapped = CONTACT.replace(first=COPPER.replace(characteristic_depth="3 um"), second=other)
    assert swapped.indices().nu == 0.3 and swapped.replace(first=COPPER).indices().nu == 0.34


def test_films():
    """That of the film counts for the film."""
    film = st.Coating(material=COPPER.replace(characteristic_depth="1.6 um"), thickness="1 um", bodies="second")
    bare = st.Coating(material=COPPER, thickness="1 um", bodies="second")
    hard = CONTACT.replace(first="hardened_steel_52100")
    sized, plain = (hard.replace(coating=one).indices().n_H for one in (film, bare))
    assert_allclose(sized / plain, np.sqrt(1.0 + radius_of(1.6e-6) / 5e-6), rtol=1e-12)


def test_what_is_said():
    sized = CONTACT.replace(first=DEEP)
    found = st.solve(sized, load="10 N", model="jackson_green_2005")
    assert "1.63 times the hardness" in found.attrs["remarks"] and found.attrs["inputs_not_used"] == ""
    elastic = st.solve(sized, load="10 N", model="greenwood_williamson_1966")
    assert "first.characteristic_depth" in elastic.attrs["inputs_not_used"]
    tiny = sized.replace(roughness=SURFACE.replace(asperity_radius="200 nm", asperity_height_deviation="5 nm"))
    assert "R^*" in str(st.solve(tiny, load="1 mN", model="jackson_green_2005").attrs["validity_warnings"]) or (
        "size_effect" in st.solve(tiny, load="1 mN", model="jackson_green_2005").attrs["validity_warnings"]
    )
    with pytest.raises(InputError):
        COPPER.replace(characteristic_depth="0 m")
    depths = st.axis("characteristic_depth", ["100 nm", "1 um"])
    swept = st.solve(
        CONTACT.replace(first=COPPER.replace(characteristic_depth=depths)), load="10 N", model="jackson_green_2005"
    )
    assert (np.diff(swept["contact_area"].values.ravel()) < 0.0).all()
