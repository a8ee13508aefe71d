"""Text with units to SI and back, and the one line said about everything that is not usable."""

import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from refusals import refusal
from stiction.quantities import units
from stiction.quantities.dimensions import axis
from stiction.quantities.errors import InputError
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("5 um", "thickness", 5e-06),
        ("48nm", "thickness", 48e-09),
        ("  200 µm ", "thickness", 2e-04),  # micro sign
        ("200 μm", "thickness", 2e-04),  # Greek mu
        ("1 in", "thickness", 0.0254),
        ("0.25 GPa", "hardness", 2.5e8),
        ("1000 psi", "hardness", 6894757.293168361),  # lbf/in^2: 0.45359237 x 9.80665 / 0.0254^2
        ("2.5 N/m", "work_of_adhesion", 2.5),
        ("50 mJ/m²", "work_of_adhesion", 0.05),
        ("50 mJ m^-2", "work_of_adhesion", 0.05),
        ("17000 /mm^2", "asperity_density", 1.7e10),
        ("1.7e10 m**-2", "asperity_density", 1.7e10),
        ("-3 mN", "load", -0.003),
        ("30 %", "nu", 0.3),
        ("0.3", "nu", 0.3),
    ],
)
def test_text_is_converted_to_the_last_digit(text, name, value):
    assert to_si(text, name) == value


@pytest.mark.parametrize(
    "text",
    [
        "5",
        "5 kg",
        "5 GPa",
        "5 furlong per",
        "nm",
        "",
        "0,25 m",
        "5 m^9^9^9^9",
        "5 m**9**9**9",
        "5 (",
        "5 5 m",
        "5 __class__",
        "-3 nm",
        "0 m",
        "1e999 m",
        "1e-999999999 m",
        "nan m",
        "5 1e999999999 m",
        "5 degC",
        "5 $",
    ],
)
def test_bad_text_is_refused_in_one_line_naming_field_value_and_unit(text):
    with pytest.raises(InputError) as error:
        to_si(text, "thickness")
    message = str(error.value)
    assert message.startswith(f"thickness: {text!r}; allowed: ")
    assert "> 0 m" in message and "\n" not in message


@pytest.mark.parametrize(
    "value",
    [
        float("nan"),
        float("inf"),
        0.5,
        -0.1,
        True,
        None,
        {},
        1j,
        [],
        10**400,
        [0.1, 0.6],
        [[0.1]],
        ["x"],
        np.array([0.1, np.nan]),
        np.array(["0.1"]),
        np.bool_(True),
    ],
)
def test_bad_values_are_refused(value):
    with refusal("nu"):
        to_si(value, "nu")


def test_very_long_text_is_refused_at_once():
    for text in ("5 " + "a " * 500_000, "5" * 1_000_000, " " * 1_000_000):
        with pytest.raises(InputError):
            to_si(text, "thickness")


def test_numbers_and_arrays_are_si():
    assert to_si(3, "thickness") == 3.0 and isinstance(to_si(3, "thickness"), float)
    assert isinstance(to_si(np.float32(0.25), "nu"), float)
    assert np.array_equal(to_si(["1 nm", 2e-9], "thickness"), [1e-9, 2e-9])
    assert to_si(np.ones((2, 3)), "thickness").shape == (2, 3)


def test_axis_is_its_own_coordinate_with_units():
    array = axis("thickness", ["100 nm", "200 nm"])
    assert array.dims == ("thickness",)
    assert np.array_equal(array, [1e-7, 2e-7]) and np.array_equal(array.coords["thickness"], array)
    assert array.coords["thickness"].attrs == {
        "units": "m",
        "long_name": "film thickness",
        "comment": QUANTITIES["thickness"].meaning,
    }
    assert axis("hardness", [1e9], "film hardness").dims == ("film hardness",)
    assert axis("nu", 0.3).attrs["units"] == "1"
    with refusal("axis", "thicknes", "thickness"):
        axis("thicknes", [1.0])
    with refusal("thickness", "-1.0"):
        axis("thickness", [1.0, -1.0])


