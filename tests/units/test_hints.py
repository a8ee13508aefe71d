"""Numbers of hardness tests, and what is said to have been meant by numbers that are refused."""

import math

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.quantities.dimensions import axis
from stiction.quantities.errors import InputError
from stiction.quantities.units import to_si

# ASTM E140, table 1 (steels that are not austenitic), as manuals print it: HRC -> HV
PRINTED = {68: 940, 65: 832, 62: 746, 60: 697, 58: 653, 55: 595, 50: 513, 45: 446, 40: 392, 38: 372, 35: 345}


def test_a_vickers_number_is_a_mean_pressure():
    """ISO 6507-1: HV = 0.102 * 2 F sin(68 deg) / d^2, with F in N and the diagonal d in mm; the projected area is d^2 / 2."""
    force, diagonal = 98.0665, 0.1528
    number = 0.102 * 2.0 * force * math.sin(math.radians(68.0)) / diagonal**2
    pressure = force / (diagonal**2 / 2.0) * 1e6
    assert to_si(f"{number!r} HV10", "hardness") == pytest.approx(pressure, rel=3e-4)  # 0.102 is rounded
    assert to_si("700 HV", "hardness") == to_si("700 HV0.1", "hardness") == to_si("700HV/10", "hardness")
    assert to_si("94.5 HV", "hardness") == pytest.approx(1e9, rel=1e-3)  # ISO 14577-1: HV = 0.0945 H_IT in MPa


@pytest.mark.parametrize("rockwell, vickers", PRINTED.items())
def test_rockwell_numbers_are_those_of_the_printed_table(rockwell, vickers):
    assert to_si(f"{rockwell} HRC", "hardness") == pytest.approx(to_si(f"{vickers} HV", "hardness"), rel=0.015)


@pytest.mark.parametrize(
    "text, allowed",
    [
        ("70 HRC", "68 HRC"),
        ("10 HRC", "68 HRC"),
        ("300 HK", "60 HRC"),
        ("90 HRB", "60 HRC"),
        ("-5 HV", ">= 1000 Pa"),
    ],
)
def test_other_numbers_of_hardness_tests_are_refused(text, allowed):
    with refusal("hardness", text, allowed):
        to_si(text, "hardness")


@pytest.mark.parametrize(
    "value, name, meant",
    [
        ("210", "youngs_modulus", "210 GPa"),
        (210, "youngs_modulus", "210 GPa"),
        (210.0, "youngs_modulus", "210 GPa"),
        ("210 Pa", "youngs_modulus", "210 GPa"),
        ("210 gpa", "youngs_modulus", "210 GPa"),
        ("210 GPA", "youngs_modulus", "210 GPa"),
        ("250 mpa", "hardness", "250 MPa"),
        ("250 mPa", "hardness", "250 MPa"),
        ("7.3", "hardness", "7.3 GPa"),
        (2.5, "yield_stress", "2.5 GPa"),
        ("20", "interfacial_shear_strength", "20 MPa"),
        ("48 NM", "thickness", "48 nm"),
    ],
)
def test_a_prefix_that_was_left_out_or_mistaken_is_asked_for(value, name, meant):
    with pytest.raises(InputError) as error:
        to_si(value, name)
    assert str(error.value).endswith(f'did you mean "{meant}"?') and "\n" not in str(error.value)


def test_nothing_is_made_up():
    for value, name in (("5 kg", "thickness"), ("5", "thickness"), (-1.0, "youngs_modulus"), ("-210 GPa", "hardness")):
        with pytest.raises(InputError) as error:
            to_si(value, name)
        assert "did you mean" not in str(error.value)


@pytest.mark.parametrize(
    "text, hint",
    [
        ("0,25 m", "0.25 m"),
        ("-1,5e3 m", "-1.5e3 m"),
        (",5 m", ".5 m"),
        ("0,3", "0.3"),
        ("1,000,000 m", "1,000,000 m"),
    ],
)
def test_a_decimal_comma_is_named(text, hint):
    with refusal("thickness", hint):
        to_si(text, "thickness")


def test_of_several_the_wrong_one_is_named_as_it_was_written():
    with refusal("thickness", "-5 nm", "> 0 m"):
        axis("thickness", ["100 nm", "-5 nm", "200 nm"])
    lengths = axis("thickness", [1.0, 2.0])
    lengths.attrs["units"] = "nm"
    with refusal("thickness", "-2 nm", "> 0 m"):
        to_si(lengths.copy(data=np.array([1.0, -2.0])), "thickness")
    with refusal("first.youngs_modulus", "210.0", ">= 1000 Pa", "210 GPa"):
        st.Contact(first={"preset": "iron", "youngs_modulus": 210.0})


@pytest.mark.parametrize("text", ["200 +/- 50 MPa", "200 MPa +- 50 MPa", "(200 ± 50) MPa"])
def test_an_error_belongs_in_a_case(text):
    with pytest.raises(InputError) as error:
        to_si(text, "interfacial_shear_strength")
    assert text in str(error.value) and "one value without an error (+/-); a case file" in str(error.value)
