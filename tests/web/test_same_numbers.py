"""The page and the command line say the same, to the last digit: the case file that the page gives away is run."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray
from typer.testing import CliRunner

import stiction as st
from stiction.case.text import as_toml
from stiction.cli import app
from stiction.quantities.errors import InputError
from stiction.web.query import Query, compared, headline, solved
from stiction.web.share_tab import KINDS, content

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.toml"))


@pytest.fixture(autouse=True)
def one_tier(force_loops):
    """Answers are compared to the last digit: Python and compiled code may differ in it."""
    force_loops("shared")


def _rows(text: str) -> list[str]:
    return [line for line in text.splitlines() if not line.startswith("#")]


@pytest.mark.usefixtures("no_pictures")
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_a_case_file_of_the_page_gives_the_same_numbers_on_the_command_line(path, tmp_path, monkeypatch):
    answer = solved(Query(tomllib.loads(path.read_text(encoding="utf-8")), path.parent))
    (tmp_path / "case.toml").write_bytes(content(answer, "case.toml"))
    monkeypatch.chdir(tmp_path)
    said = CliRunner().invoke(app, ["run", "case.toml", "--out", "out"])
    assert said.exit_code == 0, said.output
    assert _rows(content(answer, "curve.csv").decode()) == _rows((tmp_path / "out" / "curve.csv").read_text(encoding="utf-8"))
    (tmp_path / "page.nc").write_bytes(content(answer, "curve.nc"))
    with xarray.open_dataset(tmp_path / "page.nc") as page, xarray.open_dataset(tmp_path / "out" / "curve.nc") as run:
        xarray.testing.assert_equal(page, run)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_models_are_compared_as_on_the_command_line(path, tmp_path):
    from stiction import compare_case, read_case

    tables = tomllib.loads(path.read_text(encoding="utf-8"))
    tables["uncertainty"] = {"count": 64}  # few draws, where there are any
    path = tmp_path / "case.toml"
    path.write_text(as_toml(tables), encoding="utf-8")
    question = Query(tables, path.parent)
    load = float(np.max(solved(question).data["load"]))
    _, found, _ = compared(question, load, lambda text: iter)
    xarray.testing.assert_equal(found, compare_case(read_case(path), load=load))


@pytest.mark.parametrize("name", ["silver_on_steel", "soft_film"])
def test_the_prediction_of_the_page_is_that_of_python_and_of_the_command_line(name):
    path = ROOT / "examples" / f"{name}.toml"
    page = solved(Query(tomllib.loads(path.read_text(encoding="utf-8")), path.parent))
    found = st.predict(path)
    mu = float(found["friction_coefficient"].sel(load=found.attrs["working_load"]))
    number, where = headline(page, page.middle())
    assert number == f"mu = {mu:.2g}"
    said = json.loads(CliRunner().invoke(app, ["run", str(path), "--json"]).output)["answer"]
    assert number == f"mu = {said['friction_coefficient']:.2g}"
    assert where.startswith("90% interval {:.2g} to {:.2g}, at ".format(*said["interval"]))


def test_a_case_of_separations_that_names_the_recommended_model_is_predicted():
    tables = tomllib.loads((ROOT / "examples" / "silver_on_steel.toml").read_text(encoding="utf-8"))
    named = solved(Query({**tables, "solve": {**tables["solve"], "model": "recommended"}}))
    assert named.is_prediction
    expected = st.predict(tables)["friction_coefficient"].values
    np.testing.assert_array_equal(named.data["friction_coefficient"].values, expected)


def test_pictures_are_pictures():
    answer = solved(Query(tomllib.loads(EXAMPLES[-1].read_text(encoding="utf-8"))))
    assert content(answer, "curve.png").startswith(b"\x89PNG") and b"<svg" in content(answer, "curve.svg")
    assert set(KINDS) == {"case.toml", "curve.csv", "curve.nc", "curve.svg", "curve.png"}


def test_the_first_case_is_that_of_the_examples():
    from stiction.web.fields import first_case

    assert first_case() == tomllib.loads((ROOT / "examples" / "soft_film.toml").read_text(encoding="utf-8"))


def test_a_case_that_is_too_large_for_a_page_is_refused():
    from stiction.web.fields import first_case

    tables = first_case()
    tables["solve"] = {"load": {"start": "1 mN", "stop": "1 N", "count": 90_000}}
    with pytest.raises(InputError, match="stiction run"):
        solved(Query(tables))
    tables = first_case()
    tables["contact"]["work_of_adhesion"] = {"low": "0.1 J/m^2", "high": "1 J/m^2"}
    tables["uncertainty"] = {"count": 2**20}
    with pytest.raises(InputError) as caught:
        solved(Query(tables))
    assert caught.value.field == "uncertainty.count"


def test_input_warnings_are_in_the_answer_and_no_warning():
    from stiction.web.fields import first_case

    tables = first_case()
    tables["contact"]["roughness"] |= {"asperity_height_deviation": "50 um", "asperity_radius": "48 nm"}
    assert solved(Query(tables)).input_warnings
