"""Define the command `stiction sweep`, which solves many contacts and stores the results on disk."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from time import monotonic

from stiction.cli.options import Details, Json, argument, folder, option
from stiction.cli.program import app, busy, present, progress_text


@app.command()
def sweep(
    case: Path = argument("CASE.toml", "Case file in which numbers are arrays."),
    out: Path = option(
        "Folder of the store: new, or of an unfinished sweep of the same case.", ..., "--out", parser=folder, metavar="STORE"
    ),
    workers: int = option("Number of processes on this machine.", 1, metavar="N"),
    scheduler: str | None = option(
        "Address of the scheduler of a dask.distributed cluster, e.g. tcp://host:8786.", metavar="ADDRESS"
    ),
    details: Details = False,
    json: Json = False,
) -> None:
    """Solve many contacts and store the results on disk (zarr 3).

    The table [sweep] of the case selects the contacts: all combinations, a list of points, or random points. An interrupted
    sweep continues if the same command is run again. The store is identical, bit for bit, for any number of workers.
    """
    if not _stderr().is_terminal:
        _stderr().print("Reading the case")  # printed at once, because the first points take long
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
    """Show the progress of a sweep: points done, rate and remaining time.

    A terminal shows them in one line; elsewhere a line is printed every ten seconds.
    """

    def __init__(self) -> None:
        self.done = self.size = self.computed = 0

    def __call__(self, done: int, size: int, steps: Iterable[int]) -> Iterator[int]:
        self.done, self.size = done, size
        begun = monotonic()
        with progress_text() as tell:
            tell(f"{done} of {size} points")
            for points in steps:
                self.done += points
                self.computed += points
                rate = self.computed / (monotonic() - begun)
                left = (size - self.done) / rate
                tell(f"{self.done} of {size} points ({self.done / size:.0%}), {rate:.3g} points/s, {left:.0f} s left")
                yield points


def _stderr():
    from rich.console import Console

    return Console(stderr=True)
