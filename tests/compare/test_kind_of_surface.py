"""A kind of surface that is stated: only solved surfaces of that kind say how far a model is off."""

import json
import tomllib

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.case.case_tables import json_schema
from stiction.case.read import parse_case
from stiction.solving.accuracy.benchmark_set import OF_KIND, benchmark_set
from stiction.surfaces.finishes import SURFACE_KINDS, finish, finish_names
from stiction.surfaces.theory.moments import bandwidth

SOFT = {"youngs_modulus": "91 GPa", "poissons_ratio": 0.3, "hardness": "1e6 GPa"}
STIFF = {"youngs_modulus": "1e9 GPa", "poissons_ratio": 0.3, "hardness": "1e9 GPa"}
NUMBERS = {"asperity_height_deviation": "0.2 um", "asperity_radius": "20 um", "asperity_density": "1e10 1/m^2"}
# h' of these asperities by McCool's moments: m4 = pi (3/(8 R))^2, m2 = m4/(6 pi 3^(1/2) N), h'^2 = 2 m2.
SLOPE = (2 * np.pi * (3 / 8 / 20e-6) ** 2 / (6 * np.pi * 3**0.5 * 1e10)) ** 0.5


def contact(**more):
    rough = st.Roughness(**NUMBERS | more)
    return st.Contact(first=SOFT, second=STIFF, roughness=rough, nominal_area="1 mm^2", interfacial_shear_strength="5 MPa")


def solved(kind, pressure=0.1, model="persson_widened", more=None):
    load = pressure * 1e11 * SLOPE * 1e-6
    return st.solve(contact(**({"kind": kind} if kind else {}) | (more or {})), load=load, model=model)


def by_hand(kinds, pressure=0.1, column="persson_widened|moments"):
    """Mean of ln(A/solved A) at a pressure of the set, elastic, over its surfaces of these kinds."""
    known = benchmark_set()
    mine = np.isin(known["kinds"], kinds)
    errors = known.errors(column)[mine, 0, known["loads"].tolist().index(pressure)]
    distance = np.log(known.feature("alpha")[mine] / bandwidth(0.04)) / 0.5
    weight = np.exp(-0.5 * (distance**2 - (distance**2).min())) * np.isfinite(errors)
    return np.average(np.nan_to_num(errors), weights=weight), int((weight > 0.1).sum())


@pytest.mark.parametrize(
    ("kind", "kinds"),
    [
        ("gaussian", ["gaussian"]),
        ("skewed", ["skewed", "peaked"]),
        ("worn", ["worn", "flat"]),
        ("lay", ["lay", "mixed", "periodic"]),
        ("two-scale", ["bimodal", "periodic"]),
        ("turned", ["lay", "mixed", "periodic"]),
        ("polished", ["gaussian"]),
    ],
)
def test_only_solved_surfaces_of_that_kind_count(kind, kinds):
    data = solved(kind)
    said = json.loads(data.attrs["measured_error"])
    mean, count = by_hand(kinds)
    assert said["area"][0] == pytest.approx(np.expm1(mean), rel=5e-3, abs=1e-4)
    assert said["surfaces"] == [count] and said["kind_known"] is True
    assert f"of {count} of this kind, {said['kind']}" in data.attrs["measured_error_in_words"]
    for name in ("contact_area", "friction_coefficient"):
        assert float(data[name]) == float(solved(None)[name])


def test_a_kind_sharpens_the_interval_and_none_leaves_it():
    width = {}
    for kind in (None, "gaussian", "worn"):
        said = json.loads(solved(kind).attrs["measured_error"])
        width[kind] = np.log((1 + said["area_high"][0]) / (1 + said["area_low"][0]))
    assert width["gaussian"] < 0.3 * width[None] and width["worn"] < width[None]
    assert json.loads(solved(None).attrs["measured_error"])["kind"] is None


