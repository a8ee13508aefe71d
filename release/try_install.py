"""Install the wheel into empty environments, without extras and with each of them, and work there as a user does.

    make try-install                                 # ten minutes; writes its tables into docs/how-to/installing.md
    python release/try_install.py none web           # these alone, or "each"; nothing is written

In each environment the demo is solved in an empty folder away from the source, and each installed extra is used. A command that
that needs another extra must exit with code 2 and print one line that states what to install.
"""

import datetime
import platform
import re
import resource
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import shared
from shared import ROOT, installed, must, outside, run, weight

MB = 1e6
CASE = ROOT / "examples" / "silver_on_steel.toml"
SWEEP = '\n[sweep]\nsample = { method = "grid" }\n'
FIT = '\n[fit.free]\nwork_of_adhesion = { low = "0.1 J/m^2", high = "10 J/m^2" }\n'
MEASURED = "load [N],friction_coefficient\n0.1,0.09\n1,0.06\n10,0.03\n"
# A scheduler with one worker, until its input ends.
CLUSTER = """import sys, distributed
where = {"host": "127.0.0.1", "protocol": "tcp", "dashboard_address": None}
cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=False, **where)
print(cluster.scheduler_address, flush=True)
sys.stdin.read()"""
# Extra -> the command that needs it; the cluster and the page are given an address and a port as last word.
WORK = {
    "pictures": ("report", "case.toml", "--out", "report.html"),
    "scans": ("surface", "scan.sdf"),
    "sweep": ("sweep", "sweep.toml", "--out", "store"),
    "fit": ("fit", "fit.toml", "--data", "measured.csv"),
    "cluster": ("sweep", "sweep.toml", "--out", "other", "--scheduler"),
    "web": ("serve", "case.toml", "--port"),
}


@dataclass(frozen=True)
class Tried:
    """What an environment is: the extra asked for, what each distribution weighs, seconds of processor to install it."""

    extra: str
    weights: dict[str, int]
    seconds: float

    @property
    def total(self) -> int:
        return sum(self.weights.values())


def _prepare(folder: Path) -> None:
    text = CASE.read_text(encoding="utf-8")
    several = text.replace('"1 J/m^2"', '["0.5 J/m^2", "1 J/m^2"]')
    files = {"case.toml": text, "sweep.toml": several + SWEEP, "fit.toml": text + FIT, "measured.csv": MEASURED}
    for name, content in files.items():
        (folder / name).write_text(content, encoding="utf-8")
    sys.path.append(str(ROOT / "tests" / "surfaces"))
    from written_files import sdf_text

    (folder / "scan.sdf").write_bytes(sdf_text())


