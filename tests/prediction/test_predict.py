"""The predictive distribution of mu, against closed forms and draws that do not use the package."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.stats import norm

import stiction as st
from stiction.case.read import case_in
from stiction.contact.interfaces import Interface
from stiction.studies.prediction.area import grown_to
from stiction.studies.prediction.finish import with_finish
from stiction.studies.prediction.junctions import grown, squeezed
from stiction.surfaces.theory.moments import LEAST_DENSITY

ROUGH = {"asperity_height_deviation": 2e-7, "asperity_radius": 2e-5, "asperity_density": 1e10}
# Hard to the touch of a tenth of its modulus: all contacts are plastic.
PLASTIC = {"youngs_modulus": 1e12, "poissons_ratio": 0.3, "hardness": 1e8, "material_class": "polymer"}
RIGID = {"youngs_modulus": 1e12, "poissons_ratio": 0.3, "hardness": 1e11, "material_class": "ceramic"}
SOFT = {"youngs_modulus": 2e6, "poissons_ratio": 0.49, "hardness": 1e7, "material_class": "elastomer"}


def pair(first=PLASTIC, second=RIGID, rough=ROUGH, **more):
    return st.Contact(first=first, second=second, roughness=rough, nominal_area=1e-4, **more)


def test_a_plastic_contact_has_tau_over_hardness():
    found = st.predict(pair(interfacial_shear_strength=5e6), load="1 N")
    assert found.friction_coefficient.item() == pytest.approx(0.05, rel=0.02)
    assert found.contact_area.item() == pytest.approx(1e-8, rel=0.02)
    assert found.friction_force.item() == pytest.approx(0.05, rel=0.02)
    assert "plastic" in found.regime
    low, high = (found[f"friction_coefficient_{end}"].item() for end in ("low", "high"))
    assert low < 0.98 * 0.05 and 1.02 * 0.05 < high  # a strength of one number is known to 2.5 %


@pytest.mark.parametrize(
    "stated",
    [
        {"interfacial_shear_strength": 0.0, "pressure_coefficient": 0.275},
        {"interface": Interface(interfacial_shear_strength=1.0, pressure_coefficient=0.275)},
    ],
)
def test_an_exact_pressure_coefficient_alone_has_an_interval(stated):
    found = st.predict(pair(**stated), load="1 N")
    ends = [found[f"friction_coefficient{end}"].item() / 0.275 for end in ("_low", "", "_high")]
    assert ends == pytest.approx([0.9756, 1.0, 1.025], abs=2e-3)


def test_what_is_pressed_flat_has_tau_over_nominal_pressure():
    found = st.predict(pair(first=SOFT, interfacial_shear_strength=1e5), load="500 N")
    exact = 1e5 * 1e-4 / 500.0
    ends = [found[f"friction_coefficient{end}"].item() / exact for end in ("_low", "", "_high")]
    assert ends == pytest.approx([0.9756, 1.0, 1.025], abs=2e-3)  # a strength of one number is known to 2.5 %
    assert "pressed flat" in found.regime
    assert found.shares == {}


def test_the_strength_of_a_state_is_drawn_from_its_quantiles():
    """Of a plastic contact ln mu = ln tau_0 - ln H, and tau_0 is lognormal between its printed quantiles."""
    state = {"interfacial_shear_strength": 5e6, "range": {"interfacial_shear_strength": [2e6, 12.5e6]}}
    found = st.predict(pair(interface=state), load="1 N", level=0.8)
    width = math.log(2.5) / norm.ppf(0.95)
    for end, level in (("_low", 0.1), ("", 0.5), ("_high", 0.9)):
        expected = 0.05 * math.exp(width * norm.ppf(level))
        assert found[f"friction_coefficient{end}"].item() == pytest.approx(expected, rel=0.04)
    stated = [5e6 * math.exp(width * norm.ppf(level)) for level in (0.5, 0.1, 0.9)]
    assert found.attrs["strength"] == pytest.approx(stated, rel=0.04)
    assert found.shares["interface"] > 0.95


def test_the_interface_is_no_stronger_than_the_weaker_body():
    bulk = 1e8 / (2.8 * math.sqrt(3.0))
    found = st.predict(pair(interfacial_shear_strength=5e8), load="1 N")
    tresca = 1e8 / 5.6 / 1e8  # Y/2, with H = 2.8 Y
    assert found.friction_coefficient.item() == pytest.approx(0.5 * (tresca + bulk / 1e8), rel=0.02)
    known = 1.025  # a strength of one number is known to 2.5 %
    assert tresca < known * found.friction_coefficient_low < found.friction_coefficient_high < known * bulk / 1e8 * 1.02
    assert f"{5e8 / bulk:.3g} times as strong" in found.warnings[0]
    assert not st.predict(pair(interfacial_shear_strength=0.9 * bulk), load="1 N").warnings


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9, 0.99])
def test_a_junction_grows_until_its_interface_gives_way(share):
    """p^2 + alpha tau^2 = H^2 at the load P = p A, solved by bisection for the area."""
    hardness, alpha = 1.0, 3.0 * 2.8**2
    bulk = hardness / math.sqrt(alpha)

    def left(area):
        return (1.0 / area) ** 2 + alpha * (share * bulk) ** 2 - hardness**2

    expected = brentq(left, 1.0, 1e3)
    column = np.array([[1.0]])
    found = grown(np.array([0.2]), column, share * bulk * column, hardness * column, bulk * column)
    assert found.item() == pytest.approx(expected, rel=1e-9)
    assert grown(np.array([0.01]), column, share * bulk * column, column, bulk * column).item() == 1.0


def test_tabors_junctions_are_met_where_the_interface_is_strong():
    """mu = c/(3 sqrt(1 - c^2)), Tabor's alpha of 9, within 7 % from c = 0.9 on."""
    column, bulk = np.array([[1.0]]), 1.0 / (2.8 * math.sqrt(3.0))
    for share in (0.9, 0.95, 0.99):
        area = grown(np.array([0.9]), column, share * bulk * column, column, bulk * column).item()
        assert share * bulk * area == pytest.approx(share / 3.0 / math.sqrt(1.0 - share**2), rel=0.07)


