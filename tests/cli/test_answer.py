"""The answer as commands print it: short, whole, and the same number everywhere."""

import json
import re
import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import xarray
from typer.testing import CliRunner

import stiction as st
from stiction.cli import app
from stiction.report.views.prediction import _in_short

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


@pytest.fixture(scope="module")
def of_copper(tmp_path_factory):
    """A function that returns what a command prints of CASE, and runs it once for all tests."""
    path = tmp_path_factory.mktemp("copper") / "copper.toml"
    path.write_text(CASE, encoding="utf-8")
    return cache(lambda command, *words, width=80: run(command, path, *words, width=width))


@pytest.mark.parametrize("command", ["run", "compare"])
@pytest.mark.parametrize("width", [80, 120])
def test_an_answer_has_at_most_15_lines_and_nothing_is_cut_off(command, width, of_copper):
    lines = of_copper(command, width=width).rstrip().splitlines()
    assert len(lines) <= 15 and max(map(len, lines)) <= width
    assert not re.search(r"\d\.?\d{9}", "\n".join(lines))
    assert not any("…" in line for line in lines)
    assert lines[0].startswith("Copper on copper") and lines[1].startswith("mu = 0.")


SILVER = """
title = "Silver film on steel"
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
nominal_area = "1 mm^2"
interface = "soft-metal film"
[contact.roughness]
asperity_height_deviation = "50 nm"
asperity_radius = "20 um"
asperity_density = "1e10 1/m^2"
[contact.coating]
material = "silver"
bodies = "second"
thickness = "1 um"
[solve]
load = ["0.5 N", "1 N", "2 N"]
"""
DESIGN = """
[design]
objective = { minimise = "friction_coefficient" }
limits = { friction_coefficient_high = { high = 0.5 } }
effort = 2
[design.choose]
coating.thickness = { low = "0.5 um", high = "4 um" }
"""
FIT = """
[fit.free]
interfacial_shear_strength = { low = "1 MPa", high = "1 GPa" }
"""
STATED = SILVER.replace('interface = "soft-metal film"', 'interfacial_shear_strength = "20 MPa"').replace("1e10", "2e10")
STICKY = STATED.replace("nominal_area", 'work_of_adhesion = "50 mJ/m^2"\nnominal_area')
SEVERAL = CASE.replace('"0.2 um"', '["0.1 um", "0.2 um", "0.3 um"]')
NAMED = 'model = "greenwood_williamson_1966"\n'
# Command -> text of its case, and its words; CASE stands for the file, OUT for a new folder, DATA for measured friction,
# SCAN for a scan.
PRINTING = {
    "run of a film": (SILVER, "run CASE"),
    "run of several": (SEVERAL, "run CASE"),
    "run of a model": (STATED + 'model = "rough_on_film"\n', "run CASE"),
    "run with uncertain numbers": (STATED.replace('"20 MPa"', '"20 +/- 4 MPa"') + 'model = "rough_on_film"\n', "run CASE"),
    "sliding": (
        CASE.replace('interface = "oxidised metal"', 'interfacial_shear_strength = "100 MPa"') + NAMED,
        "slide CASE",
    ),
    "compare of a film": (STATED, "compare CASE"),
    "sensitivity": (SILVER, "sensitivity CASE"),
    "sweep": (SEVERAL, "sweep CASE --out OUT"),
    "design": (SILVER + DESIGN, "design CASE"),
    "film": (STICKY + 'model = "soft_coating_2015"\n', "film CASE"),
    "fit of a prediction": (CASE, "fit CASE --data DATA"),
    "fit of free parameters": (STICKY + FIT, "fit CASE --data DATA --out OUT"),
    "fit": (
        CASE.replace('interface = "oxidised metal"', 'interfacial_shear_strength = "100 MPa"') + NAMED + FIT,
        "fit CASE --data DATA",
    ),
    "report": (SILVER, "report CASE --out OUT.html"),
    "surface": (CASE, "surface SCAN --size 20um --unit m"),
    "surface of a case": (
        CASE.replace('["1 N", "10 N", "100 N"]', '"0.1 N"'),
        "surface SCAN --size 20um --unit m --case CASE --out OUT",
    ),
}


