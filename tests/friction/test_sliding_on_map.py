"""`st.slide` on a map: sums of strengths, the loss by weakening, films, and what is refused."""

import numpy as np
import pytest

import stiction as st
from refusals import refusal


def period(count=64, seed=0):
    """One period of a rough surface of 20 nm rms height on 10 um."""
    k = np.hypot(np.fft.fftfreq(count, 1.0 / count)[:, None], np.fft.fftfreq(count, 1.0 / count))
    amplitude = np.where((k >= 2.0) & (k <= 10.0), 1.0 / np.maximum(k, 1.0) ** 1.8, 0.0)
    heights = np.fft.ifft2(amplitude * np.fft.fft2(np.random.default_rng(seed).standard_normal((count, count)))).real
    return st.HeightMap(2e-8 * heights / heights.std(), (1e-5, 1e-5), periodic=True)


def contact(**more):
    given = {"first": "silicon", "second": "silicon", "roughness": period(), "nominal_area": "100 um^2"}
    return st.Contact(**given | {"interfacial_shear_strength": "200 MPa"} | more)


def slide(subject, **more):
    return st.slide(subject, **{"load": "1 mN", "model": "boundary_elements"} | more)


def test_points_that_keep_their_strength_add_up_to_the_friction_that_solve_gives():
    found = slide(contact())
    solved = st.solve(contact(), load="1 mN", model="boundary_elements")
    force = found["tangential_force"].values
    for name in ("friction_force", "contact_area", "friction_coefficient"):
        assert float(found[name]) == pytest.approx(float(solved[name]), rel=1e-12)
    assert force[0] == 0.0 and (np.diff(force) >= -1e-6 * force[-1]).all()
    assert force[-1] == pytest.approx(float(solved["friction_force"]), rel=1e-5)
    assert float(found["friction_efficiency"]) == 1.0
    assert float(found["sticking_share"][0]) == 1.0 and float(found["sticking_share"][-1]) < 0.05


def test_like_bodies_without_poissons_ratio_are_as_stiff_aside_as_they_are_pressed():
    """Mindlin (1949): both stiffnesses are one for nu = 0, spot by spot, and of any arrangement of spots."""
    body = {"youngs_modulus": "160 GPa", "poissons_ratio": 0.0, "hardness": "1000 GPa"}
    found = slide(contact(first=st.Material(**body), second=st.Material(**body)))
    stiffness = float(found["contact_stiffness"])
    assert float(found["tangential_stiffness"]) == pytest.approx(stiffness, rel=0.02)


def test_strength_that_is_lost_with_slip_makes_friction_less_for_larger_loads_and_shorter_slips():
    found = slide(contact(), load=["0.3 mN", "3 mN"], residual_strength=0.0, weakening_slip="3 nm")
    small, large = found["friction_efficiency"].values
    assert 0.3 < large < small < 1.0
    shorter = slide(contact(), load="3 mN", residual_strength=0.0, weakening_slip="1.5 nm")
    assert float(shorter["friction_efficiency"]) < large
    half = slide(contact(), load="3 mN", residual_strength=0.5, weakening_slip="3 nm")
    assert max(large, 0.5) < float(half["friction_efficiency"]) < 1.0
    ratio = half["largest_tangential_force"] / half["friction_force"]
    assert float(ratio) == pytest.approx(float(half["friction_efficiency"]), rel=1e-12)
    long = slide(contact(), load="3 mN", residual_strength=0.0, weakening_slip="10 um")
    assert float(long["friction_efficiency"]) == pytest.approx(1.0, abs=0.001)


def test_a_map_that_does_not_resolve_the_loss_says_so():
    """l_c = D_c G/(2 tau_p) of like bodies; a tenth of a point's width here, where 3 points are wanted."""
    found = slide(contact(), residual_strength=0.0, weakening_slip="0.05 nm", displacement=["0.1 nm"])
    silicon = contact().first
    rigidity = silicon.youngs_modulus / (2.0 * (1.0 + silicon.poissons_ratio))
    expected = 0.05e-9 * rigidity / (2.0 * 200e6) / (1e-5 / 64)
    counted = float(found["contact_area"] / found["contact_area_pixels"])  # a point's strength is less by what edges add
    assert float(found["points_in_weakening"]) == pytest.approx(expected / counted, rel=1e-6)
    assert "does not resolve the loss" in found.attrs["outside_validity"]


def test_a_film_of_the_same_material_changes_nothing():
    bare = slide(contact())
    film = slide(contact(coating=st.Coating(material="silicon", thickness="1 um", bodies="first")))
    for name in ("tangential_stiffness", "sliding_displacement", "friction_force"):
        assert float(film[name]) == pytest.approx(float(bare[name]), rel=1e-3)


@pytest.mark.parametrize("shear", ["lesser", "junction_growth"])
def test_points_slide_under_the_lesser_strength_and_under_combined_stresses(shear):
    """Options of the strength of points: min(alpha p, tau_0), and junctions that grow by p^2 + 9 tau_0^2 = H^2."""
    weak = {"interfacial_shear_strength": "800 MPa", "pressure_coefficient": 0.3}
    options = {"lesser": weak, "junction_growth": {"interfacial_shear_strength": "2 GPa"}}
    soft = st.Material(youngs_modulus="160 GPa", poissons_ratio=0.2, hardness="6.5 GPa")
    pair = contact(first=soft, **options[shear])
    laws = {"tangential": "bowden_tabor_1943", "shear": shear}
    found = slide(pair, load="5 mN", **laws)
    solved = st.solve(pair, load="5 mN", model="boundary_elements", **laws)
    plain = st.solve(pair, load="5 mN", model="boundary_elements", tangential="bowden_tabor_1943")
    force = float(solved["friction_force"])
    assert float(found["largest_tangential_force"]) == pytest.approx(force, rel=1e-9)
    assert float(found["tangential_force"][-1]) == pytest.approx(force, rel=1e-4)
    assert (force < float(plain["friction_force"])) is (shear == "lesser")
    weaker = slide(pair, load="5 mN", residual_strength=0.2, weakening_slip="20 nm", **laws)
    assert 0.2 < float(weaker["friction_efficiency"]) < 1.0


def test_half_of_what_weakening_takes_is_refused():
    with refusal("weakening_slip", "not given", "1 nm for monolayers"):
        slide(contact(), residual_strength=0.5)
    with refusal("weakening_slip", "1 nm", "residual_strength < 1"):
        slide(contact(), weakening_slip="1 nm")
    with refusal("tangential", "none", "tangential law"):
        slide(contact(), tangential="none")
    with refusal("weakening_slip", "1 nm", "boundary_elements"):
        st.slide(contact(), load="1 mN", weakening_slip="1 nm", residual_strength=0.5)