def test_every_kind_of_the_set_is_of_a_kind_and_every_finish_stands_for_one():
    assert set(benchmark_set()["kinds"]) == {one for kinds in OF_KIND.values() for one in kinds}
    assert tuple(OF_KIND) == SURFACE_KINDS
    for name in finish_names():
        assert st.Roughness(**NUMBERS, kind=name).surface_kind == finish(name).surface_kind
    assert st.Roughness(**NUMBERS).surface_kind is None


def test_of_a_surface_beside_the_asperities_and_of_films():
    moments = {"surface": NUMBERS | {"asperity_height_deviation": "0.21 um"}}
    said = json.loads(solved("worn", more=moments).attrs["measured_error"])
    assert said["kind"] == "worn" and said["area"] != json.loads(solved(None, more=moments).attrs["measured_error"])["area"]
    film = {"material": SOFT | {"youngs_modulus": "20 GPa"}, "thickness": "2 um", "bodies": "first"}
    for kind in SURFACE_KINDS:
        data = st.compare(contact(kind=kind).replace(coating=film), load="1 N")
        words = [str(one) for one in data["measured_error_in_words"].values]
        assert not any("solved Gaussian surfaces" in one for one in words)
        assert any(f"this kind, {kind}" in one for one in words)


def test_a_case_states_it_and_other_words_are_refused():
    case = """
    [contact]
    first = "iron"
    second = "iron"
    nominal_area = "1 mm^2"
    interfacial_shear_strength = "5 MPa"
    roughness = {asperity_height_deviation="0.2 um", asperity_radius="20 um", asperity_density="1e10 1/m^2", kind="KIND"}
    [solve]
    load = "1 N"
    model = "greenwood_williamson_1966"
    """
    assert parse_case(tomllib.loads(case.replace("KIND", "ground"))).subject.surface_kind == "lay"
    with refusal("contact.roughness.kind", "grounded", "ground", "gaussian"):
        parse_case(tomllib.loads(case.replace("KIND", "grounded")))
    with refusal("kind", "3", "gaussian"):
        st.Roughness(**NUMBERS, kind=3)
    assert json_schema()["$defs"]["Roughness"]["properties"]["kind"]["type"] == "string"


SHAPE = {"skewness": -1.2, "kurtosis": 4.5, "texture_aspect_ratio": 0.4}


@pytest.mark.parametrize("names", [["skewness"], ["kurtosis", "texture_aspect_ratio"], list(SHAPE)])
@pytest.mark.parametrize("kind", [None, "worn"])
def test_a_stated_shape_weighs_the_solved_surfaces_by_their_difference_from_it(names, kind):
    """1 is .5 in ln alpha, .35 in skewness, .3 in ln of kurtosis, .25 in ln of Str, which is one over the lay of the set."""
    known = benchmark_set()
    mine = np.isin(known["kinds"], OF_KIND[kind] if kind else sum(OF_KIND.values(), ()))
    errors = known.errors("persson_widened|moments")[mine, 0, known["loads"].tolist().index(0.1)]
    squared = (np.log(known.feature("alpha")[mine] / bandwidth(0.04)) / 0.5) ** 2
    apart = {
        "skewness": (known.feature("skewness") + 1.2) / 0.35, "kurtosis": np.log(known.feature("kurtosis") / 4.5) / 0.3,
        "texture_aspect_ratio": np.log(known.feature("lay") * 0.4) / 0.25,
    }  # fmt: skip
    squared = squared + sum(apart[name][mine] ** 2 for name in names)
    weight = np.exp(-0.5 * (squared - squared.min())) * np.isfinite(errors)
    stated = {name: SHAPE[name] for name in names} | ({"kind": kind} if kind else {})
    said = json.loads(solved(None, more=stated).attrs["measured_error"])
    assert said["distance"][0] == pytest.approx(squared.min() ** 0.5, rel=5e-3)
    assert said["surfaces"] == [int((weight > 0.1).sum())] and said["kind_known"] is True
    assert said["area"][0] is None or said["area"][0] == pytest.approx(
        np.expm1(np.average(np.nan_to_num(errors), weights=weight)), rel=5e-3, abs=1e-4
    )