def test_labelled_arrays_keep_their_dimension_and_obey_their_units():
    array = axis("thickness", [1.0, 2.0])
    array.attrs["units"] = "nm"
    converted = to_si(array, "thickness")
    assert converted.dims == ("thickness",) and np.allclose(converted, [1e-9, 2e-9], rtol=1e-15)
    assert converted.attrs == {}
    array.attrs["units"] = "kg"
    with refusal("thickness", "kg", "> 0 m"):
        to_si(array, "thickness")


@pytest.mark.parametrize(
    ("value", "name", "text"),
    [
        (4.8e-8, "thickness", "48 nm"),
        (1.25e-3, "load", "1.25 mN"),
        (-3e-7, "load", "-300 nN"),
        (0.0, "load", "0 N"),
        (2.5e8, "hardness", "250 MPa"),
        (0.999999999e-6, "thickness", "1 µm"),
        (2.5e-5, "nominal_area", "25 mm^2"),
        (7.5e-12, "nominal_area", "7.5 µm^2"),
        (0.05, "work_of_adhesion", "50 mJ/m^2"),
        (1.7e10, "asperity_density", "1.7e+10 1/m^2"),
        (0.3, "nu", "0.3"),
    ],
)
def test_show(value, name, text):
    assert show(value, name) == text
    assert to_si(text, name) == pytest.approx(value, rel=1e-6) if value else True


@settings(deadline=None, max_examples=150)
@given(
    st.sampled_from([name for name, quantity in QUANTITIES.items() if quantity.unit]),
    st.floats(1e-20, 1e20),
)
def test_what_is_shown_reads_back(name, value):
    value = min(max(value, QUANTITIES[name].lower), 0.9 * QUANTITIES[name].upper)  # angles have an end
    assert to_si(show(value, name), name) == pytest.approx(value, rel=1e-5)


@settings(deadline=None, max_examples=150)
@given(st.text(max_size=12), st.sampled_from(["", "5 ", "5 m"]))
def test_no_text_does_anything_but_convert_or_be_refused(text, start):
    try:
        assert to_si(start + text, "thickness") > 0
    except InputError as error:
        assert "\n" not in str(error)


def test_table_is_sound():
    for name, quantity in QUANTITIES.items():
        assert quantity.name == name and quantity.symbol and quantity.latex and quantity.meaning
        assert quantity.lower < quantity.upper
        if quantity.example:
            to_si(quantity.example if quantity.unit else float(quantity.example), name)


def test_error_is_one_line_and_can_be_pickled():
    error = InputError("a.b", "two\nlines " + "x" * 500, "any\nthing")
    assert "\n" not in str(error) and len(str(error)) < 200
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
    assert str(InputError("t", None, "> 0 m")) == "t: not given; allowed: > 0 m"
    assert str(InputError("t", np.float64(-1), "> 0 m")) == "t: -1.0; allowed: > 0 m"


def test_slow_libraries_are_not_imported_before_they_are_needed():
    slow = {"pint", "xarray", "scipy", "matplotlib"}
    code = f"import stiction.case.read, sys; print(sorted({slow} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_damaged_definitions_of_units_are_made_anew(tmp_path, monkeypatch):
    monkeypatch.setenv("STICTION_CACHE_DIR", str(tmp_path))
    units._registry.cache_clear()
    units._registry()
    kept = {file: file.stat().st_size for file in tmp_path.rglob("*") if file.is_file()}
    assert kept
    for file in kept:
        file.write_bytes(file.read_bytes()[:20])
    units._registry.cache_clear()
    assert units._registry().Quantity(1, "inch").to("m").magnitude == pytest.approx(0.0254)
    assert {file: file.stat().st_size for file in kept} == kept
    units._registry.cache_clear()