@pytest.fixture(scope="module")
def scan():
    spectrum = st.SelfAffine(hurst=0.8, rolloff=3e-6, shortest=0.8e-6, deviation=12e-9)
    return st.gaussian_surface((192, 192), (20e-6, 20e-6), spectrum, seed=4).heights


@pytest.mark.parametrize("which", PRINTING)
@pytest.mark.usefixtures("empty_pictures")
def test_no_result_is_longer_than_15_lines_or_cut_off_or_of_ten_digits(which, tmp_path, monkeypatch, scan):
    monkeypatch.chdir(tmp_path)  # names of files as short as a user types them
    text, words = PRINTING[which]
    places = {
        "CASE": Path("case.toml"),
        "OUT": Path("out"),
        "OUT.html": Path("out.html"),
        "DATA": Path("mu.csv"),
        "SCAN": Path("scan.npy"),
    }
    np.save(places["SCAN"], scan)
    places["CASE"].write_text(text, encoding="utf-8")
    places["DATA"].write_text("load [N],friction_coefficient\n1,0.31\n10,0.30\n100,0.32\n", encoding="utf-8")
    lines = run(*(places.get(word, word) for word in words.split())).rstrip().splitlines()
    assert 0 < len(lines) <= 15, lines
    said = [line for line in lines if str(tmp_path) not in line]
    assert max(map(len, said)) <= 80 and not any("…" in line for line in lines)
    assert not re.search(r"\d\.?\d{9}", "\n".join(said))


def test_what_is_not_used_and_the_warning_are_never_left_out():
    """Of an answer for which there is no room at all."""
    heads = (
        "mu = 1",
        "along the load",
        "state",
        "uncertainty from",
        "model",
        "if worn through",
        "checked against",
        "warning",
        "not used",
    )
    shown = _in_short([(head, "words " * 20) for head in heads], 5)
    assert {"warning", "not used", "state"} <= {row[0] for row in shown.rows}


def test_mu_of_one_model_names_its_load_where_there_are_several(case):
    assert re.search(r"^mu +0\.\d+ at 10 N$", run("run", case, "--model", "persson_2001"), re.MULTILINE)


def test_models_without_friction_are_counted_where_the_interface_is_not_stated(case, of_copper):
    assert "give an area but no" not in of_copper("compare")
    case.write_text(CASE.replace('interface = "oxidised metal"\n', ""), encoding="utf-8")
    lines = run("compare", case).splitlines()
    count = int(re.search(r"(\d+) give an area but no friction: state the interface", " ".join(lines)).group(1))
    data = st.compare(st.read_case(case).subject, load="10 N")
    assert count == int(data.friction_coefficient_at_load.isnull().sum()) > 10 and len(lines) <= 15


def test_the_same_mu_to_two_digits_everywhere(tmp_path):
    """From run, compare, sweep (one row of it), report, Python and the page's export."""
    from stiction.web.query import Query, solved

    path, page = tmp_path / "case.toml", tmp_path / "report.html"
    path.write_text(SILVER.replace('load = ["0.5 N", "1 N", "2 N"]', 'load = ["1 N"]'), encoding="utf-8")
    expected = f"{st.predict(path, load='1 N').friction_coefficient.item():.2g}"
    for command in ("run", "compare"):
        answer = json.loads(run(command, path, "--json"))["answer"]
        assert f"{answer['friction_coefficient']:.2g}" == expected
    run("report", path, "--out", page)
    assert f"μ = {expected}</span>" in page.read_text(encoding="utf-8")
    exported = solved(Query(tomllib.loads(path.read_text(encoding="utf-8")))).data
    assert f"{exported['friction_coefficient'].item():.2g}" == expected
    several = tmp_path / "several.toml"
    several.write_text(path.read_text(encoding="utf-8").replace('"1 um"', '["1 um", "2 um"]'), encoding="utf-8")
    swept = st.sweep(several, tmp_path / "store")
    assert f"{swept['friction_coefficient'].values[0, 0]:.2g}" == expected
    low, high = (swept[f"friction_coefficient_{end}"].values for end in ("low", "high"))
    assert (low < swept["friction_coefficient"].values).all() and (swept["friction_coefficient"].values < high).all()


