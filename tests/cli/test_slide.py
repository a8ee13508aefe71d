"""`stiction slide`: tables, files and refusals."""

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


def slide(*words):
    return CliRunner().invoke(app, ["slide", *map(str, words)], terminal_width=200)


def test_files_are_what_slide_gives(case, tmp_path):
    """Five of nine loads, first and last among them; picture, table and netCDF."""
    said = slide(case, "--details", "--out", tmp_path / "out")
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
    assert "largest F/P" in words and "at displacement" in words and "99 %" in words


def test_asperities_that_let_go(case, tmp_path):
    said = slide(case, "--residual-strength", "0.5", "--load", "1 N", "--json")
    assert said.exit_code == 0, said.output
    found = json.loads(said.stdout)["variables"]
    assert "energy_loss" not in found
    assert found["largest_friction_coefficient"]["values"][0] < 0.9 * found["friction_coefficient"]["values"][0]
    assert slide(case, "--residual-strength", "0.5", "--load", "1 N", "--out", tmp_path / "out").exit_code == 0


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--residual-strength", "2"), "from 0 to 1"),
        (("--tangential", "none"), "a tangential law"),
        (("--model", "persson_2001"), "single asperities"),
    ],
)
def test_refused_in_one_line(case, words, why):
    said = slide(case, *words)
    assert said.exit_code == 2 and why in said.output and "\n" not in said.output.strip()


def test_one_contact_at_a_time(case):
    case.write_text(CASE.replace('"20 MPa"', '["10 MPa", "20 MPa"]'))
    said = slide(case)
    assert said.exit_code == 2 and "array parameters" in said.output


def test_a_slip_of_weakening_belongs_to_a_map(case):
    asperities = slide(case, "--residual-strength", "0.5", "--weakening-slip", "10 nm")
    assert asperities.exit_code == 2 and "boundary_elements" in asperities.output


def test_the_map_of_a_case_is_moved_aside(tmp_path):
    """As in Python, at all loads; the surface is a period that is read from a file."""
    length = 1e-5
    surface = st.gaussian_surface((48, 48), (length, length), st.SelfAffine(0.8, length / 4, length / 16, 2e-8), seed=1)
    np.save(tmp_path / "map.npy", surface.heights)
    (tmp_path / "case.toml").write_text(
        """
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
interfacial_shear_strength = "300 MPa"
nominal_area = "100 um^2"
[contact.roughness]
first = { file = "map.npy", size = "10 um", unit = "m", periodic = true }
[solve]
load = ["1 mN", "10 mN"]
"""
    )
    weakened = ("--residual-strength", "0.3", "--weakening-slip", "5 nm")
    said = slide(tmp_path / "case.toml", "--model", "boundary_elements", *weakened, "--json", "--out", tmp_path / "out")
    assert said.exit_code == 0, said.output
    contact = st.read_case(tmp_path / "case.toml").subject
    found = st.slide(contact, load=["1 mN", "10 mN"], model="boundary_elements", residual_strength=0.3, weakening_slip="5 nm")
    efficiency = json.loads(said.stdout)["variables"]["friction_efficiency"]["values"]
    np.testing.assert_allclose(efficiency, found["friction_efficiency"], rtol=1e-9)
    assert all(0.3 < one < 1.0 for one in efficiency)
    assert "point_state" not in json.loads(said.stdout)["variables"]
    written = ["sliding.csv", "sliding.gif", "sliding.nc", "sliding.png"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == written
    assert (tmp_path / "out" / "sliding.gif").read_bytes()[:6] == b"GIF89a"
    with xarray.open_dataset(tmp_path / "out" / "sliding.nc") as data:
        states = data["point_state"].transpose("load", "displacement", "row", "column").values
        sticking = (states == 1).sum(axis=(2, 3)) / (states > 0).sum(axis=(2, 3))
        np.testing.assert_allclose(sticking, data["sticking_share"], rtol=1e-12)
