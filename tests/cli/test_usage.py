"""Wrong usage of the command line: one line with the field, the value and what is allowed, and exit code 2."""

import subprocess
import sys

import pytest
from typer.testing import CliRunner

from stiction import cli
from stiction.case.study_tables import study_tables
from stiction.quantities import paths
from stiction.quantities.errors import InputError
from stiction.studies.study import studies

STUDIES = ", ".join(study.name for _, study in studies())
CASES = {
    "surface scan.npy --form 5": ("--form: '5'", "4"),
    "surface scan.npy --form 1.5": ("--form: '1.5'", "integer"),
    "surface scan.npy --spikes abc": ("--spikes: 'abc'", "a valid "),
    "surface scan.npy --spikes": ("--spikes: not given", "a value after it"),
    "figures --theta many": ("--theta: 'many'", "a valid "),
    "run": ("CASE.toml: not given", "Case file"),
    "run one.toml two.toml": ("arguments: 'two.toml'", "CASE.toml and options"),
    "schema here": ("arguments: 'here'", "options only"),
    "compare case.toml --lod 3": ("option: '--lod'", "--load, --all, --ranges, --out, --json, --help"),
    "run case.toml -x": ("option: '-x'", "--model"),
    "run case.toml --json=3": ("--json: 'with a value'", "without a value"),
    "--bad": ("option: '--bad'", "--version, --install-completion, --show-completion, --help"),
    "no-such-command --out x": ("command: 'no-such-command'", f"sweep, {STUDIES}, report, validate, export, surface"),
    "--": ("command: not given", f"sweep, {STUDIES}, report, validate, export, surface"),
}


def said(*words):
    """What is said to wrong usage."""
    result = CliRunner().invoke(cli.app, list(words))
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith("stiction: ") and result.stderr.count("\n") == 1
    return result.stderr


@pytest.mark.parametrize("words", CASES)
def test_wrong_usage_is_one_line(words):
    field, allowed = CASES[words]
    text = said(*words.split())
    assert text.startswith(f"stiction: {field}; allowed: ") and allowed in text.partition("allowed: ")[2]


@pytest.mark.parametrize("words", (["run", "case.toml"], ["compare", "case.toml"], ["surface", "scan.npy"], ["figures"]))
@pytest.mark.parametrize("name", ("", " "))
def test_a_folder_without_a_name_is_not_the_current_one(words, name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert said(*words, "--out", name).startswith(f"stiction: --out: '{name}'; allowed: the name of a folder")
    assert list(tmp_path.iterdir()) == []


def test_the_current_folder_can_be_named(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text("[indices]\ntheta = 40\nlam = 10\n[solve]\nseparation = [1, 0]\n")
    assert CliRunner().invoke(cli.app, ["run", "case.toml", "--out", "."]).exit_code == 0
    assert (tmp_path / "curve.csv").exists()


def test_a_folder_by_default_is_one_too(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert said("figures", "--theta", "-1").startswith("stiction: theta: -1")


def test_without_arguments_and_with_help_it_helps():
    nothing, asked = (CliRunner().invoke(cli.app, words) for words in ([], ["--help"]))
    assert (nothing.exit_code, asked.exit_code) == (2, 0)
    assert "Usage:" in nothing.output and "compare" in nothing.output and "stiction: " not in nothing.output
    assert "Usage:" in asked.stdout and asked.stderr == ""
    one = CliRunner().invoke(cli.app, ["run", "--help"])
    assert one.exit_code == 0 and "CASE.toml" in one.stdout


def test_the_command_itself_says_it_in_one_line():
    code = "from stiction.cli import main; main()"
    done = subprocess.run([sys.executable, "-c", code, "surface", "x.npy", "--form", "5"], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert done.stderr.startswith("stiction: --form: '5'; allowed: ")


@pytest.mark.parametrize("command", study_tables())
def test_tables_are_named_in_the_help(command):
    shown = CliRunner().invoke(cli.app, [command, "--help"]).stdout
    assert f"[{command}]" in shown and "\\" not in shown
    assert "\\" not in said("fit")


@pytest.mark.parametrize("words", (["run", "case.toml"], ["fit", "case.toml", "--data", "d.csv"], ["report", "case.toml"]))
def test_a_place_where_nothing_can_be_is_refused_at_once(words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("kept")
    end = ".html" if words[0] == "report" else ""
    for name, why in (
        ("a" * 300 + end, "this path cannot be used"),
        (f"file/x{end}", "a parent folder in this path is a file"),
    ):
        text = said(*words, "--out", name)  # there is no case: the place is looked at first
        assert text.startswith("stiction: --out: ") and why in text
    assert [one.name for one in tmp_path.iterdir()] == ["file"]


def test_a_name_that_no_system_takes(tmp_path):
    from stiction.report.files import check_folder
    from stiction.report.html_report import check_place

    for check in (check_folder, check_place):
        with pytest.raises(InputError, match="this path cannot be used"):
            check(tmp_path / "a\0b.html")


def test_a_folder_that_cannot_be_made_is_refused_at_once(tmp_path, monkeypatch):
    monkeypatch.setattr(paths.os, "access", lambda place, mode: False)
    with pytest.raises(InputError, match="no permission to write in"):
        paths.require_place(tmp_path / "new" / "x", "a folder")


def test_permission_to_write_is_that_of_an_existing_path(tmp_path, monkeypatch):
    folder, file = tmp_path / "folder", tmp_path / "file"
    folder.mkdir()
    file.write_text("")
    locked = set()
    monkeypatch.setattr(paths.os, "access", lambda place, mode: place not in locked)

    def refuses(*given, **how):
        try:
            paths.require_place(*given, "allowed", **how)
        except InputError:
            return True
        return False

    for shut, refused in ((tmp_path, {"new", "file"}), (folder, {"folder"}), (file, {"over"})):
        locked = {shut}
        asked = {"new": refuses(tmp_path / "new"), "folder": refuses(folder), "file": refuses(file)}
        asked["over"] = refuses(file, in_place=True)
        assert {name for name, answer in asked.items() if answer} == refused


def test_an_existing_folder_is_written_from_within(tmp_path, monkeypatch):
    from stiction.report import files

    seen = []
    made = files.tempfile.TemporaryDirectory
    monkeypatch.setattr(files.tempfile, "TemporaryDirectory", lambda **how: seen.append(how["dir"]) or made(**how))
    for _ in range(2):
        files.write_folder(tmp_path / "out", {"a.txt": lambda path: path.write_text("a")})
    assert seen == [tmp_path.resolve(), tmp_path.resolve() / "out"]
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["a.txt"]


def test_models_of_a_sensitivity_have_names(tmp_path):
    (tmp_path / "case.toml").write_text("[indices]\ntheta = 40\nlam = 10\n[solve]\nload = [0.01]\n")
    for given in ("", ",", "none,none"):
        assert said("sensitivity", str(tmp_path / "case.toml"), "--models", given).startswith("stiction: model: '")