def test_the_same_number_from_run_compare_and_predict(case, of_copper):
    from_run, from_compare = (json.loads(of_copper(command, "--json"))["answer"] for command in ("run", "compare"))
    predicted = st.predict(case, load="10 N")
    assert ANSWER <= from_run.keys() and ANSWER <= from_compare.keys()
    for answer in (from_run, from_compare):
        assert answer["friction_coefficient"] == pytest.approx(predicted.friction_coefficient.item(), rel=1e-9)
        ends = [predicted.friction_coefficient_low.item(), predicted.friction_coefficient_high.item()]
        assert answer["interval"] == pytest.approx(ends, rel=1e-9) and answer["level"] == 0.9
    shown = f"mu = {float(f'{predicted.friction_coefficient.item():.2g}'):g}"
    assert shown in of_copper("run") and shown in of_copper("compare")


def test_a_named_model_answers_alone(case):
    answer = json.loads(run("run", case, "--model", "persson_widened", "--json"))["answer"]
    solved = st.solve(st.read_case(case).subject, load="10 N", model="persson_widened")
    assert answer["friction_coefficient"] == pytest.approx(solved.friction_coefficient.item(), rel=1e-9)
    assert answer["interval"] is None


@pytest.mark.usefixtures("no_pictures")
def test_files_hold_what_is_printed(case, tmp_path):
    run("run", case, "--out", tmp_path / "out")
    with xarray.open_dataset(tmp_path / "out" / "curve.nc", engine="h5netcdf") as data:
        predicted = st.predict(case)
        xarray.testing.assert_allclose(data["friction_coefficient"], predicted["friction_coefficient"])
        assert json.loads(data.attrs["shares"]) == pytest.approx(predicted.attrs["shares"])
    lines = (tmp_path / "out" / "curve.csv").read_text(encoding="utf-8").splitlines()
    heads = next(line for line in lines if not line.startswith("#")).split(",")
    assert heads[:3] == ["load [N]", "friction_coefficient", "friction_coefficient_low"]


def test_details_name_the_source_of_the_interface(of_copper):
    assert "wheeler_1976" in of_copper("run", "--details") and "wheeler_1976" not in of_copper("run")


def test_models_that_say_the_same_share_a_row(of_copper):
    said = of_copper("compare")
    assert " +" in said and "--all lists every model" in said
    assert len(of_copper("compare", "--all").splitlines()) > 30


def test_compare_says_why_its_models_are_below_the_prediction(case, of_copper):
    """Junctions of copper grow under shear, which most models leave out. Models of lubricated steel agree with it."""
    said = " ".join(of_copper("compare").split())
    assert "model + others of equal mu" in said
    assert re.search(r"mu = 0\.\d+ includes a factor of 2\.\d for the growth of junctions under shear; most models", said)
    steel = CASE.replace('"copper"', '"hardened_steel_52100"').replace("oxidised metal", "boundary lubricant")
    case.write_text(steel.replace("0.2 um", "60 nm"), encoding="utf-8")
    assert "most models include" not in (said := run("compare", case)) and "nominal inputs" not in said


def test_a_load_that_flattens_the_faces_is_refused(case):
    result = CliRunner().invoke(app, ["run", str(case), "--load", "1 GN"])
    assert result.exit_code == 2 and "hardness times the nominal area" in result.output
    assert len(result.output.strip().splitlines()) == 1


def test_the_readme_shows_what_its_case_prints(tmp_path):
    text = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    (tmp_path / "copper.toml").write_text(text.partition("# file: copper.toml\n")[2].partition("```")[0], encoding="utf-8")
    shown = text.partition("stiction run copper.toml\n")[2].partition("\n```")[0].splitlines()
    printed = [line.rstrip() for line in run("run", tmp_path / "copper.toml").splitlines()]
    assert printed == shown


def test_pasted_asperities_have_a_kind_or_a_distribution_and_every_line_counts(tmp_path, monkeypatch, scan):
    monkeypatch.chdir(tmp_path)
    np.save("scan.npy", scan)
    said = run("surface", "scan.npy", "--size", "20 um", "--unit", "m", "--save-map", "map.gwy")
    assert said.splitlines()[-1] == "written to map.gwy"
    pasted = said.partition("# or its asperities")[2].partition("Details")[0]
    assert 'kind = "' in pasted and "height_distribution" not in pasted
    text = CASE[: CASE.index("[contact.roughness]")] + "[contact.roughness]" + pasted + '[solve]\nload = "1 N"\n'
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    assert "not used" not in run("run", "case.toml")
