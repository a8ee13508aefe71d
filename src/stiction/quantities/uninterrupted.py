"""Work that Ctrl-C does not cut in two: writing, mostly."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from typing import Any


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Ctrl-C waits until this is done: files are whole, and zarr leaves no coroutines that complain at the end."""
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
