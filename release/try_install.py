"""Installs the wheel into empty environments, without extras and with each of them, and works there as a user does.

    make try-install                                 # all of it, five minutes; what weighs is written into docs/installing.md
    python release/try_install.py none web           # these alone; nothing is written

Each environment solves the demo out of an empty folder, far from the source. Of each extra that it has the work is done; of
each that it has not the command must end with exit code 2 and one line that says what to install.
"""

import datetime
import platform
import resource
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from dataclasses import dataclass
from pathlib import Path

import shared
from shared import ROOT, installed, must, outside, run, weight

MB = 1e6
CASE = ROOT / "examples" / "silver_on_steel.toml"
SWEEP = '\n[sweep]\nsample = { method = "grid" }\n'
FIT = '\n[fit.free]\nwork_of_adhesion = { low = "0.1 J/m^2", high = "10 J/m^2" }\n'
MEASURED = "load [N],friction_coefficient\n0.1,0.09\n1,0.06\n10,0.03\n"
TO_LIBRARY = "import stiction as st; s = st.SelfAffine(hurst=0.8, rolloff=1e-5, shortest=4e-6, deviation=8e-9); "
TO_LIBRARY += "st.gaussian_surface((32, 32), (4e-5, 4e-5), s, seed=1).to_topography()"
# Extra -> what it is for, done in the folder of `_prepare`; `serve` and the cluster are tried in a way of their own.
WORK = {
    "pictures": ("-m", "stiction", "report", "case.toml", "--out", "report.html"),
    "scans": ("-c", TO_LIBRARY),
    "sweep": ("-m", "stiction", "sweep", "sweep.toml", "--out", "store"),
    "fit": ("-m", "stiction", "fit", "fit.toml", "--data", "measured.csv"),
    "cluster": ("-m", "stiction", "sweep", "sweep.toml", "--out", "other", "--scheduler", "tcp://127.0.0.1:1"),
    "web": ("-m", "stiction", "serve", "case.toml", "--port"),
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


def _processor() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _environment(folder: Path, extra: str) -> tuple[Path, float]:
    """A new environment with the wheel; the seconds of processor that pip took."""
    must(sys.executable, "-m", "venv", folder)
    began = _processor()
    what = str(shared.wheel()) + ("" if extra == "none" else f"[{extra}]")
    must(folder / "bin" / "python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check", what, env=outside())
    return folder / "bin" / "python", _processor() - began


def _demo(python: Path, folder: Path, drawn: bool) -> None:
    where = Path(must(python, "-c", "import stiction; print(stiction.__file__)", cwd=folder, env=outside()).strip())
    assert ROOT not in where.parents, where
    must(python, "-m", "stiction", "run", "case.toml", "--out", "demo", cwd=folder, env=outside())
    names = sorted(path.name for path in (folder / "demo").iterdir())
    assert names == ["curve.csv", "curve.nc", *(["curve.png"] if drawn else [])], names


def _served(python: Path, folder: Path) -> None:
    """The page answers within half a minute."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    server = subprocess.Popen([python, *WORK["web"], str(port)], cwd=folder, env=outside(), stdout=subprocess.DEVNULL)
    try:
        for _ in range(60):
            time.sleep(0.5)
            try:
                with urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=30) as answer:
                    assert answer.status == 200
                    return
            except OSError:
                assert server.poll() is None, "the server ended"
        raise AssertionError("the page does not answer")
    finally:
        server.terminate()
        server.wait()


def _extras_of(extra: str) -> set[str]:
    """The extras that come with one."""
    tables = shared.project()["optional-dependencies"]
    nested = [part.partition("[")[2].rstrip("]").split(",") for part in tables.get(extra, []) if part.startswith("stiction[")]
    return {extra} | {deeper for group in nested for one in group for deeper in _extras_of(one)}


def _worked(python: Path, folder: Path, there: set[str]) -> None:
    """Of each extra the work, or the one line."""
    for extra, words in WORK.items():
        if extra in there and extra == "web":
            _served(python, folder)
            continue
        done = run(python, *words, *(["8080"] if extra == "web" else []), cwd=folder, env=outside())
        last = done.stderr.strip().splitlines()[-1:] or [""]
        if extra == "cluster" and extra in there:  # nobody listens at that address: it says so
            assert done.returncode == 2 and "--scheduler" in last[0], done.stderr
        elif extra in there:
            assert done.returncode == 0, done.stderr
        else:
            assert f"pip install 'stiction[{extra}]'" in last[0], done.stderr
            assert words[0] == "-c" or (done.returncode == 2 and "Traceback" not in done.stderr), done.stderr


def tried(extra: str) -> Tried:
    """An environment with one extra, or "none", in which everything was done that can be."""
    with tempfile.TemporaryDirectory(prefix="stiction-") as place:
        home = Path(place)
        work = home / "work"
        work.mkdir()
        _prepare(work)
        python, seconds = _environment(home / "environment", extra)
        there = _extras_of(extra)
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
        "weights", ["package", "MB"], rows, f"Measured on {when}, with what Python compiles when it is installed."
    )
    rows = [
        [f"`{one.extra}`" if one is not base else "no extra", len(one.weights), f"{one.total / MB:.0f}", f"{one.seconds:.0f}"]
        for one in found
    ]
    heads = ["installed with", "packages", "MB", "seconds of processor of pip"]
    shared.write_table(
        "extras",
        heads,
        rows,
        f"Tried on {when}: in each the demo was solved out of an empty folder, and the work of the extra done.",
    )


def main(asked: list[str]) -> None:
    known = ["none", *(extra for extra in shared.project()["optional-dependencies"] if extra not in ("docs", "dev"))]
    if unknown := set(asked) - set(known):
        sys.exit(f"{', '.join(sorted(unknown))}: one of {', '.join(known)}")
    found = []
    for extra in asked or known:
        found.append(tried(extra))
        print(f"{extra:9} {found[-1].total / MB:5.0f} MB {found[-1].seconds:5.0f} s", flush=True)
    if not asked:
        _written(found)


if __name__ == "__main__":
    assert shutil.disk_usage(tempfile.gettempdir()).free > 3e9, "an environment needs a gigabyte of room"
    main(sys.argv[1:])
