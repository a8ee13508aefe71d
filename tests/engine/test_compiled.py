"""Compiled kernels are kept under all that decides their code, and nothing that changes between processes: a second process
finds them, and whatever is edited, nobody is given a stale one. Tried on a plug-in outside the package."""

import ast
import contextlib
import io
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import stiction
from forking import Interpreter
from stiction.engine.compiled import digest, formula, kernel, lazy_kernel, loop
from stiction.quantities.cache import is_private, keep_file
from stiction.quantities.notices import Notice, notice

FORMULAS = '''
import math
import constants
from stiction.engine.compiled import formula

@formula
def inner(x):
    """Of no consequence."""
    return math.sin(x) + constants.SHIFT

@formula
def other(x):
    return 100.0 * x
'''
CONSTANTS = """
import numpy as np
SHIFT = 0.0
TABLE = np.zeros(2000)  # so long that its text leaves out the middle
STEPS = (1.0, 2.0)
"""
KERNELS = """
from constants import STEPS, TABLE
from formulas import inner, other
from stiction.engine.compiled import formula, kernel

def made_for(function, factor, count):
    @formula
    def scaled(x):
        return factor * function(x)

    @kernel
    def fill(x, out):
        for i in range(x.size):
            out[i] = scaled(x[i]) + TABLE[1000] + STEPS[0] + later(x[i]) + count

    return fill

@formula
def later(x):
    return 0.0

first, second = made_for(inner, 1.0, 0), made_for(other, 1.0, 0)
"""
RUN = """
import json
import sys
import numpy as np
import kernels
found = {}
for name in sys.argv[1:]:
    out = np.empty(3)
    compiled = getattr(kernels, name).compiled
    getattr(kernels, name)(np.array([0.0, 1.0, 2.0]), out)
    stats = compiled.stats
    found[name] = [out.tolist(), sum(stats.cache_hits.values()), sum(stats.cache_misses.values())]
print(json.dumps(found))
"""
X = np.array([0.0, 1.0, 2.0])


@pytest.fixture(scope="module")
def interpreter():
    warm = "import numba, numpy; numba.njit(lambda x: numpy.sin(x[0]))(numpy.ones(1))\n"  # tables that numba fills but once
    one = Interpreter("stiction.engine.compiled", before=warm, PYTHONDONTWRITEBYTECODE="1")
    yield one
    one.close()


def written(folder, interpreter):
    """A plug-in in a folder, and what runs its kernels in a process of their own: values, cache hits and misses of each."""
    for name, text in (("formulas", FORMULAS), ("constants", CONSTANTS), ("kernels", KERNELS)):
        (folder / f"{name}.py").write_text(text)

    def run(*names, said=None):
        done = interpreter.run(RUN, *names, folder=folder, STICTION_CACHE_DIR=str(folder / "cache"))
        assert done.returncode == 0, done.stderr
        if said is not None:
            said.append(done.stderr)
        return json.loads(done.stdout)

    return folder, run


@pytest.fixture
def plug_in(tmp_path, interpreter):
    return written(tmp_path, interpreter)


@pytest.fixture(scope="module")
def compiled_once(tmp_path_factory, interpreter):
    folder, run = written(tmp_path_factory.mktemp("compiled"), interpreter)
    assert run("first")["first"][1:] == [0, 1]
    return folder / "cache"


@pytest.fixture
def kept(plug_in, compiled_once):
    """A plug-in whose first kernel was compiled before."""
    folder, run = plug_in
    shutil.copytree(compiled_once, folder / "cache")
    assert run("first")["first"][1:] == [1, 0]
    return folder, run


def test_a_second_process_finds_every_kernel(plug_in):
    """Also one that was not forked, in which texts have other hashes."""
    folder, run = plug_in
    before = run("first", "second")
    settings = {**os.environ, "STICTION_CACHE_DIR": str(folder / "cache"), "PYTHONDONTWRITEBYTECODE": "1"}
    command = [sys.executable, "-c", RUN, "first", "second"]
    after = json.loads(subprocess.run(command, check=True, capture_output=True, text=True, env=settings, cwd=folder).stdout)
    for name, expected in (("first", np.sin(X) + 1.0), ("second", 100.0 * X + 1.0)):
        assert before[name][1:] == [0, 1] and after[name][1:] == [1, 0]
        np.testing.assert_allclose(before[name][0], expected, rtol=1e-15)
        assert before[name][0] == after[name][0]
    assert len(list((folder / "cache" / "kernels").glob("*.nbi"))) == 2


