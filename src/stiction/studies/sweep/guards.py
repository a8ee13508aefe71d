"""One sweep of a store at a time."""

import os
from contextlib import contextmanager, suppress
from pathlib import Path

from stiction.quantities.errors import InputError


@contextmanager
def locked(path: Path):
    """Lock the store, or raise InputError where another sweep writes to it.

    The lock ends with its process. On systems without locks, two sweeps of one store write the same bits.
    """
    try:
        import fcntl
    except ImportError:
        yield
        return
    handle = os.open(path, os.O_RDONLY)
    try:
        with suppress(OSError):  # of a file system without locks
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise InputError(
                    "--out", str(path), "a store that no other sweep writes to; wait for that sweep, or choose another folder"
                ) from None
        yield
    finally:
        os.close(handle)
