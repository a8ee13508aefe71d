"""How fast a sweep of seven inputs is, and in how much memory: benchmarks/seven_inputs.toml, 100 loads a contact.

    python benchmarks/sweep_speed.py [CONTACTS] [--workers 2] [--compare] [--out STORE]

Prints time, rate and the largest memory of all its processes together (what they share is counted in each), the size of the
store, and by how much points picked at random differ from `solve` of each contact alone. With --compare also what one worker
takes, and what statistics in place of the points take. 1048576 contacts, 10^8 points, need 1.3 GB of disk.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import threading
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

CASE = Path(__file__).parent / "seven_inputs.toml"
CONTACTS = 1048576
STATISTICS = 'statistics = ["count", "mean", "standard_deviation", "percentile_5", "median", "percentile_95"]\n'
COMMAND = [sys.executable, "-c", "from stiction.cli import main; main()", "sweep"]
UNITS = {
    "work_of_adhesion": "J/m^2", "interfacial_shear_strength": "Pa", "asperity_height_deviation": "m", "asperity_radius": "m",
    "asperity_density": "1/m^2", "hardness": "Pa", "thickness": "m",
}  # fmt: skip
_PICKED = 1000


@dataclass(frozen=True)
class Ran:
    """A sweep: seconds from call to end, points, the largest memory of its processes together in bytes."""

    seconds: float
    points: int
    memory: int

    @property
    def rate(self) -> float:
        return self.points / self.seconds

    def __str__(self) -> str:
        return f"{self.points:.4g} points in {self.seconds:.1f} s: {self.rate:.3g} points/s, {self.memory / 1e9:.2f} GB"


def tree(process: int) -> list[int]:
    """A process and all that it and its children have begun, as Linux tells them."""
    found = [process]
    for task in Path(f"/proc/{process}/task").glob("*/children"):
        try:
            below = task.read_text().split()
        except OSError:  # it has ended
            continue
        found += [one for child in below for one in tree(int(child))]
    return found


def memory(process: int) -> int:
    """Bytes that a process and those below it hold."""
    pages = 0
    for one in tree(process):
        try:
            pages += int(Path(f"/proc/{one}/statm").read_text().split()[1])
        except OSError:
            continue
    return pages * 4096


def case_text(contacts: int, statistics: bool = False) -> str:
    text = CASE.read_text(encoding="utf-8").replace(f"count = {CONTACTS}", f"count = {contacts}")
    return text + (STATISTICS if statistics else "")


def run(text: str, out: Path, workers: int) -> Ran:
    """Sweep the case of this text, and watch."""
    case = out.parent / f"{out.name}.toml"
    case.write_text(text, encoding="utf-8")
    begun = time.perf_counter()
    process = subprocess.Popen([*COMMAND, str(case), "--out", str(out), "--workers", str(workers), "--json"], stdout=-1)
    most, over = [0], threading.Event()

    def watch() -> None:
        while not over.wait(0.1):
            most[0] = max(most[0], memory(process.pid))

    watching = threading.Thread(target=watch)
    watching.start()
    answer, _ = process.communicate()
    seconds = time.perf_counter() - begun
    over.set()
    watching.join()
    assert process.returncode == 0
    return Ran(seconds, json.loads(answer)["computed_now"], most[0])


def one_contact(content: dict[str, Any], data: Any, sample: int) -> dict[str, Any]:
    """The tables of the case with the numbers of one of its contacts, to the last digit."""
    found: dict[str, Any] = {}
    for key, value in content.items():
        several = isinstance(value, dict) and {"start", "stop"} <= value.keys()
        inner = isinstance(value, dict) and not several
        found[key] = one_contact(value, data, sample) if inner else _number(data[key], key, sample) if several else value
    return found


def _number(values: Any, name: str, sample: int) -> str:
    return f"{float(values[sample])!r} {UNITS[name]}"


def differences(out: Path) -> dict[str, float]:
    """By how much of their size results at points picked at random differ from what `solve` gives of each contact alone."""
    import stiction as st
    from stiction.case.read import parse_case

    data = st.sweep(out.parent / f"{out.name}.toml", out)  # it is complete: nothing is computed
    content = tomllib.loads(CASE.read_text(encoding="utf-8"))
    names = content.pop("sweep")["keep"]
    worst = dict.fromkeys(names, 0.0)
    chance = np.random.default_rng(7)
    loads = data["load"].values
    for _ in range(_PICKED):
        sample, at = int(chance.integers(data.sizes["sample"])), int(chance.integers(loads.size))
        contact = one_contact({"contact": content["contact"]}, data, sample)
        alone = st.solve(parse_case(contact | {"solve": {"load": "1 N"}}).subject, load=float(loads[at]))
        for name in names:
            stored, wanted = float(data[name][sample, at]), float(alone[name].values.item())
            worst[name] = max(worst[name], abs(stored - wanted) / abs(wanted))
    return worst


def size_of(out: Path) -> int:
    return sum(file.stat().st_size for file in out.rglob("*") if file.is_file())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("contacts", nargs="?", type=int, default=40_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--compare", action="store_true")
    parser.add_argument("--out", type=Path, help="folder for the stores, kept; by default one that is removed")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        place = Path(given.out or folder)
        place.mkdir(parents=True, exist_ok=True)
        text = case_text(given.contacts)
        ran = run(text, place / "points", given.workers)
        print(f"{given.workers} workers, points stored: {ran}", flush=True)
        size = size_of(place / "points")
        print(f"store: {size / 1e6:.1f} MB, {size / ran.points:.2f} bytes a point", flush=True)
        if given.compare:
            alone = run(text, place / "alone", 1)
            print(f"1 worker, points stored: {alone}", flush=True)
            print(f"{given.workers} workers are {ran.rate / alone.rate:.2f} times as fast as 1", flush=True)
            only = run(case_text(given.contacts, statistics=True), place / "statistics", given.workers)
            print(f"{given.workers} workers, statistics only: {only}; {only.rate / ran.rate:.2f} times as fast", flush=True)
        for name, most in differences(place / "points").items():
            print(f"{name}: {_PICKED} points differ from solve by {most:.1e} at most")
    return 0


if __name__ == "__main__":
    sys.exit(main())