def test_kernels_of_one_factory_are_not_mixed_up(plug_in):
    """Compiled in processes of their own they have the same place and, but for what they close over, the same name."""
    _, run = plug_in
    run("first"), run("second")
    together = run("first", "second")
    assert [together[name][1:] for name in ("first", "second")] == [[1, 0], [1, 0]]
    np.testing.assert_allclose(together["first"][0], np.sin(X) + 1.0, rtol=1e-15)
    np.testing.assert_allclose(together["second"][0], 100.0 * X + 1.0, rtol=1e-15)


@pytest.mark.parametrize(
    "file, old, new, expected",
    [
        ("formulas", "math.sin(x)", "2.0 * math.sin(x)", 2.0 * np.sin(X) + 1.0),  # a formula in another file
        ("formulas", "math.sin", "math.cos", np.cos(X) + 1.0),  # the same instructions, another name
        ("constants", "SHIFT = 0.0", "SHIFT = 5.0", np.sin(X) + 6.0),  # a constant of a module of a module
        ("constants", "np.zeros(2000)", "np.where(np.arange(2000) == 1000, 7.0, 0.0)", np.sin(X) + 8.0),
        ("constants", "(1.0, 2.0)", "(3.0, 2.0)", np.sin(X) + 3.0),
        ("kernels", "made_for(inner, 1.0, 0)", "made_for(other, 1.0, 0)", 100.0 * X + 1.0),  # another formula in the closure
        ("kernels", "made_for(inner, 1.0, 0)", "made_for(inner, 3.0, 0)", 3.0 * np.sin(X) + 1.0),  # in that of a formula
        ("kernels", "made_for(inner, 1.0, 0)", "made_for(inner, 1.0, 4)", np.sin(X) + 5.0),  # another number in the closure
        ("kernels", "return 0.0", "return x", np.sin(X) + X + 1.0),  # a formula that stands below the kernel
    ],
)
def test_whatever_decides_a_kernel_compiles_it_anew(kept, file, old, new, expected):
    folder, run = kept
    path = folder / f"{file}.py"
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))
    values, hits, misses = run("first")["first"]
    assert (hits, misses) == (0, 1)
    np.testing.assert_allclose(values, expected, rtol=1e-15)


def test_what_decides_nothing_compiles_nothing(kept):
    """A docstring, a comment above, another formula of the same file."""
    folder, run = kept
    path = folder / "formulas.py"
    changed = path.read_text().replace("Of no consequence", "Still none").replace("100.0", "200.0")
    path.write_text("# a line more\n" + changed)
    assert run("first")["first"][1:] == [1, 0]


def test_a_formula_that_moved_to_another_module(kept):
    """The code is the same, and so is the file's name; what is in it asks for a module that is no more."""
    folder, run = kept
    (folder / "formulas.py").rename(folder / "elsewhere.py")
    (folder / "kernels.py").write_text(KERNELS.replace("from formulas", "from elsewhere"))
    np.testing.assert_allclose(run("first")["first"][0], np.sin(X) + 1.0, rtol=1e-15)


def test_a_folder_that_cannot_be_written_costs_only_time_and_is_said_once(plug_in):
    folder, run = plug_in
    (folder / "cache").write_text("a file where the folder should be")
    found = run("first", "second", said=(said := []))
    np.testing.assert_allclose(found["first"][0], np.sin(X) + 1.0, rtol=1e-15)
    assert said[0].count("takes no more files") == 1


