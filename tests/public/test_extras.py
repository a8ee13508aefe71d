"""What only part of the work needs is an extra: the rest works without it, and one line says what to install."""

import importlib.util
import re
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

import stiction as st
from forking import Interpreter
from stiction.quantities.extras import EXTRA_OF, how_to_install, require

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
CASE, BARE = (ROOT / "examples" / f"{name}.toml" for name in ("silver_on_steel", "compare_models"))
# Runs before all imports: `import` and `find_spec` see no package of an extra.
HIDDEN = f"""
import sys
for name in {sorted(EXTRA_OF)}:
    sys.modules[name] = None
"""


@pytest.fixture(scope="module")
def interpreter():
    before = f"{HIDDEN}from stiction.quantities.extras import leave_out; leave_out('dask')\n"  # as the command does first
    one = Interpreter("stiction.cli", "stiction.studies.case_results", "numba", before=before, COLUMNS="200")
    yield one
    one.close()


@pytest.fixture
def without_extras(interpreter, tmp_path):
    """The command as it is in an installation without extras: its exit code, and what it wrote on both streams."""

    def run(*words):
        done = interpreter.run("from stiction.cli import main; main()", *words, folder=tmp_path)
        return done.returncode, done.stdout, done.stderr.strip()

    return run


def name_of(requirement):
    return re.match(r"[\w.-]+", requirement)[0].lower()


def test_each_package_is_brought_by_the_extra_that_is_named():
    extras = PROJECT["optional-dependencies"]
    for package, extra in EXTRA_OF.items():
        assert package.lower() in map(name_of, extras[extra]), package
        assert package.lower() not in map(name_of, PROJECT["dependencies"]), package
    named = set(re.search(r"\[(.*)\]", extras["all"][0])[1].split(","))
    assert named | {"sweep"} == set(EXTRA_OF.values())  # that of the sweep comes with that of the cluster


def test_a_missing_package_is_said_in_a_line(monkeypatch):
    require("sweep", "zarr")
    monkeypatch.setitem(sys.modules, "zarr", None)
    with pytest.raises(st.InputError) as told:
        require("sweep", "numpy", "zarr")
    assert str(told.value) == "sweep: zarr is not installed; not supported without it: pip install 'stiction[sweep]'"


def test_a_case_is_solved_and_written_without_extras(without_extras, tmp_path):
    """All but the picture, which is named, with what to install."""
    code, out, error = without_extras("run", CASE, "--out", "results")
    assert code == 0 and "written to results: curve.csv, curve.nc\n" in out
    assert error == f"stiction: not drawn without matplotlib: curve.png, regimes.png; {how_to_install('matplotlib')}"
    assert sorted(path.name for path in (tmp_path / "results").iterdir()) == ["curve.csv", "curve.nc"]


SCAN = """
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
work_of_adhesion = "0.2 J/m^2"
nominal_area = "1 mm^2"
roughness = { first = { file = "scan.npy", size = "40 um", unit = "m" } }

[solve]
load = ["0.1 N"]
"""


@pytest.mark.parametrize(
    ("words", "pictures"),
    [
        (("compare", BARE), "compare.png"),
        (("slide", BARE, "--model", "greenwood_williamson_1966"), "sliding.png"),
        (("film", CASE), "film.png"),
        (("surface", "scan.npy", "--size", "40 um", "--unit", "m"), "map.png, spectrum.png, asperities.png, fan.png"),
        (("run", "scan.toml"), "curve.png, regimes.png"),
        (("run", "scan.toml", "--model", "soft_coating_2015"), "curve.png, regimes.png, band.png"),
    ],
)
def test_commands_write_all_but_pictures(without_extras, tmp_path, words, pictures):
    made = st.gaussian_surface(
        (64, 64), (40e-6, 40e-6), st.SelfAffine(hurst=0.8, rolloff=10e-6, shortest=4e-6, deviation=8e-9), seed=1
    )
    np.save(tmp_path / "scan.npy", made.heights)
    (tmp_path / "scan.toml").write_text(SCAN, encoding="utf-8")
    code, _, error = without_extras(*words, "--out", "results")
    assert (code, error.splitlines()[-1]) == (
        0,
        f"stiction: not drawn without matplotlib: {pictures}; {how_to_install('matplotlib')}",
    )
    written = [path.suffix for path in (tmp_path / "results").iterdir()]
    assert written and ".png" not in written


@pytest.mark.parametrize(
    ("words", "package"),
    [
        (("report", CASE, "--out", "report.html"), "matplotlib"),
        (("figures", "--out", "figures"), "matplotlib"),
        (("serve",), "nicegui"),
        (("sweep", CASE, "--out", "store"), "zarr"),
        (("sweep", CASE, "--out", "store", "--scheduler", "tcp://127.0.0.1:8786"), "distributed"),
        (("surface", "scan.sur"), "SurfaceTopography"),
    ],
)
def test_commands_of_an_extra_say_what_to_install(without_extras, tmp_path, words, package):
    """Exit code 2 and one line, no traceback, and nothing is left behind."""
    (tmp_path / "scan.sur").write_bytes(b"DIGITAL SURF")
    (tmp_path / "measured.csv").write_text("load [N],friction_coefficient\n1,0.1\n", encoding="utf-8")
    before = sorted(tmp_path.iterdir())
    code, out, error = without_extras(*words)
    said = [line for line in error.splitlines() if line != "Reading the case"]
    assert (code, out, len(said)) == (2, "", 1)
    assert said[0].startswith("stiction: ") and said[0].endswith(how_to_install(package))
    assert [path for path in sorted(tmp_path.iterdir()) if path not in before] == []


def test_no_public_name_needs_an_extra_to_be_imported(interpreter, tmp_path):
    code = "import stiction as st\nprint([name for name in st.__all__ if not hasattr(st, name)])"
    assert interpreter.run(code, folder=tmp_path).stdout.strip() == "[]"


def test_extras_can_be_found_here():
    """The tests of what they bring run where they are installed: all of them are, with the extra dev."""
    assert [package for package in EXTRA_OF if importlib.util.find_spec(package) is None] == []
