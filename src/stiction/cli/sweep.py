"""`stiction sweep`: many contacts, into a store on disk."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from time import monotonic

from stiction.cli.options import Details, Json, argument, folder, option
from stiction.cli.program import app, busy, present


@app.command()
def sweep(
    case: Path = argument("CASE.toml", "Case file in which numbers are arrays."),
    out: Path = option(
        "Folder of the store: a new one, or an unfinished one of the same case.", ..., "--out", parser=folder, metavar="STORE"
    ),
    workers: int = option("Number of processes on this machine.", 1, metavar="N"),
    scheduler: str | None = option(
        "Scheduler of a dask.distributed cluster that does the work, e.g. tcp://host:8786.", metavar="ADDRESS"
    ),
    details: Details = False,
    json: Json = False,
) -> None:
    """Solve many contacts into a labelled store on disk (zarr 3).

    The table [sweep] of the case selects the contacts: every combination, points of a list, or random points. A sweep can be
    interrupted; the same command continues it. The store is the same, bit for bit, for any number of workers.
    """
    if not _stderr().is_terminal:
        _stderr().print("Reading the case")  # at once: the first points take longer
    with busy("Reading the case"):
        from stiction.studies.sweep.run import run_sweep
    begun = monotonic()
    shown = _Shown()
    try:
        store = run_sweep(case, out, workers, scheduler, shown)
    except KeyboardInterrupt:
        stopped = f"stopped: {shown.done} of {shown.size} points are in {out}; run the command again to continue"
        _stderr().print(stopped, style="bold", highlight=False, markup=False, soft_wrap=True)
        raise
    seconds = monotonic() - begun
    from stiction.report.views.sweep import sweep_view

    present(sweep_view(store, out, shown.computed, seconds), None, json, details)


class _Shown:
    """Show progress, rate and remaining time of a sweep: a bar on a terminal, else a line every ten seconds."""

    def __init__(self) -> None:
        self.done = self.size = self.computed = 0

    def __call__(self, done: int, size: int, steps: Iterable[int]) -> Iterator[int]:
        from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn

        self.done, self.size = done, size
        terminal, texts = _stderr(), [TextColumn(f"{{task.{name}}}") for name in ("description", "fields[rate]")]
        columns = (
            texts[0],
            BarColumn(),
            TaskProgressColumn(),
            texts[1],
            TimeElapsedColumn(),
            TextColumn("left"),
            TimeRemainingColumn(),
        )
        begun = printed_at = monotonic()
        with Progress(*columns, console=terminal, transient=True, disable=not terminal.is_terminal) as progress:
            task = progress.add_task("Sweeping", total=size, completed=done, rate="")
            if progress.disable:
                self._say(terminal, 0.0)
            for points in steps:
                self.done += points
                self.computed += points
                rate = self.computed / (monotonic() - begun)
                progress.update(task, completed=self.done, rate=f"{self.done:.3g} of {size:.3g} points, {rate:.3g}/s")
                if progress.disable and monotonic() - printed_at > _EVERY:
                    printed_at = monotonic()
                    self._say(terminal, rate)
                yield points

    def _say(self, terminal, rate: float) -> None:
        left = f", {rate:.3g} points/s, {(self.size - self.done) / rate:.0f} s left" if rate else ""
        terminal.print(f"{self.done} of {self.size} points{left}", highlight=False, soft_wrap=True)


_EVERY = 10.0  # seconds between lines


def _stderr():
    from rich.console import Console

    return Console(stderr=True)