def test_a_stated_shape_narrows_the_prediction_and_replaces_the_question_for_the_kind():
    width = {}
    for name, stated in {"numbers": {}, "shape": SHAPE, "kind": {"kind": "lay"}, "both": SHAPE | {"kind": "lay"}}.items():
        answer = st.predict(contact(**stated), load="50 N")
        width[name] = float(np.log(answer.friction_coefficient_high / answer.friction_coefficient_low))
        assert any("kind of surface" in one for one in answer.warnings) == (name == "numbers")
    assert width["both"] < width["kind"] < width["numbers"] and width["shape"] < width["numbers"]


def test_a_shape_that_cannot_be_is_refused():
    for skewness in (2.0, -2.0):  # two heights of the probabilities (1 +- 1/sqrt 2)/2 have a kurtosis of 5, the smallest
        with refusal("kurtosis", "4.0", "at least 5"):
            st.Roughness(**NUMBERS, skewness=skewness, kurtosis=4.0)
        assert st.Roughness(**NUMBERS, skewness=skewness, kurtosis=5.0).kurtosis == 5.0
    with refusal("texture_aspect_ratio", "1.2", "<= 1"):
        st.Roughness(**NUMBERS, texture_aspect_ratio=1.2)
    with refusal("skewness", "2 values", "one number"):
        st.Roughness(**NUMBERS, skewness=st.axis("skewness", [0.0, 1.0]))
    with refusal("roughness.first.skewness", "-0.5", "no value where both bodies are rough"):
        contact().replace(roughness={"first": {"finish": "ground", "skewness": -0.5}, "second": {"finish": "ground"}})


def test_a_mixture_of_kinds_lies_between_them_without_a_jump():
    """Surfaces of each kind have its share together; at the ends the mixture is one kind."""
    known = benchmark_set()
    weights = known.of_kind("0.300 lay + 0.700 gaussian")
    lay, gaussian = known.of_kind("lay"), known.of_kind("gaussian")
    assert weights[lay].sum() / weights.sum() == pytest.approx(0.3, rel=1e-12) and weights[gaussian].sum() > 0.0
    assert not weights[~(lay | gaussian)].any() and weights.max() == 1.0
    shares = (0.999, 0.75, 0.5, 0.25, 0.001)
    kinds = ["lay", *(f"{share:.3f} lay + {1.0 - share:.3f} gaussian" for share in shares), "gaussian"]
    high = np.array([json.loads(solved(kind).attrs["measured_error"])["area_high"][0] for kind in kinds])
    assert (np.diff(high) < 0.01).all() and high[0] > 2.0 * high[-1]
    assert high[1] == pytest.approx(high[0], rel=0.02) and high[-2] == pytest.approx(high[-1], rel=0.02, abs=2e-3)


def test_finishes_of_both_bodies_answer_the_question_for_the_kind():
    """Advice that remains names the bodies, whose tables take the kind."""
    turned = {"finish": "turned", "mean_height": "0.8 um"}
    case = {"first": "nylon_66", "second": "mild_steel", "interface": "dry polymer", "nominal_area": "1 cm^2"}

    def predicted(first):
        return st.predict({"contact": case | {"roughness": {"first": first, "second": turned}}, "solve": {"load": "50 N"}})

    both = predicted({"finish": "moulded"})
    assert not any("kind of surface" in one for one in both.warnings) and "kind" not in both.next_step
    numbers = NUMBERS | {"asperity_radius": "10 um"}
    asked = predicted(numbers)
    assert any("kind of surface" in one for one in asked.warnings) and "of each body" in asked.next_step
    assert not any("kind of surface" in one for one in predicted(numbers | {"kind": "worn"}).warnings)
