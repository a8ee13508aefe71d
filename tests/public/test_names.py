"""The public names: listed once, imported when they are used, never hidden by a module."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import stiction as st

PACKAGE = Path(st.__file__).parent


def run(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], text=True, capture_output=True, check=True).stdout.strip()


def test_every_name_is_what_it_says():
    assert dir(st) == sorted(st.__all__)
    for name in st.__all__:
        value = getattr(st, name)
        assert value.__name__ == name and value.__doc__, name
    with pytest.raises(AttributeError, match="nothing"):
        _ = st.nothing


def test_import_loads_nothing_else():
    """`import stiction` loads neither its own modules nor those it rests on."""
    code = "import sys, stiction; print([m for m in ('numpy', 'numba', 'xarray', 'importlib.metadata') if m in sys.modules])"
    assert run(code) == "[]"
    assert run("import sys, stiction; print([m for m in sys.modules if m.startswith('stiction.')])") == "[]"


@pytest.mark.parametrize(
    "first",
    ["import stiction.solving.solve, stiction.studies.comparison.compare, stiction.solving.evaluate", "import stiction.cli"],
)
def test_no_module_takes_the_place_of_a_function(first):
    names = [name for name in st.__all__ if name[0].islower()]
    code = f"{first}\nimport stiction as st\nprint([name for name in {names} if not callable(getattr(st, name))])"
    assert run(code) == "[]"


def test_version_is_that_of_the_project():
    project = PACKAGE.parents[1] / "pyproject.toml"
    if not project.exists():
        pytest.skip("installed, not from a clone")
    assert st.__version__ == tomllib.loads(project.read_text(encoding="utf-8"))["project"]["version"]
