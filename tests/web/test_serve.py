"""`stiction serve` as a command: what it refuses, what it says, and that no other command pays for it."""

import socket
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from stiction.cli import app
from stiction.quantities.errors import InputError
from stiction.web import server


@pytest.fixture
def served(monkeypatch):
    """What would be served, and where; nothing is."""
    asked = []
    monkeypatch.setattr("stiction.web.server.serve", lambda *arguments: asked.append(arguments))
    return asked


def test_this_machine_alone_unless_told_otherwise(served):
    result = CliRunner().invoke(app, ["serve", "--port", "0"])
    assert result.exit_code == 2
    result = CliRunner().invoke(app, ["serve", "--port", str(_free())])
    assert result.exit_code == 0 and served[-1][1] == "127.0.0.1" and "everybody" not in result.stderr
    result = CliRunner().invoke(app, ["serve", "--port", str(_free()), "--host", "0.0.0.0"])
    assert result.exit_code == 0 and served[-1][1] == "0.0.0.0" and "open to other machines" in result.stderr


def test_a_port_that_is_taken_is_told(served):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        result = CliRunner().invoke(app, ["serve", "--port", str(taken.getsockname()[1])])
    assert result.exit_code == 2 and "--port" in result.stderr and not served


def test_a_case_that_is_wrong_is_told_before_anything_is_served(served, tmp_path):
    case = tmp_path / "case.toml"
    case.write_text("[contact]\nfirst = 3\n", encoding="utf-8")
    result = CliRunner().invoke(app, ["serve", str(case), "--port", str(_free())])
    assert result.exit_code == 2 and len(result.stderr.strip().splitlines()) == 1 and not served


def test_files_beside_a_case_that_is_served_may_be_named(tmp_path):
    (tmp_path / "case.toml").write_text('materials = "absent.toml"\n[solve]\nload = ["1 N"]\n', encoding="utf-8")
    with pytest.raises(InputError, match=r"absent\.toml"):
        server.query_of(tmp_path / "case.toml")


def test_no_other_command_imports_the_server():
    code = "import stiction.cli, stiction.cli.run, sys; print([name for name in sys.modules if 'nicegui' in name])"
    assert subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.strip() == "[]"


def _free() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]
