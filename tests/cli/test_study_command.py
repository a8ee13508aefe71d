"""A study is one folder: its command, options, table, files and JSON follow from its declaration and its dataset."""

import json

import numpy as np
import pytest
import typer
import xarray
from typer.testing import CliRunner

from stiction.case.read import read_case
from stiction.cli import program
from stiction.cli import studies as commands
from stiction.studies.study import Study, studies

CASE = "[indices]\ntheta = 40\nlam = 10\n[solve]\nload = [0.01]\n"
PARABOLA = {"energy": ("row", [1.0, 4.0, 9.0], {"units": "1"}), "stopped_at": ((), 2.0)}


def plan(case, options, load=None):
    return read_case(case).subject.theta, options, load


@pytest.fixture
def toy(monkeypatch, tmp_path):
    def invoke(*words, **attributes):
        def run(plan, progress):
            theta, options, load = plan
            rows = list(progress("Computing")(PARABOLA["energy"][1]))
            data = xarray.Dataset(PARABOLA | {"energy": ("row", np.array(rows) * theta)}, {"row": ["a", "b", "c"]})
            return (data.assign_attrs(attributes, load=str(load), options=json.dumps(options)),)

        app = typer.Typer(cls=program._Commands)
        monkeypatch.setattr(commands, "app", app)
        app.command("other")(lambda: None)
        commands._add_command("toy", Study("toy", "Square numbers.\n\nOf a case.", "Any case.", plan, run))
        (tmp_path / "case.toml").write_text(CASE)
        return CliRunner().invoke(app, ["toy", str(tmp_path / "case.toml"), *words])

    return invoke


def test_a_study_without_a_view_shows_its_dataset(toy, tmp_path):
    shown = toy("--out", str(tmp_path / "out"), "--load", "1", "--variant", "published")
    assert shown.exit_code == 0, shown.output
    table = [line.split() for line in shown.stdout.splitlines()]
    assert ["b", "160"] in [row[:2] for row in table] and ["stopped_at", "2"] in table
    assert sorted(one.name for one in (tmp_path / "out").iterdir()) == ["toy.nc", "toy_row.csv"]
    assert (tmp_path / "out" / "toy_row.csv").read_text().splitlines()[1:] == ["a,40.0", "b,160.0", "c,360.0"]
    found = json.loads(toy("--json", "--load", "1", "--variant", "published").stdout)
    assert found["variables"]["energy"]["values"] == [40.0, 160.0, 360.0]
    assert (found["attrs"]["load"], json.loads(found["attrs"]["options"])) == ("1", {"variant": "published"})


def test_a_study_that_was_interrupted_shows_what_it_has_and_ends_as_interrupted(toy):
    for words in ([], ["--json"]):
        shown = toy(*words, stopped=1)
        assert shown.exit_code == 130 and "160" in shown.stdout and "interrupted" in shown.stderr


def test_its_help_is_its_declaration(toy):
    shown = toy("--help").stdout
    assert "Square numbers." in shown and "Of a case." in shown and "Any case." in shown and "--load" in shown


def test_every_study_of_the_package_is_a_command():
    words = {one.name: one for _, one in studies()}
    assert {"compare", "design", "film", "fit", "sensitivity"} <= set(words)
    assert {one.name for one in program.app.registered_commands} >= set(words)
