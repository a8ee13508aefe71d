"""What keeps a store whole: writing that Ctrl-C does not cut in two, and one sweep at a time."""

import os
import signal
from contextlib import contextmanager
from pathlib import Path
from threading import current_thread, main_thread
from typing import Any

from stiction.quantities.errors import InputError

__all__ = ["locked", "uninterrupted"]


@contextmanager
def uninterrupted():
    """Ctrl-C waits until this is done: zarr, interrupted as it writes, leaves coroutines that complain at the end."""
    before = signal.getsignal(signal.SIGINT)
    if before is None or current_thread() is not main_thread():  # only the main one is interrupted
        yield
        return
    asked: list[Any] = []
    signal.signal(signal.SIGINT, lambda *of: asked.append(of))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if asked and callable(before):
        before(*asked[0])


@contextmanager
def locked(path: Path):
    """Alone with the store: InputError where another sweep writes to it. The lock goes with the process that has it; where the
    system has none, two sweeps of one store write the same bits."""
    try:
        import fcntl
    except ImportError:
        yield
        return
    handle = os.open(path, os.O_RDONLY)
    try:
        _lock(fcntl, handle, path)
        yield
    finally:
        os.close(handle)


def _lock(fcntl: Any, handle: int, path: Path) -> None:
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise InputError("--out", str(path), "a store that no other sweep is writing to") from None
    except OSError:  # a file system without locks
        return
