"""Ctrl-C while commands are imported: one line, where Python would print what it was importing."""

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from typing import Any

INTERRUPTED = 130  # exit code


@contextmanager
def ended_by_interrupts() -> Iterator[None]:
    """Within, Ctrl-C ends the program with a line. What was begun has nothing to keep, and libraries that are imported would
    take an exception for one of their own. Where somebody else handles Ctrl-C it is theirs."""
    before = signal.getsignal(signal.SIGINT)
    if before is not signal.default_int_handler or current_thread() is not main_thread():
        yield
        return
    signal.signal(signal.SIGINT, _end)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _end(*_: Any) -> None:
    os.write(2, b"stiction: interrupted\n")
    os._exit(INTERRUPTED)
