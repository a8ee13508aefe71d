"""`stiction run --sliding`: tables, files and refusals."""

import json

import numpy as np
import pytest
import xarray
from typer.testing import CliRunner

import stiction as st
from stiction.cli import app

CASE = """
title = "A lubricated contact"
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
work_of_adhesion = "50 mJ/m^2"
nominal_area = "1 mm^2"
interfacial_shear_strength = "20 MPa"
[contact.roughness]
asperity_height_deviation = "48 nm"
asperity_radius = "50 um"
asperity_density = "1.7e10 1/m^2"
[solve]
load = { start = "0.1 N", stop = "10 N", count = 9, spacing = "log" }
model = "greenwood_williamson_1966"
tangential = "bowden_tabor_1943"
"""


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    return path


def run(*words):
    return CliRunner().invoke(app, ["run", *map(str, words)], terminal_width=200)


def test_files_are_what_slide_gives(case, tmp_path):
    """Five of nine loads, first and last among them; picture, table and netCDF."""
    said = run(case, "--sliding", "--details", "--out", tmp_path / "out")
    assert said.exit_code == 0, said.output
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["sliding.csv", "sliding.nc", "sliding.png"]
    with xarray.open_dataset(tmp_path / "out" / "sliding.nc") as data:
        assert data.sizes == {"load": 5, "displacement": 61}
        assert data["load"].values[[0, -1]] == pytest.approx([0.1, 10.0])
        contact = st.read_case(case).subject
        expected = st.slide(
            contact, load=data["load"].values, model="greenwood_williamson_1966", tangential="bowden_tabor_1943"
        )
        np.testing.assert_allclose(data["tangential_force"], expected["tangential_force"], rtol=1e-12)
    lines = (tmp_path / "out" / "sliding.csv").read_text().splitlines()
    assert sum(not line.startswith("#") for line in lines) == 1 + 5 * 61
    words = " ".join(said.output.split())
    assert "largest F/P" in words and "at displacement" in words and "99 % of it" in words


def test_asperities_that_let_go(case, tmp_path):
    said = run(case, "--sliding", "--kept", "0.5", "--load", "1 N", "--json")
    assert said.exit_code == 0, said.output
    found = json.loads(said.stdout)["variables"]
    assert "energy_loss" not in found
    assert found["largest_friction_coefficient"]["values"][0] < 0.9 * found["friction_coefficient"]["values"][0]
    assert run(case, "--sliding", "--kept", "0.5", "--load", "1 N", "--out", tmp_path / "out").exit_code == 0


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--kept", "0.5"), "nothing without --sliding"),
        (("--sliding", "--kept", "2"), "from 0 to 1"),
        (("--sliding", "--tangential", "none"), "a tangential law"),
        (("--sliding", "--model", "persson_2001"), "single asperities"),
    ],
)
def test_refused_in_one_line(case, words, why):
    said = run(case, *words)
    assert said.exit_code == 2 and why in said.output and "\n" not in said.output.strip()


def test_one_contact_at_a_time(case):
    case.write_text(CASE.replace('"20 MPa"', '["10 MPa", "20 MPa"]'))
    said = run(case, "--sliding")
    assert said.exit_code == 2 and "several" in said.output


def test_a_slip_of_weakening_belongs_to_a_map(case):
    without = run(case, "--weakening-slip", "10 nm")
    assert without.exit_code == 2 and "--sliding" in without.output
    asperities = run(case, "--sliding", "--kept", "0.5", "--weakening-slip", "10 nm")
    assert asperities.exit_code == 2 and "boundary_elements" in asperities.output
