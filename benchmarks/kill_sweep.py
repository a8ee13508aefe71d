"""Kill a sweep again and again, at random moments, then let it end: is the store that of one never interrupted, bit for bit?

    python benchmarks/kill_sweep.py [KILLS] [WORKERS]

Kills the process with SIGKILL; with more than one worker, every second time a worker of it instead. Prints what it found, and
ends with 1 where a byte differs.
"""

import filecmp
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
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
block = 40000
"""
_COMMAND = [sys.executable, "-c", "from stiction.cli import main; main()", "sweep"]


def start(case: Path, out: Path, workers: int) -> subprocess.Popen:
    words = [*_COMMAND, str(case), "--out", str(out), "--workers", str(workers)]
    return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def done(out: Path) -> int:
    return len(list((out / "doubts_by_block" / "c").glob("*/*"))) if out.exists() else 0


def children(process: int) -> list[int]:
    """Processes that a process has begun, and those that they have, as Linux tells them."""
    found = []
    for task in Path(f"/proc/{process}/task").glob("*/children"):
        for child in map(int, task.read_text().split()):
            found += [child, *children(child)]
    return found


def kill_one(process: subprocess.Popen, worker: bool) -> None:
    below = children(process.pid) if worker else []
    os.kill(below[-1] if below else process.pid, signal.SIGKILL)


def main(kills: int, workers: int) -> int:
    with tempfile.TemporaryDirectory() as folder:
        case, whole, parts = (Path(folder) / name for name in ("case.toml", "whole", "parts"))
        case.write_text(CASE, encoding="utf-8")
        begun = time.monotonic()
        assert start(case, whole, workers).wait() == 0
        length = time.monotonic() - begun
        chance = random.Random(1)
        for number in range(kills):
            process, before = start(case, parts, workers), done(parts)
            while number and process.poll() is None and done(parts) == before:
                time.sleep(0.05)  # starting takes longer than the work between two kills
            time.sleep(chance.uniform(0.0, 1.5) * length / kills)
            if process.poll() is None:
                kill_one(process, workers > 1 and number % 2 == 1)
            if workers > 1 and process.poll() is None and number % 2 == 1:
                time.sleep(length / kills)
                process.kill()
            process.wait()
            print(f"kill {number + 1}: {done(parts) - before} blocks done, {done(parts)} in all", flush=True)
        assert start(case, parts, workers).wait() == 0
        names = [sorted(str(file.relative_to(one)) for file in one.rglob("*") if file.is_file()) for one in (whole, parts)]
        _, other, missing = filecmp.cmpfiles(whole, parts, names[0], shallow=False)
        good = names[0] == names[1] and not other and not missing
        print(
            f"{len(names[0])} files, {done(whole)} blocks: {'the same, bit for bit' if good else f'{other + missing} differ'}"
        )
        return 0 if good else 1


if __name__ == "__main__":
    given = [int(word) for word in sys.argv[1:]]
    sys.exit(main(*(given + [20, 1][len(given) :])))
