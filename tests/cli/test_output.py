"""What is printed reaches its reader, whatever that can show, and where it cannot be written one line says so."""

import io
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from stiction.cli.output import print_json
from stiction.report.files import write_folder

SILVER = str(Path(__file__).parents[2] / "examples" / "silver_on_steel.toml")
MAIN = "from stiction.cli import main; main()"
# Of the files that are written none may be longer than this, as on a disk that is full.
SHORT_FILES = f"import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (20480, 20480)); {MAIN}"
FULL = Path("/dev/full")


def program(*words, code=MAIN, **settings):
    """What runs the command in a process of its own."""
    return {"args": [sys.executable, "-c", code, *words], "env": {**os.environ, **settings}}


def one_line(text):
    assert text.startswith("stiction: ") and text.count("\n") == 1, text
    return text


def test_what_stands_for_characters_that_an_encoding_has_not():
    assert "30370 µm² at −4 · 10⁹, é, 水".encode("ascii", "stiction") == b"30370 um^2 at -4 * 10^9, e, ?"
    assert "30370 µm²".encode("latin-1", "stiction").decode("latin-1") == "30370 µm²"


def test_a_table_in_ascii():
    done = subprocess.run(**program("run", SILVER, PYTHONIOENCODING="ascii"), capture_output=True)
    assert (done.returncode, done.stderr) == (0, b"")
    assert b"um^2" in done.stdout and done.stdout.isascii()


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_json_loses_nothing(monkeypatch, encoding):
    content = {"title": "Öl, 30 µm² − 水"}
    printed = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    monkeypatch.setattr(sys, "stdout", printed)
    print_json(content)
    printed.flush()
    assert json.loads(printed.buffer.getvalue().decode(encoding)) == content


@pytest.mark.skipif(not FULL.exists(), reason="no such device here")
@pytest.mark.parametrize("words", [("--version",), ("schema",)])
def test_a_full_disk_is_one_line(words):
    with FULL.open("w") as full:
        done = subprocess.run(**program(*words), stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 1
    assert "No space left" in one_line(done.stderr)


@pytest.mark.skipif(sys.platform == "win32", reason="pipes break otherwise there")
@pytest.mark.parametrize("words", [("schema",), ("models",)])
def test_a_closed_pipe_is_one_line(words):
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(**program(*words), stdout=writer, stderr=subprocess.PIPE, text=True)
    os.close(writer)
    assert done.returncode == 1
    assert "Broken pipe" in one_line(done.stderr)


@pytest.mark.skipif(sys.platform == "win32", reason="no such limit there")
def test_files_that_cannot_be_finished_are_one_line_and_nothing_is_left(tmp_path):
    command = program("run", SILVER, "--out", str(tmp_path / "out"), code=SHORT_FILES)
    done = subprocess.run(**command, capture_output=True, text=True)
    assert done.returncode == 2
    assert "File too large" in one_line(done.stderr)
    assert list(tmp_path.iterdir()) == []


def test_what_a_killed_program_left_is_removed_and_nothing_else(tmp_path):
    long_ago = time.time() - 3600.0
    for name in (".out-ab12cd_4", ".out-now00000", ".out-mine0000", ".out-backup", ".other-ab12cd_4"):
        (tmp_path / name / "files").mkdir(parents=True)
        (tmp_path / name / "files" / "curve.csv").write_text("half")
        if name == ".out-mine0000":
            (tmp_path / name / "notes.txt").write_text("mine")
        for one in [*(tmp_path / name).rglob("*"), tmp_path / name]:
            if name != ".out-now00000":
                os.utime(one, (long_ago, long_ago))
    write_folder(tmp_path / "out", {"a.txt": lambda path: path.write_text("a")})
    left = sorted(one.name for one in tmp_path.iterdir())
    assert left == [".other-ab12cd_4", ".out-backup", ".out-mine0000", ".out-now00000", "out"]
