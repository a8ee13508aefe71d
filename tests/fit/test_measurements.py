"""Measured series: units in the heads, several samples, and one line about everything that is wrong."""

import numpy as np
import pytest

from refusals import refusal
from stiction.case.measurements import read_measurements

CASE = {
    "contact": {
        "first": "hardened_steel_52100",
        "second": "hardened_steel_52100",
        "nominal_area": "1 mm^2",
        "roughness": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
        "coating": {"material": "silver", "thickness": "200 nm"},
    }
}


@pytest.fixture
def read(tmp_path):
    def of(text):
        path = tmp_path / "measured.csv"
        path.write_text(text, encoding="utf-8")
        return read_measurements(path, CASE)

    return of


def test_a_table_is_read_in_si_units(read):
    found = read(
        "# a comment\n"
        "sample,load [mN],friction_coefficient,friction_coefficient_error,pull_off_force [uN],coating.thickness [nm],note\n"
        "a,5,0.2,0.01,,50,first\n"
        "\n"
        'b,250,,,3,100,"second, drier"\n'
    )
    assert found.quantity == ("friction_coefficient", "pull_off_force") and found.sample == ("a", "b")
    np.testing.assert_allclose(found.load, [0.005, 0.25], rtol=1e-15)
    np.testing.assert_allclose(found.value, [0.2, 3e-6], rtol=1e-15)
    assert found.error[0] == 0.01 and np.isnan(found.error[1])
    thickness = ("contact", "coating", "thickness")
    assert [one[thickness] for one in found.known] == pytest.approx([50e-9, 100e-9], rel=1e-15) and found.line == (3, 5)


def test_a_table_of_a_spreadsheet_with_decimal_commas(read):
    found = read(
        "\ufeffsample;load [mN];friction_coefficient;friction_coefficient_error;coating.thickness [nm];note\r\n"
        'a, b;0,5;0,25;1,5e-2;50;"first; drier, too"\r\n'
        ";;;;;\r\n"
        "c;0.5;,5;0.02;1e2;\r\n"
    )
    np.testing.assert_allclose(found.load, [0.0005, 0.0005], rtol=1e-15)
    assert found.value.tolist() == [0.25, 0.5] and found.error.tolist() == [0.015, 0.02]
    assert found.sample == ("a, b", "c") and found.line == (2, 4)
    for cell in ("1.250,5", "1,250,5", "1,2 N"):
        with refusal("line 2, load [mN]", cell):
            read(f"load [mN];friction_coefficient\n{cell};0,2\n")
    with refusal("line 2", "1"):
        read("load [mN];friction_coefficient\n1,0\n")


def test_what_was_measured_without_a_load(read):
    found = read("pull_off_force [mN]\n1\n2\n")
    assert np.isnan(found.load).all() and found.value.tolist() == [0.001, 0.002]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", ("--data",)),
        ("load [N]\n1\n", ("--data",)),
        ("load,friction_coefficient\n1,0.2\n", ("--data", "load [N]")),
        ("load [N],friction_coefficient [mN]\n1,0.2\n", ("--data",)),
        ("friction_coefficient\n0.2\n", ("--data",)),
        ("load [N],fricton_coefficient\n1,0.2\n", ("--data", "fricton_coefficient", "friction_coefficient")),
        ("load [N],friction_coefficient,hardness [GPa]\n1,0.2,3\n", ("--data", "hardness [GPa]")),
        ("load [N],friction_coefficient\n1,0.2,3\n", ("line 2", "3", "2")),
        ("load [N],friction_coefficient\n1,much\n", ("line 2, friction_coefficient", "much")),
        ("load [N],friction_coefficient\n1,-0.2\n", ("line 2, friction_coefficient", "-0.2", ">= 0")),
        ("load [km],friction_coefficient\n1,0.2\n", ("line 2, load [km]", "1 km")),
        ("load [N],friction_coefficient\n,0.2\n", ("line 2",)),
        ("load [N],friction_coefficient,friction_coefficient_error\n1,0.2,0\n", ("line 2, friction_coefficient_error", "0.0")),
        (
            "load [N],friction_coefficient,friction_coefficient_error\n1,0.2,0.1\n2,0.2,\n",
            ("line 3, friction_coefficient_error",),
        ),
        ("load [N],friction_coefficient\n0,0.2\n", ("line 2, load", "0.0", "0", "friction_coefficient")),
        ("load [N]\tfriction_coefficient\n1\t0.2\n", ("--data",)),
        (
            "load [N],friction_coefficient,friction_coefficient_error\n1,0.2,1e-12\n",
            ("line 2, friction_coefficient_error", "1e-12", "2e-11", "1e-10"),
        ),
        ("load [N],load [mN],friction_coefficient\n1,1,0.2\n", ("--data", "load [N]")),
        ("load [N],contact_area_error [m^2],friction_coefficient\n1,1,0.2\n", ("--data", "contact_area")),
        ("load [N],friction_coefficient\n", ("--data",)),
    ],
)
def test_one_line_about_what_is_wrong(read, text, said):
    with refusal(*said) as caught:
        read(text)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there(tmp_path):
    with refusal("--data"):
        read_measurements(tmp_path / "none.csv", CASE)
