"""Run commands on generated case files, and other inputs, and report all that end in no answer and no single line.

    python fuzz/run.py [--first 0] [--count 200] [--minutes 5] [--seconds 60] [--only commands] [--only runs]

A failure is a traceback, a message of more than one line, a command of more than `--seconds` of processor time or 4 GB, a
number that is not finite, a negative area or friction coefficient, an interval without mu in it, or a number that differs in a
second run. Exit code 1 where there is one. Each failure is printed with its seed: `python fuzz/run.py --first SEED --count 1`
repeats it.

All run in one worker process, so that Python, libraries and kernels are loaded once. A worker that dies, or stays in compiled
code where no alarm reaches it, is replaced, and its seed is a failure.
"""

import argparse
import json
import math
import multiprocessing
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from multiprocessing.connection import Connection
from pathlib import Path
from types import FrameType
from typing import Any

import typer.testing
from typer.testing import CliRunner

sys.path.insert(0, str(Path(__file__).parent))

from case_files import built_case
from generate import case_of, measured_text, suited_to
from inputs import TARGETS

from stiction import cli
from stiction.case.text import as_toml

# Commands that every case may be asked, and those that read a section of it; each with the share of cases that run it.
# Those that take seconds are rare: measured on 50 cases, processor time of a film 20 s, design 7 s, compare 4 s, report 1.6 s,
# validate 1.3 s, fit and export .5 s, and of all others less than .2 s.
COMMANDS = {"run": 1.0, "compare": 0.01, "sensitivity": 0.05, "film": 0.002, "slide": 0.1, "export": 0.05, "report": 0.01,
            "fit": 0.03, "validate": 0.01, "sweep": 0.05, "design": 0.005}  # fmt: skip
SECTION_COMMANDS = {"sweep": "sweep", "design": "design", "fit": "fit"}
_MEASURED = {
    "file": "measured.csv",
    "kind": "measured",
    "read": "printed",
    "source": "Somebody, Journal 1 (2000)",
    "place": "p. 2",
}
# Keys that say why a number is absent, in its table or in one that holds it.
_REASONS = ("warnings", "validity_warnings", "outside_validity", "why_not", "notes")
_POSITIVE = ("contact_area", "friction_force", "friction_coefficient", "mu")
_PICTURES = 40  # one seed in so many writes all files: matplotlib takes longer than most answers
_CHANGED = 4  # one case in so many is a changed example (generate.py), the others are built (case_files.py)
_RARE = {"other_means": 10, "solved_again": 4, "calls": 4}  # one seed in so many tries these: they take .1 to .5 s
_MOST_BYTES = 4 * 2**30
_TOLD = 50  # seeds between two lines on how far it is
_SEEDS_OF_A_WORKER = 500  # it is replaced then: what it has kept could hide what a fresh process does


# CliRunner makes the commands of the program anew for each call, which takes longer than most refusals.
typer.testing._get_command = cache(typer.testing._get_command)  # type: ignore[attr-defined]


class TooLong(BaseException):
    """Raised where a command takes more time than is allowed; no handler of errors takes it."""


def failures_of_inputs(seed: int, name: str, seconds: int) -> Iterator[str]:
    """Yield what fails of a target of `inputs.py` at a seed."""
    target = next(target for target in TARGETS if target.__name__ == name)
    try:
        with at_most(seconds), tempfile.TemporaryDirectory() as folder:
            for failure in target(random.Random(seed), Path(folder)):
                yield f"seed {seed}, {name}: {failure}"
    except TooLong:
        yield f"seed {seed}, {name}: more than {seconds} s"


def failures_of(seed: int, seconds: int, outcomes: Counter[str], only_run: bool = False) -> Iterator[str]:
    """Yield what fails among the commands on the case of a seed; only_run: of `stiction run` alone, the cheapest of them."""
    chance = random.Random(f"{seed} commands")
    with tempfile.TemporaryDirectory() as folder:
        case = case_of(seed) if seed % _CHANGED == 0 else built_case(random.Random(f"{seed} built"), Path(folder))
        path = Path(folder) / "case.toml"
        path.with_name("measured.csv").write_text(measured_text(chance), encoding="utf-8")
        for command in ["run"] if only_run else commands_of(seed, case):
            where = f"seed {seed}, {command}"
            tables = suited_to(command, case, chance) if command != "run" and chance.random() < 0.8 else case
            if not written(tables, path, command):
                continue
            found = said_of(command, path, seconds, files=seed % _PICTURES == 0)
            if isinstance(found, str):
                yield f"{where}: {found}"
                continue
            code, out = found
            outcomes[f"{command} {'answered' if code == 0 else 'refused'}"] += 1
            if code == 0:
                yield from (f"{where}: {fault}" for fault in faults_of(out))
            if command == "run" and code == 0 and seed % 20 == 0:
                again = said_of(command, path, seconds)
                if isinstance(again, str) or again[0] != code or not _alike(json.loads(out), json.loads(again[1])):
                    yield f"{where}: another number in a second run"


