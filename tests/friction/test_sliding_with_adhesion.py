"""`st.slide` on adhesive maps: Savkoor and Briggs's sphere, laws of mode mixity on a rough map, and what is refused."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import stiction as st
from refusals import refusal
from stiction.solvers.shear.mode_mixity import MODE_MIXITIES

POINTS, PITCH = 128, 1e-8
RADIUS, JKR = 64.0 * PITCH, 25.6 * PITCH  # of the sphere, and of its contact without load
MODULUS = 1e9  # E*, of two like bodies without Poisson's ratio: G = E*
WORK = 2.0 * MODULUS * JKR**3 / (9.0 * math.pi * RADIUS**2)
PULL_OFF = 1.5 * math.pi * WORK * RADIUS
ADHESIVE = {"model": "boundary_elements", "adhesion": "shortest_range", "yielding": "none"}


def body(modulus, nu):
    return st.Material(youngs_modulus=modulus, poissons_ratio=nu, hardness="1000 GPa")


@pytest.mark.parametrize(("law", "zeta"), [("savkoor_briggs_1977", 1.0), ("papangelo_ciavarella_2018", 0.5)])
def test_the_area_of_a_sphere_falls_as_in_closed_form(law, zeta):
    """(4 E* a^3/(3 R) - P)^2/(8 pi E* a^3) = y w with G_T = beta T^2/(32 pi a^3), beta = 4/G: within 4 %; the sphere sticks."""
    x, y = (np.arange(POINTS) - POINTS / 2 + 0.37) * PITCH, (np.arange(POINTS) - POINTS / 2 + 0.21) * PITCH
    sphere = st.HeightMap(-(x[None] ** 2 + y[:, None] ** 2) / (2.0 * RADIUS), (POINTS * PITCH, POINTS * PITCH), periodic=True)
    one, load = body(2.0 * MODULUS, 0.0), 0.05 * PULL_OFF
    contact = st.Contact(
        first=one, second=one, roughness=sphere, nominal_area=(POINTS * PITCH) ** 2, work_of_adhesion=WORK, peeling=zeta,
        interfacial_shear_strength="1 GPa",
    )  # fmt: skip
    found = st.slide(contact, load=load, displacement=["0 nm", "10 nm", "18 nm", "24 nm"], mode_mixity=law, **ADHESIVE)
    forces, areas = found["tangential_force"].values, found["sheared_contact_area"].values

    def open_edge(radius, force):
        x = 4.0 / MODULUS * force**2 / (32.0 * math.pi * radius**3) / WORK
        normal = (4.0 / 3.0 * MODULUS * radius**3 / RADIUS - load) ** 2 / (8.0 * math.pi * MODULUS * radius**3)
        return normal / WORK - MODE_MIXITIES[law].share(np.array([x]), zeta)[0]

    closed = np.array([brentq(open_edge, 0.75 * JKR, 1.15 * JKR, (force,)) for force in forces]) ** 2
    np.testing.assert_allclose(areas / areas[0], closed / closed[0], rtol=0.04)
    assert areas[-1] < 0.97 * areas[0] and forces[-1] > 1.2 * PULL_OFF


def rough(**more):
    side = 1e-6
    surface = st.gaussian_surface((64, 64), (side, side), st.SelfAffine(0.8, side / 2, side / 8, 1.5e-2 * side), seed=2)
    one = body("1 GPa", 0.3)
    given = {"first": one, "second": one, "roughness": surface, "nominal_area": side**2, "work_of_adhesion": "50 mJ/m^2"}
    return st.Contact(**given | {"interfacial_shear_strength": "20 MPa"} | more)


def slide(contact, **more):
    return st.slide(contact, **{"load": "2 uN"} | ADHESIVE | more)


def test_on_a_rough_map_shear_takes_friction_between_none_and_the_brittle_edge():
    """Nothing peels without a law; the brittle edge peels most, and less of the shear energy peels less."""
    alone = slide(rough())
    force = float(alone["friction_force"])
    assert force == float(st.solve(rough(), load="2 uN", **ADHESIVE).friction_force)
    assert float(alone["largest_tangential_force"]) == pytest.approx(force, rel=1e-12)
    assert "sheared_contact_area" not in alone
    brittle, part, endless, uniform = (
        slide(rough(peeling=zeta), mode_mixity=law)
        for law, zeta in (
            ("savkoor_briggs_1977", 1.0),
            ("savkoor_briggs_1977", 0.3),
            ("papangelo_ciavarella_2018", 0.3),
            ("menga_carbone_dini_2018", 1.0),
        )
    )
    peaks = [float(one["largest_tangential_force"]) / force for one in (brittle, part, endless, uniform)]
    assert 0.3 < peaks[0] < peaks[1] < 0.99 * peaks[3] and peaks[1] <= peaks[2] < peaks[3]
    assert peaks[3] == pytest.approx(1.0, abs=1e-6)
    area = brittle["sheared_contact_area"].values
    assert (np.diff(area) <= 0.0).all() and area[0] == pytest.approx(float(brittle["contact_area"]), rel=1e-9)
    assert brittle.attrs["mode_mixity"] == "savkoor_briggs_1977" and "disputed" in brittle.attrs["remarks"]
    weak = slide(rough(peeling=1.0), mode_mixity="savkoor_briggs_1977", residual_strength=0.3, weakening_slip="5 nm")
    assert 0.2 < float(weak["friction_efficiency"]) < peaks[0]


def test_the_case_file_names_the_law(tmp_path):
    roughness = {"first": {"file": str(tmp_path / "map.npy"), "size": "1 um", "unit": "m", "periodic": True}}
    np.save(tmp_path / "map.npy", rough().measured.solvable.one().heights)
    one = {"youngs_modulus": "1 GPa", "poissons_ratio": 0.3, "hardness": "1000 GPa"}
    contact = {"first": one, "second": one, "roughness": roughness, "nominal_area": "1 um^2", "work_of_adhesion": "50 mJ/m^2"}
    contact["interfacial_shear_strength"] = "20 MPa"
    solve = {"load": "2 uN", "mode_mixity": "savkoor_briggs_1977"} | ADHESIVE
    found = st.slide_case({"contact": contact, "solve": solve})
    same = slide(rough(), mode_mixity="savkoor_briggs_1977")
    assert found["friction_efficiency"].item() == pytest.approx(float(same["friction_efficiency"]), rel=1e-6)


def test_unlike_adhesive_bodies_say_what_the_coupling_may_change():
    found = slide(rough(second=body("100 GPa", 0.3)), displacement=["1 nm"])
    assert "not coupled" in found.attrs["remarks"] and found.attrs["remarks"].endswith("%")


def test_refusals():
    with refusal("mode_mixity", "savkoor_briggs_1977", "adhesion"):
        slide(rough(), adhesion="left_out", mode_mixity="savkoor_briggs_1977")
    with refusal("mode_mixity", "savkoor_briggs_1977", "slide"):
        st.solve(rough(), load="2 uN", mode_mixity="savkoor_briggs_1977", **ADHESIVE)
    with refusal("load", "2 loads", "one load"):
        slide(rough(), load=["1 uN", "2 uN"])
