"""Angles come back in degrees, as they were typed: in errors, on the terminal, in files, in a case written by a study."""

import math
import tomllib

import pytest
from typer.testing import CliRunner

from cases import SILICON_CASE
from stiction.case.text import show_exactly
from stiction.cli import app
from stiction.contact.liquid import Liquid
from stiction.quantities.errors import InputError
from stiction.quantities.shown import show
from stiction.quantities.units import to_si

WATER = {"relative_humidity": 0.6, "temperature": "20 degC"}
CASE = (
    SILICON_CASE
    + """
[contact.liquid]
relative_humidity = 0.6
contact_angle_first = "110 deg"
contact_angle_second = "10 deg"
[solve]
load = "1 mN"
model = "greenwood_williamson_1966"
[design]
objective = { minimise = "friction_coefficient" }
validity = "any"
effort = 1
[design.choose]
liquid.contact_angle_second = ["35 deg", "62.5 deg"]
"""
)


@pytest.mark.parametrize("degrees", [0.0, 10.0, 35.0, 62.5, 110.0, 179.0])
def test_an_angle_is_shown_in_degrees(degrees):
    text = f"{degrees:g} deg"
    for name in ("contact_angle_first", "contact_angle_second"):
        assert to_si(text, name) == pytest.approx(math.pi * degrees / 180.0, rel=1e-15)
        assert show(to_si(text, name), name) == text == show_exactly(to_si(text, name), name)


@pytest.mark.parametrize(
    ("first", "second", "worse"),
    [("30 deg", "160 deg", "second"), ("160 deg", "30 deg", "first"), ("20 deg", "160 deg", "second")],
)
def test_angles_that_do_not_wet_are_refused_in_degrees(first, second, worse):
    with pytest.raises(InputError) as caught:
        Liquid(contact_angle_first=first, contact_angle_second=second, **WATER)
    assert (caught.value.field, caught.value.value) == (f"contact_angle_{worse}", "160 deg")


def test_terminal_files_and_designed_case_have_degrees(tmp_path):
    case, out = tmp_path / "case.toml", tmp_path / "out"
    case.write_text(CASE, encoding="utf-8")
    ran = CliRunner().invoke(app, ["run", str(case), "--details", "--out", str(out)])
    assert ran.exit_code == 0 and "theta_1 = 110 deg, theta_2 = 10 deg" in " ".join(ran.output.split())
    assert "# input: liquid.contact_angle_first = 110 deg\n" in (out / "curve.csv").read_text(encoding="utf-8")
    designed = CliRunner().invoke(app, ["design", str(case), "--out", str(tmp_path / "design")])
    assert designed.exit_code == 0 and "62.5 deg" in designed.output
    liquid = tomllib.loads((tmp_path / "design" / "designed.toml").read_text(encoding="utf-8"))["contact"]["liquid"]
    assert (liquid["contact_angle_first"], liquid["contact_angle_second"]) == ("110 deg", "62.5 deg")
