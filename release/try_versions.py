"""Runs tests with the smallest versions of what stiction rests on that pyproject.toml allows, or with the newest there are.

    python release/try_versions.py lowest            # the oldest Python that is supported
    python release/try_versions.py newest python3.13 # the newest Python at hand
    python release/try_versions.py lowest --tests tests/pinned tests/cli

Needs the tool uv on the path. Writes docs/how-to/installing.md. Warnings are no errors here: they
are of libraries among themselves.
"""

import argparse
import datetime
import os
import re
import sys
import tempfile
from pathlib import Path

import shared
from shared import ROOT, canonical, installed, must, name_of, outside, run

PINNED_WITHIN = "1e-11"  # of their size: linear algebra of other versions rounds otherwise
TESTS = ("tests/pinned", "tests/evaluate", "tests/cli", "tests/units", "tests/case", "tests/several", "tests/fit")
NEEDED = ("pytest", "pytest-xdist", "hypothesis", "mpmath")  # of the extra dev, what these tests need


def _requirements() -> list[str]:
    """What is installed: stiction with all extras, and what tests need."""
    tables = shared.project()["optional-dependencies"]
    return [f"stiction[all] @ {ROOT.as_uri()}", *(one for one in tables["dev"] if name_of(one) in NEEDED)]


def _environment(folder: Path, which: str, python: str) -> Path:
    """A new environment; solved by uv for the Python that is in it."""
    must("uv", "venv", "--quiet", "--python", python, folder / "environment")
    asked, solved = folder / "asked.txt", folder / "solved.txt"
    asked.write_text("\n".join(_requirements()), encoding="utf-8")
    resolution = "lowest-direct" if which == "lowest" else "highest"
    at = folder / "environment" / "bin" / "python"
    must("uv", "pip", "compile", "--quiet", "--python", at, "--resolution", resolution, "--output-file", solved, asked)
    must("uv", "pip", "install", "--quiet", "--python", at, "--requirement", solved)
    return at


def main() -> int:
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("which", choices=("lowest", "newest"))
    asked.add_argument("python", nargs="?", default="python3.11")
    asked.add_argument("--tests", nargs="+", default=TESTS)
    given = asked.parse_args()
    with tempfile.TemporaryDirectory(prefix="stiction-") as place:
        python = _environment(Path(place), given.which, given.python)
        # Not in the folder of the project: what is installed is what is tested.
        words = [
            python,
            "-m",
            "pytest",
            "-o",
            "filterwarnings=default",
            "-p",
            "no:cacheprovider",
            "-n",
            os.environ.get("WORKERS", "2"),
        ]
        done = run(*words, "--dist", "loadfile", *given.tests, cwd=ROOT, env=outside() | {"PINNED_WITHIN": PINNED_WITHIN})
        print(done.stdout[-4000:], done.stderr[-2000:])
        summary = re.findall(r"^=*\s*(?:\d+ \w+, )*\d+ passed.*?(?= in )", done.stdout, re.MULTILINE)
        versions = {canonical(one.name): one.version for one in installed(Path(place) / "environment")}
        number = must(python, "-c", "import platform; print(platform.python_version())").strip()
    if not done.returncode:
        _write(given.which, number, versions, f"{summary[-1].strip('= ')}, of {', '.join(given.tests)}")
    return done.returncode


def _write(which: str, python: str, versions: dict[str, str], summary: str) -> None:
    direct = [name_of(one) for one in shared.direct()]
    rows = [[f"`{name}`", versions[name]] for name in direct if name in versions]
    day = f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}"
    said = f"Tried on {day} with Python {python}: {summary}; pinned results within {PINNED_WITHIN}."
    shared.write_table(f"{which} versions", ["package", "version"], rows, said)


if __name__ == "__main__":
    sys.exit(main())
