"""Kill a sweep again and again, at random moments, then let it end: is the store that of one never interrupted, bit for bit?

    python benchmarks/kill_sweep.py [--kills 20] [--how alone workers cluster]

With SIGKILL. alone: the process that does all the work. workers: in turn that of three workers and one of these. cluster: in
turn a worker of a dask.distributed cluster and the process that asks it to work. All stores are compared with one that one
process made without an interruption. Prints what it found, and ends with 1 where a byte differs.
"""

import argparse
import filecmp
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path

CASE = """
[indices]
theta = {start = 10, stop = 200}
lam = {start = 1, stop = 1000, spacing = "log"}
[solve]
load = {start = 1e-4, stop = 0.1, count = 50, spacing = "log"}
[sweep]
sample = {method = "sobol", count = 65536, seed = 5}
keep = ["friction_coefficient", "contact_area", "mean_separation", "pull_off_force"]
block = 10000
"""
_COMMAND = [sys.executable, "-c", "from stiction.cli import main; main()", "sweep"]
_WORKERS = 3

# From a running sweep, a process to kill.
Victim = Callable[[subprocess.Popen], int]


def start(case: Path, out: Path, words: list[str]) -> subprocess.Popen:
    return subprocess.Popen(
        [*_COMMAND, str(case), "--out", str(out), *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )


def done(out: Path) -> int:
    return len(list((out / "validity_warnings_by_block" / "c").glob("*/*"))) if out.exists() else 0


def children(process: int) -> list[int]:
    """Processes that a process has begun, and those that they have, as Linux tells them."""
    found = []
    for task in Path(f"/proc/{process}/task").glob("*/children"):
        for child in map(int, task.read_text().split()):
            found += [child, *children(child)]
    return found


def itself(process: subprocess.Popen) -> int:
    return process.pid


def a_worker(process: subprocess.Popen) -> int:
    below = children(process.pid)
    return below[-1] if below else process.pid


@contextmanager
def cluster():
    """Words of a sweep by two workers of a cluster on this machine, and which of them to kill."""
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0") as made:
        pids = (nanny.pid for _ in iter(int, 1) for nanny in made.workers.values())
        yield ["--scheduler", made.scheduler_address], lambda process: next(pid for pid in pids if pid is not None)


@contextmanager
def of_this_machine(workers: int):
    yield ["--workers", str(workers)], a_worker if workers > 1 else itself


HOW = {"alone": lambda: of_this_machine(1), "workers": lambda: of_this_machine(_WORKERS), "cluster": cluster}


def killed(case: Path, out: Path, words: list[str], victims: list[Victim], kills: int, pause: float) -> int:
    """Sweep, killing so many times, of one victim after another, and then to the end; returns how often it came to that."""
    chance, process, times = random.Random(1), start(case, out, words), 0
    while times < kills and process.poll() != 0:
        before, number = done(out), times
        while number and process.poll() is None and done(out) == before:
            time.sleep(0.02)  # starting takes longer than the work between two kills
        time.sleep(chance.uniform(0.0, pause))
        if process.poll() is None:
            times += 1
            os.kill(victims[number % len(victims)](process), signal.SIGKILL)
            time.sleep(0.1)
        if process.poll() is not None and process.returncode != 0:
            process = start(case, out, words)
    if process.wait() != 0:
        assert start(case, out, words).wait() == 0
    return times


def same(one: Path, other: Path) -> bool:
    names = [sorted(str(file.relative_to(store)) for file in store.rglob("*") if file.is_file()) for store in (one, other)]
    return names[0] == names[1] and len(filecmp.cmpfiles(one, other, names[0], shallow=False)[0]) == len(names[0])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--pause", type=float, default=0.4, help="seconds at most from the first block done to a kill")
    parser.add_argument("--how", nargs="+", choices=list(HOW), default=list(HOW))
    given = parser.parse_args()
    good = True
    with tempfile.TemporaryDirectory() as folder:
        case, whole = Path(folder) / "case.toml", Path(folder) / "whole"
        case.write_text(CASE, encoding="utf-8")
        assert start(case, whole, []).wait() == 0
        print(f"never interrupted: {done(whole)} blocks", flush=True)
        for how in given.how:
            with HOW[how]() as (words, worker):
                victims = [worker] if worker is itself else [worker, itself]
                out = Path(folder) / how
                times = killed(case, out, words, victims, given.kills, given.pause)
                agrees = same(whole, out)
                good &= agrees
                files = sum(file.is_file() for file in out.rglob("*"))
                print(
                    f"{how}: {times} kills, {files} files: {'the same, bit for bit' if agrees else 'they differ'}", flush=True
                )
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
