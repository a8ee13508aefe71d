"""Do the tests bite? Makes the code wrong in one place after another, and asks the tests that ought to notice.

    python mutation/mutate.py                    # 150 edits, spread over the parts; those in results.jsonl are not run again
    python mutation/mutate.py --minutes 30       # stop then; the next run goes on
    python mutation/mutate.py --again survivors  # only what survived before, after tests were added
    python mutation/mutate.py --only units       # only one part of targets.py
    python mutation/mutate.py --report           # what results.jsonl says, and CONTRIBUTING.md then too

Works in a copy of the tracked files, with kernels of its own; nothing here is a test, and nothing fails by it. Edits are chosen
with a seed: the same ones, as long as their module is the same.
"""

import argparse
import contextlib
import io
import json
import multiprocessing
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from edits import Edit, edits
from targets import LAST, PARTS, Part

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "mutation" / "results.jsonl"
SLOW = ("numpy", "numba", "scipy.optimize", "scipy.integrate", "scipy.special", "scipy.stats", "scipy.signal")
SLOW += ("scipy.interpolate", "xarray", "pydantic", "pint", "mpmath", "matplotlib.pyplot", "h5py")
FAILED, BROKEN = 1, 99  # pytest: tests failed; above 1: they could not be run, as where a module cannot be imported
PATIENCE = 900.0  # seconds for tests that take one to two minutes on a busy machine


class Mutant(NamedTuple):
    part: Part
    module: str
    edit: Edit

    @property
    def key(self) -> dict[str, str | int]:
        text = (ROOT / self.module).read_text(encoding="utf-8")
        line = text.splitlines()[self.edit.line - 1].strip()
        column = self.edit.start - (text.rfind("\n", 0, self.edit.start) + 1)
        return {
            "part": self.part.name, "module": self.module, "line": self.edit.line, "column": column, "kind": self.edit.kind,
            "old": self.edit.old, "new": self.edit.new, "code": line,
        }  # fmt: skip


def chosen(count: int, seed: int) -> list[Mutant]:
    """Edits drawn with a seed: the parts in turn, in each its modules in turn, so that any beginning of the list is spread."""
    drawn = [_of_part(part, seed) for part in PARTS]
    turns = [one for turn in zip(*(_endless(some) for some in drawn), strict=False) for one in turn if one]
    return turns[:count]


def _endless(mutants: Iterator[Mutant]) -> Iterator[Mutant | None]:
    yield from mutants
    for _ in range(10_000):
        yield None


def _of_part(part: Part, seed: int) -> Iterator[Mutant]:
    rng = random.Random(f"{seed} {part.name}")
    folder = ROOT / "src" / "stiction"
    files = sorted({file for pattern in part.modules for file in folder.glob(pattern) if file.name != "__init__.py"})
    rng.shuffle(files)
    left = {}
    for file in files:
        left[file] = edits(file.read_text(encoding="utf-8"))
        rng.shuffle(left[file])
    while any(left.values()):
        for file in files:
            if left[file]:
                yield Mutant(part, file.relative_to(ROOT).as_posix(), left[file].pop())


def again(rows: dict[str, dict]) -> Iterator[Mutant]:
    """The edits that survived, where they are now: in a module that changed they may not be drawn any more."""
    parts = {part.name: part for part in PARTS}
    for identity, row in rows.items():
        file = ROOT / row["module"]
        if row["outcome"] == "survived" and file.is_file():
            every = (Mutant(parts[row["part"]], row["module"], edit) for edit in edits(file.read_text(encoding="utf-8")))
            yield from (one for one in every if _identity(one.key) == identity)


def copy(folder: Path) -> Path:
    """The tracked files, and the kernels that are compiled already, in a folder of their own."""
    tree = folder / "tree"
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, tree / name)
    sys.path.insert(0, str(ROOT / "src"))
    from stiction.quantities.cache import cache_folder

    kept = cache_folder("kernels")
    if kept.is_dir():
        shutil.copytree(kept, folder / "cache" / "kernels")
    return tree