def written(tables: dict[str, Any], path: Path, command: str) -> bool:
    """Write the case of a command; return whether TOML can say it."""
    try:
        path.write_text(as_toml(tables | ({"measured": _MEASURED} if command == "validate" else {})), encoding="utf-8")
    except Exception:
        return False
    return True


def commands_of(seed: int, tables: dict[str, Any]) -> Iterator[str]:
    """Yield the commands of a case: `run`, some others, and those of its sections."""
    share = (seed * 0.6180339887498949) % 1.0
    for command, least in COMMANDS.items():
        if share < least:
            yield command
        share = (share + 0.37) % 1.0 if command != "run" else share
    yield from (command for section, command in SECTION_COMMANDS.items() if section in tables)


def said_of(command: str, path: Path, seconds: int, files: bool = False) -> tuple[int, str] | str:
    """Return exit code and standard output of a command, or what is wrong with how it ended; files: write all it can write."""
    out = path.parent / "out"
    try:
        with at_most(seconds):
            result = CliRunner().invoke(cli.app, _words(command, path, out, files))
    except TooLong:
        return f"more than {seconds} s"
    finally:
        if out.exists():
            shutil.rmtree(out, ignore_errors=True)
    if isinstance(result.exception, TooLong):
        return f"more than {seconds} s"
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        last = "".join(traceback.format_exception(result.exception)[-3:])
        return f"{type(result.exception).__name__}: {last}"
    said = [line for line in result.stderr.splitlines() if line.startswith("stiction: ")]
    lines = [line for line in said if not line.startswith("stiction: input warning: ")]
    if result.exit_code == 2 and (len(lines) != 1 or lines[0] not in result.stderr.rstrip().rpartition("\n")[2]):
        return f"not one line of error: {result.stderr[:600]}"
    if result.exit_code not in (0, 1, 2):
        return f"exit code {result.exit_code}"
    return result.exit_code, result.stdout


def _words(command: str, path: Path, out: Path, files: bool) -> list[str]:
    """Return the words of a command; files: with a folder for pictures and tables."""
    words = [command, str(path), "--json"]
    if command == "sweep" or (files and command in ("run", "compare", "film", "slide", "fit", "validate", "design")):
        words += ["--out", str(out)]
    if command == "fit":
        words += ["--data", str(path.with_name("measured.csv"))]
    if command == "export":
        words += ["--to", "csv", "--out", str(path.with_name("table.csv"))]
    if command == "report":
        words += ["--out", str(path.with_name("report.html"))]
    return words


@contextmanager
def at_most(seconds: int) -> Iterator[None]:
    """Raise TooLong after so many seconds of processor time: elapsed time would depend on what else the machine does."""

    def stop(number: int, frame: FrameType | None) -> None:
        raise TooLong

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def faults_of(out: str) -> Iterator[str]:
    """Yield what cannot be in the JSON of a result.

    An interval may have no width where a stated strength is 0 or bodies are pressed flat: roughness does not change mu then.
    """
    try:
        result = json.loads(out, parse_constant=float)
    except ValueError:
        yield f"no JSON: {out[:200]!r}"
        return
    yield from _not_finite(result, "")
    yield from _negative(result, "")
    yield from _without_reason(result, "", explained=False)
    answer = result.get("answer") if isinstance(result, dict) else None
    if not isinstance(answer, dict) or answer.get("interval") is None or answer.get("friction_coefficient") is None:
        return
    mu, (low, high) = answer["friction_coefficient"], answer["interval"]
    said = "outside its interval" in out
    if None in (low, high) or low < 0.0 or not ((low <= 1.01 * mu and 0.99 * mu <= high) or said):
        yield f"mu {mu} is not in 0 to its interval {low} to {high}"
    elif low == high and mu > 0.0 and "pressed flat" not in answer.get("regime", "").lower():
        yield f"an interval without width at {mu}"


_ROUND_OFF = {"load_residual": 1e-9, "pull_off_separation": 1e-9}


def _alike(one: Any, other: Any, least: float = 1e-300) -> bool:
    """Return whether two results are the same to 1e-12: plain Python and compiled loops round differently.

    least: difference that counts as none. Residuals of a load are round-off themselves, and so is the separation of a largest
    tension below 1e-9, because the load is flat there. How many evaluations a root took may differ.
    """
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(
            _alike(one[name], other[name], _ROUND_OFF.get(name, least)) for name in one if name != "convergence"
        )
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(_alike(*both, least) for both in zip(one, other, strict=True))
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=1e-12, abs_tol=least)
    return bool(one == other)


def _not_finite(value: Any, place: str) -> Iterator[str]:
    if isinstance(value, float) and not math.isfinite(value):
        yield f"{place or 'result'} is {value}"
    elif isinstance(value, dict):
        for name, one in value.items():
            yield from _not_finite(one, f"{place}.{name}")
    elif isinstance(value, list):
        for one in value[:50]:
            yield from _not_finite(one, place)