def _processor() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _environment(folder: Path, extra: str) -> tuple[Path, float]:
    """A new environment with the wheel; the seconds of processor that this took."""
    must(sys.executable, "-m", "venv", folder)
    began = _processor()
    what = str(shared.wheel()) + ("" if extra == "none" else f"[{extra}]")
    python = folder / "bin" / "python"
    must(python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", what, env=outside())
    return python, _processor() - began


def _demo(python: Path, folder: Path, drawn: bool) -> None:
    where = Path(must(python, "-c", "import stiction; print(stiction.__file__)", cwd=folder, env=outside()).strip())
    assert ROOT not in where.parents, where
    must(python, "-m", "stiction", "run", "case.toml", "--out", "demo", cwd=folder, env=outside())
    names = sorted(path.name for path in (folder / "demo").iterdir())
    assert names == ["curve.csv", "curve.nc", *(["curve.png"] if drawn else [])], names


def _plain(python: Path, folder: Path, words: tuple[str, ...]) -> None:
    must(python, "-m", "stiction", *words, cwd=folder, env=outside())


def _shared_out(python: Path, folder: Path, words: tuple[str, ...]) -> None:
    """A cluster of one worker computes every point of the sweep."""
    where = {"cwd": folder, "env": outside(), "text": True}
    with subprocess.Popen([python, "-c", CLUSTER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, **where) as cluster:
        assert cluster.stdin and cluster.stdout
        try:
            said = must(python, "-m", "stiction", *words, cluster.stdout.readline().strip(), cwd=folder, env=outside())
        finally:
            cluster.stdin.close()
    assert re.match(r"(\d+) points, \1 of them computed now", said), said


def _served(python: Path, folder: Path, words: tuple[str, ...]) -> None:
    """The page answers within half a minute, with the curve on it."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    words = ("-m", "stiction", *words, str(port))
    server = subprocess.Popen([python, *words], cwd=folder, env=outside(), stdout=subprocess.DEVNULL)
    try:
        for _ in range(60):
            time.sleep(0.5)
            try:
                with urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=30) as answer:
                    assert "friction coefficient mu against" in answer.read().decode()
                    return
            except OSError:
                assert server.poll() is None, "the server ended"
        raise AssertionError("the page does not answer")
    finally:
        server.terminate()
        server.wait()


# The extras whose work is more than a command that ends well.
DONE: dict[str, Callable[[Path, Path, tuple[str, ...]], None]] = {"cluster": _shared_out, "web": _served}


def _there(environment: Path) -> set[str]:
    """The extras whose packages are there, also where another asked for them: SurfaceTopography brings matplotlib."""
    names = {shared.canonical(one.name) for one in installed(environment)}
    own = {extra: [shared.name_of(part) for part in parts] for extra, parts in shared.extras().items()}
    return {extra for extra in WORK if {name for name in own[extra] if name != "stiction"} <= names}


def _refused(python: Path, folder: Path, extra: str) -> None:
    """Without an extra: one line with what to install, exit code 2."""
    last = {"cluster": ("tcp://127.0.0.1:1",), "web": ("8080",)}.get(extra, ())
    done = run(python, "-m", "stiction", *WORK[extra], *last, cwd=folder, env=outside())
    told = done.stderr.strip().splitlines()[-1:] or [""]
    assert done.returncode == 2 and f"pip install 'stiction[{extra}]'" in told[0], done.stderr
    assert "Traceback" not in done.stderr, done.stderr


def _worked(python: Path, folder: Path, there: set[str]) -> None:
    """Of each extra the work, or the one line."""
    for extra, words in WORK.items():
        if extra in there:
            DONE.get(extra, _plain)(python, folder, words)
        else:
            _refused(python, folder, extra)


def tried(extra: str) -> Tried:
    """An environment with one extra, or "none", in which everything was done that can be."""
    with tempfile.TemporaryDirectory(prefix="stiction-") as place:
        home = Path(place)
        work = home / "work"
        work.mkdir()
        _prepare(work)
        python, seconds = _environment(home / "environment", extra)
        there = _there(home / "environment")
        assert extra in {*there, "none", "all"}, there
        _demo(python, work, drawn="pictures" in there)
        _worked(python, work, there)
        return Tried(extra, {one.name: weight(one) for one in installed(home / "environment")}, seconds)


def _written(found: list[Tried]) -> None:
    base = found[0]
    on = f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}, Python {platform.python_version()}"
    when = f"{on}, {platform.system()} {platform.machine()}"
    light = [name for name, size in base.weights.items() if size < 2.5 * MB]
    rows = [
        [name, f"{size / MB:.0f}"] for name, size in sorted(base.weights.items(), key=lambda row: -row[1]) if name not in light
    ]
    rest = sum(base.weights[name] for name in light)
    rows += [[f"{len(light)} others", f"{rest / MB:.0f}"], ["**all**", f"**{base.total / MB:.0f}**"]]
    shared.write_table(
        "weights", ["package", "MB"], rows, f"Measured on {when}, including the bytecode that Python compiles at installation."
    )
    rows = [
        [f"`{one.extra}`" if one is not base else "no extra", len(one.weights), f"{one.total / MB:.0f}", f"{one.seconds:.0f}"]
        for one in found
    ]
    said = f"""Tried on {when}, installed by pip: in each environment the demo was solved in an empty
folder and the installed extras were used (a report, a scan in an instrument format, a sweep, a sweep on a cluster, a fit, the
page). Commands that need a missing extra printed one line that states what to install."""
    shared.write_table("extras", ["installed with", "packages", "MB", "seconds of processor"], rows, said)


def main(asked: list[str]) -> None:
    known = ["none", *shared.extras()]
    if unknown := set(asked) - {*known, "each"}:
        sys.exit(f"{', '.join(sorted(unknown))}: one of {', '.join(known)}, or each")
    found = []
    for extra in known if not asked or "each" in asked else asked:
        found.append(tried(extra))
        print(f"{extra:9} {found[-1].total / MB:5.0f} MB {found[-1].seconds:5.0f} s", flush=True)
    if not asked:
        _written(found)


if __name__ == "__main__":
    assert shutil.disk_usage(tempfile.gettempdir()).free > 3e9, "an environment needs a gigabyte of room"
    main(sys.argv[1:])
