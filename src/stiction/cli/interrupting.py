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
    """End the program with one line on Ctrl-C.

    Nothing begun here is worth keeping, and libraries that are being imported would take an exception for one of their own.
    A handler of Ctrl-C that is already set stays.
    """
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
