"""`st.slide` on a map: sums of strengths, the loss by weakening, films, and what is refused."""

from dataclasses import replace

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


def test_loads_are_those_asked_for_to_the_last_bit():
    """A load that round-off changed would be a row of its own, without a force."""
    loads = np.geomspace(1e-4, 5e-3, 9)
    found = slide(contact(roughness=period(32)), load=loads, displacement=["0.1 nm", "10 nm"])
    np.testing.assert_array_equal(found["load"], loads)
    assert found["tangential_force"].shape == (9, 2) and np.isfinite(found["tangential_force"]).all()


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
    harder = st.Material(youngs_modulus="160 GPa", poissons_ratio=0.2, hardness="12 GPa")  # as elastic: not coupled
    pair = contact(first=soft, second=harder, **options[shear])
    laws = {"tangential": "bowden_tabor_1943", "shear": shear}
    found = slide(pair, load="5 mN", **laws)
    solved = st.solve(pair, load="5 mN", model="boundary_elements", **laws)
    plain = st.solve(pair, load="5 mN", model="boundary_elements", tangential="bowden_tabor_1943")
    force = float(solved["friction_force"])
    assert float(found["largest_tangential_force"]) == pytest.approx(force, rel=1e-9)
    assert float(found["tangential_force"][-1]) == pytest.approx(force, rel=1e-4)
    assert (force < 0.999 * float(plain["friction_force"])) is (shear == "lesser")
    weaker = slide(pair, load="5 mN", residual_strength=0.2, weakening_slip="20 nm", **laws)
    assert 0.2 < float(weaker["friction_efficiency"]) < 1.0


def test_half_of_what_weakening_takes_is_refused():
    with refusal("weakening_slip", "not given", "3 nm for monolayers"):
        slide(contact(), residual_strength=0.5)
    with refusal("weakening_slip", "1 nm", "residual_strength"):
        slide(contact(), weakening_slip="1 nm")
    with refusal("tangential", "none", "tangential law"):
        slide(contact(), tangential="none")
    with refusal("weakening_slip", "1 nm", "boundary_elements"):
        st.slide(contact(), load="1 mN", weakening_slip="1 nm", residual_strength=0.5)


def test_a_force_is_met_at_the_displacement_that_is_found():
    found = slide(contact(), tangential_force=["0.02 mN", "0.05 mN"])
    np.testing.assert_allclose(found["tangential_force"].values, [2e-5, 5e-5], rtol=1e-5)
    again = slide(contact(), displacement=found["displacement"].values)
    np.testing.assert_allclose(again["tangential_force"].values, [2e-5, 5e-5], rtol=1e-5)
    whole = slide(contact(nominal_area="1000 um^2"), load="10 mN", tangential_force=["0.2 mN"])
    assert float(whole["displacement"][0]) == pytest.approx(float(found["displacement"][0]), rel=1e-5)


def test_a_soft_machine_leaps_and_a_stiff_one_does_not():
    """A drive through a spring is ahead by F/k; where the force falls faster than k, states are left out (Dieterich 1978)."""
    given = {"load": "3 mN", "residual_strength": 0.0, "weakening_slip": "2 nm"}
    stiff = slide(contact(), spring_stiffness="1e9 N/m", **given)
    assert (stiff["state_is_met"].values == 1.0).all()
    force, shift = stiff["tangential_force"].values, stiff["displacement"].values
    np.testing.assert_allclose(stiff["drive_displacement"].values, shift + force / 1e9, rtol=1e-12)
    falls = float(np.max(-np.diff(force) / np.diff(shift)))
    soft = slide(contact(), spring_stiffness=0.1 * falls, **given)
    met, top = soft["state_is_met"].values, int(np.argmax(force))
    assert met[: top + 1].all() and 0 < np.count_nonzero(met == 0.0)
    np.testing.assert_array_equal(soft["tangential_force"].values, force)
    assert float(soft["largest_tangential_force"]) == float(stiff["largest_tangential_force"])


def test_refused_forces_and_springs():
    with refusal("tangential_force", "132", "N"):
        slide(contact(), tangential_force="1 N")
    with refusal("tangential_force", "displacement"):
        slide(contact(), tangential_force="0.01 mN", displacement="1 nm")
    with refusal("tangential_force", "falls with slip"):
        slide(contact(), tangential_force="0.01 mN", residual_strength=0.5, weakening_slip="1 nm")
    with refusal("load", "one load"):
        slide(contact(), tangential_force="0.01 mN", load=["1 mN", "2 mN"])
    with refusal("spring_stiffness", "0", "0"):
        slide(contact(), spring_stiffness=0.0)
    with refusal("spring_stiffness", "boundary_elements"):
        st.slide(contact(), load="1 mN", spring_stiffness=1.0)


HARD = st.Material(youngs_modulus="100000 GPa", poissons_ratio=0.3, hardness="10000 GPa")
SOFT = st.Material(youngs_modulus="1 GPa", poissons_ratio=0.0, hardness="1000 GPa")  # Dundurs' parameter 1/2 against HARD


