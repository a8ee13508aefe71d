"""Laplace's pressure on maps: a solver of a few lines, Polonsky & Keer's, run in turns with the wetted points; flooded maps."""

import numpy as np
import pytest
from numpy.fft import fft2, fftfreq, ifft2
from test_rough_maps import UNIT, rough

import stiction as st
from refusals import refusal
from stiction.solvers.boundary_elements.menisci import Menisci
from stiction.solvers.boundary_elements.solve import solve_map


def polonsky_keer(heights, mean, modulus, side):
    """Pressure, gap and the displacement of a pressure; one period of a square map."""
    k = np.hypot(*np.meshgrid(*(2.0 * np.pi * fftfreq(n, side / n) for n in heights.shape)))
    compliance = np.where(k > 0.0, 2.0 / (modulus * np.where(k > 0.0, k, 1.0)), 0.0)

    def moved(p):
        return ifft2(compliance * fft2(p)).real

    p, way, square, goes_on = np.full(heights.shape, mean), np.zeros(heights.shape), 1.0, 0.0
    for _ in range(2000):
        touch, gap = p > 0.0, moved(p) - heights
        gap -= gap[touch].mean()
        before, square = square, float(np.sum(gap[touch] ** 2))
        way = np.where(touch, gap + goes_on * square / before * way, 0.0)
        answer = moved(way)
        answer -= answer[touch].mean()
        step, last = np.sum((gap * way)[touch]) / np.sum((answer * way)[touch]), p
        p = np.maximum(np.where(touch, p - step * way, p), 0.0)
        wrong = (p == 0.0) & (gap < 0.0)
        goes_on = 0.0 if wrong.any() else 1.0
        p[wrong] -= step * gap[wrong]
        p *= mean / p.mean()
        if np.abs(p - last).sum() < 1e-7 * p.sum():
            break
    gap = moved(p) - heights
    return p, gap - gap[p > 0.0].mean(), moved


def condensed(heights, mean, modulus, side, menisci):
    """Suction outside of contact over the map [Pa], share in contact, share wetted."""
    p, gap, moved = polonsky_keer(heights, mean, modulus, side)
    wet = gap < menisci.height
    while True:
        suction = menisci.pressure * wet
        p, gap, _ = polonsky_keer(heights + moved(suction), mean + suction.mean(), modulus, side)
        more = wet | (gap < menisci.height)
        if more.sum() == wet.sum():
            return menisci.pressure * (wet & (p <= 0.0)).mean(), (p > 0.0).mean(), wet.mean()
        wet = more


@pytest.mark.parametrize("humidity", [0.3, 0.6, 0.8, 0.9])
def test_as_another_solver(humidity):
    side = 2e-6
    surface = st.gaussian_surface((96, 96), (side, side), st.SelfAffine(0.8, side / 4, side / 12, 4e-9), seed=613)
    liquid = st.Liquid(relative_humidity=humidity, contact_angle_first="5 deg", contact_angle_second="40 deg")
    contact = st.Contact(first="silicon", second="silicon", roughness=surface, nominal_area="100 um^2", liquid=liquid)
    cosine = 0.5 * (np.cos(np.radians(5.0)) + np.cos(np.radians(40.0)))
    suction = 8.314462618 * 293.15 * -np.log(humidity) / 18.05e-6
    menisci = Menisci(suction, 2.0 * float(liquid.tension) / suction * cosine)
    pull, touch, wet = condensed(surface.heights, 1.5e7, contact.contact_modulus, side, menisci)
    found = st.solve(contact, load=1.5e7 * 1e-10, model="boundary_elements", yielding="none")
    assert float(found["contact_area_pixels"]) == pytest.approx(touch * 1e-10, rel=2.0 / (touch * 96**2))
    edge = touch * 1e-10 - float(found["contact_area"])  # of pixels, wetted too
    assert -float(found["load_meniscus"]) == pytest.approx(pull * 1e-10 + suction * edge, rel=0.002)
    assert 0.01 < wet < 0.9


@pytest.mark.parametrize("hardness", [None, 0.05])
@pytest.mark.parametrize("periodic", [True, False])
def test_a_flooded_map_is_the_dry_one_under_load_and_suction(hardness, periodic):
    """Where every gap is filled the suction presses everywhere alike."""
    heights, suction = rough(64), 2e-3
    how = {"modulus": 1.0, "periodic": periodic}
    menisci = Menisci(suction, 10.0 * float(np.ptp(heights)))
    (wet,) = solve_map(heights, UNIT, loads=[1e-3], hardness=hardness, menisci=menisci, **how)
    (dry,) = solve_map(heights, UNIT, loads=[1e-3 + suction], hardness=hardness and hardness + suction, **how)
    assert wet.load == pytest.approx(1e-3, rel=1e-12)
    if periodic:  # one that ends is bent by the suction
        assert wet.area == pytest.approx(dry.area, rel=1e-3)
        assert wet.separation == pytest.approx(dry.separation, rel=1e-4)
    assert wet.pull == pytest.approx(suction * (1.0 - wet.area), rel=1e-9)
    assert float(wet.pressure.mean()) == pytest.approx(wet.load + suction - suction * wet.area_pixels, rel=2e-3)
    assert wet.pressure.max() <= (hardness or np.inf) * (1.0 + 1e-12)


def test_the_wetter_the_more_contact():
    heights, areas = rough(64), []
    for suction in (0.0, 1e-4, 1e-3, 1e-2):
        menisci = Menisci(suction, 0.3 * float(np.std(heights))) if suction else None
        (found,) = solve_map(heights, UNIT, modulus=1.0, loads=[5e-4], periodic=True, menisci=menisci)
        areas.append(found.area)
        assert found.residual <= 1e-5 and found.load_error < 1e-9
    assert areas == sorted(areas) and areas[-1] > 2.0 * areas[0]


def test_friction_is_of_load_and_pull():
    """tau_0 A + alpha (P + pull): what presses the solids; without the liquid, by name, the dry contact."""
    side = 2e-6
    surface = st.gaussian_surface((64, 64), (side, side), st.SelfAffine(0.8, side / 4, side / 8, 4e-9), seed=614)
    dry = st.Contact(
        first="silicon", second="silicon", roughness=surface, nominal_area="100 um^2",
        interfacial_shear_strength="100 MPa", pressure_coefficient=0.05,
    )  # fmt: skip
    liquid = st.Liquid(relative_humidity=0.9, contact_angle_first="10 deg", contact_angle_second="10 deg")
    how = {"load": "2 mN", "model": "boundary_elements", "tangential": "briscoe_tabor_1978", "yielding": "none"}
    wet = st.solve(dry.replace(liquid=liquid), **how)
    expected = 1e8 * float(wet["contact_area"]) + 0.05 * (2e-3 - float(wet["load_meniscus"]))
    assert float(wet["friction_force"]) == pytest.approx(expected, rel=2e-3)
    left_out = st.solve(dry.replace(liquid=liquid), meniscus="none", **how)
    assert float(left_out["friction_force"]) == float(st.solve(dry, **how)["friction_force"])
    assert "load_meniscus" not in left_out
    assert float(wet["contact_area"]) > 1.05 * float(left_out["contact_area"])


@pytest.mark.parametrize(("numbers", "name"), [((0.0, 1.0), "pressure"), ((1.0, np.inf), "height")])
def test_what_cannot_be_is_refused(numbers, name):
    with refusal(f"menisci.{name}"):
        Menisci(*numbers)
