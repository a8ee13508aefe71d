"""Lock the store of a sweep against a second sweep."""

import os
from contextlib import contextmanager, suppress
from pathlib import Path

from stiction.quantities.errors import InputError


@contextmanager
def locked(path: Path):
    """Lock the store folder `path`; raise InputError if another sweep is writing to it.

    The operating system releases the lock when the process ends. Without file locks two sweeps may run at once, but they write
    the same bits.
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