def test_a_stated_strength_grows_junctions_between_tabor_and_mises():
    """At tau_0 = H/10 the area grows 1.048 times with Tabor's alpha of 9, and 1.143 times with (H/tau_b)^2 = 23.5."""
    column, bulk = np.array([[1.0]]), 1.0 / (2.8 * math.sqrt(3.0))
    stated = grown(np.array([0.9]), column, 0.1 * column, column, bulk * column, 0.0).item()
    assert 1.0 / math.sqrt(1.0 - 9.0 * 0.01) < stated < 1.0 / math.sqrt(1.0 - 2.8**2 * 3.0 * 0.01)
    assert stated < grown(np.array([0.9]), column, 0.1 * column, column, bulk * column, 0.5).item()


def test_elastic_spots_do_not_grow():
    column = np.array([[1.0]])
    assert grown(np.array([0.9]), 0.1 * column, 0.1 * column, column, 0.2 * column).item() == 1.0


def test_a_soft_film_bears_at_most_the_hardness_below():
    column = np.array([[1.0]])
    thin = squeezed(np.array([1.0 - 1e-12]), column, 1e3 * column, column, column, 5.0 * column)
    assert thin.item() == pytest.approx(5.0, rel=1e-9)
    assert squeezed(np.array([1.0]), column, 7.3 * column, column, column, 5.0 * column).item() == pytest.approx(2.0)
    assert squeezed(np.array([0.5]), column, 1e-6 * column, column, column, 5.0 * column).item() == pytest.approx(1.0, abs=1e-6)


def test_adhesion_that_does_nothing_changes_nothing():
    dry = st.predict(pair(interfacial_shear_strength=5e6), load="10 N")
    faint = st.predict(pair(interfacial_shear_strength=5e6, work_of_adhesion=1e-9), load="10 N")
    for end in ("", "_low", "_high"):
        name = f"friction_coefficient{end}"
        assert faint[name].item() == pytest.approx(dry[name].item(), rel=1e-4)


def test_samples_of_a_yield_stress_above_the_hardness_refuse_no_prediction():
    """Adhesion and ageing depend on neither; fuzz seed 5000005 was refused after minutes because of a few such samples."""
    plastic = {"youngs_modulus": "1 TPa", "poissons_ratio": 0.3, "hardness": "100 MPa", "material_class": "polymer"}
    contact = {
        "first": plastic | {"yield_stress": "80 +/- 10 MPa"}, "second": plastic | {"hardness": "100 GPa"},
        "nominal_area": "1 cm^2",
        "roughness": {"asperity_height_deviation": "200 nm", "asperity_radius": "20 um", "asperity_density": "1e10 1/m^2"},
        "interfacial_shear_strength": "5 MPa", "work_of_adhesion": "1 nJ/m^2",
        "hold_time": "100 s", "reference_time": "1 s", "ageing_rate": 0.02,
    }  # fmt: skip
    found = st.predict({"contact": contact, "solve": {"load": ["10 N"]}})
    aged = 5e6 * (1.0 + 0.02 * math.log(101.0))
    assert found.friction_coefficient.item() == pytest.approx(aged / PLASTIC["hardness"], rel=0.05)


