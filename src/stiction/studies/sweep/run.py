"""Run sweeps of any size, block by block, into a store on disk; an interrupted sweep can be continued."""

import errno
import json
import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stiction.case.read import tables_of
from stiction.quantities.errors import InputError
from stiction.quantities.extras import require
from stiction.studies.sweep.plan import make_plan
from stiction.studies.sweep.workers import make_ready

if TYPE_CHECKING:
    import xarray

    from stiction.case.arguments import CaseFile
    from stiction.quantities.arguments import FilePath
    from stiction.studies.sweep.store import Store

_MOST_WORKERS = 1024  # processes of one machine

# Function of the number of finished points, the number of all points, and an iterator over the sizes of blocks as they are
# finished; returns an iterable over the same sizes that displays the progress.
Progress = Callable[[int, int, Iterable[int]], Iterable[int]]


def sweep(
    case: "CaseFile", out: "FilePath", *, workers: int = 1, scheduler: str | None = None, progress: Progress | None = None
) -> "xarray.Dataset":
    """Solve all contacts of a case with array parameters into a store on disk.

    Parameters
    ----------
    case : path, or dict like a case file
        Case whose numbers may be lists or ranges.
    out : path
        Folder of the store: a new folder, or a store of this case, which is then completed.
    workers : int
        Number of processes on this machine.
    scheduler : str, optional
        Address of a dask.distributed scheduler, in place of workers; its workers need the store under the same path.
    progress : callable, optional
        Receives the number of finished points (contacts at a load or separation), the number of all points, and an iterator
        over the number of points of each block; returns an iterable over the same, e.g. one that displays the progress.

    Returns
    -------
    xarray.Dataset
        The store, read from disk when needed. It has the results of `solve` over the dimensions of the array parameters (or
        over `sample`) and the loads or separations, or the results of `predict` if the case names no model; and
        `validity_warnings`, bit flags whose meaning is in the attributes flag_masks and flag_meanings. If [sweep] requests
        statistics, it has these over `statistic` and the loads or separations, and no warnings.

    Raises
    ------
    InputError
        The case is wrong, the first contacts are refused, or the store is of another case, damaged, or cannot be written.
    ArithmeticError
        The model does not converge for the first contacts.

    Notes
    -----
    The store is the same, bit for bit, however many processes computed it and however often it was interrupted.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import stiction as st
    >>> contact = {
    ...     "first": "gold", "second": "gold", "nominal_area": "1 mm^2", "interfacial_shear_strength": "50 MPa",
    ...     "roughness": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
    ... }
    >>> contact["interfacial_shear_strength"] = ["50 MPa", "100 MPa"]
    >>> case = {"contact": contact, "solve": {"load": ["0.1 N", "1 N"], "model": "persson_2001"}}
    >>> st.sweep(case, pathlib.Path(tempfile.mkdtemp()) / "store.zarr").friction_coefficient.shape
    (2, 2)
    """
    from stiction.studies.sweep.store import open_store

    run_sweep(case, out, workers, scheduler, progress)
    return open_store(Path(out))


def run_sweep(case: Any, out: Any, workers: int, scheduler: str | None, progress: Progress | None) -> "Store":
    """Run a sweep into the store folder `out` and return the completed store.

    The arguments are those of `sweep`, and so are the errors raised. progress: None displays nothing.
    """
    require("sweep", *(("distributed",) if scheduler else ()), "zarr")
    if isinstance(workers, bool) or not isinstance(workers, int) or not 1 <= workers <= _MOST_WORKERS:
        raise InputError("--workers", workers, f"a whole number, 1 to {_MOST_WORKERS}; more are for a cluster, --scheduler")
    if not isinstance(out, str | os.PathLike):
        raise InputError("--out", out, "the path of a store, new, or of this case")
    if not (scheduler is None or isinstance(scheduler, str)):
        raise InputError("--scheduler", scheduler, "the address of a scheduler, as text")
    if workers > 1 and scheduler is None:
        make_ready()
    content, folder = tables_of(case)
    text = json.dumps(case, default=str) if content is case else Path(case).read_text(encoding="utf-8-sig")
    plan = make_plan(content, folder)
    from stiction.studies.sweep.opening import opened_store

    store = opened_store(Path(out), plan, str(content.get("title", "")), text)
    with locked(Path(out)):
        left = sorted([*store.left(), *store.damaged()])
        points = [plan.contacts(block) * plan.points for block in left]
        done = _done(store, left, workers, scheduler)
        for _ in (progress or (lambda done, size, steps: steps))(plan.size - sum(points), plan.size, done):
            pass
        with _refused_where_not_writable(store):
            store.finish()
    return store


def _done(store: "Store", left: list[int], workers: int, scheduler: str | None) -> Iterator[int]:
    from stiction.studies.sweep import workers as sweep_workers

    with _refused_where_not_writable(store):
        if not left:
            return
        if scheduler is not None:
            yield from sweep_workers.done_on_cluster(store, left, scheduler)
        elif workers > 1 and len(left) > 1:
            yield from sweep_workers.done_in_processes(store, left, min(workers, len(left)))
        else:
            yield from map(store.do, left)


@contextmanager
def _refused_where_not_writable(store: "Store") -> Iterator[None]:
    """Return a context manager that turns an OSError, as raised by a full disk, into an InputError of one line."""
    try:
        yield
    except OSError as error:
        full = error.errno in (errno.ENOSPC, errno.EDQUOT)
        why = "room on its disk, which is full" if full else f"a folder that can be written ({error.strerror or error})"
        raise InputError("--out", store.path, f"{why}; finished blocks are kept, run the sweep again to continue") from None


@contextmanager
def locked(path: Path):
    """Lock the store folder `path` for the duration of a with block; raise InputError if another sweep writes to it.

    The operating system releases the lock when the process ends. On a system without file locks two sweeps may run at once, but
    they write the same bits.
    """
    try:
        import fcntl
    except ImportError:
        yield
        return
    handle = os.open(path, os.O_RDONLY)
    try:
        with suppress(OSError):  # raised by file systems without locks
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise InputError(
                    "--out", str(path), "a store that no other sweep writes to; wait for that sweep, or choose another folder"
                ) from None
        yield
    finally:
        os.close(handle)