def test_a_sphere_of_unlike_bodies_slips_at_its_rim_when_it_is_pressed():
    """Spence (1968), as CONTACT's example spence35: friction .2986, Dundurs' parameter 1/2, stick radius .503 of the radius.

    Nothing else moves the map, so that the force is 0 and the contact bears shear all the same. The images of a periodic map
    hold the contact back by the square of its radius over the period; this part is extrapolated.
    """
    radii = {}
    for count in (64, 128):
        x = (np.arange(count) - 0.5 * (count - 1)) * 1e-7
        sphere = st.HeightMap(-(x[None] ** 2 + x[:, None] ** 2) / 2e-4, (count * 1e-7, count * 1e-7), periodic=True)
        pair = {"first": SOFT, "second": HARD, "roughness": sphere, "nominal_area": (count * 1e-7) ** 2}
        pressed = contact(**pair, interfacial_shear_strength="0 MPa", pressure_coefficient=0.2986)
        found = slide(pressed, load="20 uN", displacement=["0 nm", "100 nm"])
        radii[count] = np.sqrt(float(found["sticking_share"][0]))
        force = found["tangential_force"] / found["load"]
        assert abs(float(force[0])) < 1e-4 and float(force[1]) == pytest.approx(0.2986, rel=1e-3)
        assert float(found["coupling_residual"]) <= 1e-3
    points = float(found["points_in_contact"])
    assert (4.0 * radii[128] - radii[64]) / 3.0 == pytest.approx(0.503, abs=0.5 / np.sqrt(points / np.pi))


def test_unlike_bodies_change_the_contact_under_shear():
    found = slide(contact(first=SOFT, second=HARD, interfacial_shear_strength="20 MPa"), load="200 uN")
    area, alone = found["sheared_contact_area"], float(found["contact_area"])
    assert float(found["coupling_residual"]) <= 0.05 and "are coupled" in found.attrs["remarks"]
    assert float(area[0]) < 0.98 * alone and float(area[-1]) > float(area[0])  # pressed: held back; sliding: freed
    force = found["tangential_force"][-1] / (found["sheared_contact_area"][-1] * 20e6)
    assert float(force) == pytest.approx(1.0, abs=0.02)
    assert 0.9 < float(found["friction_efficiency"]) < 1.1
    with refusal("tangential_force", "give displacement"):
        slide(contact(first=SOFT, second=HARD), tangential_force="0.02 mN")


@pytest.mark.parametrize("coated", [None, "first", "second"])
def test_the_order_of_unlike_bodies_does_not_matter(coated):
    """The body that pressure displaces more, here the soft one or its film, slides along x, whichever is the first."""

    def forces(bodies, coated):
        film = st.Material(youngs_modulus="2 GPa", poissons_ratio=0.1, hardness="1000 GPa")
        coating = {} if coated is None else {"coating": st.Coating(material=film, thickness="0.2 um", bodies=coated)}
        pair = contact(**dict(zip(("first", "second"), bodies, strict=True)), roughness=period(32), **coating)
        return slide(pair, load="200 uN", displacement=["0.5 nm", "1 nm"])["tangential_force"].values

    other = {None: None, "first": "second", "second": "first"}[coated]
    one, two = forces((SOFT, HARD), coated), forces((HARD, SOFT), other)
    assert one[0] > 0.0
    np.testing.assert_allclose(one, two, rtol=1e-9)


def test_a_window_of_unlike_bodies_is_solved_as_a_period_of_its_mirror_images():
    window = replace(period(32), periodic=False)
    heights = contact(roughness=window).measured.solvable.one().heights  # the window is levelled before it is solved
    whole = np.concatenate([heights, heights[::-1]])
    whole = st.HeightMap(np.concatenate([whole, whole[:, ::-1]], axis=1), (2e-5, 2e-5), periodic=True)
    pair = {"first": SOFT, "second": HARD, "interfacial_shear_strength": "20 MPa"}
    given = {"displacement": ["0.5 nm", "2 nm"]}
    one = slide(contact(roughness=window, **pair), load="20 uN", **given)
    four = slide(contact(roughness=whole, nominal_area="400 um^2", **pair), load="80 uN", **given)
    np.testing.assert_allclose(one["tangential_force"].values, four["tangential_force"].values / 4.0, rtol=0.01)
    np.testing.assert_allclose(one["sheared_contact_area"].values, four["sheared_contact_area"].values / 4.0, rtol=0.01)


def test_a_liquid_between_unlike_bodies_leaves_them_uncoupled_and_says_what_that_may_change():
    wet = contact(
        first=SOFT,
        second=HARD,
        liquid=st.Liquid(relative_humidity=0.5, contact_angle_first="10 deg", contact_angle_second="10 deg"),
    )
    found = slide(wet, load="20 uN", displacement=["1 nm"])
    assert "coupling_residual" not in found
    assert "not coupled" in found.attrs["remarks"] and found.attrs["remarks"].endswith("%")
