"""A command says what it waits for: kernels are compiled once per installation, and only then is it said."""

import os
import subprocess
import sys

from stiction.engine.compiled import kernel
from stiction.engine.compiling import telling
from stiction.quantities.units import to_si


def test_compilation_is_told_and_the_cache_is_not(tmp_path, monkeypatch):
    """Once while it begins, and once when it is done; what comes from the cache is silent."""
    monkeypatch.setenv("STICTION_CACHE_DIR", str(tmp_path))

    def doubled(numbers):
        total = 0.0
        for number in numbers:
            total += 2.0 * number
        return total

    told: list[tuple[int, str]] = []
    with telling(lambda *one: told.append(one)):
        kernel(doubled)((1.0, 2.0))
    assert told == [(0, "doubled"), (1, "doubled")]
    assert any(tmp_path.rglob("*.nbi"))


def test_the_law_that_is_compiled_is_named(tmp_path):
    """It is that of the formulas in the loop, here Hertz's; in a process of its own, because others keep compiled loops."""
    ask = (
        "import numpy, stiction as st\nfrom stiction.engine.compiling import telling\n"
        "from stiction.engine.heights import gaussian\nfrom stiction.engine.summation import scattered\n"
        "from stiction.solving.choice import Choice\nfrom stiction.solving.problem import make_problem\n"
        "choice = Choice('greenwood_williamson_1966', asperity='hertz', tangential='none')\n"
        "regimes = make_problem(st.Indices(hardness_group=1.0), choice).regimes\n"
        "with telling(lambda done, name: print(name)):\n"
        "    scattered(regimes, numpy.zeros(1), gaussian())\n"
    )
    environment = os.environ | {"STICTION_CACHE_DIR": str(tmp_path), "STICTION_LOOPS": "shared"}
    told = subprocess.run([sys.executable, "-c", ask], env=environment, text=True, capture_output=True, check=True).stdout
    assert "hertz" in told.split()


def test_units_are_read_again_from_the_cache_and_anew_if_it_is_damaged(tmp_path):
    """A second process takes what the first kept; a damaged file is no error."""
    ask = "from stiction.quantities.units import to_si; print(to_si('5 um', 'thickness'), to_si('3 kgf', 'load'))"
    environment = os.environ | {"STICTION_CACHE_DIR": str(tmp_path)}

    def asked():
        return subprocess.run([sys.executable, "-c", ask], env=environment, text=True, capture_output=True, check=True).stdout

    first = asked()
    kept = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert kept and first.split() == [repr(to_si("5 um", "thickness")), repr(to_si("3 kgf", "load"))]
    assert asked() == first
    for path in kept:
        if path.suffix == ".pickle":
            path.write_bytes(b"\x80")
    assert asked() == first


def test_it_starts_as_a_module_too():
    run = subprocess.run([sys.executable, "-m", "stiction", "models", "--json"], capture_output=True, text=True, check=True)
    assert '"greenwood_williamson_1966"' in run.stdout


INTERRUPTED_WHILE_IMPORTING = """
import signal, sys

class Finder:
    def find_spec(name, path=None, target=None):
        if name == "typer":
            signal.raise_signal(signal.SIGINT)

signal.signal(signal.SIGINT, signal.default_int_handler)  # tests in the background of a shell inherit that it is ignored
sys.meta_path.insert(0, Finder)
from stiction.cli import main
main()
"""


def test_an_interruption_of_imports_is_one_line():
    done = subprocess.run([sys.executable, "-c", INTERRUPTED_WHILE_IMPORTING], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "stiction: interrupted\n")


def test_imported_by_somebody_else_it_leaves_interruptions_to_them():
    code = "import signal; {before}; one = signal.getsignal(2); import stiction.cli; assert signal.getsignal(2) is one"
    for before in ("pass", "signal.signal(2, signal.SIG_IGN)"):
        assert subprocess.run([sys.executable, "-c", code.format(before=before)], check=False).returncode == 0
