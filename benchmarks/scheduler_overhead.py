"""What a dask.distributed scheduler takes for a task of a sweep: tasks that do nothing, handed over as `stiction sweep` does.

    python benchmarks/scheduler_overhead.py [TASKS] [--workers 2]

A real scheduler and workers, each a process of its own on this machine. Prints seconds for a task, and how many workers that
keeps busy.
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from stiction.studies.sweep import workers as sweep_workers
from stiction.studies.sweep.plan import Plan, make_plan

CASE = Path(__file__).parent / "seven_inputs.toml"
_BLOCK = 0.31  # seconds that a block of 131072 points takes: benchmarks/sweep_speed.py


class Idle:
    """A store that has nothing to do: what is sent with a block is what a store sends, its path and its plan."""

    def __init__(self, path: str, plan: Plan):
        self.path, self.plan = path, plan

    def do(self, block: int) -> int:
        return 1


def _with_blocks(content: dict[str, Any], tasks: int) -> dict[str, Any]:
    """The case with enough points for so many blocks."""
    sample = content["sweep"]["sample"] | {"count": 1310 * tasks}
    return content | {"sweep": content["sweep"] | {"sample": sample}}


def overhead(store: Any, tasks: int, workers: int) -> float:
    """Seconds for a task."""
    from distributed import LocalCluster

    with LocalCluster(n_workers=workers, threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0") as cluster:
        address = cluster.scheduler_address
        list(sweep_workers.done_on_cluster(store, list(range(100)), address))  # all is imported
        begun = time.perf_counter()
        assert len(list(sweep_workers.done_on_cluster(store, list(range(tasks)), address))) == tasks
        return (time.perf_counter() - begun) / tasks


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tasks", nargs="?", type=int, default=100_000)
    parser.add_argument("--workers", type=int, default=2)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        import tomllib

        store = Idle(folder, make_plan(_with_blocks(tomllib.loads(CASE.read_text(encoding="utf-8")), given.tasks)))
        each = overhead(store, given.tasks, given.workers)
    print(f"{given.tasks} tasks by {given.workers} workers: {each * 1e3:.2f} ms a task, {1 / each:.0f} tasks/s")
    print(f"blocks of {_BLOCK} s keep {_BLOCK / each:.0f} workers busy, blocks 128 times as large {128 * _BLOCK / each:.0f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
