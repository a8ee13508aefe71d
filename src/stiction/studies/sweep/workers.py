"""Compute the blocks of a sweep in several processes or on a dask.distributed cluster."""

import os
import pickle
import signal
from collections.abc import Iterator
from functools import lru_cache, partial
from itertools import islice
from time import monotonic
from typing import TYPE_CHECKING, Any

from stiction.quantities.errors import InputError
from stiction.quantities.extras import bring_back

if TYPE_CHECKING:
    from stiction.studies.sweep.store import Store

# Consecutive deaths of workers, without a finished block between them, that end a sweep; blocks submitted for each worker.
_DEATHS, _AHEAD = 3, 3
_EVERY = 5.0  # seconds between two counts of the threads of a cluster
_LEAST_AHEAD = 256  # smallest number of blocks submitted to a cluster, so that its scheduler always has some to hand out


# Modules that every worker needs. They are imported once for all workers where a process can be copied (forkserver).
_NEEDED = ["stiction.studies.sweep.store", "stiction.studies.case_results", "scipy.stats", "xarray", "zarr"]


def make_ready() -> Any:
    """Return the multiprocessing context for workers, and begin to import their modules in the background.

    Without the start method forkserver (on Windows), the context is "spawn" and nothing is imported yet.
    """
    import multiprocessing

    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    from multiprocessing import forkserver, resource_tracker

    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(_NEEDED)
    resource_tracker.ensure_running()  # now, because its start would unblock the signal
    # Ctrl-C reaches all processes of a terminal. The server and the workers inherit the blocked signal, so that only this
    # process is interrupted, even while the others still import their modules.
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        forkserver.ensure_running()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    return context


def done_in_processes(store: "Store", blocks: list[int], workers: int) -> Iterator[int]:
    """Compute blocks in several processes; yield the number of points of each finished block.

    blocks: numbers of the blocks. workers: number of processes. Processes that die are replaced and their blocks repeated.
    Raises InputError if they die three times without a finished block.
    """
    from concurrent.futures.process import BrokenProcessPool

    left, deaths = list(blocks), 0
    while left:
        try:
            for block, points in _in_pool(store, list(left), workers):
                left.remove(block)
                deaths = 0
                yield points
        except BrokenProcessPool:
            deaths += 1
            if deaths == _DEATHS:
                raise InputError(
                    "--workers", workers, "fewer processes; they died repeatedly, perhaps for lack of memory"
                ) from None


def _in_pool(store: "Store", blocks: list[int], workers: int) -> Iterator[tuple[int, int]]:
    from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait

    pool = ProcessPoolExecutor(workers, mp_context=make_ready(), initializer=_begin, initargs=(store,))
    try:
        waiting: dict[Any, int] = {}
        rest = iter(blocks)
        while True:
            for block in rest:
                waiting[pool.submit(_do, block)] = block
                if len(waiting) >= _AHEAD * workers:
                    break
            if not waiting:
                return
            for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                yield waiting.pop(future), future.result()
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


_store: "Store | None" = None  # the store that this worker process writes to


def _begin(store: "Store") -> None:
    from threading import Thread

    global _store
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # where workers are not made by a server, which blocks Ctrl-C
    Thread(target=_end_with_parent, daemon=True).start()
    _store = store


def _end_with_parent() -> None:
    """End this worker process when its parent process ends; otherwise the worker would wait for ever.

    No file is left half written, because complete files are moved into place.
    """
    from multiprocessing import parent_process

    parent = parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


def _do(block: int) -> int:
    assert _store is not None
    return _store.do(block)


def done_on_cluster(store: "Store", blocks: list[int], address: str) -> Iterator[int]:
    """Compute blocks on a dask.distributed cluster; yield the number of points of each finished block.

    blocks: numbers of the blocks. address: address of the scheduler, whose workers must reach the store under the same path.
    Raises InputError if the scheduler does not answer, or if workers die repeatedly. An error of a block is raised again.
    """
    bring_back("dask")
    from distributed import Client, as_completed
    from distributed.scheduler import KilledWorker

    try:
        client = Client(address, timeout=10)
    except (OSError, ValueError) as error:
        raise InputError("--scheduler", address, f"the address of a scheduler, e.g. tcp://host:8786 ({error})") from None
    with client:
        given, rest = pickle.dumps(store), iter(blocks)
        waiting: dict[Any, int] = {}

        room = _Room(client)

        def submitted() -> list[Any]:
            some = list(islice(rest, max(0, room.now() - len(waiting))))
            futures = client.map(partial(_do_there, given), some, pure=False) if some else []
            waiting.update(zip((future.key for future in futures), some, strict=True))
            return futures

        running = as_completed(submitted())
        try:
            for batch in running.batches():  # many at a time; requesting results would cost one message each
                done = [waiting.pop(future.key) for future in batch]
                running.update(submitted())
                for future, block in zip(batch, done, strict=True):
                    if future.status != "finished":
                        future.result()  # waits, or raises what went wrong
                    yield store.plan.contacts(block) * store.plan.points
        except KilledWorker:
            raise InputError("--scheduler", address, "workers with enough memory; they died repeatedly") from None


class _Room:
    """Compute how many blocks may be submitted to a cluster at once: three for each of its threads, at least 256.

    The threads are counted at most every five seconds.
    """

    def __init__(self, client: Any) -> None:
        self.client, self.room, self.counted = client, 0, -_EVERY

    def now(self) -> int:
        if monotonic() - self.counted >= _EVERY:
            self.counted = monotonic()
            self.room = max(_LEAST_AHEAD, _AHEAD * sum(self.client.nthreads().values()))
        return self.room


def _do_there(given: bytes, block: int) -> int:
    return _opened(given).do(block)


@lru_cache(maxsize=1)
def _opened(given: bytes) -> "Store":
    """Return the store that a task carries in pickled form; the last one is cached.

    Each task carries the store itself, because data sent to a worker once are lost when the worker dies.
    """
    return pickle.loads(given)
