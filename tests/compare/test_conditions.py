"""No model escapes: what every result is asked, against areas, pressures and counts computed here from the results alone.

Contacts are drawn at random over what people build and beyond; every model is asked. The bounds stand here again, as numbers.
"""

import json
import math
import warnings

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import stiction as st
from cases import STEEL_ON_STEEL
from refusals import refusal
from stiction.laws.proportion import input_warnings
from stiction.laws.validity import warnings_of
from stiction.records.registry import FilmLaw, RoughSurface, of_kind
from stiction.solving.candidates import candidates, choice_of
from stiction.solving.state import expected_share

KINDS = {"impossible", "effect", "assumption", "fit", "statistics"}


def drawn(rng, film=False):
    """A contact: metals, ceramics, polymers; smooth to rough; nominal areas from a MEMS switch to a brake."""
    modulus = 10.0 ** rng.uniform(6.5, 11.6)
    given = {"youngs_modulus": modulus, "hardness": modulus * 10.0 ** rng.uniform(-2.5, -0.5), "poissons_ratio": 0.3}
    sigma = 10.0 ** rng.uniform(-9.0, -5.5)
    radius = sigma * 10.0 ** rng.uniform(0.5, 4.0)
    density = 10.0 ** rng.uniform(-1.9, -0.3) / (radius * sigma)
    coating = None
    if film:
        soft = given | {"hardness": given["hardness"] * 10.0 ** rng.uniform(-1.5, 0.5), "youngs_modulus": modulus * 0.4}
        coating = st.Coating(material=soft, thickness=sigma * 10.0 ** rng.uniform(-1.0, 2.0), bodies="first")
    return st.Contact(
        first=given, second=given, coating=coating, nominal_area=10.0 ** rng.uniform(-11.0, -3.0),
        work_of_adhesion=10.0 ** rng.uniform(-3.0, 0.0), interfacial_shear_strength=0.1 * given["hardness"],
        roughness=st.Roughness(asperity_height_deviation=sigma, asperity_radius=radius, asperity_density=density),
    )  # fmt: skip


def hardness_of(contact):
    """Of the softest of what is there."""
    return min(one.hardness for one in (contact.first, contact.second, contact.coating and contact.coating.material) if one)


def check(contact, found):
    """That every one of the plain facts about a result is among its validity warnings."""
    validity_warnings = warnings_of(found)
    said = {(one.quantity, one.kind) for one in validity_warnings}
    assert all(one.kind in KINDS for one in validity_warnings)
    fraction = float(found["contact_area"]) / contact.nominal_area
    pressure = float(found["load"]) / contact.nominal_area / hardness_of(contact)
    assert math.isclose(float(found["area_fraction"]), fraction, rel_tol=1e-9)
    assert math.isclose(float(found["nominal_pressure"]), float(found["load"]) / contact.nominal_area, rel_tol=1e-9)
    assert (fraction > 1.0 + 1e-9) == (("area_fraction", "impossible") in said)
    assert (pressure > 1.0) == (("nominal_pressure_over_hardness", "impossible") in said)
    if found.attrs["asperity"] != "none" and 0.1 < fraction <= 1.0:
        assert "area_fraction" in {one.quantity for one in validity_warnings}
    if "touching_asperities" in found:
        assert (float(found["touching_asperities"]) < 10.0) == (("touching_asperities", "statistics") in said)
    if {"friction_force", "load_plastic", "load_share_without_friction"} <= set(found):
        lost = float(found["load_share_without_friction"])
        assert (lost > 0.5) == (("load_share_without_friction", "effect") in said)
        # where plastic asperities resist nothing, their load is in that share
        if found.attrs["tangential"] in ("soft_coating_2015", "chang_etsion_bogy_1988"):
            assert lost >= min(float(found["load_plastic"]) / float(found["load"]), 1.0) - 1e-9
    return said


