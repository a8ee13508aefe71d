"""One asperity in section and the place in the plane, against closed forms; shares; how studies are told and stopped."""

import math

import numpy as np
import pytest

import stiction as st
from stiction.quantities.errors import InputError
from stiction.report.share_pictures import share_figure, shares_of, stacks
from stiction.studies.paper.place import place_of, plasticity_line
from stiction.studies.stresses.one_asperity import one_asperity
from stiction.web.background import Progress


def _steel(**more):
    rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    steel = "hardened_steel_52100"
    return st.Contact(first=steel, second=steel, roughness=rough, nominal_area="1 mm^2", work_of_adhesion="1 J/m^2", **more)


def test_a_pressed_asperity_has_the_stress_of_the_textbook():
    """Johnson 1985, section 4.2 (c): largest shear 0.31 p0 at a depth of 0.48 a for nu = 0.3, 0.62 p0 after von Mises."""
    found = one_asperity(st.Indices(theta=40, lam=10), 0.1, 0.0)
    peak = 1.5 * found.pressure * 2.8  # p0 over the yield stress, H/Y = 2.8
    assert found.largest / peak == pytest.approx(0.62, abs=0.003) and found.at[1] == pytest.approx(0.48, abs=0.005)
    assert abs(found.at[0]) < 1e-3 and found.stress.max() == pytest.approx(found.largest, rel=2e-3)


def test_load_and_pressure_are_those_of_hertz():
    contact = _steel()
    radius = 0.3
    found = one_asperity(contact, radius, 0.0)
    a = radius * math.sqrt(50e-6 * 48e-9)
    modulus = 1.0 / (2.0 * (1.0 - 0.3**2) / 210e9)
    load = 4.0 * modulus * a**3 / (3.0 * 50e-6)
    assert found.load * contact.scales().load == pytest.approx(load, rel=1e-12)
    assert found.pressure == pytest.approx(load / (math.pi * a * a) / contact.first.hardness, rel=1e-12)


def test_a_film_like_its_body_changes_nothing():
    groups = {"theta": 40.0, "lam": 10.0, "hardness_to_yield": 2.8}
    bare = one_asperity(st.Indices(**groups), 0.2, 0.3)
    film = one_asperity(st.Indices(**groups, n_E=1.0, n_H=1.0, tau=2.0, film_aspect=0.13), 0.2, 0.3)
    assert film.load == pytest.approx(bare.load, rel=1e-6) and film.pressure == pytest.approx(bare.pressure, rel=1e-6)
    inside = bare.stress > 0.05 * bare.stress.max()
    np.testing.assert_allclose(film.stress[inside], bare.stress[inside], rtol=2e-3)
    assert film.largest == pytest.approx(bare.largest, rel=2e-3) and film.thickness == pytest.approx(0.13 / 0.2)


def test_the_section_turns_with_the_force():
    found = one_asperity(st.Indices(theta=40, lam=10), 0.2, 0.5)
    assert found.at[0] != 0.0 and found.largest > one_asperity(st.Indices(theta=40, lam=10), 0.2, 0.0).largest


@pytest.mark.parametrize("radius", [0.0, -1.0, math.nan, math.inf])
def test_a_radius_that_is_none_is_refused(radius):
    with pytest.raises(InputError):
        one_asperity(st.Indices(theta=40, lam=10), radius, 0.0)


def test_the_place_has_the_plasticity_index_of_the_contact():
    contact = _steel()
    place = place_of(contact)
    assert place.plasticity_index == pytest.approx(float(contact.plasticity_index), rel=1e-12)
    theta, lam = place.bodies
    assert plasticity_line(np.array([theta]), place.plasticity_index)[0] == pytest.approx(lam, rel=1e-9)
    assert place.film is None
    with pytest.raises(InputError, match="work_of_adhesion"):
        place_of(contact.replace(work_of_adhesion=0.0))


def test_shares_are_shares_of_the_parts():
    curve = st.solve(_steel(), separation=[96e-9, 48e-9, 0.0])
    known = stacks(curve)
    assert "contact area, by state" in known and "friction, by state" in known
    for total, parts in known.values():
        shares = shares_of(curve, parts)
        np.testing.assert_allclose(shares.sum(axis=0), 1.0, rtol=1e-12)
        assert total not in parts
    total, parts = known["contact area, by state"]
    np.testing.assert_allclose(sum(curve[name].values for name in parts), curve[total].values, rtol=1e-9)


def test_shares_fill_their_picture():
    """All of the sum from the least to the largest load that presses, and nothing above."""
    curve = st.solve(_steel(), load=["1 mN", "10 mN", "1 N"])
    (axes,) = share_figure(curve, "contact area, by state").axes
    assert axes.get_ylim() == (0.0, 1.0) and axes.get_xlim() == (1e-3, 1.0)


def test_a_study_is_stopped_at_its_next_step_and_after_its_time():
    progress, seen = Progress(), []
    with pytest.raises(KeyboardInterrupt):
        for one in progress("counting")(range(10)):
            seen.append(one)
            if one == 3:
                progress.stop()
    assert seen == [0, 1, 2, 3] and progress.text == "counting" and not progress.too_long
    late = Progress(seconds=-1.0)
    with pytest.raises(KeyboardInterrupt):
        late.tell(1, "best so far")
    assert late.too_long
