"""Let another thread stop long computations, by a check that their loops call before each step.

An exception raised in the thread from outside would not be safe, because it may arrive while a library holds a lock. The lock
is then never released. For example, the lock of Numba's compiler would block every later computation of the process.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_check: ContextVar[Callable[[], None] | None] = ContextVar("check", default=None)


@contextmanager
def stopped_by(check: Callable[[], None]) -> Iterator[None]:
    """Return a context manager that calls `check` before each kernel and before each step of a map solver.

    check: raises KeyboardInterrupt if the computation must stop.
    """
    before = _check.set(check)
    try:
        yield
    finally:
        _check.reset(before)


def raise_if_stopped() -> None:
    """Call the check of the current context, which raises KeyboardInterrupt if the computation must stop."""
    check = _check.get()
    if check is not None:
        check()