def _asked(tree: str, tests: tuple[str, ...], told: str) -> None:
    """In a process of its own: pytest on these tests, its words to a file."""
    os.setsid()
    os.chdir(tree)
    sys.path[:0] = [f"{tree}/src", tree]
    sys.dont_write_bytecode = True  # an edit may keep a file's length and second
    with Path(told).open("w", encoding="utf-8") as file, contextlib.redirect_stdout(file), contextlib.redirect_stderr(file):
        code = BROKEN
        try:
            import pytest

            code = int(pytest.main(["-x", "-q", "-p", "no:cacheprovider", *tests]))
        except BaseException:
            traceback.print_exc()
    os._exit(code)


class Asking:
    """Runs tests of the copy; processes are forked from one that has the slow libraries already."""

    def __init__(self, folder: Path):
        self.folder, self.tree = folder, copy(folder)
        os.environ |= {
            "STICTION_CACHE_DIR": str(folder / "cache"), "PYTHONPATH": str(self.tree / "src"), "PYTHONDONTWRITEBYTECODE": "1",
            "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg",
        }  # fmt: skip
        self.processes = multiprocessing.get_context("forkserver")
        self.processes.set_forkserver_preload(list(SLOW))
        self.sound: set[str] = set()  # tests that pass where nothing is edited

    def run(self, tests: tuple[str, ...], seconds: float) -> tuple[str, str]:
        """('passed', 'failed', 'error' or 'time', the first failing test)."""
        shutil.rmtree(self.folder / "cache" / "contacts", ignore_errors=True)  # solved contacts know nothing of the edit
        told = self.folder / "told"
        process = self.processes.Process(target=_asked, args=(str(self.tree), tests, str(told)))
        process.start()
        for _ in range(int(seconds)):  # second by second: one in which all stood still, as on a machine that sleeps, is one
            process.join(1.0)
            if not process.is_alive():
                break
        if process.is_alive():
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.join()
            return "time", ""
        said = told.read_text(encoding="utf-8") if told.exists() else ""
        if process.exitcode == BROKEN or process.exitcode is None or process.exitcode < 0:
            raise SystemExit(f"tests could not be asked, exit {process.exitcode}: {said}")
        names = {0: "passed", FAILED: "failed"}
        first = next((line.split(" ", 1)[1] for line in said.splitlines() if line.startswith(("FAILED ", "ERROR "))), "")
        return names.get(process.exitcode, "error"), first.split(" - ")[0]

    def verdict(self, mutant: Mutant) -> dict[str, str | float]:
        """Whether it was killed, by what, and how long that took."""
        start, file = time.monotonic(), self.tree / mutant.module
        whole = file.read_text(encoding="utf-8")
        file.write_text(mutant.edit.of(whole), encoding="utf-8")
        try:
            (outcome, first), by = self.run(mutant.part.tests, PATIENCE), "tests"
            if outcome == "passed" and mutant.part.pinned:
                (outcome, first), by = self.run(LAST, PATIENCE), "pinned results alone"
        finally:
            file.write_text(whole, encoding="utf-8")
        found = {"seconds": round(time.monotonic() - start, 1), "date": time.strftime("%Y-%m-%d")}
        if outcome == "passed":
            return {"outcome": "survived"} | found
        self.confirm(first)
        return {"outcome": "killed", "by": by, "how": outcome, "first": first} | found

    def confirm(self, first: str) -> None:
        """What failed must pass where nothing is edited, or its failure says nothing; what could not be read has no name."""
        if first and first not in self.sound:
            outcome, _ = self.run((first,), PATIENCE)
            if outcome != "passed":
                raise SystemExit(f"{first} fails as the code is: {(self.folder / 'told').read_text(encoding='utf-8')}")
            self.sound.add(first)


def known() -> dict[str, dict]:
    """Verdicts so far, the latest of each edit, by edit."""
    lines = RESULTS.read_text(encoding="utf-8").splitlines() if RESULTS.exists() else []
    rows = [json.loads(line) for line in lines]
    return {_identity(row): row for row in rows}