@pytest.mark.parametrize("film", (False, True), ids=("bare", "coated"))
def test_no_model_escapes(film):
    rng = np.random.default_rng(11 + film)
    met, solved = set(), set()
    for number in range(9 if film else 24):  # a film is solved for each
        contact = drawn(rng, film)
        pressure = 10.0 ** rng.uniform(-9.0, 0.3) if number < 8 or not film else 1.5  # over the hardness
        load = contact.nominal_area * hardness_of(contact) * pressure
        for one in candidates(contact):
            try:
                found = st.solve(contact, load=load, model=one.name)
            except st.InputError:
                continue  # it says itself why not
            met |= check(contact, found)
            solved.add(one.name)
    asked = {key for key, model in of_kind(RoughSurface).items() if film == model.on_film and model.of_map is None}
    asked |= {key for key, one in of_kind(FilmLaw).items() if film and one.interchangeable and key != "sequential"}
    assert asked - solved <= {"hariri_zu_ben_mrad_2006"}  # which is for one kind of surface
    expected = {("area_fraction", "impossible"), ("nominal_pressure_over_hardness", "impossible"), ("adhesion_share", "effect"),
                ("touching_asperities", "statistics"), ("load_share_without_friction", "effect"),
                ("area_fraction", "assumption"),
                ("mean_pressure_over_hardness", "effect"), ("touching_share", "assumption")}  # fmt: skip
    assert expected <= met


def test_asperities_that_flow_by_degrees_count_as_frictionless():
    """Most of the load on plastic asperities, and mu of 7e-4 without a word: the graded film, and the gradual bare asperity."""
    titanium = {"youngs_modulus": 115e9, "poissons_ratio": 0.33, "hardness": 3.4e9}
    sulphide = {"youngs_modulus": 30e9, "poissons_ratio": 0.25, "hardness": 0.4e9}
    bare = st.Contact(
        first=titanium, second=titanium, nominal_area=1e-6, work_of_adhesion=0.1,
        roughness=st.Roughness(asperity_height_deviation=2e-7, asperity_radius=2e-5, asperity_density=1e10),
    )  # fmt: skip
    film = bare.replace(coating={"material": sulphide, "thickness": 1e-6, "bodies": "first"})
    soft = bare.replace(first=titanium | {"hardness": 0.4e9}, second=titanium | {"hardness": 0.4e9})
    for contact, model, options in ((film, "graded", {}), (soft, "soft_coating_2015", {"transition": "gradual"})):
        found = st.solve(contact, load=0.1, model=model, **options)
        share = float(found["load_plastic"]) / float(found["load"])
        assert share > 0.5 and float(found["friction_coefficient"]) < 0.1
        said = next(one for one in warnings_of(found) if one.quantity == "load_share_without_friction")
        assert said.kind == "effect" and said.most >= min(share, 1.0) - 1e-9


@pytest.mark.parametrize("modulus", (1e8, 2e14))
def test_a_film_beyond_the_table_of_layers_is_solved(modulus):
    """A single film more than 200 times as soft or stiff as its bodies ended the whole comparison with a traceback."""
    body = {"youngs_modulus": 210e9, "poissons_ratio": 0.3, "hardness": 1e11}
    contact = st.Contact(
        first=body, second=body, nominal_area=1e-6, interfacial_shear_strength=1e6,
        coating={"material": body | {"youngs_modulus": modulus}, "thickness": 5e-8, "bodies": "first"},
        roughness=st.Roughness(asperity_height_deviation=1e-7, asperity_radius=1e-5, asperity_density=5e10),
    )  # fmt: skip
    found = st.solve(contact, separation=1e-7, model="layered")
    assert float(found["contact_area"]) > 0.0


