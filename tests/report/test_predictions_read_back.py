"""Read the numbers of a prediction back from terminal, JSON and files: a body pressed flat, mu = tau_0 A_n/P.

Of its interface 5 and 95 % quantiles of tau_0 are stated, so that the 90 % interval of mu is known in closed form.
"""

import csv
import json
import re

import numpy as np
import pytest
from typer.testing import CliRunner

from stiction.cli import app

CASE = """
[contact]
first = { youngs_modulus = "2 MPa", poissons_ratio = 0.49, hardness = "10 MPa", material_class = "elastomer" }
second = { youngs_modulus = "1000 GPa", poissons_ratio = 0.3, hardness = "100 GPa", material_class = "ceramic" }
nominal_area = "100 mm^2"
[contact.interface]
interfacial_shear_strength = "100 kPa"
range = { interfacial_shear_strength = ["50 kPa", "200 kPa"] }
[contact.roughness]
asperity_height_deviation = "0.2 um"
asperity_radius = "20 um"
asperity_density = "1e10 1/m^2"
[solve]
load = ["200 N", "500 N", "900 N", "1 kN"]
"""
LOADS, AREA = (200.0, 500.0, 900.0, 1000.0), 1e-4
FORCE = [1e5 * AREA, 5e4 * AREA, 2e5 * AREA]  # median and ends, at every load
WITHIN = 0.02  # of quantiles of 512 draws


@pytest.fixture
def called(tmp_path):
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")

    def run(command, *options):
        done = CliRunner().invoke(app, [command, str(tmp_path / "case.toml"), *map(str, options)], env={"COLUMNS": "300"})
        assert done.exit_code == 0, (done.output, done.exception)
        return done.stdout

    return run


def numbers(text):
    return [float(one) for one in re.findall(r"\d+\.?\d*", text)]


def test_terminal(called):
    text = called("run", "--details")
    lines = {line[:18].strip(): line[18:].strip() for line in text.splitlines() if line[:18].strip()}
    head = next(name for name in lines if name.startswith("mu = "))
    assert numbers(head) == [0.02] and numbers(lines[head]) == [90.0, 0.01, 0.04, 500.0, 200.0, 1.0]  # N, of 200 N to 1 kN
    assert numbers(lines["friction force"])[:3] == [10.0, 5.0, 20.0]
    assert lines["friction force"].endswith("real contact 100 mm²")
    assert numbers(lines["along the load"]) == [0.05, 0.025, 0.1, 200.0, 0.01, 0.005, 0.02, 1.0]
    assert lines["state"].startswith("The surfaces are pressed flat") and lines["uncertainty from"] == "100% interface strength"
    assert numbers(next(line for line in text.splitlines() if line.startswith("samples"))) == [512.0, 0.0]


@pytest.mark.parametrize("command", ["run", "compare"])
def test_json(called, command):
    answer = json.loads(called(command, "--json"))["answer"]
    assert [answer["friction_coefficient"], *answer["interval"]] == pytest.approx([0.02, 0.01, 0.04], rel=WITHIN)
    assert [answer["friction_force"], *answer["friction_force_interval"]] == pytest.approx(FORCE, rel=WITHIN)
    assert [answer["contact_area"], *answer["contact_area_interval"]] == pytest.approx([AREA] * 3, rel=1e-6)
    assert (answer["load"], answer["level"], answer["excluded"], answer["warnings"]) == (500.0, 0.9, 0.0, [])
    assert answer["shares"] == {"interface": pytest.approx(1.0, abs=0.01)}


@pytest.mark.usefixtures("no_pictures")
def test_files(called, tmp_path):
    called("run", "--out", tmp_path / "out")
    with (tmp_path / "out" / "curve.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for row, load in zip(rows, LOADS, strict=True):
        read = [float(row[f"friction_coefficient{end}"]) for end in ("", "_low", "_high")]
        assert float(row["load [N]"]) == load and read == pytest.approx(np.array(FORCE) / load, rel=WITHIN)
        read = [float(row[f"friction_force{end} [N]"]) for end in ("", "_low", "_high")]
        assert read == pytest.approx(FORCE, rel=WITHIN)
        assert float(row["contact_area [m^2]"]) == pytest.approx(AREA, rel=1e-6)


@pytest.mark.usefixtures("no_pictures")
def test_a_written_curve_says_what_made_it(called, tmp_path):
    """Models, inputs in their units and what the columns are, as comments before the heads."""
    called("run", "--out", tmp_path / "out")
    lines = (tmp_path / "out" / "curve.csv").read_text(encoding="utf-8").splitlines()
    said = [line[2:] for line in lines if line.startswith("# ")]
    assert len(said) > 9 and lines[len(said)].startswith("load [N],")
    shares = re.findall(r"\w+ (\d+)%", next(line for line in said if line.startswith("model: ")))
    assert sum(map(int, shares)) == pytest.approx(100, abs=1)
    assert {"input: nominal_area = 100 mm^2", "input: first.youngs_modulus = 2 MPa"} <= set(said)
    assert any(line.startswith("column: friction_force_low: ") and line.endswith("[N]") for line in said)


def test_a_sweep_tells_between_which_ends_mu_is(called, tmp_path):
    """Of bodies pressed flat the modulus decides nothing: mu from 1 kN to 200 N, and both ends of all intervals."""
    case = CASE.replace('"2 MPa"', '["1.9 MPa", "2 MPa"]')
    (tmp_path / "case.toml").write_text(case, encoding="utf-8")
    line = next(line for line in called("sweep", "--out", tmp_path / "store").splitlines() if line.startswith("mu = "))
    assert numbers(line)[:4] == [0.01, 0.05, 0.005, 0.1]
