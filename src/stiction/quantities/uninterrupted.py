"""Protect short operations, such as writing files, from being interrupted by Ctrl-C."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from typing import Any


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Return a context manager that delays Ctrl-C until it ends.

    Files are then written completely, and the zarr library leaves no unfinished coroutines.
    """
    before = signal.getsignal(signal.SIGINT)
    if before is None or current_thread() is not main_thread():  # Python interrupts only the main thread
        yield
        return
    interrupts: list[Any] = []
    signal.signal(signal.SIGINT, lambda *signal_and_frame: interrupts.append(signal_and_frame))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if interrupts and callable(before):
        before(*interrupts[0])