def test_a_handful_of_asperities_is_a_lottery():
    """1e-30 N on a millimetre gave four digits of mu from 5e-25 asperities."""
    contact = drawn(np.random.default_rng(3))
    found = st.solve(contact, load=1e-9 * contact.nominal_area, model="greenwood_williamson_1966")
    few = next(one for one in warnings_of(found) if one.quantity == "touching_asperities")
    assert few.kind == "statistics" and few.most == pytest.approx(float(found["touching_asperities"])) and few.most < 10.0
    of_theory = st.solve(contact, load=1e-9 * contact.nominal_area, model="persson_2001")
    assert "touching_asperities" in {one.quantity for one in warnings_of(of_theory)}


def test_expected_share_against_integrals():
    """F_0 where F_1 is given, both by quadrature and the root by Brent."""

    def moment(h, power):
        return quad(lambda z: (z - h) ** power * math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi), h, max(h, 0.0) + 12.0)[0]

    for area in (3.0, 0.4, 1e-3, 1e-9):
        h = brentq(lambda at, area=area: math.log(moment(at, 1) / area), -4.0, 8.0)
        assert expected_share(np.array([area]))[0] == pytest.approx(moment(h, 0), rel=1e-4)
    assert expected_share(np.array([0.0]))[0] == 0.0


@pytest.mark.parametrize("h", [11.9, 12.1, 16.0, 30.0])
def test_expected_share_where_next_to_nothing_touches(h):
    """F_1 = phi(h) - h F_0(h), which loses all digits of a double there."""
    with mpmath.workdps(60):
        share = mpmath.erfc(mpmath.mpf(h) / mpmath.sqrt(2)) / 2
        area = mpmath.npdf(h) - h * share
    assert expected_share(np.array([float(area)]))[0] == pytest.approx(float(share), rel=1e-3, abs=0.0)


SWAPPED = {"48 nm": "50 um", "50 um": "48 nm"}


def test_what_cannot_be_a_rough_surface_has_an_input_warning_where_it_is_read(tmp_path):
    path = tmp_path / "case.toml"
    text = f'{STEEL_ON_STEEL}[solve]\nmodel = "soft_coating_2015"\nload = "1 N"\n'
    path.write_text(text)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert input_warnings(st.read_case(path).subject) == []
    for old, new in SWAPPED.items():
        text = text.replace(f'= "{old}"', f'= "<{new}>"')
    path.write_text(text.replace('"<', '"').replace('>"', '"'))
    with pytest.warns(st.InputWarning, match="sqrt.sigma/R. is 32.3.*swapped"):
        read = st.read_case(path)
    found = st.solve_case(read)
    assert ("sharpness", "impossible") in {(one.quantity, one.kind) for one in warnings_of(found)}
    assert "swapped" in json.dumps([one.as_data() for one in warnings_of(found)])


def test_indices_are_asked_what_they_know():
    """Without a density of asperities nobody knows the nominal area."""
    known = {one.quantity for one in warnings_of(st.solve(st.Indices(theta=40.0, lam=10.0), separation=-1.0))}
    assert "touching_share" in known and not known & {"area_fraction", "touching_asperities"}
    more = st.solve(st.Indices(theta=40.0, lam=10.0, roughness_parameter=0.5), separation=-3.0)
    assert float(more["area_fraction"]) == pytest.approx(math.pi * 0.5 * float(more["contact_area"]))
    assert "nominal_pressure" not in more


def test_names_of_a_comparison_are_names_of_models():
    contact = drawn(np.random.default_rng(5), film=True)
    for one in candidates(contact):
        assert choice_of(one.name, {}, contact) == one.choice
    with refusal("model", "nobody_1900", "stiction models"):
        choice_of("nobody_1900", {}, contact)
    data = st.compare(contact, load=contact.nominal_area * hardness_of(contact) * 1e-3)
    for name, mu in zip(data["model"].values, data["friction_coefficient_at_load"].values, strict=True):
        if np.isfinite(mu):
            alone = st.solve(contact, load=data.attrs["working_load"], model=str(name))
            assert float(alone["friction_coefficient"]) == pytest.approx(mu, rel=1e-9)