def _identity(row: dict) -> str:
    """Of an edit: lines may move, what stands in them not."""
    return json.dumps([row["module"], row["code"], row["column"], row["old"], row["new"]])


def _keep(row: dict) -> dict[str, dict]:
    """Add a verdict to those that are kept, which may have been edited meanwhile; all of them."""
    rows = known()
    rows[_identity(row)] = row
    part = RESULTS.with_suffix(".part")
    part.write_text("".join(json.dumps(one, ensure_ascii=False) + "\n" for one in rows.values()), encoding="utf-8")
    part.replace(RESULTS)
    return rows


def rate(rows: dict[str, dict]) -> str:
    """The line of CONTRIBUTING.md: how many were killed of how many that were run, and when."""
    every = list(rows.values())
    killed = [row for row in every if row["outcome"] == "killed"]
    alone, same = sum(row["by"] != "tests" for row in killed), sum(row["outcome"] == "equivalent" for row in every)
    counted = len(every) - same
    last = max((row["date"] for row in every), default="never")
    share = f" ({100.0 * len(killed) / counted:.0f} %)" if counted else ""
    return (
        f"Kill rate: {len(killed)} of {counted} edits{share}, {alone} of them only by the pinned results; "
        f"{same} further edits are equivalent (they change no result); last run {last}."
    )


def tell(line: str) -> None:
    """Print the line, and write it where it stands in CONTRIBUTING.md."""
    print(line)
    page = ROOT / "CONTRIBUTING.md"
    page.write_text(re.sub(r"(?m)^Kill rate: .*$", line, page.read_text(encoding="utf-8")), encoding="utf-8")


def report(rows: dict[str, dict]) -> str:
    """Kill rate, in all and by part, and what survived."""
    every = list(rows.values())
    out = io.StringIO()
    for part in [None, *PARTS]:
        some = [row for row in every if part is None or row["part"] == part.name]
        killed = [row for row in some if row["outcome"] == "killed"]
        alone = sum(row["by"] != "tests" for row in killed)
        same = sum(row["outcome"] == "equivalent" for row in some)
        name = "all" if part is None else part.name
        if some:
            note = f", {alone} of them by pinned results alone" if alone else ""
            note += f"; {same} change nothing that can be seen" if same else ""
            print(f"{name}: {len(killed)} of {len(some)} killed ({len(killed) / len(some):.0%}){note}", file=out)
    for row in every:
        if row["outcome"] != "killed":
            why = f" - {row['why']}" if "why" in row else ""
            edit = f"{row['old']!r} -> {row['new']!r}"
            print(f"{row['outcome']}: {row['module']}:{row['line']}: {edit} in `{row['code']}`{why}", file=out)
    return out.getvalue().rstrip()


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--count", type=int, default=150)
    words.add_argument("--seed", type=int, default=17)
    words.add_argument("--minutes", type=float, default=1e9)
    words.add_argument("--again", choices=("survivors",))
    words.add_argument("--only", help="a part of targets.py")
    words.add_argument("--report", action="store_true")
    given = words.parse_args()
    rows = known()
    if not given.report:
        run(given, rows)
    print(report(rows))
    tell(rate(rows))


def run(given: argparse.Namespace, rows: dict[str, dict]) -> None:
    """Ask for what is not known, and keep each verdict as it comes."""
    end = time.monotonic() + 60.0 * given.minutes
    if given.again:
        wanted = list(again(rows))
    else:
        wanted = [one for one in chosen(given.count, given.seed) if _identity(one.key) not in rows]
    wanted = [one for one in wanted if given.only in (None, one.part.name)]
    with tempfile.TemporaryDirectory() as folder:
        asking = Asking(Path(folder))
        for at, mutant in enumerate(wanted, 1):
            if time.monotonic() > end:
                break
            row = mutant.key | asking.verdict(mutant)
            rows |= _keep(row)
            print(f"{at}/{len(wanted)} {row['outcome']:8} {row['seconds']:6.1f} s  {row['module']}:{row['line']} "
                  f"{row['old']!r} -> {row['new']!r}  {row.get('first', '')}", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