def test_where_neither_is_stated_it_is_a_mixture_and_says_so():
    found = st.predict(st.Contact(first="copper", second="copper", roughness=ROUGH, nominal_area=1e-4), load="10 N")
    stated = st.predict(
        st.Contact(first="copper", second="copper", roughness=ROUGH, nominal_area=1e-4, interface="oxidised metal"), load="10 N"
    )
    assert "not stated" in found.warnings[0] and found.next_step.startswith("state the interface")
    low, high = map(float, re.search(r"([\d.]+) to ([\d.]+) with oxidised metal", found.warnings[0]).groups())
    assert low == pytest.approx(stated.friction_coefficient_low.item(), rel=0.03)
    assert high == pytest.approx(stated.friction_coefficient_high.item(), rel=0.03)
    assert found.friction_coefficient_low < stated.friction_coefficient_low
    assert not any("not stated" in one for one in stated.warnings)


def test_clean_copper_seizes_and_oxidised_copper_does_not():
    """Friction of copper: 2.2 to 16 in vacuum, 0.6 to 1.6 in air (validation/contacts)."""
    clean, oxidised = (
        st.predict(st.Contact(first="copper", second="copper", roughness=ROUGH, nominal_area=1e-4, interface=name), load="10 N")
        for name in ("clean metal", "oxidised metal")
    )
    assert clean.friction_coefficient > 1.0 and clean.friction_coefficient_high > 2.2
    assert 0.1 < oxidised.friction_coefficient_low < 0.6 < oxidised.friction_coefficient_high < 2.0


def test_shares_are_those_of_a_sum_of_logarithms():
    """Of a plastic contact ln mu = ln tau_0 - ln H: variances of the state and of a lognormal hardness add up."""
    state = {"interfacial_shear_strength": "5 MPa", "range": {"interfacial_shear_strength": ["2.5 MPa", "10 MPa"]}}
    case = {
        "contact": {
            "first": {**PLASTIC, "hardness": {"median": "100 MPa", "factor": 1.3}, "youngs_modulus": "1000 GPa"},
            "second": {**RIGID, "hardness": "100 GPa", "youngs_modulus": "1000 GPa"},
            "roughness": {"asperity_height_deviation": "0.2 um", "asperity_radius": "20 um", "asperity_density": "1e10 1/m^2"},
            "nominal_area": "1 cm^2",
            "interface": state,
        },
        "solve": {"load": "1 N"},
    }
    found = st.predict(case)
    of_state, of_hardness = (math.log(2.0) / norm.ppf(0.95)) ** 2, math.log(1.3) ** 2
    expected = of_state / (of_state + of_hardness)
    assert found.shares["interface"] == pytest.approx(expected, abs=0.06)
    assert sum(found.shares.values()) == pytest.approx(1.0, abs=0.02)


def test_a_band_along_the_load():
    found = st.predict(pair(interface="dry polymer"), load=["0.1 N", "1 N", "10 N"])
    assert found.friction_coefficient.dims == ("load",) and found["load"].values.tolist() == [0.1, 1.0, 10.0]
    assert found.friction_coefficient_samples.dims == ("sample", "load")
    assert (found.friction_coefficient_low < found.friction_coefficient).all()


def test_the_same_question_has_the_same_answer():
    one, other = (st.predict(pair(interface="dry polymer"), load="1 N") for _ in range(2))
    assert one.identical(other)


@pytest.mark.parametrize(
    ("given", "field"), [({"load": "0 N"}, "load"), ({"load": None}, "load"), ({"load": "1 N", "level": 1.0}, "level")]
)
def test_bad_input_is_refused(given, field):
    with pytest.raises(st.InputError) as error:
        st.predict(pair(interfacial_shear_strength=5e6), **given)
    assert error.value.field == field


