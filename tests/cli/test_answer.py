"""The answer as commands print it: short, whole, and the same number everywhere."""

import json
from pathlib import Path

import pytest
import xarray
from typer.testing import CliRunner

import stiction as st
from stiction.cli import app

CASE = """
title = "Copper on copper, in air"
[contact]
first = "copper"
second = "copper"
nominal_area = "1 cm^2"
interface = "oxidised metal"
[contact.roughness]
asperity_height_deviation = "0.2 um"
asperity_radius = "20 um"
asperity_density = "1e10 1/m^2"
[solve]
load = ["1 N", "10 N", "100 N"]
"""
ANSWER = {"friction_coefficient", "interval", "level", "friction_force", "regime", "shares", "warnings"}


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "copper.toml"
    path.write_text(CASE, encoding="utf-8")
    return path


def run(*words, width=80):
    result = CliRunner().invoke(app, [str(word) for word in words], env={"COLUMNS": str(width)})
    assert result.exit_code == 0, (result.output, result.exception)
    return result.stdout


@pytest.mark.parametrize("command", ["run", "compare"])
@pytest.mark.parametrize("width", [80, 120])
def test_an_answer_has_at_most_15_lines_and_nothing_is_cut_off(command, width, case):
    lines = run(command, case, width=width).rstrip().splitlines()
    assert len(lines) <= 15 and max(map(len, lines)) <= width
    assert not any("…" in line for line in lines)
    assert lines[0].startswith("Copper on copper") and lines[1].startswith("mu = 0.")


def test_the_same_number_from_run_compare_and_predict(case):
    from_run, from_compare = (json.loads(run(command, case, "--json"))["answer"] for command in ("run", "compare"))
    predicted = st.predict(case, load="10 N")
    assert ANSWER <= from_run.keys() and ANSWER <= from_compare.keys()
    for answer in (from_run, from_compare):
        assert answer["friction_coefficient"] == pytest.approx(predicted.friction_coefficient.item(), rel=1e-9)
        ends = [predicted.friction_coefficient_low.item(), predicted.friction_coefficient_high.item()]
        assert answer["interval"] == pytest.approx(ends, rel=1e-9) and answer["level"] == 0.9
    shown = f"mu = {float(f'{predicted.friction_coefficient.item():.2g}'):g}"
    assert shown in run("run", case) and shown in run("compare", case)


def test_a_named_model_answers_alone(case):
    answer = json.loads(run("run", case, "--model", "persson_widened", "--json"))["answer"]
    solved = st.solve(st.read_case(case).subject, load="10 N", model="persson_widened")
    assert answer["friction_coefficient"] == pytest.approx(solved.friction_coefficient.item(), rel=1e-9)
    assert answer["interval"] is None


def test_files_hold_what_is_printed(case, tmp_path):
    run("run", case, "--out", tmp_path / "out")
    with xarray.open_dataset(tmp_path / "out" / "curve.nc", engine="h5netcdf") as data:
        predicted = st.predict(case)
        xarray.testing.assert_allclose(data["friction_coefficient"], predicted["friction_coefficient"])
        assert json.loads(data.attrs["shares"]) == pytest.approx(predicted.attrs["shares"])
    lines = (tmp_path / "out" / "curve.csv").read_text(encoding="utf-8").splitlines()
    heads = next(line for line in lines if not line.startswith("#")).split(",")
    assert heads[:3] == ["load [N]", "friction_coefficient", "friction_coefficient_low"]


def test_details_name_the_source_of_the_interface(case):
    assert "wheeler_1976" in run("run", case, "--details") and "wheeler_1976" not in run("run", case)


def test_models_that_say_the_same_share_a_row(case):
    said = run("compare", case)
    assert " +" in said and "--all lists every model" in said
    assert len(run("compare", case, "--all").splitlines()) > 30


def test_a_load_that_flattens_the_faces_is_refused(case):
    result = CliRunner().invoke(app, ["run", str(case), "--load", "1 GN"])
    assert result.exit_code == 2 and "hardness times the nominal area" in result.output
    assert len(result.output.strip().splitlines()) == 1


def test_the_readme_shows_what_the_demo_prints():
    root = Path(__file__).parents[2]
    shown = (root / "README.md").read_text(encoding="utf-8").partition("--out demo\n")[2].partition("\n...")[0].splitlines()
    printed = [line.rstrip() for line in run("run", root / "examples" / "soft_film.toml").splitlines()]
    assert shown and printed[: len(shown)] == shown
