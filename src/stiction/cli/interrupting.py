"""Handle Ctrl-C while the program imports its libraries."""

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from typing import Any

INTERRUPTED = 130  # exit code


@contextmanager
def ended_by_interrupts() -> Iterator[None]:
    """Return a context manager in which Ctrl-C prints one line and ends the program at once.

    KeyboardInterrupt is not enough, because a library that is being imported may catch it. The manager does nothing if the
    caller has set a handler for Ctrl-C, or outside the main thread.
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
