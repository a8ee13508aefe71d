"""Records that are asked for another value, and uses that are wrong: one true line each, never a value that nobody checked."""

import numpy as np
import pytest

import stiction as st
from refusals import refusal

ROUGHNESS = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}


def contact(**changes) -> st.Contact:
    given = {"first": "iron", "second": "iron", "work_of_adhesion": "0.1 J/m^2", "nominal_area": "1 mm^2"}
    return st.Contact(**given | {"roughness": ROUGHNESS} | changes)


def line(what) -> str:
    with pytest.raises(st.InputError) as error:
        what()
    assert "\n" not in str(error.value)
    return str(error.value)


def test_replace_reads_units_and_leaves_the_first_as_it_was():
    one = contact()
    other = one.replace(nominal_area="2 mm^2", first={"preset": "iron", "hardness": "3 GPa"})
    assert (other.nominal_area, other.first.hardness) == (2e-6, 3e9)
    assert one.nominal_area == 1e-6 and other.roughness == one.roughness and other.second == one.second
    assert one.first.replace(hardness="3 GPa").hardness == 3e9
    assert st.Indices(theta=40, lam=10).replace(lam=5).lam == 5


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"nominal_area": -1}, "nominal_area: -1.0; allowed: > 0 m^2"),
        ({"nominal_area": "2 N"}, "nominal_area: '2 N'; allowed: > 0 m^2"),
        ({"nominal_are": 1}, "nominal_are: unknown key; allowed: nominal_area (all: first"),
        ({"first": "irn"}, "first: 'irn'; allowed: a preset: iron"),
        ({"first": {"preset": "iron", "hardness": -1}}, "first.hardness: -1"),
        ({"roughness": 3}, "roughness: 3; allowed: "),
    ],
)
def test_what_is_replaced_copied_or_assigned_is_checked_alike(changes, said):
    assert line(lambda: contact().replace(**changes)).startswith(said)
    assert line(lambda: contact().model_copy(update=changes)).startswith(said)
    if "nominal_are" not in changes:
        assert line(lambda: setattr(contact(), *next(iter(changes.items())))).startswith(said)


def test_a_copy_reads_units_and_its_dimensions_must_agree():
    assert contact().model_copy(update={"nominal_area": "2 mm^2"}).nominal_area == 2e-6
    one = contact(nominal_area=st.axis("nominal_area", ["1 mm^2", "2 mm^2"], "batch"))
    assert one.model_copy() == one
    three = st.axis("work_of_adhesion", [0.1, 0.2, 0.3], "batch")
    assert line(lambda: one.model_copy(update={"work_of_adhesion": three})).startswith(
        "nominal_area: length 2 along dimension 'batch'"
    )


def test_a_field_that_is_none_is_not_assigned():
    with refusal("Roughness.rms", "rms", "asperity_height_deviation"):
        st.Roughness(asperity_height_deviation=1e-8, asperity_radius=1e-6, asperity_density=1e13).rms = 3


def test_a_good_value_is_not_assigned_either_and_the_way_is_named():
    one = contact()
    assert "replace(nominal_area=...)" in line(lambda: setattr(one, "nominal_area", "2 mm^2"))
    assert one.nominal_area == 1e-6
    assert "cannot be changed" in line(lambda: setattr(one.first, "hardness", 1e9))


@pytest.mark.parametrize(
    ("use", "said"),
    [
        (
            lambda: st.Roughness(1, 2, 3),
            "Roughness: 3 values without a name; allowed: values given by name: asperity_height_d",
        ),
        (
            lambda: st.Contact("iron", "iron"),
            "Contact: 2 values without a name; allowed: values given by name: first=..., ",
        ),
        (lambda: st.Material("x"), "Material: 1 value without a name; allowed: values given by name: youngs_modulus=..."),
        (lambda: st.axis(["1 N"]), "axis: ['1 N']; allowed: first the name of a quantity, then its values"),
        (lambda: st.axis(["1 N"], "load"), "axis: ['1 N']; allowed: first the name of a quantity, then its values"),
        (lambda: st.axis("radius", [1]), "axis: 'radius'; allowed: first the name of a quantity, then its values"),
        (lambda: st.axis("load"), "load: not given; allowed: its values along the axis"),
        (lambda: st.axis("load", [1.0], 5), "dimension: 5; allowed: a name"),
        (lambda: st.axis("load", [[1.0], [2.0]]), "load: [1.0]; allowed: any finite number in N"),
        (
            lambda: st.compare(contact(), load=["1 N", "2 N"]),
            "load: ['1 N', '2 N']; allowed: one load > 0 N: compare takes a single load",
        ),
        (
            lambda: st.compare(contact(), load=np.array([1.0])),
            "load: 1.0; allowed: one load > 0 N: compare takes a single load",
        ),
        (lambda: st.compare(contact(), separations=3.0), "separations: 3.0; allowed: a sequence of numbers"),
    ],
)
def test_a_wrong_use_says_what_is_right(use, said):
    assert line(use).startswith(said)


def test_the_suggestion_for_an_axis_comes_first():
    suggested, _, _ = line(lambda: st.axis("asperity_radiu", [1])).partition(" (all: ")
    assert 'axis("load", ["1 N", "2 N"]): asperity_radius' in suggested


def surface() -> st.HeightMap:
    heights = np.random.default_rng(1).normal(size=(16, 16)) * 1e-9
    return st.HeightMap(heights, (1e-6, 1e-6), name="made")


@pytest.mark.parametrize(
    ("use", "said"),
    [
        (lambda: st.resolution_study(contact()), "surface: 'Contact'; allowed: a HeightMap, a topography"),
        (lambda: st.resolution_study(surface().heights), "surface: 'ndarray'; allowed: a HeightMap, a topography"),
        (lambda: st.resolution_study(surface(), contact=contact()), "load: not given; allowed: both contact and load"),
        (lambda: st.resolution_study(surface(), load="1 N"), "contact: not given; allowed: both contact and load"),
        (lambda: st.resolution_study(surface(), methods=["mcool"]), "methods: ['mcool']; allowed: one or more of three_point"),
        (lambda: st.resolution_study(surface(), methods=3), "methods: 3; allowed: one or more of three_point"),
        (
            lambda: st.resolution_study(surface(), contact=contact(), load="1 N", choice="jkr"),
            "choice: 'jkr'; allowed: a stiction.solving.choice.Choice",
        ),
        (
            lambda: st.resolution_study(surface(), contact=contact(), load=["1 N", "2 N"]),
            "load: ['1 N', '2 N']; allowed: one load > 0 N",
        ),
    ],
)
def test_a_wrong_use_of_the_resolution_study_says_what_is_right(use, said):
    assert line(use).startswith(said)


def test_one_cutoff_and_one_method_need_no_list():
    found = st.resolution_study(surface(), cutoffs="200 nm", methods="mccool")
    assert found.sizes == {"asperity_method": 1, "cutoff": 1} and found["cutoff"].values.tolist() == [200e-9]