@pytest.mark.parametrize(
    "damage", [lambda made: b"", lambda made: made[: len(made) // 2], lambda made: made[:-1] + bytes([made[-1] ^ 1])]
)
def test_a_damaged_file_is_made_anew(kept, damage):
    folder, run = kept
    (file,) = (folder / "cache" / "kernels").iterdir()
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    values, hits, misses = run("first")["first"]
    np.testing.assert_allclose(values, np.sin(X) + 1.0, rtol=1e-15)
    assert (hits, misses) == (0, 1)
    assert run("first")["first"][1:] == [1, 0]


@pytest.mark.skipif(os.name != "posix", reason="folders have owners and modes on POSIX systems")
@pytest.mark.parametrize("mode", [0o770, 0o702])
def test_kernels_are_not_loaded_from_a_folder_that_others_can_write(kept, mode):
    folder, run = kept
    kernels = folder / "cache" / "kernels"
    assert kernels.stat().st_mode & 0o777 == 0o700
    (file,) = kernels.iterdir()
    before = file.stat().st_mtime_ns
    kernels.chmod(mode)
    values, hits, misses = run("first", said=(said := []))["first"]
    np.testing.assert_allclose(values, np.sin(X) + 1.0, rtol=1e-15)
    assert (hits, misses) == (0, 1) and file.stat().st_mtime_ns == before
    assert said[0].count("is not used: it belongs to another user, or others can write to it") == 1
    kernels.chmod(0o700)
    assert run("first")["first"][1:] == [1, 0]


@pytest.mark.skipif(os.name != "posix", reason="folders have owners on POSIX systems")
def test_a_folder_of_another_user_is_not_private(tmp_path, monkeypatch):
    assert is_private(tmp_path) and is_private(tmp_path / "none")
    monkeypatch.setattr(os, "geteuid", lambda: tmp_path.stat().st_uid + 1)
    assert not is_private(tmp_path)


@pytest.mark.skipif(os.name != "posix", reason="folders have modes on POSIX systems")
@pytest.mark.parametrize(("mode", "private"), [(0o700, True), (0o755, True), (0o720, False), (0o702, False), (0o777, False)])
def test_a_folder_that_others_can_write_to_is_not_private(tmp_path, mode, private):
    tmp_path.chmod(mode)
    assert is_private(tmp_path) == private
    tmp_path.chmod(0o700)


def test_old_files_are_deleted_when_a_new_one_is_kept(tmp_path):
    """Those that nobody used for a quarter of a year, and the least recently used beyond the limit."""
    now = time.time()
    for days, name in ((100.0, "old"), (30.0, "used"), (2.0, "newer")):
        file = tmp_path / f"{name}.nbi"
        file.write_bytes(b"123")
        os.utime(file, (now - 86_400.0 * days,) * 2)
    keep_file(tmp_path / "new.nbi", lambda file: file.write(b"1234"), most=100)
    assert {file.stem for file in tmp_path.iterdir()} == {"used", "newer", "new"}
    keep_file(tmp_path / "last.nbi", lambda file: file.write(b"12"), most=9)
    assert {file.stem for file in tmp_path.iterdir()} == {"newer", "new", "last"}


def test_a_file_that_could_not_be_finished_is_not_left(tmp_path, monkeypatch):
    """As on a full disk."""

    def full(part, path):
        raise OSError(28, "No space left on device")

    monkeypatch.setenv("STICTION_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(Path, "replace", full)
    notice.cache_clear()

    @kernel
    def double(x):
        return 2.0 * x

    with pytest.warns(Notice, match="No space left on device"):
        assert double(3.0) == 6.0
    assert list(tmp_path.rglob("*.*")) == []


def test_a_formula_becomes_part_of_kernels_and_stays_plain_python(tmp_path, monkeypatch):
    """The machine code of a kernel calls none of them, or loops would not be vectorised."""
    monkeypatch.setenv("STICTION_CACHE_DIR", str(tmp_path))

    @formula
    def half(x):
        return 0.5 * x

    @loop
    def total(values):
        result = 0.0
        for value in values:
            result += half(value)
        return result

    @kernel
    def fill(values, out):
        out[0] = total(values)

    values, out = np.array([1.0, 2.0, 4.0]), np.zeros(1)
    fill(values, out)
    assert out[0] == 3.5
    (made,) = fill.compiled.inspect_llvm().values()
    called = [line for line in made.splitlines() if " call " in line and "@" in line]
    assert "fill" in made and not [line for line in called if "half" in line or "total" in line]
    assert half(3.0) == 1.5 and total(values) == 3.5
    np.testing.assert_array_equal(half(values), [0.5, 1.0, 2.0])


def test_one_file_alone_uses_what_numba_does_not_promise():
    promised = {"numba"} | {f"numba.extending.{name}" for name in ("register_jitable", "overload", "typeof_impl")}
    used = {}
    for file in Path(stiction.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text())):
            modules = [one.name for one in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom):
                modules = [f"{node.module}.{one.name}" for one in node.names]
            private = {one for one in modules if one.partition(".")[0] == "numba"} - promised
            if private:
                used[file.name] = private
    assert used.keys() == {"numba_internals.py"}


def halves():
    @lazy_kernel(worth=6)
    def halve(values, out):
        for i in range(values.size):
            out[i] = 1.0 / values[i]

    return halve


def test_a_lazy_kernel_is_compiled_when_its_work_pays(force_loops):
    force_loops(None)
    halve, values, out = halves(), np.array([2.0, 4.0, 8.0]), np.empty(3)
    for compiled in (0, 0, 1):
        halve(values, out)
        assert len(halve.compiled.signatures) == compiled
        assert out.tolist() == [0.5, 0.25, 0.125]


def test_what_the_interpreter_refuses_is_compiled(force_loops):
    force_loops(None)
    halve, out = halves(), np.empty(2)
    halve(np.array([0.0, -4.0]), out)
    assert halve.compiled.signatures and out.tolist() == [np.inf, -0.25]


def test_a_lazy_kernel_can_be_forced_either_way(force_loops):
    for tier, compiled in (("interpreted", 0), ("shared", 1), ("specialised", 1)):
        force_loops(tier)
        halve, out = halves(), np.empty(20)
        halve(np.full(20, 2.0), out)
        assert len(halve.compiled.signatures) == compiled and (out == 0.5).all()


WITHOUT_COMPILER = """
import numpy as np
import stiction as st
groups = st.Indices(theta=40, lam=10, n_E=1.5, n_H=0.5, tau=2)
halling = {"model": "greenwood_williamson_1966", "film": "halling_1979"}  # divides by the contact radius, also where it is 0
for chosen, film in ((groups, {}), (groups.replace(film_aspect=0.5, shear_strength=0.1), halling)):
    whole = st.solve(chosen, separation=[1.0], **film)
    print(*(float(whole[name].item()) for name in ("load", "contact_area", "friction_force")))
"""


def test_models_without_the_compiler():
    """NUMBA_DISABLE_JIT, for those who step through formulas: the same numbers as here."""
    found = np.array(
        [*printed_here(WITHOUT_COMPILER), *printed_elsewhere(WITHOUT_COMPILER, NUMBA_DISABLE_JIT="1")], dtype=float
    )
    assert found.size == 12
    np.testing.assert_allclose(found[:6], found[6:], rtol=1e-12)


def printed_elsewhere(code, **environment):
    """The words that the code prints in a process of its own."""
    told = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True, env=os.environ | environment
    )
    return told.stdout.split()


def printed_here(code):
    """The words that the code prints in this process."""
    with contextlib.redirect_stdout(io.StringIO()) as told:
        exec(code, {})
    return told.getvalue().split()


def outer(factor):
    """A function that calls another, in which the factor stands."""
    names = {}
    exec(f"def inner(x):\n    return {factor} * x\ndef outer(x):\n    return inner(x)", names)
    return names["outer"]


def calling(rule):
    return lambda x: rule(x)


def test_a_formula_named_by_a_formula_decides():
    assert digest(outer(2)) == digest(outer(2))
    assert digest(outer(2)) != digest(outer(3))


def test_what_is_closed_over_decides():
    assert digest(calling(outer(2))) == digest(calling(outer(2)))
    assert digest(calling(outer(2))) != digest(calling(outer(3)))


DIGESTS = """
from stiction.laws.asperity.roy_chowdhury_ghosh_1994 import plastic
from stiction.laws.segment import displaced
from stiction.engine.compiled import digest, formula, kernel, loop
from stiction.quantities.cache import is_private
from stiction.quantities.notices import Notice, notice
from stiction.laws.tangential.shared.slip_or_yield import _fill_kinks
from stiction.laws.tangential.soft_coating_2015 import resistance
from stiction.engine.heights import gaussian
from stiction.engine.nodes import evaluating
from stiction.laws.joining import _joined
from stiction.engine.sum_kernels import scattering
heights = gaussian()
along, coordinate = _joined(plastic, displaced, resistance, False, 2, 5)
scatter = scattering(along, coordinate, heights.density, heights.window, 12)
print(digest(_fill_kinks), digest(scatter), digest(evaluating(along, 12)))
"""


def test_digests_are_the_same_in_every_process():
    """An address in one would make every process compile anew."""
    found = printed_elsewhere(DIGESTS)
    assert found == printed_here(DIGESTS) and len(set(found)) == 3
