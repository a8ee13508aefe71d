"""What is no case at all, from Python: one line and an InputError, never an error of another kind."""

import numpy as np
import pytest

import stiction as st
from stiction.case.measurements import read_measurements
from stiction.case.read import read_content
from stiction.case.uncertain import read_distribution
from stiction.quantities.errors import InputError
from stiction.solvers.boundary_elements.map_warnings import share_at_ends
from stiction.studies.fit.plan import make_fit_plan
from stiction.studies.sweep.plan import make_plan
from stiction.studies.sweep.run import sweep
from stiction.surfaces.heightmap import HeightMap

CONTACT = {
    "first": "hardened_steel_52100",
    "second": "hardened_steel_52100",
    "interfacial_shear_strength": "200 MPa",
    "nominal_area": "1 mm^2",
    "roughness": {"asperity_height_deviation": "20 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
}
CASE = {"contact": CONTACT, "solve": {"load": ["10 mN"], "model": "persson_2001"}}
ENDS = {"low": "10 MPa", "high": "2 GPa"}
NO_TEXT = "names that are text"


def refused(function, *given, **named):
    with pytest.raises(InputError) as error:
        function(*given, **named)
    assert "\n" not in str(error.value)
    return str(error.value)


@pytest.mark.parametrize("key", [1, None, ("a", "b")])
@pytest.mark.parametrize("place", [(), ("contact",), ("contact", "roughness"), ("solve",)])
def test_names_that_are_no_text(key, place):
    def with_key(table, path):
        return {**table, path[0]: with_key(table[path[0]], path[1:])} if path else {**table, key: 1}

    for function in (st.sensitivity, st.design, make_plan, lambda case: make_fit_plan(case, "none.csv")):
        assert NO_TEXT in refused(function, with_key(CASE, place))


def test_names_that_are_no_text_in_studies_and_records():
    for name, function in (("design", st.design), ("fit", lambda case: st.fit(case, "none.csv")), ("sweep", make_plan)):
        assert NO_TEXT in refused(function, {**CASE, name: {1: 2}})
    assert refused(st.Contact, **{**CONTACT, "coating": {1: 2}}).startswith("coating: 1; allowed: names")


def test_a_body_that_is_no_material_has_no_ranges():
    wrong = {**CASE, "contact": {**CASE["contact"], "second": []}, "uncertainty": {"ranges": True}}
    assert "second: []; allowed: a material" in refused(st.predict, wrong)


@pytest.mark.parametrize("given", [None, 1.0, True, b"x", [], np.array([1.0, 2.0]), lambda: 0])
def test_what_is_no_path(given):
    for function in (st.design, st.sensitivity, lambda case: st.fit(case, "none.csv")):
        assert refused(function, given).startswith("case: ")
    assert refused(read_measurements, given, CASE).startswith("--data: ")


def test_paths_that_no_system_takes():
    assert "cannot be read" in refused(read_content, "a" * 100_000)
    assert "cannot be read" in refused(read_measurements, "a" * 100_000, CASE)
    assert "cannot be read" in refused(read_distribution, {"samples": "a" * 100_000, "unit": "GPa"}, "hardness", "hardness")


def test_a_cell_without_end(tmp_path):
    path = tmp_path / "measured.csv"
    path.write_text(f"load [N],friction_coefficient\n1,{'1' * 140_000}\n", encoding="utf-8")
    assert refused(read_measurements, path, CASE).startswith("line 2: ")


@pytest.mark.parametrize("name", [".\0", "/dev/zero", "."])
def test_values_in_what_is_no_file(name):
    strength = {"samples": name, "unit": "MPa"}
    case = {**CASE, "contact": {**CONTACT, "interfacial_shear_strength": strength}}
    assert "interfacial_shear_strength.samples" in refused(st.sensitivity, case)


@pytest.mark.parametrize("model", [[], {}, np.array([1.0, 2.0]), 1])
def test_a_model_that_is_no_text(model):
    contact = st.Contact(first="silver", second="gold", nominal_area=1e-6, roughness={
        "asperity_height_deviation": 2e-8, "asperity_radius": 5e-5, "asperity_density": 1e10})  # fmt: skip
    assert refused(st.solve, contact, load=1.0, model=model).startswith("model: ")


@pytest.mark.parametrize("side", [10**400, 1e308, 1e-320])
def test_maps_of_no_size(side):
    assert "size: " in refused(HeightMap, np.eye(4), (side, 1e-5))


def test_pressures_below_the_smallest_number():
    assert share_at_ends(np.zeros((4, 4))) == 0.0
    pressure = np.ones((4, 4))
    assert share_at_ends(pressure) == pytest.approx(0.75)


@pytest.mark.parametrize("models", ["persson_2001", 1, float("nan"), [[]], [{}], np.array([1.0, 2.0])])
def test_models_that_are_no_list_of_names(models):
    assert refused(
        st.sensitivity, {**CASE, "contact": {**CONTACT, "nominal_area": "1 +/- 0.1 mm^2"}}, models=models
    ).startswith("models: ")


def test_where_a_sweep_goes_and_who_does_it(tmp_path):
    pytest.importorskip("zarr")
    for given in (None, 1, float("nan"), ("a",)):
        assert refused(sweep, CASE, given).startswith("--out: ")
    pytest.importorskip("distributed")
    assert refused(sweep, CASE, tmp_path / "store", scheduler=1.0).startswith("--scheduler: ")


@pytest.mark.parametrize("text", ["a\0b", "\x1b[31m", "\x07"])
def test_text_with_control_characters(text):
    assert refused(make_plan, {**CASE, "title": text}).startswith("title: ")
    assert refused(st.design, {**CASE, "title": text}).startswith("title: ")
    assert refused(st.sensitivity, {**CASE, "title": text}).startswith("title: ")
    named = {"name": text, "youngs_modulus": "200 GPa", "poissons_ratio": 0.3, "hardness": "7 GPa"}
    assert "contact.first.name" in refused(st.sensitivity, {**CASE, "contact": {**CONTACT, "first": named}})


def test_a_title_that_is_no_text():
    assert refused(st.sensitivity, {**CASE, "title": 3}).startswith("title: 3; allowed: text")