def test_a_finish_leaves_the_slope_open():
    """Of an elastic contact mu = tau_0 kappa/(E* h'): with Sq stated it scatters as the slope of the finish does."""
    hard = {"youngs_modulus": 1e9, "poissons_ratio": 0.3, "hardness": 1e11}
    contact = pair(hard, hard, {"rms_height": "50 nm", "finish": "polished"}, interfacial_shear_strength=1e6)
    found = st.predict(contact, load="50 N")
    low, high = 0.01, 0.08  # 5 and 95 % of the slope of polished surfaces (finishes.toml)
    ratio = found.friction_coefficient_high.item() / found.friction_coefficient_low.item()
    assert ratio == pytest.approx(high / low, rel=0.25)
    assert next(iter(found.shares)) == "finish of the surface" and found.shares["finish of the surface"] > 0.8


def test_a_scan_answers_by_the_contact_of_its_map():
    """Its area is that of the solved map, in a narrower interval than its numbers alone leave."""
    spectrum = st.SelfAffine(hurst=0.8, rolloff=10e-6, shortest=1e-6, deviation=8e-9)
    surface = st.gaussian_surface((128, 128), (20e-6, 20e-6), spectrum, seed=1)
    bodies = {"youngs_modulus": 1e9, "poissons_ratio": 0.3, "hardness": 1e11}
    scanned = pair(bodies, bodies, surface, interfacial_shear_strength=1e6)
    found = st.predict(scanned, load="200 N")
    solved = st.solve(scanned, load="200 N", model="boundary_elements").contact_area.item()
    assert found.contact_area.item() == pytest.approx(solved, rel=0.05)
    numbers = st.predict(scanned.as_numbers(), load="200 N")

    def width(one):
        return math.log(one.contact_area_high.item() / one.contact_area_low.item())

    assert width(found) < 0.5 * width(numbers)
    (few_waves,) = found.warnings
    window = st.predict(pair(bodies, bodies, replace(surface, periodic=False), interfacial_shear_strength=1e6), load="200 N")
    assert all("long waves" in one for one in (few_waves, window.warnings[0])) and width(window) > width(found)


def test_a_hard_film_bears_no_more_than_the_body_below_it():
    """A film of 15 GPa, 0.1 um, on a body of 1.25 GPa: a punched plug bears H_b + 2 (t/a) H_f/(3 sqrt 3) at the most, so that
    mu = tau_0/p is at least tau_0 over that at spots five times as wide as the film is thick."""
    body = {"youngs_modulus": 193e9, "poissons_ratio": 0.3, "hardness": 1.25e9}
    film = {"youngs_modulus": 150e9, "poissons_ratio": 0.25, "hardness": 15e9}
    counter = {"youngs_modulus": 380e9, "poissons_ratio": 0.22, "hardness": 20e9}
    contact = st.Contact(
        first=body,
        second=counter,
        roughness={"asperity_height_deviation": 1e-7, "asperity_radius": 15e-6, "asperity_density": 5e9},
        coating={"material": film, "bodies": "first", "thickness": 1e-7},
        nominal_area=2e-6,
        interfacial_shear_strength=1e8,
    )
    most = 1.25e9 + 2.0 / 5.0 * 15e9 / (3.0 * math.sqrt(3.0))  # spots of five times the thickness
    found = st.predict(contact, load="2 N")
    assert found.friction_coefficient_low.item() > 1e8 / most
    # the sentence names the body that yields: mu = tau_0/p tells the pressure over its hardness, and over that of the film
    over_body, over_film = re.search(
        r"is ([\d.]+) times its hardness, (\d+)% of the hardness of the film", found.regime
    ).groups()
    pressure = 1e8 / found.friction_coefficient.item()
    assert float(over_body) == pytest.approx(pressure / 1.25e9, rel=0.06) and float(over_body) > 0.9
    assert float(over_film) == pytest.approx(100.0 * pressure / 15e9, abs=1.0)
    named = contact.replace(first={**body, "name": "my steel"})
    assert st.predict(named, load="2 N").regime.startswith("The body below the film yields, my steel: the pressure ")


def test_an_area_far_from_solved_surfaces_is_a_warning_only_where_it_decides():
    """The state of the interface is uncertain by far more than a factor of 2; a stated strength is not."""
    wall = {"first": "silicon", "second": "silicon", "roughness": {"rms_height": "3 nm", "finish": "polished"}}
    far = "No benchmark surface is similar to this contact: its real area is uncertain by a factor of 2."
    by_state, by_strength = (
        st.predict(st.Contact(**wall, **interface, nominal_area="1 cm^2"), load="0.1 mN")
        for interface in ({"interface": "monolayer"}, {"interfacial_shear_strength": "2 MPa"})
    )
    assert by_state.shares.get("area model", 0.0) < 0.05 < by_strength.shares["area model"]
    assert far not in by_state.warnings
    assert far in by_strength.warnings