def _negative(value: Any, place: str) -> Iterator[str]:
    """Yield areas, forces and coefficients of friction below zero."""
    if isinstance(value, dict):
        for name, one in value.items():
            numbers = one if isinstance(one, list) else [one]
            if name.startswith(_POSITIVE) and any(isinstance(number, float) and number < 0.0 for number in numbers):
                yield f"{place}.{name} is negative: {one}"
            yield from _negative(one, f"{place}.{name}")
    elif isinstance(value, list):
        for one in value[:50]:
            yield from _negative(one, place)


def _without_reason(value: Any, place: str, explained: bool) -> Iterator[str]:
    """Yield coefficients of friction that are null where neither their table nor one that holds it gives a reason."""
    if isinstance(value, list):
        for one in value:
            yield from _without_reason(one, place, explained)
    if not isinstance(value, dict):
        return
    answer, attributes = value.get("answer"), value.get("attrs")
    of_contact_only = isinstance(attributes, dict) and str(attributes.get("friction_law")).startswith("none")
    explained = (
        explained
        or of_contact_only
        or any(table.get(name) for table in (value, answer) if isinstance(table, dict) for name in _REASONS)
    )
    if not explained and _without_mu(value):
        yield f"{place or 'result'}: mu is null without a warning"
    for name, one in value.items():
        yield from _without_reason(one, f"{place}.{name}", explained)


def _without_mu(table: dict[str, Any]) -> bool:
    """Return whether a coefficient of friction is null at a load that is compressive, or at an unknown one."""
    mu, loads = table.get("friction_coefficient", 0.0), table.get("load")
    both = zip(mu, loads, strict=False) if isinstance(mu, list) and isinstance(loads, list) else [(mu, loads)]
    return any(_is_null(one) and not (isinstance(load, float) and load <= 0.0) for one, load in both)


def _is_null(value: Any) -> bool:
    return value is None or (isinstance(value, list) and None in value)


def main() -> int:
    """Run the cases and print failures, and how many commands answered or refused."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--first", type=int, default=0, help="first seed")
    parser.add_argument("--count", type=int, default=1_000_000, help="number of seeds")
    parser.add_argument("--minutes", type=float, default=5.0, help="end after so many minutes")
    parser.add_argument("--seconds", type=int, default=60, help="most processor time of a command")
    names = ["commands", "runs", *(target.__name__ for target in TARGETS)]
    parser.add_argument("--only", choices=names, action="append", help="what is tried; by default all")
    wanted = parser.parse_args()
    names = wanted.only or [name for name in names if name != "runs"]
    end, outcomes, found = time.monotonic() + 60.0 * wanted.minutes, Counter[str](), 0
    done = set()
    for seed, failures, said in in_workers(range(wanted.first, wanted.first + wanted.count), names, wanted.seconds):
        for failure in failures:
            found += 1
            print(failure, flush=True)
        outcomes += said
        done.add(seed)
        if len(done) % _TOLD == 0:
            print(f"{len(done)} seeds, {sum(outcomes.values())} commands, {found} failures; {_counts(outcomes)}", flush=True)
        if time.monotonic() > end:
            break
    print(f"{len(done)} seeds from {wanted.first}; {found} failures")
    print(_counts(outcomes))
    return int(found > 0)


def _counts(outcomes: Counter[str]) -> str:
    return "; ".join(f"{outcome}: {count}" for outcome, count in sorted(outcomes.items()))


def in_workers(seeds: range, names: list[str], seconds: int) -> Iterator[tuple[int, list[str], Counter[str]]]:
    """Yield seed, failures and outcomes of everything that is tried, from a worker that is replaced where it hangs or dies."""
    context = multiprocessing.get_context("spawn")
    while seeds:
        few, seed = seeds[:_SEEDS_OF_A_WORKER], seeds[0]
        here, there = context.Pipe(duplex=False)
        worker = context.Process(target=_try_seeds, args=(few, names, seconds, there))
        worker.start()
        there.close()
        try:
            while here.poll(30 * seconds):  # elapsed; a seed runs several commands, some of them twice
                seed, failures, said = here.recv()
                yield seed, failures, said
                if seed == few[-1]:
                    break
                seed += 1
            else:
                yield seed, [f"seed {seed}: no answer, and deaf to an alarm"], Counter()
        except EOFError:
            worker.join()
            yield seed, [f"seed {seed}: the process ended with {worker.exitcode}"], Counter()
        finally:
            worker.kill()
            worker.join()
        seeds = seeds[seeds.index(seed) + 1 :]


def _try_seeds(seeds: range, names: list[str], seconds: int, results: Connection) -> None:
    """Send seed, failures and outcomes of each seed; the work of a worker."""
    resource.setrlimit(resource.RLIMIT_DATA, (_MOST_BYTES, _MOST_BYTES))
    for seed in seeds:
        outcomes, failures = Counter[str](), list[str]()
        for name in names:
            if len(names) > 1 and seed % _RARE.get(name, 1):
                continue
            if name in ("commands", "runs"):
                failures += failures_of(seed, seconds, outcomes, only_run=name == "runs")
            else:
                failures += failures_of_inputs(seed, name, seconds)
        results.send((seed, failures, outcomes))


if __name__ == "__main__":
    sys.exit(main())
