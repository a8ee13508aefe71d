"""Along lines of one input in steps of 2 % the median moves by less than 20 %, or a warning beside the number says so."""

import math
from itertools import pairwise

import numpy as np
import pytest

import stiction as st
from stiction.case.read import case_in
from stiction.contact.materials import material
from stiction.studies.prediction.levels import draw_levels
from stiction.studies.prediction.mixture import Mixture
from stiction.studies.prediction.regime import warnings_of
from stiction.studies.prediction.sampled_case import SampledCase

BODIES = ("gold", "copper", "silver", "hardened_steel_52100", "silicon", "tungsten")
COUNT, LINES, STEPS = 512, 40, 4
LEVELS = draw_levels(0, COUNT, 0)  # those of st.predict where no number is uncertain


def answer(contact, load):
    """The median of st.predict and its warnings, without the shares of the variance, which take longest."""
    mixture = Mixture.of(
        SampledCase(case_in({"contact": contact, "solve": {"load": ["1 N"]}}), np.array([load]), LEVELS.inputs)
    )
    samples = mixture.samples(LEVELS, np.arange(COUNT))
    return float(np.nanmedian(samples.force)) / load, warnings_of(mixture, samples, 0, {})


def drawn(rng):
    """A contact of metals, often with adhesion, menisci or a film, and a load."""

    def between(low, high):
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    sigma, radius = between(2e-9, 2e-7), between(2e-7, 2e-5)
    given = {
        "first": str(rng.choice(BODIES)),
        "second": str(rng.choice(BODIES)),
        "nominal_area": between(1e-10, 1e-6),
        "roughness": {
            "asperity_height_deviation": sigma,
            "asperity_radius": radius,
            "asperity_density": between(0.02, 0.1) / radius / sigma,
        },
        "interfacial_shear_strength": between(3e6, 3e8),
    }
    if rng.random() < 0.6:
        given["work_of_adhesion"] = between(0.1, 1.0)
    if rng.random() < 0.4:
        angles = {"contact_angle_first": 0.2, "contact_angle_second": 0.5}
        given["liquid"] = {"relative_humidity": float(rng.uniform(0.2, 0.85)), **angles}
    if rng.random() < 0.45:
        bodies, film = str(rng.choice(["first", "second", "both"])), str(rng.choice(BODIES))
        given["coating"] = {"material": film, "thickness": between(5e-9, 1e-6), "bodies": bodies}
    return given, between(1e-5, 0.1) * 1e9 * given["nominal_area"]


def places(given):
    """The inputs along which a line may go."""
    found = [("load",), ("nominal_area",), ("interfacial_shear_strength",), ("first", "hardness"), ("first", "youngs_modulus")]
    found += [("roughness", name) for name in given["roughness"]]
    more = {"work_of_adhesion": (), "liquid": ("relative_humidity", "contact_angle_first"), "coating": ("thickness",)}
    for name, inner in more.items():
        found += [(name, *one) for one in [(field,) for field in inner] or [()]] if name in given else []
    return found


def moved(given, load, place, factor):
    if place == ("load",):
        return given, load * factor
    name, *inner = place
    if not inner:
        return {**given, name: given[name] * factor}, load
    if name == "first":
        body = material(given[name])
        return {**given, name: body.replace(**{inner[0]: getattr(body, inner[0]) * factor})}, load
    return {**given, name: {**given[name], inner[0]: given[name][inner[0]] * factor}}, load


def leaps(line):
    """Steps of more than 20 % at which neither end has a warning that says so."""
    found = []
    for (one, said), (other, also) in pairwise(line):
        warned = any("as strong as the weaker body" in text for text in (*said, *also))
        if abs(math.log(other / one)) > math.log(1.2) and not warned:
            found.append((one, other))
    return found


def test_lines_of_every_input():
    rng = np.random.default_rng(1)
    seen = 0
    while seen < LINES:
        given, load = drawn(rng)
        possible = places(given)
        place = possible[rng.integers(len(possible))]
        line = []
        for step in range(STEPS):
            changed, pressed = moved(given, load, place, 1.02**step)
            try:
                line.append(answer(st.Contact(**changed), pressed))
            except st.InputError as error:  # pressed flat, said in one line
                assert error.field == "load"
        assert not leaps(line), (place, given, load)
        seen += 1


@pytest.mark.parametrize("adhesion", [None, 0.1, 1.0])
def test_the_load_on_gold_that_leapt(adhesion):
    """By the recommended model alone mu leapt from .113 to .415 between 60 and 100 uN."""
    rough = {"asperity_height_deviation": 1e-8, "asperity_radius": 1e-6, "asperity_density": 5e12}
    strength = {"interfacial_shear_strength": 2e7, "work_of_adhesion": adhesion}
    contact = st.Contact(first="gold", second="gold", roughness=rough, nominal_area=1e-10, **strength)
    loads = 3e-5 * 1.02 ** np.arange(0, 97)
    found = st.predict(contact, load=loads)
    assert np.abs(np.diff(np.log(found.friction_coefficient.values))).max() < math.log(1.2)


def test_the_growth_of_junctions_is_steep_and_says_so():
    """mu goes with c/sqrt(1 - c^2) of the strength c over the body's: twice from .95 to 1, as clean metal."""
    rough = {"asperity_height_deviation": 1e-7, "asperity_radius": 5e-6, "asperity_density": 1e11}
    bulk = material("copper").hardness / (math.sqrt(3.0) * 2.8)  # H/Y of what states no yield stress
    line = []
    for step in range(-8, 4):
        strength = bulk * 0.9999 * 1.02**step
        line.append(
            answer(
                st.Contact(
                    first="copper", second="silicon", roughness=rough, nominal_area=1e-6, interfacial_shear_strength=strength
                ),
                1.0,
            )
        )
    mu = [one for one, _ in line]
    assert max(mu[at + 1] / mu[at] for at in range(len(mu) - 1)) > 1.2 and not leaps(line)
    assert not line[0][1]  # far below there is nothing to say


def test_ends_of_the_interval_do_not_leap_where_the_kind_of_surface_is_unknown():
    body = st.Material(youngs_modulus="100 GPa", poissons_ratio=0.3, hardness="4.472 GPa")
    roughness = {"asperity_height_deviation": "20 nm", "asperity_radius": "2 um", "asperity_density": "5e11 1/m^2"}
    contact = st.Contact(
        first=body, second=body, nominal_area="1 cm^2", interfacial_shear_strength="5 MPa", roughness=roughness
    )
    found = st.predict(contact, load=np.geomspace(400.0, 620.0, 23))
    for end in ("low", "high"):
        assert np.abs(np.diff(np.log(found[f"friction_coefficient_{end}"]))).max() < 0.02