def test_the_kind_of_a_surface_narrows_the_answer_under_a_film_too():
    """It is then not named as not used; without it the answer says what is missing."""
    coating = {"material": "silver", "thickness": "1 um", "bodies": "first"}
    plain, known = (
        st.predict(
            st.Contact(
                first="hardened_steel_52100", second="hardened_steel_52100", coating=coating, nominal_area="1 mm^2",
                interfacial_shear_strength="25 MPa",
                roughness={"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
                | kind,
            ),
            load="1 N",
        )
        for kind in ({}, {"kind": "polished"})
    )  # fmt: skip
    wide, narrow = (math.log(one.friction_coefficient_high / one.friction_coefficient_low) for one in (plain, known))
    assert narrow < 0.7 * wide
    assert not known.inputs_not_used and "kind of surface is not stated" in plain.warnings[0]


@pytest.mark.parametrize(("share", "grown"), [(1e-26, 2e-26), (1e-16, 2e-16), (0.5, 0.75), (1.0, 1.0)])
def test_an_area_grows_also_where_it_is_a_tiny_share_of_the_nominal(share, grown):
    assert grown_to(np.array(share), np.array(2.0), np.array(1.0)) == pytest.approx(grown, rel=1e-12)


def test_an_unknown_area_stays_unknown_and_a_closed_contact_closed():
    grown = grown_to(np.array([np.nan, 1.0, 2.0, np.inf]), np.array(0.1), np.array(1.0))
    assert np.isnan(grown[0]) and (grown[1:] == 1.0).all()


def test_a_finish_draws_no_asperities_that_cannot_be():
    """Of printed surfaces two in five have tips sharper than they are high; nobody can mend that in a case."""
    rubber = st.Material(youngs_modulus="3 MPa", poissons_ratio=0.49, hardness="3 MPa", material_class="elastomer")
    rough = {"first": {"finish": "printed"}, "second": {"finish": "polished"}}
    found = st.predict(st.Contact(first=rubber, second="silica", roughness=rough, nominal_area="4 cm^2"), load="1 N")
    assert not any("impossible" in warning for warning in found.warnings)
    assert np.isfinite(found.friction_coefficient_samples).all()


def test_adhesion_of_an_elastomer_that_is_not_stated_is_told():
    """A stated 0 J/m^2 is an answer; without a number, the user is told what it may do."""
    rough = {"first": {"finish": "blasted"}}
    rubber = {"first": "natural_rubber", "second": "borosilicate_glass", "roughness": rough, "nominal_area": "1 cm^2"}
    told = [
        "work_of_adhesion" in " ".join(st.predict({"contact": rubber | more, "solve": {"load": "10 N"}}).attrs["warnings"])
        for more in ({}, {"work_of_adhesion": "0 J/m^2"})
    ]
    assert told == [True, False]


@pytest.mark.parametrize(
    ("name", "values"), [("asperity_height_deviation", (23e-9, 24e-9)), ("asperity_density", (1e9, 1.02e9))]
)
def test_adhesion_of_sparse_bumps_does_not_leap(name, values):
    """Bumps of rubber that are pressed further than ten deviations of their heights."""
    bumps = {"asperity_height_deviation": 1e-7, "asperity_radius": 1e-5, "asperity_density": 8e9, "kind": "blasted"}
    body = {"youngs_modulus": "2 MPa", "poissons_ratio": 0.49, "hardness": "20 MPa"}
    pair = {"first": body, "second": "borosilicate_glass", "work_of_adhesion": "40 mJ/m^2", "nominal_area": "1 cm^2"}
    pair["interfacial_shear_strength"] = "0.1 MPa"
    found = [st.predict(st.Contact(**pair, roughness=bumps | {name: value}), load="1 N") for value in values]
    for end in ("_low", "", "_high"):
        first, second = (float(one[f"friction_coefficient{end}"].item()) for one in found)
        assert first == pytest.approx(second, rel=0.05)


def test_a_strength_near_that_of_the_body_is_the_same_however_it_is_written():
    """The interval holds what the three laws of growth say, and its median is none of its ends."""
    soft = {"youngs_modulus": "115 GPa", "poissons_ratio": 0.34, "hardness": "0.9 GPa"}
    rough = {"rms_height": "0.2 um", "finish": "ground"}
    pair = {"first": "hardened_steel_52100", "second": soft, "roughness": rough, "nominal_area": "1 cm^2"}
    ways = {"interfacial_shear_strength": "160 MPa"}, {"interface": {"interfacial_shear_strength": "160 MPa"}}
    found = [st.predict(st.Contact(**pair, **way), load="10 N") for way in ways]
    low, mu, high = (found[0][f"friction_coefficient{end}"].item() for end in ("_low", "", "_high"))
    assert low < 0.9 * mu and high > 1.1 * mu
    np.testing.assert_allclose(found[0].friction_coefficient_samples, found[1].friction_coefficient_samples, rtol=1e-12)


@pytest.mark.parametrize("coating", (None, {"material": {"preset": "silver", "hardness": "0.4 GPa"}, "thickness": "200 nm"}))
@pytest.mark.parametrize("limit", (1.0, 0.5))
def test_where_asperities_are_too_few_for_a_gaussian_surface_mu_does_not_leap(coating, limit):
    """From the least N R sigma of a Gaussian surface to half of it, one set of models replaces another."""
    mu = []
    for around in (0.99, 1.01):
        sigma = limit * around * LEAST_DENSITY / (1.7e10 * 50e-6)
        rough = {"asperity_height_deviation": sigma, "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
        pair = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "nominal_area": "1 mm^2", "roughness": rough}
        more = {"coating": coating | {"bodies": "first"}} if coating else {}
        mu.append(st.predict(st.Contact(**pair, **more, interfacial_shear_strength="40 MPa"), load="1 N"))
    for end in ("_low", "", "_high"):
        low, high = (float(one[f"friction_coefficient{end}"].item()) for one in mu)
        assert low == pytest.approx(high, rel=0.05)


def test_the_area_of_a_worn_surface_grows_steadily_with_a_light_load():
    """Benchmark surfaces end at a pressure of 0.002 E* h'; below it those with smooth plateaus count less and less."""
    body = {"youngs_modulus": "200 GPa", "poissons_ratio": 0.3, "hardness": "200 GPa", "material_class": "ceramic"}
    rough = {"asperity_height_deviation": 5e-8, "asperity_radius": 2e-5, "asperity_density": 4e10, "kind": "worn"}
    worn = pair(first=body, second=body, rough=rough, interfacial_shear_strength=1e6)
    slope = math.sqrt(math.sqrt(3.0) / 64.0 / 4e10) / 2e-5  # of a Gaussian surface with this density and radius of summits
    load = np.geomspace(1e-5, 0.02, 23) * 1e11 / (1.0 - 0.3**2) * slope * 1e-4
    area = st.predict(worn, load=load).contact_area.values
    power = np.diff(np.log(area)) / np.diff(np.log(load))
    assert 0.2 < power.min() and power.max() < 2.0


def test_an_uncertain_height_beside_a_finish_is_sampled():
    """Sq of 200 nm +/- 40 nm: asperities are as scattered as it is, and mu of an elastic contact, which has the same slope,
    is not."""
    hard = {"youngs_modulus": "1 GPa", "poissons_ratio": 0.3, "hardness": "100 GPa"}
    table = {"first": hard, "second": hard, "interfacial_shear_strength": "1 MPa", "nominal_area": "1 cm^2"}
    exact, scattered = (
        {"contact": table | {"roughness": {"rms_height": height, "finish": "polished"}}, "solve": {"load": "10 N"}}
        for height in ("200 nm", "200 +/- 40 nm")
    )
    spread = []
    for given in (exact, scattered):
        sigma = with_finish(case_in(given)).uncertain[0]
        assert sigma.name == "asperity_height_deviation"
        values = sigma.at(np.linspace(0.005, 0.995, 200))
        spread.append(np.std(values) / np.mean(values))
    assert spread[1] == pytest.approx(math.hypot(0.2, spread[0]), rel=0.12)  # without the outermost 1 %
    found = [st.predict(given) for given in (exact, scattered)]
    for end in ("_low", "", "_high"):
        first, second = (one[f"friction_coefficient{end}"].item() for one in found)
        assert second == pytest.approx(first, rel=0.05)
